//! Surfaces for tests.

use std::f64::consts::PI;

use super::ClosedSurface;

/// A body of height 1 over an outline that runs counterclockwise, with triangles that fill it.
pub fn prism(
    outline: &[[f64; 2]],
    filling: &[[usize; 3]],
    place: impl Fn([f64; 3]) -> [f64; 3],
) -> ClosedSurface {
    let count = outline.len();
    let level = |z: f64| outline.iter().map(move |[x, y]| [*x, *y, z]);
    let vertices = level(0.0).chain(level(1.0)).map(place).collect();
    let caps = filling.iter().flat_map(|[a, b, c]| [[*a, *c, *b], [a + count, b + count, c + count]]);
    let side = |k: usize| {
        let next = (k + 1) % count;
        [[k, next, next + count], [k, next + count, k + count]]
    };
    ClosedSurface::new(vertices, caps.chain((0..count).flat_map(side)).collect()).unwrap()
}

/// A cube of side 1.
pub fn cube(place: impl Fn([f64; 3]) -> [f64; 3]) -> ClosedSurface {
    prism(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], &[[0, 1, 2], [0, 2, 3]], place)
}

/// An L-shaped block of height 1: a square of side 2 without that of side 1 at its far corner.
pub fn block(place: impl Fn([f64; 3]) -> [f64; 3]) -> ClosedSurface {
    let outline = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
    prism(&outline, &[[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]], place)
}

/// Triangles with corners on a ball of radius 1, in `2 n` rings from pole to pole.
pub fn ball(n: usize, place: impl Fn([f64; 3]) -> [f64; 3]) -> ClosedSurface {
    let (vertices, triangles) = ball_triangles(n);
    ClosedSurface::new(vertices.into_iter().map(place).collect(), triangles).unwrap()
}

/// Vertices and triangles of such a ball.
pub fn ball_triangles(n: usize) -> (Vec<[f64; 3]>, Vec<[usize; 3]>) {
    let (rings, around) = (2 * n, 4 * n);
    let mut vertices = vec![[0.0, 0.0, -1.0]];
    for ring in 1..rings {
        let (sin, cos) = (PI * ring as f64 / rings as f64).sin_cos();
        // Every other ring is rotated by half a triangle.
        let turn = 0.5 * (ring % 2) as f64;
        vertices.extend((0..around).map(|k| {
            let (y, x) = (2.0 * PI * (k as f64 + turn) / around as f64).sin_cos();
            [sin * x, sin * y, -cos]
        }));
    }
    vertices.push([0.0, 0.0, 1.0]);
    let at = |ring: usize, k: usize| 1 + (ring - 1) * around + k % around;
    let mut triangles = Vec::new();
    for k in 0..around {
        triangles.push([0, at(1, k + 1), at(1, k)]);
        triangles.push([vertices.len() - 1, at(rings - 1, k), at(rings - 1, k + 1)]);
        for ring in 1..rings - 1 {
            let [a, b, c, d] = [at(ring, k), at(ring, k + 1), at(ring + 1, k), at(ring + 1, k + 1)];
            let halves = if ring % 2 == 1 { [[a, b, d], [a, d, c]] } else { [[a, b, c], [b, d, c]] };
            triangles.extend(halves);
        }
    }
    (vertices, triangles)
}

/// Rotation about no axis of the coordinates, and a shift, in a unit of length.
pub fn turned(unit: f64) -> impl Fn([f64; 3]) -> [f64; 3] + Copy {
    move |[x, y, z]| {
        [0.6 * x - 0.8 * y + 7.0, 0.48 * x + 0.36 * y - 0.8 * z - 2.0, 0.64 * x + 0.48 * y + 0.6 * z]
            .map(|x| unit * x)
    }
}

/// Menger's sponge of side `3^level` of unit cubes, whose inner faces are left out and whose corners are merged.
pub fn sponge(level: u32, place: impl Fn([f64; 3]) -> [f64; 3]) -> ClosedSurface {
    let size = 3_i32.pow(level);
    let solid = |cube: [i32; 3]| {
        let inside = cube.iter().all(|x| (0..size).contains(x));
        let middles = |level: u32| cube.iter().filter(|x| **x / 3_i32.pow(level) % 3 == 1).count();
        inside && (0..level).all(|level| middles(level) < 2)
    };
    let mut corners = std::collections::HashMap::new();
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    for cube in (0..size.pow(3)).map(|at| [at % size, at / size % size, at / size / size]) {
        for (axis, side) in (0..6).map(|at| (at % 3, i32::from(at > 2))).filter(|_| solid(cube)) {
            let mut beside = cube;
            beside[axis] += 2 * side - 1;
            if solid(beside) {
                continue;
            }
            let steps =
                [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[i, j]| if side == 1 { [i, j] } else { [j, i] });
            let [a, b, c, d] = steps.map(|[i, j]| {
                let mut corner = cube;
                corner[axis] += side;
                corner[(axis + 1) % 3] += i;
                corner[(axis + 2) % 3] += j;
                *corners.entry(corner).or_insert_with(|| {
                    vertices.push(place(corner.map(f64::from)));
                    vertices.len() - 1
                })
            });
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    ClosedSurface::new(vertices, triangles).unwrap()
}
