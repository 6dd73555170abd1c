//! The strategy `horizon`: culls terrain, and what stands on it, by regions that were found in advance. It makes no GPU queries and waits for
//! nothing. It plugs in from outside of the culling crate, as any other crate's strategy would. What it leaves, another strategy may test.

use std::sync::Arc;

use antumbra_cull::{
    Chain, DeclareError, FrameGraph, Latency, Registry, Setting, SettingError, Step, Strategy,
    Tunable, Value, ViewNodes, VisibleSet,
};
use antumbra_scene::Scene;

use crate::show::{ShownTerrain, TerrainInScene};
use crate::slot_filter::SlotFilter;
use crate::terrain::Terrain;
use crate::terrain_entities::TerrainEntities;

/// The strategy `horizon` for one terrain, or for several side by side. The default has no terrain, and refuses to be declared.
///
/// It culls behind terrain as it was shown. If one of a terrain's entities is missing, was moved, or has a transparent material, the whole
/// terrain is drawn and hides nothing. Other entities of the scene are culled from the frame after [`Self::prepare_entities`] on.
///
/// Clones share the terrains and the prepared entities: keep one to prepare entities again while another one runs in a stage.
#[derive(Debug, Clone, Default)]
pub struct HorizonStrategy {
    known: Option<Arc<TerrainEntities>>,
    chain: Chain,
}

impl HorizonStrategy {
    /// A strategy for one terrain.
    #[must_use]
    pub fn new(terrain: Arc<Terrain>, shown: &ShownTerrain) -> Self {
        let mut known = TerrainEntities::default();
        known.add(terrain, shown);
        Self::with_known(known)
    }

    /// A strategy for terrains side by side: see [`TerrainTiles`](crate::TerrainTiles).
    #[must_use]
    pub fn for_tiles<'a>(tiles: impl IntoIterator<Item = &'a TerrainInScene>) -> Self {
        let mut known = TerrainEntities::default();
        for tile in tiles {
            known.add(Arc::clone(&tile.terrain), &tile.shown);
        }
        Self::with_known(known)
    }

    fn with_known(known: TerrainEntities) -> Self {
        Self {
            known: (!known.terrains().is_empty()).then(|| Arc::new(known)),
            chain: Chain::default(),
        }
    }

    /// The same strategy, with the strategies that the setting `then` can name. Without a registry it can name `frustum` alone.
    #[must_use]
    pub fn with_registry(self, registry: Arc<Registry>) -> Self {
        Self {
            chain: Chain::among(registry),
            ..self
        }
    }

    /// Prepares all entities of a scene that do not show terrain, so that they are culled where terrain hides their bounding boxes. The boxes
    /// are those of the last [update](Scene::update); syncing the scene to the GPU updates it. Returns how many entities were new or had
    /// moved. An entity that is added or moved afterwards is drawn until this is called again.
    ///
    /// It takes the time of [`Terrain::box_regions`] for each terrain, and none if no entity is new. `done` is called once for each finished
    /// sector. Frames keep using the earlier results meanwhile, so this may run in parallel with them.
    pub fn prepare_entities(&self, scene: &Scene, done: &(dyn Fn() + Sync)) -> usize {
        let known = self.known.as_ref();
        known.map_or(0, |known| known.prepare(scene, done))
    }
}

impl Strategy for HorizonStrategy {
    fn name(&self) -> &str {
        "horizon"
    }

    fn summary(&self) -> &str {
        "culls terrain below the horizons that were found beforehand, without a query, and leaves the rest to another strategy"
    }

    fn conservative(&self) -> bool {
        let known = self.known.as_ref();
        self.chain.ask(|next| next.conservative())
            && known.is_none_or(|known| known.terrains().iter().all(|terrain| terrain.is_sound()))
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
            conflict: "the scene has no terrain with horizons: show a prepared terrain, or the built-in scene terrain".to_owned(),
        })?;
        let candidates = g.in_frustum(view);
        let mut filter = SlotFilter::default();
        let left = g.narrowed(
            view,
            "above the horizons",
            candidates,
            move |table, frame, slots| filter.retain_visible(&known, table, frame, slots),
        );
        g.chain(view, left, self.chain.next_mut())
    }
}

/// All settings are those of the chain: `then`, and what the next strategy has.
impl Tunable for HorizonStrategy {
    fn settings(&self) -> Vec<Setting> {
        self.chain.settings()
    }

    fn set(&mut self, key: &str, value: &Value) -> Result<(), SettingError> {
        self.chain.set("horizon", key, value)
    }

    fn following(&self, size: [u32; 2]) -> Vec<(&'static str, Value)> {
        self.chain.following(size)
    }

    fn steps(&self) -> Vec<Step> {
        self.chain.steps()
    }
}
