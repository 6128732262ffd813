//! Inertia tensors about other points against their definition.

use nalgebra::{Matrix3, Vector3};
use proptest::collection::vec;
use proptest::prelude::*;
use quasirigid::model::Inertia;

use crate::support::{cases, vector};

type V = Vector3<f64>;

/// `Σ m (|s|² 1 − s sᵀ)` about a point.
fn by_definition(masses: &[(f64, V)], point: V) -> Matrix3<f64> {
    let of = |(m, r): &(f64, V)| {
        *m * ((r - point).norm_squared() * Matrix3::identity() - (r - point) * (r - point).transpose())
    };
    masses.iter().map(of).sum()
}

proptest! {
    #![proptest_config(cases(64))]

    /// In any unit of length, off the axes.
    #[test]
    fn a_shifted_tensor_is_that_of_the_masses(places in vec(vector(), 4..9), offset in vector(), unit in -9..9i32) {
        let length = 10f64.powi(unit);
        let masses: Vec<(f64, V)> = (1..).zip(&places).map(|(i, r)| (f64::from(i), length * V::from(*r))).collect();
        let mass: f64 = masses.iter().map(|(m, _)| m).sum();
        let center = masses.iter().map(|(m, r)| *m * r).sum::<V>() / mass;
        let rows = |J: Matrix3<f64>| std::array::from_fn(|i| std::array::from_fn(|j| J[(i, j)]));
        let own = Inertia::new(rows(by_definition(&masses, center))).unwrap();
        let point = length * V::from(offset);
        let found = own.shifted(mass, (point - center).into()).rows();
        let expected = by_definition(&masses, point);
        for i in 0..3 {
            for j in 0..3 {
                prop_assert!((found[i][j] - expected[(i, j)]).abs() < 1e-14 * expected.amax(), "{found:?} {expected}");
            }
        }
    }
}
