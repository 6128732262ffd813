//! Kinetics on straight paths in lanes: eight states of a body of few coordinates side by side.
//! With the momenta as variables every coefficient of the rates is a polynomial of degree two in the coordinates, whose coefficients, sums over
//! pairs of coordinates, are formed once.
//! Equation (T5), docs/theory/08-full-system.md.

use super::mass_inverse::MassInverse;
use super::{FlexibleBody, Invariants};
use crate::math::lanes::Lanes;
use crate::math::simd::Arithmetic;
use crate::math::sparse::SparseRows;
use crate::math::sym3::{Sym, of_unit_mass};
use crate::math::vec3::{add, cross, scale};

/// Rates of a body on straight paths, as polynomials of the coordinates. (T5)
#[derive(Clone, Debug)]
pub struct StraightKinetics {
    /// `N(q) = N + N_j q_j + N_jk q_j q_k`: the constant part, `½N_j`, and `N_jk` row by row.
    inertia: Sym,
    half_slopes: Vec<Sym>,
    squares: Vec<Sym>,
    /// `X(q) = X + X_j q_j`: `X` coordinate by coordinate, and the rows `X_jk`.
    coupling: Vec<[f64; 3]>,
    couplings: Vec<[f64; 3]>,
    /// Rows of `A⁻¹`, `B` and `C`.
    inverse: Vec<f64>,
    damping: Vec<f64>,
    stiffness: Vec<f64>,
    /// Gyroscopic coupling of cyclic coordinates.
    gyroscopic: Vec<(usize, usize, [f64; 3])>,
    /// At the last states: `½∂N/∂q_j`, and `X_jk p_k`.
    slopes: Vec<[Lanes; 6]>,
    moments: Vec<[Lanes; 3]>,
}

/// Number of coordinates up to which the rates of eight states side by side cost less than one after the other.
const MAX_LANE_COORDINATES: usize = 12;

/// Any number of coordinates: others are known to the compiler.
const ANY: usize = 0;

impl StraightKinetics {
    /// Polynomials of a body; none for a body of many coordinates, on curved paths, with liquids that are carried along or friction that is not linear, and where the mass
    /// matrix is not positive.
    #[must_use]
    pub fn new(body: &FlexibleBody) -> Option<Self> {
        let n = body.coordinates().len();
        if n > MAX_LANE_COORDINATES
            || body.paths().is_some()
            || !body.advections().is_empty()
            || !body.frictions().is_empty()
        {
            return None;
        }
        let inverse = inverse(body)?;
        let times = |rows: &[[f64; 3]]| -> Vec<[f64; 3]> {
            let row = |k: usize| (0..n).fold([0.0; 3], |sum, l| add(sum, scale(inverse[k * n + l], rows[l])));
            (0..n).map(row).collect()
        };
        let Invariants { J, J1, h, .. } = body.invariants();
        let (second, changes) = second_order(body);
        let coupling = times(h);
        let couplings: Vec<_> = changes.chunks_exact(n.max(1)).flat_map(times).collect();
        let row = |j: usize| j * n..(j + 1) * n;
        let slope = |j: usize| {
            let both = [less(&changes[row(j)], &coupling), less(h, &couplings[row(j)])];
            sum(J1[j], sum(both[0], both[1])).map(|entry| 0.5 * entry)
        };
        let square = |j: usize, k: usize| {
            let both =
                [less(&changes[row(j)], &couplings[row(k)]), less(&changes[row(k)], &couplings[row(j)])];
            sum(second[j * n + k], sum(both[0], both[1]).map(|entry| 0.5 * entry))
        };
        Some(Self {
            inertia: sum(*J, less(h, &coupling)),
            half_slopes: (0..n).map(slope).collect(),
            squares: (0..n * n).map(|place| square(place / n, place % n)).collect(),
            damping: full(body.damping()),
            stiffness: full(body.stiffness()),
            gyroscopic: gyroscopic(body),
            slopes: vec![[Lanes::splat(0.0); 6]; n],
            moments: vec![[Lanes::splat(0.0); 3]; n],
            coupling,
            couplings,
            inverse,
        })
    }

    /// Angular velocities at these angular momenta (without the wheels), momenta and coordinates; writes the rates of the coordinates and of
    /// their momenta. (T5)
    #[inline(always)]
    pub fn rates<R: Arithmetic>(
        &mut self,
        K: [Lanes; 3],
        states: [&[Lanes]; 2],
        rates: [&mut [Lanes]; 2],
    ) -> [Lanes; 3] {
        match self.half_slopes.len() {
            1 => self.rates_of::<R, 1>(K, states, rates),
            2 => self.rates_of::<R, 2>(K, states, rates),
            3 => self.rates_of::<R, 3>(K, states, rates),
            _ => self.rates_of::<R, ANY>(K, states, rates),
        }
    }

    /// Rates for so many coordinates.
    #[inline(always)]
    fn rates_of<R: Arithmetic, const N: usize>(
        &mut self,
        K: [Lanes; 3],
        [q, p]: [&[Lanes]; 2],
        [q_rate, p_rate]: [&mut [Lanes]; 2],
    ) -> [Lanes; 3] {
        let (n, zero) = (if N == ANY { q.len() } else { N }, Lanes::splat(0.0));
        let (q, p, q_rate, p_rate) = (&q[..n], &p[..n], &mut q_rate[..n], &mut p_rate[..n]);
        let mut inertia = splat(&self.inertia);
        let mut load = K;
        for j in 0..n {
            let mut slope = splat(&self.half_slopes[j]);
            let mut moment = [zero; 3];
            for k in 0..n {
                add_scaled::<R, 6>(&mut slope, &self.squares[j * n + k], q[k]);
                add_scaled::<R, 3>(&mut moment, &self.couplings[j * n + k], p[k]);
            }
            let minus = [zero - q[j], zero - p[j]];
            for i in 0..6 {
                inertia[i] = (slope[i] + Lanes::splat(self.half_slopes[j][i])).mul_add::<R>(q[j], inertia[i]);
            }
            for i in 0..3 {
                load[i] = moment[i].mul_add::<R>(minus[0], load[i]);
            }
            add_scaled::<R, 3>(&mut load, &self.coupling[j], minus[1]);
            (self.slopes[j], self.moments[j]) = (slope, moment);
        }
        let omega = solved::<R>(inertia, load);
        let minus = [zero - omega[0], zero - omega[1], zero - omega[2]];
        for k in 0..n {
            let mut coupling = splat(&self.coupling[k]);
            let mut rate = zero;
            for j in 0..n {
                add_scaled::<R, 3>(&mut coupling, &self.couplings[j * n + k], q[j]);
                rate = p[j].mul_add::<R>(Lanes::splat(self.inverse[k * n + j]), rate);
            }
            q_rate[k] = product::<R>(coupling, minus, rate);
        }
        self.load::<R, N>(omega, q, q_rate, p_rate);
        omega
    }

    /// Loads on the coordinates, centrifugal and Coriolis, spring and dashpot.
    #[inline(always)]
    fn load<R: Arithmetic, const N: usize>(
        &self,
        omega: [Lanes; 3],
        q: &[Lanes],
        q_rate: &[Lanes],
        p_rate: &mut [Lanes],
    ) {
        let n = if N == ANY { q.len() } else { N };
        let [x, y, z] = omega;
        let square = [x * x, y * y, z * z, (y + y) * z, (z + z) * x, (x + x) * y];
        for j in 0..n {
            let mut load = product::<R>(self.moments[j], omega, Lanes::splat(0.0));
            for i in 0..6 {
                load = self.slopes[j][i].mul_add::<R>(square[i], load);
            }
            for k in 0..n {
                load = q_rate[k].mul_add::<R>(Lanes::splat(-self.damping[j * n + k]), load);
                load = q[k].mul_add::<R>(Lanes::splat(-self.stiffness[j * n + k]), load);
            }
            p_rate[j] = load;
        }
        for (j, k, coupling) in &self.gyroscopic {
            let turning = product::<R>(splat(coupling), omega, Lanes::splat(0.0));
            p_rate[*j] = turning.mul_add::<R>(q_rate[*k], p_rate[*j]);
        }
    }

    /// Power that the dashpots take at these rates (W).
    #[inline(always)]
    pub fn dissipation<R: Arithmetic>(&self, q_rate: &[Lanes]) -> Lanes {
        let n = q_rate.len();
        let mut power = Lanes::splat(0.0);
        for j in 0..n {
            let mut force = Lanes::splat(0.0);
            for k in 0..n {
                force = q_rate[k].mul_add::<R>(Lanes::splat(self.damping[j * n + k]), force);
            }
            power = force.mul_add::<R>(q_rate[j], power);
        }
        power
    }
}

/// Rows of `A⁻¹`, the translation of a free body eliminated; none where the matrix is not positive.
fn inverse(body: &FlexibleBody) -> Option<Vec<f64>> {
    let n = body.coordinates().len();
    let factor = MassInverse::new(body)?;
    let mut columns = vec![0.0; n * n];
    for column in 0..n {
        let unit: Vec<_> = (0..n).map(|row| [f64::from(u8::from(row == column)), 0.0, 0.0, 0.0]).collect();
        let mut solved = vec![[0.0; 4]; n];
        factor.apply(&unit, &mut solved);
        solved.iter().enumerate().for_each(|(row, solved)| columns[row * n + column] = solved[0]);
    }
    Some(columns)
}

/// `J_jk` and the changes of `h_k` with `q_j`, row by row, the translation of a free body eliminated; zero for cyclic coordinates, whose
/// values have no effect.
fn second_order(body: &FlexibleBody) -> (Vec<Sym>, Vec<[f64; 3]>) {
    let n = body.coordinates().len();
    let Invariants { S, pairs, .. } = body.invariants();
    let per_mass = body.translation().unwrap_or(0.0);
    let (mut second, mut changes) = (vec![[0.0; 6]; n * n], vec![[0.0; 3]; n * n]);
    let elastic = body.elastic();
    for (j, k, pair) in pairs.iter().filter(|(j, ..)| *j < elastic) {
        second[j * n + k] = pair.J2;
        changes[j * n + k] = pair.Z;
    }
    for j in 0..elastic {
        for k in 0..n {
            let place = j * n + k;
            changes[place] = add(changes[place], scale(-per_mass, cross(S[j], S[k])));
            if k < elastic {
                let [both, one, other] = [add(S[j], S[k]), S[j], S[k]].map(of_unit_mass);
                for i in 0..6 {
                    second[place][i] -= 0.5 * per_mass * (both[i] - one[i] - other[i]);
                }
            }
        }
    }
    (second, changes)
}

/// Couplings `Z_jk` of pairs of cyclic coordinates.
fn gyroscopic(body: &FlexibleBody) -> Vec<(usize, usize, [f64; 3])> {
    let cyclic = body.invariants().pairs.iter().filter(|(j, ..)| *j >= body.elastic());
    cyclic.filter(|(.., pair)| pair.Z != [0.0; 3]).map(|(j, k, pair)| (j, k, pair.Z)).collect()
}

/// `−½ Σ (a bᵀ + b aᵀ)` over the rows of two lists.
fn less(a: &[[f64; 3]], b: &[[f64; 3]]) -> Sym {
    let mut sum = [0.0; 6];
    for (a, b) in a.iter().zip(b) {
        for (i, (row, column)) in [(0, 0), (1, 1), (2, 2), (1, 2), (2, 0), (0, 1)].into_iter().enumerate() {
            sum[i] -= 0.5 * (a[row] * b[column] + a[column] * b[row]);
        }
    }
    sum
}

fn sum(a: Sym, b: Sym) -> Sym {
    std::array::from_fn(|i| a[i] + b[i])
}

fn full(matrix: &SparseRows<f64>) -> Vec<f64> {
    let n = matrix.size();
    let mut rows = vec![0.0; n * n];
    matrix.iter().for_each(|(row, column, entry)| rows[row * n + column] += entry);
    rows
}

/// The same numbers in every lane.
#[inline(always)]
fn splat<const D: usize>(numbers: &[f64; D]) -> [Lanes; D] {
    let mut lanes = [Lanes::splat(0.0); D];
    for i in 0..D {
        lanes[i] = Lanes::splat(numbers[i]);
    }
    lanes
}

/// Adds `entries · factor` to the sums.
#[inline(always)]
fn add_scaled<R: Arithmetic, const D: usize>(sums: &mut [Lanes; D], entries: &[f64; D], factor: Lanes) {
    for i in 0..D {
        sums[i] = factor.mul_add::<R>(Lanes::splat(entries[i]), sums[i]);
    }
}

/// `a · b + c`.
#[inline(always)]
fn product<R: Arithmetic>(a: [Lanes; 3], b: [Lanes; 3], c: Lanes) -> Lanes {
    a[2].mul_add::<R>(b[2], a[1].mul_add::<R>(b[1], a[0].mul_add::<R>(b[0], c)))
}

/// Solution of a symmetric system of size three, by its cofactors.
#[inline(always)]
fn solved<R: Arithmetic>([xx, yy, zz, yz, zx, xy]: [Lanes; 6], load: [Lanes; 3]) -> [Lanes; 3] {
    let zero = Lanes::splat(0.0);
    let x = [minor::<R>(yy, zz, yz, yz), minor::<R>(yz, zx, xy, zz), minor::<R>(xy, yz, zx, yy)];
    let y = [x[1], minor::<R>(zz, xx, zx, zx), minor::<R>(zx, xy, yz, xx)];
    let z = [x[2], y[2], minor::<R>(xx, yy, xy, xy)];
    let scale = Lanes::splat(1.0) / product::<R>(x, [xx, xy, zx], zero);
    [
        scale * product::<R>(x, load, zero),
        scale * product::<R>(y, load, zero),
        scale * product::<R>(z, load, zero),
    ]
}

/// `a b − c d`.
#[inline(always)]
fn minor<R: Arithmetic>(a: Lanes, b: Lanes, c: Lanes, d: Lanes) -> Lanes {
    (Lanes::splat(0.0) - c).mul_add::<R>(d, a * b)
}
