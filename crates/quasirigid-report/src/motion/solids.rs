//! Pieces of a scene as a few polygons, lines and dots, which a drawing of hundreds of frames can afford.

use std::collections::BTreeMap;

use quasirigid_io::record::{PieceRecord, SceneRecord};

use crate::columns::norm;
use crate::sphere::vector::{Vector, cross, direction, dot};

/// Faces up to which a surface is drawn face by face; beyond it is round.
const FACES: usize = 24;
/// Cosine of the angle between normals of triangles in one plane.
const PLANE: f64 = 0.9995;
/// Thickness over length up to which a piece is a line.
const SLENDER: f64 = 0.06;
/// Lines, and dots, of a piece of very many.
const MAX_LINES: usize = 96;
/// Meridians that show how a round body turns, arcs of each, and points of an arc.
const ARCS: usize = 6;
const POINTS: usize = 3;

/// A shape in body axes (m).
#[derive(Clone, Debug)]
pub enum Shape {
    /// Polygon, seen from the side of its normal, or from both sides if it has none.
    Face { corners: Vec<Vector>, normal: Option<Vector> },
    /// Points whose hull is drawn.
    Hull(Vec<Vector>),
    /// Line, on a surface with a normal or free.
    Line { points: Vec<Vector>, normal: Option<Vector> },
    /// Dot with a radius.
    Dot(Vector, f64),
}

/// A piece.
#[derive(Clone, Debug)]
pub struct Solid {
    /// Kind of the element.
    pub kind: String,
    /// Centre of its vertices.
    pub center: Vector,
    /// Shapes, the first at the back.
    pub shapes: Vec<Shape>,
    /// Place with respect to the largest closed piece.
    pub place: Place,
    /// Largest distance from the centre, of a closed surface; zero of others.
    reach: f64,
}

/// Place of a piece with respect to the largest closed one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// That piece; every piece, where none is closed.
    Largest,
    /// Within it.
    Inside,
    /// Beside it.
    Beside,
}

/// Pieces of a scene, without those that have nothing to draw.
pub fn solids(scene: &SceneRecord) -> Vec<Solid> {
    let mut solids: Vec<Solid> = scene.pieces.iter().filter_map(|piece| solid(piece, scene)).collect();
    let largest = (0..solids.len()).max_by(|a, b| solids[*a].reach.total_cmp(&solids[*b].reach));
    let Some((index, around)) =
        largest.map(|index| (index, solids[index].clone())).filter(|(_, it)| it.reach > 0.0)
    else {
        return solids;
    };
    for (number, solid) in solids.iter_mut().enumerate() {
        let far = norm(minus(solid.center, around.center));
        solid.place = match solid.reach > 0.0 && far + solid.reach < around.reach {
            _ if number == index => Place::Largest,
            true => Place::Inside,
            false => Place::Beside,
        };
        if solid.place == Place::Inside {
            solid.shapes.retain(|shape| !matches!(shape, Shape::Line { .. }));
        }
    }
    solids
}

fn solid(piece: &PieceRecord, scene: &SceneRecord) -> Option<Solid> {
    let vertices = piece.vertices.unpack();
    let center = mean(&vertices)?;
    let triangles = piece.triangles.as_ref().map(|list| list.0.as_chunks::<3>().0);
    let lines = piece.lines.as_ref().map(|list| list.0.as_chunks::<2>().0);
    let (mut shapes, mut reach) = (Vec::new(), 0.0);
    if let Some(triangles) = triangles.filter(|triangles| !triangles.is_empty()) {
        if let Some(line) = slender(&vertices) {
            shapes.push(line);
        } else {
            let surface = Surface::new(&vertices, triangles)?;
            shapes.extend(surface.shapes(center, scene.principal.axes));
            reach = if surface.is_closed() { farthest(&vertices, center)?.1 } else { 0.0 };
        }
    } else if let Some(lines) = lines.filter(|lines| !lines.is_empty()) {
        let of = |pair: &[u16; 2]| pair.map(|end| vertices.get(usize::from(end)).copied());
        // a few of thousands of lines would hang in the air
        let shown = if lines.len() > MAX_LINES && scene.pieces.len() > 1 { &[] } else { lines };
        let ends =
            shown.iter().step_by(shown.len().div_ceil(MAX_LINES).max(1)).filter_map(|pair| match of(pair) {
                [Some(a), Some(b)] => Some(Shape::Line { points: vec![a, b], normal: None }),
                _ => None,
            });
        shapes.extend(ends);
    } else {
        let size = piece.size.unwrap_or(0.02 * scene.radius);
        shapes.extend(
            vertices.iter().step_by(vertices.len().div_ceil(MAX_LINES)).map(|v| Shape::Dot(*v, size)),
        );
    }
    (!shapes.is_empty()).then(|| Solid {
        kind: piece.kind.clone(),
        center,
        shapes,
        place: Place::Largest,
        reach,
    })
}

impl Shape {
    /// Number of points that a frame writes.
    pub fn points(&self) -> usize {
        match self {
            Self::Face { corners, .. } => corners.len(),
            Self::Hull(_) => super::drawing::HULL,
            Self::Line { points, .. } => points.len(),
            Self::Dot(..) => 1,
        }
    }
}

fn mean(vertices: &[Vector]) -> Option<Vector> {
    let sum = vertices.iter().fold([0.0; 3], |sum, v| [0, 1, 2].map(|i| sum[i] + v[i]));
    (!vertices.is_empty()).then(|| sum.map(|part| part / vertices.len() as f64))
}

fn minus(a: Vector, b: Vector) -> Vector {
    [0, 1, 2].map(|i| a[i] - b[i])
}

fn farthest(vertices: &[Vector], from: Vector) -> Option<(Vector, f64)> {
    let far = |v: &Vector| {
        let gap = minus(*v, from);
        dot(gap, gap).sqrt()
    };
    vertices.iter().map(|v| (*v, far(v))).max_by(|a, b| a.1.total_cmp(&b.1))
}

/// The axis of a slender piece.
fn slender(vertices: &[Vector]) -> Option<Shape> {
    let (a, _) = farthest(vertices, mean(vertices)?)?;
    let (b, length) = farthest(vertices, a)?;
    let along = direction(minus(b, a))?;
    let center = mean(vertices)?;
    let off = |v: &Vector| {
        let gap = cross(minus(*v, center), along);
        dot(gap, gap).sqrt()
    };
    let radius = vertices.iter().map(off).fold(0.0, f64::max);
    let end = |at: Vector| {
        let s = dot(minus(at, center), along);
        [0, 1, 2].map(|i| center[i] + s * along[i])
    };
    (2.0 * radius < SLENDER * length).then(|| Shape::Line { points: vec![end(a), end(b)], normal: None })
}

/// Triangles between places.
struct Surface {
    places: Vec<Vector>,
    triangles: Vec<[usize; 3]>,
    normals: Vec<Vector>,
    /// Triangles at each edge, the edge turned as the first has it.
    edges: BTreeMap<[usize; 2], Vec<usize>>,
}

impl Surface {
    /// Vertices at one place are one; triangles without an area are left out.
    fn new(vertices: &[Vector], triangles: &[[u16; 3]]) -> Option<Self> {
        let mut known: BTreeMap<[u64; 3], usize> = BTreeMap::new();
        let mut places = Vec::new();
        let number: Vec<usize> = vertices
            .iter()
            .map(|vertex| {
                *known.entry(vertex.map(|part| (part + 0.0).to_bits())).or_insert_with(|| {
                    places.push(*vertex);
                    places.len() - 1
                })
            })
            .collect();
        let (mut kept, mut normals) = (Vec::new(), Vec::new());
        for triangle in triangles {
            let [a, b, c] = triangle.map(|corner| number.get(usize::from(corner)).copied());
            let (Some(a), Some(b), Some(c)) = (a, b, c) else { continue };
            let area = cross(minus(places[b], places[a]), minus(places[c], places[a]));
            if let Some(normal) = direction(area) {
                kept.push([a, b, c]);
                normals.push(normal);
            }
        }
        let mut edges: BTreeMap<[usize; 2], Vec<usize>> = BTreeMap::new();
        for (index, triangle) in kept.iter().enumerate() {
            for [a, b] in sides(*triangle) {
                edges.entry([a.min(b), a.max(b)]).or_default().push(index);
            }
        }
        (!kept.is_empty()).then_some(Self { places, triangles: kept, normals, edges })
    }

    fn is_closed(&self) -> bool {
        self.edges.values().all(|sharing| sharing.len() == 2)
    }

    /// Faces of a body with few; of a round one the hull and two meridians.
    fn shapes(&self, center: Vector, axes: [Vector; 3]) -> Vec<Shape> {
        let closed = self.is_closed();
        let groups = self.planes();
        if groups.len() <= FACES {
            let face = |group: &Vec<usize>| {
                let corners = self.border(group)?;
                let normal = self.normals[group[0]];
                let outwards = dot(normal, minus(corners[0], center)) >= 0.0;
                let normal = if outwards { normal } else { normal.map(|part| -part) };
                Some(Shape::Face { corners, normal: closed.then_some(normal) })
            };
            return groups.iter().filter_map(face).collect();
        }
        let hull = Shape::Hull(self.places.clone());
        let planes = [[axes[0], axes[2]], [axes[0], axes[1]]];
        [hull].into_iter().chain(planes.iter().flat_map(|plane| self.meridian(center, *plane))).collect()
    }

    /// Triangles in one plane that hang together.
    fn planes(&self) -> Vec<Vec<usize>> {
        let mut owner: Vec<Option<usize>> = vec![None; self.triangles.len()];
        let mut groups = Vec::new();
        for first in 0..self.triangles.len() {
            if owner[first].is_some() {
                continue;
            }
            let (mut group, mut next) = (Vec::new(), vec![first]);
            owner[first] = Some(groups.len());
            while let Some(triangle) = next.pop() {
                group.push(triangle);
                for [a, b] in sides(self.triangles[triangle]) {
                    for other in &self.edges[&[a.min(b), a.max(b)]] {
                        let same = dot(self.normals[first], self.normals[*other]).abs() > PLANE;
                        if same && owner[*other].is_none() {
                            owner[*other] = Some(groups.len());
                            next.push(*other);
                        }
                    }
                }
            }
            groups.push(group);
        }
        groups
    }

    /// The longest border of some triangles, without corners on straight lines.
    fn border(&self, group: &[usize]) -> Option<Vec<Vector>> {
        let inside = |edge: &[usize; 2]| {
            let sharing = &self.edges[&[edge[0].min(edge[1]), edge[0].max(edge[1])]];
            sharing.iter().filter(|triangle| group.contains(triangle)).count() > 1
        };
        let mut next: BTreeMap<usize, usize> = group
            .iter()
            .flat_map(|triangle| sides(self.triangles[*triangle]))
            .filter(|edge| !inside(edge))
            .map(|[a, b]| (a, b))
            .collect();
        let mut longest: Vec<usize> = Vec::new();
        while let Some((start, _)) = next.first_key_value().map(|(a, b)| (*a, *b)) {
            let (mut border, mut at) = (Vec::new(), start);
            while let Some(to) = next.remove(&at) {
                border.push(at);
                at = to;
            }
            if border.len() > longest.len() {
                longest = border;
            }
        }
        let count = longest.len();
        let place = |i: usize| self.places[longest[i % count]];
        let bends = |i: &usize| {
            let [Some(a), Some(b)] =
                [(i + count - 1, *i), (*i, i + 1)].map(|(from, to)| direction(minus(place(to), place(from))))
            else {
                return false;
            };
            dot(a, b) < PLANE
        };
        let corners: Vec<Vector> = (0..count).filter(bends).map(place).collect();
        (corners.len() > 2).then_some(corners)
    }

    /// Arcs of the line in which a plane through the centre cuts the surface, seen from the centre in all directions.
    fn meridian(&self, center: Vector, [along, up]: [Vector; 2]) -> Vec<Shape> {
        let at = |i: usize| {
            let (sin, cos) = (std::f64::consts::TAU * i as f64 / (ARCS * (POINTS - 1)) as f64).sin_cos();
            let ray = [0, 1, 2].map(|k| cos * along[k] + sin * up[k]);
            self.pierced(center, ray).map(|far| [0, 1, 2].map(|k| center[k] + far * ray[k]))
        };
        let arc = |arc: usize| {
            let points: Vec<Vector> = (0..POINTS).filter_map(|i| at(arc * (POINTS - 1) + i)).collect();
            let normal = direction(minus(*points.get(POINTS / 2)?, center));
            Some(Shape::Line { points, normal })
        };
        (0..ARCS).filter_map(arc).collect()
    }

    /// Distance along a ray to the last triangle that it meets.
    fn pierced(&self, from: Vector, ray: Vector) -> Option<f64> {
        let met = |corners: &[usize; 3]| {
            let [a, b, c] = corners.map(|corner| self.places[corner]);
            let (u, v, w) = (minus(b, a), minus(c, a), minus(from, a));
            let across = cross(ray, v);
            let volume = dot(u, across);
            let (s, lifted) = (dot(w, across) / volume, cross(w, u));
            let t = dot(ray, lifted) / volume;
            let far = dot(v, lifted) / volume;
            let slack = -1e-6;
            (s >= slack && t >= slack && s + t <= 1.0 - slack && far > 0.0).then_some(far)
        };
        self.triangles.iter().filter_map(met).reduce(f64::max)
    }
}

fn sides([a, b, c]: [usize; 3]) -> [[usize; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}
