//! Basis of elastic displacements in which the small motions about a steady spin are looked for.

use nalgebra::{Complex, DMatrix};

use crate::math::eigen::NoConvergence;
use crate::math::krylov::Pencil;
use crate::math::span::Span;
use crate::model::{FlexibleBody, SpinCoefficients};

/// Basis of elastic displacements: all, or for a body of many coordinates the slowest vibrations and the responses to the loads of a
/// motion about the steady spin.
pub(super) struct Displacements {
    /// Basis displacements, one per column; none where every coordinate is its own.
    columns: Option<DMatrix<f64>>,
    /// Square root of the stiffness of each basis displacement, that of the spin where no spring acts.
    pub units: Vec<f64>,
}

/// Number of elastic coordinates up to which all displacements are taken.
pub(super) const WHOLE: usize = 150;
/// Number of vibrations that are taken of a larger body.
const MAX_VIBRATIONS: usize = 40;

impl Displacements {
    pub fn of(
        body: &FlexibleBody,
        coefficients: &SpinCoefficients,
        whole: usize,
    ) -> Result<Self, NoConvergence> {
        let elastic = body.elastic();
        if elastic <= whole {
            let held = body.stiffness().diagonal();
            let spun = |j: usize| coefficients.centrifugal.at(j, j).abs();
            let units = (0..elastic).map(|j| if held[j] > 0.0 { held[j] } else { spun(j) }.sqrt()).collect();
            return Ok(Self { columns: None, units });
        }
        let padded = |x: &[f64]| {
            let mut all = x.to_vec();
            all.resize(body.coordinates().len(), 0.0);
            all
        };
        let cut = |mut x: Vec<f64>| {
            x.truncate(elastic);
            x
        };
        let grounded = body.grounded_stiffness();
        let stiffness = |x: &[f64]| grounded.times(x);
        let mass = |x: &[f64]| cut(body.recoiling_mass_times(&padded(x)));
        let solve = |x: &mut [f64]| {
            let mut all = padded(x);
            body.solve_stiffness(&mut all, 1);
            x.copy_from_slice(&all[..elastic]);
        };
        let softened = |mut x: Vec<f64>| {
            solve(&mut x);
            x
        };
        let load = |list: &[[f64; 3]], axis: usize| list[..elastic].iter().map(|load| load[axis]).collect();
        let loads = (0..3).flat_map(|axis| [load(&coefficients.h, axis), load(&coefficients.slopes, axis)]);
        let first: Vec<Vec<f64>> = loads.map(softened).collect();
        let damped = |x: &Vec<f64>| softened(cut(body.damping().times(&padded(x))));
        let centrifugal = |x: &Vec<f64>| softened(cut(coefficients.centrifugal.times(&padded(x))));
        let gyroscopic = |x: &Vec<f64>| softened(cut(coefficients.gyroscopic.times(&padded(x))));
        let after = |x: &Vec<f64>| [softened(mass(x)), damped(x), centrifugal(x), gyroscopic(x)];
        let second: Vec<Vec<f64>> = first.iter().flat_map(after).collect();
        let slow = Pencil { size: elastic, stiffness: &stiffness, solve: &solve, mass: &mass }
            .largest(MAX_VIBRATIONS)?;
        let span = Span::orthonormal([first, second, slow].concat(), stiffness).into_vectors();
        let matrix = DMatrix::from_fn(elastic, span.len(), |row, column| span[column][row]);
        Ok(Self { units: vec![1.0; span.len()], columns: Some(matrix) })
    }

    /// A matrix of velocities on both sides, in the basis of angular velocity, elastic displacements and cyclic coordinates.
    pub fn of_velocities(&self, matrix: DMatrix<f64>) -> DMatrix<f64> {
        let Some(columns) = &self.columns else { return matrix };
        let all = all(columns, matrix.nrows());
        all.transpose() * matrix * all
    }

    /// A matrix of forces on the velocities per elastic displacement, in the basis.
    pub fn of_forces(&self, matrix: DMatrix<f64>) -> DMatrix<f64> {
        let Some(columns) = &self.columns else { return matrix };
        all(columns, matrix.nrows()).transpose() * matrix * columns
    }

    /// Displacement of every elastic coordinate.
    pub fn lifted(&self, shares: &[Complex<f64>]) -> Vec<Complex<f64>> {
        let Some(columns) = &self.columns else { return shares.to_vec() };
        let (rows, count) = columns.shape();
        (0..rows).map(|row| (0..count).map(|k| shares[k] * columns[(row, k)]).sum()).collect()
    }
}

/// Basis of angular velocity, elastic displacements and cyclic coordinates, one per column, for so many velocities.
fn all(columns: &DMatrix<f64>, velocities: usize) -> DMatrix<f64> {
    let (rows, count) = columns.shape();
    let cyclic = velocities - 3 - rows;
    let mut all = DMatrix::zeros(velocities, 3 + count + cyclic);
    all.view_mut((0, 0), (3, 3)).fill_with_identity();
    all.view_mut((3, 3), (rows, count)).copy_from(columns);
    all.view_mut((3 + rows, 3 + count), (cyclic, cyclic)).fill_with_identity();
    all
}
