//! Pruning: keeps the passes whose results are used outside of the frame, and the passes that those need, directly or through histories
//! and read-backs.

use crate::access::Access;
use crate::compile::versions::{Versions, is_inside};
use crate::graph::Graph;

/// By pass: whether it is kept.
pub(crate) fn kept(graph: &Graph, versions: &Versions) -> Vec<bool> {
    let mut pruner = Pruner {
        graph,
        versions,
        kept: vec![false; graph.passes.len()],
        open: Vec::new(),
    };
    for (index, pass) in graph.passes.iter().enumerate() {
        let writes_import = pass
            .uses
            .iter()
            .any(|used| used.access.writes() && graph.resources[used.resource()].import);
        if pass.side_effect || writes_import {
            pruner.keep(index);
        }
    }
    for output in &graph.outputs {
        pruner.keep_writers(output.resource(), output.version);
    }
    while let Some(pass) = pruner.open.pop() {
        pruner.follow(pass);
    }
    pruner.kept
}

struct Pruner<'a> {
    graph: &'a Graph,
    versions: &'a Versions,
    kept: Vec<bool>,
    open: Vec<usize>,
}

impl Pruner<'_> {
    fn keep(&mut self, pass: usize) {
        if !std::mem::replace(&mut self.kept[pass], true) {
            self.open.push(pass);
        }
    }

    fn keep_writers(&mut self, resource: usize, version: u32) {
        let versions = self.versions;
        for &pass in versions.writers[resource]
            .get(&version)
            .into_iter()
            .flatten()
        {
            self.keep(pass);
        }
    }

    fn keep_final(&mut self, resource: usize) {
        let versions = self.versions;
        for &pass in versions.final_writers(resource) {
            self.keep(pass);
        }
    }

    fn follow(&mut self, index: usize) {
        let graph = self.graph;
        let pass = &graph.passes[index];
        if let Some(parent) = pass.parent {
            self.keep(parent);
        }
        if let Some(looped) = pass.looped {
            self.keep_writers(looped.condition.resource(), looped.condition.version);
        }
        for used in &pass.uses {
            let resource = used.resource();
            if used.raw.is_previous() || used.access.is_late() || used.access.updates() {
                // The next frame starts from the final contents, so later writers of the frame matter too.
                self.keep_final(resource);
            }
            if used.raw.is_previous() {
                continue;
            }
            if !used.access.is_late() {
                self.keep_writers(resource, used.raw.version);
                self.keep_carried(index, resource, used.access, used.raw.version);
            }
        }
    }

    /// In a loop, a version from outside is what the loop wrote last, from the second iteration on.
    fn keep_carried(&mut self, pass: usize, resource: usize, access: Access, version: u32) {
        if access.is_late() {
            return;
        }
        let (graph, versions) = (self.graph, self.versions);
        let mut scope = graph.passes[pass].parent;
        while let Some(looped) = scope {
            let inside = |writer: &&usize| is_inside(graph, **writer, looped);
            let from_outside = versions.writers[resource]
                .get(&version)
                .is_none_or(|writers| !writers.iter().any(|writer| inside(&writer)));
            if from_outside {
                let later = versions.writers[resource]
                    .range(version.saturating_add(1)..)
                    .flat_map(|(_, writers)| writers)
                    .filter(inside);
                for &writer in later.collect::<Vec<_>>() {
                    self.keep(writer);
                }
            }
            scope = graph.passes[looped].parent;
        }
    }
}
