//! `Scene::update`: brings transforms and boxes up to date and reports the changes.

use super::Scene;
use super::change_log::{ChangeLog, DrawState, SceneChanges};
use super::propagate::{self, MovedSlots};
use super::transforms::{MOVED, NEW, SCENE};
use crate::keys::EntityKey;

impl Scene {
    /// Updates world transforms and boxes, and returns the changes since the previous call.
    pub fn update(&mut self) -> SceneChanges {
        let (deformed_meshes, deformed) = self.take_deformed();
        let moved = self.propagate();
        let ChangeLog {
            reported,
            touched,
            despawned,
            reparented,
            changed_images,
            environment_changed,
        } = &mut self.changes;
        let mut changes = SceneChanges {
            removed: std::mem::take(despawned),
            reparented: std::mem::take(reparented),
            images: std::mem::take(changed_images),
            environment: std::mem::take(environment_changed),
            ..SceneChanges::default()
        };
        // An entity that is drawn as before counts as moved. An entity that is drawn otherwise counts as removed and
        // added.
        let shown = |entity: EntityKey| {
            Some(DrawState {
                drawable: *self.drawables.get(entity)?,
                tested: !self.untested.contains_key(entity),
            })
        };
        let stays = |entity: EntityKey| {
            let now = shown(entity);
            now.is_some() && now.as_ref() == reported.get(entity)
        };
        match moved {
            MovedSlots::List(slots) => {
                let entities = slots
                    .into_iter()
                    .map(|slot| self.transforms.key[slot as usize]);
                changes.moved = entities.filter(|entity| stays(*entity)).collect();
                changes.moved.sort_unstable();
            }
            MovedSlots::Flagged => {
                let moved = |entity: &EntityKey| {
                    let slot = self.tree.get(*entity).map_or(SCENE, |node| node.slot);
                    self.transforms.flags[slot as usize] & (MOVED | NEW) == MOVED
                };
                let entities = self.drawables.keys().filter(moved);
                changes.moved = entities.filter(|entity| stays(*entity)).collect();
                self.transforms.clear_flags();
            }
        }
        if !deformed.is_empty() {
            changes
                .moved
                .extend(deformed.into_iter().filter(|entity| stays(*entity)));
            changes.moved.sort_unstable();
            changes.moved.dedup();
        }
        changes.deformed = deformed_meshes;
        touched.sort_unstable();
        touched.dedup();
        for entity in touched.drain(..) {
            let now = shown(entity);
            let previous = reported.get(entity).copied();
            if now == previous {
                continue;
            }
            if previous.is_some() {
                changes.removed.push(entity);
                reported.remove(entity);
            }
            if let Some(now) = now {
                changes.added.push(entity);
                reported.insert(entity, now);
            }
        }
        changes
            .reparented
            .retain(|entity| self.tree.get(*entity).is_some());
        changes.reparented.sort_unstable();
        changes.reparented.dedup();
        changes.removed.sort_unstable();
        changes.images.sort_unstable();
        changes.images.dedup();
        changes
    }

    fn propagate(&mut self) -> MovedSlots {
        if self.transforms.is_fragmented() {
            self.transforms.compact(&mut self.tree);
        }
        let queued = std::mem::take(&mut self.queued);
        if queued.is_empty() && self.transforms.flags[SCENE as usize] == 0 {
            return MovedSlots::List(Vec::new());
        }
        propagate::propagate(&mut self.transforms, &self.tree, &self.mesh_bounds, &queued)
    }
}
