//! Curved paths of nodes: the second order of the displacement of places at which forces act or which are watched.
//! A force on a node works on it: a thrust along a boom lowers its frequencies, and buckles it in the end.
//! Equation (K6), docs/theory/12-structures.md.

use nalgebra::{DMatrix, Matrix3, Vector3};

use super::discrete::Discrete;
use super::follower_paths::FollowerPaths;
use super::loads::Acceleration;
use super::lumped_masses::MassProperties;
use super::pairs::Pairs;
use super::solver::Solver;

/// Second order `G_jk` of the path of a node: a symmetric matrix over the coordinates for each axis.
pub(super) type NodePath = [DMatrix<f64>; 3];

/// Second order of the displacement of rigid motions, a column per pair: three rows of displacement, three of rotation about a centre.
pub(super) struct RigidPart {
    pub center: Vector3<f64>,
    pub shares: DMatrix<f64>,
}

impl Discrete<'_> {
    /// Paths of nodes from the second-order displacements `second` of the structure, a row per pair of coordinates, less their rigid part.
    pub(super) fn node_paths(
        &self,
        nodes: &[usize],
        second: &DMatrix<f64>,
        followers: &FollowerPaths,
        rigid: Option<&RigidPart>,
        pairs: &Pairs,
    ) -> Vec<NodePath> {
        let path = |node: &usize| {
            let mut curved = self.dofs.spread(&[*node], 3, second);
            if let Some(carried) = followers.of(*node) {
                curved += carried.columns(0, 3);
            }
            if let Some(RigidPart { center, shares }) = rigid {
                let arm = (self.structure.nodes[*node].place - center).cross_matrix();
                curved -= (shares.rows(0, 3) - arm * shares.rows(3, 3)).transpose();
            }
            [0, 1, 2].map(|axis| pairs.symmetric(curved.column(axis).iter().copied()))
        };
        nodes.iter().map(path).collect()
    }

    /// The same by the work of unit forces on the nodes, for structures whose points are not all known; none if the paths are straight.
    /// (K6)
    pub(super) fn node_paths_by_work(
        &self,
        solver: &Solver,
        whole: &MassProperties,
        nodes: &[usize],
        fields: &DMatrix<f64>,
        followers: &FollowerPaths,
    ) -> Option<Vec<NodePath>> {
        let along: Vec<(usize, usize)> =
            nodes.iter().flat_map(|node| (0..3).map(|axis| (*node, axis))).collect();
        let inertia = |(node, axis): &(usize, usize)| {
            let arm = self.structure.nodes[*node].place - whole.center;
            inertia_of(whole, solver.floats(), arm, Vector3::ith(*axis, 1.0))
        };
        let loads: Vec<Acceleration> = along.iter().map(inertia).collect();
        let answers = solver.answers(self.unit_forces(&along));
        let works = self.works(whole.center, &loads, &answers, fields, followers)?;
        let mut works = works.into_iter();
        let pairs = Pairs(fields.nrows());
        let path = |node: &usize| {
            let carried = followers.of(*node);
            let mut next = |axis: usize| {
                let own = carried.map(|path| pairs.symmetric(path.column(axis).iter().copied()));
                works.next().map(|work| own.iter().fold(work, |sum, own| sum + own))
            };
            Some([next(0)?, next(1)?, next(2)?])
        };
        nodes.iter().map(path).collect()
    }
}

/// Load by the inertia of the rigid motion that a force on a floating structure causes, `arm` from the centre of mass. (K7)
fn inertia_of(
    whole: &MassProperties,
    floating: bool,
    arm: Vector3<f64>,
    force: Vector3<f64>,
) -> Acceleration {
    if !floating {
        return Acceleration { uniform: Vector3::zeros(), gradient: Matrix3::zeros() };
    }
    let turning = whole.angular_acceleration(arm.cross(&force));
    Acceleration { uniform: -force / whole.mass, gradient: -turning.cross_matrix() }
}
