//! A beam on a hub of nearly infinite inertia, with a name for every node; and the beam with straight paths.

use nalgebra::{Matrix3, Vector3};
use quasirigid::elements::{
    ApplicationPoint, Assembly, Frame, FrameNode, Material, Member, Part, PartKind, PartReduction,
    SectionShape,
};
use quasirigid::model::force::Force;
use quasirigid::model::{BodyParts, FlexibleBody, Invariants, Pair};
use quasirigid_math::sparse::SparseRows;

use super::common::turned_axes;
use crate::support::parts;

/// A beam from the centre of a hub outwards, along the first of the rotated axes.
#[derive(Clone)]
pub struct Cantilever {
    pub length: f64,
    /// Even number of elements.
    pub elements: usize,
    pub section: SectionShape,
    pub material: Material,
    /// Inertia of the hub, equal about each axis.
    pub hub: f64,
    pub reduction: PartReduction,
}

/// Place at which the beam is clamped.
const ROOT: [f64; 3] = [0.4, -1.1, 0.7];

impl Cantilever {
    /// The hub with the beam, and forces on it.
    pub fn assembly(&self, forces: Vec<Force<ApplicationPoint>>) -> Assembly {
        let along = turned_axes() * Vector3::x();
        let places = (0..=self.elements).map(|node| self.length * node as f64 / self.elements as f64);
        let places = places.map(|x| Vector3::from(ROOT) + x * along);
        let nodes =
            places.enumerate().map(|(i, place)| FrameNode { name: format!("{i}"), position: place.into() });
        let member = |node: usize| Member {
            name: String::new(),
            ends: [node, node + 1],
            section: self.section,
            up: Some((turned_axes() * Vector3::y()).into()),
            material: self.material.clone(),
            elements: 1,
        };
        let members = (0..self.elements).map(member).collect();
        let kind = PartKind::Frame(Frame { nodes: nodes.collect(), members });
        let part =
            Part { name: "beam".to_owned(), kind, masses: Vec::new(), attached: vec![0], rayleigh: [0.0; 2] };
        let carrier = parts::carrier(
            self.hub / (self.length * self.length),
            ROOT,
            (self.hub * Matrix3::identity()).into(),
        );
        let reduction = self.reduction;
        Assembly { carrier: Some(carrier), parts: vec![part], forces, reduction, ..Assembly::default() }
    }

    /// The body with paths made straight: linear kinematics, which lose the work of loads on the second order.
    ///
    /// Products of displacements are integrals along the beam by Simpson's rule over the nodes.
    pub fn straightened(&self, body: &FlexibleBody) -> FlexibleBody {
        let size = body.coordinates().len();
        let mut shapes = vec![vec![Vector3::zeros(); size]; self.elements + 1];
        for (node, marker) in shapes.iter_mut().zip(body.markers()) {
            marker.shapes.iter().for_each(|(j, shape)| node[*j] = Vector3::from(*shape));
        }
        let step = self.line_density() * self.length / self.elements as f64 / 3.0;
        let weight = |node: usize| match node {
            0 => step,
            node if node == self.elements => step,
            node => step * if node % 2 == 1 { 4.0 } else { 2.0 },
        };
        let pair = |j: usize, k: usize, A: f64| {
            let products = shapes.iter().enumerate();
            let W: Matrix3<f64> = products.map(|(node, u)| weight(node) * u[j] * u[k].transpose()).sum();
            let turned = W.trace() * Matrix3::identity() - 0.5 * (W + W.transpose());
            let Z = [W[(1, 2)] - W[(2, 1)], W[(2, 0)] - W[(0, 2)], W[(0, 1)] - W[(1, 0)]];
            let entries = [(0, 0), (1, 1), (2, 2), (1, 2), (2, 0), (0, 1)];
            (j, k, Pair { A, J2: entries.map(|entry| turned[entry]), Z, S2: [0.0; 3] })
        };
        let straight = body.invariants().pairs.iter().map(|(j, k, curved)| pair(j, k, curved.A)).collect();
        let pairs = SparseRows::sum(size, straight);
        FlexibleBody::new(BodyParts {
            support: body.support().clone(),
            pole: body.pole(),
            center_of_mass: body.center_of_mass(),
            invariants: Invariants { pairs, ..body.invariants().clone() },
            damping: body.damping().clone(),
            stiffness: body.stiffness().clone(),
            viscoelastic: body.viscoelastic().to_vec(),
            dissipators: body.dissipators().to_vec(),
            memories: Vec::new(),
            coordinates: body.coordinates().to_vec(),
            cyclic: 0,
            wheels: body.wheels().clone(),
            drives: Vec::new(),
            markers: body.markers().to_vec(),
        })
        .unwrap()
    }

    /// Displacement of the tip in the rotated axes: along the beam, across it in the plane of the rotation, and along the spin.
    pub fn tip(&self, body: &FlexibleBody, q: &[f64]) -> Vector3<f64> {
        turned_axes().inverse() * Vector3::from(body.markers()[self.elements].displacement(q))
    }

    /// The same of small displacements.
    pub fn tip_shape(&self, body: &FlexibleBody, q: &[f64]) -> Vector3<f64> {
        let shapes = &body.markers()[self.elements].shapes;
        let displacement: Vector3<f64> = shapes.iter().map(|(j, shape)| q[*j] * Vector3::from(*shape)).sum();
        turned_axes().inverse() * displacement
    }

    fn line_density(&self) -> f64 {
        let SectionShape::General { area, .. } = self.section else { panic!("a section by its constants") };
        self.material.density * area
    }
}
