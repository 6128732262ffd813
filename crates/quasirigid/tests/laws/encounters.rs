//! Encounters with a planet: closed impulse, plain integration, and every integrator from long before. (F4), (F23), (F25), (F26), (Z6)

use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};
use proptest::prelude::*;
use quasirigid::dynamics::{
    Forced, FullState, Method, Options, Outcome, PropagateError, Sample, SlowEquations, SlowState, Start,
    propagate_forced, propagate_full,
};
use quasirigid::elements::Assembly;
use quasirigid::model::force::{Conic, Ephemeris, Force, ForceLaw, Trajectory, Windows};
use quasirigid::model::{FlexibleBody, Marker};

use crate::support::{cases, parts, rotation, sprung_body};

type V = Vector3<f64>;
type M = Matrix3<f64>;

/// A flyby of the Earth at six radii, in its own plane.
const FLYBY: Conic = Conic {
    mu: 3.986e14,
    periapsis_distance: 3.8e7,
    eccentricity: 4.25,
    inclination: 2.84,
    raan: 2.65,
    argument_of_periapsis: 0.57,
    time_of_periapsis: 0.0,
};

const ATTITUDE: [f64; 4] = [0.7, -0.1, 0.5, 0.5];

/// Without rotation.
const STILL: SlowState =
    SlowState { angular_momentum: [0.0; 3], attitude: ATTITUDE, place: [0.0; 3], velocity: [0.0; 3] };

fn gravity(path: impl Into<Trajectory>) -> [Force<Marker>; 1] {
    [Force { name: "planet".into(), law: ForceLaw::CentralGravity { orbit: path.into() } }]
}

/// A carrier alone, its centre of mass away from the origin of the file.
fn rigid(J: M) -> FlexibleBody {
    let carrier = parts::carrier(4.0, [0.3, -0.2, 0.5], J.into());
    Assembly { carrier: Some(carrier), ..Assembly::default() }.body().unwrap()
}

/// Last state of the rigid system.
fn end_of_rigid(body: &FlexibleBody, forces: &[Force<Marker>], omega: [f64; 3], end: f64) -> Sample {
    let equations = SlowEquations::series(Forced { body, forces }, 0);
    let start = equations.state(STILL, omega).unwrap();
    let run = propagate_forced(equations, &start, &[end], &Options::default(), &mut Vec::new()).unwrap();
    assert_eq!(run.outcome, Outcome::Finished);
    run.last
}

/// Last state of the full system.
fn end_of_full(
    body: &FlexibleBody,
    forces: &[Force<Marker>],
    omega: [f64; 3],
    end: f64,
    method: Method,
) -> Result<Sample, PropagateError> {
    let start = FullState::at_rest(body, omega, ATTITUDE);
    let options = Options { method, ..Options::default() };
    let run = propagate_full(Forced { body, forces }, &start, &[end], &options, &mut Vec::new())?;
    assert_eq!(run.outcome, Outcome::Finished);
    Ok(run.last)
}

/// Inertial angular momentum of a sample.
fn inertial(sample: &Sample) -> V {
    quaternion(sample.attitude) * V::from(sample.angular_momentum)
}

fn quaternion([w, x, y, z]: [f64; 4]) -> UnitQuaternion<f64> {
    UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z))
}

/// Place, velocity, angular momentum (inertial axes) and attitude, by the classical method of Runge and Kutta: the orbit is integrated with
/// the rotation, and no equation of Kepler is solved.
#[derive(Clone, Copy)]
struct Plain {
    R: V,
    v: V,
    K: V,
    q: Quaternion<f64>,
}

impl Plain {
    fn rate(&self, mu: f64, J: &M) -> Self {
        let (r, turn) = (self.R.norm(), UnitQuaternion::new_normalize(self.q));
        let omega = J.try_inverse().unwrap() * (turn.inverse() * self.K);
        let n = turn.inverse() * self.R / r;
        let torque = 3.0 * mu / r.powi(3) * n.cross(&(J * n));
        Self {
            R: self.v,
            v: -mu / r.powi(3) * self.R,
            K: turn * torque,
            q: self.q * Quaternion::from_imag(0.5 * omega),
        }
    }

    fn moved(&self, rate: &Self, h: f64) -> Self {
        Self {
            R: self.R + h * rate.R,
            v: self.v + h * rate.v,
            K: self.K + h * rate.K,
            q: self.q + rate.q * h,
        }
    }

    fn follow(mut self, mu: f64, J: &M, end: f64, steps: usize) -> Self {
        let h = end / steps as f64;
        for _ in 0..steps {
            let k1 = self.rate(mu, J);
            let k2 = self.moved(&k1, 0.5 * h).rate(mu, J);
            let k3 = self.moved(&k2, 0.5 * h).rate(mu, J);
            let k4 = self.moved(&k3, h).rate(mu, J);
            let sixths = [(k1, 1.0), (k2, 2.0), (k3, 2.0), (k4, 1.0)];
            self = sixths.iter().fold(self, |state, (rate, weight)| state.moved(rate, h * weight / 6.0));
            self.q /= self.q.norm();
        }
        self
    }
}

/// Start of a plain integration on a conic at a true anomaly, and the time from there to the periapsis, both in closed form.
fn plain(conic: &Conic, anomaly: f64, J: &M, omega: [f64; 3]) -> (Plain, f64) {
    let Conic { mu, periapsis_distance: q, eccentricity: e, .. } = *conic;
    let [P, Q, _] = axes(conic);
    let p = q * (1.0 + e);
    let (s, c) = anomaly.sin_cos();
    let r = p / (1.0 + e * c);
    let R = r * (c * P + s * Q);
    let v = (mu / p).sqrt() * ((e + c) * Q - s * P);
    let half = (0.5 * anomaly).tan();
    let passed = if e > 1.0 {
        let a = q / (e - 1.0);
        let F = 2.0 * (((e - 1.0) / (e + 1.0)).sqrt() * half).atanh();
        (a / mu).sqrt() * a * (e * F.sinh() - F)
    } else if e < 1.0 {
        let a = q / (1.0 - e);
        let E = 2.0 * (((1.0 - e) / (e + 1.0)).sqrt() * half).atan();
        (a / mu).sqrt() * a * (E - e * E.sin())
    } else {
        0.5 * (p / mu).sqrt() * p * (half + half.powi(3) / 3.0)
    };
    let turn = quaternion(ATTITUDE);
    (Plain { R, v, K: turn * (J * V::from(omega)), q: turn.into_inner() }, -passed)
}

/// An inertia tensor with moments 2, 3 and 4, about turned axes.
fn turned(axes: &M) -> M {
    axes * M::from_diagonal(&V::new(2.0, 3.0, 4.0)) * axes.transpose()
}

proptest! {
    #![proptest_config(cases(12))]

    /// Tumbling slowly through the flyby, on orbits of every kind, about turned axes: rigid and full systems and a table of the places.
    #[test]
    fn encounters_are_those_of_a_plain_integration(
        axes in rotation(), kind in 0usize..4, x in 0.2..1.0, spin in [-1e-4..1e-4, -1e-4..1e-4, -1e-4..1e-4]
    ) {
        let eccentricity = [1.0 + 6.0 * x, 1.0, 0.3 * x + 0.6, 1.0 + 0.01 * x][kind];
        let conic = Conic { eccentricity, ..FLYBY };
        let J = turned(&axes);
        let (start, before) = plain(&conic, -1.5, &J, spin);
        let conic = Conic { time_of_periapsis: before, ..conic };
        let known = start.follow(conic.mu, &J, 2.5 * before, 20_000);
        let body = rigid(J);
        let forces = gravity(conic);
        let count = 400;
        let rows: Vec<_> = (0..=count + 1).map(|i| 2.5 * before * f64::from(i) / f64::from(count)).map(|t| (t, conic.at(t).place)).collect();
        let table = gravity(Ephemeris::new(conic.mu, &rows).unwrap());
        let ends = [
            end_of_rigid(&body, &forces, spin, 2.5 * before),
            end_of_full(&body, &forces, spin, 2.5 * before, Method::Explicit).unwrap(),
            end_of_full(&body, &forces, spin, 2.5 * before, Method::Implicit).unwrap(),
            end_of_rigid(&body, &table, spin, 2.5 * before),
        ];
        let changed = (known.K - start.K).norm();
        let expected = quaternion([known.q.w, known.q.i, known.q.j, known.q.k]);
        let energy = |K: V, q: UnitQuaternion<f64>| {
            let K = q.inverse() * K;
            0.5 * K.dot(&(J.try_inverse().unwrap() * K))
        };
        let gained = energy(known.K, expected) - energy(start.K, quaternion(ATTITUDE));
        for (index, end) in ends.iter().enumerate() {
            // Fourth order in 20 000 steps; the places of the table are good to 1e-8. It ends a row after the run.
            let allowed = if index == 3 { 1e-6 } else { 1e-9 };
            prop_assert!((inertial(end) - known.K).norm() < allowed * known.K.norm().max(changed), "{index}");
            prop_assert!(quaternion(end.attitude).angle_to(&expected) < 10.0 * allowed, "{index}");
            // the work of the field is what the body gains
            let scale = end.energy.max(gained.abs());
            prop_assert!((end.work - gained).abs() < 10.0 * allowed * scale, "{index}: {} {gained}", end.work);
            prop_assert!(end.energy_drift.abs() < 1e-9 * scale && end.dissipated == 0.0);
        }
        prop_assert!(changed > 1e-3 * known.K.norm(), "a flyby that does nothing tests nothing");
    }
}

/// A body with three equal moments feels nothing, whatever its axes.
#[test]
fn a_sphere_feels_nothing() {
    let body = rigid(M::from_diagonal_element(3.7));
    let conic = Conic { time_of_periapsis: 4e4, ..FLYBY };
    let omega = [2e-5, -1e-5, 5e-5];
    let end = end_of_rigid(&body, &gravity(conic), omega, 1e5);
    let K = quaternion(ATTITUDE) * (3.7 * V::from(omega));
    assert!((inertial(&end) - K).norm() < 1e-13 * K.norm(), "{} {K}", inertial(&end));
    assert!(end.work.abs() < 1e-14 * end.energy, "{}", end.work);
}

/// Impulse on an axisymmetric body that keeps its axis: the gradient along the orbit in closed form, of hyperbolas and the parabola. A fast
/// spin holds the axis; what is left falls with the ratio of the impulse to the angular momentum. (F25)
#[test]
fn the_impulse_on_a_steady_axis_is_the_closed_form() {
    for eccentricity in [1.0, 1.5, 4.25, 60.0] {
        let conic = Conic { eccentricity, ..FLYBY };
        let unit = conic.passing_time();
        let far = 30.0 * unit;
        let [P, _, _] = axes(&conic);
        let place = V::from(conic.at(-far).place);
        let tensor = impulse(&conic, place.angle(&P));
        let conic = Conic { time_of_periapsis: far, ..conic };
        let gap = |spin: f64| {
            let (I, C) = (2.0, 3.1);
            let a = quaternion(ATTITUDE) * V::z();
            let J = M::from_diagonal(&V::new(I, I, C));
            let end = end_of_rigid(&rigid(J), &gravity(conic), [0.0, 0.0, spin / unit], 2.0 * far);
            let found = inertial(&end) - C * spin / unit * a;
            let known = 3.0 * (C - I) * (tensor * a).cross(&a);
            (found - known).norm() / known.norm()
        };
        let gaps = [gap(30.0), gap(300.0)];
        assert!(gaps[0] < 0.1 && gaps[1] < 0.2 * gaps[0], "e = {eccentricity}: {gaps:?}");
    }
}

/// Unit vectors towards the periapsis, along the motion there, and along the angular momentum of the orbit.
fn axes(conic: &Conic) -> [V; 3] {
    let turn = nalgebra::Rotation3::from_axis_angle(&V::z_axis(), conic.raan)
        * nalgebra::Rotation3::from_axis_angle(&V::x_axis(), conic.inclination)
        * nalgebra::Rotation3::from_axis_angle(&V::z_axis(), conic.argument_of_periapsis);
    [V::x(), V::y(), V::z()].map(|axis| turn * axis)
}

/// Integral of `κ n nᵀ` along a conic between two places of this true anomaly, `(μ₀/hp) ∫(1 + e cos ν) n nᵀ dν`. (F25)
fn impulse(conic: &Conic, nu: f64) -> M {
    let Conic { mu, periapsis_distance: q, eccentricity: e, .. } = *conic;
    let p = q * (1.0 + e);
    let (s, c) = nu.sin_cos();
    let along = nu + s * c + e * (2.0 * s - 2.0 * s.powi(3) / 3.0);
    let across = nu - s * c + e * 2.0 * s.powi(3) / 3.0;
    let [P, Q, _] = axes(conic);
    mu / ((mu * p).sqrt() * p) * (along * P * P.transpose() + across * Q * Q.transpose())
}

/// Two masses on springs, far stiffer than the encounter is fast.
fn flexible() -> FlexibleBody {
    let carrier =
        parts::carrier(40.0, [0.02, 0.1, 0.4], [[9.0, 0.2, 0.0], [0.2, 13.0, -0.4], [0.0, -0.4, 16.0]]);
    let masses = [
        parts::sprung(1.2, [0.8, 0.3, 0.9], [900.0, 1000.0, 800.0], [48.0, 36.0, 40.0]),
        parts::sprung(0.9, [-0.5, -0.6, 0.7], [700.0, 800.0, 1100.0], [36.0, 40.0, 48.0]),
    ];
    sprung_body(carrier, &masses).body().unwrap()
}

/// Bodies at rest that wait a thousand times as long as the encounter lasts, in steps that would pass over it: rigid, reduced and full by
/// every method, against small steps. (Z6)
#[test]
fn no_integrator_steps_over_an_encounter() {
    let body = flexible();
    let [xx, yy, zz, yz, zx, xy] = body.invariants().J;
    let J = M::new(xx, xy, zx, xy, yy, yz, zx, yz, zz);
    let anomaly = -((5e-3 - 1.0) / FLYBY.eccentricity).acos();
    let (start, wait) = plain(&FLYBY, anomaly, &J, [0.0; 3]);
    let conic = Conic { time_of_periapsis: wait, ..FLYBY };
    let unit = conic.passing_time();
    assert!(wait > 1e3 * unit);
    let forces = gravity(conic);
    let end = wait + 10.0 * unit;
    let known = start.follow(conic.mu, &J, end, 200_000);
    let reduced = |order: usize| {
        let equations = SlowEquations::series(Forced { body: &body, forces: &forces }, order);
        let run = propagate_forced(equations, &STILL, &[end], &Options::default(), &mut Vec::new()).unwrap();
        assert_eq!(run.outcome, Outcome::Finished);
        // twelve doublings on both sides of the passage, as far as the run reaches
        assert!(run.scan.stops > 14, "{:?}", run.scan);
        run.last
    };
    let full =
        |body: &FlexibleBody, method: Method| end_of_full(body, &forces, [0.0; 3], end, method).unwrap();
    let ends = [
        end_of_rigid(&rigid(J), &forces, [0.0; 3], end),
        full(&rigid(J), Method::Explicit),
        full(&rigid(J), Method::Implicit),
        reduced(0),
        reduced(3),
        full(&body, Method::Implicit),
        full(&body, Method::Automatic),
    ];
    for (index, end) in ends.iter().enumerate() {
        // Parts on springs follow the gradient by the square of its time over that of their vibrations, below 1e-7.
        let gap = (inertial(end) - known.K).norm() / known.K.norm();
        assert!(gap < 1e-6, "{index}: {gap:e}");
    }
}

/// Full and reduced systems of a body whose parts feel the gradient, through the encounter.
#[test]
fn full_and_reduced_systems_agree_through_an_encounter() {
    let body = flexible();
    let conic = Conic { mu: 0.4, periapsis_distance: 8.0, time_of_periapsis: 60.0, ..FLYBY };
    let forces = gravity(conic);
    let system = Forced { body: &body, forces: &forces };
    let omega = [0.02, -0.03, 0.05];
    let start = Start::new(omega, ATTITUDE);
    let settled = start.settled(system, 3).unwrap();
    let run = propagate_full(system, &settled, &[200.0], &Options::default(), &mut Vec::new()).unwrap();
    let equations = SlowEquations::series(system, 3);
    let slow = equations.state(STILL, omega).unwrap();
    let reduced = propagate_forced(equations, &slow, &[200.0], &Options::default(), &mut Vec::new()).unwrap();
    let (full, reduced) = (run.last, reduced.last);
    let K = inertial(&full);
    let start = quaternion(ATTITUDE) * V::from(settled.angular_momentum(&body));
    assert!((K - start).norm() > 1e-2 * K.norm(), "a flyby that does nothing tests nothing");
    assert!(
        (inertial(&reduced) - K).norm() < 1e-7 * K.norm(),
        "{}",
        (inertial(&reduced) - K).norm() / K.norm()
    );
    assert!((full.energy - reduced.energy).abs() < 1e-7 * full.energy);
    let gained = full.energy + full.dissipated - settled.energy(&body);
    assert!((gained - full.work).abs() < 1e-10 * full.energy, "{gained} {}", full.work);
}

/// A table that ends before the run does is refused, unless the force acts within it alone.
#[test]
fn a_table_covers_the_run() {
    let body = rigid(turned(&M::identity()));
    let rows: Vec<_> = (0..100).map(|i| 1e3 * f64::from(i) - 1e4).map(|t| (t, FLYBY.at(t).place)).collect();
    let table = Ephemeris::new(FLYBY.mu, &rows).unwrap();
    let forces = gravity(table.clone());
    let refused = |end: f64, forces: &[Force<Marker>]| {
        let system = Forced { body: &body, forces };
        let slow = SlowState { angular_momentum: [0.0, 0.0, 1e-3], ..STILL };
        let equations = SlowEquations::series(system, 0);
        let reduced = propagate_forced(equations, &slow, &[end], &Options::default(), &mut Vec::new()).err();
        let full = end_of_full(&body, forces, [0.0, 0.0, 1e-3], end, Method::Automatic).err();
        assert_eq!(reduced, full);
        full
    };
    assert_eq!(refused(8.9e4, &forces), None);
    assert_eq!(
        refused(8.91e4, &forces),
        Some(PropagateError::Uncovered { from: -1e4, to: 8.9e4, end: 8.91e4 })
    );
    let windows = |to: f64| Windows::new(vec![[1e3, to]]).unwrap();
    let during = |to: f64| {
        let law = Box::new(ForceLaw::CentralGravity { orbit: table.clone().into() });
        [Force { name: "planet".into(), law: ForceLaw::During { windows: windows(to), law } }]
    };
    assert_eq!(refused(2e5, &during(8e4)), None);
    assert!(refused(2e5, &during(9e4)).is_some());
}
