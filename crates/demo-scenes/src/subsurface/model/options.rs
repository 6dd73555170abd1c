//! The options of the sub-surface model.

use antumbra_subsurface::SubsurfaceError;

/// Nodes along a side of a horizon in the full model.
const FULL_NODES: u32 = 432;

/// Resolution, seed and number of surfaces of the model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ModelOptions {
    /// Nodes along each side of a horizon, 2..=4096. The resolution of faults, wells and volume follows it; the shape
    /// of the model stays.
    pub nodes_per_side: u32,
    /// Seed of the model. One seed gives the same model on every platform.
    pub seed: u64,
    /// Number of horizons, 1..=64.
    pub horizons: u32,
    /// Number of faults, 0..=64.
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

impl ModelOptions {
    /// Checks every option against its limits.
    pub(super) fn check(&self) -> Result<(), SubsurfaceError> {
        let limits = [
            ("nodes_per_side", self.nodes_per_side, 2..=4096),
            ("horizons", self.horizons, 1..=64),
            ("faults", self.faults, 0..=64),
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
        Ok(())
    }

    /// Resolution relative to the full model, along one axis: 1 for the full model.
    pub(super) fn relative_resolution(&self) -> f64 {
        f64::from(self.nodes_per_side - 1) / f64::from(FULL_NODES - 1)
    }
}
