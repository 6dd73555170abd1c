//! The boxes of the parts of all meshes, one after the other, as the device tests them.

use antumbra_scene::{PartBox, PartBoxes};
use bytemuck::{Pod, Zeroable};
use glam::BVec3;

/// A part's box, 8 bytes. Mirrors `shared/part_box.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Pod, Zeroable)]
pub struct GpuPartBox {
    /// Ten bits for each axis: where it begins. The upper two: the lower bits of how many parts follow in the mesh.
    low: u32,
    /// Where it ends, and the upper bits of that number.
    high: u32,
}

impl GpuPartBox {
    /// The most boxes of a mesh.
    pub const MOST: usize = 16;

    /// A box from one step of each axis to another, which this many boxes of the same mesh follow.
    pub(crate) fn new(low: [u16; 3], high: [u16; 3], following: u32) -> Self {
        let pack = |[x, y, z]: [u16; 3]| u32::from(x) | u32::from(y) << 10 | u32::from(z) << 20;
        Self {
            low: pack(low) | (following & 3) << 30,
            high: pack(high) | following >> 2 << 30,
        }
    }

    /// Those of a mesh, at most [`Self::MOST`].
    fn of(boxes: &[PartBox]) -> impl Iterator<Item = Self> + '_ {
        let following = (0..boxes.len() as u32).rev();
        boxes
            .iter()
            .zip(following)
            .map(|(part, following)| Self::new(part.low(), part.high(), following))
    }
}

/// The boxes of a mesh's parts in a [`PartTable`].
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct MeshParts {
    /// Where they begin; 0: there are none.
    pub first: u32,
    /// [`PartBoxes::flat`].
    pub flat: BVec3,
}

/// The boxes of the parts of all meshes, and where those of each mesh begin.
#[derive(Debug, Clone, Default)]
pub(super) struct PartTable {
    /// By mesh.
    meshes: Vec<MeshParts>,
    boxes: Vec<GpuPartBox>,
}

/// So many boxes can be told apart: bits 8 and up of a record's traits hold the number of the first of a mesh.
const MOST_BOXES: usize = 1 << 24;

impl PartTable {
    pub fn reserve(&mut self, meshes: usize) {
        self.meshes.reserve(meshes);
    }

    /// Adds the next mesh. It is without parts where they are too many, or where there is no room for them.
    pub fn add(&mut self, parts: &PartBoxes) {
        let flat = parts.flat;
        let first = self.place(&parts.boxes);
        self.meshes.push(MeshParts { first, flat });
    }

    fn place(&mut self, boxes: &[PartBox]) -> u32 {
        if boxes.is_empty() || boxes.len() > GpuPartBox::MOST {
            return 0;
        }
        if self.boxes.is_empty() {
            // 0 stands for none.
            self.boxes.push(GpuPartBox::default());
        }
        let first = self.boxes.len();
        if first + boxes.len() > MOST_BOXES {
            return 0;
        }
        self.boxes.extend(GpuPartBox::of(boxes));
        first as u32
    }

    pub fn of_mesh(&self, mesh: usize) -> MeshParts {
        self.meshes.get(mesh).copied().unwrap_or_default()
    }

    pub fn boxes(&self) -> &[GpuPartBox] {
        &self.boxes
    }
}
