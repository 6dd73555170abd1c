//! The declaration of a graph: resources, nodes, outputs. Declaring only records; `compile` checks.
//! The phases (build, compile, execute) and the versioned handles are those of Filament's `FrameGraph`.

use std::any::Any;
use std::collections::{BTreeMap, HashMap};
use std::sync::atomic::{AtomicU32, Ordering};

use crate::access::{Access, Use};
use crate::body::Body;
use crate::error::CompileError;
use crate::handle::{Buffer, Handle, Host, PassId, Raw, Texture};
use crate::pass::{LoopDecl, Pass, PassKind};
use crate::read_back::RingDecl;
use crate::resource::{BufferDesc, HostType, Kind, Resource, TextureDesc};

static NEXT_GRAPH: AtomicU32 = AtomicU32::new(1);

/// A graph under declaration.
///
/// Handles are cheap to copy and valid only in the graph that made them. A write of version *v* returns the handle of version *v + 1*. A
/// pass that reads a handle runs after the pass that wrote it and before the pass that writes the next version. Nothing is checked here:
/// [`Graph::compile`] reports everything that is wrong at once.
pub struct Graph {
    pub(crate) id: u32,
    pub(crate) name: String,
    pub(crate) resources: Vec<Resource>,
    pub(crate) passes: Vec<Pass>,
    pub(crate) bodies: Vec<Body>,
    pub(crate) outputs: Vec<Raw>,
    /// What callers use outputs as, by resource.
    pub(crate) output_usages: Vec<(usize, wgpu::BufferUsages)>,
    pub(crate) rings: Vec<RingDecl>,
    pub(crate) faults: Vec<CompileError>,
    scope: Option<usize>,
    resource_names: HashMap<String, u32>,
    pass_names: HashMap<String, u32>,
}

/// Limits of a host loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LoopOptions {
    /// Iterations after which the frame fails with [`ExecuteError::LoopLimit`](crate::ExecuteError::LoopLimit); at least 1.
    pub limit: u32,
}

impl Default for LoopOptions {
    fn default() -> Self {
        Self { limit: 1_000 }
    }
}

impl Graph {
    /// An empty graph. The name appears in errors and exports.
    #[must_use]
    pub fn new(name: impl Into<String>) -> Self {
        Self {
            id: NEXT_GRAPH.fetch_add(1, Ordering::Relaxed),
            name: name.into(),
            resources: Vec::new(),
            passes: Vec::new(),
            bodies: Vec::new(),
            outputs: Vec::new(),
            output_usages: Vec::new(),
            rings: Vec::new(),
            faults: Vec::new(),
            scope: None,
            resource_names: HashMap::new(),
            pass_names: HashMap::new(),
        }
    }

    /// The graph's name.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// A texture owned by the plan. Its memory is shared with other resources outside of its lifetime.
    pub fn texture(&mut self, name: impl Into<String>, desc: TextureDesc) -> Texture {
        Texture(self.own(name.into(), Kind::Texture(desc)))
    }

    /// A buffer owned by the plan. Its memory is shared with other resources outside of its lifetime.
    pub fn buffer(&mut self, name: impl Into<String>, desc: BufferDesc) -> Buffer {
        Buffer(self.own(name.into(), Kind::Buffer(desc)))
    }

    /// A texture bound before each frame with [`Plan::bind_texture`](crate::Plan::bind_texture).
    /// It may be read before any write. Writing it is a side effect that keeps the pass.
    pub fn import_texture(&mut self, name: impl Into<String>, desc: TextureDesc) -> Texture {
        Texture(self.import(name.into(), Kind::Texture(desc)))
    }

    /// A buffer of at least the given size, bound with [`Plan::bind_buffer`](crate::Plan::bind_buffer).
    /// It may be read before any write. Writing it is a side effect that keeps the pass.
    pub fn import_buffer(&mut self, name: impl Into<String>, desc: BufferDesc) -> Buffer {
        Buffer(self.import(name.into(), Kind::Buffer(desc)))
    }

    /// A host value set before each frame with [`Plan::set`](crate::Plan::set) and dropped at its end.
    pub fn import_host<T: Send + 'static>(&mut self, name: impl Into<String>) -> Host<T> {
        Host::from_raw(self.import(name.into(), Kind::Host(host_type::<T>(make_none::<T>))))
    }

    /// A host value owned by the plan and written by host nodes. Its allocation is reused between frames: the first writer of a frame
    /// finds what an earlier frame left and must set all of it.
    pub fn host<T: Default + Send + 'static>(&mut self, name: impl Into<String>) -> Host<T> {
        Host::from_raw(self.own(name.into(), Kind::Host(host_type::<T>(make_default::<T>))))
    }

    /// Keeps this version of the resource and makes it readable after the frame with
    /// [`Plan::get`](crate::Plan::get), [`Plan::buffer`](crate::Plan::buffer) or [`Plan::texture`](crate::Plan::texture).
    pub fn output(&mut self, handle: impl Handle) {
        let raw = handle.raw();
        if raw.graph == self.id {
            self.outputs.push(raw);
        } else {
            self.faults.push(CompileError::ForeignHandle {
                pass: String::from("(output)"),
            });
        }
    }

    /// As [`Self::output`], for a buffer that the caller uses in these ways after the frame, besides as a copy source.
    pub fn output_as(&mut self, buffer: Buffer, usages: wgpu::BufferUsages) {
        self.output(buffer);
        self.output_usages.push((buffer.0.resource(), usages));
    }

    /// A sub-graph that repeats until a host value is true, with the limit of [`LoopOptions::default`]. See [`Graph::host_loop_with`].
    pub fn host_loop(
        &mut self,
        name: impl Into<String>,
        declare: impl FnOnce(&mut Graph) -> Host<bool>,
    ) -> PassId {
        self.host_loop_with(name, LoopOptions::default(), declare)
    }

    /// A sub-graph that repeats until the host value that `declare` returns is true.
    ///
    /// The closure declares the loop's nodes on the graph that it is given, and may declare resources there. A node that reads a version
    /// from before the loop sees, in later iterations, what the loop wrote last. Passes outside see the loop's final versions. A
    /// texture's `clear` and a buffer's `zeroed` happen in the first iteration only.
    pub fn host_loop_with(
        &mut self,
        name: impl Into<String>,
        options: LoopOptions,
        declare: impl FnOnce(&mut Graph) -> Host<bool>,
    ) -> PassId {
        let pass = self.begin(name.into(), PassKind::HostLoop);
        let outer = self.scope.replace(pass);
        let condition = declare(self);
        self.scope = outer;
        self.passes[pass].looped = Some(LoopDecl {
            condition: condition.raw,
            limit: options.limit.max(1),
        });
        self.pass_id(pass)
    }

    pub(crate) fn pass_id(&self, pass: usize) -> PassId {
        PassId {
            graph: self.id,
            index: pass as u32,
        }
    }

    /// Records a use, or a fault if the handle belongs to another graph.
    pub(crate) fn touch(&mut self, pass: usize, used: Use) {
        if used.raw.graph == self.id {
            self.passes[pass].uses.push(used);
        } else {
            self.foreign(pass);
        }
    }

    /// Records that a pass uses a handle of another graph.
    pub(crate) fn foreign(&mut self, pass: usize) {
        self.faults.push(CompileError::ForeignHandle {
            pass: self.passes[pass].name.clone(),
        });
    }

    /// Records a write (or an update) and returns the next version.
    pub(crate) fn write<H: Handle>(&mut self, pass: usize, handle: H, access: Access) -> H {
        self.touch(pass, Use::new(handle.raw(), access));
        H::with_raw(handle.raw().next())
    }

    /// Records a read.
    pub(crate) fn read(&mut self, pass: usize, handle: impl Handle, access: Access) {
        self.touch(pass, Use::new(handle.raw(), access));
    }

    /// Gives a pass its body.
    pub(crate) fn finish(&mut self, pass: usize, body: Body) -> PassId {
        if matches!(self.bodies[pass], Body::None) {
            self.bodies[pass] = body;
        } else {
            self.faults.push(CompileError::TwoBodies {
                pass: self.passes[pass].name.clone(),
            });
        }
        self.pass_id(pass)
    }

    fn own(&mut self, name: String, kind: Kind) -> Raw {
        self.add(Resource {
            name,
            kind,
            import: false,
        })
    }

    fn import(&mut self, name: String, kind: Kind) -> Raw {
        self.add(Resource {
            name,
            kind,
            import: true,
        })
    }

    fn add(&mut self, mut resource: Resource) -> Raw {
        resource.name = unique(&mut self.resource_names, resource.name);
        self.resources.push(resource);
        Raw {
            graph: self.id,
            index: (self.resources.len() - 1) as u32,
            version: 0,
        }
    }

    /// Adds a pass without uses or body to the current scope.
    pub(crate) fn begin(&mut self, name: String, kind: PassKind) -> usize {
        let name = unique(&mut self.pass_names, name);
        self.passes.push(Pass {
            name,
            kind,
            parent: self.scope,
            uses: Vec::new(),
            byte_limits: BTreeMap::new(),
            after: Vec::new(),
            group: None,
            side_effect: false,
            requires: wgpu::Features::empty(),
            viewport: None,
            query_count: None,
            condition: None,
            looped: None,
        });
        self.bodies.push(Body::None);
        self.passes.len() - 1
    }
}

/// Makes a name unique: a second "blur" becomes "blur (2)".
fn unique(names: &mut HashMap<String, u32>, name: String) -> String {
    let mut candidate = name.clone();
    while let Some(count) = names.get_mut(&candidate) {
        *count += 1;
        candidate = format!("{name} ({count})");
    }
    names.insert(candidate.clone(), 1);
    candidate
}

fn make_none<T: Send + 'static>() -> Box<dyn Any + Send> {
    Box::new(None::<T>)
}

fn make_default<T: Default + Send + 'static>() -> Box<dyn Any + Send> {
    Box::new(Some(T::default()))
}

fn empty<T: Send + 'static>(value: &mut (dyn Any + Send)) {
    if let Some(value) = value.downcast_mut::<Option<T>>() {
        *value = None;
    }
}

fn is_set<T: Send + 'static>(value: &(dyn Any + Send)) -> bool {
    value
        .downcast_ref::<Option<T>>()
        .is_some_and(Option::is_some)
}

fn host_type<T: Send + 'static>(make: fn() -> Box<dyn Any + Send>) -> HostType {
    HostType {
        make,
        empty: empty::<T>,
        is_set: is_set::<T>,
    }
}
