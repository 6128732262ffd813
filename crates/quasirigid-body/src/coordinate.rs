//! Internal coordinates of a body, and markers: places that they displace.

use super::Gimbal;
use crate::math::scalar::Smooth;
use crate::math::vec3::{add, cross, dot, scale};

/// Internal coordinate.
#[derive(Clone, Debug, PartialEq)]
pub struct Coordinate {
    /// Name of the moving part or place: `tip x`, `boom hinge 1`.
    pub name: String,
    /// Unit of the value, `m` or `rad`.
    pub unit: &'static str,
}

impl Coordinate {
    /// True for a displacement of a whole structure; [`FlexibleBody::part_masses`](super::FlexibleBody::part_masses) then has the masses
    /// of its parts.
    #[must_use]
    pub fn is_shape(&self) -> bool {
        self.name.starts_with("shape ")
    }

    /// Name of the moving part, as in the model file.
    #[must_use]
    pub fn part(&self) -> &str {
        let mut quoted = self.name.split('"');
        match (quoted.next(), quoted.next()) {
            (Some(""), Some(name)) => name,
            _ => self.name.split(' ').next().unwrap_or(&self.name),
        }
    }
}

/// Marker: a place on the body, for the displacement that tells whether the body stays nearly rigid, and for the action of forces.
#[derive(Clone, Debug, PartialEq)]
pub struct Marker {
    /// Name of the place.
    pub name: String,
    /// Equilibrium position from the pole (m).
    pub position: [f64; 3],
    /// Coordinates that displace the place, each with the displacement per unit `H_j`.
    pub shapes: Vec<(usize, [f64; 3])>,
    /// Coordinates that rotate the place, each with the rotation per unit `φ_j` (rad); none of a place without orientation.
    pub rotations: Vec<(usize, [f64; 3])>,
    /// Curvature `G_jk` of the path for pairs of coordinates, in both orders (m); none on straight paths. (I8)
    pub curvature: Vec<(usize, usize, [f64; 3])>,
    /// Rotation that carries the place, of a place on an appendage: its path is exact.
    pub carried: Option<Carried>,
}

/// Rotation of a place about a hinge. (I12)
#[derive(Clone, Debug, PartialEq)]
pub struct Carried {
    /// Axes of the hinge.
    pub gimbal: Gimbal,
    /// Position of the place from the hinge at equilibrium (m).
    pub arm: [f64; 3],
}

impl Marker {
    /// Displacement of the place (m), body axes: exact on an appendage, else of second order. (S1), (I12)
    #[must_use]
    pub fn displacement(&self, q: &[f64]) -> [f64; 3] {
        self.displaced(q).0
    }

    /// Slopes of the displacement by each of the coordinates, body axes. (S1), (I12)
    #[must_use]
    pub fn displacement_slopes(&self, q: &[f64]) -> Vec<[f64; 3]> {
        let mut slopes = vec![[0.0; 3]; q.len()];
        for (j, slope) in self.displaced(q).1 {
            slopes[j] = add(slopes[j], slope);
        }
        slopes
    }

    /// Displacement of the place (m), and its slopes by coordinate, some of them in several parts: exact on an appendage, else of second
    /// order. (S1), (I12)
    pub(crate) fn displaced<T: Smooth>(&self, q: &[T]) -> ([T; 3], Vec<(usize, [T; 3])>) {
        if let Some(Carried { gimbal, arm }) = &self.carried {
            return gimbal.displaced(q, *arm);
        }
        let mut slopes: Vec<(usize, [T; 3])> =
            self.shapes.iter().map(|(j, H)| (*j, H.map(T::from))).collect();
        let straight = slopes.iter().fold([T::from(0.0); 3], |u, (j, H)| add(u, scale(q[*j], *H)));
        let half = T::from(0.5);
        let displaced = self.curvature.chunk_by(|a, b| a.0 == b.0).fold(straight, |u, row| {
            let j = row[0].0;
            let slope =
                row.iter().fold([T::from(0.0); 3], |sum, (_, k, G)| add(sum, scale(q[*k], G.map(T::from))));
            slopes.push((j, slope));
            add(u, scale(half * q[j], slope))
        });
        (displaced, slopes)
    }

    /// A vector that turns with the place, body axes: exactly on an appendage, else by the rotation `φ_j q_j`, whose second order is that of a
    /// rotation about one axis. (F22)
    pub(crate) fn turned<T: Smooth>(&self, q: &[T], vector: [T; 3]) -> [T; 3] {
        if let Some(Carried { gimbal, .. }) = &self.carried {
            return gimbal.turned(q, vector);
        }
        let half = T::from(0.5);
        let g = self
            .rotations
            .iter()
            .fold([T::from(0.0); 3], |g, (j, turn)| add(g, scale(half * q[*j], turn.map(T::from))));
        let across = cross(g, vector);
        let share = T::from(2.0) / (T::from(1.0) + dot(g, g));
        add(vector, scale(share, add(across, cross(g, across))))
    }
}
