//! Meshes whose vertices move while the scene is shown.
//!
//! What is true of such a mesh's shape is true of one pose alone: it has no proxy and no coarser level, and its box is found anew with every change of its vertices.

use std::collections::BTreeSet;

use super::Scene;
use super::transforms::BOUNDS_DIRTY;
use crate::error::SceneError;
use crate::keys::{EntityKey, MeshKey};
use crate::mesh::{Geometry, Mesh};

/// The meshes that deform, and the changes of their vertices.
#[derive(Clone, Debug, Default)]
pub(super) struct Deforming {
    /// The entities that have such a mesh.
    users: slotmap::SparseSecondaryMap<MeshKey, BTreeSet<EntityKey>>,
    /// The meshes with new vertices since the last update.
    changed: BTreeSet<MeshKey>,
    /// The entities with a mesh that got new vertices since the last update, and deforms no longer.
    stopped: Vec<EntityKey>,
}

impl Deforming {
    /// Whether a mesh deforms.
    pub(super) fn contains(&self, mesh: MeshKey) -> bool {
        self.users.contains_key(mesh)
    }

    /// Records that an entity has got a mesh.
    pub(super) fn used(&mut self, mesh: MeshKey, entity: EntityKey) {
        if let Some(users) = self.users.get_mut(mesh) {
            users.insert(entity);
        }
    }

    /// Records that an entity has a mesh no longer.
    pub(super) fn unused(&mut self, mesh: MeshKey, entity: EntityKey) {
        if let Some(users) = self.users.get_mut(mesh) {
            users.remove(&entity);
        }
    }
}

impl Scene {
    /// Adds a mesh whose vertices [`Self::set_vertices`] may replace. It must have one level and no proxy.
    ///
    /// # Errors
    /// As for [`Self::add_mesh`], and [`SceneError::BadMesh`] for further levels and proxies.
    pub fn add_deforming_mesh(&mut self, mesh: Mesh) -> Result<MeshKey, SceneError> {
        if mesh.levels.len() > 1 || mesh.proxy.is_some() {
            return Err(SceneError::BadMesh {
                mesh: mesh.name,
                part: "levels".into(),
                problem: "a mesh that deforms has one level and no proxy, since the others would keep their shape".into(),
            });
        }
        let key = self.add_mesh(mesh)?;
        self.deforming.users.insert(key, BTreeSet::new());
        Ok(key)
    }

    /// Whether a mesh's vertices may be replaced.
    #[must_use]
    pub fn deforms(&self, mesh: MeshKey) -> bool {
        self.deforming.contains(mesh)
    }

    /// Declares that a mesh keeps the vertices that it has, new ones among them. A renderer that has it already may go on as before.
    pub fn stop_deforming(&mut self, mesh: MeshKey) {
        if let Some(users) = self.deforming.users.remove(mesh)
            && self.deforming.changed.contains(&mesh)
        {
            self.deforming.stopped.extend(users);
        }
    }

    /// Replaces the vertices of a mesh that deforms, for every entity that has it. [`Self::update`] makes boxes follow, and reports the entities as moved. Vertices that are
    /// as before change nothing.
    ///
    /// # Errors
    /// An unknown mesh, or one that does not deform; positions or normals that are not finite, or not as many as the mesh has.
    pub fn set_vertices(
        &mut self,
        mesh: MeshKey,
        positions: Vec<[f32; 3]>,
        normals: Vec<[f32; 3]>,
    ) -> Result<(), SceneError> {
        if !self.deforms(mesh) {
            return Err(self.unknown_asset("deforming mesh", &mesh, "new vertices".into()));
        }
        let known = self.meshes.get_mut(mesh);
        let Some((name, full)) =
            known.and_then(|mesh| Some((&mesh.name, mesh.levels.first_mut()?)))
        else {
            return Ok(());
        };
        let problem = vertices_problem(full, &positions, &normals);
        if let Some(problem) = problem {
            return Err(SceneError::BadMesh {
                mesh: name.clone(),
                part: "new vertices".into(),
                problem,
            });
        }
        if full.positions == positions && full.normals == normals {
            return Ok(());
        }
        (full.positions, full.normals) = (positions, normals);
        if let Some(bounds) = full.bounds() {
            self.mesh_bounds.insert(mesh, bounds);
        }
        self.deforming.changed.insert(mesh);
        Ok(())
    }

    /// The meshes with new vertices, and the entities that have them, whose boxes are marked to be found anew. Both in arena order.
    pub(super) fn take_deformed(&mut self) -> (Vec<MeshKey>, Vec<EntityKey>) {
        let meshes = std::mem::take(&mut self.deforming.changed);
        let mut entities = std::mem::take(&mut self.deforming.stopped);
        // These may have got another mesh since.
        entities.retain(|entity| {
            let drawable = self.drawables.get(*entity);
            drawable.is_some_and(|drawable| meshes.contains(&drawable.mesh))
        });
        for mesh in &meshes {
            entities.extend(self.deforming.users.get(*mesh).into_iter().flatten());
        }
        entities.sort_unstable();
        entities.dedup();
        for entity in &entities {
            self.mark_dirty(*entity, BOUNDS_DIRTY);
        }
        (meshes.into_iter().collect(), entities)
    }
}

/// Why vertices cannot take the place of a geometry's own.
fn vertices_problem(
    full: &Geometry,
    positions: &[[f32; 3]],
    normals: &[[f32; 3]],
) -> Option<String> {
    for (what, new, old) in [
        ("positions", positions, &full.positions),
        ("normals", normals, &full.normals),
    ] {
        if new.len() != old.len() {
            return Some(format!(
                "{} {what} for {}; a mesh that deforms keeps its vertices",
                new.len(),
                old.len()
            ));
        }
        if let Some(at) = new.as_flattened().iter().position(|n| !n.is_finite()) {
            return Some(format!("{what} {} are not finite", at / 3));
        }
    }
    None
}
