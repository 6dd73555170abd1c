//! Proxies for all meshes of a scene at once.

use rayon::prelude::*;
use slotmap::SecondaryMap;

use super::Scene;
use super::dense::OWN_BOX;
use crate::keys::EntityKey;
use crate::mesh::Mesh;
use crate::simplify::ProxyOptions;

impl Scene {
    /// Gives every mesh that has none a proxy, in parallel. Meshes keep their keys; boxes grow where a proxy reaches out of its mesh, for an eye
    /// inside of a proxy must count as inside of the box.
    pub fn ensure_proxies(&mut self, options: &ProxyOptions) {
        let mut meshes: Vec<&mut Mesh> = self.meshes.values_mut().collect();
        meshes.par_iter_mut().for_each(|mesh| {
            mesh.ensure_proxy(options);
        });
        let mut grown = SecondaryMap::new();
        for (key, mesh) in &self.meshes {
            if let Some(bounds) = mesh.bounds()
                && self.mesh_boxes.get(key) != Some(&bounds)
            {
                self.mesh_boxes.insert(key, bounds);
                grown.insert(key, ());
            }
        }
        let placed = self.drawables.iter();
        let placed = placed.filter(|(_, drawable)| grown.contains_key(drawable.mesh));
        let placed: Vec<EntityKey> = placed.map(|(entity, _)| entity).collect();
        for entity in placed {
            self.ask(entity, OWN_BOX);
        }
    }
}
