//! A scene on the GPU, kept in step with the host's scene.
//!
//! Entities get slots in the instance buffer. Slots of removed entities are reused; an epoch stored with each slot tells results about an
//! earlier occupant from results about the present one.

mod assets;
mod changes;
mod deform;
mod groups;

use std::collections::{BTreeSet, HashMap};
use std::sync::Arc;

use antumbra_cull::{
    Batch, Gpu, Renderer, SceneFrame, SceneLayout, SceneTable, StageScene, next_scene_number,
};
use antumbra_scene::{EntityKey, Environment, ImageKey, MaterialKey, MeshKey, Scene, SceneChanges};
use slotmap::SecondaryMap;

use crate::arena::{Arena, Upload};
use crate::builtin::BuiltinRenderer;
use crate::environment;
use crate::error::DrawError;
use crate::instance::Instance;
use crate::light::SceneLights;
use crate::material::GpuMaterial;
use crate::mesh::MeshArenas;
use crate::texture;

/// What the built-in renderer's passes read of a scene: shared handles, cheap to clone.
#[derive(Debug, Clone)]
pub struct SceneBuffers {
    /// Vertex positions.
    pub positions: wgpu::Buffer,
    /// Other vertex attributes.
    pub attributes: wgpu::Buffer,
    /// Indices.
    pub indices: wgpu::Buffer,
    /// [`Instance`]s by slot.
    pub instances: wgpu::Buffer,
    /// Materials.
    pub materials: wgpu::Buffer,
    /// Bind groups of the base-colour textures.
    pub textures: Arc<Vec<wgpu::BindGroup>>,
    /// The lights.
    pub lights: Arc<SceneLights>,
    /// The bind group of the environment that surfaces reflect.
    pub environment: Option<wgpu::BindGroup>,
}

/// A scene's drawable entities on one device.
#[derive(Debug)]
pub struct GpuScene {
    number: u64,
    gpu: Gpu,
    table: Arc<SceneTable>,
    arenas: MeshArenas,
    instances: Arena<Instance>,
    host_instances: Vec<Instance>,
    materials: Arena<GpuMaterial>,
    textures: Arc<Vec<wgpu::BindGroup>>,
    texture_layout: wgpu::BindGroupLayout,
    lights: Arc<SceneLights>,
    environment: Option<wgpu::BindGroup>,
    mesh_index: SecondaryMap<MeshKey, u32>,
    material_index: SecondaryMap<MaterialKey, u32>,
    texture_index: SecondaryMap<ImageKey, u32>,
    /// Bytes of images that were written and not submitted.
    unsubmitted: u64,
    batch_index: HashMap<Batch, u32>,
    slot_of: SecondaryMap<EntityKey, u32>,
    group_of: SecondaryMap<EntityKey, u32>,
    /// The number of groups above which those of removed entities are removed.
    max_groups: usize,
    free: Vec<u32>,
    classes: u128,
    /// Meshes whose vertices were written anew.
    rewritten: BTreeSet<MeshKey>,
    /// Staging memory of [`Self::sync_in`].
    belt: Option<wgpu::util::StagingBelt>,
}

/// Bytes of a chunk of the staging belt: 4,096 instances.
const BELT_CHUNK: u64 = 256 * 1024;

/// Entities whose drawable data has changed.
#[derive(Clone, Copy)]
struct EntityChanges<'a> {
    removed: &'a [EntityKey],
    added: &'a [EntityKey],
    moved: &'a [EntityKey],
}

impl GpuScene {
    /// Uploads a scene. Calls [`Scene::update`]; from then on this must be the only consumer of the scene's changes.
    ///
    /// # Errors
    /// [`DrawError`] where the scene does not fit the device, or a transform does not fit 32-bit floats.
    pub fn new(gpu: &Gpu, scene: &mut Scene) -> Result<Self, DrawError> {
        scene.update();
        let layout = gpu
            .device
            .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some("base colour"),
                entries: &antumbra_shaders::jobs::shaded::JOB.layout_entries(2),
            });
        let white = texture::upload(gpu, &layout, &texture::white(), 0)?;
        let mut this = Self {
            number: next_scene_number(),
            gpu: gpu.clone(),
            table: Arc::default(),
            arenas: MeshArenas::new(gpu)?,
            instances: Arena::new(gpu, "instances", wgpu::BufferUsages::STORAGE, 1)?,
            host_instances: Vec::new(),
            materials: Arena::new(gpu, "materials", wgpu::BufferUsages::STORAGE, 1)?,
            textures: Arc::new(vec![white]),
            texture_layout: layout,
            lights: Arc::default(),
            environment: environment::bind_group(gpu, scene),
            mesh_index: SecondaryMap::new(),
            material_index: SecondaryMap::new(),
            texture_index: SecondaryMap::new(),
            unsubmitted: 0,
            batch_index: HashMap::new(),
            slot_of: SecondaryMap::new(),
            group_of: SecondaryMap::new(),
            max_groups: usize::MAX,
            free: Vec::new(),
            classes: 0,
            rewritten: BTreeSet::new(),
            belt: None,
        };
        let all = SceneChanges {
            added: scene.drawables().map(|(key, _)| key).collect(),
            ..SceneChanges::default()
        };
        this.apply(scene, &all, Upload::AtOnce)?;
        this.max_groups = max_groups(&this.table);
        Ok(this)
    }

    /// Takes over the scene's changes since the last call. Call it once a frame, before drawing.
    ///
    /// # Errors
    /// As for [`Self::new`].
    pub fn sync(&mut self, scene: &mut Scene) -> Result<(), DrawError> {
        self.take_over(scene, Upload::AtOnce)
    }

    /// The same for a host that records several frames before it submits the first. The transforms are written by `encoder`, where the frame that
    /// is about to be recorded finds them; frames in encoders that were recorded before keep theirs. Submit the encoders in the order in which they were recorded.
    ///
    /// # Errors
    /// As for [`Self::new`].
    pub fn sync_in(
        &mut self,
        scene: &mut Scene,
        encoder: &mut wgpu::CommandEncoder,
    ) -> Result<(), DrawError> {
        let device = &self.gpu.device;
        let belt = self.belt.take();
        let mut belt =
            belt.unwrap_or_else(|| wgpu::util::StagingBelt::new(device.clone(), BELT_CHUNK));
        let outcome = self.take_over(
            scene,
            Upload::Recorded {
                encoder: &mut *encoder,
                belt: &mut belt,
            },
        );
        belt.finish_and_recall_on_submit(&*encoder);
        self.belt = Some(belt);
        outcome
    }

    fn take_over(&mut self, scene: &mut Scene, upload: Upload<'_>) -> Result<(), DrawError> {
        let changes = scene.update();
        self.repaint(scene, &changes.images)?;
        let repainted = |environment: Environment| changes.images.contains(&environment.image);
        if changes.environment || scene.environment().is_some_and(repainted) {
            self.environment = environment::bind_group(&self.gpu, scene);
        }
        self.apply(scene, &changes, upload)
    }

    /// What the built-in renderer's passes read.
    pub fn buffers(&self) -> SceneBuffers {
        let buffers = self.arenas.buffers();
        SceneBuffers {
            positions: buffers.positions.clone(),
            attributes: buffers.attributes.clone(),
            indices: buffers.indices.clone(),
            instances: self.instances.buffer().clone(),
            materials: self.materials.buffer().clone(),
            textures: Arc::clone(&self.textures),
            lights: Arc::clone(&self.lights),
            environment: self.environment.clone(),
        }
    }

    /// The device.
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// All drawable entities, by slot.
    pub fn table(&self) -> &Arc<SceneTable> {
        &self.table
    }

    /// The slot of an entity; `None` for one that is not drawn.
    pub fn slot(&self, entity: EntityKey) -> Option<u32> {
        self.slot_of.get(entity).copied()
    }

    fn apply(
        &mut self,
        scene: &Scene,
        changes: &SceneChanges,
        mut upload: Upload<'_>,
    ) -> Result<(), DrawError> {
        // Lights are few, so they are gathered anew each time.
        self.lights = Arc::new(SceneLights::gather(scene));
        let SceneChanges {
            removed,
            added,
            moved,
            reparented,
            deformed,
            ..
        } = changes;
        let is_same = [removed, added, moved, reparented]
            .iter()
            .all(|keys| keys.is_empty());
        if is_same && deformed.is_empty() {
            return Ok(());
        }
        let mut shared = std::mem::take(&mut self.table);
        let table = Arc::make_mut(&mut shared);
        table.clear_changes();
        self.reparent(table, scene, reparented);
        let entities = EntityChanges {
            removed,
            added,
            moved,
        };
        let room = self.arenas.vertex_capacity();
        // Before entities move: their boxes are those of the new vertices.
        self.deform(table, scene, deformed, &mut upload);
        let outcome = self.change(table, scene, entities);
        self.arenas.flush(&self.gpu);
        if matches!(upload, Upload::Recorded { .. }) && self.arenas.vertex_capacity() != room {
            // What encoders that are not submitted yet will write into the old buffers is not in the copies.
            let rewritten: Vec<MeshKey> = self.rewritten.iter().copied().collect();
            self.deform(table, scene, &rewritten, &mut upload);
        }
        self.materials.flush(&self.gpu);
        self.clear_groups(table, scene);
        self.table = shared;
        let dirty = outcome?;
        self.upload(dirty, upload)
    }
}

impl StageScene for GpuScene {
    fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    fn number(&self) -> u64 {
        self.number
    }

    fn table(&self) -> &Arc<SceneTable> {
        &self.table
    }

    fn layout(&self) -> SceneLayout {
        SceneLayout {
            slots: self.instances.capacity() as u32,
            batches: (self.table.batches().len() as u32).next_power_of_two(),
            part_boxes: (self.table.part_boxes().len() as u32).next_power_of_two(),
            classes: self.classes,
            transparent: self.table.has_transparent(),
            positional_lights: self.lights.any_positional(),
            environment: self.environment.is_some(),
        }
    }

    fn frame(&self) -> SceneFrame {
        SceneFrame::new(Arc::clone(&self.table), Arc::new(self.buffers()))
    }

    fn renderer(&self) -> Box<dyn Renderer> {
        Box::new(BuiltinRenderer::new(&self.gpu))
    }
}

/// The number of groups above which they are numbered anew: twice the present number, and some.
fn max_groups(table: &SceneTable) -> usize {
    table.groups().parents().len() * 2 + 1024
}
