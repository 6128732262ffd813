//! Internal coordinates of a body, and the places that they move.

/// An internal coordinate.
#[derive(Clone, Debug, PartialEq)]
pub struct Coordinate {
    /// What moves, in words: `tip x`, `boom hinge 1`.
    pub name: String,
    /// Unit of its value, `m` or `rad`.
    pub unit: &'static str,
}

impl Coordinate {
    /// Whether it is a displacement of a whole structure, of which [`FlexibleBody::part_masses`](super::FlexibleBody::part_masses) says what moves.
    #[must_use]
    pub fn is_shape(&self) -> bool {
        self.name.starts_with("shape ")
    }

    /// Name of the part that it moves, as the model file has it.
    #[must_use]
    pub fn part(&self) -> &str {
        let mut quoted = self.name.split('"');
        match (quoted.next(), quoted.next()) {
            (Some(""), Some(name)) => name,
            _ => self.name.split(' ').next().unwrap_or(&self.name),
        }
    }
}

/// A place on the body: its displacement says whether the body stays nearly rigid, and a force may act there.
#[derive(Clone, Debug, PartialEq)]
pub struct Marker {
    /// What it marks.
    pub name: String,
    /// Equilibrium position from the pole (m).
    pub position: [f64; 3],
    /// Coordinates that move it, with the displacement per unit `H_j` of each.
    pub shapes: Vec<(usize, [f64; 3])>,
    /// Curvature `G_jk` of its path for pairs of them, in both orders (m); none on straight paths. (I8)
    pub curvature: Vec<(usize, usize, [f64; 3])>,
}
