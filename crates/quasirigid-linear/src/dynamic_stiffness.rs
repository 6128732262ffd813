//! Dynamic stiffness `s²M + sB + C` at complex `s`, factored: the linear algebra of stiff vibrations.

use faer::prelude::Solve;
use faer::sparse::linalg::solvers::Lu;
use faer::sparse::{SparseColMat, Triplet};
use faer::{MatMut, c64};
use nalgebra::{Complex, DMatrix, DVector};

use super::sparse::SparseRows;

/// The matrices of `M ẍ + B ẋ + C x`, with `M = A − U D Uᵀ` of a sparse matrix and a few columns.
#[derive(Clone, Debug)]
pub struct Oscillator {
    A: SparseRows<f64>,
    /// Rows of `U`.
    U: Vec<[f64; COLUMNS]>,
    D: [[f64; COLUMNS]; COLUMNS],
    B: SparseRows<f64>,
    C: SparseRows<f64>,
}

/// Columns of `U`.
pub const COLUMNS: usize = 6;

/// `s²M + sB + C` at one `s`, ready to solve.
#[derive(Clone, Debug)]
pub struct DynamicStiffness {
    s: Complex<f64>,
    inverse: Inverse,
    /// Room for a right-hand side.
    right: Vec<Complex<f64>>,
}

#[derive(Clone, Debug)]
enum Inverse {
    /// Rows of the matrix that takes `g` and `f` to `x` and `M y`.
    Dense(Vec<Complex<f64>>),
    Sparse(SparseInverse),
    /// No inverse: `s` is an eigenvalue.
    None,
}

#[derive(Clone, Debug)]
struct SparseInverse {
    /// LU factors of `s²A + sB + C`.
    factor: Box<Lu<usize, c64>>,
    /// Rows of the solution `X` for `U`.
    solved: Vec<Complex<f64>>,
    /// Matrix from `Uᵀx` to the correction by `X`.
    correction: DMatrix<Complex<f64>>,
}

/// Up to this size the solution is formed as a matrix: a product with it is cheaper than the overhead of a sparse
/// solution.
const DENSE: usize = 48;

impl Oscillator {
    /// Joins the matrices.
    #[must_use]
    pub fn new(
        A: SparseRows<f64>,
        U: Vec<[f64; COLUMNS]>,
        D: [[f64; COLUMNS]; COLUMNS],
        B: SparseRows<f64>,
        C: SparseRows<f64>,
    ) -> Self {
        Self { A, U, D, B, C }
    }

    /// Number of coordinates.
    #[must_use]
    pub fn size(&self) -> usize {
        self.C.size()
    }

    /// Factors `s²M + sB + C`.
    #[must_use]
    pub fn at(&self, [re, im]: [f64; 2]) -> DynamicStiffness {
        let s = Complex::new(re, im);
        let inverse = if self.size() <= DENSE { self.dense(s) } else { self.sparse(s) };
        DynamicStiffness { s, inverse: inverse.unwrap_or(Inverse::None), right: Vec::new() }
    }

    fn dense(&self, s: Complex<f64>) -> Option<Inverse> {
        let n = self.size();
        let mut M = full(&self.A);
        let U = DMatrix::from_fn(n, COLUMNS, |i, j| self.U[i][j]);
        let D = DMatrix::from_fn(COLUMNS, COLUMNS, |i, j| self.D[i][j]);
        M -= &U * D * U.transpose();
        let M = M.map(Complex::from);
        let load = &M * s + full(&self.B).map(Complex::from);
        let from_load = (&load * s + full(&self.C).map(Complex::from)).try_inverse()?;
        let from_rate = &from_load * load;
        let mut rows = DMatrix::<Complex<f64>>::zeros(2 * n, 2 * n);
        rows.view_mut((n, 0), (n, n)).copy_from(&(&M * (&from_rate * s - DMatrix::identity(n, n))));
        rows.view_mut((n, n), (n, n)).copy_from(&(M * &from_load * s));
        rows.view_mut((0, 0), (n, n)).copy_from(&from_rate);
        rows.view_mut((0, n), (n, n)).copy_from(&from_load);
        Some(Inverse::Dense(rows.transpose().as_slice().to_vec()))
    }

    fn sparse(&self, s: Complex<f64>) -> Option<Inverse> {
        let n = self.size();
        let parts = [(s * s, &self.A), (s, &self.B), (Complex::from(1.0), &self.C)];
        let triplets: Vec<_> = parts
            .iter()
            .flat_map(|(factor, part)| {
                part.iter().map(move |(row, column, entry)| Triplet::new(row, column, factor * entry))
            })
            .collect();
        let matrix = SparseColMat::<usize, c64>::try_new_from_triplets(n, n, &triplets).ok()?;
        let factor = Box::new(matrix.sp_lu().ok()?);
        let mut solved: Vec<Complex<f64>> = self.U.iter().flatten().map(|u| Complex::from(*u)).collect();
        factor.solve_in_place(MatMut::from_row_major_slice_mut(&mut solved, n, COLUMNS));
        // (F − s²UDUᵀ)⁻¹ = F⁻¹ + s²F⁻¹U (1 − s²D UᵀF⁻¹U)⁻¹ D UᵀF⁻¹
        let mut inner = DMatrix::<Complex<f64>>::zeros(COLUMNS, COLUMNS);
        for (u, x) in self.U.iter().zip(solved.chunks_exact(COLUMNS)) {
            for (i, u) in u.iter().enumerate() {
                for (j, x) in x.iter().enumerate() {
                    inner[(i, j)] += s * s * u * x;
                }
            }
        }
        let D = DMatrix::from_fn(COLUMNS, COLUMNS, |i, j| Complex::from(self.D[i][j]));
        let middle = (DMatrix::identity(COLUMNS, COLUMNS) - &D * inner).try_inverse()?;
        Some(Inverse::Sparse(SparseInverse { factor, solved, correction: middle * D * (s * s) }))
    }

    /// Solves the first-order form `s x − y = g`, `M (s y) + B y + C x = f` in place: `g` and `f` become `x` and `M y`.
    pub fn solve(&self, stiffness: &mut DynamicStiffness, right: &mut [[f64; 2]]) {
        // A rigid body has no coordinates.
        if right.is_empty() {
            return;
        }
        let DynamicStiffness { s, inverse, right: given } = stiffness;
        given.clear();
        given.extend(right.iter().map(|[re, im]| Complex::new(*re, *im)));
        match inverse {
            Inverse::Dense(rows) => {
                for (entry, row) in right.iter_mut().zip(rows.chunks_exact(given.len())) {
                    let sum: Complex<f64> = row.iter().zip(&*given).map(|(a, b)| a * b).sum();
                    *entry = [sum.re, sum.im];
                }
            }
            Inverse::Sparse(inverse) => {
                let (g, f) = given.split_at_mut(self.size());
                self.solve_sparse(*s, inverse, g, f, right);
            }
            Inverse::None => right.fill([f64::NAN; 2]),
        }
    }

    fn solve_sparse(
        &self,
        s: Complex<f64>,
        inverse: &SparseInverse,
        g: &[Complex<f64>],
        f: &mut [Complex<f64>],
        solution: &mut [[f64; 2]],
    ) {
        let (momentum, damped) = (self.mass_times(g), times(&self.B, g));
        for ((load, momentum), damped) in f.iter_mut().zip(&momentum).zip(&damped) {
            *load += s * momentum + damped;
        }
        inverse.factor.solve_in_place(MatMut::from_row_major_slice_mut(f, self.size(), 1));
        let factors = &inverse.correction * DVector::from_row_slice(&self.projected(f));
        for (x, solved) in f.iter_mut().zip(inverse.solved.chunks_exact(COLUMNS)) {
            *x += solved.iter().zip(&factors).map(|(a, b)| a * b).sum::<Complex<f64>>();
        }
        let rate: Vec<_> = f.iter().zip(g).map(|(x, g)| s * x - g).collect();
        let momentum = self.mass_times(&rate);
        for (entry, value) in solution.iter_mut().zip(f.iter().chain(&momentum)) {
            *entry = [value.re, value.im];
        }
    }

    /// `M x`.
    fn mass_times(&self, x: &[Complex<f64>]) -> Vec<Complex<f64>> {
        let recoil = self.weighted(self.projected(x));
        let mut product = times(&self.A, x);
        for (product, U) in product.iter_mut().zip(&self.U) {
            *product -= recoil.iter().zip(U).map(|(a, b)| a * b).sum::<Complex<f64>>();
        }
        product
    }

    /// `Uᵀx`.
    fn projected(&self, x: &[Complex<f64>]) -> [Complex<f64>; COLUMNS] {
        let mut sums = [Complex::from(0.0); COLUMNS];
        for (U, x) in self.U.iter().zip(x) {
            for (sum, U) in sums.iter_mut().zip(U) {
                *sum += x * U;
            }
        }
        sums
    }

    /// `D a`.
    fn weighted(&self, a: [Complex<f64>; COLUMNS]) -> [Complex<f64>; COLUMNS] {
        self.D.map(|row| row.iter().zip(&a).map(|(weight, a)| a * weight).sum())
    }
}

fn times(matrix: &SparseRows<f64>, x: &[Complex<f64>]) -> Vec<Complex<f64>> {
    (0..matrix.size()).map(|row| matrix.row(row).map(|(column, entry)| x[column] * entry).sum()).collect()
}

fn full(matrix: &SparseRows<f64>) -> DMatrix<f64> {
    let mut rows = DMatrix::zeros(matrix.size(), matrix.size());
    matrix.iter().for_each(|(row, column, entry)| rows[(row, column)] += entry);
    rows
}
