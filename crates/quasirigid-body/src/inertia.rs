//! Inertia tensor of a mass distribution, checked for symmetry and for the triangle inequality of its moments.
//! Tolerances are relative to the largest entry, 1e-12, so that tables with 13 significant digits pass and the unit of mass has no effect.
//! Shift of the point of reference and second moments as in (I7), docs/theory/02-invariants.md.

use nalgebra::{Matrix3, Vector3};
use thiserror::Error;

/// Inertia tensor (kg·m²), about a point and in axes known to the caller.
///
/// Invariant: symmetric, with principal moments `0 ≤ J₁ ≤ J₂ ≤ J₃ ≤ J₁ + J₂`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inertia(Matrix3<f64>);

/// Error of a matrix that is the inertia tensor of no mass distribution.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum InertiaError {
    /// An entry is NaN or infinite.
    #[error("the inertia tensor has the entry {value}, which is not a finite number")]
    NotFinite {
        /// Entry.
        value: f64,
    },
    /// The matrix is not symmetric.
    #[error(
        "the inertia tensor is not symmetric: two entries that should be equal differ by {asymmetry:e} kg m^2"
    )]
    NotSymmetric {
        /// Largest difference between an entry and its mirror image (kg·m²).
        asymmetry: f64,
    },
    /// A principal moment is negative, or larger than the sum of the other two.
    #[error(
        "no body has the principal moments of inertia {:?} kg m^2: none may be negative, or exceed the sum of the other two",
        moments
    )]
    Impossible {
        /// Principal moments (kg·m²), ascending.
        moments: [f64; 3],
    },
}

/// Difference of equal entries, relative to the largest entry, that counts as rounding: the last digit of a table with 13 significant
/// digits.
const EQUAL_ENTRIES: f64 = 1e-12;

impl Inertia {
    /// Accepts `J` if a mass distribution with this tensor can exist; takes its symmetric part.
    ///
    /// Tolerances are relative to the largest entry, so that bodies of any mass are judged alike.
    ///
    /// # Errors
    /// [`InertiaError`] names the law that `J` breaks.
    pub fn new(J: [[f64; 3]; 3]) -> Result<Self, InertiaError> {
        let J = Matrix3::from(J);
        let tolerance = EQUAL_ENTRIES * J.amax();
        if let Some(value) = J.iter().copied().find(|entry| !entry.is_finite()) {
            return Err(InertiaError::NotFinite { value });
        }
        let asymmetry = (J - J.transpose()).amax();
        if asymmetry > tolerance {
            return Err(InertiaError::NotSymmetric { asymmetry });
        }
        let symmetric = Self(0.5 * (J + J.transpose()));
        let moments = symmetric.principal_moments();
        let [J1, J2, J3] = moments;
        if J1 < -tolerance || J1 + J2 < J3 - tolerance {
            return Err(InertiaError::Impossible { moments });
        }
        Ok(symmetric)
    }

    /// Rows of the tensor (kg·m²).
    #[must_use]
    pub fn rows(&self) -> [[f64; 3]; 3] {
        self.0.into()
    }

    /// Principal moments (kg·m²), ascending.
    #[must_use]
    pub fn principal_moments(&self) -> [f64; 3] {
        let mut moments: [f64; 3] = self.0.symmetric_eigenvalues().into();
        moments.sort_by(f64::total_cmp);
        moments
    }

    /// Tensor about a point at `offset` (m) from the centre of mass, for a tensor about the centre of mass of a body of this `mass` (kg):
    /// `J + m (|d|² 1 − d dᵀ)`.
    #[must_use]
    pub fn shifted(&self, mass: f64, offset: [f64; 3]) -> Self {
        let d = Vector3::from(offset);
        Self(self.0 + mass * (d.norm_squared() * Matrix3::identity() - d * d.transpose()))
    }

    /// Second moments `∫ s sᵀ dm = ½ tr(J) 1 − J` (kg·m²) about the same point.
    #[doc(hidden)]
    pub fn second_moments(&self) -> Matrix3<f64> {
        0.5 * self.0.trace() * Matrix3::identity() - self.0
    }
}
