//! Options of reduced equations: `derive`, `export`, and those about a spin.

use std::path::PathBuf;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};
use quasirigid_io::export::Target;
use quasirigid_io::model::{ManifoldMasters, ManifoldStyle};
use quasirigid_study::modes::PrincipalAxis;
use quasirigid_study::settings::{PartialSpinManifold, Range, Setting};

use super::Common;
use super::values::named;

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

/// Reads a degree of the reduced equations about a spin.
fn degree(text: &str) -> Result<usize, String> {
    match (text.parse(), Setting::Degree.range()) {
        (Ok(degree), Range::Count(least, most)) if (least..=most).contains(&degree) => Ok(degree),
        (_, range) => Err(format!("a degree of the reduced equations about a spin lies from {range}")),
    }
}
