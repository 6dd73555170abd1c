//! Materials and sun of the city.

use antumbra_scene::{Light, Material};
use glam::{DAffine3, DQuat};

/// A material.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum MaterialKind {
    Cream,
    Ochre,
    Brick,
    White,
    Tile,
    Wood,
    Steel,
    Red,
    Blue,
    Asphalt,
    Stone,
    Green,
    Black,
    RedLacquer,
    SilverLacquer,
}

impl MaterialKind {
    /// The material: name, colour, metallic and roughness.
    pub fn material(self) -> Material {
        let (name, [r, g, b], [metallic, roughness]) = match self {
            Self::Cream => ("cream plaster", [0.72, 0.62, 0.44], [0.0, 0.9]),
            Self::Ochre => ("ochre plaster", [0.62, 0.40, 0.18], [0.0, 0.9]),
            Self::Brick => ("brick", [0.34, 0.12, 0.08], [0.0, 0.9]),
            Self::White => ("white lacquer", [0.80, 0.80, 0.77], [0.0, 0.4]),
            Self::Tile => ("roof tile", [0.42, 0.13, 0.07], [0.0, 0.8]),
            Self::Wood => ("oak", [0.33, 0.19, 0.09], [0.0, 0.6]),
            Self::Steel => ("steel", [0.42, 0.43, 0.45], [1.0, 0.4]),
            Self::Red => ("red cloth", [0.44, 0.06, 0.07], [0.0, 1.0]),
            Self::Blue => ("blue cloth", [0.10, 0.17, 0.34], [0.0, 1.0]),
            Self::Asphalt => ("asphalt", [0.07, 0.07, 0.075], [0.0, 0.9]),
            Self::Stone => ("paving stone", [0.36, 0.35, 0.33], [0.0, 0.9]),
            Self::Green => ("foliage", [0.09, 0.22, 0.05], [0.0, 0.8]),
            Self::Black => ("rubber", [0.03, 0.03, 0.032], [0.0, 0.7]),
            Self::RedLacquer => ("red lacquer", [0.60, 0.03, 0.03], [0.0, 0.2]),
            Self::SilverLacquer => ("silver lacquer", [0.55, 0.57, 0.60], [0.7, 0.3]),
        };
        Material {
            name: name.into(),
            base_colour: [r, g, b, 1.0],
            metallic,
            roughness,
            ..Material::default()
        }
    }
}

/// The city's directional light.
pub(super) struct Sun {
    /// Its orientation.
    pub transform: DAffine3,
    pub light: Light,
}

/// The sun in the late morning.
pub(super) fn sun() -> Sun {
    let down = DQuat::from_euler(glam::EulerRot::YXZ, 0.65, -0.85, 0.0);
    let light = Light::Directional {
        colour: [1.0, 0.96, 0.88],
        illuminance: 3.0,
    };
    Sun {
        transform: DAffine3::from_quat(down),
        light,
    }
}
