//! Assembly with a carrier: builds its flexible body from rigid pieces, parts of finite elements, and internal rotors and liquids.
//! The order of coordinates is fixed here (moving pieces, parts, cyclic coordinates); matrices, invariants and markers all rely on it.
//! Equations (I1) to (I6), (I9), (I10), docs/theory/02-invariants.md.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::{DMatrix, Matrix3, Vector3};

use super::{Assembly, Built};
use crate::NodeRef;
use crate::contribution::Internal;
use crate::contribution::Matrices;
use crate::contribution::{Attachment, Attachments};
use crate::contribution::{Field as Shape, Piece};
use crate::contribution::{ModalBody, MovingBody};
use crate::element::{AttachmentPoint, ElementSite, Preload, Role};
use crate::error::{ElementError, ElementId, ElementKind, Field, Problem, at};
use crate::kinds::part::PartGraph;
use crate::kinds::tank::Sloshing;
use crate::kinds::tube::Slug;
use crate::math::memory;
use crate::math::sparse::SparseRows;
use crate::math::sym3::Sym;
use crate::model::control::Controls;
use crate::model::force::Force;
use crate::model::{
    BodyParts, Coordinate, CurvedPaths, Drive, FlexibleBody, FlexibleError, Friction, Hinge, Invariants,
    Marker, Pair, Support, Watched,
};
use crate::structure::Block;
use crate::structure::Component;
use crate::visual::Vertex;
use crate::{ApplicationPoint, End, SettledTank};

/// A carrier with everything on it and in it: rigid pieces that move, then the coordinates of the parts, then those of internal
/// rotors and liquids.
struct Carried {
    /// Carrier and mass that internal liquids add to it, each piece with its centre of mass (m), in the file's frame.
    rigid: Vec<(Piece, Vector3<f64>)>,
    /// Moving pieces, in the order of their elements.
    moving_bodies: Vec<Moved>,
    /// Pieces known by their modes, in the order of their elements.
    modal_bodies: Vec<Modal>,
    component: Option<Component>,
    /// First coordinate of the component.
    flexible: usize,
    inner: Internal,
    /// Tanks with their liquids settled, with the stiffness and damping of their bobs.
    tanks: Vec<SettledTank>,
    slosh: Vec<Block>,
}

/// Piece that moves, with its element and its first coordinate.
struct Moved {
    id: ElementId,
    moving_body: MovingBody,
    start: usize,
}

/// Piece known by its modes, with its element and its first coordinate.
struct Modal {
    id: ElementId,
    modal_body: ModalBody,
    start: usize,
}

/// Dense matrices over the cyclic coordinates that are in memory at once.
const INSIDE_MATRICES: usize = 4;
/// Residual of the tensions at rest, as a share of their sum, up to which they balance.
const BALANCED: f64 = 1e-6;

impl Assembly {
    /// A body with a carrier.
    pub(super) fn carried(
        &self,
        forces: &[Force<ApplicationPoint>],
        visuals: bool,
    ) -> Result<Built, ElementError> {
        let carrier =
            self.carrier.as_ref().ok_or_else(|| at(ElementId::CARRIER, Field::MASS)(Problem::NoBody))?;
        let mut graph = if self.parts.is_empty() { None } else { Some(PartGraph::of_parts(self)?) };
        if let Some(graph) = graph.as_mut().filter(|_| visuals) {
            let node = |end| if let End::Node(node) = end { Some(node) } else { None };
            graph.draw(self.drawn_ends().into_iter().filter_map(node));
        }
        let component = graph.as_ref().map(|graph| graph.component(false)).transpose()?;
        let (moving_bodies, moved) = self.moving_bodies()?;
        let (modal_bodies, flexible) = self.modal_bodies(moved + self.slosh_coordinates())?;
        let order = self.reduction.order;
        let inner = self.each().filter_map(|(id, element)| {
            let inner = element.inner(id, order).transpose()?;
            Some(inner.map(|inner| inner.of(id)))
        });
        let elastic = flexible + component.as_ref().map_or(0, Component::size);
        let inner = Internal::sum(elastic, inner)?;
        let mut rigid = vec![(carrier.piece()?, carrier.position())];
        rigid.extend(&inner.rigid);
        let (tanks, slosh) = (Vec::new(), Vec::new());
        let mut whole =
            Carried { rigid, moving_bodies, modal_bodies, component, flexible, inner, tanks, slosh };
        let held = self.held_point()?;
        whole.fill(self.sloshing(whole.mass_center(), held)?, moved);
        let (mass, center_of_mass) = whole.mass_center();
        let pole = held.unwrap_or(center_of_mass);
        let invariants = whole.invariants(pole, mass);
        self.has_inertia(ElementId::CARRIER, &invariants)?;
        whole.tanks = self.carried_along(std::mem::take(&mut whole.tanks), &invariants)?;
        let start = whole.flexible;
        let paths = whole.curved_paths(pole, &invariants);
        let nodes = graph.as_ref().zip(whole.component.as_ref());
        let drawn = nodes.map_or_else(BTreeMap::new, |(graph, component)| graph.drawn(component, start));
        let nodes =
            nodes.map_or_else(BTreeMap::new, |(graph, component)| graph.attachments(component, start));
        let reaches = graph.as_ref().map_or_else(Vec::new, |graph| graph.reaches(&nodes));
        let attachments = self.attachments(&whole, &nodes)?;
        let Matrices { stiffness, damping, viscoelastic, dissipators } =
            self.matrices(&whole, &attachments)?;
        let frictions = self.frictions(&whole, &attachments)?;
        let inside = whole.inner.coordinates.len();
        memory::ask(memory::dense(inside, INSIDE_MATRICES)).map_err(|cause| {
            at(ElementId::CARRIER, Field::NAME)(Problem::Memory { unknowns: inside, cause })
        })?;
        let markers = whole.markers(&nodes, pole);
        let forces = self.placed_forces(forces, pole, &attachments)?;
        let visuals = if visuals {
            self.visuals_at(pole, &whole.places(&drawn), &|id| whole.inner.firsts.get(&id).copied())
        } else {
            Vec::new()
        };
        let parts = BodyParts {
            support: self.support.clone(),
            pole: pole.into(),
            center_of_mass: center_of_mass.into(),
            invariants,
            damping,
            stiffness,
            viscoelastic,
            dissipators,
            memories: whole.inner.memories.clone(),
            coordinates: whole.coordinates(),
            cyclic: whole.inner.coordinates.len(),
            wheels: whole.inner.wheels.clone(),
            drives: whole.drives(),
            markers,
        };
        let body = FlexibleBody::hanging(parts, &whole.pendulums());
        let body = body.map_err(|error| self.attribute(error))?.along(paths);
        let body = body.advected(whole.inner.advections.clone()).rubbed(frictions).watching(Watched {
            reaches,
            hinges: self.sprung(&whole)?,
            gimbals: self.gimbals(&whole)?,
        });
        let all = body.coordinates().len();
        let parts = whole.component.as_ref().map(|component| component.part_masses(start, all));
        let body = body.made_of(parts.unwrap_or_default());
        self.outweighs_the_inside(&body)?;
        let condensation = whole.component.as_ref().map(Component::condensation);
        Ok(Built {
            body,
            forces,
            controls: Controls::default(),
            condensation,
            speeds: whole.inner.speeds,
            liquids: whole.inner.liquids,
            tanks: whole.tanks,
            slugs: self.slugs()?,
            resolution: None,
            visuals,
        })
    }

    /// Hinges of appendages on which springs act: these take the displacements of their places to first order. (I9), (K14)
    fn sprung(&self, whole: &Carried) -> Result<Vec<Hinge>, ElementError> {
        let sprung: BTreeSet<usize> = self
            .attachment_points()
            .filter(|(_, role, _)| *role != Role::External)
            .filter_map(
                |(_, _, attachment_point)| {
                    if let End::Hinged(on) = attachment_point.end { Some(on.hinged) } else { None }
                },
            )
            .collect();
        let turning = sprung.into_iter().filter(|index| self.hinged[*index].turns());
        turning.map(|index| self.hinge(whole, index)).collect()
    }

    /// Hinges of three axes, which may lock. (I14)
    fn gimbals(&self, whole: &Carried) -> Result<Vec<Hinge>, ElementError> {
        let gimbals = (0..self.hinged.len()).filter(|index| self.hinged[*index].axes.len() == 3);
        gimbals.map(|index| self.hinge(whole, index)).collect()
    }

    fn hinge(&self, whole: &Carried, index: usize) -> Result<Hinge, ElementError> {
        self.hinged[index].hinge(index, whole.start_of(ElementKind::Hinged.at(index)))
    }

    /// Places at which elements act.
    fn attachments(
        &self,
        whole: &Carried,
        nodes: &BTreeMap<NodeRef, Attachment>,
    ) -> Result<Attachments, ElementError> {
        let mut attachments = Attachments::default();
        for (id, role, AttachmentPoint { field, end, .. }) in self.attachment_points() {
            if attachments.has(end) {
                continue;
            }
            let moving = match end {
                End::Carrier => None,
                End::Point(index) => whole.attachment(ElementKind::Point.at(index), 0),
                End::Hinged(on) => whole.attachment(ElementKind::Hinged.at(on.hinged), 1 + on.place),
                End::Node(node) => nodes.get(&node).cloned(),
            };
            match moving.map_or_else(|| self.at_rest(end), Ok) {
                Ok(attachment) => attachments.note(end, attachment),
                // a body built without its forces needs no places for them
                Err(_) if role == Role::External => {}
                Err(problem) => return Err(at(id, field)(problem)),
            }
        }
        Ok(attachments)
    }

    /// Accepts a body whose inertia stays positive about every axis when internal rotors and liquids are free.
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
        Err(at(ElementId::CARRIER, Field::INERTIA)(Problem::HeavyInside))
    }

    /// Pieces that move, with the number of their coordinates.
    fn moving_bodies(&self) -> Result<(Vec<Moved>, usize), ElementError> {
        let (mut moving_bodies, mut next) = (Vec::new(), 0);
        for (id, element) in self.each() {
            if let Some(moving_body) = element.moving_body(id)? {
                let start = next;
                next += moving_body.shapes.len();
                moving_bodies.push(Moved { id, moving_body, start });
            }
        }
        Ok((moving_bodies, next))
    }

    /// Pieces known by their modes, with coordinates numbered from `next`, and the number of the first coordinate after them.
    fn modal_bodies(&self, mut next: usize) -> Result<(Vec<Modal>, usize), ElementError> {
        let mut modal_bodies = Vec::new();
        for (id, element) in self.each() {
            if let Some(modal_body) = element.modal_body(id)? {
                let start = next;
                next += modal_body.size();
                modal_bodies.push(Modal { id, modal_body, start });
            }
        }
        Ok((modal_bodies, next))
    }

    /// Accepts a body with inertia about every axis; `blamed` is the element to name otherwise.
    pub(super) fn has_inertia(&self, blamed: ElementId, invariants: &Invariants) -> Result<(), ElementError> {
        let [xx, yy, zz, yz, zx, xy] = invariants.J;
        let mut moments: [f64; 3] =
            Matrix3::new(xx, xy, zx, xy, yy, yz, zx, yz, zz).symmetric_eigenvalues().into();
        moments.sort_by(f64::total_cmp);
        if moments[0] > f64::EPSILON.sqrt() * moments[2] {
            return Ok(());
        }
        let problem = Problem::NoInertia { moments, held: self.support != Support::Free };
        Err(at(blamed, Field::INERTIA)(problem))
    }

    /// Stiffness and damping matrices (I9), coordinates numbered points first, then appendages, then parts.
    fn matrices(&self, whole: &Carried, attachments: &Attachments) -> Result<Matrices, ElementError> {
        let names = self.link_names();
        let site = |id: ElementId| {
            let name = names.get(&id).map_or("", String::as_str);
            ElementSite { id, name, start: whole.start_of(id), attachments }
        };
        let blocks = self.each().filter_map(|(id, element)| element.block(&site(id)).transpose());
        let blocks = blocks.chain(whole.slosh.iter().cloned().map(Ok));
        let preloads = self.preloads(whole, site)?;
        let parts = whole.component.iter().flat_map(|component| component.blocks(whole.flexible).map(Ok));
        let size = whole.elastic() + whole.inner.coordinates.len();
        Matrices::sum(size, blocks.chain(preloads.into_iter().map(Ok)).chain(parts), &whole.inner.friction)
    }

    /// Friction beyond the damping matrix. (U12)
    fn frictions(&self, whole: &Carried, attachments: &Attachments) -> Result<Vec<Friction>, ElementError> {
        let site = |id: ElementId| ElementSite { id, name: "", start: whole.start_of(id), attachments };
        self.each().filter_map(|(id, element)| element.friction(&site(id)).transpose()).collect()
    }

    /// Liquids that slide along rings.
    fn slugs(&self) -> Result<Vec<Slug>, ElementError> {
        let each = self.tubes.iter().enumerate();
        each.map(|(index, tube)| tube.slug(ElementKind::Tube.at(index))).collect()
    }

    /// Stiffness of loads at rest, which must balance. (I10)
    fn preloads<'a>(
        &self,
        whole: &Carried,
        site: impl Fn(ElementId) -> ElementSite<'a>,
    ) -> Result<Vec<Block>, ElementError> {
        let mut sums = vec![(0.0, 0.0_f64, ElementId::CARRIER); whole.elastic()];
        let mut blocks = Vec::new();
        for (id, element) in self.each() {
            let Some(Preload { block, forces }) = element.preload(&site(id))? else { continue };
            for (column, force) in forces {
                let (sum, size, last) = &mut sums[column];
                *sum += force;
                *size += f64::abs(force);
                *last = id;
            }
            blocks.push(block);
        }
        let coordinates = whole.coordinates();
        for ((sum, size, last), coordinate) in sums.iter().zip(&coordinates) {
            if f64::abs(*sum) > BALANCED * size {
                let coordinate = coordinate.name.clone();
                return Err(at(*last, Field::TENSION)(Problem::Unbalanced { coordinate, force: *sum }));
            }
        }
        Ok(blocks)
    }

    /// Attributes a mechanism to the first element with coordinates that moves in it.
    fn attribute(&self, error: FlexibleError) -> ElementError {
        let coordinates = error.coordinates();
        let moves = |name: &str| !name.is_empty() && coordinates.starts_with(&format!("{name:?}"));
        let own =
            |id: &ElementId| matches!(id.kind, ElementKind::Point | ElementKind::Hinged | ElementKind::Tube);
        let first = self.each().find(|(id, element)| own(id) && moves(element.name()));
        let id = first.map_or(ElementId::CARRIER, |(id, _)| id);
        at(id, Field::STIFFNESS)(Problem::Mechanism { coordinates })
    }
}

impl Carried {
    /// Adds the liquids of tanks, with coordinates numbered from `next`.
    fn fill(&mut self, tanks: Vec<(ElementId, Sloshing)>, mut next: usize) {
        for (id, sloshing) in tanks {
            self.slosh.extend(sloshing.blocks(next));
            let Sloshing { tank, bobs, rest } = sloshing;
            self.tanks.push(tank);
            self.rigid.push(rest);
            for (moving_body, _) in bobs {
                let start = next;
                next += moving_body.shapes.len();
                self.moving_bodies.push(Moved { id, moving_body, start });
            }
        }
    }

    /// Number of elastic coordinates.
    fn elastic(&self) -> usize {
        self.flexible + self.component.as_ref().map_or(0, Component::size)
    }

    fn moved(&self, id: ElementId) -> Option<&Moved> {
        let found = self.moving_bodies.binary_search_by_key(&id, |moved| moved.id).ok()?;
        Some(&self.moving_bodies[found])
    }

    /// Angles of appendages on hinges and of liquids in rings, which the spin may restore where no spring does. (I13)
    fn pendulums(&self) -> Vec<usize> {
        let turns = |kind: ElementKind| matches!(kind, ElementKind::Hinged | ElementKind::Tube);
        let turning = self.moving_bodies.iter().filter(|moved| turns(moved.id.kind));
        turning.flat_map(|moved| moved.start..moved.start + moved.moving_body.shapes.len()).collect()
    }

    /// Drives of pieces. (T7)
    fn drives(&self) -> Vec<Drive> {
        self.moving_bodies.iter().filter_map(|moved| moved.moving_body.drive(moved.start)).collect()
    }

    /// First coordinate of an element; the first of all for one without coordinates.
    fn start_of(&self, id: ElementId) -> usize {
        let modal = self.modal_bodies.iter().find(|modal| modal.id == id).map(|modal| modal.start);
        self.moved(id).map(|moved| moved.start).or(modal).unwrap_or(0)
    }

    /// A place on an element that moves: the watched one, then the others.
    fn attachment(&self, id: ElementId, place: usize) -> Option<Attachment> {
        let Moved { moving_body, start, .. } = self.moved(id)?;
        moving_body.attachments(*start).nth(place)
    }

    /// Places of vertices, with the coordinates that displace them.
    fn places<'a>(
        &'a self,
        drawn: &'a BTreeMap<NodeRef, Attachment>,
    ) -> impl Fn(ElementId, Vertex) -> Option<Attachment> + 'a {
        move |id, vertex| match vertex {
            Vertex::Still(place) => Some(Attachment::at(place.into(), false)),
            Vertex::Own(place) => {
                let Moved { moving_body, start, .. } = self.moved(id)?;
                Some(moving_body.place("", &(Vector3::from(place) - moving_body.base), *start))
            }
            Vertex::At(End::Carrier) => None,
            Vertex::At(End::Point(index)) => self.attachment(ElementKind::Point.at(index), 0),
            Vertex::At(End::Hinged(on)) => self.attachment(ElementKind::Hinged.at(on.hinged), 1 + on.place),
            Vertex::At(End::Node(node)) => drawn.get(&node).cloned(),
        }
    }

    fn mass_center(&self) -> (f64, Vector3<f64>) {
        let (mut mass, mut first) = (0.0, Vector3::zeros());
        for (piece, center) in &self.rigid {
            mass += piece.mass;
            first += piece.mass * center;
        }
        for Moved { moving_body, .. } in &self.moving_bodies {
            mass += moving_body.piece.mass;
            first += moving_body.first_moment();
        }
        for Modal { modal_body: ModalBody { piece, base, .. }, .. } in &self.modal_bodies {
            mass += piece.mass;
            first += piece.mass * base + piece.first;
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
        for Moved { moving_body, start, .. } in &self.moving_bodies {
            let rho = moving_body.position(pole);
            add(&mut J, half(moving_body.piece.inertia(&rho, &rho)));
            for H in &moving_body.shapes {
                S.push(moving_body.piece.sum(H));
                h.push(moving_body.piece.cross(&rho, H));
                J1.push(moving_body.piece.inertia(&rho, H));
            }
            pairs.extend(moving_body.pairs(pole, *start));
        }
        let mut coordinate = |(S_j, h_j, J_j): ([f64; 3], [f64; 3], Sym)| {
            S.push(S_j);
            h.push(h_j);
            J1.push(J_j);
        };
        for Modal { modal_body, start, .. } in &self.modal_bodies {
            add(&mut J, half(modal_body.twice_inertia(pole)));
            (0..modal_body.size()).for_each(|j| coordinate(modal_body.coordinate(j, pole)));
            pairs.extend(modal_body.pairs(*start));
        }
        if let Some(component) = &self.component {
            add(&mut J, component.inertia(pole));
            (0..component.size()).for_each(|j| coordinate(component.coordinate(j, pole)));
            pairs.extend(component.pairs(pole, self.flexible));
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

    /// Curved paths: those of parts to second order, those of appendages on hinges at any angles. (K12), (I12)
    fn curved_paths(&self, pole: Vector3<f64>, invariants: &Invariants) -> Option<CurvedPaths> {
        let parts = self.component.as_ref();
        let parts = parts.and_then(|component| component.curved_paths(pole, self.flexible, invariants));
        let straight = || CurvedPaths { straight: invariants.clone(), followers: Vec::new() };
        let mut paths = parts.unwrap_or_else(straight);
        self.moving_bodies
            .iter()
            .for_each(|Moved { moving_body, start, .. }| moving_body.turn(pole, *start, &mut paths));
        (!paths.followers.is_empty()).then_some(paths)
    }

    /// Places whose displacement is watched: points and appendages with the places on them, then nodes of parts.
    fn markers(&self, nodes: &BTreeMap<NodeRef, Attachment>, pole: Vector3<f64>) -> Vec<Marker> {
        let moving_bodies = self
            .moving_bodies
            .iter()
            .flat_map(|Moved { moving_body, start, .. }| moving_body.attachments(*start));
        moving_bodies.chain(nodes.values().cloned()).map(|place| place.marker(pole)).collect()
    }

    fn coordinates(&self) -> Vec<Coordinate> {
        let moving_bodies =
            self.moving_bodies.iter().flat_map(|moved| moved.moving_body.coordinates.iter().cloned());
        let modal_bodies = self.modal_bodies.iter().flat_map(|modal| modal.modal_body.coordinates());
        let parts = self.component.iter().flat_map(Component::coordinates);
        moving_bodies.chain(modal_bodies).chain(parts).chain(self.inner.coordinates.iter().cloned()).collect()
    }
}

fn half(matrix: Sym) -> Sym {
    matrix.map(|entry| 0.5 * entry)
}

fn add(sum: &mut Sym, part: Sym) {
    sum.iter_mut().zip(part).for_each(|(sum, part)| *sum += part);
}
