//! Strategies by name, for command lines and reports. Strategies of other crates register like the built-in ones.

use thiserror::Error;

use crate::strategy::Strategy;
use crate::tuning::SettingError;

type Maker = Box<dyn Fn() -> Box<dyn Strategy> + Send + Sync>;

/// Makes strategies by name.
#[derive(Default)]
pub struct Registry {
    makers: Vec<(String, Maker)>,
}

/// Why a strategy could not be made.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum RegistryError {
    /// No strategy of that name.
    #[error("there is no strategy '{name}' (there are: {})", known.join(", "))]
    Unknown {
        /// The name.
        name: String,
        /// The known names.
        known: Vec<String>,
    },
    /// A setting that is not `key=value`.
    #[error("'{text}' is no setting: write key=value")]
    Form {
        /// What was given.
        text: String,
    },
    /// A setting the strategy refuses.
    #[error(transparent)]
    Setting(#[from] SettingError),
}

impl std::fmt::Debug for Registry {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_list().entries(self.names()).finish()
    }
}

impl Registry {
    /// An empty registry.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a strategy under its own name; a later one of the same name takes its place.
    pub fn register(&mut self, make: impl Fn() -> Box<dyn Strategy> + Send + Sync + 'static) {
        let name = make().name().to_owned();
        self.makers.retain(|(known, _)| *known != name);
        self.makers.push((name, Box::new(make)));
    }

    /// The names, in the order of registration.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.makers.iter().map(|(name, _)| name.as_str())
    }

    /// Makes a strategy with its default settings.
    ///
    /// # Errors
    /// [`RegistryError::Unknown`], with the names there are.
    pub fn make(&self, name: &str) -> Result<Box<dyn Strategy>, RegistryError> {
        match self.makers.iter().find(|(known, _)| known == name) {
            Some((_, make)) => Ok(make()),
            None => {
                let known = self.names().map(str::to_owned).collect();
                Err(RegistryError::Unknown {
                    name: name.to_owned(),
                    known,
                })
            }
        }
    }

    /// Makes a strategy from `name` or `name:key=value:key=value`.
    ///
    /// # Errors
    /// [`RegistryError`], with the known names or settings.
    pub fn parse(&self, text: &str) -> Result<Box<dyn Strategy>, RegistryError> {
        let mut parts = text.split(':');
        let mut strategy = self.make(parts.next().unwrap_or_default())?;
        for part in parts {
            let (key, value) = part.split_once('=').ok_or_else(|| RegistryError::Form {
                text: part.to_owned(),
            })?;
            strategy.set_text(key, value)?;
        }
        Ok(strategy)
    }
}
