use crate::math::polynomial::monomial::index;
use crate::math::polynomial::{Homogeneous, Series};
use crate::math::sym3::Sym;
use crate::model::ReducedBody;

/// Dense quartic and quintic equation of `ω`, to compare integrators: `data/published/quartic_quintic`.
#[derive(Clone, Debug)]
pub struct QuarticQuintic {
    /// Equation as a reduced body, for integration in the angular-velocity form.
    pub body: ReducedBody,
    /// Angular velocity at the start (rad/s).
    pub omega: [f64; 3],
    /// Times (s) and angular velocities (rad/s) of the reference solution.
    pub reference: Vec<(f64, [f64; 3])>,
}

const J: Sym = [10.3366, 14.8812, 17.7228, 0.0, 0.0, 0.0];
const COEFFICIENTS: &str = include_str!("quartic_quintic_coefficients.csv");
const REFERENCE: &str = include_str!("quartic_quintic_reference.csv");

impl QuarticQuintic {
    /// Reads the published tables.
    #[must_use]
    pub fn published() -> Self {
        let mut f = Series::zero(5, 3);
        let mut euler = Homogeneous::zero(2, 3);
        for axis in 0..3 {
            let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
            let mut product = [0; 3];
            (product[next], product[last]) = (1, 1);
            euler.row_mut(axis)[index(product)] = -(J[last] - J[next]) / J[axis];
        }
        f.set(euler);
        for row in rows(COEFFICIENTS) {
            let [degree, i, j, k] = std::array::from_fn(|column| row[column] as usize);
            let mut part = f.part(degree).clone();
            for axis in 0..3 {
                part.row_mut(axis)[index([i, j, k])] = row[4 + axis];
            }
            f.set(part);
        }
        let reference: Vec<_> = rows(REFERENCE).map(|row| (row[0], [row[1], row[2], row[3]])).collect();
        Self { body: equation(f), omega: reference[0].1, reference }
    }
}

/// Reduced body with nothing but the equation of `ω`.
fn equation(f: Series) -> ReducedBody {
    let none = |rows| Series::zero(2, rows);
    ReducedBody {
        order: 3,
        mass: 101.0,
        J,
        f,
        K: none(3),
        Omega: none(3),
        c: none(3),
        T: none(6),
        energy: none(1),
        energy_of_momentum: none(1),
        power: none(1),
        power_shares: Vec::new(),
        phi: none(3),
        pole: none(3),
        q: none(0),
        rate: none(0),
    }
}

/// Rows of numbers below the header of a CSV text.
fn rows(text: &str) -> impl Iterator<Item = Vec<f64>> {
    text.lines().skip(1).map(|line| line.split(',').filter_map(|field| field.parse().ok()).collect())
}
