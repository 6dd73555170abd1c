//! Meshes with new vertices: they are written over the old ones, so that draws and slots stay as they are.

use antumbra_cull::SceneTable;
use antumbra_scene::{MeshKey, Scene};

use super::{GpuScene, Upload};
use crate::mesh::VertexUpload;

impl GpuScene {
    /// Takes over new vertices.
    pub(super) fn deform(
        &mut self,
        table: &mut SceneTable,
        scene: &Scene,
        deformed: &[MeshKey],
        upload: &mut Upload<'_>,
    ) {
        for key in deformed {
            let (Some(number), Some(mesh)) = (self.mesh_index.get(*key), scene.mesh(*key)) else {
                continue;
            };
            let Some(ranges) = table.mesh(*number) else {
                continue;
            };
            let upload = match upload {
                Upload::AtOnce => VertexUpload::AtOnce(&self.gpu),
                Upload::Recorded { encoder, belt } => VertexUpload::Recorded { encoder, belt },
            };
            if let Some(shape) = self.arenas.rewrite(mesh, ranges, upload) {
                table.reshape(*number, shape);
            }
        }
    }

    /// The meshes on the device that deform.
    pub(super) fn deforming(&self, scene: &Scene) -> Vec<MeshKey> {
        let known = self.mesh_index.keys();
        known.filter(|mesh| scene.deforms(*mesh)).collect()
    }
}
