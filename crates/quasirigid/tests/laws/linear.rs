//! Linear models: a closed impedance at rest, the modes of spins, and the full system pushed a little. (M16), (M17)

use nalgebra::{Complex, DMatrix, DVector, Matrix3, Quaternion, UnitQuaternion, Vector3};
use quasirigid::dynamics::{Forced, FullState, Observer, Options, Sample, propagate_full};
use quasirigid::elements::{Assembly, Cavity, CavityShape, Regime, Wheel, WheelSpeed};
use quasirigid::model::force::{Axes, Force, ForceLaw, Wave};
use quasirigid::model::{FlexibleBody, Marker, Measured, Rheology};
use quasirigid::modes::{
    LinearInput, LinearModel, LinearOutput, RelativeEquilibrium, SpinMagnitude, SpinModes, SteadyState,
};
use quasirigid_math::eigen::{Dense, eigenvalues};

use crate::support::{parts, rotors, sprung_body};

type V = Vector3<f64>;
type C = Complex<f64>;

pub(super) fn matrix(rows: &[Vec<f64>]) -> DMatrix<f64> {
    DMatrix::from_fn(rows.len(), rows.first().map_or(0, Vec::len), |i, k| rows[i][k])
}

/// Transfer matrix at a complex frequency.
pub(super) fn transfer(model: &LinearModel, s: C) -> DMatrix<C> {
    let [A, B, C_, D] = [&model.A, &model.B, &model.C, &model.D].map(|rows| matrix(rows).map(Complex::from));
    let n = A.nrows();
    let solved = (DMatrix::identity(n, n) * s - A).lu().solve(&B).unwrap();
    C_ * solved + D
}

const TORQUES: [LinearInput; 3] =
    [LinearInput::Torque { axis: 0 }, LinearInput::Torque { axis: 1 }, LinearInput::Torque { axis: 2 }];
const RATES: [LinearOutput; 3] =
    [LinearOutput::Rate { axis: 0 }, LinearOutput::Rate { axis: 1 }, LinearOutput::Rate { axis: 2 }];

/// A hub with two equal sprung points opposite each other, which no torque moves from its place.
#[test]
fn a_hub_with_two_sprung_points_has_its_closed_impedance() {
    let (center, arm, [m, k, c]) = (V::new(0.3, -0.2, 0.1), V::new(0.7, 0.5, -0.4), [1.7, 60.0, 2.5]);
    let J = [[9.0, 0.4, -0.2], [0.4, 13.0, 0.3], [-0.2, 0.3, 16.0]];
    let point = |at: V| parts::sprung(m, at.into(), [k; 3], [c; 3]);
    let hub = parts::carrier(40.0, center.into(), J);
    let body = sprung_body(hub, &[point(center + arm), point(center - arm)]).body().unwrap();
    let model = LinearModel::about(&body, &[], SteadyState::at_rest(&body), &TORQUES, &RATES, None).unwrap();
    let across = Matrix3::from_diagonal_element(arm.norm_squared()) - arm * arm.transpose();
    for s in [C::new(0.0, 0.3), C::new(0.1, 6.0), C::new(0.0, 6.2), C::new(-0.4, 90.0)] {
        let spring = k + c * s;
        let carried = spring * (2.0 * m) / (s * s * m + spring);
        let dynamic = Matrix3::from(J).transpose().map(C::from) + across.map(C::from) * carried;
        let expected = (dynamic * s).try_inverse().unwrap();
        let found = transfer(&model, s);
        let gap = (DMatrix::from_fn(3, 3, |i, k| expected[(i, k)]) - &found).norm();
        assert!(gap < 1e-12 * expected.norm(), "{s}: {gap:e}");
    }
}

/// Off-centre, damped, with a skew rotor.
pub(super) fn satellite() -> Assembly {
    let hub =
        parts::carrier(40.0, [0.05, -0.1, 0.2], [[9.0, 0.4, -0.2], [0.4, 13.0, 0.3], [-0.2, 0.3, 16.0]]);
    let masses = [
        parts::sprung(1.2, [0.9, 0.1, 0.3], [50.0, 70.0, 90.0], [0.4, 0.3, 0.2]),
        parts::sprung(0.7, [-0.6, -0.8, -0.2], [40.0, 30.0, 60.0], [0.2, 0.5, 0.3]),
    ];
    Assembly { rotors: vec![rotors::flywheel([0.2, 0.5, 0.8], 0.3, 0.05)], ..sprung_body(hub, &masses) }
}

fn spun(body: &FlexibleBody, rate: f64) -> RelativeEquilibrium {
    RelativeEquilibrium::near(body, [0.1, 0.1, 1.0], SpinMagnitude::Rate(rate)).unwrap()
}

#[test]
fn eigenvalues_are_those_of_the_modes_and_of_the_attitude() {
    let body = satellite().body().unwrap();
    for rate in [0.3, 1.6] {
        let spin = spun(&body, rate);
        let model =
            LinearModel::about(&body, &[], SteadyState::of_spin(&spin), &TORQUES, &RATES, None).unwrap();
        let mut dense = Dense::zero(model.A.len());
        for (i, row) in model.A.iter().enumerate() {
            row.iter().enumerate().for_each(|(k, entry)| dense.add(i, k, *entry));
        }
        let mut left: Vec<C> = eigenvalues(&dense).unwrap().iter().map(|[re, im]| C::new(*re, *im)).collect();
        let mut take = |expected: C| {
            let gap = |z: &C| (z - expected).norm();
            let place = (0..left.len()).min_by(|a, b| gap(&left[*a]).total_cmp(&gap(&left[*b]))).unwrap();
            let gap = gap(&left.remove(place));
            assert!(gap < 1e-12 * (1.0 + 10.0 * expected.norm()), "{expected}: {gap:e}");
        };
        let modes = SpinModes::about(&body, spin).unwrap().modes;
        for mode in &modes {
            take(C::new(-mode.decay_rate, mode.frequency));
            if mode.frequency > 0.0 {
                take(C::new(-mode.decay_rate, -mode.frequency));
            }
        }
        // the attitude, and the spin with another angular momentum
        for zero in [C::from(0.0), C::from(0.0), C::new(0.0, rate), C::new(0.0, -rate)] {
            take(zero);
        }
        assert!(left.is_empty(), "{left:?}");
    }
}

/// Rows of a run.
#[derive(Default)]
pub(super) struct Rows {
    inside: Option<(Vec<f64>, Vec<f64>)>,
    pub rows: Vec<(Sample, Vec<f64>, Vec<f64>)>,
}

impl Observer for Rows {
    fn sample(&mut self, sample: &Sample) {
        let (q, rate) = self.inside.take().unwrap();
        self.rows.push((*sample, q, rate));
    }

    fn keeps_coordinates(&self) -> bool {
        true
    }

    fn coordinates(&mut self, q: &[f64], rate: &[f64]) {
        self.inside = Some((q.to_vec(), rate.to_vec()));
    }
}

/// Inertial place of a marker.
fn place(sample: &Sample, q: &[f64], at: &Marker) -> V {
    let own = V::from(at.position) + V::from(at.displacement(q));
    V::from(sample.pole) + turn(sample) * own
}

fn turn(sample: &Sample) -> UnitQuaternion<f64> {
    let [w, x, y, z] = sample.attitude;
    UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z))
}

/// A force at a sprung point and a torque, small and of either sign: half the difference of two runs is the linear response.
#[test]
fn the_response_is_that_of_the_full_system_pushed_a_little() {
    let body = satellite().body().unwrap();
    let spin = spun(&body, 0.9);
    let pushed = body.markers()[1].clone();
    let watched = body.markers()[0].clone();
    let (force, torque) = ([0.3, -0.5, 0.8], [1.0, 0.6, -0.4]);
    let small = 2e-4;
    let end = 4.0;
    let step = 0.03;
    let times: Vec<f64> = (-3..=3).map(|k| end + step * f64::from(k)).collect();
    let times = [&[0.0], &times[..]].concat();
    let run = |sign: f64| {
        let wave = Wave { frequency: 0.0, phase: 0.0 };
        let scaled = |vector: [f64; 3]| vector.map(|entry| sign * small * entry);
        let law = ForceLaw::Thrust { at: pushed.clone(), force: scaled(force), axes: Axes::Body, wave };
        let thrust = Force { name: "thrust".into(), law };
        let law = ForceLaw::Torque { torque: scaled(torque), axes: Axes::Body, wave };
        let forces = [thrust, Force { name: "torque".into(), law }];
        let still = FullState::at_rest(&body, spin.omega, [1.0, 0.0, 0.0, 0.0]);
        let start = FullState { q: spin.q.clone(), ..still };
        let mut rows = Rows::default();
        let options = Options { tolerance: 1e-13, ..Options::default() };
        propagate_full(Forced { body: &body, forces: &forces }, &start, &times, &options, &mut rows).unwrap();
        rows.rows
    };
    let (up, down) = (run(1.0), run(-1.0));
    let half = |a: V, b: V| (a - b) / (2.0 * small);
    let (plus, minus) = (&up[4], &down[4]);
    let accelerated = |rows: &[(Sample, Vec<f64>, Vec<f64>)]| {
        let weights = [2.0, -27.0, 270.0, -490.0, 270.0, -27.0, 2.0];
        let sum: V =
            weights.iter().zip(&rows[1..]).map(|(w, (sample, q, _))| *w * place(sample, q, &watched)).sum();
        turn(&rows[4].0).inverse() * (sum / (180.0 * step * step))
    };
    let rotor = body.cyclic().start;
    let moved = |(_, q, _): &(Sample, Vec<f64>, Vec<f64>)| V::from(watched.displacement(q));
    let turned = (turn(&minus.0).inverse() * turn(&plus.0)).scaled_axis() / (2.0 * small);
    let expected = [
        half(plus.0.omega.into(), minus.0.omega.into()),
        half(plus.0.angular_momentum.into(), minus.0.angular_momentum.into()),
        half(moved(plus), moved(minus)),
        turned,
        half(accelerated(&up), accelerated(&down)),
        V::repeat((plus.2[rotor] - minus.2[rotor]) / (2.0 * small)),
    ];
    let at = |axis: usize| {
        let at = watched.clone();
        [
            LinearOutput::Rate { axis },
            LinearOutput::Momentum { axis },
            LinearOutput::Displacement { at: at.clone(), axis },
            LinearOutput::Attitude { axis },
            LinearOutput::Acceleration { at, axis },
            LinearOutput::Speed { coordinate: rotor },
        ]
    };
    let outputs: Vec<_> = (0..3).flat_map(at).collect();
    let pushes = [0, 1, 2].map(|axis| LinearInput::Force { at: pushed.clone(), axis });
    let inputs = [&pushes[..], &TORQUES].concat();
    let model = LinearModel::about(&body, &[], SteadyState::of_spin(&spin), &inputs, &outputs, None).unwrap();
    let u = DVector::from_iterator(6, force.into_iter().chain(torque));
    let n = model.A.len();
    let mut whole = DMatrix::zeros(n + 1, n + 1);
    whole.view_mut((0, 0), (n, n)).copy_from(&matrix(&model.A));
    whole.view_mut((0, n), (n, 1)).copy_from(&(matrix(&model.B) * &u));
    let x = (whole * end).exp().column(n).rows(0, n).into_owned();
    let y = matrix(&model.C) * x + matrix(&model.D) * u;
    for (kind, expected) in expected.iter().enumerate() {
        let found = V::new(y[kind], y[6 + kind], y[12 + kind]);
        let gap = (found - expected).norm() / expected.norm();
        let allowed = if kind == 4 { 5e-5 } else { 1e-6 }; // accelerations are differences of places
        assert!(gap < allowed, "{kind}: {gap:e} {found} {expected}");
    }
}

/// The hub with two sprung points again, whose springs are of a material: exact for laws that are rational, within the error told for others.
#[test]
fn materials_have_their_closed_impedance_or_tell_how_far_they_miss_it() {
    let (center, arm, [m, k]) = (V::new(0.3, -0.2, 0.1), V::new(0.7, 0.5, -0.4), [1.7, 60.0]);
    let J = [[9.0, 0.4, -0.2], [0.4, 13.0, 0.3], [-0.2, 0.3, 16.0]];
    let across = Matrix3::from_diagonal_element(arm.norm_squared()) - arm * arm.transpose();
    let table = Measured::new(vec![[0.1, 0.9, 0.05], [2.0, 1.0, 0.1], [40.0, 1.2, 0.02]]).unwrap();
    for (law, allowed) in [
        (Rheology::Maxwell { time: 0.4 }, 1e-11),
        (Rheology::StandardLinear { time: 0.3, strength: 0.7 }, 1e-11),
        (Rheology::QualityFactor { factor: 40.0 }, 0.1),
        (Rheology::Andrade { time: 20.0, creep_time: 3.0, exponent: 0.3 }, 0.1),
        // modulus and loss of the table do not belong together: no material has them
        (Rheology::Table(table), 0.4),
    ] {
        let mut assembly = sprung_body(
            parts::carrier(40.0, center.into(), J),
            &[1.0, -1.0].map(|side| parts::sprung(m, (center + side * arm).into(), [k; 3], [0.0; 3])),
        );
        assembly.springs.iter_mut().for_each(|spring| spring.rheology = law.clone());
        let body = assembly.body().unwrap();
        let rest = SteadyState::at_rest(&body);
        let model = LinearModel::about(&body, &[], rest, &TORQUES, &RATES, None).unwrap();
        let told = model.accuracy.unwrap();
        let mut worst: f64 = 0.0;
        for i in 0..60 {
            let frequency = told.band[0] * (told.band[1] / told.band[0]).powf(f64::from(i) / 59.0);
            let s = C::new(0.0, frequency);
            let [re, im] = law.modulus(frequency);
            let spring = C::new(re, im) * k;
            let carried = spring * (2.0 * m) / (s * s * m + spring);
            let dynamic = Matrix3::from(J).transpose().map(C::from) + across.map(C::from) * carried;
            let expected = (dynamic * s).try_inverse().unwrap();
            let gap = DMatrix::from_fn(3, 3, |i, k| expected[(i, k)]) - transfer(&model, s);
            worst = worst.max(gap.norm() / expected.norm());
        }
        assert!(worst < allowed && told.error < allowed, "{law:?}: {worst:e}, {:e}", told.error);
        assert!(allowed < 1e-9 || (0.3..3.0).contains(&(worst / told.error)), "{worst:e} {:e}", told.error);
        println!("{law:?}: {worst:e}, {:e}", told.error);
    }
}

/// A liquid is in the model by its coordinates; the error told is that against its impedance, and falls with their number.
#[test]
fn liquids_tell_how_far_their_coordinates_miss_them() {
    let errors = [0, 2].map(|modes| {
        let ring = Cavity {
            name: "ring".into(),
            shape: CavityShape::Ring { radius: 0.4, tube_radius: 0.006 },
            center: [0.1, -0.2, 0.3],
            attitude: [0.5, -0.5, 0.5, 0.5],
            density: 1e5,
            viscosity: 4e-6,
            resolution: 8,
            regime: Regime::Viscous,
            modes,
        };
        let body = Assembly { cavities: vec![ring], ..satellite() }.body().unwrap();
        let spin = RelativeEquilibrium::near(&body, [0.0, 0.1, 1.0], SpinMagnitude::Rate(0.2)).unwrap();
        let model = LinearModel::about(
            &body,
            &[],
            SteadyState::of_spin(&spin),
            &TORQUES,
            &RATES,
            Some([1e-3, 100.0]),
        );
        model.unwrap().accuracy.unwrap().error
    });
    assert!(errors[0] > 10.0 * errors[1] && errors[1] < 2e-3, "{errors:?}");
}

/// The motor of a momentum wheel exchanges angular momentum with the body and adds none, about rest and about a spin.
#[test]
fn a_motor_of_a_wheel_gives_the_body_what_it_takes_from_the_wheel() {
    let axis = V::new(0.2, 0.5, 0.8).normalize();
    let wheels = vec![Wheel {
        name: "w".into(),
        axis: (3.0 * axis).into(),
        speed: WheelSpeed::Constant { angular_momentum: 1.5 },
    }];
    let body = Assembly { wheels, ..satellite() }.body().unwrap();
    let inputs = [LinearInput::Torque { axis: 1 }, LinearInput::Wheel { axis: axis.into() }];
    let momentum = [0, 1, 2].map(|axis| LinearOutput::Momentum { axis });
    let outputs = [&momentum[..], &RATES, &[LinearOutput::Wheel { input: 1 }]].concat();
    for rate in [0.0, 0.7] {
        let state =
            if rate == 0.0 { SteadyState::at_rest(&body) } else { SteadyState::of_spin(&spun(&body, rate)) };
        let omega = V::from(state.omega);
        let model = LinearModel::about(&body, &[], state, &inputs, &outputs, None).unwrap();
        for s in [C::new(0.0, 0.31), C::new(0.2, 4.0), C::new(0.0, 50.0)] {
            let found = transfer(&model, s);
            let column = found.column(1).into_owned();
            let K = Vector3::new(column[0], column[1], column[2]);
            let wheel = column[6];
            assert!((wheel * s - 1.0).norm() < 1e-12, "{wheel}");
            // K̇ + ω × δK + δω × K = 0 in body axes
            let turned = Vector3::new(column[3], column[4], column[5]);
            let steady = V::from(model.equilibrium.angular_momentum).map(C::from);
            let rest = K * s + omega.map(C::from).cross(&K) + turned.cross(&steady);
            assert!(
                rest.norm() < 1e-10 * (K * s).norm().max(turned.norm() * steady.norm()).max(1e-3),
                "{rate} {s}: {rest}"
            );
            assert!(turned.norm() > 1e-4);
        }
    }
}
