//! The names of the scenes of [`by_name`](crate::by_name).

pub(crate) const NAMES: [&str; 4] = ["grid", "layer", "turbine", "city"];
