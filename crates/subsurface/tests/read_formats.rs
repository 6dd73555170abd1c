//! Small files of every format give the surfaces that they describe.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::path::Path;

use antumbra_subsurface::read::{self, ReadOptions, ZPositive};
use antumbra_subsurface::{SubsurfaceError, Surface, SurfaceKind};
use glam::{DVec3, Vec3};

#[path = "read_support/files.rs"]
mod files;
use files::{SOUTH, WEST};

fn read(name: &str, bytes: &[u8], options: &ReadOptions) -> Result<Vec<Surface>, SubsurfaceError> {
    read::surfaces_from_bytes(Path::new(name), bytes, options, &mut |_, _| ())
}

fn surfaces(name: &str, bytes: &[u8]) -> Vec<Surface> {
    read(name, bytes, &ReadOptions::default()).unwrap()
}

fn refused(name: &str, bytes: &[u8], options: &ReadOptions, word: &str) {
    let error = read(name, bytes, options).unwrap_err();
    assert!(matches!(error, SubsurfaceError::Format { .. }));
    assert!(
        error.to_string().contains(word),
        "`{error}` does not say `{word}`"
    );
    assert!(error.to_string().contains(name));
}

fn points(surface: &Surface) -> Vec<DVec3> {
    let world = |p: &[f32; 3]| surface.origin + Vec3::from(*p).as_dvec3();
    surface.geometry.positions.iter().map(world).collect()
}

fn has_point(surface: &Surface, point: DVec3) -> bool {
    points(surface).iter().any(|p| p.distance(point) < 1e-3)
}

fn normals(surface: &Surface) -> Vec<DVec3> {
    let corners = |triangle| surface.geometry.corners(triangle).unwrap();
    let faces = surface.geometry.triangles().map(corners);
    faces.map(|[a, b, c]| (b - a).cross(c - a)).collect()
}

/// The 4 x 3 nodes of the small rasters: the undefined node (1, 1), and the two cells that keep a triangle next to
/// it.
fn assert_field(surface: &Surface, step_north: f64) {
    assert_eq!(surface.kind, SurfaceKind::Horizon);
    assert_eq!(surface.geometry.positions.len(), 11);
    assert_eq!(surface.geometry.triangle_count(), 12 - 4);
    for index in (0..12).filter(|index| *index != 5) {
        let (column, row) = (f64::from(index % 4), f64::from(index / 4));
        let node = DVec3::new(
            WEST + 20.0 * column,
            -1500.0 - f64::from(index),
            -(SOUTH + step_north * row),
        );
        assert!(has_point(surface, node), "{node}");
    }
    assert!(normals(surface).iter().all(|normal| normal.y > 0.0));
    assert!(
        surface
            .geometry
            .normals
            .iter()
            .all(|normal| normal[1] > 0.5)
    );
}

#[test]
fn the_same_raster_in_every_format() {
    let irap = surfaces("top.gri", &files::irap(4, 3, &files::depths(), 0.0));
    assert_eq!((irap.len(), irap[0].name.as_str()), (1, "top"));
    assert_field(&irap[0], 25.0);
    assert_field(
        &surfaces("top.irap", files::irap_ascii().as_bytes())[0],
        25.0,
    );
    assert_field(&surfaces("top.asc", files::esri().as_bytes())[0], 20.0);
    assert_field(&surfaces("top.tif", &files::geotiff(&[]))[0], 20.0);
}

#[test]
fn a_raster_may_be_told_to_be_positive_the_other_way() {
    let options = |positive| ReadOptions {
        z_positive: Some(positive),
        ..ReadOptions::default()
    };
    let first = DVec3::new(WEST, 1500.0, -SOUTH);
    let cases = [
        (
            "a.gri",
            files::irap(4, 3, &files::depths(), 0.0),
            ZPositive::Up,
        ),
        ("a.irap", files::irap_ascii().into_bytes(), ZPositive::Up),
        ("a.asc", files::esri().into_bytes(), ZPositive::Down),
        ("a.tif", files::geotiff(&[]), ZPositive::Down),
    ];
    for (name, bytes, positive) in cases {
        let surfaces = read(name, &bytes, &options(positive)).unwrap();
        assert!(has_point(&surfaces[0], first), "{name}");
    }
}

#[test]
fn irap_surfaces_turn_around_their_first_node() {
    let surface = &surfaces("a.gri", &files::irap(4, 3, &files::depths(), 90.0))[0];
    // East becomes north, north becomes west; the file's f32 is precise to half a metre there.
    let there = |point: DVec3| points(surface).iter().any(|p| p.distance(point) < 1.0);
    assert!(there(DVec3::new(WEST, -1503.0, -(SOUTH + 60.0))));
    assert!(there(DVec3::new(WEST - 50.0, -1508.0, -SOUTH)));
    assert!(normals(surface).iter().all(|normal| normal.y > 0.0));
}

#[test]
fn esri_corners_lie_half_a_cell_from_the_nodes() {
    let text = files::esri();
    let corners = text
        .replace("xllcenter 460000", "XLLCORNER 459990")
        .replace("yllcenter 5930000", "YLLCORNER 5929990");
    assert_ne!(text, corners);
    assert_field(&surfaces("a.asc", corners.as_bytes())[0], 20.0);
}

#[test]
fn geotiff_pixels_may_be_points_and_their_places_degrees() {
    let keys = |id: u16, value: u16| [1, 1, 0, 1, id, 0, 1, value];
    let surface = &surfaces("a.tif", &files::geotiff(&keys(1025, 2)))[0];
    assert!(has_point(
        surface,
        DVec3::new(WEST - 10.0, -1500.0, -(SOUTH + 10.0))
    ));
    let options = ReadOptions::default();
    refused(
        "a.tif",
        &files::geotiff(&keys(1024, 2)),
        &options,
        "degrees",
    );
}

#[test]
fn a_file_is_told_by_what_it_holds() {
    let cases = [
        files::irap(4, 3, &files::depths(), 0.0),
        files::irap_ascii().into_bytes(),
        files::esri().into_bytes(),
        files::geotiff(&[]),
        files::gocad().into_bytes(),
        files::faultroom().into_bytes(),
    ];
    for bytes in cases {
        assert!(!surfaces("nameless", &bytes).is_empty());
    }
    refused(
        "picks",
        picks(',').as_bytes(),
        &ReadOptions::default(),
        "none of",
    );
    refused(
        "grid.gri",
        b"something else",
        &ReadOptions::default(),
        "-996",
    );
}

#[test]
fn gocad_objects_become_faults() {
    let faults = surfaces("all.ts", files::gocad().as_bytes());
    let names: Vec<_> = faults.iter().map(|fault| fault.name.as_str()).collect();
    assert_eq!(names, ["F1", "F2"]);
    assert!(
        faults
            .iter()
            .all(|fault| fault.kind == SurfaceKind::Fault && fault.plan.is_empty())
    );
    assert_eq!(faults[0].geometry.triangle_count(), 2);
    assert_eq!(faults[0].geometry.positions.len(), 4);
    assert!(has_point(
        &faults[0],
        DVec3::new(460_100.0, -1600.0, -5_930_100.0)
    ));
    assert!(
        has_point(&faults[1], DVec3::new(0.0, -20.0, -10.0)),
        "an ATOM, and z up"
    );
    let told = ReadOptions {
        z_positive: Some(ZPositive::Up),
        ..ReadOptions::default()
    };
    let faults = read("all.ts", files::gocad().as_bytes(), &told).unwrap();
    assert!(has_point(
        &faults[0],
        DVec3::new(460_100.0, 1600.0, -5_930_100.0)
    ));
}

#[test]
fn a_gocad_height_field_may_be_a_horizon_and_nothing_else_may() {
    let horizon = ReadOptions {
        kind: Some(SurfaceKind::Horizon),
        ..ReadOptions::default()
    };
    let surfaces = read("a.ts", files::gocad().as_bytes(), &horizon).unwrap();
    assert_eq!(surfaces[0].kind, SurfaceKind::Horizon);
    let mut plan = surfaces[0].plan.clone();
    plan.sort_by(|a, b| a.partial_cmp(b).unwrap());
    assert_eq!(plan, [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0]]);
    assert!(normals(&surfaces[0]).iter().all(|normal| normal.y > 0.0));
    let upright = files::gocad().replace("VRTX 7 460100 5930100", "VRTX 7 460050 5930050");
    refused("a.ts", upright.as_bytes(), &horizon, "upright");
    let folded = files::gocad().replace("VRTX 7 460100 5930100", "VRTX 7 460020 5930020");
    refused("a.ts", folded.as_bytes(), &horizon, "above each other");
}

#[test]
fn gocad_lines_that_make_no_sense_are_named() {
    let gocad = files::gocad();
    let cases = [
        (
            "VRTX 2 460100 5930000 1500",
            "VRTX 2 460100 x 1500",
            "line 8: vertex 2: y",
        ),
        (
            "VRTX 2 460100 5930000 1500",
            "VRTX 2 460100 5930000 nan",
            "vertex 2: z",
        ),
        (
            "VRTX 2 460100 5930000 1500",
            "VRTX 1 460100 5930000 1500",
            "twice",
        ),
        (
            "VRTX 2 460100 5930000 1500",
            "VRTX 2 460100 5930000 1e300",
            "no place",
        ),
        (
            "TRGL 1 2 3",
            "TRGL 1 2 99",
            "line 11: there is no vertex 99",
        ),
        ("TRGL 1 2 4", "TRGL 1 4 4", "no triangle"),
        ("ZPOSITIVE Depth", "ZPOSITIVE Sideways", "Sideways"),
        ("GOCAD TSurf 1", "GOCAD Voxet 1", "Voxet"),
    ];
    for (good, bad, word) in cases {
        let text = gocad.replacen(good, bad, 1);
        assert_ne!(text, gocad);
        refused("a.ts", text.as_bytes(), &ReadOptions::default(), word);
    }
}

#[test]
fn faultroom_triangles_are_gathered_by_fault_welded_and_wound_alike() {
    let faults = surfaces("f.json", files::faultroom().as_bytes());
    let names: Vec<_> = faults.iter().map(|fault| fault.name.as_str()).collect();
    assert_eq!(names, ["F1", "F2"]);
    assert_eq!(faults[0].geometry.positions.len(), 4);
    assert_eq!(faults[0].geometry.triangle_count(), 2);
    let normals = normals(&faults[0]);
    assert!(normals[0].dot(normals[1]) > 0.0 && normals[0].y > 0.0);
    let expected = Vec3::new(0.0, 1.0, -1.0).normalize();
    for normal in &faults[0].geometry.normals {
        assert!(Vec3::from(*normal).distance(expected) < 1e-5, "{normal:?}");
    }
    let square = files::faultroom().replace("1500.0],", "1500.0], [1.0, 2.0, 3.0],");
    refused(
        "f.json",
        square.as_bytes(),
        &ReadOptions::default(),
        "no triangle",
    );
    refused(
        "f.json",
        br#"{"features":[]}"#,
        &ReadOptions::default(),
        "no feature",
    );
}

/// A grid of picks 10 m apart for two surfaces; the first has a hole of 8 x 8 picks in its centre.
fn picks(separator: char) -> String {
    let mut text = format!("Easting{separator}NORTHING{separator}z{separator}Surface\n");
    for (name, z) in [("Top", -1500.0), ("Base", -1600.0)] {
        for (x, y) in (0..20).flat_map(|x| (0..20).map(move |y| (x, y))) {
            let in_hole = (6..14).contains(&x) && (6..14).contains(&y);
            if name == "Top" && in_hole {
                continue;
            }
            let (x, y) = (WEST + 10.0 * f64::from(x), SOUTH + 10.0 * f64::from(y));
            text += &format!("{x}{separator}{y}{separator}{z}{separator}{name}\n");
        }
    }
    text
}

/// Whether a triangle covers a place, in metres from the south-west corner.
fn covers(surface: &Surface, east: f64, north: f64) -> bool {
    let points = points(surface);
    let at = DVec3::new(WEST + east, 0.0, -(SOUTH + north));
    surface.geometry.triangles().any(|triangle| {
        let [a, b, c] = triangle.map(|index| points[index as usize]);
        let sides = [(a, b), (b, c), (c, a)];
        sides
            .iter()
            .all(|(from, to)| (to - from).cross(at - from).y >= 0.0)
    })
}

#[test]
fn picks_are_triangulated_and_their_hole_stays() {
    for separator in [',', ';', '\t'] {
        let picks = surfaces("p.csv", picks(separator).as_bytes());
        let names: Vec<_> = picks.iter().map(|surface| surface.name.as_str()).collect();
        assert_eq!(names, ["Top", "Base"]);
        assert!(!covers(&picks[0], 95.0, 95.0), "the hole is closed");
        assert!(covers(&picks[1], 95.0, 95.0));
        assert!(covers(&picks[0], 25.0, 95.0));
        assert_eq!(picks[1].geometry.triangle_count(), 19 * 19 * 2);
        assert!(
            picks
                .iter()
                .all(|s| normals(s).iter().all(|normal| normal.y > 0.0))
        );
        assert!(has_point(&picks[1], DVec3::new(WEST, -1600.0, -SOUTH)));
    }
    let options = ReadOptions {
        longest_edge: Some(200.0),
        ..ReadOptions::default()
    };
    let closed = read("p.csv", picks(',').as_bytes(), &options).unwrap();
    assert!(covers(&closed[0], 95.0, 95.0));
    for (longest, word) in [
        (5.0, "no triangle"),
        (-1.0, "positive"),
        (f64::NAN, "positive"),
    ] {
        let options = ReadOptions {
            longest_edge: Some(longest),
            ..ReadOptions::default()
        };
        refused("p.csv", picks(',').as_bytes(), &options, word);
    }
}

#[test]
fn columns_of_picks_are_found_by_their_names() {
    let three = "0,0,5\n10,0,5\n0,10,5\n";
    let first = |header: &str| {
        let text = format!("{header}\n{three}");
        surfaces("p.csv", text.as_bytes()).remove(0)
    };
    assert_eq!(first("X,Y,Z").origin.y, 5.0);
    assert_eq!(first("EAST,north,TVDSS").origin.y, -5.0);
    assert_eq!(first("X,Y,Z").name, "p");
    let options = ReadOptions::default();
    refused("p.csv", b"a,y,z\n0,0,5\n", &options, "easting");
    refused(
        "p.csv",
        b"x,y\n0,0\n",
        &options,
        "elevation or height or depth",
    );
    refused(
        "p.csv",
        b"x,y,z\n0,0,5\n1,q,5\n",
        &options,
        "line 3: y is `q`",
    );
    refused("p.csv", b"x,y,z\n0,0,inf\n", &options, "no place");
    refused("p.csv", b"x,y,z\n", &options, "no pick");
    refused(
        "p.csv",
        b"x,y,z\n0,0,1\n1,1,1\n2,2,1\n",
        &options,
        "no triangle",
    );
    let named = ReadOptions {
        surface_column: Some("zone".into()),
        ..ReadOptions::default()
    };
    let text = b"x,y,z,name,zone\n0,0,5,a,A\n10,0,5,b,A\n0,10,5,c,A\n";
    assert_eq!(read("p.csv", text, &named).unwrap()[0].name, "A");
    refused("p.csv", b"x,y,z\n0,0,5\n", &named, "zone");
}

#[test]
fn rows_that_name_no_surface_are_no_picks_and_twins_become_their_mean() {
    let text = b"x,y,z,feature_name,val\n0,0,4,s,1\n0,0,6,s,1\n10,0,5,s,1\n0,10,5,s,1\n,,,,\n3,3,99,s,\n5,5,5,s,2\n";
    let picks = surfaces("p.csv", text);
    assert_eq!(picks.len(), 1, "one point spans no triangle");
    assert_eq!(picks[0].name, "s 1");
    assert_eq!(picks[0].geometry.positions.len(), 3);
    assert!(
        points(&picks[0])
            .iter()
            .all(|point| (point.y - 5.0).abs() < 1e-6)
    );
}
