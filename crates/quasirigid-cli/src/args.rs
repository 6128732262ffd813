//! Command line: commands and options, as `clap` derives them from these types.
//! Doc comments of commands and arguments are the text of `--help`, without a full stop at the end; tests compare some of them.
//! Names of settings come from `Named`, so that flags and the model file accept the same words.

use std::path::PathBuf;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, Parser, Subcommand, ValueEnum};
use quasirigid::dynamics::{Form, Method};
use quasirigid::submanifold::MAX_DEGREE;
use quasirigid_io::model::{EvolveMethod, ManifoldMasters, ManifoldStyle, Named, Power, System};
use quasirigid_io::record::TableFormat;
use quasirigid_study::modes::PrincipalAxis;
use quasirigid_study::sweep::Shard;

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
    /// Print the reduced equations
    #[command(
        after_help = "Example:\n  quasirigid derive examples/three-masses/model.toml --order 5 --format json"
    )]
    Derive(Derive),
    /// Propagate the spin and print a table
    #[command(
        after_help = "Example:\n  quasirigid simulate examples/axial-mass/model.toml --duration 60 --samples 7"
    )]
    Simulate(Simulate),
    /// Follow the averaged rotation over any number of revolutions
    #[command(after_help = "Example:\n  quasirigid evolve examples/apophis/model.toml --to 5deg")]
    Evolve(Evolve),
    /// Compare the full system with the reduced equations and measure the order of convergence
    #[command(
        after_help = "Example:\n  quasirigid verify examples/three-masses/model.toml --orders 1,2,3,4,5"
    )]
    Verify(Verify),
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
    /// Print the references of what the model uses, as BibTeX
    #[command(after_help = "Example:\n  quasirigid cite examples/apophis/model.toml")]
    Cite(Common),
}

/// Model file and options of every command.
#[derive(Args, Debug)]
pub struct Common {
    /// Model file, or - for standard input
    #[arg(value_name = "MODEL.toml")]
    pub model: PathBuf,
    /// Order p of the reduced equations, 0 (rigid) to 12; the file's own, or 3 (the paper's)
    #[arg(long, value_name = "P", allow_hyphen_values = true)]
    pub order: Option<usize>,
    /// Print results for machines, as one JSON object
    #[arg(long)]
    pub json: bool,
    /// Print nothing but results and errors
    #[arg(long, short)]
    pub quiet: bool,
}

/// Options of a propagation.
#[derive(Args, Debug)]
pub struct Propagation {
    /// Duration, in seconds or with a unit such as "2 h"; the file's own, or a hundred revolutions
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    pub duration: Option<String>,
    /// Error allowed per step, relative, 1e-15 to 1e-2 [default: 1e-12]
    #[arg(long, value_name = "X", allow_hyphen_values = true)]
    pub tolerance: Option<f64>,
    /// Number of output times, spread evenly from the start to the end
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pub samples: Option<usize>,
    /// Variable that is integrated: the angular momentum, which keeps |K| exactly, or the angular velocity, as in the paper
    #[arg(long, value_parser = named::<Form>())]
    pub form: Option<Form>,
    /// Integrator of the full system [default: automatic]
    #[arg(long, value_parser = named::<Method>())]
    pub method: Option<Method>,
}

#[derive(Args, Debug)]
pub struct RunArgs {
    #[command(flatten)]
    pub common: Common,
    #[command(flatten)]
    pub propagation: Propagation,
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
    /// Write body and motion as a binary glTF file in the place of the report
    #[arg(long, value_name = "FILE.glb")]
    pub gltf: Option<PathBuf>,
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
pub struct ModesArgs {
    #[command(flatten)]
    pub common: Common,
    /// Angular velocity (rad/s): the steady spin nearest to its direction, with its size [default: the angular momentum of the
    /// start, about both axes of extreme inertia]
    #[arg(long, value_name = "WX,WY,WZ", value_delimiter = ',', allow_hyphen_values = true)]
    pub spin: Option<Vec<f64>>,
    /// Principal axis to spin about
    #[arg(long, value_parser = named::<PrincipalAxis>())]
    pub axis: Option<PrincipalAxis>,
    /// List every mode, overdamped ones too
    #[arg(long)]
    pub all: bool,
}

/// Options of the reduced equations about a spin.
#[derive(Args, Debug)]
pub struct Manifold {
    /// Degree of the reduced equations about the spin in the amplitude, 1 to 11 [default: the file's, or 5]
    #[arg(long, value_name = "N", value_parser = degree)]
    pub degree: Option<usize>,
    /// Modes that they follow: automatic, nutation, or frequencies in rad/s beside the nutation [default: the file's, or automatic]
    #[arg(long, value_name = "WHICH", value_parser = str::parse::<ManifoldMasters>)]
    pub masters: Option<ManifoldMasters>,
    /// Style of the equations about the spin [default: the file's, or normal-form]
    #[arg(long, value_parser = named::<ManifoldStyle>())]
    pub style: Option<ManifoldStyle>,
}

impl Manifold {
    /// Whether one of the options is given.
    pub fn is_given(&self) -> bool {
        self.degree.is_some() || self.masters.is_some() || self.style.is_some()
    }
}

/// Reads a degree of the reduced equations about a spin.
fn degree(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(degree) if (1..=MAX_DEGREE).contains(&degree) => Ok(degree),
        _ => Err(format!("a degree of the reduced equations about a spin lies from 1 to {MAX_DEGREE}")),
    }
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
    pub manifold: Manifold,
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
pub struct Simulate {
    #[command(flatten)]
    pub common: Common,
    #[command(flatten)]
    pub propagation: Propagation,
    /// System of equations to integrate
    #[arg(long, value_parser = named::<System>(), default_value = System::Reduced.name())]
    pub system: System,
    #[command(flatten)]
    pub manifold: Manifold,
    /// Add the internal coordinates and their rates to the table of the full system
    #[arg(long)]
    pub coordinates: bool,
    /// Add the displacements of points, appendages and nodes to the table of the full system
    #[arg(long)]
    pub displacements: bool,
    /// Output times in seconds, separated by commas
    #[arg(long, value_name = "A,B,C", value_delimiter = ',', allow_hyphen_values = true)]
    #[arg(conflicts_with_all = ["duration", "samples"])]
    pub times: Option<Vec<f64>>,
    /// Format of the table
    #[arg(long, value_parser = named::<TableFormat>(), default_value = TableFormat::Csv.name())]
    pub format: TableFormat,
    /// File for the table [default: standard output, or none with --json]
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Replace the file if it is there
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
    pub manifold: Manifold,
    /// Largest amplitude of the nutation about the spin, in degrees [default: 2.86, 0.05 rad]
    #[arg(long, value_name = "DEGREES")]
    pub amplitude: Option<f64>,
    /// Orders to verify, separated by commas [default: 1 to the model's order; from 0 with rotors or liquids; about the spin degrees 1 to 3]
    #[arg(long, value_name = "P,P,P", value_delimiter = ',', allow_hyphen_values = true)]
    pub orders: Option<Vec<usize>>,
    /// Revolutions of each history [default: 5]; about the spin periods of the nutation [default: 1]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pub rotations: Option<f64>,
    /// How often epsilon is halved [default: 4]; about the spin the amplitude [default: 3]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pub halvings: Option<usize>,
}

#[derive(Args, Debug)]
pub struct Evolve {
    #[command(flatten)]
    pub common: Common,
    /// Where to start: D/I3 = |K|^2/2EI3 as 0.9 or "90% of I3", or the greatest wobble about the axis of greatest inertia as
    /// "20 deg" [default: the initial state]
    #[arg(long, value_name = "X", allow_hyphen_values = true, alias = "start")]
    pub from: Option<String>,
    /// Where to end, in the same form [default: the file's, or 1 % of the energy of the wobble left]
    #[arg(long, value_name = "Y", allow_hyphen_values = true, alias = "until")]
    pub to: Option<String>,
    /// Longest time, in seconds or with a unit such as "10 Gyr" [default: the file's, or none]
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    pub duration: Option<String>,
    /// Number of rows [default: the file's, or 201]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=1_000_000))]
    pub samples: Option<u32>,
    /// Source of the mean power [default: the file's, or harmonics where a material needs them]
    #[arg(long, value_parser = named::<Power>())]
    pub power: Option<Power>,
    /// Method of the evolution [default: the file's, or the one that holds]
    #[arg(long, value_parser = named::<EvolveMethod>())]
    pub method: Option<EvolveMethod>,
    /// Draws of the keys in [uncertainty], for intervals of the time and the revolutions
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=10_000_000))]
    #[arg(conflicts_with_all = ["from", "to", "duration", "samples", "power", "method", "order"])]
    pub samples_of_uncertainty: Option<u32>,
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
    /// Number of threads, on which no result depends [default: as many as there are]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Print the model of one row and its answers, and write nothing
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

/// Reads a setting that is one of a few.
fn named<T: Named>() -> impl TypedValueParser<Value = T> {
    let value = |(name, _, help): &(&'static str, T, &'static str)| match *help {
        "" => PossibleValue::new(*name),
        help => PossibleValue::new(*name).help(help),
    };
    PossibleValuesParser::new(T::VALUES.iter().map(value))
        .try_map(|name| T::of(&name).ok_or("no such setting"))
}
