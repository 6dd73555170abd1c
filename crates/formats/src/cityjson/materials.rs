//! Colours, since files seldom have any: a material per type of object, and vertex colours for surfaces such as roofs
//! and doors.

use super::boundary::GeometryKind;
use super::document::Geometry;
use antumbra_scene::{Material, MaterialKey, Scene};
use std::collections::HashMap;

/// The materials that have been added.
#[derive(Default)]
pub(super) struct Materials(HashMap<(Option<&'static str>, GeometryKind), MaterialKey>);

/// Types of objects and their linear colours. "Building" matches "BuildingPart", too.
const TYPES: [(&str, [f32; 3]); 13] = [
    ("Bridge", [0.42, 0.40, 0.38]),
    ("Building", [0.72, 0.64, 0.55]),
    ("CityFurniture", [0.25, 0.27, 0.30]),
    ("GenericCityObject", [0.50, 0.50, 0.50]),
    ("LandUse", [0.38, 0.42, 0.25]),
    ("OtherConstruction", [0.50, 0.47, 0.43]),
    ("PlantCover", [0.12, 0.27, 0.08]),
    ("Railway", [0.20, 0.17, 0.15]),
    ("Road", [0.16, 0.16, 0.17]),
    ("SolitaryVegetationObject", [0.10, 0.25, 0.07]),
    ("TINRelief", [0.33, 0.36, 0.22]),
    ("Tunnel", [0.30, 0.30, 0.30]),
    ("Water", [0.08, 0.20, 0.33]),
];

/// A factor that leaves an object's colour unchanged, 255 for 1.
pub(super) const UNTINTED: [u8; 4] = [255; 4];

impl Materials {
    /// The material of all objects of a type. Only solids have invisible back faces.
    pub(super) fn material(
        &mut self,
        scene: &mut Scene,
        kind: &str,
        geometry: GeometryKind,
    ) -> MaterialKey {
        let known = TYPES.iter().find(|(name, _)| kind.starts_with(name));
        let name = known.map(|(name, _)| *name);
        *self.0.entry((name, geometry)).or_insert_with(|| {
            let [r, g, b] = known.map_or([0.5; 3], |(_, colour)| *colour);
            scene.add_material(Material {
                name: name.unwrap_or("other").to_owned(),
                base_colour: [r, g, b, 1.0],
                double_sided: geometry == GeometryKind::Surfaces,
                ..Material::default()
            })
        })
    }
}

/// The factors on an object's colour, one for each entry of a geometry's semantics.
pub(super) fn tints(geometry: &Geometry<'_>) -> Vec<[u8; 4]> {
    let semantics = geometry.semantics.iter();
    let surfaces = semantics.flat_map(|semantics| &semantics.surfaces);
    surfaces.map(|surface| tint(&surface.kind)).collect()
}

/// The factor for a surface with this entry of the semantics.
pub(super) fn tint_of(tints: &[[u8; 4]], entry: Option<usize>) -> [u8; 4] {
    let tint = entry.and_then(|entry| tints.get(entry));
    tint.copied().unwrap_or(UNTINTED)
}

/// The factor on an object's colour for a surface of this type, 255 for 1.
fn tint(kind: &str) -> [u8; 4] {
    match kind {
        "RoofSurface" => [170, 80, 62, 255],
        "GroundSurface" | "OuterFloorSurface" | "FloorSurface" => [110, 115, 120, 255],
        "Window" => [70, 100, 140, 255],
        "Door" => [95, 65, 45, 255],
        _ => UNTINTED,
    }
}
