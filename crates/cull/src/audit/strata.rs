//! Two strata of patches: *uncertain* ones, with an entity that was culled although samples of it are visible, and *plain* ones. Uncertain patches are few and hold most
//! of the wrong pixels of an aggressive setting, so they are sampled more densely, by Neyman's optimal allocation (*On the Two Different Aspects of the Representative
//! Method*, 1934).

use super::screen_box::ScreenProjector;
use crate::draw_source::patches::PATCH_SIDE;
use crate::entities::SceneTable;

/// Kinds of patches.
pub(super) const STRATA: usize = 2;
/// A patch without an entity below the threshold.
pub(super) const PLAIN: usize = 0;
/// A patch with an entity below the threshold.
pub(super) const UNCERTAIN: usize = 1;

/// The image in patches, and which of them are uncertain.
#[derive(Debug, Default)]
pub(super) struct Patches {
    pub columns: u32,
    pub rows: u32,
    is_uncertain: Vec<bool>,
    /// The patches of each kind, ascending.
    kinds: [Vec<u32>; STRATA],
}

impl Patches {
    /// All patches of an image, none of them uncertain.
    pub fn reset(&mut self, [width, height]: [u32; 2]) {
        self.columns = width.div_ceil(PATCH_SIDE);
        self.rows = height.div_ceil(PATCH_SIDE);
        self.is_uncertain.clear();
        self.is_uncertain.resize(self.number() as usize, false);
        self.part();
    }

    pub fn number(&self) -> u32 {
        self.columns * self.rows
    }

    pub fn place(&self, patch: u32) -> [u32; 2] {
        let columns = self.columns.max(1);
        [patch % columns, patch / columns]
    }

    /// The patches of a kind, ascending.
    pub fn of_kind(&self, kind: usize) -> &[u32] {
        self.kinds.get(kind).map_or(&[], Vec::as_slice)
    }

    /// Marks patches as uncertain.
    pub fn mark(&mut self, patches: impl Iterator<Item = u32>) {
        for patch in patches {
            if let Some(marked) = self.is_uncertain.get_mut(patch as usize) {
                *marked = true;
            }
        }
        self.part();
    }

    /// Sorts them by kind.
    fn part(&mut self) {
        for kind in &mut self.kinds {
            kind.clear();
        }
        for (uncertain, patch) in self.is_uncertain.iter().zip(0..) {
            self.kinds[if *uncertain { UNCERTAIN } else { PLAIN }].push(patch);
        }
    }

    /// Marks the patches that entities below the threshold lie on, by their boxes: a wrong mark only changes how densely a patch is sampled.
    pub fn mark_uncertain(
        &mut self,
        table: &SceneTable,
        projector: &ScreenProjector,
        left_out: impl Iterator<Item = u32>,
    ) {
        let columns_a_row = self.columns;
        let screen_boxes = left_out.map(|slot| projector.project(table, slot));
        // An unbounded projection says nothing about where the entity is.
        let somewhere = screen_boxes.filter(|screen_box| !screen_box.is_everywhere());
        let places = somewhere.filter_map(|screen_box| projector.patches(&screen_box));
        self.mark(places.flat_map(|[columns, rows]| {
            (rows[0]..=rows[1]).flat_map(move |row| {
                (columns[0]..=columns[1]).map(move |column| row * columns_a_row + column)
            })
        }));
    }
}

/// The mean of the squared wrong part of a patch, by kind; recent frames weigh more.
#[derive(Debug, Clone)]
pub(super) struct Moments {
    squares: [f64; STRATA],
    weights: [f64; STRATA],
}

/// The prior before anything was sampled; it weighs as much as `BELIEF` patches.
const BELIEVED: [f64; STRATA] = [1e-4, 3e-3];
const BELIEF: f64 = 100.0;
/// The factor by which a frame's weight decays a frame.
const FADES: f64 = 0.98;

impl Default for Moments {
    fn default() -> Self {
        Self {
            squares: [0.0; STRATA],
            weights: [0.0; STRATA],
        }
    }
}

impl Moments {
    pub fn fade(&mut self) {
        for number in self.squares.iter_mut().chain(&mut self.weights) {
            *number *= FADES;
        }
    }

    /// Adds a patch: the wrong part of it, 0 to 1.
    pub fn note(&mut self, kind: usize, wrong: f64) {
        if let (Some(square), Some(weight)) =
            (self.squares.get_mut(kind), self.weights.get_mut(kind))
        {
            *square += wrong * wrong;
            *weight += 1.0;
        }
    }

    /// The root of the mean square.
    pub fn spread(&self, kind: usize) -> f64 {
        let of = |numbers: &[f64; STRATA]| numbers.get(kind).copied().unwrap_or(0.0);
        ((of(&self.squares) + BELIEF * of(&BELIEVED)) / (of(&self.weights) + BELIEF)).sqrt()
    }
}
