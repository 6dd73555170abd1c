//! A strategy's table of settings: each described, read and written in one place.

use std::ops::{Bound, RangeInclusive};

use super::setting_range::{AUTO, SettingRange};
use super::value::Value;
use super::{Setting, SettingError};

/// One setting of a strategy (or of a part of one) of type `S`.
pub struct Parameter<S> {
    key: &'static str,
    unit: &'static str,
    meaning: &'static str,
    access: Access<S>,
}

/// What values it takes, and how it is read and written.
enum Access<S> {
    Whole {
        range: RangeInclusive<u32>,
        get: fn(&S) -> u32,
        set: fn(&mut S, u32),
    },
    WholeOrAuto {
        range: RangeInclusive<u32>,
        get: fn(&S) -> Option<u32>,
        set: fn(&mut S, Option<u32>),
    },
    Number {
        least: Bound<f64>,
        most: Bound<f64>,
        get: fn(&S) -> f64,
        set: fn(&mut S, f64),
    },
    Switch {
        get: fn(&S) -> bool,
        set: fn(&mut S, bool),
    },
    Words {
        words: &'static [&'static str],
        get: fn(&S) -> &'static str,
        /// Told the place of the word among `words`.
        set: fn(&mut S, usize),
    },
}

impl<S> Parameter<S> {
    /// A whole number.
    pub const fn whole(
        key: &'static str,
        range: RangeInclusive<u32>,
        unit: &'static str,
        meaning: &'static str,
        get: fn(&S) -> u32,
        set: fn(&mut S, u32),
    ) -> Self {
        Self {
            key,
            unit,
            meaning,
            access: Access::Whole { range, get, set },
        }
    }

    /// A whole number, or none, which is written `auto`: the strategy finds one by itself ([`Tunable::following`](super::Tunable::following)).
    pub const fn whole_or_auto(
        key: &'static str,
        range: RangeInclusive<u32>,
        unit: &'static str,
        meaning: &'static str,
        get: fn(&S) -> Option<u32>,
        set: fn(&mut S, Option<u32>),
    ) -> Self {
        Self {
            key,
            unit,
            meaning,
            access: Access::WholeOrAuto { range, get, set },
        }
    }

    /// A number in a closed range.
    pub const fn number(
        key: &'static str,
        range: RangeInclusive<f64>,
        unit: &'static str,
        meaning: &'static str,
        get: fn(&S) -> f64,
        set: fn(&mut S, f64),
    ) -> Self {
        let (least, most) = (
            Bound::Included(*range.start()),
            Bound::Included(*range.end()),
        );
        Self::bounded(key, least, most, unit, meaning, get, set)
    }

    /// A number above `least`, at most `most`.
    pub const fn number_above(
        key: &'static str,
        least: f64,
        most: f64,
        unit: &'static str,
        meaning: &'static str,
        get: fn(&S) -> f64,
        set: fn(&mut S, f64),
    ) -> Self {
        let (least, most) = (Bound::Excluded(least), Bound::Included(most));
        Self::bounded(key, least, most, unit, meaning, get, set)
    }

    /// A number from `least` on, which may be infinite; that is written `any`.
    pub const fn number_or_any(
        key: &'static str,
        least: f64,
        unit: &'static str,
        meaning: &'static str,
        get: fn(&S) -> f64,
        set: fn(&mut S, f64),
    ) -> Self {
        let (least, most) = (Bound::Included(least), Bound::Unbounded);
        Self::bounded(key, least, most, unit, meaning, get, set)
    }

    const fn bounded(
        key: &'static str,
        least: Bound<f64>,
        most: Bound<f64>,
        unit: &'static str,
        meaning: &'static str,
        get: fn(&S) -> f64,
        set: fn(&mut S, f64),
    ) -> Self {
        let access = Access::Number {
            least,
            most,
            get,
            set,
        };
        Self {
            key,
            unit,
            meaning,
            access,
        }
    }

    /// `true` or `false`.
    pub const fn switch(
        key: &'static str,
        meaning: &'static str,
        get: fn(&S) -> bool,
        set: fn(&mut S, bool),
    ) -> Self {
        Self {
            key,
            unit: "",
            meaning,
            access: Access::Switch { get, set },
        }
    }

    /// One of several words; `set` is told the place of the word among them.
    pub const fn words(
        key: &'static str,
        words: &'static [&'static str],
        meaning: &'static str,
        get: fn(&S) -> &'static str,
        set: fn(&mut S, usize),
    ) -> Self {
        Self {
            key,
            unit: "",
            meaning,
            access: Access::Words { words, get, set },
        }
    }

    /// Its name.
    pub const fn key(&self) -> &'static str {
        self.key
    }

    fn range(&self) -> SettingRange {
        match &self.access {
            Access::Whole { range, .. } => SettingRange::Whole(range.clone()),
            Access::WholeOrAuto { range, .. } => SettingRange::WholeOrAuto(range.clone()),
            Access::Number { least, most, .. } => SettingRange::Number(*least, *most),
            Access::Switch { .. } => SettingRange::Switch,
            Access::Words { words, .. } => SettingRange::Words(words),
        }
    }

    fn setting(&self, of: &S) -> Setting {
        Setting {
            key: self.key,
            value: match &self.access {
                Access::Whole { get, .. } => get(of).into(),
                Access::WholeOrAuto { get, .. } => get(of).map_or(AUTO.into(), Value::from),
                Access::Number { get, .. } => get(of).into(),
                Access::Switch { get, .. } => get(of).into(),
                Access::Words { get, .. } => get(of).into(),
            },
            range: self.range(),
            unit: self.unit,
            meaning: self.meaning,
        }
    }

    /// Sets it; false for a value that it does not take.
    fn assign(&self, of: &mut S, value: &Value) -> bool {
        if !self.range().takes(value) {
            return false;
        }
        match (&self.access, value) {
            (Access::Whole { set, .. }, Value::Number(number)) => set(of, *number as u32),
            (Access::WholeOrAuto { set, .. }, Value::Number(number)) => {
                set(of, Some(*number as u32));
            }
            (Access::WholeOrAuto { set, .. }, Value::Word(_)) => set(of, None),
            (Access::Number { set, .. }, Value::Number(number)) => set(of, *number),
            (Access::Switch { set, .. }, Value::Switch(on)) => set(of, *on),
            (Access::Words { words, set, .. }, Value::Word(word)) => {
                match words.iter().position(|known| known == word) {
                    Some(place) => set(of, place),
                    None => return false,
                }
            }
            _ => return false,
        }
        true
    }
}

/// The settings of a table as they stand.
pub fn describe<S>(table: &[Parameter<S>], of: &S) -> Vec<Setting> {
    table
        .iter()
        .map(|parameter| parameter.setting(of))
        .collect()
}

/// Sets one setting of a table.
///
/// # Errors
/// [`SettingError::Unknown`] in the name of `strategy`, and [`SettingError::Value`].
pub fn assign<S>(
    strategy: &str,
    table: &[Parameter<S>],
    of: &mut S,
    key: &str,
    value: &Value,
) -> Result<(), SettingError> {
    let Some(parameter) = table.iter().find(|parameter| parameter.key == key) else {
        return Err(SettingError::Unknown {
            strategy: strategy.to_owned(),
            key: key.to_owned(),
            known: table.iter().map(Parameter::key).collect(),
        });
    };
    match parameter.assign(of, value) {
        true => Ok(()),
        false => Err(parameter.setting(of).refuse(value)),
    }
}

/// An f32 as the f64 that prints like it: 0.1 and not 0.10000000149.
pub fn shortest(number: f32) -> f64 {
    number.to_string().parse().unwrap_or(f64::from(number))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Default)]
    struct Set {
        count: u32,
        least: Option<u32>,
        part: f64,
        reach: f64,
        small: f32,
        on: bool,
        order: usize,
    }

    const ORDERS: &[&str] = &["state", "depth"];
    const TABLE: &[Parameter<Set>] = &[
        Parameter::whole("count", 1..=9, "px", "", |s| s.count, |s, v| s.count = v),
        Parameter::whole_or_auto("least", 0..=9, "px", "", |s| s.least, |s, v| s.least = v),
        Parameter::number_above("part", 0.0, 1.0, "", "", |s| s.part, |s, v| s.part = v),
        Parameter::number_or_any("reach", 0.0, "m", "", |s| s.reach, |s, v| s.reach = v),
        Parameter::number(
            "small",
            0.0..=64.0,
            "px",
            "",
            |s| shortest(s.small),
            |s, v| s.small = v as f32,
        ),
        Parameter::switch("on", "", |s| s.on, |s, v| s.on = v),
        Parameter::words("order", ORDERS, "", |s| ORDERS[s.order], |s, v| s.order = v),
    ];

    fn set(key: &str, text: &str) -> Result<Set, SettingError> {
        let mut set = Set::default();
        let found = TABLE.iter().find(|parameter| parameter.key == key);
        let value = found.and_then(|it| it.range().read(text));
        let value = value.unwrap_or_else(|| Value::from(text.to_owned()));
        assign("set", TABLE, &mut set, key, &value).map(|()| set)
    }

    #[test]
    fn what_is_set_prints_as_it_was_written() {
        for (key, text) in [
            ("count", "9"),
            ("least", "9"),
            ("least", "auto"),
            ("part", "0.3"),
            ("reach", "any"),
            ("small", "0.1"),
            ("on", "true"),
            ("order", "depth"),
        ] {
            let set = set(key, text).ok();
            let settings = set.map(|set| describe(TABLE, &set)).unwrap_or_default();
            let own = settings.iter().find(|setting| setting.key == key);
            assert_eq!(own.map(|own| own.value.to_string()).as_deref(), Some(text));
        }
    }

    #[test]
    fn what_is_out_of_range_or_of_another_kind_is_refused_in_words() {
        for (key, text, words) in [
            ("count", "0", "a whole number, 1 to 9"),
            ("count", "2.0", "a whole number, 1 to 9"),
            ("least", "10", "a whole number, 0 to 9, or auto"),
            ("least", "any", "a whole number, 0 to 9, or auto"),
            ("part", "0", "a number above 0, at most 1"),
            ("part", "inf", "a number above 0, at most 1"),
            ("part", "NaN", "a number above 0, at most 1"),
            ("reach", "-1", "a number from 0, or any"),
            ("reach", "inf", "a number from 0, or any"),
            ("small", "65", "a number from 0 to 64"),
            ("on", "yes", "true or false"),
            ("order", "name", "state or depth"),
        ] {
            match set(key, text) {
                Err(SettingError::Value { range, .. }) => assert_eq!(range, words),
                _ => panic!("{key}={text} was taken"),
            }
        }
        let unknown = set("colour", "red").err().map(|error| error.to_string());
        assert_eq!(
            unknown.as_deref(),
            Some(
                "strategy 'set' has no setting 'colour' (it has: count, least, part, reach, small, on, order)"
            )
        );
    }
}
