//! The casings: turned walls with flanges, with openings cut into them through which the inside is seen, and red frames around those.

use super::airfoil::platform;
use super::assembly::{Assembly, Part};
use super::fastener::stud;
use super::look::Look;
use super::plan::{
    CORE_CASE, CORE_FLANGES, FAN_CASE, FAN_DUCT, FAN_FLANGES, FLANGE, Plan, WALL, line,
};
use super::skin::{CORE_OPENINGS, FAN_OPENINGS, standing, upright};
use crate::shell::Wall;
use crate::solid::{Solid, polar};
use antumbra_scene::SceneError;
use glam::DAffine3;
use std::f64::consts::TAU;

/// Cells around a casing, 1.5 degrees each: openings begin and end between two.
const SIDES: usize = 240;
/// Longest cell along the axis, in metres.
const LONGEST: f64 = 0.03;
/// Width and height of the bars around an opening.
const BAR: [f64; 2] = [0.025, 0.012];

/// One casing.
struct Casing {
    name: &'static str,
    look: Look,
    fan: bool,
    x: [f64; 2],
    /// Whether it has a flange at its front, at its rear.
    flanges: [bool; 2],
    /// Where its openings begin and end along the axis.
    opening: Option<[f64; 2]>,
}

/// The casings from inlet to nozzle.
fn casings() -> [Casing; 9] {
    let [fan, fan_end] = FAN_FLANGES;
    let [front, middle, diffuser, turbine, frame, nozzle] = CORE_FLANGES;
    let casing = |name, look, x, flanges, opening| Casing {
        name,
        look,
        fan: false,
        x,
        flanges,
        opening,
    };
    let of_fan = |casing: Casing| Casing {
        fan: true,
        ..casing
    };
    let (both, cast) = ([true, true], Look::FrontCasing);
    let cold = Look::CoreCasing;
    let hot = Look::HotCasing;
    [
        of_fan(casing(
            "inlet cowl",
            Look::Liner,
            [-2.0, fan],
            [false, true],
            None,
        )),
        of_fan(casing(
            "fan casing",
            Look::Composite,
            [fan, fan_end + FLANGE[1]],
            both,
            Some([-1.66, -1.12]),
        )),
        casing("front casing", cast, [-0.95, front], [false, true], None),
        casing(
            "compressor casing, front",
            cold,
            [front, middle],
            both,
            Some([-0.52, -0.23]),
        ),
        casing(
            "compressor casing, rear",
            cold,
            [middle, diffuser],
            both,
            Some([-0.07, 0.20]),
        ),
        casing(
            "combustor casing",
            hot,
            [diffuser, turbine],
            both,
            Some([0.36, 0.77]),
        ),
        casing(
            "turbine casing",
            hot,
            [turbine, frame],
            both,
            Some([0.93, 1.37]),
        ),
        casing("exhaust casing", hot, [frame, nozzle], both, None),
        casing(
            "exhaust nozzle",
            Look::Nozzle,
            [nozzle, 1.9],
            [true, false],
            None,
        ),
    ]
}

/// Adds casings, the splitter, and the frames of the openings.
pub(super) fn add(engine: &mut Assembly, plan: &Plan) -> Result<(), SceneError> {
    engine.module("casings")?;
    for casing in casings() {
        engine.single(casing.name, casing.look, casing.solid())?;
    }
    let mut splitter = Solid::default();
    let profile = [
        [-1.2, 0.785],
        [-1.1, 0.768],
        [-0.95, 0.765],
        [-0.95, 0.84],
        [-1.05, 0.838],
        [-1.15, 0.815],
    ];
    splitter.ring(&profile, SIDES);
    engine.single("splitter", Look::OutletVane, splitter)?;

    engine.module("openings")?;
    let mut bolt = engine.part("frame bolt", Look::Bolt, stud(0.0105, 0.0))?;
    for casing in casings() {
        if let Some(x) = casing.opening {
            casing.frames(engine, plan, x, &mut bolt)?;
        }
    }
    Ok(())
}

impl Casing {
    fn outer(&self) -> &'static [[f64; 2]] {
        if self.fan { &FAN_CASE } else { &CORE_CASE }
    }

    fn inner(&self, x: f64) -> f64 {
        if self.fan {
            line(&FAN_DUCT, x)
        } else {
            line(&CORE_CASE, x) - WALL
        }
    }

    /// Middles and half the width of its openings, in degrees.
    fn openings(&self) -> ([f64; 2], f64) {
        if self.fan {
            FAN_OPENINGS
        } else {
            CORE_OPENINGS
        }
    }

    fn solid(&self) -> Solid {
        let rows = self.rows();
        let (middles, half) = self.openings();
        let inside = |value: f64, [low, high]: [f64; 2]| low < value && value < high;
        let keep = |row: usize, column: usize| {
            let Some(opening) = self.opening else {
                return true;
            };
            let angle = (column as f64 + 0.5) * 360.0 / SIDES as f64;
            let across = middles.map(|middle| (angle - middle).abs() < half);
            !inside(0.5 * (rows[row] + rows[row + 1]), opening) || across == [false; 2]
        };
        let at = |row: usize, column: usize, outside: bool| {
            let x = rows[row];
            let radius = if outside {
                line(self.outer(), x)
            } else {
                self.inner(x)
            };
            polar(x, radius, TAU * column as f64 / SIDES as f64)
        };
        let mut solid = Solid::default();
        let wall = Wall {
            rows: rows.len(),
            columns: SIDES,
        };
        solid.wall_where(wall, at, keep);
        let [rise, thick] = FLANGE;
        let [front, rear] = self.x;
        for (x, has) in [[front, front + thick], [rear - thick, rear]]
            .into_iter()
            .zip(self.flanges)
        {
            let foot = line(self.outer(), 0.5 * (x[0] + x[1]));
            if has {
                solid.band(x, [foot - 0.5 * WALL, foot + rise], SIDES);
            }
        }
        solid
    }

    /// Where its cells begin and end along the axis: at every bend and at the openings' edges.
    fn rows(&self) -> Vec<f64> {
        let [front, rear] = self.x;
        let bends = self.outer().iter().map(|point| point[0]);
        let mut edges: Vec<f64> = bends
            .chain(self.opening.into_iter().flatten())
            .chain(self.x)
            .filter(|x| (front..=rear).contains(x))
            .collect();
        edges.sort_by(f64::total_cmp);
        edges.dedup();
        let mut rows = vec![front];
        for run in edges.windows(2) {
            let (from, to) = (run[0], run[1]);
            let cells = ((to - from) / LONGEST).ceil();
            rows.extend((1..cells as usize).map(|i| from + (to - from) * i as f64 / cells));
            rows.push(to);
        }
        rows
    }

    /// The frames of its two openings, with their bolts.
    fn frames(
        &self,
        engine: &mut Assembly,
        plan: &Plan,
        [front, rear]: [f64; 2],
        bolt: &mut Part,
    ) -> Result<(), SceneError> {
        let [width, height] = BAR;
        let (middles, half) = self.openings();
        let half = half.to_radians();
        let outer = self.outer();
        let beside = width / line(outer, 0.5 * (front + rear));
        let mut solid = Solid::default();
        for x in [[front - width, front], [rear, rear + width]] {
            let bar = [-0.002, height].map(|rise| x.map(|x| line(outer, x) + rise));
            platform(&mut solid, x, bar, half + beside, 40);
        }
        for angle in [-half - beside, half] {
            solid.block([20, 1, 1], |u, v, w| {
                let x = front + (rear - front) * u;
                let radius = line(outer, x) - 0.002 + (height + 0.002) * v;
                polar(x, radius, angle + beside * w)
            });
        }
        let name = format!("frame of the {}", self.name);
        let mut frame = engine.part(&name, Look::CutEdge, solid)?;
        let [along, around] = plan.frame_bolts;
        for middle in middles.map(f64::to_radians) {
            engine.place(&mut frame, DAffine3::from_rotation_x(middle))?;
            let spread = |i: usize, of: usize| (i as f64 + 0.5) / of as f64;
            let ends = [front - 0.5 * width, rear + 0.5 * width];
            let sides = [-half - 0.5 * beside, half + 0.5 * beside];
            let axial = (0..along).flat_map(|i| {
                sides.map(|angle| (front + (rear - front) * spread(i, along), angle))
            });
            let across =
                (0..around).flat_map(|i| ends.map(|x| (x, half * (2.0 * spread(i, around) - 1.0))));
            for (x, angle) in axial.chain(across) {
                let at = upright(outer, x, middle + angle, height);
                engine.place(bolt, at * standing())?;
            }
        }
        Ok(())
    }
}
