//! Windows: styles, frames, sills, curtains and blinds.

use super::plan::LOT;
use super::shapes::Opening;
use crate::solid::Solid;
use glam::DVec3;
use std::f64::consts::TAU;

/// Window style of a house.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Style {
    /// Two upright windows per room.
    Paired,
    /// One wide window per room.
    Wide,
    /// Two windows per room that reach the floor, each with a railing.
    French,
}

/// Curtains or blinds of a room.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Hanging {
    /// Open curtains.
    Aside,
    /// Closed curtains.
    Closed,
    /// Lowered blinds.
    Blinds,
}

impl Style {
    pub fn name(self) -> &'static str {
        match self {
            Self::Paired => "paired",
            Self::Wide => "wide",
            Self::French => "french",
        }
    }

    /// The windows of a room whose centre is at x = 0.
    pub fn of_room(self) -> Vec<Opening> {
        let pair = |half: f64, y: [f64; 2]| {
            let beside = |x: f64| Opening {
                x: [x - half, x + half],
                y,
            };
            vec![beside(-1.3), beside(1.3)]
        };
        match self {
            Self::Paired => pair(0.65, [0.85, 2.35]),
            Self::French => pair(0.55, [0.12, 2.35]),
            Self::Wide => vec![Opening {
                x: [-1.6, 1.6],
                y: [0.85, 2.3],
            }],
        }
    }

    /// The window of a hall.
    pub fn of_hall(self) -> Opening {
        Opening {
            x: [-0.6, 0.6],
            y: [0.85, 2.35],
        }
    }
}

/// A house's door.
pub(super) const DOOR: Opening = Opening {
    x: [-0.6, 0.6],
    y: [-0.02, 2.2],
};

/// Frames, sills and lintels of windows in a wall whose outer face is at z = [`LOT`], and railings of those that
/// reach the floor.
pub(super) fn frames(openings: &[Opening]) -> Solid {
    let mut solid = Solid::default();
    let front = LOT;
    for opening in openings {
        let Opening { x, y } = *opening;
        let (middle, wide) = (0.5 * (x[0] + x[1]), x[1] - x[0]);
        solid.frame(*opening, 0.06, [front - 0.2, front - 0.12]);
        let lights = (wide / 0.7).round().max(1.0) as usize;
        for light in 0..lights {
            let from = x[0] + 0.06 + (wide - 0.12) * light as f64 / lights as f64;
            let to = from + (wide - 0.12) / lights as f64;
            let pane = Opening {
                x: [from, to],
                y: [y[0] + 0.06, y[1] - 0.06],
            };
            solid.frame(pane, 0.035, [front - 0.185, front - 0.135]);
        }
        if y[0] > 0.5 {
            solid.rounded_box(
                [x[0] - 0.08, y[0] - 0.07, front - 0.13],
                [x[1] + 0.08, y[0] + 0.002, front + 0.09],
                0.02,
                1,
            );
        } else {
            railing(&mut solid, [x[0] - 0.03, x[1] + 0.03], front);
        }
        // A moulding around the window; its top is wider.
        let around = Opening {
            x: [x[0] - 0.14, x[1] + 0.14],
            y: [y[0] - 0.14, y[1] + 0.14],
        };
        solid.frame(around, 0.139, [front - 0.02, front + 0.035]);
        solid.rounded_box(
            [middle - 0.5 * wide - 0.2, y[1] + 0.13, front - 0.02],
            [middle + 0.5 * wide + 0.2, y[1] + 0.21, front + 0.11],
            0.02,
            1,
        );
    }
    solid
}

fn railing(solid: &mut Solid, x: [f64; 2], front: f64) {
    let z = front + 0.1;
    for y in [0.22, 0.95] {
        solid.bar([x[0], y, z], [x[1], y, z], 0.018, 6);
        for x in x {
            solid.bar([x, y, front - 0.03], [x, y, z + 0.01], 0.014, 4);
        }
    }
    let bars = ((x[1] - x[0]) / 0.14) as usize;
    for bar in 0..=bars {
        let x = x[0] + 0.02 + (x[1] - x[0] - 0.04) * bar as f64 / bars as f64;
        solid.bar([x, 0.21, z], [x, 0.96, z], 0.008, 4);
    }
}

/// Curtains or blinds of the windows of a room, in front of its wall at z = 0; the room is towards -Z.
pub(super) fn hangings(style: Style, hanging: Hanging) -> Solid {
    let mut solid = Solid::default();
    for Opening { x, y } in style.of_room() {
        let high = y[1] + 0.12;
        if hanging == Hanging::Blinds {
            let slats = ((high - y[0]) / 0.085) as usize;
            for slat in 0..slats {
                let y = y[0] + 0.085 * slat as f64;
                // Slats are tilted and overlap.
                solid.block([1; 3], |u, v, w| {
                    DVec3::new(
                        x[0] - 0.05 + (x[1] - x[0] + 0.1) * u,
                        y + 0.095 * v,
                        -0.3 + 0.03 * v + 0.004 * w,
                    )
                });
            }
            let ends = [x[0] - 0.06, x[1] + 0.06];
            solid.cuboid(
                [ends[0], high - 0.04, -0.32],
                [ends[1], high + 0.04, -0.002],
            );
            for x in [x[0] + 0.1, x[1] - 0.1] {
                solid.bar([x, y[0], -0.266], [x, high, -0.266], 0.003, 4);
            }
            continue;
        }
        let rod = [x[0] - 0.25, x[1] + 0.25];
        solid.bar(
            [rod[0], high + 0.05, -0.33],
            [rod[1], high + 0.05, -0.33],
            0.014,
            8,
        );
        for end in [rod[0] + 0.03, rod[1] - 0.03] {
            solid.bar([end, high + 0.05, -0.34], [end, high + 0.05, 0.01], 0.01, 6);
        }
        let low = (y[0] - 0.25).max(0.02);
        let middle = 0.5 * (x[0] + x[1]);
        let parts = match hanging {
            Hanging::Closed => [
                [rod[0] + 0.05, middle - 0.005],
                [middle + 0.005, rod[1] - 0.05],
            ],
            _ => [[rod[0] + 0.05, x[0] + 0.12], [x[1] - 0.12, rod[1] - 0.05]],
        };
        for part in parts {
            cloth(&mut solid, part, [low, high + 0.045]);
        }
    }
    solid
}

/// A curtain in folds.
fn cloth(solid: &mut Solid, x: [f64; 2], y: [f64; 2]) {
    let folds = ((x[1] - x[0]) / 0.15).ceil();
    solid.block([4 * folds as usize, 1, 1], |u, v, w| {
        let wave = (TAU * folds * u).sin() * (0.022 + 0.014 * (1.0 - v));
        DVec3::new(
            x[0] + (x[1] - x[0]) * u,
            y[0] + (y[1] - y[0]) * v,
            -0.335 + wave + 0.006 * w,
        )
    });
}
