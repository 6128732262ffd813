//! Structured meshes: blocks of hexahedra with all 27 nodes, of which the other cells use some.

use std::collections::HashMap;
use std::f64::consts::FRAC_PI_4;
use std::sync::Arc;

use nalgebra::Vector3;
use quasirigid::elements::{ElasticMaterial, Material, Part, PartKind, Region, Solid};
use quasirigid_mesh::surface::ClosedSurface;
use quasirigid_mesh::{Cell, Mesh, Shape};

use crate::support::parts;

/// Hexahedra between nodes, each with its 27 in the order of [`Shape::Hex27`].
#[derive(Default)]
pub struct Hexahedra {
    pub nodes: Vec<Vector3<f64>>,
    pub cells: Vec<[usize; 27]>,
    known: HashMap<[i64; 3], usize>,
}

/// Faces of a hexahedron by its corners.
const FACES: [[usize; 4]; 6] =
    [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];
/// Ends of the edges of a tetrahedron, in the order of [`Shape::Tet10`].
const EDGES: [[usize; 2]; 6] = [[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]];

impl Hexahedra {
    /// A block of cells: a map of the unit cube, with so many along each of its axes.
    pub fn add(&mut self, counts: [usize; 3], map: impl Fn([f64; 3]) -> Vector3<f64>) {
        for cell in 0..counts.iter().product() {
            let first = [cell % counts[0], cell / counts[0] % counts[1], cell / counts[0] / counts[1]];
            let nodes = Shape::Hex27.reference().into_iter().map(|place| {
                let share =
                    |axis: usize| (first[axis] as f64 + 0.5 * (1.0 + place[axis])) / counts[axis] as f64;
                self.node(map([0, 1, 2].map(share)))
            });
            let nodes: Vec<usize> = nodes.collect();
            self.cells.push(nodes.try_into().unwrap());
        }
    }

    /// The unit ball: a cube of `2n` cells along each edge and `n` layers around it. No cell has two faces on the
    /// surface, so none is flat.
    pub fn ball(n: usize) -> Self {
        let mut ball = Self::default();
        let core = |direction: Vector3<f64>| 0.45 * direction;
        let sphere = |direction: Vector3<f64>| direction.map(|x| (FRAC_PI_4 * x).tan()).normalize();
        ball.add([2 * n; 3], |place| core(Vector3::from(place.map(|x| 2.0 * x - 1.0))));
        for (axis, side) in (0..3).flat_map(|axis| [(axis, 1.0), (axis, -1.0)]) {
            ball.add([2 * n, 2 * n, n], |[u, v, t]| {
                let [u, v] = if side > 0.0 { [u, v] } else { [v, u] };
                let mut direction = Vector3::zeros();
                direction[axis] = side;
                direction[(axis + 1) % 3] = 2.0 * u - 1.0;
                direction[(axis + 2) % 3] = 2.0 * v - 1.0;
                (1.0 - t) * core(direction) + t * sphere(direction)
            });
        }
        ball
    }

    fn node(&mut self, place: Vector3<f64>) -> usize {
        let key = [0, 1, 2].map(|axis| (place[axis] * 1e9).round() as i64);
        *self.known.entry(key).or_insert_with(|| {
            self.nodes.push(place);
            self.nodes.len() - 1
        })
    }

    /// The cells in one of the shapes of solids, at other places.
    pub fn mesh(&self, shape: Shape, place: impl Fn(Vector3<f64>) -> Vector3<f64>) -> Mesh {
        let split = matches!(shape, Shape::Tet4 | Shape::Tet10);
        let cells: Vec<Vec<usize>> = if split {
            self.cells.iter().flat_map(|cell| tetrahedra(cell, shape.nodes())).collect()
        } else {
            self.cells.iter().map(|cell| cell[..shape.nodes()].to_vec()).collect()
        };
        mesh(shape, &self.nodes, &cells, place)
    }
}

/// Six tetrahedra: faces are cut from their first node on, so that neighbours agree.
fn tetrahedra(cell: &[usize; 27], count: usize) -> Vec<Vec<usize>> {
    let places = Shape::Hex27.reference();
    let lowest = |corners: &[usize]| corners.iter().copied().min_by_key(|corner| cell[*corner]).unwrap();
    let apex = lowest(&[0, 1, 2, 3, 4, 5, 6, 7]);
    let mut found = Vec::new();
    for face in FACES.iter().filter(|face| !face.contains(&apex)) {
        let start = face.iter().position(|corner| *corner == lowest(face)).unwrap();
        let [a, b, c, d] = [0, 1, 2, 3].map(|step| face[(start + step) % 4]);
        for [p, q, r] in [[a, b, c], [a, c, d]] {
            // Faces look outwards, the apex lies behind them.
            let corners = [p, r, q, apex];
            let middle = |[i, j]: [usize; 2]| {
                let half = [0, 1, 2].map(|axis| 0.5 * (places[corners[i]][axis] + places[corners[j]][axis]));
                places.iter().position(|place| *place == half).unwrap()
            };
            let local = corners.iter().copied().chain(EDGES.map(middle));
            found.push(local.map(|node| cell[node]).take(count).collect());
        }
    }
    found
}

/// A mesh of one shape, with the nodes that its cells use.
fn mesh(
    shape: Shape,
    nodes: &[Vector3<f64>],
    cells: &[Vec<usize>],
    place: impl Fn(Vector3<f64>) -> Vector3<f64>,
) -> Mesh {
    let mut kept = vec![usize::MAX; nodes.len()];
    let mut mesh = Mesh::default();
    for (number, cell) in cells.iter().enumerate() {
        let own = cell.iter().map(|node| {
            if kept[*node] == usize::MAX {
                kept[*node] = mesh.nodes.len();
                mesh.nodes.push(place(nodes[*node]).into());
            }
            kept[*node]
        });
        let own = own.collect();
        mesh.cells.push(Cell { label: number as u64 + 1, shape, nodes: own });
    }
    mesh.node_labels = (1..=mesh.nodes.len() as u64).collect();
    mesh
}

/// Straight tetrahedra each cut into eight, so that the surface stays.
pub fn refined(coarse: &Mesh) -> Mesh {
    let quadratic = with_middles(coarse);
    let nodes: Vec<Vector3<f64>> = quadratic.nodes.iter().map(|node| Vector3::from(*node)).collect();
    let parts: [[usize; 4]; 8] = [
        [0, 4, 6, 7],
        [4, 1, 5, 8],
        [6, 5, 2, 9],
        [7, 8, 9, 3],
        [4, 5, 6, 8],
        [4, 6, 7, 8],
        [6, 5, 9, 8],
        [6, 9, 7, 8],
    ];
    let cells =
        quadratic.cells.iter().flat_map(|cell| parts.map(|part| part.map(|i| cell.nodes[i]).to_vec()));
    mesh(Shape::Tet4, &nodes, &cells.collect::<Vec<_>>(), |place| place)
}

/// Straight tetrahedra with nodes in the middles of their edges.
pub fn with_middles(coarse: &Mesh) -> Mesh {
    let mut nodes: Vec<Vector3<f64>> = coarse.nodes.iter().map(|node| Vector3::from(*node)).collect();
    let mut known = HashMap::new();
    let mut cells = Vec::new();
    for cell in &coarse.cells {
        let mut all = cell.nodes.to_vec();
        for [i, j] in EDGES {
            let ends = [cell.nodes[i].min(cell.nodes[j]), cell.nodes[i].max(cell.nodes[j])];
            let middle = *known.entry(ends).or_insert_with(|| {
                nodes.push(0.5 * (nodes[ends[0]] + nodes[ends[1]]));
                nodes.len() - 1
            });
            all.push(middle);
        }
        cells.push(all);
    }
    mesh(Shape::Tet10, &nodes, &cells, |place| place)
}

/// Triangles of tetrahedra that have no neighbour, seen from outside counter-clockwise.
pub fn surface(mesh: &Mesh) -> Vec<[usize; 3]> {
    let mut seen: HashMap<[usize; 3], ([usize; 3], usize)> = HashMap::new();
    for cell in &mesh.cells {
        for face in [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]] {
            let face = face.map(|corner| cell.nodes[corner]);
            let mut key = face;
            key.sort_unstable();
            seen.entry(key).or_insert((face, 0)).1 += 1;
        }
    }
    let mut outer: Vec<[usize; 3]> =
        seen.into_values().filter(|(_, count)| *count == 1).map(|(face, _)| face).collect();
    outer.sort_unstable();
    outer
}

/// A solid of one isotropic material, or of several by cells.
pub fn solid(mesh: Mesh, regions: &[(Vec<usize>, Material)], attached: Vec<usize>) -> Part {
    let axes = parts::diag([1.0, 1.0, 1.0]);
    let region = |(cells, material): &(Vec<usize>, Material)| Region {
        cells: cells.clone(),
        name: String::new(),
        material: ElasticMaterial::Isotropic(material.clone()),
        axes,
        grading: None,
    };
    let regions = regions.iter().map(region).collect();
    let kind = PartKind::Solid(Solid { mesh: Arc::new(mesh), regions });
    Part { name: "solid".to_owned(), kind, masses: Vec::new(), attached, rayleigh: [0.0; 2] }
}

/// All cells of a mesh, of one material.
pub fn throughout(mesh: &Mesh, material: &Material) -> Vec<(Vec<usize>, Material)> {
    vec![((0..mesh.cells.len()).collect(), material.clone())]
}

/// The surface of a mesh without the nodes inside.
pub fn outer(mesh: &Mesh) -> ClosedSurface {
    let triangles = surface(mesh);
    let mut used: Vec<usize> = triangles.iter().flatten().copied().collect();
    used.sort_unstable();
    used.dedup();
    let number = |node: usize| used.binary_search(&node).unwrap();
    let triangles = triangles.iter().map(|triangle| triangle.map(number)).collect();
    ClosedSurface::new(used.iter().map(|node| mesh.nodes[*node]).collect(), triangles).unwrap()
}
