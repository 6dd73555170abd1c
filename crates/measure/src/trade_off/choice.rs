//! The setting to take under a budget: the fastest that stays within it.

use super::limit::ErrorLimit;
use super::settings;
use super::speed::SpeedComparison;
use crate::report::{Aggregate, Choice, LimitChoices, Report, StrategyReport};

/// A setting with its time and the error that is limited.
#[derive(Clone, Copy)]
struct Candidate<'a> {
    setting: &'a StrategyReport,
    time: f64,
    error: f64,
}

/// Chooses for a budget: for the mean and for the worst pose, false culls for their sum.
///
/// Of the settings within the budget it is the fastest; where others are as fast, as far as the noise
/// can tell, the one of them with the least error. Where no setting stays within the budget, the one
/// with the least error is named as the nearest. A report in which no setting was measured gets no
/// choices.
pub fn choose(report: &Report, budget: ErrorLimit) -> LimitChoices {
    let race = SpeedComparison::of(report);
    let choices = budget.measure().overs().iter();
    LimitChoices {
        measure: budget.measure(),
        limit: budget.limit(),
        choices: choices
            .filter_map(|over| choice(report, &race, budget, *over))
            .collect(),
    }
}

fn choice(
    report: &Report,
    race: &SpeedComparison,
    budget: ErrorLimit,
    over: Aggregate,
) -> Option<Choice> {
    let mut candidates: Vec<Candidate<'_>> = settings(report)
        .filter_map(|(setting, time)| {
            let error = budget.measure().of(&setting.error, over)?;
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
        within: chosen.error <= budget.limit(),
        error: chosen.error,
        margin: budget.limit() - chosen.error,
        fastest: None,
        alike: Vec::new(),
        next: None,
    };
    let within = candidates.iter().copied();
    let within = within.filter(|candidate| candidate.error <= budget.limit());
    let within: Vec<Candidate<'_>> = within.collect();
    let Some(fastest) = within.first().copied() else {
        return least_wrong(&candidates).map(named);
    };
    let (slower, alike): (Vec<_>, Vec<_>) = within
        .into_iter()
        .partition(|candidate| race.faster(fastest.setting, candidate.setting));
    let chosen = least_wrong(&alike)?;
    let others = alike.iter().map(|candidate| candidate.setting);
    let next = slower.first();
    Some(Choice {
        fastest: Some(fastest.setting.title().to_owned()),
        alike: others
            .filter(|other| !std::ptr::eq(*other, chosen.setting))
            .map(|other| other.title().to_owned())
            .collect(),
        next: next.and_then(|next| race.runner_up(next.setting, fastest.setting)),
        ..named(chosen)
    })
}

/// The least error; of equals the first, which is the fastest.
fn least_wrong<'a>(candidates: &[Candidate<'a>]) -> Option<Candidate<'a>> {
    candidates
        .iter()
        .copied()
        .min_by(|a, b| a.error.total_cmp(&b.error))
}
