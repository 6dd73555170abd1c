//! Room for entities that will be added. Arrays that grow step by step leave the memory of each step behind.

use super::Scene;

impl Scene {
    /// Makes room for `entities` more entities, each with a name and a mesh of its own, so that they are added without growing step by step.
    pub fn reserve(&mut self, entities: usize) {
        let all = self.len() + entities;
        self.tree.nodes.reserve(entities);
        self.transforms.reserve(entities);
        self.names.set_capacity(all);
        self.drawables.set_capacity(all);
        self.meshes.reserve(entities);
        self.mesh_bounds.set_capacity(self.meshes.len() + entities);
    }
}
