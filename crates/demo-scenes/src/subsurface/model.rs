//! The built-in sub-surface model: a folded and faulted stack of horizons in a seismic volume, out of a seed.
//!
//! It is as large as the data set of Plate, Grundhoefer, Schmidt, Froehlich, *Occlusion Culling for Sub-Surface Models in Geo-Scientific
//! Applications*, 2004: eleven horizons and sixteen faults of 3.88 million triangles together in 525 x 475 x 751 samples. All
//! geometry comes from one rule, `depth(horizon, place)`, so that horizons, faults and reflections fit each other at any size.

mod chance;
mod fault;
mod fault_surface;
mod horizon;
mod layers;
mod placing;
mod stage;
mod volume;
mod wells;

pub use fault::ModelFault;
pub use stage::{FlightPoint, ModelLight, Viewpoint};
pub use volume::ModelVolume;
pub use wells::Well;

use antumbra_subsurface::{SubsurfaceError, Surface};
use fault::displace;
use glam::{DVec2, DVec3};
use layers::Layers;

/// Half the field's extent, metres east and north.
const HALF: DVec2 = DVec2::new(3275.0, 2962.5);
/// Depth of the volume, in metres.
const DEPTH: f64 = 3000.0;
/// Nodes along a side of a horizon in the full model.
const FULL_NODES: u32 = 432;

/// How large the model is, and how its chance falls.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ModelOptions {
    /// Nodes along each side of a horizon, 2..=4096. Faults, wells and the volume grow with it; the shape stays.
    pub nodes_per_side: u32,
    /// The same seed gives the same model everywhere.
    pub seed: u64,
    /// How many horizons, 1..=64.
    pub horizons: u32,
    /// How many faults, 0..=64.
    pub faults: u32,
}

impl Default for ModelOptions {
    /// The full model: 3.88 million triangles, 187 million samples.
    fn default() -> Self {
        Self {
            nodes_per_side: FULL_NODES,
            seed: 1,
            horizons: 11,
            faults: 16,
        }
    }
}

/// The rule of a sub-surface model; surfaces, wells and samples are made when they are asked for.
#[derive(Debug, Clone)]
pub struct Model {
    options: ModelOptions,
    layers: Layers,
    faults: Vec<ModelFault>,
}

impl Model {
    /// Draws a model.
    ///
    /// # Errors
    /// [`SubsurfaceError::Setting`] for an option outside its limits.
    pub fn new(options: &ModelOptions) -> Result<Self, SubsurfaceError> {
        let limits = [
            ("nodes_per_side", options.nodes_per_side, 2..=4096),
            ("horizons", options.horizons, 1..=64),
            ("faults", options.faults, 0..=64),
        ];
        for (what, value, possible) in limits {
            if !possible.contains(&value) {
                return Err(SubsurfaceError::Setting {
                    what,
                    value: value.to_string(),
                    problem: format!("{possible:?} are possible"),
                });
            }
        }
        let horizons = options.horizons as usize;
        let layers = Layers::new(options.seed, horizons);
        let faults = placing::faults(options.seed, &layers, horizons, options.faults as usize);
        Ok(Self {
            options: *options,
            layers,
            faults,
        })
    }

    /// What it was drawn from.
    #[must_use]
    pub fn options(&self) -> &ModelOptions {
        &self.options
    }

    /// The faults, oldest first.
    #[must_use]
    pub fn faults(&self) -> &[ModelFault] {
        &self.faults
    }

    /// Depth in metres of a horizon at a place, metres east and north of the middle; `None` where a fault left a gap in it, and
    /// for a horizon that there is not. Horizons count from 0 at the top. It holds for the whole field, also where the horizon was not interpreted.
    #[must_use]
    pub fn depth(&self, horizon: usize, place: DVec2) -> Option<f64> {
        let moved = displace(&self.faults, place, self.layers.depth(horizon, place));
        let is_there = !moved.cut && horizon < self.options.horizons as usize;
        is_there.then_some(moved.depth)
    }

    /// A horizon, counted from 0 at the top.
    ///
    /// Its cells are left out where a fault breaks it, and in the south-east, where the more of it was not interpreted the
    /// higher it lies, so that what is below shows.
    ///
    /// # Errors
    /// [`SubsurfaceError::BadSurface`] if there is no such horizon, or so few nodes that the faults break every cell.
    pub fn horizon(&self, horizon: usize) -> Result<Surface, SubsurfaceError> {
        horizon::surface(self, horizon)
    }

    /// The surface of a fault, counted from 0, the oldest.
    ///
    /// # Errors
    /// [`SubsurfaceError::BadSurface`] if there is no such fault.
    pub fn fault(&self, fault: usize) -> Result<Surface, SubsurfaceError> {
        fault_surface::surface(self, fault)
    }

    /// Triangles of all horizons and faults, counted without making them.
    #[must_use]
    pub fn triangle_count(&self) -> u64 {
        let horizons = 0..self.options.horizons as usize;
        let faults = self.faults.iter();
        let horizons: u64 = horizons.map(|k| horizon::triangles(self, k)).sum();
        horizons
            + faults
                .map(|f| fault_surface::triangles(self, f))
                .sum::<u64>()
    }

    /// The wells.
    #[must_use]
    pub fn wells(&self) -> Vec<Well> {
        wells::wells(self)
    }

    /// The seismic volume, computed brick by brick.
    #[must_use]
    pub fn volume(&self) -> ModelVolume {
        ModelVolume::new(self.clone())
    }

    /// Two lamps above the field and where they are, with intensities for its size.
    #[must_use]
    pub fn lights(&self) -> [ModelLight; 2] {
        stage::lights()
    }

    /// `open`, from above the cut-outs with many layers in sight, and `occluded`, from where the upper horizons and the
    /// slices hide most.
    #[must_use]
    pub fn views(&self) -> [Viewpoint; 2] {
        stage::views()
    }

    /// A closed flight around and into the model: eye and target of each control point.
    #[must_use]
    pub fn flight(&self) -> Vec<FlightPoint> {
        stage::flight(self)
    }

    /// How much finer than the full model it is.
    fn fineness(&self) -> f64 {
        f64::from(self.options.nodes_per_side - 1) / f64::from(FULL_NODES - 1)
    }
}

/// World coordinates of a place, metres east and north, and a depth in metres.
fn world(place: DVec2, depth: f64) -> DVec3 {
    DVec3::new(place.x, -depth, -place.y)
}
