//! Coefficients of the full equations about a steady rotation with displaced coordinates. (M2)

use std::sync::Arc;

use nalgebra::DMatrix;

use super::spin_matrix::SpinSum;
use super::{FlexibleBody, Invariants, SpinMatrix};
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
    pub mass: SpinMatrix,
    /// Angular momentum per unit rate of each coordinate, `h_k(q)`.
    pub h: Vec<[f64; 3]>,
    /// Change of the angular momentum with each coordinate, `(∂J/∂q_j) ω`; zero of cyclic ones.
    pub slopes: Vec<[f64; 3]>,
    /// Gyroscopic matrix `G`, antisymmetric.
    pub gyroscopic: SpinMatrix,
    /// Centrifugal stiffness `N`, symmetric, to be subtracted from `C`.
    pub centrifugal: SpinMatrix,
}

/// Number of coordinates up to which matrices about a spin are dense.
const DENSE_COORDINATES: usize = 150;

impl FlexibleBody {
    /// Centrifugal stiffness `N_jk = ωᵀJ_jk ω` at an angular velocity (rad/s) and any displacements of the second order, symmetric. (M2)
    #[must_use]
    pub fn centrifugal_stiffness(&self, omega: [f64; 3]) -> SpinMatrix {
        let elastic = self.elastic();
        let place = Place { translation: self.translation(), displaced: &|j| j < elastic, omega };
        centrifugal(self.invariants(), &place, self.has_sparse_coefficients())
            .finished(&self.moments(self.has_sparse_coefficients()))
    }

    /// Whether coefficients about a spin are sparse matrices by default.
    fn has_sparse_coefficients(&self) -> bool {
        self.coordinates().len() > DENSE_COORDINATES && self.can_be_sparse()
    }

    /// Whether coefficients about a spin can be sparse: on straight paths, where only displaced coordinates recoil.
    fn can_be_sparse(&self) -> bool {
        self.paths().is_none() && self.cyclic().all(|j| self.invariants().S[j] == [0.0; 3])
    }

    /// Rows of `S` of a free body, for sparse coefficients; none where they are not needed.
    fn moments(&self, sparse: bool) -> Arc<Vec<[f64; 3]>> {
        let recoils = sparse && self.translation().is_some();
        Arc::new(if recoils { self.invariants().S.clone() } else { Vec::new() })
    }

    /// Coefficients of small motions about a steady angular velocity (rad/s) with these displacements, momenta and inertia to the second
    /// order in these. (M2), (K6)
    #[must_use]
    pub fn about_spin(&self, omega: [f64; 3], q: &[f64]) -> SpinCoefficients {
        self.straight_about(omega, q, self.has_sparse_coefficients())
    }

    /// The same with sparse matrices, however few the coordinates; none of a body on curved paths.
    #[must_use]
    pub fn sparse_about_spin(&self, omega: [f64; 3], q: &[f64]) -> Option<SpinCoefficients> {
        self.can_be_sparse().then(|| self.straight_about(omega, q, true))
    }

    fn straight_about(&self, omega: [f64; 3], q: &[f64], sparse: bool) -> SpinCoefficients {
        let elastic = self.elastic();
        let place = Place { translation: self.translation(), displaced: &|j| j < elastic, omega };
        straight(self.invariants(), &place, q, sparse).finished(&self.moments(sparse))
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
        let place = Place { translation: self.translation(), displaced: &displaced, omega };
        let whole = straight(&paths.straight, &place, &z, false).finished(&Arc::default());
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
            mass: SpinMatrix::Dense(projected(&whole.mass, slopes)),
            h: gathered(&whole.h),
            slopes: gathered(&whole.slopes),
            gyroscopic: SpinMatrix::Dense(projected(&whole.gyroscopic, slopes)),
            centrifugal: SpinMatrix::Dense(centrifugal),
        }
    }
}

/// `DᵀMD` with the derivatives `D` of all coordinates of a body on straight paths by the first, those of the last being `slopes`.
fn projected(matrix: &SpinMatrix, slopes: &DMatrix<f64>) -> Dense {
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

/// Steady rotation of coordinates of which some are displaced; the others are cyclic.
struct Place<'a> {
    /// `1/m*` of a free body.
    translation: Option<f64>,
    displaced: &'a dyn Fn(usize) -> bool,
    omega: [f64; 3],
}

/// Coefficients whose matrices are being summed.
struct Sums {
    inertia: Sym,
    mass: SpinSum,
    h: Vec<[f64; 3]>,
    slopes: Vec<[f64; 3]>,
    gyroscopic: SpinSum,
    centrifugal: SpinSum,
}

/// Coefficients on straight paths.
fn straight(invariants: &Invariants, place: &Place, z: &[f64], sparse: bool) -> Sums {
    let Invariants { J, J1, S, h, pairs, .. } = invariants;
    let Place { displaced, omega, .. } = *place;
    let count = S.len();
    let (mut inertia, mut h) = (*J, h.clone());
    let mut slopes: Vec<[f64; 3]> = J1.iter().map(|J1| times(*J1, omega)).collect();
    let (mut A, mut G) = (SpinSum::zero(count, sparse), SpinSum::zero(count, sparse));
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
    let centrifugal = centrifugal(invariants, place, sparse);
    let mut sums = Sums { inertia, mass: A, h, slopes, gyroscopic: G, centrifugal };
    sums.recoil(S, place, z);
    sums
}

/// Centrifugal stiffness on straight paths, the translation of a free body taken out.
fn centrifugal(invariants: &Invariants, place: &Place, sparse: bool) -> SpinSum {
    let Invariants { S, pairs, .. } = invariants;
    let Place { translation, displaced, omega } = *place;
    let mut N = SpinSum::zero(S.len(), sparse);
    for (j, k, pair) in pairs.iter().filter(|(j, k, _)| displaced(*j) && displaced(*k)) {
        N.add(j, k, dot(omega, times(pair.J2, omega)));
    }
    if let Some(per_mass) = translation {
        let square = dot(omega, omega);
        let load = |j: usize, k: usize| square * dot(S[j], S[k]) - dot(S[j], omega) * dot(S[k], omega);
        let own = |a: usize, b: usize| if a == b { square } else { 0.0 };
        let form = [0, 1, 2].map(|a| [0, 1, 2].map(|b| -per_mass * (own(a, b) - omega[a] * omega[b])));
        N.recoil(displaced, |j, k| -per_mass * load(j, k), form);
    }
    N
}

impl Sums {
    fn finished(self, moments: &Arc<Vec<[f64; 3]>>) -> SpinCoefficients {
        let Self { inertia, mass, h, slopes, gyroscopic, centrifugal } = self;
        SpinCoefficients {
            inertia,
            mass: mass.finished(moments),
            h,
            slopes,
            gyroscopic: gyroscopic.finished(moments),
            centrifugal: centrifugal.finished(moments),
        }
    }

    /// Takes the translation of a free body out. (S6)
    fn recoil(&mut self, S: &[[f64; 3]], place: &Place, z: &[f64]) {
        let Place { translation: Some(per_mass), displaced, omega } = *place else { return };
        let moved = (0..S.len()).filter(|j| displaced(*j));
        let s = moved.fold([0.0; 3], |s, j| add(s, scale(z[j], S[j])));
        self.inertia.iter_mut().zip(of_unit_mass(s)).for_each(|(J, part)| *J -= per_mass * part);
        for (j, S_j) in S.iter().enumerate().filter(|(j, _)| displaced(*j)) {
            let along = add(scale(dot(*S_j, omega), s), scale(dot(s, omega), *S_j));
            let own = scale(2.0 * dot(*S_j, s), omega);
            self.slopes[j] = add(self.slopes[j], scale(-per_mass, add(own, scale(-1.0, along))));
            self.h[j] = add(self.h[j], scale(-per_mass, cross(s, *S_j)));
        }
        let unit = |a: usize, b: usize| if a == b { -per_mass } else { 0.0 };
        let mass = |j: usize, k: usize| -per_mass * dot(S[j], S[k]);
        self.mass.recoil(|_| true, mass, [0, 1, 2].map(|a| [0, 1, 2].map(|b| unit(a, b))));
        let turning = |j: usize, k: usize| match displaced(j) {
            true => 2.0 * per_mass * dot(omega, cross(S[j], S[k])),
            false => 0.0,
        };
        let [x, y, z] = scale(2.0 * per_mass, omega);
        self.gyroscopic.recoil(|_| true, turning, [[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]]);
    }
}
