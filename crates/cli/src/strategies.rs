//! The strategies there are, that of a scene's terrain included.

use std::sync::Arc;

use antumbra::cull::Registry;
use antumbra::strategies;
use antumbra::terrain::HorizonStrategy;

/// All strategies by name. `horizon` needs a terrain: without one it is known, and says so when it is to draw.
pub fn registry(horizon: Option<&HorizonStrategy>) -> Registry {
    let mut registry = strategies::registry();
    let next = Arc::new(strategies::registry());
    let horizon = horizon.cloned().unwrap_or_default().with_registry(next);
    registry.register(move || Box::new(horizon.clone()));
    registry
}
