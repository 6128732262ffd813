//! Solid part: tetrahedra, wedges and hexahedra in regions of one material each.
//! Every solid cell belongs to exactly one region; the axes of an orthotropic material belong to the region, not to the cell.
//! Solid elements: `finite::solid`.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector, Matrix3, Matrix6, Vector3};

use super::{ElasticMaterial, Grading, Seat, sound};
use crate::error::{ElementError, Field, Problem, at};
use crate::finite::{Connectivity, Element, LumpedMass, elasticity, solid};
use crate::structure::Structure;
use quasirigid_mesh::{Mesh, Shape};

/// A solid of cells: tetrahedra, wedges and hexahedra.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Solid {
    /// Nodes and cells; faces and lines among the cells bear nothing.
    pub mesh: Arc<Mesh>,
    /// Regions of one material; each solid cell is in one of them.
    pub regions: Vec<Region>,
}

/// Cells of one material.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// Indices of the cells; cells of other dimensions are skipped.
    pub cells: Vec<usize>,
    /// Name of the material, by which its share of the dissipation is told; it may be empty.
    #[cfg_attr(feature = "serde", serde(default))]
    pub name: String,
    /// Material of the cells.
    pub material: ElasticMaterial,
    /// Axes 1, 2, 3 of the material, a unit vector each, in the file's frame.
    pub axes: [[f64; 3]; 3],
    /// Densities of the cells, where they differ; none where each cell has that of the material.
    #[cfg_attr(feature = "serde", serde(default))]
    pub grading: Option<Grading>,
}

/// Solid cell with the data of its matrices.
#[derive(Debug)]
struct SolidCell {
    shape: Shape,
    connectivity: Connectivity,
    places: Vec<Vector3<f64>>,
    density: f64,
    elasticity: Arc<Matrix6<f64>>,
    /// Moduli relative to those of the elasticity.
    factor: f64,
}

impl Solid {
    /// Adds the elements of the solid to a structure that has its nodes.
    pub(super) fn assemble_into(&self, seat: Seat, structure: &mut Structure) -> Result<(), ElementError> {
        let Seat { place, .. } = seat;
        sound(&self.mesh, 3).map_err(at(place, Field::FILE))?;
        for region in &self.regions {
            region.material.check(place)?;
            let count = self.mesh.cells.len();
            if let Some(index) = region.cells.iter().copied().find(|cell| *cell >= count) {
                return Err(at(place, Field::MATERIAL)(Problem::NoSuchCell { index, count }));
            }
            region.assemble_into(&self.mesh, seat, structure)?;
        }
        Ok(())
    }
}

impl Region {
    /// Adds the cells of the region, which exist, to a structure that has the nodes of the mesh.
    pub(super) fn assemble_into(
        &self,
        mesh: &Mesh,
        seat: Seat,
        structure: &mut Structure,
    ) -> Result<(), ElementError> {
        let reference = self.material.density();
        if let Some(grading) = &self.grading {
            grading.check(self.cells.len(), reference).map_err(at(seat.place, Field::MATERIAL))?;
        }
        let elasticity = Arc::new(self.elasticity().map_err(at(seat.place, Field::MATERIAL))?);
        let material = structure.named_material(&self.name, self.material.rheology(), seat.rayleigh);
        for (number, cell) in self.cells.iter().map(|cell| &mesh.cells[*cell]).enumerate() {
            if cell.shape.dimension() != 3 {
                continue;
            }
            let (density, factor) = self.grading.as_ref().map_or((reference, 1.0), |grading| {
                (grading.densities[number], grading.factor(grading.densities[number], reference))
            });
            structure.elements.push(Box::new(SolidCell {
                shape: cell.shape,
                connectivity: seat.connectivity(&cell.nodes, 3, material),
                places: cell.nodes.iter().map(|node| mesh.nodes[*node].into()).collect(),
                density,
                elasticity: Arc::clone(&elasticity),
                factor,
            }));
        }
        Ok(())
    }

    fn elasticity(&self) -> Result<Matrix6<f64>, Problem> {
        let elasticity = match &self.material {
            ElasticMaterial::Isotropic(material) => elasticity::isotropic(material.young, material.poisson),
            ElasticMaterial::Orthotropic(material) => {
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
    fn connectivity(&self) -> &Connectivity {
        &self.connectivity
    }

    fn stiffness(&self) -> DMatrix<f64> {
        self.factor * solid::stiffness(self.shape, &self.places, &self.elasticity)
    }

    fn mass(&self) -> DMatrix<f64> {
        solid::mass(self.shape, &self.places, self.density).kronecker(&Matrix3::identity())
    }

    fn lumped_masses(&self) -> Vec<LumpedMass> {
        solid::lumped_masses(self.shape, &self.places, self.density)
    }

    fn geometric(
        &self,
        displacement: &DVector<f64>,
        _: &dyn Fn(Vector3<f64>) -> Vector3<f64>,
    ) -> Option<DMatrix<f64>> {
        let scalar = solid::geometric(self.shape, &self.places, &self.elasticity, displacement);
        Some(self.factor * scalar.kronecker(&Matrix3::identity()))
    }
}
