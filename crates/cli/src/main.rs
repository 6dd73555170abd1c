//! The command line: compare, sweep, render, graph, prepare, doctor.
//!
//! Exit status: 0, 1 when the work failed, 2 for wrong usage.

mod args;
mod commands;
mod contenders;
mod eyes;
mod failure;
mod input;
mod landscape;
mod measuring;
mod progress;
mod strategies;
mod vary;

use std::process::ExitCode;

use clap::Parser;

use crate::args::{Args, Command};

fn main() -> ExitCode {
    let filter = tracing_subscriber::EnvFilter::try_from_env("ANTUMBRA_LOG")
        .unwrap_or_else(|_| tracing_subscriber::EnvFilter::new("error,wgpu_hal=off,wgpu_core=off"));
    tracing_subscriber::fmt()
        .with_env_filter(filter)
        .with_writer(std::io::stderr)
        .init();
    let args = Args::parse();
    let outcome = match args.command() {
        Command::Compare(args) => commands::compare::run(args),
        Command::Sweep(args) => commands::sweep::run(args),
        Command::Render(args) => commands::render::run(args),
        Command::Graph(args) => commands::graph::run(args),
        Command::Prepare(args) => commands::prepare::run(args),
        Command::Doctor => commands::doctor::run(),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("antumbra: {failure}");
            ExitCode::from(failure.status())
        }
    }
}
