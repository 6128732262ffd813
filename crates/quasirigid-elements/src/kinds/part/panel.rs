//! Panel: a thin plate or shell of layered cells.
//! Layers of the same material are summed to one section, and a cell has an element for each, so that every material keeps its own loss.
//! Shell elements: `finite::shell`.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector, Vector3};

use super::{ElasticMaterial, Seat, sound};
use crate::error::{ElementError, ElementId, Field, Problem, at};
use crate::finite::shell::{self, Ply, ShellError, ShellSection};
use crate::finite::{Connectivity, Element, LumpedMass};
use crate::number;
use crate::structure::Structure;
use quasirigid_mesh::{Cell, Mesh, Shape};

/// A thin plate or shell.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// Nodes and cells: triangles and quadrilaterals without nodes on their edges.
    pub mesh: Arc<Mesh>,
    /// Layers from the lowest to the highest; the nodes of a cell run counter-clockwise seen from above.
    pub layers: Vec<Layer>,
    /// Direction whose projection is the angle zero of the layers, in the file's frame.
    pub reference: [f64; 3],
    /// Height of the middle of the layers above the nodes (m).
    pub offset: f64,
}

/// A layer of a panel.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    /// Name of the material, by which its share of the dissipation is told; it may be empty.
    #[cfg_attr(feature = "serde", serde(default))]
    pub name: String,
    /// Material of the layer; its axis 3 is the normal.
    pub material: ElasticMaterial,
    /// Thickness (m).
    pub thickness: f64,
    /// Angle (rad) from the reference direction to its axis 1, counter-clockwise seen from above.
    pub angle: f64,
}

/// Cell with the layers of one material.
#[derive(Debug)]
struct ShellCell {
    shape: Shape,
    connectivity: Connectivity,
    places: Vec<Vector3<f64>>,
    reference: Vector3<f64>,
    section: ShellSection,
}

impl Panel {
    /// Adds the elements of the panel to a structure that has its nodes: for each cell one of every material in its layers.
    pub(super) fn assemble_into(&self, seat: Seat, structure: &mut Structure) -> Result<(), ElementError> {
        let Seat { place, .. } = seat;
        sound(&self.mesh, 2).map_err(at(place, Field::FILE))?;
        number::unit(self.reference).map_err(at(place, Field::REFERENCE))?;
        self.layers.iter().try_for_each(|layer| layer.material.check(place))?;
        let plating = Plating { layers: &self.layers, reference: Some(self.reference), offset: self.offset };
        let cells = self.mesh.cells.iter().filter(|cell| cell.shape.dimension() == 2);
        plating.assemble_into(&self.mesh, cells, seat, structure)
    }
}

/// Layers of shell cells, and the direction from which their angles count.
pub(super) struct Plating<'p> {
    /// Layers from the lowest to the highest.
    pub(super) layers: &'p [Layer],
    /// Direction of the angle zero; none for the first side of each cell.
    pub(super) reference: Option<[f64; 3]>,
    /// Height of the middle of the layers above the nodes (m).
    pub(super) offset: f64,
}

impl Plating<'_> {
    /// Adds cells to a structure that has the nodes of the mesh: for each cell an element of every material in its layers.
    pub(super) fn assemble_into<'c>(
        &self,
        mesh: &Mesh,
        cells: impl Iterator<Item = &'c Cell>,
        seat: Seat,
        structure: &mut Structure,
    ) -> Result<(), ElementError> {
        let Seat { place, rayleigh, .. } = seat;
        self.layers.iter().try_for_each(|layer| layer.material.check_constants(place))?;
        let sections = self.sections(place, rayleigh, structure)?;
        for cell in cells {
            for (material, section) in &sections {
                let element = self.cell(mesh, cell, seat.connectivity(&cell.nodes, 6, *material), *section);
                element.matrix().map_err(|cause| {
                    let field = match cause {
                        ShellError::Reference { .. } => Field::REFERENCE,
                        _ => Field::FILE,
                    };
                    at(place, field)(Problem::Shell { cell: Some(cell.label), cause })
                })?;
                structure.elements.push(Box::new(element));
            }
        }
        Ok(())
    }

    /// Section of the layers of each material.
    fn sections(
        &self,
        place: ElementId,
        rayleigh: [f64; 2],
        structure: &mut Structure,
    ) -> Result<Vec<(usize, ShellSection)>, ElementError> {
        let refuse = at(place, Field::LAYERS);
        let plies: Vec<Ply> = self.layers.iter().map(Layer::ply).collect();
        let layers = ShellSection::layers(&plies, self.offset)
            .map_err(|cause| refuse(Problem::Shell { cell: None, cause }))?;
        let mut sections: Vec<(usize, ShellSection)> = Vec::new();
        for (layer, section) in self.layers.iter().zip(layers) {
            let material = structure.named_material(&layer.name, layer.material.rheology(), rayleigh);
            match sections.iter_mut().find(|(known, _)| *known == material) {
                Some((_, sum)) => *sum = *sum + section,
                None => sections.push((material, section)),
            }
        }
        if sections.is_empty() { Err(refuse(Problem::NoMass)) } else { Ok(sections) }
    }

    fn cell(&self, mesh: &Mesh, cell: &Cell, connectivity: Connectivity, section: ShellSection) -> ShellCell {
        let places: Vec<Vector3<f64>> = cell.nodes.iter().map(|node| mesh.nodes[*node].into()).collect();
        let reference = self.reference.map_or_else(|| places[1] - places[0], Vector3::from);
        ShellCell { shape: cell.shape, connectivity, places, reference, section }
    }
}

impl Layer {
    fn ply(&self) -> Ply {
        let (thickness, angle) = (self.thickness, self.angle);
        match &self.material {
            ElasticMaterial::Isotropic(material) => Ply {
                young: [material.young; 2],
                poisson: material.poisson,
                shear: [material.shear(); 3],
                density: material.density,
                thickness,
                angle,
            },
            ElasticMaterial::Orthotropic(material) => Ply {
                young: [material.young[0], material.young[1]],
                poisson: material.poisson[0],
                shear: material.shear,
                density: material.density,
                thickness,
                angle,
            },
        }
    }
}

impl ShellCell {
    fn matrix(&self) -> Result<DMatrix<f64>, ShellError> {
        shell::stiffness(self.shape, &self.places, self.reference, &self.section)
    }
}

impl Element for ShellCell {
    fn connectivity(&self) -> &Connectivity {
        &self.connectivity
    }

    fn stiffness(&self) -> DMatrix<f64> {
        self.matrix().expect("the panel has tried the cell")
    }

    fn mass(&self) -> DMatrix<f64> {
        shell::mass(self.shape, &self.places, &self.section).expect("the panel has tried the cell")
    }

    fn lumped_masses(&self) -> Vec<LumpedMass> {
        shell::lumped_masses(self.shape, &self.places, &self.section)
    }

    fn geometric(
        &self,
        displacement: &DVector<f64>,
        _: &dyn Fn(Vector3<f64>) -> Vector3<f64>,
    ) -> Option<DMatrix<f64>> {
        shell::geometric(self.shape, &self.places, self.reference, &self.section, displacement).ok()
    }
}
