//! Interpolation in a beam element: displacement and rotation of a section from the coordinates of both nodes.
//! It is the exact deflection under end loads, shear included, so that a beam neither locks nor depends on how it is cut.
//! Shape functions of `[@przemieniecki1968]`, `[@friedman1993]`.

use nalgebra::{Matrix3, RowSVector, SMatrix, Vector3};

use super::element::Beam;

/// A number as a combination of the coordinates of both nodes.
pub(super) type Row = RowSVector<f64, 12>;
/// A vector as a combination of the coordinates of both nodes.
pub(super) type Rows = SMatrix<f64, 3, 12>;

/// Bending in a principal plane: the displacement `v` and the rotation `ψ` of the section, `v′ = ψ` without shear.
///
/// Between the nodes, at `x = (½ + t) L`, the beam moves as it does under forces at its nodes `[@przemieniecki1968]`,
/// `[@friedman1993]`: as a rigid rod along its chord, bent evenly by `s`, and oddly by `a`:
///
/// ```text
/// c = (v₂ − v₁)/L,     s = ψ₂ − ψ₁,     a = ψ₁ + ψ₂ − 2c,     φ = 12 EI/(GA_s L²)
/// v = (½ − t) v₁ + (½ + t) v₂ + ½ L (t² − ¼) s + L (t³ − ¼ t) a/(1 + φ)
/// ψ = c + t s + (3t² − ¼ + ½ φ) a/(1 + φ)
/// ```
pub(super) struct Plane {
    /// Unit vector of `v`.
    pub across: Vector3<f64>,
    /// Unit vector of `ψ`.
    pub about: Vector3<f64>,
    /// `v₁` and `v₂`.
    ends: [Row; 2],
    chord: Row,
    pub even: Row,
    pub odd: Row,
    /// `EI` (N·m²).
    pub stiffness: f64,
    /// `φ`: the additional flexibility of odd bending by shear.
    pub phi: f64,
}

/// Fields of the element at one section, in the axes of the body.
pub(super) struct Fields {
    /// Displacement of the centroid.
    pub place: Rows,
    /// Rotation of the section.
    pub turn: Rows,
    /// Derivative of the displacement along the beam.
    pub slope: Rows,
    /// Derivative of the rotation along the beam (1/m).
    pub bend: Rows,
}

impl Beam {
    /// The planes of the beam with `y` and with `z`.
    pub(super) fn planes(&self) -> [Plane; 2] {
        let [_, y, z] = self.directions();
        let section = &self.section;
        [
            self.plane(y, z, section.second_z, section.shear_y),
            self.plane(z, -y, section.second_y, section.shear_z),
        ]
    }

    fn plane(&self, across: Vector3<f64>, about: Vector3<f64>, second: f64, area: f64) -> Plane {
        let ends = [0, 1].map(|node| translation(node, &across));
        let [first, last] = [0, 1].map(|node| rotation(node, &about));
        let chord = (ends[1] - ends[0]) / self.length;
        let stiffness = self.young * second;
        Plane {
            across,
            about,
            ends,
            chord,
            even: last - first,
            odd: first + last - 2.0 * chord,
            stiffness,
            phi: 12.0 * stiffness / (self.shear * area * self.length * self.length),
        }
    }

    /// Stretch `u₂ − u₁` along the beam.
    pub(super) fn stretch(&self) -> Row {
        let [axis, ..] = self.directions();
        translation(1, &axis) - translation(0, &axis)
    }

    /// Twist `θ₂ − θ₁` about the beam.
    pub(super) fn twist(&self) -> Row {
        let [axis, ..] = self.directions();
        rotation(1, &axis) - rotation(0, &axis)
    }

    /// The fields at `x = (½ + t) L`.
    pub(super) fn fields(&self, t: f64) -> Fields {
        let [axis, ..] = self.directions();
        let mean = |at: fn(usize, &Vector3<f64>) -> Row| (0.5 - t) * at(0, &axis) + (0.5 + t) * at(1, &axis);
        let mut fields = Fields {
            place: axis * mean(translation),
            turn: axis * mean(rotation),
            slope: axis * self.stretch() / self.length,
            bend: axis * self.twist() / self.length,
        };
        for plane in self.planes() {
            fields.place += plane.across * plane.place(t, self.length);
            fields.turn += plane.about * plane.turn(t);
            fields.slope += plane.across * plane.slope(t);
            fields.bend += plane.about * plane.bend(t, self.length);
        }
        fields
    }

    /// `∫ p pᵀ dA` (m⁴) of the places `p` in a section, from its centroid.
    pub(super) fn spread(&self) -> Matrix3<f64> {
        let [_, y, z] = self.directions();
        self.section.second_z * y * y.transpose() + self.section.second_y * z * z.transpose()
    }
}

impl Plane {
    fn place(&self, t: f64, length: f64) -> Row {
        let chord = (0.5 - t) * self.ends[0] + (0.5 + t) * self.ends[1];
        let odd = (t * t - 0.25) * t / (1.0 + self.phi);
        chord + length * (0.5 * (t * t - 0.25) * self.even + odd * self.odd)
    }

    fn turn(&self, t: f64) -> Row {
        self.chord + t * self.even + (3.0 * t * t - 0.25 + 0.5 * self.phi) / (1.0 + self.phi) * self.odd
    }

    /// `v′`.
    fn slope(&self, t: f64) -> Row {
        self.chord + t * self.even + (3.0 * t * t - 0.25) / (1.0 + self.phi) * self.odd
    }

    /// `ψ′`.
    fn bend(&self, t: f64, length: f64) -> Row {
        (self.even + 6.0 * t / (1.0 + self.phi) * self.odd) / length
    }
}

/// Translation of a node along a direction.
pub(super) fn translation(node: usize, direction: &Vector3<f64>) -> Row {
    placed(6 * node, direction)
}

/// Rotation of a node about a direction.
pub(super) fn rotation(node: usize, direction: &Vector3<f64>) -> Row {
    placed(6 * node + 3, direction)
}

fn placed(column: usize, direction: &Vector3<f64>) -> Row {
    let mut row = Row::zeros();
    row.fixed_columns_mut::<3>(column).copy_from(&direction.transpose());
    row
}
