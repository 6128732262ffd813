//! The `quasirigid` program: reads its arguments, calls the library, prints.
#![allow(clippy::print_stdout, clippy::print_stderr)]

mod args;
mod commands;
mod failure;
mod former;
mod history_format;
mod interrupt;
mod message;
mod output;
mod progress;

use std::process::ExitCode;

use clap::Parser;

use args::{Arguments, Command};
use failure::Failure;

/// Exit status of a command that could run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum ExitStatus {
    /// Everything asked for was done and holds.
    Done,
    /// Done, but a check asked for failed.
    CheckFailed,
}

fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => {
            let wrong = error.use_stderr();
            return match message::of_arguments(&error) {
                Err(cause) if !wrong => ended(Err(output::printed(cause.kind()))),
                _ => ExitCode::from(if wrong { 2 } else { 0 }),
            };
        }
    };
    if !arguments.command.is_quiet() {
        former::notes(std::env::args_os()).iter().for_each(|note| message::remark(&format!("note: {note}")));
    }
    interrupt::survive_limits();
    ended(match &arguments.command {
        Command::Run(run) => commands::run::run(run),
        Command::Check(check) => commands::check::check(check),
        Command::Modes(modes) => commands::modes::modes(modes),
        Command::Linear(linear) => commands::linear::linear(linear),
        Command::Infer(infer) => commands::infer::infer(infer),
        Command::Sensitivity(sensitivity) => commands::sensitivity::sensitivity(sensitivity),
        Command::Fills(fills) => commands::fills::fills(fills),
        Command::Lightcurve(lightcurve) => commands::lightcurve::lightcurve(lightcurve),
        Command::Yorp(yorp) => commands::yorp::yorp(yorp),
        Command::Derive(derive) => commands::derive::derive(derive),
        Command::Export(export) => commands::export::export(export),
        Command::Simulate(simulate) => commands::simulate::simulate(simulate),
        Command::Evolve(evolve) => commands::evolve::evolve(evolve),
        Command::Verify(verify) => commands::verify::verify(verify),
        Command::Sweep(sweep) => commands::sweep::sweep(sweep),
        Command::Report(report) => commands::report::report(report),
        Command::Plot(plot) => commands::plot::plot(plot),
        Command::Audit(audit) => commands::audit::audit(audit),
        Command::Keys(keys) => commands::keys::keys(keys),
        Command::Schema => commands::schema::schema(),
        Command::New(new) => commands::new::new(new),
        Command::Diff(diff) => commands::diff::diff(diff),
        Command::Cite(cite) => commands::cite::cite(cite),
    })
}

/// Exit code of a command, with the message of its failure.
fn ended(result: Result<ExitStatus, Failure>) -> ExitCode {
    match result {
        Ok(ExitStatus::Done) => ExitCode::SUCCESS,
        Ok(ExitStatus::CheckFailed) => ExitCode::from(1),
        Err(Failure::BrokenPipe) => ExitCode::SUCCESS,
        Err(failure @ (Failure::Interrupted | Failure::Abandoned)) => {
            message::print(&failure);
            ExitCode::from(1)
        }
        Err(failure) => {
            message::print(&failure);
            ExitCode::from(2)
        }
    }
}
