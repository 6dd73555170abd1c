//! Meshes with new vertices: they are written over the old ones, so that draws and slots stay as they are.

use antumbra_cull::SceneTable;
use antumbra_scene::{MeshKey, Scene};

use super::GpuScene;
use crate::arena::Upload;

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
            let shape = self.arenas.rewrite(&self.gpu, mesh, ranges, upload);
            if let Some(shape) = shape {
                table.reshape(*number, shape);
            }
            self.rewritten.insert(*key);
        }
    }
}
