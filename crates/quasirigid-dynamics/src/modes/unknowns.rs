//! Unknowns of the small motions about a steady spin: the angular velocity, coordinates, and the angles of liquids. (M3)

use nalgebra::{Complex, Matrix3, Vector3};

use super::iteration::Pair;
use super::mode::SpinMode;
use super::shares::LiquidMotion;
use super::spectrum::Eigenmotion;
use crate::math::vec3::scale;
use crate::model::{FlexibleBody, LiquidFlow, LiquidMemory, SpinCoefficients, Viscoelastic, impedance};

/// Unknowns of the small motions: the angular velocity, the coordinates, and for a liquid whose impedance is known the angles about its axes in
/// place of its coordinates.
#[derive(Clone)]
pub(super) struct Unknowns<'a> {
    pub body: &'a FlexibleBody,
    /// Coordinates that are unknowns.
    pub kept: Vec<usize>,
    /// Liquids with the index of their first axis among the unknowns after the angular velocity.
    pub memories: Vec<(usize, &'a LiquidMemory)>,
    /// Number of unknowns.
    pub size: usize,
    /// True if a material or a liquid makes the eigenproblem nonlinear.
    pub nonlinear: bool,
}

impl<'a> Unknowns<'a> {
    /// Unknowns with the exact response of materials and liquids.
    pub fn exact(body: &'a FlexibleBody) -> Self {
        let known = |j: &usize| body.memories().iter().any(|memory| memory.coordinates.contains(j));
        let kept: Vec<usize> = (0..body.coordinates().len()).filter(|j| !known(j)).collect();
        let mut next = kept.len();
        let place = |memory: &'a LiquidMemory| {
            let start = next;
            next += memory.axes.len();
            (start, memory)
        };
        let memories: Vec<_> = body.memories().iter().map(place).collect();
        let nonlinear = !(body.viscoelastic().is_empty() && memories.is_empty());
        Self { body, kept, memories, size: 3 + next, nonlinear }
    }

    /// Unknowns of the equations of motion: all coordinates.
    pub fn of_motion(body: &'a FlexibleBody) -> Self {
        let kept: Vec<usize> = (0..body.coordinates().len()).collect();
        Self { body, size: 3 + kept.len(), kept, memories: Vec::new(), nonlinear: false }
    }

    /// True if a liquid enters by its impedance in place of coordinates.
    pub fn has_liquids(&self) -> bool {
        !self.memories.is_empty()
    }

    /// Whether a mode is a relaxation of a liquid in a cavity, overdamped and without growth: of these there is no end, and which of them an
    /// iteration comes to is left to rounding. (M3)
    pub fn is_relaxation(&self, mode: &SpinMode) -> bool {
        let coordinates = self.body.coordinates();
        let in_cavity = |memory: &LiquidMemory| {
            memory.flow != LiquidFlow::Tube && coordinates[memory.coordinates.start].part() == mode.name
        };
        mode.overdamped() && !mode.grows() && self.memories.iter().any(|(_, memory)| in_cavity(memory))
    }

    /// Unknowns of a motion of all coordinates, with the angles of liquids where it has them.
    pub fn given(&self, Eigenmotion { delta, q, angles, .. }: &Eigenmotion) -> Vec<Complex<f64>> {
        let mut x = delta.to_vec();
        x.extend(self.kept.iter().map(|j| q[*j]).chain(angles.iter().copied()));
        x.resize(self.size, Complex::from(0.0));
        x
    }

    /// Displacements of all coordinates; zero of those of a liquid whose impedance is known.
    pub fn coordinates(&self, x: &[Complex<f64>]) -> Vec<Complex<f64>> {
        let mut q = vec![Complex::from(0.0); self.body.coordinates().len()];
        self.kept.iter().zip(&x[3..]).for_each(|(j, x)| q[*j] = *x);
        q
    }

    /// Motion of all coordinates.
    pub fn motion(&self, (lambda, x): &Pair) -> Eigenmotion {
        let q = self.coordinates(x);
        let rate = q.iter().map(|q| lambda * q).collect();
        Eigenmotion { lambda: *lambda, delta: [x[0], x[1], x[2]], rate, q, angles: Vec::new() }
    }

    /// Angular momentum per unit rate and per unit displacement of each unknown after the angular velocity.
    pub fn couplings(&self, coefficients: &SpinCoefficients) -> impl Iterator<Item = ([f64; 3], [f64; 3])> {
        let SpinCoefficients { h, slopes, .. } = coefficients;
        let coordinates = self.kept.iter().map(|j| (h[*j], slopes[*j]));
        let axes =
            self.memories.iter().flat_map(|(_, memory)| memory.axes.iter().map(move |axis| (memory, axis)));
        coordinates.chain(axes.map(|(memory, axis)| (scale(memory.inertia, *axis), [0.0; 3])))
    }

    /// Entries `λ a·Z b` of the liquids whose impedance is known, by their places after the angular velocity.
    pub fn impedances(&self, lambda: Complex<f64>, omega: Vector3<f64>) -> Vec<(usize, usize, Complex<f64>)> {
        let of_liquid = |(start, memory): &(usize, &LiquidMemory)| {
            let start = *start;
            between_axes(memory, lambda, omega).into_iter().map(move |(i, j, Z)| (start + i, start + j, Z))
        };
        self.memories.iter().flat_map(of_liquid).collect()
    }

    /// Motions of the liquids whose impedance is known.
    pub fn liquids<'x>(
        &'x self,
        lambda: Complex<f64>,
        x: &'x [Complex<f64>],
    ) -> impl Iterator<Item = LiquidMotion<'x>> {
        let angles = |start: &usize, memory: &LiquidMemory| &x[3 + start..3 + start + memory.axes.len()];
        self.memories.iter().map(move |(start, memory)| (*memory, lambda, angles(start, memory)))
    }
}

/// Entries `λ a·Z b` between the axes of a liquid whose impedance is known, by the places of the axes.
pub(super) fn between_axes(
    memory: &LiquidMemory,
    lambda: Complex<f64>,
    omega: Vector3<f64>,
) -> Vec<(usize, usize, Complex<f64>)> {
    let Z = impedance(memory, lambda, omega);
    let axes: Vec<_> = memory.axes.iter().map(|axis| Vector3::from(*axis).map(Complex::from)).collect();
    let pairs = (0..axes.len()).flat_map(|i| (0..axes.len()).map(move |j| (i, j)));
    pairs.map(|(i, j)| (i, j, lambda * axes[i].dot(&(Z * axes[j])))).collect()
}

/// `λ1 + [ω]ₓ`.
pub(super) fn turning(lambda: Complex<f64>, omega: Vector3<f64>) -> Matrix3<Complex<f64>> {
    Matrix3::from_diagonal_element(lambda) + omega.cross_matrix().map(Complex::from)
}

/// Complex modulus of a material less one.
pub(super) fn modulus(material: &Viscoelastic, lambda: Complex<f64>) -> Complex<f64> {
    let [re, im] = material.rheology.continued([lambda.re, lambda.im]);
    Complex::new(re - 1.0, im)
}
