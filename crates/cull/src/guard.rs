//! Late answers that hide nothing that has come into view meanwhile: what is hidden is hidden from everywhere that the eye can be until the answer is used.
//!
//! Wonka, Wimmer, Sillion, *Instant Visibility*, 2001: what occluders that are shrunk by a distance hide from a point, the occluders themselves hide from all points within that
//! distance. (Where the line of sight from the first point meets a shrunk occluder, the line from the second passes no farther than the distance from there, hence through the occluder.) No image of depths can say this, since a gap
//! between two surfaces need not show in it. So occluders are boxes that lie wholly inside of closed meshes ([`OrientedBox::inner`]), shrunk; open surfaces and thin walls hide nothing here.
//!
//! Per view: a host node takes the answers of an earlier frame. The strategy has each entity that it holds occluded [confirmed](Guard::confirm), and draws the others. A further node
//! writes the shrunk boxes, which are drawn into a depth of their own, and a query for each entity that the strategy holds occluded. Half a pixel is taken off and added everywhere, so that what lies between samples is covered too. The image of these passes is wider than
//! the view by as much as the eye may turn.
//!
//! Nothing depends on a promise: how far the eye has come, and what has moved, is checked when an answer is used.

mod movement;
mod wide;

use std::ops::RangeInclusive;
use std::sync::Arc;

use antumbra_graph::{Buffer, BufferDesc, Clear, Host, HostBuilder, TextureDesc};
use antumbra_scene::{Aabb, Projection, Topology};
use glam::DVec3;

use crate::boxes::{BoxContents, BoxPassSpec, Widening, box_depth_pass, box_query_pass};
use crate::candidates::{Candidates, Stamp};
use crate::entities::{OrientedBox, SceneTable};
use crate::frame_graph::{CULL, FrameGraph};
use crate::renderer::{DEPTH_FORMAT, ViewInputs};
use crate::verdict::{Verdict, Verdicts};
use crate::view::{GpuView, ViewFrame};
use crate::view_nodes::ViewNodes;
use movement::Movement;
use wide::WideView;

/// How far an eye goes from one frame to the next, at most. Late answers hold for that; where it goes farther, nothing is hidden until newer ones are there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GuardOptions {
    /// Metres a frame. 0: there is no guard.
    pub metres: f64,
    /// Degrees a frame, about any axis. What the view turns to faster is drawn until answers about it are there.
    pub degrees: f64,
}

impl GuardOptions {
    /// No guard.
    pub const OFF: Self = Self {
        metres: 0.0,
        degrees: 2.0,
    };
    /// The range of the setting `guard`.
    pub const METRES: RangeInclusive<f64> = 0.0..=1e6;
    /// What the setting `guard` means.
    pub const METRES_MEAN: &str = "late answers hide nothing that comes into view while the eye goes at most this far a frame; 0: they are believed as they are";
    /// The range of the setting `guard-turn`.
    pub const DEGREES: RangeInclusive<f64> = 0.0..=90.0;
    /// What the setting `guard-turn` means.
    pub const DEGREES_MEAN: &str =
        "with a guard, by how much the eye may turn a frame; what it turns to faster is drawn";

    /// Whether there is a guard.
    pub fn is_on(self) -> bool {
        self.metres > 0.0
    }
}

impl Default for GuardOptions {
    fn default() -> Self {
        Self::OFF
    }
}

/// What is known to be hidden from wherever the eye can be. A host value that a view keeps from frame to frame.
#[derive(Debug, Default)]
pub struct Guard {
    answer: Option<Answer>,
    /// By slot: its place in the answer's lists, plus one; 0: it is not there.
    places: Vec<u32>,
    movement: Movement,
    holds: bool,
    /// What the strategy holds occluded in this frame.
    wanted: Vec<u32>,
    /// Of these, what is not confirmed.
    revived: Vec<u32>,
}

/// What was asked in a frame. It travels with the answers.
#[derive(Debug, Clone, Default)]
struct Asked {
    stamp: Stamp,
    /// The frame, in the movement's own count.
    frame: u64,
    eye: DVec3,
    projection: Option<Projection>,
    /// The slots that were tested, in the order of the queries.
    slots: Arc<Vec<u32>>,
    /// Where their entities might be without being seen.
    tested: Arc<Vec<Aabb>>,
    /// The slots whose entities hid.
    occluders: Arc<Vec<u32>>,
}

#[derive(Debug)]
struct Answer {
    asked: Asked,
    hidden: Vec<bool>,
}

impl Guard {
    /// Takes the answers of an earlier frame.
    fn take(&mut self, asked: &Asked, bytes: &[u8]) {
        self.places.clear();
        let most = asked
            .slots
            .iter()
            .max()
            .map_or(0, |most| *most as usize + 1);
        self.places.resize(most, 0);
        for (slot, place) in asked.slots.iter().zip(1u32..) {
            if let Some(known) = self.places.get_mut(*slot as usize) {
                *known = place;
            }
        }
        let (answers, _) = bytes.as_chunks::<8>();
        self.answer = Some(Answer {
            asked: asked.clone(),
            hidden: answers
                .iter()
                .take(asked.slots.len())
                .map(|answer| u64::from_le_bytes(*answer) == 0)
                .collect(),
        });
    }

    /// Starts a frame: whether the answers that are there hold for this eye. `radius`: metres that it may be from where it was.
    fn begin(&mut self, table: &SceneTable, view: &ViewFrame, radius: f64) {
        self.movement.follow(table);
        self.wanted.clear();
        self.revived.clear();
        let moved = |asked: &Asked| {
            let mut occluders = asked.occluders.iter();
            occluders.any(|slot| self.movement.has_moved(*slot, asked.frame))
        };
        self.holds = self.answer.as_ref().is_some_and(|Answer { asked, .. }| {
            asked.stamp.cuts == view.cuts
                && asked.projection == Some(view.camera.projection)
                && asked.eye.distance(view.camera.position) <= radius
                && !moved(asked)
        });
    }

    /// Whether the entity in a slot is hidden from wherever the eye may be now.
    fn is_hidden(&self, table: &SceneTable, slot: u32) -> bool {
        let place = self
            .places
            .get(slot as usize)
            .and_then(|place| place.checked_sub(1));
        let (true, Some(place), Some(Answer { asked, hidden })) = (self.holds, place, &self.answer)
        else {
            return false;
        };
        let place = place as usize;
        let known = table
            .occupant(slot)
            .is_some_and(|occupant| occupant.added_epoch <= asked.stamp.epoch);
        let tested = asked.tested.get(place);
        known
            && hidden.get(place).copied().unwrap_or(false)
            && tested.is_some_and(|tested| tested.contains_box(&table.bounds(slot)))
    }

    /// Makes what a strategy holds occluded visible again, unless it is hidden from wherever the eye may be by now. Tests of all of it follow in this frame. Returns the slots that are drawn for it, in the order of `inside`, and counts the tests.
    pub fn confirm(
        &mut self,
        table: &SceneTable,
        inside: impl IntoIterator<Item = u32>,
        verdicts: &mut Verdicts,
    ) -> &[u32] {
        for slot in inside {
            if verdicts.get(slot) != Verdict::Occluded {
                continue;
            }
            self.wanted.push(slot);
            if !self.is_hidden(table, slot) {
                verdicts.set(slot, Verdict::Visible);
                self.revived.push(slot);
            }
        }
        verdicts.add_tested(self.wanted.len() as u32);
        &self.revived
    }
}

/// A view's guard while its nodes are declared, between [`FrameGraph::begin_guard`] and [`FrameGraph::end_guard`].
#[derive(Debug, Clone, Copy)]
pub struct GuardNodes {
    guard: Host<Guard>,
    asked: Host<Asked>,
    answers: Buffer,
    options: GuardOptions,
}

impl GuardNodes {
    /// Declares on the strategy's node that it has entities confirmed. Returns the value to [confirm](Guard::confirm) them by.
    pub fn updated_by(&mut self, node: &mut HostBuilder<'_>) -> Host<Guard> {
        self.guard = node.write(self.guard);
        self.guard
    }
}

/// A moved entity hides nothing here until it has stood still for this many times the frames in flight: else it would void the answers again.
const STILL: u64 = 2;
/// What lies between samples is no farther from one than this, in pixels: half a diagonal, and what a rasteriser moves corners by.
const BETWEEN: f64 = 0.8;

impl FrameGraph<'_> {
    /// The first half of a guard: takes what is known from earlier frames. The strategy's node then [writes](GuardNodes::updated_by) it, and [`Self::end_guard`] follows.
    pub fn begin_guard(&mut self, view: &ViewNodes, options: GuardOptions) -> Option<GuardNodes> {
        if !options.is_on() {
            return None;
        }
        let inputs = view.inputs();
        let radius = self.guarded(options).metres;
        let bytes = BufferDesc::new(self.slot_bytes() * 2);
        let answers = self.graph().buffer(view.named("guard: answers"), bytes);
        let guard = self.graph().host::<Guard>(view.named("guard"));
        let asked = self.graph().host::<Asked>(view.named("guarded entities"));
        let mut node = self.graph().host_node(view.named("read guard"));
        node.group(CULL).read(inputs.scene).read(inputs.view);
        let late = node.read_previous(answers, asked);
        let guard = node.updates(guard);
        node.run(move |ctx| {
            let (scene, frame) = (ctx.get(inputs.scene)?, ctx.get(inputs.view)?);
            let mut guard = ctx.get_mut(guard)?;
            if let Some(late) = ctx.late(late) {
                guard.take(late.tag, late.bytes);
            }
            guard.begin(&scene.table, &frame, radius);
            Ok(())
        });
        Some(GuardNodes {
            guard,
            asked,
            answers,
            options,
        })
    }

    /// The second half: tests what the strategy holds occluded, for a later frame.
    pub fn end_guard(&mut self, view: &ViewNodes, nodes: Option<GuardNodes>) {
        let Some(GuardNodes {
            guard,
            asked,
            answers,
            options,
        }) = nodes
        else {
            return;
        };
        let (size, inputs) = (view.size(), view.inputs());
        let while_away = self.guarded(options);
        let still = STILL * u64::from(self.frames_in_flight());
        let most = u64::from(self.scene_layout().slots.max(1));
        let occluders = self.unsubmitted_boxes(&view.named("shrunk occluders"), most);
        let tests = self.unsubmitted_boxes(&view.named("guarded boxes"), most);
        let uniform = BufferDesc::new(size_of::<GpuView>() as u64);
        let uniform = self.graph().buffer(view.named("guarded view"), uniform);
        let depth = TextureDesc::new(size[0], size[1], DEPTH_FORMAT).cleared(Clear::Depth(0.0));
        let depth = self.graph().texture(view.named("guarded depth"), depth);
        let mut node = self.graph().host_node(view.named("submit guard"));
        node.group(CULL).read(inputs.scene).read(inputs.view);
        node.read(guard);
        let asked = node.write(asked);
        let (occluders, tests) = (occluders.written_by(&mut node), tests.written_by(&mut node));
        let uniform = node.upload(uniform);
        let mut candidates = Candidates::default();
        node.run(move |ctx| {
            let (scene, frame) = (ctx.get(inputs.scene)?, ctx.get(inputs.view)?);
            let (guard, table) = (ctx.get(guard)?, &scene.table);
            let mut asked = ctx.get_mut(asked)?;
            let (mut boxes, mut hiding) = (ctx.get_mut(tests.list)?, ctx.get_mut(occluders.list)?);
            boxes.clear();
            hiding.clear();
            *asked = Asked {
                stamp: Stamp {
                    epoch: table.epoch(),
                    cuts: frame.cuts,
                },
                frame: guard.movement.frame(),
                eye: frame.camera.position,
                projection: Some(frame.camera.projection),
                ..Asked::default()
            };
            let wide = WideView::of(&frame, while_away.degrees);
            let shown = wide.as_ref().map_or(&*frame, |wide| &wide.frame);
            ctx.upload(uniform, 0, bytemuck::bytes_of(&shown.uniform()))?;
            let Some(wide) = wide.filter(|_| !guard.wanted.is_empty()) else {
                return Ok(());
            };
            candidates.find(table, &wide.frame);
            let stands = |slot: &u32| !guard.movement.has_moved_within(*slot, still);
            let hides = |slot: &u32| {
                table.is_occluder(*slot)
                    && stands(slot)
                    && guard.wanted.binary_search(slot).is_err()
            };
            let shrinking = Shrinking {
                wide: &wide,
                metres: while_away.metres,
            };
            let mut slots = Vec::new();
            for slot in candidates.inside().iter().copied().filter(hides) {
                let shrunk = shrinking.occluder(&table.oriented(slot), &table.bounds(slot));
                if let Some(made) = shrunk {
                    hiding.push(made);
                    slots.push(slot);
                }
            }
            asked.occluders = Arc::new(slots);
            // Behind nothing nothing is hidden.
            let tested = guard
                .wanted
                .iter()
                .copied()
                .filter(|_| hiding.query_count() > 0);
            let (mut slots, mut places) = (Vec::new(), Vec::new());
            for slot in tested {
                if table.class_of(slot).topology() != Topology::Triangles {
                    continue;
                }
                let (what, place) = match stands(&slot) {
                    true => (table.oriented(slot), table.bounds(slot)),
                    false => {
                        let place = table.bounds(slot).grown(DVec3::splat(while_away.metres));
                        (OrientedBox::aligned(&place), place)
                    }
                };
                if let Some(made) = shrinking.occludee(&what) {
                    boxes.push(made);
                    slots.push(slot);
                    places.push(place);
                }
            }
            (asked.slots, asked.tested) = (Arc::new(slots), Arc::new(places));
            ctx.upload(occluders.buffer, 0, bytemuck::cast_slice(hiding.boxes()))?;
            ctx.upload(tests.buffer, 0, bytemuck::cast_slice(boxes.boxes()))?;
            Ok(())
        });
        let wide = ViewInputs { uniform, ..inputs };
        let spec = |name: &str, pipeline| BoxPassSpec {
            name: view.named(name),
            group: CULL,
            pipeline,
        };
        let [hide, query] = self.guard_pipelines();
        let writing = spec("draw shrunk occluders", hide);
        let depth = box_depth_pass(self.graph, writing, wide, occluders, depth);
        let asking = spec("query guarded boxes", query);
        box_query_pass(self.graph, asking, wide, tests, depth, answers);
    }

    /// How far the eye goes while answers are under way.
    fn guarded(&self, options: GuardOptions) -> GuardOptions {
        let frames = f64::from(self.frames_in_flight());
        GuardOptions {
            metres: options.metres * frames * (1.0 + 1e-9),
            degrees: options.degrees * frames,
        }
    }
}

/// Makes boxes smaller that hide, and larger that are tested.
struct Shrinking<'a> {
    wide: &'a WideView,
    metres: f64,
}

impl Shrinking<'_> {
    /// The box that an entity hides by; `None` where nothing is left of it, or where the eye may come so near that the near plane cuts the entity.
    fn occluder(&self, what: &OrientedBox, bounds: &Aabb) -> Option<crate::boxes::GpuBox> {
        let eye = self.wide.frame.camera.position;
        let widening = Widening::new(&self.wide.frame, BoxContents::Triangles);
        let reach = what.centre.distance(eye) + f64::from(what.half.length());
        // Drawing it adds the widening again.
        let less = self.metres + self.wide.metres(BETWEEN, reach) + widening.margin(reach);
        if bounds.distance(eye) <= self.metres + self.wide.near_reach {
            return None;
        }
        let inner = what.inner()?;
        let half = inner.half.as_dvec3() - less;
        if half.min_element() <= 0.0 {
            return None;
        }
        widening.oriented(&OrientedBox {
            half: half.as_vec3(),
            ..inner
        })
    }

    /// The box that is tested for an entity; `None` where the image does not hold all of it.
    fn occludee(&self, what: &OrientedBox) -> Option<crate::boxes::GpuBox> {
        let eye = self.wide.frame.camera.position;
        let widening = Widening::new(&self.wide.frame, BoxContents::Triangles);
        let reach = what.centre.distance(eye) + f64::from(what.half.length());
        let half = what.half.as_dvec3() + self.wide.metres(BETWEEN, reach);
        let larger = OrientedBox {
            half: half.as_vec3(),
            ..*what
        };
        let corners = widening.corners(&larger)?;
        let shown = corners
            .into_iter()
            .all(|corner| self.wide.shows(corner.as_dvec3()));
        shown.then(|| widening.oriented(&larger)).flatten()
    }
}
