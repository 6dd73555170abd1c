//! An instance as the GPU judges it: a box along axes of its own, 64 bytes.

use antumbra_scene::Aabb;
use antumbra_shaders::assert_layout;
use bytemuck::{Pod, Zeroable};
use glam::{DAffine3, DVec3, Vec3};

use crate::entities::OrientedBox;
use crate::split_point::SplitPoint;

/// What an instance is in visibility tests.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Part {
    /// It hides others, and may be hidden: an opaque object.
    #[default]
    Both,
    /// It may be hidden and hides nothing: a transparent object. In two phases it waits for the test.
    Occludee,
    /// It hides others and is drawn whenever it is in the view: a terrain, the walls of a level.
    Occluder,
    /// It hides nothing, and is drawn whenever it is in the view.
    Exempt,
}

/// An instance as the GPU judges it. Mirrors `JudgedInstance` of `shared/judged.wgsl`, for hosts that keep such a buffer themselves.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default, Pod, Zeroable)]
pub struct JudgedInstance {
    /// The x coordinates of the three half edges, in metres, and the high part of the centre's x.
    pub row_x: [f32; 4],
    /// The y coordinates, likewise.
    pub row_y: [f32; 4],
    /// The z coordinates, likewise.
    pub row_z: [f32; 4],
    /// The low parts of the centre: what is left of each f64 coordinate after its high part, the nearest f32.
    pub centre_low: [f32; 3],
    /// [`Self::HIDES`], [`Self::TESTED`] and [`Self::LIVE`], bits 3 to 7 zero (the contents may fill the box), and from bit 8 on a generation: another one says that the index has a new owner, of which nothing is known. (Where slots are tested, they say instead where the boxes of its parts begin: `ResidentScene`.)
    pub traits: u32,
}

assert_layout!(JudgedInstance, "judge_first", "JudgedInstance", { row_x, row_y, row_z, centre_low, traits });

impl JudgedInstance {
    /// It hides others.
    pub const HIDES: u32 = 1;
    /// It may be hidden.
    pub const TESTED: u32 = 2;
    /// It is there. Without this bit the record is skipped.
    pub const LIVE: u32 = 4;
    /// How round it is: [`Self::round_bits`].
    pub(super) const ROUND: u32 = 31 << 3;
    /// The generations there are: those above begin at 0 again.
    pub const GENERATIONS: u32 = 1 << 24;

    /// The record of an instance with these bounds in its own space.
    pub fn new(bounds: &Aabb, at: &DAffine3, part: Part, generation: u32) -> Self {
        let half = bounds.half_extents();
        let edges = [
            at.matrix3.x_axis * half.x,
            at.matrix3.y_axis * half.y,
            at.matrix3.z_axis * half.z,
        ];
        let centre = at.transform_point3(bounds.centre());
        Self::of_edges(
            centre,
            edges.map(|edge| edge.as_vec3()),
            Self::traits(part, generation),
        )
    }

    /// Bits 3 to 7 of the traits, as `shared/judged_instance.wgsl` has them: how round it is, in steps of a fortieth, rounded up; 0 for what gains nothing by it.
    pub(super) fn round_bits(roundness: f32) -> u32 {
        let steps = ((roundness - 1.0).max(0.0) * 40.0).ceil();
        // Written so that what is not a number gains nothing.
        if steps < 26.0 {
            (steps as u32 + 1) << 3
        } else {
            0
        }
    }

    fn of_edges(centre: DVec3, [x, y, z]: [Vec3; 3], traits: u32) -> Self {
        let SplitPoint { high, low } = SplitPoint::new(centre);
        let row = |axis: usize| [x[axis], y[axis], z[axis], high[axis]];
        Self {
            row_x: row(0),
            row_y: row(1),
            row_z: row(2),
            centre_low: low,
            traits,
        }
    }

    /// The record of a box of ours.
    pub(crate) fn oriented(what: &OrientedBox, part: Part) -> Self {
        let edges = [0, 1, 2].map(|axis| what.axes[axis] * what.half[axis]);
        let round = Self::round_bits(what.roundness);
        Self::of_edges(what.centre, edges, Self::traits(part, what.parts) | round)
    }

    /// The traits of a live instance.
    pub const fn traits(part: Part, generation: u32) -> u32 {
        let part = match part {
            Part::Both => Self::HIDES | Self::TESTED,
            Part::Occludee => Self::TESTED,
            Part::Occluder => Self::HIDES,
            Part::Exempt => 0,
        };
        part | Self::LIVE | (generation % Self::GENERATIONS) << 8
    }

    /// Bounds along the world's axes, with the rounding of the record.
    pub fn bounds(&self) -> Aabb {
        let rows = [self.row_x, self.row_y, self.row_z];
        let half =
            rows.map(|[x, y, z, _]| f64::from(x.abs()) + f64::from(y.abs()) + f64::from(z.abs()));
        let high = DVec3::from_array(rows.map(|row| f64::from(row[3])));
        let low = DVec3::from_array(self.centre_low.map(f64::from));
        // A coordinate of two floats has about 48 bits.
        let rounding = high.abs() * 1e-14;
        Aabb::from_centre(
            high + low,
            DVec3::from_array(half) * (1.0 + 1e-6) + rounding,
        )
    }

    /// Whether f32 can hold it.
    pub(super) fn fits(&self) -> bool {
        let rows = [self.row_x, self.row_y, self.row_z];
        rows.iter().flatten().all(|number| number.is_finite())
    }
}
