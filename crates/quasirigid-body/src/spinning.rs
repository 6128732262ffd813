//! Coefficients of the full equations about a steady rotation with displaced coordinates. (M2)

use nalgebra::DMatrix;

use super::{FlexibleBody, Invariants};
use crate::math::eigen::Dense;
use crate::math::sym3::{Sym, of_unit_mass, times};
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
    /// Centrifugal stiffness `N_jk = ωᵀJ_jk ω` at an angular velocity (rad/s) and any displacements of the second order, symmetric. (M2)
    #[must_use]
    pub fn centrifugal_stiffness(&self, omega: [f64; 3]) -> Dense {
        let elastic = self.elastic();
        centrifugal(self.invariants(), self.translation(), &|j| j < elastic, omega)
    }

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
        let fields = paths.amplitudes(q);
        let (slopes, mut z) = (&fields.slopes, q.to_vec());
        z.extend(&fields.y);
        let displaced = |j: usize| j < elastic || j >= n;
        let whole = straight(&paths.straight, self.translation(), &displaced, omega, &z);
        let gathered = |list: &[[f64; 3]]| -> Vec<[f64; 3]> {
            let field = |j: usize, e: usize| scale(slopes[(e, j)], list[n + e]);
            (0..n).map(|j| (0..paths.fields()).fold(list[j], |sum, e| add(sum, field(j, e)))).collect()
        };
        let mut centrifugal = projected(&whole.centrifugal, slopes);
        for ((coordinates, second), slope) in fields.curved.iter().zip(&whole.slopes[n..]) {
            let load = 0.5 * dot(omega, *slope);
            let (from, size) = (coordinates.start, coordinates.len());
            for (at, entry) in second.iter().enumerate() {
                centrifugal.add(from + at / size, from + at % size, load * entry);
            }
        }
        SpinCoefficients {
            inertia: whole.inertia,
            mass: projected(&whole.mass, slopes),
            h: gathered(&whole.h),
            slopes: gathered(&whole.slopes),
            gyroscopic: projected(&whole.gyroscopic, slopes),
            centrifugal,
        }
    }
}

/// `DᵀMD` with the derivatives `D` of all coordinates of a body on straight paths by the first, those of the last being `slopes`.
fn projected(matrix: &Dense, slopes: &DMatrix<f64>) -> Dense {
    let (fields, n) = slopes.shape();
    let half = |i: usize, k: usize| {
        let along = (0..fields).map(|e| matrix.at(i, n + e) * slopes[(e, k)]);
        matrix.at(i, k) + along.sum::<f64>()
    };
    let mut sum = Dense::zero(n);
    for k in 0..n {
        let along: Vec<f64> = (0..fields).map(|e| half(n + e, k)).collect();
        for j in 0..n {
            let own: f64 = along.iter().enumerate().map(|(e, along)| slopes[(e, j)] * along).sum();
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
    let (mut A, mut G) = (Dense::zero(count), Dense::zero(count));
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
            }
        }
    }
    let centrifugal = centrifugal(invariants, translation, displaced, omega);
    let mut coefficients = SpinCoefficients { inertia, mass: A, h, slopes, gyroscopic: G, centrifugal };
    if let Some(per_mass) = translation {
        coefficients.recoil(S, per_mass, displaced, omega, z);
    }
    coefficients
}

/// Centrifugal stiffness on straight paths, the translation of a free body taken out.
fn centrifugal(
    invariants: &Invariants,
    translation: Option<f64>,
    displaced: &dyn Fn(usize) -> bool,
    omega: [f64; 3],
) -> Dense {
    let Invariants { S, pairs, .. } = invariants;
    let mut N = Dense::zero(S.len());
    for (j, k, pair) in pairs.iter().filter(|(j, k, _)| displaced(*j) && displaced(*k)) {
        N.add(j, k, dot(omega, times(pair.J2, omega)));
    }
    if let Some(per_mass) = translation {
        let square = dot(omega, omega);
        let moved: Vec<usize> = (0..S.len()).filter(|j| displaced(*j)).collect();
        for &j in &moved {
            for &k in &moved {
                let load = square * dot(S[j], S[k]) - dot(S[j], omega) * dot(S[k], omega);
                N.add(j, k, -per_mass * load);
            }
        }
    }
    N
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
        self.inertia.iter_mut().zip(of_unit_mass(s)).for_each(|(J, part)| *J -= per_mass * part);
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
            }
        }
    }
}
