//! Lenses: their content, their draw order, and which bricks they read.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod volume_rule;

use std::sync::Arc;

use antumbra_scene::{AlphaMode, Geometry, Scene};
use antumbra_subsurface::{
    Axis, AxisEnd, BrickCache, ColourMap, Lens, LensOptions, PagingReport, SampleBox,
    StackOrientation, SubsurfaceError, VolumeLayout,
};
use glam::{DAffine3, DVec3};
use proptest::prelude::*;
use volume_rule::{Rule, layout, sample_at};

const AREA: SampleBox = SampleBox {
    min: [3, 2, 5],
    max: [14, 9, 20],
};

struct Stage {
    scene: Scene,
    rule: Arc<Rule>,
    bricks: BrickCache,
    lens: Lens,
}

fn stage(options: &LensOptions) -> Stage {
    stage_of(Rule::new([20, 15, 25], 4), AREA, 64 * 4, options)
}

fn stage_of(rule: Rule, area: SampleBox, budget: usize, options: &LensOptions) -> Stage {
    let rule = Arc::new(rule);
    let mut scene = Scene::new();
    let lens = Lens::spawn(&mut scene, None, &rule.layout, area, options).unwrap();
    Stage {
        scene,
        bricks: BrickCache::new(rule.clone(), budget).unwrap(),
        rule,
        lens,
    }
}

impl Stage {
    fn geometry(&self) -> &Geometry {
        let drawable = self.scene.drawable(self.lens.entity()).unwrap();
        self.scene.mesh(drawable.mesh).unwrap().full().unwrap()
    }

    /// The corners of the triangles in draw order, in the world and in the image.
    fn drawn(&self) -> Vec<(DVec3, [f32; 2])> {
        let world = self.scene.world(self.lens.entity()).unwrap();
        let geometry = self.geometry();
        let corner = |i: &u32| {
            let place = geometry.positions[*i as usize].map(f64::from);
            let uv = geometry.uvs[*i as usize];
            (world.transform_point3(DVec3::from(place)), uv)
        };
        geometry.indices.iter().map(corner).collect()
    }

    fn middle(&self) -> DVec3 {
        let area = self.lens.area();
        let [min, max] = [area.min, area.max].map(|end| DVec3::from(end.map(f64::from)));
        self.rule.layout.position(min.midpoint(max))
    }
}

/// Steps that are neither perpendicular nor equally long, of either handedness.
fn skewed(mirrored: bool) -> VolumeLayout {
    let time = DVec3::new(0.5, -4.0, 0.25) * if mirrored { -1.0 } else { 1.0 };
    VolumeLayout {
        steps: [
            DVec3::new(20.0, 0.0, -15.0),
            DVec3::new(9.0, 1.0, 10.0),
            time,
        ],
        ..layout([20, 15, 25], 4)
    }
}

#[test]
fn from_each_of_six_sides_the_farthest_is_drawn_first() {
    for mirrored in [false, true] {
        let rule = Rule {
            layout: skewed(mirrored),
            asked: Default::default(),
        };
        let mut stage = stage_of(rule, AREA, 256, &LensOptions::default());
        let steps = stage.rule.layout.steps;
        for (axis, side) in Axis::ALL
            .into_iter()
            .flat_map(|axis| [(axis, -1.0), (axis, 1.0)])
        {
            let [right, down] = axis.plane().map(|along| along.of(steps));
            let normal = right.cross(down).normalize();
            let normal = normal * normal.dot(axis.of(steps)).signum();
            let eye = stage.middle() + normal * side * 2000.0;
            stage.lens.orient_to(&mut stage.scene, eye).unwrap();
            assert_eq!(
                stage.lens.orientation(),
                StackOrientation {
                    axis,
                    eye_side: if side < 0.0 {
                        AxisEnd::First
                    } else {
                        AxisEnd::Last
                    }
                }
            );

            let drawn = stage.drawn();
            let depths: Vec<f64> = (drawn.chunks(6))
                .map(|quad| (quad[0].0 - eye).dot(-normal * side))
                .collect();
            assert_eq!(depths.len(), axis.of(AREA.samples()) as usize);
            assert!(
                depths.is_sorted_by(|a, b| a > b),
                "{axis} {side}: {depths:?}"
            );
            // A quad is one section.
            for (quad, depth) in drawn.chunks(6).zip(depths) {
                let far = |corner: &(DVec3, [f32; 2])| (corner.0 - eye).dot(-normal * side);
                assert!(quad.iter().all(|corner| (far(corner) - depth).abs() < 1e-2));
            }
        }
    }
}

#[test]
fn only_a_change_of_side_is_a_change() {
    let mut stage = stage(&LensOptions::default());
    let above = stage.middle() + DVec3::new(10.0, 3000.0, -20.0);
    // It is made for a view from above.
    assert!(!stage.lens.orient_to(&mut stage.scene, above).unwrap());
    stage.scene.update();
    assert!(
        !stage
            .lens
            .orient_to(&mut stage.scene, above + DVec3::X)
            .unwrap()
    );
    assert!(stage.scene.update().is_empty());
    let below = stage.middle() - DVec3::new(10.0, 3000.0, -20.0);
    assert!(stage.lens.orient_to(&mut stage.scene, below).unwrap());
    assert_eq!(stage.scene.update().added, [stage.lens.entity()]);
    // From its centre, or from an undefined position, the current side stays.
    let middle = stage.middle();
    for eye in [middle, DVec3::NAN, DVec3::INFINITY] {
        assert!(!stage.lens.orient_to(&mut stage.scene, eye).unwrap());
    }
}

#[test]
fn an_axis_that_is_as_near_changes_nothing() {
    let mut stage = stage(&LensOptions::default());
    let steps = stage.rule.layout.steps.map(DVec3::normalize);
    let middle = stage.middle();
    stage
        .lens
        .orient_to(&mut stage.scene, middle - steps[0] * 900.0)
        .unwrap();
    assert_eq!(stage.lens.orientation().axis, Axis::Inline);
    let between = middle - (steps[0] + steps[1] * 1.000_001) * 900.0;
    assert!(!stage.lens.orient_to(&mut stage.scene, between).unwrap());
    let beyond = middle - (steps[0] + steps[1] * 1.1) * 900.0;
    assert!(stage.lens.orient_to(&mut stage.scene, beyond).unwrap());
    assert_eq!(stage.lens.orientation().axis, Axis::Crossline);
    assert!(!stage.lens.orient_to(&mut stage.scene, between).unwrap());
}

#[test]
fn a_lens_blends_and_is_tested_by_its_box() {
    let rule = Rule {
        layout: skewed(true),
        asked: Default::default(),
    };
    let mut stage = stage_of(rule, AREA, 256, &LensOptions::default());
    let drawable = stage.scene.drawable(stage.lens.entity()).unwrap();
    assert!(stage.scene.is_tested(stage.lens.entity()));
    let material = stage.scene.material(drawable.material).unwrap();
    assert_eq!(material.alpha, AlphaMode::Blend);
    let proxy = stage
        .scene
        .mesh(drawable.mesh)
        .unwrap()
        .proxy
        .clone()
        .unwrap();
    assert_eq!(proxy.triangle_count(), 12);
    // The box is closed and faces outwards: its volume is positive.
    let volume: f64 = (proxy.triangles())
        .map(|triangle| {
            let [a, b, c] = proxy.corners(triangle).unwrap();
            a.cross(b).dot(c) / 6.0
        })
        .sum();
    let [x, y, z] = stage.rule.layout.steps;
    let expected = x.cross(y).dot(z).abs() * 11.0 * 7.0 * 15.0;
    assert!(
        (volume / expected - 1.0).abs() < 1e-4,
        "{volume} {expected}"
    );
    assert_eq!(stage.geometry().bounds(), proxy.bounds());
    let eye = stage.middle() - x * 100.0;
    stage.lens.orient_to(&mut stage.scene, eye).unwrap();
    assert_eq!(stage.geometry().bounds(), proxy.bounds());
}

/// Position of a corner of the lens's geometry, in samples.
fn sample_of(layout: &VolumeLayout, place: DVec3) -> DVec3 {
    let [x, y, z] = layout.steps;
    glam::DMat3::from_cols(x, y, z).inverse() * (place - layout.origin)
}

/// Opacity of the drawable's image at a position.
fn alpha_at(stage: &Stage, uv: [f64; 2]) -> u8 {
    let drawable = stage.scene.drawable(stage.lens.entity()).unwrap();
    let material = stage.scene.material(drawable.material).unwrap();
    let image = stage
        .scene
        .image(material.base_colour_image.unwrap())
        .unwrap();
    let [x, y] = [
        uv[0] * f64::from(image.width),
        uv[1] * f64::from(image.height),
    ];
    // The centre of a pixel, not its border.
    assert!((x.fract() - 0.5).abs() < 0.01 && (y.fract() - 0.5).abs() < 0.01);
    image.rgba[(y as usize * image.width as usize + x as usize) * 4 + 3]
}

/// Checks that the corners of every section lie at samples and that their pixels show these samples; returns the
/// number of sections along each axis.
fn check_corners(stage: &mut Stage) -> [usize; 3] {
    let paged = (stage
        .lens
        .page(&mut stage.scene, &mut stage.bricks, &|_| false))
    .unwrap();
    assert_eq!((paged.updated, paged.skipped), (3, 0));
    let layout = stage.rule.layout;
    let (mut seen, mut unseen) = (0, 0);
    let sections = Axis::ALL.map(|axis| {
        let eye = stage.middle() - axis.of(layout.steps) * 1000.0;
        stage.lens.orient_to(&mut stage.scene, eye).unwrap();
        let drawn = stage.drawn();
        for (place, uv) in &drawn {
            let place = sample_of(&layout, *place);
            assert!((place - place.round()).length() < 1e-3, "{place}");
            let sample = sample_at(place.round().as_uvec3().to_array());
            let expected = shown(&layout, sample);
            let alpha = alpha_at(stage, uv.map(f64::from));
            assert_eq!(alpha > 0, expected, "{axis} at {place}");
            *(if expected { &mut seen } else { &mut unseen }) += 1;
        }
        drawn.len() / 6
    });
    assert!(seen > 10 && unseen > 10, "{seen} {unseen}");
    sections
}

/// Whether a sample is visible at a threshold of one half.
fn shown(layout: &VolumeLayout, sample: u8) -> bool {
    (layout.value(sample)).is_some_and(|value| value.abs() > 0.5 * 2.0)
}

const STARK: LensOptions = LensOptions {
    colours: ColourMap::Grey,
    opacity: 1.0,
    threshold: 0.5,
    atlas_side: 256,
};

#[test]
fn strong_samples_are_seen_where_they_are_and_weak_ones_are_not() {
    let sections = check_corners(&mut stage(&STARK));
    assert_eq!(sections, AREA.samples().map(|count| count as usize));
}

#[test]
fn a_box_that_does_not_fit_its_images_is_thinned_and_stays_where_it_is() {
    let area = SampleBox {
        min: [1; 3],
        max: [199, 99, 149],
    };
    let rule = Rule::new([200, 100, 150], 16);
    // A budget of one brick is enough.
    let mut stage = stage_of(rule, area, 4096, &STARK);
    let sections = check_corners(&mut stage);
    for (sections, samples) in sections.into_iter().zip(area.samples()) {
        assert!((8..samples as usize).contains(&sections), "{sections}");
    }
    for (_, image) in stage.scene.images() {
        assert!((128..=256).contains(&image.width) && (128..=256).contains(&image.height));
    }
    let stats = stage.bricks.stats();
    assert_eq!((stats.read, stats.peak_bytes), (13 * 7 * 10, 4096));
    for axis in Axis::ALL {
        let eye = stage.middle() - axis.of(stage.rule.layout.steps) * 1000.0;
        stage.lens.orient_to(&mut stage.scene, eye).unwrap();
        let drawable = stage.scene.drawable(stage.lens.entity()).unwrap();
        let mesh = stage.scene.mesh(drawable.mesh).unwrap();
        let proxy = mesh.proxy.as_ref().unwrap();
        assert_eq!(stage.geometry().bounds(), proxy.bounds());
    }
}

#[test]
fn the_bricks_of_a_hidden_lens_are_not_read_and_of_a_shown_one_once() {
    let mut stage = stage(&LensOptions::default());
    let hidden = stage
        .lens
        .page(&mut stage.scene, &mut stage.bricks, &|_| true)
        .unwrap();
    assert_eq!(
        hidden,
        PagingReport {
            updated: 0,
            skipped: 3,
            bricks_read: 0
        }
    );
    assert!(stage.rule.take_asked().is_empty());
    assert!(stage.scene.images().all(|(_, image)| image.rgba == [0; 4]));

    let shown = stage
        .lens
        .page(&mut stage.scene, &mut stage.bricks, &|_| false)
        .unwrap();
    let mut expected: Vec<_> = stage.lens.bricks().collect();
    expected.sort_unstable();
    assert_eq!(stage.rule.take_asked(), expected);
    assert_eq!(
        shown,
        PagingReport {
            updated: 3,
            skipped: 0,
            bricks_read: 4 * 3 * 5
        }
    );
    assert!(stage.bricks.stats().peak_bytes <= 64 * 4);

    let again = stage
        .lens
        .page(&mut stage.scene, &mut stage.bricks, &|_| false)
        .unwrap();
    assert_eq!(again, PagingReport::default());
}

#[test]
fn a_moved_lens_shows_what_is_there() {
    let mut stage = stage(&LensOptions::default());
    stage
        .lens
        .page(&mut stage.scene, &mut stage.bricks, &|_| false)
        .unwrap();
    stage.lens.move_to(&mut stage.scene, AREA.min).unwrap();
    assert_eq!(
        stage
            .lens
            .page(&mut stage.scene, &mut stage.bricks, &|_| false)
            .unwrap(),
        PagingReport::default()
    );

    let pixels = |scene: &Scene| {
        scene
            .images()
            .map(|(_, image)| image.clone())
            .collect::<Vec<_>>()
    };
    stage.lens.move_to(&mut stage.scene, [8, 7, 0]).unwrap();
    let paged = stage
        .lens
        .page(&mut stage.scene, &mut stage.bricks, &|_| false)
        .unwrap();
    assert_eq!(paged.updated, 3);
    // The same as a lens created there.
    let mut scene = Scene::new();
    let mut other = Lens::spawn(
        &mut scene,
        None,
        &stage.rule.layout,
        stage.lens.area(),
        &LensOptions::default(),
    )
    .unwrap();
    other
        .page(&mut scene, &mut stage.bricks, &|_| false)
        .unwrap();
    assert_eq!(pixels(&scene), pixels(&stage.scene));
    assert_eq!(
        scene.world(other.entity()),
        stage.scene.world(stage.lens.entity())
    );

    let entity = stage.lens.entity();
    stage.lens.remove(&mut stage.scene);
    assert!(!stage.scene.contains(entity));
}

#[test]
fn sections_farther_apart_cover_more() {
    // Samples are 4 m apart in depth and 25 m along the inline axis.
    let layout = layout([20, 15, 25], 4);
    let rule = Rule {
        layout,
        asked: Default::default(),
    };
    let mut stage = stage_of(
        rule,
        AREA,
        256,
        &LensOptions {
            opacity: 0.5,
            threshold: 0.0,
            ..LensOptions::default()
        },
    );
    stage
        .lens
        .page(&mut stage.scene, &mut stage.bricks, &|_| false)
        .unwrap();
    let mut strongest = |axis: Axis| {
        let eye = stage.middle() - axis.of(layout.steps) * 1000.0;
        stage.lens.orient_to(&mut stage.scene, eye).unwrap();
        let drawable = stage.scene.drawable(stage.lens.entity()).unwrap();
        let material = stage.scene.material(drawable.material).unwrap();
        let image = stage
            .scene
            .image(material.base_colour_image.unwrap())
            .unwrap();
        image.rgba.iter().skip(3).step_by(4).copied().max().unwrap()
    };
    let down = f64::from(strongest(Axis::Time)) / 255.0;
    let across = f64::from(strongest(Axis::Inline)) / 255.0;
    assert!((0.45..=0.5 + 0.01).contains(&down), "{down}");
    assert!(
        (1.0 - across - (1.0 - down).powf(25.0 / 4.0)).abs() < 0.01,
        "{across}"
    );
}

#[test]
fn a_lens_that_is_not_within_the_volume_is_refused_by_axis_and_range() {
    let rule = Rule::new([20, 15, 25], 4);
    let mut scene = Scene::new();
    let mut spawn = |min, max| {
        Lens::spawn(
            &mut scene,
            None,
            &rule.layout,
            SampleBox { min, max },
            &LensOptions::default(),
        )
        .map(|_| ())
        .unwrap_err()
    };
    let partly = spawn([3, 2, 5], [14, 15, 20]);
    assert!(matches!(
        partly,
        SubsurfaceError::Outside {
            axis: Axis::Crossline,
            asked: [2, 15],
            last: 14,
            ..
        }
    ));
    let said = partly.to_string();
    assert!(
        said.contains("crossline") && said.contains("0 to 14"),
        "{said}"
    );
    let wholly = spawn([3, 2, 30], [14, 9, u32::MAX]);
    assert!(matches!(
        wholly,
        SubsurfaceError::Outside {
            axis: Axis::Time,
            ..
        }
    ));
    let empty = spawn([9, 2, 5], [8, 9, 20]);
    assert!(matches!(
        empty,
        SubsurfaceError::Empty {
            axis: Axis::Inline,
            first: 9,
            last: 8,
            ..
        }
    ));
    assert_eq!(scene.roots().count(), 0);

    let mut stage = stage(&LensOptions::default());
    let refused = stage.lens.move_to(&mut stage.scene, [9, 2, 5]);
    assert!(matches!(
        refused,
        Err(SubsurfaceError::Outside {
            axis: Axis::Inline,
            ..
        })
    ));
    let refused = stage.lens.move_to(&mut stage.scene, [u32::MAX; 3]);
    assert!(matches!(refused, Err(SubsurfaceError::Outside { .. })));
    assert_eq!(stage.lens.area(), AREA);
}

#[test]
fn wrong_options_and_bricks_are_refused() {
    let rule = Rule::new([20, 15, 25], 4);
    let good = LensOptions::default();
    let wrong = [
        LensOptions {
            opacity: 1.5,
            ..good
        },
        LensOptions {
            opacity: f32::NAN,
            ..good
        },
        LensOptions {
            threshold: 1.0,
            ..good
        },
        LensOptions {
            atlas_side: 63,
            ..good
        },
    ];
    for options in wrong {
        let refused = Lens::spawn(&mut Scene::new(), None, &rule.layout, AREA, &options);
        assert!(
            matches!(refused, Err(SubsurfaceError::Setting { .. })),
            "{options:?}"
        );
    }
    let mut stage = stage(&good);
    let mut other = BrickCache::new(Arc::new(Rule::new([20, 15, 26], 4)), 1 << 20).unwrap();
    let refused = stage.lens.page(&mut stage.scene, &mut other, &|_| false);
    assert!(matches!(refused, Err(SubsurfaceError::OtherVolume { .. })));
    stage.scene.despawn(stage.lens.entity());
    let refused = stage.lens.orient_to(&mut stage.scene, DVec3::ZERO);
    assert!(matches!(refused, Err(SubsurfaceError::Scene(_))));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn wherever_the_eye_is_outside_the_drawn_stack_is_back_to_front(
        direction in [-1.0f64..1.0, -1.0f64..1.0, -1.0f64..1.0],
        turn in 0.0f64..6.0,
        mirrored: bool,
    ) {
        let direction = DVec3::from(direction);
        prop_assume!(direction.length() > 0.1);
        let rule = Arc::new(Rule { layout: skewed(mirrored), asked: Default::default() });
        let mut scene = Scene::new();
        let parent = scene.spawn(None, DAffine3::from_rotation_z(turn)).unwrap();
        let mut lens = Lens::spawn(&mut scene, Some(parent), &rule.layout, AREA, &LensOptions::default()).unwrap();
        let bricks = BrickCache::new(rule.clone(), 1 << 20).unwrap();
        let middle = scene.world(lens.entity()).unwrap().translation;
        let eye = middle + direction.normalize() * 5000.0;
        lens.orient_to(&mut scene, eye).unwrap();
        let stage = Stage { scene, rule, bricks, lens };
        // Distance of each section's plane from the eye.
        let drawn = stage.drawn();
        let distances: Vec<f64> = drawn.chunks(6).map(|quad| {
            let [a, b, c] = [0, 1, 2].map(|i| quad[i].0);
            (b - a).cross(c - a).normalize().dot(eye - a).abs()
        }).collect();
        prop_assert!(distances.is_sorted_by(|a, b| a > b), "{:?}", distances);
    }
}
