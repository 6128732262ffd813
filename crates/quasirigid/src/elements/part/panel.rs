use std::sync::Arc;

use super::Substance;
use crate::elements::error::ElementError;
use crate::elements::structure::Structure;
use crate::math::mesh::Mesh;

/// A thin plate or shell.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// Nodes and cells: triangles and quadrilaterals without nodes on their edges.
    pub mesh: Arc<Mesh>,
    /// Layers, from the side opposite to the normal on.
    pub layers: Vec<Layer>,
    /// Direction whose projection is the angle zero of the layers.
    pub reference: [f64; 3],
}

/// A layer of a panel.
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    /// What it is made of; its axis 3 is the normal.
    pub substance: Substance,
    /// Thickness (m).
    pub thickness: f64,
    /// Angle (rad) from the reference direction to its axis 1.
    pub angle: f64,
}

impl Panel {
    pub(super) fn furnish(&self, _: usize, _: usize, _: [f64; 2], _: &mut Structure) -> Result<(), ElementError> {
        Ok(())
    }
}
