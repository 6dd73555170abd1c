//! `antumbra sweep`: the trade that a strategy's settings offer, speed against error.

use antumbra::cull::Gpu;
use antumbra::measure::report::Report;
use antumbra::measure::summary::recommendations;
use antumbra::measure::table::{Table, facts, wants_colour};
use antumbra::measure::trade_off::{self, EDGE_LEGEND};

use super::compare::{print_basis, print_withheld};
use crate::args::SweepArgs;
use crate::failure::Failure;
use crate::input::Input;
use crate::measuring::measure;
use crate::outputs::{Outputs, open_folder};
use crate::print::{print, print_styled};
use crate::strategies::Horizons;
use crate::vary::settings;

/// Compares all settings at once, writes the report, prints the trade and what the limits choose.
///
/// # Errors
/// What stopped it; nothing half-written stays behind.
pub fn run(args: SweepArgs) -> Result<(), Failure> {
    // Wrong usage is found before anything is loaded.
    settings(&args, None)?;
    let mut outputs = Outputs::for_view(&args.view);
    outputs.reports_into("--out", &args.out);
    outputs.check()?;
    let gpu = Gpu::open(&args.view.adapter)?;
    let folder = open_folder(&args.out)?;
    let input = Input::open(&args.view, Horizons::of(&args.strategy), &gpu, &mut outputs)?;
    let settings = settings(&args, input.horizon.as_ref())?;
    let mut comparison = measure(&gpu, input, &settings.list, &args.view, args.in_flight)?;
    let report = &mut comparison.report;
    report.sweep = Some(trade_off::sweep(
        report,
        args.strategy.clone(),
        settings.vary,
        &args.limit,
    ));
    // Saved first, since a reader of the table may be gone; and shown even where saving fails.
    let saved = comparison.save_into(&folder);
    let shown = match args.view.quiet {
        true => Ok(()),
        false => show(&comparison.report),
    };
    saved?;
    shown?;
    if !args.view.quiet {
        let file = |name: &str| args.out.join(name);
        print(format_args!("report: {}", file("report.html").display()))?;
        print(format_args!("plot: {}", file("trade.svg").display()))?;
    }
    Ok(())
}

/// The table, the settings on the efficient edge, and those that each limit chooses.
fn show(report: &Report) -> Result<(), Failure> {
    for line in facts(report) {
        print(line)?;
    }
    if let Some(sweep) = &report.sweep {
        print(format_args!("{}\n", trade_off::sweep_title(sweep)))?;
    }
    let colour = wants_colour(&std::io::stdout());
    let tables = [Table::sweep(report), Table::eyes(report)];
    for table in tables.into_iter().flatten() {
        print_styled(table.terminal(colour))?;
    }
    print(EDGE_LEGEND)?;
    print_basis(report)?;
    let answers = trade_off::choice_texts(report);
    for answer in &answers {
        let setting = report.title_of(answer.setting);
        print(format_args!("{}: {setting}", answer.heading))?;
        for line in &answer.lines {
            print(format_args!("  {line}"))?;
        }
    }
    if answers.is_empty() {
        for pick in recommendations(report) {
            let setting = report.title_of(pick.strategy);
            print(format_args!(
                "{}: {setting}, {}",
                pick.title, pick.summary.text
            ))?;
        }
    }
    print_withheld(report)?;
    Ok(())
}
