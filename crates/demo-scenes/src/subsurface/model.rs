//! The sub-surface model of the scene: a folded and faulted stack of horizons in a seismic volume, generated from a
//! seed.
//!
//! Its size is that of the data set of Plate, Grundhoefer, Schmidt, Froehlich, *Occlusion Culling for Sub-Surface
//! Models in Geo-Scientific Applications*, 2004: eleven horizons and sixteen faults with 3.88 million triangles in
//! all, and 525 x 475 x 751 samples. One function, `depth(horizon, place)`, defines all geometry, so that horizons,
//! faults and reflections match at every resolution.

mod extent;
mod fault;
mod fault_placement;
mod fault_surface;
mod horizon;
mod layers;
mod options;
mod viewpoints;
mod volume;
mod wells;

pub use fault::ModelFault;
pub use options::ModelOptions;
pub use viewpoints::{FlightPoint, ModelLight, Viewpoint};
pub use volume::ModelVolume;
pub use wells::Well;

use antumbra_subsurface::SubsurfaceError;
use fault::displace;
use glam::DVec2;
use layers::Layers;

/// A sub-surface model. It holds the parameters only; its methods generate surfaces, wells and samples.
#[derive(Debug, Clone)]
pub struct Model {
    options: ModelOptions,
    layers: Layers,
    faults: Vec<ModelFault>,
}

impl Model {
    /// Generates the parameters of a model from a seed.
    ///
    /// # Errors
    /// [`SubsurfaceError::Setting`] for an option outside its limits.
    pub fn new(options: &ModelOptions) -> Result<Self, SubsurfaceError> {
        options.check()?;
        let horizons = options.horizons as usize;
        let layers = Layers::new(options.seed, horizons);
        let faults =
            fault_placement::faults(options.seed, &layers, horizons, options.faults as usize);
        Ok(Self {
            options: *options,
            layers,
            faults,
        })
    }

    /// The options of the model.
    #[must_use]
    pub fn options(&self) -> &ModelOptions {
        &self.options
    }

    /// The faults, oldest first.
    #[must_use]
    pub fn faults(&self) -> &[ModelFault] {
        &self.faults
    }

    /// Depth in metres of a horizon (counted from 0 at the top) at a place (metres east and north of the centre).
    /// `None` where a fault leaves a gap in the horizon, and for a horizon that does not exist. Depths exist for the
    /// whole field, also where the horizon was not interpreted.
    #[must_use]
    pub fn depth(&self, horizon: usize, place: DVec2) -> Option<f64> {
        let moved = displace(&self.faults, place, self.layers.depth(horizon, place));
        let is_there = !moved.in_gap && horizon < self.options.horizons as usize;
        is_there.then_some(moved.depth)
    }

    /// Number of triangles of all horizons and faults, counted without making their geometry.
    #[must_use]
    pub fn triangle_count(&self) -> u64 {
        let horizons = 0..self.options.horizons as usize;
        let horizons: u64 = horizons
            .map(|horizon| self.horizon_triangles(horizon))
            .sum();
        let faults = self.faults.iter().map(|fault| self.fault_triangles(fault));
        horizons + faults.sum::<u64>()
    }
}
