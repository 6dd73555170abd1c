//! Boxes around the parts of meshes: what is drawn lies in them, and they leave empty space out.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use antumbra_scene::{Aabb, Geometry, Mesh, PartBox, PartBoxes, Topology, icosphere};
use glam::{DVec3, Vec3};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg32;

const MOST: usize = 16;

/// Boxes of these middles and half edges, as one mesh, each `times` over, so that there are enough triangles.
fn boxes(boxes: &[(DVec3, DVec3)], times: usize) -> Geometry {
    let mut made = Geometry::default();
    for (middle, half) in boxes {
        for _ in 0..times {
            let first = made.positions.len() as u32;
            let part = Geometry::from_box(&Aabb::from_centre(*middle, *half));
            made.positions.extend(&part.positions);
            made.indices
                .extend(part.indices.iter().map(|index| first + index));
        }
    }
    made
}

fn parts_of(mesh: &Mesh) -> PartBoxes {
    PartBoxes::new(mesh, &mesh.bounds().unwrap(), MOST)
}

/// A part's box in the mesh's own space.
fn placed(part: &PartBox, bounds: &Aabb) -> Aabb {
    let at = |steps: [u16; 3]| {
        let share = DVec3::from_array(steps.map(f64::from)) / f64::from(PartBox::STEPS);
        bounds.min + (bounds.max - bounds.min) * share
    };
    Aabb {
        min: at(part.low()),
        max: at(part.high()),
    }
}

/// Points all over the triangles of a geometry.
fn points(geometry: &Geometry, random: &mut Pcg32, each: usize) -> Vec<DVec3> {
    let corner = |index: u32| Vec3::from(geometry.positions[index as usize]).as_dvec3();
    let mut made = Vec::new();
    for triangle in geometry.triangles() {
        let [a, b, c] = triangle.map(corner);
        made.extend([a, b, c]);
        for _ in 0..each {
            let (mut s, mut t) = (random.random_range(0.0..1.0), random.random_range(0.0..1.0));
            if s + t > 1.0 {
                (s, t) = (1.0 - s, 1.0 - t);
            }
            made.push(a + (b - a) * s + (c - a) * t);
        }
    }
    made
}

fn table() -> Mesh {
    let leg = |x: f64, z: f64| (DVec3::new(x, 0.35, z), DVec3::new(0.03, 0.35, 0.03));
    let top = (DVec3::new(0.0, 0.72, 0.0), DVec3::new(0.8, 0.02, 0.4));
    let legs = [
        leg(-0.7, -0.3),
        leg(0.7, -0.3),
        leg(-0.7, 0.3),
        leg(0.7, 0.3),
    ];
    let all: Vec<_> = std::iter::once(top).chain(legs).collect();
    Mesh::new("table", boxes(&all, 2))
}

#[test]
fn a_table_is_its_top_and_its_legs() {
    let mesh = table();
    let bounds = mesh.bounds().unwrap();
    let parts = parts_of(&mesh);
    let volume = |bounds: &Aabb| (bounds.max - bounds.min).element_product();
    let held: f64 = parts
        .boxes
        .iter()
        .map(|part| volume(&placed(part, &bounds)))
        .sum();
    assert!(
        held < 0.12 * volume(&bounds),
        "{held} of {}",
        volume(&bounds)
    );
    assert!((5..=MOST).contains(&parts.boxes.len()), "{parts:?}");
    // The largest comes first.
    let first = placed(&parts.boxes[0], &bounds);
    assert!(first.min.y > 0.6, "{first:?}");
}

#[test]
fn whatever_is_drawn_lies_in_a_part() {
    let mut random = Pcg32::seed_from_u64(3);
    let mut with_parts = 0;
    for number in 0..120 {
        let mut number_in = |low: f64, high: f64| random.random_range(low..high);
        // Triangles of all sizes, many of them flat or long, anywhere from the origin.
        let origin = DVec3::splat([0.0, 5.0, -1e5][number % 3]);
        let stretch = DVec3::from_array([(); 3].map(|()| 10f64.powf(number_in(-2.5, 1.0))));
        let mut soup = Geometry::default();
        for triangle in 0..90u32 {
            let middle = DVec3::from_array([(); 3].map(|()| number_in(-1.0, 1.0).powi(3)));
            let size = 10f64.powf(number_in(-2.0, -0.3));
            for _ in 0..3 {
                let off = DVec3::from_array([(); 3].map(|()| number_in(-size, size)));
                let at = origin + (middle + off) * stretch;
                soup.positions.push(at.as_vec3().to_array());
            }
            soup.indices
                .extend([0, 1, 2].map(|corner| triangle * 3 + corner));
        }
        let mut mesh = Mesh::new("soup", soup);
        // A coarser level that lies elsewhere.
        mesh.levels
            .push(boxes(&[(origin + stretch, stretch * 0.1)], 1));
        let bounds = mesh.bounds().unwrap();
        let parts = parts_of(&mesh);
        assert!(parts.boxes.len() <= MOST);
        if parts.boxes.is_empty() {
            continue;
        }
        with_parts += 1;
        let placed: Vec<_> = parts
            .boxes
            .iter()
            .map(|part| placed(part, &bounds))
            .collect();
        for level in &mesh.levels {
            for point in points(level, &mut random, 20) {
                assert!(
                    placed.iter().any(|part| part.contains(point)),
                    "soup {number}: {point} lies in none of {placed:?}"
                );
            }
        }
    }
    assert!(with_parts > 30, "only {with_parts} have parts");
}

#[test]
fn what_gains_nothing_has_no_parts() {
    let solid = Mesh::new("solid", boxes(&[(DVec3::ZERO, DVec3::ONE)], 8));
    let small = Mesh::new(
        "small",
        boxes(
            &[(DVec3::ZERO, DVec3::ONE), (DVec3::ONE * 9.0, DVec3::ONE)],
            1,
        ),
    );
    let ball = Mesh::new("ball", icosphere(2, 1.0));
    let point = Mesh::new("point", boxes(&[(DVec3::ZERO, DVec3::ZERO)], 8));
    let mut lines = table();
    lines.levels[0].topology = Topology::Lines;
    for mesh in [&solid, &small, &ball, &point, &lines] {
        assert_eq!(parts_of(mesh), PartBoxes::default(), "{}", mesh.name);
    }
}

#[test]
fn a_flat_mesh_reaches_from_end_to_end_of_its_thin_axis() {
    // Two small squares at opposite corners of a sheet.
    let square = |x: f64, y: f64| (DVec3::new(x, y, 0.0), DVec3::new(0.1, 0.1, 0.0));
    let mesh = Mesh::new("squares", boxes(&[square(-1.0, -1.0), square(1.0, 1.0)], 4));
    let parts = parts_of(&mesh);
    assert_eq!(parts.boxes.len(), 2, "{parts:?}");
    assert_eq!(parts.flat.to_string(), "[false, false, true]");
    for part in &parts.boxes {
        assert_eq!([part.low()[2], part.high()[2]], [0, PartBox::STEPS]);
        assert!(part.high()[0] - part.low()[0] < 120, "{part:?}");
    }
}
