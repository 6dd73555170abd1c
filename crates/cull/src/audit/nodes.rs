//! The audit's nodes: take in what came back, choose patches once the verdicts are known, draw into them once the image is finished.

use std::sync::Arc;

use antumbra_draw::patches::{
    MARK_BYTES, PATCH_BYTES, PATCH_SIDE, PatchList, PatchMember, patch_pass,
};
use antumbra_draw::{MeshDetail, PipelineKind, SceneTable, ViewFrame};
use antumbra_graph::{BodyError, Buffer, BufferDesc, Host, HostBuilder, HostContext, HostRef};
use antumbra_scene::hierarchy::HierarchyShape;
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

use super::cover::Covers;
use super::doubts::Doubts;
use super::plan::{Lots, MOST, overhead};
use super::sift::{ENTRY_BYTES, GpuSettings, Listed, MOST_ENTRIES, draw_bytes};
use super::strata::{DOUBTFUL, Patches, STRATA};
use super::through;
use super::{AUDIT, Audit, AuditOptions, Experience, FrameAudit, Hit, Lessons};
use crate::candidates::{Candidates, Queried};
use crate::counting::Counting;
use crate::frame_graph::FrameGraph;
use crate::indirect::unasked;
use crate::strategy::{VerdictSource, VisibleSet};
use crate::tree::Tree;
use crate::verdict::{Verdict, Verdicts};
use crate::view_nodes::ViewNodes;

/// What was looked at; goes along with the marks.
#[derive(Debug, Clone, Default)]
pub(super) struct Looked {
    lots: Arc<Lots>,
    /// What it took to find and list what may show in each patch, in triangles.
    work: Arc<Vec<f64>>,
    cuts: u64,
    left_out: Option<f64>,
    /// Pixels of the image in which the GPU says what was left out, where it is there that the threshold is adapted.
    counted: Option<u32>,
    pixels: f64,
    census: bool,
    often: f64,
    /// There was no room for all that had to be drawn: the frame says nothing.
    spilled: bool,
}

/// Instances there is room for.
const ENTRIES: u64 = 65_536;
/// In a census, instances a patch there is room for.
const ENTRIES_A_PATCH: u64 = 64;
/// After the marks of all patches: the visible samples of all that a adapted threshold left out.
const LEFT_OUT_BYTES: u64 = size_of::<u32>() as u64;
/// How often the triangles a view draws are added up, in frames.
const RECKON: u64 = 16;
/// Which part of the candidates' triangles is taken to be drawn where that is decided on the GPU and no count is known.
const DRAWN_ON_GPU: f64 = 0.25;

impl Looked {
    /// Whether the frame is looked at.
    pub fn at_all(&self) -> bool {
        self.lots.looked
    }
}

impl FrameGraph<'_> {
    /// Audits what a view has drawn: after all of its nodes, with its final depth. What the audit finds is in the value, a frame or two late.
    /// It goes on from what the audits of other plans have learned.
    pub(crate) fn audit(
        &mut self,
        view: &ViewNodes,
        set: &VisibleSet,
        options: AuditOptions,
        lessons: Lessons,
    ) -> Host<Audit> {
        let [width, height] = view.size();
        let patches =
            u64::from(width.div_ceil(PATCH_SIDE)) * u64::from(height.div_ceil(PATCH_SIDE));
        let (most, entries) = match options.census {
            true => (patches, ENTRIES.max(patches * ENTRIES_A_PATCH)),
            false => (u64::from(MOST) * STRATA as u64, ENTRIES),
        };
        let shown = self.graph().buffer(
            view.named("audit: marks"),
            BufferDesc::new(most * PATCH_BYTES + LEFT_OUT_BYTES).zeroed(),
        );
        // What does not fit into a dispatch of one row leaves the frame out.
        let entries = entries.min(MOST_ENTRIES);
        let looked = self.graph().host::<Looked>(view.named("audit: looked at"));
        let audit = self.read_marks(view, shown, looked, lessons);
        let (listed, looked) = self.choose_patches(view, set, options, (audit, looked), entries);
        let depth = view.targets.depth;
        let (sifted, shown) = self.sift(view, listed, (depth, shown), entries);
        let way = Counting::by_fragments(self.gpu());
        let kind = match way {
            Counting::Atomics => PipelineKind::PatchEarly,
            _ => PipelineKind::PatchCompare,
        };
        let spec = self.pass(view.named("audit"), AUDIT, kind);
        let scratch = view.named("audit: scratch depth");
        let test = self.depth_test(way, depth, scratch, view.size());
        patch_pass(self.graph(), &spec, view.inputs(), sifted, test, shown);
        self.graph().output(looked);
        audit
    }

    /// Takes in the marks of an earlier frame.
    fn read_marks(
        &mut self,
        view: &ViewNodes,
        shown: Buffer,
        looked: Host<Looked>,
        lessons: Lessons,
    ) -> Host<Audit> {
        let audit = self.graph().host::<Audit>(view.named("audit"));
        let mut node = self.graph().host_node(view.named("audit: read late"));
        node.group(AUDIT);
        let marks = node.read_previous(shown, looked);
        let audit = node.updates(audit);
        node.run(move |ctx| {
            let mut audit = ctx.get_mut(audit)?;
            if let Some(learned) = lessons.take() {
                audit.learn(learned);
            }
            if let Some(late) = ctx.late(marks) {
                take(&mut audit, late.frame, late.tag, late.bytes);
            }
            Ok(())
        });
        audit
    }

    /// Chooses patches and lists who was culled behind them.
    fn choose_patches(
        &mut self,
        view: &ViewNodes,
        set: &VisibleSet,
        options: AuditOptions,
        (audit, looked): (Host<Audit>, Host<Looked>),
        entries: u64,
    ) -> (Listed, Host<Looked>) {
        let inputs = view.inputs();
        let tree = self.any_tree(view);
        let doubts = self.doubts(view, set.verdicts);
        let list = self.graph().host::<PatchList>(view.named("audit: list"));
        let mut buffer = |name: &str, bytes| {
            let name = view.named(&format!("audit: {name}"));
            self.graph().buffer(name, BufferDesc::new(bytes))
        };
        let entry_buffer = buffer("entries", entries * ENTRY_BYTES);
        let settings = buffer("settings", size_of::<GpuSettings>() as u64);
        let draws = buffer("draws", draw_bytes(entries));
        let none = buffer("no counts", 16);
        let source = set.verdicts;
        let mut node = self.graph().host_node(view.named("audit: choose patches"));
        node.group(AUDIT)
            .read(inputs.scene)
            .read(inputs.view)
            .read(tree)
            .read(audit);
        read(&mut node, source, doubts);
        let looked = node.write(looked);
        let listed = Listed {
            looked,
            list: node.write(list),
            settings: node.upload(settings),
            entries: node.upload(entry_buffer),
            draws: node.upload(draws),
            counts: match source {
                VerdictSource::Host(_) => node.upload(none),
                VerdictSource::Gpu { counts, .. } => counts,
            },
            adapted: match source {
                VerdictSource::Host(_) => None,
                VerdictSource::Gpu { adapted, .. } => adapted,
            },
        };
        let index = view.index() as u64;
        let mut chooser = Chooser::default();
        node.run(move |ctx| {
            let (scene, frame) = (ctx.get(inputs.scene)?, ctx.get(inputs.view)?);
            let seed = options.seed ^ index.wrapping_mul(0x9E37_79B9_7F4A_7C15);
            let mut random = Pcg64Mcg::seed_from_u64(seed.wrapping_add(ctx.frame()));
            let culled = Culled::of(ctx, source, doubts)?;
            let at = At {
                table: &scene.table,
                view: &frame,
                covers: Covers::new(&frame),
                tree: &*ctx.get(tree)?,
                culled: &culled,
                number: ctx.frame(),
            };
            let mut list = ctx.get_mut(listed.list)?;
            let lots = chooser.choose(&at, options, &*ctx.get(audit)?, &mut random);
            let work = chooser.list(&at, &lots, &mut list);
            let spilled = list.entries().len() as u64 > entries;
            if spilled {
                list.clear();
            }
            ctx.upload(listed.entries, 0, bytemuck::cast_slice(list.entries()))?;
            ctx.upload(listed.draws, 0, bytemuck::cast_slice(list.draws()))?;
            let threshold = match source {
                VerdictSource::Host(_) => {
                    ctx.upload(listed.counts, 0, &[0; 16])?;
                    u32::MAX
                }
                VerdictSource::Gpu { rule, .. } => rule.threshold,
            };
            let counted = match listed.adapted {
                Some(adapted) => Some(ctx.get(adapted.allowed)?.pixels),
                None => None,
            };
            let settings = GpuSettings::new(list.entries().len(), threshold);
            ctx.upload(listed.settings, 0, bytemuck::bytes_of(&settings))?;
            let [width, height] = frame.size;
            *ctx.get_mut(looked)? = Looked {
                lots: Arc::new(lots),
                work: Arc::new(work),
                cuts: frame.cuts,
                left_out: culled.left_out(),
                counted,
                pixels: f64::from(width) * f64::from(height),
                census: options.census,
                often: options.part(),
                spilled,
            };
            Ok(())
        });
        (listed, looked)
    }

    /// A tree that is kept anyway, or one of boxes, which the audit has to pay for.
    fn any_tree(&mut self, view: &ViewNodes) -> Host<Tree> {
        let kept = [
            HierarchyShape::Divided,
            HierarchyShape::Bvh,
            HierarchyShape::Groups,
        ]
        .into_iter()
        .find(|shape| self.keeps_tree(*shape));
        self.tree_for(view, kept.unwrap_or(HierarchyShape::Bvh), AUDIT)
    }
}

/// Declares what tells who was culled.
fn read(node: &mut HostBuilder<'_>, source: VerdictSource, doubts: Option<Host<Doubts>>) {
    if let Some(doubts) = doubts {
        node.read(doubts);
    }
    match source {
        VerdictSource::Host(verdicts) => node.read(verdicts),
        VerdictSource::Gpu {
            candidates,
            asked,
            adapted,
            ..
        } => {
            if let Some(adapted) = adapted {
                node.read(adapted.allowed);
            }
            node.read(candidates).read(asked)
        }
    };
}

/// Who was culled, as far as the host knows.
enum Culled<'a> {
    Host(HostRef<'a, Verdicts>),
    /// Whoever is not drawn for sure; the GPU leaves out the rest of what is drawn.
    Gpu {
        candidates: HostRef<'a, Candidates>,
        unasked: Vec<u32>,
        doubts: Option<HostRef<'a, Doubts>>,
    },
}

impl<'a> Culled<'a> {
    fn of(
        ctx: &HostContext<'a>,
        source: VerdictSource,
        doubts: Option<Host<Doubts>>,
    ) -> Result<Self, BodyError> {
        Ok(match source {
            VerdictSource::Host(verdicts) => Self::Host(ctx.get(verdicts)?),
            VerdictSource::Gpu {
                candidates, asked, ..
            } => {
                let candidates = ctx.get(candidates)?;
                let asked: &Queried = &*ctx.get(asked)?;
                let unasked = unasked(&candidates, asked);
                Self::Gpu {
                    candidates,
                    unasked,
                    doubts: doubts.map(|doubts| ctx.get(doubts)).transpose()?,
                }
            }
        })
    }

    /// Whether an entity may have been culled.
    fn has(&self, slot: u32) -> bool {
        match self {
            Self::Host(verdicts) => !verdicts.get(slot).draws(),
            Self::Gpu {
                candidates,
                unasked,
                ..
            } => !candidates.is_exempt(slot) && unasked.binary_search(&slot).is_err(),
        }
    }

    /// What was left out by the frame's own count, in percent, where the host knows that.
    fn left_out(&self) -> Option<f64> {
        match self {
            Self::Host(verdicts) => verdicts.left_out_percent(),
            Self::Gpu { .. } => None,
        }
    }

    /// Entities that are left out though samples of them were seen, as far as the host knows.
    fn doubtful(&self) -> Vec<u32> {
        match self {
            Self::Host(verdicts) => verdicts.of_kind(Verdict::BelowThreshold).collect(),
            Self::Gpu {
                candidates, doubts, ..
            } => {
                let left_out = doubts
                    .iter()
                    .flat_map(|doubts| doubts.may_be_left_out(candidates));
                left_out.collect()
            }
        }
    }

    /// Triangles that the view draws.
    fn triangles_drawn(&self, table: &SceneTable) -> f64 {
        let of = |slot: u32, level| f64::from(table.primitives_of(slot, MeshDetail::Level(level)));
        match self {
            Self::Host(verdicts) => {
                let drawn = verdicts.drawn();
                drawn.map(|slot| of(slot, verdicts.level(slot))).sum()
            }
            Self::Gpu {
                candidates, doubts, ..
            } => {
                let known = doubts
                    .as_ref()
                    .and_then(|doubts| doubts.drawn(candidates, |slot| of(slot, 0)));
                known.unwrap_or_else(|| {
                    let all = candidates.inside().iter();
                    all.map(|slot| of(*slot, 0)).sum::<f64>() * DRAWN_ON_GPU
                })
            }
        }
    }
}

/// A frame as the chooser sees it.
struct At<'a> {
    table: &'a SceneTable,
    view: &'a ViewFrame,
    covers: Covers,
    tree: &'a Tree,
    culled: &'a Culled<'a>,
    number: u64,
}

/// What is kept from frame to frame.
#[derive(Debug, Default)]
struct Chooser {
    patches: Patches,
    triangles: Option<f64>,
    stack: Vec<u32>,
    found: Vec<u32>,
    members: Vec<PatchMember>,
}

impl Chooser {
    fn choose(
        &mut self,
        at: &At<'_>,
        options: AuditOptions,
        audit: &Audit,
        random: &mut Pcg64Mcg,
    ) -> Lots {
        self.patches.reset(at.view.size);
        if options.census {
            return Lots::all(&self.patches);
        }
        self.patches
            .doubt(at.table, &at.covers, at.culled.doubtful().into_iter());
        let triangles = match self.triangles {
            Some(known) if !at.number.is_multiple_of(RECKON) => known,
            _ => at.culled.triangles_drawn(at.table),
        };
        self.triangles = Some(triangles);
        let budget = triangles * options.share;
        let Experience { costs, moments } = audit.experience();
        let known = (budget, costs, moments);
        Lots::draw(&self.patches, known, options.part(), random)
    }

    /// Lists what may show in each patch, and says what finding it took.
    fn list(&mut self, at: &At<'_>, lots: &Lots, list: &mut PatchList) -> Vec<f64> {
        list.clear();
        let mut work = Vec::with_capacity(lots.drawn.len());
        for (patch, _) in &lots.drawn {
            let place = self.patches.place(*patch);
            let frustum = through::frustum(at.view, place);
            self.found.clear();
            let nodes = through::walk(at.tree, &frustum, &mut self.stack, &mut self.found);
            let culled = self.found.iter().filter(|slot| at.culled.has(**slot));
            let members = culled.filter_map(|slot| {
                let shadow = at.covers.shadow(at.table, *slot);
                Some(PatchMember {
                    slot: *slot,
                    cover: at.covers.cover(&shadow, place)?,
                })
            });
            self.members.clear();
            self.members.extend(members);
            let draws = list.push(at.table, place, &mut self.members);
            work.push(overhead(nodes, self.members.len(), draws));
        }
        work
    }
}

/// Takes in the marks of a frame.
fn take(audit: &mut Audit, frame: u64, looked: &Looked, bytes: &[u8]) {
    if looked.spilled {
        return;
    }
    let side = f64::from(PATCH_SIDE);
    let pixels_a_patch = side * side;
    let Experience { costs, moments } = &mut audit.experience;
    if looked.lots.looked {
        moments.fade();
        costs.fade();
    }
    let mut hits = Vec::new();
    let kept = bytes.chunks_exact(PATCH_BYTES as usize);
    let drawn = looked.lots.drawn.iter().zip(looked.work.iter());
    for (((_, kind), work), kept) in drawn.zip(kept) {
        let (marks, indices) = kept.split_at(MARK_BYTES as usize);
        let indices: u32 = bytemuck::pod_read_unaligned(indices);
        costs.note(*kind, work + f64::from(indices) / 3.0);
        let shown: u32 = marks.iter().map(|byte| byte.count_ones()).sum();
        moments.note(*kind, f64::from(shown) / pixels_a_patch);
        if shown > 0 {
            let weight = looked.lots.weights.get(*kind).copied().unwrap_or(0.0);
            hits.push(Hit {
                pixels: f64::from(shown) * weight,
                doubtful: *kind == DOUBTFUL,
            });
        }
    }
    let left_out = match (looked.counted, bytes.last_chunk()) {
        (Some(_), _) if !looked.lots.looked => None,
        (Some(pixels), Some(samples)) => {
            Some(f64::from(u32::from_le_bytes(*samples)) / f64::from(pixels.max(1)) * 100.0)
        }
        _ => looked.left_out,
    };
    let heaviest = match looked.census {
        true => 0.0,
        false => looked.lots.heaviest() * pixels_a_patch,
    };
    audit.take(FrameAudit {
        frame,
        cuts: looked.cuts,
        patches: looked.lots.drawn.len() as u32,
        looked: looked.lots.looked,
        often: looked.often,
        pixels: looked.pixels,
        heaviest,
        hits,
        left_out,
    });
}
