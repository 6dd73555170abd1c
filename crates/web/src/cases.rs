//! What stages are made of: every registered strategy, with each latency, each way of counting and each word of its other settings, and for those of note, several kinds of stage.

use antumbra_cull::{Setting, SettingRange, Strategy, Value};
use antumbra_strategies::registry;

/// A strategy with settings, and what its stage is made for.
#[derive(Debug, Clone)]
pub(crate) struct CaseSpec {
    /// As the registry parses it.
    pub strategy: String,
    pub kind: StageKind,
}

/// What a stage is made for, beside one image of one sample a pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum StageKind {
    Plain,
    FourSamples,
    Audited,
    AuditedFourSamples,
    TwoEyes,
    Answers,
    Timed,
}

impl StageKind {
    pub const ALL: [Self; 7] = [
        Self::Plain,
        Self::FourSamples,
        Self::Audited,
        Self::AuditedFourSamples,
        Self::TwoEyes,
        Self::Answers,
        Self::Timed,
    ];

    pub fn name(self) -> &'static str {
        match self {
            Self::Plain => "plain",
            Self::FourSamples => "4 samples",
            Self::Audited => "audited",
            Self::AuditedFourSamples => "audited, 4 samples",
            Self::TwoEyes => "two eyes",
            Self::Answers => "answers alone",
            Self::Timed => "timed",
        }
    }

    pub fn samples(self) -> u32 {
        match self {
            Self::FourSamples | Self::AuditedFourSamples => 4,
            _ => 1,
        }
    }
}

/// What numbers are worth a case of their own, since they add nodes: strategy, setting and value.
const NUMBERS: &[[&str; 3]] = &[
    ["three-pass", "allow", "1"],
    ["three-pass", "coarser", "200"],
];

/// Every strategy with each latency and each way of counting, other settings as they are by default.
pub(crate) fn ways() -> Vec<String> {
    let mut ways = Vec::new();
    let registry = registry();
    for name in registry.names() {
        let Ok(strategy) = registry.make(name) else {
            continue;
        };
        let settings = settings(strategy.as_ref());
        let of = |key: &str| {
            let setting = settings.iter().find(|setting| setting.key == key);
            let words = setting.map(words).unwrap_or_default();
            let written = words.iter().map(|word| format!(":{key}={word}"));
            match words.is_empty() {
                true => vec![String::new()],
                false => written.collect(),
            }
        };
        for latency in of("latency") {
            ways.extend(of("counting").iter().map(|way| match way.as_str() {
                // Queries do not count.
                ":counting=queries" => format!("{name}{latency}{way}:threshold=0"),
                _ => format!("{name}{latency}{way}"),
            }));
        }
    }
    ways
}

/// [`ways`] in a plain stage.
pub(crate) fn plain() -> Vec<CaseSpec> {
    let plain = ways().into_iter().map(|strategy| CaseSpec {
        strategy,
        kind: StageKind::Plain,
    });
    plain.collect()
}

/// Every case: [`ways`] in each kind of stage, and each of them with each word of each other setting in a plain one. What waits, and what counts in a way that says no more than others, is
/// tried once.
pub(crate) fn all() -> Vec<CaseSpec> {
    let mut all = plain();
    let registry = registry();
    for way in ways() {
        if way.contains("same-frame") || is_counted_elsewhere(&way) {
            continue;
        }
        let kinds = StageKind::ALL.into_iter().skip(1);
        all.extend(kinds.map(|kind| CaseSpec {
            strategy: way.clone(),
            kind,
        }));
        let Ok(strategy) = registry.parse(&way) else {
            continue;
        };
        let more = settings(strategy.as_ref());
        let more = more
            .iter()
            .filter(|setting| !["latency", "counting", "sketch"].contains(&setting.key));
        let words = more.flat_map(|setting| {
            let others = words(setting).into_iter();
            let others = others.filter(|word| *word != setting.value.to_string());
            others.map(|word| format!("{way}:{}={word}", setting.key))
        });
        let name = strategy.name();
        let numbers = NUMBERS.iter().filter(|[of, ..]| *of == name);
        let numbers = numbers.map(|[_, key, value]| format!("{way}:{key}={value}"));
        all.extend(words.chain(numbers).map(|strategy| CaseSpec {
            // A rival's pyramid has a shader of its own for several samples.
            kind: match strategy.contains("like=niagara") {
                true => StageKind::FourSamples,
                false => StageKind::Plain,
            },
            strategy,
        }));
    }
    all
}

/// Kinds of stages and other settings are tried with two ways of counting: `auto` is one of them.
fn is_counted_elsewhere(way: &str) -> bool {
    let tried = [":counting=compare", ":counting=identity"];
    way.contains(":counting=") && !tried.iter().any(|counting| way.contains(counting))
}

fn settings(strategy: &dyn Strategy) -> Vec<Setting> {
    let tuning = strategy.tuning();
    tuning.map(|tuning| tuning.settings()).unwrap_or_default()
}

/// The words that a setting takes; none for a number.
fn words(setting: &Setting) -> Vec<String> {
    match &setting.range {
        SettingRange::Words(words) => words.iter().map(|word| (*word).to_owned()).collect(),
        SettingRange::Switch => [true, false].map(|on| Value::from(on).to_string()).into(),
        _ => Vec::new(),
    }
}
