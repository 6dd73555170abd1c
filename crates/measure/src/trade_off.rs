//! The trade of a sweep: speed against error, the settings worth having, and the one to take under
//! a budget of errors.
//!
//! A setting is worth having when no other is both faster and no worse in error: such settings are
//! the *efficient edge*, Vilfredo Pareto's front ("Manuale di economia politica", 1906). A choice
//! among them is what the literature calls an epsilon-constraint (Yacov Haimes, Leon Lasdon and
//! David Wismer, 1971): the errors get a limit, and the fastest setting that keeps it is taken.
//! Errors are counted and the same in every run; times are not, so that both ask of a difference
//! in speed that it exceeds the noise of the run.
//!
//! Everything here reads a [`Report`] and nothing else.

use crate::report::{Report, StrategyReport, Sweep, VariedSetting};

mod choice;
mod limit;
mod pareto;
mod sentences;
mod speed;
mod time_base;

pub use choice::choose;
pub use limit::ErrorLimit;
pub(crate) use pareto::front;
pub use pareto::pareto_front;
pub use sentences::{ChoiceText, EDGE_LEGEND, choice_texts, sweep_title};
pub(crate) use time_base::TimeBase;

/// What a report says of a sweep of `strategies` (as they were asked for) over `vary`: its edge and
/// what each budget chooses. The report's own [`Report::sweep`] plays no part.
///
/// ```no_run
/// # use antumbra_measure::{MeasureError, report::{Report, VariedSetting}, trade_off};
/// # fn main() -> Result<(), MeasureError> {
/// let mut report = Report::load("out/report.json")?;
/// let threshold = VariedSetting { strategy: None, key: "threshold".into(), values: vec!["1".into(), "4".into()] };
/// let budget = "wrong_pixels=0.05%".parse()?;
/// report.sweep = Some(trade_off::sweep(&report, vec!["three-pass".into()], vec![threshold], &[budget]));
/// # Ok(())
/// # }
/// ```
pub fn sweep(
    report: &Report,
    strategies: Vec<String>,
    vary: Vec<VariedSetting>,
    budgets: &[ErrorLimit],
) -> Sweep {
    let edge = pareto_front(report).into_iter();
    Sweep {
        strategies,
        vary,
        edge: edge.map(|s| s.title().to_owned()).collect(),
        budgets: budgets.iter().map(|b| choose(report, *b)).collect(),
    }
}

/// The settings of a sweep: what is no yardstick, and was timed.
fn settings(report: &Report) -> impl Iterator<Item = (&StrategyReport, f64)> {
    let clock = TimeBase::of(report);
    let measured = report.strategies.iter().filter(|s| !s.is_yardstick());
    measured.filter_map(move |s| Some((s, clock.time(s)?)))
}
