//! Sums over the lumped masses of a structure: mass and moments, inertial loads, and products of displacements.
//! All inertia invariants come from here; masses are taken in batches, so that the products are products of matrices.
//! Equations (K3) to (K5), docs/theory/12-structures.md.

use nalgebra::{DMatrix, Matrix3, MatrixXx3, SMatrix, Vector3};

use super::discrete::Discrete;
use super::loads::{Acceleration, LOADS};
use crate::finite::LumpedMass;

/// Lumped masses in one product of matrices.
const BATCH: usize = 512;

/// Mass of a structure with its centre and second moments.
#[derive(Clone, Debug)]
pub(super) struct MassProperties {
    /// Mass (kg).
    pub mass: f64,
    /// Centre of mass (m), in the file's frame.
    pub center: Vector3<f64>,
    /// `∫ s sᵀ dm` about it (kg·m²).
    pub second: Matrix3<f64>,
}

impl MassProperties {
    /// Angular acceleration (rad/s²) under a moment (N·m) about the centre of mass; none of masses on a line. (K7)
    pub fn angular_acceleration(&self, moment: Vector3<f64>) -> Vector3<f64> {
        let inertia = self.second.trace() * Matrix3::identity() - self.second;
        inertia.try_inverse().unwrap_or_else(Matrix3::zeros) * moment
    }
}

impl Discrete<'_> {
    /// Mass, centre of mass and second moments.
    pub(super) fn whole(&self) -> MassProperties {
        let middle = self.structure.middle();
        let (mut mass, mut first, mut second) = (0.0, Vector3::zeros(), Matrix3::zeros());
        for lumped_mass in self.structure.elements.iter().flat_map(|element| element.lumped_masses()) {
            let s = lumped_mass.place_from(middle);
            mass += lumped_mass.mass * lumped_mass.one();
            first += lumped_mass.mass * lumped_mass.one() * s;
            second += lumped_mass.mass * s * s.transpose();
        }
        MassProperties {
            mass,
            center: middle + first / mass,
            second: second - first * first.transpose() / mass,
        }
    }

    /// Forces of the accelerations `e_a` and `s_b e_a`, with `s` from a point: a row each. (K4)
    pub(super) fn loads(&self, reference: Vector3<f64>) -> DMatrix<f64> {
        let mut loads = DMatrix::zeros(LOADS, self.dofs.unknowns().len());
        for element in &self.structure.elements {
            let mut forces = DMatrix::zeros(LOADS, element.nodes().len() * element.dofs());
            for lumped_mass in element.lumped_masses() {
                forces += lumped_mass.mass * accelerations(&lumped_mass, reference) * &lumped_mass.shapes;
            }
            self.dofs.gather(element.nodes(), element.dofs(), &forces, &mut loads);
        }
        loads
    }

    /// Forces of the accelerations `E u` for every displacement `u`, a row each, and each of the nine maps `e_a e_bᵀ`: the inertia that a
    /// spin gives to a displacement. (K5)
    pub(super) fn turned(&self, displacements: &DMatrix<f64>) -> DMatrix<f64> {
        let count = displacements.nrows();
        let mut turned = DMatrix::zeros(9 * count, displacements.ncols());
        for element in &self.structure.elements {
            let spread = self.dofs.spread(element.nodes(), element.dofs(), displacements);
            let mut forces = DMatrix::zeros(9 * count, spread.ncols());
            for lumped_mass in element.lumped_masses() {
                let moved: MatrixXx3<f64> = &spread * lumped_mass.shapes.transpose() * lumped_mass.mass;
                for (a, b) in (0..9).map(|map| (map / 3, map % 3)) {
                    let force = moved.column(b) * lumped_mass.shapes.row(a);
                    let mut rows = forces.rows_mut((3 * a + b) * count, count);
                    rows += force;
                }
            }
            self.dofs.gather(element.nodes(), element.dofs(), &forces, &mut turned);
        }
        turned
    }

    /// `∫ u vᵀ dm` for every pair of displacements: entry `(3a + b)` holds `∫ u_a v_b dm`, a row for each `u`. (K4)
    pub(super) fn products(&self, displacements: &DMatrix<f64>) -> [DMatrix<f64>; 9] {
        let count = displacements.nrows();
        let mut products: [DMatrix<f64>; 9] = std::array::from_fn(|_| DMatrix::zeros(count, count));
        let mut batch = Batch::new(count);
        for element in &self.structure.elements {
            let spread = self.dofs.spread(element.nodes(), element.dofs(), displacements);
            for lumped_mass in element.lumped_masses() {
                batch.push(&(&spread * lumped_mass.shapes.transpose()), lumped_mass.mass);
                if batch.filled == BATCH {
                    batch.add_to(&mut products);
                }
            }
        }
        batch.add_to(&mut products);
        products
    }
}

/// Rows: the acceleration of each load at a lumped mass.
fn accelerations(lumped_mass: &LumpedMass, reference: Vector3<f64>) -> SMatrix<f64, LOADS, 3> {
    let s = lumped_mass.place_from(reference);
    SMatrix::from_fn(|load, axis| Acceleration::of_load(load).at(s, lumped_mass.one())[axis])
}

/// Displacements of a few material points by axis, and these times the masses.
struct Batch {
    moved: [DMatrix<f64>; 3],
    weighted: [DMatrix<f64>; 3],
    filled: usize,
}

impl Batch {
    fn new(count: usize) -> Self {
        let zeros = || std::array::from_fn(|_| DMatrix::zeros(count, BATCH));
        Self { moved: zeros(), weighted: zeros(), filled: 0 }
    }

    fn push(&mut self, moved: &MatrixXx3<f64>, mass: f64) {
        for axis in 0..3 {
            self.moved[axis].set_column(self.filled, &moved.column(axis));
            self.weighted[axis].set_column(self.filled, &(mass * moved.column(axis)));
        }
        self.filled += 1;
    }

    fn add_to(&mut self, products: &mut [DMatrix<f64>; 9]) {
        for (entry, product) in products.iter_mut().enumerate() {
            let u = self.weighted[entry / 3].columns(0, self.filled);
            let v = self.moved[entry % 3].columns(0, self.filled);
            product.gemm(1.0, &u, &v.transpose(), 1.0);
        }
        self.filled = 0;
    }
}
