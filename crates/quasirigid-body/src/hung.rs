//! Coordinates that the spin alone restores: hinged pendulums without a spring, such as those of slosh.
//! Equation (I13), docs/theory/02-invariants.md.

use super::flexible::BodyParts;
use super::flexible_error::named;
use crate::math::sparse::SparseRows;

/// Coordinates that nothing restores but the spin. (I13)
#[derive(Clone, Debug)]
pub struct Hung {
    pendulums: Vec<usize>,
    names: String,
    springs: Vec<(usize, usize, f64)>,
    grounded: SparseRows<f64>,
}

/// Angular velocity (rad/s) whose centrifugal force measures the displacements of what has no spring: results do not depend on it.
const MEASURE: f64 = 1.0;

impl Hung {
    /// The pendulums among the elastic coordinates, of this stiffness, that move in a direction without any; none if anything else moves in it.
    pub(super) fn of(
        parts: &BodyParts,
        stiffness: &SparseRows<f64>,
        pendulums: &[usize],
        direction: &[f64],
    ) -> Option<Self> {
        let elastic = stiffness.size();
        let largest = direction.iter().fold(0.0, |most: f64, amount| most.max(amount.abs()));
        let moves = |amount: f64| amount.abs() > f64::EPSILON.sqrt() * largest;
        let alone = (0..elastic).filter(|j| moves(direction[*j])).all(|j| pendulums.contains(&j));
        let diagonal = stiffness.diagonal();
        let free: Vec<usize> = pendulums.iter().copied().filter(|j| diagonal[*j] == 0.0).collect();
        if !alone || free.is_empty() {
            return None;
        }
        let spring = |j: &usize| (*j, *j, MEASURE * MEASURE * parts.invariants.modal_mass(*j));
        let springs: Vec<_> = free.iter().map(spring).collect();
        let all = stiffness.iter().map(|(j, k, C)| (j, k, *C)).chain(springs.iter().copied()).collect();
        let grounded = SparseRows::sum(elastic, all);
        let shares: Vec<f64> = (0..elastic).map(|j| f64::from(u8::from(free.contains(&j)))).collect();
        Some(Self {
            pendulums: pendulums.to_vec(),
            names: named(&parts.coordinates[..elastic], &shares),
            springs,
            grounded,
        })
    }

    /// Names of the coordinates.
    #[must_use]
    pub fn names(&self) -> &str {
        &self.names
    }

    /// Coordinates that the spin may restore.
    pub(super) fn pendulums(&self) -> &[usize] {
        &self.pendulums
    }

    /// Springs on the coordinates without any, as strong as the centrifugal force of an angular velocity (rad/s): entries of the stiffness.
    pub(super) fn springs(&self, rate: f64) -> impl Iterator<Item = (usize, usize, f64)> {
        let share = (rate / MEASURE).powi(2);
        self.springs.iter().map(move |(j, k, C)| (*j, *k, share * C))
    }

    /// Stiffness matrix of the elastic coordinates with springs as strong as the centrifugal force of 1 rad/s where there are none.
    pub(super) fn grounded(&self) -> &SparseRows<f64> {
        &self.grounded
    }
}
