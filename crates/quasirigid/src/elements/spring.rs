use std::collections::BTreeMap;

use nalgebra::{Matrix3, Vector3};

use super::error::{ElementError, Field, Place, Problem, at};
use super::matrices::Block;
use super::part::NodeRef;
use super::{Assembly, Point, coefficient};
use crate::model::{Marker, Rheology};

/// A linear spring with a linear dashpot beside it, between two ends.
///
/// It acts on the displacement of one end relative to the other, taken in body axes, so a body that turns
/// steadily does not work it.
#[derive(Clone, Debug, PartialEq)]
pub struct Spring {
    /// Name; empty if it is called after its ends. Springs of the same name are one dissipator.
    pub name: String,
    /// One end.
    pub from: End,
    /// The other end.
    pub to: End,
    /// Force per displacement and force per rate.
    pub law: Law,
    /// How the spring itself answers periodic strain, beside the dashpot.
    pub rheology: Rheology,
}

/// What an end of a spring is fixed to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// The carrier.
    Carrier,
    /// The point with this index in [`Assembly::points`](super::Assembly::points).
    Point(usize),
    /// A node of a part.
    Node(NodeRef),
}

/// Stiffness and damping of a spring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Law {
    /// Force `−(stiffness · r + damping · ṙ)` for a relative displacement `r`.
    Spatial {
        /// Stiffness (N/m).
        stiffness: Coefficient,
        /// Damping (N·s/m).
        damping: Coefficient,
    },
    /// Force along the line that joins the ends at equilibrium, and none across it.
    Axial {
        /// Stiffness (N/m).
        stiffness: f64,
        /// Damping (N·s/m).
        damping: f64,
        /// Where the carrier's end sits (m, file's frame); needed when one end is the carrier.
        anchor: Option<[f64; 3]>,
    },
}

/// A symmetric linear map from displacement to force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Coefficient {
    /// The same in every direction.
    Isotropic(f64),
    /// One value per axis of the file's frame.
    Diagonal([f64; 3]),
    /// Full symmetric matrix in the axes of the file's frame.
    Full([[f64; 3]; 3]),
}

/// Points and nodes that springs may join, with the coordinates that move them.
pub(super) struct Ends<'a> {
    pub points: &'a [Point],
    /// First coordinate of each point.
    pub starts: &'a [usize],
    pub nodes: &'a BTreeMap<NodeRef, Pulled>,
}

/// A node at which something pulls.
pub(super) struct Pulled {
    pub name: String,
    /// Equilibrium position (m), in the file's frame.
    pub place: Vector3<f64>,
    /// Coordinates that move it, with the displacement per unit of each.
    pub shapes: Vec<(usize, [f64; 3])>,
}

impl Spring {
    /// Accepts the spring of a body.
    pub(super) fn check(&self, index: usize, body: &Assembly) -> Result<(), ElementError> {
        let place = Place::Spring(index);
        for (end, field) in [(self.from, Field::From), (self.to, Field::To)] {
            match end {
                End::Node(node) => body.has(node).map_err(at(place, field))?,
                End::Carrier if body.carrier.is_none() => return Err(at(place, field)(Problem::NoCarrier)),
                End::Carrier | End::Point(_) => {}
            }
        }
        let named = |end| if let End::Node(node) = end { Some(node) } else { None };
        let pulled = |node: NodeRef| {
            let nodes = body.parts[node.part].nodes();
            (node, Pulled { name: String::new(), place: nodes[node.node].place, shapes: Vec::new() })
        };
        let nodes = [self.from, self.to].into_iter().filter_map(named).map(pulled).collect();
        let starts = vec![0; body.points.len()];
        let ends = Ends { points: &body.points, starts: &starts, nodes: &nodes };
        self.block(index, String::new(), &ends).map(drop)
    }

    /// Stiffness and damping over the coordinates of both ends, as a dissipator of this name. (I9)
    pub(super) fn block(&self, index: usize, name: String, ends: &Ends<'_>) -> Result<Block, ElementError> {
        let place = Place::Spring(index);
        if self.from == self.to {
            return Err(at(place, Field::To)(Problem::SameEnds));
        }
        let places = [(self.from, Field::From), (self.to, Field::To)]
            .map(|(end, field)| self.place_of(end, ends).map_err(at(place, field)));
        let [from, to] = places;
        let (stiffness, damping) = self.matrices(place, [from?, to?])?;
        let mut moved = Vec::new();
        for (end, sign) in [(self.from, 1.0), (self.to, -1.0)] {
            moved.extend(ends.shapes(end)?.into_iter().map(|(column, e)| (column, sign * e)));
        }
        let form = |matrix: Matrix3<f64>| {
            let row = |e: &Vector3<f64>| moved.iter().map(|(_, f)| e.dot(&(matrix * f))).collect();
            moved.iter().map(|(_, e)| row(e)).collect()
        };
        Ok(Block {
            name,
            rheology: self.rheology.clone(),
            stiffness: form(stiffness),
            damping: form(damping),
            columns: moved.iter().map(|(column, _)| *column).collect(),
        })
    }

    /// Force for a displacement of one end relative to the other and for its rate, with the ends at these places.
    pub(super) fn matrices(
        &self,
        place: Place,
        [from, to]: [Vector3<f64>; 2],
    ) -> Result<(Matrix3<f64>, Matrix3<f64>), ElementError> {
        self.rheology.check().map_err(|error| at(place, Field::Rheology)(error.into()))?;
        let (stiffness, damping, direction) = match self.law {
            Law::Spatial { stiffness, damping } => (stiffness, damping, None),
            Law::Axial { stiffness, damping, .. } => {
                let line = coefficient::unit((to - from).into())
                    .map_err(|_| at(place, Field::To)(Problem::NoLine))?;
                (Coefficient::Isotropic(stiffness), Coefficient::Isotropic(damping), Some(line))
            }
        };
        let stiffness = coefficient::matrix(stiffness).map_err(at(place, Field::Stiffness))?;
        let damping = coefficient::matrix(damping).map_err(at(place, Field::Damping))?;
        let along = direction.map_or(Matrix3::identity(), |n| n * n.transpose());
        Ok((along * stiffness * along, along * damping * along))
    }

    /// Where an end is; the carrier's end of a spring that is not axial may be anywhere.
    fn place_of(&self, end: End, ends: &Ends<'_>) -> Result<Vector3<f64>, Problem> {
        let place = match (end, self.law) {
            (End::Carrier, Law::Axial { anchor, .. }) => anchor.ok_or(Problem::NoAnchor)?,
            (End::Carrier, Law::Spatial { .. }) => [0.0; 3],
            (End::Point(index), _) => ends.points.get(index).ok_or(Problem::NoSuchPoint { index })?.position,
            (End::Node(node), _) => ends.nodes.get(&node).map_or([0.0; 3], |pulled| pulled.place.into()),
        };
        coefficient::finite(&place)?;
        Ok(place.into())
    }
}

impl Ends<'_> {
    /// Displacement of an end per unit of each coordinate that moves it.
    fn shapes(&self, end: End) -> Result<Vec<(usize, Vector3<f64>)>, ElementError> {
        let shapes = match end {
            End::Carrier => Vec::new(),
            End::Point(index) => {
                let directions = self.points[index].directions();
                let directions = directions.map_err(at(Place::Point(index), Field::Motion))?;
                let start = self.starts[index];
                directions.iter().enumerate().map(|(j, (e, _))| (start + j, *e)).collect()
            }
            End::Node(node) => {
                let shapes = self.nodes.get(&node).map(|pulled| pulled.shapes.as_slice()).unwrap_or_default();
                shapes.iter().map(|(column, shape)| (*column, Vector3::from(*shape))).collect()
            }
        };
        Ok(shapes)
    }
}

impl Pulled {
    /// The node as a place on the body, from the pole.
    pub fn marker(&self, pole: Vector3<f64>) -> Marker {
        Marker { name: self.name.clone(), position: (self.place - pole).into(), shapes: self.shapes.clone() }
    }
}
