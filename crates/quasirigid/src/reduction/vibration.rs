use thiserror::Error;

use crate::math::eigen::{Dense, Modes, NoConvergence, eigenvalues, modes};
use crate::math::sparse::SparseRows;
use crate::math::sym;
use crate::model::FlexibleBody;

/// Vibrations that cannot be told.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum VibrationError {
    /// The body has more coordinates than the dense solver takes.
    #[error(
        "the vibrations of {coordinates} coordinates cannot be found: the dense solver takes {MOST_COORDINATES}"
    )]
    TooMany {
        /// Coordinates of the body.
        coordinates: usize,
    },
    /// The solver failed.
    #[error(transparent)]
    NoConvergence(#[from] NoConvergence),
}

/// Coordinates whose vibrations are found: more would take minutes and gigabytes.
pub const MOST_COORDINATES: usize = 2_000;

/// Free vibrations of a body that does not turn.
#[derive(Clone, Debug, PartialEq)]
pub struct Vibrations {
    /// Undamped natural frequencies with the attitude held (rad/s), ascending. (V2)
    pub frequencies: Vec<f64>,
    /// Undamped natural frequencies with the body free to recoil in rotation (rad/s), ascending; not below the others.
    pub free_frequencies: Vec<f64>,
    /// Decay rates of the damped vibrations with the attitude held (1/s), ascending, two to a coordinate. (V3)
    pub decay_rates: Vec<f64>,
    /// Largest `β` of `B x = β C x` (s). (V5)
    pub damping_time: f64,
    /// The coordinate that moves most in the slowest vibration.
    pub softest: Option<String>,
}

/// Undamped natural frequencies with the attitude held (rad/s), ascending. (V2)
///
/// # Errors
/// [`VibrationError`] if the body has too many coordinates or the eigenvalue solver fails.
pub fn frequencies(body: &FlexibleBody) -> Result<Vec<f64>, VibrationError> {
    few_enough(body)?;
    Ok(modes(&body.mass_matrix(), &dense(body.stiffness()))?.frequencies)
}

impl Vibrations {
    /// Free vibrations of a body.
    ///
    /// # Errors
    /// [`VibrationError`] if the body has too many coordinates or an eigenvalue solver fails.
    pub fn of(body: &FlexibleBody) -> Result<Self, VibrationError> {
        few_enough(body)?;
        let (A, B, C) = (body.mass_matrix(), dense(body.damping()), dense(body.stiffness()));
        let held = modes(&A, &C)?;
        let free = modes(&recoiling(body, A), &C)?;
        let softest = (0..held.shapes.size())
            .max_by(|a, b| held.shapes.at(*a, 0).abs().total_cmp(&held.shapes.at(*b, 0).abs()))
            .map(|row| body.coordinates()[row].name.clone());
        Ok(Self {
            decay_rates: decay_rates(&held, body.damping())?,
            damping_time: modes(&B, &C)?.frequencies.first().map_or(0.0, |lowest| lowest.powi(-2)),
            frequencies: held.frequencies,
            free_frequencies: free.frequencies,
            softest,
        })
    }
}

fn few_enough(body: &FlexibleBody) -> Result<(), VibrationError> {
    let coordinates = body.coordinates().len();
    if coordinates > MOST_COORDINATES { Err(VibrationError::TooMany { coordinates }) } else { Ok(()) }
}

/// `A − h J⁻¹ hᵀ`: the mass matrix of a body that recoils in rotation. (V2)
fn recoiling(body: &FlexibleBody, mut A: Dense) -> Dense {
    let invariants = body.invariants();
    let inverse = sym::inverse(invariants.J);
    for (row, h_row) in invariants.h.iter().enumerate() {
        for (column, h_column) in invariants.h.iter().enumerate() {
            A.add(row, column, -sym::dot(*h_row, sym::times(inverse, *h_column)));
        }
    }
    A
}

/// Decay rates of `λ²A + λB + C`, from its first-order form in the undamped modes `(Ωη, η̇)`. (V3)
fn decay_rates(modes: &Modes, B: &SparseRows<f64>) -> Result<Vec<f64>, NoConvergence> {
    let size = modes.frequencies.len();
    let mut system = Dense::zero(2 * size);
    for (k, frequency) in modes.frequencies.iter().enumerate() {
        system.add(k, size + k, *frequency);
        system.add(size + k, k, -frequency);
    }
    for column in 0..size {
        let shape: Vec<f64> = (0..size).map(|row| modes.shapes.at(row, column)).collect();
        let force = B.times(&shape);
        for row in 0..size {
            let damping: f64 = (0..size).map(|j| modes.shapes.at(j, row) * force[j]).sum();
            system.add(size + row, size + column, -damping);
        }
    }
    let mut rates: Vec<f64> = eigenvalues(&system)?.iter().map(|[real, _]| -real).collect();
    rates.sort_by(f64::total_cmp);
    Ok(rates)
}

fn dense(matrix: &SparseRows<f64>) -> Dense {
    let mut dense = Dense::zero(matrix.size());
    matrix.iter().for_each(|(row, column, entry)| dense.add(row, column, *entry));
    dense
}
