//! The table's meshes: where they lie, their shapes, and what these say of an entity.

use antumbra_scene::{Aabb, PartBoxes};
use glam::DAffine3;

use super::SceneTable;
use crate::entities::detail::MeshDetail;
use crate::entities::oriented::{MeshShape, OrientedBox};
use crate::entities::part_table::GpuPartBox;
use crate::entities::ranges::{IndexRange, MeshRanges, NewShape};
use crate::entities::scale::greatest_scale;

impl SceneTable {
    /// Adds a mesh and returns its index.
    pub fn add_mesh(&mut self, ranges: MeshRanges, parts: &PartBoxes) -> u32 {
        self.parts.add(parts);
        self.meshes.push(ranges);
        self.meshes.len() as u32 - 1
    }

    /// Where a mesh's geometries lie; `None` for a mesh that does not exist.
    pub fn mesh(&self, mesh: u32) -> Option<&MeshRanges> {
        self.meshes.get(mesh as usize)
    }

    /// Takes what else is true of a mesh with new vertices, which lie where the old ones did. It must have no parts. Its entities' boxes follow with
    /// [`Self::move_to`].
    pub fn reshape(&mut self, mesh: u32, shape: NewShape) {
        if let Some(ranges) = self.meshes.get_mut(mesh as usize) {
            (ranges.bounds, ranges.box_margin) = (shape.bounds, shape.box_margin);
            (ranges.roundness, ranges.solid) = (OrientedBox::ANGULAR, 0.0);
        }
    }

    /// The boxes of the parts of all meshes, as the device tests them.
    pub fn part_boxes(&self) -> &[GpuPartBox] {
        self.parts.boxes()
    }

    /// Where a mesh's geometry lies; an empty range for a mesh that does not exist.
    pub fn range(&self, mesh: u32, detail: MeshDetail) -> IndexRange {
        let ranges = self.meshes.get(mesh as usize);
        ranges
            .map(|ranges| ranges.range(detail))
            .unwrap_or_default()
    }

    /// By how many metres, at most, a mesh's proxy deviates in the world.
    pub(super) fn deviates(&self, mesh: u32, world: &DAffine3) -> f32 {
        let own = self
            .meshes
            .get(mesh as usize)
            .map_or(0.0, |mesh| mesh.deviation);
        (own * greatest_scale(world)) as f32
    }

    pub(super) fn orient(&self, mesh: u32, bounds: Aabb, world: &DAffine3) -> OrientedBox {
        let at = mesh as usize;
        match self.meshes.get(at) {
            Some(mesh) if !mesh.bounds.is_empty() => {
                let shape = MeshShape {
                    bounds: mesh.bounds,
                    roundness: mesh.roundness,
                    solid: mesh.solid,
                    parts: self.parts.of_mesh(at),
                };
                OrientedBox::new(&shape, world, &bounds)
            }
            _ => OrientedBox::aligned(&bounds),
        }
    }
}
