//! Options of what is seen from outside: `infer`, `lightcurve`, `yorp`.

use std::path::PathBuf;

use clap::Args;
use quasirigid_io::estimate::{Estimate, Limits};
use quasirigid_io::model::{KeyPath, Named, System};
use quasirigid_io::plan::Sensor;
use quasirigid_study::infer::{Loss, Profiles};
use quasirigid_study::light_curve::{Phase, Scattering, phase, scattering};
use quasirigid_study::settings::Setting;

use super::Common;
use super::history::RunOptions;
use super::values::{named, numbers};

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

/// Reads a direction.
fn direction(text: &str) -> Result<[f64; 3], String> {
    numbers(text).ok_or_else(|| "a direction has three components, as 0.8,0.6,0".to_owned())
}
