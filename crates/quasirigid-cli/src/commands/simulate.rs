use quasirigid::dynamics::{Event, Outcome, Run};
use quasirigid::model::FlexibleBody;
use quasirigid::reduction::{Validity, Verdict, reduce};
use quasirigid_io::record::{Column, history_csv};
use serde_json::json;

use super::{Loaded, circled_axis, duration, even_times, initial, load, note_left_out, notes, options, room};
use crate::args::{Simulate, System, TableFormat};
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::message::remark;
use crate::motion::Motion;
use crate::progress::Collector;
use crate::record::{columns, coordinate_columns, displacement_columns, name, status};
use crate::{Ending, describe, output};

/// Rows of a table when nothing says how many.
const ROWS: usize = 1001;

/// Propagates the spin and prints a table.
pub fn simulate(arguments: &Simulate) -> Result<Ending, Failure> {
    let loaded = load(&arguments.common)?;
    let Loaded { model, body, order, .. } = &loaded;
    notes(model, &arguments.common);
    let start = initial(model, body, *order)?;
    let wrong = arguments.system != System::Rigid && note_left_out(&loaded, start.omega, &arguments.common);
    let axis = stop_axis(&loaded, start.omega)?;
    let options = options(&loaded, &arguments.propagation, axis)?;
    let times = match &arguments.times {
        Some(times) => times.clone(),
        None => {
            let rows = arguments.propagation.samples.or(model.run.samples).unwrap_or(ROWS);
            even_times(rows, duration(model, &arguments.propagation, start.omega)?)?
        }
    };
    let kept = arguments.coordinates || arguments.displacements;
    room(times.len(), 1, if kept { body.coordinates().len() } else { 0 })?;
    if let Some(path) = &arguments.out {
        output::check_file(path, arguments.overwrite)?;
    }
    for (asked, option) in
        [(arguments.coordinates, "--coordinates"), (arguments.displacements, "--displacements")]
    {
        if asked && arguments.system == System::Rigid {
            return Err(Failure::NoCoordinates { option });
        }
    }
    let motion = Motion::new(&loaded, start);
    let judged = start.omega != [0.0; 3] || !motion.system().acts();
    if !arguments.common.quiet && arguments.system == System::Reduced && judged {
        let reduced = reduce(body, *order)?;
        warn(&Validity::of_reduced(body, &reduced, motion.settled_spin(&reduced)?)?);
    }
    let interrupt = Interrupt::listen()?;
    let end = times.last().copied().unwrap_or(0.0);
    let mut collector = Collector::new(&interrupt, "propagating", end, arguments.common.quiet);
    if kept {
        collector.keep_coordinates();
    }
    let run = motion.follow(arguments.system, &times, options, &mut collector)?;
    let budget = collector.budget().to_vec();
    let (samples, coordinates) = collector.finish();
    interrupt.forget();
    let (forced, last) = (motion.system().acts(), run.last);
    let note = describe::drift_note(
        name(arguments.system),
        forced,
        last.energy,
        [last.energy_drift, last.dissipated],
    );
    if let Some(note) = note {
        remark(&note);
    }
    let mut columns = columns(body.support(), &samples, None);
    if arguments.displacements {
        columns.extend(displacement_columns(body.markers(), &coordinates));
    }
    if arguments.coordinates {
        let valued = if arguments.system == System::Full { body.coordinates().len() } else { body.elastic() };
        columns.extend(coordinate_columns(body.coordinates(), valued, &coordinates));
    }
    let in_place = table(arguments, &columns, &interrupt)?;
    if arguments.common.json {
        output::print(&object(body, arguments.system, &budget, &run))?;
    }
    let message = status(body, run.outcome, run.last.t).1;
    match run.outcome {
        Outcome::Finished => Ok(if in_place && !wrong { Ending::Done } else { Ending::CheckFailed }),
        Outcome::Event(Event::Energy(_) | Event::Nutation { .. }) => {
            remark(&message);
            Ok(if wrong { Ending::CheckFailed } else { Ending::Done })
        }
        _ => {
            remark(&format!("{message}; the table is valid up to there"));
            Ok(Ending::CheckFailed)
        }
    }
}

/// The axis from which the nutation that ends a history is counted. (P8)
fn stop_axis(loaded: &Loaded, omega: [f64; 3]) -> Result<[f64; 3], Failure> {
    if loaded.model.run.stop.nutation.is_none() {
        return Ok(omega);
    }
    let reduced = reduce(&loaded.body, loaded.order)?;
    let validity = Validity::of_reduced(&loaded.body, &reduced, omega);
    let holds = validity.is_ok_and(|validity| validity.verdict() != Verdict::Fails);
    Ok(circled_axis(&if holds { reduced } else { reduce(&loaded.body, 0)? }, omega))
}

fn warn(validity: &Validity) {
    if validity.verdict() != Verdict::Holds {
        remark(&format!("{} See `quasirigid check`.", describe::verdict(validity)));
    }
}

/// Writes the table; whether it stands where it should.
fn table(arguments: &Simulate, columns: &[Column], interrupt: &Interrupt) -> Result<bool, Failure> {
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

fn object(
    body: &FlexibleBody,
    system: System,
    budget: &[(String, f64)],
    Run { outcome, last, work }: &Run,
) -> String {
    let (status, message) = status(body, *outcome, last.t);
    let object = json!({
        "system": name(system),
        "status": status,
        "message": message,
        "t": last.t,
        "omega": last.omega,
        "attitude": last.attitude,
        "momentum": last.momentum,
        "energy": last.energy,
        "dissipated": last.dissipated,
        "dissipation": describe::shares(budget),
        "work": last.work,
        "energy_drift": last.energy_drift,
        "momentum_drift": last.momentum_drift,
        "turns": last.turns,
        "position": last.place,
        "velocity": last.velocity,
        "pole": last.pole,
        "steps": work.steps,
        "rejected": work.rejected,
        "implicit_steps": work.implicit_steps,
        "evaluations": work.evaluations,
        "factorizations": work.factorizations,
    });
    format!("{object:#}\n")
}
