//! Directions, turned axes and surfaces.

use quasirigid_math::vec3::{cross, dot, unit};
use quasirigid_mesh::surface::ClosedSurface;
use quasirigid_photometry::{Law, LawAt, Phase, Scattering};

pub type V = [f64; 3];

/// Three unit vectors at right angles, aslant to everything.
pub const SLANT: [V; 3] = {
    let ninth = 1.0 / 9.0;
    [
        [ninth, 8.0 * ninth, -4.0 * ninth],
        [4.0 * ninth, -4.0 * ninth, -7.0 * ninth],
        [-8.0 * ninth, -ninth, -4.0 * ninth],
    ]
};

pub fn turned(vector: V) -> V {
    SLANT.map(|axis| dot(axis, vector))
}

/// Sun and observer at a phase angle (rad), both aslant.
pub fn at_phase(alpha: f64) -> [V; 2] {
    let sun = unit([0.48, -0.6, 0.64]);
    let across = unit(cross(sun, [0.1, 0.9, 0.3]));
    let observer = [0, 1, 2].map(|axis| alpha.cos() * sun[axis] + alpha.sin() * across[axis]);
    [sun, observer]
}

pub fn law(scattering: Scattering, alpha: f64) -> LawAt {
    Law::new(scattering, Phase::Flat).unwrap().at(alpha).unwrap()
}

/// A box from corner to corner, as vertices and triangles counterclockwise from outside.
pub fn cuboid(low: V, high: V) -> (Vec<V>, Vec<[usize; 3]>) {
    let vertices =
        (0..8).map(|k| [0, 1, 2].map(|axis| if k >> axis & 1 == 0 { low[axis] } else { high[axis] }));
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = faces.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
    (vertices.collect(), triangles.collect())
}

/// Boxes beside each other as one surface, moved by `place`.
pub fn boxes(ends: &[[V; 2]], place: impl Fn(V) -> V) -> ClosedSurface {
    let (mut vertices, mut triangles): (Vec<V>, Vec<[usize; 3]>) = Default::default();
    for [low, high] in ends {
        let (corners, faces) = cuboid(*low, *high);
        let from = vertices.len();
        triangles.extend(faces.into_iter().map(|face| face.map(|vertex| vertex + from)));
        vertices.extend(corners.into_iter().map(&place));
    }
    ClosedSurface::new(vertices, triangles).unwrap()
}
