//! The `.prj` file beside a raster: the coordinate system in words, as OGC's well-known text (ISO 19162) or in Esri's older lines of
//! `Projection` and `Units`. Only the units are read.

use std::path::Path;

use crate::units::{LengthUnit, PlanUnit, SaidUnits, Units};

/// The greatest length of such a file that is read.
const MOST: u64 = 64 << 10;

/// The units that the projection file beside `file` names; nothing where there is none.
#[must_use]
pub fn units_beside(file: &Path) -> SaidUnits {
    let path = file.with_extension("prj");
    let bytes = antumbra_files::read_whole_file(&path, MOST);
    bytes.map_or_else(
        |_| SaidUnits::default(),
        |bytes| units(&String::from_utf8_lossy(&bytes)),
    )
}

fn units(text: &str) -> SaidUnits {
    let text = text.trim().to_ascii_uppercase();
    match text.contains('[') {
        true => SaidUnits {
            units: of_well_known_text(&text),
            notes: Vec::new(),
        },
        false => of_lines(&text),
    }
}

fn of_well_known_text(text: &str) -> Units {
    // A compound system names the plan's first, then that of heights.
    let vertical = ["VERT_CS", "VERTCRS", "VERTCS", "VERTICALCRS"];
    let at = vertical.iter().filter_map(|word| text.find(word)).min();
    let (plan, height) = text.split_at(at.unwrap_or(text.len()));
    let is_projected = ["PROJCS", "PROJCRS", "PROJECTEDCRS"]
        .iter()
        .any(|word| plan.contains(word));
    let is_geographic = ["GEOGCS", "GEOGCRS", "GEODCRS", "GEOGRAPHICCRS"]
        .iter()
        .any(|word| plan.contains(word));
    Units {
        plan: match (is_projected, is_geographic) {
            (true, _) => last_unit(plan).map(PlanUnit::Length),
            (false, true) => Some(angle(plan)),
            (false, false) => None,
        },
        height: last_unit(height),
    }
}

/// The last `UNIT["name",metres]` of a text.
fn last_unit(text: &str) -> Option<LengthUnit> {
    LengthUnit::from_metres(last_size(text, "UNIT[")?)
}

/// The unit of a geographic system: `UNIT["name",radians]`, in newer texts `ANGLEUNIT`, since those have lengths too. Degrees where it has none.
fn angle(text: &str) -> PlanUnit {
    let radians = last_size(text, "ANGLEUNIT[").or_else(|| last_size(text, "UNIT["));
    let degrees = radians.map(f64::to_degrees).filter(|degrees| {
        // Degrees are written with few digits and with many.
        degrees.is_finite() && *degrees > 0.0 && (degrees - 1.0).abs() > 1e-6
    });
    degrees.map_or(PlanUnit::DEGREES, PlanUnit::Angle)
}

/// The size of the last unit that is written with `keyword`.
fn last_size(text: &str, keyword: &str) -> Option<f64> {
    let (_, rest) = text.rsplit_once(keyword)?;
    let (_, number) = rest.split_once(',')?;
    let end = number.find([',', ']'])?;
    number.get(..end)?.trim().parse().ok()
}

fn of_lines(text: &str) -> SaidUnits {
    let value = |key: &str| {
        let mut lines = text.lines().map(str::split_whitespace);
        lines.find_map(|mut words| words.next().filter(|word| *word == key).and(words.next()))
    };
    let is_degrees = value("PROJECTION") == Some("GEOGRAPHIC") || value("UNITS") == Some("DD");
    let mut said = SaidUnits::default();
    said.units.plan = match (is_degrees, value("UNITS")) {
        (true, _) => Some(PlanUnit::DEGREES),
        (false, Some(word)) => said.length("places", word).map(PlanUnit::Length),
        (false, None) => None,
    };
    // NO: there are none.
    let heights = value("ZUNITS").filter(|word| *word != "NO");
    said.units.height = heights.and_then(|word| said.length("heights", word));
    said
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_kinds_of_projection_files_name_units() {
        let known = |text: &str| {
            let said = units(text);
            assert!(said.notes.is_empty(), "{said:?}");
            said.units
        };
        let feet = known(
            r#"PROJCS["NAD83 / Texas",GEOGCS["NAD83",UNIT["degree",0.0174532925199433]],UNIT["US survey foot",0.3048006096012192]]"#,
        );
        let survey_foot = LengthUnit::from_code(9003);
        assert_eq!(feet.plan, survey_foot.map(PlanUnit::Length));
        let compound = known(
            r#"COMPD_CS["x",GEOGCS["WGS 84",UNIT["degree",0.0174532925199433]],VERT_CS["h",UNIT["foot",0.3048]]]"#,
        );
        assert_eq!(compound.plan, Some(PlanUnit::DEGREES));
        assert_eq!(compound.height, Some(LengthUnit::FOOT));
        let lines = known("Projection    GEOGRAPHIC\nDatum WGS84\nUnits DD\nZunits FEET\n");
        assert_eq!(lines, compound);
        for nothing in [
            "",
            "[",
            "PROJCS[",
            "UNIT[x,",
            "LOCAL_CS[\"a\",UNIT[\"m\",1]]",
        ] {
            assert_eq!(known(nothing), Units::default(), "{nothing}");
        }
    }
    #[test]
    fn angles_are_those_that_a_geographic_system_names() {
        let plan = |text| units(text).units.plan;
        let grad = r#"GEOGCS["NTF (Paris)",DATUM["x",SPHEROID["y",6378249.2,293.46]],PRIMEM["Paris",2.33],UNIT["grad",0.015707963267949]]"#;
        let newer = r#"GEOGCRS["x",ELLIPSOID["y",6378249.2,293.46,LENGTHUNIT["metre",1]],CS[ellipsoidal,3],AXIS["lat",north,ANGLEUNIT["grad",0.015707963267949]],AXIS["h",up,LENGTHUNIT["metre",1]]]"#;
        for text in [grad, newer] {
            let Some(PlanUnit::Angle(degrees)) = plan(text) else {
                panic!("no angle in {text}");
            };
            assert!((degrees - 0.9).abs() < 1e-9, "{degrees}");
        }
        assert_eq!(plan(r#"GEOGCS["x"]"#), Some(PlanUnit::DEGREES));
    }

    #[test]
    fn a_unit_that_is_not_known_is_quoted() {
        let said = units("Projection UTM\nUnits CHAINS\nZunits NO\n");
        assert_eq!(said.units, Units::default());
        assert_eq!(said.notes.len(), 1);
        assert!(said.notes[0].contains("`CHAINS`"), "{said:?}");
    }
}
