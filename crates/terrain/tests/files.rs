//! Prepared terrains as files: what is written is read back, and damage causes an error at most.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod support;

use std::path::PathBuf;
use std::sync::LazyLock;

use antumbra_formats::{Attachment, LoadOptions, load, save_glb};
use antumbra_scene::{Drawable, Geometry, Mesh, Scene};
use antumbra_terrain::file::EXTENSION;
use antumbra_terrain::{
    AzimuthRange, Field, GroupOptions, Method, NONE, PreparedScene, Sectors, ShownTerrain, Terrain,
    TerrainError, TerrainInScene, TerrainOptions,
};
use glam::{DAffine3, DVec3};
use proptest::prelude::*;
use support::ridged;

/// A small terrain far from zero, with nested groups and ungrouped triangles.
struct Made {
    terrain: Terrain,
    scene: Scene,
    shown: ShownTerrain,
    attachment: Attachment,
}

static MADE: LazyLock<Made> = LazyLock::new(|| {
    let near = ridged(4, 10.0, 40.0, 3);
    let far = DVec3::new(460_123.0, 5_932_000.0, 12.0);
    let points = near.points().iter().map(|point| *point + far);
    let field = Field::new(points.collect(), near.triangles().to_vec()).unwrap();
    let options = TerrainOptions {
        sectors: Sectors::new(8, 4).unwrap().with_reaches(2).unwrap(),
        method: Method::Sound,
        groups: Some(GroupOptions {
            seeds: 24,
            max_groups: 48,
            min_triangles: 6,
            ..GroupOptions::for_triangles(0)
        }),
    };
    let terrain = Terrain::prepare(field, &options, &|| ()).unwrap();
    let mut scene = Scene::new();
    let shown = terrain.show_lit(&mut scene).unwrap();
    let attachment = terrain.attachment(&shown).unwrap();
    Made {
        terrain,
        scene,
        shown,
        attachment,
    }
});

/// The offset of each row of the bytes, in the order of `docs/horizons-extension.md`.
struct Rows {
    origin: usize,
    circles: usize,
    heights: usize,
    points: usize,
    regions: usize,
    triangles: usize,
    ranges: usize,
    children: usize,
    roots: usize,
    order: usize,
    ungrouped: usize,
    ends: usize,
}

fn rows() -> Rows {
    let (field, groups) = (MADE.terrain.field(), MADE.terrain.groups());
    let count = groups.groups().len();
    let mut end = 0;
    let mut next = |bytes: usize| {
        end += bytes;
        end - bytes
    };
    let rows = Rows {
        origin: next(24),
        circles: next(count * 24),
        heights: next(count * 16),
        points: next(field.points().len() * 12),
        regions: next(count * 8 * 2 * 36),
        triangles: next(field.triangles().len() * 12),
        ranges: next(count * 8),
        children: next(count * 8),
        roots: next(groups.roots().len() * 4),
        order: next(field.triangles().len() * 4),
        ungrouped: next(groups.ungrouped().len() * 4),
        ends: next(MADE.shown.ungrouped.len() * 4),
    };
    assert_eq!(end, MADE.attachment.bytes.len());
    rows
}

fn written() -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("terrain.glb");
    let Made {
        terrain,
        scene,
        shown,
        ..
    } = &*MADE;
    terrain.save(scene, shown, &file).unwrap();
    (folder, file)
}

#[test]
fn a_file_gives_back_the_terrain_and_its_verdicts() {
    let (_folder, file) = written();
    let made = &MADE.terrain;
    let groups = made.groups();
    assert!(groups.groups().iter().any(|group| !group.is_leaf()) && !groups.ungrouped().is_empty());
    let again = PreparedScene::load(&file, &LoadOptions::default()).unwrap();
    assert_eq!(again.scene.len(), MADE.scene.len());
    let terrain = &again.terrain;
    assert!(terrain.field() == made.field());
    assert_eq!(terrain.groups(), groups);
    assert_eq!(terrain.method(), Method::Sound);
    assert!(terrain.attachment(&again.shown).unwrap().bytes == MADE.attachment.bytes);
    let numbers = |shown: &ShownTerrain| {
        let groups = shown.groups.iter().map(|shown| shown.group);
        let ungrouped = shown.ungrouped.iter();
        let ungrouped = ungrouped.map(|shown| shown.triangles.clone());
        (groups.collect::<Vec<_>>(), ungrouped.collect::<Vec<_>>())
    };
    assert_eq!(numbers(&again.shown), numbers(&MADE.shown));
    // The same groups are visible from everywhere.
    let [low, high] = made.field().plan_bounds();
    let mut hidden = 0;
    for step in 0..60 {
        let share = (f64::from(step) * 0.618).fract();
        let plan = low + (high - low) * glam::DVec2::new(share, f64::from(step) / 60.0);
        let Some(top) = made.highest_near(plan, 1.0) else {
            continue;
        };
        let at = plan.extend(top + 2.0);
        let visible = |terrain: &Terrain| {
            let mut visible = Vec::new();
            let observer = terrain.observer(at, AzimuthRange::ALL, 0.1).unwrap();
            observer.each_visible(|group| visible.push(group));
            visible
        };
        assert_eq!(visible(terrain), visible(made));
        hidden += usize::from(visible(made).len() < MADE.shown.groups.len());
    }
    assert!(
        hidden > 10,
        "some group is hidden from {hidden} positions of 60"
    );
}

#[test]
fn any_reader_shows_the_mesh_and_requires_nothing() {
    let (_folder, file) = written();
    let scene = load(&file, &LoadOptions::default()).unwrap();
    assert_eq!(scene.triangle_count(), MADE.scene.triangle_count());
    let bytes = std::fs::read(&file).unwrap();
    let text = String::from_utf8_lossy(&bytes);
    assert!(text.contains(r#""extensionsUsed":["KHR_lights_punctual","ANTUMBRA_horizons"]"#));
    assert!(!text.contains("extensionsRequired"));
}

#[test]
fn a_file_of_the_first_version_has_one_reach() {
    let options = TerrainOptions {
        sectors: Sectors::default().with_reaches(1).unwrap(),
        ..TerrainOptions::default()
    };
    let field = ridged(4, 10.0, 40.0, 3);
    let terrain = Terrain::prepare(field, &options, &|| ()).unwrap();
    let mut scene = Scene::new();
    let shown = terrain.show_lit(&mut scene).unwrap();
    let mut attachment = terrain.attachment(&shown).unwrap();
    let properties = &mut attachment.properties;
    properties.insert("version".to_owned(), 1.into());
    properties.remove("reaches");
    let read = Terrain::read(&scene, &attachment).unwrap();
    assert!(read.terrain.groups() == terrain.groups());
}

/// The error of reading a changed scene and attachment.
fn refused(change: impl FnOnce(&mut Scene, &mut Attachment)) -> String {
    let (mut scene, mut attachment) = (MADE.scene.clone(), MADE.attachment.clone());
    change(&mut scene, &mut attachment);
    let error = Terrain::read(&scene, &attachment).unwrap_err();
    error.to_string()
}

#[track_caller]
fn refuses(words: &str, change: impl FnOnce(&mut Scene, &mut Attachment)) {
    let error = refused(change);
    assert!(error.contains(words), "'{words}' is not in: {error}");
}

#[test]
fn facts_that_cannot_be_are_refused() {
    assert!(Terrain::read(&MADE.scene, &MADE.attachment).is_ok());
    let set = |name: &'static str, value: serde_json::Value| {
        move |_: &mut Scene, attachment: &mut Attachment| {
            attachment.properties.insert(name.to_owned(), value);
        }
    };
    refuses("version 3", set("version", 3.into()));
    refuses("version 0", set("version", 0.into()));
    refuses("no number \"version\"", set("version", "1".into()));
    refuses("\"method\"", set("method", "magic".into()));
    refuses("4 to 1024", set("sectors", 3.into()));
    refuses("4 to 1024", set("sectors", u32::MAX.wrapping_sub(1).into()));
    refuses("1 to 1024", set("parts", 0.into()));
    refuses("1 to 8", set("reaches", 0.into()));
    refuses("1 to 8", set("reaches", 9.into()));
    refuses("4294967294", set("reaches", u64::MAX.into()));
    refuses("its counts need", set("reaches", 3.into()));
    refuses("its counts need", set("version", 1.into()));
    refuses("no number \"reaches\"", |_, attachment| {
        attachment.properties.remove("reaches");
    });
    for name in [
        "vertices",
        "triangles",
        "groups",
        "tops",
        "always",
        "alwaysNodes",
    ] {
        refuses("4294967294", set(name, u64::MAX.into()));
        refuses("4294967294", set(name, u32::MAX.into()));
        // More memory than any machine has, if it were allocated.
        refuses("its counts need", set(name, (u32::MAX - 1).into()));
        refuses("its counts need", set(name, 0.into()));
        refuses("no number", set(name, (-1).into()));
        refuses("no number", set(name, 1.5.into()));
        refuses("no number", |_, attachment| {
            attachment.properties.remove(name);
        });
    }
    refuses("its counts need", |_, attachment| {
        attachment.bytes.truncate(100)
    });
    refuses("its counts need", |_, attachment| attachment.bytes.clear());
    refuses("its counts need", |_, attachment| attachment.bytes.push(0));
    refuses("nodes", |_, attachment| attachment.entities.truncate(3));
    refuses("nodes", |_, attachment| attachment.entities.clear());
}

fn put<const N: usize>(at: usize, number: [u8; N]) -> impl FnOnce(&mut Scene, &mut Attachment) {
    move |_, attachment| attachment.bytes[at..at + N].copy_from_slice(&number)
}

fn number(at: usize) -> u32 {
    u32::from_le_bytes(MADE.attachment.bytes[at..at + 4].try_into().unwrap())
}

#[test]
fn rows_that_cannot_be_are_refused() {
    let rows = rows();
    let groups = MADE.terrain.groups().groups();
    let inner = groups.iter().position(|group| !group.is_leaf()).unwrap();
    let leaf = groups.iter().position(|group| group.is_leaf()).unwrap();
    let (nan, far) = (f32::NAN.to_le_bytes(), 1e10_f64.to_le_bytes());
    refuses("origin", put(rows.origin, f64::NAN.to_le_bytes()));
    refuses("origin", put(rows.origin + 16, far));
    refuses(
        "does not stand where",
        put(rows.origin, 7.0_f64.to_le_bytes()),
    );
    refuses("circle", put(rows.circles + leaf * 24, far));
    refuses("circle", put(rows.circles + 16, f64::NAN.to_le_bytes()));
    refuses("circle", put(rows.circles + 16, 0.0_f64.to_le_bytes()));
    refuses(
        "circle",
        put(rows.circles + 16, f64::INFINITY.to_le_bytes()),
    );
    refuses(
        "heights",
        put(rows.heights + 16 * leaf, f64::MIN.to_le_bytes()),
    );
    refuses("heights", put(rows.heights + 16 * inner + 8, far));
    refuses("no height field", put(rows.points + 12, nan));
    refuses("no height field", put(rows.points, 1e7_f32.to_le_bytes()));
    // The heights of the file's groups reveal it. If those were changed too, the meshes would.
    refuses("heights", put(rows.points + 8, 1e4_f32.to_le_bytes()));
    refuses("region", put(rows.regions, nan));
    refuses(
        "region",
        put(rows.regions + 32, f32::INFINITY.to_le_bytes()),
    );
    refuses(
        "no height field",
        put(rows.triangles, u32::MAX.to_le_bytes()),
    );
    refuses(
        "no height field",
        put(rows.triangles, number(rows.triangles + 4).to_le_bytes()),
    );
    refuses(
        "has the triangles",
        put(rows.ranges + 8 * leaf, 1_u32.to_le_bytes()),
    );
    refuses(
        "has the triangles",
        put(rows.ranges + 8 * leaf + 4, u32::MAX.to_le_bytes()),
    );
    refuses(
        "has the triangles",
        put(rows.ranges + 8 * inner, 1_u32.to_le_bytes()),
    );
    let own = inner as u32;
    refuses(
        "after its parent",
        put(rows.children + 8 * inner, own.to_le_bytes()),
    );
    refuses(
        "after its parent",
        put(rows.children + 8 * inner, 0_u32.to_le_bytes()),
    );
    refuses(
        "after its parent",
        put(rows.children + 8 * inner, NONE.to_le_bytes()),
    );
    let count = groups.len() as u32;
    refuses(
        "after its parent",
        put(rows.children + 8 * inner, count.to_le_bytes()),
    );
    let other = number(rows.children + 8 * inner + 4);
    refuses(
        "has one parent",
        put(rows.children + 8 * inner, other.to_le_bytes()),
    );
    refuses("tops", put(rows.roots, 1_u32.to_le_bytes()));
    refuses(
        "order",
        put(rows.order, number(rows.order + 4).to_le_bytes()),
    );
    refuses("order", put(rows.order, u32::MAX.to_le_bytes()));
    refuses(
        "always drawn",
        put(rows.ungrouped, number(rows.order).to_le_bytes()),
    );
    refuses("always drawn", put(rows.ends, 0_u32.to_le_bytes()));
    refuses("always drawn", put(rows.ends, u32::MAX.to_le_bytes()));
    refuses("not in the order", |_, attachment| {
        attachment.bytes[rows.triangles..rows.triangles + 12].rotate_left(4);
    });
}

#[test]
fn a_cycle_of_groups_is_refused() {
    let rows = rows();
    let groups = MADE.terrain.groups().groups();
    let inner = |group: u32| !groups[group as usize].is_leaf();
    let (parent, child) = (0..groups.len() as u32)
        .filter(|&group| inner(group))
        .find_map(|group| {
            let child = groups[group as usize]
                .children
                .into_iter()
                .find(|&c| inner(c));
            child.map(|child| (group, child))
        })
        .unwrap();
    let at = rows.children + 8 * child as usize;
    refuses("after its parent", put(at, parent.to_le_bytes()));
}

#[test]
fn a_scene_that_shows_something_else_is_refused() {
    let [first, second] = [0, 1].map(|at| MADE.shown.groups[at].entity);
    let ungrouped = MADE.shown.ungrouped[0].entity;
    refuses("two parts", |_, attachment| {
        attachment.entities[2] = attachment.entities[1]
    });
    refuses("other triangles", |_, attachment| {
        attachment.entities.swap(1, 2)
    });
    refuses("moved", |scene, _| {
        let up = DAffine3::from_translation(DVec3::Y * 1e-9);
        scene.set_local(ungrouped, up).unwrap();
    });
    refuses("does not stand where", |scene, _| {
        let up = DAffine3::from_translation(DVec3::Y);
        scene.set_local(MADE.shown.root, up).unwrap();
    });
    refuses("another parent", |scene, _| {
        scene.set_parent(first, Some(second)).unwrap();
    });
    refuses("no mesh", |scene, _| {
        scene.clear_drawable(first).unwrap();
    });
    refuses("does not stand where", |scene, _| {
        assert!(scene.despawn(MADE.shown.root) > 1);
    });
    let change = |change: fn(&mut Mesh)| {
        move |scene: &mut Scene, _: &mut Attachment| {
            let Drawable { mesh, material } = scene.drawable(first).unwrap();
            let mut mesh = scene.mesh(mesh).unwrap().clone();
            change(&mut mesh);
            let mesh = scene.add_mesh(mesh).unwrap();
            scene
                .set_drawable(first, Drawable { mesh, material })
                .unwrap();
        }
    };
    refuses(
        "other triangles",
        change(|mesh| mesh.levels[0].positions[0][1] += 0.001),
    );
    refuses(
        "other triangles",
        change(|mesh| mesh.levels[0].indices.truncate(3)),
    );
    refuses(
        "other triangles",
        change(|mesh| mesh.levels[0].indices.swap(0, 1)),
    );
    refuses(
        "coarser",
        change(|mesh| mesh.levels.push(mesh.levels[0].clone())),
    );
    // Such a scene is not written either.
    let mut scene = MADE.scene.clone();
    scene
        .set_local(first, DAffine3::from_scale(DVec3::splat(2.0)))
        .unwrap();
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("no.glb");
    let error = MADE.terrain.save(&scene, &MADE.shown, &file).unwrap_err();
    assert!(error.to_string().contains("moved"), "{error}");
    assert!(!file.exists());
}

#[test]
fn a_scene_without_horizons_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("plain.glb");
    save_glb(&MADE.scene, &file).unwrap();
    let error = PreparedScene::load(&file, &LoadOptions::default()).unwrap_err();
    assert!(error.to_string().contains("antumbra prepare"), "{error}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// Changed bytes cause an error, or give the same surface with other regions: only regions are not checked.
    #[test]
    fn changed_bytes_are_an_error_or_regions(
        flips in prop::collection::vec((any::<prop::sample::Index>(), 1_u8..), 1..4),
    ) {
        let mut attachment = MADE.attachment.clone();
        for (at, flip) in flips {
            let at = at.index(attachment.bytes.len());
            attachment.bytes[at] ^= flip;
        }
        match Terrain::read(&MADE.scene, &attachment) {
            Err(error) => prop_assert!(error.to_string().len() > 20),
            Ok(TerrainInScene { terrain, shown }) => {
                prop_assert!(terrain.field() == MADE.terrain.field());
                prop_assert_eq!(terrain.groups().order(), MADE.terrain.groups().order());
                prop_assert_eq!(shown, MADE.shown.clone());
                let observer = terrain.observer(DVec3::new(1.0, 2.0, 200.0), AzimuthRange::ALL, 0.1);
                observer.unwrap().each_visible(|group| assert!(terrain.groups().groups()[group as usize].is_leaf()));
            }
        }
    }

    /// A file that is cut or changed anywhere gives an error, or a scene with a terrain or with an error about its terrain.
    #[test]
    fn a_damaged_file_is_an_error_or_a_scene(
        at in any::<prop::sample::Index>(), flip in 1_u8.., cut in any::<bool>(),
    ) {
        static FILE: LazyLock<Vec<u8>> = LazyLock::new(|| std::fs::read(written().1).unwrap());
        let mut bytes = FILE.clone();
        let at = at.index(bytes.len());
        if cut {
            bytes.truncate(at);
        } else {
            bytes[at] ^= flip;
        }
        let format = antumbra_formats::SceneFormat::Gltf;
        let options = LoadOptions::default();
        let loaded = antumbra_formats::load_slice_with_attachments(format, &bytes, None, &options, &[EXTENSION]);
        prop_assert!(!(cut && loaded.is_ok()));
        for found in loaded.map(|loaded| (loaded.scene, loaded.attachments)).into_iter() {
            let (scene, attachments) = found;
            for attachment in attachments.into_iter().flatten() {
                if let Ok(read) = Terrain::read(&scene, &attachment) {
                    prop_assert!(read.terrain.field() == MADE.terrain.field());
                }
            }
        }
    }
}

/// A scene of one mesh of a field, Y up, as another program would write it.
fn mesh_of(field: &Field, transform: DAffine3) -> Scene {
    let position = |point: &DVec3| DVec3::new(point.x, point.z, -point.y).as_vec3().to_array();
    let geometry = Geometry {
        positions: field.points().iter().map(position).collect(),
        indices: field.triangles().as_flattened().to_vec(),
        ..Geometry::default()
    };
    let mut scene = Scene::new();
    let mesh = scene.add_mesh(Mesh::new("field", geometry)).unwrap();
    let material = scene.add_material(Default::default());
    let entity = scene.spawn(None, transform).unwrap();
    scene
        .set_drawable(entity, Drawable { mesh, material })
        .unwrap();
    scene
}

fn rounded() -> Field {
    let field = ridged(3, 8.0, 20.0, 5);
    let points = field
        .points()
        .iter()
        .map(|point| (*point * 64.0).round() / 64.0);
    Field::new(points.collect(), field.triangles().to_vec()).unwrap()
}

#[test]
fn fields_out_of_files_equal_those_they_were_written_from() {
    let field = rounded();
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    save_glb(&mesh_of(&field, DAffine3::IDENTITY), &at("field.glb")).unwrap();
    let positions = || {
        field
            .points()
            .iter()
            .map(|point| [point.x, point.z, -point.y])
    };
    let mut obj = String::new();
    positions().for_each(|[x, y, z]| obj += &format!("v {x} {y} {z}\n"));
    for corners in field.triangles() {
        let [a, b, c] = corners.map(|corner| corner + 1);
        obj += &format!("f {a} {b} {c}\n");
    }
    std::fs::write(at("field.obj"), obj).unwrap();
    let mut ply = format!(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
        field.points().len(),
        field.triangles().len()
    );
    positions().for_each(|[x, y, z]| ply += &format!("{x} {y} {z}\n"));
    for [a, b, c] in field.triangles() {
        ply += &format!("3 {a} {b} {c}\n");
    }
    std::fs::write(at("field.ply"), ply).unwrap();
    for name in ["field.glb", "field.obj", "field.ply"] {
        let scene = load(&at(name), &LoadOptions::default()).unwrap();
        let read = Field::from_scene(&scene).unwrap();
        assert!(read == field, "{name}");
    }
}

#[test]
fn a_prepared_terrain_is_a_mesh_like_any_other() {
    let triangles = |field: &Field| {
        let corners = |triangle: u32| {
            let mut corners = field
                .corners(triangle)
                .map(|at| (at + field.origin()).to_array());
            corners.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
            corners.map(|corner| corner.map(f64::to_bits))
        };
        let mut all: Vec<_> = (0..field.triangles().len() as u32).map(corners).collect();
        all.sort_unstable();
        all
    };
    let field = Field::from_scene(&MADE.scene).unwrap();
    assert_eq!(field.points().len(), MADE.terrain.field().points().len());
    assert_eq!(triangles(&field), triangles(MADE.terrain.field()));
    assert!(field.boundary().convex);
}

#[test]
fn entities_stand_where_their_transforms_put_them_mirrored_or_not() {
    let field = rounded();
    let translation = DAffine3::from_translation(DVec3::new(1024.0, 16.0, -512.0));
    let moved = Field::from_scene(&mesh_of(&field, translation)).unwrap();
    assert_eq!(
        moved.origin() - field.origin(),
        DVec3::new(1024.0, 512.0, 16.0)
    );
    assert!(moved.points() == field.points());
    // A field and its mirror image: if its triangles were not reversed they would lie upside down.
    let mut scene = mesh_of(&field, DAffine3::IDENTITY);
    let (_, drawable) = scene.drawables().next().unwrap();
    let [low, high] = field.plan_bounds();
    let mirror = DAffine3::from_scale_rotation_translation(
        DVec3::new(-1.0, 1.0, 1.0),
        glam::DQuat::IDENTITY,
        DVec3::X * (2.0 * high.x),
    );
    let parent = scene.spawn(None, mirror).unwrap();
    let entity = scene.spawn(Some(parent), DAffine3::IDENTITY).unwrap();
    scene.set_drawable(entity, drawable).unwrap();
    let both = Field::from_scene(&scene).unwrap();
    assert_eq!(both.triangles().len(), 2 * field.triangles().len());
    let [west, east] = both.plan_bounds();
    assert_eq!(east.x - west.x, 2.0 * (high.x - low.x));
    assert_eq!(both.boundary().rings.len(), 1);
}

#[test]
fn a_heap_of_triangles_takes_no_more_memory_than_triangles_do() {
    let sheets = 3000;
    let corners = [DVec3::ZERO, DVec3::X, DVec3::Y].map(|corner| corner * 100.0);
    let points = (0..sheets).flat_map(|sheet| {
        let shift = DVec3::new(0.01, 0.005, 1.0) * f64::from(sheet);
        corners.map(|corner| corner + shift)
    });
    let triangles = (0..sheets as u32).map(|sheet| [3 * sheet, 3 * sheet + 1, 3 * sheet + 2]);
    let error = Field::new(points.collect(), triangles.collect()).unwrap_err();
    let TerrainError::NotAHeightField { faults, total } = error else {
        panic!("{error}");
    };
    assert_eq!(faults.len(), 10);
    assert!((3000..=30_000).contains(&total), "{total}");
}

#[test]
fn what_overhangs_is_refused_with_its_place() {
    let field = rounded();
    let mut scene = mesh_of(&field, DAffine3::IDENTITY);
    let (_, drawable) = scene.drawables().next().unwrap();
    let above = DAffine3::from_translation(DVec3::new(0.5, 100.0, 0.25));
    let entity = scene.spawn(None, above).unwrap();
    scene.set_drawable(entity, drawable).unwrap();
    let error = Field::from_scene(&scene).unwrap_err().to_string();
    assert!(error.contains("lie one above the other at ("), "{error}");
    let nothing = Field::from_scene(&Scene::new()).unwrap_err().to_string();
    assert!(nothing.contains("at least one"), "{nothing}");
}
