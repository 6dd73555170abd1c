//! The order of passes: deterministic, with as few sync points as the data allows.
//! Within each scope, passes that need no wait come first. Then one sync point serves all host nodes that wait. The number of sync points
//! is therefore the length of the longest chain of waits, which no order can beat.

use std::cmp::Reverse;
use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet, BinaryHeap, VecDeque};

use petgraph::algo::tarjan_scc;
use petgraph::graph::{DiGraph, NodeIndex};

use crate::access::Access;
use crate::compile::versions::within;
use crate::error::CompileError;
use crate::graph::Graph;
use crate::pass::PassKind;

/// A step of the executor.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Step {
    Pass(usize),
    /// Submit, wait, and run these host nodes.
    Sync(Vec<usize>),
    Loop(usize, Vec<Step>),
}

impl Step {
    /// Calls `visit` with each pass that records or runs, in order, and whether it is in a loop.
    pub fn each(steps: &[Step], visit: &mut impl FnMut(usize, bool)) {
        Self::each_within(steps, false, visit);
    }

    fn each_within(steps: &[Step], looped: bool, visit: &mut impl FnMut(usize, bool)) {
        for step in steps {
            match step {
                Step::Pass(pass) => visit(*pass, looped),
                Step::Sync(passes) => passes.iter().for_each(|pass| visit(*pass, looped)),
                Step::Loop(_, steps) => Step::each_within(steps, true, visit),
            }
        }
    }

    /// Sync points among these steps; those inside of loops are not counted.
    pub fn count_syncs(steps: &[Step]) -> usize {
        let syncs = steps.iter().filter(|step| matches!(step, Step::Sync(_)));
        syncs.count()
    }

    /// Whether there is a sync point among these steps or in their loops.
    pub fn has_sync(steps: &[Step]) -> bool {
        steps.iter().any(|step| match step {
            Step::Pass(_) => false,
            Step::Sync(_) => true,
            Step::Loop(_, steps) => Step::has_sync(steps),
        })
    }
}

/// Finds the cycles among the passes, scope by scope; each is reported once.
pub(crate) fn cycles(graph: &Graph, edges: &[(usize, usize)], errors: &mut Vec<CompileError>) {
    let loops = (0..graph.passes.len())
        .filter(|&pass| graph.passes[pass].kind == PassKind::HostLoop)
        .map(Some);
    for scope in std::iter::once(None).chain(loops) {
        let map = digraph(graph.passes.len(), scoped(graph, scope, edges));
        let mut found: Vec<Vec<usize>> = tarjan_scc(&map)
            .into_iter()
            .filter(|component| component.len() > 1)
            .map(|component| shortest_cycle(&map, &component))
            .collect();
        found.sort();
        errors.extend(found.into_iter().map(|cycle| {
            CompileError::Cycle {
                passes: cycle
                    .into_iter()
                    .map(|pass| graph.passes[pass].name.clone())
                    .collect(),
            }
        }));
    }
}

/// The passes as a petgraph graph: node *n* is pass *n*. Edges are pairs of passes, the one that runs first and the one that runs after it.
pub(crate) fn digraph(
    passes: usize,
    edges: impl IntoIterator<Item = (usize, usize)>,
) -> DiGraph<(), ()> {
    let mut map = DiGraph::new();
    for _ in 0..passes {
        map.add_node(());
    }
    map.extend_with_edges(
        edges
            .into_iter()
            .map(|(from, to)| (NodeIndex::new(from), NodeIndex::new(to))),
    );
    map
}

/// Edges between different members of a scope. A loop represents all passes that it contains.
fn scoped(
    graph: &Graph,
    scope: Option<usize>,
    edges: &[(usize, usize)],
) -> BTreeSet<(usize, usize)> {
    edges
        .iter()
        .filter_map(|&(from, to)| {
            let pair = (within(graph, scope, from)?, within(graph, scope, to)?);
            (pair.0 != pair.1).then_some(pair)
        })
        .collect()
}

/// A shortest cycle through the component's first-declared pass, in order.
fn shortest_cycle(map: &DiGraph<(), ()>, component: &[NodeIndex]) -> Vec<usize> {
    let members: BTreeSet<usize> = component.iter().map(|node| node.index()).collect();
    let Some(&start) = members.first() else {
        return Vec::new();
    };
    let mut came_from = BTreeMap::new();
    let mut queue = VecDeque::from([start]);
    while let Some(at) = queue.pop_front() {
        let mut next: Vec<usize> = map
            .neighbors(NodeIndex::new(at))
            .map(NodeIndex::index)
            .filter(|n| members.contains(n))
            .collect();
        next.sort_unstable();
        for to in next {
            if to == start {
                let mut path = vec![at];
                let mut back = at;
                while back != start {
                    back = came_from[&back];
                    path.push(back);
                }
                path.reverse();
                return path;
            }
            if let Entry::Vacant(entry) = came_from.entry(to) {
                entry.insert(at);
                queue.push_back(to);
            }
        }
    }
    members.into_iter().collect()
}

/// Orders the kept passes of a scope. The edges must have no cycle.
pub(crate) fn schedule(
    graph: &Graph,
    scope: Option<usize>,
    edges: &[(usize, usize)],
    kept: &[bool],
) -> Vec<Step> {
    let members: Vec<usize> = (0..graph.passes.len())
        .filter(|&pass| kept[pass] && graph.passes[pass].parent == scope)
        .collect();
    let mut inner: BTreeMap<usize, Vec<Step>> = members
        .iter()
        .filter(|&&pass| graph.passes[pass].kind == PassKind::HostLoop)
        .map(|&pass| (pass, schedule(graph, Some(pass), edges, kept)))
        .collect();
    let mut waits: BTreeMap<usize, usize> = members.iter().map(|&pass| (pass, 0)).collect();
    let mut followers: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    let live: Vec<_> = edges
        .iter()
        .copied()
        .filter(|&(from, to)| kept[from] && kept[to])
        .collect();
    for (from, to) in scoped(graph, scope, &live) {
        followers.entry(from).or_default().push(to);
        *waits.entry(to).or_default() += 1;
    }

    let mut ready = Ready::default();
    for (&pass, &count) in &waits {
        if count == 0 {
            ready.add(graph, &inner, pass);
        }
    }
    let mut steps = Vec::with_capacity(members.len());
    while let Some(done) = ready.next() {
        for pass in &done {
            for &follower in followers.get(pass).into_iter().flatten() {
                if let Some(count) = waits.get_mut(&follower) {
                    *count -= 1;
                    if *count == 0 {
                        ready.add(graph, &inner, follower);
                    }
                }
            }
        }
        steps.push(match done.as_slice() {
            [pass] if graph.passes[*pass].kind == PassKind::HostLoop => {
                Step::Loop(*pass, inner.remove(pass).unwrap_or_default())
            }
            [pass] if !waits_for_gpu(graph, *pass) => Step::Pass(*pass),
            _ => Step::Sync(done),
        });
    }
    steps
}

/// Passes that may run now. Those without a wait come first, then sync points, then loops that contain sync points.
#[derive(Default)]
struct Ready {
    free: BinaryHeap<Reverse<usize>>,
    syncs: BTreeSet<usize>,
    loops: BTreeSet<usize>,
}

impl Ready {
    fn add(&mut self, graph: &Graph, inner: &BTreeMap<usize, Vec<Step>>, pass: usize) {
        if waits_for_gpu(graph, pass) {
            self.syncs.insert(pass);
        } else if inner.get(&pass).is_some_and(|steps| Step::has_sync(steps)) {
            self.loops.insert(pass);
        } else {
            self.free.push(Reverse(pass));
        }
    }

    /// Takes the next pass, or all host nodes of the next sync point.
    fn next(&mut self) -> Option<Vec<usize>> {
        if let Some(Reverse(pass)) = self.free.pop() {
            return Some(vec![pass]);
        }
        if !self.syncs.is_empty() {
            return Some(std::mem::take(&mut self.syncs).into_iter().collect());
        }
        self.loops.pop_first().map(|pass| vec![pass])
    }
}

fn waits_for_gpu(graph: &Graph, pass: usize) -> bool {
    graph.passes[pass]
        .uses
        .iter()
        .any(|used| used.access == Access::ReadBack)
}
