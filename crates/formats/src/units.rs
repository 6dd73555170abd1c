//! Units of lengths and places, as files name them and as a caller overrides them. Codes are those of the EPSG registry, which GeoTIFF uses.

use std::fmt;
use std::str::FromStr;

use antumbra_files::words;

/// The length of a degree on a great circle of the mean Earth, in metres.
const DEGREE: f64 = 6_371_008.8 * std::f64::consts::PI / 180.0;

/// A unit of length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LengthUnit {
    /// Its plural; `None` for a length without a name.
    name: Option<&'static str>,
    metres: f64,
}

/// A known unit: its plural, its length in metres, its EPSG code, and the names that files give it, in lower case.
struct Known {
    unit: LengthUnit,
    code: u16,
    names: &'static [&'static str],
}

const fn known(
    name: &'static str,
    metres: f64,
    code: u16,
    names: &'static [&'static str],
) -> Known {
    Known {
        unit: LengthUnit {
            name: Some(name),
            metres,
        },
        code,
        names,
    }
}

const KNOWN: [Known; 13] = [
    known(
        "metres",
        1.0,
        9001,
        &["m", "metre", "metres", "meter", "meters"],
    ),
    known(
        "feet",
        0.3048,
        9002,
        &[
            "ft",
            "foot",
            "feet",
            "international foot",
            "international feet",
        ],
    ),
    known(
        "US survey feet",
        1200.0 / 3937.0,
        9003,
        &[
            "us-ft",
            "usft",
            "ftus",
            "ft-us",
            "us_ft",
            "foot_us",
            "us survey foot",
            "us survey feet",
        ],
    ),
    known(
        "Clarke's feet",
        0.304_797_265_4,
        9005,
        &["clarke's foot", "clarke's feet"],
    ),
    known("fathoms", 1.8288, 9014, &["fathom", "fathoms"]),
    known(
        "nautical miles",
        1852.0,
        9030,
        &["nmi", "nautical mile", "nautical miles"],
    ),
    known(
        "German legal metres",
        1.000_013_596_5,
        9031,
        &[
            "german legal metre",
            "german legal metres",
            "german metre",
            "german metres",
        ],
    ),
    known(
        "kilometres",
        1000.0,
        9036,
        &["km", "kilometre", "kilometres", "kilometer", "kilometers"],
    ),
    known("miles", 1609.344, 9093, &["mi", "mile", "miles"]),
    known("yards", 0.9144, 9096, &["yd", "yard", "yards"]),
    known(
        "Indian feet",
        0.304_799_510_248_147,
        9080,
        &["indian foot", "indian feet"],
    ),
    known(
        "Indian feet of 1937",
        0.304_798_41,
        9081,
        &["indian foot (1937)", "indian feet (1937)"],
    ),
    known(
        "centimetres",
        0.01,
        1033,
        &[
            "cm",
            "centimetre",
            "centimetres",
            "centimeter",
            "centimeters",
        ],
    ),
];

impl LengthUnit {
    /// The metre.
    pub const METRE: Self = KNOWN[0].unit;
    /// The international foot.
    pub const FOOT: Self = KNOWN[1].unit;

    /// The unit of this name, in upper or lower case, as files write it: `m`, `FEET`, `US survey foot`.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        let name = name.trim().to_ascii_lowercase();
        let mut all = KNOWN.iter();
        let found = all.find(|known| known.names.contains(&name.as_str()));
        found.map(|known| known.unit)
    }

    /// The unit with this EPSG code.
    #[must_use]
    pub fn from_code(code: u16) -> Option<Self> {
        let found = KNOWN.iter().find(|known| known.code == code);
        found.map(|known| known.unit)
    }

    /// The unit of this many metres; `None` if that is no length.
    #[must_use]
    pub fn from_metres(metres: f64) -> Option<Self> {
        let near = |known: &&Known| (known.unit.metres - metres).abs() < 1e-9 * known.unit.metres;
        let other = Self { name: None, metres };
        let is_length = metres.is_finite() && metres > 0.0;
        is_length.then(|| KNOWN.iter().find(near).map_or(other, |known| known.unit))
    }

    /// Its length in metres.
    #[must_use]
    pub fn metres(self) -> f64 {
        self.metres
    }
}

impl fmt::Display for LengthUnit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.name {
            Some(name) => f.write_str(name),
            None => write!(f, "units of {} m", self.metres),
        }
    }
}

/// A unit of places in the plan.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PlanUnit {
    /// Longitude and latitude, in units of so many degrees (1 for degrees).
    Angle(f64),
    /// Lengths east and north.
    Length(LengthUnit),
}

impl PlanUnit {
    /// Longitude and latitude in degrees.
    pub const DEGREES: Self = Self::Angle(1.0);

    /// Metres of a unit east and north. Degrees are taken to metres on the mean Earth's sphere, with the parallel of `latitude` (degrees) in its
    /// true length: an equirectangular projection, in which places far north or south of it are too wide or too narrow.
    #[must_use]
    pub fn metres(self, latitude: f64) -> [f64; 2] {
        match self {
            Self::Length(unit) => [unit.metres; 2],
            Self::Angle(degrees) => {
                let parallel = latitude.to_radians().cos().max(1e-3);
                [degrees * DEGREE * parallel, degrees * DEGREE]
            }
        }
    }
}

/// What a caller, or a file, says of its units. `None` says nothing.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Units {
    /// The unit of places in the plan.
    pub plan: Option<PlanUnit>,
    /// The unit of heights and depths.
    pub height: Option<LengthUnit>,
}

impl Units {
    /// These units, and `other`'s where these say nothing.
    #[must_use]
    pub fn or(self, other: Self) -> Self {
        Self {
            plan: self.plan.or(other.plan),
            height: self.height.or(other.height),
        }
    }
}

/// What a file says of its units, with what of it is not known.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SaidUnits {
    /// The units.
    pub units: Units,
    /// The units that are named and not known, a line each.
    pub notes: Vec<String>,
}

impl SaidUnits {
    /// The unit of length that a file names for `what`. One that is not known is noted; no word is no unit.
    pub fn length(&mut self, what: &str, word: &str) -> Option<LengthUnit> {
        let found = LengthUnit::from_name(word);
        if found.is_none() && !word.trim().is_empty() {
            self.unknown(what, word);
        }
        found
    }

    /// As [`Self::length`], by EPSG code.
    pub fn length_of_code(&mut self, what: &str, code: u16) -> Option<LengthUnit> {
        let found = LengthUnit::from_code(code);
        if found.is_none() {
            self.unknown(what, &format!("EPSG:{code}"));
        }
        found
    }

    fn unknown(&mut self, what: &str, word: &str) {
        self.notes.push(format!(
            "its unit of {what}, `{}`, is not known and counts as none (--units)",
            words::name(word.trim())
        ));
    }
}

impl FromStr for Units {
    type Err = String;

    /// Reads `m`, `ft` and other lengths for places and heights alike; `degrees` for places alone; and `degrees,ft` or `km,m` for places, then
    /// heights.
    fn from_str(text: &str) -> Result<Self, String> {
        let length = |name: &str| {
            LengthUnit::from_name(name).ok_or_else(|| {
                format!("`{name}` is no unit: write m, ft, us-ft, km, cm or degrees, or two for places and heights, degrees,ft")
            })
        };
        let is_degrees = |name: &str| {
            ["degrees", "degree", "deg"]
                .iter()
                .any(|known| known.eq_ignore_ascii_case(name.trim()))
        };
        let plan = |name: &str| match is_degrees(name) {
            true => Ok(PlanUnit::DEGREES),
            false => length(name).map(PlanUnit::Length),
        };
        match text.split_once(',') {
            Some((places, heights)) => Ok(Self {
                plan: Some(plan(places)?),
                height: Some(length(heights)?),
            }),
            None => Ok(Self {
                plan: Some(plan(text)?),
                height: match is_degrees(text) {
                    true => None,
                    false => Some(length(text)?),
                },
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_word_says_units_of_places_and_heights() {
        let feet: Units = "ft".parse().unwrap_or_default();
        assert_eq!(feet.plan, Some(PlanUnit::Length(LengthUnit::FOOT)));
        assert_eq!(feet.height, Some(LengthUnit::FOOT));
        let degrees: Units = "degrees".parse().unwrap_or_default();
        assert_eq!(degrees.plan, Some(PlanUnit::DEGREES));
        assert_eq!(degrees.height, None);
        let both: Units = "degrees,ft".parse().unwrap_or_default();
        assert_eq!(both.height, Some(LengthUnit::FOOT));
        for wrong in ["", "furlong", "m,degrees", "m,", "ft,m,m"] {
            assert!(wrong.parse::<Units>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn a_degree_is_shorter_along_its_parallel() {
        let [east, north] = PlanUnit::DEGREES.metres(60.0);
        assert!((north - 111_195.08).abs() < 0.01 && (east / north - 0.5).abs() < 1e-12);
        let [east, _] = PlanUnit::DEGREES.metres(90.0);
        assert!(east > 0.0, "a pole has an area");
    }

    #[test]
    fn a_size_is_the_unit_of_that_size() {
        let foot = LengthUnit::from_metres(0.304_800_609_601_219_2);
        assert_eq!(foot, LengthUnit::from_code(9003));
        assert_eq!(LengthUnit::from_name(" METRES "), Some(LengthUnit::METRE));
        assert_eq!(LengthUnit::from_metres(-1.0), None);
        assert_eq!(LengthUnit::from_metres(f64::NAN), None);
        let half = LengthUnit::from_metres(0.5).map(|unit| unit.to_string());
        assert_eq!(half.as_deref(), Some("units of 0.5 m"));
    }

    #[test]
    fn indian_feet_are_those_of_the_registry() {
        let metres = |code| LengthUnit::from_code(code).map(LengthUnit::metres);
        assert_eq!(metres(9080), Some(0.304_799_510_248_147));
        assert_eq!(metres(9081), Some(0.304_798_41));
    }

    #[test]
    fn plurals_are_names_too() {
        for plural in ["German legal metres", "Indian feet", "Clarke's feet"] {
            let found = LengthUnit::from_name(plural).map(|unit| unit.to_string());
            assert_eq!(found.as_deref(), Some(plural));
        }
    }

    #[test]
    fn units_that_are_not_known_are_quoted() {
        let mut said = SaidUnits::default();
        assert_eq!(said.length("heights", " "), None);
        assert_eq!(said.length("heights", "ft"), Some(LengthUnit::FOOT));
        assert!(said.notes.is_empty());
        assert_eq!(said.length("heights", "cubits"), None);
        assert_eq!(said.length_of_code("places", 9999), None);
        assert!(said.notes[0].contains("heights, `cubits`"));
        assert!(said.notes[1].contains("EPSG:9999"));
    }
}
