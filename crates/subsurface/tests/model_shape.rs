//! The shape of the built-in model: its size, layers that never cross, and the throw of its faults.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_demo_scenes::subsurface::{Model, ModelOptions};
use antumbra_subsurface::{Surface, SurfaceKind};
use glam::{DVec2, DVec3, Vec3};
use std::collections::HashMap;

const HALF: DVec2 = DVec2::new(3275.0, 2962.5);

fn model(nodes_per_side: u32, seed: u64) -> Model {
    let options = ModelOptions {
        nodes_per_side,
        seed,
        ..ModelOptions::default()
    };
    Model::new(&options).unwrap()
}

fn surfaces(model: &Model) -> Vec<Surface> {
    let horizons = (0..model.options().horizons).map(|k| model.horizon(k as usize));
    let faults = (0..model.faults().len()).map(|i| model.fault(i));
    horizons.chain(faults).map(Result::unwrap).collect()
}

/// Places all over the field that are nodes at no resolution.
fn places() -> impl Iterator<Item = DVec2> {
    let share = |at: u32| (f64::from(at) + 0.37) / 90.0 * 2.0 - 1.0;
    (0..90).flat_map(move |x| (0..90).map(move |y| HALF * DVec2::new(share(x), share(y))))
}

#[test]
fn the_full_model_is_as_large_as_the_papers() {
    let triangles = Model::new(&ModelOptions::default())
        .unwrap()
        .triangle_count();
    let off = triangles as f64 / 3.88e6 - 1.0;
    assert!(off.abs() < 0.005, "{triangles} triangles");
}

#[test]
fn triangles_are_counted_as_they_are_made() {
    for seed in [1, 7] {
        let model = model(61, seed);
        let made = surfaces(&model);
        let made: usize = made.iter().map(|s| s.geometry.triangle_count()).sum();
        assert_eq!(made as u64, model.triangle_count());
    }
}

#[test]
fn horizons_never_cross_and_stay_in_the_volume() {
    for seed in 1..6 {
        let model = model(2, seed);
        let mut gaps = 0;
        for place in places() {
            let depths = (0..11).map(|k| model.depth(k, place));
            let known: Vec<f64> = depths.flatten().collect();
            gaps += 11 - known.len();
            assert!(
                known.is_sorted_by(|above, below| above < below),
                "{seed}: {place} {known:?}"
            );
            let inside = known.iter().all(|depth| (0.0..=3000.0).contains(depth));
            assert!(inside, "{seed}: {place} {known:?}");
        }
        let share = gaps as f64 / (11.0 * 90.0 * 90.0);
        assert!(
            (0.001..0.05).contains(&share),
            "{seed}: {share} of the horizons are gaps"
        );
    }
}

#[test]
fn faults_throw_horizons_by_what_they_say() {
    for seed in 1..6 {
        let model = model(2, seed);
        // The same layers, unbroken.
        let whole = Model::new(&ModelOptions {
            faults: 0,
            ..*model.options()
        })
        .unwrap();
        for (number, fault) in model.faults().iter().enumerate() {
            let towards = DVec2::new(fault.strike.cos(), -fault.strike.sin());
            // The first place on a side where the horizon exists, and its displacement there.
            let edge = |towards: DVec2| {
                let places = (0..400).map(|at| fault.centre + towards * f64::from(at) * 0.5);
                let mut known =
                    places.filter_map(|place| Some((place, model.depth(fault.horizon, place)?)));
                let (place, depth) = known.next().unwrap();
                (place, depth - whole.depth(fault.horizon, place).unwrap())
            };
            let ((low, sunken), (high, risen)) = (edge(towards), edge(-towards));
            let throw = sunken - risen;
            assert!(
                (throw / fault.throw - 1.0).abs() < 0.1,
                "{seed}: fault {number} of {} throws {throw}",
                fault.throw
            );
            // The gap follows from the slope of the fault and its throw.
            let heave = low.distance(high) / (fault.throw / fault.dip.tan());
            assert!(
                (0.7..1.4).contains(&heave),
                "{seed}: the gap at fault {number} is {heave} times as wide"
            );
        }
    }
}

#[test]
fn faults_are_where_they_may_be() {
    for seed in 1..6 {
        let model = model(40, seed);
        assert_eq!(model.faults().len(), 16);
        for (number, fault) in model.faults().iter().enumerate() {
            assert!((20.0..=150.0).contains(&fault.throw));
            assert!((50.0..=70.0).contains(&fault.dip.to_degrees()));
            let surface = model.fault(number).unwrap();
            let bounds = surface.geometry.bounds().unwrap();
            let (min, max) = (surface.origin + bounds.min, surface.origin + bounds.max);
            let room = DVec3::new(HALF.x, 1500.0, HALF.y);
            let middle = DVec3::NEG_Y * 1500.0;
            assert!(
                min.cmpge(middle - room).all() && max.cmple(middle + room).all(),
                "{seed}: fault {number} from {min} to {max}"
            );
        }
    }
}

#[test]
fn broken_cells_are_left_out() {
    let model = model(220, 1);
    let mut seen = 0;
    for fault in model.faults() {
        let surface = model.horizon(fault.horizon).unwrap();
        let flat = |p: DVec3| DVec2::new(p.x, -p.z);
        let mut sides = [0, 0];
        for triangle in surface.geometry.triangles() {
            let corners = surface.geometry.corners(triangle).unwrap();
            let [a, b, c] = corners.map(|corner| flat(corner + surface.origin) - fault.centre);
            let around = [a.perp_dot(b), b.perp_dot(c), c.perp_dot(a)];
            assert!(
                !around.into_iter().all(|turn| turn > 0.0),
                "a triangle lies across a fault"
            );
            let middle = (a + b + c) / 3.0;
            if middle.length() < 150.0 {
                let across = middle.dot(DVec2::new(fault.strike.cos(), -fault.strike.sin()));
                sides[usize::from(across > 0.0)] += 1;
            }
        }
        seen += usize::from(sides.into_iter().all(|count| count > 0));
    }
    assert!(
        seen >= 12,
        "only {seen} faults have a horizon on both sides"
    );
}

#[test]
fn the_same_seed_is_the_same_model() {
    let [a, b, c] = [5, 5, 6].map(|seed| model(48, seed));
    assert_eq!(surfaces(&a), surfaces(&b));
    assert_eq!(a.wells(), b.wells());
    assert_ne!(surfaces(&a), surfaces(&c));
}

#[test]
fn a_smaller_model_has_the_same_shape() {
    let (small, large) = (model(33, 3), model(129, 3));
    for horizon in 0..11 {
        let heights = |model: &Model| -> HashMap<[u32; 2], f64> {
            let surface = model.horizon(horizon).unwrap();
            let world = |p: &[f32; 3]| surface.origin.y + f64::from(p[1]);
            let heights = surface.geometry.positions.iter().map(world);
            let places = surface
                .plan
                .iter()
                .map(|plan| plan.map(|p| (p * 128.0).round() as u32));
            places.zip(heights).collect()
        };
        let (few, many) = (heights(&small), heights(&large));
        let shared = few
            .iter()
            .filter_map(|(place, height)| Some((height, many.get(place)?)));
        let mut count = 0;
        for (a, b) in shared {
            assert!((a - b).abs() < 1e-3, "horizon {horizon}: {a} and {b}");
            count += 1;
        }
        assert!(count > 600, "horizon {horizon}: only {count} shared nodes");
    }
}

#[test]
fn every_surface_can_be_drawn() {
    for surface in surfaces(&model(64, 2)) {
        let geometry = &surface.geometry;
        assert_eq!(geometry.problem(), None, "{}", surface.name);
        assert_eq!(geometry.normals.len(), geometry.positions.len());
        let is_horizon = surface.kind == SurfaceKind::Horizon;
        assert_eq!(
            surface.plan.len(),
            if is_horizon {
                geometry.positions.len()
            } else {
                0
            }
        );
        for triangle in geometry.triangles() {
            let [a, b, c] = geometry.corners(triangle).unwrap();
            let normal = (b - a).cross(c - a);
            assert!(
                normal.length() > 1.0,
                "{}: a triangle without area",
                surface.name
            );
            assert!(normal.y > 0.0, "{}: a triangle looks down", surface.name);
        }
        let unit = |normal: &[f32; 3]| (Vec3::from(*normal).length() - 1.0).abs() < 1e-4;
        assert!(geometry.normals.iter().all(unit));
    }
}

#[test]
fn what_cannot_be_is_refused() {
    let default = ModelOptions::default();
    let refused = |options: ModelOptions, name: &str| {
        let error = Model::new(&options).unwrap_err().to_string();
        assert!(error.contains(name), "{error}");
    };
    refused(
        ModelOptions {
            nodes_per_side: 1,
            ..default
        },
        "nodes_per_side",
    );
    refused(
        ModelOptions {
            nodes_per_side: u32::MAX,
            ..default
        },
        "nodes_per_side",
    );
    refused(
        ModelOptions {
            horizons: 0,
            ..default
        },
        "horizons",
    );
    refused(
        ModelOptions {
            faults: 65,
            ..default
        },
        "faults",
    );
    let model = model(2, 1);
    assert!(model.horizon(11).unwrap_err().to_string().contains("0..11"));
    assert!(model.fault(16).unwrap_err().to_string().contains("0..16"));
    for (horizons, faults) in [(1, 0), (1, 64), (64, 3)] {
        let options = ModelOptions {
            nodes_per_side: 80,
            horizons,
            faults,
            ..default
        };
        let model = Model::new(&options).unwrap();
        surfaces(&model);
        assert!(!model.flight().is_empty());
    }
    // Two cells per side, each crossed by faults.
    let coarse = ModelOptions {
        nodes_per_side: 3,
        faults: 64,
        ..default
    };
    let error = Model::new(&coarse).unwrap().horizon(10).unwrap_err();
    assert!(error.to_string().contains("nothing to show"));
}
