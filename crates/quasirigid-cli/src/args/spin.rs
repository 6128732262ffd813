//! Options of questions about a spin: `modes`, `sensitivity`, `linear`, `fills`.

use std::path::PathBuf;

use clap::Args;
use quasirigid_io::model::KeyPath;
use quasirigid_io::study_file::Quantity;
use quasirigid_io::units::{Dimension, quantity};
use quasirigid_study::modes::PrincipalAxis;
use quasirigid_study::settings::Setting;

use super::Common;
use super::values::{named, numbers};

#[derive(Args, Debug)]
pub struct ModesArgs {
    #[command(flatten)]
    pub common: Common,
    #[arg(long, help = Setting::Spin.help(), value_name = "WX,WY,WZ", value_delimiter = ',', allow_hyphen_values = true)]
    pub spin: Option<Vec<f64>>,
    #[arg(long, help = Setting::Axis.help(), value_parser = named::<PrincipalAxis>())]
    pub axis: Option<PrincipalAxis>,
    /// List every mode, overdamped ones too
    #[arg(long)]
    pub all: bool,
    /// File for a certificate, with which tools/check_certificate.py checks the answer without this program
    #[arg(long, value_name = "FILE.json")]
    pub certificate: Option<PathBuf>,
    /// Replace the certificate if its file exists
    #[arg(long, requires = "certificate")]
    pub overwrite: bool,
    /// Give the cantilever modes instead, with the carrier held: participation factors and effective masses
    #[arg(long, conflicts_with_all = ["spin", "axis", "certificate"])]
    pub effective_masses: bool,
    /// Point that participation in rotations is about (m), in the file's frame [default: the centre of mass, or the point of the support]
    #[arg(
        long,
        value_name = "X,Y,Z",
        value_delimiter = ',',
        allow_hyphen_values = true,
        requires = "effective_masses"
    )]
    pub about: Option<Vec<f64>>,
}

#[derive(Args, Debug)]
pub struct SensitivityArgs {
    #[command(flatten)]
    pub common: Common,
    /// Quantity to differentiate, a path into the JSON object of a command: modes.nutation.time_constant, evolve.time
    #[arg(long, value_name = "QUANTITY", value_parser = str::parse::<Quantity>)]
    pub of: Quantity,
    /// Keys to vary, as in studies: spring.boom.stiffness, body.mass [default: every number outside [run]]
    #[arg(long, value_name = "KEYS", value_delimiter = ',', value_parser = str::parse::<KeyPath>)]
    pub with: Vec<KeyPath>,
    /// List every key
    #[arg(long)]
    pub all: bool,
    /// Draw the tornado of the keys into an .svg or .png file
    #[arg(long, value_name = "FILE")]
    pub figure: Option<PathBuf>,
    /// Replace the file
    #[arg(long, requires = "figure")]
    pub overwrite: bool,
}

#[derive(Args, Debug)]
pub struct LinearArgs {
    #[command(flatten)]
    pub common: Common,
    /// State that the model is about: rest, spin (next to the start), or an angular velocity WX,WY,WZ (rad/s) [default: spin, if there is one]
    #[arg(long, value_name = "STATE", allow_hyphen_values = true)]
    pub at: Option<String>,
    /// Frequencies (rad/s) between which materials and liquids are met [default: those of the body's own rates]
    #[arg(long, value_name = "LOW,HIGH", value_parser = band)]
    pub band: Option<[f64; 2]>,
    /// Write matrices and names into this file, .mat for MATLAB and Octave or .npz for NumPy
    #[arg(short, long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Replace the file
    #[arg(long, requires = "out")]
    pub overwrite: bool,
    /// Leave out states, of which so many are kept, and say how far the response is off
    #[arg(long, value_name = "METHOD", value_parser = ["balanced", "modal"], requires = "keep")]
    pub truncate: Option<String>,
    /// Number of states to keep
    #[arg(long, value_name = "N", requires = "truncate")]
    pub keep: Option<usize>,
    /// Inputs: torque.x, force.x, force.NODE.x, wheel.NAME.torque, hinge.NAME.torque, acceleration.x of a support [default: the torques]
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    pub inputs: Vec<String>,
    /// Outputs: rate.x, attitude.x, momentum.x, acceleration.NODE.x, displacement.NODE.x, wheel.NAME.speed or .momentum,
    /// hinge.NAME.angle or .rate, cavity.NAME.momentum.x, coordinate.NAME
    /// [default: the rates]
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    pub outputs: Vec<String>,
}

#[derive(Args, Debug)]
pub struct FillsArgs {
    #[command(flatten)]
    pub common: Common,
    /// Names of the tanks that are filled, all alike [default: every tank of revolution]
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub tank: Vec<String>,
    /// First and last fill, more than 0 and less than 1
    #[arg(long, value_name = "FIRST,LAST", value_parser = fills, default_value = "0.05,0.95")]
    pub fill: [f64; 2],
    /// First and last spin, with a unit or in rad/s, or one alone [default: half to twice that of the start]
    #[arg(long, value_name = "FIRST,LAST", value_parser = spins)]
    pub spin: Option<[f64; 2]>,
    /// Number of fills and of spins
    #[arg(long, value_name = "N,M", value_parser = counts, default_value = "20,20")]
    pub points: [usize; 2],
    /// Write the points into a .csv file, the figure into an .svg or .png file; several times for several
    #[arg(short, long, value_name = "FILE")]
    pub out: Vec<PathBuf>,
    /// Replace the files
    #[arg(long, requires = "out")]
    pub overwrite: bool,
}

/// Reads two fills.
fn fills(text: &str) -> Result<[f64; 2], String> {
    numbers(text).ok_or_else(|| "fills are two numbers, as 0.05,0.95".to_owned())
}

/// Reads numbers of fills and spins.
fn counts(text: &str) -> Result<[usize; 2], String> {
    numbers(text).ok_or_else(|| "give a number of fills and one of spins, as 20,20".to_owned())
}

/// Reads two spins, or one.
fn spins(text: &str) -> Result<[f64; 2], String> {
    let spin = |text: &str| match text.trim().parse() {
        Ok(rate) => Ok(rate),
        Err(_) => quantity(text.trim(), Dimension::ANGULAR_VELOCITY).map_err(|error| error.to_string()),
    };
    let ends = text.split(',').map(spin).collect::<Result<Vec<f64>, String>>()?;
    match ends[..] {
        [one] => Ok([one, one]),
        [first, last] => Ok([first, last]),
        _ => Err("give a first and a last spin, as 5rpm,60rpm, or one alone".to_owned()),
    }
}

/// Reads a band of frequencies (rad/s).
fn band(text: &str) -> Result<[f64; 2], String> {
    numbers(text).ok_or_else(|| "a band is two frequencies (rad/s), as 0.01,50".to_owned())
}
