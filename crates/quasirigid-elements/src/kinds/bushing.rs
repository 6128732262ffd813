//! Bushing: stiffness and damping along and about three axes, between two places, in an elastic centre.
//! Both ends are moved to the centre as rigid pieces, so that a rigid motion strains nothing; an end without rotations must be there.
//! Equation (I11), docs/theory/02-invariants.md.

use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};

use crate::contribution::{Attachment, Floating};
use crate::element::{AttachmentPoint, Element, ElementSite, joined};
use crate::error::{ElementError, ElementId, Field, Problem, at};
use crate::finite::Link;
use crate::kinds::coefficient;
use crate::model::Rheology;
use crate::number;
use crate::structure::Block;
use crate::visual::Outline;
use crate::{Assembly, Coefficient, End, Incomplete};

/// A bushing: springs and dashpots between two places, three along axes of its own and three about them, in an elastic centre. (I11)
///
/// The strain is the displacement and the rotation of the second place relative to the first, both at the centre, to first order in the
/// coordinates; a rigid motion of the whole does not strain it. A material point has no rotation: the centre is at the point, and no moment
/// acts there.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Bushing {
    /// Name; empty for a name made of the ends. Links of the same name are one dissipator.
    pub name: String,
    /// One end.
    pub from: End,
    /// The other end.
    pub to: End,
    /// Elastic centre (m), in the file's frame; none for the place of an end: of one without rotations, else of the first that is not the
    /// carrier.
    pub center: Option<[f64; 3]>,
    /// Direction of the first axis, and one in the plane of the first two, in the file's frame; of any length but zero.
    pub axes: [[f64; 3]; 2],
    /// Stiffness along each axis (N/m).
    pub stiffness: [f64; 3],
    /// Stiffness about each axis (N·m/rad).
    pub rotational_stiffness: [f64; 3],
    /// Damping along each axis (N·s/m).
    pub damping: [f64; 3],
    /// Damping about each axis (N·m·s/rad).
    pub rotational_damping: [f64; 3],
    /// Rheology of the springs: response to periodic strain, beside the damping.
    pub rheology: Rheology,
}

/// Key of the stiffness about the axes.
const ROTATIONAL_STIFFNESS: Field = Field::new("rotational_stiffness");
/// Key of the damping about the axes.
const ROTATIONAL_DAMPING: Field = Field::new("rotational_damping");
/// Length of an arm, as a share of the distances from the origin, below which there is none: rounding of the places in a file.
const NO_ARM: f64 = 1e-9;

impl Bushing {
    /// Force and moment for a strain and for its rate, in the file's axes.
    fn laws(&self, id: ElementId) -> Result<[Matrix6<f64>; 2], ElementError> {
        self.rheology.check().map_err(|error| at(id, Field::RHEOLOGY)(error.into()))?;
        let R = self.rotation().map_err(at(id, Field::AXES))?;
        let law = |along: [f64; 3], about: [f64; 3], fields: [Field; 2]| {
            let mut law = Matrix6::zeros();
            for (block, (values, field)) in [along, about].into_iter().zip(fields).enumerate() {
                let matrix = coefficient::matrix(Coefficient::Diagonal(values)).map_err(at(id, field))?;
                law.fixed_view_mut::<3, 3>(3 * block, 3 * block).copy_from(&(R * matrix * R.transpose()));
            }
            Ok(law)
        };
        Ok([
            law(self.stiffness, self.rotational_stiffness, [Field::STIFFNESS, ROTATIONAL_STIFFNESS])?,
            law(self.damping, self.rotational_damping, [Field::DAMPING, ROTATIONAL_DAMPING])?,
        ])
    }

    /// Axes of the bushing as columns, in the file's frame.
    fn rotation(&self) -> Result<Matrix3<f64>, Problem> {
        let [first, plane] = self.axes;
        let (first, plane) = (number::unit(first)?, number::unit(plane)?);
        let third = number::unit(first.cross(&plane).into()).map_err(|_| Problem::DependentAxes)?;
        Ok(Matrix3::from_columns(&[first, third.cross(&first), third]))
    }

    /// Whether a moment acts in the bushing.
    fn has_moment(&self) -> bool {
        self.rotational_stiffness != [0.0; 3] || self.rotational_damping != [0.0; 3]
    }

    /// Elastic centre (m), in the file's frame, for ends at these places, each with whether it has rotations.
    fn center(&self, places: [(Vector3<f64>, bool); 2]) -> Vector3<f64> {
        let still = places.iter().find(|(_, rotations)| !rotations);
        let moving = [self.from, self.to].iter().position(|end| *end != End::Carrier);
        let usual = still.map_or(places[moving.unwrap_or(0)].0, |(place, _)| *place);
        self.center.map_or(usual, Vector3::from)
    }

    /// Accepts an end at its distance from the centre: an end without rotations is at the centre and bears no moment.
    fn accepts(
        &self,
        end: &str,
        place: Vector3<f64>,
        rotations: bool,
        center: Vector3<f64>,
    ) -> Result<(), Problem> {
        number::finite(center.as_slice())?;
        let distance = (center - place).norm();
        if rotations {
            return Ok(());
        }
        if distance > NO_ARM * (center.norm() + place.norm()) {
            let node = "the centre of the bushing".to_owned();
            return Err(Problem::NoArm { base: end.to_owned(), node, distance });
        }
        if self.has_moment() { Err(Problem::NoTurn { node: end.to_owned() }) } else { Ok(()) }
    }

    /// Stiffness and damping over the coordinates of both ends. (I11)
    fn between(&self, id: ElementId, name: &str, ends: [&Attachment; 2]) -> Result<Block, ElementError> {
        let laws = self.laws(id)?;
        let carried =
            |end: End, place: &Attachment| (place.position, end == End::Carrier || place.rotations.is_some());
        let center = self.center([carried(self.from, ends[0]), carried(self.to, ends[1])]);
        let mut moved = Vec::new();
        for (end, sign, field) in [(ends[0], -1.0, Field::FROM), (ends[1], 1.0, Field::TO)] {
            let known = self.accepts(&end.name, end.position, end.rotations.is_some(), center);
            known.map_err(at(id, field))?;
            moved.extend(end.motion_at(center).into_iter().map(|(column, motion)| (column, sign * motion)));
        }
        Ok(Block::between(name, &self.rheology, &moved, &laws[0], &laws[1]))
    }
}

impl Attachment {
    /// Displacement and rotation, at a centre, of a rigid piece on the attachment, per unit of each coordinate.
    fn motion_at(&self, center: Vector3<f64>) -> Vec<(usize, Vector6<f64>)> {
        let arm = center - self.position;
        let mut motion: Vec<(usize, Vector6<f64>)> = Vec::new();
        for (column, shape) in &self.shapes {
            motion.push((*column, stacked((*shape).into(), Vector3::zeros())));
        }
        for (column, turn) in self.rotations.iter().flatten() {
            let turn = Vector3::from(*turn);
            motion.push((*column, stacked(turn.cross(&arm), turn)));
        }
        motion
    }
}

fn stacked(displacement: Vector3<f64>, rotation: Vector3<f64>) -> Vector6<f64> {
    let [x, y, z] = displacement.into();
    let [a, b, c] = rotation.into();
    Vector6::new(x, y, z, a, b, c)
}

/// Motion at a centre of a node with six degrees of freedom, from its own.
fn transport(arm: Vector3<f64>) -> Matrix6<f64> {
    let mut map = Matrix6::identity();
    map.fixed_view_mut::<3, 3>(0, 3).copy_from(&-arm.cross_matrix());
    map
}

impl Element for Bushing {
    fn check(&self, id: ElementId, body: &Assembly) -> Vec<ElementError> {
        let check = || {
            let [from, to] = joined(id, [self.from, self.to], |end| body.at_rest(end))?;
            self.between(id, "", [&from, &to]).map(drop)
        };
        check().err().into_iter().collect()
    }

    fn incomplete(&self) -> Vec<Incomplete> {
        let placed = [self.from, self.to].iter().any(|end| matches!(end, End::Hinged(_)));
        if placed { vec![Incomplete::SpringsOnAppendages] } else { Vec::new() }
    }

    fn rheologies_mut(&mut self) -> Vec<&mut Rheology> {
        vec![&mut self.rheology]
    }

    fn attachment_points(&self) -> Vec<AttachmentPoint> {
        let ends = [(Field::FROM, self.from), (Field::TO, self.to)];
        ends.map(|(field, end)| AttachmentPoint { field, end, moment: true }).to_vec()
    }

    fn outline(&self, _: ElementId, body: &Assembly) -> Option<Outline> {
        Outline::link(body, [self.from, self.to], self.center)
    }

    fn block(&self, site: &ElementSite<'_>) -> Result<Option<Block>, ElementError> {
        self.between(site.id, site.name, site.ends(self.from, self.to)?).map(Some)
    }

    fn afloat(&self, id: ElementId, graph: &mut dyn Floating) -> Result<(), ElementError> {
        let [from, to] = joined(id, [self.from, self.to], |end| graph.node_at(end))?;
        let laws = self.laws(id)?;
        let nodes = [from, to].map(|node| graph.structure().nodes[node]);
        let center = self.center(nodes.map(|node| (node.place, node.rotations)));
        for (node, number, field) in [(nodes[0], from, Field::FROM), (nodes[1], to, Field::TO)] {
            self.accepts(&graph.node_name(number), node.place, node.rotations, center)
                .map_err(at(id, field))?;
        }
        let material = graph.material(&self.rheology);
        let link = if nodes.iter().all(|node| node.rotations) {
            let [a, b] = nodes.map(|node| transport(center - node.place));
            Link::new([from, to], material, [-a, b], laws)
        } else {
            let distance = (nodes[1].place - nodes[0].place).norm();
            if distance > NO_ARM * (nodes[0].place.norm() + nodes[1].place.norm()) {
                let [base, node] = if nodes[0].rotations { [to, from] } else { [from, to] };
                let (base, node) = (graph.node_name(base), graph.node_name(node));
                return Err(at(id, Field::TO)(Problem::NoArm { base, node, distance }));
            }
            let laws = laws.map(|law| -> Matrix3<f64> { law.fixed_view::<3, 3>(0, 0).into_owned() });
            Link::new([from, to], material, [-Matrix3::identity(), Matrix3::identity()], laws)
        };
        graph.structure().elements.push(Box::new(link));
        Ok(())
    }
}
