//! Eigenvalues of dense matrices; the only file that names the dense library.

use std::ops::Range;

use faer::{Mat, Side};
use thiserror::Error;

use super::sparse::SparseRows;

/// The iteration of an eigenvalue solver did not converge.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[error(
    "the modes of {size} coordinates were not found: the iteration for them did not converge; if masses or stiffnesses in the model differ by many orders of magnitude, bring them closer together"
)]
pub struct NoConvergence {
    /// Size of the matrix.
    pub size: usize,
}

/// Square matrix of numbers, by rows.
#[derive(Clone, Debug, PartialEq)]
pub struct Dense {
    size: usize,
    entries: Vec<f64>,
}

impl Dense {
    /// Zero.
    #[must_use]
    pub fn zero(size: usize) -> Self {
        Self { size, entries: vec![0.0; size * size] }
    }

    /// Dense form of a sparse matrix.
    #[must_use]
    pub fn of(matrix: &SparseRows<f64>) -> Self {
        let mut dense = Self::zero(matrix.size());
        matrix.iter().for_each(|(row, column, entry)| dense.add(row, column, *entry));
        dense
    }

    /// Number of rows and columns.
    #[must_use]
    pub fn size(&self) -> usize {
        self.size
    }

    /// The square block of a range of rows and columns.
    #[must_use]
    pub fn block(&self, range: Range<usize>) -> Self {
        let row = |row: usize| &self.entries[row * self.size..][range.clone()];
        Self { size: range.len(), entries: range.clone().flat_map(row).copied().collect() }
    }

    /// An entry.
    #[must_use]
    pub fn at(&self, row: usize, column: usize) -> f64 {
        self.entries[row * self.size + column]
    }

    /// Adds to an entry.
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        self.entries[row * self.size + column] += value;
    }

    /// Product with a vector.
    #[must_use]
    pub fn times(&self, x: &[f64]) -> Vec<f64> {
        self.entries
            .chunks_exact(self.size.max(1))
            .map(|row| row.iter().zip(x).map(|(a, b)| a * b).sum())
            .collect()
    }

    fn mat(&self) -> Mat<f64> {
        Mat::from_fn(self.size, self.size, |row, column| self.at(row, column))
    }
}

/// Vibration modes of `C x = Ω² A x`: frequencies ascending, and modes with unit modal mass, one per column.
#[derive(Clone, Debug)]
pub struct Eigenmodes {
    /// Frequencies `Ω`, ascending.
    pub frequencies: Vec<f64>,
    /// Modes, one per column; `xᵀ A x = 1`, or `xᵀ C x = 1` if the frequency is infinite.
    pub shapes: Dense,
}

/// Solves `C x = Ω² A x` for symmetric positive definite `C` and positive semi-definite `A`. (V2)
///
/// Works with `1/Ω²`, so the lowest frequencies, which decide how far the theory holds, are the most accurate. A
/// coordinate without mass has an infinite frequency. Coordinates that neither matrix couples are solved apart.
///
/// # Errors
/// [`NoConvergence`] if the solver fails or `C` is not positive definite.
pub fn modes(A: &Dense, C: &Dense) -> Result<Eigenmodes, NoConvergence> {
    let size = A.size();
    let mut found: Vec<(f64, Vec<(usize, f64)>)> = Vec::with_capacity(size);
    for rows in coupled(A, C) {
        let (squares, vectors) = block_modes(A, C, &rows).ok_or(NoConvergence { size })?;
        for (column, inverse) in squares.iter().enumerate() {
            let frequency = inverse.max(0.0).sqrt().recip();
            let unit = if frequency.is_finite() { frequency } else { 1.0 };
            let entries = rows.iter().enumerate().map(|(i, row)| (*row, vectors[(i, column)] * unit));
            found.push((frequency, entries.collect()));
        }
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut modes = Eigenmodes { frequencies: Vec::with_capacity(size), shapes: Dense::zero(size) };
    for (column, (frequency, entries)) in found.into_iter().enumerate() {
        modes.frequencies.push(frequency);
        entries.iter().for_each(|(row, entry)| modes.shapes.add(*row, column, *entry));
    }
    Ok(modes)
}

/// Lists of rows that are coupled with each other and with no others, each ascending.
fn coupled(A: &Dense, C: &Dense) -> Vec<Vec<usize>> {
    let size = A.size();
    let mut lists = Vec::new();
    let mut taken = vec![false; size];
    for first in 0..size {
        if taken[first] {
            continue;
        }
        taken[first] = true;
        let mut list = vec![first];
        let mut next = 0;
        while let Some(&row) = list.get(next) {
            for other in 0..size {
                if !taken[other] && (A.at(row, other) != 0.0 || C.at(row, other) != 0.0) {
                    taken[other] = true;
                    list.push(other);
                }
            }
            next += 1;
        }
        list.sort_unstable();
        lists.push(list);
    }
    lists
}

/// Values of `1/Ω²` of some rows, and vectors with `xᵀ C x = 1`, one per column.
fn block_modes(A: &Dense, C: &Dense, rows: &[usize]) -> Option<(Vec<f64>, Mat<f64>)> {
    let scale: Vec<f64> = rows.iter().map(|row| C.at(*row, *row).sqrt().recip()).collect();
    let scaled = |matrix: &Dense| {
        Mat::from_fn(rows.len(), rows.len(), |i, j| matrix.at(rows[i], rows[j]) * scale[i] * scale[j])
    };
    let factor = scaled(C).llt(Side::Lower).ok()?;
    let L = factor.L();
    let mut inner = scaled(A);
    L.solve_lower_triangular_in_place(inner.as_mut());
    inner = inner.transpose().to_owned();
    L.solve_lower_triangular_in_place(inner.as_mut());
    let eigen = inner.self_adjoint_eigen(Side::Lower).ok()?;
    let mut vectors = eigen.U().to_owned();
    L.transpose().solve_upper_triangular_in_place(vectors.as_mut());
    let unscaled = Mat::from_fn(rows.len(), rows.len(), |i, j| vectors[(i, j)] * scale[i]);
    Some(((0..rows.len()).map(|i| eigen.S()[i]).collect(), unscaled))
}

/// Linear forms `g` whose squares sum to a symmetric positive semi-definite matrix, `Σ g gᵀ`, one per row.
///
/// Each row of the matrix keeps its digits however large the others are; negative eigenvalues are taken for rounding.
///
/// # Errors
/// [`NoConvergence`] if the solver fails.
pub fn squares(matrix: &Dense) -> Result<Dense, NoConvergence> {
    let size = matrix.size();
    if size == 0 {
        return Ok(Dense::zero(0));
    }
    let scale: Vec<f64> = (0..size).map(|row| matrix.at(row, row).max(0.0).sqrt()).collect();
    let unit = |row: usize| if scale[row] > 0.0 { scale[row].recip() } else { 0.0 };
    let scaled = Mat::from_fn(size, size, |i, j| matrix.at(i, j) * unit(i) * unit(j));
    let eigen = scaled.self_adjoint_eigen(Side::Lower).map_err(|_| NoConvergence { size })?;
    let (values, vectors) = (eigen.S(), eigen.U());
    let least = size as f64 * f64::EPSILON * (0..size).map(|form| values[form]).fold(0.0, f64::max);
    let mut forms = Dense::zero(size);
    for form in (0..size).filter(|form| values[*form] > least) {
        (0..size)
            .for_each(|row| forms.add(form, row, values[form].sqrt() * scale[row] * vectors[(row, form)]));
    }
    Ok(forms)
}

/// Eigenvalues of a square matrix as pairs (real part, imaginary part), in no particular order.
///
/// # Errors
/// [`NoConvergence`] if the solver fails.
pub fn eigenvalues(matrix: &Dense) -> Result<Vec<[f64; 2]>, NoConvergence> {
    if matrix.size() == 0 {
        return Ok(Vec::new());
    }
    let values = matrix.mat().eigenvalues().map_err(|_| NoConvergence { size: matrix.size() })?;
    Ok(values.iter().map(|value| [value.re, value.im]).collect())
}

/// Eigenvalues, and eigenvectors as lists; real and imaginary parts.
pub type Eigenvectors = (Vec<[f64; 2]>, Vec<Vec<[f64; 2]>>);

/// Eigenvalues of a square matrix with an eigenvector of each.
///
/// Complex eigenvalues come in conjugate pairs, real ones have no imaginary part. Vectors of eigenvalues that are equal are independent
/// where the matrix has so many.
///
/// # Errors
/// [`NoConvergence`] if the solver fails.
pub fn eigenvectors(matrix: &Dense) -> Result<Eigenvectors, NoConvergence> {
    let size = matrix.size();
    if size == 0 {
        return Ok((Vec::new(), Vec::new()));
    }
    let (values, mut vectors) = lists(&matrix.mat().eigen().map_err(|_| NoConvergence { size })?);
    let scale = matrix.entries.iter().fold(0.0_f64, |sum, entry| sum.hypot(*entry));
    let least = STRAY * size as f64 * f64::EPSILON * scale;
    let lost = |k: &usize| crowded(&values, *k) || !solves(matrix, values[*k], &vectors[*k], least);
    let wrong: Vec<usize> = (0..size).filter(lost).collect();
    if !wrong.is_empty() {
        let complex = Mat::from_fn(size, size, |row, column| faer::c64::new(matrix.at(row, column), 0.0));
        let (near, found) = lists(&complex.eigen().map_err(|_| NoConvergence { size })?);
        replace(&mut vectors, &values, &wrong, &near, &found);
    }
    Ok((values, vectors))
}

/// Residuals of an eigenvector, in roundings, beyond which it is not one.
const STRAY: f64 = 1e3;

/// Relative distance within which the library loses the vectors of complex eigenvalues in the arithmetic of real numbers, though not in
/// that of complex ones.
const NEARLY_EQUAL: f64 = 1e-8;

/// Whether another complex eigenvalue is as good as equal.
fn crowded(values: &[[f64; 2]], k: usize) -> bool {
    let [re, im] = values[k];
    let near = |other: &[f64; 2]| (other[0] - re).hypot(other[1] - im) <= NEARLY_EQUAL * re.hypot(im);
    im != 0.0 && values.iter().filter(|other| near(other)).count() > 1
}

/// Eigenvalues and eigenvectors as lists.
fn lists(eigen: &faer::linalg::solvers::Eigen<f64>) -> Eigenvectors {
    let (values, vectors) = (eigen.S(), eigen.U());
    let pair = |entry: faer::c64| [entry.re, entry.im];
    let list = |column: usize| (0..vectors.nrows()).map(|row| pair(vectors[(row, column)])).collect();
    ((0..vectors.ncols()).map(|i| pair(values[i])).collect(), (0..vectors.ncols()).map(list).collect())
}

/// Whether `|Mx − λx|` is at most so much of `|x|`.
fn solves(matrix: &Dense, [re, im]: [f64; 2], x: &[[f64; 2]], least: f64) -> bool {
    let part = |i: usize| matrix.times(&x.iter().map(|entry| entry[i]).collect::<Vec<_>>());
    let residual = part(0).iter().zip(part(1)).zip(x).fold(0.0_f64, |sum, ((first, second), [u, v])| {
        sum.hypot((first - re * u + im * v).hypot(second - re * v - im * u))
    });
    residual <= least * x.iter().fold(0.0_f64, |sum, [u, v]| sum.hypot(u.hypot(*v)))
}

/// Replaces wrong vectors by those of the nearest eigenvalues of another list, each once; conjugates stay conjugate.
fn replace(
    vectors: &mut [Vec<[f64; 2]>],
    values: &[[f64; 2]],
    wrong: &[usize],
    near: &[[f64; 2]],
    found: &[Vec<[f64; 2]>],
) {
    let mut left: Vec<usize> = (0..near.len()).collect();
    let off = |k: usize, other: usize| (near[other][0] - values[k][0]).hypot(near[other][1] - values[k][1]);
    for k in (0..values.len()).filter(|k| values[*k][1] >= 0.0) {
        let nearest = (0..left.len()).min_by(|a, b| off(k, left[*a]).total_cmp(&off(k, left[*b])));
        let Some(nearest) = nearest.map(|at| left.swap_remove(at)) else { continue };
        if wrong.contains(&k) {
            vectors[k].clone_from(&found[nearest]);
        }
    }
    for k in wrong.iter().filter(|k| values[**k][1] < 0.0) {
        let twin = |other: &usize| values[*other] == [values[*k][0], -values[*k][1]];
        let copies = (0..*k).filter(|other| values[*other] == values[*k]).count();
        if let Some(twin) = (0..values.len()).filter(twin).nth(copies) {
            vectors[*k] = vectors[twin].iter().map(|[re, im]| [*re, -im]).collect();
        }
    }
}
