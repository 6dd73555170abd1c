//! Submitting proxies: the geometry that stands for a view's candidates in the depth pass and in the counting pass.

use std::sync::Arc;

use antumbra_graph::Host;

use crate::candidates::{Candidates, Queried};
use crate::draw_source::ListDraws;
use crate::entities::{MeshDetail, SceneTable};
use crate::frame_graph::{CULL, FrameGraph};
use crate::order::front_to_back;
use crate::view::ViewFrame;
use crate::view_nodes::ViewNodes;

/// Candidates, and the geometry that stands for them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProxySource {
    /// The entities.
    pub candidates: Host<Candidates>,
    /// What is drawn for each of them.
    pub detail: MeshDetail,
}

/// Where the full mesh replaces a [`MeshDetail::Proxy`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProxyLimits {
    /// Most pixels of the view's image by which a proxy may deviate from its mesh; infinity: any.
    pub deviation: f64,
    /// What proxies of meshes that cross the near plane do as occluders; full meshes as occluders always hide.
    pub at_near_plane: AtNearPlane,
}

/// What meshes that cross the near plane do as occluders. They are drawn as themselves in any case: an eye between a mesh and its proxy would see the wrong side
/// of the proxy.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum AtNearPlane {
    /// They hide nothing. For answers that are used a frame late: by then the eye may have passed through the mesh, and all that it hid is in sight.
    #[default]
    HideNothing,
    /// They hide what is behind them.
    Hide,
}

impl Default for ProxyLimits {
    /// Proxies everywhere but at the near plane, where nothing is hidden.
    fn default() -> Self {
        Self {
            deviation: f64::INFINITY,
            at_near_plane: AtNearPlane::HideNothing,
        }
    }
}

/// The proxies of a view's candidates, on the GPU.
#[derive(Debug, Clone, Copy)]
pub struct Proxies {
    /// What hides others: opaque triangles.
    pub occluders: ListDraws,
    /// What is tested but hides nothing; `None` where the scene has no such entity and occluders and occludees are drawn alike.
    pub others: Option<ListDraws>,
    /// Everything that is tested.
    pub occludees: ListDraws,
    /// The entities that are tested, to match the answers with.
    pub queried: Host<Queried>,
}

impl FrameGraph<'_> {
    /// Submits proxies of all candidates, as occluders in one detail and as occludees in another.
    pub fn proxies(
        &mut self,
        view: &ViewNodes,
        candidates: Host<Candidates>,
        occluder: MeshDetail,
        occludee: MeshDetail,
    ) -> Proxies {
        let of = |detail| ProxySource { candidates, detail };
        self.proxies_of(view, of(occluder), of(occludee))
    }

    /// Submits proxies of some candidates as occluders and of others as occludees. Of the first, only entities that can hide others are drawn; each of them must be
    /// among the second.
    pub fn proxies_of(
        &mut self,
        view: &ViewNodes,
        occluders: ProxySource,
        occludees: ProxySource,
    ) -> Proxies {
        self.proxies_within(view, occluders, occludees, ProxyLimits::default())
    }

    /// The same, with the full mesh in place of a [`MeshDetail::Proxy`] where the limits ask for it.
    pub fn proxies_within(
        &mut self,
        view: &ViewNodes,
        occluders: ProxySource,
        occludees: ProxySource,
        limits: ProxyLimits,
    ) -> Proxies {
        let inputs = view.inputs();
        let (hiding, candidates) = (occluders.candidates, occludees.candidates);
        let (occluder, occludee) = (occluders.detail, occludees.detail);
        let all_hide =
            hiding == candidates && self.scene_layout().classes().all(|class| class.occludes());
        let apart = occluder != occludee || !all_hide;
        let occluders = self.unsubmitted(&view.named("occluders"));
        let others = apart.then(|| self.unsubmitted(&view.named("other occludees")));
        let occludees = apart.then(|| self.unsubmitted(&view.named("occludees")));
        let queried = self.graph().host::<Queried>(view.named("tested"));
        let mut node = self.graph().host_node(view.named("submit proxies"));
        node.group(CULL).read(inputs.scene).read(candidates);
        if hiding != candidates {
            node.read(hiding);
        }
        let occluders = occluders.written_by(&mut node);
        let others = others.map(|list| list.written_by(&mut node));
        let all = occludees.map(|list| list.written_by(&mut node));
        let queried = node.write(queried);
        node.read(inputs.view);
        // Near proxies first spares fragments of far ones. Full meshes keep the canonical order, so that ties fall as in the reference.
        let sorts = occluder == MeshDetail::Proxy;
        // A bounding box stays one at any distance.
        let closest = match occludee {
            MeshDetail::Proxy => MeshDetail::Level(0),
            other => other,
        };
        let cut_hides_nothing = sorts && limits.at_near_plane == AtNearPlane::HideNothing;
        let mut order = Vec::new();
        node.run(move |ctx| {
            let (scene, candidates) = (ctx.get(inputs.scene)?, ctx.get(candidates)?);
            let hiding = ctx.get(hiding)?;
            let frame = ctx.get(inputs.view)?;
            let table = &scene.table;
            let inside = || candidates.inside().iter().copied();
            let occludes = |slot: &u32| table.is_occluder(*slot);
            let is_cut = |slot: &u32| cut_hides_nothing && hiding.is_near(*slot);
            let in_detail = |slot: u32| {
                let full = hiding.is_near(slot) || deviates(table, &frame, slot, limits.deviation);
                (slot, usize::from(full))
            };
            let hiders = hiding.inside().iter().copied();
            let hiders = hiders.filter(|slot| occludes(slot) && !is_cut(slot));
            let mut occluder_list = ctx.get_mut(occluders.list)?;
            if sorts {
                front_to_back(&mut order, table, &frame, hiders);
                let sorted = order.iter().map(|entry| in_detail(*entry as u32));
                occluder_list.fill_mixed(table, sorted, &[occluder, MeshDetail::Level(0)]);
            } else {
                occluder_list.fill(table, hiders, occluder);
            }
            let slots = bytemuck::cast_slice(occluder_list.slots());
            ctx.upload(occluders.slots, 0, slots)?;
            let mut tested = Arc::new(occluder_list.slots().to_vec());
            if let (Some(others), Some(all)) = (others, all) {
                let mut list = ctx.get_mut(others.list)?;
                let rest = inside()
                    .filter(|slot| !occludes(slot) || is_cut(slot) || !hiding.contains(*slot));
                list.fill_mixed(table, rest.map(in_detail), &[occludee, closest]);
                ctx.upload(others.slots, 0, bytemuck::cast_slice(list.slots()))?;
                let mut list = ctx.get_mut(all.list)?;
                list.fill_mixed(table, inside().map(in_detail), &[occludee, closest]);
                ctx.upload(all.slots, 0, bytemuck::cast_slice(list.slots()))?;
                tested = Arc::new(list.slots().to_vec());
            }
            *ctx.get_mut(queried)? = Queried {
                stamp: candidates.stamp(),
                slots: tested,
                ends: Arc::default(),
            };
            Ok(())
        });
        Proxies {
            occluders,
            others,
            occludees: all.unwrap_or(occluders),
            queried,
        }
    }
}

/// Whether an entity's proxy may be off by more than so many pixels.
fn deviates(table: &SceneTable, view: &ViewFrame, slot: u32, pixels: f64) -> bool {
    let metres = f64::from(table.deviation(slot));
    // Without a limit, or for a mesh without a proxy, the projection is not needed.
    metres > 0.0 && pixels.is_finite() && view.max_pixels(metres, &table.bounds(slot)) > pixels
}
