//! Materials of the engine and lights of the workshop.

use antumbra_scene::{Light, Material};

/// A material, one for each kind of part.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum MaterialKind {
    FanBlade,
    Spinner,
    Composite,
    OutletVane,
    CompressorBlade,
    CompressorVane,
    TurbineBlade,
    TurbineVane,
    Disc,
    Shaft,
    Bearing,
    Can,
    Nozzle,
    FrontCasing,
    CoreCasing,
    HotCasing,
    CutEdge,
    Bolt,
    Steel,
    Copper,
    Hose,
    Clamp,
    Bracket,
    Gearbox,
    Electronics,
    Liner,
}

impl MaterialKind {
    /// The material: name, colour, metallic and roughness.
    pub fn material(self) -> Material {
        let (name, [r, g, b], [metallic, roughness]) = match self {
            Self::FanBlade => ("titanium, polished", [0.52, 0.55, 0.60], [1.0, 0.2]),
            Self::Spinner => ("white lacquer", [0.80, 0.80, 0.78], [0.0, 0.4]),
            Self::Composite => ("carbon composite", [0.10, 0.11, 0.13], [0.0, 0.6]),
            Self::OutletVane => ("aluminium", [0.66, 0.68, 0.70], [1.0, 0.5]),
            Self::CompressorBlade => ("titanium", [0.45, 0.47, 0.52], [1.0, 0.4]),
            Self::CompressorVane => ("steel, brushed", [0.34, 0.38, 0.42], [1.0, 0.5]),
            Self::TurbineBlade => ("nickel alloy", [0.58, 0.46, 0.30], [1.0, 0.4]),
            Self::TurbineVane => ("nickel alloy, coated", [0.70, 0.63, 0.48], [0.6, 0.6]),
            Self::Disc => ("forged steel", [0.30, 0.31, 0.34], [1.0, 0.6]),
            Self::Shaft => ("ground steel", [0.55, 0.56, 0.58], [1.0, 0.2]),
            Self::Bearing => ("chrome steel", [0.78, 0.80, 0.82], [1.0, 0.1]),
            Self::Can => ("heat-tinted alloy", [0.50, 0.34, 0.24], [0.9, 0.5]),
            Self::Nozzle => ("inconel", [0.36, 0.31, 0.28], [1.0, 0.4]),
            Self::FrontCasing => ("magnesium casting", [0.40, 0.44, 0.40], [0.3, 0.6]),
            Self::CoreCasing => ("steel casing", [0.42, 0.43, 0.46], [1.0, 0.4]),
            Self::HotCasing => ("heat-tinted steel", [0.44, 0.38, 0.34], [1.0, 0.5]),
            Self::CutEdge => ("red lacquer", [0.62, 0.07, 0.05], [0.0, 0.4]),
            Self::Bolt => ("cadmium plate", [0.72, 0.62, 0.34], [1.0, 0.4]),
            Self::Steel => ("stainless steel", [0.62, 0.63, 0.66], [1.0, 0.2]),
            Self::Copper => ("copper", [0.72, 0.40, 0.24], [1.0, 0.2]),
            Self::Hose => ("black hose", [0.05, 0.05, 0.06], [0.0, 0.6]),
            Self::Clamp => ("zinc plate", [0.56, 0.60, 0.66], [1.0, 0.4]),
            Self::Bracket => ("anodised aluminium", [0.24, 0.40, 0.46], [0.8, 0.5]),
            Self::Gearbox => ("cast aluminium", [0.50, 0.50, 0.47], [0.8, 0.6]),
            Self::Electronics => ("blue lacquer", [0.08, 0.16, 0.34], [0.0, 0.4]),
            Self::Liner => ("perforated liner", [0.48, 0.52, 0.50], [0.7, 0.6]),
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

/// A light of the workshop.
pub(super) struct Lamp {
    pub name: &'static str,
    /// Position in metres.
    pub position: [f64; 3],
    pub light: Light,
}

/// Four lights of the workshop: two at the ceiling on one side, one at the ceiling on the other side, and one on a low stand.
pub(super) fn lamps() -> [Lamp; 4] {
    let (warm, cold) = ([1.0, 0.94, 0.86], [0.88, 0.94, 1.0]);
    [
        ("ceiling lamp, front", [-3.2, 3.2, 3.0], cold, 1600.0),
        ("ceiling lamp, rear", [3.2, 3.2, 2.6], cold, 1400.0),
        ("ceiling lamp, far side", [0.4, 3.4, -3.4], warm, 1500.0),
        ("lamp on a stand", [-3.4, -0.6, -2.8], warm, 1100.0),
    ]
    .map(|(name, position, colour, intensity)| Lamp {
        name,
        position,
        light: Light::Point {
            colour,
            intensity,
            range: None,
        },
    })
}
