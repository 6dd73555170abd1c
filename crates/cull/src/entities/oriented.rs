//! Oriented bounding boxes: the box of an entity's mesh after rotation and scale, which is tighter than its box along the world's axes.

use antumbra_scene::bounds::{round_down, round_up};
use antumbra_scene::{Aabb, PartBox};
use glam::{DAffine3, DMat3, DVec3, Vec3};

use super::part_table::MeshParts;

/// A box along axes of its own, which are at right angles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OrientedBox {
    /// The centre, in metres.
    pub centre: DVec3,
    /// Unit vectors along its edges.
    pub axes: [Vec3; 3],
    /// Half the size along each axis, in metres, with the rounding error of the mesh's f32 coordinates added.
    pub half: Vec3,
    /// What is in the box lies in the ellipsoid whose half axes are the box's times this: 1 for a sphere, [`Self::ANGULAR`] for anything.
    pub roundness: f32,
    /// The box with this part of its size, about the same centre, lies inside of the surface that is in it; 0: nothing is known of an inside.
    pub solid: f32,
    /// Where the boxes of its parts begin in [`SceneTable::part_boxes`](super::SceneTable::part_boxes); 0: it has none.
    pub parts: u32,
}

/// What is known of a mesh's shape.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MeshShape {
    pub bounds: Aabb,
    /// As [`OrientedBox::roundness`].
    pub roundness: f32,
    /// As [`OrientedBox::solid`], of `bounds`.
    pub solid: f32,
    pub parts: MeshParts,
}

impl OrientedBox {
    /// The roundness of what reaches a corner: the root of 3, rounded up.
    pub const ANGULAR: f32 = 1.733;

    /// A box along the world's axes.
    pub fn aligned(bounds: &Aabb) -> Self {
        Self {
            centre: bounds.centre(),
            axes: Vec3::AXES,
            half: Vec3::from(bounds.half_extents().to_array().map(round_up)),
            roundness: Self::ANGULAR,
            solid: 0.0,
            parts: 0,
        }
    }

    /// The box inside of the surface; `None` where nothing is known of one.
    pub fn inner(&self) -> Option<Self> {
        let half = self.half * self.solid;
        (self.solid > 0.0).then_some(Self { half, ..*self })
    }

    /// The bounds along the world's axes.
    pub fn bounds(&self) -> Aabb {
        let edges = [0, 1, 2].map(|i| (self.axes[i].abs() * self.half[i]).as_dvec3());
        Aabb::from_centre(self.centre, edges[0] + edges[1] + edges[2])
    }

    /// The box around a mesh of this shape after the transform `world`. `bounds` are the bounds along the world's axes, used where a transform shears or
    /// flattens, so that a box does not stay a box.
    pub(crate) fn new(shape: &MeshShape, world: &DAffine3, bounds: &Aabb) -> Self {
        let local = &shape.bounds;
        let DMat3 {
            x_axis,
            y_axis,
            z_axis,
        } = world.matrix3;
        let columns = [x_axis, y_axis, z_axis];
        let lengths = DVec3::from_array(columns.map(DVec3::length));
        let reach = local.min.abs().max(local.max.abs()).max_element();
        let lost = reach * lengths.max_element() * f64::from(f32::EPSILON) * 8.0;
        let units = [0, 1, 2].map(|i| columns[i] / lengths[i]);
        let cosines = [(0, 1), (1, 2), (2, 0)].map(|(i, j)| units[i].dot(units[j]).abs());
        // An axis without length gives NaN, which does not compare as less.
        if !cosines.iter().all(|cosine| *cosine < 1e-6) {
            return Self::aligned(&bounds.grown(DVec3::splat(lost)));
        }
        // The error of the angles, and the rounding to f32.
        let half = local.half_extents() * lengths;
        let slack = lost + half.max_element() * 4e-6;
        // A part's box is a step too wide on each side. The slack is lost twice: this box is wider by it than the one that steps were counted in, and the part needs as much itself.
        let step = half * (2.0 / f64::from(PartBox::STEPS));
        let holds = shape.parts.flat | step.cmpgt(DVec3::splat(slack * 2.0));
        Self {
            centre: world.transform_point3(local.centre()),
            axes: units.map(DVec3::as_vec3),
            half: (half + slack).as_vec3(),
            roundness: shape.roundness,
            // A mirrored mesh is inside out.
            solid: match world.matrix3.determinant() > 0.0 {
                true => solid_of(half, slack, f64::from(shape.solid)),
                false => 0.0,
            },
            parts: if holds.all() { shape.parts.first } else { 0 },
        }
    }
}

/// The part of a box of these half edges with the slack added that lies inside of a part of the box without it, with the slack taken off.
fn solid_of(half: DVec3, slack: f64, part: f64) -> f32 {
    let inner = (half * part - slack) / (half + slack);
    round_down(inner.min_element().max(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{BVec3, DQuat};

    fn shape(bounds: Aabb) -> MeshShape {
        MeshShape {
            bounds,
            roundness: OrientedBox::ANGULAR,
            solid: 0.75,
            parts: MeshParts {
                first: 7,
                flat: BVec3::FALSE,
            },
        }
    }

    /// The distance of a point from the centre, as a multiple of the half size; above 1 it is outside.
    fn outside(oriented: &OrientedBox, point: DVec3) -> f64 {
        let from = point - oriented.centre;
        let along =
            |i: usize| oriented.axes[i].as_dvec3().dot(from).abs() / f64::from(oriented.half[i]);
        (0..3).map(along).fold(0.0, f64::max)
    }

    #[test]
    fn it_holds_its_mesh_and_little_more() {
        let local = Aabb::new(DVec3::new(3.0, -1.0, 0.0), DVec3::new(5.0, 1.0, 0.25));
        let rotation = DQuat::from_rotation_x(0.4) * DQuat::from_rotation_z(1.1);
        let stretch = DVec3::new(2.0, 0.5, -3.0);
        let placed =
            DAffine3::from_scale_rotation_translation(stretch, rotation, DVec3::splat(1e6));
        let sheared = DAffine3::from_scale(DVec3::new(1.0, 0.1, 1.0)) * placed;
        let flat = DAffine3::from_scale(DVec3::new(1.0, 0.0, 1.0));
        for (world, tight) in [
            (placed, true),
            (sheared, false),
            (flat, false),
            (DAffine3::IDENTITY, true),
        ] {
            let bounds = local.transformed(&world);
            let oriented = OrientedBox::new(&shape(local), &world, &bounds);
            let worst = local
                .corners()
                .map(|corner| outside(&oriented, world.transform_point3(corner)));
            let worst = worst.into_iter().fold(0.0, f64::max);
            assert!(worst <= 1.0, "{world}: {worst}");
            if tight {
                assert!(worst > 0.999, "{world}: {worst}");
                let size = oriented.half.as_dvec3() * 2.0
                    / (local.max - local.min)
                    / world.matrix3.determinant().abs().cbrt();
                assert!((size.element_product() - 1.0).abs() < 1e-3, "{size}");
            }
        }
        // Rounding to f32 never makes a box smaller.
        let odd = Aabb::new(DVec3::splat(-1e6), DVec3::new(1.1, 0.1, 1e6 / 3.0));
        assert!(OrientedBox::aligned(&odd).bounds().contains_box(&odd));
        // A flat mesh gets a small thickness.
        let sheet = Aabb::new(DVec3::ZERO, DVec3::new(1.0, 1.0, 0.0));
        let oriented = OrientedBox::new(&shape(sheet), &placed, &sheet.transformed(&placed));
        assert!(oriented.half.z > 0.0 && oriented.half.z < 1e-4);
    }

    #[test]
    fn parts_are_tested_where_their_steps_are_coarser_than_what_is_lost() {
        let parts = |shape: &MeshShape, world: DAffine3| {
            OrientedBox::new(shape, &world, &shape.bounds.transformed(&world)).parts
        };
        let solid = shape(Aabb::new(-DVec3::ONE, DVec3::ONE));
        let turned = DAffine3::from_rotation_y(1.0);
        assert_eq!(parts(&solid, turned), 7);
        assert_eq!(
            parts(&solid, DAffine3::from_scale(DVec3::new(-3.0, 3.0, 3.0))),
            7
        );
        // Long ones, where a step across is less than the rounding along.
        assert_eq!(
            parts(&solid, DAffine3::from_scale(DVec3::new(1.0, 1.0, 1e4))),
            0
        );
        // Far from the mesh's own origin.
        let far = shape(Aabb::new(DVec3::splat(9999.0), DVec3::splat(10001.0)));
        assert_eq!(parts(&far, turned), 0);
        // A sheet, whose parts reach through it, and the same where they do not.
        let mut sheet = shape(Aabb::new(DVec3::ZERO, DVec3::new(1.0, 1.0, 1e-4)));
        assert_eq!(parts(&sheet, turned), 0);
        sheet.parts.flat = BVec3::new(false, false, true);
        assert_eq!(parts(&sheet, turned), 7);
        // What shears has a box along the world's axes.
        let shear = DAffine3::from_scale(DVec3::new(1.0, 0.1, 1.0))
            * turned
            * DAffine3::from_rotation_z(1.0);
        assert_eq!(parts(&solid, shear), 0);
    }
}
