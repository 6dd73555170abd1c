//! The strategies that a comparison measures: the standard selection, or those given with `--strategies`.

use std::sync::Arc;

use antumbra::cull::{AuditOptions, Latency, Registry, Strategy};
use antumbra::measure::compare::Contender;
use antumbra::terrain::HorizonStrategy;

use crate::args::CompareArgs;
use crate::failure::Failure;
use crate::fixed_setting::{FixedSetting, fixed_settings, with_fixed};
use crate::strategies::{identity, name_of, registry};

/// Above this number of occludees the standard selection leaves `stop-and-wait` out. It waits for each occludee, which then takes minutes.
const MOST_AWAITED: usize = 500;

/// The standard selection: labels and specifications. An empty label stands for the strategy's name.
const STANDARD: [(&str, &str); 13] = [
    ("", "none"),
    ("", "frustum"),
    ("", "ideal"),
    ("", "stop-and-wait"),
    ("three-pass late", "three-pass:latency=frame-late"),
    ("three-pass same", "three-pass:latency=same-frame"),
    ("three-pass on-gpu", "three-pass:latency=on-gpu"),
    (
        "three-pass coarser",
        "three-pass:latency=on-gpu:coarser=1000",
    ),
    ("map late", "occupancy-map:latency=frame-late"),
    ("map same", "occupancy-map:latency=same-frame"),
    ("coherent late", "coherent:latency=frame-late"),
    ("coherent same", "coherent:latency=same-frame"),
    (
        "three-pass exact",
        "three-pass:latency=same-frame:threshold=0:scale=1:occluders=full:occludees=full",
    ),
];

/// What two views add to the standard selection.
const STEREO: [(&str, &str); 3] = [
    ("stereo late", "stereo-coherent:latency=frame-late"),
    ("stereo same", "stereo-coherent:latency=same-frame"),
    (
        "stereo half",
        "stereo-coherent:latency=same-frame:fraction=0.5",
    ),
];

/// What a terrain adds to the standard selection.
const TERRAIN: [(&str, &str); 1] = [("", "horizon")];

/// What the contenders depend on besides the arguments. The default serves to check the arguments before a scene is loaded.
#[derive(Debug, Default, Clone, Copy)]
pub struct Conditions<'a> {
    /// The number of occludees in a frame, all views together.
    pub occludees: usize,
    /// Whether a frame has two views, one for each eye.
    pub stereo: bool,
    /// The strategy of the scene's terrain; `None` for a scene without one.
    pub horizon: Option<&'a HorizonStrategy>,
}

/// The contenders of a comparison, and notes about them.
pub struct Contenders {
    /// The contenders, in the order of the report.
    pub list: Vec<Contender>,
    /// Notes to print, such as which strategy is left out and why.
    pub notes: Vec<String>,
}

/// The contenders that the arguments select. Checks the strategies and settings; draws nothing.
///
/// # Errors
/// [`Failure::Registry`] for a strategy or setting that does not exist, with those that exist; [`Failure::Usage`] for a `--set` that is not
/// `STRATEGY.KEY=VALUE`.
pub fn contenders(args: &CompareArgs, conditions: Conditions<'_>) -> Result<Contenders, Failure> {
    let registry = Arc::new(registry(conditions.horizon));
    let fixed = fixed_settings(&args.set, &registry)?;
    let mut notes = Vec::new();
    let entries = match args.strategies.is_empty() {
        true => standard(conditions, &mut notes),
        false => args
            .strategies
            .iter()
            .map(|spec| Entry::given(spec))
            .collect(),
    };
    let mut list = Vec::new();
    let mut seen = Vec::new();
    for entry in entries {
        let entry = entry.with_settings(&fixed, args.latency, &registry)?;
        let strategy = registry.parse(&entry.spec)?;
        let identity = identity(strategy.as_ref());
        if !seen.contains(&identity) {
            seen.push(identity);
            list.extend(runs(&entry, strategy.as_ref(), args, &registry)?);
        }
    }
    Ok(Contenders { list, notes })
}

/// A strategy to compare.
struct Entry {
    /// Its label in tables; an empty one stands for the strategy's name.
    label: String,
    /// Its specification, `NAME:key=value`.
    spec: String,
}

impl Entry {
    /// An entry of `--strategies`. A specification with settings is its own label.
    fn given(spec: &str) -> Self {
        let label = match spec.contains(':') {
            true => spec.to_owned(),
            false => String::new(),
        };
        Self {
            label,
            spec: spec.to_owned(),
        }
    }

    /// Adds the fixed settings of its strategy, and the latency if the strategy has that setting.
    fn with_settings(
        self,
        fixed: &[FixedSetting],
        latency: Option<Latency>,
        registry: &Registry,
    ) -> Result<Self, Failure> {
        let spec = with_fixed(&self.spec, fixed);
        let settings = registry.parse(&spec)?.settings();
        let has_latency = settings.iter().any(|setting| setting.key == "latency");
        let Some(latency) = latency.filter(|_| has_latency) else {
            return Ok(Self { spec, ..self });
        };
        // Most labels name the latency that is replaced; those that end with "exact" do not.
        let label = match self.label.ends_with("exact") {
            true => self.label,
            false => String::new(),
        };
        let spec = format!("{spec}:latency={latency}");
        Ok(Self { label, spec })
    }
}

/// The standard selection under these conditions. Adds a note for a strategy that is left out.
fn standard(conditions: Conditions<'_>, notes: &mut Vec<String>) -> Vec<Entry> {
    let stereo: &[_] = if conditions.stereo { &STEREO } else { &[] };
    let terrain: &[_] = match conditions.horizon {
        Some(_) => &TERRAIN,
        None => &[],
    };
    let occludees = conditions.occludees;
    let mut entries = Vec::new();
    for (label, spec) in STANDARD.iter().chain(stereo).chain(terrain) {
        if *spec == "stop-and-wait" && occludees > MOST_AWAITED {
            notes.push(format!(
                "stop-and-wait is left out: it would wait for {occludees} answers a frame, one by one. Ask for it with --strategies"
            ));
            continue;
        }
        entries.push(Entry {
            label: (*label).to_owned(),
            spec: (*spec).to_owned(),
        });
    }
    entries
}

/// The runs of an entry: with its settings, with an audit, and within each budget. A yardstick runs only with its settings.
fn runs(
    entry: &Entry,
    strategy: &dyn Strategy,
    args: &CompareArgs,
    registry: &Arc<Registry>,
) -> Result<Vec<Contender>, Failure> {
    let run = |label: &str| Contender::of(label, registry, &entry.spec);
    let title = match entry.label.as_str() {
        "" => name_of(&entry.spec),
        label => label,
    };
    let mut runs = vec![run(&entry.label)?];
    if strategy.role().is_yardstick() {
        return Ok(runs);
    }
    let usual = AuditOptions::default();
    let audit = args.audit.map(|share| AuditOptions {
        share: share.unwrap_or(usual.share),
        ..usual
    });
    if let Some(audit) = audit {
        runs.push(run(&format!("{title} audited"))?.audited(audit));
    }
    // A budget chooses among the steps.
    if strategy.steps().is_empty() {
        return Ok(runs);
    }
    for budget in &args.budget {
        let within = run(&format!("{title} within {budget}"))?.within(*budget);
        runs.push(match audit {
            Some(audit) => within.audited(audit),
            None => within,
        });
    }
    Ok(runs)
}
