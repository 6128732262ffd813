//! Distance to a surface: the nearest point, and the side on which a point is.

use std::f64::consts::PI;

use super::ClosedSurface;
use super::geometry::{Corners, bounds, triple};
use super::shells::solid_angle;
use super::topology;
use super::tree::{Bounds, Tree};
use quasirigid_math::connected_components::connected_components;
use quasirigid_math::vec3::{add, cross, dot, minus, norm, scale};

/// Triangles prepared for queries of the nearest of them.
pub struct NearestTriangles {
    triangles: Vec<Corners>,
    tree: Tree,
}

/// A closed surface prepared for queries of distance.
pub(crate) struct Proximity {
    all: NearestTriangles,
    normals: Vec<Normals>,
}

/// Outward normals of a triangle, of the edges that leave its corners, and of its corners.
struct Normals {
    face: [f64; 3],
    edges: [[f64; 3]; 3],
    /// Normals of corners; none where parts of the surface meet in a corner and nowhere near it.
    corners: [Option<[f64; 3]>; 3],
}

/// Part of a triangle: all of it, the edge that leaves a corner, a corner.
#[derive(Clone, Copy)]
enum Feature {
    Face,
    Edge(usize),
    Corner(usize),
}

/// The point of a surface nearest to another.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Nearest {
    pub at: [f64; 3],
    /// Distance, negative from inside.
    pub distance: f64,
}

impl NearestTriangles {
    /// The triangles by their corners; none without any.
    #[must_use]
    pub fn new(triangles: Vec<[[f64; 3]; 3]>) -> Option<Self> {
        let boxes: Vec<Bounds> = triangles.iter().map(|corners| bounds(corners.iter().copied())).collect();
        (!triangles.is_empty()).then(|| Self { tree: Tree::new(&boxes), triangles })
    }

    /// Index of the nearest triangle, and its point nearest to another.
    #[must_use]
    pub fn nearest(&self, point: [f64; 3]) -> (usize, [f64; 3]) {
        let (triangle, _, at) = self.found(point);
        (triangle, at)
    }

    fn found(&self, point: [f64; 3]) -> (usize, Feature, [f64; 3]) {
        let (mut best, mut square) = ((0, Feature::Face, point), f64::INFINITY);
        let mut open = vec![(self.tree.nodes.len() - 1, 0.0)];
        while let Some((node, least)) = open.pop() {
            if least >= square {
                continue;
            }
            let node = &self.tree.nodes[node];
            if let Some(children) = node.children {
                let mut children = children.map(|child| (child, away(&self.tree.nodes[child].bounds, point)));
                // The nearer child is opened first.
                children.sort_by(|a, b| b.1.total_cmp(&a.1));
                open.extend(children);
                continue;
            }
            for triangle in &self.tree.order[node.items.clone()] {
                let (feature, at) = nearest_of(&self.triangles[*triangle], point);
                let from = minus(point, at);
                if dot(from, from) < square {
                    (best, square) = ((*triangle, feature, at), dot(from, from));
                }
            }
        }
        best
    }
}

impl Proximity {
    /// Surface after a map of its vertices, which may move, rotate and stretch it as a whole.
    pub fn new(surface: &ClosedSurface, map: impl Fn([f64; 3]) -> [f64; 3]) -> Self {
        let place = |corners: &[usize; 3]| corners.map(|corner| map(surface.vertices[corner]));
        let triangles: Vec<Corners> = surface.triangles.iter().map(place).collect();
        let normals = normals(&triangles, &surface.triangles);
        Self { all: NearestTriangles::new(triangles).expect("a closed surface has triangles"), normals }
    }

    /// Volume that the surface encloses.
    pub fn volume(&self) -> f64 {
        let about = self.all.triangles[0][0];
        let six = |[a, b, c]: &Corners| triple(minus(*a, about), minus(*b, *a), minus(*c, *a));
        self.all.triangles.iter().map(six).sum::<f64>() / 6.0
    }

    /// Nearest point. The side is that of the normal there; the normal of edges and corners is the mean of their triangles, weighted by
    /// angles `[@baerentzen2005]`.
    pub fn nearest(&self, point: [f64; 3]) -> Nearest {
        let (triangle, feature, at) = self.all.found(point);
        let normals = &self.normals[triangle];
        let normal = match feature {
            Feature::Face => Some(normals.face),
            Feature::Edge(edge) => Some(normals.edges[edge]),
            Feature::Corner(corner) => normals.corners[corner],
        };
        let inside =
            normal.map_or_else(|| self.encloses(point), |normal| dot(minus(point, at), normal) < 0.0);
        let distance = norm(minus(point, at));
        Nearest { at, distance: if inside { -distance } else { distance } }
    }

    /// Whether the surface winds around a point.
    fn encloses(&self, point: [f64; 3]) -> bool {
        let angle = |corners: &Corners| solid_angle(corners.map(|corner| minus(corner, point)));
        self.all.triangles.iter().map(angle).sum::<f64>() > 2.0 * PI
    }
}

/// Square of the distance to a box.
fn away([low, high]: &Bounds, point: [f64; 3]) -> f64 {
    let out = |axis: usize| (low[axis] - point[axis]).max(point[axis] - high[axis]).max(0.0);
    let out = [out(0), out(1), out(2)];
    dot(out, out)
}

/// Nearest point of a triangle, and the feature on which it is `[@ericson2005]`.
fn nearest_of([a, b, c]: &Corners, point: [f64; 3]) -> (Feature, [f64; 3]) {
    let (ab, ac) = (minus(*b, *a), minus(*c, *a));
    let along = |from: [f64; 3]| [dot(ab, minus(point, from)), dot(ac, minus(point, from))];
    let [d1, d2] = along(*a);
    if d1 <= 0.0 && d2 <= 0.0 {
        return (Feature::Corner(0), *a);
    }
    let [d3, d4] = along(*b);
    if d3 >= 0.0 && d4 <= d3 {
        return (Feature::Corner(1), *b);
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return (Feature::Edge(0), add(*a, scale(d1 / (d1 - d3), ab)));
    }
    let [d5, d6] = along(*c);
    if d6 >= 0.0 && d5 <= d6 {
        return (Feature::Corner(2), *c);
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return (Feature::Edge(2), add(*a, scale(d2 / (d2 - d6), ac)));
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        let share = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return (Feature::Edge(1), add(*b, scale(share, minus(*c, *b))));
    }
    let whole = 1.0 / (va + vb + vc);
    (Feature::Face, add(*a, add(scale(vb * whole, ab), scale(vc * whole, ac))))
}

/// Weights of the corners of a triangle in its point nearest to another.
#[must_use]
pub fn nearest_weights(corners: [[f64; 3]; 3], point: [f64; 3]) -> [f64; 3] {
    let (_, at) = nearest_of(&corners, point);
    let [u, v, w] = [corners[1], corners[2], at].map(|place| minus(place, corners[0]));
    let normal = cross(u, v);
    let [s, t] = [cross(w, v), cross(u, w)].map(|part| dot(part, normal) / dot(normal, normal));
    [1.0 - s - t, s, t]
}

/// Normals of all triangles, with corners by place and by number of vertex.
fn normals(triangles: &[Corners], vertices: &[[usize; 3]]) -> Vec<Normals> {
    let faces: Vec<[f64; 3]> = triangles
        .iter()
        .map(|[a, b, c]| {
            let normal = cross(minus(*b, *a), minus(*c, *a));
            scale(1.0 / norm(normal), normal)
        })
        .collect();
    let mut sides: Vec<([usize; 2], usize, usize)> = Vec::with_capacity(3 * triangles.len());
    for (triangle, corners) in vertices.iter().enumerate() {
        for (side, [from, to]) in topology::edges(*corners).into_iter().enumerate() {
            sides.push(([from.min(to), from.max(to)], triangle, side));
        }
    }
    sides.sort_unstable();
    let mut edges = vec![[[0.0; 3]; 3]; triangles.len()];
    let mut joints = Vec::with_capacity(sides.len());
    for pair in sides.chunk_by(|a, b| a.0 == b.0) {
        let normal = pair.iter().fold([0.0; 3], |sum, (_, triangle, _)| add(sum, faces[*triangle]));
        for (_, triangle, side) in pair {
            edges[*triangle][*side] = normal;
        }
        if let [(_, t, i), (_, u, j)] = *pair {
            // The two pass the edge in opposite directions.
            joints.push([3 * t + i, 3 * u + (j + 1) % 3]);
            joints.push([3 * t + (i + 1) % 3, 3 * u + j]);
        }
    }
    let fans = connected_components(3 * triangles.len(), joints);
    let mut corners = vec![[None; 3]; triangles.len()];
    let vertex = |corner: &usize| vertices[corner / 3][corner % 3];
    let mut count = vec![0_usize; vertices.iter().flatten().fold(0, |most, vertex| most.max(vertex + 1))];
    fans.iter().for_each(|fan| count[vertex(&fan[0])] += 1);
    for fan in fans.iter().filter(|fan| count[vertex(&fan[0])] == 1) {
        let weighted = |corner: &usize| scale(angle(&triangles[corner / 3], corner % 3), faces[corner / 3]);
        let normal = fan.iter().map(weighted).fold([0.0; 3], add);
        fan.iter().for_each(|corner| corners[corner / 3][corner % 3] = Some(normal));
    }
    let all = faces.into_iter().zip(edges).zip(corners);
    all.map(|((face, edges), corners)| Normals { face, edges, corners }).collect()
}

/// Angle of a triangle at a corner.
fn angle(triangle: &Corners, corner: usize) -> f64 {
    let to = |other: usize| minus(triangle[(corner + other) % 3], triangle[corner]);
    let (u, v) = (to(1), to(2));
    norm(cross(u, v)).atan2(dot(u, v))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::testing::{block, turned};
    use super::*;

    /// Distance to a box from `low` to `high`, negative inside.
    fn from_box(point: [f64; 3], low: [f64; 3], high: [f64; 3]) -> f64 {
        let out: [f64; 3] =
            std::array::from_fn(|axis| (low[axis] - point[axis]).max(point[axis] - high[axis]));
        norm(out.map(|x| x.max(0.0))) + out.into_iter().fold(f64::NEG_INFINITY, f64::max).min(0.0)
    }

    proptest! {
        /// Outside, the distance is the less of those to the two boxes of the block; inside it is up to the missing one,
        /// or to the box around both.
        #[test]
        fn distances_are_those_of_boxes(
            x in -1.0..3.0, y in -1.0..3.0, z in -1.0..2.0, on_lattice in any::<bool>(), exponent in -3..4i32
        ) {
            let unit = 10f64.powi(exponent);
            let place = turned(unit);
            let proximity = Proximity::new(&block(place), |at| at);
            // Points straight over edges and corners as well.
            let point = [x, y, z].map(|x: f64| if on_lattice { (2.0 * x).round() / 2.0 } else { x });
            let outside = from_box(point, [0.0; 3], [2.0, 1.0, 1.0]).min(from_box(point, [0.0; 3], [1.0, 2.0, 1.0]));
            let missing = from_box(point, [1.0, 1.0, -9.0], [9.0, 9.0, 9.0]);
            let inside = from_box(point, [0.0; 3], [2.0, 2.0, 1.0]).max(-missing);
            let exact = if outside > 0.0 { outside } else { inside };
            let found = proximity.nearest(place(point));
            prop_assert!((found.distance / unit - exact).abs() < 1e-13, "{:?} {:e}", found, exact);
            prop_assert!(proximity.nearest(found.at).distance.abs() < 1e-14 * unit);
            let away = norm(minus(place(point), found.at)) / unit;
            prop_assert!((away - exact.abs()).abs() < 1e-13);
        }
    }

    proptest! {
        /// No point of a triangle is nearer, and the choice of the first corner does not matter.
        #[test]
        fn the_nearest_point_of_a_triangle_is_the_nearest(
            [ax, ay, bx, by, cx, cy, x, y, z] in prop::array::uniform9(-1.0..1.0), u in 0.0..1.0, v in 0.0..1.0
        ) {
            let [a, b, c]: Corners = [[ax, ay, 0.3], [bx, by, 0.1], [cx, cy, -0.2]];
            let away = |triangle: Corners| norm(minus([x, y, z], nearest_of(&triangle, [x, y, z]).1));
            let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
            let other = add(a, add(scale(u, minus(b, a)), scale(v, minus(c, a))));
            prop_assert!(away([a, b, c]) <= norm(minus([x, y, z], other)) + 1e-12);
            // Flat triangles, which surfaces do not have, would lose digits.
            prop_assume!(norm(cross(minus(b, a), minus(c, a))) > 0.01);
            prop_assert!((away([a, b, c]) - away([b, c, a])).abs() < 1e-12);
            prop_assert!((away([a, b, c]) - away([c, a, b])).abs() < 1e-12);
            let weights = nearest_weights([a, b, c], [x, y, z]);
            let weighed = add(scale(weights[0], a), add(scale(weights[1], b), scale(weights[2], c)));
            prop_assert!(norm(minus(weighed, nearest_of(&[a, b, c], [x, y, z]).1)) < 1e-12);
        }
    }

    #[test]
    fn volumes_are_exact() {
        for unit in [1e-3, 1.0, 1e3] {
            let volume = Proximity::new(&block(turned(unit)), |at| at.map(|x| 2.0 * x)).volume();
            assert!((volume / (24.0 * unit.powi(3)) - 1.0).abs() < 1e-13, "{volume}");
        }
    }

    #[test]
    fn sides_are_right_where_bodies_share_a_corner() {
        // Two tetrahedra tip to tip; the lower one has a notch, so that points in it have the tip for their nearest.
        let mut vertices = vec![[0.0; 3], [1.0, 0.0, 1.0], [-1.0, 1.0, 1.0], [-1.0, -1.0, 1.0]];
        vertices.extend([[3.0, 0.0, 1.0], [-3.0, 3.0, 1.0], [-3.0, -3.0, 1.0], [0.0, 0.0, -5.0]]);
        let up = [[0, 2, 1], [0, 3, 2], [0, 1, 3], [1, 2, 3]];
        let down = [[0, 4, 5], [0, 5, 6], [0, 6, 4], [7, 5, 4], [7, 6, 5], [7, 4, 6]];
        // The tree takes its triangles in an order that depends on their places.
        for axis in 0..3 {
            let turned = |mut at: [f64; 3]| {
                at.rotate_right(axis);
                at
            };
            let vertices = vertices.iter().copied().map(turned).collect();
            let surface = ClosedSurface::new(vertices, up.into_iter().chain(down).collect()).unwrap();
            for sign in [1.0, -1.0] {
                // Both rotated around an axis through the tip.
                let around = |[x, y, z]: [f64; 3]| [x, sign * y, sign * z];
                let proximity = Proximity::new(&surface, around);
                let distance = |at: [f64; 3]| proximity.nearest(around(turned(at))).distance;
                assert!((distance([0.0, 0.0, -0.3]) + 0.3).abs() < 1e-15);
                assert!(distance([0.0, 0.0, 0.3]) < 0.0);
                assert!(distance([0.9, 0.0, 0.6]) > 0.0 && distance([0.0, 0.0, 1.1]) > 0.0);
            }
        }
    }
}
