//! The strategy `horizon`: terrain, and what stands on it, culled by what was found beforehand. It asks nothing, waits for nothing, and plugs in from
//! outside of the culling crate as anybody's would. What it leaves, another strategy may judge.

use std::collections::HashMap;
use std::sync::{Arc as Shared, PoisonError, RwLock};

use antumbra_cull::{
    Chain, DeclareError, FrameGraph, Latency, Registry, Setting, SettingError, Step, Strategy,
    Tunable, Value, ViewNodes, VisibleSet,
};
use antumbra_scene::{Aabb, EntityKey, Scene};
use glam::DVec3;

use crate::field::NONE;
use crate::seen::Seen;
use crate::show::{ShownTerrain, to_world};
use crate::stood::Stood;
use crate::terrain::Terrain;

/// The strategy `horizon` for a terrain, or for several beside each other. By default it has none, and refuses to be declared.
///
/// What it culls it culls behind terrain as it was shown: of a terrain one of whose entities is missing, moved or of a material that one can
/// see through, all is left to be drawn, and nothing is hidden by it. Other entities of the scene are culled from the next frame on after [`Self::stand`] has prepared them.
///
/// Clones know the same terrains and the same entities: keep one to prepare entities anew while another is at work in a stage.
#[derive(Debug, Clone, Default)]
pub struct Horizon {
    known: Option<Shared<Known>>,
    chain: Chain,
}

/// What is known of terrains in a scene.
#[derive(Debug)]
pub(crate) struct Known {
    pub terrains: Vec<Shared<Terrain>>,
    /// How many entities show each.
    pub entities_of: Vec<usize>,
    /// The terrain and the group of each entity, [`NONE`] for those always drawn, and the box it is in.
    pub entities: HashMap<EntityKey, (usize, u32, Aabb)>,
    /// The other entities that were prepared.
    stood: RwLock<Shared<Stood>>,
}

impl Horizon {
    /// For a terrain, as it was shown.
    #[must_use]
    pub fn new(terrain: Shared<Terrain>, shown: &ShownTerrain) -> Self {
        Self::over([(terrain, shown)])
    }

    /// For terrains that lie beside each other, each as it was shown: see [`Blocks`](crate::Blocks).
    #[must_use]
    pub fn over<'a>(blocks: impl IntoIterator<Item = (Shared<Terrain>, &'a ShownTerrain)>) -> Self {
        let mut known = Known {
            terrains: Vec::new(),
            entities_of: Vec::new(),
            entities: HashMap::new(),
            stood: RwLock::default(),
        };
        for (block, (terrain, shown)) in blocks.into_iter().enumerate() {
            let entities = entities(shown, &terrain);
            let before = known.entities.len();
            let numbered = entities.map(|(key, (group, bounds))| (key, (block, group, bounds)));
            known.entities.extend(numbered);
            known.entities_of.push(known.entities.len() - before);
            known.terrains.push(terrain);
        }
        Self {
            known: (!known.terrains.is_empty()).then(|| Shared::new(known)),
            chain: Chain::default(),
        }
    }

    /// The same with the setting `then` taken from these strategies; those of the culling crate are known by themselves.
    #[must_use]
    pub fn before(self, registry: Shared<Registry>) -> Self {
        Self {
            chain: Chain::among(registry),
            ..self
        }
    }

    /// Prepares all entities of a scene but the terrains' own, so that they are culled where terrain hides the boxes around them as of the last
    /// [update](Scene::update), which syncing the GPU's scene is one of; says how many were new or had moved. Until this is called again, what moves or comes is left to be drawn.
    ///
    /// It takes what [`Terrain::stand`] takes, for each terrain, and nothing where nobody is new; `done` is told of every sector finished. Frames go on meanwhile with
    /// what was known before, so that it may run beside them.
    pub fn stand(&self, scene: &Scene, done: &(dyn Fn() + Sync)) -> usize {
        let Some(known) = &self.known else {
            return 0;
        };
        let own = |entity| known.entities.contains_key(&entity);
        let (stood, count) = known.stood().prepare(&known.terrains, scene, own, done);
        *known.stood.write().unwrap_or_else(PoisonError::into_inner) = Shared::new(stood);
        count
    }
}

/// All entities of a terrain that show something: the group of each, [`NONE`] for those always drawn, and the box around it in the world.
fn entities(
    shown: &ShownTerrain,
    terrain: &Terrain,
) -> impl Iterator<Item = (EntityKey, (u32, Aabb))> {
    let groups = terrain.groups();
    let around = |triangles: &[u32]| {
        let corners = triangles
            .iter()
            .flat_map(|&triangle| terrain.field().corners(triangle));
        let place = |corner: DVec3| to_world(corner) + to_world(terrain.field().origin());
        Aabb::from_points(corners.map(place)).unwrap_or(Aabb::new(DVec3::ZERO, DVec3::ZERO))
    };
    let crystals = shown.groups.iter().map(move |&(entity, group)| {
        let known = groups.groups().get(group as usize);
        let triangles = known.map_or(&[][..], |group| groups.triangles(group));
        (entity, (group, around(triangles)))
    });
    let rest = shown.always.iter();
    crystals.chain(rest.map(move |(entity, triangles)| (*entity, (NONE, around(triangles)))))
}

impl Known {
    fn stood(&self) -> Shared<Stood> {
        let stood = self.stood.read().unwrap_or_else(PoisonError::into_inner);
        Shared::clone(&stood)
    }
}

impl Strategy for Horizon {
    fn name(&self) -> &str {
        "horizon"
    }

    fn summary(&self) -> &str {
        "culls terrain below the horizons that were found beforehand, without a query, and leaves the rest to another strategy"
    }

    fn conservative(&self) -> bool {
        let known = self.known.as_ref();
        self.chain.ask(|next| next.conservative())
            && known.is_none_or(|known| known.terrains.iter().all(|terrain| terrain.is_sound()))
    }

    fn latency(&self) -> Option<Latency> {
        self.chain.ask(|next| next.latency())
    }

    fn needs_reference(&self) -> bool {
        self.chain.ask(|next| next.needs_reference())
    }

    fn tuning(&self) -> Option<&dyn Tunable> {
        Some(self)
    }

    fn tuning_mut(&mut self) -> Option<&mut dyn Tunable> {
        Some(self)
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
        let left = g.narrowed(
            view,
            "above the horizons",
            candidates,
            move |table, frame, slots| seen.keep(&known, &known.stood(), (table, frame), slots),
        );
        g.chain(view, left, self.chain.next_mut())
    }
}

/// All settings are those of the chain: `then`, and what the next strategy has.
impl Tunable for Horizon {
    fn settings(&self) -> Vec<Setting> {
        self.chain.settings()
    }

    fn set(&mut self, key: &str, value: &Value) -> Result<(), SettingError> {
        self.chain.set("horizon", key, value)
    }

    fn steps(&self) -> Vec<Step> {
        self.chain.steps()
    }
}
