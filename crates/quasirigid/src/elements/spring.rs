use std::collections::BTreeMap;

use nalgebra::{Matrix3, Vector3};

use super::error::{ElementError, ElementId, ElementKind, Field, Problem, at};
use super::hinged::PlaceRef;
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
    /// A place on a hinged appendage.
    Hinged(PlaceRef),
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
        /// What it pulls with at rest.
        prestress: Prestress,
    },
}

/// What an axial spring pulls with while the body is at rest. (I10)
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Prestress {
    /// Nothing.
    #[default]
    Relaxed,
    /// A tension (N), negative in a strut under pressure.
    Tension(f64),
    /// What the stiffness makes of a length that it would have without load (m).
    NaturalLength(f64),
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
    /// Places on hinged appendages.
    pub places: &'a BTreeMap<PlaceRef, Pulled>,
}

/// A node at which something pulls.
pub(super) struct Pulled {
    pub name: String,
    /// Equilibrium position (m), in the file's frame.
    pub place: Vector3<f64>,
    /// Coordinates that move it, with the displacement per unit of each.
    pub shapes: Vec<(usize, [f64; 3])>,
    /// Curvature of its path for pairs of them, where that is known.
    pub curvature: Vec<(usize, usize, [f64; 3])>,
}

/// A spring under tension at rest.
pub(super) struct Pull {
    /// Its stiffness across its line and along curved paths.
    pub block: Block,
    /// Generalised force of the tension, coordinate by coordinate. (I10)
    pub forces: Vec<(usize, f64)>,
}

impl Spring {
    /// Accepts the spring of a body.
    pub(super) fn check(&self, index: usize, body: &Assembly) -> Result<(), ElementError> {
        let place = ElementKind::Spring.at(index);
        for (end, field) in [(self.from, Field::From), (self.to, Field::To)] {
            match end {
                End::Node(node) => body.has(node).map_err(at(place, field))?,
                End::Hinged(on) => body.has_place(on).map(drop).map_err(at(place, field))?,
                End::Carrier if body.carrier.is_none() => return Err(at(place, field)(Problem::NoCarrier)),
                End::Carrier | End::Point(_) => {}
            }
        }
        let named = |end| if let End::Node(node) = end { Some(node) } else { None };
        let pulled = |node: NodeRef| {
            let nodes = body.parts[node.part].nodes();
            (node, Pulled::at(nodes[node.node].place))
        };
        let nodes = [self.from, self.to].into_iter().filter_map(named).map(pulled).collect();
        let starts = vec![0; body.points.len()];
        let places = [self.from, self.to].into_iter().filter_map(|end| match end {
            End::Hinged(on) => Some((on, Pulled::at(body.has_place(on).ok()?.into()))),
            _ => None,
        });
        let places = places.collect();
        let ends = Ends { points: &body.points, starts: &starts, nodes: &nodes, places: &places };
        self.block(index, String::new(), &ends)?;
        self.pull(index, String::new(), &ends).map(drop)
    }

    /// What its tension at rest does, if it has one. (I10)
    pub(super) fn pull(
        &self,
        index: usize,
        name: String,
        ends: &Ends<'_>,
    ) -> Result<Option<Pull>, ElementError> {
        let place = ElementKind::Spring.at(index);
        let Law::Axial { stiffness, prestress, .. } = self.law else { return Ok(None) };
        if prestress == Prestress::Relaxed {
            return Ok(None);
        }
        let from = self.place_of(self.from, ends).map_err(at(place, Field::From))?;
        let to = self.place_of(self.to, ends).map_err(at(place, Field::To))?;
        let length = (to - from).norm();
        let tension = match prestress {
            Prestress::Relaxed => 0.0,
            Prestress::Tension(tension) => tension,
            Prestress::NaturalLength(natural) => stiffness * (length - natural),
        };
        coefficient::finite(&[tension]).map_err(at(place, Field::Tension))?;
        if matches!(self.from, End::Node(_)) || matches!(self.to, End::Node(_)) {
            return Err(at(place, Field::Tension)(Problem::TensionOnPart));
        }
        let n = (to - from) / length;
        let across = tension / length * (Matrix3::identity() - n * n.transpose());
        let moved = self.moved(ends)?;
        let row = |e: &Vector3<f64>| moved.iter().map(|(_, f)| e.dot(&(across * f))).collect();
        let mut block = Block {
            name,
            rheology: Rheology::Elastic,
            stiffness: moved.iter().map(|(_, e)| row(e)).collect(),
            damping: vec![vec![0.0; moved.len()]; moved.len()],
            columns: moved.iter().map(|(column, _)| *column).collect(),
        };
        for (end, sign) in [(self.from, -1.0), (self.to, 1.0)] {
            let End::Hinged(on) = end else { continue };
            for (j, k, G) in ends.places.get(&on).map(|place| place.curvature.as_slice()).unwrap_or_default()
            {
                let at = |column: usize| block.columns.iter().position(|other| *other == column);
                if let (Some(row), Some(column)) = (at(*j), at(*k)) {
                    block.stiffness[row][column] += sign * tension * n.dot(&Vector3::from(*G));
                }
            }
        }
        let forces = moved.iter().map(|(column, e)| (*column, tension * n.dot(e))).collect();
        Ok(Some(Pull { block, forces }))
    }

    /// Displacement of the end `from` relative to the other, per unit of each coordinate.
    fn moved(&self, ends: &Ends<'_>) -> Result<Vec<(usize, Vector3<f64>)>, ElementError> {
        let mut moved = Vec::new();
        for (end, sign) in [(self.from, 1.0), (self.to, -1.0)] {
            moved.extend(ends.shapes(end)?.into_iter().map(|(column, e)| (column, sign * e)));
        }
        Ok(moved)
    }

    /// Stiffness and damping over the coordinates of both ends, as a dissipator of this name. (I9)
    pub(super) fn block(&self, index: usize, name: String, ends: &Ends<'_>) -> Result<Block, ElementError> {
        let place = ElementKind::Spring.at(index);
        if self.from == self.to {
            return Err(at(place, Field::To)(Problem::SameEnds));
        }
        let places = [(self.from, Field::From), (self.to, Field::To)]
            .map(|(end, field)| self.place_of(end, ends).map_err(at(place, field)));
        let [from, to] = places;
        let (stiffness, damping) = self.matrices(place, [from?, to?])?;
        let moved = self.moved(ends)?;
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
        place: ElementId,
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
            (End::Hinged(on), _) => ends.places.get(&on).map_or([0.0; 3], |pulled| pulled.place.into()),
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
                let directions = directions.map_err(at(ElementKind::Point.at(index), Field::Motion))?;
                let start = self.starts[index];
                directions.iter().enumerate().map(|(j, (e, _))| (start + j, *e)).collect()
            }
            End::Node(node) => self.nodes.get(&node).map(Pulled::vectors).unwrap_or_default(),
            End::Hinged(on) => self.places.get(&on).map(Pulled::vectors).unwrap_or_default(),
        };
        Ok(shapes)
    }
}

impl Pulled {
    /// A place that nothing moves.
    pub fn at(place: Vector3<f64>) -> Self {
        Self { name: String::new(), place, shapes: Vec::new(), curvature: Vec::new() }
    }

    fn vectors(&self) -> Vec<(usize, Vector3<f64>)> {
        self.shapes.iter().map(|(column, shape)| (*column, Vector3::from(*shape))).collect()
    }

    /// The node as a place on the body, from the pole.
    pub fn marker(&self, pole: Vector3<f64>) -> Marker {
        Marker {
            name: self.name.clone(),
            position: (self.place - pole).into(),
            shapes: self.shapes.clone(),
            curvature: Vec::new(),
        }
    }
}
