//! The fixed settings of `--set`: read from their text, and added to the specifications of their strategies.

use antumbra::cull::Registry;

use crate::failure::Failure;
use crate::strategies::name_of;

/// A setting of every entry of a strategy, `STRATEGY.KEY=VALUE`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FixedSetting {
    /// The name of the strategy.
    pub strategy: String,
    /// The key of the setting.
    pub key: String,
    /// The value as text. The strategy checks it when the specification is parsed.
    pub value: String,
}

impl FixedSetting {
    fn read(text: &str) -> Result<Self, Failure> {
        let parts = text
            .split_once('=')
            .and_then(|(left, value)| left.split_once('.').map(|(name, key)| (name, key, value)));
        match parts {
            Some((strategy, key, value)) => Ok(Self {
                strategy: strategy.to_owned(),
                key: key.to_owned(),
                value: value.to_owned(),
            }),
            None => Err(Failure::Usage(format!(
                "'{text}' is no setting: write STRATEGY.KEY=VALUE"
            ))),
        }
    }
}

/// Reads the values of `--set`, and checks that their strategies exist.
///
/// # Errors
/// [`Failure::Usage`] for a text that is not `STRATEGY.KEY=VALUE`; [`Failure::Registry`] for a strategy that does not exist.
pub fn fixed_settings(texts: &[String], registry: &Registry) -> Result<Vec<FixedSetting>, Failure> {
    let fixed = texts.iter().map(|text| FixedSetting::read(text));
    let fixed = fixed.collect::<Result<Vec<_>, _>>()?;
    for setting in &fixed {
        registry.make(&setting.strategy)?;
    }
    Ok(fixed)
}

/// A specification with the fixed settings of its strategy added.
pub fn with_fixed(spec: &str, fixed: &[FixedSetting]) -> String {
    let name = name_of(spec);
    let own = fixed.iter().filter(|setting| setting.strategy == name);
    own.fold(spec.to_owned(), |spec, FixedSetting { key, value, .. }| {
        format!("{spec}:{key}={value}")
    })
}
