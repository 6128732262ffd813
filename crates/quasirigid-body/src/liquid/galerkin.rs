//! Galerkin equations of a spinning liquid: block-tridiagonal system of the flows of one harmonic, and its response.
//! Groups are eliminated from the last on, so that the cost is linear in their number; a change of the basis must keep the coupling to
//! neighbours.
//! Equations (L15), (L16) and (L20), docs/theory/13-inside.md.

use nalgebra::{Complex, DMatrix, DVector};

use crate::math::lu::{ComplexDense, ComplexLu};

type C = Complex<f64>;

/// Solenoidal flows of one harmonic round the spin, zero on the wall, in groups that couple to neighbours only. (L16), (L20)
pub(super) struct Fields {
    /// Products of each group, and between each group and the next.
    pub groups: Vec<Products>,
    pub between: Vec<Products>,
    /// `∫ū·(e × r) dV` with the flows of the first group for a unit of `∫|e × r|² dV`; zero for the other groups.
    pub load: DVector<f64>,
}

/// Products of flows: rows of one group, columns of another.
#[derive(Clone)]
pub(super) struct Products {
    /// `∫ū_j·u_k dV`.
    pub mass: DMatrix<f64>,
    /// `∫∇ū_j:∇u_k dV`.
    pub friction: DMatrix<f64>,
    /// `−i∫ū_j·(e × u_k) dV`.
    pub turning: DMatrix<f64>,
}

/// Weights of the components `u_x + iu_y`, `u_x − iu_y` and `u_z` in the square of a flow, and their factors in the Coriolis force, per
/// `i`.
pub(super) const WEIGHTS: [f64; 3] = [0.5, 0.5, 1.0];
pub(super) const TURNED: [f64; 3] = [1.0, -1.0, 0.0];
/// Share of the largest product below which others are rounding.
const PRODUCT_ROUNDING: f64 = 1e-14;

impl Fields {
    /// `bᵀ(σM + K + 2iτG)⁻¹b` with the load `b`, the groups eliminated from the last on. (L16)
    ///
    /// None if a matrix is singular to rounding.
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
    /// Products with rounding set to zero.
    pub fn cleaned(mut self) -> Self {
        for matrix in [&mut self.mass, &mut self.friction, &mut self.turning] {
            let largest = matrix.amax();
            matrix
                .iter_mut()
                .filter(|entry| entry.abs() < PRODUCT_ROUNDING * largest)
                .for_each(|entry| *entry = 0.0);
        }
        self
    }

    fn at(&self, sigma: C, tau: f64) -> DMatrix<C> {
        let turned =
            self.mass.zip_map(&self.turning, |mass, turning| sigma * mass + C::new(0.0, 2.0 * tau * turning));
        turned.zip_map(&self.friction, |sum, friction| sum + friction)
    }
}

fn factor(matrix: &DMatrix<C>) -> Option<ComplexLu> {
    let size = matrix.nrows();
    let mut dense = ComplexDense::zero(size);
    for row in 0..size {
        (0..size)
            .for_each(|column| dense.add(row, column, [matrix[(row, column)].re, matrix[(row, column)].im]));
    }
    ComplexLu::new(&dense)
}

/// `B S⁻¹ Bᵀ` for a `B` with few entries.
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
