//! The audit's nodes: read the marks of an earlier frame, choose patches once the verdicts are known, draw into them once the image is finished.

use std::sync::Arc;

use antumbra_graph::{Buffer, BufferDesc, Host};
use antumbra_scene::hierarchy::HierarchyShape;
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

use super::audited_frame::AuditedFrame;
use super::chooser::{Chooser, ChooserInput, Culled};
use super::depth_cull::{ENTRY_BYTES, GpuSettings, MOST_ENTRIES, PatchBuffers, draw_bytes};
use super::sample_plan::MOST;
use super::screen_box::ScreenProjector;
use super::strata::STRATA;
use super::{AUDIT, Audit, AuditOptions, Lessons};
use crate::counting::Counting;
use crate::draw_source::patches::{PATCH_BYTES, PATCH_SIDE, PatchList};
use crate::frame_graph::FrameGraph;
use crate::strategy::VerdictSource;
use crate::tree::Tree;
use crate::view_nodes::ViewNodes;

/// The number of entries there is room for.
const ENTRIES: u64 = 65_536;
/// The number of entries a patch there is room for in a census.
const ENTRIES_A_PATCH: u64 = 64;
/// After the marks of all patches: the visible samples of the entities that an adaptive threshold left out.
const LEFT_OUT_BYTES: u64 = size_of::<u32>() as u64;

/// The host values of an audit.
struct AuditValues {
    audit: Host<Audit>,
    frame: Host<AuditedFrame>,
}

impl FrameGraph<'_> {
    /// Audits what a view has drawn, after all of its nodes and with its final depth. The result is in the returned value, a frame or two late.
    /// The audit goes on from what the audits of other plans have learned.
    pub(crate) fn audit(
        &mut self,
        view: &ViewNodes,
        source: VerdictSource,
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
        // A frame with more entries than one row of workgroups holds is not audited.
        let entries = entries.min(MOST_ENTRIES);
        let frame = self
            .graph()
            .host::<AuditedFrame>(view.named("audit: frame"));
        let audit = self.read_marks(view, shown, frame, lessons);
        let buffers =
            self.choose_patches(view, source, options, AuditValues { audit, frame }, entries);
        let depth = view.targets.depth;
        let left = self.depth_cull(view, buffers, depth, shown, entries);
        let way = Counting::by_fragments(self.gpu(), self.samples());
        let scratch = view.named("audit: scratch depth");
        let test = self.depth_test(way, depth, scratch, view.size());
        self.mark_patches(view, "audit", left.draws, test, left.shown);
        self.graph().output(buffers.frame);
        audit
    }

    /// Reads the marks of an earlier frame.
    fn read_marks(
        &mut self,
        view: &ViewNodes,
        shown: Buffer,
        frame: Host<AuditedFrame>,
        lessons: Lessons,
    ) -> Host<Audit> {
        let audit = self.graph().host::<Audit>(view.named("audit"));
        let mut node = self.graph().host_node(view.named("audit: read late"));
        node.group(AUDIT);
        let marks = node.read_previous(shown, frame);
        let audit = node.updates(audit);
        node.run(move |ctx| {
            let mut audit = ctx.get_mut(audit)?;
            if let Some(learned) = lessons.take() {
                audit.learn(learned);
            }
            if let Some(late) = ctx.late(marks) {
                late.tag.take_marks(&mut audit, late.frame, late.bytes);
            }
            Ok(())
        });
        audit
    }

    /// Chooses patches, and lists the culled entities behind them.
    fn choose_patches(
        &mut self,
        view: &ViewNodes,
        source: VerdictSource,
        options: AuditOptions,
        AuditValues { audit, frame }: AuditValues,
        entries: u64,
    ) -> PatchBuffers {
        let inputs = view.inputs();
        let tree = self.any_tree(view);
        let uncertain = self.uncertain(view, source);
        let list = self.graph().host::<PatchList>(view.named("audit: list"));
        let mut buffer = |name: &str, bytes| {
            let name = view.named(&format!("audit: {name}"));
            self.graph().buffer(name, BufferDesc::new(bytes))
        };
        let entry_buffer = buffer("entries", entries * ENTRY_BYTES);
        let settings = buffer("settings", size_of::<GpuSettings>() as u64);
        let draws = buffer("draws", draw_bytes(entries));
        let none = buffer("no counts", 16);
        let samples = self.samples();
        let mut node = self.graph().host_node(view.named("audit: choose patches"));
        node.group(AUDIT)
            .read(inputs.scene)
            .read(inputs.view)
            .read(tree)
            .read(audit);
        Culled::declare(&mut node, source, uncertain);
        let audited = node.write(frame);
        let buffers = PatchBuffers {
            frame: audited,
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
            let culled = Culled::of(ctx, source, uncertain)?;
            let at = ChooserInput {
                table: &scene.table,
                view: &frame,
                projector: ScreenProjector::new(&frame),
                tree: &*ctx.get(tree)?,
                culled: &culled,
                number: ctx.frame(),
            };
            let mut list = ctx.get_mut(buffers.list)?;
            let plan = chooser.choose(&at, options, &*ctx.get(audit)?, &mut random);
            let work = chooser.list(&at, &plan, &mut list);
            let spilled = list.entries().len() as u64 > entries;
            if spilled {
                list.clear();
            }
            ctx.upload(buffers.entries, 0, bytemuck::cast_slice(list.entries()))?;
            ctx.upload(buffers.draws, 0, bytemuck::cast_slice(list.draws()))?;
            let threshold = match source {
                VerdictSource::Host(_) => {
                    ctx.upload(buffers.counts, 0, &[0; 16])?;
                    u32::MAX
                }
                VerdictSource::Gpu { rule, .. } => rule.threshold,
            };
            let counted = match buffers.adapted {
                Some(adapted) => Some(ctx.get(adapted.allowed)?.image_samples),
                None => None,
            };
            let settings = GpuSettings::new(list.entries().len(), threshold, samples);
            ctx.upload(buffers.settings, 0, bytemuck::bytes_of(&settings))?;
            let [width, height] = frame.size;
            *ctx.get_mut(audited)? = AuditedFrame {
                plan: Arc::new(plan),
                work: Arc::new(work),
                cuts: frame.cuts,
                left_out: culled.left_out(),
                counted,
                pixels: f64::from(width) * f64::from(height),
                census: options.census,
                frame_share: options.frame_share_in_range(),
                spilled,
            };
            Ok(())
        });
        buffers
    }

    /// A tree that the strategy keeps anyway, or else a bounding volume hierarchy, whose cost counts as the audit's.
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
