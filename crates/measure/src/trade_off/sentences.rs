//! Sentences about the settings that error limits select.

use super::settings::settings;
use crate::report::{
    Aggregate, Choice, ErrorMeasure, LimitChoices, Report, RunnerUp, StrategyReport, Sweep,
};
use crate::{format, summary};

/// The explanation of the mark on settings of the efficient edge.
pub const EDGE_LEGEND: &str = "* efficient edge: no other setting is faster, beyond the noise, \
                              without more wrong pixels on average.";

/// One choice, in sentences.
#[derive(Debug, Clone, PartialEq)]
pub struct ChoiceText<'a> {
    /// For example "Fastest with at most 0.05 % wrong pixels on average".
    pub heading: String,
    /// The selected setting.
    pub setting: &'a StrategyReport,
    /// Whether it is within the limit.
    pub within: bool,
    /// Its speed and error, and how significant its lead is; one sentence each, without the setting's name.
    pub lines: Vec<String>,
}

/// A sweep in one line: "sweep of three-pass over threshold = 0, 1, 4".
pub fn sweep_title(sweep: &Sweep) -> String {
    let varied: Vec<String> = sweep
        .vary
        .iter()
        .map(|varied| {
            let of = varied.strategy.iter().map(|name| format!("{name}."));
            let values = varied.values.join(", ");
            format!("{}{} = {values}", of.collect::<String>(), varied.key)
        })
        .collect();
    format::clean(&format!(
        "sweep of {} over {}",
        sweep.strategies.join(", "),
        varied.join("; ")
    ))
}

/// The choices of all limits of a report's sweep, in order; empty for a report without a sweep or without limits.
pub fn choice_texts(report: &Report) -> Vec<ChoiceText<'_>> {
    let limits = report.sweep.iter().flat_map(|sweep| &sweep.budgets);
    let choices = limits.flat_map(|limit| limit.choices.iter().map(move |choice| (limit, choice)));
    choices
        .filter_map(|(limit, choice)| choice_text(report, limit, choice))
        .collect()
}

fn choice_text<'a>(
    report: &'a Report,
    limit: &LimitChoices,
    choice: &Choice,
) -> Option<ChoiceText<'a>> {
    let setting = titled(report, &choice.setting)?;
    // No error on average means no error in any frame, so the second choice would repeat the first.
    let none = limit.limit == 0.0;
    if none && choice.over == Aggregate::Max {
        return None;
    }
    let most = error(limit.measure, limit.limit);
    let over = over(choice.over);
    let heading = match (choice.within, none) {
        (true, true) => format!("Fastest with {most}"),
        (true, false) => format!("Fastest with at most {most}{over}"),
        (false, true) => format!("No setting has {most}; nearest"),
        (false, false) => format!("No setting has at most {most}{over}; nearest"),
    };
    let used = if none || choice.error == 0.0 {
        String::new()
    } else {
        let share = 100.0 * choice.error / limit.limit;
        format!(", {} % of the limit", format::percent(share))
    };
    let speed = summary::speed(report, setting).text;
    let mut lines = vec![format!(
        "{speed}, {}{used}",
        error(limit.measure, choice.error)
    )];
    lines.extend(summary::loss(setting));
    if choice.within {
        lines.extend(certainty(report, choice));
    }
    Some(ChoiceText {
        heading,
        setting,
        within: choice.within,
        lines,
    })
}

/// Sentences about the settings that are as fast, and about the next slower one.
fn certainty(report: &Report, choice: &Choice) -> Vec<String> {
    let noise = match report.noise.frame_time_ratio_p95 {
        Some(ratio) => format!("the noise of {} %", format::percent((ratio - 1.0) * 100.0)),
        None => "noise that was not measured".to_owned(),
    };
    let shown = |title: &String| match titled(report, title) {
        Some(setting) => format::clean(report.title_of(setting)),
        None => format::clean(title),
    };
    let mut lines = Vec::new();
    if !choice.alike.is_empty() {
        let alike: Vec<String> = choice.alike.iter().map(shown).collect();
        lines.push(format!(
            "as fast, within {noise}, but no less wrong: {}",
            alike.join(", ")
        ));
    }
    match (&choice.next, &choice.fastest) {
        (Some(next), Some(fastest)) => {
            let than = if *fastest == choice.setting {
                String::new()
            } else {
                format!(" as {}", shown(fastest))
            };
            lines.push(format!(
                "slower, beyond {noise}: {} takes {} times as long{than}{}",
                shown(&next.setting),
                format::ratio(next.time_ratio),
                blocks(next)
            ));
        }
        _ if settings(report).count() > choice.alike.len() + 1 => {
            lines.push("all others are beyond the limit".to_owned());
        }
        _ => {}
    }
    lines
}

/// ", slower in 6 of 6 blocks (by chance 1 time in 64)".
fn blocks(next: &RunnerUp) -> String {
    let (Some(slower), Some(all), Some(chance)) = (next.slower_blocks, next.blocks, next.by_chance)
    else {
        return String::new();
    };
    let chance = match chance.recip() {
        times if times < 3.0 => "chance alone does as much".to_owned(),
        times if times < 1e6 => format!("by chance 1 time in {}", format::count(times.round())),
        _ => "by chance hardly ever".to_owned(),
    };
    format!(
        ", slower in {} of {} ({chance})",
        format::count(slower as f64),
        format::plural(all, "block")
    )
}

/// "0.05 % wrong pixels", "no false cull", "a FLIP of 0.01".
fn error(measure: ErrorMeasure, error: f64) -> String {
    match measure {
        ErrorMeasure::WrongPixelsPercent if error == 0.0 => "no wrong pixel".to_owned(),
        ErrorMeasure::WrongPixelsPercent => format!("{} % wrong pixels", format::percent(error)),
        ErrorMeasure::WrongOfOwnedPercent if error == 0.0 => "no wrong pixel".to_owned(),
        ErrorMeasure::WrongOfOwnedPercent => format!(
            "{} % of the pixels that entities own wrong",
            format::percent(error)
        ),
        ErrorMeasure::FalseCulls if error == 0.0 => "no false cull".to_owned(),
        ErrorMeasure::FalseCulls => format::plural(error as u64, "false cull"),
        ErrorMeasure::Flip => format!("a FLIP of {}", format::flip(error)),
    }
}

fn over(over: Aggregate) -> &'static str {
    match over {
        Aggregate::Mean => " on average",
        Aggregate::Max => " in the worst frame",
        Aggregate::Sum => " in all frames",
    }
}

fn titled<'a>(report: &'a Report, title: &str) -> Option<&'a StrategyReport> {
    report.strategies.iter().find(|s| s.title() == title)
}
