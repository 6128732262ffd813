//! Orientations and transformations: axes of materials and of displacements, rectangular, cylindrical or spherical.

use quasirigid_math::vec3::{add, cross, dot, minus, norm, scale, unit};

use super::Reader;
use super::fields::reals;
use crate::deck::across;
use crate::matrix::MatrixProblem;
use crate::matrix::listed::LocatedProblem;
use crate::mesh::inp::{InpCard, Placing};

/// Axes that an orientation gives.
#[derive(Clone, Copy)]
pub(super) struct Orientation {
    kind: Kind,
    /// Two points, of the first axis and of its plane or of the axis of a cylinder, and the origin.
    points: [[f64; 3]; 3],
    /// A further rotation (degrees) about axis 1, 2 or 3.
    turn: Option<(usize, f64)>,
    line: usize,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Rectangular,
    Cylindrical,
    Spherical,
}

/// Sine of the angle below which two directions are one.
const PARALLEL: f64 = 1e-9;

impl Orientation {
    fn read(card: &InpCard, kind: Option<&str>) -> Result<Self, LocatedProblem> {
        let kind = match kind.and_then(|kind| kind.chars().next()).map(|letter| letter.to_ascii_uppercase()) {
            Some('C') => Kind::Cylindrical,
            Some('S') => Kind::Spherical,
            _ => Kind::Rectangular,
        };
        let mut numbers = card.lines.first().map(reals).transpose()?.unwrap_or_default();
        numbers.resize(9, 0.0);
        let point = |at: usize| [numbers[at], numbers[at + 1], numbers[at + 2]];
        let turn = match card.lines.get(1).map(reals).transpose()?.as_deref() {
            Some([axis, angle, ..]) if (1.0..=3.0).contains(axis) => Some((*axis as usize - 1, *angle)),
            _ => None,
        };
        Ok(Self { kind, points: [point(0), point(3), point(6)], turn, line: card.line })
    }

    /// Whether the axes are the same everywhere.
    pub fn is_uniform(&self) -> bool {
        self.kind == Kind::Rectangular
    }

    /// Axes 1, 2, 3 at a place, of an orientation of a part that stands where it is placed.
    pub fn axes_at(&self, place: [f64; 3], placing: &Placing) -> Result<[[f64; 3]; 3], LocatedProblem> {
        let [a, b, origin] = self.points.map(|point| placing.place(point));
        let axes = match self.kind {
            Kind::Rectangular => {
                let x = minus(a, origin);
                self.square(x, cross(x, minus(b, origin)))?
            }
            Kind::Cylindrical => {
                let (axis, from) = (minus(b, a), minus(place, a));
                let share = dot(axis, from) / dot(axis, axis);
                let radial = minus(from, scale(share, axis));
                let away = norm(radial) > PARALLEL * norm(from);
                self.square(if away { radial } else { minus(place, origin) }, axis)
                    .or_else(|_| self.square(across(axis), axis))?
            }
            Kind::Spherical => {
                let (radial, axis) = (minus(place, a), minus(b, a));
                let around = cross(axis, radial);
                let meridian = cross(radial, around);
                self.square(radial, cross(radial, meridian))?
            }
        };
        Ok(match self.turn {
            Some((axis, angle)) => turned(axes, axis, angle),
            None => axes,
        })
    }

    /// Unit vectors along a first direction and the part of the third across it.
    fn square(&self, first: [f64; 3], third: [f64; 3]) -> Result<[[f64; 3]; 3], LocatedProblem> {
        let second = cross(third, first);
        if !(norm(second) > PARALLEL * norm(first) * norm(third)) {
            return Err((self.line, MatrixProblem::SystemFlat { system: 0 }));
        }
        let (first, second) = (unit(first), unit(second));
        Ok([first, second, cross(first, second)])
    }
}

/// Axes turned by an angle (degrees) about one of them.
fn turned(axes: [[f64; 3]; 3], about: usize, angle: f64) -> [[f64; 3]; 3] {
    let (sin, cos) = angle.to_radians().sin_cos();
    let (one, two) = ((about + 1) % 3, (about + 2) % 3);
    let mut out = axes;
    out[one] = add(scale(cos, axes[one]), scale(sin, axes[two]));
    out[two] = add(scale(cos, axes[two]), scale(-sin, axes[one]));
    out
}

impl Reader {
    pub(super) fn read_orientations(&mut self) -> Result<(), LocatedProblem> {
        for at in self.cards(&["ORIENTATION"]) {
            let card = &self.cards[at];
            let name = card.parameter("NAME").unwrap_or_default().to_ascii_uppercase();
            let orientation = Orientation::read(card, card.parameter("SYSTEM"))?;
            self.orientations.insert(name, orientation);
        }
        Ok(())
    }

    /// An orientation by its name.
    pub(super) fn orientation(&self, name: &str, line: usize) -> Result<Orientation, LocatedProblem> {
        let known = self.orientations.get(&name.to_ascii_uppercase()).copied();
        known.ok_or_else(|| super::names::no("orientation", name, line))
    }

    /// Axes of the displacements of nodes.
    pub(super) fn read_transforms(&mut self) -> Result<(), LocatedProblem> {
        for at in self.cards(&["TRANSFORM"]) {
            let card = &self.cards[at];
            let (line, set) = (card.line, card.parameter("NSET").unwrap_or_default().to_owned());
            let transform = Orientation::read(card, card.parameter("TYPE"))?;
            for placed in self.placed(card.scope) {
                for label in self.nodes(&placed, &set, line)? {
                    let at = self.model.points.partition_point(|point| point.label < label);
                    let Some(point) = self.model.points.get_mut(at) else { continue };
                    point.axes = Some(transform.axes_at(point.place, &placed.placing)?);
                }
            }
        }
        Ok(())
    }
}
