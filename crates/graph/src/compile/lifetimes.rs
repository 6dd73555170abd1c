//! Assigns wgpu objects to resources. Transient resources whose lifetimes do not overlap share an object: textures of the same description,
//! buffers of the same power of two.

use crate::compile::order::Step;
use crate::compile::versions::Versions;
use crate::graph::Graph;
use crate::physical::{NOWHERE, Placed};
use crate::resource::{Kind, TextureDesc};
use crate::store::Store;

/// A texture to be created.
pub(crate) struct TexturePlan {
    pub desc: TextureDesc,
    pub usages: wgpu::TextureUsages,
    pub label: String,
    /// The first step after its last use; `usize::MAX` for one that is not shared.
    free_from: usize,
}

/// A buffer to be created.
pub(crate) struct BufferPlan {
    pub size: u64,
    pub usages: wgpu::BufferUsages,
    pub label: String,
    /// The first step after its last use; `usize::MAX` for one that is not shared.
    free_from: usize,
}

impl BufferPlan {
    pub fn create(&self, device: &wgpu::Device) -> wgpu::Buffer {
        device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(&self.label),
            size: self.size,
            usage: self.usages,
            mapped_at_creation: false,
        })
    }
}

/// The objects of all resources.
pub(crate) struct Layout {
    pub placed: Vec<Placed>,
    /// `None` for an import; likewise below.
    pub textures: Vec<Option<TexturePlan>>,
    pub buffers: Vec<Option<BufferPlan>>,
}

/// A resource's lifetime and usages.
struct Life {
    /// First step that uses it.
    first: usize,
    /// Last step that uses it.
    last: usize,
    texture_usages: wgpu::TextureUsages,
    buffer_usages: wgpu::BufferUsages,
}

/// By resource: whether its contents are read after its last use in the schedule: at the end of the frame or in the next one.
pub(crate) fn persistent(graph: &Graph, versions: &Versions, kept: &[bool]) -> Vec<bool> {
    let any = |passes: &[usize]| passes.iter().any(|&pass| kept[pass]);
    let mut persistent: Vec<bool> = (0..graph.resources.len())
        .map(|resource| {
            any(&versions.previous_readers[resource])
                || any(&versions.updaters[resource])
                || any(&versions.late[resource])
        })
        .collect();
    for output in &graph.outputs {
        persistent[output.resource()] = true;
    }
    persistent
}

/// Assigns objects to all resources, and places in the store to host values.
pub(crate) fn place(
    graph: &Graph,
    versions: &Versions,
    kept: &[bool],
    steps: &[Step],
    persistent: &[bool],
    store: &mut Store,
) -> Layout {
    let lives = lives(graph, kept, steps);
    let mut layout = Layout {
        placed: graph
            .resources
            .iter()
            .enumerate()
            .map(|(index, resource)| placed(graph, versions, kept, index, resource, &lives[index]))
            .collect(),
        textures: Vec::new(),
        buffers: Vec::new(),
    };
    let mut by_birth: Vec<usize> = (0..graph.resources.len()).collect();
    by_birth.sort_by_key(|&index| (lives[index].as_ref().map(|life| life.first), index));
    for index in by_birth {
        let Some(life) = &lives[index] else {
            // Unused host imports still get a place, so that setting them is no error.
            if let Kind::Host(host) = graph.resources[index].kind {
                layout.placed[index].slots = [store.add(host); 2];
            }
            if graph.resources[index].import {
                layout.place_import(index);
            }
            continue;
        };
        if let Kind::Host(host) = graph.resources[index].kind {
            let first = store.add(host);
            let second = if versions.is_double(index, kept) {
                store.add(host)
            } else {
                first
            };
            layout.placed[index].slots = [first, second];
        } else if graph.resources[index].import {
            layout.place_import(index);
        } else {
            let first = match persistent[index] {
                true => layout.own_object(index, life),
                false => layout.shared_object(index, life),
            };
            let second = if versions.is_double(index, kept) {
                layout.own_object(index, life)
            } else {
                first
            };
            layout.placed[index].slots = [first, second];
        }
    }
    layout
}

impl Layout {
    /// Adds a usage to a texture and to its objects.
    pub fn add_texture_usage(&mut self, resource: usize, usage: wgpu::TextureUsages) {
        let placed = &mut self.placed[resource];
        placed.texture_usages |= usage;
        for slot in placed.slots {
            if let Some(Some(plan)) = self.textures.get_mut(slot as usize) {
                plan.usages |= usage;
            }
        }
    }

    fn place_import(&mut self, index: usize) {
        let slot = match self.placed[index].resource.kind {
            Kind::Texture(_) => {
                self.textures.push(None);
                self.textures.len() - 1
            }
            Kind::Buffer(_) => {
                self.buffers.push(None);
                self.buffers.len() - 1
            }
            Kind::Host(_) => return,
        };
        self.placed[index].slots = [slot as u32; 2];
    }

    /// An object of a resource's own.
    fn own_object(&mut self, index: usize, life: &Life) -> u32 {
        self.object(index, life, false)
    }

    /// An object that a resource may share with others: a free one that fits, or a new one.
    fn shared_object(&mut self, index: usize, life: &Life) -> u32 {
        self.object(index, life, true)
    }

    fn object(&mut self, index: usize, life: &Life, shared: bool) -> u32 {
        let placed = &self.placed[index];
        let free_from = if shared { life.last + 1 } else { usize::MAX };
        match placed.resource.kind {
            Kind::Texture(desc) => {
                let found = self.textures.iter_mut().enumerate().find_map(|(n, plan)| {
                    let plan = plan.as_mut()?;
                    (shared && plan.free_from <= life.first && plan.desc.same_object(&desc))
                        .then_some((n, plan))
                });
                if let Some((n, plan)) = found {
                    plan.free_from = free_from;
                    plan.usages |= placed.texture_usages;
                    join(&mut plan.label, &placed.resource.name);
                    return n as u32;
                }
                self.textures.push(Some(TexturePlan {
                    desc,
                    usages: placed.texture_usages,
                    label: placed.resource.name.clone(),
                    free_from,
                }));
                (self.textures.len() - 1) as u32
            }
            Kind::Buffer(desc) => {
                let size = desc.rounded();
                let found = self.buffers.iter_mut().enumerate().find_map(|(n, plan)| {
                    let plan = plan.as_mut()?;
                    (shared
                        && plan.free_from <= life.first
                        && plan.size.ilog2() == size.max(1).ilog2()
                        && is_index(plan.usages) == is_index(placed.buffer_usages))
                    .then_some((n, plan))
                });
                if let Some((n, plan)) = found {
                    plan.free_from = free_from;
                    plan.size = plan.size.max(size);
                    plan.usages |= placed.buffer_usages;
                    join(&mut plan.label, &placed.resource.name);
                    return n as u32;
                }
                self.buffers.push(Some(BufferPlan {
                    size,
                    usages: placed.buffer_usages,
                    label: placed.resource.name.clone(),
                    free_from,
                }));
                (self.buffers.len() - 1) as u32
            }
            Kind::Host(_) => NOWHERE,
        }
    }
}

/// GL allows no other usage for index buffers.
fn is_index(usages: wgpu::BufferUsages) -> bool {
    usages.contains(wgpu::BufferUsages::INDEX)
}

fn join(label: &mut String, name: &str) {
    label.push_str(" / ");
    label.push_str(name);
}

fn placed(
    graph: &Graph,
    versions: &Versions,
    kept: &[bool],
    index: usize,
    resource: &crate::resource::Resource,
    life: &Option<Life>,
) -> Placed {
    let output = graph
        .outputs
        .iter()
        .any(|output| output.resource() == index);
    let mut texture_usages = wgpu::TextureUsages::empty();
    let mut buffer_usages = wgpu::BufferUsages::empty();
    if let Some(life) = life {
        texture_usages = life.texture_usages;
        buffer_usages = life.buffer_usages;
    }
    if let Kind::Buffer(desc) = resource.kind {
        if desc.zeroed {
            buffer_usages |= wgpu::BufferUsages::COPY_DST;
        }
        if output {
            buffer_usages |= wgpu::BufferUsages::COPY_SRC;
        }
        for (_, usages) in graph.output_usages.iter().filter(|(of, _)| *of == index) {
            buffer_usages |= *usages;
        }
    }
    let any = |passes: &[usize]| passes.iter().any(|&pass| kept[pass]);
    Placed {
        resource: resource.clone(),
        slots: [NOWHERE; 2],
        texture_usages,
        buffer_usages,
        used: life.is_some(),
        output,
        history: !resource.import
            && (any(&versions.previous_readers[index]) || any(&versions.updaters[index])),
    }
}

/// By resource: its lifetime in steps, where a loop is one step, and its usages.
fn lives(graph: &Graph, kept: &[bool], steps: &[Step]) -> Vec<Option<Life>> {
    let mut at = vec![0; graph.passes.len()];
    for (position, step) in steps.iter().enumerate() {
        Step::each(std::slice::from_ref(step), &mut |pass, _| {
            at[pass] = position;
        });
    }
    let mut lives: Vec<Option<Life>> = (0..graph.resources.len()).map(|_| None).collect();
    for (index, pass) in graph.passes.iter().enumerate() {
        if !kept[index] {
            continue;
        }
        for used in &pass.uses {
            let life = lives[used.resource()].get_or_insert(Life {
                first: at[index],
                last: at[index],
                texture_usages: wgpu::TextureUsages::empty(),
                buffer_usages: wgpu::BufferUsages::empty(),
            });
            life.first = life.first.min(at[index]);
            life.last = life.last.max(at[index]);
            life.texture_usages |= used.access.texture_usages();
            life.buffer_usages |= used.access.buffer_usages();
        }
    }
    lives
}
