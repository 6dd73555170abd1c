//! The trade-off of a sweep, speed against error: the Pareto front of the settings, and the setting to take under a limit of errors.
//!
//! A setting is on the front when no other is faster without more error (Vilfredo Pareto, "Manuale di economia politica", 1906). Reports call
//! the front the *efficient edge*. To choose a setting, one error gets a limit, and the fastest setting within it is taken: the
//! epsilon-constraint method of Yacov Haimes, Leon Lasdon and David Wismer, 1971. Errors are the same in every run, but times are not; so a
//! difference in speed counts only if it exceeds the noise of the run.
//!
//! Everything here is computed from a [`Report`].

use crate::report::{Report, Sweep, VariedSetting};

mod choice;
mod limit;
mod pareto;
mod sentences;
mod settings;
mod speed;
mod time_base;

pub use choice::choose;
pub use limit::ErrorLimit;
pub use pareto::pareto_front;
pub(crate) use pareto::{Cost, front};
pub use sentences::{ChoiceText, EDGE_LEGEND, choice_texts, sweep_title};
pub(crate) use time_base::TimeBase;

/// The results of a sweep of `strategies` (as they were requested) over `vary`: its Pareto front, and what each limit selects. The report's
/// own [`Report::sweep`] is not read.
///
/// ```no_run
/// # use antumbra_measure::{MeasureError, report::{Report, VariedSetting}, trade_off};
/// # fn main() -> Result<(), MeasureError> {
/// let mut report = Report::load("out/report.json")?;
/// let threshold = VariedSetting { strategy: None, key: "threshold".into(), values: vec!["1".into(), "4".into()] };
/// let limit = "wrong_pixels=0.05%".parse()?;
/// report.sweep = Some(trade_off::sweep(&report, vec!["three-pass".into()], vec![threshold], &[limit]));
/// # Ok(())
/// # }
/// ```
pub fn sweep(
    report: &Report,
    strategies: Vec<String>,
    vary: Vec<VariedSetting>,
    limits: &[ErrorLimit],
) -> Sweep {
    let front = pareto_front(report).into_iter();
    Sweep {
        strategies,
        vary,
        edge: front.map(|s| s.title().to_owned()).collect(),
        budgets: limits.iter().map(|limit| choose(report, *limit)).collect(),
    }
}
