//! Comparisons with two views: errors of each eye, and errors of both together.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::sync::Arc;

use antumbra_draw::GpuScene;
use antumbra_measure::MeasureError;
use antumbra_measure::compare::{CompareOptions, Comparison, Contender, compare};
use antumbra_measure::path::CameraPath;
use antumbra_measure::report::{ErrorReport, Report, StereoFacts};
use antumbra_scene::{Projection, Scene, Stereo, StereoError};
use antumbra_strategies::registry;
use antumbra_testing::{auto, balls_with_proxies};
use antumbra_verify::{EntitySet, Oracle};

const SIZE: [u32; 2] = [96, 72];
const FRAMES: usize = 3;
const EXACT: &str =
    "three-pass:latency=same-frame:threshold=0:scale=1:occluders=full:occludees=full";
/// A threshold that is far too high for the grid, so that every frame has wrong pixels.
const WRONG: &str = "three-pass:latency=same-frame:threshold=40";

fn scene() -> (Scene, CameraPath) {
    let mut scene = balls_with_proxies(5);
    scene.update();
    let path = CameraPath::orbit_around(&scene.bounds().unwrap(), 4.0 / 3.0, FRAMES).unwrap();
    (scene, path)
}

/// Eyes that are far apart, so that each sees entities that the other does not.
fn stereo() -> Stereo {
    Stereo::new(2.0, 15.0).unwrap()
}

fn compared(
    stereo: Option<Stereo>,
    specs: &[&str],
    change: impl FnOnce(CameraPath) -> CameraPath,
) -> Result<Comparison, MeasureError> {
    let (mut scene, path) = scene();
    let registry = Arc::new(registry());
    let contenders: Vec<Contender> = specs
        .iter()
        .map(|spec| Contender::of("", &registry, spec).unwrap())
        .collect();
    let options = CompareOptions {
        size: SIZE,
        stereo,
        least_seconds: 0.0,
        ..CompareOptions::default()
    };
    let path = change(path);
    compare(
        auto(),
        &mut scene,
        &path,
        &contenders,
        &options,
        &mut |_| (),
    )
}

fn close(a: f64, b: f64) {
    assert!((a - b).abs() <= 1e-12 * (1.0 + a.abs()), "{a} is not {b}");
}

#[test]
fn each_eye_is_judged_and_both_together() {
    let comparison = compared(
        Some(stereo()),
        &["frustum", "ideal", EXACT, WRONG],
        |path| path,
    )
    .unwrap();
    let report = &comparison.report;
    assert_eq!(report.scene.views, 2);
    let distances = StereoFacts {
        interocular: 2.0,
        convergence: 15.0,
    };
    assert_eq!(report.scene.stereo, Some(distances));
    for strategy in &report.strategies {
        let [left, right] = strategy.views.as_slice() else {
            panic!("{}: {} views", strategy.name, strategy.views.len())
        };
        let both = &strategy.error;
        let wrong = |error: &ErrorReport| error.wrong_pixels_percent.mean;
        close(wrong(both), (wrong(left) + wrong(right)) / 2.0);
        close(both.flip.mean, (left.flip.mean + right.flip.mean) / 2.0);
        close(both.flip.max, left.flip.max.max(right.flip.max));
        let culls = |error: &ErrorReport| error.false_culls.entities;
        assert_eq!(culls(both), culls(left) + culls(right));
        let [asked_left, asked_right] = strategy.queries_a_view[..] else {
            panic!("{:?}", strategy.queries_a_view)
        };
        close(strategy.queries, asked_left + asked_right);
        let [series_left, series_right] = strategy.frames.wrong_pixels_percent_a_view.as_slice()
        else {
            panic!("{:?}", strategy.frames)
        };
        for (pose, both) in strategy.frames.wrong_pixels_percent.iter().enumerate() {
            close(*both, (series_left[pose] + series_right[pose]) / 2.0);
        }
        assert_eq!(strategy.frames.wrong_pixels_percent.len(), FRAMES);
    }
    for exact in &report.strategies[..3] {
        assert_eq!(exact.error.wrong_pixels_percent.max, 0.0, "{}", exact.name);
        assert_eq!(exact.error.false_culls.entities, 0, "{}", exact.name);
        assert!(exact.worst.is_none());
    }
    let three = &report.strategies[2];
    assert!(three.queries_a_view.iter().all(|asked| *asked > 0.0));
    assert_eq!(report.strategies[0].queries, 0.0);

    let wrong = &report.strategies[3];
    let worst = wrong.worst.as_ref().unwrap();
    let percent = |eye: usize| wrong.views[eye].wrong_pixels_percent.max;
    assert!(percent(0) > 0.0 && percent(1) > 0.0);
    assert!(percent(worst.view as usize) >= percent(1 - worst.view as usize));
    let series = &wrong.frames.wrong_pixels_percent_a_view[worst.view as usize];
    close(series[worst.frame as usize], percent(worst.view as usize));
    // The pictures are those of this eye: as many pixels are magenta as are wrong.
    let marked = &comparison.pictures[&worst.images.marked];
    let magenta = marked.pixels().filter(|p| p.0 == [255, 0, 255, 255]);
    close(
        100.0 * magenta.count() as f64 / f64::from(SIZE[0] * SIZE[1]),
        percent(worst.view as usize),
    );
}

/// `ideal` draws the owners of each eye's pixels, and those differ.
#[test]
fn what_owns_pixels_differs_from_eye_to_eye() {
    let (mut scene, path) = scene();
    let on_gpu = GpuScene::new(auto(), &mut scene).unwrap();
    let mut oracle = Oracle::new(&on_gpu, SIZE);
    let mut sum = 0;
    for camera in path.cameras() {
        let owners = stereo().eyes(&camera).unwrap().map(|eye| {
            let seen = oracle.render(&on_gpu, &eye, EntitySet::InFrustum).unwrap();
            seen.owners()
        });
        assert_ne!(owners[0], owners[1]);
        sum += owners[0].len() + owners[1].len();
    }
    let comparison = compared(Some(stereo()), &["ideal"], |path| path).unwrap();
    let ideal = &comparison.report.strategies[0];
    close(ideal.drawn.entities, sum as f64 / FRAMES as f64);
    close(ideal.overdrawn_entities, 0.0);
}

#[test]
fn eyes_in_one_place_are_one_view_twice() {
    let together = Stereo::new(0.0, 15.0).unwrap();
    let two = compared(Some(together), &[EXACT, WRONG], |path| path).unwrap();
    let one = compared(None, &[EXACT, WRONG], |path| path).unwrap();
    assert_eq!((one.report.scene.views, two.report.scene.views), (1, 2));
    for (two, one) in two.report.strategies.iter().zip(&one.report.strategies) {
        assert_eq!(two.views, [one.error; 2]);
        assert_eq!(
            two.error.wrong_pixels_percent,
            one.error.wrong_pixels_percent
        );
        close(two.drawn.entities, 2.0 * one.drawn.entities);
        close(two.drawn.triangles, 2.0 * one.drawn.triangles);
        close(two.overdrawn_entities, 2.0 * one.overdrawn_entities);
        assert_eq!(two.queries_a_view, [one.queries; 2]);
        // In a tie, the left eye is shown.
        assert_eq!(two.worst, one.worst);
    }
    // With one view, there are no eyes.
    let text = one.report.to_json().unwrap();
    for field in ["stereo", "queries_a_view", "wrong_pixels_percent_a_view"] {
        assert!(!text.contains(field), "{field}");
    }
    let again: Report = serde_json::from_str(&text).unwrap();
    assert_eq!(again, one.report);
    let text = two.report.to_json().unwrap();
    assert_eq!(serde_json::from_str::<Report>(&text).unwrap(), two.report);
}

#[test]
fn eyes_that_cannot_be_are_refused_before_anything_is_drawn() {
    let parallel = |path: CameraPath| {
        let projection = Projection::Orthographic {
            height: 10.0,
            near: 0.0,
            far: 100.0,
        };
        CameraPath::new("flat", projection, path.poses().to_vec()).unwrap()
    };
    let error = compared(Some(stereo()), &["frustum"], parallel).unwrap_err();
    assert!(
        matches!(error, MeasureError::Stereo(StereoError::Orthographic)),
        "{error}"
    );
    let unchecked = Stereo {
        interocular: 1.0,
        convergence: 0.0,
    };
    let error = compared(Some(unchecked), &["frustum"], |path| path).unwrap_err();
    assert!(error.to_string().contains("above 0"), "{error}");
}
