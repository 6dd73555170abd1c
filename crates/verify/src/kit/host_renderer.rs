//! Stands in for a renderer that is not ours. It shades with the built-in pipelines and then goes on: every pass has a node of its own after it, so that
//! a strategy that does not take the versions it is given back draws into textures that another node writes, and does not compile.

use antumbra_cull::{DrawSource, Pass, Renderer, ShadeTargets, StageOutput, Targets, TestRenderer};
use antumbra_draw::BuiltinRenderer;

/// The renderer.
pub(super) struct HostRenderer(pub BuiltinRenderer);

impl Renderer for HostRenderer {
    fn begin_view(&mut self, pass: Pass<'_>) {
        self.0.begin_view(pass);
    }

    fn shade(&mut self, pass: Pass<'_>, source: DrawSource, into: ShadeTargets) -> ShadeTargets {
        let Pass {
            graph,
            name,
            group,
            output,
            ..
        } = pass;
        let own = format!("{name}: the host's own");
        let built_in = Pass {
            graph: &mut *graph,
            name,
            group,
            output,
            ..pass
        };
        let shaded = self.0.shade(built_in, source, into);
        let mut node = graph.raster(own);
        node.group(group);
        let colour = match output {
            StageOutput::Image => node.colour(shaded.targets.colour),
            StageOutput::Answers => shaded.targets.colour,
        };
        let ids = shaded.ids.map(|ids| node.colour(ids));
        let depth = node.depth(shaded.targets.depth);
        node.run(|_| Ok(()));
        ShadeTargets {
            targets: Targets { colour, depth },
            ids,
            queries: shaded.queries,
        }
    }

    fn tests(&mut self) -> &mut dyn TestRenderer {
        self.0.tests()
    }
}
