//! The built-in city: as many triangles as it says under every seed, a tree as an architect's file has it, closed pieces that look
//! outwards, and walls that hide what is behind them but for windows and doors.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "turbine/shells.rs"]
mod shells;

use antumbra_scene::builtin::{self, BuiltinError, CityOptions, city};
use antumbra_scene::{EntityKey, Light, Scene};
use glam::{DAffine3, DVec3};
use std::collections::{HashMap, HashSet};

/// As many as the city of Staneker, Bartz and Straßer had.
const TRIANGLES: f64 = 64_898_464.0;

fn built(size: u32, seed: u64) -> Scene {
    city(CityOptions { size, seed }).unwrap()
}

#[test]
fn stats() {
    let scene = built(7, 1);
    println!("triangles {}  share {}", scene.triangle_count(), scene.triangle_count() as f64 / TRIANGLES);
    println!("entities {} drawables {} meshes {} materials {}", scene.len(), scene.drawable_count(), scene.mesh_count(), scene.materials().count());
    let mut by: HashMap<_, usize> = HashMap::new();
    for (_, d) in scene.drawables() { *by.entry(d.mesh).or_default() += 1; }
    let mut rows: Vec<_> = scene.meshes().map(|(k, m)| (by[&k] * m.triangle_count(), by[&k], m.triangle_count(), m.name.clone())).collect();
    rows.sort();
    println!("unique {}", rows.iter().map(|r| r.2).sum::<usize>());
    for r in rows.iter().rev() { println!("{:>9} {:>6} {:>6} {}", r.0, r.1, r.2, r.3); }
}

#[test]
fn pieces_are_closed_and_look_outwards() {
    let mut bad = Vec::new();
    for (_, mesh) in built(3, 1).meshes() {
        mesh.validate().unwrap();
        let (name, geometry) = (&mesh.name, mesh.full().unwrap());
        let open = shells::open_edges(geometry);
        if open != 0 { bad.push(format!("{name}: {open} open edges")); }
        let neg = shells::volumes(geometry).into_iter().filter(|v| *v <= 0.0).count();
        if neg > 0 { bad.push(format!("{name}: {neg} shells inside out")); }
        let (mut flat, mut turned) = (0, 0);
        for triangle in geometry.triangles() {
            let [a, b, c] = geometry.corners(triangle).unwrap();
            let face = (b - a).cross(c - a);
            if face.length() <= 0.0 { flat += 1; }
            let sum: DVec3 = triangle.map(|i| {
                DVec3::from(geometry.normals[i as usize].map(f64::from))
            }).into_iter().sum();
            if face.dot(sum) <= 0.0 { turned += 1; }
        }
        if flat + turned > 0 { bad.push(format!("{name}: {flat} without area, {turned} turned")); }
    }
    assert!(bad.is_empty(), "{}", bad.join("\n"));
}
#[test]
fn opendoors() {
    let scene = built(7, 1);
    for (e, d) in scene.drawables() {
        if scene.mesh(d.mesh).unwrap().name == "open house door" {
            let storey = scene.parent(e).unwrap(); let house = scene.parent(storey).unwrap(); let lot = scene.parent(house).unwrap(); let block = scene.parent(lot).unwrap();
            let at = scene.world(house).unwrap().translation;
            if ["lot 4","lot 8","lot 12","lot 16"].contains(&scene.entity_name(lot)) && at.x.abs() < 130.0 && at.z.abs() < 130.0 {
                println!("{} {} {} {:?} children {}", scene.entity_name(block), scene.entity_name(lot), scene.entity_name(house), at, scene.children(house).count());
            }
        }
    }
}
