//! The strategy `horizon`: terrain culled by what was found beforehand. It asks nothing, waits for nothing, and plugs in from outside of the
//! culling crate as anybody's would.

use std::collections::HashMap;
use std::sync::Arc as Shared;

use antumbra_cull::{DeclareError, FrameGraph, Strategy, Verdict, ViewNodes, VisibleSet};
use antumbra_draw::{SceneTable, ViewFrame};
use antumbra_scene::{Aabb, EntityKey, Projection};
use glam::DVec3;

use crate::cull::Arc;
use crate::field::NONE;
use crate::show::{ShownTerrain, from_world};
use crate::terrain::Terrain;

/// The strategy `horizon` for one terrain; all else in a scene is drawn where it touches the frustum. By default it has no terrain, and
/// refuses to be declared.
///
/// What it culls it culls behind the terrain as it was shown: where one of its entities is missing, moved or of a material that one can see
/// through, all of it is drawn.
#[derive(Debug, Clone, Default)]
pub struct Horizon {
    known: Option<Shared<Known>>,
}

/// What is known of a terrain in a scene.
#[derive(Debug)]
struct Known {
    terrain: Shared<Terrain>,
    /// The group of each entity, [`NONE`] for those always drawn, and the box it is in.
    entities: HashMap<EntityKey, (u32, Aabb)>,
}

impl Horizon {
    /// For a terrain, as it was shown.
    #[must_use]
    pub fn new(terrain: Shared<Terrain>, shown: &ShownTerrain) -> Self {
        let entities = shown.entities(&terrain).collect();
        Self {
            known: Some(Shared::new(Known { terrain, entities })),
        }
    }
}

/// What of a terrain may be seen in a frame.
#[derive(Debug, Default)]
struct Seen {
    /// The group of each slot, whether all groups are where they were, and of which epoch that is.
    of: Vec<u32>,
    intact: bool,
    epoch: Option<u64>,
    /// Whether each group may be seen.
    seen: Vec<bool>,
}

impl Seen {
    /// Looks up which slots show which groups, if anything has changed.
    fn follow(&mut self, table: &SceneTable, known: &Known) {
        if self.epoch == Some(table.epoch()) {
            return;
        }
        self.epoch = Some(table.epoch());
        let mut there = 0;
        let mut group = |slot| {
            let (group, bounds) = known.entities.get(&table.occupant(slot)?.key)?;
            there += usize::from(table.is_occluder(slot) && is_at(&table.bounds(slot), bounds));
            Some(*group)
        };
        self.of = (0..table.slots())
            .map(|slot| group(slot).unwrap_or(NONE))
            .collect();
        self.intact = there == known.entities.len();
    }

    fn look(&mut self, terrain: &Terrain, view: &ViewFrame) {
        let at = from_world(view.camera.position) - terrain.field().origin();
        // Parallel lines of sight come from everywhere; horizons say who sees from one place.
        let spread = spread(view).filter(|_| self.intact);
        let eye = spread.and_then(|spread| {
            let [wide, high] = spread;
            let clearance = view.camera.near() * (1.0 + wide * wide + high * high).sqrt();
            terrain.eye(at, sight(view, spread), clearance)
        });
        self.seen.clear();
        self.seen
            .resize(terrain.groups().groups().len(), eye.is_none());
        if let Some(eye) = eye {
            eye.each_seen(|group| self.seen[group as usize] = true);
        }
    }

    fn verdict(&self, slot: u32) -> Verdict {
        let group = self.of.get(slot as usize).copied().unwrap_or(NONE);
        match self.seen.get(group as usize) {
            Some(false) => Verdict::Occluded,
            Some(true) => Verdict::Visible,
            None => Verdict::Untested,
        }
    }
}

/// Whether a box is where it was, give or take what rounding does to it.
fn is_at(now: &Aabb, then: &Aabb) -> bool {
    let slack = 1e-3 + 1e-6 * (then.min.abs().max(then.max.abs())).max_element();
    (now.min - then.min).abs().max_element() < slack
        && (now.max - then.max).abs().max_element() < slack
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

impl Strategy for Horizon {
    fn name(&self) -> &str {
        "horizon"
    }

    fn summary(&self) -> &str {
        "culls terrain below the horizons that were found beforehand, without a query"
    }

    fn conservative(&self) -> bool {
        let known = self.known.as_ref();
        known.is_none_or(|known| known.terrain.is_sound())
    }

    fn declare(
        &mut self,
        g: &mut FrameGraph<'_>,
        view: &mut ViewNodes,
    ) -> Result<VisibleSet, DeclareError> {
        let known = self.known.clone().ok_or_else(|| DeclareError::Settings {
            strategy: self.name().to_owned(),
            conflict: "this scene has no terrain whose horizons were found: show one that was prepared, or the built-in scene terrain".to_owned(),
        })?;
        let candidates = g.in_frustum(view);
        let mut seen = Seen::default();
        let chosen = g.choose(
            view,
            |node| {
                node.read(candidates);
            },
            move |ctx, table, frame, verdicts| {
                seen.follow(table, &known);
                seen.look(&known.terrain, frame);
                let candidates = ctx.get(candidates)?;
                for &slot in candidates.inside() {
                    verdicts.set(slot, Verdict::Untested);
                }
                for slot in candidates.testable() {
                    verdicts.set(slot, seen.verdict(slot));
                }
                Ok(())
            },
        );
        Ok(g.shade(view, chosen))
    }
}
