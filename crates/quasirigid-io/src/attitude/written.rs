//! Writing of a history as an attitude file: the formats, and what a file says beside the numbers.

use std::io::{Seek, Write};
use std::path::Path;
use std::time::{SystemTime, UNIX_EPOCH};

use super::error::Unwritten;
use super::rows::{Records, has_rates};
use super::{Epoch, TimeSystem, aem, basilisk, msopck, stk};
use crate::model::Named;
use crate::record::{Column, RowTable, Rows};

/// Format of an attitude file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AttitudeFormat {
    /// CCSDS attitude ephemeris message, version 2.0.
    Aem,
    /// CCSDS attitude ephemeris message, version 1.0.
    Aem1,
    /// Attitude file of STK.
    Stk,
    /// Input data of SPICE's `msopck`, which makes a C-kernel of them.
    Msopck,
    /// Arrays of Basilisk.
    Basilisk,
}

impl Named for AttitudeFormat {
    const VALUES: &'static [(&'static str, Self, &'static str)] = &[
        ("aem", Self::Aem, "attitude ephemeris message of CCSDS, version 2.0"),
        ("aem1", Self::Aem1, "the same, version 1.0"),
        ("stk", Self::Stk, "attitude file of STK"),
        ("msopck", Self::Msopck, "input of SPICE's msopck, which makes a C-kernel of it"),
        ("basilisk", Self::Basilisk, "times, sigma_BN and omega_BN_B as NumPy arrays"),
    ];
}

/// Inertial axes that those of a model stand for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum InertialFrame {
    /// International celestial reference frame.
    #[default]
    Icrf,
    /// Mean equator and equinox of J2000.
    Eme2000,
}

impl Named for InertialFrame {
    const VALUES: &'static [(&'static str, Self, &'static str)] = &[
        ("icrf", Self::Icrf, "international celestial reference frame"),
        ("eme2000", Self::Eme2000, "mean equator and equinox of J2000"),
    ];
}

impl Named for TimeSystem {
    const VALUES: &'static [(&'static str, Self, &'static str)] = &[
        ("utc", Self::Utc, ""),
        ("tai", Self::Uniform("TAI"), ""),
        ("tt", Self::Uniform("TT"), ""),
        ("tdb", Self::TDB, ""),
        ("gps", Self::Uniform("GPS"), ""),
    ];
}

impl InertialFrame {
    /// Its name in CCSDS messages.
    pub(super) fn ccsds(self) -> &'static str {
        match self {
            Self::Icrf => "ICRF",
            Self::Eme2000 => "EME2000",
        }
    }

    /// Its name in STK.
    pub(super) fn stk(self) -> &'static str {
        match self {
            Self::Icrf => "ICRF",
            Self::Eme2000 => "J2000",
        }
    }
}

/// What an attitude file says beside the numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Labels {
    /// Name of the body.
    pub object: String,
    /// Epoch of time zero; [`Epoch::J2000`] where none is given.
    pub epoch: Option<Epoch>,
    /// Time scale of the epoch.
    pub time_system: TimeSystem,
    /// Inertial axes of the model.
    pub frame: InertialFrame,
    /// Whether angular velocities are written.
    pub rates: bool,
    /// Time at which the file is made, UTC.
    pub created: Epoch,
}

impl Labels {
    /// The name of the body in letters that every format takes.
    pub(super) fn plain_object(&self) -> String {
        let plain: String = self
            .object
            .chars()
            .map(|letter| if matches!(letter, ' '..='~') { letter } else { '?' })
            .collect();
        let plain = plain.trim();
        if plain.is_empty() { "UNKNOWN".to_owned() } else { plain.chars().take(NAME).collect() }
    }

    /// Epoch of time zero.
    pub(super) fn start(&self) -> Epoch {
        self.epoch.unwrap_or(Epoch::J2000)
    }

    /// The epoch of a time (s) of the history.
    pub(super) fn at(&self, t: f64) -> Result<Epoch, Unwritten> {
        self.start().after(t).ok_or(Unwritten::Beyond { t, epoch: self.start() })
    }

    /// What the reader of a file must be told of axes and time, in lines.
    pub(super) fn sentences(&self, frame: &str) -> [String; 2] {
        let default = if self.epoch.is_none() { " by default" } else { "" };
        let (start, system) = (self.start(), self.time_system.label());
        [
            format!("Written by quasirigid {}", env!("CARGO_PKG_VERSION")),
            format!("Inertial axes of the model: {frame}; its time 0: {start} {system}{default}"),
        ]
    }
}

/// Time at which a file is made, UTC: that of the clock, or of `SOURCE_DATE_EPOCH` where a build must give the same bits again.
#[must_use]
pub fn creation_time() -> Epoch {
    let told = std::env::var("SOURCE_DATE_EPOCH").ok().and_then(|text| text.parse().ok());
    let seconds = told
        .unwrap_or_else(|| SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs()));
    Epoch::UNIX.after(seconds as f64).unwrap_or(Epoch::UNIX)
}

/// Most letters of a name: lines of CCSDS messages have at most 254.
const NAME: usize = 80;

impl AttitudeFormat {
    /// The format of the ending of a file.
    #[must_use]
    pub fn of_ending(file: &Path) -> Option<Self> {
        let ending = file.extension()?.to_str()?;
        Self::VALUES.iter().map(|(_, format, _)| *format).find(|format| format.ending() == ending)
    }

    /// Ending of the names of files.
    #[must_use]
    pub fn ending(self) -> &'static str {
        match self {
            Self::Aem | Self::Aem1 => "aem",
            Self::Stk => "a",
            Self::Msopck => "msopck",
            Self::Basilisk => "npz",
        }
    }

    /// Whether files of the format are binary.
    #[must_use]
    pub fn is_binary(self) -> bool {
        self == Self::Basilisk
    }

    /// Writes the history in a table with the columns `t`, `qw`, `qx`, `qy`, `qz` and perhaps `wx`, `wy`, `wz`, whose rows are those of
    /// the columns or of a log. What went into it, a text in JSON, is told in archives of NumPy.
    ///
    /// # Errors
    /// [`Unwritten`]; whatever is wrong with the history is told before the first byte.
    pub fn write(
        self,
        out: &mut (impl Write + Seek),
        (labels, inputs): (&Labels, Option<&str>),
        (columns, log): (&Vec<Column>, Option<&RowTable>),
    ) -> Result<(), Unwritten> {
        let rows: &dyn Rows = match log {
            Some(log) => log,
            None => columns,
        };
        let records = Records::of(columns, rows, labels)?;
        match self {
            Self::Aem => aem::write(out, aem::Version::Two, labels, &records),
            Self::Aem1 => aem::write(out, aem::Version::One, labels, &records),
            Self::Stk => stk::write(out, labels, &records),
            Self::Msopck => msopck::write(out, labels, &records),
            Self::Basilisk => basilisk::write(out, inputs, &records),
        }
    }

    /// The setup file that belongs to the data in these columns, of a format that has one; `data` names the file of the data.
    #[must_use]
    pub fn setup(self, labels: &Labels, columns: &[Column], data: &str) -> Option<String> {
        let rates = labels.rates && has_rates(columns);
        (self == Self::Msopck).then(|| msopck::setup(labels, rates, data))
    }
}

/// A history whose epochs of UTC are right: without a leap second in it.
pub(super) fn without_leap(labels: &Labels, records: &Records<'_>) -> Result<(), Unwritten> {
    let [first, last] = records.ends;
    match labels.time_system.leap_between(labels.at(first)?.min(labels.start()), labels.at(last)?) {
        Some(leap) => Err(Unwritten::LeapSecond { leap }),
        None => Ok(()),
    }
}
