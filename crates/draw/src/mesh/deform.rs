//! Writes the new vertices of a mesh that deforms over the old ones, and those of its box.

use antumbra_cull::{Gpu, IndexRange, MeshRanges, NewShape};
use antumbra_scene::{Geometry, Mesh};

use super::{MeshArenas, attributes, box_margin, widened};
use crate::arena::Arena;

/// How vertices reach the device.
pub enum VertexUpload<'a> {
    /// Before everything that is submitted from now on.
    AtOnce(&'a Gpu),
    /// By an encoder.
    Recorded {
        /// The encoder.
        encoder: &'a mut wgpu::CommandEncoder,
        /// Its staging memory.
        belt: &'a mut wgpu::util::StagingBelt,
    },
}

impl VertexUpload<'_> {
    fn write<T: bytemuck::Pod>(&mut self, arena: &mut Arena<T>, first: u64, elements: &[T]) {
        match self {
            Self::AtOnce(gpu) => arena.write(gpu, first, elements),
            Self::Recorded { encoder, belt } => arena.write_in(encoder, belt, first, elements),
        }
    }
}

impl MeshArenas {
    /// Rewrites the vertices of a mesh that lies in `ranges`. Everything appended must have been flushed.
    pub fn rewrite(
        &mut self,
        mesh: &Mesh,
        ranges: &MeshRanges,
        mut upload: VertexUpload<'_>,
    ) -> Option<NewShape> {
        let (full, level) = (mesh.full()?, ranges.levels.first()?);
        let bounds = mesh.bounds()?;
        let box_margin = box_margin(&bounds);
        self.rewrite_vertices(full, level, &mut upload);
        let boxed = Geometry::from_box(&widened(&bounds, box_margin));
        self.rewrite_vertices(&boxed, &ranges.boxed, &mut upload);
        Some(NewShape { bounds, box_margin })
    }

    /// Elements of positions that fit; a buffer with another number is another buffer.
    pub fn vertex_capacity(&self) -> u64 {
        self.positions.capacity()
    }

    fn rewrite_vertices(
        &mut self,
        geometry: &Geometry,
        range: &IndexRange,
        upload: &mut VertexUpload<'_>,
    ) {
        if let Ok(first) = u64::try_from(range.base_vertex) {
            upload.write(&mut self.positions, first, &geometry.positions);
            upload.write(&mut self.attributes, first, &attributes(geometry));
        }
    }
}
