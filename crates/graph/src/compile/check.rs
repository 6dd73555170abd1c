//! Checks of the declaration alone: versions, updates, histories, loops, uses within one pass. They need no device.

use std::fmt;

use petgraph::graph::NodeIndex;

use crate::access::{Access, Use};
use crate::body::Body;
use crate::compile::order::digraph;
use crate::compile::versions::{Versions, is_inside};
use crate::error::CompileError;
use crate::graph::Graph;
use crate::pass::{Pass, PassKind};
use crate::resource::{Kind, Resource};

/// Finds everything that is wrong with the declaration, except for cycles.
pub(crate) fn declaration(
    graph: &Graph,
    versions: &Versions,
    edges: &[(usize, usize)],
    errors: &mut Vec<CompileError>,
) {
    for resource in &graph.resources {
        description(resource, errors);
    }
    for (index, pass) in graph.passes.iter().enumerate() {
        if pass.kind == PassKind::HostLoop {
            loop_condition(graph, versions, index, errors);
            continue;
        }
        if matches!(graph.bodies[index], Body::None) {
            errors.push(CompileError::NoBody {
                pass: pass.name.clone(),
            });
        }
        for used in &pass.uses {
            one_use(graph, versions, pass, used, errors);
        }
        conflicts(graph, pass, errors);
        if pass.kind == PassKind::Raster {
            attachments(graph, pass, errors);
        }
    }
    two_writers(graph, versions, edges, errors);
    updates(graph, versions, errors);
    outputs(graph, versions, errors);
}

fn description(resource: &Resource, errors: &mut Vec<CompileError>) {
    let what = match resource.kind {
        Kind::Texture(desc) => {
            let longest = desc.width.max(desc.height).max(1);
            if desc.width == 0 || desc.height == 0 || desc.layers == 0 || desc.mips == 0 {
                "has an extent of zero; width, height, layers and mips are at least 1"
            } else if desc.mips > 32 - longest.leading_zeros() {
                "has more mips than its size allows"
            } else if desc.samples == 0 || (desc.samples > 1 && (desc.mips > 1 || desc.layers > 1))
            {
                "is multisampled and has mips or layers (or no sample at all); wgpu has no such texture"
            } else {
                return;
            }
        }
        Kind::Buffer(desc) if desc.size == 0 => "has no bytes; give it at least 1",
        _ => return,
    };
    errors.push(CompileError::BadDescription {
        resource: resource.name.clone(),
        what,
    });
}

fn one_use(
    graph: &Graph,
    versions: &Versions,
    pass: &Pass,
    used: &Use,
    errors: &mut Vec<CompileError>,
) {
    let index = used.resource();
    let resource = &graph.resources[index];
    let missing = |version| CompileError::ReadBeforeWrite {
        pass: pass.name.clone(),
        resource: resource.name.clone(),
        version,
    };
    if used.raw.is_previous() && !used.access.is_late() {
        if used.access.writes() {
            errors.push(CompileError::WritesPrevious {
                pass: pass.name.clone(),
                resource: resource.name.clone(),
            });
        } else if resource.import {
            errors.push(CompileError::PreviousOfImport {
                pass: pass.name.clone(),
                resource: resource.name.clone(),
            });
        } else if versions.writers[index].is_empty() {
            errors.push(missing(0));
        }
        return;
    }
    if used.access.is_late() {
        if !resource.import && versions.writers[index].is_empty() {
            errors.push(missing(0));
        }
        return;
    }
    let version = used.raw.version;
    if version == 0 {
        if !resource.import && used.reads_now() {
            errors.push(missing(0));
        }
    } else if !versions.writers[index].contains_key(&version) {
        errors.push(missing(version));
    }
}

/// Finds uses of one resource that wgpu refuses within one pass.
fn conflicts(graph: &Graph, pass: &Pass, errors: &mut Vec<CompileError>) {
    for (n, a) in pass.uses.iter().enumerate() {
        for b in &pass.uses[n + 1..] {
            if a.raw.index != b.raw.index
                || a.raw.is_previous() != b.raw.is_previous()
                || a.access.is_late()
                || b.access.is_late()
            {
                continue;
            }
            if conflict(graph, pass.kind, a, b) {
                errors.push(CompileError::Conflict {
                    pass: pass.name.clone(),
                    resource: graph.resources[a.resource()].name.clone(),
                    first: a.access.word(),
                    second: b.access.word(),
                });
            }
        }
    }
}

fn conflict(graph: &Graph, kind: PassKind, a: &Use, b: &Use) -> bool {
    let writes = a.access.writes() || b.access.writes();
    match (&graph.resources[a.resource()].kind, kind) {
        (Kind::Texture(desc), PassKind::Raster) => {
            if a.access.is_attachment() && b.access.is_attachment() {
                (a.mip, a.layer) == (b.mip, b.layer)
            } else {
                // With several mips or layers, views of single ones separate reads from writes.
                writes && desc.mips == 1 && desc.layers == 1
            }
        }
        (Kind::Buffer(_), PassKind::Raster) => writes,
        _ => a.access.writes() && b.access.writes(),
    }
}

fn attachments(graph: &Graph, pass: &Pass, errors: &mut Vec<CompileError>) {
    let mut first: Option<(String, Shape)> = None;
    let mut depths = 0;
    for used in pass.uses.iter().filter(|used| used.access.is_attachment()) {
        let resource = &graph.resources[used.resource()];
        let Kind::Texture(desc) = resource.kind else {
            continue;
        };
        if used.mip >= desc.mips || used.layer >= desc.layers {
            errors.push(CompileError::NoSuchSubresource {
                pass: pass.name.clone(),
                resource: resource.name.clone(),
                mip: used.mip,
                layer: used.layer,
                mips: desc.mips,
                layers: desc.layers,
            });
            continue;
        }
        if matches!(used.access, Access::Depth | Access::DepthRead) {
            depths += 1;
        }
        let samples = if used.access == Access::Resolve {
            // The target has one sample; the attachment that it resolves has the pass's count.
            first.as_ref().map_or(1, |(_, shape)| shape.samples)
        } else {
            desc.samples
        };
        let shape = Shape {
            width: (desc.width >> used.mip).max(1),
            height: (desc.height >> used.mip).max(1),
            samples,
        };
        match &first {
            None => first = Some((resource.name.clone(), shape)),
            Some((name, other)) if *other != shape => {
                errors.push(CompileError::AttachmentMismatch {
                    pass: pass.name.clone(),
                    first: name.clone(),
                    first_shape: other.to_string(),
                    second: resource.name.clone(),
                    second_shape: shape.to_string(),
                });
            }
            Some(_) => {}
        }
    }
    if depths > 1 {
        errors.push(CompileError::Conflict {
            pass: pass.name.clone(),
            resource: String::from("the depth attachment"),
            first: "one texture",
            second: "another",
        });
    }
    if first.is_none() {
        errors.push(CompileError::NoAttachment {
            pass: pass.name.clone(),
        });
    }
}

/// What all attachments of a pass must agree in.
#[derive(Clone, Copy, PartialEq)]
struct Shape {
    width: u32,
    height: u32,
    samples: u32,
}

impl fmt::Display for Shape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            width,
            height,
            samples,
        } = self;
        write!(f, "{width}x{height}, {samples} samples")
    }
}

/// Finds passes that write one version without another order between them.
fn two_writers(
    graph: &Graph,
    versions: &Versions,
    edges: &[(usize, usize)],
    errors: &mut Vec<CompileError>,
) {
    let mut map = None;
    for (resource, by_version) in versions.writers.iter().enumerate() {
        for (version, writers) in by_version {
            for (n, &first) in writers.iter().enumerate() {
                for &second in &writers[n + 1..] {
                    let map = map
                        .get_or_insert_with(|| digraph(graph.passes.len(), edges.iter().copied()));
                    if !(reaches(map, first, second) || reaches(map, second, first)) {
                        errors.push(CompileError::TwoWriters {
                            first: graph.passes[first].name.clone(),
                            second: graph.passes[second].name.clone(),
                            resource: graph.resources[resource].name.clone(),
                            version: version - 1,
                        });
                    }
                }
            }
        }
    }
}

fn reaches(map: &petgraph::graph::DiGraph<(), ()>, from: usize, to: usize) -> bool {
    petgraph::algo::has_path_connecting(map, NodeIndex::new(from), NodeIndex::new(to), None)
}

fn updates(graph: &Graph, versions: &Versions, errors: &mut Vec<CompileError>) {
    for (resource, updaters) in versions.updaters.iter().enumerate() {
        let name = |pass: usize| graph.passes[pass].name.clone();
        let mut refuse = |pass: usize, why: String| {
            errors.push(CompileError::BadUpdate {
                pass: name(pass),
                resource: graph.resources[resource].name.clone(),
                why,
            });
        };
        for (n, &pass) in updaters.iter().enumerate() {
            if graph.resources[resource].import {
                refuse(pass, String::from("it is imported; write it instead"));
            }
            if n > 0 {
                refuse(
                    pass,
                    format!(
                        "pass `{}` updates it already; write the handle that one returned",
                        name(updaters[0])
                    ),
                );
            }
            let late = graph.passes[pass].uses.iter().any(|used| {
                used.resource() == resource && used.access.updates() && used.raw.version != 0
            });
            if late {
                refuse(
                    pass,
                    String::from(
                        "it was written before in this frame; update the handle the declaration returned",
                    ),
                );
            }
            if versions.previous_readers[resource].contains(&pass) {
                refuse(
                    pass,
                    String::from("looks back at it too; an update sees last frame's value already"),
                );
            }
        }
    }
}

fn outputs(graph: &Graph, versions: &Versions, errors: &mut Vec<CompileError>) {
    for output in &graph.outputs {
        let resource = output.resource();
        let name = &graph.resources[resource].name;
        let (writers, version) = (&versions.writers[resource], output.version);
        if version == 0 || output.is_previous() || !writers.contains_key(&version) {
            errors.push(CompileError::ReadBeforeWrite {
                pass: String::from("(output)"),
                resource: name.clone(),
                version: if output.is_previous() { 0 } else { version },
            });
        } else if let Some(pass) = writers
            .range(version.saturating_add(1)..)
            .find_map(|(_, passes)| passes.first())
        {
            errors.push(CompileError::OutputOverwritten {
                resource: name.clone(),
                version,
                pass: graph.passes[*pass].name.clone(),
            });
        }
    }
}

fn loop_condition(
    graph: &Graph,
    versions: &Versions,
    index: usize,
    errors: &mut Vec<CompileError>,
) {
    let pass = &graph.passes[index];
    let Some(looped) = pass.looped else {
        return;
    };
    if looped.condition.graph != graph.id {
        errors.push(CompileError::ForeignHandle {
            pass: pass.name.clone(),
        });
        return;
    }
    let resource = looped.condition.resource();
    let decided = versions.writers[resource]
        .get(&looped.condition.version)
        .is_some_and(|writers| {
            writers
                .iter()
                .any(|&writer| is_inside(graph, writer, index))
        });
    if !decided {
        errors.push(CompileError::LoopCondition {
            pass: pass.name.clone(),
            resource: graph.resources[resource].name.clone(),
        });
    }
}
