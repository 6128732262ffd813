//! Coordinate systems of NASTRAN: rectangular, cylindrical and spherical, by points of other systems or by grid points.
//! Systems may hang on each other in chains, whose order in the file is free; a circle is refused, and a chain has a bounded length.
//! MSC Nastran Quick Reference Guide, CORD1R to CORD2S.

use std::collections::HashMap;

use quasirigid_math::vec3::{add, cross, dot, norm, scale};

use super::bulk::{Card, integer, integer_or, real_or_zero};
use crate::matrix::error::{MatrixProblem, Row};
use crate::matrix::listed::LocatedProblem;

/// Coordinates in a system.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Rectangular,
    Cylindrical,
    Spherical,
}

/// Origin, a point on the third axis, and one in the plane of the first and third.
#[derive(Clone, Copy)]
enum Defined {
    /// In another system, 0 for the basic one.
    ByPoints {
        reference: u64,
        points: [[f64; 3]; 3],
    },
    ByGrids([u64; 3]),
}

#[derive(Clone, Copy)]
struct Definition {
    kind: Kind,
    defined: Defined,
    line: usize,
}

/// A system with its place in the basic one.
#[derive(Clone, Copy)]
pub(crate) struct System {
    kind: Kind,
    origin: [f64; 3],
    /// Unit vectors along the three axes.
    axes: [[f64; 3]; 3],
}

/// A grid point as its card gives it.
#[derive(Clone, Copy)]
pub(crate) struct Grid {
    /// System of its coordinates, 0 for the basic one.
    pub system: u64,
    pub coordinates: [f64; 3],
    pub line: usize,
}

/// The systems of a file.
#[derive(Default)]
pub(crate) struct Systems {
    definitions: HashMap<u64, Definition>,
    found: HashMap<u64, System>,
}

/// Longest chain of systems.
const LONGEST: usize = 100;
/// Sine of the angle below which two directions of a system are one.
const PARALLEL: f64 = 1e-9;

/// Names of the cards that define systems.
pub(crate) const CARDS: [&str; 6] = ["CORD1R", "CORD1C", "CORD1S", "CORD2R", "CORD2C", "CORD2S"];

impl System {
    const BASIC: Self = Self {
        kind: Kind::Rectangular,
        origin: [0.0; 3],
        axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    };

    /// The place in the basic system of a point by its coordinates; angles are in degrees.
    pub fn place(&self, coordinates: [f64; 3]) -> [f64; 3] {
        add(self.origin, self.turned(self.straight(coordinates)))
    }

    /// The vector in the basic system of components along the axes.
    pub fn turned(&self, components: [f64; 3]) -> [f64; 3] {
        let along = |axis: usize| scale(components[axis], self.axes[axis]);
        add(add(along(0), along(1)), along(2))
    }

    fn straight(&self, [a, b, c]: [f64; 3]) -> [f64; 3] {
        let polar = |radius: f64, angle: f64| {
            let (sin, cos) = angle.to_radians().sin_cos();
            [radius * cos, radius * sin]
        };
        match self.kind {
            Kind::Rectangular => [a, b, c],
            Kind::Cylindrical => {
                let [x, y] = polar(a, b);
                [x, y, c]
            }
            Kind::Spherical => {
                let [z, across] = polar(a, b);
                let [x, y] = polar(across, c);
                [x, y, z]
            }
        }
    }

    /// Unit vectors of the system at a place of the basic one; where a cylindrical or spherical system has none, on its axis, those
    /// of its axes.
    pub fn axes_at(&self, place: [f64; 3]) -> [[f64; 3]; 3] {
        let from = add(place, scale(-1.0, self.origin));
        let [x, y, z] = self.axes.map(|axis| dot(axis, from));
        let across = x.hypot(y);
        if self.kind == Kind::Rectangular || across <= PARALLEL * norm(from) {
            return self.axes;
        }
        let radial = self.turned([x / across, y / across, 0.0]);
        let around = cross(self.axes[2], radial);
        if self.kind == Kind::Cylindrical {
            return [radial, around, self.axes[2]];
        }
        let outward = scale(norm(from).recip(), from);
        let polar = self.turned([x / across * z, y / across * z, -across]);
        [outward, scale(norm(polar).recip(), polar), around]
    }
}

impl Systems {
    /// Notes the systems that a card defines: one, or two on one card by grid points.
    pub fn define(&mut self, card: &Card) -> Result<(), LocatedProblem> {
        let kind = match card.name.as_bytes().last().map(u8::to_ascii_uppercase) {
            Some(b'C') => Kind::Cylindrical,
            Some(b'S') => Kind::Spherical,
            _ => Kind::Rectangular,
        };
        let line = card.line;
        if card.name.as_bytes().get(4) == Some(&b'2') {
            let label = integer(card.field(2), Row::Grid)?;
            let reference = integer_or(card.field(3), 0, Row::Grid)?;
            let mut points = [[0.0; 3]; 3];
            for (index, entry) in points.iter_mut().flatten().enumerate() {
                *entry = real_or_zero(card.field(4 + index))?;
            }
            return self
                .insert(label, Definition { kind, defined: Defined::ByPoints { reference, points }, line });
        }
        for first in [2, 6] {
            if card.field(first).text.is_empty() {
                continue;
            }
            let [label, a, b, c] = [0, 1, 2, 3].map(|at| integer(card.field(first + at), Row::Grid));
            let defined = Defined::ByGrids([a?, b?, c?]);
            self.insert(label?, Definition { kind, defined, line })?;
        }
        Ok(())
    }

    fn insert(&mut self, label: u64, definition: Definition) -> Result<(), LocatedProblem> {
        match self.definitions.insert(label, definition) {
            None => Ok(()),
            Some(_) => Err((definition.line, MatrixProblem::SystemTwice { system: label })),
        }
    }

    /// The system of this number, which grid points may define; `line` is where it is named.
    pub fn system(
        &mut self,
        label: u64,
        grids: &HashMap<u64, Grid>,
        line: usize,
    ) -> Result<System, LocatedProblem> {
        self.resolved(label, grids, line, 0)
    }

    /// The place of a grid point in the basic system.
    pub fn place(&mut self, grid: &Grid, grids: &HashMap<u64, Grid>) -> Result<[f64; 3], LocatedProblem> {
        Ok(self.system(grid.system, grids, grid.line)?.place(grid.coordinates))
    }

    fn resolved(
        &mut self,
        label: u64,
        grids: &HashMap<u64, Grid>,
        line: usize,
        depth: usize,
    ) -> Result<System, LocatedProblem> {
        if label == 0 {
            return Ok(System::BASIC);
        }
        if let Some(known) = self.found.get(&label) {
            return Ok(*known);
        }
        let Some(definition) = self.definitions.get(&label).copied() else {
            return Err((line, MatrixProblem::NoSuchSystem { system: label }));
        };
        if depth > LONGEST {
            return Err((definition.line, MatrixProblem::SystemCircle { system: label, limit: LONGEST }));
        }
        let [origin, along, plane] = match definition.defined {
            Defined::ByPoints { reference, points } => {
                let system = self.resolved(reference, grids, definition.line, depth + 1)?;
                points.map(|point| system.place(point))
            }
            Defined::ByGrids(labels) => {
                let mut points = [[0.0; 3]; 3];
                for (point, node) in points.iter_mut().zip(labels) {
                    let problem = || (definition.line, MatrixProblem::SystemGrid { system: label, node });
                    let grid = grids.get(&node).ok_or_else(problem)?;
                    let system = self.resolved(grid.system, grids, grid.line, depth + 1)?;
                    *point = system.place(grid.coordinates);
                }
                points
            }
        };
        let [along, plane] = [along, plane].map(|point| add(point, scale(-1.0, origin)));
        let second = cross(along, plane);
        if !(norm(second) > PARALLEL * norm(along) * norm(plane)) {
            return Err((definition.line, MatrixProblem::SystemFlat { system: label }));
        }
        let unit = |vector: [f64; 3]| scale(norm(vector).recip(), vector);
        let (second, third) = (unit(second), unit(along));
        let system = System { kind: definition.kind, origin, axes: [cross(second, third), second, third] };
        self.found.insert(label, system);
        Ok(system)
    }
}
