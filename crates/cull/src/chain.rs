//! The next one of two strategies in a chain, as the first one keeps it: chosen by the setting `then`, with its own settings.

use std::sync::{Arc, Mutex, PoisonError};

use crate::registry::Registry;
use crate::strategy::Strategy;
use crate::tuning::{Setting, SettingError, SettingRange, Step, Value};
use crate::yardsticks::FrustumOnly;

/// The strategy that judges what another one leaves ([`FrameGraph::chain`](crate::FrameGraph::chain)); at first `frustum`, which draws all of it.
pub struct Chain {
    registry: Arc<Registry>,
    /// Never contended: a strategy need not be `Sync`, but what a registry clones the owner from has to be.
    next: Mutex<Box<dyn Strategy>>,
}

impl std::fmt::Debug for Chain {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let name = self.ask(|next| next.name().to_owned());
        f.debug_tuple("Chain").field(&name).finish()
    }
}

impl Default for Chain {
    /// One that can only be `frustum`; [`Self::among`] has more to choose from.
    fn default() -> Self {
        let mut registry = Registry::new();
        registry.register(|| Box::new(FrustumOnly));
        Self::among(Arc::new(registry))
    }
}

impl Clone for Chain {
    /// A new strategy of the same name and settings: what a strategy keeps of its declared nodes is not copied.
    fn clone(&self) -> Self {
        let (name, settings) = self.ask(|next| (next.name().to_owned(), next.settings()));
        let mut copy = Self::among(Arc::clone(&self.registry));
        if let Ok(strategy) = self.registry.make(&name) {
            copy.next = Mutex::new(strategy);
        }
        for setting in settings {
            // A present value is always in range.
            let _ = copy.next_mut().set(setting.key, &setting.value);
        }
        copy
    }
}

impl Chain {
    /// One that may be any of these strategies; the owner itself is refused by [`Self::set`].
    pub fn among(registry: Arc<Registry>) -> Self {
        Self {
            registry,
            next: Mutex::new(Box::new(FrustumOnly)),
        }
    }

    /// Reads something of the next strategy.
    pub fn ask<T>(&self, read: impl FnOnce(&dyn Strategy) -> T) -> T {
        let strategy = self.next.lock();
        read(strategy.unwrap_or_else(PoisonError::into_inner).as_ref())
    }

    /// The next strategy, to be declared.
    pub fn next_mut(&mut self) -> &mut dyn Strategy {
        let strategy = self.next.get_mut();
        strategy.unwrap_or_else(PoisonError::into_inner).as_mut()
    }

    /// The setting `then`, and after it those of the strategy that it names.
    pub fn settings(&self) -> Vec<Setting> {
        let (name, own) = self.ask(|next| (next.name().to_owned(), next.settings()));
        let then = Setting {
            key: "then",
            value: Value::from(name),
            range: SettingRange::Strategy,
            unit: "",
            meaning: "which strategy judges what this one leaves",
        };
        std::iter::once(then).chain(own).collect()
    }

    /// The settings of the strategy that it names which follow the size of the image.
    pub fn following(&self, size: [u32; 2]) -> Vec<(&'static str, Value)> {
        self.ask(|next| next.following(size))
    }

    /// The steps of the strategy that it names.
    pub fn steps(&self) -> Vec<Step> {
        self.ask(|next| next.steps())
    }

    /// Sets a setting of the strategy `outer` that owns this: `then` replaces the next strategy by a new one, all other settings belong to the next strategy.
    ///
    /// # Errors
    /// [`SettingError::Strategy`] for a `then` that is unknown or `outer` itself; [`SettingError::Unknown`] and [`SettingError::Value`] as the next strategy says.
    pub fn set(&mut self, outer: &str, key: &str, value: &Value) -> Result<(), SettingError> {
        if key == "then" {
            let wanted = value.to_string();
            let names = self.registry.names().filter(|name| *name != outer);
            let known: Vec<String> = names.map(str::to_owned).collect();
            let made = self.registry.make(&wanted).ok();
            let Some(made) = made.filter(|_| known.contains(&wanted)) else {
                return Err(SettingError::Strategy {
                    key: key.to_owned(),
                    name: wanted,
                    known,
                });
            };
            self.next = Mutex::new(made);
            return Ok(());
        }
        let next = self.next_mut();
        next.set(key, value).map_err(|error| match error {
            SettingError::Unknown { key, .. } if next.settings().is_empty() => {
                SettingError::Unknown {
                    strategy: format!("{outer}:then={}", next.name()),
                    key,
                    known: vec!["then"],
                }
            }
            error => error,
        })
    }
}
