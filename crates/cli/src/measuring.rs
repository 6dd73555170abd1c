//! Runs a comparison for the commands that need one, with its progress on the terminal.

use antumbra::cull::Gpu;
use antumbra::measure::compare::{CompareOptions, Comparison, Contender, Script, compare_scripted};

use crate::args::ViewArgs;
use crate::failure::Failure;
use crate::input::{FaceLenses, Input};
use crate::progress::Bars;

/// Compares the contenders on the input, lenses rotated to face each pose. The report has the command line and the seeds.
///
/// # Errors
/// What stopped it; nothing was written.
pub fn measure(
    gpu: &Gpu,
    mut input: Input,
    contenders: &[Contender],
    view: &ViewArgs,
) -> Result<Comparison, Failure> {
    let options = CompareOptions {
        size: input.size,
        samples: input.samples,
        stereo: input.stereo,
        command: command_line(),
        scene_name: input.name,
        ..CompareOptions::default()
    };
    let mut bars = Bars::new(view.quiet);
    let mut lenses = input.sections.as_mut().map(FaceLenses);
    let mut nothing = ();
    let script: &mut dyn Script = match &mut lenses {
        Some(lenses) => lenses,
        None => &mut nothing,
    };
    let comparison = compare_scripted(
        gpu,
        &mut input.scene,
        script,
        &input.path,
        contenders,
        &options,
        &mut |progress| bars.show(progress),
    );
    bars.finish();
    let mut comparison = comparison?;
    let seeds = &mut comparison.report.seeds;
    seeds.insert("path".to_owned(), view.seed);
    if let Some(seed) = input.scene_seed {
        seeds.insert("scene".to_owned(), seed);
    }
    Ok(comparison)
}

/// What was typed, from the program's name on.
fn command_line() -> String {
    let words = std::env::args().skip(1).map(|word| {
        if word.contains(' ') {
            format!("'{word}'")
        } else {
            word
        }
    });
    std::iter::once("antumbra".to_owned())
        .chain(words)
        .collect::<Vec<_>>()
        .join(" ")
}
