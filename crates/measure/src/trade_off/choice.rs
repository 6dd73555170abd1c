//! The setting to take under an error limit: the fastest within it.

use super::limit::ErrorLimit;
use super::settings::{TimedSetting, settings};
use super::speed::SpeedComparison;
use crate::report::{Aggregate, Choice, LimitChoices, Report, StrategyReport};
use crate::summary::loses_the_scene;

/// A setting with its time and the limited error.
#[derive(Clone, Copy)]
struct Candidate<'a> {
    setting: &'a StrategyReport,
    time: f64,
    error: f64,
}

/// Selects settings for a limit: one for the mean and one for the worst pose; for false culls, one for their sum.
///
/// The selected setting is the fastest within the limit. Where others are not significantly slower, it is the one of them with the least
/// error. Where no setting is within the limit, it is the setting with the least error. A limit of wrong pixels goes by [`Report::error_basis`]. What loses most of the scene is no choice
/// ([`withheld`](crate::summary::withheld)). A report without other measured settings gets none.
pub fn choose(report: &Report, limit: ErrorLimit) -> LimitChoices {
    let speeds = SpeedComparison::of(report);
    let limit = limit.in_report(report);
    let choices = limit.measure().aggregates().iter();
    LimitChoices {
        measure: limit.measure(),
        limit: limit.limit(),
        choices: choices
            .filter_map(|over| choice(report, &speeds, limit, *over))
            .collect(),
    }
}

fn choice(
    report: &Report,
    speeds: &SpeedComparison,
    limit: ErrorLimit,
    over: Aggregate,
) -> Option<Choice> {
    let mut candidates: Vec<Candidate<'_>> = settings(report)
        .filter(|timed| loses_the_scene(timed.setting).is_none())
        .filter_map(|TimedSetting { setting, time }| {
            let error = limit.measure().of(&setting.error, over)?;
            Some(Candidate {
                setting,
                time,
                error,
            })
        })
        .collect();
    candidates.sort_by(|a, b| a.time.total_cmp(&b.time));
    let named = |chosen: Candidate<'_>| Choice {
        over,
        setting: chosen.setting.title().to_owned(),
        within: chosen.error <= limit.limit(),
        error: chosen.error,
        margin: limit.limit() - chosen.error,
        fastest: None,
        alike: Vec::new(),
        next: None,
    };
    let within = candidates.iter().copied();
    let within = within.filter(|candidate| candidate.error <= limit.limit());
    let within: Vec<Candidate<'_>> = within.collect();
    let Some(fastest) = within.first().copied() else {
        return least_error(&candidates).map(named);
    };
    let (slower, alike): (Vec<_>, Vec<_>) = within
        .into_iter()
        .partition(|candidate| speeds.faster(fastest.setting, candidate.setting));
    let chosen = least_error(&alike)?;
    let others = alike.iter().map(|candidate| candidate.setting);
    let next = slower.first();
    Some(Choice {
        fastest: Some(fastest.setting.title().to_owned()),
        alike: others
            .filter(|other| !std::ptr::eq(*other, chosen.setting))
            .map(|other| other.title().to_owned())
            .collect(),
        next: next.and_then(|next| speeds.runner_up(next.setting, fastest.setting)),
        ..named(chosen)
    })
}

/// The candidate with the least error; in a tie the first, which is the fastest.
fn least_error<'a>(candidates: &[Candidate<'a>]) -> Option<Candidate<'a>> {
    candidates
        .iter()
        .copied()
        .min_by(|a, b| a.error.total_cmp(&b.error))
}
