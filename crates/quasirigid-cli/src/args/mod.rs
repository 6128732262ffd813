//! Command line: commands and options, as `clap` derives them from these types.
//! Doc comments of commands and arguments are the text of `--help`, without a full stop at the end; tests compare some of them.
//! Flags of settings and their help come from the table of the study, and words from `Named`, so that flags and the model file have the
//! same names.

mod data;
mod equations;
mod history;
mod record;
mod spin;
mod study;
mod values;

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};
use quasirigid_study::settings::Setting;

pub use data::{InferArgs, LightcurveArgs, YorpArgs};
pub use equations::{About, Derive, DeriveFormat, ExportArgs};
pub use history::{Evolve, EvolveFormat, RunArgs, Simulate, Verify};
pub use record::{AuditArgs, DiffArgs, KeysArgs, NewArgs, PictureFormat, Plot, Report, Start};
pub use spin::{FillsArgs, LinearArgs, ModesArgs, SensitivityArgs};
pub use study::SweepArgs;
pub(crate) use values::named;
pub use values::{positive, positive_seconds, seconds};

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
