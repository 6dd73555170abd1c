//! The settings of both coherent strategies: fields, parameters (key, range, unit, description), and steps from accurate to fast.

use antumbra_cull::guard::GuardOptions;
use antumbra_cull::{
    Counting, DeclareError, FrameGraph, Latency, Parameter, Setting, SettingError, Step, Tunable,
    Value, assign, describe,
};

use super::fraction::FractionRule;

/// The settings of both strategies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CoherentSettings {
    /// When the answers of the queries are used.
    pub latency: Latency,
    /// The part of the occluded entities that is tested a frame: above 0, at most 1. Below 1 an entity may appear late.
    pub fraction: f64,
    /// Entities that may be late on average. The fraction grows as far as that needs. 0: the fraction is fixed.
    pub late: f64,
    /// Camera motion after which the visible entities are sorted again, as a part of the distance to the middle one of their list.
    pub resort: f64,
    /// Most occluded entities that share a query. Where it finds a sample, all of them are drawn, and the next frame queries each on its own.
    /// 1: no sharing, as in the paper.
    pub together: u32,
    /// How far the eye goes a frame, for late answers that hide nothing that has come into view meanwhile.
    pub guard: GuardOptions,
}

impl Default for CoherentSettings {
    fn default() -> Self {
        Self {
            latency: Latency::FrameLate,
            fraction: 1.0,
            late: 0.0,
            resort: 0.01,
            together: 8,
            guard: GuardOptions::OFF,
        }
    }
}

impl CoherentSettings {
    /// How the fraction of a frame is found.
    pub(super) fn fraction_rule(self) -> FractionRule {
        FractionRule {
            least: self.fraction,
            late: self.late,
        }
    }

    /// The same with all occluded entities tested: a view after the first needs no fraction (section 3.2).
    pub(super) fn testing_all(self) -> Self {
        Self {
            fraction: 1.0,
            late: 0.0,
            ..self
        }
    }

    /// Refuses settings that contradict each other, and what the device cannot do.
    pub(super) fn check(self, strategy: &str, g: &FrameGraph<'_>) -> Result<(), DeclareError> {
        if self.latency == Latency::OnGpu && self.late > 0.0 {
            return Err(DeclareError::Settings {
                strategy: strategy.to_owned(),
                conflict: "a fraction that adapts needs answers on the host: set late to 0, or latency to frame-late or same-frame".to_owned(),
            });
        }
        if self.latency != Latency::OnGpu {
            return Ok(());
        }
        // The owners of pixels are read from entity ids, and the others are counted.
        let (gpu, samples) = (g.gpu(), g.samples());
        let ways = [Counting::Identity, Counting::by_fragments(gpu, samples)];
        let lacking = ways.iter().find_map(|way| way.lacking(gpu, samples));
        match lacking {
            None => Ok(()),
            Some(lacking) => Err(DeclareError::Device {
                strategy: strategy.to_owned(),
                lacking: lacking.to_owned(),
                instead: "set latency to frame-late or same-frame, or draw one sample a pixel"
                    .to_owned(),
            }),
        }
    }

    /// Whether no visible entity is culled.
    pub(super) fn conservative(self) -> bool {
        match self.latency {
            Latency::FrameLate => self.guard.is_on(),
            Latency::SameFrame | Latency::OnGpu => self.fraction >= 1.0,
        }
    }
}

impl Tunable for CoherentSettings {
    fn settings(&self) -> Vec<Setting> {
        describe(PARAMETERS, self)
    }

    fn set(&mut self, key: &str, value: &Value) -> Result<(), SettingError> {
        assign("coherent", PARAMETERS, self, key, value)
    }

    /// From all of the occluded entities tested to a twentieth of them.
    fn steps(&self) -> Vec<Step> {
        let current = match self.latency {
            Latency::SameFrame => Latency::SameFrame,
            Latency::FrameLate | Latency::OnGpu => Latency::OnGpu,
        };
        let step = |latency: Latency, fraction: f64| {
            Step::of([
                ("late", 0u32.into()),
                ("latency", latency.word().into()),
                ("fraction", fraction.into()),
            ])
        };
        let mut steps = vec![step(current, 1.0)];
        if self.latency == Latency::FrameLate {
            steps.push(step(self.latency, 1.0));
        }
        let parts = [0.7, 0.5, 0.35, 0.2, 0.1, 0.05];
        steps.extend(parts.map(|part| step(self.latency, part)));
        steps
    }
}

pub(super) const PARAMETERS: &[Parameter<CoherentSettings>] = &[
    Parameter::words(
        "latency",
        Latency::WORDS,
        "when the answers are used",
        |s| s.latency.word(),
        |s, at| s.latency = Latency::ALL[at],
    ),
    Parameter::number_above(
        "fraction",
        0.0,
        1.0,
        "",
        "part of the occluded entities that is tested a frame; the rest stays occluded",
        |s| s.fraction,
        |s, part| s.fraction = part,
    ),
    Parameter::number(
        "late",
        0.0..=1_000_000.0,
        "entities",
        "entities that may appear late, on average: the fraction grows as far as that needs; 0: the fraction is fixed",
        |s| s.late,
        |s, entities| s.late = entities,
    ),
    Parameter::number(
        "resort",
        0.0..=10.0,
        "",
        "camera motion after which the visible entities are sorted again, as a part of the distance to the middle one of their list",
        |s| s.resort,
        |s, part| s.resort = part,
    ),
    Parameter::whole(
        "together",
        1..=256,
        "entities",
        "most entities that share a query while they stay occluded; 1: each has its own",
        |s| s.together,
        |s, entities| s.together = entities,
    ),
    Parameter::number(
        "guard",
        GuardOptions::METRES,
        "m",
        GuardOptions::METRES_MEAN,
        |s| s.guard.metres,
        |s, metres| s.guard.metres = metres,
    ),
    Parameter::number(
        "guard-turn",
        GuardOptions::DEGREES,
        "degrees",
        GuardOptions::DEGREES_MEAN,
        |s| s.guard.degrees,
        |s, degrees| s.guard.degrees = degrees,
    ),
];
