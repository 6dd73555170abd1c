//! The inner one of two strategies, as the outer one keeps it: chosen by the setting `then`, with all settings of its own.

use std::sync::{Arc, Mutex, PoisonError};

use crate::registry::Registry;
use crate::setting::{Setting, SettingError};
use crate::strategy::Strategy;
use crate::yardsticks::Frustum;

/// The strategy that another one [hands](crate::FrameGraph::hand_on) what it leaves on to; at first `frustum`, which draws it all.
pub struct Inner {
    registry: Arc<Registry>,
    /// Nobody waits for it: strategies need not be `Sync`, while whoever makes clones of the outer one for a registry has to be.
    strategy: Mutex<Box<dyn Strategy>>,
}

impl std::fmt::Debug for Inner {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let name = self.ask(|inner| inner.name().to_owned());
        f.debug_tuple("Inner").field(&name).finish()
    }
}

impl Default for Inner {
    /// One that can only ever be `frustum`; [`Self::among`] has more to choose from.
    fn default() -> Self {
        let mut registry = Registry::new();
        registry.register(|| Box::new(Frustum));
        Self::among(Arc::new(registry))
    }
}

impl Clone for Inner {
    /// A fresh one of the same name and settings: what a strategy keeps of what it declared stays with it.
    fn clone(&self) -> Self {
        let (name, settings) = self.ask(|inner| (inner.name().to_owned(), inner.settings()));
        let mut copy = Self::among(Arc::clone(&self.registry));
        if let Ok(strategy) = self.registry.make(&name) {
            copy.strategy = Mutex::new(strategy);
        }
        for setting in settings {
            // What a setting stands at is what it takes.
            let _ = copy.strategy_mut().set(setting.key, &setting.value);
        }
        copy
    }
}

impl Inner {
    /// Out of these strategies; the outer one is better not among them.
    pub fn among(registry: Arc<Registry>) -> Self {
        Self {
            registry,
            strategy: Mutex::new(Box::new(Frustum)),
        }
    }

    /// Asks the strategy something.
    pub fn ask<T>(&self, question: impl FnOnce(&dyn Strategy) -> T) -> T {
        let strategy = self.strategy.lock();
        question(strategy.unwrap_or_else(PoisonError::into_inner).as_ref())
    }

    /// The strategy, to be declared.
    pub fn strategy_mut(&mut self) -> &mut dyn Strategy {
        let strategy = self.strategy.get_mut();
        strategy.unwrap_or_else(PoisonError::into_inner).as_mut()
    }

    /// The setting `then`, and after it those of the strategy that it names.
    pub fn settings(&self) -> Vec<Setting> {
        let (name, own) = self.ask(|inner| (inner.name().to_owned(), inner.settings()));
        let then = Setting {
            key: "then",
            value: name,
            range: "the name of another strategy, whose settings follow",
            meaning: "which strategy judges what this one leaves",
        };
        std::iter::once(then).chain(own).collect()
    }

    /// Turns a knob: `then` takes another strategy as it comes, all else is the inner one's. An inner one that has a `then` itself keeps what it has.
    ///
    /// # Errors
    /// [`SettingError::Strategy`] for a name that is none or the outer one's, [`SettingError::Unknown`] of the strategy that has no such knob, which is the outer
    /// one where it has been told of no other; and what the inner one refuses.
    pub fn set(&mut self, outer: &str, key: &str, value: &str) -> Result<(), SettingError> {
        if key == "then" {
            let names = self.registry.names().filter(|name| *name != outer);
            let known: Vec<String> = names.map(str::to_owned).collect();
            let made = self.registry.make(value).ok();
            let Some(made) = made.filter(|_| known.iter().any(|name| name == value)) else {
                return Err(SettingError::Strategy {
                    key: key.to_owned(),
                    name: value.to_owned(),
                    known,
                });
            };
            self.strategy = Mutex::new(made);
            return Ok(());
        }
        let inner = self.strategy_mut();
        inner.set(key, value).map_err(|error| match error {
            SettingError::Unknown { key, .. } if inner.settings().is_empty() => {
                SettingError::Unknown {
                    strategy: format!("{outer}:then={}", inner.name()),
                    key,
                    known: vec!["then"],
                }
            }
            error => error,
        })
    }
}
