//! Model files: values that are read from them, and refusals of mistakes.

mod appendages;
mod baffles;
mod beams;
mod bodies;
mod change;
mod connections;
mod connections_refused;
mod controllers;
mod decks;
mod drives;
mod eddy_currents;
mod elements;
mod ellipsoids;
mod evolve;
mod files;
mod flybys;
mod forces;
mod guide;
mod initial;
mod inp_connectors;
mod inp_decks;
mod inp_equations;
mod inside;
mod keys;
mod laminated;
mod magnetic_control;
mod materials;
mod matrices;
mod matrices_refused;
mod modes;
mod networks;
mod orthotropic;
mod panels;
mod parts_refused;
mod physics;
mod reading;
mod reference;
mod rheology;
mod rings;
mod robustness;
mod rotation;
mod same;
mod sections;
mod settings;
mod sheets;
mod shorthands;
mod solids;
mod start_file;
mod sunlight;
mod surfaces;
mod tanks;
mod timing;
mod values;
mod voxel_densities;
mod voxels;

use std::fs;
use std::path::Path;

use quasirigid::elements::{Assembly, Carrier, Part};
use quasirigid_io::model::{Model, ModelError};
use tempfile::TempDir;

const CARRIER: &str = "[carrier]\nmass = 40.0\ncenter_of_mass = [0, 0.1, 0]\ninertia = [9.0, 13.0, 16.0]\n";
const POINT: &str = "[[point]]\nname = \"tip\"\nmass = 1.0\nposition = [0.8, 0.3, 0.5]\n";
const HINGED: &str = "[[hinged]]\nname = \"boom\"\nmass = 2\ncenter_of_mass = [1, 0, 0]\ninertia = [0, 1, 1]\nhinge = [0.5, 0, 0]\n";
const ELLIPSOID: &str = "[[ellipsoid]]\nsemi_axes = [2300, 1200, 950]\nmaterial = \"rock\"\n";
/// Keys of a material.
const ROCK: &str = "density = \"2.5 g/cm^3\"\nyoung = \"1 GPa\"\npoisson = 0.25\n";
/// A material and a section of beams.
const ALUMINIUM: &str = "[material.aluminium]\ndensity = 2700\nyoung = \"70 GPa\"\npoisson = 0.3\n";
const TUBE: &str = "[section.tube]\nshape = \"tube\"\nradius = \"3 cm\"\nthickness = \"2 mm\"\n";
/// A beam along x, to which a test adds lines.
const BOOM: &str = "[[beam]]\nname = \"boom\"\nnodes = { root = [1, 0, 0], tip = [3, 0, 0] }\nlines = [[\"root\", \"tip\"]]\n\
                    section = \"tube\"\nmaterial = \"aluminium\"\n";

fn read(text: &str) -> Model {
    Model::parse(Path::new("model.toml"), text).unwrap_or_else(|error| panic!("{error}"))
}

fn carrier(assembly: &Assembly) -> &Carrier {
    assembly.carrier.as_ref().expect("a carrier")
}

/// A file with an ellipsoid, and in line 4 its material with these lines.
fn made_of(lines: &str) -> String {
    format!("{ELLIPSOID}[material.rock]\n{lines}")
}

/// Refusal of a text.
fn refusal(text: &str) -> String {
    Model::parse(Path::new("model.toml"), text).expect_err("a refusal").to_string()
}

/// Refusal of a text after a good carrier and a good point; the text starts in line 9.
fn refusal_of(rest: &str) -> String {
    refusal(&format!("{CARRIER}{POINT}{rest}"))
}

/// Refusal of a spring between the point and the carrier with these further lines, which start in line 12.
fn refusal_of_spring(lines: &str) -> String {
    refusal_of(&format!("[[spring]]\nfrom = \"tip\"\nto = \"carrier\"\n{lines}"))
}

/// Refusal of a text, by its reading or by the laws of mechanics.
fn verdict(text: &str) -> String {
    told(Model::parse(Path::new("model.toml"), text))
}

/// Diagnostics of a model, from its reading or from the laws of mechanics.
fn told(read: Result<Model, ModelError>) -> String {
    let model = match read {
        Err(error) => return error.to_string(),
        Ok(model) => model,
    };
    let errors = model.assembly.check();
    if errors.is_empty() {
        model.diagnose(&model.assembly.body().expect_err("a refusal")).to_string()
    } else {
        model.diagnose_all(&errors).to_string()
    }
}

/// A model with this text beside files.
fn written(files: &[(&str, String)], text: &str) -> Result<Model, ModelError> {
    let files: Vec<(&str, &[u8])> = files.iter().map(|(name, text)| (*name, text.as_bytes())).collect();
    read_with(&files, text)
}

/// A model beside files.
fn read_with(files: &[(&str, &[u8])], text: &str) -> Result<Model, ModelError> {
    let folder = TempDir::new().expect("a folder");
    for (name, text) in files {
        fs::write(folder.path().join(name), text).expect("a file");
    }
    fs::write(folder.path().join("model.toml"), text).expect("a file");
    Model::read(&folder.path().join("model.toml"))
}

/// The only part of a body.
fn only_part(assembly: &Assembly) -> &Part {
    let [part] = &assembly.parts[..] else { panic!("one part") };
    part
}

/// A message without the folder that its files are in.
fn located(message: &impl ToString) -> String {
    let folder = |line: &str| {
        let words = line.split(' ').map(|word| match word.strip_prefix('/') {
            Some(path) => path.rsplit('/').next().unwrap_or(path),
            None => word,
        });
        words.collect::<Vec<_>>().join(" ")
    };
    message.to_string().lines().map(folder).collect::<Vec<_>>().join("\n")
}
