//! `antumbra compare`: strategies along a path, their cost and their errors.

use antumbra::cull::Gpu;
use antumbra::measure::audit_summary::audit_summaries;
use antumbra::measure::summary::recommendations;
use antumbra::measure::table::{Table, facts, wants_colour};

use crate::args::CompareArgs;
use crate::contenders::{Conditions, contenders};
use crate::failure::Failure;
use crate::input::Input;
use crate::measuring::measure;
use crate::outputs::Outputs;
use crate::print::print;

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
    let input = Input::open(&args.view, &gpu, &mut outputs)?;
    let conditions = Conditions {
        // Each eye has its own queries.
        occludees: input.scene.drawable_count() * input.views().len(),
        stereo: input.stereo.is_some(),
        horizon: input.horizon.as_ref(),
    };
    let contenders = contenders(&args, conditions)?;
    let comparison = measure(&gpu, input, &contenders.list, &args.view)?;
    comparison.save(&args.out)?;
    if !args.view.quiet {
        let [scene, adapter] = facts(&comparison.report);
        print(format_args!("{scene}\n{adapter}\n"))?;
        let colour = wants_colour(&std::io::stdout());
        print(Table::new(&comparison.report).terminal(colour))?;
        if let Some(eyes) = Table::eyes(&comparison.report) {
            print(eyes.terminal(colour))?;
        }
        for note in &contenders.notes {
            print(format_args!("{note}."))?;
        }
        for pick in recommendations(&comparison.report) {
            let strategy = pick.strategy.title();
            print(format_args!(
                "{}: {strategy}, {}",
                pick.title, pick.summary.text
            ))?;
        }
        for summary in audit_summaries(&comparison.report) {
            let strategy = summary.strategy.title();
            print(format_args!("{strategy}: {}", summary.lines.join("\n  ")))?;
        }
        let page = args.out.join("report.html");
        print(format_args!("report: {}", page.display()))?;
    }
    Ok(())
}
