//! Random cameras, boxes and what is in them, for the tests of margins.

use antumbra_scene::{Camera, Projection};
use glam::{DQuat, DVec2, DVec3, Mat4, Vec2, Vec3, Vec4};
use rand::RngExt;
use rand_pcg::Pcg32;

use super::rasteriser::{Depths, Rasteriser, Ties};
use crate::entities::OrientedBox;
use crate::view::ViewFrame;

/// The bits that rasterisers have, at least and as a rule.
pub const BITS: [u32; 2] = [4, 8];

pub fn turn(random: &mut Pcg32) -> DQuat {
    let mut number = || random.random_range(-1.0..1.0);
    let axis = DVec3::new(number(), number(), number() + 1.5).normalize();
    DQuat::from_axis_angle(axis, number() * 3.1)
}

/// A view from anywhere to anywhere: in perspective, off axis or parallel, of any size.
pub fn view(random: &mut Pcg32) -> ViewFrame {
    let size = [random.random_range(16..120), random.random_range(16..90)];
    let fov_y = random.random_range(0.3..2.0);
    let near = 0.01;
    let projection = match random.random_range(0..3) {
        0 => Projection::Perspective { fov_y, near },
        1 => Projection::OffAxis {
            fov_y,
            near,
            shift: DVec2::new(
                random.random_range(-0.6..0.6),
                random.random_range(-0.6..0.6),
            ),
        },
        _ => Projection::Orthographic {
            height: random.random_range(2.0..12.0),
            near: 0.0,
            far: 200.0,
        },
    };
    let position = DVec3::from_array([(); 3].map(|()| random.random_range(-50.0..50.0)));
    let camera = Camera::new(projection, position, turn(random));
    ViewFrame::new(camera.expect("the numbers are in range"), size, 0)
}

/// A rasteriser for a view, with either way to break ties.
pub fn rasteriser(view: &ViewFrame, bits: u32, random: &mut Pcg32) -> Rasteriser {
    Rasteriser {
        size: view.size,
        bits,
        ties: match random.random_range(0..2) {
            0 => Ties::TopLeft,
            _ => Ties::BottomRight,
        },
        depths: Depths::OfMovedCorners,
    }
}

/// A box wholly in front of the eye, from a fraction of a pixel to half the view; `None` where this one is not.
pub fn place_box(random: &mut Pcg32, view: &ViewFrame) -> Option<OrientedBox> {
    let axes = view.axes();
    let mut within = |half: f64| random.random_range(-half..half);
    let distance = 10f64.powf(0.8 + within(0.8));
    let aside = DVec2::new(within(0.9), within(0.9)) * distance;
    let metres = distance * 10f64.powf(within(1.0) - 1.6);
    let sides = DVec3::from_array([(); 3].map(|()| 10f64.powf(within(0.5))));
    let turned = turn(random);
    let made = OrientedBox {
        centre: view.camera.position
            + axes.forward * distance
            + axes.right * aside.x
            + axes.up * aside.y,
        axes: [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| (turned * axis).as_vec3()),
        half: (sides * metres).as_vec3(),
        roundness: OrientedBox::ANGULAR,
        solid: 0.0,
        parts: 0,
    };
    let nearest =
        axes.forward.dot(made.centre - view.camera.position) - f64::from(made.half.length());
    (nearest > distance * 0.1).then_some(made)
}

/// A few triangles of a mesh in this box, relative to the eye.
pub fn mesh_in(random: &mut Pcg32, view: &ViewFrame, boxed: &OrientedBox) -> Vec<[Vec3; 3]> {
    let place = |local: Vec3| {
        let from_centre = (0..3)
            .map(|axis| boxed.axes[axis].as_dvec3() * f64::from(local[axis] * boxed.half[axis]));
        (boxed.centre - view.camera.position + from_centre.sum::<DVec3>()).as_vec3()
    };
    let count = random.random_range(1..12);
    let mut corner = || {
        // Mostly on edges, where margins are tried: what lies in a corner moves as the box does.
        let mut at =
            Vec3::from_array([(); 3].map(|()| f32::from(random.random_range(0..2u8)) * 2.0 - 1.0));
        let free = match random.random_range(0..4) {
            0 => 0..3,
            axis => axis - 1..axis,
        };
        for axis in free {
            at[axis] = random.random_range(-1.0..1.0);
        }
        place(at)
    };
    (0..count).map(|_| [corner(), corner(), corner()]).collect()
}

/// `clip_position` of `shared/clip.wgsl`.
pub fn clip_position(view: &ViewFrame, relative: Vec3) -> Vec4 {
    let matrix: Mat4 = view.clip_from_relative();
    let clip = matrix * relative.extend(1.0);
    let [wide, high] = view.size.map(|side| side as f32);
    let grid = Vec2::new(wide, high) * (0.5 * (1u32 << super::SHADER_BITS) as f32);
    let at = Vec2::new(clip.x, clip.y);
    if !(clip.w > 0.0 && at.abs().cmplt(Vec2::splat(2.0 * clip.w)).all()) {
        return clip;
    }
    let snapped = (at / clip.w * grid).map(f32::round_ties_even) / grid * clip.w;
    Vec4::new(snapped.x, snapped.y, clip.z, clip.w)
}
