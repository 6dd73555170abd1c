//! The distance on the screen from an entity to the nearest visible one, in cells of a coarse grid. An entity hidden beside a visible one
//! appears sooner than one hidden behind the middle of a wall.

use antumbra_cull::{SceneTable, ViewFrame};
use antumbra_scene::Aabb;
use glam::DVec3;

/// Cells along each side of the screen.
const SIDE: usize = 32;

/// For each cell, the steps to the nearest cell that holds the centre of a visible entity.
#[derive(Debug, Clone)]
pub(crate) struct ScreenDistance {
    steps: Box<[u32; SIDE * SIDE]>,
}

impl Default for ScreenDistance {
    fn default() -> Self {
        Self {
            steps: Box::new([u32::MAX; SIDE * SIDE]),
        }
    }
}

impl ScreenDistance {
    /// Marks the cells of the visible slots and finds the steps from all other cells, with two sweeps over the grid (the distance transform
    /// of Rosenfeld and Pfaltz, *Sequential Operations in Digital Picture Processing*, 1966).
    pub fn update(&mut self, table: &SceneTable, view: &ViewFrame, visible: &[u32]) {
        self.steps.fill(FAR);
        for slot in visible {
            if let Some(cell) = cell(&table.bounds(*slot), view)
                && let Some(steps) = self.steps.get_mut(cell)
            {
                *steps = 0;
            }
        }
        for at in 0..SIDE * SIDE {
            let before = [(at % SIDE > 0).then(|| at - 1), at.checked_sub(SIDE)];
            self.relax(at, before);
        }
        for at in (0..SIDE * SIDE).rev() {
            let after = [
                (at % SIDE < SIDE - 1).then_some(at + 1),
                (at + SIDE < SIDE * SIDE).then_some(at + SIDE),
            ];
            self.relax(at, after);
        }
    }

    fn relax(&mut self, at: usize, neighbours: [Option<usize>; 2]) {
        let near = neighbours.into_iter().flatten();
        let best = near.filter_map(|cell| self.steps.get(cell).copied()).min();
        if let (Some(best), Some(steps)) = (best, self.steps.get_mut(at)) {
            *steps = (*steps).min(best.saturating_add(1));
        }
    }

    /// Steps from the centre of a box to the nearest visible entity. 0 where the centre lies off the screen: the entity may turn into view
    /// at any time.
    pub fn steps(&self, bounds: &Aabb, view: &ViewFrame) -> u32 {
        cell(bounds, view)
            .and_then(|cell| self.steps.get(cell).copied())
            .unwrap_or(0)
    }
}

/// More steps than there are between any two cells.
const FAR: u32 = 4 * SIDE as u32;

/// The cell of a box's centre; `None` off the screen.
fn cell(bounds: &Aabb, view: &ViewFrame) -> Option<usize> {
    let relative: DVec3 = bounds.centre() - view.camera.position;
    let clip = view.clip_from_relative() * relative.as_vec3().extend(1.0);
    if clip.w <= 0.0 {
        return None;
    }
    let part = |along: f32| {
        let part = (along / clip.w * 0.5 + 0.5) * SIDE as f32;
        (0.0..SIDE as f32).contains(&part).then_some(part as usize)
    };
    Some(part(clip.y)? * SIDE + part(clip.x)?)
}
