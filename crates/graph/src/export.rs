//! Exports a plan as DOT, Mermaid or JSON, all from one model.
//! Solid edges are data of this frame, dashed ones read an earlier frame. Sync points are red, pruned passes grey.

use std::fmt::Write as _;

use crate::compile::order::Step;
use crate::pass::PassKind;
use crate::physical::NOWHERE;
use crate::plan::Plan;
use crate::resource::Kind;

/// The formats of [`Plan::export`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PlanFormat {
    /// Graphviz.
    Dot,
    /// Mermaid, which Markdown viewers render.
    Mermaid,
    /// A JSON object with `passes`, `resources` and `edges`, for other tools.
    #[cfg(feature = "json")]
    Json,
}

#[cfg_attr(feature = "json", derive(serde::Serialize))]
#[cfg_attr(
    not(feature = "json"),
    allow(dead_code, reason = "some fields are for JSON alone")
)]
struct Model<'a> {
    graph: &'a str,
    sync_points: usize,
    passes: Vec<PassNode<'a>>,
    resources: Vec<ResourceNode<'a>>,
    edges: Vec<Edge>,
}

#[cfg_attr(feature = "json", derive(serde::Serialize))]
#[cfg_attr(
    not(feature = "json"),
    allow(dead_code, reason = "some fields are for JSON alone")
)]
struct PassNode<'a> {
    name: &'a str,
    kind: PassKind,
    #[cfg_attr(feature = "json", serde(skip_serializing_if = "Option::is_none"))]
    group: Option<&'static str>,
    #[cfg_attr(feature = "json", serde(skip_serializing_if = "Option::is_none"))]
    in_loop: Option<usize>,
    /// Its position in the order in which passes run.
    #[cfg_attr(feature = "json", serde(skip_serializing_if = "Option::is_none"))]
    order: Option<usize>,
    sync_point: bool,
    pruned: bool,
    #[cfg_attr(feature = "json", serde(skip_serializing_if = "Option::is_none"))]
    cpu_us: Option<f64>,
    #[cfg_attr(feature = "json", serde(skip_serializing_if = "Option::is_none"))]
    gpu_us: Option<f64>,
}

#[cfg_attr(feature = "json", derive(serde::Serialize))]
#[cfg_attr(
    not(feature = "json"),
    allow(dead_code, reason = "some fields are for JSON alone")
)]
struct ResourceNode<'a> {
    name: &'a str,
    kind: &'static str,
    shape: String,
    imported: bool,
    output: bool,
    history: bool,
    used: bool,
    /// Numbers of its wgpu objects, two for a double-buffered history. Resources with the same number share an object.
    objects: Vec<u32>,
}

#[cfg_attr(feature = "json", derive(serde::Serialize))]
#[cfg_attr(
    not(feature = "json"),
    allow(dead_code, reason = "some fields are for JSON alone")
)]
struct Edge {
    pass: usize,
    resource: usize,
    access: &'static str,
    writes: bool,
    /// It reads an earlier frame.
    history: bool,
}

impl Plan {
    /// The plan as text: passes with their times where known, resources and edges. Histories are dashed, sync points marked, pruned passes
    /// grey, shared objects listed.
    #[must_use]
    pub fn export(&self, format: PlanFormat) -> String {
        let model = self.model();
        match format {
            PlanFormat::Dot => dot(&model),
            PlanFormat::Mermaid => mermaid(&model),
            #[cfg(feature = "json")]
            // A model of plain values always serialises. If serde fails all the same, its message is the text.
            PlanFormat::Json => {
                serde_json::to_string_pretty(&model).unwrap_or_else(|error| error.to_string())
            }
        }
    }

    fn model(&self) -> Model<'_> {
        let mut order = vec![None; self.passes.len()];
        let mut sync = vec![false; self.passes.len()];
        let mut next = 0;
        mark(&self.steps, &mut order, &mut sync, &mut next);
        let times = self.timings();
        let passes = self.passes.iter().enumerate().map(|(index, pass)| {
            let time = times
                .as_ref()
                .and_then(|times| times.passes.iter().find(|time| time.name == pass.name));
            PassNode {
                name: &pass.name,
                kind: pass.kind,
                group: pass.group,
                in_loop: pass.parent,
                order: order[index],
                sync_point: sync[index],
                pruned: !self.kept[index],
                cpu_us: time.map(|time| time.cpu.as_secs_f64() * 1e6),
                gpu_us: time
                    .and_then(|time| time.gpu)
                    .map(|gpu| gpu.as_secs_f64() * 1e6),
            }
        });
        let resources = self.layout.placed.iter().map(|placed| {
            let (kind, shape) = shape(&placed.resource.kind);
            let mut objects = placed.slots.to_vec();
            objects.dedup();
            objects.retain(|slot| *slot != NOWHERE);
            ResourceNode {
                name: &placed.resource.name,
                kind,
                shape,
                imported: placed.resource.import,
                output: placed.output,
                history: placed.history,
                used: placed.used,
                objects,
            }
        });
        let edges = self.passes.iter().enumerate().flat_map(|(index, pass)| {
            pass.uses.iter().flat_map(move |used| {
                let edge = |writes, history| Edge {
                    pass: index,
                    resource: used.resource(),
                    access: used.access.word(),
                    writes,
                    history,
                };
                let history =
                    used.raw.is_previous() || used.access.is_late() || used.access.updates();
                let read = (history || !used.access.writes()).then(|| edge(false, history));
                let write = used.access.writes().then(|| edge(true, false));
                read.into_iter().chain(write)
            })
        });
        Model {
            graph: &self.name,
            sync_points: self.sync_points(),
            passes: passes.collect(),
            resources: resources.collect(),
            edges: edges.collect(),
        }
    }
}

/// Numbers the passes in the order in which they run, and marks those that wait for the GPU.
fn mark(steps: &[Step], order: &mut [Option<usize>], sync: &mut [bool], next: &mut usize) {
    for step in steps {
        let (passes, waits) = match step {
            Step::Pass(pass) | Step::Loop(pass, _) => (std::slice::from_ref(pass), false),
            Step::Sync(passes) => (passes.as_slice(), true),
        };
        for &pass in passes {
            order[pass] = Some(*next);
            sync[pass] = waits;
            *next += 1;
        }
        if let Step::Loop(_, steps) = step {
            mark(steps, order, sync, next);
        }
    }
}

fn shape(kind: &Kind) -> (&'static str, String) {
    match kind {
        Kind::Texture(desc) => {
            let mut words = format!("{}x{} {:?}", desc.width, desc.height, desc.format);
            for (count, what) in [
                (desc.layers, "layers"),
                (desc.mips, "mips"),
                (desc.samples, "samples"),
            ] {
                if count > 1 {
                    let _ = write!(words, ", {count} {what}");
                }
            }
            ("texture", words)
        }
        Kind::Buffer(desc) => ("buffer", format!("{} bytes", desc.size)),
        Kind::Host(_) => ("host", String::new()),
    }
}

impl PassNode<'_> {
    fn lines(&self) -> Vec<String> {
        let mut lines = vec![String::from(self.name)];
        let group = self
            .group
            .map_or_else(String::new, |group| format!(", {group}"));
        lines.push(format!("{}{group}", self.kind.word()));
        if self.sync_point {
            lines.push(String::from("sync point"));
        }
        if self.pruned {
            lines.push(String::from("pruned"));
        }
        if let Some(gpu) = self.gpu_us {
            lines.push(format!("GPU {gpu:.0} us"));
        }
        if let Some(cpu) = self.cpu_us {
            lines.push(format!("CPU {cpu:.0} us"));
        }
        lines
    }
}

impl ResourceNode<'_> {
    fn lines(&self) -> Vec<String> {
        let mut lines = vec![String::from(self.name)];
        if !self.shape.is_empty() {
            lines.push(self.shape.clone());
        }
        if self.imported {
            lines.push(String::from("imported"));
        }
        if self.output {
            lines.push(String::from("output"));
        }
        lines
    }
}

/// A line for each object that several resources share, by kind.
fn shared(model: &Model<'_>) -> Vec<String> {
    let mut lines = Vec::new();
    for kind in ["texture", "buffer"] {
        let objects = model
            .resources
            .iter()
            .filter(|resource| resource.kind == kind && !resource.imported)
            .flat_map(|resource| resource.objects.iter().copied());
        let objects: std::collections::BTreeSet<u32> = objects.collect();
        for object in objects {
            let names: Vec<&str> = model
                .resources
                .iter()
                .filter(|resource| {
                    resource.kind == kind
                        && !resource.imported
                        && resource.objects.contains(&object)
                })
                .map(|resource| resource.name)
                .collect();
            if names.len() > 1 {
                lines.push(format!("one {kind}: {}", names.join(", ")));
            }
        }
    }
    lines
}

fn dot(model: &Model<'_>) -> String {
    let quote = |text: &str| text.replace('\\', "\\\\").replace('"', "\\\"");
    let label = |lines: Vec<String>| {
        let lines: Vec<String> = lines.iter().map(|line| quote(line)).collect();
        lines.join("\\n")
    };
    let mut text = String::new();
    let _ = writeln!(text, "digraph \"{}\" {{", quote(model.graph));
    text.push_str("  rankdir=LR;\n  node [fontname=\"sans-serif\"];\n");
    for (index, pass) in model.passes.iter().enumerate() {
        let style = if pass.pruned {
            ", color=gray, fontcolor=gray"
        } else if pass.sync_point {
            ", color=red, peripheries=2"
        } else if pass.kind == PassKind::HostLoop {
            ", style=bold"
        } else {
            ""
        };
        let _ = writeln!(
            text,
            "  p{index} [shape=box, label=\"{}\"{style}];",
            label(pass.lines())
        );
        if let Some(looped) = pass.in_loop {
            let _ = writeln!(
                text,
                "  p{looped} -> p{index} [style=dotted, arrowhead=none];"
            );
        }
    }
    for (index, resource) in model.resources.iter().enumerate() {
        let style = if resource.used {
            ""
        } else {
            ", color=gray, fontcolor=gray"
        };
        let lines = label(resource.lines());
        let _ = writeln!(
            text,
            "  r{index} [shape=ellipse, label=\"{lines}\"{style}];"
        );
    }
    for edge in &model.edges {
        let (from, to) = ends(edge);
        let style = if edge.history { ", style=dashed" } else { "" };
        let _ = writeln!(text, "  {from} -> {to} [label=\"{}\"{style}];", edge.access);
    }
    let notes = shared(model);
    if !notes.is_empty() {
        let _ = writeln!(text, "  shared [shape=note, label=\"{}\"];", label(notes));
    }
    text.push_str("}\n");
    text
}

fn mermaid(model: &Model<'_>) -> String {
    let label = |lines: Vec<String>| {
        let lines: Vec<String> = lines
            .iter()
            .map(|line| {
                line.replace('&', "&amp;")
                    .replace('"', "&quot;")
                    .replace('<', "&lt;")
            })
            .collect();
        lines.join("<br/>")
    };
    let mut text = String::from("flowchart LR\n");
    for (index, pass) in model.passes.iter().enumerate() {
        let lines = label(pass.lines());
        let (open, close) = if pass.sync_point {
            ("[[", "]]")
        } else {
            ("[", "]")
        };
        let class = if pass.pruned {
            ":::pruned"
        } else if pass.sync_point {
            ":::sync"
        } else {
            ""
        };
        let _ = writeln!(text, "  p{index}{open}\"{lines}\"{close}{class}");
        if let Some(looped) = pass.in_loop {
            let _ = writeln!(text, "  p{looped} --- p{index}");
        }
    }
    for (index, resource) in model.resources.iter().enumerate() {
        let class = if resource.used { "" } else { ":::pruned" };
        let _ = writeln!(text, "  r{index}([\"{}\"]){class}", label(resource.lines()));
    }
    for edge in &model.edges {
        let (from, to) = ends(edge);
        let arrow = if edge.history { "-.->" } else { "-->" };
        let _ = writeln!(text, "  {from} {arrow}|\"{}\"| {to}", edge.access);
    }
    let notes = shared(model);
    if !notes.is_empty() {
        let _ = writeln!(text, "  shared>\"{}\"]", label(notes));
    }
    text.push_str("  classDef sync stroke:#c00,stroke-width:3px\n");
    text.push_str("  classDef pruned color:#999,stroke:#999,stroke-dasharray:2\n");
    text
}

fn ends(edge: &Edge) -> (String, String) {
    let (pass, resource) = (format!("p{}", edge.pass), format!("r{}", edge.resource));
    if edge.writes {
        (pass, resource)
    } else {
        (resource, pass)
    }
}
