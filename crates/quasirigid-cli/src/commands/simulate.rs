use std::fs::File;
use std::io::{self, BufWriter, IsTerminal, Seek, Write};

use quasirigid::dynamics::Outcome;
use quasirigid_io::attitude::{Labels, Unwritten};
use quasirigid_io::model::System;
use quasirigid_io::record::{MOST_ROWS, TableFormat, history_csv, log_csv};
use quasirigid_study::histories::{History, Table};
use quasirigid_study::{Study, StudyError};
use serde_json::json;

use super::attitude::{setup_beside, unwritten};
use super::{certificate, inputs_beside, open};
use crate::args::Simulate;
use crate::failure::Failure;
use crate::history_format::HistoryFormat;
use crate::interrupt::Interrupt;
use crate::message::remark;
use crate::progress::Terminal;
use crate::{ExitStatus, output};

/// Propagates the spin and prints a table.
pub fn simulate(arguments: &Simulate) -> Result<ExitStatus, Failure> {
    let Simulate { common, out, overwrite, .. } = arguments;
    let format = HistoryFormat::of_file(arguments.format, out.as_deref());
    if matches!(format, HistoryFormat::Table(_)) && arguments.attitude.are_given() {
        return Err(Failure::NoAttitudeFile { with: "--format aem, aem1, stk, msopck or basilisk" });
    }
    if arguments.spin_manifold.is_given() && arguments.system != Some(System::SpinManifold) {
        return Err(Failure::NotAboutSpin { with: "--system spin-manifold" });
    }
    let study = open(common)?;
    study.initial()?;
    let asked = arguments.run.partial()?;
    match out {
        Some(path) if output::is_stdout(path) && common.json => {
            return Err(Failure::TwiceOnStdout { option: "--json" });
        }
        Some(path) if !output::is_stdout(path) => output::check_file(path, *overwrite)?,
        _ if format.is_binary() && !common.json && std::io::stdout().is_terminal() => {
            return Err(Failure::BinaryOnTerminal { format: format.ending() });
        }
        _ => {}
    }
    certificate::check(arguments.certificate.as_deref(), *overwrite)?;
    let table = Table {
        system: arguments.system,
        coordinates: arguments.coordinates,
        displacements: arguments.displacements,
        times: arguments.times.clone(),
        manifold: arguments.spin_manifold.partial(),
    };
    let interrupt = Interrupt::listen()?;
    let mut terminal = Terminal::new(&interrupt, common.quiet);
    // the rows of a long table go to the disk as they come
    let long = study.table_rows(&asked, &table) as u64 > MOST_ROWS;
    let spool = long.then(|| output::spool(out.as_deref())).transpose()?;
    let history = match &spool {
        Some(spool) => {
            study.simulate_logged(&asked, &table, spool.path(), &mut terminal).map_err(|error| {
                // a temporary file says nothing to a user
                match (error, out) {
                    (StudyError::Write { cause, .. }, Some(path)) => {
                        Failure::Write { path: path.clone(), cause }
                    }
                    (other, _) => other.into(),
                }
            })?
        }
        None => study.simulate(&asked, &table, &mut terminal)?,
    };
    drop(terminal);
    interrupt.forget();
    tell_range(&history, common.quiet);
    // what is wrong is told to quiet callers too; others have read it before the work
    let unsaid = history.wrong.iter().filter(|reason| common.quiet && !history.notes.contains(reason));
    unsaid.for_each(|reason| remark(reason));
    history.notes.iter().for_each(|note| remark(note));
    let certified = arguments.certificate.is_some().then(|| study.certify_history(&history)).transpose()?;
    let in_place = print_table((arguments, format), (&study, &history), &interrupt)?;
    let certified = certified.as_ref().zip(arguments.certificate.as_deref());
    let in_place = certificate::write(certified, *overwrite, common.quiet)? && in_place;
    if common.json {
        output::print(&format!("{:#}\n", study.with_inputs(history.json())))?;
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

/// Writing of a table to its place.
type Writing<'a> = Box<dyn FnOnce(&mut dyn Write) -> io::Result<()> + 'a>;

/// Writes the table or the attitude file; returns whether it stands at the place asked for.
fn print_table(
    (arguments, format): (&Simulate, HistoryFormat),
    (study, history): (&Study, &History),
    interrupt: &Interrupt,
) -> Result<bool, Failure> {
    if arguments.out.is_none() && arguments.common.json {
        return Ok(true);
    }
    let labels = arguments.attitude.labels(&study.model.name);
    let write = writing((arguments, format), &labels, (study, history))?;
    let Some(path) = &arguments.out else {
        return output::to_stdout(interrupt, write).map(|()| true);
    };
    let placed = output::to_file(path, arguments.overwrite, write)?;
    let beside = format.is_binary() || inputs_beside(&study.inputs(), &placed.path, arguments.overwrite)?;
    let setup = match format {
        HistoryFormat::Attitude(format) => {
            let setup = |data: &str| format.setup(&labels, &history.columns, data);
            setup_beside(setup, (&placed.path, arguments.overwrite))?
        }
        HistoryFormat::Table(_) => true,
    };
    Ok(placed.told(path) & beside & setup)
}

/// The writing of a table or an attitude file, which is then known to be possible.
fn writing<'a>(
    (arguments, format): (&'a Simulate, HistoryFormat),
    labels: &Labels,
    (study, history): (&Study, &'a History),
) -> Result<Writing<'a>, Failure> {
    let columns = &history.columns;
    let inputs = || json!(study.inputs()).to_string();
    Ok(match (&history.log, format) {
        (None, HistoryFormat::Table(TableFormat::Csv)) => Box::new(|out| history_csv(columns, out)),
        (Some(log), HistoryFormat::Table(TableFormat::Csv)) => Box::new(|out| log_csv(columns, log, out)),
        (None, HistoryFormat::Table(format)) => {
            let bytes = format.bytes(columns, Some(&inputs()))?;
            Box::new(move |out| out.write_all(&bytes))
        }
        (Some(log), HistoryFormat::Table(format)) => spooled(arguments, |out| {
            format.copy_log(out, (columns, Some(&inputs())), log).map_err(Unwritten::from)
        })?,
        (log, HistoryFormat::Attitude(format)) => {
            spooled(arguments, |out| format.write(out, (labels, Some(&inputs())), (columns, log.as_ref())))?
        }
    })
}

/// The writing of a file that is made beside its place first.
fn spooled<'a>(
    arguments: &Simulate,
    fill: impl FnOnce(&mut BufWriter<&mut File>) -> Result<(), Unwritten>,
) -> Result<Writing<'a>, Failure> {
    let mut file = output::spool(arguments.out.as_deref())?;
    let mut buffered = BufWriter::new(file.as_file_mut());
    let path = arguments.out.clone().unwrap_or_else(|| "standard output".into());
    fill(&mut buffered).map_err(|error| unwritten(&path, error))?;
    let failed = |cause| Failure::Write { path: path.clone(), cause };
    buffered.flush().map_err(failed)?;
    drop(buffered);
    file.rewind().map_err(failed)?;
    Ok(Box::new(move |out| io::copy(file.as_file_mut(), out).map(drop)))
}
