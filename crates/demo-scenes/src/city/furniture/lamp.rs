//! Indoor lamps.

use crate::city::city_builder::Prefab;
use crate::city::materials::MaterialKind;
use crate::city::shapes::along_y;
use crate::solid::Solid;

pub(in crate::city) const FLOOR_LAMP: Prefab = Prefab {
    name: "floor lamp",
    material: MaterialKind::Cream,
    make: standing,
};
/// Hangs from y = 0.
pub(in crate::city) const PENDANT: Prefab = Prefab {
    name: "pendant lamp",
    material: MaterialKind::RedLacquer,
    make: pendant,
};

fn standing() -> Solid {
    // Radius of the foot, height of the stem, radius and height of the shade.
    let ([foot, stem], [shade, high]) = ([0.15, 1.25], [0.2, 0.3]);
    let mut solid = Solid::default();
    let profile = [
        [stem + high * 0.7, 0.0],
        [stem + high * 0.7, 0.008],
        [0.08 * stem, 0.012],
        [0.05 * stem, foot * 0.4],
        [0.025 * stem, foot * 0.9],
        [0.02 * stem, foot],
        [0.0, foot],
        [0.0, 0.0],
    ];
    solid.revolve_upright([0.0; 3], &profile, 14);
    shell(&mut solid, [stem, stem + high], [shade, shade * 0.6]);
    bulb(&mut solid, stem + 0.45 * high);
    solid
}

fn pendant() -> Solid {
    let mut solid = Solid::default();
    solid.post([0.0, -0.03, 0.0], 0.05, 0.032, 16);
    solid.post([0.0, -0.75, 0.0], 0.005, 0.73, 6);
    let profile = [
        [-0.72, 0.0],
        [-0.72, 0.03],
        [-0.76, 0.05],
        [-0.8, 0.12],
        [-0.88, 0.2],
        [-0.93, 0.22],
        [-0.93, 0.21],
        [-0.88, 0.19],
        [-0.81, 0.11],
        [-0.78, 0.04],
        [-0.78, 0.0],
    ];
    solid.revolve_upright([0.0; 3], &profile, 20);
    bulb(&mut solid, -0.85);
    solid
}

/// A thin shade, open at the top and the bottom.
fn shell(solid: &mut Solid, y: [f64; 2], radius: [f64; 2]) {
    let mut ring = Solid::default();
    let thick = 0.004;
    let profile = [
        [y[0], radius[0] - thick],
        [y[1], radius[1] - thick],
        [y[1], radius[1]],
        [y[0], radius[0]],
    ];
    // Upright, x is the height: the profile is counter-clockwise with the height to the right.
    ring.revolve_closed(&profile, 20);
    solid.add(&ring, along_y([0.0; 3]));
    for spoke in 0..3 {
        let (sin, cos) = (f64::from(spoke) * 120.0_f64).to_radians().sin_cos();
        let high = y[0] + 0.94 * (y[1] - y[0]);
        let rim = radius[0] + 0.94 * (radius[1] - radius[0]) - 0.002;
        solid.bar(
            [0.0, y[0] + 0.66 * (y[1] - y[0]), 0.0],
            [rim * cos, high, rim * sin],
            0.003,
            5,
        );
    }
}

fn bulb(solid: &mut Solid, y: f64) {
    let profile = [
        [0.05, 0.0],
        [0.05, 0.015],
        [0.03, 0.018],
        [0.0, 0.03],
        [-0.02, 0.033],
        [-0.04, 0.026],
        [-0.052, 0.012],
        [-0.055, 0.0],
    ];
    solid.revolve_upright([0.0, y, 0.0], &profile, 10);
}
