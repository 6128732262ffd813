//! Constraints: attachments and connections of parts as joints between nodes of one structure.
//! A joint constrains a node to at most one other; a hinge between many nodes gets a node of its own, so that no equation of
//! constraint is left to solve. Equation (K2), docs/theory/12-structures.md.

use std::collections::BTreeSet;

use nalgebra::Vector3;

use super::Assembly;
use crate::NodeRef;
use crate::contribution::Floating;
use crate::error::{ElementError, ElementId, ElementKind, Field, Problem, at};
use crate::kinds::part::PartGraph;
use crate::kinds::part::{Anchor, Connection, Part};
use crate::number;
use crate::structure::{Constraint, Joint};

/// Distance, as a share of the size of the structure, below which nodes of two sides are at the same place.
const SAME_PLACE: f64 = 1e-6;

/// Constrains the nodes of a structure as attachments and connections say.
///
/// # Errors
/// [`ElementError`] for an attachment or a connection that cannot be.
pub(super) fn constraints(assembly: &Assembly, graph: &mut PartGraph<'_>) -> Result<(), ElementError> {
    for (index, part) in assembly.parts.iter().enumerate() {
        let refuse = at(ElementKind::Part.at(index), Field::ATTACH);
        if assembly.carrier.is_none() && !part.attached.is_empty() {
            return Err(refuse(Problem::NoCarrier));
        }
        if let Some(node) = part.held().filter(|_| assembly.carrier.is_none()) {
            return Err(at(ElementKind::Part.at(index), Field::STIFFNESS)(Problem::HeldByMatrices { node }));
        }
        for node in part.attached.iter().collect::<BTreeSet<_>>() {
            let node = NodeRef { part: index, node: *node };
            assembly.has(node).map_err(&refuse)?;
            graph.constrain(graph.index(node), None, Vec::new()).map_err(&refuse)?;
        }
    }
    for (index, connection) in assembly.connections.iter().enumerate() {
        connection.join(assembly, index, graph)?;
    }
    if assembly.carrier.is_some() { all_attached(assembly) } else { Ok(()) }
}

/// Accepts parts that attachments and connections join to the carrier, directly or through others.
fn all_attached(assembly: &Assembly) -> Result<(), ElementError> {
    let held = |part: &Part| !part.attached.is_empty() || part.stands();
    let mut joined: Vec<bool> = assembly.parts.iter().map(held).collect();
    let part = |anchor: &Anchor| match anchor {
        Anchor::Carrier => None,
        Anchor::Nodes { part, .. } => Some(*part),
    };
    // each pass reaches one more part at least
    for _ in &assembly.parts {
        for connection in &assembly.connections {
            let sides = [part(&connection.from), part(&connection.to)];
            if sides.iter().any(|side| side.is_none_or(|part| joined[part])) {
                sides.into_iter().flatten().for_each(|part| joined[part] = true);
            }
        }
    }
    match joined.iter().position(|joined| !joined) {
        Some(part) => Err(at(ElementKind::Part.at(part), Field::ATTACH)(Problem::NotAttached)),
        None => Ok(()),
    }
}

/// Nodes of one side of a connection; none for the carrier.
type Side = Option<Vec<usize>>;

impl Connection {
    fn join(&self, assembly: &Assembly, index: usize, graph: &mut PartGraph<'_>) -> Result<(), ElementError> {
        let place = ElementKind::Connection.at(index);
        let from = side(&self.from, assembly, graph).map_err(at(place, Field::FROM))?;
        let to = side(&self.to, assembly, graph).map_err(at(place, Field::TO))?;
        let axes = self.unit_axes(place)?;
        self.rheology.check().map_err(|error| at(place, Field::RHEOLOGY)(error.into()))?;
        let refuse = at(place, Field::TO);
        match (from, to) {
            (None, None) => Err(refuse(Problem::SameEnds)),
            (None, Some(nodes)) | (Some(nodes), None) => {
                self.constrain(index, graph, None, nodes, axes).map_err(refuse)
            }
            (Some(base), Some(nodes)) if base.len() == 1 && (nodes.len() > 1 || graph.is_free(nodes[0])) => {
                self.constrain(index, graph, Some(base[0]), nodes, axes).map_err(refuse)
            }
            (Some(nodes), Some(base)) if base.len() == 1 => {
                self.constrain(index, graph, Some(base[0]), nodes, axes).map_err(refuse)
            }
            (Some(base), Some(nodes)) if axes.is_empty() => weld(graph, &base, &nodes).map_err(refuse),
            (Some(base), Some(nodes)) => {
                let joint = graph.joint_node(middle(graph, &base), index);
                for node in base {
                    graph.constrain(node, Some(joint), Vec::new()).map_err(&refuse)?;
                }
                self.constrain(index, graph, Some(joint), nodes, axes).map_err(refuse)
            }
        }
    }

    /// Constrains nodes as one rigid piece, to a base or to the carrier.
    fn constrain(
        &self,
        index: usize,
        graph: &mut PartGraph<'_>,
        base: Option<usize>,
        nodes: Vec<usize>,
        axes: Vec<Vector3<f64>>,
    ) -> Result<(), Problem> {
        let (joint, rest) = match nodes.as_slice() {
            [node] => (*node, Vec::new()),
            _ if axes.is_empty() => {
                return nodes.into_iter().try_for_each(|node| graph.constrain(node, base, Vec::new()));
            }
            _ => (graph.joint_node(middle(graph, &nodes), index), nodes),
        };
        if !axes.is_empty() {
            if !graph.structure.nodes[joint].rotations {
                return Err(Problem::NoTurn { node: graph.node_name(joint) });
            }
            let material = graph.material(&self.rheology);
            let (stiffness, damping) = (self.stiffness.clone(), self.damping.clone());
            let name = graph.assembly.connection_name(index);
            graph.hinge(Joint { name, node: joint, stiffness, damping, material }, index);
        }
        graph.constrain(joint, base, axes)?;
        rest.into_iter().try_for_each(|node| graph.constrain(node, Some(joint), Vec::new()))
    }

    fn unit_axes(&self, place: ElementId) -> Result<Vec<Vector3<f64>>, ElementError> {
        let axes: Vec<Vector3<f64>> = self
            .axes
            .iter()
            .map(|axis| number::unit(*axis))
            .collect::<Result<_, _>>()
            .map_err(at(place, Field::HINGE))?;
        if axes.len() > 3 {
            return Err(at(place, Field::HINGE)(Problem::AxisCount { count: axes.len() }));
        }
        for (field, values) in [(Field::STIFFNESS, &self.stiffness), (Field::DAMPING, &self.damping)] {
            if values.len() != axes.len() {
                return Err(at(place, field)(Problem::ValuePerAxis {
                    axes: axes.len(),
                    values: values.len(),
                }));
            }
            for value in values {
                number::finite(&[*value]).map_err(at(place, field))?;
                if *value < 0.0 {
                    return Err(at(place, field)(Problem::Indefinite { eigenvalue: *value }));
                }
            }
        }
        Ok(axes)
    }
}

impl PartGraph<'_> {
    fn is_free(&self, node: usize) -> bool {
        self.structure.constraints[node].is_free()
    }

    /// Constrains a node that is still free.
    fn constrain(
        &mut self,
        node: usize,
        base: Option<usize>,
        axes: Vec<Vector3<f64>>,
    ) -> Result<(), Problem> {
        if matches!(self.structure.constraints[node], Constraint::Shaped { .. } | Constraint::Linear { .. }) {
            return Err(Problem::NotInterface { node: self.node_name(node) });
        }
        if !self.is_free(node) {
            return Err(Problem::HeldTwice { node: self.node_name(node) });
        }
        if let Some(base) = base.filter(|base| !self.structure.nodes[*base].rotations) {
            let distance = (self.structure.nodes[node].place - self.structure.nodes[base].place).norm();
            if distance > SAME_PLACE * self.size() {
                let (base, node) = (self.node_name(base), self.node_name(node));
                return Err(Problem::NoArm { base, node, distance });
            }
            if !axes.is_empty() {
                return Err(Problem::NoTurn { node: self.node_name(base) });
            }
        }
        self.structure.constraints[node] = Constraint::On { base, axes };
        Ok(())
    }

    /// Largest distance of a node from the first.
    fn size(&self) -> f64 {
        let nodes = &self.structure.nodes;
        nodes.iter().map(|node| (node.place - nodes[0].place).norm()).fold(0.0, f64::max)
    }
}

fn side(anchor: &Anchor, assembly: &Assembly, graph: &PartGraph<'_>) -> Result<Side, Problem> {
    let Anchor::Nodes { part, nodes } = anchor else {
        return if assembly.carrier.is_some() { Ok(None) } else { Err(Problem::NoCarrier) };
    };
    if nodes.is_empty() {
        return Err(Problem::NoNodes);
    }
    let number = |node: &usize| {
        let reference = NodeRef { part: *part, node: *node };
        assembly.has(reference).map(|()| graph.index(reference))
    };
    nodes.iter().map(number).collect::<Result<_, _>>().map(Some)
}

/// Joins each node of one side to the node of the other side that is at the same place.
fn weld(graph: &mut PartGraph<'_>, base: &[usize], nodes: &[usize]) -> Result<(), Problem> {
    let tolerance = SAME_PLACE * graph.size();
    for node in nodes {
        let place = graph.structure.nodes[*node].place;
        let distance = |other: &usize| (graph.structure.nodes[*other].place - place).norm();
        let nearest = base.iter().copied().min_by(|a, b| distance(a).total_cmp(&distance(b)));
        match nearest {
            Some(partner) if distance(&partner) <= tolerance => {
                graph.constrain(*node, Some(partner), Vec::new())?
            }
            _ => {
                let distance = nearest.as_ref().map_or(f64::INFINITY, distance);
                return Err(Problem::NoPartner { node: graph.node_name(*node), distance });
            }
        }
    }
    Ok(())
}

fn middle(graph: &PartGraph<'_>, nodes: &[usize]) -> Vector3<f64> {
    nodes.iter().map(|node| graph.structure.nodes[*node].place).sum::<Vector3<f64>>() / nodes.len() as f64
}
