use std::collections::BTreeMap;

use nalgebra::{DMatrix, Matrix3, Vector3};

use super::net::Net;
use super::{Assembly, Built, Mover};
use crate::elements::affine::{Field as Shape, Piece};
use crate::elements::cavity::Filled;
use crate::elements::error::{ElementError, ElementId, ElementKind, Field, Problem, at};
use crate::elements::inner::Inner;
use crate::elements::matrices::{Block, Matrices};
use crate::elements::part::NodeRef;
use crate::elements::spring::{Ends, Pull, Pulled};
use crate::elements::structure::Component;
use crate::elements::{End, PlaceRef, Station};
use crate::math::memory;
use crate::math::sparse::SparseRows;
use crate::math::sym3::Sym;
use crate::model::force::Force;
use crate::model::{
    BodyParts, Coordinate, FlexibleBody, FlexibleError, Hinge, Invariants, Marker, Pair, Support, Watched,
    Wheels,
};

/// A carrier with everything on it and in it: rigid pieces that move, then the coordinates of the parts, then those of what
/// turns inside.
struct Carried {
    /// The carrier and the liquids in it, at rest, each with its centre of mass (m), in the file's frame.
    rigid: Vec<(Piece, Vector3<f64>)>,
    movers: Vec<Mover>,
    /// First coordinate of each mover, and the end.
    starts: Vec<usize>,
    component: Option<Component>,
    inner: Inner,
}

/// Dense matrices of what turns inside that are held at once.
const INSIDE_MATRICES: usize = 4;
/// Tensions balance if what is left of them at rest is at most this share of their sum.
const BALANCED: f64 = 1e-6;

impl Assembly {
    /// A body with a carrier.
    pub(super) fn carried(&self, forces: &[Force<Station>]) -> Result<Built, ElementError> {
        let carrier =
            self.carrier.as_ref().ok_or_else(|| at(ElementId::CARRIER, Field::Mass)(Problem::NoBody))?;
        let movers = self.movers()?;
        let net = if self.parts.is_empty() { None } else { Some(Net::of_parts(self)?) };
        let component = net.as_ref().map(|net| net.component(false)).transpose()?;
        let order = self.reduction.order;
        let liquids = self.cavities.iter().enumerate().map(|(i, cavity)| cavity.filled(i, order));
        let liquids = liquids.collect::<Result<Vec<Filled>, _>>()?;
        let mut rigid = vec![(carrier.piece()?, carrier.position())];
        rigid.extend(liquids.iter().map(|liquid| (liquid.piece, liquid.center)));
        let rotors = self.rotors.iter().enumerate().map(|(i, rotor)| rotor.inner(i));
        let (motions, slow): (Vec<_>, Vec<_>) =
            liquids.into_iter().map(|liquid| (Ok(liquid.inner), liquid.slow)).unzip();
        let mut whole =
            Carried { rigid, starts: starts(&movers), movers, component, inner: Inner::default() };
        whole.inner = Inner::sum(whole.elastic(), rotors.chain(motions))?;
        let (mass, center_of_mass) = whole.mass_center();
        let pole = self.held_point()?.unwrap_or(center_of_mass);
        let invariants = whole.invariants(pole, mass);
        self.has_inertia(ElementId::CARRIER, &invariants)?;
        let start = whole.flexible();
        let paths =
            whole.component.as_ref().and_then(|component| component.curved_paths(pole, start, &invariants));
        let nodes = net.as_ref().zip(whole.component.as_ref());
        let pulled = nodes.map_or_else(BTreeMap::new, |(net, component)| net.pulled(component, start));
        let reaches = net.as_ref().map_or_else(Vec::new, |net| net.reaches(&pulled));
        let Matrices { stiffness, damping, lossy, dissipators } = self.matrices(&whole, &pulled)?;
        let inside = whole.inner.coordinates.len();
        memory::ask(memory::dense(inside, INSIDE_MATRICES)).map_err(|cause| {
            at(ElementId::CARRIER, Field::Name)(Problem::Memory { unknowns: inside, cause })
        })?;
        let markers = whole.markers(&pulled, pole);
        let marker = |end: End| match end {
            End::Carrier => None,
            End::Point(index) => markers.get(index).cloned(),
            End::Hinged(on) => self.place_on(&whole, on, pole),
            End::Node(node) => pulled.get(&node).map(|pulled| pulled.marker(pole)),
        };
        let forces = self.placed_forces(forces, pole, marker)?;
        let body = FlexibleBody::new(BodyParts {
            support: self.support.clone(),
            pole: pole.into(),
            center_of_mass: center_of_mass.into(),
            invariants,
            damping,
            stiffness,
            lossy,
            dissipators,
            memories: whole.inner.memories.clone(),
            coordinates: whole.coordinates(),
            cyclic: whole.inner.coordinates.len(),
            wheels: self.spinning_wheels()?,
            markers,
        });
        let body = body.map_err(|error| self.blame(error))?.along(paths);
        let body = body
            .advected(whole.inner.advections.clone())
            .watching(Watched { reaches, hinges: self.watched(&whole.starts)? });
        let all = body.coordinates().len();
        let parts = whole.component.as_ref().map(|component| component.part_masses(start, all));
        let body = body.made_of(parts.unwrap_or_default());
        self.outweighs_the_inside(&body)?;
        let condensation = whole.component.as_ref().map(Component::condensation);
        Ok(Built { body, forces, condensation, speeds: whole.inner.speeds, liquids: slow, resolution: None })
    }

    /// Hinges of appendages, from where the coordinates of each mover start.
    fn watched(&self, starts: &[usize]) -> Result<Vec<Hinge>, ElementError> {
        let hinged = self.hinged.iter().zip(&starts[self.points.len()..]).enumerate();
        hinged.map(|(index, (hinged, start))| hinged.hinge(index, *start)).collect()
    }

    /// A place on an appendage, from a pole.
    fn place_on(&self, whole: &Carried, on: PlaceRef, pole: Vector3<f64>) -> Option<Marker> {
        let mover = self.points.len() + on.hinged;
        whole.movers.get(mover)?.markers(pole, whole.starts[mover]).nth(1 + on.place)
    }

    fn spinning_wheels(&self) -> Result<Wheels, ElementError> {
        let mut wheels = Wheels::default();
        self.wheels.iter().enumerate().try_for_each(|(i, wheel)| wheel.added(i, &mut wheels))?;
        Ok(wheels)
    }

    /// Accepts a body that has inertia left about every axis when what turns inside is loose.
    fn outweighs_the_inside(&self, body: &FlexibleBody) -> Result<(), ElementError> {
        let cyclic = body.cyclic();
        if cyclic.is_empty() {
            return Ok(());
        }
        let loose = body.recoiling_cyclic_mass();
        let entry = |row: usize, column: usize| loose.at(row, column);
        if DMatrix::from_fn(cyclic.len(), cyclic.len(), entry).cholesky().is_some() {
            return Ok(());
        }
        Err(at(ElementId::CARRIER, Field::Inertia)(Problem::HeavyInside))
    }

    fn movers(&self) -> Result<Vec<Mover>, ElementError> {
        let points = self.points.iter().enumerate().map(|(i, point)| point.mover(i));
        let hinged = self.hinged.iter().enumerate().map(|(i, hinged)| hinged.mover(i));
        points.chain(hinged).collect()
    }

    /// Accepts a body that resists a turn about every axis; `blamed` is the element to name otherwise.
    pub(super) fn has_inertia(&self, blamed: ElementId, invariants: &Invariants) -> Result<(), ElementError> {
        let [xx, yy, zz, yz, zx, xy] = invariants.J;
        let mut moments: [f64; 3] =
            Matrix3::new(xx, xy, zx, xy, yy, yz, zx, yz, zz).symmetric_eigenvalues().into();
        moments.sort_by(f64::total_cmp);
        if moments[0] > f64::EPSILON.sqrt() * moments[2] {
            return Ok(());
        }
        let problem = Problem::NoInertia { moments, held: self.support != Support::Free };
        Err(at(blamed, Field::Inertia)(problem))
    }

    /// Stiffness and damping matrices (I9), coordinates numbered points first, then appendages, then parts.
    fn matrices(
        &self,
        whole: &Carried,
        pulled: &BTreeMap<NodeRef, Pulled>,
    ) -> Result<Matrices, ElementError> {
        let places =
            self.springs.iter().flat_map(|spring| [spring.from, spring.to]).filter_map(|end| match end {
                End::Hinged(on) => {
                    let Marker { name, position, shapes, curvature } =
                        self.place_on(whole, on, Vector3::zeros())?;
                    Some((on, Pulled { name, place: position.into(), shapes, curvature }))
                }
                _ => None,
            });
        let places = places.collect();
        let ends = Ends { points: &self.points, starts: &whole.starts, nodes: pulled, places: &places };
        let springs = self.springs.iter().zip(self.spring_names()).enumerate();
        let springs = springs.map(|(i, (spring, name))| spring.block(i, name, &ends));
        let pulls = self.pulls(whole, &ends)?;
        let hinges = self.hinged.iter().enumerate().zip(&whole.starts[self.points.len()..]);
        let hinges = hinges.map(|((i, hinged), start)| hinged.block(i, *start));
        let start = whole.flexible();
        let parts = whole.component.iter().flat_map(|component| component.blocks(start).map(Ok));
        let size = whole.elastic() + whole.inner.coordinates.len();
        Matrices::sum(
            size,
            springs.chain(pulls.into_iter().map(Ok)).chain(hinges).chain(parts),
            &whole.inner.friction,
        )
    }

    /// Stiffness that tensions at rest give, if they balance. (I10)
    fn pulls(&self, whole: &Carried, ends: &Ends<'_>) -> Result<Vec<Block>, ElementError> {
        let mut sums = vec![(0.0, 0.0_f64, 0); whole.elastic()];
        let mut blocks = Vec::new();
        for (index, (spring, name)) in self.springs.iter().zip(self.spring_names()).enumerate() {
            let Some(Pull { block, forces }) = spring.pull(index, name, ends)? else { continue };
            for (column, force) in forces {
                let (sum, size, last) = &mut sums[column];
                *sum += force;
                *size += f64::abs(force);
                *last = index;
            }
            blocks.push(block);
        }
        let coordinates = whole.coordinates();
        for ((sum, size, last), coordinate) in sums.iter().zip(&coordinates) {
            if f64::abs(*sum) > BALANCED * size {
                let coordinate = coordinate.name.clone();
                return Err(at(ElementKind::Spring.at(*last), Field::Tension)(Problem::Unbalanced {
                    coordinate,
                    force: *sum,
                }));
            }
        }
        Ok(blocks)
    }

    /// Lays a mechanism at the door of the first element it moves.
    fn blame(&self, error: FlexibleError) -> ElementError {
        let coordinates = error.coordinates();
        let moves = |name: &str| coordinates.starts_with(&format!("\"{name}\""));
        let place = self
            .points
            .iter()
            .position(|point| moves(&point.name))
            .map(|index| ElementKind::Point.at(index))
            .or_else(|| {
                self.hinged
                    .iter()
                    .position(|hinged| moves(&hinged.name))
                    .map(|index| ElementKind::Hinged.at(index))
            })
            .unwrap_or(ElementId::CARRIER);
        at(place, Field::Stiffness)(Problem::Mechanism { coordinates })
    }
}

impl Carried {
    /// First coordinate of the parts.
    fn flexible(&self) -> usize {
        self.starts.last().copied().unwrap_or_default()
    }

    /// Number of elastic coordinates.
    fn elastic(&self) -> usize {
        self.flexible() + self.component.as_ref().map_or(0, Component::size)
    }

    fn mass_center(&self) -> (f64, Vector3<f64>) {
        let (mut mass, mut first) = (0.0, Vector3::zeros());
        for (piece, center) in &self.rigid {
            mass += piece.mass;
            first += piece.mass * center;
        }
        for mover in &self.movers {
            mass += mover.piece.mass;
            first += mover.piece.mass * mover.base + mover.piece.first;
        }
        if let Some(component) = &self.component {
            mass += component.mass();
            first += component.mass() * component.center();
        }
        (mass, first / mass)
    }

    /// Inertia invariants about the pole (I1)–(I6).
    fn invariants(&self, pole: Vector3<f64>, mass: f64) -> Invariants {
        let mut J = [0.0; 6];
        for (piece, center) in &self.rigid {
            let rho = Shape::position(center - pole);
            add(&mut J, half(piece.inertia(&rho, &rho)));
        }
        let (mut S, mut h, mut J1) = (Vec::new(), Vec::new(), Vec::new());
        let mut pairs: Vec<(usize, usize, Pair)> = Vec::new();
        for (mover, start) in self.movers.iter().zip(&self.starts) {
            let rho = mover.position(pole);
            add(&mut J, half(mover.piece.inertia(&rho, &rho)));
            for H in &mover.shapes {
                S.push(mover.piece.sum(H));
                h.push(mover.piece.cross(&rho, H));
                J1.push(mover.piece.inertia(&rho, H));
            }
            pairs.extend(mover.pairs(pole, *start));
        }
        if let Some(component) = &self.component {
            add(&mut J, component.inertia(pole));
            for j in 0..component.size() {
                let (S_j, h_j, J_j) = component.coordinate(j, pole);
                S.push(S_j);
                h.push(h_j);
                J1.push(J_j);
            }
            pairs.extend(component.pairs(pole, self.flexible()));
        }
        for h_j in &self.inner.h {
            S.push([0.0; 3]);
            h.push(*h_j);
            J1.push([0.0; 6]);
        }
        pairs.extend(&self.inner.pairs);
        let pairs = SparseRows::sum(S.len(), pairs);
        Invariants { mass, J, S, h, J1, pairs }
    }

    /// Places whose displacement is watched: points and appendages with the places on them, then nodes of parts.
    fn markers(&self, pulled: &BTreeMap<NodeRef, Pulled>, pole: Vector3<f64>) -> Vec<Marker> {
        let movers = self.movers.iter().zip(&self.starts);
        let movers = movers.flat_map(|(mover, start)| mover.markers(pole, *start));
        movers.chain(pulled.values().map(|pulled| pulled.marker(pole))).collect()
    }

    fn coordinates(&self) -> Vec<Coordinate> {
        let movers = self.movers.iter().flat_map(|mover| mover.coordinates.iter().cloned());
        let parts = self.component.iter().flat_map(Component::coordinates);
        movers.chain(parts).chain(self.inner.coordinates.iter().cloned()).collect()
    }
}

fn starts(movers: &[Mover]) -> Vec<usize> {
    let mut starts = vec![0];
    starts.extend(movers.iter().scan(0, |next, mover| {
        *next += mover.shapes.len();
        Some(*next)
    }));
    starts
}

fn half(matrix: Sym) -> Sym {
    matrix.map(|entry| 0.5 * entry)
}

fn add(sum: &mut Sym, part: Sym) {
    sum.iter_mut().zip(part).for_each(|(sum, part)| *sum += part);
}
