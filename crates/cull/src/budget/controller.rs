//! Applies a budget: the controller chooses a step, and the strategy's settings follow.

use antumbra_graph::Mode;

use super::error::ErrorController;
use super::time::TimeController;
use super::{Budget, BudgetState};
use crate::audit::FrameAudit;
use crate::latency::Latency;
use crate::stage::Rebuilt;
use crate::strategy::{DeclareError, Strategy};
use crate::tuning::{Step, Value};

/// A budget at work.
#[derive(Debug)]
pub(crate) struct BudgetController {
    goal: Goal,
    steps: Vec<Step>,
    /// The user's settings.
    user: Vec<(&'static str, Value)>,
    at: BudgetState,
}

/// The controller of each kind of budget.
#[derive(Debug)]
enum Goal {
    Error(ErrorController),
    Time(TimeController),
}

impl BudgetController {
    /// Puts the strategy on its first step. In [`Mode::Embedded`] steps that need a sync point are left out.
    pub fn new(
        budget: Budget,
        strategy: &mut dyn Strategy,
        mode: Mode,
    ) -> Result<Self, DeclareError> {
        let settings = strategy.settings().into_iter();
        let user: Vec<_> = settings
            .map(|setting| (setting.key, setting.value))
            .collect();
        let refused = |strategy: &dyn Strategy, why: &str| DeclareError::Settings {
            strategy: strategy.name().to_owned(),
            conflict: format!("it cannot keep {budget}: {why}; leave the budget out"),
        };
        let mut steps = strategy.steps();
        if steps.is_empty() {
            if !strategy.conservative() {
                let why =
                    "it is set to be aggressive, and has no steps to trade accuracy for speed";
                return Err(refused(strategy, why));
            }
            // A conservative strategy keeps any budget of errors.
            steps.push(Step::default());
        }
        let mut fit = Vec::with_capacity(steps.len());
        for step in steps {
            for (key, value) in user.iter().chain(&step.settings) {
                set(strategy, key, value)?;
            }
            let waits = strategy.latency() == Some(Latency::SameFrame);
            if mode == Mode::Owned || !waits {
                fit.push((step, strategy.conservative()));
            }
        }
        if !fit.first().is_some_and(|(_, conservative)| *conservative) {
            let why = "it has no conservative step to begin with (a step that waits within the frame cannot run in a host's)";
            return Err(refused(strategy, why));
        }
        let steps: Vec<Step> = fit.into_iter().map(|(step, _)| step).collect();
        let goal = match budget {
            Budget::WrongPixels(percent) => Goal::Error(ErrorController::new(percent, &steps)),
            Budget::FrameTime(time) => Goal::Time(TimeController::new(time, &steps)),
        };
        let mut controller = Self {
            goal,
            steps,
            user,
            at: BudgetState::default(),
        };
        controller.at = controller.wanted();
        controller.apply(controller.at, strategy)?;
        Ok(controller)
    }

    /// The present step and dial, and the settings of that step.
    pub fn state(&self) -> Option<(BudgetState, &Step)> {
        Some((self.at, self.steps.get(self.at.step)?))
    }

    /// Adds the audit's result for a frame; `now` is the next frame's number.
    pub fn note_audit(&mut self, found: &FrameAudit, now: u64) {
        if let Goal::Error(goal) = &mut self.goal {
            goal.note(found, now);
        }
    }

    /// Adds a frame's time in milliseconds.
    pub fn note_time(&mut self, milliseconds: f64) {
        if let Goal::Time(goal) = &mut self.goal {
            goal.note(milliseconds);
        }
    }

    /// Notes that there is another plan: the time of the frame that compiled it says nothing of the step, and times of another size of image nothing of any.
    pub fn note_rebuilt(&mut self, rebuilt: Rebuilt) {
        if let Goal::Time(goal) = &mut self.goal {
            match rebuilt {
                Rebuilt::Size | Rebuilt::Scene => goal.forget(),
                Rebuilt::Layout => goal.settle(),
                // The controller's own doing: it settles anyway.
                Rebuilt::Step | Rebuilt::Resumed | Rebuilt::Distrust => {}
            }
        }
    }

    fn wanted(&self) -> BudgetState {
        match &self.goal {
            Goal::Error(goal) => goal.state(),
            Goal::Time(goal) => goal.state(),
        }
    }

    /// Puts the strategy on the step and the dial that the controller wants. On failure the state stays, so that the next frame tries again.
    pub fn follow(&mut self, strategy: &mut dyn Strategy) -> Result<(), DeclareError> {
        let wanted = self.wanted();
        if wanted.step != self.at.step {
            self.apply(wanted, strategy)?;
        } else if wanted.allow != self.at.allow {
            self.turn_dial(wanted, strategy)?;
        }
        self.at = wanted;
        Ok(())
    }

    fn apply(&self, wanted: BudgetState, strategy: &mut dyn Strategy) -> Result<(), DeclareError> {
        let step = self.steps.get(wanted.step);
        let settings = step.map_or(&[][..], |step| &step.settings);
        for (key, value) in self.user.iter().chain(settings) {
            set(strategy, key, value)?;
        }
        self.turn_dial(wanted, strategy)
    }

    fn turn_dial(
        &self,
        wanted: BudgetState,
        strategy: &mut dyn Strategy,
    ) -> Result<(), DeclareError> {
        match self.steps.get(wanted.step).and_then(|step| step.dial) {
            Some(dial) => {
                let allow = wanted.allow.clamp(LEAST, 100.0);
                set(strategy, dial, &Value::Number(allow))
            }
            None => Ok(()),
        }
    }
}

/// The dial's value for "nothing", in percent of the image: above 0, so that the plan has the node that the dial controls, and below a pixel of any image.
const LEAST: f64 = 1e-9;

fn set(strategy: &mut dyn Strategy, key: &str, value: &Value) -> Result<(), DeclareError> {
    strategy
        .set(key, value)
        .map_err(|error| DeclareError::Settings {
            strategy: strategy.name().to_owned(),
            conflict: format!("a step of its own cannot be set: {error}"),
        })
}
