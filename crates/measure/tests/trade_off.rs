//! The trade-off of a sweep: the Pareto front, and the choice under a limit of errors.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

#[path = "common/swept.rs"]
mod swept;
#[path = "common/synthetic.rs"]
mod synthetic;

use antumbra_measure::report::{Aggregate, Choice, ErrorMeasure, Report, StrategyReport};
use antumbra_measure::trade_off::{ErrorLimit, choice_texts, choose, pareto_front};
use proptest::prelude::*;
use swept::{known, report, setting, with};

fn thresholds(report: &Report) -> Vec<&str> {
    pareto_front(report).into_iter().map(threshold).collect()
}

fn threshold(setting: &StrategyReport) -> &str {
    setting.label.split('=').nth(1).unwrap()
}

fn chosen(report: &Report, budget: &str) -> Vec<Choice> {
    let budget: ErrorLimit = budget.parse().unwrap();
    choose(report, budget).choices
}

#[test]
fn the_edge_of_a_known_report() {
    assert_eq!(thresholds(&known()), ["0", "4", "64"]);
    // With less noise, 5 differs from 4.
    let mut quiet = known();
    quiet.noise.frame_time_ratio_p95 = Some(1.02);
    assert_eq!(thresholds(&quiet), ["0", "4", "5", "64"]);
    // With more noise only the ends are left, then only the setting without errors.
    let mut loud = known();
    loud.noise.frame_time_ratio_p95 = Some(1.3);
    assert_eq!(thresholds(&loud), ["0", "64"]);
    loud.noise.frame_time_ratio_p95 = Some(2.0);
    assert_eq!(thresholds(&loud), ["0"]);
}

#[test]
fn ties_single_settings_and_none() {
    let one = report(vec![setting("1", 0.4, 0.0)]);
    assert_eq!(thresholds(&one), ["1"]);
    assert_eq!(thresholds(&report(Vec::new())), [""; 0]);
    let twins = report(vec![setting("1", 0.4, 0.1), setting("2", 0.4, 0.1)]);
    assert_eq!(thresholds(&twins), ["1"]);
    let all_right = report(vec![
        setting("1", 0.5, 0.0),
        setting("2", 0.4, 0.0),
        setting("3", 0.6, 0.0),
    ]);
    assert_eq!(thresholds(&all_right), ["2"]);
    assert!(chosen(&report(Vec::new()), "wrong_pixels=1%").is_empty());
    let alone = &chosen(&one, "wrong_pixels=0")[0];
    assert_eq!((alone.within, &alone.next), (true, &None));
}

#[test]
fn the_choice_of_a_known_report() {
    let report = known();
    let [mean, worst] = &chosen(&report, "wrong_pixels=0.05%")[..] else {
        panic!("one for the mean and one for the worst pose")
    };
    // 5 is the fastest within the limit; 4 is as fast within the noise and has less error; 0 is the next.
    assert_eq!(mean.over, Aggregate::Mean);
    assert_eq!(mean.setting, "three-pass threshold=4");
    assert_eq!(mean.fastest.as_deref(), Some("three-pass threshold=5"));
    assert_eq!(mean.alike, ["three-pass threshold=5"]);
    assert!(mean.within && (mean.error - 0.01).abs() < 1e-12 && (mean.margin - 0.04).abs() < 1e-12);
    let next = mean.next.as_ref().unwrap();
    assert_eq!(next.setting, "three-pass threshold=0");
    assert!((next.time_ratio - 0.50 / 0.39).abs() < 1e-9);
    assert_eq!((next.slower_blocks, next.blocks), (Some(6), Some(6)));
    assert!((next.by_chance.unwrap() - 1.0 / 64.0).abs() < 1e-12);
    assert_eq!(
        (worst.over, worst.setting.as_str()),
        (Aggregate::Max, "three-pass threshold=4")
    );

    // 0.02 % on average is 0.04 % in the worst frame. An error equal to the limit is within it.
    let [mean, worst] = &chosen(&report, "wrong_pixels=0.02%")[..] else {
        panic!()
    };
    assert_eq!(mean.alike, ["three-pass threshold=5"]);
    assert_eq!(worst.setting, "three-pass threshold=4");
    assert!(worst.alike.is_empty() && worst.fastest.as_ref() == Some(&worst.setting));

    let generous = &chosen(&report, "wrong_pixels=100%")[0];
    assert_eq!(generous.setting, "three-pass threshold=64");
    assert_eq!(
        generous.next.as_ref().unwrap().setting,
        "three-pass threshold=99"
    );
    let none = &chosen(&report, "false_culls=0")[0];
    assert_eq!(
        (none.over, none.setting.as_str(), none.within),
        (Aggregate::Sum, "three-pass threshold=0", true)
    );
    let flip = &chosen(&report, "flip=0.002");
    assert_eq!(flip[0].setting, "three-pass threshold=64");
    assert_eq!(flip[1].setting, "three-pass threshold=4");
}

#[test]
fn where_nothing_stays_within_the_nearest_is_named() {
    let mut report = known();
    report.strategies.retain(|s| !s.label.ends_with("=0"));
    for choice in chosen(&report, "wrong_pixels=0") {
        assert_eq!(choice.setting, "three-pass threshold=4");
        assert!(!choice.within && choice.margin < 0.0);
        assert_eq!((choice.fastest, choice.next), (None, None));
    }
    let report = with(report, &["wrong_pixels=0"]);
    let said = choice_texts(&report);
    // No wrong pixel on average means none in the worst frame, so there is one sentence.
    assert_eq!(said.len(), 1);
    assert_eq!(said[0].heading, "No setting has no wrong pixel; nearest");
}

#[test]
fn blocks_that_disagree_show_nothing() {
    // By the yardstick, 2 is a fifth faster. By blocks, it was faster only once.
    let mut right = setting("1", 0.50, 0.0);
    let mut wrong = setting("2", 0.40, 0.1);
    right.frames.frame_ms = vec![50.0; 12];
    wrong.frames.frame_ms = [vec![10.0; 2], vec![50.0; 10]].concat();
    let report = report(vec![right, wrong]);
    assert_eq!(thresholds(&report), ["1"]);
    let choice = &chosen(&report, "wrong_pixels=1%")[0];
    assert_eq!(choice.setting, "three-pass threshold=1");
    assert_eq!(choice.alike, ["three-pass threshold=2"]);
}

#[test]
fn reports_without_series_or_yardsticks_are_judged_by_what_they_have() {
    let mut report = known();
    for strategy in &mut report.strategies {
        strategy.frames = Default::default();
    }
    assert_eq!(thresholds(&report), ["0", "4", "64"]);
    let next = chosen(&report, "wrong_pixels=0.05%")[0]
        .next
        .clone()
        .unwrap();
    assert_eq!((next.slower_blocks, next.by_chance), (None, None));
    for strategy in &mut report.strategies {
        (strategy.time_vs_frustum, strategy.time_vs_none) = (None, None);
    }
    assert_eq!(thresholds(&report), ["0", "4", "64"]);
}

#[test]
fn what_is_no_number_neither_competes_nor_is_written() {
    let mut report = known();
    report.strategies[4].error.wrong_pixels_percent.mean = f64::NAN;
    report.strategies[5].frames.frame_ms[3] = f64::NAN;
    assert_eq!(thresholds(&report), ["4", "64"]);
    report.strategies[7].time_vs_frustum = Some(f64::INFINITY);
    report.strategies[6].frame_ms.median = f64::NAN;
    let report = with(report, &["wrong_pixels=0.05%", "false_culls=1", "flip=1"]);
    let sweep = serde_json::to_string(&report.sweep).unwrap();
    assert!(!sweep.contains("null"), "{sweep}");
}

#[test]
fn answers_say_how_certain_they_are() {
    let report = with(
        known(),
        &["wrong_pixels=0.05%", "wrong_pixels=0", "false_culls=500"],
    );
    let said = choice_texts(&report);
    let text = |at: usize| {
        let answer: &antumbra_measure::trade_off::ChoiceText<'_> = &said[at];
        format!("{}: {}", answer.heading, answer.lines.join("; "))
    };
    assert_eq!(
        text(0),
        "Fastest with at most 0.050 % wrong pixels on average: 2.5 times as fast as frustum, 0.010 % wrong pixels, \
         20 % of the limit; as fast, within the noise of 5.0 %, but no less wrong: threshold=5; slower, beyond the \
         noise of 5.0 %: threshold=0 takes 1.28 times as long as threshold=5, slower in 6 of 6 blocks (by chance 1 \
         time in 64)"
    );
    assert!(
        text(1)
            .starts_with("Fastest with at most 0.050 % wrong pixels in the worst frame: 2.5 times")
    );
    assert_eq!(
        text(2),
        "Fastest with no wrong pixel: 2.0 times as fast as frustum, no wrong pixel; all others are beyond the limit"
    );
    assert!(text(3).starts_with("Fastest with at most 500 false culls in all frames: 3.3 times"));
    assert!(choice_texts(&known()).is_empty());
}

/// Settings without series, many of them with equal times and errors.
fn settings() -> impl Strategy<Value = (Report, f64)> {
    let one = (1u32..40, prop_oneof![Just(0u32), 0u32..6, 0u32..1000]);
    let noise = prop_oneof![Just(1.0), 1.0..1.5f64];
    (prop::collection::vec(one, 0..25), noise).prop_map(|(all, noise)| {
        let settings = all.into_iter().enumerate().map(|(at, (time, wrong))| {
            let mut setting = setting(
                &at.to_string(),
                f64::from(time) * 0.05,
                f64::from(wrong) * 0.01,
            );
            setting.frames = Default::default();
            setting
        });
        let mut report = report(settings.collect());
        report.noise.frame_time_ratio_p95 = Some(noise);
        let noise = report.noise.least_ratio();
        (report, noise)
    })
}

fn time(setting: &StrategyReport) -> f64 {
    setting.time_vs_frustum.unwrap()
}

fn wrong(setting: &StrategyReport) -> f64 {
    setting.error.wrong_pixels_percent.mean
}

proptest! {
    #[test]
    fn the_edge_is_monotone_undominated_and_covers_everything((report, noise) in settings()) {
        let edge = pareto_front(&report);
        let all: Vec<_> = report.strategies.iter().filter(|s| !s.is_yardstick()).collect();
        prop_assert_eq!(edge.is_empty(), all.is_empty());
        for pair in edge.windows(2) {
            prop_assert!(wrong(pair[0]) < wrong(pair[1]));
            prop_assert!(time(pair[0]) > time(pair[1]) * noise);
        }
        for on in &edge {
            for other in &all {
                let better = (time(other) < time(on) && wrong(other) <= wrong(on))
                    || (time(other) <= time(on) && wrong(other) < wrong(on));
                prop_assert!(!better, "{} beats {}", other.label, on.label);
            }
        }
        for one in &all {
            let covered = edge.iter().any(|on| wrong(on) <= wrong(one) && time(on) <= time(one) * noise);
            prop_assert!(covered, "{}", one.label);
        }
    }

    #[test]
    fn the_order_of_the_settings_does_not_move_the_edge((mut report, _) in settings()) {
        let costs = |report: &Report| pareto_front(report).into_iter().map(|s| (time(s), wrong(s))).collect::<Vec<_>>();
        let before = costs(&report);
        report.strategies.reverse();
        prop_assert_eq!(before, costs(&report));
    }

    #[test]
    fn a_choice_keeps_its_budget_and_nothing_clearly_faster_does((report, noise) in settings(), limit in 0.0..12.0f64) {
        let budget = ErrorLimit::new(ErrorMeasure::WrongPixelsPercent, limit).unwrap();
        for choice in choose(&report, budget).choices {
            let error = |s: &StrategyReport| match choice.over {
                Aggregate::Max => s.error.wrong_pixels_percent.max,
                _ => s.error.wrong_pixels_percent.mean,
            };
            let all: Vec<_> = report.strategies.iter().filter(|s| !s.is_yardstick()).collect();
            let of = |title: &str| *all.iter().find(|s| s.title() == title).unwrap();
            let its = of(&choice.setting);
            prop_assert_eq!(error(its), choice.error);
            prop_assert_eq!(choice.within, choice.error <= limit);
            prop_assert!((choice.margin - (limit - choice.error)).abs() < 1e-12);
            if !choice.within {
                prop_assert!(all.iter().all(|s| error(s) > limit && error(s) >= choice.error));
                continue;
            }
            let fastest = of(choice.fastest.as_deref().unwrap());
            for other in all.iter().filter(|s| error(s) <= limit) {
                prop_assert!(time(other) >= time(fastest));
                let alike = choice.alike.iter().any(|title| title == other.title());
                if std::ptr::eq(*other, its) {
                    prop_assert!(!alike && time(its) <= time(fastest) * noise);
                } else if alike {
                    prop_assert!(time(other) <= time(fastest) * noise && error(other) >= choice.error);
                } else {
                    prop_assert!(time(other) > time(fastest) * noise);
                    let next = choice.next.as_ref().unwrap();
                    prop_assert!(time(of(&next.setting)) <= time(other) && next.time_ratio > noise);
                }
            }
            prop_assert!(choice.alike.iter().all(|title| error(of(title)) <= limit));
        }
    }
}
