//! Sentences about a report: the speed and the errors of each strategy, and recommendations.

use crate::format;
use crate::report::{Report, StrategyReport};
use antumbra_cull::Role;

/// Most viewers of a moving image do not notice up to this share of wrong pixels (percent, mean). [`recommendations`] use it.
const UNNOTICED_PERCENT: f64 = 0.1;

/// The rating of a strategy.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tone {
    /// A yardstick, which is not rated.
    Yardstick,
    /// Faster than the yardstick, without wrong pixels.
    Good,
    /// Faster, with errors.
    Trade,
    /// Not faster.
    Poor,
    /// It claims to be conservative and has culled a visible entity.
    Broken,
}

/// The summary of one strategy.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Summary {
    /// One line without the strategy's name: "3.4 times as fast as frustum, 0.012 % wrong pixels on
    /// average (0.31 % in the worst frame)".
    pub text: String,
    /// Its rating.
    pub tone: Tone,
}

/// A recommended strategy.
#[derive(Debug, Clone, PartialEq)]
pub struct Recommendation<'a> {
    /// What it is recommended for, such as "Fastest with every pixel right".
    pub title: &'static str,
    /// The strategy.
    pub strategy: &'a StrategyReport,
    /// Its [`summarise`].
    pub summary: Summary,
}

/// Summarises one strategy of a report.
pub fn summarise(report: &Report, strategy: &StrategyReport) -> Summary {
    let SpeedSummary { text, faster } = speed(report, strategy);
    let wrong = strategy.error.wrong_pixels_percent;
    let right = all_right(strategy);
    let mut text = text + ", ";
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

/// The fastest strategy without wrong pixels, the fastest with hardly any, and the fastest of all. Each strategy appears once, with its best
/// title. Yardsticks are left out.
pub fn recommendations(report: &Report) -> Vec<Recommendation<'_>> {
    let criteria = [
        Criterion {
            title: "Fastest with every pixel right",
            title_of_all: "Fastest of all, and every pixel right",
            fits: all_right,
        },
        Criterion {
            title: "Fastest with at most 0.1 % wrong pixels",
            title_of_all: "Fastest of all, with at most 0.1 % wrong pixels",
            fits: hardly_wrong,
        },
        Criterion {
            title: "Fastest of all",
            title_of_all: "Fastest of all",
            fits: |_| true,
        },
    ];
    let fastest = |fits: fn(&StrategyReport) -> bool| {
        let runners = report
            .strategies
            .iter()
            .filter(|s| !s.is_yardstick() && fits(s));
        runners.min_by(|a, b| a.frame_ms.median.total_cmp(&b.frame_ms.median))
    };
    let of_all = fastest(|_| true);
    let mut recommended: Vec<Recommendation<'_>> = Vec::new();
    for criterion in criteria {
        let Some(strategy) = fastest(criterion.fits) else {
            continue;
        };
        let title = if of_all.is_some_and(|s| std::ptr::eq(s, strategy)) {
            criterion.title_of_all
        } else {
            criterion.title
        };
        if recommended
            .iter()
            .all(|pick| !std::ptr::eq(pick.strategy, strategy))
        {
            recommended.push(Recommendation {
                title,
                strategy,
                summary: summarise(report, strategy),
            });
        }
    }
    recommended
}

/// What a strategy is recommended for.
struct Criterion {
    title: &'static str,
    /// The title where the strategy is the fastest of all.
    title_of_all: &'static str,
    fits: fn(&StrategyReport) -> bool,
}

fn all_right(strategy: &StrategyReport) -> bool {
    strategy.error.wrong_pixels_percent.max == 0.0 && strategy.error.false_culls.entities == 0
}

fn hardly_wrong(strategy: &StrategyReport) -> bool {
    strategy.error.wrong_pixels_percent.mean <= UNNOTICED_PERCENT
}

/// A strategy's speed in words.
pub(crate) struct SpeedSummary {
    /// For example "3.4 times as fast as frustum".
    pub text: String,
    /// Whether it is significantly faster.
    pub faster: bool,
}

/// A strategy's speed against `frustum` or, where that was not measured, against `none`.
pub(crate) fn speed(report: &Report, strategy: &StrategyReport) -> SpeedSummary {
    match (strategy.time_vs_frustum, strategy.time_vs_none) {
        _ if strategy.role() == Role::Frustum => against(report, "none", strategy.time_vs_none),
        (Some(ratio), _) => against(report, "frustum", Some(ratio)),
        (None, ratio) => against(report, "none", ratio),
    }
}

fn against(report: &Report, yardstick: &str, ratio: Option<f64>) -> SpeedSummary {
    let not_faster = |text| SpeedSummary {
        text,
        faster: false,
    };
    let Some(ratio) = ratio.filter(|r| *r > 0.0) else {
        return not_faster(format!("not measured against {yardstick}"));
    };
    if ratio.max(ratio.recip()) <= report.noise.least_ratio() {
        not_faster(format!("as fast as {yardstick}, within the noise"))
    } else if ratio < 1.0 {
        let factor = format::factor(ratio.recip());
        SpeedSummary {
            text: format!("{factor} times as fast as {yardstick}"),
            faster: true,
        }
    } else {
        let factor = format::factor(ratio);
        not_faster(format!("takes {factor} times as long as {yardstick}"))
    }
}
