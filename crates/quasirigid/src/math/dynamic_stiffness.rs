//! Dynamic stiffness `s²M + sB + C` at complex `s`, factored: the linear algebra of stiff vibrations.

use faer::prelude::Solve;
use faer::sparse::linalg::solvers::Lu;
use faer::sparse::{SparseColMat, Triplet};
use faer::{MatMut, c64};
use nalgebra::{Complex, DMatrix};

use super::sparse::SparseRows;

/// The matrices of `M ẍ + B ẋ + C x`, with `M = A − U D Uᵀ` of a sparse matrix and a few columns.
#[derive(Clone, Debug)]
pub struct Vibrator {
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
}

#[derive(Clone, Debug)]
enum Inverse {
    /// Rows of the inverse.
    Dense(Vec<Complex<f64>>),
    /// Factor of `s²A + sB + C`, its solution `X` for `U`, and what takes `Uᵀx` to the correction by `X`.
    Sparse { factor: Box<Lu<usize, c64>>, solved: Vec<Complex<f64>>, correction: DMatrix<Complex<f64>> },
    /// No inverse: `s` is an eigenvalue.
    None,
}

/// Up to this size the inverse is formed: a product with it is cheaper than the overhead of a sparse solution.
const DENSE: usize = 48;

impl Vibrator {
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
        DynamicStiffness { s, inverse: inverse.unwrap_or(Inverse::None) }
    }

    fn dense(&self, s: Complex<f64>) -> Option<Inverse> {
        let n = self.size();
        let mut matrix = DMatrix::<Complex<f64>>::zeros(n, n);
        for (factor, part) in [(s * s, &self.A), (s, &self.B), (Complex::from(1.0), &self.C)] {
            for (row, column, entry) in part.iter() {
                matrix[(row, column)] += factor * entry;
            }
        }
        for row in 0..n {
            let left = self.weighted(self.U[row].map(Complex::from));
            for column in 0..n {
                let product: Complex<f64> = left.iter().zip(&self.U[column]).map(|(a, b)| a * b).sum();
                matrix[(row, column)] -= s * s * product;
            }
        }
        let inverse = matrix.try_inverse()?;
        Some(Inverse::Dense(inverse.transpose().as_slice().to_vec()))
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
        Some(Inverse::Sparse { factor, solved, correction: middle * D * (s * s) })
    }

    /// Solves the first-order form `s x − y = g`, `M (s y) + B y + C x = f` in place: `g` and `f` become `x` and `M y`.
    pub fn solve(&self, stiffness: &DynamicStiffness, right: &mut [[f64; 2]]) {
        let n = self.size();
        let s = stiffness.s;
        let entry = |[re, im]: [f64; 2]| Complex::new(re, im);
        let g: Vec<_> = right[..n].iter().copied().map(entry).collect();
        let (momentum, damped) = (self.mass_times(&g), times(&self.B, &g));
        let load: Vec<_> = (0..n).map(|i| entry(right[n + i]) + s * momentum[i] + damped[i]).collect();
        let x = self.inverse_times(stiffness, load);
        let rate: Vec<_> = x.iter().zip(&g).map(|(x, g)| s * x - g).collect();
        let momentum = self.mass_times(&rate);
        for (entry, value) in right.iter_mut().zip(x.iter().chain(&momentum)) {
            *entry = [value.re, value.im];
        }
    }

    fn inverse_times(&self, stiffness: &DynamicStiffness, mut load: Vec<Complex<f64>>) -> Vec<Complex<f64>> {
        match &stiffness.inverse {
            Inverse::Dense(rows) => rows
                .chunks_exact(self.size())
                .map(|row| row.iter().zip(&load).map(|(entry, load)| entry * load).sum())
                .collect(),
            Inverse::Sparse { factor, solved, correction } => {
                factor.solve_in_place(MatMut::from_row_major_slice_mut(&mut load, self.size(), 1));
                let projected = nalgebra::DVector::from_row_slice(&self.projected(&load));
                let factors = correction * projected;
                for (x, solved) in load.iter_mut().zip(solved.chunks_exact(COLUMNS)) {
                    *x += solved.iter().zip(&factors).map(|(a, b)| a * b).sum::<Complex<f64>>();
                }
                load
            }
            Inverse::None => vec![Complex::from(f64::NAN); load.len()],
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
