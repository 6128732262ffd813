//! Shells of a surface, and their nesting.

use std::f64::consts::PI;

use super::SurfaceError;
use super::geometry::{Corners, bounds, triple};
use quasirigid_math::connected_components::connected_components;
use quasirigid_math::vec3::{dot, minus, norm, scale};

/// Shell: a part of the surface whose triangles are connected by their edges.
pub(super) struct Shell {
    pub triangles: Vec<usize>,
    bounds: [[f64; 3]; 2],
    pub volume: f64,
}

impl Shell {
    pub fn new(corners: &[Corners], triangles: Vec<usize>) -> Self {
        let about = corners[triangles[0]][0];
        let six = |triangle: &usize| {
            let [a, b, c] = corners[*triangle];
            triple(minus(a, about), minus(b, a), minus(c, a))
        };
        let volume = triangles.iter().map(six).sum::<f64>() / 6.0;
        let bounds = bounds(triangles.iter().flat_map(|triangle| corners[*triangle]));
        Self { triangles, bounds, volume }
    }

    /// Whether the shell, whichever way it looks, is around another that it does not meet.
    pub fn surrounds(&self, other: &Self, corners: &[Corners]) -> bool {
        self.winding(corners, other.point(corners)) != 0.0
    }

    /// A point of the shell that is on no other, even where shells share a vertex: the middle of a triangle.
    fn point(&self, corners: &[Corners]) -> [f64; 3] {
        let [a, b, c] = corners[self.triangles[0]];
        scale(1.0 / 3.0, std::array::from_fn(|axis| a[axis] + b[axis] + c[axis]))
    }

    /// Winding number of the shell around a point off it: 1 inside, −1 inside a cavity, 0 outside.
    fn winding(&self, corners: &[Corners], point: [f64; 3]) -> f64 {
        let [low, high] = self.bounds;
        if (0..3).any(|axis| point[axis] < low[axis] || point[axis] > high[axis]) {
            return 0.0;
        }
        let angle = |triangle: &usize| solid_angle(corners[*triangle].map(|corner| minus(corner, point)));
        (self.triangles.iter().map(angle).sum::<f64>() / (4.0 * PI)).round()
    }
}

/// Solid angle of a triangle seen from the origin; positive if it runs counterclockwise seen from its far side.
pub(super) fn solid_angle([a, b, c]: Corners) -> f64 {
    let [p, q, r] = [norm(a), norm(b), norm(c)];
    2.0 * triple(a, b, c).atan2(p * q * r + dot(a, b) * r + dot(b, c) * p + dot(c, a) * q)
}

pub(super) fn shells(corners: &[Corners], neighbours: &[[usize; 2]]) -> Vec<Shell> {
    let parts = connected_components(corners.len(), neighbours.iter().copied());
    parts.into_iter().map(|part| Shell::new(corners, part)).collect()
}

/// Number of shells that look outward.
pub(super) fn outward(corners: &[Corners], neighbours: &[[usize; 2]]) -> usize {
    shells(corners, neighbours).iter().filter(|shell| shell.volume > 0.0).count()
}

/// Accepts shells that look outward where there is no body around them, and inward where there is: bodies side by side,
/// cavities in a body, bodies in cavities. No two triangles may cross.
pub(super) fn check(corners: &[Corners], neighbours: &[[usize; 2]]) -> Result<(), SurfaceError> {
    let shells = shells(corners, neighbours);
    if !(shells.iter().map(|shell| shell.volume).sum::<f64>() > 0.0) {
        return Err(SurfaceError::Inward);
    }
    let (mut loose, mut buried) = (Vec::new(), Vec::new());
    for (number, shell) in shells.iter().enumerate() {
        let triangle = shell.triangles[0];
        let point = shell.point(corners);
        let others = shells.iter().enumerate().filter(|(other, _)| *other != number);
        let around: f64 = others.map(|(_, other)| other.winding(corners, point)).sum();
        if shell.volume > 0.0 && around != 0.0 {
            buried.push(triangle);
        } else if !(shell.volume > 0.0) && around != 1.0 {
            loose.push(triangle);
        }
    }
    if let Some(triangle) = loose.first() {
        return Err(SurfaceError::LooseCavity { triangle: *triangle, count: loose.len() });
    }
    match buried.first() {
        Some(triangle) => Err(SurfaceError::Buried { triangle: *triangle, count: buried.len() }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_octant_is_an_eighth_of_all_directions() {
        let octant = [[2.0, 0.0, 0.0], [0.0, 5.0, 0.0], [0.0, 0.0, 0.1]];
        assert!((solid_angle(octant) - 0.5 * PI).abs() < 1e-15);
        assert!((solid_angle([octant[1], octant[0], octant[2]]) + 0.5 * PI).abs() < 1e-15);
    }
}
