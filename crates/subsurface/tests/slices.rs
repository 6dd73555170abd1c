//! Slices: their positions, the content of their tiles, and which bricks they read.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod volume_rule;

use std::sync::Arc;

use antumbra_scene::{AlphaMode, EntityKey, Scene};
use antumbra_subsurface::{
    Axis, BrickCache, ColourMap, PagingReport, Slice, SliceOptions, SliceTile, SubsurfaceError,
};
use glam::{DAffine3, DVec3};
use volume_rule::{Rule, layout, sample_at};

const SIZE: [u32; 3] = [21, 13, 9];
const BRICK: u32 = 4;

struct Stage {
    scene: Scene,
    rule: Arc<Rule>,
    bricks: BrickCache,
}

impl Stage {
    fn new() -> Self {
        let rule = Arc::new(Rule::new(SIZE, BRICK));
        Self {
            scene: Scene::new(),
            bricks: BrickCache::new(rule.clone(), 1 << 20).unwrap(),
            rule,
        }
    }

    fn slice(&mut self, axis: Axis, index: u32) -> Slice {
        let options = SliceOptions::default();
        Slice::spawn(
            &mut self.scene,
            None,
            &self.rule.layout,
            axis,
            index,
            &options,
        )
        .unwrap()
    }

    fn page(&mut self, slice: &mut Slice, is_hidden: &dyn Fn(EntityKey) -> bool) -> PagingReport {
        (slice.page(&mut self.scene, &mut self.bricks, is_hidden)).unwrap()
    }

    /// World positions of a tile's corners, with their texture coordinates.
    fn corners(&self, tile: &SliceTile) -> Vec<(DVec3, [f32; 2])> {
        let drawable = self.scene.drawable(tile.entity()).unwrap();
        let geometry = self.scene.mesh(drawable.mesh).unwrap().full().unwrap();
        let world = self.scene.world(tile.entity()).unwrap();
        let place = |p: &[f32; 3]| world.transform_point3(DVec3::from(p.map(f64::from)));
        (geometry.positions.iter().map(place))
            .zip(geometry.uvs.iter().copied())
            .collect()
    }
}

fn seen(_: EntityKey) -> bool {
    false
}

#[test]
fn every_pixel_of_every_tile_is_its_sample() {
    for (axis, index) in [(Axis::Inline, 20), (Axis::Crossline, 5), (Axis::Time, 8)] {
        let mut stage = Stage::new();
        let mut slice = stage.slice(axis, index);
        let paged = stage.page(&mut slice, &seen);
        assert_eq!((paged.updated, paged.skipped), (slice.tiles().len(), 0));
        let colours = ColourMap::Seismic.table(&stage.rule.layout);
        let [right, down] = axis.plane().map(|along| along.of(SIZE));
        let mut shown = 0;
        for tile in slice.tiles() {
            let image = stage.scene.image(tile.image()).unwrap();
            let area = tile.area();
            assert_eq!(
                [image.width, image.height].map(|side| side as usize),
                area.each_ref().map(ExactSizeIterator::len)
            );
            let places = (area[1].clone()).flat_map(|v| area[0].clone().map(move |u| [u, v]));
            for (pixel, place) in image.rgba.as_chunks::<4>().0.iter().zip(places) {
                let [r, g, b] = colours[usize::from(sample_at(axis.place(index, place)))];
                assert_eq!(*pixel, [r, g, b, 255], "{axis} {index} at {place:?}");
                shown += 1;
            }
        }
        assert_eq!(shown, right * down);
    }
}

#[test]
fn the_tiles_cover_the_section_and_nothing_else() {
    for (axis, index) in [(Axis::Inline, 3), (Axis::Crossline, 12), (Axis::Time, 0)] {
        let mut stage = Stage::new();
        let slice = stage.slice(axis, index);
        let layout = stage.rule.layout;
        let [right, down] = axis.plane().map(|along| along.of(layout.steps));
        let [across, along] = axis.plane().map(|along| f64::from(along.of(SIZE) - 1));
        let first = layout.position(DVec3::from(axis.place(f64::from(index), [0.0; 2])));
        let mut area = 0.0;
        for tile in slice.tiles() {
            let corners = stage.corners(tile);
            for (corner, uv) in &corners {
                // The steps are perpendicular here, so that positions follow from dot products.
                let [u, v] =
                    [right, down].map(|step| (*corner - first).dot(step) / step.length_squared());
                assert!((*corner - first - right * u - down * v).length() < 1e-3);
                assert!(u > -1e-6 && u < across + 1e-6, "{u}");
                assert!(v > -1e-6 && v < along + 1e-6, "{v}");
                // Pixel centres are samples.
                for ((at, uv), range) in [u, v].into_iter().zip(*uv).zip(tile.area()) {
                    let pixel = f64::from(uv) * range.len() as f64;
                    assert!((pixel - 0.5 + f64::from(range.start) - at).abs() < 1e-4);
                }
            }
            let [a, b, d] = [0, 1, 3].map(|i| corners[i].0);
            area += (b - a).length() * (d - a).length();
        }
        // Without gaps, because tiles do not overlap: each covers the area nearest to its samples.
        let whole = right.length() * across * down.length() * along;
        assert!((area / whole - 1.0).abs() < 1e-6, "{area} {whole}");
    }
}

#[test]
fn tiles_hide_but_are_not_tested() {
    let mut stage = Stage::new();
    let slice = stage.slice(Axis::Inline, 0);
    assert_eq!(slice.tiles().len(), 2 * 2);
    assert_eq!(stage.scene.entity_name(slice.entity()), "inline slice 0");
    for tile in slice.tiles() {
        assert!(!stage.scene.is_tested(tile.entity()));
        let drawable = stage.scene.drawable(tile.entity()).unwrap();
        let material = stage.scene.material(drawable.material).unwrap();
        assert_eq!(material.alpha, AlphaMode::Opaque);
        assert!(material.unlit && material.double_sided);
        assert_eq!(material.base_colour_image, Some(tile.image()));
        assert_eq!(stage.scene.mesh(drawable.mesh).unwrap().triangle_count(), 2);
        assert_eq!(stage.scene.parent(tile.entity()), Some(slice.entity()));
    }
}

#[test]
fn the_bricks_of_hidden_tiles_are_not_read() {
    let mut stage = Stage::new();
    let mut slice = stage.slice(Axis::Time, 6);
    let hidden: Vec<_> = slice
        .tiles()
        .iter()
        .map(SliceTile::entity)
        .step_by(2)
        .collect();
    let before = stage.scene.image(slice.tiles()[0].image()).cloned();

    let paged = stage.page(&mut slice, &|entity| hidden.contains(&entity));
    assert_eq!((paged.updated, paged.skipped), (3, 3));
    let shown = slice
        .tiles()
        .iter()
        .filter(|tile| !hidden.contains(&tile.entity()));
    let mut expected: Vec<_> = shown.flat_map(|tile| slice.bricks(tile)).collect();
    expected.sort_unstable();
    assert_eq!(stage.rule.take_asked(), expected);
    assert_eq!(paged.bricks_read, expected.len() as u64);
    assert_eq!(stage.scene.image(slice.tiles()[0].image()).cloned(), before);
    assert_eq!(slice.tiles()[0].shown_section(), None);

    // Tiles are read when they become visible; nothing else is read again.
    let paged = stage.page(&mut slice, &seen);
    assert_eq!((paged.updated, paged.skipped), (3, 0));
    let mut expected: Vec<_> = (slice.tiles().iter().step_by(2))
        .flat_map(|tile| slice.bricks(tile))
        .collect();
    expected.sort_unstable();
    assert_eq!(stage.rule.take_asked(), expected);
    assert_eq!(stage.page(&mut slice, &seen), PagingReport::default());
}

#[test]
fn only_what_a_move_makes_wrong_is_read() {
    let mut stage = Stage::new();
    let mut slice = stage.slice(Axis::Crossline, 4);
    stage.page(&mut slice, &seen);
    stage.rule.take_asked();
    let tiles = slice.tiles().len();

    // To its current position: nothing is read.
    slice.move_to(&mut stage.scene, 4).unwrap();
    assert_eq!(stage.page(&mut slice, &seen), PagingReport::default());
    // Within the same bricks: pixels change, nothing is read.
    slice.move_to(&mut stage.scene, 7).unwrap();
    let paged = stage.page(&mut slice, &seen);
    assert_eq!(
        paged,
        PagingReport {
            updated: tiles,
            skipped: 0,
            bricks_read: 0
        }
    );
    assert!(stage.rule.take_asked().is_empty());
    // Away while hidden, and back: nothing is read.
    slice.move_to(&mut stage.scene, 12).unwrap();
    let paged = stage.page(&mut slice, &|_| true);
    assert_eq!(
        paged,
        PagingReport {
            updated: 0,
            skipped: tiles,
            bricks_read: 0
        }
    );
    slice.move_to(&mut stage.scene, 7).unwrap();
    assert_eq!(stage.page(&mut slice, &seen), PagingReport::default());
}

#[test]
fn a_slice_moves_as_one() {
    let mut stage = Stage::new();
    let parent = (stage
        .scene
        .spawn(None, DAffine3::from_translation(DVec3::X)))
    .unwrap();
    let options = SliceOptions::default();
    let rule = stage.rule.clone();
    let mut slice = Slice::spawn(
        &mut stage.scene,
        Some(parent),
        &rule.layout,
        Axis::Time,
        2,
        &options,
    )
    .unwrap();
    let before = stage.corners(&slice.tiles()[1]);
    stage.scene.update();
    slice.move_to(&mut stage.scene, 8).unwrap();
    let changes = stage.scene.update();
    assert_eq!(changes.moved.len(), slice.tiles().len());
    assert!(changes.added.is_empty() && changes.removed.is_empty());
    let after = stage.corners(&slice.tiles()[1]);
    for (before, after) in before.iter().zip(after) {
        let way = rule.layout.steps[2] * 6.0;
        assert!((before.0 + way - after.0).length() < 1e-6);
    }
    assert_eq!(slice.index(), 8);
    assert_eq!(stage.scene.entity_name(slice.entity()), "time slice 8");

    slice.remove(&mut stage.scene);
    assert_eq!(stage.scene.drawable_count(), 0);
}

#[test]
fn a_slice_outside_is_refused_by_axis_and_range() {
    let mut stage = Stage::new();
    let mut slice = stage.slice(Axis::Crossline, 12);
    let error = slice.move_to(&mut stage.scene, 13).unwrap_err();
    assert!(matches!(
        error,
        SubsurfaceError::Outside {
            axis: Axis::Crossline,
            asked: [13, 13],
            last: 12,
            ..
        }
    ));
    let said = error.to_string();
    assert!(
        said.contains("crossline slice 13") && said.contains("0 to 12"),
        "{said}"
    );
    assert_eq!(slice.index(), 12);
    let entities = stage.scene.roots().count();
    let rule = stage.rule.clone();
    let outside = Slice::spawn(
        &mut stage.scene,
        None,
        &rule.layout,
        Axis::Inline,
        21,
        &SliceOptions::default(),
    );
    assert!(matches!(
        outside,
        Err(SubsurfaceError::Outside {
            axis: Axis::Inline,
            ..
        })
    ));
    assert_eq!(stage.scene.roots().count(), entities);
}

#[test]
fn wrong_options_bricks_and_scenes_are_refused() {
    let mut stage = Stage::new();
    let rule = stage.rule.clone();
    for tile_bricks in [0, 1025, u32::MAX] {
        let options = SliceOptions {
            tile_bricks,
            ..SliceOptions::default()
        };
        let refused = Slice::spawn(
            &mut stage.scene,
            None,
            &rule.layout,
            Axis::Time,
            0,
            &options,
        );
        assert!(matches!(refused, Err(SubsurfaceError::Setting { .. })));
    }
    let mut slice = stage.slice(Axis::Time, 0);
    let mut other = BrickCache::new(Arc::new(Rule::new([22, 13, 9], BRICK)), 1 << 20).unwrap();
    let refused = slice.page(&mut stage.scene, &mut other, &seen);
    assert!(matches!(refused, Err(SubsurfaceError::OtherVolume { .. })));
    stage.scene.despawn(slice.entity());
    assert!(matches!(
        slice.move_to(&mut stage.scene, 1),
        Err(SubsurfaceError::Scene(_))
    ));
    assert_eq!(slice.index(), 0);
}

#[test]
fn a_volume_of_one_sheet_has_sections() {
    let rule = Arc::new(Rule {
        layout: layout([30, 1, 40], 8),
        asked: Default::default(),
    });
    let mut bricks = BrickCache::new(rule.clone(), 1 << 20).unwrap();
    let mut scene = Scene::new();
    for axis in Axis::ALL {
        let mut slice = Slice::spawn(
            &mut scene,
            None,
            &rule.layout,
            axis,
            0,
            &SliceOptions::default(),
        )
        .unwrap();
        slice.page(&mut scene, &mut bricks, &seen).unwrap();
    }
    scene.update();
    assert!(scene.bounds().unwrap().is_finite());
}
