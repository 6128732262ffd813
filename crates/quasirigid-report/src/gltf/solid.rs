//! Spheres for points and rods for lines: places, each with the vertex that it moves with, and triangles.

use std::f32::consts::TAU;

/// Triangles about vertices.
#[derive(Default)]
pub(super) struct Solid {
    pub places: Vec<[f32; 3]>,
    /// Vertex that each place moves with.
    pub owners: Vec<usize>,
    pub triangles: Vec<[u32; 3]>,
}

/// Sides of a rod; places around a sphere.
const SIDES: usize = 6;
/// Rings of a sphere between its poles.
const RINGS: usize = 4;

impl Solid {
    /// Sphere about a vertex.
    pub fn sphere(&mut self, vertex: usize, center: [f32; 3], radius: f32) {
        let first = self.places.len() as u32;
        let mut push = |offset: [f32; 3]| {
            self.places.push(std::array::from_fn(|axis| center[axis] + radius * offset[axis]));
            self.owners.push(vertex);
        };
        push([0.0, 0.0, -1.0]);
        for ring in 1..=RINGS {
            let (sin, cos) = (0.5 * TAU * (ring as f32 / (RINGS + 1) as f32 - 0.5)).sin_cos();
            for side in 0..SIDES {
                let (y, x) = (TAU * side as f32 / SIDES as f32).sin_cos();
                push([cos * x, cos * y, sin]);
            }
        }
        push([0.0, 0.0, 1.0]);
        let at = |ring: usize, side: usize| first + (1 + ring * SIDES + side % SIDES) as u32;
        let top = first + (1 + RINGS * SIDES) as u32;
        for side in 0..SIDES {
            self.triangles.push([first, at(0, side + 1), at(0, side)]);
            self.triangles.push([top, at(RINGS - 1, side), at(RINGS - 1, side + 1)]);
            for ring in 0..RINGS - 1 {
                self.quad([at(ring, side), at(ring, side + 1), at(ring + 1, side + 1), at(ring + 1, side)]);
            }
        }
    }

    /// Rod between two vertices.
    pub fn rod(&mut self, vertices: [usize; 2], ends: [[f32; 3]; 2], radius: f32) {
        let along: [f32; 3] = std::array::from_fn(|axis| ends[1][axis] - ends[0][axis]);
        let length = norm(along);
        // a spring without length at rest is seen once it is stretched
        let third = if length > 0.0 { along.map(|entry| entry / length) } else { [0.0, 0.0, 1.0] };
        let least = (0..3).min_by(|a, b| third[*a].abs().total_cmp(&third[*b].abs())).unwrap_or(0);
        let mut unit = [0.0; 3];
        unit[least] = 1.0;
        let across = cross(unit, third);
        let first = across.map(|entry| entry / norm(across));
        let second = cross(third, first);
        let start = self.places.len() as u32;
        for (vertex, end) in vertices.into_iter().zip(ends) {
            for side in 0..SIDES {
                let (sin, cos) = (TAU * side as f32 / SIDES as f32).sin_cos();
                let offset = |axis: usize| radius * (cos * first[axis] + sin * second[axis]);
                self.places.push(std::array::from_fn(|axis| end[axis] + offset(axis)));
                self.owners.push(vertex);
            }
        }
        let at = |end: usize, side: usize| start + (end * SIDES + side % SIDES) as u32;
        for side in 0..SIDES {
            self.quad([at(0, side), at(0, side + 1), at(1, side + 1), at(1, side)]);
        }
    }

    fn quad(&mut self, [a, b, c, d]: [u32; 4]) {
        self.triangles.extend([[a, b, c], [a, c, d]]);
    }
}

fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn norm(a: [f32; 3]) -> f32 {
    a.iter().map(|entry| entry * entry).sum::<f32>().sqrt()
}
