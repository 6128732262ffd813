use std::sync::Arc;

use nalgebra::{DMatrix, DVector, Matrix3, Matrix6, Rotation3, Vector3};

use super::Substance;
use crate::elements::error::{ElementError, Place};
use crate::elements::finite::{Element, Grain};
use crate::elements::structure::{Matter, Structure};
use crate::math::mesh::{Mesh, Shape};

/// A solid of cells: tetrahedra, wedges and hexahedra.
#[derive(Clone, Debug, PartialEq)]
pub struct Solid {
    /// Nodes and cells; faces and lines among the cells bear nothing.
    pub mesh: Arc<Mesh>,
    /// What its cells are made of; each solid cell is in one region.
    pub regions: Vec<Region>,
}

/// Cells of one substance.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// Indices of the cells.
    pub cells: Vec<usize>,
    /// What they are made of.
    pub substance: Substance,
    /// Axes 1, 2, 3 of the substance, a unit vector each, in the file's frame.
    pub axes: [[f64; 3]; 3],
}

/// A cell with what its matrices need.
#[derive(Debug)]
struct SolidCell {
    shape: Shape,
    nodes: Vec<usize>,
    places: Vec<Vector3<f64>>,
    matter: usize,
    density: f64,
    elasticity: Arc<Matrix6<f64>>,
}

impl Solid {
    pub(super) fn furnish(&self, _: usize, _: usize, _: [f64; 2], _: &mut Structure) -> Result<(), ElementError> {
        Ok(())
    }
}
