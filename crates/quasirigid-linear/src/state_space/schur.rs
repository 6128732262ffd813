//! Complex Schur form of a real matrix, group by group of states that depend on each other, and the exchange of its eigenvalues.

use faer::Mat;

use super::components::dependent;
use super::triangular::unitary;
use super::{C, Matrix, Real};
use crate::eigen::NoConvergence;

/// `A = Q T Qᴴ`, `T` upper triangular.
#[derive(Clone, Debug)]
pub(super) struct Schur {
    pub Q: Matrix,
    pub T: Matrix,
    /// For each eigenvalue its group of states.
    pub group: Vec<usize>,
    /// Norm and size of each group.
    pub groups: Vec<(f64, usize)>,
}

/// Entries below the diagonal, in roundings of the matrix, beyond which the form was not found.
const STRAY: f64 = 1e3;

impl Schur {
    pub fn of(A: &Real) -> Result<Self, NoConvergence> {
        let size = A.nrows();
        let mut Q = Matrix::zeros(size, size);
        let (mut group, mut groups) = (Vec::new(), Vec::new());
        for (number, states) in dependent(A).iter().enumerate() {
            let block = A.select_rows(states).select_columns(states);
            let unitary = unitary(&block)?;
            for (i, state) in states.iter().enumerate() {
                (0..states.len()).for_each(|k| Q[(*state, group.len() + k)] = unitary[(i, k)]);
            }
            group.extend(states.iter().map(|_| number));
            groups.push((block.norm(), states.len()));
        }
        let mut T = Q.adjoint() * A.map(C::from) * &Q;
        let mut stray: f64 = 0.0;
        for (row, column) in (0..size).flat_map(|column| (column + 1..size).map(move |row| (row, column))) {
            stray = stray.hypot(T[(row, column)].norm());
            T[(row, column)] = C::from(0.0);
        }
        let found = stray <= STRAY * size as f64 * f64::EPSILON * A.norm();
        found.then_some(Self { Q, T, group, groups }).ok_or(NoConvergence { size })
    }

    pub fn eigenvalues(&self) -> Vec<C> {
        self.T.diagonal().iter().copied().collect()
    }

    /// Brings eigenvalues to the front, in their order.
    pub fn order(&mut self, first: &[bool]) {
        let front = (0..first.len()).filter(|place| first[*place]);
        for (to, from) in front.enumerate() {
            (to..from).rev().for_each(|place| self.exchange(place));
        }
    }

    /// Exchanges an eigenvalue with the next.
    fn exchange(&mut self, place: usize) {
        let [first, second] = [self.T[(place, place)], self.T[(place + 1, place + 1)]];
        let (x, y) = (self.T[(place, place + 1)], second - first); // eigenvector of the second
        let length = x.norm().hypot(y.norm());
        let (x, y) = if length > 0.0 { (x / length, y / length) } else { (C::from(0.0), C::from(1.0)) };
        let size = self.T.nrows();
        let turn = |matrix: &mut Matrix, rows: usize| {
            for row in 0..rows {
                let [a, b] = [matrix[(row, place)], matrix[(row, place + 1)]];
                matrix[(row, place)] = a * x + b * y;
                matrix[(row, place + 1)] = b * x.conj() - a * y.conj();
            }
        };
        turn(&mut self.T, place + 2);
        turn(&mut self.Q, size);
        for column in place..size {
            let [a, b] = [self.T[(place, column)], self.T[(place + 1, column)]];
            self.T[(place, column)] = x.conj() * a + y.conj() * b;
            self.T[(place + 1, column)] = x * b - y * a;
        }
        self.T[(place, place)] = second;
        self.T[(place + 1, place + 1)] = first;
        self.T[(place + 1, place)] = C::from(0.0);
        self.group.swap(place, place + 1);
    }
}

/// Left singular vectors, singular values (descending) and right singular vectors.
pub(super) fn singular(matrix: &Real) -> Result<(Real, Vec<f64>, Real), NoConvergence> {
    let (rows, columns) = matrix.shape();
    let size = rows.max(columns);
    let least = rows.min(columns);
    if least == 0 {
        return Ok((Real::zeros(rows, 0), Vec::new(), Real::zeros(columns, 0)));
    }
    let own = Mat::from_fn(rows, columns, |i, k| matrix[(i, k)]);
    let found = own.thin_svd().map_err(|_| NoConvergence { size })?;
    let (U, V, S) = (found.U(), found.V(), found.S());
    Ok((
        Real::from_fn(rows, least, |i, k| U[(i, k)]),
        (0..least).map(|k| S[k]).collect(),
        Real::from_fn(columns, least, |i, k| V[(i, k)]),
    ))
}
