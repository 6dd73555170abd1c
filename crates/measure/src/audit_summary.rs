//! Sentences on audits and budgets: what strategies estimated of their own wrong pixels, and whether they kept their budgets. For the
//! terminal and the page.

use crate::report::{Aggregate, AuditReport, BudgetReport, ErrorBasis, Report, StrategyReport};
use crate::trade_off::ErrorLimit;
use crate::{format, stats};

/// What one strategy's audit and budget came to.
#[derive(Debug, Clone, PartialEq)]
pub struct AuditSummary<'a> {
    /// The strategy.
    pub strategy: &'a StrategyReport,
    /// A sentence each, without full stops.
    pub lines: Vec<String>,
}

/// The summaries of all strategies that were audited or had a budget, in the report's order.
pub fn audit_summaries(report: &Report) -> Vec<AuditSummary<'_>> {
    let all = report.strategies.iter().map(|strategy| AuditSummary {
        strategy,
        lines: lines(report, strategy),
    });
    all.filter(|summary| !summary.lines.is_empty()).collect()
}

fn lines(report: &Report, strategy: &StrategyReport) -> Vec<String> {
    let StrategyReport { audit, budget, .. } = strategy;
    let speed = budget
        .as_ref()
        .and_then(|budget| speed_of_best(report, strategy, budget));
    let budget = budget.as_ref().map(|budget| budget_line(strategy, budget));
    let audit = audit.as_ref().map(|audit| audit_line(strategy, audit));
    let cost = audit_cost(report, strategy);
    budget
        .into_iter()
        .chain(speed)
        .chain(audit)
        .chain(cost)
        .collect()
}

/// " (12 % of the pixels that entities own)"; nothing in old reports.
fn of_owned(strategy: &StrategyReport) -> String {
    let owned = strategy.error.wrong_of_owned_percent;
    owned.map_or_else(String::new, |owned| {
        let percent = format::percent(owned.mean);
        format!(" ({percent} % {})", ErrorBasis::Owned.words())
    })
}

fn audit_line(strategy: &StrategyReport, audit: &AuditReport) -> String {
    format!(
        "by its own audit {} % of the pixels are wrong ({} to {}), in truth {} %{}; of {} frames {} % held the truth within their interval; {} patches a frame",
        format::percent(audit.percent),
        format::percent(audit.low),
        format::percent(audit.high),
        format::percent(strategy.error.wrong_pixels_percent.mean),
        of_owned(strategy),
        audit.frames,
        format::percent(audit.frames_within as f64 / audit.frames.max(1) as f64 * 100.0),
        format::count(audit.patches),
    )
}

fn budget_line(strategy: &StrategyReport, budget: &BudgetReport) -> String {
    let frames: Vec<String> = budget
        .frames_a_step
        .iter()
        .map(|frames| frames.to_string())
        .collect();
    let wrong = format::percent(strategy.error.wrong_pixels_percent.mean);
    let owned = of_owned(strategy);
    let outcome = match (budget.kept, budget.kept_of_owned) {
        (Some(true), Some(false)) => {
            format!(
                "kept as a share of the image with {wrong} % wrong pixels on average{owned}; not kept as a share of the pixels that entities own"
            )
        }
        (Some(true), _) => format!("kept with {wrong} % wrong pixels on average{owned}"),
        (Some(false), _) => format!("overdrawn with {wrong} % wrong pixels on average{owned}"),
        (None, _) => format!(
            "a frame took {} ms, half of them less",
            format::milliseconds(strategy.frame_ms.median)
        ),
    };
    format!(
        "{}: {outcome}; frames on its steps, the most accurate first: {}",
        budget.asked,
        frames.join(", ")
    )
}

/// The speed against the best that fixed settings achieved within the same budget, by the sums of all frames. The best is known only
/// after the run; it is looked for among the entries of the same strategy and latency.
fn speed_of_best(
    report: &Report,
    strategy: &StrategyReport,
    budget: &BudgetReport,
) -> Option<String> {
    let limit: ErrorLimit = budget.asked.parse().ok()?;
    let fits = |one: &&StrategyReport| {
        let fixed = one.budget.is_none() && one.audit.is_none();
        let alike = one.name == strategy.name && one.latency == strategy.latency;
        let error = limit.measure().of(&one.error, Aggregate::Mean);
        fixed && alike && error.is_some_and(|error| error <= limit.limit())
    };
    let time = |one: &StrategyReport| stats::mean(&one.frames.frame_ms).ok();
    let timed = report.strategies.iter().filter(fits);
    let timed = timed.filter_map(|one| Some((one, time(one)?)));
    let (best, _) = timed.min_by(|(_, a), (_, b)| a.total_cmp(b))?;
    let (own, other) = (&strategy.frames.frame_ms, &best.frames.frame_ms);
    let block = report.noise.block_frames.unwrap_or(1) as usize;
    let speed = stats::ratio_of_sums(other, own, block).ok()?;
    Some(format!(
        "{:.0} % of the speed of {}, the fastest of the fixed settings that were within it (+- {:.0}, one standard error over blocks)",
        speed.ratio * 100.0,
        best.title(),
        speed.standard_error * 100.0
    ))
}

/// The time of an audited entry against that of the same strategy and settings without the audit, where this run measured both.
fn audit_cost(report: &Report, audited: &StrategyReport) -> Option<String> {
    let plain = report.without_audit(audited)?;
    // Sums of all frames: only a few frames pay for an audit, and a median would not show them.
    let (own, other) = (&audited.frames.frame_ms, &plain.frames.frame_ms);
    let cost = stats::ratio_of_sums(own, other, 1).ok()?;
    Some(format!(
        "the audit takes {} % of a frame's time ({} ms in its passes), where differences below {} % show nothing",
        format::percent((cost.ratio - 1.0) * 100.0),
        format::milliseconds(audited.audit_ms.unwrap_or(0.0)),
        format::percent((report.noise.least_ratio() - 1.0) * 100.0),
    ))
}
