//! Structure of an assembly: parts, joints and, without a carrier, points and springs as nodes and finite elements.
//! Keeps for every node the element that it comes from, so that a mechanism or a circle is reported by name and key.
//! Equations (K1), (K2) and (K8), docs/theory/12-structures.md.

use std::collections::BTreeMap;

use nalgebra::Vector3;

use super::constraints::constraints;
use crate::NodeRef;
use crate::contribution::{Attachment, Floating};
use crate::element::{AttachmentPoint, Role};
use crate::error::{ElementError, ElementId, ElementKind, Field, Problem, at};
use crate::finite::{Connectivity, Mass};
use crate::kinds::part::{Part, PartKind, extremes};
use crate::model::{Reach, Rheology};
use crate::number;
use crate::structure::{
    Component, CondensationOptions, Constraint, Dofs, Fault, Joint, Load, Node, Structure, Unknown,
};
use crate::{Assembly, End, PointMotion};

/// The parts of a body as one structure; without a carrier also its points and springs.
pub(crate) struct PartGraph<'a> {
    pub assembly: &'a Assembly,
    pub structure: Structure,
    /// First node of each part, of the points, and of the joints.
    pub firsts: Vec<usize>,
    /// Connection of each node that is a joint.
    joints: Vec<usize>,
    /// Connection of each spring about the axes of a joint.
    hinges: Vec<usize>,
    /// Nodes whose displacements the component keeps: those that are watched or loaded, then those that are only drawn.
    kept_nodes: Vec<NodeRef>,
    drawn: Vec<NodeRef>,
    /// Loads of links and forces at each of these nodes.
    loads: Vec<Load>,
}

/// Order above which the space of a structure does not grow: its strains are complete up to there.
const HIGHEST: usize = 5;
/// Most unknowns named in a message.
const MOST_NAMES: usize = 6;

impl<'a> PartGraph<'a> {
    /// Structure of the parts of a body.
    ///
    /// # Errors
    /// [`ElementError`] for the first part or connection that cannot be.
    pub fn of_parts(assembly: &'a Assembly) -> Result<Self, ElementError> {
        Self::new(assembly, false)
    }

    /// Structure of a body without a carrier: parts, points and springs.
    ///
    /// # Errors
    /// [`ElementError`] for the first element that cannot be.
    pub fn of_everything(assembly: &'a Assembly) -> Result<Self, ElementError> {
        for (index, point) in assembly.points.iter().enumerate() {
            let place = ElementKind::Point.at(index);
            number::mass(point.mass).map_err(at(place, Field::MASS))?;
            number::finite(&point.position).map_err(at(place, Field::POSITION))?;
            if point.motion != PointMotion::Free {
                return Err(at(place, Field::MOTION)(Problem::NoGuide));
            }
        }
        let mut graph = Self::new(assembly, true)?;
        graph.structure.own("");
        let names = assembly.link_names();
        for (id, link) in assembly.each().filter(|(id, _)| id.kind.role() == Role::Link) {
            link.afloat(id, &mut graph)?;
            graph.structure.own(&names[&id]);
        }
        Ok(graph)
    }

    fn new(assembly: &'a Assembly, floating: bool) -> Result<Self, ElementError> {
        let mut structure = Structure::default();
        let mut firsts = Vec::new();
        for (index, part) in assembly.parts.iter().enumerate() {
            firsts.push(structure.nodes.len());
            structure.nodes.extend(part.nodes());
            structure.constraints.extend(part.constraints(firsts[index]));
            part.assemble_into(index, firsts[index], &mut structure)?;
            structure.own(&part.name);
        }
        firsts.push(structure.nodes.len());
        let (joints, hinges) = (Vec::new(), Vec::new());
        let (kept_nodes, drawn, loads) = (Vec::new(), Vec::new(), Vec::new());
        let mut graph = Self { assembly, structure, firsts, joints, hinges, kept_nodes, drawn, loads };
        for point in assembly.points.iter().filter(|_| floating) {
            graph.point(point.mass, point.position.into());
        }
        graph.firsts.push(graph.structure.nodes.len());
        constraints(assembly, &mut graph)?;
        graph.station_all(floating)?;
        Ok(graph)
    }

    /// Component: the structure condensed to few coordinates.
    ///
    /// # Errors
    /// [`ElementError`] for nodes that constrain each other in a circle, and for a mechanism.
    pub fn component(&self, floating: bool) -> Result<Component, ElementError> {
        let dofs = Dofs::new(&self.structure.nodes, &self.structure.constraints).map_err(|circle| {
            self.attribute_to(circle.node, Problem::Circle { node: self.node_name(circle.node) })
        })?;
        let kept = self.kept_nodes.iter().chain(&self.drawn);
        let kept_nodes: Vec<usize> = kept.map(|node| self.index(*node)).collect();
        let options = CondensationOptions {
            order: self.assembly.reduction.order.min(HIGHEST),
            modes: self.assembly.reduction.modes,
            floating,
            kept_nodes: &kept_nodes,
            loads: &self.loads,
        };
        self.structure.component(dofs, &options).map_err(|fault| self.refusal(fault))
    }

    /// Number of a node in the structure.
    pub fn index(&self, node: NodeRef) -> usize {
        self.firsts[node.part] + node.node
    }

    /// Asks the component to keep the displacements of nodes that are drawn.
    pub fn draw(&mut self, nodes: impl Iterator<Item = NodeRef>) {
        self.drawn.extend(nodes);
        self.drawn.sort_unstable();
    }

    /// Attachments: nodes that are watched or loaded, in terms of the coordinates of the component, numbered from `start`.
    pub fn attachments(&self, component: &Component, start: usize) -> BTreeMap<NodeRef, Attachment> {
        self.kept(&self.kept_nodes, 0, component, start)
    }

    /// Nodes that are drawn, as [`attachments`](Self::attachments).
    pub fn drawn(&self, component: &Component, start: usize) -> BTreeMap<NodeRef, Attachment> {
        self.kept(&self.drawn, self.kept_nodes.len(), component, start)
    }

    /// Nodes, the first of them with a number among those that the component keeps.
    fn kept(
        &self,
        nodes: &[NodeRef],
        first: usize,
        component: &Component,
        start: usize,
    ) -> BTreeMap<NodeRef, Attachment> {
        let attachment = |(number, node): (usize, &NodeRef)| {
            let number = first + number;
            let index = self.index(*node);
            let attachment = Attachment {
                name: self.node_name(index),
                position: self.structure.nodes[index].place,
                shapes: component.shapes(number, start),
                rotations: component.rotations(number, start),
                curvature: component.curvature(number, start),
                carried: None,
            };
            (*node, attachment)
        };
        nodes.iter().enumerate().map(attachment).collect()
    }

    /// Reaches: nodes that measure the displacement of parts, each with its distance from the nearest clamped node of its part, or from the
    /// farthest of its nodes.
    pub fn reaches(&self, nodes: &BTreeMap<NodeRef, Attachment>) -> Vec<Reach> {
        let of_part = |(number, part): (usize, &Part)| {
            let places = part.nodes();
            let reach = |node: usize| {
                let from = |other: usize| (places[other].place - places[node].place).norm();
                let held = part.attached.iter().map(|other| from(*other)).min_by(f64::total_cmp);
                let length = held.or_else(|| (0..places.len()).map(from).max_by(f64::total_cmp))?;
                let Attachment { name, shapes, .. } = nodes.get(&NodeRef { part: number, node })?;
                (length > 0.0).then(|| Reach { name: name.clone(), length, shapes: shapes.clone() })
            };
            part.watched().into_iter().filter_map(reach).collect::<Vec<_>>()
        };
        self.assembly.parts.iter().enumerate().flat_map(of_part).collect()
    }

    /// Name of a generalised coordinate that a node of the structure keeps as a component.
    fn coordinate_name(&self, node: usize, component: usize) -> String {
        let (element, inner) = self.owner(node);
        let modes = |part: &'a Part| match &part.kind {
            PartKind::Modes(modes) => {
                Some(format!("{:?} {}", part.name, modes.coordinate_name(inner, component)))
            }
            _ => None,
        };
        match element.kind {
            ElementKind::Part => self.assembly.parts.get(element.index).and_then(modes).unwrap_or_default(),
            _ => element.to_string(),
        }
    }

    /// Element to which a node belongs, and the index of the node in it.
    fn owner(&self, node: usize) -> (ElementId, usize) {
        let group = self.firsts.partition_point(|first| *first <= node).saturating_sub(1);
        let (inner, parts) = (node - self.firsts[group], self.assembly.parts.len());
        let place = match group {
            part if part < parts => ElementKind::Part.at(part),
            points if points == parts => ElementKind::Point.at(inner),
            _ => ElementKind::Connection.at(self.joints[inner]),
        };
        (place, inner)
    }

    /// Adds a node of a connection, which belongs to no part.
    pub fn joint_node(&mut self, place: Vector3<f64>, connection: usize) -> usize {
        self.joints.push(connection);
        self.structure.nodes.push(Node { place, rotations: true });
        self.structure.constraints.push(Constraint::Free);
        self.structure.nodes.len() - 1
    }

    /// Adds the springs about the axes of a connection.
    pub fn hinge(&mut self, joint: Joint, connection: usize) {
        self.structure.joints.push(joint);
        self.hinges.push(connection);
    }

    /// Error of the element to which a node belongs.
    pub fn attribute_to(&self, node: usize, problem: Problem) -> ElementError {
        let element = self.owner(node).0;
        let field = if element.kind == ElementKind::Part { Field::ATTACH } else { Field::STIFFNESS };
        at(element, field)(problem)
    }

    fn point(&mut self, mass: f64, place: Vector3<f64>) {
        let node = self.structure.nodes.len();
        let material = self.material(&Rheology::Elastic);
        self.structure.nodes.push(Node { place, rotations: false });
        self.structure.constraints.push(Constraint::Free);
        let points = vec![(mass, Vector3::zeros())];
        let connectivity = Connectivity { nodes: vec![node], dofs: 3, material };
        self.structure.elements.push(Box::new(Mass { connectivity, points, place }));
    }

    /// Notes the nodes that are watched, and those at which springs and forces act; of a body without a carrier also points, which count as
    /// one more part.
    fn station_all(&mut self, floating: bool) -> Result<(), ElementError> {
        let points = self.assembly.parts.len();
        let mut kept_nodes = BTreeMap::new();
        for (part, description) in self.assembly.parts.iter().enumerate() {
            kept_nodes.extend(
                description.watched().into_iter().map(|node| (NodeRef { part, node }, Load::default())),
            );
        }
        if floating {
            let places: Vec<[f64; 3]> = self.assembly.points.iter().map(|point| point.position).collect();
            kept_nodes.extend(
                extremes(&places).into_iter().map(|node| (NodeRef { part: points, node }, Load::default())),
            );
        }
        for (id, role, AttachmentPoint { field, end, moment }) in self.assembly.attachment_points() {
            let between_nodes = floating && role == Role::Link;
            match end {
                End::Node(node) => {
                    self.assembly.has(node).map_err(at(id, field))?;
                    let rotations = self.structure.nodes[self.index(node)].rotations;
                    let load: &mut Load = kept_nodes.entry(node).or_default();
                    load.force |= !between_nodes;
                    load.moment |= !between_nodes && moment && rotations;
                }
                End::Point(node) if floating && role != Role::Link => {
                    kept_nodes.insert(NodeRef { part: points, node }, Load { force: true, moment: false });
                }
                End::Point(_) | End::Carrier | End::Hinged(_) => {}
            }
        }
        self.loads = kept_nodes.values().copied().collect();
        self.kept_nodes = kept_nodes.into_keys().collect();
        Ok(())
    }

    fn refusal(&self, fault: Fault) -> ElementError {
        match fault {
            Fault::Loose(unknowns) => self.mechanism(&unknowns),
            Fault::Memory(unknowns, cause) => {
                at(ElementKind::Part.at(0), Field::NAME)(Problem::Memory { unknowns, cause })
            }
            Fault::NoConvergence(cause) => {
                at(ElementKind::Part.at(0), Field::MODES)(Problem::NoModes { cause })
            }
        }
    }

    /// Attributes a mechanism to the hinges that rotate freely, else to the nodes that move.
    fn mechanism(&self, loose: &[Unknown]) -> ElementError {
        const COMPONENTS: [&str; 6] = ["x", "y", "z", "about x", "about y", "about z"];
        let hinges = loose.iter().filter_map(|unknown| match *unknown {
            Unknown::Joint(node, axis) => {
                let hinge = ElementKind::Connection.at(self.hinged_by(node)?);
                Some((hinge, format!("{hinge} about its axis {}", axis + 1)))
            }
            Unknown::Node(..) | Unknown::Coordinate(..) => None,
        });
        let (hinges, names): (Vec<ElementId>, Vec<String>) = hinges.unzip();
        if let Some(first) = hinges.first() {
            return at(*first, Field::STIFFNESS)(Problem::Mechanism { coordinates: listed(names) });
        }
        let nodes = loose.iter().filter_map(|unknown| match *unknown {
            Unknown::Node(node, component) => {
                Some((node, format!("{} {}", self.node_name(node), COMPONENTS[component])))
            }
            Unknown::Coordinate(node, component) => Some((node, self.coordinate_name(node, component))),
            Unknown::Joint(..) => None,
        });
        let (nodes, names): (Vec<usize>, Vec<String>) = nodes.unzip();
        let first = nodes.first().copied().unwrap_or_default();
        self.attribute_to(first, Problem::Mechanism { coordinates: listed(names) })
    }

    /// Connection whose hinge constrains a node.
    fn hinged_by(&self, node: usize) -> Option<usize> {
        let joint = self.structure.joints.iter().position(|joint| joint.node == node)?;
        self.hinges.get(joint).copied()
    }
}

impl Floating for PartGraph<'_> {
    fn node_at(&self, end: End) -> Result<usize, Problem> {
        match end {
            End::Carrier | End::Hinged(_) => Err(Problem::NoCarrier),
            End::Point(point) if point < self.assembly.points.len() => {
                Ok(self.firsts[self.assembly.parts.len()] + point)
            }
            End::Point(index) => Err(Problem::NoSuchPoint { index }),
            End::Node(node) => Ok(self.index(node)),
        }
    }

    fn node_name(&self, node: usize) -> String {
        let (element, inner) = self.owner(node);
        match element.kind {
            ElementKind::Part => {
                let owner = &self.assembly.parts[element.index];
                format!("{:?} {}", owner.name, owner.node_name(inner))
            }
            ElementKind::Point => format!("{:?}", self.assembly.points[element.index].name),
            _ => element.to_string(),
        }
    }

    fn material(&mut self, rheology: &Rheology) -> usize {
        self.structure.material(rheology, [0.0; 2])
    }

    fn structure(&mut self) -> &mut Structure {
        &mut self.structure
    }
}

fn listed(mut names: Vec<String>) -> String {
    let more = names.len().saturating_sub(MOST_NAMES);
    names.truncate(MOST_NAMES);
    if more > 0 {
        names.push(format!("{more} more"));
    }
    names.join(", ")
}
