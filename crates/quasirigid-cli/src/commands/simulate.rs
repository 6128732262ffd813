use std::io::{IsTerminal, Write};

use quasirigid::dynamics::Outcome;
use quasirigid_io::model::System;
use quasirigid_io::record::{Column, TableFormat, history_csv};
use quasirigid_study::histories::{History, Table};

use super::{manifold, notes, open, propagation};
use crate::args::Simulate;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::message::remark;
use crate::progress::Terminal;
use crate::{ExitStatus, output};

/// Propagates the spin and prints a table.
pub fn simulate(arguments: &Simulate) -> Result<ExitStatus, Failure> {
    let Simulate { common, out, overwrite, .. } = arguments;
    if arguments.manifold.is_given() && arguments.system != System::Manifold {
        return Err(Failure::NotAboutSpin { with: "--system manifold" });
    }
    let study = open(common)?;
    notes(&study, common);
    study.initial()?;
    let asked = propagation(&arguments.propagation)?;
    match out {
        Some(path) => output::check_file(path, *overwrite)?,
        None if arguments.format != TableFormat::Csv && !common.json && std::io::stdout().is_terminal() => {
            return Err(Failure::BinaryOnTerminal { format: arguments.format.ending() });
        }
        None => {}
    }
    let table = Table {
        system: arguments.system,
        coordinates: arguments.coordinates,
        displacements: arguments.displacements,
        times: arguments.times.clone(),
        manifold: manifold(&arguments.manifold, None),
    };
    let interrupt = Interrupt::listen()?;
    let history = study.simulate(&asked, &table, &mut Terminal::new(&interrupt, common.quiet))?;
    interrupt.forget();
    // what is wrong is told to quiet callers too; others have read it before the work
    history.wrong.iter().filter(|_| common.quiet).for_each(|reason| remark(reason));
    history.notes.iter().for_each(|note| remark(note));
    tell_range(&history, common.quiet);
    let in_place = print_table(arguments, &history.columns, &interrupt)?;
    if common.json {
        output::print(&format!("{:#}\n", history.json()))?;
    }
    tell_end(&history);
    Ok(if history.holds() && in_place { ExitStatus::Done } else { ExitStatus::CheckFailed })
}

/// Says how far the reduced equations about the spin hold, before the table of a history by them.
fn tell_range(history: &History, quiet: bool) {
    if let Some(verdict) = &history.manifold
        && (!quiet || !verdict.holds())
    {
        remark(&verdict.sentence());
    }
}

/// Says how a history ended that is not the one to the last time.
fn tell_end(history: &History) {
    let message = &history.message;
    match history.run.outcome {
        Outcome::Finished => {} // a history that left the range was told first
        _ if history.ended() => remark(message),
        _ => remark(&format!("{message}; the table is valid up to there")),
    }
}

/// Writes the table; returns whether it stands at the place asked for.
fn print_table(arguments: &Simulate, columns: &Vec<Column>, interrupt: &Interrupt) -> Result<bool, Failure> {
    let binary = match arguments.format {
        TableFormat::Csv => None,
        format => Some(format.bytes(columns)?),
    };
    let write = |out: &mut dyn Write| match &binary {
        Some(bytes) => out.write_all(bytes),
        None => history_csv(columns, out),
    };
    match (&arguments.out, arguments.common.json) {
        (Some(path), _) => {
            let placed = output::to_file(path, arguments.overwrite, write)?;
            return Ok(placed.told(path));
        }
        (None, false) => output::to_stdout(interrupt, write)?,
        (None, true) => {}
    }
    Ok(true)
}
