//! The edges of a field in coordinates rotated to one direction, in a bounding volume hierarchy. The query is: which edge stands highest
//! ahead of a vertex?
//!
//! After the rotation all lines of sight run along the first axis. An edge can hide something from a vertex only if it crosses the vertex's
//! line. A box of edges can only if the line to its highest and nearest corner rises above the best edge so far. That is best-first search.
//! The tree is built once; for each direction only its boxes are fitted again, which costs less than a tenth of the queries.

use glam::{DVec2, DVec3, Vec4};

use super::sectors::Sectors;
use crate::field::{Field, NONE};
use crate::packed_tree::{WIDTH, packed_order};

/// The edges of a field in packed order.
#[derive(Debug, Clone)]
pub(super) struct PackedEdges {
    /// A half-edge for each slot.
    half_edges: Vec<u32>,
    /// The vertices at the ends of each.
    ends: Vec<[u32; 2]>,
    /// For each half-edge, its slot in `half_edges`; [`NONE`] for the others.
    slots: Vec<u32>,
    /// The diagonal of the field's plan bounds, metres.
    diagonal: f64,
}

impl PackedEdges {
    pub fn new(field: &Field) -> Self {
        let middles: Vec<DVec2> = field
            .edges()
            .iter()
            .map(|&half_edge| {
                let [a, b] = field.ends(half_edge);
                (a.truncate() + b.truncate()) / 2.0
            })
            .collect();
        let mut packed = packed_order(&middles);
        // Leaves are full: the last edge is repeated.
        if let Some(&last) = packed.last() {
            packed.resize(packed.len().next_multiple_of(LEAF), last);
        }
        let half_edges: Vec<u32> = packed
            .iter()
            .map(|&edge| field.edges()[edge as usize])
            .collect();
        let ends = half_edges
            .iter()
            .map(|&half_edge| [field.start(half_edge), field.end(half_edge)])
            .collect();
        let mut slots = vec![NONE; field.triangles().len() * 3];
        for (slot, &half_edge) in half_edges.iter().enumerate() {
            slots[half_edge as usize] = slot as u32;
        }
        let [low, high] = field.plan_bounds();
        Self {
            half_edges,
            ends,
            slots,
            diagonal: (high - low).length(),
        }
    }

    /// Edges nearer than this count as touching the vertex itself, metres.
    fn closest(&self) -> f32 {
        self.diagonal as f32 / 1e6
    }

    /// The distance of each reach, metres.
    pub fn reach_distances(&self, sectors: &Sectors) -> Vec<f32> {
        let distance = |reach| sectors.reach_distance(reach, self.diagonal) as f32;
        (0..sectors.reaches()).map(distance).collect()
    }
}

/// Four edges: the coordinates along, across and up of both ends.
#[derive(Debug, Clone, Copy)]
struct FourEdges {
    along: [Vec4; 2],
    across: [Vec4; 2],
    up: [Vec4; 2],
}

/// Four boxes: the range along, the range across, and the highest point.
#[derive(Debug, Clone, Copy)]
struct FourBoxes {
    along: [Vec4; 2],
    across: [Vec4; 2],
    top: Vec4,
}

/// Groups of four edges in a leaf: testing all of them costs less than finding out which are worth it.
const FOURS: usize = 4;
const LEAF: usize = FOURS * WIDTH;

/// Below every slope.
const LOWEST: f32 = f32::MIN;

/// The most open nodes: the children of one node in each of the levels that 32-bit half-edges allow, and one more.
const OPEN: usize = (WIDTH - 1) * 16 + WIDTH + 1;

/// A position in rotated coordinates, for each of four lanes.
#[derive(Clone, Copy)]
struct Position {
    along: Vec4,
    across: Vec4,
    up: Vec4,
}

/// The distances that a query covers, for each of four lanes, metres.
#[derive(Clone, Copy)]
struct Distances {
    nearest: Vec4,
    farthest: Vec4,
}

impl Position {
    fn splat([along, across, up]: [f32; 3]) -> Self {
        Self {
            along: Vec4::splat(along),
            across: Vec4::splat(across),
            up: Vec4::splat(up),
        }
    }
}

impl Distances {
    fn splat(nearest: f32, farthest: f32) -> Self {
        Self {
            nearest: Vec4::splat(nearest),
            farthest: Vec4::splat(farthest),
        }
    }
}

impl FourEdges {
    /// Edges that no line crosses.
    const NONE: Self = Self {
        along: [Vec4::ZERO; 2],
        across: [Vec4::ZERO; 2],
        up: [Vec4::ZERO; 2],
    };

    /// The slope of the line from a position to each edge, [`LOWEST`] for edges that the line does not cross within the distances or that
    /// are not steeper than `best`. `None` if there is no steeper edge.
    #[inline(always)]
    fn steeper(&self, from: Position, distances: Distances, best: f32) -> Option<Vec4> {
        let [left, right] = [from.across - self.across[0], self.across[1] - from.across];
        let same = (left * right).cmpge(Vec4::ZERO);
        let [left, right] = [left.abs(), right.abs()];
        // All multiplied by the width of the edge, so that only a steeper edge costs a division.
        let distance = (self.along[0] - from.along) * right + (self.along[1] - from.along) * left;
        let rise = (self.up[0] - from.up) * right + (self.up[1] - from.up) * left;
        let width = left + right;
        let crosses = same
            & distance.cmpgt(distances.nearest * width)
            & distance.cmple(distances.farthest * width)
            & rise.cmpgt(distance * best);
        crosses
            .any()
            .then(|| Vec4::select(crosses, rise / distance, Vec4::splat(LOWEST)))
    }
}

impl FourBoxes {
    const NONE: Self = Self {
        along: [Vec4::INFINITY, Vec4::NEG_INFINITY],
        across: [Vec4::INFINITY, Vec4::NEG_INFINITY],
        top: Vec4::NEG_INFINITY,
    };

    /// How far the tops of the boxes reach above a line that rises by `slope`, metres. Above 0, the box may hold an edge that is steeper.
    /// [`LOWEST`] for boxes that the line does not cross within the distances.
    #[inline(always)]
    fn height_above(&self, from: Position, distances: Distances, slope: f32) -> Vec4 {
        let near = (self.along[0] - from.along).max(distances.nearest);
        let far = (self.along[1] - from.along).min(distances.farthest);
        // A rising line is lowest at the near end of the box, a falling one at the far end.
        let line = if slope >= 0.0 { near } else { far };
        let above = self.top - from.up - line * slope;
        let beside = from.across.cmpge(self.across[0]) & from.across.cmple(self.across[1]);
        let within = far.cmpgt(distances.nearest) & near.cmple(distances.farthest);
        Vec4::select(beside & within, above, Vec4::splat(LOWEST))
    }

    /// Fits box `k` around the edges of a leaf.
    fn fit_edges(&mut self, k: usize, leaf: &[FourEdges]) {
        let mut around = Self::NONE;
        for four in leaf {
            for end in 0..2 {
                around.along[0] = around.along[0].min(four.along[end]);
                around.along[1] = around.along[1].max(four.along[end]);
                around.across[0] = around.across[0].min(four.across[end]);
                around.across[1] = around.across[1].max(four.across[end]);
                around.top = around.top.max(four.up[end]);
            }
        }
        self.fit_boxes(k, &around);
    }

    /// Fits box `k` around four boxes.
    fn fit_boxes(&mut self, k: usize, boxes: &Self) {
        self.along[0][k] = boxes.along[0].min_element();
        self.along[1][k] = boxes.along[1].max_element();
        self.across[0][k] = boxes.across[0].min_element();
        self.across[1][k] = boxes.across[1].max_element();
        self.top[k] = boxes.top.max_element();
    }
}

/// The edges in coordinates rotated to one direction.
#[derive(Debug)]
pub(super) struct RotatedEdges<'a> {
    edges: &'a PackedEdges,
    direction: DVec2,
    /// The vertices: along, across to the left, and up, metres.
    vertices: Vec<[f32; 3]>,
    fours: Vec<FourEdges>,
    /// A tree with four children for each node: those of `node` are `WIDTH * node + 1` and the three after it. The nodes after the last
    /// level of boxes are the leaves. Levels begin where those of a full tree do, and end where there are no more edges.
    boxes: Vec<FourBoxes>,
    /// The first node that is a leaf.
    leaves: u32,
    /// Nodes that may hold a higher edge.
    open: Vec<u32>,
}

impl<'a> RotatedEdges<'a> {
    pub fn new(edges: &'a PackedEdges) -> Self {
        let count = (edges.ends.len() / LEAF).max(1);
        let (mut leaves, mut level) = (0, 1);
        while level < count || leaves == 0 {
            leaves += level;
            level *= WIDTH;
        }
        let parent = (leaves + count - 2) / WIDTH;
        Self {
            edges,
            direction: DVec2::X,
            vertices: Vec::new(),
            fours: vec![FourEdges::NONE; count * FOURS],
            boxes: vec![FourBoxes::NONE; parent + 1],
            leaves: leaves as u32,
            open: vec![0; OPEN],
        }
    }

    /// Rotates to a unit direction.
    pub fn rotate(&mut self, field: &Field, direction: DVec2) {
        self.direction = direction;
        self.vertices.clear();
        let points = field.points().iter();
        self.vertices
            .extend(points.map(|&point| rotated(point, direction)));
        let vertex = |vertex: u32| self.vertices[vertex as usize];
        for (four, ends) in self.fours.iter_mut().zip(self.edges.ends.chunks(WIDTH)) {
            for (k, ends) in ends.iter().enumerate() {
                for (end, &index) in ends.iter().enumerate() {
                    let [along, across, up] = vertex(index);
                    four.along[end][k] = along;
                    four.across[end][k] = across;
                    four.up[end][k] = up;
                }
            }
        }
        self.boxes.fill(FourBoxes::NONE);
        let parent = |node: usize| ((node - 1) / WIDTH, (node - 1) % WIDTH);
        for (at, leaf) in self.fours.chunks_exact(FOURS).enumerate() {
            let (node, k) = parent(self.leaves as usize + at);
            self.boxes[node].fit_edges(k, leaf);
        }
        for node in (1..self.boxes.len()).rev() {
            let (above, k) = parent(node);
            let boxes = self.boxes[node];
            self.boxes[above].fit_boxes(k, &boxes);
        }
    }

    /// Replaces, for every vertex and each of its reaches, the edge that stands highest in another direction by the one that does in this
    /// direction. `reaches` has the distances, the farthest first; `highest` has one half-edge for each vertex and reach.
    pub fn update_highest(&mut self, reaches: &[f32], highest: &mut [u32]) {
        let mut neighbours = vec![NONE; reaches.len()];
        for (vertex, highest) in (0..).zip(highest.chunks_exact_mut(reaches.len())) {
            let mut farther = None;
            for ((highest, neighbour), &reach) in
                highest.iter_mut().zip(&mut neighbours).zip(reaches)
            {
                *highest = match farther {
                    // Most of the highest edges are near: that of a farther reach is often within this one.
                    Some(half_edge)
                        if half_edge == NONE || self.is_within(vertex, half_edge, reach) =>
                    {
                        half_edge
                    }
                    _ => self.highest_ahead(vertex, reach, [*highest, *neighbour]),
                };
                *neighbour = *highest;
                farther = Some(*highest);
            }
        }
    }

    /// The half-edge of the edge that the line from a vertex rises most steeply to, within `reach` metres; [`NONE`] if there is none.
    /// `likely` has half-edges that may be it, such as those of a neighbouring vertex or direction. They only make the search faster.
    fn highest_ahead(&mut self, vertex: u32, reach: f32, likely: [u32; 2]) -> u32 {
        let distances = Distances::splat(self.edges.closest(), reach);
        let from = Position::splat(self.vertices[vertex as usize]);
        self.highest_from(from, distances, likely)
    }

    /// Whether the line from a vertex crosses an edge within `reach` metres. If the edge is the highest of a farther reach, it is the
    /// highest of this one too.
    fn is_within(&self, vertex: u32, half_edge: u32, reach: f32) -> bool {
        let slot = self.edges.slots[half_edge as usize] as usize;
        let from = Position::splat(self.vertices[vertex as usize]);
        let distances = Distances::splat(self.edges.closest(), reach);
        self.fours[slot / WIDTH]
            .steeper(from, distances, LOWEST)
            .is_some_and(|slopes| slopes[slot % WIDTH] > LOWEST)
    }

    /// The half-edge of the edge that the line from any position rises most steeply to, farther than `beyond` metres and within `reach`;
    /// [`NONE`] if there is none.
    pub fn highest_beyond(&mut self, from: DVec3, beyond: f64, reach: f32) -> u32 {
        let from = Position::splat(rotated(from, self.direction));
        let nearest = beyond.max(0.0) as f32 + self.edges.closest();
        self.highest_from(from, Distances::splat(nearest, reach), [NONE; 2])
    }

    fn highest_from(&mut self, from: Position, distances: Distances, likely: [u32; 2]) -> u32 {
        let (mut best, mut found) = (LOWEST, NONE);
        let open = self.open.as_mut_slice();
        open[0] = 0;
        let mut count = 1;
        // The last opened node is visited first.
        for half_edge in likely {
            let slot = self.edges.slots.get(half_edge as usize).copied();
            if let Some(slot) = slot.filter(|slot| *slot != NONE) {
                open[count] = self.leaves + slot / LEAF as u32;
                count += 1;
            }
        }
        while count > 0 {
            count -= 1;
            let node = open[count];
            if node >= self.leaves {
                let first = (node - self.leaves) as usize * FOURS;
                for (four, edges) in (first..).zip(&self.fours[first..first + FOURS]) {
                    let Some(slopes) = edges.steeper(from, distances, best) else {
                        continue;
                    };
                    let highest = slopes.max_element();
                    if highest > best {
                        best = highest;
                        found = (four * WIDTH + slopes.max_position()) as u32;
                    }
                }
                continue;
            }
            let above = self.boxes[node as usize].height_above(from, distances, best);
            // Without a branch that depends on the terrain. Then the highest box is moved to the end, to be visited first.
            let (mut most, mut last) = (0.0, count);
            let first = count;
            for (k, above) in above.to_array().into_iter().enumerate() {
                open[count] = node * WIDTH as u32 + 1 + k as u32;
                if above > most {
                    (most, last) = (above, count);
                }
                count += usize::from(above > 0.0);
            }
            if count > first {
                open.swap(last, count - 1);
            }
        }
        match found {
            NONE => NONE,
            slot => self.edges.half_edges[slot as usize],
        }
    }
}

/// A position in coordinates rotated to a unit direction: along, across to the left, and up, metres.
fn rotated(position: DVec3, direction: DVec2) -> [f32; 3] {
    let plan = position.truncate();
    [direction.dot(plan), direction.perp_dot(plan), position.z].map(|number| number as f32)
}
