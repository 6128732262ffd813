use nalgebra::{Complex, DMatrix};

use super::fields::{Fields, Products};
use crate::math::lu::{ComplexDense, ComplexLu};

type C = Complex<f64>;

impl Fields {
    /// `bᵀ(σM + K + 2iτG)⁻¹b` with the load `b`, the degrees eliminated from the highest down. (L16)
    ///
    /// None if floating point finds no answer.
    pub fn answer(&self, sigma: C, tau: f64) -> Option<C> {
        let mut matrix = self.groups.last()?.at(sigma, tau);
        for (own, between) in self.groups.iter().zip(&self.between).rev() {
            let lower = eliminated(&matrix, &between.at(sigma, tau))?;
            matrix = own.at(sigma, tau) - lower;
        }
        let right: Vec<[f64; 2]> = self.load.iter().map(|load| [*load, 0.0]).collect();
        let flow = factor(&matrix)?.solve(&right, 1)?;
        Some(self.load.iter().zip(flow).map(|(load, [re, im])| C::new(load * re, load * im)).sum())
    }
}

impl Products {
    fn at(&self, sigma: C, tau: f64) -> DMatrix<C> {
        let turned = self.mass.zip_map(&self.turning, |mass, turning| sigma * mass + C::new(0.0, 2.0 * tau * turning));
        turned.zip_map(&self.friction, |sum, friction| sum + friction)
    }
}

fn factor(matrix: &DMatrix<C>) -> Option<ComplexLu> {
    let size = matrix.nrows();
    let mut dense = ComplexDense::zero(size);
    for row in 0..size {
        (0..size).for_each(|column| dense.add(row, column, [matrix[(row, column)].re, matrix[(row, column)].im]));
    }
    ComplexLu::new(&dense)
}

/// `B S⁻¹ Bᵀ`, of a `B` with few entries.
fn eliminated(S: &DMatrix<C>, B: &DMatrix<C>) -> Option<DMatrix<C>> {
    let (rows, size) = B.shape();
    let pair = |value: C| [value.re, value.im];
    let right: Vec<[f64; 2]> =
        (0..size).flat_map(|row| (0..rows).map(move |column| pair(B[(column, row)]))).collect();
    let solved = factor(S)?.solve(&right, rows)?;
    let mut product = DMatrix::zeros(rows, rows);
    for row in 0..rows {
        for k in (0..size).filter(|k| B[(row, *k)] != C::ZERO) {
            let share = B[(row, k)];
            for column in 0..rows {
                let [re, im] = solved[k * rows + column];
                product[(row, column)] += share * C::new(re, im);
            }
        }
    }
    Some(product)
}
