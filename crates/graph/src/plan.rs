//! The compiled plan: binding and setting imports before a frame, reading outputs after it, and inspecting the plan itself.

use std::cell::RefCell;

use crate::bind::BindCache;
use crate::body::Body;
use crate::compile::flow::Prepared;
use crate::compile::lifetimes::Layout;
use crate::compile::made::Compiled;
use crate::compile::order::Step;
use crate::error::ExecuteError;
use crate::graph::Graph;
use crate::handle::{Buffer, Handle, Host, Raw, Texture};
use crate::options::{CompileOptions, LateResults, Mode};
use crate::pass::{Pass, PassKind};
use crate::physical::{Physical, PhysicalTexture};
use crate::queries::QuerySets;
use crate::read_back::{AnyRing, RingDecl};
use crate::resource::Kind;
use crate::store::Store;
use crate::sync::Staging;
use crate::timing::{Timing, Timings};

/// A compiled graph: checked, ordered, with its resources. Each frame: bind and set the imports, then
/// [`execute`](Plan::execute) or [`record`](Plan::record), then read the outputs.
pub struct Plan {
    pub(crate) name: String,
    pub(crate) graph: u32,
    pub(crate) mode: Mode,
    pub(crate) passes: Vec<Pass>,
    pub(crate) bodies: Vec<Body>,
    pub(crate) caches: Vec<RefCell<BindCache>>,
    pub(crate) steps: Vec<Step>,
    pub(crate) prepared: Vec<Prepared>,
    pub(crate) kept: Vec<bool>,
    pub(crate) layout: Layout,
    pub(crate) physical: Physical,
    pub(crate) store: Store,
    pub(crate) staging: Vec<Staging>,
    pub(crate) ring_decls: Vec<RingDecl>,
    pub(crate) rings: Vec<Box<dyn AnyRing>>,
    pub(crate) ring_places: Vec<Option<usize>>,
    /// Results of fewer frames ago are not given to nodes; 0: any that has arrived is.
    pub(crate) least_age: u32,
    pub(crate) query_sets: QuerySets,
    pub(crate) belt: wgpu::util::StagingBelt,
    pub(crate) timing: Timing,
    pub(crate) read_only_depth: bool,
    pub(crate) frame: u64,
    pub(crate) has_previous: bool,
}

/// What a plan tells about one of its passes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PassInfo<'a> {
    /// Its name.
    pub name: &'a str,
    /// Its kind.
    pub kind: PassKind,
    /// Its timing group.
    pub group: Option<&'static str>,
    /// The number of host loops around it.
    pub depth: usize,
}

/// The sync points of one host loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LoopSyncPoints<'a> {
    /// The loop's name.
    pub name: &'a str,
    /// Sync points of each iteration; those of loops inside are not counted.
    pub sync_points: usize,
}

/// The memory of a plan's resources in bytes, as wgpu estimates it. Imports are not counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Memory {
    /// Textures after reuse.
    pub textures: u64,
    /// Buffers after reuse.
    pub buffers: u64,
    /// Staging buffers of read-backs.
    pub staging: u64,
    /// Saved by reuse: textures and buffers would need so much more without it.
    pub saved: u64,
}

/// Bytes of a chunk of the upload belt.
const BELT_CHUNK: u64 = 256 * 1024;

impl Plan {
    pub(crate) fn assemble(graph: Graph, options: &CompileOptions<'_>, compiled: Compiled) -> Self {
        let count = graph.passes.len();
        Self {
            name: graph.name,
            graph: graph.id,
            mode: options.mode,
            passes: graph.passes,
            bodies: graph.bodies,
            caches: (0..count).map(|_| RefCell::default()).collect(),
            steps: compiled.steps,
            prepared: compiled.prepared,
            kept: compiled.kept,
            layout: compiled.layout,
            physical: compiled.made.physical,
            store: compiled.store,
            staging: compiled.made.staging,
            ring_decls: graph.rings,
            rings: compiled.made.rings,
            ring_places: compiled.made.ring_places,
            least_age: match options.late_results {
                LateResults::Newest => 0,
                LateResults::OfFramesInFlight => options.frames_in_flight.max(1),
            },
            query_sets: QuerySets::new(count),
            belt: wgpu::util::StagingBelt::new(options.device.clone(), BELT_CHUNK),
            timing: Timing::new(options.timing),
            read_only_depth: compiled.read_only_depth,
            frame: 0,
            has_previous: false,
        }
    }

    /// The graph's name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The number of the next frame. A frame that fails does not count.
    #[must_use]
    pub fn frame(&self) -> u64 {
        self.frame
    }

    /// Sets an imported host value for the next frame. It is dropped at the end of that frame.
    ///
    /// # Errors
    /// The handle is no host import of this graph.
    pub fn set<T: 'static>(&mut self, value: Host<T>, to: T) -> Result<(), ExecuteError> {
        let slot = self.import("Plan::set", value)?;
        if self.store.set(slot, to) {
            Ok(())
        } else {
            Err(self.no_import("Plan::set"))
        }
    }

    /// Binds an imported texture for the next frame and releases it at the end of that frame. `view` is a view of all of `object`.
    ///
    /// # Errors
    /// The handle is no import of this graph, or the texture does not fit the declaration or lacks a usage the passes need.
    pub fn bind_texture(
        &mut self,
        texture: Texture,
        view: &wgpu::TextureView,
        object: &wgpu::Texture,
    ) -> Result<(), ExecuteError> {
        let slot = self.import("Plan::bind_texture", texture)?;
        let placed = &self.layout.placed[texture.0.resource()];
        let Kind::Texture(desc) = placed.resource.kind else {
            return Err(self.no_import("Plan::bind_texture"));
        };
        let why = if object.format() != desc.format {
            Some(format!(
                "its format is {:?}, not {:?}",
                object.format(),
                desc.format
            ))
        } else if (object.width(), object.height()) != (desc.width, desc.height) {
            Some(format!(
                "it is {}x{}, not {}x{}; compile the graph for the new size",
                object.width(),
                object.height(),
                desc.width,
                desc.height
            ))
        } else if object.depth_or_array_layers() != desc.layers
            || object.mip_level_count() != desc.mips
            || object.sample_count() != desc.samples
        {
            Some(String::from("its layers, mips or samples differ"))
        } else if !object.usage().contains(placed.texture_usages) {
            let missing = placed.texture_usages - object.usage();
            Some(format!("it lacks the usage {missing:?}"))
        } else {
            None
        };
        if let Some(why) = why {
            return Err(ExecuteError::BadBinding {
                resource: placed.resource.name.clone(),
                why,
            });
        }
        self.physical.textures[slot as usize] = Some(PhysicalTexture::from_parts(
            object.clone(),
            view.clone(),
            desc,
        ));
        Ok(())
    }

    /// Binds an imported buffer. It stays bound until another one is bound.
    ///
    /// # Errors
    /// The handle is no import of this graph, or the buffer is too small or lacks a usage the passes need.
    pub fn bind_buffer(
        &mut self,
        buffer: Buffer,
        object: &wgpu::Buffer,
    ) -> Result<(), ExecuteError> {
        let slot = self.import("Plan::bind_buffer", buffer)?;
        let placed = &self.layout.placed[buffer.0.resource()];
        let Kind::Buffer(desc) = placed.resource.kind else {
            return Err(self.no_import("Plan::bind_buffer"));
        };
        let why = if object.size() < desc.size {
            Some(format!("it has {} bytes, not {}", object.size(), desc.size))
        } else if !object.usage().contains(placed.buffer_usages) {
            let missing = placed.buffer_usages - object.usage();
            Some(format!("it lacks the usage {missing:?}"))
        } else {
            None
        };
        if let Some(why) = why {
            return Err(ExecuteError::BadBinding {
                resource: placed.resource.name.clone(),
                why,
            });
        }
        self.physical.buffers[slot as usize] = Some(object.clone());
        Ok(())
    }

    /// An output host value of the last finished frame.
    #[must_use]
    pub fn get<T: 'static>(&self, value: Host<T>) -> Option<&T> {
        self.store.rest(self.output_slot(value.raw)?)
    }

    /// An output buffer of the last finished frame, usable as a copy source. It may be larger than declared.
    #[must_use]
    pub fn buffer(&self, buffer: Buffer) -> Option<&wgpu::Buffer> {
        self.physical.buffer(self.output_slot(buffer.0)?)
    }

    /// An output texture of the last finished frame, usable as a copy source and for sampling, where its format allows.
    #[must_use]
    pub fn texture(&self, texture: Texture) -> Option<&wgpu::Texture> {
        Some(&self.physical.texture(self.output_slot(texture.0)?)?.texture)
    }

    /// Goes on from another plan, between frames: takes over the host values that outlive a frame (those that a node updates or reads of the last frame), where name and
    /// type are the same, and the number of the next frame. For a graph that was declared anew because a size has changed: what its nodes know on the host stays
    /// true. Last frame's textures and buffers, and read-backs under way, are not taken over. `from` is left with what this plan had.
    pub fn inherit(&mut self, from: &mut Self) {
        for placed in &self.layout.placed {
            let own = &placed.resource;
            if !placed.history || own.import || !matches!(own.kind, Kind::Host(_)) {
                continue;
            }
            let theirs = from.layout.placed.iter().find(|theirs| {
                let other = &theirs.resource;
                theirs.history && !other.import && other.name == own.name
            });
            let Some(theirs) =
                theirs.filter(|theirs| matches!(theirs.resource.kind, Kind::Host(_)))
            else {
                continue;
            };
            let double = |slots: [u32; 2]| slots[0] != slots[1];
            if double(placed.slots) != double(theirs.slots) {
                continue;
            }
            self.store
                .swap(placed.slots[0], &mut from.store, theirs.slots[0]);
            if double(placed.slots) {
                self.store
                    .swap(placed.slots[1], &mut from.store, theirs.slots[1]);
            }
        }
        self.frame = from.frame;
    }

    /// Drops the results of all frame-late read-backs, pending or arrived: after a camera cut they describe another view.
    pub fn discard_read_backs(&mut self) {
        for ring in &mut self.rings {
            ring.discard();
        }
    }

    /// Switches the measuring of pass times on or off.
    pub fn set_timing(&mut self, enabled: bool) {
        self.timing.set_enabled(enabled);
    }

    /// The times of the latest frame for which they have arrived; `None` while timing was never on.
    #[must_use]
    pub fn timings(&self) -> Option<Timings> {
        self.timing.latest(&self.passes, &self.kept)
    }

    /// The passes in the order in which they run. A loop comes before its nodes.
    #[must_use]
    pub fn passes(&self) -> Vec<PassInfo<'_>> {
        let mut list = Vec::new();
        self.list_passes(&self.steps, 0, &mut list);
        list
    }

    /// The names of the passes that nothing needs, in the order of their declaration.
    #[must_use]
    pub fn pruned(&self) -> Vec<&str> {
        self.passes
            .iter()
            .zip(&self.kept)
            .filter(|(_, kept)| !**kept)
            .map(|(pass, _)| pass.name.as_str())
            .collect()
    }

    /// Sync points of a frame; those in loops are not counted.
    #[must_use]
    pub fn sync_points(&self) -> usize {
        Step::count_syncs(&self.steps)
    }

    /// Sync points of each host loop, outer loops first.
    #[must_use]
    pub fn loop_sync_points(&self) -> Vec<LoopSyncPoints<'_>> {
        let mut list = Vec::new();
        self.list_loops(&self.steps, &mut list);
        list
    }

    /// The number of textures that the plan has created; fewer than declared where resources share them.
    #[must_use]
    pub fn physical_textures(&self) -> usize {
        self.layout.textures.iter().flatten().count()
    }

    /// The number of buffers that the plan has created; fewer than declared where resources share them.
    #[must_use]
    pub fn physical_buffers(&self) -> usize {
        self.layout.buffers.iter().flatten().count()
    }

    /// The memory of the plan's resources.
    #[must_use]
    pub fn describe_memory(&self) -> Memory {
        let textures = self.layout.textures.iter().flatten();
        let textures = textures.map(|plan| plan.desc.bytes()).sum();
        let buffers = self.layout.buffers.iter().flatten();
        let buffers: u64 = buffers.map(|plan| plan.size).sum();
        let unshared: u64 = self
            .layout
            .placed
            .iter()
            .filter(|placed| placed.used && !placed.resource.import)
            .map(|placed| {
                let copies = if placed.slots[0] == placed.slots[1] {
                    1
                } else {
                    2
                };
                copies
                    * match placed.resource.kind {
                        Kind::Texture(desc) => desc.bytes(),
                        Kind::Buffer(desc) => desc.rounded(),
                        Kind::Host(_) => 0,
                    }
            })
            .sum();
        let rings: u64 = self.rings.iter().map(|ring| ring.memory()).sum();
        Memory {
            textures,
            buffers,
            staging: rings + self.staging.iter().map(Staging::memory).sum::<u64>(),
            saved: unshared.saturating_sub(textures + buffers),
        }
    }

    fn import(&self, call: &'static str, handle: impl Handle) -> Result<u32, ExecuteError> {
        let raw = handle.raw();
        let placed = self.layout.placed.get(raw.resource());
        match placed {
            Some(placed) if raw.graph == self.graph && placed.resource.import => {
                Ok(placed.slots[0])
            }
            _ => Err(self.no_import(call)),
        }
    }

    fn no_import(&self, call: &'static str) -> ExecuteError {
        ExecuteError::NoImport {
            call,
            graph: self.name.clone(),
        }
    }

    /// The object of an output after the last finished frame.
    fn output_slot(&self, raw: Raw) -> Option<u32> {
        let placed = self.layout.placed.get(raw.resource())?;
        let last = self.frame.checked_sub(1)?;
        (raw.graph == self.graph && placed.output && self.has_previous).then(|| placed.slot(last))
    }

    fn list_passes<'a>(&'a self, steps: &'a [Step], depth: usize, list: &mut Vec<PassInfo<'a>>) {
        let info = |pass: usize| PassInfo {
            name: &self.passes[pass].name,
            kind: self.passes[pass].kind,
            group: self.passes[pass].group,
            depth,
        };
        for step in steps {
            match step {
                Step::Pass(pass) => list.push(info(*pass)),
                Step::Sync(passes) => list.extend(passes.iter().map(|pass| info(*pass))),
                Step::Loop(pass, steps) => {
                    list.push(info(*pass));
                    self.list_passes(steps, depth + 1, list);
                }
            }
        }
    }

    fn list_loops<'a>(&'a self, steps: &'a [Step], list: &mut Vec<LoopSyncPoints<'a>>) {
        for step in steps {
            if let Step::Loop(pass, steps) = step {
                list.push(LoopSyncPoints {
                    name: &self.passes[*pass].name,
                    sync_points: Step::count_syncs(steps),
                });
                self.list_loops(steps, list);
            }
        }
    }
}
