//! Factors of matrices without symmetry: dense ones, real and complex, and sparse complex ones.

use faer::linalg::solvers::PartialPivLu;
use faer::prelude::Solve;
use faer::sparse::linalg::solvers::Lu as SparseFactor;
use faer::sparse::{SparseColMat, Triplet};
use faer::{Mat, c64};

use super::eigen::Dense;

/// LU factors of a real square matrix, rows scaled to a largest entry of one.
#[derive(Clone, Debug)]
pub struct Lu {
    scale: Vec<f64>,
    factor: PartialPivLu<f64>,
}

impl Lu {
    /// Factors a matrix; none if a row of it is zero or no number.
    #[must_use]
    pub fn new(matrix: &Dense) -> Option<Self> {
        let size = matrix.size();
        let scale = row_scales(size, |row, column| matrix.at(row, column).abs())?;
        let scaled = Mat::from_fn(size, size, |row, column| scale[row] * matrix.at(row, column));
        Some(Self { factor: scaled.partial_piv_lu(), scale })
    }

    /// Solutions for right-hand sides stored row by row, `width` to a row; none where the matrix is singular.
    #[must_use]
    pub fn solve(&self, right: &[f64], width: usize) -> Option<Vec<f64>> {
        let size = self.scale.len();
        let mut x = Mat::from_fn(size, width, |row, column| self.scale[row] * right[row * width + column]);
        self.factor.solve_in_place(x.as_mut());
        let entries = (0..size).flat_map(|row| (0..width).map(move |column| (row, column)));
        let solved: Vec<f64> = entries.map(|(row, column)| x[(row, column)]).collect();
        solved.iter().all(|entry| entry.is_finite()).then_some(solved)
    }
}

/// Square matrix of complex numbers, real and imaginary part, by rows.
#[derive(Clone, Debug, PartialEq)]
pub struct ComplexDense {
    size: usize,
    entries: Vec<[f64; 2]>,
}

impl ComplexDense {
    /// Zero.
    #[must_use]
    pub fn zero(size: usize) -> Self {
        Self { size, entries: vec![[0.0; 2]; size * size] }
    }

    /// Number of rows and columns.
    #[must_use]
    pub fn size(&self) -> usize {
        self.size
    }

    /// An entry.
    #[must_use]
    pub fn at(&self, row: usize, column: usize) -> [f64; 2] {
        self.entries[row * self.size + column]
    }

    /// Adds to an entry.
    pub fn add(&mut self, row: usize, column: usize, [re, im]: [f64; 2]) {
        let entry = &mut self.entries[row * self.size + column];
        entry[0] += re;
        entry[1] += im;
    }

    /// Entries of a row, to change.
    pub fn row_mut(&mut self, row: usize) -> &mut [[f64; 2]] {
        &mut self.entries[row * self.size..(row + 1) * self.size]
    }

    /// Adds a real matrix times a complex factor.
    pub fn add_scaled(&mut self, [re, im]: [f64; 2], matrix: &Dense) {
        for row in 0..self.size {
            for column in 0..self.size {
                let value = matrix.at(row, column);
                if value != 0.0 {
                    self.add(row, column, [re * value, im * value]);
                }
            }
        }
    }
}

/// LU factors of a complex square matrix, rows scaled to a largest real or imaginary part of one.
#[derive(Clone, Debug)]
pub struct ComplexLu {
    scale: Vec<f64>,
    factor: PartialPivLu<c64>,
}

impl ComplexLu {
    /// Factors a matrix; none if a row of it is zero or no number.
    #[must_use]
    pub fn new(matrix: &ComplexDense) -> Option<Self> {
        let size = matrix.size();
        let scale = row_scales(size, |row, column| {
            let [re, im] = matrix.at(row, column);
            re.abs().max(im.abs())
        })?;
        let scaled = Mat::from_fn(size, size, |row, column| {
            let [re, im] = matrix.at(row, column);
            c64::new(scale[row] * re, scale[row] * im)
        });
        Some(Self { factor: scaled.partial_piv_lu(), scale })
    }

    /// Solutions for right-hand sides stored row by row, `width` to a row; none where the matrix is singular.
    #[must_use]
    pub fn solve(&self, right: &[[f64; 2]], width: usize) -> Option<Vec<[f64; 2]>> {
        let size = self.scale.len();
        let mut x = Mat::from_fn(size, width, |row, column| {
            let [re, im] = right[row * width + column];
            c64::new(self.scale[row] * re, self.scale[row] * im)
        });
        self.factor.solve_in_place(x.as_mut());
        finite_rows(&x)
    }
}

/// LU factors of a sparse complex matrix.
#[derive(Clone, Debug)]
pub struct SparseLu {
    size: usize,
    factor: Box<SparseFactor<usize, c64>>,
}

impl SparseLu {
    /// Factors the square matrix of these entries by row and column, real and imaginary part; none where it is singular.
    #[must_use]
    pub fn new(size: usize, entries: &[(usize, usize, [f64; 2])]) -> Option<Self> {
        let triplet = |(row, column, [re, im]): &(usize, usize, [f64; 2])| {
            Triplet::new(*row, *column, c64::new(*re, *im))
        };
        let triplets: Vec<_> = entries.iter().map(triplet).collect();
        let matrix = SparseColMat::<usize, c64>::try_new_from_triplets(size, size, &triplets).ok()?;
        Some(Self { size, factor: Box::new(matrix.sp_lu().ok()?) })
    }

    /// Solutions for right-hand sides stored row by row, `width` to a row; none where the matrix is singular.
    #[must_use]
    pub fn solve(&self, right: &[[f64; 2]], width: usize) -> Option<Vec<[f64; 2]>> {
        let mut x = Mat::from_fn(self.size, width, |row, column| {
            let [re, im] = right[row * width + column];
            c64::new(re, im)
        });
        self.factor.solve_in_place(x.as_mut());
        finite_rows(&x)
    }
}

/// Entries row by row; none if one is no number.
fn finite_rows(x: &Mat<c64>) -> Option<Vec<[f64; 2]>> {
    let mut entries = Vec::with_capacity(x.nrows() * x.ncols());
    for row in 0..x.nrows() {
        entries.extend((0..x.ncols()).map(|column| [x[(row, column)].re, x[(row, column)].im]));
    }
    entries.iter().all(|[re, im]| re.is_finite() && im.is_finite()).then_some(entries)
}

/// Inverse of the largest size in each row.
fn row_scales(count: usize, size: impl Fn(usize, usize) -> f64) -> Option<Vec<f64>> {
    let scale = |row: usize| {
        let largest = (0..count).map(|column| size(row, column)).fold(0.0, f64::max);
        (largest > 0.0 && largest.is_finite()).then(|| largest.recip())
    };
    (0..count).map(scale).collect()
}
