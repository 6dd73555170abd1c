//! Progress on a terminal; silence in a pipe.

use antumbra::measure::compare::CompareProgress;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// A bar a phase.
pub struct Bars {
    bar: ProgressBar,
    phase: &'static str,
}

impl Bars {
    /// Bars on standard error where that is a terminal, unless `quiet`.
    pub fn new(quiet: bool) -> Self {
        let target = if quiet {
            ProgressDrawTarget::hidden()
        } else {
            ProgressDrawTarget::stderr()
        };
        let bar = ProgressBar::with_draw_target(Some(1), target);
        if let Ok(style) =
            ProgressStyle::with_template("{msg:>14} {bar:40} {pos}/{len} frames, {eta} left")
        {
            bar.set_style(style);
        }
        Self { bar, phase: "" }
    }

    /// Shows how far it is.
    pub fn show(&mut self, progress: CompareProgress) {
        if self.phase != progress.phase {
            self.phase = progress.phase;
            self.bar.reset();
            self.bar.set_message(progress.phase);
        }
        self.bar.set_length(progress.total);
        self.bar.set_position(progress.done);
    }

    /// Takes the bar away.
    pub fn finish(self) {
        self.bar.finish_and_clear();
    }
}

/// A bar for one kind of work, on standard error where that is a terminal and `quiet` is not asked for. Work that takes no time shows none.
pub fn work(what: &'static str, quiet: bool) -> ProgressBar {
    let target = if quiet {
        ProgressDrawTarget::hidden()
    } else {
        ProgressDrawTarget::stderr()
    };
    let bar = ProgressBar::with_draw_target(Some(1), target);
    if let Ok(style) = ProgressStyle::with_template("{msg:>14} {bar:40} {percent}%, {eta} left") {
        bar.set_style(style);
    }
    bar.set_message(what);
    bar
}
