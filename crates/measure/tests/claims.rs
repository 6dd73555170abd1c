//! Reports claim no more than was measured: scenes that cover few pixels, entities that are never drawn, and entities at equal depth.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::sync::Arc;

use antumbra_measure::compare::{CompareOptions, Comparison, Contender, compare};
use antumbra_measure::path::{CameraPath, Pose};
use antumbra_measure::report::{ErrorBasis, ErrorMeasure, Report, StrategyReport};
use antumbra_measure::summary::{following, recommendations, summarise, withheld};
use antumbra_measure::table::{Table, facts};
use antumbra_measure::trade_off::choose;
use antumbra_scene::{Drawable, Material, Mesh, Scene, icosphere};
use antumbra_strategies::registry;
use antumbra_testing::{add, auto, cuboid, drawable, perspective_degrees};
use glam::{DAffine3, DVec3};

const SIZE: [u32; 2] = [320, 240];
const EXACT: &str =
    "three-pass:latency=same-frame:threshold=0:scale=1:occluders=full:occludees=full";
/// Leaves out whatever covers ten pixels or fewer.
const TEN: &str = "three-pass:latency=same-frame:threshold=10";

/// 400 boxes of about one pixel each, 400 metres away, none in front of another.
fn fleet() -> Scene {
    let mut scene = Scene::new();
    let hull = drawable(
        &mut scene,
        "hull",
        cuboid(DVec3::splat(2.2)),
        Material::default(),
    );
    for at in 0..400 {
        let (column, row) = (f64::from(at % 20) - 9.5, f64::from(at / 20) - 9.5);
        let place = DVec3::new(column * 20.3, row * 15.7, -400.0);
        let ship = add(&mut scene, DAffine3::from_translation(place), hull);
        scene.set_entity_name(ship, format!("ship {at}")).unwrap();
    }
    scene
}

/// 24 pairs of boxes in the same places and in other colours.
fn duplicates() -> Scene {
    let mut scene = Scene::new();
    let colours = [[1.0, 0.1, 0.1, 1.0], [0.1, 1.0, 0.1, 1.0]].map(|base_colour| {
        let material = Material {
            base_colour,
            unlit: true,
            ..Material::default()
        };
        drawable(&mut scene, "box", cuboid(DVec3::splat(2.0)), material)
    });
    for at in 0..24 {
        let (column, row) = (f64::from(at % 6) - 2.5, f64::from(at / 6) - 1.5);
        let place = DVec3::new(column * 3.0, row * 3.0, -18.0 + f64::from(at % 5));
        // Of every other pair the entity that is drawn last is added first.
        let [first, last] = colours;
        let pair = match at % 2 {
            0 => [first, last],
            _ => [last, first],
        };
        for shown in pair {
            add(&mut scene, DAffine3::from_translation(place), shown);
        }
    }
    scene
}

fn compared(mut scene: Scene, specs: &[&str]) -> Comparison {
    let poses = (0..4).map(|at| {
        let eye = DVec3::new(f64::from(at) * 0.3, 0.0, 0.0);
        Pose::look_at(eye, eye - DVec3::Z * 400.0, None).unwrap()
    });
    let path = CameraPath::new("ahead", perspective_degrees(60.0, 0.1), poses.collect()).unwrap();
    let registry = Arc::new(registry());
    let contenders: Vec<Contender> = specs
        .iter()
        .map(|spec| Contender::of(*spec, &registry, spec).unwrap())
        .collect();
    let options = CompareOptions {
        size: SIZE,
        least_seconds: 0.0,
        ..CompareOptions::default()
    };
    let mut silent = |_| ();
    compare(
        auto(),
        &mut scene,
        &path,
        &contenders,
        &options,
        &mut silent,
    )
    .unwrap()
}

fn titled<'a>(report: &'a Report, title: &str) -> &'a StrategyReport {
    let mut all = report.strategies.iter();
    all.find(|one| one.title() == title).unwrap()
}

/// The report as it is read back from its file.
fn saved(comparison: &Comparison) -> Report {
    let dir = tempfile::tempdir().unwrap();
    comparison.save(dir.path()).unwrap();
    Report::load(dir.path().join("report.json")).unwrap()
}

#[test]
fn a_strategy_that_loses_a_fleet_of_one_pixel_ships_is_not_recommended() {
    let mut report = saved(&compared(fleet(), &["frustum", EXACT, TEN]));
    let owned = report.scene.owned_percent.unwrap();
    assert!((0.1..2.0).contains(&owned), "{owned}");
    assert_eq!(report.error_basis(), ErrorBasis::Owned);
    assert!(facts(&report)[0].contains("entities own"));

    let losing = titled(&report, TEN).clone();
    assert_eq!(losing.drawn.entities, 0.0);
    // The share of the image flatters: it is the share that the fleet covers.
    assert!(losing.error.wrong_pixels_percent.max < 2.0);
    let of_owned = losing.error.wrong_of_owned_percent.unwrap();
    assert_eq!((of_owned.mean, of_owned.max), (100.0, 100.0));
    assert_eq!(losing.frames.wrong_of_owned_percent, [100.0; 4]);
    let lost = losing.lost.clone().unwrap();
    assert_eq!((lost.entities, lost.of), (400, 400));
    assert!(lost.named[0].contains("ship "), "{lost:?}");
    let exact = titled(&report, EXACT);
    assert_eq!(exact.error.wrong_of_owned_percent.unwrap().max, 0.0);
    assert_eq!(exact.lost.as_ref().unwrap().entities, 0);

    // However fast it is.
    for one in &mut report.strategies {
        one.frame_ms.median = if one.title() == TEN { 0.1 } else { 10.0 };
        one.time_vs_frustum = Some(one.frame_ms.median / 10.0);
    }
    let picks = recommendations(&report);
    assert!(!picks.is_empty());
    assert!(picks.iter().all(|pick| pick.strategy.title() != TEN));
    let held = withheld(&report);
    assert_eq!(held.len(), 1);
    assert_eq!(held[0].0.title(), TEN);
    assert_eq!(
        held[0].1,
        "100 % of the pixels that entities own are wrong, draws nothing of 400 visible entities"
    );
    let words = summarise(&report, &losing).text;
    assert!(
        words.contains("100 % of the pixels that entities own"),
        "{words}"
    );
    assert!(words.contains("draws nothing"), "{words}");
    // A limit of wrong pixels goes by the pixels that entities own, and says so.
    let limit = choose(&report, "wrong_pixels=2%".parse().unwrap());
    assert_eq!(limit.measure, ErrorMeasure::WrongOfOwnedPercent);
    assert!(limit.choices.iter().all(|choice| choice.setting == EXACT));
    // Nor is it a choice where the limit lets it pass.
    let limit = choose(&report, "false_culls=100000".parse().unwrap());
    assert!(!limit.choices.is_empty());
    assert!(limit.choices.iter().all(|choice| choice.setting == EXACT));
    let table = Table::new(&report).terminal(false);
    assert!(
        table.contains("of owned") && table.contains("for good"),
        "{table}"
    );
}

#[test]
fn what_is_lost_for_good_is_said_wherever_a_strategy_is_recommended() {
    let mut scene = fleet();
    // Large boxes beside the fleet, which the threshold keeps: enough that the strategy is not withheld.
    let large = drawable(
        &mut scene,
        "large",
        cuboid(DVec3::splat(0.9)),
        Material::default(),
    );
    let places = (0..500).map(|at| {
        let (column, row) = (f64::from(at % 25) - 12.0, f64::from(at / 25) - 9.5);
        DVec3::new(column * 1.1, row * 1.1, -18.0)
    });
    for place in places {
        add(&mut scene, DAffine3::from_translation(place), large);
    }
    let mut report = saved(&compared(scene, &["frustum", TEN]));
    assert_eq!(report.error_basis(), ErrorBasis::Image);
    let lost = titled(&report, TEN).lost.clone().unwrap();
    assert!(
        lost.entities > 0 && 2 * lost.entities <= lost.of,
        "{lost:?}"
    );
    report.strategies[1].time_vs_frustum = Some(0.1);
    let picks = recommendations(&report);
    assert_eq!(picks.len(), 1);
    let words = &picks[0].summary.text;
    let expected = format!("never draws {} of {}", lost.entities, lost.of);
    assert!(words.contains(&expected), "{words}");
    assert!(withheld(&report).is_empty());
    // Nor is one recommended that shows each entity once, and most of them hardly ever.
    let of_owned = &mut report.strategies[1].error.wrong_of_owned_percent;
    of_owned.as_mut().unwrap().mean = 51.0;
    assert!(recommendations(&report).is_empty());
    assert!(withheld(&report)[0].1.contains("51 % of the pixels"));
}

#[test]
fn flip_is_computed_from_images_and_ties_are_no_errors() {
    let comparison = compared(
        duplicates(),
        &[
            "frustum",
            EXACT,
            "stop-and-wait",
            "coherent:latency=same-frame",
        ],
    );
    let report = saved(&comparison);
    for one in &report.strategies {
        let ties = one.error.ties.unwrap();
        assert_eq!(one.error.wrong_pixels_percent.max, 0.0, "{}", one.title());
        assert_eq!(one.error.false_culls.entities, 0, "{}", one.title());
        assert_eq!(ties.culled_entities, 0, "{}", one.title());
        assert!(!one.breaks_its_promise());
        assert_eq!(one.lost.as_ref().unwrap().entities, 0);
        // All differences between the images are ties here.
        let differs = ties.shown_percent.max > 0.0;
        assert_eq!(one.error.flip.max > 0.0, differs, "{}", one.title());
        let words = summarise(&report, one).text;
        assert_eq!(words.contains("ties in"), differs, "{words}");
    }
    for alike in ["frustum", EXACT] {
        assert_eq!(titled(&report, alike).error.flip.max, 0.0, "{alike}");
    }
    // Several lists are shaded, and the other twin is in front.
    let other = titled(&report, "stop-and-wait").error;
    assert!(other.flip.mean > 0.0 && other.ties.unwrap().shown_percent.mean > 0.0);
    let table = Table::new(&report).terminal(false);
    assert!(table.contains("ties"), "{table}");
}

#[test]
fn the_colours_of_a_coarser_level_are_no_ties() {
    let mut scene = Scene::new();
    let mesh = Mesh {
        name: "ball".to_owned(),
        levels: [3, 0].map(|splits| icosphere(splits, 1.0)).into(),
        proxy: None,
    };
    let mesh = scene.add_mesh(mesh).unwrap();
    let material = scene.add_material(Material::default());
    for at in 0..9 {
        let place = DVec3::new(f64::from(at % 3) - 1.0, f64::from(at / 3) - 1.0, -6.0) * 3.0;
        let ball = Drawable { mesh, material };
        add(&mut scene, DAffine3::from_translation(place), ball);
    }
    let coarser = "three-pass:latency=same-frame:coarser=100000";
    let report = saved(&compared(scene, &["frustum", coarser]));
    let error = &titled(&report, coarser).error;
    assert!(error.flip.max > 0.0);
    assert_eq!(error.ties.unwrap().shown_percent.max, 0.0);
}

#[test]
fn a_threshold_that_follows_the_image_is_said_with_its_number() {
    let report = saved(&compared(fleet(), &["three-pass", TEN]));
    let found = &titled(&report, "three-pass").follows_image;
    assert_eq!(found["threshold"], 1);
    assert!(titled(&report, TEN).follows_image.is_empty());
    assert_eq!(titled(&report, TEN).settings["threshold"], 10);
    assert_eq!(
        following(&report),
        ["three-pass: threshold 1 (follows the image)"]
    );
    let dir = tempfile::tempdir().unwrap();
    let page = antumbra_measure::html::page(&report, dir.path()).unwrap();
    assert!(page.contains("threshold = 1 (follows the image)"));
}
