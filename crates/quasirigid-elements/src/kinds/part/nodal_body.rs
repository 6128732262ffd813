use nalgebra::Vector3;

use super::Seat;
use crate::error::{ElementError, Field, Problem, at};
use crate::finite::{Connectivity, Mass, rigid_points};
use crate::model::{Inertia, Rheology};
use crate::number;
use crate::structure::Structure;

/// A rigid body at a node.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct TipMass {
    /// Index of the node.
    pub node: usize,
    /// Mass (kg).
    pub mass: f64,
    /// Inertia tensor (kg·m²) about its centre of mass, which is at the node, in the file's axes; none at a node without rotations.
    pub inertia: [[f64; 3]; 3],
}

impl TipMass {
    /// Adds the rigid body to a structure that has the nodes of its part, so many from the first on; `name` is that of its node.
    pub(super) fn assemble_into(
        &self,
        Seat { place, first, .. }: Seat,
        count: usize,
        name: impl Fn() -> String,
        structure: &mut Structure,
    ) -> Result<(), ElementError> {
        let refuse = at(place, Field::MASSES);
        number::mass(self.mass).map_err(&refuse)?;
        let inertia = Inertia::new(self.inertia).map_err(|error| refuse(error.into()))?;
        if self.node >= count {
            return Err(refuse(Problem::NoSuchNode { index: self.node, count }));
        }
        let node = structure.nodes[first + self.node];
        let points = if node.rotations {
            rigid_points(self.mass, &inertia)
        } else if self.inertia == [[0.0; 3]; 3] {
            vec![(self.mass, Vector3::zeros())]
        } else {
            return Err(refuse(Problem::NoTurnForInertia { node: name() }));
        };
        let material = structure.material(&Rheology::Elastic, [0.0; 2]);
        let connectivity = Connectivity { nodes: vec![first + self.node], dofs: node.dofs(), material };
        structure.elements.push(Box::new(Mass { connectivity, points, place: node.place }));
        Ok(())
    }
}
