//! The edges of a field as they lie along one direction, packed for searching: which of them stands highest before a vertex?
//!
//! Turned so that all look along the first axis, an edge can hide something from a vertex only if it crosses the vertex's line, and a box of edges
//! only if the line to its highest and nearest corner rises above what was already found: best-first search over a packed tree. The
//! tree is packed once; for each direction its boxes are fitted anew, which costs less than a tenth of the questions asked of them.

use glam::{DVec2, DVec3};

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
    /// Closer than this, nothing is told apart from the vertex itself, metres.
    close: f32,
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
        let packed = order(&middles);
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
            close: (high - low).length() as f32 / 1e6,
        }
    }

    /// The half-edge that stands at a place.
    pub fn half(&self, place: u32) -> u32 {
        self.halves[place as usize]
    }
}

/// One number for each of four.
type Four = [f32; WIDTH];

/// Four edges: along, across and up, of one end and the other.
#[derive(Debug, Clone, Copy)]
struct FourEdges {
    along: [Four; 2],
    across: [Four; 2],
    up: [Four; 2],
}

/// Four boxes: from and to along, from and to across, and the highest place.
#[derive(Debug, Clone, Copy)]
struct FourBoxes {
    along: [Four; 2],
    across: [Four; 2],
    top: Four,
}

const NOWHERE: f32 = f32::NAN;
/// Below every slope.
const LOWEST: f32 = f32::MIN;

impl FourEdges {
    const NONE: Self = Self {
        along: [[NOWHERE; WIDTH]; 2],
        across: [[NOWHERE; WIDTH]; 2],
        up: [[NOWHERE; WIDTH]; 2],
    };

    /// How steeply the line from a vertex to each edge rises, where the vertex's line crosses it.
    #[inline(always)]
    fn slopes(&self, [along, across, up]: [f32; 3], close: f32) -> Four {
        let mut slopes = [LOWEST; WIDTH];
        for (k, slope) in slopes.iter_mut().enumerate() {
            let [left, right] = [across - self.across[0][k], self.across[1][k] - across];
            let share = left / (left + right);
            let far = self.along[0][k] + (self.along[1][k] - self.along[0][k]) * share - along;
            let rise = self.up[0][k] + (self.up[1][k] - self.up[0][k]) * share - up;
            let crosses = left * right >= 0.0 && far > close;
            let steep = rise / far;
            *slope = if crosses { steep } else { LOWEST };
        }
        slopes
    }
}

impl FourBoxes {
    const NONE: Self = Self {
        along: [[f32::INFINITY; WIDTH], [f32::NEG_INFINITY; WIDTH]],
        across: [[f32::INFINITY; WIDTH], [f32::NEG_INFINITY; WIDTH]],
        top: [f32::NEG_INFINITY; WIDTH],
    };

    /// No line from a vertex to what is in each box rises more steeply; [`LOWEST`] for boxes that the vertex's line misses.
    #[inline(always)]
    fn bounds(&self, [along, across, up]: [f32; 3], close: f32) -> Four {
        let mut bounds = [LOWEST; WIDTH];
        for (k, bound) in bounds.iter_mut().enumerate() {
            let near = (self.along[0][k] - along).max(close);
            let far = self.along[1][k] - along;
            let rise = self.top[k] - up;
            let steep = rise / if rise >= 0.0 { near } else { far };
            let crosses = self.across[0][k] <= across && across <= self.across[1][k] && far > close;
            *bound = if crosses { steep } else { LOWEST };
        }
        bounds
    }

    /// Fits box `k` around four edges.
    fn fit_edges(&mut self, k: usize, edges: &FourEdges) {
        for end in 0..2 {
            for i in 0..WIDTH {
                self.along[0][k] = self.along[0][k].min(edges.along[end][i]);
                self.along[1][k] = self.along[1][k].max(edges.along[end][i]);
                self.across[0][k] = self.across[0][k].min(edges.across[end][i]);
                self.across[1][k] = self.across[1][k].max(edges.across[end][i]);
                self.top[k] = self.top[k].max(edges.up[end][i]);
            }
        }
    }

    /// Fits box `k` around four boxes.
    fn fit_boxes(&mut self, k: usize, boxes: &Self) {
        for i in 0..WIDTH {
            self.along[0][k] = self.along[0][k].min(boxes.along[0][i]);
            self.along[1][k] = self.along[1][k].max(boxes.along[1][i]);
            self.across[0][k] = self.across[0][k].min(boxes.across[0][i]);
            self.across[1][k] = self.across[1][k].max(boxes.across[1][i]);
            self.top[k] = self.top[k].max(boxes.top[i]);
        }
    }
}

/// The edges along one direction.
#[derive(Debug)]
pub(super) struct Bearing<'a> {
    edges: &'a Edges,
    /// The vertices: along, across to the left, up.
    vertices: Vec<[f32; 3]>,
    fours: Vec<FourEdges>,
    /// Boxes around four edges each, four of them together; then around four of those, up to one.
    levels: Vec<Vec<FourBoxes>>,
}

impl<'a> Bearing<'a> {
    pub fn new(edges: &'a Edges) -> Self {
        let mut levels = Vec::new();
        let mut count = edges.ends.len().div_ceil(WIDTH);
        let fours = vec![FourEdges::NONE; count];
        while count > 1 || levels.is_empty() {
            count = count.div_ceil(WIDTH);
            levels.push(vec![FourBoxes::NONE; count]);
        }
        Self {
            edges,
            vertices: Vec::new(),
            fours,
            levels,
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
        let mut below: Option<&[FourBoxes]> = None;
        for level in &mut self.levels {
            level.fill(FourBoxes::NONE);
            for (node, boxes) in level.iter_mut().enumerate() {
                for k in 0..WIDTH {
                    let child = node * WIDTH + k;
                    match below {
                        None => {
                            let four = self.fours.get(child);
                            four.into_iter().for_each(|four| boxes.fit_edges(k, four));
                        }
                        Some(below) => {
                            let four = below.get(child);
                            four.into_iter().for_each(|four| boxes.fit_boxes(k, four));
                        }
                    }
                }
            }
            below = Some(level);
        }
    }

    /// The edge, as its half-edge, to which the line from a vertex rises most steeply; [`NONE`] if nothing lies that way. Edges that
    /// may stand as high, because they do from a neighbour or did in a neighbouring direction, make it faster.
    pub fn highest(&self, vertex: u32, likely: [u32; 2]) -> u32 {
        self.highest_from(self.vertices[vertex as usize], self.edges.close, likely)
    }

    /// The same from any place, of what lies farther along the direction, which this one was turned to, than `beyond` metres.
    pub fn highest_beyond(&self, way: DVec2, from: DVec3, beyond: f64) -> u32 {
        let plan = from.truncate();
        let eye = [way.dot(plan), way.perp_dot(plan), from.z].map(|number| number as f32);
        let close = beyond.max(0.0) as f32 + self.edges.close;
        self.highest_from(eye, close, [NONE; 2])
    }

    fn highest_from(&self, eye: [f32; 3], close: f32, likely: [u32; 2]) -> u32 {
        let (mut best, mut found) = (LOWEST, NONE);
        for half in likely {
            let place = self.edges.places.get(half as usize).copied();
            let Some(place) = place.filter(|place| *place != NONE) else {
                continue;
            };
            let slopes = self.fours[place as usize / WIDTH].slopes(eye, close);
            for (k, &slope) in slopes.iter().enumerate() {
                if slope > best {
                    (best, found) = (slope, (place / WIDTH as u32) * WIDTH as u32 + k as u32);
                }
            }
        }
        let mut open = [(0_u32, 0_u32, 0.0_f32); 64];
        let mut count = 1;
        open[0] = (self.levels.len() as u32, 0, f32::INFINITY);
        while count > 0 {
            count -= 1;
            let (level, node, bound) = open[count];
            if bound <= best {
                continue;
            }
            if level == 0 {
                let slopes = self.fours[node as usize].slopes(eye, close);
                for (k, &slope) in slopes.iter().enumerate() {
                    if slope > best {
                        (best, found) = (slope, node * WIDTH as u32 + k as u32);
                    }
                }
                continue;
            }
            let bounds = self.levels[level as usize - 1][node as usize].bounds(eye, close);
            let first = count;
            for (k, &bound) in bounds.iter().enumerate() {
                if bound > best {
                    // The steepest last, so that it is opened first.
                    let mut at = count;
                    while at > first && open[at - 1].2 > bound {
                        open[at] = open[at - 1];
                        at -= 1;
                    }
                    open[at] = (level - 1, node * WIDTH as u32 + k as u32, bound);
                    count += 1;
                }
            }
        }
        match found {
            NONE => NONE,
            place => self.edges.half(place),
        }
    }
}
