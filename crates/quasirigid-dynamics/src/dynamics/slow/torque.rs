//! Torque and force of the elastic and dissipative parts under external forces, in the angular-velocity form of the paper.
//! Sums over points are written as invariants, first variations by series of two terms in the displacement; five terms in time reach the
//! fourth derivative of `ω`.
//! Equation (E3), docs/theory/09-forced-reduction.md; (3.1) to (3.4) of `[@chernousko1978]`.

use crate::dynamics::external::{Forced, Pose};
use crate::math::rotation::{self, Turn};
use crate::math::scalar::Smooth;
use crate::math::sym3::{inverse, times};
use crate::math::taylor::Taylor;
use crate::math::vec3::{add, cross, dot, scale};
use crate::model::force::{KinematicState, Loads};
use crate::model::{MotionState, Support};

/// Angular-velocity form of the reduced equations of a forced body, `Jω̇ + ω × Jω = M* + μ`, `m* R̈₀ = F* + φ`, at one state: paper,
/// (3.1)–(3.4). (E3)
#[derive(Clone, Debug, PartialEq)]
pub struct ForcedTorque {
    /// Moment `M*` of the forces on the frozen body about the pole (N·m), body axes.
    pub moment: [f64; 3],
    /// Torque `μ` of the elastic and dissipative parts (N·m), body axes.
    pub mu: [f64; 3],
    /// First variation `M₁* = Σ{r × F* + ρ × (∂F/∂R r + ∂F/∂Ṙ ṙ)}` of the moment with the displacements (N·m): part of `μ`.
    pub moment_variation: [f64; 3],
    /// Force `F*` on the frozen body (N), body axes.
    pub force: [f64; 3],
    /// First variation `Σ(∂F/∂R r + ∂F/∂Ṙ ṙ)` of the force (N): part of `φ`.
    pub force_variation: [f64; 3],
    /// Force `φ` of the elastic and dissipative parts (N), body axes.
    pub phi: [f64; 3],
    /// Internal coordinates.
    pub q: Vec<f64>,
    /// Rates of the internal coordinates.
    pub rate: Vec<f64>,
}

/// State of the frozen body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidState {
    /// Time (s).
    pub t: f64,
    /// Angular velocity (rad/s), body axes.
    pub omega: [f64; 3],
    /// Attitude, unit quaternion, scalar first, from body to inertial axes.
    pub attitude: [f64; 4],
    /// Place of the pole `R₀` (m), inertial axes.
    pub pole: [f64; 3],
    /// Velocity of the pole (m/s), inertial axes.
    pub pole_velocity: [f64; 3],
}

/// Terms of the series in time: the paper needs `ω` to its fourth derivative.
const TERMS: usize = 5;
type Series = Taylor<TERMS>;

/// Torque and force of the elastic and dissipative parts at a state of the frozen body; paper, (3.2), (3.4). (E3)
///
/// Order 3 is the paper's, order 2 leaves out the dashpots, order 1 the springs too.
#[must_use]
pub fn forced_torque(system: Forced, order: usize, state: &RigidState) -> ForcedTorque {
    let flow = RigidFlow::along(system, state);
    let loads = flow.elastic_loads(system);
    let weight = |kept: bool| Series::from(f64::from(u8::from(kept)));
    let springs: Vec<_> = compliant(system, &loads).iter().map(|q| weight(order > 1) * *q).collect();
    let damped: Vec<Series> = (0..springs.len())
        .map(|j| {
            let row = system.body.damping().row(j);
            row.fold(Series::from(0.0), |sum, (k, b)| sum + Taylor::from(*b) * springs[k].derivative())
        })
        .collect();
    let lag = compliant(system, &damped);
    let q: Vec<Series> =
        springs.iter().zip(lag).map(|(spring, lag)| *spring - weight(order > 2) * lag).collect();
    let (moment, force) = flow.first_variation(system, state, &q);
    let value = |v: [Series; 3]| v.map(Smooth::value);
    let (turning, recoil) = flow.momenta(system, &q);
    let carried = scale(-1.0, cross(value(first_moment(system, &q)), value(flow.acceleration)));
    ForcedTorque {
        moment: value(flow.loads.moment),
        mu: add(add(moment, scale(-1.0, value(turning))), carried),
        moment_variation: moment,
        force: value(flow.loads.force),
        force_variation: force,
        phi: add(force, scale(-1.0, value(recoil))),
        q: q.iter().map(|q| q.value()).collect(),
        rate: q.iter().map(|q| q.coefficient(1)).collect(),
    }
}

/// `C⁻¹x`.
fn compliant(system: Forced, x: &[Series]) -> Vec<Series> {
    let mut rows: Vec<f64> = x.iter().flat_map(|x| (0..TERMS).map(|term| x.coefficient(term))).collect();
    system.body.solve_stiffness(&mut rows, TERMS);
    rows.as_chunks::<TERMS>().0.iter().map(|coefficients| Taylor::new(*coefficients)).collect()
}

/// `Σ m r = q_j S_j`.
fn first_moment(system: Forced, q: &[Series]) -> [Series; 3] {
    let S = &system.body.invariants().S;
    q.iter().zip(S).fold([Series::from(0.0); 3], |s, (q, S)| add(s, scale(*q, S.map(Taylor::from))))
}

/// Inertial derivative of a vector in body axes.
fn inertial_rate(v: [Series; 3], omega: [Series; 3]) -> [Series; 3] {
    add(v.map(|v| v.derivative()), cross(omega, v))
}

/// Motion of the frozen body as series in time: paper, (2.4).
struct RigidFlow {
    omega: [Series; 3],
    loads: Loads<Series>,
    /// Acceleration of the pole of a free body (m/s²), body axes; zero where the loads have it already.
    acceleration: [Series; 3],
}

impl RigidFlow {
    fn along(system: Forced, state: &RigidState) -> Self {
        let RigidState { t, omega, attitude, pole, pole_velocity } = *state;
        let J = system.body.invariants().J;
        let still = vec![Series::from(0.0); system.body.coordinates().len()];
        let mut spin = omega.map(Series::from);
        let mut pose = Pose {
            t: Taylor::variable(t),
            attitude: attitude.map(Taylor::from),
            place: pole.map(Taylor::from),
            velocity: pole_velocity.map(Taylor::from),
        };
        let loads = |pose: &Pose<Series>, spin: [Series; 3]| {
            let motion = MotionState { omega: spin, q: &still, rate: &still };
            system.body.loads(system.forces, &kinematics(pose, motion))
        };
        for _ in 1..TERMS {
            let now = loads(&pose, spin);
            let turning = times(inverse(J), add(now.moment, cross(times(J, spin), spin)));
            let acceleration = system.acceleration(&pose, now.force);
            pose.attitude = Taylor::integrals(rotation::rate(pose.attitude, spin), attitude);
            pose.place = Taylor::integrals(pose.velocity, pole);
            pose.velocity = Taylor::integrals(acceleration, pole_velocity);
            spin = Taylor::integrals(turning, omega);
        }
        let loads = loads(&pose, spin);
        let acceleration = match system.body.support() {
            Support::Free => Turn::of(pose.attitude).to_body(system.acceleration(&pose, loads.force)),
            Support::FixedPoint { .. } | Support::Prescribed { .. } => [Series::from(0.0); 3],
        };
        Self { omega: spin, loads, acceleration }
    }

    /// `Q*_j = Σ H_ij·{F_i* − m_i[R̈₀ + ω×(ω×ρ_i) + ω̇×ρ_i]}`.
    fn elastic_loads(&self, system: Forced) -> Vec<Series> {
        let invariants = system.body.invariants();
        let turning = self.omega.map(|w| w.derivative());
        let half = Series::from(0.5);
        let load = |j: usize| {
            let centrifugal = half * dot(self.omega, times(invariants.J1[j], self.omega));
            let lag = dot(invariants.h[j].map(Taylor::from), turning)
                + dot(invariants.S[j].map(Taylor::from), self.acceleration);
            self.loads.generalized[j] + centrifugal - lag
        };
        (0..invariants.h.len()).map(load).collect()
    }

    /// First variation of the moment and the force of the external forces with the displacement and its rate.
    fn first_variation(&self, system: Forced, state: &RigidState, q: &[Series]) -> ([f64; 3], [f64; 3]) {
        let along = |slope: f64| Taylor::<2>::new([0.0, slope]);
        let displaced: Vec<_> = q.iter().map(|q| along(q.value())).collect();
        let moving: Vec<_> = q.iter().map(|q| along(q.coefficient(1))).collect();
        let pose = Pose {
            t: Taylor::from(state.t),
            attitude: state.attitude.map(Taylor::from),
            place: state.pole.map(Taylor::from),
            velocity: state.pole_velocity.map(Taylor::from),
        };
        let motion = MotionState { omega: state.omega.map(Taylor::from), q: &displaced, rate: &moving };
        let loads = system.body.loads(system.forces, &kinematics(&pose, motion));
        (loads.moment.map(|m| m.coefficient(1)), loads.force.map(|f| f.coefficient(1)))
    }

    /// Inertial rate of the angular momentum of the displacement about the pole, and second inertial derivative of the first moment.
    fn momenta(&self, system: Forced, q: &[Series]) -> ([Series; 3], [Series; 3]) {
        let invariants = system.body.invariants();
        let mut K = [Series::from(0.0); 3];
        for ((q, J1), h) in q.iter().zip(&invariants.J1).zip(&invariants.h) {
            K = add(K, scale(*q, times(*J1, self.omega)));
            K = add(K, scale(q.derivative(), h.map(Taylor::from)));
        }
        let moment = first_moment(system, q);
        let recoil = inertial_rate(inertial_rate(moment, self.omega), self.omega);
        (inertial_rate(K, self.omega), recoil)
    }
}

fn kinematics<'a, T: Smooth>(pose: &Pose<T>, motion: MotionState<'a, T>) -> KinematicState<'a, T> {
    let Pose { t, attitude, place, velocity } = *pose;
    KinematicState { t, attitude, pole: place, pole_velocity: velocity, motion }
}
