//! What of terrains, and of what stands on them, may be seen in a frame.

use std::sync::Arc as Shared;

use antumbra_draw::{SceneTable, ViewFrame};
use antumbra_scene::{Aabb, Projection, Topology};
use glam::DVec3;

use crate::blocks::Blocks;
use crate::cull::{Arc, Eye};
use crate::field::NONE;
use crate::show::from_world;
use crate::standing::Stand;
use crate::stood::{Placed, Stood, slack};
use crate::strategy::Known;
use crate::terrain::Terrain;

/// What a slot shows, as far as terrain is concerned.
#[derive(Debug, Clone)]
enum Shows {
    /// Something that is always drawn.
    Other,
    /// A group, counted through all terrains.
    Group(u32),
    /// Something that stands on it.
    Placed(Shared<Placed>),
}

/// What may be seen; kept from frame to frame.
#[derive(Debug, Default)]
pub(crate) struct Seen {
    shows: Vec<Shows>,
    /// Which terrains are whole and where they were, and those together.
    intact: Vec<usize>,
    blocks: Option<Blocks>,
    /// Of which epoch that is, and of which preparation.
    of: Option<(u64, Shared<Stood>)>,
    /// Whether each group may be seen.
    groups: Vec<bool>,
}

impl Seen {
    /// Takes away the slots of all that is hidden and that a test may judge.
    pub fn keep(
        &mut self,
        known: &Known,
        stood: &Shared<Stood>,
        (table, frame): (&SceneTable, &ViewFrame),
        slots: &mut Vec<u32>,
    ) {
        self.follow(table, known, stood);
        let Some(blocks) = &self.blocks else {
            return;
        };
        let eyes = eyes(blocks, frame);
        if eyes.iter().all(Option::is_none) {
            return;
        }
        // By terrain, those that are not whole among them.
        let mut each: Vec<Option<&Eye<'_>>> = vec![None; known.terrains.len()];
        for (&block, eye) in self.intact.iter().zip(&eyes) {
            each[block] = eye.as_ref();
        }
        self.groups.clear();
        for (terrain, eye) in known.terrains.iter().zip(&each) {
            let first = self.groups.len();
            let count = terrain.groups().groups().len();
            self.groups.resize(first + count, eye.is_none());
            if let Some(eye) = eye {
                eye.each_seen(|group| self.groups[first + group as usize] = true);
            }
        }
        let exempt = |slot: u32| {
            let near = || {
                let bounds = table.bounds(slot);
                frame.camera.crosses_near(&bounds, frame.aspect())
            };
            !table.is_tested(slot) || near()
        };
        let (shows, groups) = (&self.shows, &self.groups);
        let hidden = |slot: u32| match shows.get(slot as usize) {
            Some(Shows::Group(group)) => groups.get(*group as usize) == Some(&false),
            Some(Shows::Placed(placed)) => {
                let behind = |(eye, stand): (&Option<&Eye<'_>>, &Stand)| {
                    eye.is_some_and(|eye| eye.misses(stand))
                };
                each.iter().zip(&placed.stands).any(behind)
            }
            _ => false,
        };
        slots.retain(|slot| !hidden(*slot) || exempt(*slot));
    }

    /// Looks up which slots show what, if anything has changed.
    fn follow(&mut self, table: &SceneTable, known: &Known, stood: &Shared<Stood>) {
        let same = |(epoch, last): &(u64, Shared<Stood>)| {
            *epoch == table.epoch() && Shared::ptr_eq(last, stood)
        };
        if self.of.as_ref().is_some_and(same) {
            return;
        }
        self.of = Some((table.epoch(), Shared::clone(stood)));
        let firsts: Vec<u32> = firsts(&known.terrains).collect();
        let mut there = vec![0; known.terrains.len()];
        let mut shows = |slot| {
            let Some(occupant) = table.occupant(slot) else {
                return Shows::Other;
            };
            let now = table.bounds(slot);
            if let Some((block, group, bounds)) = known.entities.get(&occupant.key) {
                there[*block] += usize::from(table.is_occluder(slot) && is_at(&now, bounds));
                return match *group {
                    NONE => Shows::Other,
                    group => Shows::Group(firsts[*block] + group),
                };
            }
            let solid = table.class_of(slot).topology() == Topology::Triangles;
            match stood.at(occupant.key, &now).filter(|_| solid) {
                Some(placed) => Shows::Placed(Shared::clone(placed)),
                None => Shows::Other,
            }
        };
        self.shows = (0..table.slots()).map(&mut shows).collect();
        let intact = (0..there.len()).filter(|&block| there[block] == known.entities_of[block]);
        let intact: Vec<usize> = intact.collect();
        if self.blocks.is_none() || intact != self.intact {
            let whole = intact.iter().map(|&block| known.terrains[block].clone());
            self.blocks = Some(Blocks::join(whole.collect()));
            self.intact = intact;
        }
    }
}

/// The numbers of the terrains' first groups.
fn firsts(terrains: &[Shared<Terrain>]) -> impl Iterator<Item = u32> {
    terrains.iter().scan(0, |next, terrain| {
        let first = *next;
        *next += terrain.groups().groups().len() as u32;
        Some(first)
    })
}

/// Whether a box is where it was, give or take what rounding does to it.
fn is_at(now: &Aabb, then: &Aabb) -> bool {
    let slack = slack(then);
    (now.min - then.min).abs().max_element() < slack
        && (now.max - then.max).abs().max_element() < slack
}

/// Whoever looks at each block, where horizons say anything to them: parallel lines of sight come from everywhere, and horizons say who sees
/// from one place.
fn eyes<'a>(blocks: &'a Blocks, view: &ViewFrame) -> Vec<Option<Eye<'a>>> {
    let Some(spread) = spread(view) else {
        return Vec::new();
    };
    let at = from_world(view.camera.position);
    let [wide, high] = spread;
    let clearance = view.camera.near() * (1.0 + wide * wide + high * high).sqrt();
    blocks.eyes(at, sight(view, spread), clearance).collect()
}

/// Half the picture's height and width over its distance; `None` where lines of sight are parallel.
fn spread(view: &ViewFrame) -> Option<[f64; 2]> {
    let matrix = view.camera.projection_matrix(view.aspect());
    let parallel = matches!(view.camera.projection, Projection::Orthographic { .. });
    let off = [matrix.z_axis.x, matrix.z_axis.y].map(|off| f64::from(off).abs());
    let scale = [matrix.x_axis.x, matrix.y_axis.y].map(|scale| f64::from(scale).abs());
    (!parallel).then(|| [(1.0 + off[0]) / scale[0], (1.0 + off[1]) / scale[1]])
}

/// The directions in the plan in which anything is seen.
fn sight(view: &ViewFrame, [wide, high]: [f64; 2]) -> Arc {
    let rotation = view.camera.rotation;
    let up = rotation.inverse() * DVec3::Y;
    let steep = up.x.abs() <= wide * up.z.abs() && up.y.abs() <= high * up.z.abs();
    if steep {
        // Straight above or below is in the picture.
        return Arc::ALL;
    }
    let plan = |way: DVec3| from_world(rotation * way).truncate();
    let middle = plan(DVec3::NEG_Z);
    let corners = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)]
        .map(|(x, y)| plan(DVec3::new(x * wide, y * high, -1.0)));
    let half = corners.map(|corner| middle.angle_to(corner).abs());
    let half = half.into_iter().fold(0.0, f64::max);
    Arc::around(middle, half + 1e-6)
}
