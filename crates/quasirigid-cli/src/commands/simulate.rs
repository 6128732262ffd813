use quasirigid::dynamics::{Event, Outcome};
use quasirigid_io::model::System;
use quasirigid_io::record::{Column, history_csv};
use quasirigid_study::histories::Table;

use super::{note_left_out, notes, open, propagation};
use crate::args::{Simulate, TableFormat};
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::message::remark;
use crate::progress::Terminal;
use crate::{ExitStatus, output};

/// Propagates the spin and prints a table.
pub fn simulate(arguments: &Simulate) -> Result<ExitStatus, Failure> {
    let Simulate { common, out, overwrite, .. } = arguments;
    let study = open(common)?;
    notes(&study, common);
    let system = arguments.system;
    let omega = study.initial()?.omega;
    let wrong = system != System::Rigid && note_left_out(&study, omega, common);
    let asked = propagation(&arguments.propagation)?;
    if let Some(path) = out {
        output::check_file(path, *overwrite)?;
    }
    let table = Table {
        system,
        coordinates: arguments.coordinates,
        displacements: arguments.displacements,
        times: arguments.times.clone(),
    };
    let interrupt = Interrupt::listen()?;
    let history = study.simulate(&asked, &table, &mut Terminal::new(&interrupt, common.quiet))?;
    interrupt.forget();
    history.notes.iter().for_each(|note| remark(note));
    let in_place = print_table(arguments, &history.columns, &interrupt)?;
    if common.json {
        output::print(&format!("{:#}\n", history.json()))?;
    }
    let message = &history.message;
    match history.run.outcome {
        Outcome::Finished => Ok(if in_place && !wrong { ExitStatus::Done } else { ExitStatus::CheckFailed }),
        Outcome::Event(Event::Energy(_) | Event::Nutation { .. }) => {
            remark(message);
            Ok(if wrong { ExitStatus::CheckFailed } else { ExitStatus::Done })
        }
        _ => {
            remark(&format!("{message}; the table is valid up to there"));
            Ok(ExitStatus::CheckFailed)
        }
    }
}

/// Writes the table; returns whether it stands at the place asked for.
fn print_table(arguments: &Simulate, columns: &[Column], interrupt: &Interrupt) -> Result<bool, Failure> {
    let TableFormat::Csv = arguments.format;
    match (&arguments.out, arguments.common.json) {
        (Some(path), _) => {
            let placed = output::to_file(path, arguments.overwrite, |out| history_csv(columns, out))?;
            return Ok(placed.told(path));
        }
        (None, false) => output::to_stdout(interrupt, |out| history_csv(columns, out))?,
        (None, true) => {}
    }
    Ok(true)
}
