//! Which strategies a comparison compares.

use std::sync::Arc;

use antumbra::cull::{AuditOptions, Strategy};
use antumbra::measure::compare::Contender;
use antumbra::terrain::HorizonStrategy;

use crate::args::CompareArgs;
use crate::failure::Failure;
use crate::strategies::registry;

/// Waiting for each of more occludees than this takes minutes: only when asked for.
const PATIENCE: usize = 500;

/// What is compared when nothing is asked for: label, then the strategy.
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

/// What is compared beside it with two eyes.
const STEREO: [(&str, &str); 3] = [
    ("stereo late", "stereo-coherent:latency=frame-late"),
    ("stereo same", "stereo-coherent:latency=same-frame"),
    (
        "stereo half",
        "stereo-coherent:latency=same-frame:fraction=0.5",
    ),
];

/// The contenders and what is said about them.
pub struct Contenders {
    /// In order.
    pub list: Vec<Contender>,
    /// For the person at the terminal.
    pub notes: Vec<String>,
}

/// Reads the arguments; all of them are checked before anything is drawn. `occludees` are those of a frame, all views together;
/// `stereo`: there are two.
///
/// # Errors
/// [`Failure::Registry`] for a strategy or setting that does not exist, with what exists; [`Failure::Usage`] for a `--set` without a dot.
pub fn contenders(
    args: &CompareArgs,
    occludees: usize,
    stereo: bool,
    horizon: Option<&HorizonStrategy>,
) -> Result<Contenders, Failure> {
    let registry = Arc::new(registry(horizon));
    let mut notes = Vec::new();
    let mut specs: Vec<(String, String)> = Vec::new();
    if args.strategies.is_empty() {
        let stereo: &[(&str, &str)] = if stereo { &STEREO } else { &[] };
        let own: &[(&str, &str)] = if horizon.is_some() {
            &[("", "horizon")]
        } else {
            &[]
        };
        for (label, spec) in STANDARD.iter().chain(stereo).chain(own).copied() {
            if spec == "stop-and-wait" && occludees > PATIENCE {
                notes.push(format!(
                    "stop-and-wait is left out: it would wait for {occludees} answers a frame, one by one. Ask for it with --strategies"
                ));
            } else {
                specs.push((label.to_owned(), spec.to_owned()));
            }
        }
    } else {
        specs.extend(args.strategies.iter().map(|spec| {
            (
                if spec.contains(':') {
                    spec.clone()
                } else {
                    String::new()
                },
                spec.clone(),
            )
        }));
    }
    let sets = args
        .set
        .iter()
        .map(|set| split_set(set))
        .collect::<Result<Vec<_>, _>>()?;
    for (name, ..) in &sets {
        registry.make(name)?;
    }
    let mut list: Vec<Contender> = Vec::new();
    let mut seen: Vec<String> = Vec::new();
    for (label, spec) in specs {
        let name = spec.split(':').next().unwrap_or_default().to_owned();
        let mut spec = spec;
        for (_, key, value) in sets.iter().filter(|(of, ..)| *of == name) {
            spec = format!("{spec}:{key}={value}");
        }
        let asks = registry
            .parse(&spec)?
            .settings()
            .iter()
            .any(|setting| setting.key == "latency");
        let mut label = label;
        if let Some(latency) = args.latency.filter(|_| asks) {
            spec = format!("{spec}:latency={latency}");
            label = if label.ends_with("exact") {
                label
            } else {
                String::new()
            };
        }
        let strategy = registry.parse(&spec)?;
        let identity = identity(strategy.as_ref());
        if seen.contains(&identity) {
            continue;
        }
        seen.push(identity);
        let made = |label: &str| Contender::of(label, &registry, &spec);
        let title = match label.as_str() {
            "" => name.clone(),
            label => label.to_owned(),
        };
        list.push(made(&label)?);
        if strategy.role().is_yardstick() {
            continue;
        }
        let usual = AuditOptions::default();
        let audit = args.audit.map(|share| AuditOptions {
            share: share.unwrap_or(usual.share),
            ..usual
        });
        if let Some(audit) = audit {
            list.push(made(&format!("{title} audited"))?.audited(audit));
        }
        if strategy.steps().is_empty() {
            continue;
        }
        for budget in &args.budget {
            let within = made(&format!("{title} within {budget}"))?.within(*budget);
            list.push(match audit {
                Some(audit) => within.audited(audit),
                None => within,
            });
        }
    }
    Ok(Contenders { list, notes })
}

/// Two entries with the same settings are one.
pub fn identity(strategy: &dyn Strategy) -> String {
    let settings: Vec<String> = strategy
        .settings()
        .iter()
        .map(|setting| format!("{}={}", setting.key, setting.value))
        .collect();
    format!("{} {}", strategy.name(), settings.join(" "))
}

/// Reads `STRATEGY.KEY=VALUE`.
///
/// # Errors
/// [`Failure::Usage`] for anything else.
pub fn split_set(text: &str) -> Result<(String, String, String), Failure> {
    let parts = text
        .split_once('=')
        .and_then(|(left, value)| left.split_once('.').map(|(name, key)| (name, key, value)));
    match parts {
        Some((name, key, value)) => Ok((name.to_owned(), key.to_owned(), value.to_owned())),
        None => Err(Failure::Usage(format!(
            "'{text}' is no setting: write STRATEGY.KEY=VALUE"
        ))),
    }
}
