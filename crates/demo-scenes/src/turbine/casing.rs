//! The casings: shells of revolution with flanges. Two openings in a casing show the inside; red frames surround
//! them.

use super::airfoil::platform;
use super::assembly::{Assembly, Part};
use super::casing_surface::{CORE_OPENINGS, FAN_OPENINGS, OpeningAngles, standing, upright};
use super::fastener::stud;
use super::materials::MaterialKind;
use super::plan::{
    CORE_CASE, CORE_FLANGES, FAN_CASE, FAN_DUCT, FAN_FLANGES, FLANGE, Plan, WALL, radius_at,
};
use crate::shell::{ShellGrid, ShellSide};
use crate::solid::{Solid, polar};
use antumbra_scene::SceneError;
use glam::DAffine3;
use std::f64::consts::TAU;

/// Cells around a casing, 1.5 degrees each; openings begin and end between two cells.
const SIDES: usize = 240;
/// Maximum length of a cell along the axis, in metres.
const LONGEST: f64 = 0.03;
/// Width and height of the bars around an opening.
const BAR: [f64; 2] = [0.025, 0.012];

/// A part of the engine that has casings.
#[derive(Clone, Copy)]
enum EnginePart {
    Fan,
    Core,
}

/// The ends of a casing that have a flange.
#[derive(Clone, Copy)]
struct Flanges {
    front: bool,
    rear: bool,
}

/// One casing.
struct Casing {
    name: &'static str,
    material: MaterialKind,
    part: EnginePart,
    x: [f64; 2],
    /// Its flanges.
    flanges: Flanges,
    /// Axial range of its openings.
    opening: Option<[f64; 2]>,
}

/// The casings from inlet to nozzle.
fn casings() -> [Casing; 9] {
    let [fan, fan_end] = FAN_FLANGES;
    let [front, middle, diffuser, turbine, frame, nozzle] = CORE_FLANGES;
    let casing = |name, material, x, flanges, opening| Casing {
        name,
        material,
        part: EnginePart::Core,
        x,
        flanges,
        opening,
    };
    let of_fan = |casing: Casing| Casing {
        part: EnginePart::Fan,
        ..casing
    };
    let both = Flanges {
        front: true,
        rear: true,
    };
    let at_rear = Flanges {
        front: false,
        rear: true,
    };
    let at_front = Flanges {
        front: true,
        rear: false,
    };
    let cast = MaterialKind::FrontCasing;
    let cold = MaterialKind::CoreCasing;
    let hot = MaterialKind::HotCasing;
    [
        of_fan(casing(
            "inlet cowl",
            MaterialKind::Liner,
            [-2.0, fan],
            at_rear,
            None,
        )),
        of_fan(casing(
            "fan casing",
            MaterialKind::Composite,
            [fan, fan_end + FLANGE[1]],
            both,
            Some([-1.66, -1.12]),
        )),
        casing("front casing", cast, [-0.95, front], at_rear, None),
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
            MaterialKind::Nozzle,
            [nozzle, 1.9],
            at_front,
            None,
        ),
    ]
}

/// Adds casings, the splitter, and the frames of the openings.
pub(super) fn add(engine: &mut Assembly, plan: &Plan) -> Result<(), SceneError> {
    engine.module("casings")?;
    for casing in casings() {
        engine.place_single(casing.name, casing.material, casing.solid())?;
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
    splitter.revolve_closed(&profile, SIDES);
    engine.place_single("splitter", MaterialKind::OutletVane, splitter)?;

    engine.module("openings")?;
    let mut bolt = engine.part("frame bolt", MaterialKind::Bolt, stud(0.0105, 0.0))?;
    for casing in casings() {
        if let Some(x) = casing.opening {
            casing.frames(engine, plan, x, &mut bolt)?;
        }
    }
    Ok(())
}

impl Casing {
    fn outer(&self) -> &'static [[f64; 2]] {
        match self.part {
            EnginePart::Fan => &FAN_CASE,
            EnginePart::Core => &CORE_CASE,
        }
    }

    fn inner(&self, x: f64) -> f64 {
        match self.part {
            EnginePart::Fan => radius_at(&FAN_DUCT, x),
            EnginePart::Core => radius_at(&CORE_CASE, x) - WALL,
        }
    }

    /// The angles of its openings.
    fn openings(&self) -> OpeningAngles {
        match self.part {
            EnginePart::Fan => FAN_OPENINGS,
            EnginePart::Core => CORE_OPENINGS,
        }
    }

    fn solid(&self) -> Solid {
        let rows = self.rows();
        let OpeningAngles {
            middles,
            half_width: half,
        } = self.openings();
        let inside = |value: f64, [low, high]: [f64; 2]| low < value && value < high;
        let keep = |row: usize, column: usize| {
            let Some(opening) = self.opening else {
                return true;
            };
            let angle = (column as f64 + 0.5) * 360.0 / SIDES as f64;
            let across = middles.map(|middle| (angle - middle).abs() < half);
            !inside(0.5 * (rows[row] + rows[row + 1]), opening) || across == [false; 2]
        };
        let at = |row: usize, column: usize, side: ShellSide| {
            let x = rows[row];
            let radius = if side == ShellSide::Outer {
                radius_at(self.outer(), x)
            } else {
                self.inner(x)
            };
            polar(x, radius, TAU * column as f64 / SIDES as f64)
        };
        let mut solid = Solid::default();
        let wall = ShellGrid {
            rows: rows.len(),
            columns: SIDES,
        };
        solid.shell_where(wall, at, keep);
        let [rise, thick] = FLANGE;
        let [front, rear] = self.x;
        let flanges = [
            ([front, front + thick], self.flanges.front),
            ([rear - thick, rear], self.flanges.rear),
        ];
        for (x, has) in flanges {
            let foot = radius_at(self.outer(), 0.5 * (x[0] + x[1]));
            if has {
                solid.band(x, [foot - 0.5 * WALL, foot + rise], SIDES);
            }
        }
        solid
    }

    /// Axial positions of its rows of vertices: at every bend, at the edges of the openings, and between.
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
        let OpeningAngles {
            middles,
            half_width,
        } = self.openings();
        let half = half_width.to_radians();
        let outer = self.outer();
        let beside = width / radius_at(outer, 0.5 * (front + rear));
        let mut solid = Solid::default();
        for x in [[front - width, front], [rear, rear + width]] {
            let bar = [-0.002, height].map(|rise| x.map(|x| radius_at(outer, x) + rise));
            platform(&mut solid, x, bar, half + beside, 40);
        }
        for angle in [-half - beside, half] {
            solid.block([20, 1, 1], |u, v, w| {
                let x = front + (rear - front) * u;
                let radius = radius_at(outer, x) - 0.002 + (height + 0.002) * v;
                polar(x, radius, angle + beside * w)
            });
        }
        let name = format!("frame of the {}", self.name);
        let mut frame = engine.part(&name, MaterialKind::CutEdge, solid)?;
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
