//! `antumbra compare`: the main job.

use antumbra::draw::Gpu;
use antumbra::measure::audit_summary::audit_summaries;
use antumbra::measure::summary::recommendations;
use antumbra::measure::table::{Table, facts, wants_colour};

use crate::args::CompareArgs;
use crate::contenders::contenders;
use crate::failure::Failure;
use crate::input::Input;
use crate::measuring::measure;

/// Compares, writes the report, prints the table and where the report lies.
///
/// # Errors
/// What stopped it; nothing half-written stays behind.
pub fn run(args: CompareArgs) -> Result<(), Failure> {
    // Wrong words are found before anything is loaded.
    contenders(&args, 0, false, None)?;
    let gpu = Gpu::open(&args.view.adapter)?;
    let input = Input::open(&args.view, &gpu)?;
    // Each eye asks for itself.
    let occludees = input.scene.drawable_count() * input.views().len();
    let contenders = contenders(
        &args,
        occludees,
        input.stereo.is_some(),
        input.horizon.as_ref(),
    )?;
    let comparison = measure(&gpu, input, &contenders.list, &args.view, args.quiet)?;
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
        for pick in recommendations(&comparison.report) {
            println!(
                "{}: {}, {}",
                pick.title,
                pick.strategy.title(),
                pick.summary.text
            );
        }
        for summary in audit_summaries(&comparison.report) {
            println!(
                "{}: {}",
                summary.strategy.title(),
                summary.lines.join("\n  ")
            );
        }
        println!("report: {}", args.out.join("report.html").display());
    }
    Ok(())
}
