//! Writes the new vertices of a mesh that deforms over the old ones, and those of its box.

use antumbra_cull::{Gpu, IndexRange, MeshRanges, NewShape};
use antumbra_scene::{Geometry, Mesh};

use super::{MeshArenas, attributes, box_margin, widened};
use crate::arena::Upload;

impl MeshArenas {
    /// Rewrites the vertices of a mesh that lies in `ranges`. Everything appended must have been flushed.
    pub fn rewrite(
        &mut self,
        gpu: &Gpu,
        mesh: &Mesh,
        ranges: &MeshRanges,
        upload: &mut Upload<'_>,
    ) -> Option<NewShape> {
        let (full, level) = (mesh.full()?, ranges.levels.first()?);
        let bounds = mesh.bounds()?;
        let box_margin = box_margin(&bounds);
        self.rewrite_vertices(gpu, full, level, upload);
        let boxed = Geometry::from_box(&widened(&bounds, box_margin));
        self.rewrite_vertices(gpu, &boxed, &ranges.boxed, upload);
        Some(NewShape { bounds, box_margin })
    }

    /// Elements of positions that fit; a buffer with another number is another buffer.
    pub fn vertex_capacity(&self) -> u64 {
        self.positions.capacity()
    }

    fn rewrite_vertices(
        &mut self,
        gpu: &Gpu,
        geometry: &Geometry,
        range: &IndexRange,
        upload: &mut Upload<'_>,
    ) {
        if let Ok(first) = u64::try_from(range.base_vertex) {
            let positions = &geometry.positions;
            self.positions.write_by(gpu, upload, first, positions);
            let attributes = attributes(geometry);
            self.attributes.write_by(gpu, upload, first, &attributes);
        }
    }
}
