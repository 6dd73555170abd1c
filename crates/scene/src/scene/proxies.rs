//! Proxies for all meshes of a scene.

use rayon::prelude::*;
use slotmap::SecondaryMap;

use super::Scene;
use super::transforms::BOUNDS_DIRTY;
use crate::keys::EntityKey;
use crate::mesh::Mesh;
use crate::simplify::ProxyOptions;

impl Scene {
    /// Computes a proxy for every mesh without one that does not deform, in parallel. Meshes keep their keys. A box grows where a proxy
    /// reaches beyond its mesh, since an eye inside a proxy must count as inside the box.
    pub fn ensure_proxies(&mut self, options: &ProxyOptions) {
        let deforming = &self.deforming;
        let fixed = (self.meshes.iter_mut()).filter(|(key, _)| !deforming.contains(*key));
        let mut meshes: Vec<&mut Mesh> = fixed.map(|(_, mesh)| mesh).collect();
        meshes.par_iter_mut().for_each(|mesh| {
            mesh.ensure_proxy(options);
        });
        let mut grown = SecondaryMap::new();
        for (key, mesh) in &self.meshes {
            if let Some(bounds) = mesh.bounds()
                && self.mesh_bounds.get(key) != Some(&bounds)
            {
                self.mesh_bounds.insert(key, bounds);
                grown.insert(key, ());
            }
        }
        let placed = self.drawables.iter();
        let placed = placed.filter(|(_, drawable)| grown.contains_key(drawable.mesh));
        let placed: Vec<EntityKey> = placed.map(|(entity, _)| entity).collect();
        for entity in placed {
            self.mark_dirty(entity, BOUNDS_DIRTY);
        }
    }
}
