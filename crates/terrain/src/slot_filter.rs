//! Removes the slots of a frame whose entities are hidden by terrain: groups of the terrains, and entities that stand on them.

use std::sync::Arc;

use antumbra_cull::{SceneTable, ViewFrame};
use antumbra_scene::{Aabb, Projection, Topology};
use glam::DVec3;

use crate::azimuth::AzimuthRange;
use crate::field::NONE;
use crate::observer::Observer;
use crate::prepared_entities::{PreparedEntities, PreparedEntity, slack};
use crate::terrain::Terrain;
use crate::terrain_entities::TerrainEntities;
use crate::tiles::TerrainTiles;
use crate::world::from_world;

/// What a slot shows.
#[derive(Debug, Clone)]
enum Shows {
    /// Something that terrain never hides.
    Other,
    /// A group, numbered through all terrains.
    Group(u32),
    /// A prepared entity.
    Prepared(Arc<PreparedEntity>),
}

/// Removes hidden slots. It keeps its buffers, and what it knows of the scene, from frame to frame.
#[derive(Debug, Default)]
pub(crate) struct SlotFilter {
    /// What each slot shows.
    shows: Vec<Shows>,
    /// The terrains that are complete and where they were shown, and those terrains joined.
    intact: Vec<usize>,
    tiles: Option<TerrainTiles>,
    /// What the fields above were computed from.
    source: Option<Source>,
    /// Whether each group may be visible.
    visible: Vec<bool>,
}

/// The state of a scene that a filter was computed from.
#[derive(Debug)]
struct Source {
    /// The epoch of the scene table.
    epoch: u64,
    prepared: Arc<PreparedEntities>,
}

impl SlotFilter {
    /// Removes the slots whose entities are hidden, except those that a test may not cull.
    pub fn retain_visible(
        &mut self,
        known: &TerrainEntities,
        table: &SceneTable,
        frame: &ViewFrame,
        slots: &mut Vec<u32>,
    ) {
        let prepared = known.prepared();
        self.update(table, known, &prepared);
        let Some(tiles) = &self.tiles else {
            return;
        };
        let observers = observers(tiles, frame);
        if observers.iter().all(Option::is_none) {
            return;
        }
        // For all terrains, also those that are not intact.
        let mut each: Vec<Option<&Observer<'_>>> = vec![None; known.terrains().len()];
        for (&terrain, observer) in self.intact.iter().zip(&observers) {
            each[terrain] = observer.as_ref();
        }
        self.visible.clear();
        for (terrain, observer) in known.terrains().iter().zip(&each) {
            let first = self.visible.len();
            let count = terrain.groups().groups().len();
            self.visible.resize(first + count, observer.is_none());
            if let Some(observer) = observer {
                observer.each_visible(|group| self.visible[first + group as usize] = true);
            }
        }
        let is_exempt = |slot: u32| {
            let crosses_near = || {
                let bounds = table.bounds(slot);
                frame.camera.crosses_near(&bounds, frame.aspect())
            };
            !table.is_tested(slot) || crosses_near()
        };
        let (shows, visible) = (&self.shows, &self.visible);
        let is_hidden = |slot: u32| match shows.get(slot as usize) {
            Some(Shows::Group(group)) => visible.get(*group as usize) == Some(&false),
            Some(Shows::Prepared(entity)) => {
                let mut by_terrain = each.iter().zip(&entity.regions);
                by_terrain.any(|(observer, regions)| {
                    observer.is_some_and(|observer| observer.is_box_hidden(regions))
                })
            }
            _ => false,
        };
        slots.retain(|slot| !is_hidden(*slot) || is_exempt(*slot));
    }

    /// Finds out what each slot shows, if the scene or the prepared entities have changed.
    fn update(
        &mut self,
        table: &SceneTable,
        known: &TerrainEntities,
        prepared: &Arc<PreparedEntities>,
    ) {
        let is_current = |source: &Source| {
            source.epoch == table.epoch() && Arc::ptr_eq(&source.prepared, prepared)
        };
        if self.source.as_ref().is_some_and(is_current) {
            return;
        }
        self.source = Some(Source {
            epoch: table.epoch(),
            prepared: Arc::clone(prepared),
        });
        let first_groups: Vec<u32> = first_groups(known.terrains()).collect();
        let mut present = vec![0; known.terrains().len()];
        let mut shows = |slot| {
            let Some(occupant) = table.occupant(slot) else {
                return Shows::Other;
            };
            let now = table.bounds(slot);
            if let Some(entity) = known.get(occupant.key) {
                let unchanged = table.is_occluder(slot) && is_at(&now, &entity.bounds);
                present[entity.terrain] += usize::from(unchanged);
                return match entity.group {
                    NONE => Shows::Other,
                    group => Shows::Group(first_groups[entity.terrain] + group),
                };
            }
            let solid = table.class_of(slot).topology() == Topology::Triangles;
            match prepared.get(occupant.key, &now).filter(|_| solid) {
                Some(entity) => Shows::Prepared(Arc::clone(entity)),
                None => Shows::Other,
            }
        };
        self.shows = (0..table.slots()).map(&mut shows).collect();
        let is_intact = |terrain: &usize| present[*terrain] == known.count(*terrain);
        let intact: Vec<usize> = (0..present.len()).filter(is_intact).collect();
        if self.tiles.is_none() || intact != self.intact {
            let terrains = intact.iter().map(|&index| known.terrains()[index].clone());
            self.tiles = Some(TerrainTiles::join(terrains.collect()));
            self.intact = intact;
        }
    }
}

/// The number of the first group of each terrain.
fn first_groups(terrains: &[Arc<Terrain>]) -> impl Iterator<Item = u32> {
    terrains.iter().scan(0, |next, terrain| {
        let first = *next;
        *next += terrain.groups().groups().len() as u32;
        Some(first)
    })
}

/// Whether a bounding box is where it was, up to rounding.
fn is_at(now: &Aabb, then: &Aabb) -> bool {
    let slack = slack(then);
    (now.min - then.min).abs().max_element() < slack
        && (now.max - then.max).abs().max_element() < slack
}

/// An observer over each tile, for a perspective camera. Parallel lines of sight have no common origin, and horizons decide only about
/// one position.
fn observers<'a>(tiles: &'a TerrainTiles, view: &ViewFrame) -> Vec<Option<Observer<'a>>> {
    let Some(tangents) = half_view_tangents(view) else {
        return Vec::new();
    };
    let at = from_world(view.camera.position);
    let [wide, high] = tangents;
    let clearance = view.camera.near() * (1.0 + wide * wide + high * high).sqrt();
    let azimuths = azimuths(view, tangents);
    tiles.observers(at, azimuths, clearance).collect()
}

/// The tangents of half the horizontal and half the vertical field of view; `None` for a parallel projection, and for one that is a matrix.
fn half_view_tangents(view: &ViewFrame) -> Option<[f64; 2]> {
    let matrix = view.camera.projection_matrix(view.aspect());
    let unknown = matches!(
        view.camera.projection,
        Projection::Orthographic { .. } | Projection::Matrix(_)
    );
    let off = [matrix.z_axis.x, matrix.z_axis.y].map(|off| f64::from(off).abs());
    let scale = [matrix.x_axis.x, matrix.y_axis.y].map(|scale| f64::from(scale).abs());
    (!unknown).then(|| [(1.0 + off[0]) / scale[0], (1.0 + off[1]) / scale[1]])
}

/// The directions in the plan that a view sees.
fn azimuths(view: &ViewFrame, [wide, high]: [f64; 2]) -> AzimuthRange {
    let rotation = view.camera.rotation;
    let up = rotation.inverse() * DVec3::Y;
    let sees_vertical = up.x.abs() <= wide * up.z.abs() && up.y.abs() <= high * up.z.abs();
    if sees_vertical {
        // The vertical is in the picture, and with it every azimuth.
        return AzimuthRange::ALL;
    }
    let plan = |direction: DVec3| from_world(rotation * direction).truncate();
    let middle = plan(DVec3::NEG_Z);
    let corners = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)]
        .map(|(x, y)| plan(DVec3::new(x * wide, y * high, -1.0)));
    let half = corners.map(|corner| middle.angle_to(corner).abs());
    let half = half.into_iter().fold(0.0, f64::max);
    AzimuthRange::around(middle, half + 1e-6)
}
