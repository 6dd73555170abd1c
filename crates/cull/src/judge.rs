//! Culling for a renderer that is not ours: a host hands in boxes, its cameras and its depth, and gets answers. No mesh, no material, no image.
//!
//! The host's depth becomes a pyramid, and each box is tested against it in a compute pass. Nothing is submitted, nothing waits, and nothing by instance is done on the host
//! while instances stand still.
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
mod masks;
mod passes;
mod pyramid;
mod record;
mod upload;
mod view;

use antumbra_graph::{CompileOptions, Graph, Plan};

pub use depth::{DepthRange, HostDepth};
pub use draws::{DrawBuffers, DrawKind, DrawTemplate, JudgeDraws};
pub use error::JudgeError;
pub use eye::Eye;
pub use instances::{InstanceDesc, InstanceId, Instances};
pub use record::{JudgedInstance, Part};
pub use view::JudgeView;

use answers::Asked;
use eye::{FORGET, FRAME_LATE, GpuJudgedView};
use masks::Masks;
use passes::{FirstNodes, TestDesc, TestNodes, prefix};

use crate::device::Gpu;
use crate::pipelines::Pipelines;
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
    /// A plan was compiled: a view has another size, or a list has more instances. What was known is kept.
    pub rebuilt: bool,
    /// The buffers have grown, and masks are other buffers than before. What was known is kept.
    pub grown: bool,
}

/// Judges instances for the views of a host.
pub struct Judge {
    gpu: Gpu,
    options: JudgeOptions,
    views: Vec<Judged>,
    pipelines: Pipelines,
    first: Option<FirstPlan>,
    test: Option<TestPlan>,
    begun: Option<Begun>,
    frame: u64,
}

/// A view, and what is remembered for it.
struct Judged {
    spec: JudgeView,
    masks: Masks,
    /// Cuts so far.
    cuts: u64,
    eye: Option<Eye>,
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
    /// Bytes of the masks that are read back.
    list: Option<u64>,
}

/// A frame between its two calls.
struct Begun {
    instances: wgpu::Buffer,
    count: u32,
    epoch: u64,
    eyes: Vec<GpuJudgedView>,
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
    /// A judge for these views. Pipelines are compiled here; plans, with the first frame.
    ///
    /// # Errors
    /// [`JudgeError::View`] for a view without pixels or with a depth that holds none, [`JudgeError::Order`] without a view.
    pub fn new(
        gpu: &Gpu,
        views: Vec<JudgeView>,
        options: JudgeOptions,
    ) -> Result<Self, JudgeError> {
        if views.is_empty() {
            return Err(JudgeError::Order("no view to judge for: name at least one"));
        }
        for view in &views {
            view.check(gpu)?;
        }
        let views = views.into_iter().map(|spec| Judged {
            masks: Masks::new(gpu, &spec.name),
            spec,
            cuts: 0,
            eye: None,
            inside: Vec::new(),
        });
        let mut judge = Self {
            gpu: gpu.clone(),
            options,
            views: views.collect(),
            pipelines: Pipelines::default(),
            first: None,
            test: None,
            begun: None,
            frame: 0,
        };
        judge.first = Some(judge.first_plan()?);
        judge.test = Some(judge.test_plan()?);
        Ok(judge)
    }

    /// Gives a view's depth another size, from the next test on. Nothing that is known is lost.
    ///
    /// # Errors
    /// [`JudgeError::View`] for a view that does not exist, and for a size that [`Self::new`] refuses.
    pub fn resize(&mut self, view: usize, size: [u32; 2]) -> Result<(), JudgeError> {
        let views = self.views.len();
        let Some(judged) = self.views.get_mut(view) else {
            return Err(JudgeError::View {
                view: view.to_string(),
                why: format!("there are {views} views, numbered from 0"),
            });
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

    /// Begins a frame: brings the instances' changes onto the device, and finds what is drawn first. `eyes` are those of the views, in order.
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
        let records = instances.upload(encoder);
        let count = instances.slots();
        let mut grown = false;
        let late = match self.options.phases {
            Phases::Two => 0,
            Phases::Late => FRAME_LATE,
        };
        let mut frames = Vec::with_capacity(eyes.len());
        for (eye, view) in eyes.iter().zip(&mut self.views) {
            grown |= view.masks.reserve(&self.gpu, count, encoder);
            view.cuts += u64::from(eye.cut);
            view.eye = Some(*eye);
            let forget = if eye.cut { FORGET } else { 0 };
            let JudgeView { size, depth, .. } = view.spec;
            frames.push(GpuJudgedView::new(eye, size, depth, count, late | forget));
        }
        if self.first.is_none() {
            self.first = Some(self.first_plan()?);
        }
        let Some(FirstPlan { plan, views }) = &mut self.first else {
            return Err(UNBUILT);
        };
        for ((nodes, view), frame) in views.iter().zip(&self.views).zip(&frames) {
            plan.set(nodes.imports.view, *frame)?;
            plan.bind_buffer(nodes.imports.instances, &records)?;
            plan.bind_buffer(nodes.imports.states, view.masks.states())?;
            plan.bind_buffer(nodes.first, view.masks.of(Chosen::First))?;
        }
        plan.record(&self.gpu.device, &self.gpu.queue, encoder)?;
        self.begun = Some(Begun {
            instances: records,
            count,
            epoch: instances.epoch(),
            eyes: frames,
        });
        let frame = self.frame;
        self.frame += 1;
        Ok(JudgeReport {
            frame,
            rebuilt: false,
            grown,
        })
    }

    /// Tests all instances of the frame that was begun, against the depths of the views, in order: in two phases those of what was drawn first, a frame late the
    /// finished ones. A frame may go without.
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
        let Some(begun) = self.begun.take() else {
            return Err(JudgeError::Order(
                "a test belongs to a frame: call `Judge::begin` first, once a test",
            ));
        };
        let rebuilt = self.prepare_test()?;
        let Some(TestPlan {
            plan, views, list, ..
        }) = &mut self.test
        else {
            return Err(UNBUILT);
        };
        for (((nodes, view), frame), depth) in
            views.iter().zip(&self.views).zip(&begun.eyes).zip(depths)
        {
            plan.set(nodes.imports.view, *frame)?;
            plan.bind_buffer(nodes.imports.instances, &begun.instances)?;
            plan.bind_buffer(nodes.imports.states, view.masks.states())?;
            plan.bind_buffer(nodes.rest, view.masks.of(Chosen::Rest))?;
            plan.bind_buffer(nodes.hidden, view.masks.hidden())?;
            let aspect = depth.create_view(&wgpu::TextureViewDescriptor {
                aspect: wgpu::TextureAspect::DepthOnly,
                ..Default::default()
            });
            plan.bind_texture(nodes.depth, &aspect, depth)?;
            if let Some(nodes) = nodes.list {
                let asked = Asked {
                    epoch: begun.epoch,
                    cuts: view.cuts,
                    bytes: list.unwrap_or(0).min(masks::bytes(begun.count)),
                };
                plan.set(nodes.asked, asked)?;
            }
        }
        plan.record(&self.gpu.device, &self.gpu.queue, encoder)?;
        Ok(JudgeReport {
            frame: self.frame.saturating_sub(1),
            rebuilt,
            grown: false,
        })
    }

    /// A mask of a view: bit `index % 32` of word `index / 32` is the instance of that index. Instances that are near, new or exempt have theirs set. `None` for a view that does not
    /// exist. After [`JudgeReport::grown`] it is another buffer.
    pub fn mask(&self, view: usize, chosen: Chosen) -> Option<&wgpu::Buffer> {
        Some(self.views.get(view)?.masks.of(chosen))
    }

    /// Writes a verdict an instance, by index, for the eye of the last frame that was begun: the newest answers that have arrived, with what has come, moved out of the view or
    /// near to the eye since. Never waits; before the first answer everything in the view is drawn. For hosts that draw from lists of their own.
    ///
    /// # Errors
    /// [`JudgeError::Order`] without [`JudgeOptions::list`], for a view that does not exist or that has not begun a frame.
    pub fn verdicts(
        &mut self,
        view: usize,
        instances: &mut Instances,
        verdicts: &mut Verdicts,
    ) -> Result<(), JudgeError> {
        let missing = JudgeError::Order(
            "there are no verdicts: set `JudgeOptions::list`, name a view that exists, and begin a frame",
        );
        let Some(TestPlan { plan, views, .. }) = &self.test else {
            return Err(missing);
        };
        let nodes = views.get(view).and_then(|nodes| nodes.list);
        let (Some(nodes), Some(judged)) = (nodes, self.views.get_mut(view)) else {
            return Err(missing);
        };
        let Some(eye) = judged.eye else {
            return Err(missing);
        };
        let none = answers::Answers::default();
        let answers = plan.get(nodes.answers).unwrap_or(&none);
        let (range, cuts) = (judged.spec.depth.range, judged.cuts);
        answers.judge(instances, &eye, range, cuts, &mut judged.inside, verdicts);
        Ok(())
    }

    /// Writes a host's indirect draws: of each draw's members, those that are chosen, in order.
    ///
    /// # Errors
    /// [`JudgeError::Buffer`] for buffers that are too small or lack a usage, [`JudgeError::Order`] for a view that does not exist.
    pub fn write_draws(
        &mut self,
        view: usize,
        chosen: Chosen,
        draws: &JudgeDraws,
        into: DrawBuffers<'_>,
        encoder: &mut wgpu::CommandEncoder,
    ) -> Result<(), JudgeError> {
        let Some(judged) = self.views.get(view) else {
            return Err(JudgeError::Order("draws of a view that does not exist"));
        };
        draws.write(judged.masks.of(chosen), into, encoder)
    }

    /// Bytes of device memory that this judge holds for its views, those of the instances aside.
    pub fn memory(&self) -> u64 {
        let masks: u64 = self.views.iter().map(|view| view.masks.memory()).sum();
        let plans = [
            self.first.as_ref().map(|first| &first.plan),
            self.test.as_ref().map(|test| &test.plan),
        ];
        let plans = plans.into_iter().flatten().map(Plan::describe_memory);
        masks
            + plans
                .map(|memory| memory.textures + memory.buffers + memory.staging)
                .sum::<u64>()
    }

    fn first_plan(&mut self) -> Result<FirstPlan, JudgeError> {
        let mut graph = Graph::new("judge: first");
        let count = self.views.len();
        let views = self.views.iter().map(|view| {
            let prefix = prefix(&view.spec, count);
            passes::first(&mut graph, &self.gpu, &mut self.pipelines, &prefix)
        });
        let views = views.collect();
        Ok(FirstPlan {
            plan: compile(&self.gpu, graph)?,
            views,
        })
    }

    fn test_plan(&mut self) -> Result<TestPlan, JudgeError> {
        let mut graph = Graph::new("judge: test");
        let count = self.views.len();
        let list = self.options.list.then(|| self.list_bytes());
        let views = self.views.iter().map(|view| {
            let prefix = prefix(&view.spec, count);
            let JudgeView { size, depth, .. } = view.spec;
            let desc = TestDesc { depth, size, list };
            passes::test(&mut graph, &self.gpu, &mut self.pipelines, &prefix, desc)
        });
        let views = views.collect();
        Ok(TestPlan {
            plan: compile(&self.gpu, graph)?,
            views,
            sizes: self.views.iter().map(|view| view.spec.size).collect(),
            list,
        })
    }

    /// Makes the plan that tests fit the sizes of the views and, for a list, the number of instances. Returns whether it was compiled anew.
    fn prepare_test(&mut self) -> Result<bool, JudgeError> {
        let list = self.options.list.then(|| self.list_bytes());
        let mut sizes = self.views.iter().map(|view| &view.spec.size);
        let fits = |test: &TestPlan| test.list == list && test.sizes.iter().eq(sizes.by_ref());
        if self.test.as_ref().is_some_and(fits) {
            return Ok(false);
        }
        let mut next = self.test_plan()?;
        if let Some(before) = &mut self.test {
            // Answers that have arrived stay.
            next.plan.inherit(&mut before.plan);
        }
        self.test = Some(next);
        Ok(true)
    }

    /// Bytes of a mask that has room for all instances.
    fn list_bytes(&self) -> u64 {
        let sizes = self.views.iter().map(|view| view.masks.hidden().size());
        sizes.max().unwrap_or(4)
    }
}

const UNBUILT: JudgeError = JudgeError::Order("the plans are not built");

fn compile(gpu: &Gpu, graph: Graph) -> Result<Plan, JudgeError> {
    Ok(graph.compile(&CompileOptions::embedded(&gpu.device))?)
}
