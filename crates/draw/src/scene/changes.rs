//! Applies the changes of a scene's entities to its GPU side.

use std::collections::{HashMap, HashSet};

use antumbra_scene::{EntityKey, MeshKey, PartBoxes, Scene};
use glam::DAffine3;
use rayon::prelude::*;

use super::{EntityChanges, GpuScene};
use crate::arena::Upload;
use crate::error::DrawError;
use crate::instance::Instance;
use crate::mesh::LastingShape;
use antumbra_cull::{
    Batch, GpuPartBox, MeshDetail, NewOccupant, PipelineClass, PipelineTraits, SceneTable,
};

/// An added entity that is drawn.
struct DrawnEntity {
    instance: Instance,
    occupant: NewOccupant,
}

impl GpuScene {
    /// Applies removed, added and moved entities. Returns the slots whose instances have changed.
    pub(super) fn change(
        &mut self,
        table: &mut SceneTable,
        scene: &Scene,
        changes: EntityChanges<'_>,
    ) -> Result<Vec<u32>, DrawError> {
        table.next_epoch();
        let EntityChanges {
            removed,
            added,
            moved,
        } = changes;
        let mut dirty = Vec::with_capacity(added.len() + moved.len());
        let mut kept_slots = self.remove(table, removed, added);
        let new = new_meshes(scene, added, |mesh| self.mesh_index.contains_key(mesh));
        let meshes = new.iter().filter_map(|key| scene.mesh(*key));
        self.arenas.reserve(&self.gpu, meshes)?;
        self.host_instances.reserve(added.len());
        table.reserve(added.len(), new.len());
        let mut new = look_into(scene, new);
        for key in added {
            let Some(drawn) = self.drawn(table, scene, *key, &mut new)? else {
                continue;
            };
            let slot = kept_slots
                .remove(key)
                .or_else(|| self.free.pop())
                .unwrap_or(self.host_instances.len() as u32);
            if slot as usize == self.host_instances.len() {
                self.host_instances.push(drawn.instance);
            } else {
                self.host_instances[slot as usize] = drawn.instance;
            }
            let group = self.group(table, scene, scene.parent(*key));
            table.groups_mut().place(slot, group);
            table.occupy(slot, drawn.occupant, &mut self.batch_index);
            self.slot_of.insert(*key, slot);
            dirty.push(slot);
        }
        // Kept slots of entities that cannot be drawn any more.
        self.free
            .extend(added.iter().filter_map(|key| kept_slots.get(key)));
        let mut remirrored = Vec::new();
        for key in moved {
            let (Some(slot), Some(world)) = (self.slot(*key), scene.world(*key)) else {
                continue;
            };
            let Some(bounds) = scene.world_bounds(*key) else {
                fits(scene, *key, &world)?;
                continue;
            };
            if table.class_of(slot).mirrored() != mirrors(&world) {
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
            let again = EntityChanges {
                removed: &remirrored,
                added: &remirrored,
                moved: &[],
            };
            dirty.extend(self.change(table, scene, again)?);
        }
        Ok(dirty)
    }

    /// Frees the slots of removed entities. An entity that is removed and added again, with another mesh or material, keeps its slot, so that
    /// slots stored elsewhere stay valid; these slots are returned.
    fn remove(
        &mut self,
        table: &mut SceneTable,
        removed: &[EntityKey],
        added: &[EntityKey],
    ) -> HashMap<EntityKey, u32> {
        let mut left: HashMap<EntityKey, u32> = HashMap::new();
        for key in removed {
            if let Some(slot) = self.slot_of.remove(*key) {
                table.vacate(slot);
                left.insert(*key, slot);
            }
        }
        let kept = added.iter();
        let kept = kept
            .filter_map(|key| Some((*key, left.remove(key)?)))
            .collect();
        self.free
            .extend(removed.iter().filter_map(|key| left.get(key)));
        kept
    }

    /// Uploads what an added entity needs and describes it for the table; `None` for one that is not drawn.
    fn drawn(
        &mut self,
        table: &mut SceneTable,
        scene: &Scene,
        key: EntityKey,
        new: &mut HashMap<MeshKey, NewMesh>,
    ) -> Result<Option<DrawnEntity>, DrawError> {
        let (Some(drawable), Some(world)) = (scene.drawable(key), scene.world(key)) else {
            return Ok(None);
        };
        let (Some(mesh), Some(material)) =
            (scene.mesh(drawable.mesh), scene.material(drawable.material))
        else {
            return Ok(None);
        };
        let Some(bounds) = scene.world_bounds(key) else {
            // The mesh is empty, or the transform is not finite.
            fits(scene, key, &world)?;
            return Ok(None);
        };
        let material_number = self.material(scene, drawable.material)?;
        let texture = match material.base_colour_image {
            Some(image) => self.texture(scene, image)?,
            None => 0,
        };
        let mesh_number = match self.mesh_index.get(drawable.mesh) {
            Some(number) => *number,
            None => {
                let NewMesh { deviation, parts } = new.remove(&drawable.mesh).unwrap_or_default();
                let lasting = match scene.deforms(drawable.mesh) {
                    true => LastingShape::Deforming,
                    false => LastingShape::Rigid { deviation },
                };
                let ranges = self.arenas.add(&self.gpu, mesh, lasting)?;
                let number = table.add_mesh(ranges, &parts);
                self.mesh_index.insert(drawable.mesh, number);
                number
            }
        };
        let instance = instance(scene, key, &world, material_number)?;
        let topology = mesh
            .levels
            .first()
            .map(|level| level.topology)
            .unwrap_or_default();
        let class = PipelineClass::new(PipelineTraits {
            topology,
            mirrored: mirrors(&world),
            double_sided: material.double_sided,
            alpha: material.alpha,
            textured: texture != 0,
        });
        self.classes |= 1 << class.index() | 1 << class.for_detail(MeshDetail::Box).index();
        Ok(Some(DrawnEntity {
            instance,
            occupant: NewOccupant {
                key,
                bounds,
                world,
                batch: Batch {
                    class,
                    texture,
                    mesh: mesh_number,
                },
                tested: scene.is_tested(key),
            },
        }))
    }

    /// Writes the changed instances, neighbours in one write.
    pub(super) fn upload(
        &mut self,
        mut dirty: Vec<u32>,
        mut upload: Upload<'_>,
    ) -> Result<(), DrawError> {
        let before = self.instances.capacity();
        self.instances
            .reserve(&self.gpu, self.host_instances.len() as u64)?;
        if matches!(upload, Upload::Recorded { .. }) && self.instances.capacity() != before {
            // What encoders that are not submitted yet will write into the old buffer is not in the copy.
            dirty = (0..self.host_instances.len() as u32).collect();
        }
        dirty.sort_unstable();
        dirty.dedup();
        let mut rest = dirty.as_slice();
        while let Some(first) = rest.first() {
            // Writing a few unchanged instances in a gap is cheaper than another write.
            let run = rest
                .windows(2)
                .position(|pair| pair[1] - pair[0] > 8)
                .map_or(rest.len(), |at| at + 1);
            let last = rest.get(run - 1).copied().unwrap_or(*first);
            if let Some(changed) = self.host_instances.get(*first as usize..=last as usize) {
                let first = u64::from(*first);
                (self.instances).write_by(&self.gpu, &mut upload, first, changed);
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

/// Whether a transform mirrors, so that front faces are clockwise.
fn mirrors(world: &DAffine3) -> bool {
    world.matrix3.determinant() < 0.0
}

/// The meshes of added entities, without those that are `known` already.
fn new_meshes(
    scene: &Scene,
    added: &[EntityKey],
    known: impl Fn(MeshKey) -> bool,
) -> HashSet<MeshKey> {
    let meshes = added
        .iter()
        .filter_map(|key| Some(scene.drawable(*key)?.mesh));
    meshes.filter(|mesh| !known(*mesh)).collect()
}

/// What takes time to find out about a mesh.
#[derive(Debug, Default)]
struct NewMesh {
    /// By how much its proxy deviates from it.
    deviation: f64,
    parts: PartBoxes,
}

/// Looks into meshes side by side; those without anything to keep are left out, and so are those that deform, of which nothing stays true.
fn look_into(scene: &Scene, meshes: HashSet<MeshKey>) -> HashMap<MeshKey, NewMesh> {
    let looked = meshes.into_par_iter().filter_map(|key| {
        if scene.deforms(key) {
            return None;
        }
        let mesh = scene.mesh(key)?;
        let bounds = mesh.bounds()?;
        let found = NewMesh {
            deviation: mesh.proxy_hausdorff_distance(),
            parts: PartBoxes::new(mesh, &bounds, GpuPartBox::MOST),
        };
        Some((key, found))
    });
    looked
        .filter(|(_, found)| found.deviation > 0.0 || !found.parts.boxes.is_empty())
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
