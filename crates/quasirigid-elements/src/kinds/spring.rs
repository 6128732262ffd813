//! Spring with a dashpot between two places: spatial or axial, relaxed or under tension.
//! A tension at rest acts on the second order of the displacement: it adds stiffness across its line, and tensions must balance.
//! Equations (I9) and (I10), docs/theory/02-invariants.md.

use nalgebra::{Matrix3, Vector3};

use crate::End;
use crate::contribution::{Attachment, Floating};
use crate::element::{AttachmentPoint, Element, ElementSite, Preload, joined};
use crate::error::{ElementError, ElementId, Field, Problem, at};
use crate::finite::Link;
use crate::kinds::coefficient;
use crate::model::Rheology;
use crate::number;
use crate::structure::Block;
use crate::visual::Outline;
use crate::{Assembly, Incomplete};

/// A linear spring with a linear dashpot beside it, between two ends.
///
/// The spring acts on the displacement of one end relative to the other, taken in body axes, so a body that rotates steadily does not work
/// it.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, PartialEq)]
pub struct Spring {
    /// Name; empty for a name made of the ends. Springs of the same name are one dissipator.
    pub name: String,
    /// One end.
    pub from: End,
    /// The other end.
    pub to: End,
    /// Force per displacement and force per rate.
    pub law: SpringLaw,
    /// Rheology of the spring itself: response to periodic strain, beside the dashpot.
    pub rheology: Rheology,
}

/// Stiffness and damping of a spring.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SpringLaw {
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
        /// Place of the carrier's end (m, file's frame); needed when one end is the carrier.
        anchor: Option<[f64; 3]>,
        /// Load at rest.
        prestress: Prestress,
    },
}

/// Load of an axial spring while the body is at rest. (I10)
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Prestress {
    /// Nothing.
    #[default]
    Relaxed,
    /// A tension (N), negative in a strut under pressure.
    Tension(f64),
    /// Tension from the stiffness and a natural length without load (m).
    NaturalLength(f64),
}

/// A symmetric linear map from displacement to force.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Coefficient {
    /// Equal in every direction.
    Isotropic(f64),
    /// One value per axis of the file's frame.
    Diagonal([f64; 3]),
    /// Full symmetric matrix in the axes of the file's frame.
    Full([[f64; 3]; 3]),
}

impl Spring {
    /// Load at rest, if the spring has one. (I10)
    fn tension(&self, id: ElementId, ends: [&Attachment; 2]) -> Result<Option<Tension>, ElementError> {
        let SpringLaw::Axial { stiffness, prestress, .. } = self.law else { return Ok(None) };
        if prestress == Prestress::Relaxed {
            return Ok(None);
        }
        let [from, to] = self.places(id, ends)?;
        let length = (to - from).norm();
        let tension = match prestress {
            Prestress::Relaxed => 0.0,
            Prestress::Tension(tension) => tension,
            Prestress::NaturalLength(natural) => stiffness * (length - natural),
        };
        number::finite(&[tension]).map_err(at(id, Field::TENSION))?;
        if matches!(self.from, End::Node(_)) || matches!(self.to, End::Node(_)) {
            return Err(at(id, Field::TENSION)(Problem::TensionOnPart));
        }
        Ok(Some(Tension { tension, length, direction: (to - from) / length }))
    }

    /// Stiffness and damping over the coordinates of both ends. (I9)
    fn elastic(&self, id: ElementId, name: &str, ends: [&Attachment; 2]) -> Result<Block, ElementError> {
        let (stiffness, damping) = self.matrices(id, self.places(id, ends)?)?;
        Ok(Block::between(name, &self.rheology, &moved(ends), &stiffness, &damping))
    }

    /// Force for a displacement of one end relative to the other and for its rate, with the ends at these places.
    fn matrices(
        &self,
        id: ElementId,
        [from, to]: [Vector3<f64>; 2],
    ) -> Result<(Matrix3<f64>, Matrix3<f64>), ElementError> {
        self.rheology.check().map_err(|error| at(id, Field::RHEOLOGY)(error.into()))?;
        let (stiffness, damping, direction) = match self.law {
            SpringLaw::Spatial { stiffness, damping } => (stiffness, damping, None),
            SpringLaw::Axial { stiffness, damping, .. } => {
                let line =
                    number::unit((to - from).into()).map_err(|_| at(id, Field::TO)(Problem::NoLine))?;
                (Coefficient::Isotropic(stiffness), Coefficient::Isotropic(damping), Some(line))
            }
        };
        let stiffness = coefficient::matrix(stiffness).map_err(at(id, Field::STIFFNESS))?;
        let damping = coefficient::matrix(damping).map_err(at(id, Field::DAMPING))?;
        let along = direction.map_or(Matrix3::identity(), |n| n * n.transpose());
        Ok((along * stiffness * along, along * damping * along))
    }

    /// Places of the ends; the carrier's end of a spring that is not axial may be anywhere.
    fn places(&self, id: ElementId, [from, to]: [&Attachment; 2]) -> Result<[Vector3<f64>; 2], ElementError> {
        let place = |end: End, attachment: &Attachment| {
            let place = match (end, self.law) {
                (End::Carrier, SpringLaw::Axial { anchor, .. }) => anchor.ok_or(Problem::NoAnchor)?.into(),
                _ => attachment.position,
            };
            number::finite(place.as_slice()).map(|()| place)
        };
        let from = place(self.from, from).map_err(at(id, Field::FROM))?;
        Ok([from, place(self.to, to).map_err(at(id, Field::TO))?])
    }
}

/// Load of a spring at rest.
struct Tension {
    /// Tension (N).
    tension: f64,
    /// Length at rest (m).
    length: f64,
    /// Direction from the first end to the second.
    direction: Vector3<f64>,
}

impl Tension {
    /// Stiffness across the line and along curved paths, and generalised force. (I10)
    fn preload(&self, name: &str, ends: [&Attachment; 2]) -> Preload {
        let Self { tension, length, direction: n } = self;
        let across = *tension / *length * (Matrix3::identity() - n * n.transpose());
        let moved = moved(ends);
        let mut block = Block::between(name, &Rheology::Elastic, &moved, &across, &Matrix3::zeros());
        for (end, sign) in ends.into_iter().zip([-1.0, 1.0]) {
            for (j, k, G) in &end.curvature {
                let at = |column: usize| block.columns.iter().position(|other| *other == column);
                if let (Some(row), Some(column)) = (at(*j), at(*k)) {
                    block.stiffness[row][column] += sign * tension * n.dot(&Vector3::from(*G));
                }
            }
        }
        let forces = moved.iter().map(|(column, e)| (*column, tension * n.dot(e))).collect();
        Preload { block, forces }
    }
}

/// Displacement of the first end relative to the second, per unit of each coordinate.
fn moved([from, to]: [&Attachment; 2]) -> Vec<(usize, Vector3<f64>)> {
    let signed = |end: &Attachment, sign: f64| {
        let shapes = end.shapes.iter().map(|(column, shape)| (*column, sign * Vector3::from(*shape)));
        shapes.collect::<Vec<_>>()
    };
    [signed(from, 1.0), signed(to, -1.0)].concat()
}

impl Element for Spring {
    fn check(&self, id: ElementId, body: &Assembly) -> Vec<ElementError> {
        let check = || {
            let [from, to] = joined(id, [self.from, self.to], |end| body.at_rest(end))?;
            self.elastic(id, "", [&from, &to])?;
            self.tension(id, [&from, &to]).map(drop)
        };
        check().err().into_iter().collect()
    }

    fn incomplete(&self) -> Vec<Incomplete> {
        let axial = matches!(self.law, SpringLaw::Axial { .. }).then_some(Incomplete::AxialSprings);
        let placed = [self.from, self.to].iter().any(|end| matches!(end, End::Hinged(_)));
        axial.into_iter().chain(placed.then_some(Incomplete::SpringsOnAppendages)).collect()
    }

    fn rheologies_mut(&mut self) -> Vec<&mut Rheology> {
        vec![&mut self.rheology]
    }

    fn attachment_points(&self) -> Vec<AttachmentPoint> {
        vec![AttachmentPoint::force(Field::FROM, self.from), AttachmentPoint::force(Field::TO, self.to)]
    }

    fn outline(&self, _: ElementId, body: &Assembly) -> Option<Outline> {
        let anchor = if let SpringLaw::Axial { anchor, .. } = self.law { anchor } else { None };
        Outline::link(body, [self.from, self.to], anchor)
    }

    fn block(&self, site: &ElementSite<'_>) -> Result<Option<Block>, ElementError> {
        self.elastic(site.id, site.name, site.ends(self.from, self.to)?).map(Some)
    }

    fn preload(&self, site: &ElementSite<'_>) -> Result<Option<Preload>, ElementError> {
        let ends = site.ends(self.from, self.to)?;
        Ok(self.tension(site.id, ends)?.map(|tension| tension.preload(site.name, ends)))
    }

    fn afloat(&self, id: ElementId, graph: &mut dyn Floating) -> Result<(), ElementError> {
        let nodes = joined(id, [self.from, self.to], |end| graph.node_at(end))?;
        if matches!(self.law, SpringLaw::Axial { prestress, .. } if prestress != Prestress::Relaxed) {
            return Err(at(id, Field::TENSION)(Problem::TensionAfloat));
        }
        let places = nodes.map(|node| graph.structure().nodes[node].place);
        let (stiffness, damping) = self.matrices(id, places)?;
        let material = graph.material(&self.rheology);
        let strain = [-Matrix3::identity(), Matrix3::identity()];
        let link = Link::new(nodes, material, strain, [stiffness, damping]);
        graph.structure().elements.push(Box::new(link));
        Ok(())
    }
}
