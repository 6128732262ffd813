//! Frame: straight members between nodes, each divided into beam elements.
//! Nodes inside a member follow the named ones, so that the numbers of named nodes do not depend on the division.
//! Beam elements with shear and rotary inertia: `finite::beam`.

use nalgebra::{DMatrix, DVector, SVector, Vector3};

use super::Seat;
use crate::Material;
use crate::error::{ElementError, ElementId, Field, Problem, at};
use crate::finite::beam::{self, Beam, BeamError, SectionShape};
use crate::finite::{Connectivity, Element, LumpedMass};
use crate::structure::Structure;

/// Straight beams between nodes.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Ends of the beams.
    pub nodes: Vec<FrameNode>,
    /// The beams.
    pub members: Vec<Member>,
}

/// A node of a frame.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct FrameNode {
    /// Name of the node.
    pub name: String,
    /// Place of the node (m), in the file's frame.
    pub position: [f64; 3],
}

/// A straight beam of one section.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Member {
    /// Indices of the end nodes.
    pub ends: [usize; 2],
    /// Section of the member.
    pub section: SectionShape,
    /// Direction of the `y` axis of the section, projected across the beam; none for the axis of the file's frame that is the least
    /// parallel to the beam.
    pub up: Option<[f64; 3]>,
    /// Name of the material, by which its share of the dissipation is told; it may be empty.
    #[cfg_attr(feature = "serde", serde(default))]
    pub name: String,
    /// Material of the member.
    pub material: Material,
    /// Number of elements, one or more.
    pub elements: usize,
}

/// A beam element of a member.
#[derive(Debug)]
struct BeamElement {
    connectivity: Connectivity,
    beam: Beam,
}

impl Frame {
    /// Places of the nodes: those with a name, then those inside the members, one after the other.
    pub(super) fn places(&self) -> Vec<[f64; 3]> {
        let named = self.nodes.iter().map(|node| node.position);
        let inner = self.members.iter().flat_map(|member| {
            let [a, b] = member.ends.map(|end| self.nodes[end].position);
            (1..member.elements).map(move |step| {
                let share = step as f64 / member.elements as f64;
                [0, 1, 2].map(|axis| a[axis] + share * (b[axis] - a[axis]))
            })
        });
        named.chain(inner).collect()
    }

    /// Name of a node.
    pub(super) fn node_name(&self, node: usize) -> String {
        if let Some(named) = self.nodes.get(node) {
            return named.name.clone();
        }
        let mut first = self.nodes.len();
        for member in &self.members {
            let inner = member.elements.saturating_sub(1);
            if node < first + inner {
                let [a, b] = member.ends.map(|end| &self.nodes[end].name);
                return format!("between {a} and {b}, {} of {}", node + 1 - first, member.elements);
            }
            first += inner;
        }
        format!("node {node}")
    }

    /// Adds the elements of the frame to a structure that has its nodes.
    pub(super) fn assemble_into(&self, seat: Seat, structure: &mut Structure) -> Result<(), ElementError> {
        let Seat { place, first, rayleigh } = seat;
        let places = self.places();
        let mut inner = first + self.nodes.len();
        for member in &self.members {
            member.check(place, self.nodes.len())?;
            let [start, end] = member.ends.map(|end| first + end);
            let steps = member.elements;
            let chain: Vec<usize> =
                std::iter::once(start).chain(inner..inner + steps - 1).chain([end]).collect();
            inner += steps - 1;
            let material = structure.named_material(&member.name, &member.material.rheology, rayleigh);
            for pair in chain.windows(2) {
                let nodes = [pair[0], pair[1]];
                let beam = member.beam(place, nodes.map(|node| places[node - first]))?;
                structure.elements.push(Box::new(BeamElement {
                    connectivity: Connectivity { nodes: nodes.to_vec(), dofs: 6, material },
                    beam,
                }));
            }
        }
        Ok(())
    }
}

impl Member {
    fn check(&self, place: ElementId, nodes: usize) -> Result<(), ElementError> {
        self.material.check(place)?;
        let refuse = at(place, Field::LINES);
        if self.elements == 0 {
            return Err(refuse(Problem::NotPositive { value: 0.0 }));
        }
        match self.ends.iter().find(|end| **end >= nodes) {
            Some(end) => Err(refuse(Problem::NoSuchNode { index: *end, count: nodes })),
            None => Ok(()),
        }
    }

    fn beam(&self, place: ElementId, ends: [[f64; 3]; 2]) -> Result<Beam, ElementError> {
        beam_between(place, ends, (self.section, self.up), &self.material)
    }
}

/// A beam between two places, with its section and the direction of the section's `y`.
fn beam_between(
    place: ElementId,
    ends: [[f64; 3]; 2],
    (section, up): (SectionShape, Option<[f64; 3]>),
    material: &Material,
) -> Result<Beam, ElementError> {
    let section = section.section(material.poisson);
    let section = section.map_err(|error| at(place, Field::SECTION)(error.into()))?;
    let Material { young, density, .. } = *material;
    let constants = beam::BeamMaterial { young, shear: material.shear(), density };
    Beam::new(ends, up, section, constants).map_err(|error| {
        let field = match error {
            BeamError::NoDirection { .. } => Field::UP,
            BeamError::NoLength { .. } => Field::LINES,
            _ => Field::MATERIAL,
        };
        at(place, field)(error.into())
    })
}

/// The element of a beam between two places.
pub(super) fn bar_element(
    place: ElementId,
    connectivity: Connectivity,
    ends: [[f64; 3]; 2],
    section: (SectionShape, Option<[f64; 3]>),
    material: &Material,
) -> Result<Box<dyn Element>, ElementError> {
    let beam = beam_between(place, ends, section, material)?;
    Ok(Box::new(BeamElement { connectivity, beam }))
}

impl Element for BeamElement {
    fn connectivity(&self) -> &Connectivity {
        &self.connectivity
    }

    fn stiffness(&self) -> DMatrix<f64> {
        DMatrix::from_column_slice(12, 12, self.beam.stiffness().as_slice())
    }

    fn mass(&self) -> DMatrix<f64> {
        DMatrix::from_column_slice(12, 12, self.beam.mass().as_slice())
    }

    fn lumped_masses(&self) -> Vec<LumpedMass> {
        self.beam.lumped_masses()
    }

    fn geometric(
        &self,
        displacement: &DVector<f64>,
        force: &dyn Fn(Vector3<f64>) -> Vector3<f64>,
    ) -> Option<DMatrix<f64>> {
        let u = SVector::<f64, 12>::from_column_slice(displacement.as_slice());
        let geometric = self.beam.geometric_under(&u, self.beam.load(force));
        Some(DMatrix::from_column_slice(12, 12, geometric.as_slice()))
    }
}
