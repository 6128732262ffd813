//! Inputs and outputs of linear models beyond torques and rates: hinges, accelerations of a support, liquids. (M16), (M17)

use nalgebra::{Complex, DVector, Quaternion, UnitQuaternion, Vector3};
use quasirigid::dynamics::{Forced, FullState, Options, propagate_full};
use quasirigid::elements::{Assembly, Cavity, CavityShape, HingeCoefficient, Hinged, Regime};
use quasirigid::expression::Expression;
use quasirigid::model::{Marker, Rheology, Support};
use quasirigid::modes::{LinearError, LinearInput, LinearModel, LinearOutput, SteadyState};

use super::linear::{Rows, matrix, satellite, transfer};
type V = Vector3<f64>;
type C = Complex<f64>;

const AXES: [usize; 3] = [0, 1, 2];

/// A support shaken by a constant acceleration of either sign: half the difference of two runs is the linear response.
#[test]
fn the_response_to_a_shaken_support_is_that_of_the_full_system() {
    let point = [0.4, -0.3, 0.7];
    let held = |support: Support| Assembly { support, ..satellite() }.body().unwrap();
    let body = held(Support::FixedPoint { point });
    let (a, small, end) = (V::new(0.6, -0.8, 0.5), 1e-4, 2.5);
    let run = |sign: f64| {
        let driven = held(Support::Prescribed {
            point,
            acceleration: AXES
                .map(|axis| Expression::parse(&format!("{:e}", sign * small * a[axis]), &["t"]).unwrap()),
            velocity: [0.0; 3],
            position: [0.0; 3],
        });
        let start = FullState::at_rest(&driven, [0.0; 3], [1.0, 0.0, 0.0, 0.0]);
        let options = Options { tolerance: 1e-13, ..Options::default() };
        let mut rows = Rows::default();
        propagate_full(Forced::not(&driven), &start, &[0.0, end], &options, &mut rows).unwrap();
        rows.rows.pop().unwrap()
    };
    let (up, down) = (run(1.0), run(-1.0));
    let watched = body.markers()[0].clone();
    let half = |a: V, b: V| (a - b) / (2.0 * small);
    let turn = |[w, x, y, z]: [f64; 4]| UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
    let expected = [
        half(up.0.omega.into(), down.0.omega.into()),
        (turn(down.0.attitude).inverse() * turn(up.0.attitude)).scaled_axis() / (2.0 * small),
        half(watched.displacement(&up.1).into(), watched.displacement(&down.1).into()),
    ];
    let inputs = AXES.map(|axis| LinearInput::Acceleration { axis });
    let outputs = [
        AXES.map(|axis| LinearOutput::Rate { axis }),
        AXES.map(|axis| LinearOutput::Attitude { axis }),
        AXES.map(|axis| LinearOutput::Displacement { at: watched.clone(), axis }),
    ];
    let rest = SteadyState::at_rest(&body);
    let model = LinearModel::about(&body, &[], rest, &inputs, outputs.as_flattened(), None).unwrap();
    let n = model.A.len();
    let mut whole = matrix(&model.A).resize(n + 1, n + 1, 0.0);
    let push = matrix(&model.B) * DVector::from_row_slice(a.as_slice());
    whole.view_mut((0, n), (n, 1)).copy_from(&push);
    let y = matrix(&model.C) * (whole * end).exp().column(n).rows(0, n);
    for (kind, expected) in expected.iter().enumerate() {
        let found = V::new(y[3 * kind], y[3 * kind + 1], y[3 * kind + 2]);
        let gap = (found - expected).norm() / expected.norm();
        assert!(gap < 1e-6, "{kind}: {gap:e} {found} {expected}");
    }
}

/// The pole has the acceleration of its support, any other place that and what it causes; a free body has none as input.
#[test]
fn accelerations_of_places_contain_that_of_the_support() {
    let body =
        Assembly { support: Support::FixedPoint { point: [0.4, -0.3, 0.7] }, ..satellite() }.body().unwrap();
    let pole = Marker {
        name: "pole".into(),
        position: [0.0; 3],
        shapes: Vec::new(),
        rotations: Vec::new(),
        curvature: Vec::new(),
        carried: None,
    };
    let point = body.markers()[0].clone();
    let inputs = AXES.map(|axis| LinearInput::Acceleration { axis });
    let at = |at: &Marker| AXES.map(|axis| LinearOutput::Acceleration { at: at.clone(), axis });
    let outputs = [at(&pole), at(&point)];
    let rest = || SteadyState::at_rest(&body);
    let model = LinearModel::about(&body, &[], rest(), &inputs, outputs.as_flattened(), None).unwrap();
    for (s, own) in [(0.3, 1.0), (70.0, 1.0), (1e5, 0.0)] {
        let found = transfer(&model, C::new(0.0, s));
        for (row, column) in AXES.iter().flat_map(|row| AXES.map(|column| (*row, column))) {
            let of_pole = found[(row, column)] - f64::from(u8::from(row == column));
            assert!(of_pole.norm() < 1e-11, "{s}: {of_pole}");
            // a sprung mass stays where it is when its support is shaken fast
            assert!(own == 1.0 || found[(3 + row, column)].norm() < 1e-3, "{s} {row} {column}");
        }
    }
    let free = satellite().body().unwrap();
    let state = SteadyState::at_rest(&free);
    let refused = LinearModel::about(&free, &[], state, &inputs, outputs.as_flattened(), None);
    assert_eq!(refused.unwrap_err(), LinearError::Free);
}

/// A motor in a hinge adds no angular momentum to the body, and turns the hinge by its torque over the stiffness in the end.
#[test]
fn a_motor_of_a_hinge_turns_it_and_not_the_whole() {
    let boom = Hinged {
        name: "boom".into(),
        mass: 3.0,
        center_of_mass: [1.4, 0.3, 0.2],
        inertia: [[0.3, 0.0, 0.0], [0.0, 0.9, 0.05], [0.0, 0.05, 0.8]],
        hinge: [0.5, 0.2, 0.1],
        axes: vec![[0.0, 0.2, 1.0], [0.0, 1.0, -0.2]],
        stiffness: HingeCoefficient::PerAxis(vec![14.0, 22.0]),
        damping: HingeCoefficient::PerAxis(vec![0.6, 0.4]),
        rheology: Rheology::Elastic,
        places: Vec::new(),
        angle: None,
    };
    let body = Assembly { hinged: vec![boom], ..satellite() }.body().unwrap();
    let axis = |number: usize| {
        let name = format!("about axis {number}");
        body.coordinates().iter().position(|coordinate| coordinate.name.ends_with(&name)).unwrap()
    };
    let (first, second) = (axis(1), axis(2));
    let inputs = [first, second].map(|coordinate| LinearInput::Motor { coordinate });
    let outputs = [
        &AXES.map(|axis| LinearOutput::Momentum { axis })[..],
        &[first, second].map(|coordinate| LinearOutput::Coordinate { coordinate }),
        &[first, second].map(|coordinate| LinearOutput::Speed { coordinate }),
    ];
    let rest = SteadyState::at_rest(&body);
    let model = LinearModel::about(&body, &[], rest, &inputs, &outputs.concat(), None).unwrap();
    for s in [C::new(0.0, 1e-4), C::new(0.0, 2.7), C::new(0.1, 40.0)] {
        let found = transfer(&model, s);
        for column in 0..2 {
            let whole = found.view((0, column), (3, 1)).norm();
            // an external torque of the same size gives 1/|s|
            assert!(whole < 1e-11 / s.norm(), "{s}: {whole:e}");
            for row in 0..2 {
                let rate = found[(3 + row, column)] * s;
                assert!((rate - found[(5 + row, column)]).norm() < 1e-10 * found.norm());
            }
        }
        if s.im < 1e-3 {
            let gap =
                [(3, 0, 14.0), (4, 1, 22.0)].map(|(row, column, k)| (found[(row, column)] * k - 1.0).norm());
            assert!(gap.iter().all(|gap| *gap < 1e-5), "{gap:?}");
        }
    }
}

/// At rest a torque turns the liquid of a ring and the rest: what the rest has of the angular momentum, the liquid has not.
#[test]
fn the_momentum_of_a_liquid_is_what_the_rest_has_not() {
    let ring = Cavity {
        name: "ring".into(),
        shape: CavityShape::Ring { radius: 0.4, tube_radius: 0.03 },
        center: [0.1, -0.2, 0.3],
        attitude: [1.0, 0.0, 0.0, 0.0],
        density: 900.0,
        viscosity: 4e-4,
        resolution: 8,
        regime: Regime::Viscous,
        modes: 2,
    };
    let body = Assembly { cavities: vec![ring], ..satellite() }.body().unwrap();
    let liquid =
        (0..body.coordinates().len()).filter(|j| body.coordinates()[*j].part() == "ring").collect::<Vec<_>>();
    let coordinates = liquid[0]..liquid[liquid.len() - 1] + 1;
    let output = |axis| LinearOutput::Internal { coordinates: coordinates.clone(), axis };
    let outputs = [AXES.map(output), AXES.map(|axis| LinearOutput::Rate { axis })];
    let inputs = [LinearInput::Torque { axis: 2 }];
    let rest = SteadyState::at_rest(&body);
    let model = LinearModel::about(&body, &[], rest, &inputs, outputs.as_flattened(), None).unwrap();
    // fast, the liquid stays behind: about its axis its momentum relative to the hub is minus that of turning with it
    let found = transfer(&model, C::new(0.0, 1e3));
    let inertia = 900.0 * std::f64::consts::PI * 0.03_f64.powi(2) * 2.0 * std::f64::consts::PI * 0.4 * 0.16;
    let behind = -found[(2, 0)] / found[(5, 0)] / inertia;
    assert!((behind.re - 1.0).abs() < 0.35 && behind.im.abs() < 0.35, "{behind}");
    // slow, it goes along
    let slow = transfer(&model, C::new(0.0, 1e-6));
    assert!((slow[(2, 0)] / slow[(5, 0)]).norm() < 1e-3 * inertia, "{}", slow[(2, 0)] / slow[(5, 0)]);
}
