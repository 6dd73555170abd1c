//! The strategies by name, that of a scene's terrain included.

use std::sync::Arc;

use antumbra::cull::{Registry, Strategy};
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

/// The names of the yardsticks, in the order of the registry.
pub fn yardsticks(registry: &Registry) -> Vec<&str> {
    let is_yardstick = |name: &&str| {
        let made = registry.make(name);
        made.is_ok_and(|strategy| strategy.role().is_yardstick())
    };
    registry.names().filter(is_yardstick).collect()
}

/// Whether a strategy uses the horizons of a terrain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Horizons {
    /// One does.
    Used,
    /// None does.
    Unused,
}

impl Horizons {
    /// Whether one of the strategies that are named uses them.
    pub fn of<'a>(specs: impl IntoIterator<Item = &'a String>) -> Self {
        let own = HorizonStrategy::default();
        let mut names = specs.into_iter().map(|spec| name_of(spec));
        match names.any(|name| name == own.name()) {
            true => Self::Used,
            false => Self::Unused,
        }
    }
}

/// The strategy's name in a specification, `NAME:key=value`.
pub fn name_of(spec: &str) -> &str {
    spec.split(':').next().unwrap_or_default()
}

/// A text that two strategies share where they have one name and the same settings.
pub fn identity(strategy: &dyn Strategy) -> String {
    let settings: Vec<String> = strategy
        .settings()
        .iter()
        .map(|setting| format!("{}={}", setting.key, setting.value))
        .collect();
    format!("{} {}", strategy.name(), settings.join(" "))
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn horizons_are_used_by_the_strategy_of_that_name_alone() {
        let of = |specs: &[&str]| {
            let specs: Vec<String> = specs.iter().map(|spec| (*spec).to_owned()).collect();
            Horizons::of(&specs)
        };
        assert_eq!(of(&["frustum", "horizon:clearance=2"]), Horizons::Used);
        assert_eq!(of(&["horizon"]), Horizons::Used);
        assert_eq!(of(&["frustum", "three-pass:threshold=5"]), Horizons::Unused);
        assert_eq!(of(&[]), Horizons::Unused);
    }
}
