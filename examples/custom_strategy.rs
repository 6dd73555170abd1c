//! A custom strategy: draws the depth of the occluders that appear largest (chosen after Coorg and Teller, *Real-Time Occlusion Culling for
//! Models with Large Occluders*, 1997), and tests each occludee against it with a hardware query, whose answer stays on the GPU.

use antumbra::cull::{
    AdapterChoice, Counting, DeclareError, FrameGraph, Gpu, Latency, MeshDetail, ProxySource,
    Stage, StageOptions, Strategy, ViewInput, ViewNodes, ViewSpec, VisibleSet,
};
use antumbra::draw::GpuScene;
use antumbra::measure::path::CameraPath;
use antumbra::strategies::registry;

/// The number of occluders, and the proxy of the occludees: `Level(0)` for their meshes or, much faster, `Box` for their bounding boxes.
pub struct LargestOccluders(pub usize, pub MeshDetail);

impl Strategy for LargestOccluders {
    fn name(&self) -> &str {
        "largest-occluders"
    }
    fn summary(&self) -> &str {
        "tests what is in the frustum against the occluders that look largest"
    }
    fn conservative(&self) -> bool {
        self.1 == MeshDetail::Level(0) // A box may round away from the last sample of its mesh.
    }
    fn latency(&self) -> Option<Latency> {
        Some(Latency::OnGpu)
    }
    #[rustfmt::skip]
    fn declare(&mut self, g: &mut FrameGraph<'_>, view: &mut ViewNodes) -> Result<VisibleSet, DeclareError> {
        let Self(most, occludee) = *self;
        let candidates = g.in_frustum(view);
        let largest = g.narrowed(view, "largest occluders", candidates, move |table, frame, slots| {
            slots.retain(|slot| table.is_occluder(*slot));
            slots.sort_by_cached_key(|slot| {
                let bounds = table.bounds(*slot);
                let looks = bounds.half_extents().length() / bounds.distance(frame.camera.position);
                std::cmp::Reverse(looks.to_bits()) // The bits of positive floats sort as the floats do.
            });
            slots.truncate(most);
        });
        let proxies = g.proxies_of(
            view,
            ProxySource { candidates: largest, detail: MeshDetail::Level(0) },
            ProxySource { candidates, detail: occludee },
        );
        let counts = g.count_samples(view, proxies, Counting::Queries, view.size());
        Ok(g.visible_samples(view, candidates, counts, Latency::OnGpu, 0))
    }
}

/// Draws the built-in grid with three strategies; one of them is the custom one.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut registry = registry();
    registry.register(|| Box::new(LargestOccluders(800, MeshDetail::Box)));
    let mut grid = antumbra::demo_scenes::by_name("grid", Some(12))?;
    let scene = GpuScene::new(&Gpu::open(&AdapterChoice::Auto)?, &mut grid)?;
    let path = CameraPath::orbit_around(&grid.bounds().ok_or("an empty scene")?, 4.0 / 3.0, 8)?;
    for name in ["none", "frustum", "largest-occluders"] {
        let (strategy, view) = (registry.parse(name)?, ViewSpec::main(640, 480));
        let mut stage = Stage::new(&scene, strategy, vec![view], StageOptions::default())?;
        stage.frame(&scene, &[ViewInput::new(path.camera(0)?)])?;
        let drawn = stage.verdicts(0, &scene)?.drawn().count();
        println!("{name}: drew {drawn} of {} entities", scene.table().live());
    }
    Ok(())
}
