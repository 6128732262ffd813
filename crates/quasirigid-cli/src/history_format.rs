//! Formats of a history on the disk: tables, and attitude files of other programs with what these say beside the numbers.

use std::path::Path;

use clap::Args;
use quasirigid_io::attitude::{AttitudeFormat, Epoch, InertialFrame, Labels, TimeSystem, creation_time};
use quasirigid_io::model::Named;
use quasirigid_io::record::TableFormat;

use crate::args::named;

/// Format of a history.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HistoryFormat {
    Table(TableFormat),
    Attitude(AttitudeFormat),
}

impl Named for HistoryFormat {
    const VALUES: &'static [(&'static str, Self, &'static str)] = &ALL;
}

const TABLES: usize = TableFormat::VALUES.len();

/// The formats of tables, then those of attitude files.
const ALL: [(&str, HistoryFormat, &str); TABLES + AttitudeFormat::VALUES.len()] = {
    let mut all = [of_table(0); TABLES + AttitudeFormat::VALUES.len()];
    let mut place = 0;
    while place < all.len() {
        all[place] = if place < TABLES { of_table(place) } else { of_attitude(place - TABLES) };
        place += 1;
    }
    all
};

const fn of_table(place: usize) -> (&'static str, HistoryFormat, &'static str) {
    let (name, format, meaning) = TableFormat::VALUES[place];
    (name, HistoryFormat::Table(format), meaning)
}

const fn of_attitude(place: usize) -> (&'static str, HistoryFormat, &'static str) {
    let (name, format, meaning) = AttitudeFormat::VALUES[place];
    (name, HistoryFormat::Attitude(format), meaning)
}

impl HistoryFormat {
    /// The format asked for, or that of the ending of a file, or CSV.
    pub fn of_file(asked: Option<Self>, out: Option<&Path>) -> Self {
        let ending = out.and_then(Path::extension).and_then(|ending| ending.to_str());
        let endings = Self::VALUES.iter().map(|(_, format, _)| *format);
        let told = endings.into_iter().find(|format| Some(format.ending()) == ending);
        asked.or(told).unwrap_or(Self::Table(TableFormat::Csv))
    }

    /// Ending of the names of files.
    pub fn ending(self) -> &'static str {
        match self {
            Self::Table(format) => format.ending(),
            Self::Attitude(format) => format.ending(),
        }
    }

    /// Whether files of the format are binary, and then have a place for what went into them.
    pub fn is_binary(self) -> bool {
        match self {
            Self::Table(format) => format != TableFormat::Csv,
            Self::Attitude(format) => format.is_binary(),
        }
    }
}

/// What attitude files say beside the numbers.
#[derive(Args, Debug)]
pub struct AttitudeOptions {
    /// Epoch of time zero in an attitude file [default: 2000-01-01T12:00:00]
    #[arg(long, value_name = "EPOCH")]
    epoch: Option<Epoch>,
    /// Time scale of the epoch [default: utc]
    #[arg(long, value_name = "SCALE", value_parser = named::<TimeSystem>())]
    time_system: Option<TimeSystem>,
    /// Inertial axes that those of the model stand for [default: icrf]
    #[arg(long, value_name = "AXES", value_parser = named::<InertialFrame>())]
    frame: Option<InertialFrame>,
    /// Leave angular velocities out of an attitude file
    #[arg(long)]
    without_rates: bool,
}

impl AttitudeOptions {
    /// Whether any is given.
    pub fn are_given(&self) -> bool {
        let Self { epoch, time_system, frame, without_rates } = self;
        epoch.is_some() || time_system.is_some() || frame.is_some() || *without_rates
    }

    /// The labels of a file of a body.
    pub fn labels(&self, object: &str) -> Labels {
        Labels {
            object: object.to_owned(),
            epoch: self.epoch,
            time_system: self.time_system.unwrap_or_default(),
            frame: self.frame.unwrap_or_default(),
            rates: !self.without_rates,
            created: creation_time(),
        }
    }
}
