//! Internal coordinates of a body, and markers: places that they displace.

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
    /// Curvature `G_jk` of the path for pairs of coordinates, in both orders (m); none on straight paths. (I8)
    pub curvature: Vec<(usize, usize, [f64; 3])>,
}
