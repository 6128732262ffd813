//! Part of given modes: shapes of another program over the nodes of its model, as generalised coordinates.
//! The nodes keep their mass, so inertia and loads follow from the shapes; stiffness and damping come from the spectrum alone.
//! Equations (K10) and (K11), docs/theory/12-structures.md; interface modes of Craig and Bampton `[@craig1968]`.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector, Matrix6};

use super::Seat;
use super::nodal::{NodalMass, symmetric, times};
use crate::error::{ElementError, ElementId, ElementKind, Field, Problem, at};
use crate::finite::{Block, Connectivity};
use crate::model::Rheology;
use crate::number;
use crate::structure::{Constraint, Node, Structure};

/// Shapes of generalised coordinates over the nodes of another program's model: its modes of vibration, or those of Craig and
/// Bampton. (K10)
///
/// Without an interface the nodes move as seen from the carrier, or, in a body that has none, from a frame of their own.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct GivenModes {
    /// Nodes of the model and their mass.
    pub mass: NodalMass,
    /// Shapes: motion of each row of the mass matrix per unit of each coordinate (columns): m/m, rad/m for displacements of the interface,
    /// m/rad, rad/rad for rotations of it, m and rad for the others.
    pub shapes: Vec<Vec<f64>>,
    /// Nodes whose displacements and rotations are the first coordinates, node by node.
    pub interface: Vec<usize>,
    /// Stiffness and damping of the coordinates.
    pub spectrum: Spectrum,
    /// Rheology of this stiffness: response to periodic strain.
    pub rheology: Rheology,
}

/// Stiffness and damping of generalised coordinates.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub enum Spectrum {
    /// Modes of vibration.
    Modes {
        /// Natural frequency of each (rad/s).
        frequencies: Vec<f64>,
        /// Damping of each as a share of the critical one.
        damping_ratios: Vec<f64>,
    },
    /// Matrices between the coordinates: rows, columns and entries, both triangles.
    Matrices {
        /// Stiffness.
        stiffness: Vec<(usize, usize, f64)>,
        /// Damping.
        damping: Vec<(usize, usize, f64)>,
    },
}

/// Deviation from a unit displacement up to which a shape of the interface is one.
const UNIT: f64 = 1e-6;
/// Coupling of two modes by the mass, as a share of their own masses, up to which they count as modes of this mass.
const COUPLED: f64 = 0.1;

impl GivenModes {
    /// Bound on the response to a spin about a pole that modes beyond the last can add, as a share of the largest response in energy; none
    /// for coordinates that are no modes, or no part of a body. (K11)
    #[must_use]
    pub fn missing(&self, pole: [f64; 3]) -> Option<f64> {
        let Spectrum::Modes { frequencies, .. } = &self.spectrum else { return None };
        let blocks = self.mass.blocks(ElementKind::Part.at(0), [(Field::MASS, &self.mass.entries)]).ok()?;
        let lumps = self.mass.lumps(blocks.iter().map(|(pair, [mass])| (*pair, mass))).ok()?;
        let masses = modal_masses(&self.couplings()).ok()?;
        let highest = frequencies.iter().copied().fold(0.0, f64::max);
        let (mut rest, mut largest) = (0.0_f64, 0.0_f64);
        for (a, b) in (0..9).map(|load| (load % 3, load / 3)) {
            let (mut whole, mut forces) = (0.0, DVector::<f64>::zeros(masses.len()));
            let rows = self.mass.dofs.iter().zip(&self.shapes);
            for ((node, _), row) in rows.filter(|((_, component), _)| *component == a) {
                if row.iter().all(|share| *share == 0.0) {
                    continue;
                }
                let (mass, s) = (lumps[*node].mass, self.mass.nodes[*node][b] - pole[b]);
                whole += mass * s * s;
                row.iter().zip(forces.iter_mut()).for_each(|(share, force)| *force += mass * s * share);
            }
            let held: f64 = (0..masses.len()).map(|j| forces[j] * forces[j] / masses[j]).sum();
            let answer = |j: usize| (forces[j] / frequencies[j]).powi(2) / masses[j];
            rest = rest.max((whole - held) / highest.powi(2));
            largest = largest.max((0..masses.len()).map(answer).sum());
        }
        Some(rest / largest)
    }

    /// Nodes of the model, and extra ones that hold the coordinates beyond the interface as components.
    pub(super) fn structure_nodes(&self) -> Vec<Node> {
        let mut nodes: Vec<Node> = self.mass.structure_nodes().collect();
        let keeper = nodes.first().copied();
        nodes.extend(keeper.into_iter().flat_map(|keeper| std::iter::repeat_n(keeper, self.keepers())));
        nodes
    }

    /// Constraints of the nodes, the first of them being `first` in the structure.
    pub(super) fn constraints(&self, first: usize) -> Vec<Constraint> {
        let columns: Arc<[(usize, usize)]> =
            self.columns().into_iter().map(|(node, component)| (first + node, component)).collect();
        let per_node = self.mass.per_node();
        let mut shares = vec![DMatrix::zeros(per_node, columns.len()); self.mass.nodes.len()];
        for ((node, component), row) in self.mass.dofs.iter().zip(&self.shapes) {
            for (entry, share) in shares[*node].row_mut(*component).iter_mut().zip(row) {
                *entry = *share;
            }
        }
        let moves = self.mass.moves();
        let constrain = |(node, shares)| {
            if self.interface.contains(&node) {
                Constraint::Partly(moves[node])
            } else {
                Constraint::Shaped { columns: columns.clone(), shares }
            }
        };
        let kept = self.size().saturating_sub(self.interface_columns().len());
        let keeper = |number: usize| Constraint::Coordinates((kept - number * per_node).min(per_node));
        shares.into_iter().enumerate().map(constrain).chain((0..self.keepers()).map(keeper)).collect()
    }

    /// Name of a generalised coordinate that a node holds as a component.
    pub(crate) fn coordinate_name(&self, node: usize, component: usize) -> String {
        let before = (node - self.mass.nodes.len()) * self.mass.per_node();
        format!("coordinate {}", self.interface_columns().len() + before + component + 1)
    }

    /// Adds the elements of the modes to a structure that has their nodes.
    pub(super) fn assemble_into(&self, seat: Seat, structure: &mut Structure) -> Result<(), ElementError> {
        let Seat { place, first, rayleigh } = seat;
        self.rheology.check().map_err(|error| at(place, Field::RHEOLOGY)(error.into()))?;
        self.check_shapes().map_err(at(place, Field::SHAPES))?;
        let blocks = self.mass.blocks(place, [(Field::MASS, self.mass.entries.as_slice())])?;
        let resistance = self.spectrum.matrices(self.size(), place, || self.couplings())?;
        let material = structure.material(&self.rheology, rayleigh);
        structure.elements.push(Box::new(self.resistance(first, material, &resistance)));
        let lumps = self.mass.lumps(blocks.iter().map(|(pair, [mass])| (*pair, mass)));
        let lumps = lumps.map_err(at(place, Field::MASS))?;
        for (pair, [mass]) in &blocks {
            let inertia = [*mass, Matrix6::zeros(), Matrix6::zeros()];
            structure.elements.push(Box::new(self.mass.element(*pair, first, material, &inertia, &lumps)));
        }
        Ok(())
    }

    /// Number of coordinates.
    fn size(&self) -> usize {
        self.shapes.first().map_or(0, Vec::len)
    }

    /// Number of nodes that hold the coordinates beyond the interface.
    fn keepers(&self) -> usize {
        self.size().saturating_sub(self.interface_columns().len()).div_ceil(self.mass.per_node())
    }

    /// Node and component of the coordinates of the interface.
    fn interface_columns(&self) -> Vec<(usize, usize)> {
        self.mass.rows_of(&self.interface)
    }

    /// Node and component that hold each coordinate.
    fn columns(&self) -> Vec<(usize, usize)> {
        let (nodes, per_node) = (self.mass.nodes.len(), self.mass.per_node());
        let mut columns = self.interface_columns();
        let kept = self.size().saturating_sub(columns.len());
        columns.extend((0..kept).map(|number| (nodes + number / per_node, number % per_node)));
        columns
    }

    /// Accepts shapes of the right size that are finite and, at the interface, unit displacements.
    fn check_shapes(&self) -> Result<(), Problem> {
        let (size, rows) = (self.size(), self.mass.dofs.len());
        let interface = self.interface_columns();
        if self.shapes.len() != rows || self.shapes.iter().any(|row| row.len() != size) {
            return Err(Problem::ShapeRows { rows: self.shapes.len(), dofs: rows });
        }
        if size == 0 || size < interface.len() {
            return Err(Problem::ShapeColumns { columns: size, interface: interface.len() });
        }
        for ((node, component), row) in self.mass.dofs.iter().zip(&self.shapes) {
            number::finite(row)?;
            if !self.interface.contains(node) {
                continue;
            }
            let one = interface.iter().position(|column| column == &(*node, *component));
            let wrong = |(column, share): &(usize, &f64)| {
                !((**share - f64::from(u8::from(one == Some(*column)))).abs() < UNIT)
            };
            if let Some((column, share)) = row.iter().enumerate().find(wrong) {
                let node = self.mass.node_labels[*node];
                return Err(Problem::NotUnit { node, component: *component, column, share: *share });
            }
        }
        Ok(())
    }

    /// The mass matrix between the coordinates.
    fn couplings(&self) -> DMatrix<f64> {
        let shapes = DMatrix::from_fn(self.shapes.len(), self.size(), |row, column| self.shapes[row][column]);
        shapes.tr_mul(&times(&self.mass.entries, &shapes))
    }

    /// Stiffness and damping between the coordinates as an element.
    fn resistance(&self, first: usize, material: usize, [stiffness, damping]: &[DMatrix<f64>; 2]) -> Block {
        let (dofs, columns) = (self.mass.per_node(), self.columns());
        let mut nodes: Vec<usize> = columns.iter().map(|(node, _)| *node).collect();
        nodes.dedup();
        let place = |(node, component): &(usize, usize)| {
            let number = nodes.iter().position(|known| known == node).unwrap_or_default();
            dofs * number + component
        };
        let places: Vec<usize> = columns.iter().map(place).collect();
        let size = nodes.len() * dofs;
        let spread = |matrix: &DMatrix<f64>| {
            let mut spread = DMatrix::zeros(size, size);
            for (j, row) in places.iter().enumerate() {
                for (k, column) in places.iter().enumerate() {
                    spread[(*row, *column)] = matrix[(j, k)];
                }
            }
            spread
        };
        let nodes = nodes.into_iter().map(|node| first + node).collect();
        Block {
            connectivity: Connectivity { nodes, dofs, material },
            stiffness: spread(stiffness),
            damping: spread(damping),
            mass: DMatrix::zeros(size, size),
            lumped_masses: Vec::new(),
        }
    }
}

impl Spectrum {
    /// Stiffness and damping between so many coordinates.
    fn matrices(
        &self,
        size: usize,
        place: ElementId,
        couplings: impl Fn() -> DMatrix<f64>,
    ) -> Result<[DMatrix<f64>; 2], ElementError> {
        match self {
            Self::Matrices { stiffness, damping } => {
                let dense = |field: Field, entries: &[(usize, usize, f64)]| {
                    symmetric(entries, size, |row| format!("coordinate {}", row + 1))
                        .map_err(at(place, field))?;
                    let mut dense = DMatrix::zeros(size, size);
                    entries.iter().for_each(|(row, column, value)| dense[(*row, *column)] += value);
                    Ok(dense)
                };
                Ok([dense(Field::STIFFNESS, stiffness)?, dense(Field::DAMPING, damping)?])
            }
            Self::Modes { frequencies, damping_ratios } => {
                let value = |field: Field, values: &[f64], check: fn(f64) -> Result<(), Problem>| {
                    if values.len() != size {
                        return Err(at(place, field)(Problem::ValuePerMode {
                            modes: size,
                            values: values.len(),
                        }));
                    }
                    values.iter().try_for_each(|value| check(*value)).map_err(at(place, field))
                };
                value(Field::FREQUENCIES, frequencies, number::positive)?;
                value(Field::DAMPING_RATIOS, damping_ratios, number::non_negative)?;
                let masses = modal_masses(&couplings()).map_err(at(place, Field::SHAPES))?;
                let diagonal = |of: &dyn Fn(usize) -> f64| {
                    DMatrix::from_diagonal(&DVector::from_fn(size, |j, _| masses[j] * of(j)))
                };
                Ok([
                    diagonal(&|j| frequencies[j] * frequencies[j]),
                    diagonal(&|j| 2.0 * damping_ratios[j] * frequencies[j]),
                ])
            }
        }
    }
}

/// Mass of each mode, of shapes that the mass does not couple.
fn modal_masses(couplings: &DMatrix<f64>) -> Result<DVector<f64>, Problem> {
    let masses = couplings.diagonal();
    if let Some(mode) = masses.iter().position(|mass| !(*mass > 0.0)) {
        return Err(Problem::EmptyMode { mode });
    }
    for k in 0..masses.len() {
        for j in 0..k {
            let share = couplings[(j, k)].abs() / (masses[j] * masses[k]).sqrt();
            if !(share < COUPLED) {
                return Err(Problem::CoupledModes { modes: [j, k], share });
            }
        }
    }
    Ok(masses)
}
