//! What of a terrain, and of what stands on it, may be seen in a frame.

use std::sync::Arc as Shared;

use antumbra_draw::{SceneTable, ViewFrame};
use antumbra_scene::{Aabb, Projection, Topology};
use glam::DVec3;

use crate::cull::{Arc, Eye};
use crate::field::NONE;
use crate::show::from_world;
use crate::stood::{Placed, Stood, slack};
use crate::strategy::Known;
use crate::terrain::Terrain;

/// What a slot shows, as far as terrain is concerned.
#[derive(Debug, Clone)]
enum Shows {
    /// Something that is always drawn.
    Other,
    /// A group of the terrain.
    Group(u32),
    /// Something that stands on it.
    Placed(Shared<Placed>),
}

/// What may be seen; kept from frame to frame.
#[derive(Debug, Default)]
pub(crate) struct Seen {
    shows: Vec<Shows>,
    /// Whether all of the terrain is where it was.
    intact: bool,
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
        let Some(eye) = eye(&known.terrain, frame).filter(|_| self.intact) else {
            return;
        };
        self.groups.clear();
        let groups = known.terrain.groups().groups().len();
        self.groups.resize(groups, false);
        eye.each_seen(|group| self.groups[group as usize] = true);
        let exempt = |slot: u32| {
            let near = || {
                let bounds = table.bounds(slot);
                frame.camera.crosses_near(&bounds, frame.aspect())
            };
            !table.is_tested(slot) || near()
        };
        slots.retain(|slot| !self.hides(&eye, *slot) || exempt(*slot));
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
        let mut there = 0;
        let mut shows = |slot| {
            let Some(occupant) = table.occupant(slot) else {
                return Shows::Other;
            };
            let now = table.bounds(slot);
            if let Some((group, bounds)) = known.entities.get(&occupant.key) {
                there += usize::from(table.is_occluder(slot) && is_at(&now, bounds));
                return match *group {
                    NONE => Shows::Other,
                    group => Shows::Group(group),
                };
            }
            let solid = table.class_of(slot).topology() == Topology::Triangles;
            match stood.at(occupant.key, &now).filter(|_| solid) {
                Some(placed) => Shows::Placed(Shared::clone(placed)),
                None => Shows::Other,
            }
        };
        self.shows = (0..table.slots()).map(&mut shows).collect();
        self.intact = there == known.entities.len();
    }

    fn hides(&self, eye: &Eye<'_>, slot: u32) -> bool {
        match self.shows.get(slot as usize) {
            Some(Shows::Group(group)) => self.groups.get(*group as usize) == Some(&false),
            Some(Shows::Placed(placed)) => eye.misses(&placed.stand),
            _ => false,
        }
    }
}

/// Whether a box is where it was, give or take what rounding does to it.
fn is_at(now: &Aabb, then: &Aabb) -> bool {
    let slack = slack(then);
    (now.min - then.min).abs().max_element() < slack
        && (now.max - then.max).abs().max_element() < slack
}

/// Whoever looks, where horizons say anything to them: parallel lines of sight come from everywhere, and horizons say who sees from one place.
fn eye<'a>(terrain: &'a Terrain, view: &ViewFrame) -> Option<Eye<'a>> {
    let at = from_world(view.camera.position) - terrain.field().origin();
    let spread = spread(view)?;
    let [wide, high] = spread;
    let clearance = view.camera.near() * (1.0 + wide * wide + high * high).sqrt();
    terrain.eye(at, sight(view, spread), clearance)
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
