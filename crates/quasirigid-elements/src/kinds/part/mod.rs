//! Parts that are elastic throughout, as a user describes them; finite elements are made of them.

mod connection;
mod constraints;
mod frame;
mod grading;
mod graph;
mod material;
mod matrices;
mod mixed;
mod modes;
mod nodal;
mod nodal_body;
mod outline;
mod panel;
mod solid;

use nalgebra::Vector3;

pub use connection::{Anchor, Connection};
pub use frame::{Frame, FrameNode, Member};
pub use grading::Grading;
pub(crate) use graph::PartGraph;
pub use material::{ElasticMaterial, Orthotropic};
pub use matrices::Matrices;
pub use mixed::{Bar, BarKind, Coupling, Mixed, NodeBody, NodeLink, Skin, Strain, Term, Weighted};
pub use modes::{GivenModes, Spectrum};
pub use nodal::NodalMass;
pub use nodal_body::TipMass;
pub use panel::{Layer, Panel};
pub use solid::{Region, Solid};

use crate::element::Element;
use crate::error::{ElementError, ElementId, ElementKind, Problem};
use crate::finite::Connectivity;
use crate::model::Rheology;
use crate::structure::{Constraint, Node, Structure};
use crate::visual::Outline;
use crate::{Assembly, Incomplete, Material};
use quasirigid_mesh::{Mesh, MeshNote};

/// A part of a body that is elastic throughout.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Unique name.
    pub name: String,
    /// Kind of the part, with its description.
    pub kind: PartKind,
    /// Rigid bodies at the nodes of the part.
    pub masses: Vec<TipMass>,
    /// Nodes that are clamped on the carrier.
    pub attached: Vec<usize>,
    /// Damping in proportion to mass (1/s) and to stiffness (s), beside that of its materials.
    pub rayleigh: [f64; 2],
}

/// Kind of a part.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq)]
pub enum PartKind {
    /// A solid of cells.
    Solid(Solid),
    /// Straight beams between nodes.
    Frame(Frame),
    /// A thin plate or shell.
    Panel(Panel),
    /// Solids, shells, bars, bodies, links and couplings between common nodes.
    Mixed(Mixed),
    /// Matrices from another program.
    Matrices(Matrices),
    /// Modes from another program.
    Modes(GivenModes),
}

/// Seat of a part in a structure: its identity, its first node, and its damping.
#[derive(Clone, Copy)]
struct Seat {
    place: ElementId,
    first: usize,
    rayleigh: [f64; 2],
}

impl Seat {
    /// Connectivity of a cell between nodes of the part.
    fn connectivity(&self, nodes: &[usize], dofs: usize, material: usize) -> Connectivity {
        let nodes = nodes.iter().map(|node| self.first + node).collect();
        Connectivity { nodes, dofs, material }
    }
}

impl PartKind {
    /// Words for a part of this kind.
    #[must_use]
    pub fn words(&self) -> &'static str {
        match self {
            Self::Solid(_) => "solid",
            Self::Frame(_) => "beam",
            Self::Panel(_) => "panel",
            Self::Mixed(_) => "deck",
            Self::Matrices(_) => "matrices",
            Self::Modes(_) => "modes",
        }
    }

    /// Rheologies of the part, one for each region, member or layer.
    pub(crate) fn rheologies_mut(&mut self) -> Vec<&mut Rheology> {
        match self {
            Self::Frame(frame) => {
                frame.members.iter_mut().map(|member| &mut member.material.rheology).collect()
            }
            Self::Panel(panel) => {
                panel.layers.iter_mut().map(|layer| layer.material.rheology_mut()).collect()
            }
            Self::Solid(solid) => {
                solid.regions.iter_mut().map(|region| region.material.rheology_mut()).collect()
            }
            Self::Mixed(mixed) => mixed.rheologies_mut(),
            Self::Matrices(given) => vec![&mut given.rheology],
            Self::Modes(modes) => vec![&mut modes.rheology],
        }
    }
}

impl Part {
    /// Nodes of the part, in order.
    pub(crate) fn nodes(&self) -> Vec<Node> {
        match &self.kind {
            PartKind::Solid(solid) => solid.mesh.nodes.iter().map(|place| node(*place, false)).collect(),
            PartKind::Panel(panel) => panel.mesh.nodes.iter().map(|place| node(*place, true)).collect(),
            PartKind::Frame(frame) => frame.places().into_iter().map(|place| node(place, true)).collect(),
            PartKind::Mixed(mixed) => mixed.structure_nodes(),
            PartKind::Matrices(given) => given.mass.structure_nodes().collect(),
            PartKind::Modes(modes) => modes.structure_nodes(),
        }
    }

    /// Number of the part's nodes that are places.
    pub(crate) fn count(&self) -> usize {
        match &self.kind {
            PartKind::Solid(Solid { mesh, .. })
            | PartKind::Panel(Panel { mesh, .. })
            | PartKind::Mixed(Mixed { mesh, .. }) => mesh.nodes.len(),
            PartKind::Frame(frame) => frame.places().len(),
            PartKind::Matrices(Matrices { mass, .. }) | PartKind::Modes(GivenModes { mass, .. }) => {
                mass.nodes.len()
            }
        }
    }

    /// Name of a node within the part.
    pub(crate) fn node_name(&self, node: usize) -> String {
        match &self.kind {
            PartKind::Solid(Solid { mesh, .. })
            | PartKind::Panel(Panel { mesh, .. })
            | PartKind::Mixed(Mixed { mesh, .. }) => {
                format!("node {}", mesh.node_labels[node])
            }
            PartKind::Frame(frame) => frame.node_name(node),
            PartKind::Matrices(Matrices { mass, .. }) | PartKind::Modes(GivenModes { mass, .. }) => {
                format!("node {}", mass.node_labels[node])
            }
        }
    }

    /// Nodes whose displacement is watched: those with a name, else the farthest along each axis, both ways.
    pub(crate) fn watched(&self) -> Vec<usize> {
        match &self.kind {
            PartKind::Frame(frame) => (0..frame.nodes.len()).collect(),
            PartKind::Matrices(Matrices { mass, .. }) | PartKind::Modes(GivenModes { mass, .. }) => {
                extremes(&mass.nodes)
            }
            PartKind::Solid(Solid { mesh, .. })
            | PartKind::Panel(Panel { mesh, .. })
            | PartKind::Mixed(Mixed { mesh, .. }) => extremes(&mesh.nodes),
        }
    }

    /// Whether the part carries a frame of its own, rigid in the body.
    pub(crate) fn is_frame(&self) -> bool {
        matches!(&self.kind, PartKind::Modes(modes) if modes.interface.is_empty())
    }

    /// Whether the part needs no attachment to a carrier: the program that it comes from constrained it.
    pub(crate) fn stands(&self) -> bool {
        match &self.kind {
            PartKind::Matrices(given) => given.held().is_some() || given.stands(),
            _ => self.is_frame(),
        }
    }

    /// Adds the elements of the part to a structure that has its nodes, the first of them at `first`.
    ///
    /// # Errors
    /// [`ElementError`] for a value that no part can have.
    pub(crate) fn assemble_into(
        &self,
        index: usize,
        first: usize,
        structure: &mut Structure,
    ) -> Result<(), ElementError> {
        let seat = Seat { place: ElementKind::Part.at(index), first, rayleigh: self.rayleigh };
        match &self.kind {
            PartKind::Solid(solid) => solid.assemble_into(seat, structure),
            PartKind::Frame(frame) => frame.assemble_into(seat, structure),
            PartKind::Panel(panel) => panel.assemble_into(seat, structure),
            PartKind::Mixed(mixed) => mixed.assemble_into(seat, structure),
            PartKind::Matrices(given) => given.assemble_into(seat, structure),
            PartKind::Modes(modes) => modes.assemble_into(seat, structure),
        }?;
        let name = |node| move || format!("{:?} {}", self.name, self.node_name(node));
        let add = |mass: &TipMass| mass.assemble_into(seat, self.count(), name(mass.node), structure);
        self.masses.iter().try_for_each(add)
    }

    /// Constraints of the part's nodes before anything is attached or connected; the first of them is `first` in the structure.
    pub(crate) fn constraints(&self, first: usize) -> Vec<Constraint> {
        match &self.kind {
            PartKind::Mixed(mixed) => mixed.constraints(first),
            PartKind::Matrices(given) => given.constraints(),
            PartKind::Modes(modes) => modes.constraints(first),
            _ => vec![Constraint::Free; self.count()],
        }
    }

    /// Number of a node that the matrices of the part constrain to the carrier.
    pub(crate) fn held(&self) -> Option<u64> {
        match &self.kind {
            PartKind::Matrices(given) => given.held(),
            _ => None,
        }
    }
}

fn node(place: [f64; 3], rotations: bool) -> Node {
    Node { place: Vector3::from(place), rotations }
}

/// Accepts a mesh whose cells of a dimension describe a part and hold every node of it; the other cells bear nothing.
fn sound(mesh: &Mesh, dimension: usize) -> Result<(), Problem> {
    let bearing = mesh.cells.iter().filter(|cell| cell.shape.dimension() == dimension);
    let bearing = Mesh { cells: bearing.cloned().collect(), sets: Vec::new(), ..mesh.clone() };
    if bearing.cells.is_empty() {
        return Err(Problem::NoCells { dimension });
    }
    bearing.check().map_err(Problem::Mesh)?;
    let loose = |note: &MeshNote| matches!(note, MeshNote::Unused { .. } | MeshNote::Coincident { .. });
    bearing.notes().into_iter().find(loose).map_or(Ok(()), |note| Err(note.into()))
}

/// The nodes farthest along each axis, each once.
pub(crate) fn extremes(nodes: &[[f64; 3]]) -> Vec<usize> {
    let farthest = |axis: usize, sign: f64| {
        let along = |node: &usize| sign * nodes[*node][axis];
        (0..nodes.len()).max_by(|a, b| along(a).total_cmp(&along(b)))
    };
    let ends = (0..3).flat_map(|axis| [farthest(axis, 1.0), farthest(axis, -1.0)]);
    let mut found: Vec<usize> = ends.flatten().collect();
    found.sort_unstable();
    found.dedup();
    found
}

impl Element for Part {
    fn words(&self) -> Option<&'static str> {
        Some(self.kind.words())
    }

    fn outline(&self, id: ElementId, _: &Assembly) -> Option<Outline> {
        Some(self.drawn(id.index))
    }

    fn homogeneous(&self) -> Option<&Material> {
        let PartKind::Solid(solid) = &self.kind else { return None };
        let [region] = &solid.regions[..] else { return None };
        match &region.material {
            ElasticMaterial::Isotropic(material) if self.masses.is_empty() && region.grading.is_none() => {
                Some(material)
            }
            _ => None,
        }
    }

    fn incomplete(&self) -> Vec<Incomplete> {
        match &self.kind {
            PartKind::Matrices(_) | PartKind::Modes(_) => vec![Incomplete::Shapes],
            PartKind::Solid(_) | PartKind::Frame(_) | PartKind::Panel(_) | PartKind::Mixed(_) => {
                vec![Incomplete::Structures]
            }
        }
    }

    fn rheologies_mut(&mut self) -> Vec<&mut Rheology> {
        self.kind.rheologies_mut()
    }
}
