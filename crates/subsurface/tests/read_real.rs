//! The real files of `data/` (`make data`), where they are: what is known of them is what is read.

use std::path::PathBuf;
use std::time::Instant;

use antumbra_subsurface::read::{self, ReadOptions};
use antumbra_subsurface::{BrickSource, Surface, SurfaceKind};

/// `None`, said aloud, where the file has not been fetched.
fn real(name: &str) -> Option<PathBuf> {
    let path = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../data")).join(name);
    if !path.exists() {
        eprintln!("skipped: {} is not there (make data)", path.display());
        return None;
    }
    Some(path)
}

fn surfaces(name: &str) -> Option<Vec<Surface>> {
    let path = real(name)?;
    let start = Instant::now();
    let mut told = Vec::new();
    let read = read::surfaces(&path, &ReadOptions::default(), &mut |done, total| {
        told.push((done, total));
    });
    let surfaces = read.unwrap();
    let triangles = surfaces.iter().map(|s| s.geometry.triangle_count());
    eprintln!(
        "{name}: {} surfaces, {} triangles in {:?}",
        surfaces.len(),
        triangles.sum::<usize>(),
        start.elapsed()
    );
    let count = surfaces.len() as u64;
    assert_eq!(told.last(), Some(&(count, count)));
    for surface in &surfaces {
        let geometry = &surface.geometry;
        assert_eq!(geometry.problem(), None, "{}", surface.name);
        assert_eq!(geometry.normals.len(), geometry.positions.len());
        let is_horizon = surface.kind == SurfaceKind::Horizon;
        let plan = if is_horizon {
            geometry.positions.len()
        } else {
            0
        };
        assert_eq!(surface.plan.len(), plan);
        let inside = |at: &f32| (0.0..=1.0).contains(at);
        assert!(surface.plan.as_flattened().iter().all(inside));
        eprintln!(
            "  {}: {} vertices, {} triangles, {:?}",
            surface.name,
            geometry.positions.len(),
            geometry.triangle_count(),
            geometry.bounds().unwrap()
        );
    }
    Some(surfaces)
}

#[test]
fn drogons_grid_has_66_horizons_of_93_by_147_pillars() {
    let Some(surfaces) = surfaces("drogon/gg.roff") else {
        return;
    };
    assert_eq!(surfaces.len(), 66);
}

#[test]
fn drogons_porosity_fills_a_volume() {
    let (Some(grid), Some(property)) = (real("drogon/gg.roff"), real("drogon/gg_phit.roff")) else {
        return;
    };
    let grid = read::grid(&grid, &ReadOptions::default()).unwrap();
    let property = read::property(&property).unwrap();
    assert_eq!(
        (property.name.as_str(), property.size),
        ("PHIT", [92, 146, 65])
    );
    let start = Instant::now();
    let volume = grid
        .volume(&property, [200, 250, 100], &mut |_, _| ())
        .unwrap();
    eprintln!("{:?} {:?}", start.elapsed(), volume.layout());
    let nonzero = (0..100)
        .flat_map(|k| (0..250).flat_map(move |j| (0..200).map(move |i| [i, j, k])))
        .filter(|at| volume.sample(*at).unwrap() > 0)
        .count();
    eprintln!("filled {nonzero} of {}", 200 * 250 * 100);
}

#[test]
fn drogons_faults_are_six_of_479_triangles() {
    surfaces("drogon/ex_faultroom_1.3.1.json");
    surfaces("drogon/F5.ts");
    surfaces("drogon/topvolantis--ds_extract_geogrid.gri");
    surfaces("claudius.csv");
    surfaces("dem.tif");
}
