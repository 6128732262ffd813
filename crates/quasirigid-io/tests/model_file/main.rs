//! Model files: what is read from them, and how each mistake is refused.

mod elements;
mod ellipsoids;
mod evolve;
mod files;
mod forces;
mod guide;
mod initial;
mod keys;
mod materials;
mod physics;
mod reading;
mod rheology;
mod robustness;
mod rotation;
mod settings;
mod surfaces;
mod values;

use std::path::Path;

use quasirigid::elements::{Assembly, Carrier};
use quasirigid_io::model::Model;

const CARRIER: &str = "[carrier]\nmass = 40.0\ncenter_of_mass = [0, 0.1, 0]\ninertia = [9.0, 13.0, 16.0]\n";
const POINT: &str = "[[point]]\nname = \"tip\"\nmass = 1.0\nposition = [0.8, 0.3, 0.5]\n";
const HINGED: &str = "[[hinged]]\nname = \"boom\"\nmass = 2\ncenter_of_mass = [1, 0, 0]\ninertia = [0, 1, 1]\nhinge = [0.5, 0, 0]\n";
const ELLIPSOID: &str = "[[ellipsoid]]\nsemi_axes = [2300, 1200, 950]\nmaterial = \"rock\"\n";
/// Keys of a material.
const ROCK: &str = "density = \"2.5 g/cm^3\"\nyoung = \"1 GPa\"\npoisson = 0.25\n";

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

/// How a text is refused.
fn refusal(text: &str) -> String {
    Model::parse(Path::new("model.toml"), text).expect_err("a refusal").to_string()
}

/// How a text after a good carrier and a good point is refused; it starts in line 9.
fn refusal_of(rest: &str) -> String {
    refusal(&format!("{CARRIER}{POINT}{rest}"))
}

/// How a spring between the point and the carrier with these further lines is refused; they start in line 12.
fn refusal_of_spring(lines: &str) -> String {
    refusal_of(&format!("[[spring]]\nfrom = \"tip\"\nto = \"carrier\"\n{lines}"))
}
