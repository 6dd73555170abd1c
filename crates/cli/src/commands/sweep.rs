//! `antumbra sweep`: the trade that a strategy's settings offer, speed against error.

use antumbra::draw::Gpu;
use antumbra::measure::report::Report;
use antumbra::measure::summary::recommendations;
use antumbra::measure::table::{Table, facts, wants_colour};
use antumbra::measure::trade_off::{self, EDGE_LEGEND};

use crate::args::SweepArgs;
use crate::failure::Failure;
use crate::input::Input;
use crate::measuring::measure;
use crate::vary::settings;

/// Compares all settings at once, writes the report, prints the trade and what the budgets choose.
///
/// # Errors
/// What stopped it; nothing half-written stays behind.
pub fn run(args: SweepArgs) -> Result<(), Failure> {
    // Wrong words are found before anything is loaded.
    settings(&args, None)?;
    let gpu = Gpu::open(&args.view.adapter)?;
    let input = Input::open(&args.view, &gpu)?;
    let settings = settings(&args, input.horizon.as_ref())?;
    let mut comparison = measure(&gpu, input, &settings.list, &args.view, args.quiet)?;
    let report = &mut comparison.report;
    report.sweep = Some(trade_off::sweep(
        report,
        args.strategy.clone(),
        settings.vary,
        &args.budget,
    ));
    comparison.save(&args.out)?;
    if !args.quiet {
        print(&comparison.report);
        println!("report: {}", args.out.join("report.html").display());
        println!("plot: {}", args.out.join("trade.svg").display());
    }
    Ok(())
}

fn print(report: &Report) {
    for line in facts(report) {
        println!("{line}");
    }
    if let Some(sweep) = &report.sweep {
        println!("{}\n", trade_off::sweep_title(sweep));
    }
    let colour = wants_colour(&std::io::stdout());
    let tables = [Table::sweep(report), Table::eyes(report)];
    for table in tables.into_iter().flatten() {
        println!("{}", table.terminal(colour));
    }
    println!("{EDGE_LEGEND}");
    let answers = trade_off::choice_texts(report);
    for answer in &answers {
        let setting = report.title_of(answer.setting);
        println!("{}: {setting}", answer.heading);
        for line in &answer.lines {
            println!("  {line}");
        }
    }
    if answers.is_empty() {
        for pick in recommendations(report) {
            let setting = report.title_of(pick.strategy);
            println!("{}: {setting}, {}", pick.title, pick.summary.text);
        }
    }
}
