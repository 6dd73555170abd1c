//! A scene on the GPU, kept in step with the host's scene.
//!
//! Entities get slots in the instance buffer. Slots of removed entities are reused; an epoch stored with each slot tells results about an
//! earlier occupant from results about the present one.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use antumbra_scene::hierarchy::NONE;
use antumbra_scene::{EntityKey, Environment, ImageKey, MaterialKey, MeshKey, Scene, SceneChanges};
use glam::DAffine3;
use rayon::prelude::*;
use slotmap::SecondaryMap;

use crate::arena::Arena;
use crate::class::{PipelineClass, PipelineTraits};
use crate::detail::MeshDetail;
use crate::device::Gpu;
use crate::environment;
use crate::error::DrawError;
use crate::instance::Instance;
use crate::light::SceneLights;
use crate::material::GpuMaterial;
use crate::mesh::MeshArenas;
use crate::table::{Batch, NewOccupant, SceneTable};
use crate::texture;

/// What the passes of a frame need of a scene: shared handles, cheap to clone.
#[derive(Debug, Clone)]
pub struct SceneFrame {
    /// All drawable entities, by slot.
    pub table: Arc<SceneTable>,
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

/// What a compiled plan depends on. When it changes, plans must be compiled again.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SceneLayout {
    /// Capacity in slots: the size of buffers of counts by slot.
    pub slots: u32,
    /// Capacity in batches: the number of indirect draws.
    pub batches: u32,
    /// Classes in use, as a bit mask by [`PipelineClass::index`].
    pub classes: u128,
    /// Whether any entity is blended.
    pub transparent: bool,
    /// Whether any light is a point or a spot light. Without one, lighting needs no distances.
    pub positional_lights: bool,
    /// Whether the scene has an environment to reflect.
    pub environment: bool,
}

impl SceneLayout {
    /// The classes in use, in drawing order.
    pub fn classes(&self) -> impl Iterator<Item = PipelineClass> + '_ {
        PipelineClass::all().filter(|class| self.classes >> class.index() & 1 != 0)
    }
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
    batch_index: HashMap<Batch, u32>,
    slot_of: SecondaryMap<EntityKey, u32>,
    group_of: SecondaryMap<EntityKey, u32>,
    /// The number of groups above which those of removed entities are removed.
    most_groups: usize,
    free: Vec<u32>,
    classes: u128,
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
        static SCENES: AtomicU64 = AtomicU64::new(0);
        let mut this = Self {
            number: SCENES.fetch_add(1, Ordering::Relaxed),
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
            batch_index: HashMap::new(),
            slot_of: SecondaryMap::new(),
            group_of: SecondaryMap::new(),
            most_groups: usize::MAX,
            free: Vec::new(),
            classes: 0,
        };
        let all = SceneChanges {
            added: scene.drawables().map(|(key, _)| key).collect(),
            ..SceneChanges::default()
        };
        this.apply(scene, &all)?;
        this.most_groups = most_groups(&this.table);
        Ok(this)
    }

    /// Takes over the scene's changes since the last call. Call it once a frame, before drawing.
    ///
    /// # Errors
    /// As for [`Self::new`].
    pub fn sync(&mut self, scene: &mut Scene) -> Result<(), DrawError> {
        let changes = scene.update();
        self.repaint(scene, &changes.images)?;
        let repainted = |environment: Environment| changes.images.contains(&environment.image);
        if changes.environment || scene.environment().is_some_and(repainted) {
            self.environment = environment::bind_group(&self.gpu, scene);
        }
        self.apply(scene, &changes)
    }

    /// The handles that the passes of a frame use.
    pub fn frame(&self) -> SceneFrame {
        let buffers = self.arenas.buffers();
        SceneFrame {
            table: Arc::clone(&self.table),
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

    /// What plans for this scene depend on.
    pub fn layout(&self) -> SceneLayout {
        SceneLayout {
            slots: self.instances.capacity() as u32,
            batches: (self.table.batches().len() as u32).next_power_of_two(),
            classes: self.classes,
            transparent: self.table.has_transparent(),
            positional_lights: self.lights.any_positional(),
            environment: self.environment.is_some(),
        }
    }

    /// An id, unique in this process. Slots and epochs are meaningful only together with it.
    pub fn number(&self) -> u64 {
        self.number
    }

    /// All drawable entities, by slot.
    pub fn table(&self) -> &Arc<SceneTable> {
        &self.table
    }

    /// The slot of an entity; `None` for one that is not drawn.
    pub fn slot(&self, entity: EntityKey) -> Option<u32> {
        self.slot_of.get(entity).copied()
    }

    /// The device.
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    fn apply(&mut self, scene: &Scene, changes: &SceneChanges) -> Result<(), DrawError> {
        // Lights are few, so they are gathered anew each time.
        self.lights = Arc::new(SceneLights::gather(scene));
        let SceneChanges {
            removed,
            added,
            moved,
            reparented,
            ..
        } = changes;
        if [removed, added, moved, reparented]
            .iter()
            .all(|keys| keys.is_empty())
        {
            return Ok(());
        }
        let mut shared = std::mem::take(&mut self.table);
        let table = Arc::make_mut(&mut shared);
        table.clear_changes();
        self.reparent(table, scene, reparented);
        let outcome = self.change(table, scene, removed, added, moved);
        self.clear_groups(table, scene);
        self.table = shared;
        let dirty = outcome?;
        self.upload(dirty)
    }

    /// Applies changed parents.
    fn reparent(&mut self, table: &mut SceneTable, scene: &Scene, reparented: &[EntityKey]) {
        for key in reparented {
            let (group, slot) = (self.group_of.get(*key).copied(), self.slot(*key));
            if group.is_none() && slot.is_none() {
                continue;
            }
            let parent = self.group(table, scene, scene.parent(*key));
            if let Some(group) = group {
                table.groups_mut().move_group(group, parent);
            }
            if let Some(slot) = slot {
                table.groups_mut().move_slot(slot, parent);
            }
        }
    }

    /// The group of the children of `parent`.
    fn group(&mut self, table: &mut SceneTable, scene: &Scene, parent: Option<EntityKey>) -> u32 {
        let mut unknown = Vec::new();
        let mut group = NONE;
        let mut above = parent;
        while let Some(key) = above {
            if let Some(known) = self.group_of.get(key) {
                group = *known;
                break;
            }
            unknown.push(key);
            above = scene.parent(key);
        }
        for key in unknown.into_iter().rev() {
            group = table.groups_mut().add(group);
            self.group_of.insert(key, group);
        }
        group
    }

    /// Numbers the groups anew once most of them belong to removed entities.
    fn clear_groups(&mut self, table: &mut SceneTable, scene: &Scene) {
        if table.groups().parents().len() <= self.most_groups {
            return;
        }
        table.groups_mut().clear();
        self.group_of.clear();
        let occupants: Vec<(u32, EntityKey)> = (table.live_slots())
            .filter_map(|slot| Some((slot, table.occupant(slot)?.key)))
            .collect();
        for (slot, key) in occupants {
            let group = self.group(table, scene, scene.parent(key));
            table.groups_mut().place(slot, group);
        }
        self.most_groups = most_groups(table);
    }

    fn change(
        &mut self,
        table: &mut SceneTable,
        scene: &Scene,
        removed: &[EntityKey],
        added: &[EntityKey],
        moved: &[EntityKey],
    ) -> Result<Vec<u32>, DrawError> {
        table.next_epoch();
        let mut dirty = Vec::with_capacity(added.len() + moved.len());
        // An entity that is removed and added again, with another mesh or material, keeps its slot, so that slots stored elsewhere stay valid.
        let mut left: HashMap<EntityKey, u32> = HashMap::new();
        for key in removed {
            if let Some(slot) = self.slot_of.remove(*key) {
                table.vacate(slot);
                left.insert(*key, slot);
            }
        }
        let mut stay: HashMap<EntityKey, u32> = HashMap::new();
        for key in added {
            if let Some(slot) = left.remove(key) {
                stay.insert(*key, slot);
            }
        }
        self.free
            .extend(removed.iter().filter_map(|key| left.get(key)));
        let deviations = deviations(scene, added, |mesh| self.mesh_index.contains_key(mesh));
        for key in added {
            let (Some(drawable), Some(world)) = (scene.drawable(*key), scene.world(*key)) else {
                continue;
            };
            let (Some(mesh), Some(material)) =
                (scene.mesh(drawable.mesh), scene.material(drawable.material))
            else {
                continue;
            };
            let Some(bounds) = scene.world_bounds(*key) else {
                // The mesh is empty, or the transform is not finite.
                fits(scene, *key, &world)?;
                continue;
            };
            let material_number = self.material(scene, drawable.material)?;
            let texture = match material.base_colour_image {
                Some(image) => self.texture(scene, image)?,
                None => 0,
            };
            let mesh_number = match self.mesh_index.get(drawable.mesh) {
                Some(number) => *number,
                None => {
                    let deviation = deviations.get(&drawable.mesh).copied().unwrap_or(0.0);
                    let ranges = self.arenas.add(&self.gpu, mesh, deviation)?;
                    let number = table.add_mesh(ranges);
                    self.mesh_index.insert(drawable.mesh, number);
                    number
                }
            };
            let instance = instance(scene, *key, &world, material_number)?;
            let topology = mesh
                .levels
                .first()
                .map(|level| level.topology)
                .unwrap_or_default();
            let class = PipelineClass::new(PipelineTraits {
                topology,
                mirrored: world.matrix3.determinant() < 0.0,
                double_sided: material.double_sided,
                alpha: material.alpha,
                textured: texture != 0,
            });
            self.classes |= 1 << class.index() | 1 << class.for_detail(MeshDetail::Box).index();
            let slot = stay
                .remove(key)
                .or_else(|| self.free.pop())
                .unwrap_or(self.host_instances.len() as u32);
            if slot as usize == self.host_instances.len() {
                self.host_instances.push(instance);
            } else {
                self.host_instances[slot as usize] = instance;
            }
            let group = self.group(table, scene, scene.parent(*key));
            table.groups_mut().place(slot, group);
            let entity = NewOccupant {
                key: *key,
                bounds,
                world: &world,
                batch: Batch {
                    class,
                    texture,
                    mesh: mesh_number,
                },
                tested: scene.is_tested(*key),
            };
            table.occupy(slot, entity, &mut self.batch_index);
            self.slot_of.insert(*key, slot);
            dirty.push(slot);
        }
        // Kept slots of entities that cannot be drawn any more.
        self.free
            .extend(added.iter().filter_map(|key| stay.get(key)));
        let mut remirrored = Vec::new();
        for key in moved {
            let (Some(slot), Some(world)) = (self.slot(*key), scene.world(*key)) else {
                continue;
            };
            let Some(bounds) = scene.world_bounds(*key) else {
                fits(scene, *key, &world)?;
                continue;
            };
            if table.class_of(slot).mirrored() != (world.matrix3.determinant() < 0.0) {
                remirrored.push(*key);
                continue;
            }
            let material = self.host_instances[slot as usize].material;
            self.host_instances[slot as usize] = instance(scene, *key, &world, material)?;
            table.move_to(slot, bounds, &world);
            dirty.push(slot);
        }
        table.sort_batches(&mut self.batch_index);
        if !remirrored.is_empty() {
            // The motion has changed the handedness, so the entity needs another pipeline and batch.
            dirty.extend(self.change(table, scene, &remirrored, &remirrored, &[])?);
        }
        Ok(dirty)
    }

    fn material(&mut self, scene: &Scene, key: MaterialKey) -> Result<u32, DrawError> {
        if let Some(number) = self.material_index.get(key) {
            return Ok(*number);
        }
        let material = scene.material(key).cloned().unwrap_or_default();
        let number = self
            .materials
            .append(&self.gpu, &[GpuMaterial::from(&material)])? as u32;
        self.material_index.insert(key, number);
        Ok(number)
    }

    fn texture(&mut self, scene: &Scene, key: ImageKey) -> Result<u32, DrawError> {
        if let Some(number) = self.texture_index.get(key) {
            return Ok(*number);
        }
        let Some(image) = scene.image(key) else {
            return Ok(0);
        };
        let number = self.textures.len();
        let bound = texture::upload(&self.gpu, &self.texture_layout, image, number)?;
        Arc::make_mut(&mut self.textures).push(bound);
        self.texture_index.insert(key, number as u32);
        Ok(number as u32)
    }

    /// Uploads images again that have changed.
    fn repaint(&mut self, scene: &Scene, images: &[ImageKey]) -> Result<(), DrawError> {
        for key in images {
            let (Some(number), Some(image)) = (self.texture_index.get(*key), scene.image(*key))
            else {
                continue;
            };
            let number = *number as usize;
            let bound = texture::upload(&self.gpu, &self.texture_layout, image, number)?;
            if let Some(place) = Arc::make_mut(&mut self.textures).get_mut(number) {
                *place = bound;
            }
        }
        Ok(())
    }

    /// Writes the changed instances, neighbours in one write.
    fn upload(&mut self, mut dirty: Vec<u32>) -> Result<(), DrawError> {
        dirty.sort_unstable();
        dirty.dedup();
        self.instances
            .reserve(&self.gpu, self.host_instances.len() as u64)?;
        let mut rest = dirty.as_slice();
        while let Some(first) = rest.first() {
            // Writing a few unchanged instances in a gap is cheaper than another write.
            let run = rest
                .windows(2)
                .position(|pair| pair[1] - pair[0] > 8)
                .map_or(rest.len(), |at| at + 1);
            let last = rest.get(run - 1).copied().unwrap_or(*first);
            if let Some(changed) = self.host_instances.get(*first as usize..=last as usize) {
                self.instances.write(&self.gpu, u64::from(*first), changed);
            }
            rest = rest.get(run..).unwrap_or_default();
        }
        Ok(())
    }
}

fn instance(
    scene: &Scene,
    key: EntityKey,
    world: &DAffine3,
    material: u32,
) -> Result<Instance, DrawError> {
    fits(scene, key, world)?;
    Ok(Instance::new(world, material))
}

/// The proxy deviations of the meshes of added entities, without those that are `known` already.
fn deviations(
    scene: &Scene,
    added: &[EntityKey],
    known: impl Fn(MeshKey) -> bool,
) -> HashMap<MeshKey, f64> {
    let meshes = added
        .iter()
        .filter_map(|key| Some(scene.drawable(*key)?.mesh));
    let new: HashSet<MeshKey> = meshes.filter(|mesh| !known(*mesh)).collect();
    new.into_par_iter()
        .filter_map(|key| Some((key, scene.mesh(key)?.proxy_hausdorff_distance())))
        .collect()
}

/// Refuses a transform that does not fit 32-bit floats. The error names the entity and the number.
fn fits(scene: &Scene, key: EntityKey, world: &DAffine3) -> Result<(), DrawError> {
    let Some(number) = Instance::misfit(world) else {
        return Ok(());
    };
    let name = scene.entity_name(key);
    let entity = if name.is_empty() {
        format!("{key:?}")
    } else {
        name.to_owned()
    };
    Err(DrawError::Transform { entity, number })
}

/// Twice the present number of groups, and some.
fn most_groups(table: &SceneTable) -> usize {
    table.groups().parents().len() * 2 + 1024
}
