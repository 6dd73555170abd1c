//! The `.prj` file beside a raster: the coordinate system in words, as OGC's well-known text (ISO 19162) or in Esri's older lines of
//! `Projection` and `Units`. Only the units are read.

use std::path::Path;

use crate::units::{LengthUnit, PlanUnit, Units};

/// The greatest length of such a file that is read.
const MOST: u64 = 64 << 10;

/// The units that the projection file beside `file` names; nothing where there is none.
pub(super) fn beside(file: &Path) -> Units {
    let path = file.with_extension("prj");
    let bytes = antumbra_files::read_whole_file(&path, MOST);
    bytes.map_or_else(
        |_| Units::default(),
        |bytes| units(&String::from_utf8_lossy(&bytes)),
    )
}

fn units(text: &str) -> Units {
    let text = text.trim().to_ascii_uppercase();
    match text.contains('[') {
        true => of_well_known_text(&text),
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
            (false, true) => Some(PlanUnit::DEGREES),
            (false, false) => None,
        },
        height: last_unit(height),
    }
}

/// The last `UNIT["name",metres]` of a text.
fn last_unit(text: &str) -> Option<LengthUnit> {
    let (_, rest) = text.rsplit_once("UNIT[")?;
    let (_, number) = rest.split_once(',')?;
    let end = number.find([',', ']'])?;
    LengthUnit::from_metres(number.get(..end)?.trim().parse().ok()?)
}

fn of_lines(text: &str) -> Units {
    let value = |key: &str| {
        let mut lines = text.lines().map(str::split_whitespace);
        lines.find_map(|mut words| words.next().filter(|word| *word == key).and(words.next()))
    };
    let is_degrees = value("PROJECTION") == Some("GEOGRAPHIC") || value("UNITS") == Some("DD");
    let length = |key| value(key).and_then(LengthUnit::from_name);
    Units {
        plan: match is_degrees {
            true => Some(PlanUnit::DEGREES),
            false => length("UNITS").map(PlanUnit::Length),
        },
        height: length("ZUNITS"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_kinds_of_projection_files_name_units() {
        let feet = units(
            r#"PROJCS["NAD83 / Texas",GEOGCS["NAD83",UNIT["degree",0.0174532925199433]],UNIT["US survey foot",0.3048006096012192]]"#,
        );
        let survey_foot = LengthUnit::from_code(9003);
        assert_eq!(feet.plan, survey_foot.map(PlanUnit::Length));
        let compound = units(
            r#"COMPD_CS["x",GEOGCS["WGS 84",UNIT["degree",0.0174532925199433]],VERT_CS["h",UNIT["foot",0.3048]]]"#,
        );
        assert_eq!(compound.plan, Some(PlanUnit::DEGREES));
        assert_eq!(compound.height, Some(LengthUnit::FOOT));
        let lines = units("Projection    GEOGRAPHIC\nDatum WGS84\nUnits DD\nZunits FEET\n");
        assert_eq!(lines, compound);
        for nothing in [
            "",
            "[",
            "PROJCS[",
            "UNIT[x,",
            "LOCAL_CS[\"a\",UNIT[\"m\",1]]",
        ] {
            assert_eq!(units(nothing), Units::default(), "{nothing}");
        }
    }
}
