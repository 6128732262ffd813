use nalgebra::{Matrix3, Vector3};

use super::affine::{Field as Shape, Piece};
use super::error::{ElementError, Field, Place, Problem};
use super::matrices::Matrices;
use super::{Carrier, Ellipsoid, Hinged, Point, Spring, Station, Surface, coefficient, force};
use crate::math::sparse::SparseRows;
use crate::math::sym::Sym;
use crate::model::Support;
use crate::model::force::Force;
use crate::model::{Coordinate, FlexibleBody, FlexibleError, Invariants, Marker, Pair, Parts};

/// A body as the user describes it: a carrier with points, springs and hinged appendages on it, or a body without a
/// carrier that is elastic throughout.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Assembly {
    /// The rigid body that carries everything else; none of a body that is elastic throughout.
    pub carrier: Option<Carrier>,
    /// Ellipsoids, each of them a whole body.
    pub ellipsoids: Vec<Ellipsoid>,
    /// Solids inside closed surfaces, each of them a whole body.
    pub surfaces: Vec<Surface>,
    /// Material points.
    pub points: Vec<Point>,
    /// Springs and dashpots.
    pub springs: Vec<Spring>,
    /// Rigid appendages on hinges.
    pub hinged: Vec<Hinged>,
    /// How the body is held.
    pub support: Support,
    /// External forces.
    pub forces: Vec<Force<Station>>,
}

/// An element that is a whole body, elastic throughout.
enum Alone<'a> {
    Ellipsoid(&'a Ellipsoid),
    Surface(&'a Surface),
}

/// A rigid piece placed on the body, with the coordinates that move it.
pub(super) struct Mover {
    /// Mass and moments about the base.
    pub piece: Piece,
    /// Where the base is (m), in the file's frame.
    pub base: Vector3<f64>,
    /// One shape per coordinate, outermost first.
    pub shapes: Vec<Shape>,
    /// Curvature of the path of each pair of coordinates, `G_jk`.
    pub curvature: Vec<Vec<Shape>>,
    /// Name and unit of each coordinate.
    pub coordinates: Vec<Coordinate>,
    /// Place watched on the piece: its name, and where it is from the base.
    pub marker: (String, Vector3<f64>),
}

impl Assembly {
    /// Everything wrong with the elements, one by one; what only the whole body can show is left to [`Self::body`].
    #[must_use]
    pub fn check(&self) -> Vec<ElementError> {
        let carrier = self.carrier.as_ref().and_then(|carrier| carrier.piece().err());
        let ellipsoids =
            self.ellipsoids.iter().enumerate().filter_map(|(i, ellipsoid)| ellipsoid.check(i).err());
        let surfaces = self.surfaces.iter().enumerate().filter_map(|(i, surface)| surface.check(i).err());
        let points = self.points.iter().enumerate().filter_map(|(i, point)| point.mover(i).err());
        let hinged = self.hinged.iter().enumerate().filter_map(|(i, hinged)| hinged.mover(i).err());
        let hinges = self.hinged.iter().enumerate().filter_map(|(i, hinged)| hinged.block(i, 0).err());
        let starts = vec![0; self.points.len()];
        let springs =
            (0..self.springs.len()).filter_map(|i| self.springs[i].block(i, &self.points, &starts).err());
        let support = self.held_point().err();
        let points_of_forces = self.points.len();
        let forces = self.forces.iter().enumerate();
        let forces = forces.filter_map(|(i, force)| force::check(i, force, points_of_forces).err());
        carrier
            .into_iter()
            .chain(ellipsoids)
            .chain(surfaces)
            .chain(self.alone().err())
            .chain(points)
            .chain(hinged)
            .chain(hinges)
            .chain(springs)
            .chain(support)
            .chain(forces)
            .chain(self.same_names())
            .collect()
    }

    /// The flexible body.
    ///
    /// # Errors
    /// [`ElementError`] for the first element that no body can have, and for a mechanism.
    pub fn body(&self) -> Result<FlexibleBody, ElementError> {
        if let Some(error) = self.same_names().into_iter().next() {
            return Err(error);
        }
        match self.alone()? {
            Some(Alone::Ellipsoid(ellipsoid)) => return ellipsoid.body(0),
            Some(Alone::Surface(surface)) => return surface.body(0),
            None => {}
        }
        let (carrier, position) = self.carried()?;
        let movers = self.movers()?;
        let (mass, center_of_mass) = mass_center(&carrier, position, &movers);
        let pole = self.held_point()?.unwrap_or(center_of_mass);
        let invariants = invariants(&carrier, position - pole, &movers, pole, mass);
        self.has_inertia(&invariants)?;
        let Matrices { stiffness, damping, lossy } = self.matrices(&movers)?;
        FlexibleBody::new(Parts {
            support: self.support.clone(),
            pole: pole.into(),
            center_of_mass: center_of_mass.into(),
            invariants,
            damping,
            stiffness,
            lossy,
            coordinates: movers.iter().flat_map(|mover| mover.coordinates.clone()).collect(),
            markers: markers(&movers, pole),
        })
        .map_err(|error| self.blame(error))
    }

    /// External forces with the places they act at, as seen from the pole of [`Self::body`].
    ///
    /// # Errors
    /// [`ElementError`] for the first force, or element under it, that cannot be.
    pub fn forces(&self) -> Result<Vec<Force<Marker>>, ElementError> {
        let movers = self.movers()?;
        let center_of_mass = match self.alone()? {
            Some(Alone::Ellipsoid(ellipsoid)) => ellipsoid.center.into(),
            Some(Alone::Surface(surface)) => surface.surface.centroid().into(),
            None => {
                let (carrier, position) = self.carried()?;
                mass_center(&carrier, position, &movers).1
            }
        };
        let pole = self.held_point()?.unwrap_or(center_of_mass);
        let markers = markers(&movers, pole);
        let points = &markers[..self.points.len()];
        let placed = |(i, force): (usize, &Force<Station>)| {
            force::check(i, force, points.len())?;
            if self.carrier.is_none() && force.law.place().is_some() {
                return Err(at(Place::Force(i), Field::On)(Problem::NoCarrier));
            }
            force.try_map(|station| station.marker(Place::Force(i), &force.name, points, pole))
        };
        self.forces.iter().enumerate().map(placed).collect()
    }

    /// The carrier and the place of its centre of mass.
    fn carried(&self) -> Result<(Piece, Vector3<f64>), ElementError> {
        let carrier =
            self.carrier.as_ref().ok_or_else(|| at(Place::Carrier, Field::Mass)(Problem::NoBody))?;
        Ok((carrier.piece()?, carrier.position()))
    }

    /// The element that is the whole body, if there is one; nothing may stand beside it.
    fn alone(&self) -> Result<Option<Alone<'_>>, ElementError> {
        let ellipsoids = self.ellipsoids.iter().map(Alone::Ellipsoid);
        let Some(alone) = ellipsoids.chain(self.surfaces.iter().map(Alone::Surface)).next() else {
            return Ok(None);
        };
        let beside = [
            (self.carrier.is_some(), Place::Carrier),
            (self.ellipsoids.len() > 1, Place::Ellipsoid(1)),
            (!self.ellipsoids.is_empty() && !self.surfaces.is_empty(), Place::Surface(0)),
            (self.surfaces.len() > 1, Place::Surface(1)),
            (!self.points.is_empty(), Place::Point(0)),
            (!self.springs.is_empty(), Place::Spring(0)),
            (!self.hinged.is_empty(), Place::Hinged(0)),
        ];
        if let Some((_, place)) = beside.iter().find(|(there, _)| *there) {
            return Err(at(*place, Field::Name)(Problem::BesideWhole));
        }
        if self.support != Support::Free {
            return Err(at(Place::Support, Field::FixedPoint)(Problem::HeldWhole));
        }
        Ok(Some(alone))
    }

    fn movers(&self) -> Result<Vec<Mover>, ElementError> {
        let points = self.points.iter().enumerate().map(|(i, point)| point.mover(i));
        let hinged = self.hinged.iter().enumerate().map(|(i, hinged)| hinged.mover(i));
        points.chain(hinged).collect()
    }

    /// The point that is fixed or driven; none of a free body.
    fn held_point(&self) -> Result<Option<Vector3<f64>>, ElementError> {
        let finite =
            |field: Field, values: &[f64; 3]| coefficient::finite(values).map_err(at(Place::Support, field));
        let point = match &self.support {
            Support::Free => return Ok(None),
            Support::FixedPoint { point } => point,
            Support::Prescribed { point, velocity, position, .. } => {
                finite(Field::Velocity, velocity)?;
                finite(Field::Position, position)?;
                point
            }
        };
        finite(Field::FixedPoint, point)?;
        Ok(Some((*point).into()))
    }

    fn same_names(&self) -> Vec<ElementError> {
        let points = self.points.iter().enumerate().map(|(i, point)| (Place::Point(i), &point.name));
        let hinged = self.hinged.iter().enumerate().map(|(i, hinged)| (Place::Hinged(i), &hinged.name));
        let mut seen = std::collections::HashSet::new();
        let repeated = points.chain(hinged).filter(|(_, name)| !seen.insert(name.as_str()));
        repeated
            .map(|(place, name)| at(place, Field::Name)(Problem::DuplicateName { name: name.clone() }))
            .collect()
    }

    fn has_inertia(&self, invariants: &Invariants) -> Result<(), ElementError> {
        let [xx, yy, zz, yz, zx, xy] = invariants.J;
        let mut moments: [f64; 3] =
            Matrix3::new(xx, xy, zx, xy, yy, yz, zx, yz, zz).symmetric_eigenvalues().into();
        moments.sort_by(f64::total_cmp);
        if moments[0] > f64::EPSILON.sqrt() * moments[2] {
            return Ok(());
        }
        let problem = Problem::NoInertia { moments, held: self.support != Support::Free };
        Err(at(Place::Carrier, Field::Inertia)(problem))
    }

    /// Stiffness and damping matrices (I9), coordinates numbered points first.
    fn matrices(&self, movers: &[Mover]) -> Result<Matrices, ElementError> {
        let starts: Vec<usize> = movers
            .iter()
            .scan(0, |next, mover| Some(std::mem::replace(next, *next + mover.shapes.len())))
            .collect();
        let size = movers.iter().map(|mover| mover.shapes.len()).sum();
        let springs =
            self.springs.iter().enumerate().map(|(i, spring)| spring.block(i, &self.points, &starts));
        let hinges = self.hinged.iter().enumerate().zip(&starts[self.points.len()..]);
        let hinges = hinges.map(|((i, hinged), start)| hinged.block(i, *start));
        Matrices::sum(size, springs.chain(hinges))
    }

    /// Lays a mechanism at the door of the first element it moves.
    fn blame(&self, error: FlexibleError) -> ElementError {
        let FlexibleError::Mechanism { coordinates } = error;
        let moves = |name: &str| coordinates.starts_with(&format!("\"{name}\""));
        let place = self
            .points
            .iter()
            .position(|point| moves(&point.name))
            .map(Place::Point)
            .or_else(|| self.hinged.iter().position(|hinged| moves(&hinged.name)).map(Place::Hinged))
            .unwrap_or(Place::Carrier);
        at(place, Field::Stiffness)(Problem::Mechanism { coordinates })
    }
}

/// Makes an [`ElementError`] of a problem with a value of an element.
pub(super) fn at(place: Place, field: Field) -> impl Fn(Problem) -> ElementError {
    move |problem| ElementError { place, field, problem }
}

fn mass_center(carrier: &Piece, position: Vector3<f64>, movers: &[Mover]) -> (f64, Vector3<f64>) {
    let mut mass = carrier.mass;
    let mut first = carrier.mass * position;
    for mover in movers {
        mass += mover.piece.mass;
        first += mover.piece.mass * mover.base + mover.piece.first;
    }
    (mass, first / mass)
}

/// Inertia invariants about the pole (I1)–(I6).
fn invariants(
    carrier: &Piece,
    center: Vector3<f64>,
    movers: &[Mover],
    pole: Vector3<f64>,
    mass: f64,
) -> Invariants {
    let rho = Shape::position(center);
    let mut J = half(carrier.inertia(&rho, &rho));
    let (mut S, mut h, mut J1, mut pairs) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for Mover { piece, base, shapes, curvature, .. } in movers {
        let rho = Shape::position(base - pole);
        let start = S.len();
        for (sum, part) in J.iter_mut().zip(half(piece.inertia(&rho, &rho))) {
            *sum += part;
        }
        for (j, H_j) in shapes.iter().enumerate() {
            S.push(piece.sum(H_j));
            h.push(piece.cross(&rho, H_j));
            J1.push(piece.inertia(&rho, H_j));
            for (k, H_k) in shapes.iter().enumerate() {
                pairs.push((start + j, start + k, piece.pair(&rho, H_j, H_k, &curvature[j][k])));
            }
        }
    }
    let pairs: SparseRows<Pair> = SparseRows::sum(S.len(), pairs);
    Invariants { mass, J, S, h, J1, pairs }
}

fn half(matrix: Sym) -> Sym {
    matrix.map(|entry| 0.5 * entry)
}

fn markers(movers: &[Mover], pole: Vector3<f64>) -> Vec<Marker> {
    let mut start = 0;
    let mut markers = Vec::with_capacity(movers.len());
    for mover in movers {
        let (name, s) = &mover.marker;
        let shapes = mover.shapes.iter().enumerate();
        markers.push(Marker {
            name: name.clone(),
            position: (mover.base + s - pole).into(),
            shapes: shapes.map(|(j, H)| (start + j, (H.constant + H.linear * s).into())).collect(),
        });
        start += mover.shapes.len();
    }
    markers
}
