//! Modes of bodies under moments against the full system, an independent method. (M6)–(M8)

use nalgebra::{Complex, Matrix3, Vector3};
use proptest::prelude::*;
use quasirigid::dynamics::{Forced, FullState, Options, propagate_full};
use quasirigid::elements::{ApplicationPoint, Assembly, End, Rotor, RotorKind, Wheel, WheelSpeed};
use quasirigid::model::force::{Axes, Force, ForceLaw, Wave};
use quasirigid::model::{FlexibleBody, Marker, Support};
use quasirigid::modes::{SpinMode, SteadyModes, SteadyState, SteadyStateGuess};
use quasirigid_math::expression::Expression;
use quasirigid_math::rotation::{to_inertial, turned};
use quasirigid_math::sym3::times;
use quasirigid_math::vec3::norm;

use super::forced::formula;
use super::spin_modes::Last;
use super::steady_states::{quaternion, turned_orbit};
use crate::support::{assemblies, cases, direction, rotation};

type V = Vector3<f64>;
type C = Complex<f64>;

/// Size of the motion beside the steady state, whose square is left out.
const SMALL: f64 = 1e-5;
/// Relative difference between a small motion and its mode.
const DIFFERENCE: f64 = 1e-3;

fn complex(pair: &[f64; 2]) -> C {
    C::new(pair[0], pair[1])
}

/// Rotation that belongs to a mode: `(λ + ω×)θ = δω`.
fn turn(state: &SteadyState, mode: &SpinMode) -> Option<Vector3<C>> {
    let lambda = C::new(-mode.decay_rate, mode.frequency);
    let turning = V::from(state.omega).cross_matrix().map(C::from) + Matrix3::from_diagonal_element(lambda);
    let spin = Vector3::from(mode.omega.each_ref().map(complex));
    turning.try_inverse().map(|inverse| inverse * spin)
}

/// Largest difference between a full run from a mode and the mode itself after a radian or a decay, relative to its size.
fn difference(
    body: &FlexibleBody,
    forces: &[Force<Marker>],
    modes: &SteadyModes,
    mode: &SpinMode,
) -> Option<f64> {
    let state = &modes.state;
    let J = body.invariants().J;
    let I = (J[0] + J[1] + J[2]) / 3.0;
    let mass =
        |j: usize| body.invariants().pairs.row(j).find(|(k, _)| *k == j).map_or(0.0, |(_, pair)| pair.A);
    let lambda = C::new(-mode.decay_rate, mode.frequency);
    let rate = lambda.norm();
    let scale = |omega: [f64; 3], q: &[f64]| {
        let moved = q.iter().enumerate().map(|(j, q)| q * q * mass(j)).sum::<f64>();
        (norm(times(J, omega)).powi(2) / (I * I * rate * rate) + moved / I).sqrt()
    };
    let theta = turn(state, mode)?;
    let at = |t: f64, x: C| (x * (lambda * t).exp()).re;
    let spin = |t: f64| mode.omega.each_ref().map(|x| at(t, complex(x)));
    let shape = |t: f64| mode.shape.iter().map(|x| at(t, complex(x))).collect::<Vec<f64>>();
    let large = scale(spin(0.0), &shape(0.0)).max(theta.map(|x| x.norm()).norm());
    let factor = SMALL / large;
    let sum = |a: &[f64], b: Vec<f64>| a.iter().zip(b).map(|(a, b)| a + factor * b).collect::<Vec<f64>>();
    let leaned = theta.map(|x| factor * x.re);
    let rates = mode.shape.iter().map(|x| factor * at(0.0, lambda * complex(x))).collect();
    let attitude = turned(state.attitude, to_inertial(state.attitude, leaned.into()));
    let omega = sum(&state.omega, spin(0.0).into());
    let (place, velocity) = match body.support() {
        Support::Prescribed { velocity, position, .. } => (*position, *velocity),
        _ => ([0.0; 3], [0.0; 3]),
    };
    let q = sum(&state.q, shape(0.0));
    let start =
        FullState { omega: [omega[0], omega[1], omega[2]], attitude, q, rate: rates, place, velocity };
    // Other motions that grow must not outgrow the mode.
    let growth = modes.modes.iter().map(|mode| -mode.decay_rate).fold(0.0, f64::max);
    let t = (1.0 / rate).min(2.0 / growth);
    let mut last = Last::default();
    let options = Options { tolerance: 1e-13, ..Options::default() };
    propagate_full(Forced { body, forces }, &start, &[t], &options, &mut last).unwrap();
    let gap = [0, 1, 2].map(|i| last.omega[i] - state.omega[i] - factor * spin(t)[i]);
    let mut left: Vec<f64> = last.q.iter().zip(sum(&state.q, shape(t))).map(|(a, b)| a - b).collect();
    left[body.cyclic()].fill(0.0);
    Some(scale(gap, &left) / SMALL)
}

/// A world with a steady state: the support, the forces, and the rate at which the state is sought.
fn world(
    assembly: &Assembly,
    kind: usize,
    S: &Matrix3<f64>,
    direction: [f64; 3],
    rate: f64,
) -> (Assembly, V) {
    let up = S.column(2).into_owned();
    let named = |name: &str, law: ForceLaw<ApplicationPoint>| Force { name: name.into(), law };
    let weight = named("weight", ForceLaw::UniformGravity { acceleration: (-9.81 * up).into() });
    let at = ApplicationPoint { on: End::Carrier, at: Some(direction) };
    let tip = ApplicationPoint { on: End::Point(0), at: None };
    let body_torque = |size: f64| {
        named(
            "motor",
            ForceLaw::Torque { torque: direction.map(|x| size * x), axes: Axes::Body, wave: Wave::default() },
        )
    };
    let thrust = |size: f64, at: ApplicationPoint| {
        let force = [0.3 * size, -0.5 * size, 0.8 * size];
        named("jet", ForceLaw::Thrust { at, force, axes: Axes::Body, wave: Wave::default() })
    };
    let spin_drag = |coefficient: f64| named("air", ForceLaw::SpinDrag { coefficient });
    let drag = |at: ApplicationPoint| named("oil", ForceLaw::Drag { at, coefficient: 0.3 });
    let held = Support::FixedPoint { point: [0.3, -0.4, 0.2] };
    let orbit = named("Earth", ForceLaw::CentralGravity { orbit: turned_orbit(S, rate, 0.7).into() });
    let text = |i: usize| {
        let [x, y, z] = [up[0], up[1], up[2]];
        let along = format!("({x:e}*x + {y:e}*y + {z:e}*z)");
        format!("-4*({} - {:e}*{along}) - 0.2*v{}", ["x", "y", "z"][i], up[i], ["x", "y", "z"][i])
    };
    let spring = named("tether", ForceLaw::Expression { at, force: [0, 1, 2].map(|i| formula(&text(i))) });
    let (support, forces, rate) = match kind {
        0 => (held, vec![weight], rate),
        1 => (Support::Free, vec![orbit], rate),
        2 => (held, vec![orbit], rate),
        3 => (Support::Free, vec![body_torque(0.5), spin_drag(0.4)], rate),
        4 => (held, vec![weight, drag(tip), drag(at)], 0.0),
        5 => (held, vec![thrust(2.0, tip), spin_drag(0.5)], rate),
        6 => {
            let (out, ahead) = (S.column(0), S.column(1));
            let pull = 2.0 * rate * rate;
            let part = |i: usize| {
                let text =
                    format!("{:e}*cos({rate:e}*t) + {:e}*sin({rate:e}*t)", -pull * out[i], -pull * ahead[i]);
                Expression::parse(&text, &["t"]).unwrap()
            };
            let acceleration = [part(0), part(1), part(2)];
            let (velocity, position) = ((2.0 * rate * ahead).into(), (2.0 * out).into());
            let support = Support::Prescribed { point: [0.3, -0.4, 0.2], acceleration, velocity, position };
            (support, vec![weight, drag(at)], rate)
        }
        7 => (held, vec![weight, spring], 0.0),
        _ => (held, vec![weight, thrust(1.0, at), spin_drag(0.2)], 0.0),
    };
    (Assembly { support, forces, ..assembly.clone() }, rate * up)
}

proptest! {
    #![proptest_config(cases(72))]

    #[test]
    fn full_systems_under_forces_move_in_their_modes(
        assembly in assemblies(), kind in 0..9usize, S in rotation(), R in rotation(), direction in direction(),
        rate in 0.5..4.0f64, inside in 0..3u8
    ) {
        let mut assembly = assembly;
        if inside > 0 {
            let axis = [0.3, -0.8, 0.5];
            assembly.rotors.push(Rotor {
                name: "rotor".into(), kind: RotorKind::Flywheel { axis }, inertia: 1e-2, friction: 0.04, speed: None,
            });
        }
        if inside > 1 {
            let speed = WheelSpeed::Constant { angular_momentum: 0.3 };
            assembly.wheels.push(Wheel { name: "wheel".into(), axis: [0.2, 0.5, -0.9], speed });
        }
        let (assembly, omega_N) = world(&assembly, kind, &S, direction, rate);
        let Ok(body) = assembly.body() else { return Ok(()) };
        let forces = assembly.forces().unwrap();
        let (place, velocity) = match body.support() {
            Support::Prescribed { velocity, position, .. } => (*position, *velocity),
            _ => ([0.0; 3], [0.0; 3]),
        };
        let near = SteadyStateGuess { omega: (R.transpose() * omega_N).into(), attitude: quaternion(&R), place, velocity, asked: false };
        let state = SteadyState::near(&body, &forces, near);
        if std::env::var("STEADY").is_ok() {
            println!("{kind} {:?}", state.as_ref().map(|s| (s.omega, s.away)).map_err(ToString::to_string));
        }
        prop_assume!(state.is_ok());
        let modes = SteadyModes::about(&body, &forces, state.unwrap()).unwrap();
        for mode in &modes.modes {
            let Some(found) = difference(&body, &forces, &modes, mode) else { continue };
            prop_assert!(found < DIFFERENCE, "{kind} {}: {found:e} of {mode:?} about {:?}", mode.name, modes.state);
        }
    }
}
