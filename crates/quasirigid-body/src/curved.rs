//! Full equations along curved paths: momenta, velocities and loads with the fields of the paths as extra coordinates.
//! The body on straight paths has more coordinates, the last of which follow the others; the mass matrix then changes with `q` and is
//! factored at each displacement. Of driven coordinates the rates are given, and the momenta follow.
//! Equations (K12) and (K13), docs/theory/12-structures.md; (I12), docs/theory/02-invariants.md; (S6), docs/theory/01-system.md; (T8),
//! docs/theory/08-full-system.md.

use nalgebra::{Cholesky, DMatrix, DVectorViewMut, Dyn};

use super::paths::Amplitudes;
use super::{CurvedPaths, FlexibleBody, Invariants, MotionState};
use crate::math::sym3::{Sym, of_unit_mass, products, times};
use crate::math::vec3::{add, cross, dot, scale};

/// Full equations along curved paths: those of the body on straight paths, whose last coordinates follow the others. (K12), (K13)
#[derive(Clone, Debug)]
pub(super) struct CurvedKinetics<'a> {
    body: &'a FlexibleBody,
    paths: &'a CurvedPaths,
    /// Invariants of pairs, row by row over all coordinates of the body on straight paths; the first are symmetric in the pair.
    second: Vec<Sym>,
    turning: Vec<[f64; 3]>,
    mass: DMatrix<f64>,
    /// Values and rates of all coordinates; values of cyclic ones are zero.
    z: Vec<f64>,
    z_rate: Vec<f64>,
    /// Amplitudes of the fields and their derivatives.
    fields: Amplitudes,
    /// `h(z)` of all coordinates, and `½∂J/∂z` of the body without recoil in translation.
    h: Vec<[f64; 3]>,
    grown: Vec<Sym>,
    spin: [f64; 3],
    /// Rate of the first moment of the displacement, `ṡ`, and its inertial rate, `ṡ + ω × s`.
    drift: [f64; 3],
    u: [f64; 3],
    placed: Option<Placed>,
    /// Coordinates that move by their momenta, and those that are driven, with the rates of these. (T8)
    free: Vec<usize>,
    driven: Vec<usize>,
    driving: Vec<f64>,
    /// Momenta of the free coordinates beyond those that the drives give them.
    own: Vec<f64>,
}

/// Factors that depend on the displacements alone, kept because a Jacobian by differences evaluates many momenta at the same
/// displacements.
#[derive(Clone, Debug)]
struct Placed {
    q: Vec<f64>,
    /// First moment of the displacement.
    s: [f64; 3],
    /// Mass matrix of the free coordinates, and its columns of the driven ones.
    mass: Option<Cholesky<f64, Dyn>>,
    beside: DMatrix<f64>,
    /// `h_j`, and `M⁻¹h`, a row for each free coordinate.
    h: DMatrix<f64>,
    turned: DMatrix<f64>,
    /// `(J − hᵀM⁻¹h)⁻¹`.
    inverse: Sym,
}

impl<'a> CurvedKinetics<'a> {
    /// Prepares the body.
    pub fn new(body: &'a FlexibleBody, paths: &'a CurvedPaths) -> Self {
        let Invariants { S, pairs, .. } = &paths.straight;
        let (all, n) = (S.len(), body.coordinates().len());
        let driven: Vec<usize> = body.drives().iter().map(|drive| drive.coordinate).collect();
        let free: Vec<usize> = (0..n).filter(|j| !driven.contains(j)).collect();
        let mut curved = Self {
            body,
            paths,
            second: vec![[0.0; 6]; all * all],
            turning: vec![[0.0; 3]; all * all],
            mass: DMatrix::zeros(all, all),
            z: vec![0.0; all],
            z_rate: vec![0.0; all],
            fields: paths.amplitudes(&vec![0.0; n]),
            h: vec![[0.0; 3]; all],
            grown: vec![[0.0; 6]; all],
            spin: [0.0; 3],
            drift: [0.0; 3],
            u: [0.0; 3],
            placed: None,
            own: vec![0.0; free.len()],
            free,
            driving: vec![0.0; driven.len()],
            driven,
        };
        for (j, k, pair) in pairs.iter() {
            curved.second[j * all + k] = pair.J2;
            curved.turning[j * all + k] = pair.Z;
            curved.mass[(j, k)] = pair.A;
        }
        curved
    }

    /// Sets the displacements and the fields that follow them; returns the inertia tensor there and the first moment of the displacement.
    fn displace(&mut self, q: &[f64]) -> (Sym, [f64; 3]) {
        let (n, elastic) = (q.len(), self.body.elastic());
        self.z[..elastic].copy_from_slice(&q[..elastic]);
        self.paths.follow(q, &mut self.fields);
        self.z[n..].copy_from_slice(&self.fields.y);
        self.straight()
    }

    /// Returns `J(z)` and the first moment of the displacement; stores `h(z)` and `½∂J/∂z`.
    fn straight(&mut self) -> (Sym, [f64; 3]) {
        let Invariants { J, J1, S, h, .. } = &self.paths.straight;
        let all = self.z.len();
        let (mut J, mut s) = (*J, [0.0; 3]);
        self.h.copy_from_slice(h);
        self.grown.fill([0.0; 6]);
        for (k, zk) in self.z.iter().enumerate() {
            s = add(s, scale(*zk, S[k]));
            let row = k * all..(k + 1) * all;
            add_scaled(self.grown.as_flattened_mut(), *zk, self.second[row.clone()].as_flattened());
            add_scaled(self.h.as_flattened_mut(), *zk, self.turning[row].as_flattened());
        }
        for ((zj, J1), grown) in self.z.iter().zip(J1).zip(&mut self.grown) {
            for ((J, J1), grown) in J.iter_mut().zip(J1).zip(grown) {
                *J += zj * (J1 + *grown);
                *grown += 0.5 * J1;
            }
        }
        let Some(per_mass) = self.body.translation() else { return (J, [0.0; 3]) };
        J.iter_mut().zip(of_unit_mass(s)).for_each(|(J, part)| *J -= per_mass * part);
        for (h, S) in self.h.iter_mut().zip(S) {
            *h = add(*h, scale(-per_mass, cross(s, *S)));
        }
        (J, s)
    }

    /// Vector of a coordinate with those of the fields that follow the coordinate.
    fn gathered(&self, vectors: &[[f64; 3]], j: usize) -> [f64; 3] {
        let n = self.body.coordinates().len();
        let fields = vectors[n..].iter().enumerate();
        fields.fold(vectors[j], |sum, (e, vector)| add(sum, scale(self.fields.slopes[(e, j)], *vector)))
    }

    /// Mass matrix of the coordinates at the displacements set, the translation of a free body eliminated. (K13)
    fn mass(&self) -> DMatrix<f64> {
        let n = self.body.coordinates().len();
        let fields = self.paths.fields();
        let own = self.mass.view((0, 0), (n, n));
        let cross = self.mass.view((n, 0), (fields, n));
        let inner = self.mass.view((n, n), (fields, fields));
        let slopes = &self.fields.slopes;
        let mixed = slopes.transpose() * (0.5 * inner * slopes + cross);
        let mut mass = own + &mixed + mixed.transpose();
        if let Some(per_mass) = self.body.translation() {
            let S: Vec<[f64; 3]> = (0..n).map(|j| self.gathered(&self.paths.straight.S, j)).collect();
            for (j, S_j) in S.iter().enumerate() {
                for (k, S_k) in S.iter().enumerate() {
                    mass[(j, k)] -= per_mass * dot(*S_j, *S_k);
                }
            }
        }
        mass
    }

    /// Sets the velocities of a motion whose displacements have been set.
    fn move_on(&mut self, omega: [f64; 3], rate: &[f64], s: [f64; 3]) {
        let n = rate.len();
        self.z_rate[..n].copy_from_slice(rate);
        for e in 0..self.paths.fields() {
            self.z_rate[n + e] =
                self.fields.slopes.row(e).iter().zip(rate).map(|(slope, rate)| slope * rate).sum();
        }
        let S = &self.paths.straight.S;
        self.spin = omega;
        (self.drift, self.u) = ([0.0; 3], [0.0; 3]);
        if self.body.translation().is_some() {
            self.drift =
                S.iter().zip(&self.z_rate).fold([0.0; 3], |sum, (S, rate)| add(sum, scale(*rate, *S)));
            self.u = add(self.drift, cross(omega, s));
        }
    }

    /// Sets displacements, unless they are those set last.
    fn place(&mut self, q: &[f64]) -> Placed {
        if let Some(placed) = self.placed.take_if(|placed| placed.q == q) {
            return placed;
        }
        let (J, s) = self.displace(q);
        let n = self.free.len();
        let h = DMatrix::from_row_iterator(n, 3, self.free.iter().flat_map(|j| self.gathered(&self.h, *j)));
        let all = self.mass();
        let (own, beside) = match self.driven.is_empty() {
            true => (all, DMatrix::zeros(n, 0)),
            false => {
                let rows = all.select_rows(&self.free);
                (rows.select_columns(&self.free), rows.select_columns(&self.driven))
            }
        };
        let mass = Cholesky::<f64, Dyn>::new(own);
        let turned =
            mass.as_ref().map_or_else(|| DMatrix::from_element(n, 3, f64::NAN), |factor| factor.solve(&h));
        let schur = h.transpose() * &turned;
        let at = |i: usize, j: usize| 0.5 * (schur[(i, j)] + schur[(j, i)]);
        let entries = [at(0, 0), at(1, 1), at(2, 2), at(1, 2), at(2, 0), at(0, 1)];
        let inverse = crate::math::sym3::inverse(std::array::from_fn(|i| J[i] - entries[i]));
        Placed { q: q.to_vec(), s, mass, beside, h, turned, inverse }
    }

    /// Sets the rates of the driven coordinates, in the order of the drives. (T8)
    pub fn drive(&mut self, rates: impl Iterator<Item = f64>) {
        self.driving.iter_mut().zip(rates).for_each(|(own, rate)| *own = rate);
    }

    /// Angular velocity at these momenta, of which those of driven coordinates do not count; writes the rates of the coordinates. (T8)
    pub fn velocities(&mut self, K: [f64; 3], p: &[f64], q: &[f64], rate: &mut [f64]) -> [f64; 3] {
        let placed = self.place(q);
        let K = self.undriven(&placed, K, p);
        let rows = placed.turned.row_iter().zip(&self.own);
        let load = rows.fold(K, |load, (turned, p)| add(load, scale(-p, [turned[0], turned[1], turned[2]])));
        let omega = times(placed.inverse, load);
        let turning = placed.h.row_iter().map(|h| dot([h[0], h[1], h[2]], omega));
        self.own.iter_mut().zip(turning).for_each(|(p, turning)| *p -= turning);
        match &placed.mass {
            Some(factor) => {
                let free = self.free.len();
                factor.solve_mut(&mut DVectorViewMut::from_slice(&mut self.own, free));
            }
            None => self.own.fill(f64::NAN),
        }
        self.free.iter().zip(&self.own).for_each(|(j, own)| rate[*j] = *own);
        self.driven.iter().zip(&self.driving).for_each(|(j, driving)| rate[*j] = *driving);
        self.move_on(omega, rate, placed.s);
        self.placed = Some(placed);
        omega
    }

    /// Angular momentum without that of the drives, which is returned, and momenta of the free coordinates without theirs. (T8)
    fn undriven(&mut self, placed: &Placed, K: [f64; 3], p: &[f64]) -> [f64; 3] {
        self.own.iter_mut().zip(&self.free).for_each(|(own, j)| *own = p[*j]);
        for (column, driving) in placed.beside.column_iter().zip(&self.driving) {
            add_scaled(&mut self.own, -driving, column.as_slice());
        }
        let drives = self.driven.iter().zip(&self.driving);
        drives.fold(K, |K, (j, driving)| add(K, scale(-driving, self.gathered(&self.h, *j))))
    }

    /// Momentum of a coordinate in the motion set last. (K13)
    pub fn momentum_of(&self, j: usize) -> f64 {
        let n = self.body.coordinates().len();
        let fields = (0..self.paths.fields()).map(|e| self.momentum(n + e) * self.fields.slopes[(e, j)]);
        self.momentum(j) + fields.sum::<f64>()
    }

    /// Adds the centrifugal and Coriolis loads of the motion set last to `sum`. (K13)
    pub fn add_loads(&self, sum: &mut [f64]) {
        let n = self.body.coordinates().len();
        let all = self.z.len();
        let S = &self.paths.straight.S;
        let per_mass = self.body.translation().unwrap_or(0.0);
        let [xx, yy, zz, yz, zx, xy] = products(self.spin);
        let square = [xx, yy, zz, 2.0 * yz, 2.0 * zx, 2.0 * xy];
        let recoil = scale(per_mass, cross(self.u, self.spin));
        let load = |i: usize| {
            let centrifugal: f64 =
                self.grown[i].iter().zip(square).map(|(grown, square)| grown * square).sum();
            let mut turning = [0.0; 3];
            for (Z, rate) in self.turning[i * all..(i + 1) * all].iter().zip(&self.z_rate) {
                turning.iter_mut().zip(Z).for_each(|(turning, Z)| *turning += rate * Z);
            }
            centrifugal + dot(self.spin, turning) - dot(S[i], recoil)
        };
        for (i, sum) in sum.iter_mut().enumerate() {
            *sum += load(i);
        }
        for (e, (coordinates, second)) in self.fields.curved.iter().enumerate() {
            let field = n + e;
            let rates = &self.z_rate[coordinates.clone()];
            let (load, momentum) = (load(field), self.momentum(field));
            for (row, rate) in second.chunks_exact(rates.len().max(1)).zip(rates) {
                add_scaled(&mut sum[coordinates.clone()], rate * momentum, row);
            }
            for at in coordinates.clone() {
                sum[at] += self.fields.slopes[(e, at)] * load;
            }
        }
    }

    /// Momentum of a coordinate of the body on straight paths.
    fn momentum(&self, i: usize) -> f64 {
        let own: f64 = self.mass.column(i).iter().zip(&self.z_rate).map(|(mass, rate)| mass * rate).sum();
        let per_mass = self.body.translation().unwrap_or(0.0);
        own + dot(self.h[i], self.spin) - per_mass * dot(self.paths.straight.S[i], self.drift)
    }

    /// Angular momentum about the pole without that of the wheels, and the generalised momenta of a motion.
    pub fn momenta(&mut self, MotionState { omega, q, rate }: MotionState<f64>) -> ([f64; 3], Vec<f64>) {
        self.placed = None;
        let (J, s) = self.displace(q);
        self.move_on(omega, rate, s);
        let n = q.len();
        let turning = (0..n).fold([0.0; 3], |sum, j| add(sum, scale(rate[j], self.gathered(&self.h, j))));
        let all: Vec<f64> = (0..self.z.len()).map(|i| self.momentum(i)).collect();
        let own = (0..n).map(|j| {
            let fields = all[n..].iter().enumerate();
            all[j] + fields.map(|(e, momentum)| momentum * self.fields.slopes[(e, j)]).sum::<f64>()
        });
        (add(times(J, omega), turning), own.collect())
    }
}

/// Adds so many times the entries to the sums.
fn add_scaled(sums: &mut [f64], factor: f64, entries: &[f64]) {
    sums.iter_mut().zip(entries).for_each(|(sum, entry)| *sum += factor * entry);
}
