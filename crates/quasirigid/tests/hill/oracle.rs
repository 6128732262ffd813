//! The internal motion along a polhode by numerical derivatives of the full equations, and integration over a period.

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use quasirigid::averaging::FreeRotation;
use quasirigid::model::{FlexibleBody, MotionState, Principal};
use quasirigid_math::sym3;

use crate::support::matrices::dense;

/// The full equations of the internal coordinates at a given angular momentum `K`, linear about no displacement.
pub struct Linear<'a> {
    body: &'a FlexibleBody,
    elastic: usize,
    B: DMatrix<f64>,
    C: DMatrix<f64>,
    /// Steps of displacements and of rates, so large that the full equations depart from linear by rounding alone.
    steps: [f64; 2],
}

/// Linear parts at an angular momentum: `p = p₀ + P_q q + P_v v` and `∂R/∂q = Q₀ + Q_q q + Q_v v`.
pub struct Parts {
    p: [DMatrix<f64>; 2],
    Q: [DMatrix<f64>; 2],
    zero: [DVector<f64>; 2],
}

impl Parts {
    fn weighted(terms: &[Self], weights: &[f64]) -> Self {
        let matrix = |of: &dyn Fn(&Self) -> &DMatrix<f64>| -> DMatrix<f64> {
            terms.iter().zip(weights).map(|(term, weight)| of(term) * *weight).sum()
        };
        let vector = |of: &dyn Fn(&Self) -> &DVector<f64>| -> DVector<f64> {
            terms.iter().zip(weights).map(|(term, weight)| of(term) * *weight).sum()
        };
        Self {
            p: [0, 1].map(|which| matrix(&|term| &term.p[which])),
            Q: [0, 1].map(|which| matrix(&|term| &term.Q[which])),
            zero: [0, 1].map(|which| vector(&|term| &term.zero[which])),
        }
    }
}

/// Parts at any angular momentum from ten of a size: with the angular velocity linear in `K`, momenta are linear and forces quadratic in it.
struct Quadratic {
    size: f64,
    at: Vec<Parts>,
}

impl Quadratic {
    fn new(linear: &Linear, size: f64) -> Self {
        let at = |k: [i32; 3]| linear.parts(k.map(|k| size * f64::from(k)));
        let axes = [[1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, 0, 0], [0, -1, 0], [0, 0, -1]];
        let nodes = [[0; 3]].into_iter().chain(axes).chain([[0, 1, 1], [1, 0, 1], [1, 1, 0]]);
        Self { size, at: nodes.map(at).collect() }
    }

    fn at(&self, K: [f64; 3]) -> Parts {
        let [x, y, z] = K.map(|part| part / self.size);
        let mixed = [y * z, z * x, x * y];
        let squares = x * x + y * y + z * z;
        let mut weights = vec![1.0 - squares + mixed.iter().sum::<f64>()];
        weights.extend([x, y, z].map(|k| 0.5 * (k + k * k) - k * (x + y + z - k)));
        weights.extend([x, y, z].map(|k| 0.5 * (k * k - k)));
        weights.extend(mixed);
        Parts::weighted(&self.at, &weights)
    }
}

impl<'a> Linear<'a> {
    /// `steps` in units of the coordinates and of their rates.
    pub fn new(body: &'a FlexibleBody, steps: [f64; 2]) -> Self {
        Self { body, elastic: body.elastic(), B: dense(body.damping()), C: dense(body.stiffness()), steps }
    }

    /// Bound on the frequencies (rad/s): the root of the trace of `A⁻¹C`, and of `A⁻¹B`.
    pub fn fastest(&self) -> f64 {
        let Parts { p, .. } = self.parts([0.0; 3]);
        let inverse = p[1].clone().try_inverse().unwrap();
        (&inverse * &self.C).trace().sqrt() + (inverse * &self.B).trace()
    }

    fn size(&self) -> usize {
        self.B.nrows()
    }

    /// Momenta of the coordinates and forces of the Routhian at a state.
    fn routhian(&self, K: [f64; 3], q: &[f64], rate: &[f64]) -> [DVector<f64>; 2] {
        let still = MotionState { omega: [0.0; 3], q, rate };
        let inside = Vector3::from(self.body.angular_momentum(still));
        let J = Matrix3::from(sym3::rows(self.body.inertia_at(q)));
        let omega = (J.try_inverse().unwrap() * (Vector3::from(K) - inside)).into();
        let motion = MotionState { omega, q, rate };
        [self.body.generalized_momentum(motion), self.body.load(motion)].map(DVector::from_vec)
    }

    fn parts(&self, K: [f64; 3]) -> Parts {
        let n = self.size();
        let at = |which: usize, k: usize, step: f64| {
            let mut state = [vec![0.0; n], vec![0.0; n]];
            state[which][k] = step;
            self.routhian(K, &state[0], &state[1])
        };
        let mut parts = Parts {
            p: [0, 1].map(|_| DMatrix::zeros(n, n)),
            Q: [0, 1].map(|_| DMatrix::zeros(n, n)),
            zero: at(0, 0, 0.0),
        };
        for which in 0..2 {
            let h = self.steps[which];
            for k in 0..n {
                let [far, near] = [h, 0.5 * h].map(|h| {
                    let [plus, minus] = [at(which, k, h), at(which, k, -h)];
                    [0, 1].map(|i| (&plus[i] - &minus[i]) / (2.0 * h))
                });
                let slope = |i: usize| (&near[i] * 4.0 - &far[i]) / 3.0;
                parts.p[which].set_column(k, &slope(0));
                parts.Q[which].set_column(k, &slope(1));
            }
        }
        parts
    }

    /// Rates of displacements and momenta of the coordinates, from the parts at an angular momentum: matrix, and vector.
    fn rates(&self, Parts { p, Q, zero }: Parts) -> (DMatrix<f64>, DVector<f64>) {
        let (n, elastic) = (self.size(), self.elastic);
        let by_momentum = p[1].clone().try_inverse().unwrap();
        let by_displacement = -&by_momentum * &p[0];
        let drag = &Q[1] - &self.B;
        let offset = -&by_momentum * &zero[0];
        let mut matrix = DMatrix::zeros(elastic + n, elastic + n);
        let mut vector = DVector::zeros(elastic + n);
        let forces = &Q[0] - &self.C + &drag * &by_displacement;
        let braking = &drag * &by_momentum;
        let pushes = &zero[1] + &drag * &offset;
        matrix
            .view_mut((0, 0), (elastic, elastic))
            .copy_from(&by_displacement.view((0, 0), (elastic, elastic)));
        matrix.view_mut((0, elastic), (elastic, n)).copy_from(&by_momentum.rows(0, elastic));
        matrix.view_mut((elastic, 0), (n, elastic)).copy_from(&forces.columns(0, elastic));
        matrix.view_mut((elastic, elastic), (n, n)).copy_from(&braking);
        vector.rows_mut(0, elastic).copy_from(&offset.rows(0, elastic));
        vector.rows_mut(elastic, n).copy_from(&pushes);
        (matrix, vector)
    }

    /// Rates of the coordinates at displacements and momenta of the coordinates.
    fn velocity(&self, Parts { p, zero, .. }: Parts, y: &DVector<f64>) -> DVector<f64> {
        let mut q = DVector::zeros(self.size());
        q.rows_mut(0, self.elastic).copy_from(&y.rows(0, self.elastic));
        let rest = y.rows(self.elastic, self.size()) - &zero[0] - &p[0] * q;
        p[1].clone().lu().solve(&rest).unwrap()
    }
}

/// Periodic motion, sampled over a period.
pub struct Periodic {
    pub monodromy: DMatrix<f64>,
    /// Displacements and momenta of the coordinates at equal steps.
    pub states: Vec<DVector<f64>>,
    pub rates: Vec<DVector<f64>>,
    pub power: f64,
}

/// Angular momentum in body axes along a motion.
pub fn momentum(body: &FlexibleBody, motion: &FreeRotation, t: f64) -> [f64; 3] {
    let J = body.invariants().J;
    sym3::times(J, Principal::compute(J).vector(motion.omega(t)))
}

/// The periodic motion by a Runge–Kutta method of order four in `count` double steps, with a Richardson step.
pub fn periodic(linear: &Linear, motion: &FreeRotation, count: usize) -> Periodic {
    let period = motion.polhode_period();
    let h = period / count as f64;
    let of = Quadratic::new(linear, motion.angular_momentum());
    let at = |t: f64| of.at(momentum(linear.body, motion, t));
    let nodes: Vec<_> = (0..=4 * count).map(|i| linear.rates(at(0.25 * h * i as f64))).collect();
    let size = linear.elastic + linear.size();
    // A step of the affine map on (matrix | vector).
    let step = |from: usize, stride: usize, h: f64, M: &DMatrix<f64>| {
        let f = |i: usize, M: &DMatrix<f64>| {
            let (A, b) = &nodes[i];
            let mut rate = A * M;
            let last = rate.ncols() - 1;
            let moved = rate.column(last) + b;
            rate.set_column(last, &moved);
            rate
        };
        let k1 = f(from, M);
        let k2 = f(from + stride, &(M + &k1 * (0.5 * h)));
        let k3 = f(from + stride, &(M + &k2 * (0.5 * h)));
        let k4 = f(from + 2 * stride, &(M + &k3 * h));
        M + (k1 + k2 * 2.0 + k3 * 2.0 + k4) * (h / 6.0)
    };
    let mut maps = vec![DMatrix::identity(size, size + 1)];
    for i in 0..count {
        let M = &maps[i];
        let coarse = step(4 * i, 2, h, M);
        let fine = step(4 * i + 2, 1, 0.5 * h, &step(4 * i, 1, 0.5 * h, M));
        maps.push((fine * 16.0 - coarse) / 15.0);
    }
    let last = &maps[count];
    let monodromy = last.columns(0, size).into_owned();
    let start = (DMatrix::identity(size, size) - &monodromy).lu().solve(&last.column(size)).unwrap();
    let states: Vec<DVector<f64>> =
        maps[..count].iter().map(|M| M.columns(0, size) * &start + M.column(size)).collect();
    let rates: Vec<DVector<f64>> =
        states.iter().enumerate().map(|(i, y)| linear.velocity(at(h * i as f64), y)).collect();
    let power = rates.iter().map(|v| v.dot(&(&linear.B * v))).sum::<f64>() / count as f64;
    Periodic { monodromy, states, rates, power }
}
