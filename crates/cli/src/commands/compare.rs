//! `antumbra compare`: strategies along a path, their cost and their errors.

use antumbra::cull::Gpu;
use antumbra::measure::audit_summary::audit_summaries;
use antumbra::measure::report::{ErrorBasis, Report};
use antumbra::measure::summary::{following, recommendations, withheld};
use antumbra::measure::table::{Table, facts, wants_colour};

use crate::args::CompareArgs;
use crate::contenders::{Conditions, contenders};
use crate::failure::Failure;
use crate::input::Input;
use crate::measuring::measure;
use crate::outputs::{Outputs, open_folder};
use crate::print::{print, print_styled};
use crate::strategies::Horizons;

/// Compares, writes the report, prints the table and the report's file.
///
/// # Errors
/// What stopped it; nothing half-written stays behind.
pub fn run(args: CompareArgs) -> Result<(), Failure> {
    // Wrong usage is found before anything is loaded.
    contenders(&args, Conditions::default())?;
    let mut outputs = Outputs::for_view(&args.view);
    outputs.reports_into("--out", &args.out);
    outputs.check()?;
    let gpu = Gpu::open(&args.view.adapter)?;
    let folder = open_folder(&args.out)?;
    // The standard selection has the strategy that uses them.
    let horizons = match args.strategies.is_empty() {
        true => Horizons::Used,
        false => Horizons::of(&args.strategies),
    };
    let input = Input::open(&args.view, horizons, &gpu, &mut outputs)?;
    let conditions = Conditions {
        // Each eye has its own queries.
        occludees: input.scene.drawable_count() * input.views().len(),
        stereo: input.stereo.is_some(),
        horizon: input.horizon.as_ref(),
    };
    let contenders = contenders(&args, conditions)?;
    let comparison = measure(&gpu, input, &contenders.list, &args.view, args.in_flight)?;
    // Saved first, since a reader of the table may be gone; and shown even where saving fails.
    let saved = comparison.save_into(&folder);
    let shown = match args.view.quiet {
        true => Ok(()),
        false => show(&comparison.report, &contenders.notes),
    };
    saved?;
    shown?;
    match args.view.quiet {
        true => Ok(()),
        false => print(format_args!(
            "report: {}",
            args.out.join("report.html").display()
        )),
    }
}

/// The table, and what it says in words.
fn show(report: &Report, notes: &[String]) -> Result<(), Failure> {
    let [scene, adapter] = facts(report);
    print(format_args!("{scene}\n{adapter}\n"))?;
    let colour = wants_colour(&std::io::stdout());
    print_styled(Table::new(report).terminal(colour))?;
    if let Some(eyes) = Table::eyes(report) {
        print_styled(eyes.terminal(colour))?;
    }
    for note in notes {
        print(format_args!("{note}."))?;
    }
    print_basis(report)?;
    for pick in recommendations(report) {
        let strategy = pick.strategy.title();
        print(format_args!(
            "{}: {strategy}, {}",
            pick.title, pick.summary.text
        ))?;
    }
    print_withheld(report)?;
    for summary in audit_summaries(report) {
        let strategy = summary.strategy.title();
        print(format_args!("{strategy}: {}", summary.lines.join("\n  ")))?;
    }
    Ok(())
}

/// What the settings that follow the image are, and what share of wrong pixels the recommendations go by.
pub(super) fn print_basis(report: &Report) -> Result<(), Failure> {
    for line in following(report) {
        print(format_args!("{line}."))?;
    }
    if report.error_basis() == ErrorBasis::Owned {
        print(
            "Entities own less than half of the pixels: the recommendations go by wrong pixels as a share of those that they own.",
        )?;
    }
    Ok(())
}

/// The strategies that lose the scene, which are not recommended.
pub(super) fn print_withheld(report: &Report) -> Result<(), Failure> {
    for (strategy, loss) in withheld(report) {
        print(format_args!(
            "Not recommended: {}, {loss}",
            report.title_of(strategy)
        ))?;
    }
    Ok(())
}
