//! The program `antumbra`: compare, sweep, render, graph, prepare, strategies, doctor.
//!
//! It is the library on the command line, and adds nothing to it: `args` is what is typed, `input` makes a scene, views and a camera path of
//! it, `drawn_pose` draws a pose of it, `contenders` and `vary` are the strategies to measure, `outputs` refuses to overwrite what is read, and `commands` has a file for each
//! command. All text goes through `print`. `interrupt` and `watch` end what would not end.
//!
//! Exit status: 0, also where a pipe's reader is gone; 1 when the work failed; 2 for wrong usage; 130 after SIGINT and 143 after SIGTERM.

mod args;
mod commands;
mod contenders;
mod drawn_pose;
mod eyes;
mod failure;
mod fixed_setting;
mod input;
mod interrupt;
mod landscape;
mod losses;
mod measuring;
mod notes;
mod outputs;
mod print;
mod progress;
mod scene_file;
mod strategies;
mod vary;
mod volume_source;
mod watch;

use std::process::ExitCode;

use clap::Parser;

use crate::args::{Args, Command};
use crate::print::warn;

fn main() -> ExitCode {
    let filter = tracing_subscriber::EnvFilter::try_from_env("ANTUMBRA_LOG")
        .unwrap_or_else(|_| tracing_subscriber::EnvFilter::new("error,wgpu_hal=off,wgpu_core=off"));
    tracing_subscriber::fmt()
        .with_env_filter(filter)
        .with_writer(std::io::stderr)
        // A closed standard error is no reason to panic.
        .log_internal_errors(false)
        .init();
    interrupt::listen();
    let args = Args::parse();
    let outcome = match args.command() {
        Command::Compare(args) => commands::compare::run(args),
        Command::Sweep(args) => commands::sweep::run(args),
        Command::Render(args) => commands::render::run(args),
        Command::Graph(args) => commands::graph::run(args),
        Command::Prepare(args) => commands::prepare::run(args),
        Command::Strategies(args) => commands::strategies::run(args),
        Command::Doctor(args) => commands::doctor::run(&args),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            if !failure.is_silent() {
                warn(&failure);
            }
            ExitCode::from(failure.status())
        }
    }
}
