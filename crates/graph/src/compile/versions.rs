//! The passes that write and read each version of each resource, and the order that follows.

use std::collections::BTreeMap;

use crate::graph::Graph;

/// Passes by version.
type ByVersion = BTreeMap<u32, Vec<usize>>;

/// The data flow of a graph.
pub(crate) struct Versions {
    /// By resource: the passes that produce a version, which is to write the one before it.
    pub writers: Vec<ByVersion>,
    /// By resource: the passes that read a version.
    pub readers: Vec<ByVersion>,
    /// By resource: the passes that read last frame's value; updaters are not among them.
    pub previous_readers: Vec<Vec<usize>>,
    /// By resource: the passes that update it in place.
    pub updaters: Vec<Vec<usize>>,
    /// By resource: the passes that read it back late, or as a tag.
    pub late: Vec<Vec<usize>>,
}

impl Versions {
    pub fn new(graph: &Graph) -> Self {
        let count = graph.resources.len();
        let mut versions = Self {
            writers: vec![ByVersion::new(); count],
            readers: vec![ByVersion::new(); count],
            previous_readers: vec![Vec::new(); count],
            updaters: vec![Vec::new(); count],
            late: vec![Vec::new(); count],
        };
        for (index, pass) in graph.passes.iter().enumerate() {
            for used in &pass.uses {
                let resource = used.resource();
                if used.access.writes() {
                    if used.raw.is_previous() {
                        continue;
                    }
                    push(
                        &mut versions.writers[resource],
                        used.raw.next().version,
                        index,
                    );
                    if used.access.updates() {
                        versions.updaters[resource].push(index);
                    }
                } else if used.access.is_late() {
                    versions.late[resource].push(index);
                } else if used.raw.is_previous() {
                    versions.previous_readers[resource].push(index);
                } else {
                    push(&mut versions.readers[resource], used.raw.version, index);
                }
            }
        }
        versions
    }

    /// The passes that write the last version; none if no pass writes.
    pub fn final_writers(&self, resource: usize) -> &[usize] {
        self.writers[resource]
            .last_key_value()
            .map_or(&[], |(_, passes)| passes)
    }

    /// Whether the resource needs two objects, for this frame's and last frame's value: it is read as a previous value and not updated in
    /// place.
    pub fn is_double(&self, resource: usize, kept: &[bool]) -> bool {
        self.updaters[resource].is_empty()
            && self.previous_readers[resource]
                .iter()
                .any(|&pass| kept[pass])
    }

    /// The order between passes, as pairs of the one that runs first and the one that runs after it: by data, by `after`, and where a
    /// previous value is read that another pass updates in place.
    pub fn edges(&self, graph: &Graph) -> Vec<(usize, usize)> {
        let mut edges = Vec::new();
        for resource in 0..graph.resources.len() {
            for (&version, writers) in &self.writers[resource] {
                let before = self.readers[resource].get(&(version - 1));
                let earlier = self.writers[resource].get(&(version - 1));
                let after = self.readers[resource].get(&version);
                for &writer in writers {
                    edges.extend(before.into_iter().flatten().map(|&pass| (pass, writer)));
                    edges.extend(earlier.into_iter().flatten().map(|&pass| (pass, writer)));
                    edges.extend(after.into_iter().flatten().map(|&pass| (writer, pass)));
                }
            }
            for &updater in &self.updaters[resource] {
                edges.extend(
                    self.previous_readers[resource]
                        .iter()
                        .map(|&pass| (pass, updater)),
                );
            }
        }
        for (index, pass) in graph.passes.iter().enumerate() {
            edges.extend(pass.after.iter().map(|other| (other.index as usize, index)));
        }
        edges.retain(|(from, to)| from != to);
        edges
    }
}

fn push(map: &mut ByVersion, version: u32, pass: usize) {
    let passes = map.entry(version).or_default();
    if passes.last() != Some(&pass) {
        passes.push(pass);
    }
}

/// The member of `scope` that is `pass` or contains it; `None` if `pass` is outside of that scope.
pub(crate) fn within(graph: &Graph, scope: Option<usize>, pass: usize) -> Option<usize> {
    let mut at = pass;
    loop {
        let parent = graph.passes[at].parent;
        if parent == scope {
            return Some(at);
        }
        at = parent?;
    }
}

/// Whether `pass` is `outer` or inside of it.
pub(crate) fn is_inside(graph: &Graph, pass: usize, outer: usize) -> bool {
    let mut at = Some(pass);
    while let Some(pass) = at {
        if pass == outer {
            return true;
        }
        at = graph.passes[pass].parent;
    }
    false
}
