//! Options of records and model files: `report`, `plot`, `diff`, `audit`, `keys`, `new`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use quasirigid_io::attitude::AttitudeFormat;

use super::values::named;
use crate::history_format::AttitudeOptions;

#[derive(Args, Debug)]
pub struct Report {
    /// Folder of a record, as `quasirigid run` writes it; of several, they are put side by side
    #[arg(value_name = "DIR", required = true)]
    pub folders: Vec<PathBuf>,
    /// File of the report [default: report.html in the folder; of several, comparison.html]
    #[arg(long, short, value_name = "FILE", conflicts_with = "gltf")]
    pub out: Option<PathBuf>,
    /// Open the report in the browser
    #[arg(long, conflicts_with = "gltf")]
    pub open: bool,
    /// Write body and motion as a binary glTF file in place of the report
    #[arg(long, value_name = "FILE.glb")]
    pub gltf: Option<PathBuf>,
    /// Write a history as an attitude file in place of the report
    #[arg(long, value_name = "FILE", conflicts_with_all = ["out", "gltf", "open"])]
    pub attitude: Option<PathBuf>,
    /// Format of the attitude file [default: that of its ending, .aem, .a, .msopck or .npz]
    #[arg(long, requires = "attitude", value_parser = named::<AttitudeFormat>())]
    pub format: Option<AttitudeFormat>,
    /// System of the history in it [default: the first of the record]
    #[arg(long, value_name = "SYSTEM", requires = "attitude")]
    pub system: Option<String>,
    #[command(flatten)]
    pub labels: AttitudeOptions,
    /// Seconds that the animation takes, for the whole run [default: 30]
    #[arg(long, value_name = "S", requires = "gltf", allow_hyphen_values = true)]
    pub duration: Option<f64>,
    /// Factor of the displacements in the animation [default: the largest is a twentieth of the body]
    #[arg(long, value_name = "X", requires = "gltf", allow_hyphen_values = true)]
    pub deformation: Option<f64>,
    /// Replace a file that is there
    #[arg(long)]
    pub overwrite: bool,
    /// Print nothing but errors
    #[arg(long, short)]
    pub quiet: bool,
}

#[derive(Args, Debug)]
pub struct Plot {
    /// Folder of a record, as `quasirigid run` writes it
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
    /// Name of the figure
    #[arg(long, value_name = "NAME")]
    pub figure: Option<String>,
    /// Format of the picture [default: that of the file's name, or svg]
    #[arg(long, value_enum, requires = "figure")]
    pub format: Option<PictureFormat>,
    /// File of the picture [default: the figure's name in the current folder]
    #[arg(long, short, value_name = "FILE", requires = "figure")]
    pub out: Option<PathBuf>,
    /// Width of a PNG picture in pixels [default: 1600]
    #[arg(long, value_name = "N", requires = "figure")]
    pub pixels: Option<u32>,
    /// Replace a file that is there
    #[arg(long)]
    pub overwrite: bool,
    /// Print nothing but errors
    #[arg(long, short)]
    pub quiet: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum PictureFormat {
    /// Curves, for papers
    Svg,
    /// Pixels, for slides
    Png,
}

impl PictureFormat {
    /// Ending of the names of files.
    pub fn ending(self) -> &'static str {
        match self {
            Self::Svg => "svg",
            Self::Png => "png",
        }
    }
}

#[derive(Args, Debug)]
pub struct DiffArgs {
    /// First result: the folder of a run or of a study, or a file of an answer with --json
    #[arg(value_name = "A")]
    pub first: PathBuf,
    /// Second result
    #[arg(value_name = "B")]
    pub second: PathBuf,
    /// Print the differences for machines, as one JSON object
    #[arg(long)]
    pub json: bool,
}

#[derive(Args, Debug)]
pub struct AuditArgs {
    /// History t,wx,wy,wz, perhaps with a quaternion: CSV and other tables in text, Parquet, NPZ, AEM or STK; several of one run at different
    /// steps; and the model of the body, a .toml file
    #[arg(value_name = "FILE", required = true)]
    pub files: Vec<PathBuf>,
    /// Inertia of the body in the axes of the rates (kg m^2): XX,YY,ZZ or XX,YY,ZZ,XY,XZ,YZ, entries of the tensor (XY = -int x y dm); only
    /// their ratios matter
    #[arg(long, value_name = "XX,YY,ZZ", value_delimiter = ',', allow_hyphen_values = true)]
    pub inertia: Option<Vec<f64>>,
    /// Largest relative change of energy and of angular momentum; above it the exit code is 1
    #[arg(long, value_name = "X")]
    pub limit: Option<f64>,
    /// Least time constant of an invented change of the wobble, in seconds or with a unit such as "1 yr"; below it the exit code is 1
    #[arg(long, value_name = "T")]
    pub min_time_constant: Option<String>,
    /// Step of the integrator in each of several histories (s) [default: the time between rows]
    #[arg(long, value_name = "S,S", value_delimiter = ',')]
    pub steps: Vec<f64>,
    /// Write a badge as JSON, in the form of an endpoint of shields.io
    #[arg(long, value_name = "FILE.json")]
    pub badge: Option<PathBuf>,
    /// Replace the file of the badge
    #[arg(long, requires = "badge")]
    pub overwrite: bool,
    /// Print the answer for machines, as one JSON object
    #[arg(long)]
    pub json: bool,
    /// Print nothing but results and errors
    #[arg(long, short)]
    pub quiet: bool,
}

#[derive(Args, Debug)]
pub struct KeysArgs {
    /// Table, such as spring, run or rheology [default: every table]
    #[arg(value_name = "TABLE")]
    pub table: Option<String>,
    /// Print the list for machines, as one JSON object
    #[arg(long)]
    pub json: bool,
}

#[derive(Args, Debug)]
pub struct NewArgs {
    /// Kind of body
    #[arg(value_name = "KIND", value_enum)]
    pub kind: Option<Start>,
    /// Folder for the model [default: named like the kind]
    #[arg(long, short, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Your file, of a kind that reads one
    #[arg(long, value_name = "FILE")]
    pub file: Option<PathBuf>,
    /// Print nothing but errors
    #[arg(long, short)]
    pub quiet: bool,
}

/// Kind of body that a model can start from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Start {
    /// A satellite with sprung tip masses
    BoomSatellite,
    /// A satellite with wings of layered panels
    Panels,
    /// A satellite with a momentum wheel and a nutation damper
    Wheel,
    /// A stage with a tank full of liquid
    Tank,
    /// A satellite with an elastic part from a mesh
    Mesh,
    /// A satellite as a finite-element model of NASTRAN
    Nastran,
    /// An asteroid by its shape
    Shape,
    /// An asteroid as an ellipsoid
    Ellipsoid,
    /// A tumbler with the two periods of its light curve
    LightCurve,
    /// Tumblers in a table
    Tumblers,
}
