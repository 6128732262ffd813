//! One command a file.

pub mod check;
pub mod derive;
pub mod evolve;
pub mod modes;
pub mod run;
pub mod simulate;
mod summary;
pub mod verify;

use std::path::Path;

use quasirigid::dynamics::{Event, Form, Method, Nutations, Options};
use quasirigid::elements::{Built, Condensation, Resolution, SlowLiquid, Surface};
use quasirigid::math::memory;
use quasirigid::math::sym::norm;
use quasirigid::model::force::Force;
use quasirigid::model::{FlexibleBody, Marker, Principal, ReducedBody};
use quasirigid::reduction::{Comparison, Criterion, frequencies};
use quasirigid_io::model::{Model, Stop};
use quasirigid_io::units::{Dimension, quantity};

use crate::args::{self, Common, Propagation};
use crate::complete::beyond;
use crate::failure::Failure;
use crate::left_out::LeftOut;
use crate::liquids;
use crate::message::remark;
use crate::resolution;
use crate::rotation::initial;

/// A model file with its flexible body.
pub struct Loaded {
    pub model: Model,
    pub body: FlexibleBody,
    pub forces: Vec<Force<Marker>>,
    /// Rates of cyclic coordinates at the start, where the file gives them.
    pub speeds: Vec<(usize, f64)>,
    /// What each liquid does to a slow rotation.
    pub liquids: Vec<SlowLiquid>,
    pub condensation: Option<Condensation>,
    /// How a solid inside a surface is approximated.
    pub resolution: Option<Resolution>,
    pub order: usize,
}

/// Where a model comes from that has no file: its name in messages, in the current folder.
const STANDARD_INPUT: &str = "standard input";

/// Whether the model is read from the standard input.
fn is_standard_input(common: &Common) -> bool {
    common.model == Path::new("-")
}

fn load(common: &Common) -> Result<Loaded, Failure> {
    let mut model = if is_standard_input(common) {
        Model::read_from(Path::new(STANDARD_INPUT), std::io::stdin().lock())?
    } else {
        Model::read(&common.model)?
    };
    let order = common.order.unwrap_or(model.run.order);
    model.assembly.reduction.order = order;
    let errors = model.assembly.check();
    if !errors.is_empty() {
        return Err(model.diagnose_all(&errors).into());
    }
    let Built { body, forces, condensation, speeds, liquids: slow, resolution } =
        model.assembly.build().map_err(|error| model.diagnose(&error))?;
    model.notes.extend(beyond(&model.assembly, order));
    model.notes.extend(liquids::notes(&model.assembly, &slow));
    if let Some(resolution) = &resolution {
        settle(&mut model, resolution);
    }
    Ok(Loaded { model, body, forces, speeds, liquids: slow, condensation, resolution, order })
}

/// Notes how well a solid is resolved, and takes the same approximation for the ends of the ranges of its materials.
fn settle(model: &mut Model, resolution: &Resolution) {
    let solids = &model.assembly.surfaces;
    model.notes.extend(solids.iter().filter_map(|solid| resolution::note(&solid.name, resolution)));
    let settled = |surface: &mut Surface| *surface = surface.settled(resolution);
    model.extremes.iter_mut().flat_map(|ends| ends.iter_mut()).for_each(|end| {
        end.surfaces.iter_mut().for_each(settled);
    });
}

/// Says what is suspect in the model, on standard error.
fn notes(model: &Model, common: &Common) {
    if !common.quiet {
        model.notes.iter().for_each(|note| remark(&format!("note: {note}")));
    }
}

/// Says on standard error what the equations of motion leave out; whether what they give may be false.
fn note_left_out(loaded: &Loaded, omega: [f64; 3], common: &Common) -> bool {
    let LeftOut { materials, liquids } = LeftOut::at(loaded, omega, None);
    if let (Some(note), false) = (materials, common.quiet) {
        remark(&format!("note: {note}"));
    }
    liquids.iter().for_each(|wrong| remark(wrong));
    liquids.is_some()
}

/// Turns that a propagation makes when nothing says how long it lasts.
const TURNS: f64 = 100.0;

/// Duration (s): the command's, the file's, or a hundred turns.
fn duration(model: &Model, propagation: &Propagation, omega: [f64; 3]) -> Result<f64, Failure> {
    let Some(text) = &propagation.duration else {
        return Ok(model.run.duration.unwrap_or(TURNS * std::f64::consts::TAU / norm(omega)));
    };
    seconds(text)
}

/// A duration (s) given on the command line.
fn seconds(text: &str) -> Result<f64, Failure> {
    let seconds = match text.parse() {
        Ok(seconds) => seconds,
        Err(_) => quantity(text, Dimension::TIME)
            .map_err(|cause| Failure::Duration { text: text.to_owned(), cause: Box::new(cause) })?,
    };
    if seconds > 0.0 && f64::is_finite(seconds) { Ok(seconds) } else { Err(Failure::NoDuration { seconds }) }
}

/// Options of a propagation: the command's, the file's, or the defaults. Nutation is counted from the `axis`.
fn options(loaded: &Loaded, propagation: &Propagation, axis: [f64; 3]) -> Result<Options, Failure> {
    let model = &loaded.model;
    let mut options = Options { events: events(loaded, axis)?, ..Options::default() };
    if let Some(method) = propagation.method {
        options.method = match method {
            args::Method::Automatic => Method::Automatic,
            args::Method::Explicit => Method::Explicit,
            args::Method::Implicit => Method::Implicit,
        };
    } else if let Some(method) = model.run.method {
        options.method = match method {
            quasirigid_io::model::Method::Automatic => Method::Automatic,
            quasirigid_io::model::Method::Explicit => Method::Explicit,
            quasirigid_io::model::Method::Implicit => Method::Implicit,
        };
    }
    if let Some(tolerance) = propagation.tolerance.or(model.run.tolerance) {
        options.tolerance = tolerance;
    }
    let paper = match propagation.form {
        Some(form) => form == args::Form::Paper,
        None => model.run.form == Some(quasirigid_io::model::Form::Paper),
    };
    options.form = if paper { Form::Paper } else { Form::Momentum };
    Ok(options)
}

/// What ends a propagation, as the file asks.
fn events(loaded: &Loaded, axis: [f64; 3]) -> Result<Vec<Event>, Failure> {
    let Stop { energy, nutation, validity } = loaded.model.run.stop;
    let mut events: Vec<Event> = energy.map(Event::Energy).into_iter().collect();
    events.extend(nutation.map(|angle| Event::Nutation { axis, angle }));
    if validity && let Some(slowest) = frequencies(&loaded.body)?.first() {
        let limit = Criterion { comparison: Comparison::Spin, value: 0.0 }.failure();
        events.push(Event::Validity { slowest: *slowest, limit });
    }
    Ok(events)
}

/// The axis from which nutation is counted, of a body at an angular velocity; that of greatest inertia where the momentum circles none. (P8)
fn circled_axis(body: &ReducedBody, omega: [f64; 3]) -> [f64; 3] {
    let nutation = Nutations::of(body).at(body.momentum(omega));
    nutation.map_or_else(|| Principal::of(body.J).axes[2], |nutation| nutation.axis)
}

/// Numbers of a row, in the history and in its table.
const ROW: usize = 40;

/// Refuses histories that have no room in memory, with so many internal coordinates kept in each row.
fn room(samples: usize, histories: usize, coordinates: usize) -> Result<(), Failure> {
    let numbers = (ROW + 4 * coordinates) as f64 * samples as f64 * histories as f64;
    memory::ask(numbers * size_of::<f64>() as f64).map_err(|cause| Failure::History { samples, cause })
}

/// Output times from zero to `duration`.
fn even_times(samples: usize, duration: f64) -> Result<Vec<f64>, Failure> {
    if !(2..=10_000_000).contains(&samples) {
        return Err(Failure::Samples { samples });
    }
    let last = samples - 1;
    Ok((0..samples).map(|i| if i == last { duration } else { duration * i as f64 / last as f64 }).collect())
}
