//! Coefficients of the full equations about a steady rotation with displaced coordinates. (M2)

use super::{CurvedPaths, FlexibleBody, Invariants};
use crate::math::eigen::Dense;
use crate::math::sym3::{self, Sym, times};
use crate::math::vec3::{add, cross, dot, scale};

/// Coefficients of small motions about a steady angular velocity `ω` and displacements `q`. (M2)
///
/// The translation of a free body is eliminated (S6).
#[derive(Clone, Debug)]
pub struct SpinCoefficients {
    /// Inertia tensor `J(q)` (kg·m²).
    pub inertia: Sym,
    /// Mass matrix `A` of the coordinates; on curved paths it depends on the displacements.
    pub mass: Dense,
    /// Angular momentum per unit rate of each coordinate, `h_k(q)`.
    pub h: Vec<[f64; 3]>,
    /// Change of the angular momentum with each coordinate, `(∂J/∂q_j) ω`; zero of cyclic ones.
    pub slopes: Vec<[f64; 3]>,
    /// Gyroscopic matrix `G`, antisymmetric.
    pub gyroscopic: Dense,
    /// Centrifugal stiffness `N`, symmetric, to be subtracted from `C`.
    pub centrifugal: Dense,
}

impl SpinCoefficients {
    /// `A x`.
    #[must_use]
    pub fn mass_times(&self, x: &[f64]) -> Vec<f64> {
        let row = |j: usize| x.iter().enumerate().map(|(k, x)| self.mass.at(j, k) * x).sum();
        (0..x.len()).map(row).collect()
    }
}

impl FlexibleBody {
    /// Coefficients of small motions about a steady angular velocity (rad/s) with these displacements, momenta and inertia to the second
    /// order in these. (M2), (K6)
    #[must_use]
    pub fn about_spin(&self, omega: [f64; 3], q: &[f64]) -> SpinCoefficients {
        let elastic = self.elastic();
        straight(self.invariants(), self.translation(), &|j| j < elastic, omega, q)
    }

    /// The same along curved paths, where the body has them: the mass matrix is positive at any displacement. (M10)
    #[must_use]
    pub fn about_spin_on_paths(&self, omega: [f64; 3], q: &[f64]) -> SpinCoefficients {
        let Some(paths) = self.paths() else { return self.about_spin(omega, q) };
        let (n, elastic) = (q.len(), self.elastic());
        let Followed { z, slopes } = Followed::at(paths, q);
        let displaced = |j: usize| j < elastic || j >= n;
        let whole = straight(&paths.straight, self.translation(), &displaced, omega, &z);
        let gathered = |list: &[[f64; 3]]| -> Vec<[f64; 3]> {
            let fields = |j: usize| {
                slopes.iter().zip(&list[n..]).map(move |(slopes, vector)| scale(slopes[j], *vector))
            };
            (0..n).map(|j| fields(j).fold(list[j], add)).collect()
        };
        let mut centrifugal = projected(&whole.centrifugal, &slopes, n);
        let from = paths.coordinates.start;
        for (form, slope) in paths.forms.iter().zip(&whole.slopes[n..]) {
            let load = 0.5 * dot(omega, *slope);
            let size = paths.coordinates.len();
            for (at, entry) in form.iter().enumerate() {
                centrifugal.add(from + at / size, from + at % size, load * entry);
            }
        }
        SpinCoefficients {
            inertia: whole.inertia,
            mass: projected(&whole.mass, &slopes, n),
            h: gathered(&whole.h),
            slopes: gathered(&whole.slopes),
            gyroscopic: projected(&whole.gyroscopic, &slopes, n),
            centrifugal,
        }
    }
}

/// Values of all coordinates of a body on straight paths, the last of which follow the others, with the slopes `∂y_e/∂q_j`. (K12)
struct Followed {
    z: Vec<f64>,
    slopes: Vec<Vec<f64>>,
}

impl Followed {
    fn at(paths: &CurvedPaths, q: &[f64]) -> Self {
        let curving = &q[paths.coordinates.clone()];
        let (mut z, mut slopes) = (q.to_vec(), Vec::with_capacity(paths.fields()));
        for form in &paths.forms {
            let mut slope = vec![0.0; q.len()];
            for (j, row) in form.chunks_exact(curving.len()).enumerate() {
                slope[paths.coordinates.start + j] = row.iter().zip(curving).map(|(form, q)| form * q).sum();
            }
            z.push(0.5 * slope.iter().zip(q).map(|(slope, q)| slope * q).sum::<f64>());
            slopes.push(slope);
        }
        Self { z, slopes }
    }
}

/// `DᵀMD` with the slopes `D` of all coordinates of a body on straight paths with respect to the first `n`.
fn projected(matrix: &Dense, slopes: &[Vec<f64>], n: usize) -> Dense {
    let half = |i: usize, k: usize| {
        let fields = slopes.iter().enumerate().map(|(e, slopes)| matrix.at(i, n + e) * slopes[k]);
        matrix.at(i, k) + fields.sum::<f64>()
    };
    let mut sum = Dense::zero(n);
    for k in 0..n {
        let fields: Vec<f64> = (0..slopes.len()).map(|e| half(n + e, k)).collect();
        for j in 0..n {
            let own: f64 = slopes.iter().zip(&fields).map(|(slopes, field)| slopes[j] * field).sum();
            sum.add(j, k, half(j, k) + own);
        }
    }
    sum
}

/// Coefficients on straight paths; the coordinates that are not `displaced` are cyclic.
fn straight(
    invariants: &Invariants,
    translation: Option<f64>,
    displaced: &dyn Fn(usize) -> bool,
    omega: [f64; 3],
    z: &[f64],
) -> SpinCoefficients {
    let Invariants { J, J1, S, h, pairs, .. } = invariants;
    let count = S.len();
    let (mut inertia, mut h) = (*J, h.clone());
    let mut slopes: Vec<[f64; 3]> = J1.iter().map(|J1| times(*J1, omega)).collect();
    let (mut A, mut G, mut N) = (Dense::zero(count), Dense::zero(count), Dense::zero(count));
    let mut grow =
        |amount: f64, part: Sym| inertia.iter_mut().zip(part).for_each(|(sum, part)| *sum += amount * part);
    (0..count).filter(|j| displaced(*j)).for_each(|j| grow(z[j], J1[j]));
    for (j, k, pair) in pairs.iter() {
        let turn = dot(omega, pair.Z);
        A.add(j, k, pair.A);
        G.add(j, k, -turn);
        if displaced(j) {
            let load = times(pair.J2, omega);
            G.add(k, j, turn);
            slopes[j] = add(slopes[j], scale(2.0 * z[k], load));
            h[k] = add(h[k], scale(z[j], pair.Z));
            if displaced(k) {
                grow(z[j] * z[k], pair.J2);
                N.add(j, k, dot(omega, load));
            }
        }
    }
    let mut coefficients = SpinCoefficients { inertia, mass: A, h, slopes, gyroscopic: G, centrifugal: N };
    if let Some(per_mass) = translation {
        coefficients.recoil(S, per_mass, displaced, omega, z);
    }
    coefficients
}

impl SpinCoefficients {
    /// Takes the translation of a free body out. (S6)
    fn recoil(
        &mut self,
        S: &[[f64; 3]],
        per_mass: f64,
        displaced: &dyn Fn(usize) -> bool,
        omega: [f64; 3],
        z: &[f64],
    ) {
        let moved = (0..S.len()).filter(|j| displaced(*j));
        let s = moved.fold([0.0; 3], |s, j| add(s, scale(z[j], S[j])));
        let [xx, yy, zz, yz, zx, xy] = sym3::products(s);
        let about_center = [yy + zz, zz + xx, xx + yy, -yz, -zx, -xy];
        self.inertia.iter_mut().zip(about_center).for_each(|(J, part)| *J -= per_mass * part);
        let square = dot(omega, omega);
        for (j, S_j) in S.iter().enumerate() {
            for (k, S_k) in S.iter().enumerate() {
                self.mass.add(j, k, -per_mass * dot(*S_j, *S_k));
            }
            if !displaced(j) {
                continue;
            }
            let along = add(scale(dot(*S_j, omega), s), scale(dot(s, omega), *S_j));
            let own = scale(2.0 * dot(*S_j, s), omega);
            self.slopes[j] = add(self.slopes[j], scale(-per_mass, add(own, scale(-1.0, along))));
            self.h[j] = add(self.h[j], scale(-per_mass, cross(s, *S_j)));
            for (k, S_k) in S.iter().enumerate() {
                self.gyroscopic.add(j, k, 2.0 * per_mass * dot(omega, cross(*S_j, *S_k)));
                if displaced(k) {
                    let load = square * dot(*S_j, *S_k) - dot(*S_j, omega) * dot(*S_k, omega);
                    self.centrifugal.add(j, k, -per_mass * load);
                }
            }
        }
    }
}
