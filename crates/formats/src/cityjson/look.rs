//! Colours, since files seldom have any: a material a type of object, and on it the tint of a surface that is known to be a roof
//! or a door.

use antumbra_scene::{Material, MaterialKey, Scene};
use std::collections::HashMap;

/// The materials made so far.
#[derive(Default)]
pub(super) struct Looks(HashMap<(Option<&'static str>, bool), MaterialKey>);

/// Types of objects and their linear colours. "Building" counts for "BuildingPart", too.
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

/// What is multiplied with an object's colour, of 255.
pub(super) const UNTINTED: [u8; 4] = [255; 4];

impl Looks {
    /// The material of all objects of a type. Only solids have a back that is never seen.
    pub(super) fn material(
        &mut self,
        scene: &mut Scene,
        kind: &str,
        is_solid: bool,
    ) -> MaterialKey {
        let known = TYPES.iter().find(|(name, _)| kind.starts_with(name));
        let name = known.map(|(name, _)| *name);
        *self.0.entry((name, is_solid)).or_insert_with(|| {
            let [r, g, b] = known.map_or([0.5; 3], |(_, colour)| *colour);
            scene.add_material(Material {
                name: name.unwrap_or("other").to_owned(),
                base_colour: [r, g, b, 1.0],
                double_sided: !is_solid,
                ..Material::default()
            })
        })
    }
}

/// The tint of a surface.
pub(super) fn tint(kind: &str) -> [u8; 4] {
    match kind {
        "RoofSurface" => [170, 80, 62, 255],
        "GroundSurface" | "OuterFloorSurface" | "FloorSurface" => [110, 115, 120, 255],
        "Window" => [70, 100, 140, 255],
        "Door" => [95, 65, 45, 255],
        _ => UNTINTED,
    }
}
