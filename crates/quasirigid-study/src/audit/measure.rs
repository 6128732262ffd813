//! A history in SI units and body axes: which units and which convention it has, by its own motion.

use std::path::Path;

use quasirigid_io::history_file::{HistoryFile, QuaternionOrder};
use quasirigid_math::rotation::Turn;
use quasirigid_math::vec3::norm;

use super::attitude_alone::{Alone, with_rates};
use super::attitude_rates::REACH;
use super::convention::{Agreement, Convention, agreements};
use super::error::AuditError;
use super::euler::{Numbers, UnitFit, unit_fit};
use super::rigid::Rigid;
use super::units::Units;

/// Misfits up to which a unit or a convention is the right one, up to which the rates still are those of about this body.
const FITS: f64 = 0.1;
const ROUGH: f64 = 0.7;
/// Ratio of misfits that tells one choice from another.
const BY_FAR: f64 = 3.0;
/// Difference of rates, relative, below which it does not matter in which axes they are.
const SAME: f64 = 1e-6;

/// Where the units were found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnitSource {
    /// In the heading of the file.
    Heading,
    /// From the motion.
    Motion,
    /// Nowhere: rad/s and s are taken.
    Assumed,
}

/// History in SI units and body axes.
#[derive(Debug)]
pub struct Measured {
    /// The file, with times (s) and rates (rad/s) in body axes.
    pub file: HistoryFile,
    /// Units that the file has.
    pub units: Units,
    /// Where they were found.
    pub source: UnitSource,
    /// Fit of Euler's equations, where the rates change enough.
    pub fit: Option<UnitFit>,
    /// Convention of the attitude and its agreement with the rates; none without an attitude, and of one that fits in no convention.
    pub attitude: Option<Agreement>,
    /// Why an attitude was left out.
    pub left_out: Option<String>,
    /// Most by which rates from an attitude alone may be off (rad/s); none of a file that has rates.
    pub derived: Option<f64>,
    scale: f64,
}

impl Measured {
    /// Finds the units and the convention of a file, and converts it.
    pub fn of(path: &Path, mut file: HistoryFile, body: &Rigid) -> Result<Self, AuditError> {
        if file.t.len() < 2 {
            return Err(AuditError::OneRow { file: path.into() });
        }
        if file.rates.is_empty() {
            return Self::of_attitude(path, file, body);
        }
        if let Some(at) = file.rates.iter().position(|rate| norm(*rate) == 0.0) {
            return Err(AuditError::AtRest { file: path.into(), row: at + 1 });
        }
        let (attitude, left_out) = conventions(&file);
        let found = best(path, &file, body, &attitude)?;
        let Found { agreement, units, source, fit } = found;
        if let Some(Agreement { convention, .. }) = agreement.filter(|found| !found.convention.body_rates) {
            file.rates = body_rates(&file, convention);
        }
        let [rate, time] = units.values;
        if rate != 1.0 {
            file.rates.iter_mut().for_each(|w| *w = w.map(|part| part * rate));
        }
        if time != 1.0 {
            file.t.iter_mut().for_each(|t| *t *= time);
        }
        Ok(Self { file, units, source, fit, attitude: agreement, left_out, derived: None, scale: rate })
    }

    /// A file that has attitudes alone, with the rates of these.
    fn of_attitude(path: &Path, file: HistoryFile, body: &Rigid) -> Result<Self, AuditError> {
        let Alone { file, convention, fit, error } = with_rates(path, file, body)?;
        if let Some(at) = file.rates.iter().position(|rate| norm(*rate) <= error) {
            return Err(AuditError::AtRest { file: path.into(), row: at + 1 + REACH });
        }
        let source = if file.time_unit.is_some() { UnitSource::Heading } else { UnitSource::Assumed };
        Ok(Self {
            file,
            units: Units::SI,
            source,
            fit,
            attitude: Some(Agreement { convention, factor: 1.0, misfit: 0.0 }),
            left_out: None,
            derived: Some(error),
            scale: 1.0,
        })
    }

    /// How finely the rates are known, in words.
    pub fn digits(&self) -> String {
        self.derived.map_or_else(|| self.file.resolution.words(), |_| "rates from the attitude".to_owned())
    }

    /// Most by which rounding may have changed the rates of a row (rad/s).
    pub fn rounding(&self, row: usize) -> [f64; 3] {
        if let Some(error) = self.derived {
            return [error; 3];
        }
        let HistoryFile { rates, rate_factor, resolution, .. } = &self.file;
        let unit = rate_factor * self.scale;
        let errors: [f64; 3] = std::array::from_fn(|axis| resolution.error(rates[row][axis] / unit) * unit);
        match self.attitude {
            Some(found) if !found.convention.body_rates => [norm(errors); 3],
            _ => errors,
        }
    }

    /// Angle (rad) of the angular momentum in inertial axes from that of the first row: of the last row, and the largest.
    pub fn direction(&self, body: &Rigid) -> Option<[f64; 2]> {
        let convention = self.attitude?.convention;
        let rows = self.file.attitude.iter().zip(&self.file.rates);
        let mut directions = rows
            .map(|(stored, rate)| Turn::of(convention.attitude(*stored)).to_inertial(body.momentum(*rate)));
        let first = directions.next()?;
        let angles = directions.map(|other| quasirigid_math::rotation::angle(first, other));
        Some(angles.fold([0.0; 2], |[_, largest], angle| [angle, angle.max(largest)]))
    }
}

/// Conventions of an attitude that fit the rates, or why there is none.
fn conventions(file: &HistoryFile) -> (Vec<Agreement>, Option<String>) {
    if file.attitude.is_empty() {
        return (Vec::new(), None);
    }
    let known = file.order == QuaternionOrder::ScalarFirst;
    let Some(found) = agreements(&file.t, &file.rates, &file.attitude, known) else {
        let reason = "the body turns by about half a turn from row to row, so that the attitude cannot be compared with the rates; it was left out";
        return (Vec::new(), Some(reason.to_owned()));
    };
    let Some(best) = found.first().filter(|best| best.misfit < FITS) else {
        let share = found.first().map_or(1.0, |best| best.misfit);
        let reason = format!(
            "the attitude fits the rates in no convention (the best leaves {} % of the rotation unexplained), and was left out",
            crate::words::significant(100.0 * share, 2)
        );
        return (Vec::new(), Some(reason));
    };
    let near = (BY_FAR * best.misfit).max(SAME);
    (found.iter().copied().filter(|other| other.misfit <= near).collect(), None)
}

/// Convention and units of a history.
#[derive(Clone, Debug)]
struct Found {
    agreement: Option<Agreement>,
    units: Units,
    source: UnitSource,
    fit: Option<UnitFit>,
}

/// The convention in which the rates follow Euler's equations, with their units.
fn best(path: &Path, file: &HistoryFile, body: &Rigid, attitude: &[Agreement]) -> Result<Found, AuditError> {
    if attitude.is_empty() {
        return units(path, file, &file.rates, body, None);
    }
    let mut found: Vec<(Found, Option<Vec<[f64; 3]>>)> = Vec::new();
    let mut refused = None;
    for agreement in attitude {
        let turned = (!agreement.convention.body_rates).then(|| body_rates(file, agreement.convention));
        let rates = turned.as_deref().unwrap_or(&file.rates);
        match units(path, file, rates, body, Some(*agreement)) {
            Ok(next) => found.push((next, turned)),
            Err(error) => refused = refused.or(Some(error)),
        }
    }
    let misfit = |found: &Found| found.fit.map_or(0.0, |fit| fit.misfit);
    found.sort_by(|a, b| misfit(&a.0).total_cmp(&misfit(&b.0)));
    let mut found = found.into_iter();
    let Some((first, rates)) = found.next() else {
        return Err(refused.unwrap_or(AuditError::NoFile));
    };
    for (other, others) in found {
        let [one, two] = [&rates, &others].map(|turned| turned.as_deref().unwrap_or(&file.rates));
        let apart = one.iter().zip(two).map(|(a, b)| difference(*a, *b)).fold(0.0, f64::max);
        if misfit(&other) <= (BY_FAR * misfit(&first)).max(SAME) && apart > SAME {
            let words =
                |found: &Found| found.agreement.map_or_else(String::new, |found| found.convention.words());
            return Err(AuditError::TwoConventions {
                file: path.into(),
                first: words(&first),
                second: words(&other),
            });
        }
    }
    Ok(first)
}

fn difference(a: [f64; 3], b: [f64; 3]) -> f64 {
    norm([a[0] - b[0], a[1] - b[1], a[2] - b[2]]) / norm(a).max(norm(b))
}

/// Rates in body axes of a file that has them in inertial ones.
fn body_rates(file: &HistoryFile, convention: Convention) -> Vec<[f64; 3]> {
    let rows = file.rates.iter().zip(&file.attitude);
    rows.map(|(rate, stored)| Turn::of(convention.attitude(*stored)).to_body(*rate)).collect()
}

/// Units in which the rates follow Euler's equations and agree with the attitude.
fn units(
    path: &Path,
    file: &HistoryFile,
    rates: &[[f64; 3]],
    body: &Rigid,
    agreement: Option<Agreement>,
) -> Result<Found, AuditError> {
    let known = [file.time_unit.is_some(), file.rate_unit.is_some()];
    let possible = Units::possible(known[0], known[1]);
    let starts: Vec<f64> = possible.iter().map(Units::factor).collect();
    let numbers = Numbers { t: &file.t, rates, rounding: &|row| file.rounding(row) };
    let source = if known == [true, true] { UnitSource::Heading } else { UnitSource::Motion };
    let Some(fits) = unit_fit(body, &numbers, &starts).filter(|fits| !fits.is_empty()) else {
        return unchanging(path, &possible, source, agreement);
    };
    let agrees = |fit: &UnitFit| possible.iter().find(|units| units.agree(fit)).copied();
    let mut good: Vec<(Units, UnitFit)> =
        fits.iter().filter(|fit| fit.misfit < ROUGH).filter_map(|fit| Some((agrees(fit)?, *fit))).collect();
    good.sort_by(|a, b| a.1.misfit.total_cmp(&b.1.misfit));
    let best = fits.iter().min_by(|a, b| a.misfit.total_cmp(&b.misfit)).copied();
    let outdone =
        |fit: &UnitFit| fit.misfit >= FITS && best.is_some_and(|best| best.misfit * BY_FAR < fit.misfit);
    let Some((units, fit)) = good.first().copied().filter(|(_, fit)| !outdone(fit)) else {
        return Err(misfit(path, best, &possible, known));
    };
    let rival = good.iter().find(|(other, fit)| *other != units && fit.misfit < FITS);
    if let Some((other, _)) = rival {
        let (first, second) = (units.words(), other.words());
        return Err(AuditError::TwoUnits { file: path.into(), first, second });
    }
    if let Some(turns) = agreement
        && (turns.factor / units.factor() - 1.0).abs() > FITS
    {
        return Err(AuditError::Disagreement {
            file: path.into(),
            attitude: turns.factor,
            factor: fit.factor,
        });
    }
    Ok(Found { agreement, units, source, fit: Some(fit) })
}

/// Units of rates that change too little for Euler's equations to show them: those of the attitude, or radians and seconds.
fn unchanging(
    path: &Path,
    possible: &[Units],
    source: UnitSource,
    agreement: Option<Agreement>,
) -> Result<Found, AuditError> {
    let Some(turns) = agreement else {
        let source = if source == UnitSource::Heading { source } else { UnitSource::Assumed };
        return Ok(Found { agreement, units: possible[0], source, fit: None });
    };
    let fit = UnitFit { factor: turns.factor, error: 0.0, misfit: turns.misfit, turn: 0.0 };
    match possible.iter().find(|units| units.agree(&fit)) {
        Some(units) => Ok(Found { agreement, units: *units, source, fit: None }),
        None => Err(misfit(path, Some(fit), possible, [true, source == UnitSource::Heading])),
    }
}

fn misfit(path: &Path, best: Option<UnitFit>, possible: &[Units], known: [bool; 2]) -> AuditError {
    let fit = best.unwrap_or(UnitFit { factor: f64::NAN, error: f64::NAN, misfit: 1.0, turn: 0.0 });
    let advice = match known {
        [_, true]
            if Units::possible(true, false)
                .iter()
                .any(|units| units.agree(&fit) && units.factor() != 1.0) =>
        {
            "the heading names a unit that the numbers do not have"
        }
        _ => "are the moments in the order and the axes of the rates, and does no torque act?",
    };
    AuditError::Units {
        file: path.into(),
        factor: fit.factor,
        misfit: fit.misfit,
        expected: possible[0].words(),
        wanted: possible[0].factor(),
        advice,
    }
}
