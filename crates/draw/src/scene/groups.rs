//! Keeps the groups of a scene's hierarchy.

use antumbra_scene::hierarchy::NONE;
use antumbra_scene::{EntityKey, Scene};

use super::{GpuScene, max_groups};
use antumbra_cull::SceneTable;

impl GpuScene {
    /// Applies changed parents.
    pub(super) fn reparent(
        &mut self,
        table: &mut SceneTable,
        scene: &Scene,
        reparented: &[EntityKey],
    ) {
        for key in reparented {
            let (group, slot) = (self.group_of.get(*key).copied(), self.slot(*key));
            if group.is_none() && slot.is_none() {
                continue;
            }
            let parent = self.group(table, scene, scene.parent(*key));
            if let Some(group) = group {
                table.groups_mut().move_group(group, parent);
            }
            if let Some(slot) = slot {
                table.groups_mut().move_slot(slot, parent);
            }
        }
    }

    /// The group of the children of `parent`.
    pub(super) fn group(
        &mut self,
        table: &mut SceneTable,
        scene: &Scene,
        parent: Option<EntityKey>,
    ) -> u32 {
        let mut unknown = Vec::new();
        let mut group = NONE;
        let mut above = parent;
        while let Some(key) = above {
            if let Some(known) = self.group_of.get(key) {
                group = *known;
                break;
            }
            unknown.push(key);
            above = scene.parent(key);
        }
        for key in unknown.into_iter().rev() {
            group = table.groups_mut().add(group);
            self.group_of.insert(key, group);
        }
        group
    }

    /// Numbers the groups anew once most of them belong to removed entities.
    pub(super) fn clear_groups(&mut self, table: &mut SceneTable, scene: &Scene) {
        if table.groups().parents().len() <= self.max_groups {
            return;
        }
        table.groups_mut().clear();
        self.group_of.clear();
        let occupants: Vec<(u32, EntityKey)> = (table.live_slots())
            .filter_map(|slot| Some((slot, table.occupant(slot)?.key)))
            .collect();
        for (slot, key) in occupants {
            let group = self.group(table, scene, scene.parent(key));
            table.groups_mut().place(slot, group);
        }
        self.max_groups = max_groups(table);
    }
}
