//! `antumbra strategies`: each strategy's promise, idea and settings.

use antumbra::cull::{Setting, Strategy};

use crate::args::StrategiesArgs;
use crate::failure::Failure;
use crate::print::print;
use crate::strategies::registry;

/// The narrowest and the widest text.
const WIDTHS: (usize, usize) = (60, 110);

/// Lists one strategy or all.
///
/// # Errors
/// [`Failure::Registry`] for an unknown name, with the known ones.
pub fn run(args: StrategiesArgs) -> Result<(), Failure> {
    let registry = registry(None);
    let names = match &args.name {
        Some(name) => vec![name.as_str()],
        None => registry.names().collect(),
    };
    let width = textwrap::termwidth().clamp(WIDTHS.0, WIDTHS.1);
    let pages = names.into_iter().map(|name| {
        let strategy = registry.make(name)?;
        Ok(page(strategy.as_ref(), width))
    });
    print(pages.collect::<Result<Vec<_>, Failure>>()?.join("\n\n"))
}

/// A strategy in lines of at most `width` characters.
fn page(strategy: &dyn Strategy, width: usize) -> String {
    let promise = match strategy.conservative() {
        true => "conservative as set by default: draws every entity that owns a pixel",
        false => "aggressive as set by default: may cull an entity that owns a pixel",
    };
    let mut lines = vec![strategy.name().to_owned()];
    lines.extend(wrapped(strategy.summary(), 2, width));
    lines.extend(wrapped(promise, 2, width));
    let settings = strategy.settings();
    if settings.is_empty() {
        lines.push("  no settings".to_owned());
        return lines.join("\n");
    }
    let widest = |cell: fn(&Setting) -> String, title: &str| {
        let cells = settings.iter().map(cell).chain([title.to_owned()]);
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let key = widest(|setting| setting.key.to_owned(), "setting");
    let value = widest(|setting| setting.value.to_string(), "default");
    let row = |left: &str, middle: &str| format!("  {left:key$}  {middle:value$}  ");
    let indent = row("", "").chars().count();
    lines.push(String::new());
    lines.push(format!(
        "{}range, and what it does",
        row("setting", "default")
    ));
    for setting in &settings {
        let range = match setting.unit {
            "" => setting.range.to_string(),
            unit => format!("{} {unit}", setting.range),
        };
        let range = wrapped(&range, indent, width);
        let meaning = wrapped(setting.meaning, indent, width);
        let mut cells = range.into_iter().chain(meaning);
        if let Some(first) = cells.next() {
            let start = row(setting.key, &setting.value.to_string());
            lines.push(format!("{start}{}", first.trim_start()));
        }
        lines.extend(cells);
    }
    lines.join("\n")
}

/// The lines of a text, each of at most `width` characters and after `indent` spaces.
fn wrapped(text: &str, indent: usize, width: usize) -> Vec<String> {
    let indent = " ".repeat(indent);
    let options = textwrap::Options::new(width)
        .initial_indent(&indent)
        .subsequent_indent(&indent)
        .break_words(false);
    textwrap::wrap(text, options)
        .into_iter()
        .map(|line| line.into_owned())
        .collect()
}
