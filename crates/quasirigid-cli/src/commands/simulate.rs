use quasirigid::dynamics::{Options, Outcome, Run, Sample, SpinState, propagate};
use quasirigid::model::ReducedBody;
use quasirigid::reduction::{Validity, Verdict, reduce};
use quasirigid_io::record::history_csv;
use serde_json::json;

use super::{Loaded, duration, even_times, initial, load, notes, options};
use crate::args::{Simulate, System, TableFormat};
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::message::remark;
use crate::progress::Collector;
use crate::record::{columns, status};
use crate::{Ending, describe, output};

/// Rows of a table when nothing says how many.
const ROWS: usize = 1001;

/// Propagates the spin and prints a table.
pub fn simulate(arguments: &Simulate) -> Result<Ending, Failure> {
    let Loaded { model, body, order } = load(&arguments.common)?;
    notes(&model, &arguments.common);
    let start = initial(&model, &arguments.common.model)?;
    let options = options(&model, &arguments.propagation);
    let times = match &arguments.times {
        Some(times) => times.clone(),
        None => {
            let rows = arguments.propagation.samples.or(model.run.samples).unwrap_or(ROWS);
            even_times(rows, duration(&model, &arguments.propagation, start.omega)?)?
        }
    };
    if let Some(path) = &arguments.out {
        output::check_file(path, arguments.overwrite)?;
    }
    let order = if arguments.system == System::Rigid { 1 } else { order };
    let reduced = reduce(&body, order)?;
    if !arguments.common.quiet && arguments.system == System::Reduced {
        warn(&Validity::of(&body, order, start.omega)?);
    }
    let interrupt = Interrupt::listen()?;
    let (samples, run) = propagated(&reduced, start, &times, options, arguments, &interrupt)?;
    interrupt.forget();
    if let Some(note) = describe::drift_note("integrated", run.last.energy_drift, run.last.dissipated) {
        remark(&note);
    }
    table(arguments, &samples, &interrupt)?;
    if arguments.common.json {
        output::print(&object(arguments.system, &run))?;
    }
    if run.outcome == Outcome::Finished {
        return Ok(Ending::Done);
    }
    remark(&format!("{}; the table is valid up to there", status(run.outcome, run.last.t).1));
    Ok(Ending::CheckFailed)
}

fn warn(validity: &Validity) {
    if validity.verdict() != Verdict::Holds {
        remark(&format!("{} See `quasirigid check`.", describe::verdict(validity)));
    }
}

fn propagated(
    reduced: &ReducedBody,
    start: SpinState,
    times: &[f64],
    options: Options,
    arguments: &Simulate,
    interrupt: &Interrupt,
) -> Result<(Vec<Sample>, Run), Failure> {
    let end = times.last().copied().unwrap_or(0.0);
    let mut collector = Collector::new(interrupt, "propagating", end, arguments.common.quiet);
    let run = propagate(reduced, start, times, options, &mut collector)?;
    Ok((collector.finish(), run))
}

fn table(arguments: &Simulate, samples: &[Sample], interrupt: &Interrupt) -> Result<(), Failure> {
    let TableFormat::Csv = arguments.format;
    let columns = columns(samples, None);
    match (&arguments.out, arguments.common.json) {
        (Some(path), _) => output::to_file(path, |out| history_csv(&columns, out)),
        (None, false) => output::to_stdout(interrupt, |out| history_csv(&columns, out)),
        (None, true) => Ok(()),
    }
}

fn object(system: System, Run { outcome, last, work }: &Run) -> String {
    let (status, message) = status(*outcome, last.t);
    let object = json!({
        "system": match system { System::Reduced => "reduced", System::Rigid => "rigid" },
        "status": status,
        "message": message,
        "t": last.t,
        "omega": last.omega,
        "attitude": last.attitude,
        "momentum": last.momentum,
        "energy": last.energy,
        "dissipated": last.dissipated,
        "energy_drift": last.energy_drift,
        "momentum_drift": last.momentum_drift,
        "turns": last.turns,
        "steps": work.steps,
        "rejected": work.rejected,
        "evaluations": work.evaluations,
    });
    format!("{object:#}\n")
}
