//! A rigid piece of mass whose place (S1) is an affine function of the place on it: every invariant in closed form. (I7)

use nalgebra::{Matrix3, Vector3};

use crate::math::sym3::Sym;
use crate::model::moment;
use crate::model::{Inertia, Pair};

/// A rigid piece: its mass, first and second moments about a base point of its own.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece {
    /// Mass `m` (kg).
    pub mass: f64,
    /// `d = ∫ s dm` (kg·m), `s` from the base.
    pub first: Vector3<f64>,
    /// `P = ∫ s sᵀ dm` (kg·m²).
    pub second: Matrix3<f64>,
}

/// A vector field `constant + linear · s` on a piece.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Field {
    pub constant: Vector3<f64>,
    pub linear: Matrix3<f64>,
}

impl Piece {
    /// All mass at the base.
    pub fn point(mass: f64) -> Self {
        Self { mass, first: Vector3::zeros(), second: Matrix3::zeros() }
    }

    /// A rigid body with this inertia about its centre of mass, which is at `center` from the base.
    pub fn rigid(mass: f64, center: Vector3<f64>, inertia: &Inertia) -> Self {
        let second = inertia.second_moments() + mass * center * center.transpose();
        Self { mass, first: mass * center, second }
    }

    /// `∫ u dm`.
    pub fn sum(&self, u: &Field) -> [f64; 3] {
        (self.mass * u.constant + u.linear * self.first).into()
    }

    /// `∫ u × v dm`.
    pub fn cross(&self, u: &Field, v: &Field) -> [f64; 3] {
        moment::cross(&self.moment(u, v))
    }

    /// `∫ u · v dm`.
    pub fn dot(&self, u: &Field, v: &Field) -> f64 {
        self.moment(u, v).trace()
    }

    /// `∫ [2(u·v) 1 − u vᵀ − v uᵀ] dm`.
    pub fn inertia(&self, u: &Field, v: &Field) -> Sym {
        moment::inertia(&self.moment(u, v))
    }

    /// Invariants of the pair of coordinates with shapes `H_j`, `H_k` and path curvature `G_jk`, for a piece whose
    /// equilibrium position is the field `rho`. (I4)–(I6)
    pub fn pair(&self, rho: &Field, H_j: &Field, H_k: &Field, G_jk: &Field) -> Pair {
        let straight = moment::straight_pair(&self.moment(H_j, H_k));
        moment::curved_pair(straight, self.sum(G_jk), &self.moment(rho, G_jk))
    }

    /// `∫ u vᵀ dm`.
    fn moment(&self, u: &Field, v: &Field) -> Matrix3<f64> {
        self.mass * u.constant * v.constant.transpose()
            + u.constant * (v.linear * self.first).transpose()
            + (u.linear * self.first) * v.constant.transpose()
            + u.linear * self.second * v.linear.transpose()
    }
}

impl Field {
    /// Constant field.
    pub fn constant(vector: Vector3<f64>) -> Self {
        Self { constant: vector, linear: Matrix3::zeros() }
    }

    /// Position, for a piece whose base is at `base`.
    pub fn position(base: Vector3<f64>) -> Self {
        Self { constant: base, linear: Matrix3::identity() }
    }

    /// A linear function of `s`.
    pub fn linear(linear: Matrix3<f64>) -> Self {
        Self { constant: Vector3::zeros(), linear }
    }
}
