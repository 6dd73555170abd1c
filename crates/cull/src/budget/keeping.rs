//! A budget at work: the controller says where to stand, and the strategy is set to it.

use super::error::ErrorKeeper;
use super::time::TimeKeeper;
use super::{Budget, BudgetState};
use crate::audit::FrameAudit;
use crate::latency::Latency;
use crate::strategy::{DeclareError, Strategy};
use crate::tuning::{Step, Value};

/// A budget that is kept.
#[derive(Debug)]
pub(crate) struct Keeping {
    keeper: Keeper,
    steps: Vec<Step>,
    /// What the strategy was set to by its user.
    user: Vec<(&'static str, Value)>,
    at: BudgetState,
}

/// Who keeps it.
#[derive(Debug)]
enum Keeper {
    Error(ErrorKeeper),
    Time(TimeKeeper),
}

impl Keeping {
    /// Puts the strategy on the step to begin with. `may_wait`: frames may have sync points; steps that need one are left out where they may not.
    pub fn new(
        budget: Budget,
        strategy: &mut dyn Strategy,
        may_wait: bool,
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
            // It keeps any budget of errors as it is.
            steps.push(Step::default());
        }
        let mut fit = Vec::with_capacity(steps.len());
        for step in steps {
            for (key, value) in user.iter().chain(&step.settings) {
                set(strategy, key, value)?;
            }
            let waits = strategy.latency() == Some(Latency::SameFrame);
            if may_wait || !waits {
                fit.push((step, strategy.conservative()));
            }
        }
        if !fit.first().is_some_and(|(_, conservative)| *conservative) {
            let why =
                "its conservative step waits within the frame, and this frame is somebody else's";
            return Err(refused(strategy, why));
        }
        let steps: Vec<Step> = fit.into_iter().map(|(step, _)| step).collect();
        let keeper = match budget {
            Budget::WrongPixels(percent) => Keeper::Error(ErrorKeeper::new(percent, &steps)),
            Budget::FrameTime(time) => Keeper::Time(TimeKeeper::new(time, &steps)),
        };
        let mut keeping = Self {
            keeper,
            steps,
            user,
            at: BudgetState::default(),
        };
        keeping.at = keeping.wanted();
        keeping.apply(strategy)?;
        Ok(keeping)
    }

    /// Where it stands, and the settings of that step.
    pub fn state(&self) -> Option<(BudgetState, &Step)> {
        Some((self.at, self.steps.get(self.at.step)?))
    }

    /// Takes in what the audit found in a frame; `now` is the next frame's number.
    pub fn note_audit(&mut self, found: &FrameAudit, now: u64) {
        if let Keeper::Error(keeper) = &mut self.keeper {
            keeper.note(found, now);
        }
    }

    /// Takes in a frame's milliseconds.
    pub fn note_time(&mut self, milliseconds: f64) {
        if let Keeper::Time(keeper) = &mut self.keeper {
            keeper.note(milliseconds);
        }
    }

    fn wanted(&self) -> BudgetState {
        match &self.keeper {
            Keeper::Error(keeper) => keeper.state(),
            Keeper::Time(keeper) => keeper.state(),
        }
    }

    /// Goes where the controller wants to stand; whether the strategy has to be declared anew.
    pub fn follow(&mut self, strategy: &mut dyn Strategy) -> Result<bool, DeclareError> {
        let wanted = self.wanted();
        let before = std::mem::replace(&mut self.at, wanted);
        if wanted.step != before.step {
            self.apply(strategy)?;
            return Ok(true);
        }
        if wanted.allow != before.allow {
            self.turn_dial(strategy)?;
        }
        Ok(false)
    }

    fn apply(&self, strategy: &mut dyn Strategy) -> Result<(), DeclareError> {
        let step = self.steps.get(self.at.step);
        let settings = step.map_or(&[][..], |step| &step.settings);
        for (key, value) in self.user.iter().chain(settings) {
            set(strategy, key, value)?;
        }
        self.turn_dial(strategy)
    }

    fn turn_dial(&self, strategy: &mut dyn Strategy) -> Result<(), DeclareError> {
        match self.steps.get(self.at.step).and_then(|step| step.dial) {
            Some(dial) => {
                let allow = self.at.allow.clamp(LEAST, 100.0);
                set(strategy, dial, &Value::Number(allow))
            }
            None => Ok(()),
        }
    }
}

/// Where a dial stands that allows nothing, in percent of the image: above 0, so that the plan has what the dial turns, and below a pixel of any image.
const LEAST: f64 = 1e-9;

fn set(strategy: &mut dyn Strategy, key: &str, value: &Value) -> Result<(), DeclareError> {
    strategy
        .set(key, value)
        .map_err(|error| DeclareError::Settings {
            strategy: strategy.name().to_owned(),
            conflict: format!("a step of its own cannot be set: {error}"),
        })
}
