//! What a person would say on seeing the numbers: how fast against the yardsticks, how wrong, and
//! which strategy to take.

use crate::format;
use crate::report::{Report, StrategyReport};

/// Up to this share of wrong pixels (percent, mean) most viewers of a moving picture notice
/// nothing; the picks of [`recommendations`] use it.
const HARDLY_WRONG_PERCENT: f64 = 0.1;

/// How a strategy fared, beyond the words.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tone {
    /// A yardstick: nothing to judge.
    Yardstick,
    /// Faster than the baseline, every pixel right.
    Good,
    /// Faster, with errors.
    Trade,
    /// Not faster.
    Poor,
    /// It claims to be conservative and culled what is seen.
    Broken,
}

/// The words about one strategy.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Summary {
    /// One line without the strategy's name: "3.4 times as fast as frustum, 0.012 % wrong pixels on
    /// average (0.31 % in the worst frame)".
    pub text: String,
    /// How it fared.
    pub tone: Tone,
}

/// One answer to "which shall I take".
#[derive(Debug, Clone, PartialEq)]
pub struct Recommendation<'a> {
    /// The question it answers, e.g. "Fastest with every pixel right".
    pub title: &'static str,
    /// The strategy.
    pub strategy: &'a StrategyReport,
    /// Its [`summarise`].
    pub summary: Summary,
}

/// Judges one strategy of a report.
pub fn summarise(report: &Report, strategy: &StrategyReport) -> Summary {
    let (speed, faster) = speed(report, strategy);
    let wrong = strategy.error.wrong_pixels_percent;
    let right = all_right(strategy);
    let mut text = speed;
    text += ", ";
    text += &if right {
        "every pixel right".to_owned()
    } else if wrong.max == 0.0 {
        format::plural(strategy.error.false_culls.entities, "false cull")
    } else {
        format!(
            "{} % wrong pixels on average ({} % in the worst frame)",
            format::percent(wrong.mean),
            format::percent(wrong.max)
        )
    };
    let tone = match (strategy.breaks_its_promise(), faster, right) {
        (true, ..) => {
            text += ": claims to be conservative and is not";
            Tone::Broken
        }
        _ if strategy.is_yardstick() => Tone::Yardstick,
        (_, false, _) => Tone::Poor,
        (_, true, true) => Tone::Good,
        (_, true, false) => Tone::Trade,
    };
    Summary { text, tone }
}

/// The strategies to look at first: the fastest with every pixel right, the fastest that is hardly
/// wrong, the fastest of all. A strategy is named once, by its best title; yardsticks are not
/// picked.
pub fn recommendations(report: &Report) -> Vec<Recommendation<'_>> {
    type Question = (&'static str, &'static str, fn(&StrategyReport) -> bool);
    let questions: [Question; 3] = [
        (
            "Fastest with every pixel right",
            "Fastest of all, and every pixel right",
            all_right,
        ),
        (
            "Fastest with at most 0.1 % wrong pixels",
            "Fastest of all, with at most 0.1 % wrong pixels",
            hardly_wrong,
        ),
        ("Fastest of all", "Fastest of all", |_| true),
    ];
    let fastest = |fits: fn(&StrategyReport) -> bool| {
        let runners = report
            .strategies
            .iter()
            .filter(|s| !s.is_yardstick() && fits(s));
        runners.min_by(|a, b| a.frame_ms.median.total_cmp(&b.frame_ms.median))
    };
    let of_all = fastest(|_| true);
    let mut picks: Vec<Recommendation<'_>> = Vec::new();
    for (title, title_of_all, fits) in questions {
        let Some(strategy) = fastest(fits) else {
            continue;
        };
        let title = if of_all.is_some_and(|s| std::ptr::eq(s, strategy)) {
            title_of_all
        } else {
            title
        };
        if picks
            .iter()
            .all(|pick| !std::ptr::eq(pick.strategy, strategy))
        {
            picks.push(Recommendation {
                title,
                strategy,
                summary: summarise(report, strategy),
            });
        }
    }
    picks
}

fn all_right(strategy: &StrategyReport) -> bool {
    strategy.error.wrong_pixels_percent.max == 0.0 && strategy.error.false_culls.entities == 0
}

fn hardly_wrong(strategy: &StrategyReport) -> bool {
    strategy.error.wrong_pixels_percent.mean <= HARDLY_WRONG_PERCENT
}

/// "3.4 times as fast as frustum", or as another yardstick, and whether that is faster beyond the
/// noise.
pub(crate) fn speed(report: &Report, strategy: &StrategyReport) -> (String, bool) {
    match (strategy.time_vs_frustum, strategy.time_vs_none) {
        _ if strategy.name == "frustum" => against(report, "none", strategy.time_vs_none),
        (Some(ratio), _) => against(report, "frustum", Some(ratio)),
        (None, ratio) => against(report, "none", ratio),
    }
}

fn against(report: &Report, baseline: &str, ratio: Option<f64>) -> (String, bool) {
    let Some(ratio) = ratio.filter(|r| *r > 0.0) else {
        return (format!("not measured against {baseline}"), false);
    };
    if ratio.max(ratio.recip()) <= report.noise.least_ratio() {
        (format!("as fast as {baseline}, within the noise"), false)
    } else if ratio < 1.0 {
        (
            format!(
                "{} times as fast as {baseline}",
                format::factor(ratio.recip())
            ),
            true,
        )
    } else {
        (
            format!(
                "takes {} times as long as {baseline}",
                format::factor(ratio)
            ),
            false,
        )
    }
}
