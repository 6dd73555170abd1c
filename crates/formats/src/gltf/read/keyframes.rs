//! The keyframes of a sampler.

use super::accessor::Accessor;
use super::document::Document;
use crate::budget::Budget;
use crate::error::LoadProblem;
use antumbra_scene::animation::{Interpolation, Keyframes};
use gltf::json::accessor::{ComponentType, Type};
use gltf::json::animation::{Interpolation as Named, Sampler};
use gltf::json::validation::Checked;

/// Why a channel is not played.
pub(super) enum ChannelLoss {
    /// It is left out.
    LeftOut {
        /// A few words.
        reason: String,
        /// More words, about this channel alone.
        detail: Option<String>,
    },
    /// The file is refused.
    Refused(Box<LoadProblem>),
}

impl ChannelLoss {
    /// It is left out for this reason.
    pub(super) fn reason(reason: impl Into<String>) -> Self {
        Self::LeftOut {
            reason: reason.into(),
            detail: None,
        }
    }
}

/// What is wrong with a channel's accessors costs the channel, unless they exceed the limits.
fn unreadable(problem: LoadProblem) -> ChannelLoss {
    match problem {
        LoadProblem::TooMuchWork { .. } | LoadProblem::TooMuchMemory(_) => refused(problem),
        _ => ChannelLoss::LeftOut {
            reason: "its keyframes cannot be read".to_owned(),
            detail: Some(problem.to_string()),
        },
    }
}

/// What exceeds the limits of the load costs the file.
fn refused(problem: LoadProblem) -> ChannelLoss {
    ChannelLoss::Refused(Box::new(problem))
}

/// The value of a key as accessors have it.
#[derive(Clone, Copy)]
pub(super) struct KeyShape {
    pub(super) element: Type,
    /// The elements of a value.
    pub(super) rows: usize,
}

/// Reads keys of this shape.
pub(super) fn read(
    document: &Document<'_>,
    sampler: &Sampler,
    shape: KeyShape,
    budget: &mut Budget,
) -> Result<Keyframes, ChannelLoss> {
    let interpolation = match sampler.interpolation {
        Checked::Valid(Named::Step) => Interpolation::Step,
        Checked::Valid(Named::Linear) => Interpolation::Linear,
        Checked::Valid(Named::CubicSpline) => Interpolation::CubicSpline,
        Checked::Invalid => {
            return Err(ChannelLoss::reason("its interpolation is not known"));
        }
    };
    let mut open = |index: usize, user: &str| Accessor::open(document, index, user, budget);
    let times = open(sampler.input.value(), "the times of keyframes").map_err(unreadable)?;
    let values = open(sampler.output.value(), "the values of keyframes").map_err(unreadable)?;
    let fits = times.shape == Type::Scalar && times.component == ComponentType::F32;
    times.expect(fits, "times").map_err(unreadable)?;
    let KeyShape { element, rows } = shape;
    let fits = values.shape == element && values.component != ComponentType::U32;
    values
        .expect(fits, "the values of this channel")
        .map_err(unreadable)?;
    let components = element.multiplicity();
    let each = (rows as u64).saturating_mul(interpolation.values_per_key() as u64);
    if values.count as u64 != (times.count as u64).saturating_mul(each) {
        let reason = "its times and values are not as many";
        return Err(ChannelLoss::reason(reason));
    }
    let numbers = (values.count as u64).saturating_mul(components as u64);
    let numbers = numbers.saturating_add(times.count as u64);
    budget.work(numbers).map_err(refused)?;
    let bytes = numbers.saturating_mul(size_of::<f32>() as u64);
    budget.memory(bytes).map_err(refused)?;
    let seconds = (0..times.count).map(|key| times.numbers::<1>(key)[0]);
    let mut all = Vec::with_capacity(values.count * components);
    for element in 0..values.count {
        let numbers = values.numbers::<4>(element);
        all.extend(numbers.into_iter().take(components));
    }
    let keyframes = Keyframes::new(interpolation, seconds.collect(), all, rows * components);
    keyframes.map_err(|problem| ChannelLoss::reason(problem.to_string()))
}
