//! Surfaces of triangles, by hand and random.

use std::collections::BTreeMap;

use proptest::array::uniform3;
use proptest::collection::vec;
use proptest::prelude::*;
use quasirigid_mesh::surface::{ClosedSurface, SurfaceError};

pub type Mesh = (Vec<[f64; 3]>, Vec<[usize; 3]>);

pub fn closed((vertices, triangles): &Mesh) -> ClosedSurface {
    ClosedSurface::new(vertices.clone(), triangles.clone()).unwrap()
}

pub fn refusal((vertices, triangles): &Mesh) -> SurfaceError {
    ClosedSurface::new(vertices.clone(), triangles.clone()).unwrap_err()
}

/// Vertex `4i + 2j + k` is at `[x_i, y_j, z_k]`.
pub fn block([low, high]: [[f64; 3]; 2]) -> Mesh {
    let corner =
        |n: usize| [[low[0], high[0]][n / 4], [low[1], high[1]][n / 2 % 2], [low[2], high[2]][n % 2]];
    let sides = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let triangles = sides.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
    ((0..8).map(corner).collect(), triangles)
}

pub const UNIT_CUBE: [[f64; 3]; 2] = [[-1.0; 3], [1.0; 3]];

pub fn tetrahedron(corners: [[f64; 3]; 4]) -> Mesh {
    (corners.to_vec(), vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
}

/// A sphere about the origin: the icosahedron, every triangle split in four `splits` times.
pub fn icosphere(splits: usize) -> Mesh {
    let g = 0.5 * (1.0 + 5f64.sqrt());
    let mut vertices = Vec::new();
    for [a, b] in [[1.0, g], [-1.0, g], [1.0, -g], [-1.0, -g]] {
        vertices.extend([[a, b, 0.0], [0.0, a, b], [b, 0.0, a]]);
    }
    let near = |a: [f64; 3], b: [f64; 3]| (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>() < 4.1;
    let mut triangles = Vec::new();
    for a in 0..12 {
        for b in a + 1..12 {
            for c in b + 1..12 {
                let [p, q, r] = [a, b, c].map(|n: usize| vertices[n]);
                if near(p, q) && near(q, r) && near(r, p) {
                    triangles.push(if det(p, q, r) > 0.0 { [a, b, c] } else { [a, c, b] });
                }
            }
        }
    }
    let mut mesh = (vertices, triangles);
    for _ in 0..splits {
        mesh = split_in_four(&mesh);
    }
    for vertex in &mut mesh.0 {
        let length = vertex.iter().map(|x| x * x).sum::<f64>().sqrt();
        *vertex = vertex.map(|x| x / length);
    }
    mesh
}

pub fn split_in_four((vertices, triangles): &Mesh) -> Mesh {
    let (mut vertices, mut halves) = (vertices.clone(), BTreeMap::new());
    let mut half = |a: usize, b: usize| {
        *halves.entry([a.min(b), a.max(b)]).or_insert_with(|| {
            vertices.push(std::array::from_fn(|i| 0.5 * (vertices[a][i] + vertices[b][i])));
            vertices.len() - 1
        })
    };
    let split = |[a, b, c]: &[usize; 3]| {
        let [p, q, r] = [half(*a, *b), half(*b, *c), half(*c, *a)];
        [[*a, p, r], [p, *b, q], [r, q, *c], [p, q, r]]
    };
    let triangles = triangles.iter().flat_map(split).collect();
    (vertices, triangles)
}

pub fn det(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> f64 {
    a[0] * (b[1] * c[2] - b[2] * c[1])
        + a[1] * (b[2] * c[0] - b[0] * c[2])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
}

/// Two meshes as one.
pub fn both((mut vertices, mut triangles): Mesh, (others, more): Mesh) -> Mesh {
    let first = vertices.len();
    vertices.extend(others);
    triangles.extend(more.into_iter().map(|corners| corners.map(|corner| corner + first)));
    (vertices, triangles)
}

pub fn inside_out((vertices, triangles): Mesh) -> Mesh {
    (vertices, triangles.into_iter().map(|[a, b, c]| [a, c, b]).collect())
}

/// Vertices moved.
pub fn mapped((vertices, triangles): &Mesh, map: impl Fn([f64; 3]) -> [f64; 3]) -> Mesh {
    (vertices.iter().copied().map(map).collect(), triangles.clone())
}

/// A body about the origin whose every ray from there leaves it once, with bumps of up to 40 %.
pub fn star(splits: usize) -> impl Strategy<Value = Mesh> {
    let size = icosphere(splits).0.len();
    let waves = vec((uniform3(-3.0..3.0), 0.0..6.3), 4);
    let bumps = vec(0.9..1.0, size);
    (waves, bumps).prop_map(move |(waves, bumps)| {
        let (mut vertices, triangles) = icosphere(splits);
        for (vertex, bump) in vertices.iter_mut().zip(bumps) {
            let phase = |(k, start): &([f64; 3], f64)| (0..3).map(|i| k[i] * vertex[i]).sum::<f64>() + start;
            let radius = bump * (1.0 + 0.08 * waves.iter().map(|wave| phase(wave).sin()).sum::<f64>());
            *vertex = vertex.map(|x| x * radius);
        }
        (vertices, triangles)
    })
}
