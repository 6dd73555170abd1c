//! Progress bars on standard error. They are hidden where it is not a terminal.

use std::time::Duration;

use antumbra::measure::compare::CompareProgress;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// The progress of a comparison: one bar, which begins again with each phase.
pub struct Bars {
    bar: ProgressBar,
    phase: &'static str,
}

impl Bars {
    /// An empty bar; a hidden one if `quiet`.
    pub fn new(quiet: bool) -> Self {
        Self {
            bar: bar("{msg:>14} {bar:40} {pos}/{len} frames, {eta} left", quiet),
            phase: "",
        }
    }

    /// Shows the progress.
    pub fn show(&mut self, progress: CompareProgress) {
        if self.phase != progress.phase {
            self.phase = progress.phase;
            self.bar.reset();
            self.bar.set_message(progress.phase);
        }
        self.bar.set_length(progress.total);
        self.bar.set_position(progress.done);
    }

    /// Removes the bar from the terminal.
    pub fn finish(self) {
        self.bar.finish_and_clear();
    }
}

/// A bar for one piece of work, which `what` names; a hidden one if `quiet`. Work that takes no time shows no bar.
pub fn work(what: &'static str, quiet: bool) -> ProgressBar {
    let bar = bar("{msg:>14} {bar:40} {percent}%, {eta} left", quiet);
    bar.set_message(what);
    bar
}

/// A sign of life for work whose end is not known: what it does and for how long; a hidden one if `quiet`.
pub fn spin(what: &'static str, quiet: bool) -> ProgressBar {
    let bar = bar("{msg:>14} {spinner} {elapsed}", quiet);
    bar.set_message(what);
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}

/// Shows how much of a bar's work is done, out of how much.
pub fn count(bar: &ProgressBar) -> impl Fn(u64, u64) {
    |done, total| {
        bar.set_length(total);
        bar.set_position(done);
    }
}

fn bar(template: &str, quiet: bool) -> ProgressBar {
    let target = match quiet {
        true => ProgressDrawTarget::hidden(),
        false => ProgressDrawTarget::stderr(),
    };
    let bar = ProgressBar::with_draw_target(Some(1), target);
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style);
    }
    bar
}
