//! The settings that a sweep measures: all combinations of the values of `--vary`.

use std::sync::Arc;

use antumbra::measure::compare::Contender;
use antumbra::measure::report::VariedSetting;
use antumbra::terrain::HorizonStrategy;

use crate::args::SweepArgs;
use crate::failure::Failure;
use crate::fixed_setting::{fixed_settings, with_fixed};
use crate::strategies::{identity, name_of, registry, yardsticks};

mod range;

/// The largest number of settings in a sweep. Each setting is a strategy with its own buffers.
const MOST_SETTINGS: usize = 200;

/// What a sweep compares.
pub struct Settings {
    /// The yardsticks, then every setting.
    pub list: Vec<Contender>,
    /// The settings that are varied, with their values.
    pub vary: Vec<VariedSetting>,
}

/// The settings that the arguments select. Checks strategies, keys and values; draws nothing.
///
/// # Errors
/// [`Failure::Registry`] for a strategy, key or value that does not exist, with those that exist; [`Failure::Usage`] for text that cannot be
/// read, a varied strategy that `--strategy` does not name, a key that is varied twice, and too many settings.
pub fn settings(args: &SweepArgs, horizon: Option<&HorizonStrategy>) -> Result<Settings, Failure> {
    let registry = Arc::new(registry(horizon));
    let fixed = fixed_settings(&args.set, &registry)?;
    let vary = args.vary.iter().map(|text| varied(text));
    let vary = vary.collect::<Result<Vec<_>, _>>()?;
    let names: Vec<&str> = args.strategy.iter().map(|spec| name_of(spec)).collect();
    for (at, varied) in vary.iter().enumerate() {
        refuse_unnamed(varied, &names)?;
        refuse_twice(varied, vary.get(at + 1..).unwrap_or_default())?;
    }
    let mut list = Vec::new();
    let mut seen = Vec::new();
    let yardsticks = yardsticks(&registry);
    for name in &yardsticks {
        seen.push(identity(registry.make(name)?.as_ref()));
        list.push(Contender::of("", &registry, name)?);
    }
    for (spec, name) in args.strategy.iter().zip(&names) {
        let base = with_fixed(spec, &fixed);
        registry.parse(&base)?;
        let own: Vec<&VariedSetting> = vary.iter().filter(|varied| is_of(varied, name)).collect();
        for chosen in combinations(&own)? {
            let pairs = || own.iter().zip(&chosen);
            let full = pairs().fold(base.clone(), |full, (varied, value)| {
                format!("{full}:{}={value}", varied.key)
            });
            let label = pairs().fold(spec.clone(), |label, (varied, value)| {
                format!("{label} {}={value}", varied.key)
            });
            let identity = identity(registry.parse(&full)?.as_ref());
            if !seen.contains(&identity) {
                seen.push(identity);
                list.push(Contender::of(label, &registry, &full)?);
            }
        }
        if list.len() > MOST_SETTINGS + yardsticks.len() {
            return Err(too_many(list.len() - yardsticks.len()));
        }
    }
    Ok(Settings { list, vary })
}

/// Whether the setting varies in this strategy.
fn is_of(varied: &VariedSetting, name: &str) -> bool {
    varied.strategy.as_deref().is_none_or(|of| of == name)
}

/// Refuses to vary a strategy that `--strategy` does not name.
fn refuse_unnamed(varied: &VariedSetting, names: &[&str]) -> Result<(), Failure> {
    match &varied.strategy {
        Some(of) if !names.contains(&of.as_str()) => Err(Failure::Usage(format!(
            "'{of}.{}' is varied, but --strategy does not name {of} (it names: {})",
            varied.key,
            names.join(", ")
        ))),
        _ => Ok(()),
    }
}

/// Refuses a setting that is varied again later.
fn refuse_twice(varied: &VariedSetting, later: &[VariedSetting]) -> Result<(), Failure> {
    let same = |other: &&VariedSetting| {
        let of = [&varied.strategy, &other.strategy];
        other.key == varied.key && (of.contains(&&None) || of[0] == of[1])
    };
    match later.iter().find(same) {
        Some(_) => Err(Failure::Usage(format!(
            "'{0}' is varied twice: name all its values at once, --vary {0}=1,2,3",
            varied.key
        ))),
        None => Ok(()),
    }
}

/// All combinations of one value of each setting. The value of the last setting changes fastest.
fn combinations<'a>(vary: &[&'a VariedSetting]) -> Result<Vec<Vec<&'a str>>, Failure> {
    let counts = vary.iter().map(|varied| varied.values.len());
    let count = counts.fold(1, usize::saturating_mul);
    if count > MOST_SETTINGS {
        return Err(too_many(count));
    }
    let mut all = vec![Vec::new()];
    for varied in vary {
        all = all
            .into_iter()
            .flat_map(|chosen: Vec<&'a str>| {
                varied.values.iter().map(move |value| {
                    let mut chosen = chosen.clone();
                    chosen.push(value.as_str());
                    chosen
                })
            })
            .collect();
    }
    Ok(all)
}

fn too_many(count: usize) -> Failure {
    Failure::Usage(format!(
        "{count} settings are too many for one sweep: {MOST_SETTINGS} at most, all combinations counted"
    ))
}

/// Reads `KEY=V1,V2` or `STRATEGY.KEY=V1,V2`, in which a value may be a range.
fn varied(text: &str) -> Result<VariedSetting, Failure> {
    let form = || {
        Failure::Usage(format!(
            "'{text}' varies nothing: write KEY=V1,V2 or STRATEGY.KEY=V1,V2"
        ))
    };
    let (left, right) = text.split_once('=').ok_or_else(form)?;
    let (strategy, key) = match left.split_once('.') {
        Some((strategy, key)) => (Some(strategy.to_owned()), key),
        None => (None, left),
    };
    let mut values = Vec::new();
    for part in right.split(',') {
        match range::values(part, MOST_SETTINGS)? {
            Some(range) => values.extend(range),
            None => values.push(part.to_owned()),
        }
    }
    if key.is_empty() || values.iter().any(String::is_empty) {
        return Err(form());
    }
    Ok(VariedSetting {
        strategy,
        key: key.to_owned(),
        values,
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
mod tests {
    use super::*;

    fn values(text: &str) -> Vec<String> {
        varied(&format!("key={text}")).unwrap().values
    }

    #[test]
    fn ranges_are_written_out_with_their_ends() {
        assert_eq!(values("7,frame-late"), ["7", "frame-late"]);
        assert_eq!(values("1..4"), ["1", "2", "3", "4"]);
        assert_eq!(values("0..1+0.25"), ["0", "0.25", "0.5", "0.75", "1"]);
        assert_eq!(values("0.1..0.3+0.1"), ["0.1", "0.2", "0.3"]);
        assert_eq!(values("1..256*4"), ["1", "4", "16", "64", "256"]);
        assert_eq!(values("0..10*2,50"), ["0", "1", "2", "4", "8", "50"]);
        assert_eq!(values("0.05..1*2"), ["0.05", "0.1", "0.2", "0.4", "0.8"]);
        assert_eq!(values("3..3"), ["3"]);
    }

    #[test]
    fn what_is_no_range_is_refused() {
        for text in [
            "4..1", "1..", "..4", "a..b", "1..4*1", "1..4*0.5", "1..4+0", "-1..4*2", "1..inf",
            "nan..4", "1..1e9", "1..4+", "1..4*2*2", "1...4",
        ] {
            let error = varied(&format!("key={text}")).unwrap_err().to_string();
            assert!(error.contains(text), "{error}");
        }
        for text in ["key", "key=", "=1", "key=1,,2", "a.=1"] {
            let error = varied(text).unwrap_err().to_string();
            assert!(error.contains("KEY=V1,V2"), "{error}");
        }
    }
}
