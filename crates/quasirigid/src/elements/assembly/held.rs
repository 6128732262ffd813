use std::collections::BTreeSet;

use nalgebra::Vector3;

use super::Assembly;
use super::net::Net;
use crate::elements::coefficient;
use crate::elements::error::{ElementError, ElementId, ElementKind, Field, Problem, at};
use crate::elements::part::{Anchor, Connection, NodeRef, Part};
use crate::structure::{Hold, Joint};

/// Nodes of two sides are at the same place if they are closer than this share of the size of the structure.
const SAME_PLACE: f64 = 1e-6;

/// Holds the nodes of a net as attachments and connections say.
///
/// # Errors
/// [`ElementError`] for an attachment or a connection that cannot be.
pub(super) fn holds(assembly: &Assembly, net: &mut Net<'_>) -> Result<(), ElementError> {
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
            net.hold(net.index(node), None, Vec::new()).map_err(&refuse)?;
        }
    }
    for (index, connection) in assembly.connections.iter().enumerate() {
        connection.join(assembly, index, net)?;
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
    // each pass reaches at least one more part
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
    fn join(&self, assembly: &Assembly, index: usize, net: &mut Net<'_>) -> Result<(), ElementError> {
        let place = ElementKind::Connection.at(index);
        let from = side(&self.from, assembly, net).map_err(at(place, Field::FROM))?;
        let to = side(&self.to, assembly, net).map_err(at(place, Field::TO))?;
        let axes = self.unit_axes(place)?;
        self.rheology.check().map_err(|error| at(place, Field::RHEOLOGY)(error.into()))?;
        let refuse = at(place, Field::TO);
        match (from, to) {
            (None, None) => Err(refuse(Problem::SameEnds)),
            (None, Some(nodes)) | (Some(nodes), None) => {
                self.hold(index, net, None, nodes, axes).map_err(refuse)
            }
            (Some(base), Some(nodes)) if base.len() == 1 && (nodes.len() > 1 || net.is_free(nodes[0])) => {
                self.hold(index, net, Some(base[0]), nodes, axes).map_err(refuse)
            }
            (Some(nodes), Some(base)) if base.len() == 1 => {
                self.hold(index, net, Some(base[0]), nodes, axes).map_err(refuse)
            }
            (Some(base), Some(nodes)) if axes.is_empty() => weld(net, &base, &nodes).map_err(refuse),
            (Some(base), Some(nodes)) => {
                let joint = net.joint_node(middle(net, &base), index);
                for node in base {
                    net.hold(node, Some(joint), Vec::new()).map_err(&refuse)?;
                }
                self.hold(index, net, Some(joint), nodes, axes).map_err(refuse)
            }
        }
    }

    /// Holds nodes as one piece, on a base or the carrier.
    fn hold(
        &self,
        index: usize,
        net: &mut Net<'_>,
        base: Option<usize>,
        nodes: Vec<usize>,
        axes: Vec<Vector3<f64>>,
    ) -> Result<(), Problem> {
        let (joint, rest) = match nodes.as_slice() {
            [node] => (*node, Vec::new()),
            _ if axes.is_empty() => {
                return nodes.into_iter().try_for_each(|node| net.hold(node, base, Vec::new()));
            }
            _ => (net.joint_node(middle(net, &nodes), index), nodes),
        };
        if !axes.is_empty() {
            if !net.structure.nodes[joint].turns {
                return Err(Problem::NoTurn { node: net.node_name(joint) });
            }
            let matter = net.matter(&self.rheology);
            let (stiffness, damping) = (self.stiffness.clone(), self.damping.clone());
            let name = net.connection_name(index);
            net.hinge(Joint { name, node: joint, stiffness, damping, matter }, index);
        }
        net.hold(joint, base, axes)?;
        rest.into_iter().try_for_each(|node| net.hold(node, Some(joint), Vec::new()))
    }

    fn unit_axes(&self, place: ElementId) -> Result<Vec<Vector3<f64>>, ElementError> {
        let axes: Vec<Vector3<f64>> = self
            .axes
            .iter()
            .map(|axis| coefficient::unit(*axis))
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
                coefficient::finite(&[*value]).map_err(at(place, field))?;
                if *value < 0.0 {
                    return Err(at(place, field)(Problem::Indefinite { eigenvalue: *value }));
                }
            }
        }
        Ok(axes)
    }
}

impl Net<'_> {
    fn is_free(&self, node: usize) -> bool {
        self.structure.holds[node].is_free()
    }

    /// Holds a node that nothing holds yet.
    fn hold(&mut self, node: usize, base: Option<usize>, axes: Vec<Vector3<f64>>) -> Result<(), Problem> {
        if matches!(self.structure.holds[node], Hold::Shaped { .. }) {
            return Err(Problem::NotInterface { node: self.node_name(node) });
        }
        if !self.is_free(node) {
            return Err(Problem::HeldTwice { node: self.node_name(node) });
        }
        if let Some(base) = base.filter(|base| !self.structure.nodes[*base].turns) {
            let distance = (self.structure.nodes[node].place - self.structure.nodes[base].place).norm();
            if distance > SAME_PLACE * self.size() {
                let (base, node) = (self.node_name(base), self.node_name(node));
                return Err(Problem::NoArm { base, node, distance });
            }
            if !axes.is_empty() {
                return Err(Problem::NoTurn { node: self.node_name(base) });
            }
        }
        self.structure.holds[node] = Hold::On { base, axes };
        Ok(())
    }

    /// Largest distance of a node from the first.
    fn size(&self) -> f64 {
        let nodes = &self.structure.nodes;
        nodes.iter().map(|node| (node.place - nodes[0].place).norm()).fold(0.0, f64::max)
    }
}

fn side(anchor: &Anchor, assembly: &Assembly, net: &Net<'_>) -> Result<Side, Problem> {
    let Anchor::Nodes { part, nodes } = anchor else {
        return if assembly.carrier.is_some() { Ok(None) } else { Err(Problem::NoCarrier) };
    };
    if nodes.is_empty() {
        return Err(Problem::NoNodes);
    }
    let number = |node: &usize| {
        let reference = NodeRef { part: *part, node: *node };
        assembly.has(reference).map(|()| net.index(reference))
    };
    nodes.iter().map(number).collect::<Result<_, _>>().map(Some)
}

/// Joins each node of one side to the node of the other side that is at the same place.
fn weld(net: &mut Net<'_>, base: &[usize], nodes: &[usize]) -> Result<(), Problem> {
    let tolerance = SAME_PLACE * net.size();
    for node in nodes {
        let place = net.structure.nodes[*node].place;
        let distance = |other: &usize| (net.structure.nodes[*other].place - place).norm();
        let nearest = base.iter().copied().min_by(|a, b| distance(a).total_cmp(&distance(b)));
        match nearest {
            Some(partner) if distance(&partner) <= tolerance => net.hold(*node, Some(partner), Vec::new())?,
            _ => {
                let distance = nearest.as_ref().map_or(f64::INFINITY, distance);
                return Err(Problem::NoPartner { node: net.node_name(*node), distance });
            }
        }
    }
    Ok(())
}

fn middle(net: &Net<'_>, nodes: &[usize]) -> Vector3<f64> {
    nodes.iter().map(|node| net.structure.nodes[*node].place).sum::<Vector3<f64>>() / nodes.len() as f64
}
