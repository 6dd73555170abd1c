//! Dimensions of the engine in metres: the number of each part in the two sizes, and the profiles along which parts
//! meet.
//!
//! The axis is X, rearwards; the origin is the engine's centre.

/// Number and resolution of each part.
pub(super) struct Plan {
    /// Drawable entities in all.
    pub components: usize,
    pub fan_blades: usize,
    /// Vanes behind the fan.
    pub outlet_vanes: usize,
    /// Vanes before the compressor.
    pub inlet_vanes: usize,
    pub compressor: Stages,
    pub turbine: Stages,
    /// Bolts between a disc and the next.
    pub tie_bolts: usize,
    pub cans: usize,
    /// Balls of a bearing.
    pub balls: usize,
    /// Struts of the front and of the rear frame.
    pub struts: usize,
    /// Bolts of a flange of the fan's casing.
    pub fan_bolts: usize,
    /// Bolts of a flange of the core's casing.
    pub core_bolts: usize,
    /// Bolts on each side of an opening: axial sides and sides around.
    pub frame_bolts: [usize; 2],
    pub pipes: usize,
    /// Clamps of a pipe.
    pub clamps: usize,
    pub brackets: usize,
    pub pumps: usize,
    pub boxes: usize,
    /// Panels inside the inlet.
    pub panels: usize,
    /// Rings of screws on the spinner, and screws per ring.
    pub spinner_screws: [usize; 2],
    /// Cells of an airfoil along the span and around: compressor blades, compressor vanes, turbine.
    pub airfoils: [[usize; 2]; 3],
    /// Points of a pipe.
    pub pipe_steps: usize,
}

/// The stages of a compressor or turbine: rows of blades and vanes.
#[derive(Clone, Copy)]
pub(super) struct Stages {
    pub count: usize,
    /// Blades of the first stage, and the increase per stage.
    pub blades: [isize; 2],
    /// Vanes of the first stage, and the increase per stage.
    pub vanes: [isize; 2],
    /// Axial range of all stages.
    pub x: [f64; 2],
}

impl Stages {
    /// Length of a stage in metres.
    pub fn pitch(&self) -> f64 {
        (self.x[1] - self.x[0]) / self.count as f64
    }

    /// Axial position in a stage, from 0 at its front to 1 at its rear.
    pub fn at(&self, stage: usize, part: f64) -> f64 {
        self.x[0] + self.pitch() * (stage as f64 + part)
    }

    pub fn blades(&self, stage: usize) -> usize {
        grown(self.blades, stage)
    }

    pub fn vanes(&self, stage: usize) -> usize {
        grown(self.vanes, stage)
    }
}

fn grown([first, more]: [isize; 2], stage: usize) -> usize {
    (first + more * stage as isize).max(1) as usize
}

/// The sizes 1 and 2, with the triangle counts of the two engines of the publication.
pub(super) const PLANS: [Plan; 2] = [
    Plan {
        components: 2_000,
        fan_blades: 22,
        outlet_vanes: 40,
        inlet_vanes: 20,
        compressor: Stages {
            count: 6,
            blades: [26, 4],
            vanes: [28, 4],
            x: [-0.56, 0.24],
        },
        turbine: Stages {
            count: 3,
            blades: [48, -4],
            vanes: [24, 4],
            x: [0.88, 1.44],
        },
        tie_bolts: 4,
        cans: 12,
        balls: 14,
        struts: 8,
        fan_bolts: 60,
        core_bolts: 36,
        frame_bolts: [3, 5],
        pipes: 56,
        clamps: 2,
        brackets: 60,
        pumps: 5,
        boxes: 6,
        panels: 18,
        spinner_screws: [3, 20],
        airfoils: [[14, 22], [14, 22], [17, 26]],
        pipe_steps: 120,
    },
    Plan {
        components: 4_000,
        fan_blades: 24,
        outlet_vanes: 48,
        inlet_vanes: 28,
        compressor: Stages {
            count: 9,
            blades: [28, 5],
            vanes: [30, 5],
            x: [-0.56, 0.24],
        },
        turbine: Stages {
            count: 5,
            blades: [60, -4],
            vanes: [28, 4],
            x: [0.88, 1.44],
        },
        tie_bolts: 4,
        cans: 18,
        balls: 20,
        struts: 10,
        fan_bolts: 150,
        core_bolts: 70,
        frame_bolts: [4, 6],
        pipes: 108,
        clamps: 3,
        brackets: 150,
        pumps: 8,
        boxes: 10,
        panels: 24,
        spinner_screws: [5, 24],
        airfoils: [[14, 22], [14, 22], [19, 28]],
        pipe_steps: 134,
    },
];

/// Thickness of a casing.
pub(super) const WALL: f64 = 0.02;
/// Height of a flange above its casing, and its thickness.
pub(super) const FLANGE: [f64; 2] = [0.045, 0.015];

/// Axial positions of the flanges of the fan casing; the last ends it.
pub(super) const FAN_FLANGES: [f64; 2] = [-1.75, -0.965];
/// Axial positions of the flanges between the core casings.
pub(super) const CORE_FLANGES: [f64; 6] = [-0.6, -0.15, 0.28, 0.85, 1.45, 1.65];

/// Outer profile of the fan casing.
pub(super) const FAN_CASE: [[f64; 2]; 5] = [
    [-2.0, 1.462],
    [-1.975, 1.485],
    [-1.93, 1.496],
    [-1.85, 1.5],
    [-0.95, 1.5],
];
/// Inner profile of the fan casing.
pub(super) const FAN_DUCT: [[f64; 2]; 5] = [
    [-2.0, 1.462],
    [-1.975, 1.45],
    [-1.93, 1.444],
    [-1.85, 1.44],
    [-0.95, 1.44],
];
/// Outer profile of the core casings.
pub(super) const CORE_CASE: [[f64; 2]; 10] = [
    [-0.95, 0.82],
    [-0.6, 0.77],
    [-0.15, 0.67],
    [0.28, 0.62],
    [0.4, 0.645],
    [0.75, 0.645],
    [0.85, 0.64],
    [1.45, 0.8],
    [1.65, 0.8],
    [1.9, 0.7],
];
/// Profile of the hub below the blades of compressor and turbine.
pub(super) const HUB: [[f64; 2]; 5] = [
    [-1.3, 0.42],
    [-0.6, 0.45],
    [0.25, 0.47],
    [0.85, 0.47],
    [1.5, 0.42],
];

/// Radius of a profile at `x`; outside its range, that of its ends.
pub(super) fn radius_at(points: &[[f64; 2]], x: f64) -> f64 {
    let mut height = points.first().map_or(0.0, |point| point[1]);
    for run in points.windows(2) {
        let ([from, low], [to, high]) = (run[0], run[1]);
        if x > from {
            height = low + (high - low) * ((x - from) / (to - from)).min(1.0);
        }
    }
    height
}

/// Inner radius of the core casing over an axial range: the upper limit for rotating parts.
pub(super) fn core_duct(x: f64, half: f64) -> f64 {
    radius_at(&CORE_CASE, x - half).min(radius_at(&CORE_CASE, x + half)) - WALL
}
