//! Visual geometry: what a viewer draws of each element, with the displacement of every vertex by the internal coordinates.
//! Kinds of elements give outlines on places of the body; the assembly resolves the places, so that no kind knows the coordinates.
//! A body looks as its model says: a carrier known by its inertia alone is the box with that inertia.

mod boundary;
mod disc;
mod outline;
mod shapes;
mod thinned;

pub(crate) use boundary::boundary;
pub(crate) use disc::disc;
pub(crate) use outline::{Outline, Vertex};
pub(crate) use shapes::{Triangulated, cuboid, cuboid_of, ellipsoid, revolved};
pub(crate) use thinned::thinned;

use std::collections::{BTreeMap, HashSet};

use nalgebra::Vector3;

use crate::contribution::Attachment;
use crate::element::Element;
use crate::{Assembly, ElementId, ElementKind, End};

/// Most elements of a kind that are drawn.
const MOST_OF_A_KIND: usize = 3_000;

/// Visual geometry of an element: vertices with their displacements, joined by lines and triangles; without these they are points.
#[derive(Clone, Debug, PartialEq)]
pub struct Visual {
    /// The element.
    pub element: ElementId,
    /// Name of the element; empty for one without.
    pub name: String,
    /// Words for the kind of the element.
    pub kind: &'static str,
    /// Vertices at equilibrium (m), from the pole, body axes.
    pub vertices: Vec<[f64; 3]>,
    /// Coordinates that displace vertices, ascending, each with the displacement of every vertex per unit.
    pub shapes: Vec<(usize, Vec<[f64; 3]>)>,
    /// Lines between two vertices each.
    pub lines: Vec<[usize; 2]>,
    /// Triangles, counter-clockwise seen from outside where there is an outside.
    pub triangles: Vec<[usize; 3]>,
    /// Radius of points and lines (m), where the model gives one.
    pub radius: Option<f64>,
    /// Axis of a rotor, which its rotation turns the vertices about.
    pub turning: Option<RotorAxis>,
}

/// Axis about which an element turns in its carrier.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotorAxis {
    /// Direction, a unit vector.
    pub axis: [f64; 3],
    /// Point of the axis (m), from the pole.
    pub center: [f64; 3],
    /// Cyclic coordinate that is the angle (rad).
    pub coordinate: usize,
}

impl Visual {
    /// Surface of an element that is a whole body; `shapes` gives the displacement of a vertex per unit of each coordinate.
    pub(crate) fn surface(
        (element, name): (ElementId, &str),
        (vertices, triangles): Triangulated,
        shapes: impl Fn([f64; 3]) -> Vec<(usize, [f64; 3])>,
    ) -> Self {
        let moved: Vec<_> = vertices.iter().map(|vertex| shapes(*vertex)).collect();
        Self {
            element,
            name: name.to_owned(),
            kind: element.kind.words(),
            shapes: by_coordinate(&moved),
            vertices,
            lines: Vec::new(),
            triangles,
            radius: None,
            turning: None,
        }
    }
}

impl Assembly {
    /// Points and nodes of parts on which outlines have vertices.
    pub(crate) fn drawn_ends(&self) -> HashSet<End> {
        let of_outline = |(id, _, outline): (ElementId, &'static str, Outline)| {
            outline.vertices.into_iter().filter_map(move |vertex| match vertex {
                Vertex::At(end) => Some(end),
                Vertex::Own(_) if id.kind == ElementKind::Point => Some(End::Point(id.index)),
                Vertex::Own(_) | Vertex::Still(_) => None,
            })
        };
        self.outlines().flat_map(of_outline).collect()
    }

    /// Visual geometry of the elements, with each vertex at the place that `place` finds.
    pub(crate) fn visuals_at(
        &self,
        pole: Vector3<f64>,
        place: &dyn Fn(ElementId, Vertex) -> Option<Attachment>,
        rotor: &dyn Fn(ElementId) -> Option<usize>,
    ) -> Vec<Visual> {
        let visual =
            |(element, kind, outline): (ElementId, &'static str, Outline)| {
                let places: Vec<Attachment> =
                    outline.vertices.iter().map(|vertex| place(element, *vertex)).collect::<Option<_>>()?;
                let turning = outline.axis.zip(rotor(element)).map(|((axis, center), coordinate)| {
                    RotorAxis { axis, center: (Vector3::from(center) - pole).into(), coordinate }
                });
                Some(Visual {
                    element,
                    name: self.element(element).map_or_else(String::new, |element| element.name().to_owned()),
                    kind,
                    vertices: places.iter().map(|place| (place.position - pole).into()).collect(),
                    shapes: by_coordinate(&places.into_iter().map(|place| place.shapes).collect::<Vec<_>>()),
                    lines: outline.lines,
                    triangles: outline.triangles,
                    radius: outline.radius,
                    turning,
                })
            };
        self.outlines().filter_map(visual).collect()
    }

    /// Outlines of the elements that are seen, with the words for their kinds; of very many of a kind some, evenly among all.
    fn outlines(&self) -> impl Iterator<Item = (ElementId, &'static str, Outline)> + '_ {
        let carrier =
            self.carrier.iter().filter_map(|carrier| Some((ElementId::CARRIER, carrier.outline()?)));
        let mut counts: BTreeMap<ElementKind, usize> = BTreeMap::new();
        self.each().for_each(|(id, _)| *counts.entry(id.kind).or_default() += 1);
        let drawn =
            move |id: ElementId| id.index.is_multiple_of(counts[&id.kind].div_ceil(MOST_OF_A_KIND).max(1));
        let elements = self.each().filter(move |(id, _)| drawn(*id));
        let elements = elements.filter_map(|(id, element)| Some((id, element.outline(id, self)?)));
        carrier.chain(elements).map(|(id, outline)| {
            let words = self.element(id).and_then(Element::words);
            (id, words.unwrap_or_else(|| id.kind.words()), outline)
        })
    }
}

/// Displacements of places, coordinate by coordinate.
fn by_coordinate(places: &[Vec<(usize, [f64; 3])>]) -> Vec<(usize, Vec<[f64; 3]>)> {
    let mut found: BTreeMap<usize, Vec<[f64; 3]>> = BTreeMap::new();
    for (place, shapes) in places.iter().enumerate() {
        for (coordinate, shape) in shapes {
            found.entry(*coordinate).or_insert_with(|| vec![[0.0; 3]; places.len()])[place] = *shape;
        }
    }
    found.into_iter().collect()
}
