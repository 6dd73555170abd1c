//! The strategy `horizon`: terrain, and what stands on it, culled by what was found beforehand. It asks nothing, waits for nothing, and plugs in from
//! outside of the culling crate as anybody's would. What it leaves, another strategy may judge.

use std::collections::HashMap;
use std::sync::{Arc as Shared, PoisonError, RwLock};

use antumbra_cull::{
    DeclareError, FrameGraph, Inner, Latency, Registry, Setting, SettingError, Strategy, ViewNodes,
    VisibleSet,
};
use antumbra_scene::{Aabb, EntityKey, Scene};

use crate::seen::Seen;
use crate::show::ShownTerrain;
use crate::stood::Stood;
use crate::terrain::Terrain;

/// The strategy `horizon` for one terrain. By default it has no terrain, and refuses to be declared.
///
/// What it culls it culls behind the terrain as it was shown: where one of its entities is missing, moved or of a material that one can see
/// through, all of it is left to be drawn. Other entities of the scene are culled from the next frame on after [`Self::stand`] has prepared them.
///
/// Clones know the same terrain and the same entities: keep one to prepare entities anew while another is at work in a stage.
#[derive(Debug, Clone, Default)]
pub struct Horizon {
    known: Option<Shared<Known>>,
    inner: Inner,
}

/// What is known of a terrain in a scene.
#[derive(Debug)]
pub(crate) struct Known {
    pub terrain: Shared<Terrain>,
    /// The group of each entity, [`NONE`](crate::NONE) for those always drawn, and the box it is in.
    pub entities: HashMap<EntityKey, (u32, Aabb)>,
    /// The other entities that were prepared.
    stood: RwLock<Shared<Stood>>,
}

impl Horizon {
    /// For a terrain, as it was shown.
    #[must_use]
    pub fn new(terrain: Shared<Terrain>, shown: &ShownTerrain) -> Self {
        let entities = shown.entities(&terrain).collect();
        let known = Known {
            terrain,
            entities,
            stood: RwLock::default(),
        };
        Self {
            known: Some(Shared::new(known)),
            inner: Inner::default(),
        }
    }

    /// The same with the setting `then` taken from these strategies; those of the culling crate are known by themselves.
    #[must_use]
    pub fn before(self, registry: Shared<Registry>) -> Self {
        Self {
            inner: Inner::among(registry),
            ..self
        }
    }

    /// Prepares all entities of a scene but the terrain's own, so that they are culled where the terrain hides the boxes around them as of the last
    /// [update](Scene::update), which syncing the GPU's scene is one of; says how many were new or had moved. Until this is called again, what moves or comes is left to be drawn.
    ///
    /// It takes what [`Terrain::stand`] takes, and nothing where nobody is new; `done` is told of every sector finished. Frames go on meanwhile with
    /// what was known before, so that it may run beside them.
    pub fn stand(&self, scene: &Scene, done: &(dyn Fn() + Sync)) -> usize {
        let Some(known) = &self.known else {
            return 0;
        };
        let own = |entity| known.entities.contains_key(&entity);
        let (stood, count) = known.stood().prepare(&known.terrain, scene, own, done);
        *known.stood.write().unwrap_or_else(PoisonError::into_inner) = Shared::new(stood);
        count
    }
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
        self.inner.ask(|inner| inner.conservative())
            && known.is_none_or(|known| known.terrain.is_sound())
    }

    fn latency(&self) -> Option<Latency> {
        self.inner.ask(|inner| inner.latency())
    }

    fn needs_reference(&self) -> bool {
        self.inner.ask(|inner| inner.needs_reference())
    }

    fn settings(&self) -> Vec<Setting> {
        self.inner.settings()
    }

    fn set(&mut self, key: &str, value: &str) -> Result<(), SettingError> {
        self.inner.set("horizon", key, value)
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
        g.hand_on(view, left, self.inner.strategy_mut())
    }
}
