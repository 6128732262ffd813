//! Assembly without a carrier: builds its flexible body from parts, points and springs.
//! Nothing rigid fixes the frame: it is the Tisserand frame, unless a part of modes brings a frame of its own.
//! Equations (G2), docs/theory/11-materials.md, and (K7), docs/theory/12-structures.md.

use std::collections::BTreeMap;

use nalgebra::Vector3;

use super::{Assembly, Built};
use crate::NodeRef;
use crate::contribution::Exact;
use crate::contribution::Matrices;
use crate::contribution::{Attachment, Attachments};
use crate::error::{ElementError, ElementId, ElementKind, Field, Problem, at};
use crate::kinds::part::Part;
use crate::kinds::part::PartGraph;
use crate::math::sparse::SparseRows;
use crate::model::control::Controls;
use crate::model::force::Force;
use crate::model::{BodyParts, FlexibleBody, Invariants, Marker, Support, Watched, Wheels};
use crate::structure::Component;
use crate::visual::Vertex;
use crate::{ApplicationPoint, End};

impl Assembly {
    /// A body without a carrier: parts, points and springs, in their Tisserand frame, or in that of modes.
    pub(crate) fn floating(
        &self,
        forces: &[Force<ApplicationPoint>],
        exact: Option<Exact<'_>>,
        visuals: bool,
    ) -> Result<Built, ElementError> {
        if self.parts.is_empty() && self.points.len() < 3 {
            return Err(at(ElementId::CARRIER, Field::MASS)(Problem::NoBody));
        }
        self.free()?;
        let mut graph = PartGraph::of_everything(self)?;
        if visuals {
            let node = |end| match end {
                End::Node(node) => Some(node),
                End::Point(node) => Some(NodeRef { part: self.parts.len(), node }),
                End::Carrier | End::Hinged(_) => None,
            };
            graph.draw(self.drawn_ends().into_iter().filter_map(node));
        }
        let component = graph.component(!self.parts.iter().any(Part::is_frame))?;
        let center = exact.as_ref().map_or(component.center(), |exact| exact.center.into());
        let mut invariants = invariants(&component, center);
        if let Some(exact) = &exact {
            (invariants.mass, invariants.J) = (exact.mass, exact.inertia);
        }
        let whole = if self.parts.is_empty() { ElementKind::Point.at(0) } else { ElementKind::Part.at(0) };
        self.has_inertia(whole, &invariants)?;
        let paths = component.curved_paths(center, 0, &invariants);
        let size = component.size();
        let Matrices { stiffness, damping, viscoelastic, dissipators } =
            Matrices::sum(size, component.blocks(0).map(Ok), &[])?;
        let nodes = graph.attachments(&component, 0);
        let reaches = graph.reaches(&nodes);
        let parts = if exact.is_none() { component.part_masses(0, size) } else { Vec::new() };
        let mut attachments = Attachments::default();
        for (node, attachment) in &nodes {
            let point = NodeRef { part: self.parts.len(), node: node.node };
            let end = if *node == point { End::Point(node.node) } else { End::Node(*node) };
            attachments.note(end, attachment.clone());
        }
        let forces = self.placed_forces(forces, center, &attachments)?;
        let drawn = graph.drawn(&component, 0);
        let visuals = if visuals {
            self.visuals_at(center, &places(&drawn, self.parts.len()), &|_| None)
        } else {
            Vec::new()
        };
        let markers: Vec<Marker> = nodes.values().map(|node| node.marker(center)).collect();
        let body = FlexibleBody::new(BodyParts {
            support: Support::Free,
            pole: center.into(),
            center_of_mass: center.into(),
            invariants,
            damping,
            stiffness,
            viscoelastic,
            dissipators,
            memories: Vec::new(),
            coordinates: exact.as_ref().map_or(component.coordinates(), |exact| exact.coordinates(size)),
            cyclic: 0,
            wheels: Wheels::default(),
            drives: Vec::new(),
            markers: match &exact {
                Some(exact) => exact.markers(markers),
                None => markers,
            },
        });
        let body = body.map_err(|error| {
            at(ElementId::CARRIER, Field::STIFFNESS)(Problem::Mechanism { coordinates: error.coordinates() })
        });
        Ok(Built {
            body: body?.along(paths).watching(Watched { reaches, ..Watched::default() }).made_of(parts),
            forces,
            controls: Controls::default(),
            condensation: Some(component.condensation()),
            speeds: Vec::new(),
            liquids: Vec::new(),
            tanks: Vec::new(),
            slugs: Vec::new(),
            resolution: None,
            visuals,
        })
    }
}

/// Places of vertices in a body whose points are the nodes of a part after the others.
fn places(
    drawn: &BTreeMap<NodeRef, Attachment>,
    points: usize,
) -> impl Fn(ElementId, Vertex) -> Option<Attachment> + '_ {
    move |id, vertex| {
        let node = match (id, vertex) {
            (ElementId { kind: ElementKind::Point, index }, Vertex::Own(_)) => {
                NodeRef { part: points, node: index }
            }
            (_, Vertex::At(End::Point(node))) => NodeRef { part: points, node },
            (_, Vertex::At(End::Node(node))) => node,
            _ => return None,
        };
        drawn.get(&node).cloned()
    }
}

fn invariants(component: &Component, pole: Vector3<f64>) -> Invariants {
    let each: Vec<_> = (0..component.size()).map(|j| component.coordinate(j, pole)).collect();
    Invariants {
        mass: component.mass(),
        J: component.inertia(pole),
        S: each.iter().map(|(S, _, _)| *S).collect(),
        h: each.iter().map(|(_, h, _)| *h).collect(),
        J1: each.iter().map(|(_, _, J1)| *J1).collect(),
        pairs: SparseRows::sum(component.size(), component.pairs(pole, 0).collect()),
    }
}
