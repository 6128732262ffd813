//! Options of histories and evolutions: `run`, `simulate`, `verify`, `evolve`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use quasirigid::dynamics::{Form, Method};
use quasirigid_io::model::{EvolveMethod, Power, System};
use quasirigid_io::record::TableFormat;
use quasirigid_study::settings::{PartialRun, Setting};

use super::Common;
use super::equations::{About, SpinManifoldOptions};
use super::values::{named, seconds};
use crate::failure::Failure;
use crate::history_format::{AttitudeOptions, HistoryFormat};

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
pub struct Simulate {
    #[command(flatten)]
    pub common: Common,
    #[command(flatten)]
    pub run: RunOptions,
    /// System of equations to integrate [default: reduced, or full for a body with driven parts]
    #[arg(long, value_parser = named::<System>())]
    pub system: Option<System>,
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
