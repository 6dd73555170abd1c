//! The edges of a field as they lie along one direction, packed for searching: which of them stands highest before a vertex?
//!
//! Turned so that all look along the first axis, an edge can hide something from a vertex only if it crosses the vertex's line, and a box of edges
//! only if the line to its highest and nearest corner rises above what was already found: best-first search over a packed tree. The
//! tree is packed once; for each direction its boxes are fitted anew, which costs less than a tenth of the questions asked of them.

use glam::{DVec2, DVec3, Vec4};

use super::Sectors;
use crate::field::{Field, NONE};
use crate::packed::{WIDTH, order};

/// The edges of a field in packed order.
#[derive(Debug, Clone)]
pub(super) struct Edges {
    /// A half-edge for each.
    halves: Vec<u32>,
    /// The vertices at their ends.
    ends: Vec<[u32; 2]>,
    /// For each half-edge with a name in `halves`, where it stands there.
    places: Vec<u32>,
    /// From corner to corner, metres.
    across: f64,
}

impl Edges {
    pub fn new(field: &Field) -> Self {
        let middles: Vec<DVec2> = field
            .edges()
            .iter()
            .map(|&half| {
                let [a, b] = field.ends(half);
                (a.truncate() + b.truncate()) / 2.0
            })
            .collect();
        let mut packed = order(&middles);
        // Leaves are full: the last edge stands in for those that are missing.
        if let Some(&last) = packed.last() {
            packed.resize(packed.len().next_multiple_of(LEAF), last);
        }
        let halves: Vec<u32> = packed
            .iter()
            .map(|&edge| field.edges()[edge as usize])
            .collect();
        let ends = halves
            .iter()
            .map(|&half| [field.start(half), field.end(half)])
            .collect();
        let mut places = vec![NONE; field.triangles().len() * 3];
        for (place, &half) in halves.iter().enumerate() {
            places[half as usize] = place as u32;
        }
        let [low, high] = field.plan_bounds();
        Self {
            halves,
            ends,
            places,
            across: (high - low).length(),
        }
    }

    /// Closer than this, nothing is told apart from the vertex itself, metres.
    fn close(&self) -> f32 {
        self.across as f32 / 1e6
    }

    /// How far each reach goes, metres.
    pub fn reaches(&self, sectors: &Sectors) -> Vec<f32> {
        let reach = |reach| sectors.reach(reach, self.across) as f32;
        (0..sectors.reaches()).map(reach).collect()
    }

    /// The half-edge that stands at a place.
    pub fn half(&self, place: u32) -> u32 {
        self.halves[place as usize]
    }
}

/// Four edges: along, across and up, of one end and the other.
#[derive(Debug, Clone, Copy)]
struct FourEdges {
    along: [Vec4; 2],
    across: [Vec4; 2],
    up: [Vec4; 2],
}

/// Four boxes: from and to along, from and to across, and the highest place.
#[derive(Debug, Clone, Copy)]
struct FourBoxes {
    along: [Vec4; 2],
    across: [Vec4; 2],
    top: Vec4,
}

/// How many times four edges stand together at the end of the tree: looking at all of them costs less than telling which are worth it.
const FOURS: usize = 4;
const LEAF: usize = FOURS * WIDTH;

/// Below every slope.
const LOWEST: f32 = f32::MIN;

/// The most nodes that are open at a time: a row's children for each of the rows that half-edges' numbers have room for, and one more.
const OPEN: usize = (WIDTH - 1) * 16 + WIDTH + 1;

impl FourEdges {
    /// Crossed by no line.
    const NONE: Self = Self {
        along: [Vec4::ZERO; 2],
        across: [Vec4::ZERO; 2],
        up: [Vec4::ZERO; 2],
    };

    /// How steeply the line from a vertex to each edge rises, where the vertex's line crosses it between two distances and it rises more than `best`;
    /// nothing where there is none.
    #[inline(always)]
    fn steeper(
        &self,
        [along, across, up]: [Vec4; 3],
        [close, reach]: [Vec4; 2],
        best: f32,
    ) -> Option<Vec4> {
        let [left, right] = [across - self.across[0], self.across[1] - across];
        let same = (left * right).cmpge(Vec4::ZERO);
        let [left, right] = [left.abs(), right.abs()];
        // All times the width of the edge, to divide only by what is steeper.
        let far = (self.along[0] - along) * right + (self.along[1] - along) * left;
        let rise = (self.up[0] - up) * right + (self.up[1] - up) * left;
        let width = left + right;
        let crosses =
            same & far.cmpgt(close * width) & far.cmple(reach * width) & rise.cmpgt(far * best);
        crosses
            .any()
            .then(|| Vec4::select(crosses, rise / far, Vec4::splat(LOWEST)))
    }
}

impl FourBoxes {
    const NONE: Self = Self {
        along: [Vec4::INFINITY, Vec4::NEG_INFINITY],
        across: [Vec4::INFINITY, Vec4::NEG_INFINITY],
        top: Vec4::NEG_INFINITY,
    };

    /// How far the tops of the boxes reach above a line that rises by `slope`, metres: where that is more than 0, a line to what is in the
    /// box may rise more steeply. [`LOWEST`] for boxes that the vertex's line misses between two distances.
    #[inline(always)]
    fn above(&self, [along, across, up]: [Vec4; 3], [close, reach]: [Vec4; 2], slope: f32) -> Vec4 {
        let near = (self.along[0] - along).max(close);
        let far = (self.along[1] - along).min(reach);
        // A line that rises is lowest at the box's near end, one that falls at its far end.
        let line = if slope >= 0.0 { near } else { far };
        let above = self.top - up - line * slope;
        let beside = across.cmpge(self.across[0]) & across.cmple(self.across[1]);
        let within = far.cmpgt(close) & near.cmple(reach);
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

/// The edges along one direction.
#[derive(Debug)]
pub(super) struct Bearing<'a> {
    edges: &'a Edges,
    /// The vertices: along, across to the left, up.
    vertices: Vec<[f32; 3]>,
    fours: Vec<FourEdges>,
    /// A tree with four children a node: those of `node` are `WIDTH * node + 1` and its neighbours, and what would come behind the last
    /// row of boxes are the leaves. Rows begin where full ones would, and end where there is no more.
    boxes: Vec<FourBoxes>,
    /// The first node that stands for edges.
    leaves: u32,
    /// Nodes that may hold something higher.
    open: Vec<u32>,
}

impl<'a> Bearing<'a> {
    pub fn new(edges: &'a Edges) -> Self {
        let there = (edges.ends.len() / LEAF).max(1);
        let (mut leaves, mut row) = (0, 1);
        while row < there || leaves == 0 {
            leaves += row;
            row *= WIDTH;
        }
        let parent = (leaves + there - 2) / WIDTH;
        Self {
            edges,
            vertices: Vec::new(),
            fours: vec![FourEdges::NONE; there * FOURS],
            boxes: vec![FourBoxes::NONE; parent + 1],
            leaves: leaves as u32,
            open: vec![0; OPEN],
        }
    }

    /// Turns towards a direction.
    pub fn turn(&mut self, field: &Field, way: DVec2) {
        self.vertices.clear();
        self.vertices.extend(field.points().iter().map(|point| {
            let plan = point.truncate();
            [way.dot(plan), way.perp_dot(plan), point.z].map(|number| number as f32)
        }));
        let vertex = |vertex: u32| self.vertices[vertex as usize];
        for (four, ends) in self.fours.iter_mut().zip(self.edges.ends.chunks(WIDTH)) {
            for (k, ends) in ends.iter().enumerate() {
                for (end, &name) in ends.iter().enumerate() {
                    let [along, across, up] = vertex(name);
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

    /// The edge, as its half-edge, to which the line from a vertex rises most steeply, of those no farther away than `reach` metres; [`NONE`] if
    /// nothing lies there. Edges that may stand as high, because they do from a neighbour or did in a neighbouring direction, make it faster.
    pub fn highest(&mut self, vertex: u32, reach: f32, likely: [u32; 2]) -> u32 {
        let between = [self.edges.close(), reach];
        self.highest_from(self.vertices[vertex as usize], between, likely)
    }

    /// Whether the line from a vertex crosses an edge no farther away than `reach` metres: if it is the highest of a farther reach, it is the
    /// highest of this one too.
    pub fn is_within(&self, vertex: u32, half: u32, reach: f32) -> bool {
        let place = self.edges.places[half as usize] as usize;
        let eye = self.vertices[vertex as usize].map(Vec4::splat);
        let between = [self.edges.close(), reach].map(Vec4::splat);
        self.fours[place / WIDTH]
            .steeper(eye, between, LOWEST)
            .is_some_and(|slopes| slopes[place % WIDTH] > LOWEST)
    }

    /// The same as [`Self::highest`] from any place, of what lies farther along the direction, which this one was turned to, than `beyond` metres and
    /// no farther than `reach`.
    pub fn highest_beyond(&mut self, way: DVec2, from: DVec3, beyond: f64, reach: f32) -> u32 {
        let plan = from.truncate();
        let eye = [way.dot(plan), way.perp_dot(plan), from.z].map(|number| number as f32);
        let close = beyond.max(0.0) as f32 + self.edges.close();
        self.highest_from(eye, [close, reach], [NONE; 2])
    }

    fn highest_from(&mut self, eye: [f32; 3], between: [f32; 2], likely: [u32; 2]) -> u32 {
        let eye = eye.map(Vec4::splat);
        let between = between.map(Vec4::splat);
        let (mut best, mut found) = (LOWEST, NONE);
        let open = self.open.as_mut_slice();
        open[0] = 0;
        let mut count = 1;
        // What is opened last is looked at first.
        for half in likely {
            let place = self.edges.places.get(half as usize).copied();
            if let Some(place) = place.filter(|place| *place != NONE) {
                open[count] = self.leaves + place / LEAF as u32;
                count += 1;
            }
        }
        while count > 0 {
            count -= 1;
            let node = open[count];
            if node >= self.leaves {
                let first = (node - self.leaves) as usize * FOURS;
                for (four, edges) in (first..).zip(&self.fours[first..first + FOURS]) {
                    let Some(slopes) = edges.steeper(eye, between, best) else {
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
            let above = self.boxes[node as usize].above(eye, between, best);
            // Without a branch that depends on the terrain; then what stands out most is put last, to be opened first.
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
            place => self.edges.half(place),
        }
    }
}
