//! `antumbra compare`: the main job.

use antumbra::draw::Gpu;
use antumbra::measure::compare::{CompareOptions, Script, compare_scripted};
use antumbra::measure::table::{Table, facts, wants_colour};
use antumbra::measure::verdict::picks;

use crate::args::CompareArgs;
use crate::contenders::contenders;
use crate::failure::Failure;
use crate::input::{FaceLenses, Input};
use crate::progress::Bars;

/// Compares, writes the report, prints the table and where the report lies.
///
/// # Errors
/// What stopped it; nothing half-written stays behind.
pub fn run(args: CompareArgs) -> Result<(), Failure> {
    // Wrong words are found before anything is loaded.
    contenders(&args, 0, false, None)?;
    let gpu = Gpu::open(&args.view.adapter)?;
    let mut input = Input::open(&args.view, &gpu)?;
    // Each eye asks for itself.
    let occludees = input.scene.drawable_count() * input.views().len();
    let contenders = contenders(
        &args,
        occludees,
        input.stereo.is_some(),
        input.horizon.as_ref(),
    )?;
    let options = CompareOptions {
        size: input.size,
        stereo: input.stereo,
        command: command_line(),
        scene_name: input.name.clone(),
        ..CompareOptions::default()
    };
    let mut bars = Bars::new(args.quiet);
    let mut lenses = input.sections.as_mut().map(FaceLenses);
    let mut nothing = ();
    let script: &mut dyn Script = match &mut lenses {
        Some(lenses) => lenses,
        None => &mut nothing,
    };
    let comparison = compare_scripted(
        &gpu,
        &mut input.scene,
        script,
        &input.path,
        &contenders.list,
        &options,
        &mut |progress| bars.show(progress),
    );
    bars.finish();
    let mut comparison = comparison?;
    comparison
        .report
        .seeds
        .insert("path".to_owned(), args.view.seed);
    if let Some(seed) = input.scene_seed {
        comparison.report.seeds.insert("scene".to_owned(), seed);
    }
    comparison.save(&args.out)?;
    if !args.quiet {
        let [scene, adapter] = facts(&comparison.report);
        println!("{scene}\n{adapter}\n");
        let colour = wants_colour(&std::io::stdout());
        println!("{}", Table::new(&comparison.report).terminal(colour));
        if let Some(eyes) = Table::eyes(&comparison.report) {
            println!("{}", eyes.terminal(colour));
        }
        for note in &contenders.notes {
            println!("{note}.");
        }
        for pick in picks(&comparison.report) {
            println!(
                "{}: {}, {}",
                pick.title,
                pick.strategy.title(),
                pick.verdict.text
            );
        }
        println!("report: {}", args.out.join("report.html").display());
    }
    Ok(())
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
