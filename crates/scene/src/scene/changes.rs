//! What came, went and moved between two updates.

use super::dense::{MOVED, NEW, SCENE};
use super::update::{self, Moved};
use super::{Drawable, Scene};
use crate::keys::{EntityKey, ImageKey};
use slotmap::SecondaryMap;

/// What changed among the drawable entities since the last [`Scene::update`], each list in arena order.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SceneChanges {
    /// Became drawable, or got another mesh, material or role in tests (then also in `removed`).
    pub added: Vec<EntityKey>,
    /// Are no longer drawable or gone, or got another mesh, material or role in tests.
    pub removed: Vec<EntityKey>,
    /// Were drawable and stay so, but stand elsewhere.
    pub moved: Vec<EntityKey>,
    /// Hang below another parent, or below none; drawable or not.
    pub reparented: Vec<EntityKey>,
    /// Images that hold other pixels now.
    pub images: Vec<ImageKey>,
    /// Whether the scene has another environment, or none any more. One whose image was repainted is the same: see `images`.
    pub environment: bool,
}

impl SceneChanges {
    /// Whether nothing changed.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.added.is_empty()
            && self.removed.is_empty()
            && self.moved.is_empty()
            && self.reparented.is_empty()
            && self.images.is_empty()
            && !self.environment
    }
}

/// How an entity is drawn and tested.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Shown {
    drawable: Drawable,
    tested: bool,
}

/// What the last update reported, and what may differ from it.
#[derive(Clone, Debug, Default)]
pub(super) struct Ledger {
    reported: SecondaryMap<EntityKey, Shown>,
    touched: Vec<EntityKey>,
    gone: Vec<EntityKey>,
    reparented: Vec<EntityKey>,
    repainted: Vec<ImageKey>,
    surrounded: bool,
}

impl Ledger {
    /// The entity hangs below another parent.
    pub(super) fn reparented(&mut self, entity: EntityKey) {
        self.reparented.push(entity);
    }

    /// The image got other pixels.
    pub(super) fn repainted(&mut self, image: ImageKey) {
        self.repainted.push(image);
    }

    /// The environment is another one.
    pub(super) fn surrounded(&mut self) {
        self.surrounded = true;
    }

    /// The entity's drawable was set or cleared, or it is tested where it was not.
    pub(super) fn touched(&mut self, entity: EntityKey) {
        self.touched.push(entity);
    }

    /// The entity is gone.
    pub(super) fn despawned(&mut self, entity: EntityKey) {
        if self.reported.remove(entity).is_some() {
            self.gone.push(entity);
        }
    }
}

impl Scene {
    /// Brings world transforms and boxes up to date and says what changed since the last call.
    pub fn update(&mut self) -> SceneChanges {
        let moved = self.propagate();
        let Ledger {
            reported,
            touched,
            gone,
            reparented,
            repainted,
            surrounded,
        } = &mut self.ledger;
        let mut changes = SceneChanges {
            removed: std::mem::take(gone),
            reparented: std::mem::take(reparented),
            images: std::mem::take(repainted),
            environment: std::mem::take(surrounded),
            ..SceneChanges::default()
        };
        // Only who looks as before counts as moved; who looks different is removed and added.
        let shown = |entity: EntityKey| {
            Some(Shown {
                drawable: *self.drawables.get(entity)?,
                tested: !self.untested.contains_key(entity),
            })
        };
        let stays = |entity: EntityKey| {
            let now = shown(entity);
            now.is_some() && now.as_ref() == reported.get(entity)
        };
        match moved {
            Moved::Some(slots) => {
                let entities = slots.into_iter().map(|slot| self.dense.key[slot as usize]);
                changes.moved = entities.filter(|entity| stays(*entity)).collect();
                changes.moved.sort_unstable();
            }
            Moved::Marked => {
                let moved = |entity: &EntityKey| {
                    let slot = self.links.get(*entity).map_or(SCENE, |entry| entry.slot);
                    self.dense.state[slot as usize] & (MOVED | NEW) == MOVED
                };
                let entities = self.drawables.keys().filter(moved);
                changes.moved = entities.filter(|entity| stays(*entity)).collect();
                update::settle(&mut self.dense);
            }
        }
        touched.sort_unstable();
        touched.dedup();
        for entity in touched.drain(..) {
            let now = shown(entity);
            let before = reported.get(entity).copied();
            if now == before {
                continue;
            }
            if before.is_some() {
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
            .retain(|entity| self.links.get(*entity).is_some());
        changes.reparented.sort_unstable();
        changes.reparented.dedup();
        changes.removed.sort_unstable();
        changes.images.sort_unstable();
        changes.images.dedup();
        changes
    }

    fn propagate(&mut self) -> Moved {
        if self.dense.is_untidy() {
            self.dense.lay_out(&mut self.links);
        }
        let listed = std::mem::take(&mut self.listed);
        if listed.is_empty() && self.dense.state[SCENE as usize] == 0 {
            return Moved::Some(Vec::new());
        }
        update::propagate(&mut self.dense, &self.links, &self.mesh_boxes, &listed)
    }
}
