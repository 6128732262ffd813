use std::sync::Arc;

use nalgebra::{DMatrix, DVector, Matrix3, Matrix6, Vector3};

use super::{Substance, sound};
use crate::elements::error::{ElementError, ElementKind, Field, Problem, at};
use crate::finite::{Element, Grain, elasticity, solid};
use crate::structure::Structure;
use quasirigid_mesh::{Mesh, Shape};

/// A solid of cells: tetrahedra, wedges and hexahedra.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Solid {
    /// Nodes and cells; faces and lines among the cells bear nothing.
    pub mesh: Arc<Mesh>,
    /// What its cells are made of; each solid cell is in one region.
    pub regions: Vec<Region>,
}

/// Cells of one substance.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// Indices of the cells; those that are not solid are passed over.
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
    /// Adds its elements to a structure that has its nodes.
    pub(super) fn furnish(
        &self,
        index: usize,
        first: usize,
        rayleigh: [f64; 2],
        structure: &mut Structure,
    ) -> Result<(), ElementError> {
        let place = ElementKind::Part.at(index);
        sound(&self.mesh, 3).map_err(at(place, Field::FILE))?;
        for region in &self.regions {
            region.substance.check(place)?;
            let elasticity = Arc::new(region.elasticity().map_err(at(place, Field::MATERIAL))?);
            let matter = structure.matter(region.substance.rheology(), rayleigh);
            let count = self.mesh.cells.len();
            if let Some(index) = region.cells.iter().copied().find(|cell| *cell >= count) {
                return Err(at(place, Field::MATERIAL)(Problem::NoSuchCell { index, count }));
            }
            let cells = region.cells.iter().map(|cell| &self.mesh.cells[*cell]);
            for cell in cells.filter(|cell| cell.shape.dimension() == 3) {
                structure.elements.push(Box::new(SolidCell {
                    shape: cell.shape,
                    nodes: cell.nodes.iter().map(|node| first + node).collect(),
                    places: cell.nodes.iter().map(|node| self.mesh.nodes[*node].into()).collect(),
                    matter,
                    density: region.substance.density(),
                    elasticity: Arc::clone(&elasticity),
                }));
            }
        }
        Ok(())
    }
}

impl Region {
    fn elasticity(&self) -> Result<Matrix6<f64>, Problem> {
        let elasticity = match &self.substance {
            Substance::Isotropic(material) => elasticity::isotropic(material.young, material.poisson),
            Substance::Orthotropic(material) => {
                let [young, poisson, shear] = [material.young, material.poisson, material.shear];
                let columns = self.axes.map(Vector3::from);
                let constants = elasticity::Orthotropic { young, poisson, shear };
                elasticity::orthotropic(&constants, &Matrix3::from_columns(&columns))
            }
        };
        Ok(elasticity?)
    }
}

impl Element for SolidCell {
    fn nodes(&self) -> &[usize] {
        &self.nodes
    }

    fn freedoms(&self) -> usize {
        3
    }

    fn matter(&self) -> usize {
        self.matter
    }

    fn stiffness(&self) -> DMatrix<f64> {
        solid::stiffness(self.shape, &self.places, &self.elasticity)
    }

    fn mass(&self) -> DMatrix<f64> {
        solid::mass(self.shape, &self.places, self.density).kronecker(&Matrix3::identity())
    }

    fn grains(&self) -> Vec<Grain> {
        solid::grains(self.shape, &self.places, self.density)
    }

    fn geometric(
        &self,
        displacement: &DVector<f64>,
        _: &dyn Fn(Vector3<f64>) -> Vector3<f64>,
    ) -> Option<DMatrix<f64>> {
        let scalar = solid::geometric(self.shape, &self.places, &self.elasticity, displacement);
        Some(scalar.kronecker(&Matrix3::identity()))
    }
}
