//! Quadrilateral shell element: membrane, bending, transverse shear and drilling without locking.
//! Strains do not depend on the section, so that layers of different materials add; every factor below is chosen under this constraint.
//! Transverse shear `[@dvorkin1984]`, hourglass modes `[@flanagan1981]`, `[@belytschko1991]`, drilling `[@hughes1989]`.

use nalgebra::{DMatrix, Matrix2, Matrix2xX, Matrix3, Matrix3xX, RowDVector, Vector2, Vector3};

use super::error::ShellError;
use super::plane::Plane;
use super::sample::Sample;
use super::section::ShellSection;

/// A quadrilateral, flat or warped, that locks neither in shear nor in its membrane.
///
/// - Membrane: five strains, none of which depends on the rotations. Three are constant; those along the sides are the
///   mean stretches of opposite sides, whose warped parts a flat element would lose. Two are bending in the plane,
///   after the hourglass modes of `[@belytschko1991]`, here for warped elements too; they are linear, of
///   mean zero, and vanish for a linear displacement (patch test).
/// - Bending: bilinear rotations. Transverse shear from the middles of the sides `[@dvorkin1984]`.
/// - Drilling: the mean rotation about the normal follows that of the membrane (`[@hughes1989]`, at one point);
///   the varying part is constrained as weakly as a curvature, since more would stiffen thin warped shells.
pub(super) struct Quad {
    /// Half the lines between middles of opposite sides: `∂x/∂r` and `∂x/∂s` at the centre (m).
    sides: [Vector2<f64>; 2],
    /// `∂²x/∂r∂s` (m).
    skew: Vector2<f64>,
    /// Height of the first and third node over the plane, depth of the others (m).
    warp: f64,
}

/// Natural coordinates of the nodes.
pub(super) const R: [f64; 4] = [-1.0, 1.0, 1.0, -1.0];
pub(super) const S: [f64; 4] = [-1.0, -1.0, 1.0, 1.0];
/// Contraction across a strain of bending in the plane. Exact for an isotropic material with this Poisson's ratio, 0.3 % too stiff at 0.3
/// and 6 % at zero for a single element; a contraction that followed the section would not leave the stiffness linear in it.
const CONTRACTION: f64 = 0.25;
/// Stiffness that constrains the varying rotation about the normal, in units of the stiffness in twist.
const DRILLING: f64 = 0.01;

impl Quad {
    pub fn new(plane: &Plane) -> Result<Self, ShellError> {
        let mean = |factor: &dyn Fn(usize) -> f64| -> Vector2<f64> {
            (0..4).map(|i| 0.25 * factor(i) * plane.places[i]).sum()
        };
        let sides = [mean(&|i| R[i]), mean(&|i| S[i])];
        let quad = Self { sides, skew: mean(&|i| R[i] * S[i]), warp: plane.heights[0] };
        // The Jacobian is linear: a positive one at the corners is positive everywhere.
        match (0..4).find(|i| !(quad.jacobian(R[*i], S[*i]) > 0.0)) {
            Some(node) => Err(ShellError::Concave { node: node + 1 }),
            None => Ok(quad),
        }
    }

    /// Four Gauss points.
    pub fn samples(&self) -> Vec<Sample> {
        let constant = self.constant();
        let [along_r, along_s] = [self.flexure(0), self.flexure(1)];
        let point = |[r, s]: [f64; 2]| {
            let area = self.jacobian(r, s);
            // Divided by the Jacobian, a linear strain has no mean.
            let uneven = self.jacobian(0.0, 0.0) / area;
            let slopes = self.slopes(r, s);
            Sample {
                area,
                membrane: &constant + uneven * (s * &along_r + r * &along_s),
                bending: bending(&slopes),
                shear: self.shear(r, s),
                slopes,
            }
        };
        gauss().map(point).into()
    }

    /// Stiffness that constrains the rotations about the normal.
    pub fn drilling(&self, section: &ShellSection) -> DMatrix<f64> {
        let slopes = self.slopes(0.0, 0.0);
        let mut tie = RowDVector::zeros(24);
        for i in 0..4 {
            // θ₃ − ½ (∂v/∂x − ∂u/∂y)
            tie[6 * i] = 0.5 * slopes[(1, i)];
            tie[6 * i + 1] = -0.5 * slopes[(0, i)];
            tie[6 * i + 5] = 0.25;
        }
        let area = 4.0 * self.jacobian(0.0, 0.0);
        let mut stiffness = twist(&section.A) * area * tie.tr_mul(&tie);
        for [r, s] in gauss() {
            let slopes = self.slopes(r, s);
            let hold = DRILLING * twist(&section.D) * self.jacobian(r, s) * slopes.tr_mul(&slopes);
            for (i, j) in (0..4).flat_map(|i| (0..4).map(move |j| (i, j))) {
                stiffness[(6 * i + 5, 6 * j + 5)] += hold[(i, j)];
            }
        }
        stiffness
    }

    /// `∂x/∂r` and `∂x/∂s` (m).
    fn tangents(&self, r: f64, s: f64) -> [Vector2<f64>; 2] {
        [self.sides[0] + s * self.skew, self.sides[1] + r * self.skew]
    }

    /// Area (m²) per unit of `r` and `s`.
    fn jacobian(&self, r: f64, s: f64) -> f64 {
        let [along_r, along_s] = self.tangents(r, s);
        along_r.perp(&along_s)
    }

    /// Gradients of `r` and `s` (1/m), as columns.
    fn gradients(&self, r: f64, s: f64) -> Matrix2<f64> {
        let [a, c] = self.tangents(r, s);
        Matrix2::new(c.y, -a.y, -c.x, a.x) / a.perp(&c)
    }

    /// Gradients of the bilinear shape functions (1/m).
    fn slopes(&self, r: f64, s: f64) -> Matrix2xX<f64> {
        let natural = Matrix2xX::from_fn(4, |row, i| {
            0.25 * if row == 0 { R[i] * (1.0 + S[i] * s) } else { S[i] * (1.0 + R[i] * r) }
        });
        self.gradients(r, s) * natural
    }

    /// Part of a displacement of the nodes that is neither constant nor linear in the plane, `γ` of `[@flanagan1981]`: one for the
    /// displacement `rs`.
    fn hourglass(&self) -> [f64; 4] {
        let slopes = self.slopes(0.0, 0.0);
        std::array::from_fn(|i| 0.25 * R[i] * S[i] - slopes.column(i).dot(&self.skew))
    }

    /// The constant membrane strain.
    fn constant(&self) -> Matrix3xX<f64> {
        let slopes = self.slopes(0.0, 0.0);
        let hourglass = self.hourglass();
        let gradients = self.gradients(0.0, 0.0);
        let [along_r, along_s] = [0, 1].map(|side| gradients.column(side).into_owned());
        // A warped element that twists stretches all its sides alike.
        let twisted = self.warp * (dyad(along_r) + dyad(along_s));
        let mut strain = Matrix3xX::zeros(24);
        for i in 0..4 {
            let (x, y) = (slopes[(0, i)], slopes[(1, i)]);
            strain.set_column(6 * i, &Vector3::new(x, 0.0, y));
            strain.set_column(6 * i + 1, &Vector3::new(0.0, y, x));
            strain.set_column(6 * i + 2, &(hourglass[i] * twisted));
        }
        strain
    }

    /// The membrane strain of bending in the plane: half the difference of the stretches of two opposite sides.
    fn flexure(&self, side: usize) -> Matrix3xX<f64> {
        let along = self.sides[side];
        let square = along.norm_squared();
        let across = Vector2::new(-along.y, along.x);
        let shape = (dyad(along) - CONTRACTION * dyad(across)) / (square * square);
        let hourglass = self.hourglass();
        let natural = [R, S][side];
        let mut strain = Matrix3xX::zeros(24);
        for i in 0..4 {
            strain.set_column(6 * i, &(hourglass[i] * along.x * shape));
            strain.set_column(6 * i + 1, &(hourglass[i] * along.y * shape));
            strain.set_column(6 * i + 2, &(0.25 * natural[i] * self.warp * shape));
        }
        strain
    }

    /// Transverse shear, linear between the middles of opposite sides.
    fn shear(&self, r: f64, s: f64) -> Matrix2xX<f64> {
        let mut natural = Matrix2xX::zeros(24);
        for i in 0..4 {
            // on the side of the node: ∂w/∂r + ∂x/∂r · (θ₂, −θ₁)
            let [along_r, along_s] = self.tangents(R[i], S[i]);
            let [by_r, by_s] = [0.5 * (1.0 + R[i] * r), 0.5 * (1.0 + S[i] * s)];
            natural.set_column(6 * i + 2, &Vector2::new(0.5 * R[i] * by_s, 0.5 * S[i] * by_r));
            natural.set_column(6 * i + 3, &Vector2::new(-0.5 * along_r.y * by_s, -0.5 * along_s.y * by_r));
            natural.set_column(6 * i + 4, &Vector2::new(0.5 * along_r.x * by_s, 0.5 * along_s.x * by_r));
        }
        self.gradients(r, s) * natural
    }
}

/// Natural coordinates of the four Gauss points, each of weight one.
pub(super) fn gauss() -> [[f64; 2]; 4] {
    std::array::from_fn(|i| [R[i], S[i]].map(|sign| sign / 3.0_f64.sqrt()))
}

/// Curvature of rotations that are interpolated with these `slopes`.
fn bending(slopes: &Matrix2xX<f64>) -> Matrix3xX<f64> {
    let mut curvature = Matrix3xX::zeros(6 * slopes.ncols());
    for (i, slope) in slopes.column_iter().enumerate() {
        curvature.set_column(6 * i + 3, &Vector3::new(0.0, -slope.y, -slope.x));
        curvature.set_column(6 * i + 4, &Vector3::new(slope.x, 0.0, slope.y));
    }
    curvature
}

/// The strain `v vᵀ`, its shear as an angle.
fn dyad(v: Vector2<f64>) -> Vector3<f64> {
    Vector3::new(v.x * v.x, v.y * v.y, 2.0 * v.x * v.y)
}

/// Stiffness in shear, averaged over all directions in the plane.
fn twist(stiffness: &Matrix3<f64>) -> f64 {
    let pure = stiffness[(0, 0)] + stiffness[(1, 1)] - 2.0 * stiffness[(0, 1)];
    0.125 * (pure + 4.0 * stiffness[(2, 2)])
}
