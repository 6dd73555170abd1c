//! The strategies there are, that of a scene's terrain included.

use antumbra::cull::Registry;
use antumbra::terrain::HorizonStrategy;

/// All strategies by name. `horizon` needs a terrain: without one it is known, and says so when it is to draw.
pub fn registry(horizon: Option<&HorizonStrategy>) -> Registry {
    let mut registry = antumbra::strategies::registry();
    let horizon = horizon.cloned().unwrap_or_default();
    registry.register(move || Box::new(horizon.clone()));
    registry
}
