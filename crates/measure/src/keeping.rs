//! What strategies said of their own wrong pixels, and how well budgets were kept, in words: for the terminal and the page.

use crate::report::{AuditReport, BudgetReport, Over, Report, StrategyReport};
use crate::trade::Budget;
use crate::{stats, words};

/// Of one strategy.
#[derive(Debug, Clone, PartialEq)]
pub struct Kept<'a> {
    /// Whose.
    pub strategy: &'a StrategyReport,
    /// What is to be said, a sentence each, without full stops.
    pub lines: Vec<String>,
}

/// What the title of an audited strategy ends with; the same title without it is the strategy that is not.
const AUDITED: &str = " audited";

/// A sentence or more for each strategy that was audited or had a budget.
pub fn kept(report: &Report) -> Vec<Kept<'_>> {
    let all = report.strategies.iter().map(|strategy| Kept {
        strategy,
        lines: lines(report, strategy),
    });
    all.filter(|kept| !kept.lines.is_empty()).collect()
}

fn lines(report: &Report, strategy: &StrategyReport) -> Vec<String> {
    let StrategyReport { audit, budget, .. } = strategy;
    let speed = budget
        .as_ref()
        .and_then(|budget| of_the_best(report, strategy, budget));
    let budget = budget.as_ref().map(|budget| of_budget(strategy, budget));
    let audit = audit.as_ref().map(|audit| of_audit(strategy, audit));
    let cost = cost(report, strategy);
    budget
        .into_iter()
        .chain(speed)
        .chain(audit)
        .chain(cost)
        .collect()
}

fn of_audit(strategy: &StrategyReport, audit: &AuditReport) -> String {
    format!(
        "by its own audit {} % of the pixels are wrong ({} to {}), in truth {} %; of {} frames {} % held the truth within their interval; {} patches a frame",
        words::percent(audit.percent),
        words::percent(audit.low),
        words::percent(audit.high),
        words::percent(strategy.error.wrong_pixels_percent.mean),
        audit.frames,
        words::percent(audit.frames_within as f64 / audit.frames.max(1) as f64 * 100.0),
        words::count(audit.patches),
    )
}

fn of_budget(strategy: &StrategyReport, budget: &BudgetReport) -> String {
    let stood: Vec<String> = budget
        .frames_a_step
        .iter()
        .map(|frames| frames.to_string())
        .collect();
    let came = match budget.kept {
        Some(true) => format!(
            "kept with {} % wrong pixels on average",
            words::percent(strategy.error.wrong_pixels_percent.mean)
        ),
        Some(false) => format!(
            "overdrawn with {} % wrong pixels on average",
            words::percent(strategy.error.wrong_pixels_percent.mean)
        ),
        None => format!(
            "a frame took {} ms, half of them less",
            words::milliseconds(strategy.frame_ms.median)
        ),
    };
    format!(
        "{}: {came}; frames on its steps, the most accurate first: {}",
        budget.asked,
        stood.join(", ")
    )
}

/// How fast it was beside the best that fixed settings could do within the same budget, which is known only afterwards: of those of the same strategy and latency
/// in this run. By the sums of all frames.
fn of_the_best(
    report: &Report,
    strategy: &StrategyReport,
    budget: &BudgetReport,
) -> Option<String> {
    let limit: Budget = budget.asked.parse().ok()?;
    let fits = |one: &&StrategyReport| {
        let fixed = one.budget.is_none() && one.audit.is_none();
        let alike = one.name == strategy.name && one.latency == strategy.latency;
        let error = limit.measure().of(&one.error, Over::Mean);
        fixed && alike && error.is_some_and(|error| error <= limit.limit())
    };
    let time = |one: &StrategyReport| stats::mean(&one.frames.frame_ms).ok();
    let timed = report.strategies.iter().filter(fits);
    let timed = timed.filter_map(|one| Some((one, time(one)?)));
    let (best, _) = timed.min_by(|(_, a), (_, b)| a.total_cmp(b))?;
    let (own, other) = (&strategy.frames.frame_ms, &best.frames.frame_ms);
    let block = report.noise.block_frames.unwrap_or(1) as usize;
    let (ratio, error) = stats::ratio_of_sums(other, own, block).ok()?;
    Some(format!(
        "{:.0} % of the speed of {}, the fastest of the fixed settings that were within it (+- {:.0}, one standard error over blocks)",
        ratio * 100.0,
        best.title(),
        error * 100.0
    ))
}

/// What an audit costs: the time beside that of the same strategy without, where that was measured in the same run.
fn cost(report: &Report, audited: &StrategyReport) -> Option<String> {
    let title = audited.title().strip_suffix(AUDITED)?;
    let plain = report.strategies.iter().find(|one| one.title() == title)?;
    // Of all frames: a median would not notice what few of them pay.
    let (own, other) = (&audited.frames.frame_ms, &plain.frames.frame_ms);
    let (ratio, _) = stats::ratio_of_sums(own, other, 1).ok()?;
    Some(format!(
        "the audit takes {} % of a frame's time ({} ms in its passes), where differences below {} % show nothing",
        words::percent((ratio - 1.0) * 100.0),
        words::milliseconds(audited.audit_ms.unwrap_or(0.0)),
        words::percent((report.noise.least_ratio() - 1.0) * 100.0),
    ))
}
