//! Chairs, armchairs and sofas.

use crate::city::city_builder::Prefab;
use crate::city::materials::MaterialKind;
use crate::solid::Solid;

pub(in crate::city) const CHAIR: Prefab = Prefab {
    name: "chair",
    material: MaterialKind::Wood,
    make: chair,
};
pub(in crate::city) const SWIVEL_CHAIR: Prefab = Prefab {
    name: "swivel chair",
    material: MaterialKind::Black,
    make: swivel_chair,
};
pub(in crate::city) const ARMCHAIR: Prefab = Prefab {
    name: "armchair",
    material: MaterialKind::Red,
    make: || upholstered(0.9, 1),
};
pub(in crate::city) const SOFA: Prefab = Prefab {
    name: "sofa",
    material: MaterialKind::Blue,
    make: || upholstered(2.1, 3),
};

fn chair() -> Solid {
    let mut solid = Solid::default();
    solid.rounded_box([-0.22, 0.43, -0.21], [0.22, 0.47, 0.23], 0.015, 2);
    for x in [-0.19, 0.19] {
        let leg = [[0.435, 0.0], [0.435, 0.022], [0.06, 0.013], [0.0, 0.015]];
        solid.revolve_upright(
            [x, 0.0, 0.19],
            &[leg[0], leg[1], leg[2], leg[3], [0.0, 0.0]],
            8,
        );
        solid.bar([x, 0.0, -0.22], [x, 0.5, -0.19], 0.017, 8);
        solid.bar([x, 0.46, -0.19], [x, 0.94, -0.26], 0.016, 8);
    }
    for (y, z) in [(0.6, -0.215), (0.73, -0.235), (0.87, -0.255)] {
        solid.rounded_box([-0.2, y, z], [0.2, y + 0.06, z + 0.016], 0.007, 1);
    }
    solid
}

fn swivel_chair() -> Solid {
    let mut solid = Solid::default();
    solid.rounded_box([-0.24, 0.44, -0.22], [0.24, 0.52, 0.24], 0.035, 2);
    solid.rounded_box([-0.21, 0.62, -0.27], [0.21, 1.05, -0.21], 0.028, 2);
    solid.bar([0.0, 0.45, -0.15], [0.0, 0.8, -0.25], 0.02, 8);
    solid.post([0.0, 0.1, 0.0], 0.028, 0.35, 14);
    for arm in 0..5 {
        let (sin, cos) = (f64::from(arm) * 72.0_f64).to_radians().sin_cos();
        let end = [0.29 * cos, 0.075, 0.29 * sin];
        solid.bar([0.0, 0.12, 0.0], end, 0.016, 8);
        solid.post([end[0], 0.0, end[2]], 0.024, 0.06, 8);
    }
    solid
}

/// A seat with arms and a row of cushions.
fn upholstered(wide: f64, cushions: usize) -> Solid {
    let mut solid = Solid::default();
    let half = 0.5 * wide;
    for x in [-half + 0.08, half - 0.08] {
        for z in [-0.36, 0.36] {
            solid.post([x, 0.0, z], 0.022, 0.11, 8);
        }
    }
    solid.rounded_box([-half, 0.1, -0.42], [half, 0.3, 0.42], 0.03, 1);
    solid.rounded_box(
        [-half + 0.02, 0.2, -0.44],
        [half - 0.02, 0.82, -0.24],
        0.07,
        2,
    );
    for x in [-half, half - 0.18] {
        solid.rounded_box([x, 0.2, -0.4], [x + 0.18, 0.6, 0.43], 0.07, 2);
    }
    let each = (wide - 0.34) / cushions as f64;
    for i in 0..cushions {
        let x = -half + 0.17 + each * i as f64;
        solid.rounded_box(
            [x + 0.005, 0.28, -0.27],
            [x + each - 0.005, 0.45, 0.41],
            0.05,
            2,
        );
        solid.rounded_box(
            [x + 0.015, 0.43, -0.28],
            [x + each - 0.015, 0.86, -0.14],
            0.06,
            2,
        );
    }
    solid
}
