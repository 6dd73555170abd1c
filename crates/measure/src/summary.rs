//! Sentences about a report: the speed and the errors of each strategy, and recommendations.

use crate::format;
use crate::report::{ErrorBasis, LostEntities, Report, StrategyReport};
use antumbra_cull::Role;

/// Most viewers of a moving image do not notice up to this share of wrong pixels (percent, mean, by [`Report::error_basis`]). [`recommendations`] use it.
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
    let basis = report.error_basis();
    let wrong = strategy.error.wrong(basis);
    let right = all_right(strategy);
    let mut text = text + ", ";
    text += &if right {
        "every pixel right".to_owned()
    } else if wrong.max == 0.0 && strategy.error.false_culls.entities > 0 {
        format::plural(strategy.error.false_culls.entities, "false cull")
    } else if wrong.max == 0.0 {
        "no wrong pixel".to_owned()
    } else {
        let (mean, max) = (format::percent(wrong.mean), format::percent(wrong.max));
        match basis {
            ErrorBasis::Image => {
                format!("{mean} % wrong pixels on average ({max} % in the worst frame)")
            }
            ErrorBasis::Owned => format!(
                "{mean} % of the pixels that entities own are wrong ({max} % in the worst frame)"
            ),
        }
    };
    if let Some(ties) = ties(strategy) {
        text = text + ", " + &ties;
    }
    if let Some(loss) = loss(strategy) {
        text = text + ", " + &loss;
    }
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

/// The pixels in which a strategy shows another entity of equal depth, in words; `None` without any.
fn ties(strategy: &StrategyReport) -> Option<String> {
    let percent = strategy.error.ties?.percent();
    (percent > 0.0).then(|| {
        let percent = format::percent(percent);
        format!("ties in {percent} % of the image (another entity of equal depth is shown)")
    })
}

/// What a strategy loses for good, in words; `None` where it loses nothing.
pub(crate) fn loss(strategy: &StrategyReport) -> Option<String> {
    let lost = strategy.lost.as_ref()?;
    let LostEntities {
        entities,
        of,
        named,
    } = lost;
    if *entities == 0 {
        return None;
    }
    let of = format::count(*of as f64);
    if draws_nothing(strategy) {
        return Some(format!("draws nothing of {of} visible entities"));
    }
    let more = match (*entities as usize).saturating_sub(named.len()) {
        0 => "",
        _ => ", ...",
    };
    let named: Vec<String> = named.iter().map(|name| format::short(name, 40)).collect();
    Some(format!(
        "never draws {} of {of} visible entities where they are visible ({}{more})",
        format::count(*entities as f64),
        named.join(", ")
    ))
}

/// Whether a strategy drew no entity although some were visible.
fn draws_nothing(strategy: &StrategyReport) -> bool {
    let visible = strategy.lost.as_ref().is_some_and(|lost| lost.of > 0);
    visible && strategy.drawn.entities == 0.0
}

/// Why a strategy is not recommended, in words; `None` for one that may be: it draws nothing, loses more than half of the visible entities for good, or more than
/// half of the pixels that entities own are wrong.
/// What a strategy loses that loses most of the scene: see [`withheld`].
pub(crate) fn loses_the_scene(strategy: &StrategyReport) -> Option<String> {
    let most = |lost: &LostEntities| 2 * lost.entities > lost.of;
    let owned = strategy.error.wrong_of_owned_percent;
    let wrong = owned.filter(|owned| owned.mean > 50.0).map(|owned| {
        let percent = format::percent(owned.mean);
        format!("{percent} % {} are wrong", ErrorBasis::Owned.words())
    });
    let lost = draws_nothing(strategy) || strategy.lost.as_ref().is_some_and(most);
    if !lost && wrong.is_none() {
        return None;
    }
    let reasons: Vec<String> = wrong.into_iter().chain(loss(strategy)).collect();
    Some(reasons.join(", "))
}

/// The strategies that are not recommended however fast they are, since they lose most of the scene: each with a sentence on that, without its name. They draw nothing,
/// lose more than half of the visible entities for good, or more than half of the pixels that entities own are wrong.
pub fn withheld(report: &Report) -> Vec<(&StrategyReport, String)> {
    let contenders = report.strategies.iter().filter(|s| !s.is_yardstick());
    contenders
        .filter_map(|s| Some((s, loses_the_scene(s)?)))
        .collect()
}

/// A line for each setting that follows the image, with the strategies that have it: "three-pass late, three-pass same: threshold 2 (follows the image)".
pub fn following(report: &Report) -> Vec<String> {
    let mut lines: Vec<(String, Vec<String>)> = Vec::new();
    for strategy in &report.strategies {
        let title = format::short(report.title_of(strategy), 64);
        for (key, value) in &strategy.follows_image {
            let setting = format::clean(&format!("{key} {value} (follows the image)"));
            match lines.iter_mut().find(|(known, _)| *known == setting) {
                Some((_, titles)) => titles.push(title.clone()),
                None => lines.push((setting, vec![title.clone()])),
            }
        }
    }
    let lines = lines.into_iter();
    lines
        .map(|(setting, titles)| format!("{}: {setting}", titles.join(", ")))
        .collect()
}

/// The fastest strategy without wrong pixels, the fastest with hardly any, and the fastest of all. Each strategy appears once, with its best
/// title. Yardsticks are left out, and so are those that lose the scene ([`withheld`]).
pub fn recommendations(report: &Report) -> Vec<Recommendation<'_>> {
    let basis = report.error_basis();
    let [hardly, hardly_of_all] = match basis {
        ErrorBasis::Image => [
            "Fastest with at most 0.1 % wrong pixels",
            "Fastest of all, with at most 0.1 % wrong pixels",
        ],
        ErrorBasis::Owned => [
            "Fastest with at most 0.1 % of the pixels that entities own wrong",
            "Fastest of all, with at most 0.1 % of the pixels that entities own wrong",
        ],
    };
    let criteria = [
        Criterion {
            title: "Fastest with every pixel right",
            title_of_all: "Fastest of all, and every pixel right",
            fits: |s, _| all_right(s),
        },
        Criterion {
            title: hardly,
            title_of_all: hardly_of_all,
            fits: hardly_wrong,
        },
        Criterion {
            title: "Fastest of all",
            title_of_all: "Fastest of all",
            fits: |_, _| true,
        },
    ];
    let fastest = |fits: fn(&StrategyReport, ErrorBasis) -> bool| {
        let runners = report
            .strategies
            .iter()
            .filter(|s| !s.is_yardstick() && loses_the_scene(s).is_none() && fits(s, basis));
        runners.min_by(|a, b| a.frame_ms.median.total_cmp(&b.frame_ms.median))
    };
    let of_all = fastest(|_, _| true);
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
    fits: fn(&StrategyReport, ErrorBasis) -> bool,
}

fn all_right(strategy: &StrategyReport) -> bool {
    let error = &strategy.error;
    error.wrong_pixels_percent.max == 0.0 && error.false_culls.entities == 0 && !error.culls_ties()
}

fn hardly_wrong(strategy: &StrategyReport, basis: ErrorBasis) -> bool {
    strategy.error.wrong(basis).mean <= UNNOTICED_PERCENT
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
