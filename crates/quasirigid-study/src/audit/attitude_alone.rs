//! History of an attitude without rates: its convention is the one whose rates follow Euler's equations. (J4)

use std::path::Path;

use quasirigid_io::history_file::{HistoryFile, QuaternionOrder};

use super::attitude_rates::{AttitudeRates, FEWEST, REACH, too_far};
use super::convention::Convention;
use super::error::AuditError;
use super::euler::{Numbers, UnitFit, unit_fit};
use super::rigid::Rigid;
use super::units::Units;

/// Share of the change of the rates that the right convention may leave unexplained.
const ROUGH: f64 = 0.7;
/// Ratio of misfits that tells one convention from another, and the least misfit that counts.
const BY_FAR: f64 = 3.0;
const LEAST: f64 = 1e-3;

/// Rates of an attitude in the convention that fits.
pub struct Alone {
    /// The history with rates (rad/s), body axes, without the rows at its ends that have none.
    pub file: HistoryFile,
    /// The convention.
    pub convention: Convention,
    /// Fit of Euler's equations, where the rates change enough.
    pub fit: Option<UnitFit>,
    /// Most by which a component of the rates may be off (rad/s).
    pub error: f64,
}

struct Candidate {
    convention: Convention,
    derived: AttitudeRates,
    fit: Option<UnitFit>,
}

/// The rates of a file that has attitudes alone.
///
/// # Errors
/// [`AuditError`] for rows that are too few or too far apart, and where no convention, or more than one, follows Euler's equations.
pub fn with_rates(path: &Path, file: HistoryFile, body: &Rigid) -> Result<Alone, AuditError> {
    let rows = file.t.len();
    if rows < FEWEST {
        return Err(AuditError::FewAttitudes { file: path.into(), rows });
    }
    if let Some((before, turn)) = too_far(&file.attitude) {
        return Err(AuditError::Coarse { file: path.into(), row: before + 1, turn });
    }
    let known = file.order == QuaternionOrder::ScalarFirst;
    let conventions = Convention::all(known).filter(|convention| convention.body_rates);
    let candidates: Vec<Candidate> =
        conventions.map(|convention| candidate(&file, convention, body)).collect();
    let Candidate { convention, derived, fit } = chosen(path, candidates, body)?;
    let kept = REACH..rows - REACH;
    let file = HistoryFile {
        t: file.t[kept.clone()].to_vec(),
        attitude: file.attitude[kept].to_vec(),
        rates: derived.rates,
        ..file
    };
    Ok(Alone { file, convention, fit, error: derived.error })
}

fn candidate(file: &HistoryFile, convention: Convention, body: &Rigid) -> Candidate {
    let attitude: Vec<[f64; 4]> = file.attitude.iter().map(|stored| convention.attitude(*stored)).collect();
    let derived = AttitudeRates::of(&file.t, &attitude, file.attitude_rounding);
    let t = &file.t[REACH..file.t.len() - REACH];
    let error = [derived.error; 3];
    let numbers = Numbers { t, rates: &derived.rates, rounding: &|_| error };
    // rates of an attitude are per unit of its own times, in which Euler's equations have the factor one
    let fits = unit_fit(body, &numbers, &[1.0]).unwrap_or_default();
    let fit = fits.into_iter().min_by(|a, b| misfit(a).total_cmp(&misfit(b)));
    Candidate { convention, derived, fit }
}

/// What Euler's equations leave unexplained; all where they ask for another factor than one.
fn misfit(fit: &UnitFit) -> f64 {
    if Units::SI.agree(fit) { fit.misfit } else { f64::INFINITY }
}

/// The convention that fits by far the best. Rates that change in none tell nothing, and need none; where another fits as well with the same
/// energy and angular momentum, as after a change of names of the axes, it does not matter which.
fn chosen(path: &Path, mut candidates: Vec<Candidate>, body: &Rigid) -> Result<Candidate, AuditError> {
    let size = |candidate: &Candidate| candidate.fit.as_ref().map_or(f64::INFINITY, misfit);
    if candidates.iter().any(|candidate| candidate.fit.is_some()) {
        candidates.sort_by(|a, b| size(a).total_cmp(&size(b)));
        if !candidates.first().is_some_and(|best| size(best) < ROUGH) {
            return Err(AuditError::NoConvention { file: path.into() });
        }
    }
    let mut candidates = candidates.into_iter();
    let best = candidates.next().ok_or(AuditError::NoFile)?;
    let near = |other: &Candidate| size(other) <= BY_FAR * size(&best).max(LEAST);
    let rival = candidates.find(|other| near(other) && !alike(body, &best.derived, &other.derived));
    match rival {
        None => Ok(best),
        Some(second) => Err(AuditError::TwoAttitudes {
            file: path.into(),
            first: best.convention.attitude_words(),
            second: second.convention.attitude_words(),
        }),
    }
}

/// Whether two histories of rates have the same energy and angular momentum, to the error of each.
fn alike(body: &Rigid, one: &AttitudeRates, other: &AttitudeRates) -> bool {
    one.rates.iter().zip(&other.rates).all(|(a, b)| {
        let [a, b] =
            [(a, one.error), (b, other.error)].map(|(rate, error)| body.invariants(*rate, [error; 3]));
        let apart = |a: f64, b: f64| (a / b - 1.0).abs();
        apart(a.energy, b.energy) <= a.rounding.energy + b.rounding.energy
            && apart(a.momentum, b.momentum) <= a.rounding.momentum + b.rounding.momentum
    })
}
