//! Helpers of the tests: studies, and questions to them.

pub mod any_body;
pub mod free_body;
mod models;

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use quasirigid_io::model::{EvolveMethod, Named, System, Target};
use quasirigid_io::record::{Column, EvolutionRecord, ModeRecord};
use quasirigid_study::evolution::Evolved;
use quasirigid_study::histories::{History, Table};
use quasirigid_study::modes::{Modes, PrincipalAxis, SteadySpinSettings};
use quasirigid_study::settings::{PartialEvolve, PartialRun, PartialSpinManifold};
use quasirigid_study::{Study, Watch};
use serde_json::Value;

pub use models::*;

pub const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
pub const SPIN: [&str; 3] = ["wx", "wy", "wz"];

/// File of an example.
pub fn file(example: &str) -> PathBuf {
    Path::new(ROOT).join("examples").join(example).join("model.toml")
}

/// Names of the examples that are quick, all but those of finite elements and networks.
pub fn examples() -> impl Iterator<Item = String> {
    const SLOW: [&str; 4] = ["apophis-shape", "quillen-network", "solar-panels", "spin-up-beam"];
    let names = std::fs::read_dir(format!("{ROOT}/examples")).unwrap();
    let names = names.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    names.filter(|name| file(name).is_file() && !SLOW.contains(&name.as_str()))
}

/// Text of an example.
pub fn example(name: &str) -> String {
    std::fs::read_to_string(file(name)).unwrap()
}

/// Study of an example.
pub fn study_of(example: &str) -> Study {
    Study::open(file(example), None).unwrap()
}

/// Study of the text of a model.
#[track_caller]
pub fn study(model: &str) -> Study {
    of_order(model, None)
}

/// Study at an order of the reduced equations.
#[track_caller]
pub fn of_order(model: &str, order: impl Into<Option<usize>>) -> Study {
    let opened = Study::read_from(Path::new("model.toml"), model.as_bytes(), order.into());
    opened.unwrap_or_else(|error| panic!("{error}\n{model}"))
}

/// Table of a system of equations at times (s).
pub fn table(system: System, times: &[f64]) -> Table {
    let manifold = PartialSpinManifold::default();
    Table {
        system: Some(system),
        coordinates: false,
        displacements: false,
        times: Some(times.to_vec()),
        manifold,
    }
}

/// Table with coordinates and displacements.
pub fn whole_table(system: System, times: &[f64]) -> Table {
    Table { coordinates: true, displacements: true, ..table(system, times) }
}

/// History of a system of equations at times (s), with the usual settings.
#[track_caller]
pub fn follow(study: &Study, system: System, times: &[f64]) -> History {
    history(study, &table(system, times), PartialRun::default())
}

/// History of a system that is followed to its end.
#[track_caller]
pub fn finished(study: &Study, system: System, times: &[f64]) -> History {
    let found = follow(study, system, times);
    assert!(found.holds() && found.status == "finished", "{:?}: {}", found.system, found.message);
    found
}

/// History with settings of its own.
#[track_caller]
pub fn history(study: &Study, table: &Table, propagation: PartialRun) -> History {
    study.simulate(&propagation, table, &mut ()).unwrap_or_else(|error| panic!("{error}"))
}

/// Remarks of work that goes on to its end.
#[derive(Default)]
pub struct Remarks(pub Vec<String>);

impl Watch for Remarks {
    fn at(&mut self, _: &str, _: f64) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    fn remark(&mut self, sentence: &str) {
        self.0.push(sentence.to_owned());
    }
}

/// History with what is remarked before the work and noted after it, in one text.
#[track_caller]
pub fn told_history(study: &Study, table: &Table, propagation: PartialRun) -> (History, String) {
    let mut remarks = Remarks::default();
    let found = study.simulate(&propagation, table, &mut remarks).unwrap_or_else(|error| panic!("{error}"));
    let said = [remarks.0.as_slice(), &found.notes].concat().join(" ");
    (found, said)
}

/// Evolution with settings beside those of the file.
#[track_caller]
pub fn evolved(study: &Study, set: impl FnOnce(&mut PartialEvolve)) -> Evolved {
    try_evolve(study, set).unwrap_or_else(|error| panic!("{error}"))
}

/// Record of an evolution by the settings of the file.
#[track_caller]
pub fn evolve(model: &str) -> EvolutionRecord {
    evolved(&study(model), |_| {}).record
}

/// The same on a machine so busy that a choice which takes too long is refused: that choice is asked for by name.
#[track_caller]
pub fn evolve_in_any_time(model: &str) -> EvolutionRecord {
    let study = study(model);
    let found = evolved(&study, |_| {}).record;
    let Some((_, method)) = found.message.split_once("ask for the method ") else { return found };
    let method = method.split(' ').next().and_then(EvolveMethod::of);
    evolved(&study, |asked| asked.method = method).record
}

/// Evolution, or the words in which it is refused.
pub fn try_evolve(study: &Study, set: impl FnOnce(&mut PartialEvolve)) -> Result<Evolved, String> {
    let mut asked = PartialEvolve::default();
    set(&mut asked);
    study.evolve(asked, &mut ()).map_err(|error| error.to_string())
}

/// Target or start of an evolution, as a file has it.
pub fn target(text: &str) -> Option<Target> {
    Some(text.parse().unwrap())
}

/// Modes about the steady spin next to a principal axis.
#[track_caller]
pub fn modes_about(study: &Study, axis: PrincipalAxis) -> Modes {
    study.modes(SteadySpinSettings { axis: Some(axis), ..SteadySpinSettings::default() }).unwrap()
}

/// Modes about the steady spins of the start, or about the steady state.
#[track_caller]
pub fn modes(study: &Study) -> Modes {
    study.modes(SteadySpinSettings::default()).unwrap_or_else(|error| panic!("{error}"))
}

/// The mode with this name.
#[track_caller]
pub fn mode<'a>(modes: &'a [ModeRecord], name: &str) -> &'a ModeRecord {
    modes.iter().find(|mode| mode.name == name).unwrap_or_else(|| panic!("{name} in {modes:#?}"))
}

/// Time constant (s) of the nutation about the first steady spin.
#[track_caller]
pub fn nutation(modes: &Modes) -> f64 {
    mode(&modes.spins[0].modes, "nutation").time_constant.unwrap()
}

/// Values of a column.
#[track_caller]
pub fn column<'a>(columns: &'a [Column], name: &str) -> &'a [f64] {
    let found = columns.iter().find(|column| column.name == name);
    &found.unwrap_or_else(|| panic!("no column {name}")).values
}

/// A vector of three columns in one row.
#[track_caller]
pub fn vector(columns: &[Column], names: [&str; 3], row: usize) -> [f64; 3] {
    names.map(|name| column(columns, name)[row])
}

/// Rows of a published table, of some of its columns.
pub fn published<const N: usize>(file: &str, names: [&str; N]) -> Vec<[f64; N]> {
    let text = std::fs::read_to_string(format!("{ROOT}/data/published/{file}")).unwrap();
    let mut lines = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let header = lines.next().unwrap();
    let places = names.map(|name| header.iter().position(|column| *column == name).unwrap());
    lines.map(|row| places.map(|place| row[place].parse().unwrap())).collect()
}

/// Numbers of a JSON array, nested ones in a row.
pub fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(entries) => entries.iter().flat_map(numbers).collect(),
        number => vec![number.as_f64().unwrap()],
    }
}

#[track_caller]
pub fn close(found: f64, expected: f64, tolerance: f64) {
    assert!((found / expected - 1.0).abs() <= tolerance, "{found:e} {expected:e}");
}

/// Distance of two vectors relative to the second.
pub fn difference<const N: usize>(a: [f64; N], b: [f64; N]) -> f64 {
    let norm = |entries: [f64; N]| entries.iter().map(|x| x * x).sum::<f64>().sqrt();
    norm(std::array::from_fn(|i| a[i] - b[i])) / norm(b)
}

/// A text that was wrapped, on one line.
pub fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
