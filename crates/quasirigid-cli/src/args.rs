//! Command line: commands and options, as `clap` derives them from these types.
//! Doc comments of commands and arguments are the text of `--help`, without a full stop at the end; tests compare some of them.
//! Flags of settings and their help come from the table of the study, and words from `Named`, so that flags and the model file have the
//! same names.

use std::path::PathBuf;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, Parser, Subcommand, ValueEnum};
use quasirigid::dynamics::{Form, Method};
use quasirigid_io::attitude::AttitudeFormat;
use quasirigid_io::estimate::{Estimate, Limits};
use quasirigid_io::export::Target;
use quasirigid_io::model::{EvolveMethod, KeyPath, ManifoldMasters, ManifoldStyle, Named, Power, System};
use quasirigid_io::plan::Sensor;
use quasirigid_io::record::TableFormat;
use quasirigid_io::study_file::Quantity;
use quasirigid_io::units::{Dimension, quantity};
use quasirigid_study::infer::{Loss, Profiles};
use quasirigid_study::light_curve::{Phase, Scattering, phase, scattering};
use quasirigid_study::modes::PrincipalAxis;
use quasirigid_study::settings::{PartialRun, PartialSpinManifold, Range, Setting};
use quasirigid_study::sweep::Shard;

use crate::failure::Failure;
use crate::history_format::{AttitudeOptions, HistoryFormat};

/// How does a body that is almost rigid, but bends and dissipates a little, change its spin?
///
/// Reads a model of the body (TOML), derives its reduced equations of motion after Chernousko (1978), says how far they
/// hold, and integrates them.
#[derive(Debug, Parser)]
#[command(name = "quasirigid", version, max_term_width = 80)]
#[command(after_help = "Exit codes: 0 done, 1 done but a requested check failed, 2 could not run.")]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Command,
}

#[derive(Debug, Subcommand)]
pub enum Command {
    /// The main job: check, reduce, propagate, and write a record with its report
    #[command(after_help = "Example:\n  quasirigid run examples/three-masses/model.toml -o spin")]
    Run(RunArgs),
    /// Say how far the reduced equations hold, in words and numbers
    #[command(after_help = "Example:\n  quasirigid check examples/explorer1/model.toml")]
    Check(Common),
    /// Find the steady spin and the modes about it: time constants, stability, shares of the dissipation
    #[command(after_help = "Example:\n  quasirigid modes examples/nutation-damper/model.toml")]
    Modes(ModesArgs),
    /// Give the linear model about rest or a steady spin: A, B, C and D between named inputs and outputs
    #[command(
        after_help = "Example:\n  quasirigid linear examples/boom-satellite/model.toml --at rest --json"
    )]
    Linear(LinearArgs),
    /// Map the time constants over the fill of the tanks and the spin, and name the worst fill
    #[command(after_help = "Example:\n  quasirigid fills examples/two-tanks/model.toml -o fills.svg")]
    Fills(FillsArgs),
    /// Give the light curve of the rotating body, compare it with a measured one, and find its frequencies
    #[command(
        after_help = "Example:\n  quasirigid lightcurve examples/duende/model.toml --sun 1,0,0 --observer 0,1,0"
    )]
    Lightcurve(LightcurveArgs),
    /// Give the mean torque of sunlight by the obliquity: how fast the spin rises or falls, and its axis tilts
    #[command(
        after_help = "Example:\n  quasirigid yorp examples/sunlit-rock/model.toml --thermal-inertia 200"
    )]
    Yorp(YorpArgs),
    /// Print the reduced equations
    #[command(
        after_help = "Example:\n  quasirigid derive examples/three-masses/model.toml --order 5 --format json"
    )]
    Derive(Derive),
    /// Write the reduced equations, which cannot gain energy, as source of another language
    #[command(after_help = "Example:\n  quasirigid export examples/boom-satellite/model.toml --to c -o boom")]
    Export(ExportArgs),
    /// Propagate the spin and print a table
    #[command(
        after_help = "Example:\n  quasirigid simulate examples/axial-mass/model.toml --duration 60 --samples 7"
    )]
    Simulate(Simulate),
    /// Follow the averaged rotation over any number of revolutions
    #[command(after_help = "Example:\n  quasirigid evolve examples/apophis/model.toml --until 5deg")]
    Evolve(Evolve),
    /// Compare the full system with the reduced equations and measure the order of convergence
    #[command(
        after_help = "Example:\n  quasirigid verify examples/three-masses/model.toml --orders 1,2,3,4,5"
    )]
    Verify(Verify),
    /// Say which numbers of a model matter most for an answer: its derivatives with respect to keys
    #[command(after_help = "Example:\n  quasirigid sensitivity examples/apophis/model.toml --of evolve.time")]
    Sensitivity(SensitivityArgs),
    /// Infer numbers of a model from measurements, with their deviations and what the data do not tell
    #[command(
        after_help = "Example:\n  quasirigid infer examples/heavy-top/model.toml --data HISTORY.csv --vary KEY"
    )]
    Infer(InferArgs),
    /// Answer the same question of many bodies: grids, random draws, a table of bodies
    #[command(after_help = "Example:\n  quasirigid sweep examples/damper-study/study.toml -o damper")]
    Sweep(SweepArgs),
    /// Make the report of a record again, a comparison of several, or the body in motion as a glTF file for other viewers
    #[command(
        after_help = "Examples:\n  quasirigid report spin --open\n  quasirigid report light-damper heavy-damper -o comparison.html\n  quasirigid report spin --gltf spin.glb"
    )]
    Report(Report),
    /// Draw one figure of a record as a file for a paper or a slide; without a figure, list them
    #[command(after_help = "Example:\n  quasirigid plot spin --figure nutation --format png")]
    Plot(Plot),
    /// Say in words which inputs and which answers of two results differ
    #[command(
        after_help = "Examples:\n  quasirigid diff light-damper heavy-damper\n  quasirigid diff before.json after.json\n\nExit codes: 0 the same, 1 different, 2 could not run."
    )]
    Diff(DiffArgs),
    /// Say whether another program's history of a free body invents damping, and how fast
    #[command(
        after_help = "Examples:\n  quasirigid audit examples/invented-damping/euler.csv --inertia 10,14,17\n  quasirigid audit coarse.csv fine.csv model.toml --limit 1e-6\n\nExit codes: 0 done, 1 a limit is not kept or the history does not fit, 2 could not run."
    )]
    Audit(AuditArgs),
    /// List the keys of the model file, with their values and meanings
    #[command(after_help = "Example:\n  quasirigid keys spring")]
    Keys(KeysArgs),
    /// Print the JSON Schema of the model file, by which editors complete and check it
    #[command(after_help = "Example:\n  quasirigid schema > schema.json")]
    Schema,
    /// Write a commented model to start from; without a kind, list them
    #[command(
        after_help = "Examples:\n  quasirigid new boom-satellite\n  quasirigid new shape --file asteroid.obj -o asteroid"
    )]
    New(NewArgs),
    /// Print the references of what the model uses, as BibTeX
    #[command(after_help = "Example:\n  quasirigid cite examples/apophis/model.toml")]
    Cite(Common),
}

impl Command {
    /// Whether the command prints no notes.
    pub fn is_quiet(&self) -> bool {
        match self {
            Self::Run(RunArgs { common, .. })
            | Self::Modes(ModesArgs { common, .. })
            | Self::Linear(LinearArgs { common, .. })
            | Self::Fills(FillsArgs { common, .. })
            | Self::Lightcurve(LightcurveArgs { common, .. })
            | Self::Yorp(YorpArgs { common, .. })
            | Self::Sensitivity(SensitivityArgs { common, .. })
            | Self::Infer(InferArgs { common, .. })
            | Self::Derive(Derive { common, .. })
            | Self::Export(ExportArgs { common, .. })
            | Self::Simulate(Simulate { common, .. })
            | Self::Evolve(Evolve { common, .. })
            | Self::Verify(Verify { common, .. }) => common.quiet,
            Self::Check(common) | Self::Cite(common) => common.quiet,
            Self::Keys(_) | Self::Schema | Self::Diff(_) => false,
            Self::New(NewArgs { quiet, .. }) | Self::Audit(AuditArgs { quiet, .. }) => *quiet,
            Self::Sweep(SweepArgs { quiet, .. })
            | Self::Report(Report { quiet, .. })
            | Self::Plot(Plot { quiet, .. }) => *quiet,
        }
    }
}

/// Model file and options of every command.
#[derive(Args, Debug)]
pub struct Common {
    /// Model file, or - for standard input
    #[arg(value_name = "MODEL.toml")]
    pub model: PathBuf,
    #[arg(long, help = Setting::Order.help(), value_name = "P", allow_hyphen_values = true)]
    pub order: Option<usize>,
    /// Print results for machines, as one JSON object
    #[arg(long)]
    pub json: bool,
    /// Print nothing but results and errors
    #[arg(long, short)]
    pub quiet: bool,
}

/// Options of histories.
#[derive(Args, Debug)]
pub struct RunOptions {
    #[arg(long, help = Setting::Duration.help(), value_name = "T", allow_hyphen_values = true)]
    pub duration: Option<String>,
    #[arg(long, help = Setting::Tolerance.help(), value_name = "X", allow_hyphen_values = true)]
    pub tolerance: Option<f64>,
    #[arg(long, help = Setting::Samples.help(), value_name = "N", allow_hyphen_values = true)]
    pub samples: Option<usize>,
    #[arg(long, help = Setting::Form.help(), value_parser = named::<Form>())]
    pub form: Option<Form>,
    #[arg(long, help = Setting::Integrator.help(), alias = Setting::Integrator.former())]
    #[arg(value_parser = named::<Method>())]
    pub integrator: Option<Method>,
}

impl RunOptions {
    /// The settings that are given.
    pub fn partial(&self) -> Result<PartialRun, Failure> {
        let Self { duration, tolerance, samples, form, integrator } = self;
        Ok(PartialRun {
            duration: duration.as_deref().map(seconds).transpose()?,
            tolerance: *tolerance,
            samples: *samples,
            form: *form,
            integrator: *integrator,
        })
    }
}

#[derive(Args, Debug)]
pub struct RunArgs {
    #[command(flatten)]
    pub common: Common,
    #[command(flatten)]
    pub run: RunOptions,
    /// Folder for the record and report.html [default: the model's name with -run]
    #[arg(long, short, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Formats of the tables, separated by commas [default: csv, or parquet for histories over 100000 rows]
    #[arg(long, value_name = "FORMAT", value_delimiter = ',', value_parser = named::<TableFormat>())]
    pub tables: Option<Vec<TableFormat>>,
    /// Replace the folder if it is there
    #[arg(long)]
    pub overwrite: bool,
    /// Go on with a run that was cut off, with the same bits
    #[arg(long)]
    pub resume: bool,
    /// Open the report in the browser
    #[arg(long)]
    pub open: bool,
}

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
pub struct InferArgs {
    #[command(flatten)]
    pub common: Common,
    /// Measured history: t and columns as simulate names them, each perhaps with sigma_ and its name
    #[arg(long, value_name = "FILE", required_unless_present_any = ["measured", "design"])]
    pub data: Option<PathBuf>,
    /// Measured answer of a command, as studies name it, or a file with one in each line: 'evolve.time = 12 h +- 1 h'
    #[arg(long, value_name = "ANSWER")]
    pub measured: Vec<String>,
    /// Keys to infer, as in studies: spring.boom.damping, initial.angular_velocity.1
    #[arg(long, value_name = "KEYS", value_delimiter = ',', required = true, value_parser = str::parse::<KeyPath>)]
    pub vary: Vec<KeyPath>,
    /// Standard deviation of columns that have none in the file, in their units
    #[arg(long, value_name = "SIGMA")]
    pub sigma: Option<f64>,
    /// Mean and standard deviation of a key that is known beforehand: 'KEY = 40 N/m +- 5 %'
    #[arg(long, value_name = "PRIOR", value_parser = str::parse::<Estimate>)]
    pub prior: Vec<Estimate>,
    /// Range of a key: 'KEY = 0.02..0.2', 'KEY = 10 N/m ..'
    #[arg(long, value_name = "RANGE", value_parser = str::parse::<Limits>)]
    pub range: Vec<Limits>,
    /// How much a residual counts: robust losses leave outliers little weight
    #[arg(long, value_parser = named::<Loss>(), default_value = "squares")]
    pub loss: Loss,
    /// Deviations beyond which a robust loss is no square [default: 1.345 of huber, 1.287 of soft-l1]
    #[arg(long, value_name = "X")]
    pub loss_scale: Option<f64>,
    /// Starts of the search beside that of the file, within the ranges of the keys or 20 % of the file
    #[arg(long, value_name = "N", default_value_t = 2)]
    pub starts: usize,
    /// Keys whose intervals are those of the profile likelihood
    #[arg(long, value_parser = named::<Profiles>(), default_value = "auto")]
    pub profile: Profiles,
    /// Draw the fit with its residuals into an .svg or .png file
    #[arg(long, value_name = "FILE")]
    pub figure: Option<PathBuf>,
    /// Replace the file
    #[arg(long, requires = "figure")]
    pub overwrite: bool,
    #[arg(long, help = Setting::System.help(), value_parser = named::<System>(), default_value = "reduced")]
    pub system: System,
    /// Without data: say which of planned sensors and manoeuvres would tell the keys best
    #[arg(long, requires = "sensor", conflicts_with_all = ["data", "measured", "range", "figure"])]
    pub design: bool,
    /// Sensor of a design, with the deviation of its values: 'wx,wy +- 0.5 mrad/s', 'modes.nutation.frequency +- 1 %'
    #[arg(long, value_name = "SENSOR", requires = "design", value_parser = str::parse::<Sensor>)]
    pub sensor: Vec<Sensor>,
    /// Another motion of a design: changes of the model, 'initial.wobble.angle = 5 deg; ...', or a model file
    #[arg(long, value_name = "CHANGES", requires = "design", alias = "maneuver")]
    pub manoeuvre: Vec<String>,
    /// Time for which columns of a design are measured [default: that of the model]
    #[arg(long, value_name = "T", requires = "design")]
    pub duration: Option<String>,
    /// Number of times in a design at which columns are measured
    #[arg(long, value_name = "N", requires = "design", default_value_t = 101)]
    pub samples: usize,
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

/// Options of light curves.
#[derive(Args, Debug)]
pub struct LightcurveArgs {
    #[command(flatten)]
    pub common: Common,
    #[command(flatten)]
    pub run: RunOptions,
    #[arg(long, help = Setting::System.help(), value_parser = named::<System>(), default_value = System::Reduced.name())]
    pub system: System,
    /// Direction from the body to the Sun, inertial axes
    #[arg(long, value_name = "X,Y,Z", value_parser = direction, allow_hyphen_values = true)]
    pub sun: Option<[f64; 3]>,
    /// Direction from the body to the observer, inertial axes
    #[arg(long, value_name = "X,Y,Z", value_parser = direction, allow_hyphen_values = true)]
    pub observer: Option<[f64; 3]>,
    /// Times and places of Sun and observer, perhaps with measured brightness: a table t or jd, sun_x, sun_y, sun_z, observer_x, observer_y,
    /// observer_z (au), brightness or magnitude, block; or a file lc.txt of DAMIT
    #[arg(long, value_name = "FILE", conflicts_with_all = ["sun", "observer", "duration", "samples"])]
    pub view: Option<PathBuf>,
    /// Julian date of the start of the model
    #[arg(long, value_name = "JD")]
    pub epoch: Option<f64>,
    /// Law of scattering: lommel-seeliger, lambert, mixed:C with the weight C of Lambert's law, or hapke:W,G,B0,H,DEGREES
    #[arg(long, value_name = "LAW", value_parser = scattering, default_value = "lommel-seeliger")]
    pub law: Scattering,
    /// Phase function beside the law: flat, surge:A,D,K for A exp(-alpha/D) + K alpha + 1 in radians, or hg:G
    #[arg(long, value_name = "PHASE", value_parser = phase, default_value = "flat")]
    pub phase: Phase,
    /// Geometric albedo, for magnitudes in V
    #[arg(long, value_name = "P")]
    pub albedo: Option<f64>,
    /// Absolute magnitude in V of a sphere with the mean cross-section, in place of the albedo
    #[arg(long, value_name = "H", conflicts_with = "albedo", allow_hyphen_values = true)]
    pub absolute_magnitude: Option<f64>,
    /// Find the frequencies of the curve, of the measured one where there is one
    #[arg(long)]
    pub periods: bool,
    /// Write the table into a .csv, .parquet or .npz file, the figure into an .svg or .png file, the curve into a .txt file of DAMIT or an
    /// .alcdef file; several times for several
    #[arg(short, long, value_name = "FILE")]
    pub out: Vec<PathBuf>,
    /// Replace the files
    #[arg(long, requires = "out")]
    pub overwrite: bool,
}

/// Options of YORP.
#[derive(Args, Debug)]
pub struct YorpArgs {
    #[command(flatten)]
    pub common: Common,
    /// Bond albedo; it matters where the heat lags
    #[arg(long, value_name = "A", default_value = "0.1")]
    pub albedo: f64,
    /// Emissivity
    #[arg(long, value_name = "E", default_value = "0.9")]
    pub emissivity: f64,
    /// Thermal inertia (J m^-2 K^-1 s^-1/2), by which the heat lags
    #[arg(long, value_name = "GAMMA", default_value = "0")]
    pub thermal_inertia: f64,
    /// Write the curves into a .csv, .parquet or .npz file, the figure into an .svg or .png file; several times for several
    #[arg(short, long, value_name = "FILE")]
    pub out: Vec<PathBuf>,
    /// Replace the files
    #[arg(long, requires = "out")]
    pub overwrite: bool,
}

/// Reads so many numbers.
fn numbers<T: std::str::FromStr, const N: usize>(text: &str) -> Option<[T; N]> {
    let found: Option<Vec<T>> = text.split(',').map(|number| number.trim().parse().ok()).collect();
    <[T; N]>::try_from(found?).ok()
}

/// Reads a direction.
fn direction(text: &str) -> Result<[f64; 3], String> {
    numbers(text).ok_or_else(|| "a direction has three components, as 0.8,0.6,0".to_owned())
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

/// Options of the reduced equations about a spin.
#[derive(Args, Debug)]
pub struct SpinManifoldOptions {
    #[arg(long, help = Setting::Degree.help(), value_name = "N", value_parser = degree)]
    pub degree: Option<usize>,
    #[arg(long, help = Setting::Masters.help(), value_name = "WHICH")]
    #[arg(value_parser = str::parse::<ManifoldMasters>)]
    pub masters: Option<ManifoldMasters>,
    #[arg(long, help = Setting::Style.help(), value_parser = named::<ManifoldStyle>())]
    pub style: Option<ManifoldStyle>,
}

impl SpinManifoldOptions {
    /// The settings that are given.
    pub fn partial(&self) -> PartialSpinManifold {
        let Self { degree, masters, style } = self;
        PartialSpinManifold { degree: *degree, masters: masters.clone(), style: *style }
    }

    /// Whether one of the options is given.
    pub fn is_given(&self) -> bool {
        self.partial() != PartialSpinManifold::default()
    }
}

/// Reads a band of frequencies (rad/s).
fn band(text: &str) -> Result<[f64; 2], String> {
    numbers(text).ok_or_else(|| "a band is two frequencies (rad/s), as 0.01,50".to_owned())
}

/// Reads a degree of the reduced equations about a spin.
fn degree(text: &str) -> Result<usize, String> {
    match (text.parse(), Setting::Degree.range()) {
        (Ok(degree), Range::Count(least, most)) if (least..=most).contains(&degree) => Ok(degree),
        (_, range) => Err(format!("a degree of the reduced equations about a spin lies from {range}")),
    }
}

/// A time (s) given on the command line.
pub fn seconds(text: &str) -> Result<f64, Failure> {
    match text.parse() {
        Ok(seconds) => Ok(seconds),
        Err(_) => quantity(text, Dimension::TIME)
            .map_err(|cause| Failure::Duration { text: text.to_owned(), cause: Box::new(cause) }),
    }
}

/// A positive time (s) of an option.
pub fn positive_seconds(option: &'static str, text: &str) -> Result<f64, Failure> {
    let read = text.parse().or_else(|_| quantity(text, Dimension::TIME));
    let seconds: f64 =
        read.map_err(|cause| Failure::Time { option, text: text.to_owned(), cause: Box::new(cause) })?;
    positive(option, seconds)
}

/// A positive number of an option.
pub fn positive(option: &'static str, value: f64) -> Result<f64, Failure> {
    if value > 0.0 && value.is_finite() { Ok(value) } else { Err(Failure::NotPositive { option, value }) }
}

/// State about which reduced equations expand.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum About {
    /// In the angular velocity: where the spin is slow beside the vibrations
    Rest,
    /// In the nutation about the steady spin: at any ratio of spin to vibrations
    Spin,
}

#[derive(Args, Debug)]
pub struct Derive {
    #[command(flatten)]
    pub common: Common,
    /// State about which the equations expand
    #[arg(long, value_enum, default_value_t = About::Rest)]
    pub about: About,
    #[command(flatten)]
    pub spin_manifold: SpinManifoldOptions,
    /// Principal axis of the steady spin [default: the one that the start circles]
    #[arg(long, value_parser = named::<PrincipalAxis>())]
    pub axis: Option<PrincipalAxis>,
    /// Format of the result
    #[arg(long, value_enum, default_value_t = DeriveFormat::Text)]
    pub format: DeriveFormat,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum DeriveFormat {
    /// Tables for people
    Text,
    /// One JSON object with every coefficient
    Json,
    /// Displays for a document that loads amsmath
    Latex,
}

#[derive(Args, Debug)]
pub struct ExportArgs {
    #[command(flatten)]
    pub common: Common,
    /// Language or tool
    #[arg(long, value_name = "TARGET", value_parser = target())]
    pub to: Target,
    /// File, or folder for C; names in the source are its name
    #[arg(long, short, value_name = "PATH")]
    pub out: PathBuf,
    /// Replace the file if it is there
    #[arg(long)]
    pub overwrite: bool,
}

/// Reads a target by its name.
fn target() -> impl TypedValueParser<Value = Target> {
    let values = Target::ALL.map(|(_, name, help)| PossibleValue::new(name).help(help));
    PossibleValuesParser::new(values).try_map(|name| Target::named(&name).ok_or("no such target"))
}

#[derive(Args, Debug)]
pub struct Simulate {
    #[command(flatten)]
    pub common: Common,
    #[command(flatten)]
    pub run: RunOptions,
    #[arg(long, help = Setting::System.help(), value_parser = named::<System>(), default_value = System::Reduced.name())]
    pub system: System,
    #[command(flatten)]
    pub spin_manifold: SpinManifoldOptions,
    #[arg(long, help = Setting::Coordinates.help())]
    pub coordinates: bool,
    #[arg(long, help = Setting::Displacements.help())]
    pub displacements: bool,
    /// Output times in seconds, separated by commas
    #[arg(long, value_name = "A,B,C", value_delimiter = ',', allow_hyphen_values = true)]
    #[arg(conflicts_with_all = ["duration", "samples"])]
    pub times: Option<Vec<f64>>,
    /// Format of the table, or attitude file of another program [default: that of the ending of --out, or csv]
    #[arg(long, value_parser = named::<HistoryFormat>())]
    pub format: Option<HistoryFormat>,
    #[command(flatten)]
    pub attitude: AttitudeOptions,
    /// File for the table [default: standard output, or none with --json]
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// File for a certificate, with which tools/check_certificate.py checks the rows without this program
    #[arg(long, value_name = "FILE.json")]
    pub certificate: Option<PathBuf>,
    /// Replace the files if they are there
    #[arg(long)]
    pub overwrite: bool,
}

#[derive(Args, Debug)]
pub struct Verify {
    #[command(flatten)]
    pub common: Common,
    /// State about which the equations expand
    #[arg(long, value_enum, default_value_t = About::Rest)]
    pub about: About,
    #[command(flatten)]
    pub spin_manifold: SpinManifoldOptions,
    #[arg(long, help = Setting::Amplitude.help(), value_name = "DEGREES")]
    pub amplitude: Option<f64>,
    #[arg(long, help = Setting::Orders.help(), value_name = "P,P,P", value_delimiter = ',', allow_hyphen_values = true)]
    pub orders: Option<Vec<usize>>,
    #[arg(long, help = Setting::Revolutions.help(), alias = Setting::Revolutions.former())]
    #[arg(value_name = "N", allow_hyphen_values = true)]
    pub revolutions: Option<f64>,
    #[arg(long, help = Setting::Halvings.help(), value_name = "N", allow_hyphen_values = true)]
    pub halvings: Option<usize>,
}

#[derive(Args, Debug)]
pub struct Evolve {
    #[command(flatten)]
    pub common: Common,
    #[arg(long, help = Setting::Start.help(), alias = Setting::Start.former())]
    #[arg(value_name = "X", allow_hyphen_values = true)]
    pub start: Option<String>,
    #[arg(long, help = Setting::Until.help(), alias = Setting::Until.former())]
    #[arg(value_name = "Y", allow_hyphen_values = true)]
    pub until: Option<String>,
    #[arg(long, help = Setting::EvolutionDuration.help(), value_name = "T", allow_hyphen_values = true)]
    pub duration: Option<String>,
    #[arg(long, help = Setting::EvolutionSamples.help(), value_name = "N", allow_hyphen_values = true)]
    pub samples: Option<usize>,
    #[arg(long, help = Setting::Power.help(), value_parser = named::<Power>())]
    pub power: Option<Power>,
    #[arg(long, help = Setting::Method.help(), value_parser = named::<EvolveMethod>())]
    pub method: Option<EvolveMethod>,
    #[arg(long, help = Setting::UncertaintySamples.help(), alias = Setting::UncertaintySamples.former())]
    #[arg(value_name = "N", allow_hyphen_values = true)]
    #[arg(conflicts_with_all = ["start", "until", "duration", "samples", "power", "method", "order"])]
    pub uncertainty_samples: Option<usize>,
    /// Format of the result on standard output
    #[arg(long, value_enum, default_value_t = EvolveFormat::Text)]
    pub format: EvolveFormat,
    /// File for the whole table as CSV
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Replace the file if it is there
    #[arg(long)]
    pub overwrite: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum EvolveFormat {
    /// The answer in words, with a short table
    Text,
    /// The whole table
    Csv,
}

#[derive(Args, Debug)]
pub struct SweepArgs {
    /// Study file: the model, what is varied in it, and what is asked
    #[arg(value_name = "STUDY.toml")]
    pub study: PathBuf,
    /// Folder for the results [default: the study's name with -sweep]
    #[arg(long, short, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Go on where an earlier run of the same study ended
    #[arg(long)]
    pub resume: bool,
    /// Share of the parts that this process answers, for job arrays; shards may share a folder
    #[arg(long, value_name = "K/N", value_parser = shard)]
    pub shard: Option<Shard>,
    #[arg(long, help = Setting::Threads.help(), value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Print the model of one row, counted from 1, and its answers, and write nothing
    #[arg(long, value_name = "I", conflicts_with_all = ["out", "resume", "shard", "threads"])]
    pub row: Option<u64>,
    /// Print results for machines, as one JSON object
    #[arg(long)]
    pub json: bool,
    /// Print nothing but errors, and with --json the result
    #[arg(long, short)]
    pub quiet: bool,
}

/// Reads a shard such as 1/3.
fn shard(text: &str) -> Result<Shard, String> {
    let numbers =
        text.split_once('/').and_then(|(index, count)| Some((index.parse().ok()?, count.parse().ok()?)));
    match numbers {
        Some((index, count)) if (1..=count).contains(&index) => Ok(Shard { index, count }),
        _ => Err("write K/N with K from 1 to N, such as 1/3".to_owned()),
    }
}

/// Reads a setting that is one of a few, by its name or a former one.
/// Parser of a word of a setting.
pub(crate) fn named<T: Named>() -> impl TypedValueParser<Value = T> {
    let value = |(name, value, help): &(&'static str, T, &'static str)| {
        let former = T::FORMER.iter().filter(|(_, renamed)| renamed == value).map(|(former, _)| *former);
        let possible = PossibleValue::new(*name).aliases(former);
        if help.is_empty() { possible } else { possible.help(*help) }
    };
    PossibleValuesParser::new(T::VALUES.iter().map(value))
        .try_map(|name| T::of(&name).ok_or("no such setting"))
}
