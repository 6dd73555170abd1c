//! The strategy `horizon`: terrain culled by what was found beforehand. It asks nothing, waits for nothing, and plugs in from outside of the
//! culling crate as anybody's would.

use std::collections::HashMap;
use std::sync::Arc as Shared;

use antumbra_cull::{DeclareError, FrameGraph, Strategy, Verdict, ViewNodes, VisibleSet};
use antumbra_draw::{SceneTable, ViewFrame};
use antumbra_scene::{Aabb, EntityKey, Projection};
use glam::DVec3;

use crate::blocks::Blocks;
use crate::cull::Arc;
use crate::field::NONE;
use crate::show::{ShownTerrain, from_world};
use crate::terrain::Terrain;

/// The strategy `horizon` for a terrain, or for several beside each other; all else in a scene is drawn where it touches the frustum. By
/// default it has none, and refuses to be declared.
///
/// What it culls it culls behind terrain as it was shown: of a terrain one of whose entities is missing, moved or of a material that one can
/// see through, all is drawn, and nothing is hidden by it.
#[derive(Debug, Clone, Default)]
pub struct Horizon {
    known: Option<Shared<Known>>,
}

/// What is known of terrains in a scene.
#[derive(Debug)]
struct Known {
    terrains: Vec<Shared<Terrain>>,
    /// How many entities show each.
    entities_of: Vec<usize>,
    /// The terrain and the group of each entity, [`NONE`] for those always drawn, and the box it is in.
    entities: HashMap<EntityKey, (usize, u32, Aabb)>,
}

impl Horizon {
    /// For a terrain, as it was shown.
    #[must_use]
    pub fn new(terrain: Shared<Terrain>, shown: &ShownTerrain) -> Self {
        Self::over([(terrain, shown)])
    }

    /// For terrains that lie beside each other, each as it was shown: see [`Blocks`].
    #[must_use]
    pub fn over<'a>(blocks: impl IntoIterator<Item = (Shared<Terrain>, &'a ShownTerrain)>) -> Self {
        let mut known = Known {
            terrains: Vec::new(),
            entities_of: Vec::new(),
            entities: HashMap::new(),
        };
        for (block, (terrain, shown)) in blocks.into_iter().enumerate() {
            let entities = shown.entities(&terrain);
            let before = known.entities.len();
            let numbered = entities.map(|(key, (group, bounds))| (key, (block, group, bounds)));
            known.entities.extend(numbered);
            known.entities_of.push(known.entities.len() - before);
            known.terrains.push(terrain);
        }
        Self {
            known: (!known.terrains.is_empty()).then(|| Shared::new(known)),
        }
    }
}

/// What of the terrains may be seen in a frame.
#[derive(Debug, Default)]
struct Seen {
    /// The group of each slot, those of a terrain after those of the one before, and of which epoch that is.
    of: Vec<u32>,
    epoch: Option<u64>,
    /// Which terrains are whole and where they were, and those together.
    intact: Vec<usize>,
    blocks: Option<Blocks>,
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
        let firsts: Vec<u32> = firsts(&known.terrains).collect();
        let mut there = vec![0; known.terrains.len()];
        let mut number = |slot| {
            let (block, group, bounds) = known.entities.get(&table.occupant(slot)?.key)?;
            there[*block] +=
                usize::from(table.is_occluder(slot) && is_at(&table.bounds(slot), bounds));
            (*group != NONE).then(|| firsts[*block] + group)
        };
        self.of = (0..table.slots())
            .map(|slot| number(slot).unwrap_or(NONE))
            .collect();
        let intact = (0..there.len()).filter(|&block| there[block] == known.entities_of[block]);
        let intact: Vec<usize> = intact.collect();
        if self.blocks.is_none() || intact != self.intact {
            let whole = intact.iter().map(|&block| known.terrains[block].clone());
            self.blocks = Some(Blocks::join(whole.collect()));
            self.intact = intact;
        }
    }

    fn look(&mut self, known: &Known, view: &ViewFrame) {
        let groups = known.terrains.iter().map(groups_of).sum::<u32>();
        self.seen.clear();
        self.seen.resize(groups as usize, true);
        // Parallel lines of sight come from everywhere; horizons say who sees from one place.
        let (Some(spread), Some(blocks)) = (spread(view), &self.blocks) else {
            return;
        };
        let at = from_world(view.camera.position);
        let [wide, high] = spread;
        let clearance = view.camera.near() * (1.0 + wide * wide + high * high).sqrt();
        let eyes = blocks.eyes(at, sight(view, spread), clearance);
        let mut eyes = self.intact.iter().zip(eyes).peekable();
        for (block, first) in firsts(&known.terrains).enumerate() {
            let eye = eyes.next_if(|(intact, _)| **intact == block);
            if let Some((_, Some(eye))) = eye {
                let end = first + groups_of(&known.terrains[block]);
                self.seen[first as usize..end as usize].fill(false);
                eye.each_seen(|group| self.seen[(first + group) as usize] = true);
            }
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

fn groups_of(terrain: &Shared<Terrain>) -> u32 {
    terrain.groups().groups().len() as u32
}

/// The numbers of the terrains' first groups.
fn firsts(terrains: &[Shared<Terrain>]) -> impl Iterator<Item = u32> {
    terrains.iter().scan(0, |next, terrain| {
        let first = *next;
        *next += groups_of(terrain);
        Some(first)
    })
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
        known.is_none_or(|known| known.terrains.iter().all(|terrain| terrain.is_sound()))
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
                seen.look(&known, frame);
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
