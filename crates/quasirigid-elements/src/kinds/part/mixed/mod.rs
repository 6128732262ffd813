//! Mixed part: solids, shells, bars, bodies, links and couplings between common nodes, as decks of other programs have them.
//! A node has rotations where something turns it; a rotation that only its partner in a link has is held, for nothing acts on it.
//! Equations (K1), (K2) and (I11), docs/theory.

mod mean;
mod rod;

use std::collections::HashSet;
use std::sync::Arc;

use nalgebra::{DMatrix, Vector3};

use mean::mean;
use rod::Rod;

use super::frame::bar_element;
use super::panel::Plating;
use super::{Layer, Region, Seat};
use crate::Material;
use crate::error::{ElementError, Field, Problem, at};
use crate::finite::beam::SectionShape;
use crate::finite::{Block, Connectivity, Mass, rigid_points};
use crate::model::{Inertia, Rheology};
use crate::number;
use crate::structure::{Constraint, Node, Structure};
use quasirigid_mesh::{Mesh, MeshFault};

/// Solids, shells, bars, bodies, links and couplings between common nodes.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mixed {
    /// Nodes and cells: the regions and skins name their cells; bars, bodies, links and couplings name nodes.
    pub mesh: Arc<Mesh>,
    /// Regions of solid cells of one material.
    pub regions: Vec<Region>,
    /// Shells.
    pub skins: Vec<Skin>,
    /// Beams and rods, one element each.
    pub bars: Vec<Bar>,
    /// Rigid bodies at nodes.
    pub bodies: Vec<NodeBody>,
    /// Springs and dashpots between nodes.
    pub links: Vec<NodeLink>,
    /// Nodes that follow others.
    pub couplings: Vec<Coupling>,
}

/// Shell cells of the same layers.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Skin {
    /// Indices of the cells.
    pub cells: Vec<usize>,
    /// Layers from the lowest to the highest, of one material or more; a density may be zero.
    pub layers: Vec<Layer>,
    /// Direction whose projection is the angle zero of the layers; none for the first side of each cell.
    pub reference: Option<[f64; 3]>,
    /// Height of the middle of the layers above the nodes (m).
    pub offset: f64,
}

/// A straight beam or rod between two nodes.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Bar {
    /// Indices of the nodes.
    pub ends: [usize; 2],
    /// What the bar resists.
    pub kind: BarKind,
    /// Name of the material.
    pub name: String,
    /// Material; its density may be zero.
    pub material: Material,
}

/// What a bar resists.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BarKind {
    /// Stretch, bending and twist.
    Beam {
        /// Section.
        section: SectionShape,
        /// Direction of the `y` axis of the section.
        up: Option<[f64; 3]>,
    },
    /// Stretch alone.
    Rod {
        /// Area (m²).
        area: f64,
    },
}

/// A rigid body that a node carries.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NodeBody {
    /// Index of the node.
    pub node: usize,
    /// Mass (kg).
    pub mass: f64,
    /// Centre of mass from the node (m); zero at a node without rotations.
    pub offset: [f64; 3],
    /// Inertia tensor about the centre of mass (kg·m²); zero at a node without rotations.
    pub inertia: [[f64; 3]; 3],
}

/// Springs and dashpots between two nodes.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct NodeLink {
    /// Indices of the nodes.
    pub nodes: [usize; 2],
    /// Strains of the link, with what they meet.
    pub strains: Vec<Strain>,
}

/// A strain of a link: a combination of displacements and rotations of its nodes.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strain {
    /// Shares of the three displacements and three rotations of each node.
    pub shares: [[f64; 6]; 2],
    /// Stiffness (N/m or N·m/rad).
    pub stiffness: f64,
    /// Damping (N·s/m or N·m·s/rad).
    pub damping: f64,
}

/// A node that follows others.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub enum Coupling {
    /// One rigid piece with another node, but for rotations about these axes.
    Rigid {
        /// The node.
        node: usize,
        /// The other node.
        base: usize,
        /// Unit vectors, none to three.
        free: Vec<[f64; 3]>,
    },
    /// The rigid motion nearest to the motions of other nodes, by least squares.
    Mean {
        /// The node.
        node: usize,
        /// The others.
        others: Vec<Weighted>,
    },
    /// Some components by those of other nodes; the others are the node's own.
    Linear {
        /// The node.
        node: usize,
        /// Components 0 to 5, translations before rotations, each once, with what moves them: components that no coupling of this kind moves.
        rows: Vec<(usize, Vec<Term>)>,
    },
}

/// Share of a component of a node in a component of another one.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Term {
    /// The node.
    pub node: usize,
    /// Component 0 to 5, translations before rotations.
    pub component: usize,
    /// Share (dimensionless, m or 1/m).
    pub share: f64,
}

/// A node of a mean, with its weight.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Weighted {
    /// The node.
    pub node: usize,
    /// Weight, positive.
    pub weight: f64,
    /// Directions of the displacements that count, unit vectors.
    pub displacements: Vec<[f64; 3]>,
    /// Axes of the rotations that count, unit vectors.
    pub rotations: Vec<[f64; 3]>,
}

impl Coupling {
    /// The node that follows.
    #[must_use]
    pub fn node(&self) -> usize {
        match self {
            Self::Rigid { node, .. } | Self::Mean { node, .. } | Self::Linear { node, .. } => *node,
        }
    }
}

/// Rotations of a node.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Turning {
    /// None.
    Without,
    /// Held: only another node of a link needs them.
    Held,
    /// Free.
    Free,
}

impl Mixed {
    /// Rheologies: of each region, of each layer of each skin, of each bar.
    pub(super) fn rheologies_mut(&mut self) -> Vec<&mut Rheology> {
        let regions = self.regions.iter_mut().map(|region| region.material.rheology_mut());
        let layers = self.skins.iter_mut().flat_map(|skin| &mut skin.layers);
        let layers = layers.map(|layer| layer.material.rheology_mut());
        let bars = self.bars.iter_mut().map(|bar| &mut bar.material.rheology);
        regions.chain(layers).chain(bars).collect()
    }

    /// Which nodes have rotations.
    fn turning(&self) -> Vec<Turning> {
        let mut turning = vec![Turning::Without; self.mesh.nodes.len()];
        let mut raise = |node: usize, to: Turning| {
            if let Some(known) = turning.get_mut(node) {
                *known = (*known).max(to);
            }
        };
        let shells = self.skins.iter().flat_map(|skin| &skin.cells);
        for cell in shells.filter_map(|cell| self.mesh.cells.get(*cell)) {
            cell.nodes.iter().for_each(|node| raise(*node, Turning::Free));
        }
        for bar in self.bars.iter().filter(|bar| matches!(bar.kind, BarKind::Beam { .. })) {
            bar.ends.iter().for_each(|end| raise(*end, Turning::Free));
        }
        for coupling in &self.couplings {
            match coupling {
                Coupling::Rigid { node, base, free } => {
                    raise(*base, Turning::Free);
                    if !free.is_empty() {
                        raise(*node, Turning::Free);
                    }
                }
                Coupling::Mean { node, others } => {
                    raise(*node, Turning::Free);
                    let turned = others.iter().filter(|other| !other.rotations.is_empty());
                    turned.for_each(|other| raise(other.node, Turning::Free));
                }
                Coupling::Linear { node, rows } => {
                    for (component, terms) in rows {
                        let turned = terms.iter().filter(|term| term.component >= 3).map(|term| term.node);
                        let own = (*component >= 3).then_some(*node);
                        turned.chain(own).for_each(|node| raise(node, Turning::Free));
                    }
                }
            }
        }
        for link in self.links.iter().filter(|link| link.turns()) {
            for (end, node) in link.nodes.iter().enumerate() {
                let turns = link.strains.iter().any(|strain| strain.turns(end));
                raise(*node, if turns { Turning::Free } else { Turning::Held });
            }
        }
        turning
    }

    /// Nodes of the part, in order.
    pub(super) fn structure_nodes(&self) -> Vec<Node> {
        let node = |(place, turning): (&[f64; 3], Turning)| Node {
            place: Vector3::from(*place),
            rotations: turning != Turning::Without,
        };
        self.mesh.nodes.iter().zip(self.turning()).map(node).collect()
    }

    /// Whether each node has rotations that something turns.
    #[must_use]
    pub fn turned(&self) -> Vec<bool> {
        self.turning().into_iter().map(|turning| turning == Turning::Free).collect()
    }

    /// Constraints of the nodes; the first of them is `first` in the structure.
    pub(super) fn constraints(&self, first: usize) -> Vec<Constraint> {
        let held = |turning| match turning {
            Turning::Held => Constraint::Partly([true, true, true, false, false, false]),
            _ => Constraint::Free,
        };
        let mut constraints: Vec<Constraint> = self.turning().into_iter().map(held).collect();
        for coupling in &self.couplings {
            let constraint = match coupling {
                Coupling::Rigid { base, free, .. } => Constraint::On {
                    base: Some(first + base),
                    axes: free.iter().map(|axis| Vector3::from(*axis)).collect(),
                },
                Coupling::Mean { node, others } => mean(*node, others, &self.mesh.nodes, first),
                Coupling::Linear { node, rows } => linear(rows, constraints.get(*node), first),
            };
            if let Some(known) = constraints.get_mut(coupling.node()) {
                *known = constraint;
            }
        }
        constraints
    }

    /// Adds the elements of the part to a structure that has its nodes.
    pub(super) fn assemble_into(&self, seat: Seat, structure: &mut Structure) -> Result<(), ElementError> {
        let refuse = at(seat.place, Field::FILE);
        self.check().map_err(&refuse)?;
        for region in &self.regions {
            region.material.check_constants(seat.place)?;
            region.assemble_into(&self.mesh, seat, structure)?;
        }
        for Skin { cells, layers, reference, offset } in &self.skins {
            let plating = Plating { layers, reference: *reference, offset: *offset };
            let cells = cells.iter().map(|cell| &self.mesh.cells[*cell]);
            plating.assemble_into(&self.mesh, cells, seat, structure)?;
        }
        for bar in &self.bars {
            bar.assemble_into(&self.mesh, seat, structure)?;
        }
        let turned = self.turned();
        for body in &self.bodies {
            body.assemble_into(turned[body.node], seat, structure).map_err(&refuse)?;
        }
        self.links.iter().for_each(|link| link.assemble_into(seat, structure));
        Ok(())
    }

    /// Accepts equations for components that there are, each once, by components that no equation gives.
    fn check_equations(&self) -> Result<(), Problem> {
        let equations = self.couplings.iter().filter_map(|coupling| match coupling {
            Coupling::Linear { node, rows } => Some((*node, rows)),
            _ => None,
        });
        let mut given = HashSet::new();
        let name = |node: usize, component: usize| {
            format!("node {} component {component}", self.mesh.node_labels[node])
        };
        for (node, (component, _)) in
            equations.clone().flat_map(|(node, rows)| rows.iter().map(move |row| (node, row)))
        {
            if *component >= 6 || !given.insert((node, *component)) {
                return Err(Problem::HeldTwice { node: name(node, *component) });
            }
        }
        let mut terms = equations.flat_map(|(_, rows)| rows.iter().flat_map(|(_, terms)| terms));
        let unfit = |term: &&Term| {
            term.component >= 6 || !term.share.is_finite() || given.contains(&(term.node, term.component))
        };
        match terms.find(unfit) {
            Some(term) => Err(Problem::Circle { node: name(term.node, term.component) }),
            None => Ok(()),
        }
    }

    /// Accepts indices of nodes and cells that exist, cells that are sound, and each node following once.
    fn check(&self) -> Result<(), Problem> {
        let (nodes, cells) = (self.mesh.nodes.len(), self.mesh.cells.len());
        let named = self.regions.iter().map(|region| &region.cells);
        let named = named.chain(self.skins.iter().map(|skin| &skin.cells)).flatten();
        if let Some(index) = named.copied().find(|cell| *cell >= cells) {
            return Err(Problem::NoSuchCell { index, count: cells });
        }
        let of_couplings = self.couplings.iter().flat_map(|coupling| match coupling {
            Coupling::Rigid { node, base, .. } => vec![*node, *base],
            Coupling::Mean { node, others } => others.iter().map(|other| other.node).chain([*node]).collect(),
            Coupling::Linear { node, rows } => {
                rows.iter().flat_map(|(_, terms)| terms).map(|term| term.node).chain([*node]).collect()
            }
        });
        let of_elements = self.bars.iter().flat_map(|bar| bar.ends);
        let of_links = self.links.iter().flat_map(|link| link.nodes);
        let of_bodies = self.bodies.iter().map(|body| body.node);
        let mut named = of_couplings.chain(of_elements).chain(of_links).chain(of_bodies);
        if let Some(index) = named.find(|node| *node >= nodes) {
            return Err(Problem::NoSuchNode { index, count: nodes });
        }
        let mut follows = vec![false; nodes];
        for coupling in &self.couplings {
            if std::mem::replace(&mut follows[coupling.node()], true) {
                let node = format!("node {}", self.mesh.node_labels[coupling.node()]);
                return Err(Problem::HeldTwice { node });
            }
        }
        self.check_equations()?;
        // Two shells may lie between the same nodes.
        let faults = self.mesh.check().err().unwrap_or_default();
        let faults: Vec<MeshFault> =
            faults.into_iter().filter(|fault| !matches!(fault, MeshFault::CellTwice { .. })).collect();
        if faults.is_empty() { Ok(()) } else { Err(Problem::Mesh(faults)) }
    }
}

/// Constraint of a node on components of others; components that nothing gives are as they were.
fn linear(rows: &[(usize, Vec<Term>)], before: Option<&Constraint>, first: usize) -> Constraint {
    let mut own = match before {
        Some(Constraint::Partly(own)) => *own,
        _ => [true; 6],
    };
    for (component, _) in rows {
        if let Some(own) = own.get_mut(*component) {
            *own = false;
        }
    }
    let term = |term: &Term| (first + term.node, term.component, term.share);
    let rows = rows.iter().map(|(component, terms)| (*component, terms.iter().map(term).collect()));
    Constraint::Linear { own, rows: rows.collect() }
}

impl Bar {
    fn assemble_into(&self, mesh: &Mesh, seat: Seat, structure: &mut Structure) -> Result<(), ElementError> {
        self.material.check_constants(seat.place)?;
        let places = self.ends.map(|end| mesh.nodes[end]);
        let material = structure.named_material(&self.name, &self.material.rheology, seat.rayleigh);
        match self.kind {
            BarKind::Beam { section, up } => {
                let connectivity = seat.connectivity(&self.ends, 6, material);
                structure.elements.push(bar_element(
                    seat.place,
                    connectivity,
                    places,
                    (section, up),
                    &self.material,
                )?);
            }
            BarKind::Rod { area } => {
                number::positive(area).map_err(at(seat.place, Field::SECTION))?;
                let connectivity = seat.connectivity(&self.ends, 3, material);
                let Material { young, density, .. } = self.material;
                let places = places.map(Vector3::from);
                structure.elements.push(Box::new(Rod { connectivity, places, young, area, density }));
            }
        }
        Ok(())
    }
}

impl NodeBody {
    fn assemble_into(
        &self,
        turned: bool,
        Seat { first, .. }: Seat,
        structure: &mut Structure,
    ) -> Result<(), Problem> {
        number::mass(self.mass)?;
        number::finite(&self.offset)?;
        let inertia = Inertia::new(self.inertia)?;
        let node = structure.nodes[first + self.node];
        let points = if turned {
            let offset = Vector3::from(self.offset);
            let points = rigid_points(self.mass, &inertia).into_iter();
            points.map(|(mass, arm)| (mass, arm + offset)).collect()
        } else if self.inertia == [[0.0; 3]; 3] && self.offset == [0.0; 3] {
            vec![(self.mass, Vector3::zeros())]
        } else {
            return Err(Problem::NoTurnForInertia { node: self.node.to_string() });
        };
        let material = structure.material(&Rheology::Elastic, [0.0; 2]);
        let dofs = if turned { 6 } else { 3 };
        let connectivity = Connectivity { nodes: vec![first + self.node], dofs, material };
        structure.elements.push(Box::new(Mass { connectivity, points, place: node.place }));
        Ok(())
    }
}

impl Strain {
    /// Whether a rotation of an end strains the link.
    fn turns(&self, end: usize) -> bool {
        self.shares[end][3..].iter().any(|share| *share != 0.0)
    }
}

impl NodeLink {
    /// Whether a rotation strains the link.
    fn turns(&self) -> bool {
        self.strains.iter().any(|strain| strain.turns(0) || strain.turns(1))
    }

    fn assemble_into(&self, seat: Seat, structure: &mut Structure) {
        let dofs = if self.turns() { 6 } else { 3 };
        let material = structure.material(&Rheology::Elastic, [0.0; 2]);
        let zero = DMatrix::zeros(2 * dofs, 2 * dofs);
        let mut block = Block {
            connectivity: seat.connectivity(&self.nodes, dofs, material),
            stiffness: zero.clone(),
            damping: zero.clone(),
            mass: zero,
            lumped_masses: Vec::new(),
        };
        for strain in &self.strains {
            let shares = DMatrix::from_fn(2 * dofs, 1, |row, _| strain.shares[row / dofs][row % dofs]);
            let square = &shares * shares.transpose();
            block.stiffness += strain.stiffness * &square;
            block.damping += strain.damping * square;
        }
        structure.elements.push(Box::new(block));
    }
}
