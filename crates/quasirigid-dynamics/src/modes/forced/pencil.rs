//! Nonlinear eigenproblem of small motions about a steady state, `P(λ)x = 0`. (M7)

use nalgebra::{Complex, DMatrix, Matrix3, Vector3};

use super::system::System;
use crate::math::eigen::Dense;
use crate::math::lu::{ComplexDense, ComplexLu};
use crate::math::vec3::scale;
use crate::model::{FlexibleBody, LiquidMemory, RationalModulus};
use crate::modes::iteration::{Nonlinear, Solution, times};
use crate::modes::unknowns::between_axes;

type C = Complex<f64>;

/// Unknowns: the rotation `θ`, or the angular velocity where no force depends on the attitude; the coordinates, without those of liquids
/// whose impedance is known; the angles of these liquids; the velocity of a free body where that is followed.
pub(super) struct Pencil<'a> {
    body: &'a FlexibleBody,
    system: &'a System,
    attitude: bool,
    kept: Vec<usize>,
    memories: Vec<(usize, &'a LiquidMemory)>,
    viscoelastic: Vec<Dense>,
    /// Moduli that stand for those of the materials.
    rational: Option<&'a [RationalModulus]>,
    /// Index of the velocity, and the number of unknowns.
    velocity: usize,
    size: usize,
}

impl<'a> Pencil<'a> {
    pub fn new(body: &'a FlexibleBody, system: &'a System, attitude: bool, followed: bool) -> Self {
        let known = |j: &usize| body.memories().iter().any(|memory| memory.coordinates.contains(j));
        let kept: Vec<usize> = (0..body.coordinates().len()).filter(|j| !known(j)).collect();
        let mut next = 3 + kept.len();
        let mut memories = Vec::new();
        for memory in body.memories() {
            memories.push((next, memory));
            next += memory.axes.len();
        }
        let viscoelastic =
            body.viscoelastic().iter().map(|viscoelastic| Dense::of(&viscoelastic.stiffness)).collect();
        let size = if followed { next + 3 } else { next };
        Self { body, system, attitude, kept, memories, viscoelastic, rational: None, velocity: next, size }
    }

    /// The same with states in place of memories: rational moduli of the materials, all coordinates of the liquids. (M21)
    pub fn with_states(self, rational: &'a [RationalModulus]) -> Self {
        let kept: Vec<usize> = (0..self.body.coordinates().len()).collect();
        let (velocity, velocities) = (3 + kept.len(), self.size - self.velocity);
        let size = velocity + velocities;
        Self { kept, memories: Vec::new(), rational: Some(rational), velocity, size, ..self }
    }

    /// Angular velocities by torques on the carrier at a frequency (rad/s), a column each; none where a motion needs no torque.
    pub fn response(&self, frequency: f64) -> Option<Matrix3<C>> {
        let lambda = C::new(0.0, frequency);
        let mut torques = vec![[0.0; 2]; 3 * self.size];
        (0..3).for_each(|axis| torques[4 * axis][0] = 1.0);
        let solved = ComplexLu::new(&self.at(lambda))?.solve(&torques, 3)?;
        let turns =
            Matrix3::from_fn(|row, column| C::new(solved[3 * row + column][0], solved[3 * row + column][1]));
        Some(self.turning(lambda) * turns)
    }

    /// True if a material or a liquid makes the eigenproblem nonlinear.
    pub fn is_nonlinear(&self) -> bool {
        !(self.viscoelastic.is_empty() && self.memories.is_empty())
    }

    /// True if a liquid enters by its impedance in place of coordinates.
    pub fn has_liquids(&self) -> bool {
        !self.memories.is_empty()
    }

    /// `[λ + ω×]`, which takes `θ` to the angular velocity; the identity where the angular velocity is the unknown.
    fn turning(&self, lambda: C) -> Matrix3<C> {
        if !self.attitude {
            return Matrix3::identity();
        }
        Matrix3::from_diagonal_element(lambda) + self.system.turning().map(Complex::from)
    }

    /// Unknowns of a motion.
    pub fn unknowns(&self, turn: [C; 3], q: &[C], velocity: &[C]) -> Vec<C> {
        let mut x = turn.to_vec();
        x.extend(self.kept.iter().map(|j| q[*j]));
        x.resize(self.velocity, C::from(0.0));
        x.extend(velocity);
        x
    }

    /// Angular velocity from the unknowns.
    pub fn spin(&self, lambda: C, x: &[C]) -> [C; 3] {
        let spin = self.turning(lambda) * Vector3::new(x[0], x[1], x[2]);
        spin.into()
    }

    /// Displacements of all coordinates; zero of those of a liquid whose impedance is known.
    pub fn coordinates(&self, x: &[C]) -> Vec<C> {
        let mut q = vec![C::from(0.0); self.body.coordinates().len()];
        self.kept.iter().zip(&x[3..]).for_each(|(j, x)| q[*j] = *x);
        q
    }

    /// Liquids whose impedance is known with the angles about their axes.
    pub fn liquids<'x>(&'x self, x: &'x [C]) -> impl Iterator<Item = (&'a LiquidMemory, &'x [C])> {
        self.memories.iter().map(|(start, memory)| (*memory, &x[*start..*start + memory.axes.len()]))
    }

    /// Modulus of a material.
    fn modulus(&self, number: usize, lambda: C) -> C {
        let s = [lambda.re, lambda.im];
        let [re, im] = match self.rational {
            Some(rational) => rational[number].at(s),
            None => self.body.viscoelastic()[number].rheology.continued(s),
        };
        C::new(re, im)
    }

    /// Rows of the system with the indices of their unknowns.
    fn rows(&self) -> Vec<(usize, usize)> {
        let n = self.body.coordinates().len();
        let coordinates = self.kept.iter().enumerate().map(|(place, j)| (3 + j, 3 + place));
        let velocity = (self.velocity..self.size).enumerate().map(|(i, place)| (3 + n + i, place));
        (0..3).map(|i| (i, i)).chain(coordinates).chain(velocity).collect()
    }

    /// Bound on the change of an eigenvalue by rounding.
    pub fn rounding(&self, lambda: C, x: &[C]) -> f64 {
        let P = self.at(lambda);
        let entry = |i: usize, k: usize| {
            let [re, im] = P.at(i, k);
            re.hypot(im)
        };
        let h = Complex::from(1e-4 * lambda.norm());
        let (ahead, behind) = (self.at(lambda + h), self.at(lambda - h));
        let (mut size, mut slope) = (0.0, C::from(0.0));
        for i in 0..self.size {
            for k in 0..self.size {
                size += x[i].norm() * entry(i, k) * x[k].norm();
                let [a, b] = [&ahead, &behind].map(|P| C::new(P.at(i, k)[0], P.at(i, k)[1]));
                slope += x[i].conj() * (a - b) / (2.0 * h) * x[k];
            }
        }
        ROUNDED * size / slope.norm()
    }
}

/// Rounding of an entry, relative to it, with a margin.
const ROUNDED: f64 = 16.0 * f64::EPSILON;

impl Pencil<'_> {
    /// `P(λ)`.
    fn at(&self, lambda: C) -> ComplexDense {
        let mut P = ComplexDense::zero(self.size);
        let System { mass, rate, stiffness, omega, .. } = self.system;
        let elastic = self.body.elastic();
        let n = self.body.coordinates().len();
        let turning = self.turning(lambda);
        let rows = self.rows();
        let mut add = |row: usize, column: usize, value: C| P.add(row, column, [value.re, value.im]);
        for (row, at) in &rows {
            let spin = Vector3::from([0, 1, 2].map(|k| lambda * mass[(*row, k)] + rate[(*row, k)]));
            let turned = turning.transpose() * spin;
            for k in 0..3 {
                let held = if self.attitude { stiffness[(*row, k)] } else { 0.0 };
                add(*at, k, turned[k] + held);
            }
            for (column, to) in rows.iter().filter(|(column, _)| *column >= 3) {
                let dynamic = lambda * mass[(*row, *column)] + rate[(*row, *column)];
                let whole = if *column >= 3 + n { dynamic } else { lambda * dynamic };
                let displaced = *column < 3 + elastic;
                add(*at, *to, whole + if displaced { stiffness[(*row, *column)] } else { 0.0 });
            }
        }
        for (number, stiffness) in self.viscoelastic.iter().enumerate() {
            let factor = self.modulus(number, lambda) - 1.0;
            for (j, row) in self.kept.iter().enumerate() {
                for (k, column) in self.kept.iter().enumerate() {
                    add(3 + j, 3 + k, factor * stiffness.at(*row, *column));
                }
            }
        }
        let whirl = Matrix3::from_diagonal_element(lambda) + self.system.turning().map(Complex::from);
        for (start, memory) in &self.memories {
            for (i, a) in memory.axes.iter().enumerate() {
                let h = Vector3::from(scale(memory.inertia, *a)).map(Complex::from);
                let (column, row) = (whirl * h * lambda, turning.transpose() * h * lambda);
                for k in 0..3 {
                    add(k, start + i, column[k]);
                    add(start + i, k, row[k]);
                }
            }
            for (i, j, entry) in between_axes(memory, lambda, Vector3::from(*omega)) {
                add(start + i, start + j, entry);
            }
        }
        P
    }
}

impl Nonlinear for Pencil<'_> {
    fn times(&self, lambda: C, x: &[C]) -> Vec<C> {
        times(&self.at(lambda), x)
    }

    fn solve(&self, lambda: C, right: &[C]) -> Solution {
        Solution::dense(&self.at(lambda), right)
    }

    fn weights(&self, lambda: C) -> Vec<f64> {
        let square = lambda.norm_sqr();
        let [turn, liquid] =
            [if self.attitude { square + self.system.turning().norm_squared() } else { 1.0 }, square];
        let n = self.body.coordinates().len();
        let mut weights = vec![0.0; self.size];
        for (row, at) in self.rows() {
            let factor = if row < 3 {
                turn
            } else if row < 3 + n {
                square
            } else {
                1.0
            };
            weights[at] = factor * self.system.mass[(row, row)];
        }
        for (start, memory) in &self.memories {
            (0..memory.axes.len()).for_each(|i| weights[start + i] = liquid * memory.inertia);
        }
        weights
    }
}

/// `xᴴ X y` of a real matrix.
pub(super) fn form(X: &DMatrix<f64>, x: &[C], y: &[C]) -> C {
    let row = |i: usize| (0..y.len()).map(|k| X[(i, k)] * y[k]).sum::<C>();
    (0..x.len()).map(|i| x[i].conj() * row(i)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::modes::forced::slopes::{Instant, Slopes};
    use crate::modes::iteration::product;
    use crate::problems::ring_of_points;

    /// A velocity counts with the mass of the body, in every direction and at every rate; a rate of a coordinate with its own.
    #[test]
    fn translations_in_all_directions_weigh_the_same() {
        let body = ring_of_points(1).body().unwrap();
        let n = body.coordinates().len();
        let instant = Instant {
            t: 0.0,
            attitude: [1.0, 0.0, 0.0, 0.0],
            omega: [0.2, -0.1, 0.9],
            q: vec![0.0; n],
            place: [0.0; 3],
            velocity: [0.3, 0.1, -0.2],
        };
        let system = System::about(&body, Slopes::none(&body), &instant, true);
        let pencil = Pencil::new(&body, &system, true, true);
        let one = |i: usize, j: usize| C::from(f64::from(u8::from(i == j)));
        let lambda = C::new(-0.4, 7.0);
        for axis in 0..3 {
            let x =
                pencil.unknowns([C::from(0.0); 3], &vec![C::from(0.0); n], &[0, 1, 2].map(|i| one(i, axis)));
            let found = product(&pencil.weights(lambda), &x, &x);
            assert!(
                (found - body.invariants().mass).norm() < 1e-12 * body.invariants().mass,
                "{axis}: {found}"
            );
        }
        for j in 0..n {
            let q: Vec<C> = (0..n).map(|k| one(j, k)).collect();
            let x = pencil.unknowns([C::from(0.0); 3], &q, &[C::from(0.0); 3]);
            let rate: Vec<f64> = (0..n).map(|k| lambda.norm() * one(j, k).re).collect();
            let twice: f64 = body.mass_times(&rate).iter().zip(&rate).map(|(p, rate)| p * rate).sum();
            let found = product(&pencil.weights(lambda), &x, &x);
            assert!((found - twice).norm() < 1e-12 * twice, "{j}: {found} {twice}");
        }
    }
}
