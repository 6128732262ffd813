//! Truncated linear models: bounds against dense grids of true errors, and what axes and units cannot change. (M22), (M23)

use nalgebra::{Complex, DMatrix, Rotation3, Vector3};
use quasirigid::elements::Assembly;
use quasirigid::modes::{
    LinearInput, LinearModel, LinearOutput, RelativeEquilibrium, SpinMagnitude, SteadyState,
    TruncatedLinearModel, TruncationMethod,
};

use super::linear::transfer;
use crate::support::{parts, rotors, sprung_body};

type V = Vector3<f64>;

/// Numbers from −1 to 1, the same in each run.
struct Draws(u64);

impl Draws {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn vector(&mut self) -> V {
        V::new(self.next(), self.next(), self.next())
    }
}

/// Hub with damped points on isotropic springs and a rotor with friction, in turned axes and units of mass and length.
fn drawn(seed: u64, turn: &Rotation3<f64>, [mass, length]: [f64; 2]) -> Assembly {
    let mut draws = Draws(seed);
    let place = |at: V| -> [f64; 3] { (turn * at * length).into() };
    let J = V::new(9.0, 12.0, 15.0) + draws.vector();
    let J = turn.matrix()
        * nalgebra::Matrix3::from_diagonal(&J)
        * turn.matrix().transpose()
        * mass
        * length
        * length;
    let hub = parts::carrier(
        40.0 * mass,
        place(0.1 * draws.vector()),
        std::array::from_fn(|i| std::array::from_fn(|k| J[(i, k)])),
    );
    let points: Vec<_> = (0..3)
        .map(|_| {
            let (m, at) = (1.0 + 0.4 * draws.next(), draws.vector());
            let frequency = 10f64.powf(0.5 + 0.8 * draws.next());
            let (k, c) = (m * frequency * frequency, 2.0 * m * frequency * (0.03 + 0.02 * draws.next()));
            parts::sprung(m * mass, place(at), [k * mass; 3], [c * mass; 3])
        })
        .collect();
    let axis = (turn * draws.vector()).into();
    Assembly {
        rotors: vec![rotors::flywheel(axis, 0.3 * mass * length * length, 0.05 * mass * length * length)],
        ..sprung_body(hub, &points)
    }
}

const AXES: [usize; 3] = [0, 1, 2];

fn model(assembly: &Assembly, rate: f64, axis: V) -> LinearModel {
    let body = assembly.body().unwrap();
    let state = if rate == 0.0 {
        SteadyState::at_rest(&body)
    } else {
        let spin = RelativeEquilibrium::near(&body, axis.into(), SpinMagnitude::Rate(rate));
        SteadyState::of_spin(&spin.unwrap())
    };
    let at = body.markers()[0].clone();
    let inputs = AXES.map(|axis| LinearInput::Torque { axis });
    let outputs = [
        AXES.map(|axis| LinearOutput::Rate { axis }),
        AXES.map(|axis| LinearOutput::Displacement { at: at.clone(), axis }),
    ];
    LinearModel::about(&body, &[], state, &inputs, outputs.as_flattened(), None).unwrap()
}

const KINDS: [&[usize]; 2] = [&[0, 0, 0], &[0, 0, 0, 1, 1, 1]];

fn gain(matrix: &DMatrix<Complex<f64>>) -> f64 {
    (matrix.adjoint() * matrix).symmetric_eigenvalues().max().max(0.0).sqrt()
}

fn scaled(matrix: DMatrix<Complex<f64>>, found: &TruncatedLinearModel) -> DMatrix<Complex<f64>> {
    let [inputs, outputs] = &found.truncation.scales;
    matrix.map_with_location(|row, column, entry| entry / (outputs[row] * inputs[column]))
}

/// Free bodies at rest and spinning, by both methods: 24 bodies, 300 frequencies each.
#[test]
fn bounds_are_never_exceeded() {
    let mut tightest: f64 = 0.0;
    for seed in 0..24 {
        let turn = Rotation3::new(Draws(seed + 100).vector());
        let rate = if seed % 2 == 0 { 0.0 } else { 0.7 };
        let whole = model(&drawn(seed, &turn, [1.0, 1.0]), rate, turn * V::z());
        for (method, states) in [
            (TruncationMethod::Balanced, 11),
            (TruncationMethod::Balanced, 16),
            (TruncationMethod::Modal, 14),
        ] {
            let found = match whole.truncated(method, states, KINDS) {
                Ok(found) => found,
                Err(error) if method == TruncationMethod::Modal => {
                    assert!(error.to_string().contains("end between modes"), "{error}");
                    whole.truncated(method, states + 1, KINDS).unwrap()
                }
                Err(error) => panic!("{seed}: {error}"),
            };
            let truncation = &found.truncation;
            assert!(
                !truncation.spoiled && truncation.found <= truncation.bound,
                "{seed} {method:?}: {truncation:?}"
            );
            let mut worst: f64 = 0.0;
            for k in 0..300 {
                let frequency = 1e-3 * 10f64.powf(f64::from(k) / 299.0 * 5.5);
                if truncation.up_to.is_some_and(|last| frequency > last) {
                    break;
                }
                let s = Complex::new(0.0, frequency);
                let (all, part) = (transfer(&whole, s), transfer(&found.model, s));
                let size = gain(&scaled(all.clone(), &found));
                worst = worst.max(gain(&scaled(all - part, &found)) - 1e-11 * size);
            }
            assert!(
                worst <= truncation.bound,
                "{seed} {method:?} {states}: {worst:e} {:e}",
                truncation.bound
            );
            tightest = tightest.max(worst / truncation.bound);
        }
    }
    assert!(tightest > 0.1, "{tightest}");
}

/// Relative Hankel singular values know no axes, no unit of mass and none of length.
#[test]
fn singular_values_do_not_know_axes_and_units() {
    for (rate, seed) in [(0.0, 3), (0.7, 5)] {
        let of = |turn: &Rotation3<f64>, units: [f64; 2]| {
            let whole = model(&drawn(seed, turn, units), rate, turn * V::z());
            whole.truncated(TruncationMethod::Balanced, 12, KINDS).unwrap().truncation
        };
        let first = of(&Rotation3::identity(), [1.0, 1.0]);
        for (turn, units) in
            [(Rotation3::new(V::new(0.4, -1.1, 0.7)), [1.0, 1.0]), (Rotation3::identity(), [1e-6, 1e3])]
        {
            let other = of(&turn, units);
            let largest = first.singular_values[0];
            assert_eq!(first.lasting, other.lasting);
            for (a, b) in first.singular_values.iter().zip(&other.singular_values) {
                assert!(
                    (a - b).abs() < 1e-9 * largest,
                    "{rate}: {:?} {:?}",
                    first.singular_values,
                    other.singular_values
                );
            }
        }
    }
}

/// A hub without damping in its springs has nothing to balance; its fast modes leave their static response.
#[test]
fn undamped_bodies_are_truncated_by_modes_alone() {
    let hub =
        parts::carrier(40.0, [0.05, -0.1, 0.2], [[9.0, 0.4, -0.2], [0.4, 13.0, 0.3], [-0.2, 0.3, 16.0]]);
    let points = [(9e4, [-0.6, -0.8, -0.2]), (50.0, [0.9, 0.1, 0.3])]
        .map(|(k, at)| parts::sprung(1.0, at, [k, 1.1 * k, 1.3 * k], [0.0; 3]));
    let whole = model(&sprung_body(hub, &points), 0.0, V::z());
    let refused = whole.truncated(TruncationMethod::Balanced, 12, KINDS).unwrap_err().to_string();
    assert!(refused.contains("18 states do not decay") && refused.contains("truncate by modes"), "{refused}");
    let found = whole.truncated(TruncationMethod::Modal, 12, KINDS).unwrap();
    assert!(found.truncation.bound < 0.02 && found.truncation.lasting == 12, "{:?}", found.truncation);
    // without its static response the fast point, whose displacement is seen, would be missed by more
    let s = Complex::new(0.0, 0.5 * found.truncation.up_to.unwrap());
    let error = |model: &LinearModel| gain(&scaled(transfer(&whole, s) - transfer(model, s), &found));
    let bare = LinearModel { D: whole.D.clone(), ..found.model.clone() };
    assert!(error(&found.model) < 0.1 * error(&bare), "{:e} {:e}", error(&found.model), error(&bare));
}
