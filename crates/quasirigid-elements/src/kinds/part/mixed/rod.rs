//! Rod: a straight element that resists stretch alone.

use nalgebra::{DMatrix, DVector, Matrix3, Matrix3xX, SVector, Vector3};

use crate::finite::{Connectivity, Element, LumpedMass, MassLocation};

/// Rod: stretch alone.
#[derive(Debug)]
pub(super) struct Rod {
    pub connectivity: Connectivity,
    /// Places of the ends (m).
    pub places: [Vector3<f64>; 2],
    /// Young's modulus (Pa).
    pub young: f64,
    /// Area (m²).
    pub area: f64,
    /// Density (kg/m³).
    pub density: f64,
}

impl Rod {
    /// Direction along the rod, and its length (m).
    fn direction(&self) -> (Vector3<f64>, f64) {
        let along = self.places[1] - self.places[0];
        (along.normalize(), along.norm())
    }

    /// `A ⊗ (1, −1; −1, 1)`.
    fn between(block: Matrix3<f64>) -> DMatrix<f64> {
        DMatrix::from_fn(6, 6, |i, j| {
            let sign = if i / 3 == j / 3 { 1.0 } else { -1.0 };
            sign * block[(i % 3, j % 3)]
        })
    }
}

impl Element for Rod {
    fn connectivity(&self) -> &Connectivity {
        &self.connectivity
    }

    fn stiffness(&self) -> DMatrix<f64> {
        let (n, length) = self.direction();
        Self::between(self.young * self.area / length * n * n.transpose())
    }

    fn lumped_masses(&self) -> Vec<LumpedMass> {
        let (_, length) = self.direction();
        let mass = 0.5 * self.density * self.area * length;
        if mass == 0.0 {
            return Vec::new();
        }
        // Gauss's two points integrate the products of linear shapes.
        let shares = [0.5 - 0.5 / 3.0_f64.sqrt(), 0.5 + 0.5 / 3.0_f64.sqrt()];
        let point = |share: f64| {
            let mut shapes = Matrix3xX::zeros(6);
            shapes.columns_mut(0, 3).copy_from(&((1.0 - share) * Matrix3::identity()));
            shapes.columns_mut(3, 3).copy_from(&(share * Matrix3::identity()));
            let place = (1.0 - share) * self.places[0] + share * self.places[1];
            LumpedMass { mass, location: MassLocation::At(place), shapes, turn: None }
        };
        shares.map(point).to_vec()
    }

    fn geometric(
        &self,
        displacement: &DVector<f64>,
        _: &dyn Fn(Vector3<f64>) -> Vector3<f64>,
    ) -> Option<DMatrix<f64>> {
        let (n, length) = self.direction();
        let u = SVector::<f64, 6>::from_column_slice(displacement.as_slice());
        let stretch = n.dot(&(u.fixed_rows::<3>(3) - u.fixed_rows::<3>(0)));
        let tension = self.young * self.area / length * stretch;
        Some(Self::between(tension / length * (Matrix3::identity() - n * n.transpose())))
    }
}
