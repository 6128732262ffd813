use nalgebra::{DMatrix, SymmetricEigen};

use super::discrete::{Discrete, times};

/// Share of the trace of the mass, at equal elastic energy, below which a mass is rounding.
const MASS_ROUNDING: f64 = 1e-13;

/// Displacements of a structure as coordinates: each with an rms of one over its mass, and the mass matrix between them. (K16)
pub(super) struct MassNormalized {
    /// Displacements, a row each.
    pub fields: DMatrix<f64>,
    pub masses: DMatrix<f64>,
}

impl MassNormalized {
    /// `fields` are orthonormal in the stiffness; `mass` is that of the structure (kg).
    pub fn new(discrete: &Discrete<'_>, mut fields: DMatrix<f64>, mass: f64) -> Self {
        let forces = times(&discrete.mass, &fields);
        let raised = raised(&(&fields * forces.transpose()));
        let mut scales = Vec::with_capacity(fields.nrows());
        for j in 0..fields.nrows() {
            let own =
                fields.row(j).dot(&forces.row(j)) + raised.as_ref().map_or(0.0, |raised| raised[(j, j)]);
            let rms = (own / mass).sqrt();
            fields.row_mut(j).scale_mut(rms.recip());
            scales.push(rms.recip());
        }
        let mut masses = &fields * times(&discrete.mass, &fields).transpose();
        if let Some(raised) = raised {
            masses += raised.map_with_location(|j, k, entry| scales[j] * entry * scales[k]);
        }
        Self { fields, masses }
    }
}

/// Matrix that raises the mass of motions without mass to rounding: `Σ (θ₀ − θ) y yᵀ` over the `y` with `θ < θ₀`; none if all have more.
fn raised(masses: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let size = masses.nrows();
    let floor = MASS_ROUNDING * masses.trace();
    let above = masses - floor * DMatrix::identity(size, size);
    if size == 0 || above.cholesky().is_some() {
        return None;
    }
    let eigen = SymmetricEigen::new(0.5 * (masses + masses.transpose()));
    let mut raised = DMatrix::zeros(size, size);
    for (value, y) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
        if *value < floor {
            raised.ger(floor - value, &y, &y, 1.0);
        }
    }
    Some(raised)
}
