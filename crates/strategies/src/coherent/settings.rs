//! The parameters of both coherent strategies: key, range, unit and description of each setting.

use antumbra_cull::{Latency, Parameter};

use super::CoherentSettings;

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
];
