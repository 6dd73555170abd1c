//! Culling for a renderer that is not ours: a host hands in boxes, its cameras and its depth, and gets answers. No mesh, no material, no image.
//!
//! The host's depth becomes a pyramid, and each box is tested against it in a compute pass. Nothing is submitted, nothing waits, and nothing by instance is done on the host
//! while instances stand still, but for a list.
//!
//! - In two phases ([`Phases::Two`]) a frame has no error: [`Judge::begin`] says what to draw first (what was visible in the last frame), the host draws it, and
//!   [`Judge::test`] with that depth says what to draw besides. An instance that neither names is behind what was drawn.
//! - A frame late ([`Phases::Late`]) there is one phase: [`Judge::begin`] says what to draw, and [`Judge::test`], with the frame's finished depth, finds what the next
//!   frame draws. What comes into sight is missing for a frame.
//!
//! Answers are a bit an instance ([`Judge::mask`]), indirect draws ([`Judge::write_draws`]), or a list on the host, a frame late ([`Judge::verdicts`]).
//!
//! ```no_run
//! use antumbra_cull::{Gpu, judge::*};
//! use antumbra_scene::Aabb;
//! use glam::{DAffine3, DVec3, Mat4};
//!
//! # fn host(gpu: &Gpu, matrix: Mat4, eye: DVec3, depth: &wgpu::Texture) -> Result<(), JudgeError> {
//! let mut instances = Instances::new(gpu);
//! let bounds = Aabb::from_centre(DVec3::ZERO, DVec3::ONE);
//! instances.insert(InstanceDesc { bounds, at: DAffine3::IDENTITY, part: Part::Both })?;
//! let view = JudgeView::main(1280, 1024, HostDepth { samples: 4, ..HostDepth::default() });
//! let mut judge = Judge::new(gpu, vec![view], JudgeOptions::default())?;
//! // Each frame:
//! let mut encoder = gpu.device.create_command_encoder(&Default::default());
//! judge.begin(&mut instances, &[Eye::new(matrix, eye)], &mut encoder)?;
//! // Draw the instances whose bits are set in judge.mask(0, Chosen::First), and their depth.
//! judge.test(&[depth], &mut encoder)?;
//! // Draw the instances whose bits are set in judge.mask(0, Chosen::Rest).
//! gpu.queue.submit([encoder.finish()]);
//! # Ok(())
//! # }
//! ```
//!
//! Two phases after Haar and Aaltonen, *GPU-Driven Rendering Pipelines*, 2015.

mod answers;
mod depth;
mod draws;
mod error;
mod eye;
mod instances;
mod list;
mod masks;
mod passes;
mod pyramid;
mod record;
mod submitted;
mod upload;
mod view;

use antumbra_graph::{CompileOptions, Graph, Plan, ReadBackCopy};

pub use answers::Hidden;
pub use depth::{DepthRange, HostDepth};
pub use draws::{DrawBuffers, DrawKind, DrawTemplate, JudgeDraws};
pub use error::JudgeError;
pub use eye::{Drift, Eye};
pub use instances::{InstanceDesc, InstanceId, Instances, Moved};
pub use record::{JudgedInstance, Part};
pub use view::JudgeView;

use answers::Asked;
pub(crate) use eye::{
    AT_MIDDLES, BOXES_ALONE, CULL_UNKNOWN, FORGET, FRAME_LATE, GpuJudgedView, ONE_LOOK, WHOLE_BOXES,
};
use list::List;
use masks::Masks;
use passes::{FirstNodes, TestDesc, TestNodes, prefix};
pub(crate) use pyramid::{
    FIRST_KEPT, GpuPyramid, PyramidNodes, declare_pyramid, fill_pyramid, first_levels,
};
use submitted::Submitted;

use crate::box_test::TestDetail;
use crate::device::Gpu;
use crate::verdict::Verdicts;

/// In how many phases a host draws.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Phases {
    /// What was visible, then what the test finds besides. Without error.
    #[default]
    Two,
    /// One phase, by the test of the frame before.
    Late,
}

/// How a judge is built.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct JudgeOptions {
    /// In how many phases the host draws.
    pub phases: Phases,
    /// Whether answers are read back for [`Judge::verdicts`].
    pub list: bool,
    /// How closely the depth is inspected. Down to the pixel more is found hidden, and the test takes longer.
    pub detail: TestDetail,
}

/// Which of a view's masks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Chosen {
    /// What [`Judge::begin`] says: in two phases, what is drawn before the test; a frame late, everything that is drawn.
    First,
    /// What [`Judge::test`] says to draw besides. Nothing, a frame late.
    Rest,
}

/// What a call has done.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct JudgeReport {
    /// The number of the frame.
    pub frame: u64,
    /// A plan was compiled, for a view has another size. What was known is kept.
    pub rebuilt: bool,
    /// The buffers have grown, and masks are other buffers than before. What was known is kept.
    pub grown: bool,
    /// Views whose answers are not read back for [`Judge::verdicts`], since those of several frames are still under way.
    pub not_read_back: u32,
}

/// Judges instances for the views of a host.
pub struct Judge {
    gpu: Gpu,
    options: JudgeOptions,
    views: Vec<Judged>,
    first: FirstPlan,
    test: TestPlan,
    begun: Option<Begun>,
    submitted: Submitted,
    /// The instances of the last frame.
    of: Option<u64>,
    frame: u64,
}

/// A view, and what is remembered for it.
struct Judged {
    spec: JudgeView,
    masks: Masks,
    /// Cuts so far.
    cuts: u64,
    /// Whether nothing that was found before is true of this view, until the next test.
    forgets: bool,
    eye: Option<Eye>,
    list: List,
    inside: Vec<u32>,
}

struct FirstPlan {
    plan: Plan,
    views: Vec<FirstNodes>,
}

struct TestPlan {
    plan: Plan,
    views: Vec<TestNodes>,
    sizes: Vec<[u32; 2]>,
}

/// A frame between its two calls.
struct Begun {
    instances: wgpu::Buffer,
    count: u32,
    epoch: u64,
    views: Vec<BegunView>,
}

struct BegunView {
    eye: Eye,
    flags: u32,
}

impl std::fmt::Debug for Judge {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let views: Vec<&JudgeView> = self.views.iter().map(|view| &view.spec).collect();
        f.debug_struct("Judge")
            .field("options", &self.options)
            .field("views", &views)
            .finish_non_exhaustive()
    }
}

impl Judge {
    /// A judge for these views. Everything is compiled here.
    ///
    /// # Errors
    /// [`JudgeError::View`] for a view without pixels, with a depth that holds none or with the name of another, [`JudgeError::Order`] without a view.
    pub fn new(
        gpu: &Gpu,
        views: Vec<JudgeView>,
        options: JudgeOptions,
    ) -> Result<Self, JudgeError> {
        if views.is_empty() {
            return Err(JudgeError::Order("no view to judge for: name at least one"));
        }
        for (number, view) in views.iter().enumerate() {
            view.check(gpu)?;
            let mut others = views.iter().skip(number + 1);
            if others.any(|other| other.name == view.name) {
                return Err(JudgeError::View {
                    view: view.name.clone(),
                    why: "another view has the same name: give each its own".to_owned(),
                });
            }
        }
        Ok(Self {
            gpu: gpu.clone(),
            options,
            first: FirstPlan::new(gpu, &views)?,
            test: TestPlan::new(gpu, &views)?,
            views: views
                .into_iter()
                .map(|spec| Judged {
                    masks: Masks::new(gpu, &spec.name),
                    spec,
                    cuts: 0,
                    forgets: false,
                    eye: None,
                    list: List::default(),
                    inside: Vec::new(),
                })
                .collect(),
            begun: None,
            submitted: Submitted::default(),
            of: None,
            frame: 0,
        })
    }

    /// Gives a view's depth another size, from the next test on. Nothing that is known is lost.
    ///
    /// # Errors
    /// [`JudgeError::View`] for a view that does not exist, and for a size that [`Self::new`] refuses.
    pub fn resize(&mut self, view: usize, size: [u32; 2]) -> Result<(), JudgeError> {
        let views = self.views.len();
        let Some(judged) = self.views.get_mut(view) else {
            return Err(no_view(view, views));
        };
        let resized = JudgeView {
            size,
            ..judged.spec.clone()
        };
        resized.check(&self.gpu)?;
        judged.spec = resized;
        Ok(())
    }

    /// The views.
    pub fn views(&self) -> impl Iterator<Item = &JudgeView> {
        self.views.iter().map(|view| &view.spec)
    }

    /// Begins a frame: brings the instances' changes onto the device, and finds what is drawn first. `eyes` are those of the views, in order. Submit encoders in the order in which they were
    /// recorded. One that is dropped unsubmitted is noticed: its changes come again, and its answers do not count.
    ///
    /// # Errors
    /// [`JudgeError::View`] for an eye without an image; [`JudgeError::Order`] where the eyes are not one a view; [`JudgeError::Frame`]. The encoder must then be
    /// dropped.
    pub fn begin(
        &mut self,
        instances: &mut Instances,
        eyes: &[Eye],
        encoder: &mut wgpu::CommandEncoder,
    ) -> Result<JudgeReport, JudgeError> {
        self.begun = None;
        if eyes.len() != self.views.len() {
            return Err(JudgeError::Order(
                "as many eyes as views must be given, in order",
            ));
        }
        for (eye, view) in eyes.iter().zip(&self.views) {
            if let Some(why) = eye.fault() {
                return Err(JudgeError::View {
                    view: view.spec.name.clone(),
                    why,
                });
            }
        }
        let others = self.of.replace(instances.number()) != Some(instances.number());
        let late = self.options.phases == Phases::Late;
        let unknown = self.submitted.take_lost();
        let records = instances.upload(encoder);
        let count = instances.slots();
        let mut grown = false;
        let mut begun = Vec::with_capacity(eyes.len());
        for (eye, view) in eyes.iter().zip(&mut self.views) {
            grown |= view.masks.reserve(&self.gpu, count, encoder);
            view.cuts += u64::from(eye.cut || others);
            view.forgets |= eye.cut || others || unknown;
            view.eye = Some(*eye);
            view.masks.clear(Chosen::Rest, encoder);
            if others {
                view.masks.clear(Chosen::First, encoder);
            }
            let flags = if late { FRAME_LATE } else { 0 };
            let flags = flags | if view.forgets { FORGET } else { 0 } | self.options.detail.flag();
            // A frame late, a frame that goes without a test leaves what was found before it, which is not about what it has drawn.
            view.forgets |= late;
            begun.push(BegunView { eye: *eye, flags });
        }
        let FirstPlan { plan, views } = &mut self.first;
        for ((nodes, view), begun) in views.iter().zip(&self.views).zip(&begun) {
            plan.set(nodes.imports.view, begun.frame(&view.spec, count))?;
            plan.bind_buffer(nodes.imports.instances, &records)?;
            plan.bind_buffer(nodes.imports.states, view.masks.states())?;
            plan.bind_buffer(nodes.first, view.masks.of(Chosen::First))?;
        }
        plan.record(&self.gpu.device, &self.gpu.queue, encoder)?;
        self.begun = Some(Begun {
            instances: records,
            count,
            epoch: instances.epoch(),
            views: begun,
        });
        let frame = self.frame;
        self.frame += 1;
        Ok(JudgeReport {
            frame,
            grown,
            ..JudgeReport::default()
        })
    }

    /// Tests all instances of the frame that was begun, against the depths of the views, in order: in two phases those of what was drawn first, a frame late the
    /// finished ones. In two phases a frame without a test lacks what the test would have found; a frame late, the next frame then draws everything in the view.
    ///
    /// # Errors
    /// [`JudgeError::Depth`] for a depth that is not what its view says; [`JudgeError::Order`] where no frame was begun, or the depths are not one a view;
    /// [`JudgeError::Compile`] and [`JudgeError::Frame`].
    pub fn test(
        &mut self,
        depths: &[&wgpu::Texture],
        encoder: &mut wgpu::CommandEncoder,
    ) -> Result<JudgeReport, JudgeError> {
        if depths.len() != self.views.len() {
            return Err(JudgeError::Order(
                "as many depths as views must be given, in order",
            ));
        }
        for (depth, view) in depths.iter().zip(&self.views) {
            let JudgeView {
                name,
                size,
                depth: host,
            } = &view.spec;
            host.check(name, *size, depth)?;
        }
        let rebuilt = self.prepare_test()?;
        let Some(begun) = self.begun.take() else {
            return Err(JudgeError::Order(
                "a test belongs to a frame: call `Judge::begin` first, once a test",
            ));
        };
        let TestPlan { plan, views, .. } = &mut self.test;
        for (((nodes, view), frame), depth) in
            views.iter().zip(&self.views).zip(&begun.views).zip(depths)
        {
            plan.set(nodes.imports.view, frame.frame(&view.spec, begun.count))?;
            plan.bind_buffer(nodes.imports.instances, &begun.instances)?;
            plan.bind_buffer(nodes.imports.states, view.masks.states())?;
            plan.bind_buffer(nodes.first, view.masks.of(Chosen::First))?;
            plan.bind_buffer(nodes.rest, view.masks.of(Chosen::Rest))?;
            plan.bind_buffer(nodes.hidden, view.masks.hidden())?;
            let aspect = depth.create_view(&wgpu::TextureViewDescriptor {
                aspect: wgpu::TextureAspect::DepthOnly,
                ..Default::default()
            });
            plan.bind_texture(nodes.depth, &aspect, depth)?;
        }
        plan.record(&self.gpu.device, &self.gpu.queue, encoder)?;
        let frame = self.frame.saturating_sub(1);
        let mut not_read_back = 0;
        for view in &mut self.views {
            view.forgets = false;
            if self.options.list {
                let copy = ReadBackCopy {
                    source: view.masks.hidden(),
                    bytes: masks::bytes(begun.count),
                    frame,
                    tag: Asked {
                        epoch: begun.epoch,
                        cuts: view.cuts,
                    },
                };
                not_read_back += u32::from(!view.list.ask(&self.gpu, copy, encoder));
            }
        }
        self.submitted.note(encoder);
        Ok(JudgeReport {
            frame,
            rebuilt,
            not_read_back,
            ..JudgeReport::default()
        })
    }

    /// A mask of a view: bit `index % 32` of word `index / 32` is the instance of that index. Instances that are near to the eye, new or never tested are in one of the two, and those that hide
    /// nothing in the second. `None` for a view that does not exist. After [`JudgeReport::grown`] it is another buffer.
    pub fn mask(&self, view: usize, chosen: Chosen) -> Option<&wgpu::Buffer> {
        Some(self.views.get(view)?.masks.of(chosen))
    }

    /// Writes a verdict an instance, by index, for the eye of the last frame that was begun: the newest answers that have arrived, with what has come, come into the view or come
    /// near to the eye since. Never waits; before the first answer everything in the view is drawn. Returns the frame that the answers are about. For hosts that draw from lists of their own; it looks at each instance.
    ///
    /// # Errors
    /// [`JudgeError::View`] for a view that does not exist; [`JudgeError::Order`] without [`JudgeOptions::list`], before the first frame, and for instances on the GPU alone.
    pub fn verdicts(
        &mut self,
        view: usize,
        instances: &mut Instances,
        verdicts: &mut Verdicts,
    ) -> Result<Option<u64>, JudgeError> {
        let views = self.views.len();
        let Some(judged) = self.views.get_mut(view) else {
            return Err(no_view(view, views));
        };
        if !self.options.list {
            return Err(READS_NONE_BACK);
        }
        let Some(eye) = judged.eye else {
            return Err(JudgeError::Order(
                "verdicts before the first frame: call `Judge::begin`",
            ));
        };
        if instances.world().is_none() {
            return Err(JudgeError::Order(
                "verdicts of instances that are on the GPU alone: use the masks",
            ));
        }
        let (range, cuts) = (judged.spec.depth.range, judged.cuts);
        let answers = judged.list.newest();
        answers.judge(instances, &eye, range, cuts, &mut judged.inside, verdicts);
        Ok(answers.frame())
    }

    /// What was found hidden, by the newest answers that have arrived. Never waits; `None` before the first, and since a cut until one is about a later frame. For hosts that have lists of their own,
    /// and know what has come, changed or moved since [`Hidden::frame`]: they draw that, whatever its bit says. [`Self::verdicts`] does so for what has come, and looks at the frustum as well.
    ///
    /// # Errors
    /// [`JudgeError::View`] for a view that does not exist; [`JudgeError::Order`] without [`JudgeOptions::list`].
    pub fn hidden(&mut self, view: usize) -> Result<Option<Hidden<'_>>, JudgeError> {
        let views = self.views.len();
        let Some(judged) = self.views.get_mut(view) else {
            return Err(no_view(view, views));
        };
        if !self.options.list {
            return Err(READS_NONE_BACK);
        }
        Ok(judged.list.newest().hidden(judged.cuts))
    }

    /// Writes a host's indirect draws: of each draw's members, those that are chosen, in order.
    ///
    /// # Errors
    /// [`JudgeError::Buffer`] for buffers that are too small or lack a usage, [`JudgeError::View`] for a view that does not exist.
    pub fn write_draws(
        &self,
        view: usize,
        chosen: Chosen,
        draws: &JudgeDraws,
        into: DrawBuffers<'_>,
        encoder: &mut wgpu::CommandEncoder,
    ) -> Result<(), JudgeError> {
        let Some(judged) = self.views.get(view) else {
            return Err(no_view(view, self.views.len()));
        };
        draws.write(judged.masks.of(chosen), into, encoder)
    }

    /// Bytes of device memory that this judge holds for its views. [`Instances::memory`] has those of the instances.
    pub fn memory(&self) -> u64 {
        let views = self.views.iter();
        let views = views.map(|view| view.masks.memory() + view.list.memory());
        let plans = [&self.first.plan, &self.test.plan].map(Plan::describe_memory);
        let plans = plans.map(|memory| memory.textures + memory.buffers + memory.staging);
        views.sum::<u64>() + plans.iter().sum::<u64>()
    }

    /// Makes the plan that tests fit the sizes of the views. Returns whether it was compiled anew.
    fn prepare_test(&mut self) -> Result<bool, JudgeError> {
        let sizes = self.views.iter().map(|view| &view.spec.size);
        if sizes.eq(&self.test.sizes) {
            return Ok(false);
        }
        let specs = self.views.iter().map(|view| view.spec.clone());
        let specs: Vec<JudgeView> = specs.collect();
        self.test = TestPlan::new(&self.gpu, &specs)?;
        Ok(true)
    }
}

impl FirstPlan {
    fn new(gpu: &Gpu, specs: &[JudgeView]) -> Result<Self, JudgeError> {
        let mut graph = Graph::new("judge: first");
        let views = specs.iter().map(|spec| {
            let prefix = prefix(spec, specs.len());
            passes::first(&mut graph, gpu, &prefix)
        });
        let views = views.collect();
        let plan = graph.compile(&CompileOptions::embedded(&gpu.device))?;
        Ok(Self { plan, views })
    }
}

impl TestPlan {
    fn new(gpu: &Gpu, specs: &[JudgeView]) -> Result<Self, JudgeError> {
        let mut graph = Graph::new("judge: test");
        let views = specs.iter().map(|spec| {
            let prefix = prefix(spec, specs.len());
            let JudgeView { size, depth, .. } = *spec;
            let desc = TestDesc { depth, size };
            passes::test(&mut graph, gpu, &prefix, desc)
        });
        Ok(Self {
            views: views.collect(),
            plan: graph.compile(&CompileOptions::embedded(&gpu.device))?,
            sizes: specs.iter().map(|spec| spec.size).collect(),
        })
    }
}

impl BegunView {
    /// What the device knows of it. The size is that of the depth at hand: it may change between the two calls of a frame.
    fn frame(&self, spec: &JudgeView, count: u32) -> GpuJudgedView {
        GpuJudgedView::new(&self.eye, spec.size, spec.depth, count, self.flags)
    }
}

const READS_NONE_BACK: JudgeError =
    JudgeError::Order("answers of a judge that reads none back: set `JudgeOptions::list`");

fn no_view(view: usize, views: usize) -> JudgeError {
    JudgeError::View {
        view: view.to_string(),
        why: format!("there are {views} views, numbered from 0"),
    }
}
