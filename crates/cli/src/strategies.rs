//! The strategies by name, that of a scene's terrain included.

use std::sync::Arc;

use antumbra::cull::Registry;
use antumbra::strategies;
use antumbra::terrain::HorizonStrategy;

/// All strategies. `horizon` needs a terrain; without one it is listed, and refuses to draw.
pub fn registry(horizon: Option<&HorizonStrategy>) -> Registry {
    let mut registry = strategies::registry();
    let next = Arc::new(strategies::registry());
    let horizon = horizon.cloned().unwrap_or_default().with_registry(next);
    registry.register(move || Box::new(horizon.clone()));
    registry
}

/// The help of an option that takes strategies: what it says, and their names.
pub fn listed(what: &str) -> String {
    let registry = registry(None);
    let names: Vec<&str> = registry.names().collect();
    format!(
        "{what}. Names: {}; `antumbra strategies` describes them",
        names.join(", ")
    )
}
