//! Curved paths of a structure: second-order displacements by the work of twelve loads on them.
//! By reciprocity the stress of each load suffices, so no second-order problem is solved; masses on arms add their own rotation.
//! Equations (K4) and (K6), docs/theory/12-structures.md.

use nalgebra::{DMatrix, Matrix3, MatrixXx3, Vector3};

use super::discrete::Discrete;
use super::follower_paths::FollowerPaths;
use super::loads::{Acceleration, moments};
use super::pairs::Pairs;
use crate::finite::{Element, LumpedMass, Turn};
use crate::math::watch;

/// `∫ G_jk dm` and `∫ s G_jkᵀ dm` of a pair of coordinates, with `s` from the reference point. (K6)
#[derive(Clone, Copy, Debug)]
pub(super) struct Curvature {
    pub sum: Vector3<f64>,
    pub moment: Matrix3<f64>,
}

impl Curvature {
    /// Curvature of the paths of all points, by the work of the loads of an acceleration that is linear in the place. (K6)
    pub(super) fn of_pairs(works: &[DMatrix<f64>]) -> Vec<Vec<Self>> {
        let count = works[0].nrows();
        let pair = |j: usize, k: usize| {
            let (sum, moment) = moments(&works.iter().map(|work| work[(j, k)]).collect::<Vec<f64>>());
            Self { sum, moment }
        };
        (0..count).map(|j| (0..count).map(|k| pair(j, k)).collect()).collect()
    }
}

impl Discrete<'_> {
    /// Work of loads on the second order of displacements, a matrix over the coordinates for each; none if the paths are straight.
    ///
    /// The work is the stiffness lost to the stress of the load, `f·½G_jk q_j q_k = −½ qᵀ K_G[f] q`; lumped masses on an arm rotate with it
    /// besides. `answers` are the displacements under the loads, a row each. (K6)
    pub(super) fn works(
        &self,
        reference: Vector3<f64>,
        loads: &[Acceleration],
        answers: &DMatrix<f64>,
        fields: &DMatrix<f64>,
        followers: &FollowerPaths,
    ) -> Option<Vec<DMatrix<f64>>> {
        let pairs = Pairs(fields.nrows());
        let mut works = vec![DMatrix::zeros(pairs.0, pairs.0); loads.len()];
        let mut curved = !followers.is_empty();
        watch::stage("bending the paths");
        for (number, element) in self.structure.elements.iter().enumerate() {
            watch::progress(number as f64 / self.structure.elements.len() as f64);
            let spread = |rows: &DMatrix<f64>| self.dofs.spread(element.nodes(), element.dofs(), rows);
            let (own, answers) = (spread(fields), spread(answers));
            curved |= bent(element.as_ref(), reference, loads, &answers, &own, &mut works);
            if let Some(path) = followers.spread(element.as_ref()) {
                let of_pairs = path * held(element.as_ref(), reference, loads, &answers);
                for (work, own) in works.iter_mut().zip(of_pairs.column_iter()) {
                    *work += pairs.symmetric(own.iter().copied());
                }
            }
            for lumped_mass in element.lumped_masses() {
                curved |= turned(&lumped_mass, reference, loads, &own, &mut works);
            }
        }
        curved.then_some(works)
    }
}

/// Forces on the nodes of an element that its stress does not balance, a column per load: those that hold nodes on others.
fn held(
    element: &dyn Element,
    reference: Vector3<f64>,
    loads: &[Acceleration],
    answers: &DMatrix<f64>,
) -> DMatrix<f64> {
    let mut forces = -element.stiffness() * answers.transpose();
    for lumped_mass in element.lumped_masses() {
        for (mut force, load) in forces.column_iter_mut().zip(loads) {
            force += lumped_mass.shapes.tr_mul(&load.force_on(&lumped_mass, reference));
        }
    }
    forces
}

/// Adds the work of the loads on the second order of an element, by its geometric stiffness.
fn bent(
    element: &dyn Element,
    reference: Vector3<f64>,
    loads: &[Acceleration],
    answers: &DMatrix<f64>,
    fields: &DMatrix<f64>,
    works: &mut [DMatrix<f64>],
) -> bool {
    let mut bent = false;
    for (number, (load, work)) in loads.iter().zip(works).enumerate() {
        let force = |place: Vector3<f64>| load.at(place - reference, 1.0);
        if let Some(geometric) = element.geometric(&answers.row(number).transpose(), &force) {
            *work -= fields * geometric * fields.transpose();
            bent = true;
        }
    }
    bent
}

/// Adds the work of the loads on a lumped mass on a rotating arm: `½ (θ_j × (θ_k × p) + θ_k × (θ_j × p))` for each pair.
fn turned(
    lumped_mass: &LumpedMass,
    reference: Vector3<f64>,
    loads: &[Acceleration],
    fields: &DMatrix<f64>,
    works: &mut [DMatrix<f64>],
) -> bool {
    let Some(Turn { arm, shapes }) = &lumped_mass.turn else { return false };
    let rotations: MatrixXx3<f64> = fields * shapes.transpose();
    for (load, work) in loads.iter().zip(works) {
        let force = load.force_on(lumped_mass, reference);
        // θ_j × (θ_k × p) = θ_k (θ_j·p) − p (θ_j·θ_k)
        let (along, across) = (&rotations * force, &rotations * arm);
        let product = 0.5 * (&along * across.transpose() + &across * along.transpose());
        *work += product - force.dot(arm) * &rotations * rotations.transpose();
    }
    true
}
