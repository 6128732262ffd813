//! Histories that are not audited, in words.

use std::path::PathBuf;

use quasirigid::model::InertiaError;
use quasirigid_io::history_file::HistoryFileError;

use crate::error::StudyError;
use crate::words::significant;

/// Audit that gives no answer.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum AuditError {
    /// A file that cannot be read.
    #[error(transparent)]
    File(#[from] HistoryFileError),
    /// The model, or its modes.
    #[error(transparent)]
    Study(#[from] StudyError),
    /// Neither moments nor a model.
    #[error(
        "the inertia of the body is not given; add its moments, as --inertia 10,14,17 (kg m^2), or its model, MODEL.toml"
    )]
    NoBody,
    /// Both moments and a model.
    #[error("the inertia is given twice, by --inertia and by a model; leave one out")]
    TwoBodies,
    /// No history at all.
    #[error("there is no history to audit; name a file beside the model")]
    NoFile,
    /// A number of entries that no tensor has.
    #[error(
        "an inertia has three moments XX,YY,ZZ or six entries XX,YY,ZZ,XY,XZ,YZ of the tensor (XY = -int x y dm), not {count}"
    )]
    Entries {
        /// Number of entries.
        count: usize,
    },
    /// A tensor that no body has.
    #[error("{0}; is one of the products of the other sign, or are the moments about another point?")]
    Inertia(#[from] InertiaError),
    /// A moment that is zero.
    #[error("a principal moment of inertia is {} kg m^2; every moment of a body that turns freely is positive", significant(*moment, 4))]
    NoMoment {
        /// The moment (kg·m²).
        moment: f64,
    },
    /// A body with internal angular momentum.
    #[error(
        "the model has internal rotors, wheels or liquids, whose angular momentum no history of the carrier shows; give the inertia of a body without them, by --inertia"
    )]
    Rotors,
    /// A history of one row.
    #[error("{}: the history has one row; a drift needs two", file.display())]
    OneRow {
        /// The file.
        file: PathBuf,
    },
    /// A row without rotation.
    #[error("{}: row {row} has no rotation; the drift of a free body is relative to what it has", file.display())]
    AtRest {
        /// The file.
        file: PathBuf,
        /// Row, from 1.
        row: usize,
    },
    /// Rates that follow Euler's equations in no known units.
    #[error(
        "{}: this inertia or these units do not fit the history: Euler's equations leave {} % of the change of the rates unexplained, best with {} times the rates; {} would be {}; {advice}",
        file.display(),
        significant(100.0 * misfit, 2),
        significant(*factor, 4),
        expected,
        significant(*wanted, 4)
    )]
    Units {
        /// The file.
        file: PathBuf,
        /// Factor of the rates that fits best.
        factor: f64,
        /// Share that is left unexplained.
        misfit: f64,
        /// Units that are expected.
        expected: String,
        /// Their factor.
        wanted: f64,
        /// What to try.
        advice: &'static str,
    },
    /// Rates and an attitude that ask for different units.
    #[error(
        "{}: the attitude turns {} times as fast as the rates say, but Euler's equations ask for {} times; is the inertia in the axes of the rates?",
        file.display(),
        significant(*attitude, 4),
        significant(*factor, 4)
    )]
    Disagreement {
        /// The file.
        file: PathBuf,
        /// Factor by the attitude.
        attitude: f64,
        /// Factor by Euler's equations.
        factor: f64,
    },
    /// A history that several units fit.
    #[error("{}: rates in {first} and in {second} fit alike, as the rows are far apart; name the unit in the heading, as wx [deg/s]", file.display())]
    TwoUnits {
        /// The file.
        file: PathBuf,
        /// Units that fit.
        first: String,
        /// Others that fit.
        second: String,
    },
    /// An attitude that several conventions fit.
    #[error("{}: the attitude fits the rates in two conventions alike: {first}; and {second}; leave the attitude out, or give rows closer to each other", file.display())]
    TwoConventions {
        /// The file.
        file: PathBuf,
        /// A convention.
        first: String,
        /// Another.
        second: String,
    },
    /// An attitude of too few rows to find its rates.
    #[error("{}: the history has attitudes alone, of {rows} rows; their rates need {} rows", file.display(), super::attitude_rates::FEWEST)]
    FewAttitudes {
        /// The file.
        file: PathBuf,
        /// Number of rows.
        rows: usize,
    },
    /// An attitude whose rows are too far apart to find its rates.
    #[error(
        "{}: the history has attitudes alone, and row {row} is {} rad from the one before; rates need rows that are {} rad apart at most, so write rows closer to each other, or the rates too",
        file.display(),
        significant(*turn, 3),
        super::attitude_rates::LARGEST_TURN
    )]
    Coarse {
        /// The file.
        file: PathBuf,
        /// The later of both rows, from 1.
        row: usize,
        /// Rotation between them (rad).
        turn: f64,
    },
    /// An attitude alone that is not the motion of this body in any convention.
    #[error(
        "{}: in no convention do the rotations from row to row follow Euler's equations with this inertia; are the moments in the order and the axes of the body, does no torque act, and are the rows close enough?",
        file.display()
    )]
    NoConvention {
        /// The file.
        file: PathBuf,
    },
    /// An attitude alone that is the motion of this body in two conventions.
    #[error(
        "{}: the rotations from row to row follow Euler's equations in two conventions alike: {first}; and {second}; name the columns qw,qx,qy,qz, or write the rates too",
        file.display()
    )]
    TwoAttitudes {
        /// The file.
        file: PathBuf,
        /// A convention.
        first: String,
        /// Another.
        second: String,
    },
    /// Steps of several histories that give no order.
    #[error("{problem}")]
    Steps {
        /// The problem, with advice.
        problem: String,
    },
}
