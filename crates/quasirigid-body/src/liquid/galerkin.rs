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
    pub between: Vec<Couplings>,
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

/// Products of two groups, of which few are not zero.
pub(super) struct Couplings(Vec<Coupling>);

struct Coupling {
    row: usize,
    column: usize,
    products: [f64; 3],
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
            let mut eliminated = own.at(sigma, tau);
            between.eliminate(&matrix, &mut eliminated, sigma, tau)?;
            matrix = eliminated;
        }
        let right: Vec<[f64; 2]> = self.load.iter().map(|load| [*load, 0.0]).collect();
        let flow = ComplexLu::new(&matrix)?.solve(&right, 1)?;
        Some(self.load.iter().zip(flow).map(|(load, [re, im])| C::new(load * re, load * im)).sum())
    }
}

/// `σM + K + 2iτG` of a pair of flows.
fn weighted([mass, friction, turning]: [f64; 3], sigma: C, tau: f64) -> [f64; 2] {
    [sigma.re * mass + friction, sigma.im * mass + 2.0 * tau * turning]
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

    /// Those that are not zero.
    pub fn couplings(&self) -> Couplings {
        let (rows, columns) = self.mass.shape();
        let places = (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column)));
        let all = places.map(|(row, column)| Coupling { row, column, products: self.of(row, column) });
        Couplings(all.filter(|coupling| coupling.products != [0.0; 3]).collect())
    }

    fn of(&self, row: usize, column: usize) -> [f64; 3] {
        [&self.mass, &self.friction, &self.turning].map(|matrix| matrix[(row, column)])
    }

    fn at(&self, sigma: C, tau: f64) -> ComplexDense {
        let mut matrix = ComplexDense::zero(self.mass.nrows());
        for row in 0..matrix.size() {
            let entries = matrix.row_mut(row).iter_mut().enumerate();
            entries.for_each(|(column, entry)| *entry = weighted(self.of(row, column), sigma, tau));
        }
        matrix
    }
}

impl Couplings {
    /// Subtracts `B S⁻¹ Bᵀ` from a matrix, with these couplings in the rows of `B`; none where `S` is singular to rounding.
    fn eliminate(&self, S: &ComplexDense, matrix: &mut ComplexDense, sigma: C, tau: f64) -> Option<()> {
        let rows = matrix.size();
        let mut right = vec![[0.0; 2]; S.size() * rows];
        for Coupling { row, column, products } in &self.0 {
            right[column * rows + row] = weighted(*products, sigma, tau);
        }
        let solved = ComplexLu::new(S)?.solve(&right, rows)?;
        for Coupling { row, column, products } in &self.0 {
            let [re, im] = weighted(*products, sigma, tau);
            for (entry, [x, y]) in matrix.row_mut(*row).iter_mut().zip(&solved[column * rows..]) {
                entry[0] -= re * x - im * y;
                entry[1] -= re * y + im * x;
            }
        }
        Some(())
    }
}
