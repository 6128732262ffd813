//! Basis of the slow manifold of a structure: Krylov space of its static responses, orthonormal in the stiffness.
//! Each step is a factor of inertia or damping, so the degree in the spin says exactly which vectors an order needs.
//! Equation (K8), docs/theory/12-structures.md.

use nalgebra::DMatrix;

use super::discrete::{Discrete, times};
use super::solver::Solver;
use crate::math::krylov::dot;
use crate::math::watch;

/// Basis: displacements of a structure that span its slow manifold to an order, a row each. (K8)
///
/// Orthonormal in the stiffness.
pub(super) struct Basis {
    rows: Vec<Vec<f64>>,
    /// Forces in balance with each of them.
    forces: Vec<Vec<f64>>,
    /// Largest share of the energy of a response that the basis does not hold.
    pub left_out: f64,
}

/// Share of its energy below which the rest of a displacement is linearly dependent on the others.
const DEPENDENT: f64 = 1e-10;
/// Share of the energy of the largest static response below which a response is rounding.
const NOTHING: f64 = 1e-24;

impl Basis {
    /// Space of the responses to loads, and of the responses to the inertia, spin and damping of these.
    ///
    /// A factor of the damping raises the degree in the spin by one, one of the inertia by two; the responses to the loads are of degree
    /// two.
    pub fn new(discrete: &Discrete<'_>, solver: &Solver, statics: &DMatrix<f64>, order: usize) -> Self {
        let mut basis = Self { rows: Vec::new(), forces: Vec::new(), left_out: 0.0 };
        let budget = order.max(3) - 2;
        let losses = discrete.losses();
        let mut found = vec![basis.append(discrete, statics)];
        watch::stage("answering the loads");
        for cost in 1..=budget {
            watch::progress((cost - 1) as f64 / budget as f64);
            let mut images = Vec::new();
            images.extend(losses.iter().map(|loss| solver.answers(times(loss, &found[cost - 1]))));
            if let Some(before) = cost.checked_sub(2) {
                images.push(solver.answers(discrete.turned(&found[before])));
            }
            let added =
                images.iter().flat_map(|image| basis.append_rows(discrete, image)).collect::<Vec<_>>();
            found.push(stacked(&added, statics.ncols()));
        }
        if budget < 2 {
            let image = solver.answers(times(&discrete.mass, &found[0]));
            basis.append(discrete, &image);
        }
        basis
    }

    /// The displacements, a row each.
    pub fn displacements(&self, size: usize) -> DMatrix<f64> {
        stacked(&self.rows, size)
    }

    /// Adds the part of some displacements that is not in the space yet, and returns that part, a row each.
    pub fn append(&mut self, discrete: &Discrete<'_>, displacements: &DMatrix<f64>) -> DMatrix<f64> {
        let added = self.append_rows(discrete, displacements);
        stacked(&added, displacements.ncols())
    }

    fn append_rows(&mut self, discrete: &Discrete<'_>, displacements: &DMatrix<f64>) -> Vec<Vec<f64>> {
        let energy = |x: &[f64]| dot(x, &discrete.total.times(x));
        let candidates: Vec<Vec<f64>> =
            displacements.row_iter().map(|row| row.iter().copied().collect()).collect();
        let energies: Vec<f64> = candidates.iter().map(|x| energy(x)).collect();
        let largest = energies.iter().copied().fold(0.0, f64::max);
        let first = self.rows.len();
        for (mut x, whole) in candidates.into_iter().zip(energies) {
            if whole > NOTHING * largest {
                self.orthogonal(&mut x);
                self.keep(discrete, x, whole);
            }
        }
        self.rows[first..].to_vec()
    }

    fn orthogonal(&self, x: &mut [f64]) {
        for _ in 0..2 {
            for (y, force) in self.rows.iter().zip(&self.forces) {
                let share = dot(force, x);
                x.iter_mut().zip(y).for_each(|(x, y)| *x -= share * y);
            }
        }
    }

    fn keep(&mut self, discrete: &Discrete<'_>, mut x: Vec<f64>, whole: f64) {
        let mut force = discrete.total.times(&x);
        let rest = dot(&x, &force);
        if rest > DEPENDENT * whole {
            let length = rest.sqrt();
            x.iter_mut().chain(&mut force).for_each(|entry| *entry /= length);
            self.rows.push(x);
            self.forces.push(force);
        } else {
            self.left_out = self.left_out.max(rest / whole);
        }
    }
}

fn stacked(rows: &[Vec<f64>], size: usize) -> DMatrix<f64> {
    DMatrix::from_fn(rows.len(), size, |row, column| rows[row][column])
}
