//! Springs and forces at places on appendages, springs under tension, formulas that see spin and attitude.

use nalgebra::{Matrix3, Rotation3, Vector3};
use quasirigid::dynamics::{Forced, Start};
use quasirigid::elements::{
    ApplicationPoint, Assembly, Coefficient, ElementError, End, Field, HingeCoefficient, Incomplete,
    PlaceRef, Prestress, Problem, Spring, SpringLaw,
};
use quasirigid::model::force::{Axes, Force, ForceLaw, KinematicState, MagneticField, Wave};
use quasirigid::model::{MotionState as Moving, Rheology};
use quasirigid::reduction::frequencies;
use quasirigid::verification::{VerificationPlan, verify};
use quasirigid_math::rotation::Turn;

use super::forced::formula;
use super::wobbler::{assembly, attitude};
use crate::support::parts;

type V = Vector3<f64>;

const TIP: [f64; 3] = [-1.3, 0.5, 0.4];

/// Body of the tests, with a place on its boom.
fn placed() -> Assembly {
    let mut assembly = assembly();
    assembly.hinged[0].places = vec![("root".into(), [-0.4, 0.1, 0.1]), ("tip".into(), TIP)];
    assembly
}

const ON_TIP: End = End::Hinged(PlaceRef { hinged: 0, place: 1 });

/// A force on the tip does the work of a force on a place that rotates about both axes, one inside the other: moment and generalised forces
/// are those of exact rotations, at any angle.
#[test]
fn a_place_on_an_appendage_turns_with_it() {
    let mut assembly = placed();
    let drag = ForceLaw::Expression {
        at: ApplicationPoint { on: ON_TIP, at: None },
        force: ["2*x + y*vz", "0.3*vx - y", "z*x"].map(formula),
    };
    assembly.forces = vec![Force { name: "own".into(), law: drag }];
    let (body, forces) = (assembly.body().unwrap(), assembly.forces().unwrap());
    let hinge = V::from(assembly.hinged[0].hinge);
    let axes: Vec<V> = assembly.hinged[0].axes.iter().map(|axis| V::from(*axis).normalize()).collect();
    let omega = [0.4, -0.7, 0.3];
    for size in [0.05, 0.2, 1.1, -2.7] {
        let mut q = vec![0.0; 5];
        (q[3], q[4]) = (size, -0.7 * size);
        let rate = [0.0, 0.0, 0.0, 0.9, 0.6];
        let motion = Moving { omega, q: &q, rate: &rate };
        let kinematics = KinematicState {
            t: 0.0,
            attitude: [1.0, 0.0, 0.0, 0.0],
            pole: [0.3, 1.0, -2.0],
            pole_velocity: [0.1, 0.2, 0.5],
            motion,
        };
        let loads = body.loads(&forces, &kinematics);
        let turn = |i: usize| *Rotation3::new(q[3 + i] * axes[i]).matrix();
        let arm = turn(0) * turn(1) * (V::from(TIP) - hinge);
        // the outer axis is fixed in the carrier, the inner one turns with the outer
        let slopes = [axes[0].cross(&arm), (turn(0) * axes[1]).cross(&arm)];
        let tip = body.markers().iter().find(|marker| marker.name.ends_with("tip")).unwrap();
        let moved = V::from(tip.displacement(&q)) - (hinge + arm - V::from(TIP));
        assert!(moved.norm() < 1e-15 * 8.0, "{moved}");
        let u = hinge + arm - V::from(body.pole());
        let (x, v) = (
            V::from(kinematics.pole) + u,
            V::from(kinematics.pole_velocity) + V::from(omega).cross(&u) + 0.9 * slopes[0] + 0.6 * slopes[1],
        );
        let F = V::new(2.0 * x.x + x.y * v.z, 0.3 * v.x - x.y, x.z * x.x);
        let Q = [3, 4].map(|i| loads.generalized[i] - F.dot(&slopes[i - 3]));
        let M = V::from(loads.moment) - u.cross(&F);
        let size_of_load = F.norm() * (u.norm() + arm.norm());
        println!("{size} rad: {:e} {:e} of {size_of_load}", M.norm(), Q[0].hypot(Q[1]));
        assert!(M.norm().max(Q[0].hypot(Q[1])) < 1e-14 * size_of_load, "{size}: {M} {Q:?} of {size_of_load}");
    }
}

/// A thrust that turns with its place has the direction of exact rotations at any angle, on the tip and, unturned, on the carrier; a sprung point
/// has no direction. (F22)
#[test]
fn a_thrust_turns_with_its_place() {
    let f = [0.3, -1.2, 0.7];
    let thrust = |on, at| {
        let at = ApplicationPoint { on, at };
        let law = ForceLaw::Thrust { at, force: f, axes: Axes::Place, wave: Wave::default() };
        Force { name: "thruster".into(), law }
    };
    let at_rest = [0.0; 5];
    let loads = |force: Force<ApplicationPoint>, q: &[f64]| {
        let assembly = Assembly { forces: vec![force], ..placed() };
        let (body, forces) = (assembly.body().unwrap(), assembly.forces().unwrap());
        let motion = Moving { omega: [0.4, -0.7, 0.3], q, rate: &at_rest };
        let kinematics = KinematicState {
            t: 0.0,
            attitude: attitude(),
            pole: [0.3, 1.0, -2.0],
            pole_velocity: [0.1, 0.2, 0.5],
            motion,
        };
        (body.loads(&forces, &kinematics), V::from(body.pole()))
    };
    let boom = &placed().hinged[0];
    let axes: Vec<V> = boom.axes.iter().map(|axis| V::from(*axis).normalize()).collect();
    for size in [0.05, 0.9, -2.7] {
        let q = [0.0, 0.0, 0.0, size, -0.7 * size];
        let (found, pole) = loads(thrust(ON_TIP, None), &q);
        let turn = |i: usize| *Rotation3::new(q[3 + i] * axes[i]).matrix();
        let (arm, F) =
            (turn(0) * turn(1) * (V::from(TIP) - V::from(boom.hinge)), turn(0) * turn(1) * V::from(f));
        let Q = [axes[0].cross(&arm).dot(&F), (turn(0) * axes[1]).cross(&arm).dot(&F)];
        let gap = [3, 4].map(|j| (found.generalized[j] - Q[j - 3]).abs());
        let M = V::from(found.moment) - (V::from(boom.hinge) + arm - pole).cross(&F);
        assert!(gap[0].max(gap[1]).max(M.norm()) < 1e-14 * 10.0, "{size}: {gap:?} {M}");
        assert!((V::from(found.force) - F).norm() < 1e-14, "{size}");
        assert_eq!(loads(thrust(End::Carrier, Some([0.2, 0.1, 0.0])), &q).0.force, f);
    }
    let refused = Assembly { forces: vec![thrust(End::Point(0), None)], ..placed() }.forces().unwrap_err();
    assert!(matches!(refused.problem, Problem::NoDirection { .. }), "{refused}");
}

/// Stiffness of a spring at a place about each axis: `(a × s)ᵀ k (a × s)`.
#[test]
fn a_spring_at_a_place_stiffens_the_hinge() {
    let k = [[70.0, 5.0, -3.0], [5.0, 40.0, 2.0], [-3.0, 2.0, 55.0]];
    let mut sprung = placed();
    let law = SpringLaw::Spatial { stiffness: Coefficient::Full(k), damping: Coefficient::Isotropic(0.7) };
    sprung.springs.push(parts::spring(End::Carrier, ON_TIP, law));
    let mut stiff = assembly();
    let boom = &mut stiff.hinged[0];
    let s = V::from(TIP) - V::from(boom.hinge);
    let arms: Vec<V> = boom.axes.iter().map(|axis| V::from(*axis).normalize().cross(&s)).collect();
    let form = |own: [f64; 2], k: Matrix3<f64>| {
        let entry = |i: usize, j: usize| arms[i].dot(&(k * arms[j])) + if i == j { own[i] } else { 0.0 };
        HingeCoefficient::Full(vec![vec![entry(0, 0), entry(0, 1)], vec![entry(1, 0), entry(1, 1)]])
    };
    boom.stiffness = form([14.0, 18.0], Matrix3::from(k));
    boom.damping = form([0.4, 0.3], Matrix3::identity() * 0.7);
    let (sprung, stiff) = (sprung.body().unwrap(), stiff.body().unwrap());
    for (a, b) in [(sprung.stiffness(), stiff.stiffness()), (sprung.damping(), stiff.damping())] {
        for i in 0..5 {
            let unit: Vec<f64> = (0..5).map(|j| f64::from(u8::from(i == j))).collect();
            for (x, y) in a.times(&unit).iter().zip(b.times(&unit)) {
                assert!((x - y).abs() < 1e-12 * (1.0 + y.abs()), "{x} {y}");
            }
        }
    }
    assert!(sprung.dissipators().iter().any(|part| part.name == "spring carrier-boom tip"));
}

/// Forces at a place, springs there and formulas of the spin are verified as any others.
#[test]
fn orders_are_reached_with_places_and_formulas() {
    let mut assembly = placed();
    let law = parts::axial(30.0, 0.4, Some([-0.5, 0.9, 0.2]));
    assembly.springs.push(parts::spring(ON_TIP, End::Carrier, law));
    let at = ApplicationPoint { on: ON_TIP, at: None };
    let laws = [
        ForceLaw::Drag { at, coefficient: 0.05 },
        ForceLaw::Thrust {
            at,
            force: [0.06, -0.03, 0.05],
            axes: Axes::Place,
            wave: Wave { frequency: 0.4, phase: 0.7 },
        },
        ForceLaw::Expression { at, force: ["0.1*qx*wz", "0.05*wy*qw", "-0.1*qz"].map(formula) },
        ForceLaw::TorqueExpression {
            torque: ["-0.1*wx*wz", "0.05*qy", "-0.02*wz^3"].map(formula),
            axes: Axes::Inertial,
        },
    ];
    assembly.forces = laws.into_iter().map(|law| Force { name: "own".into(), law }).collect();
    let (body, forces) = (assembly.body().unwrap(), assembly.forces().unwrap());
    let start = Start {
        omega: [0.4, 0.5, 0.7],
        attitude: attitude(),
        place: [0.3, 0.1, 0.2],
        velocity: [0.2, -0.1, 0.3],
    };
    let plan = VerificationPlan {
        orders: vec![1, 2, 3],
        rotations: 0.5,
        halvings: 4,
        samples: 20,
        ..VerificationPlan::default()
    };
    let system = Forced { body: &body, forces: &forces };
    let found = verify(system, &start, &plan, &mut |_| std::ops::ControlFlow::Continue(())).unwrap();
    for row in &found.rows {
        println!("{:?} p = {}: {:?}", row.form, row.p, row.order);
    }
    assert!(found.reached() && found.rows.len() == 6);
}

/// Formulas of a torque are the torques that have laws of their own, in either axes.
#[test]
fn formulas_of_torques_are_torques() {
    let body = assembly().body().unwrap();
    let (q, rate) = ([0.01, -0.02, 0.03, 0.1, -0.2], [0.3, 0.1, -0.2, 0.4, 0.2]);
    let omega = [0.4, -0.7, 1.3];
    let attitude = attitude();
    let motion = Moving { omega, q: &q, rate: &rate };
    let kinematics =
        KinematicState { t: 0.7, attitude, pole: [0.3, 1.0, -2.0], pole_velocity: [0.1, 0.2, 0.5], motion };
    let moment = |law| body.loads(&[Force { name: "own".into(), law }], &kinematics).moment;
    let own =
        |torque: [&str; 3], axes| moment(ForceLaw::TorqueExpression { torque: torque.map(formula), axes });
    let near = |a: [f64; 3], b: [f64; 3]| {
        let gap = (V::from(a) - V::from(b)).norm();
        assert!(gap < 1e-14 * V::from(b).norm().max(1.0), "{a:?} {b:?}");
    };
    near(own(["-0.3*wx", "-0.3*wy", "-0.3*wz"], Axes::Body), moment(ForceLaw::SpinDrag { coefficient: 0.3 }));
    let wave = Wave { frequency: 2.0, phase: 0.4 };
    let torque = [0.5, -0.4, 0.3];
    for axes in [Axes::Body, Axes::Inertial] {
        let texts = ["0.5*cos(2*t+0.4)", "-0.4*cos(2*t+0.4)", "0.3*cos(2*t+0.4)"];
        near(own(texts, axes), moment(ForceLaw::Torque { torque, axes, wave }));
    }
    // dipole along z in a field along the inertial x: the first row of the rotation matrix is the field in body axes
    let field = ["1 - 2*(qy^2 + qz^2)", "2*(qx*qy - qw*qz)"];
    let dipole =
        ForceLaw::MagneticDipole { moment: [0.0, 0.0, 1.0], field: MagneticField::Uniform([1.0, 0.0, 0.0]) };
    near(own([&format!("-({})", field[1]), field[0], "0"], Axes::Body), moment(dipole));
    let place = own(["x", "vy", "0"], Axes::Inertial);
    near(place, Turn::of(attitude).to_body([0.3, 0.2, 0.0]));
}

/// Bead in the middle of a string of half length `L` and tension `T`: stiffness `2T/L` across, `2k` along; the carrier is heavy.
fn string(prestress: Prestress) -> Assembly {
    let mut assembly = assembly();
    let carrier = assembly.carrier.as_mut().unwrap();
    carrier.mass = 1e9;
    carrier.inertia = parts::diag([1e9, 1e9, 1e9]);
    assembly.hinged.clear();
    let middle = V::new(0.4, -0.2, 0.3);
    let along = 0.5 * V::new(2.0, -1.0, 0.5).normalize();
    assembly.points = vec![parts::free_point("bead", 0.2, middle.into())];
    let half = |end: V| Spring {
        name: String::new(),
        from: End::Point(0),
        to: End::Carrier,
        law: SpringLaw::Axial { stiffness: 2000.0, damping: 0.0, anchor: Some(end.into()), prestress },
        rheology: Rheology::KelvinVoigt { time: 0.01 },
    };
    assembly.springs = vec![half(middle + along), half(middle - along)];
    assembly
}

#[test]
fn a_string_resists_across_with_its_tension_over_its_length() {
    for prestress in [Prestress::Tension(300.0), Prestress::NaturalLength(0.35)] {
        let body = string(prestress).body().unwrap();
        let found = frequencies(&body).unwrap();
        let (across, along) = ((2.0 * 300.0 / 0.5 / 0.2_f64).sqrt(), (2.0 * 2000.0 / 0.2_f64).sqrt());
        for (found, expected) in found.iter().zip([across, across, along]) {
            assert!((found / expected - 1.0).abs() < 1e-6, "{found} {expected}");
        }
        // the tension dissipates nothing: across there is no damping
        let n = V::new(2.0, -1.0, 0.5).normalize();
        let lost: f64 =
            body.damping().times(&[n.x, n.y, n.z]).iter().zip([n.x, n.y, n.z]).map(|(a, b)| a * b).sum();
        let trace: f64 =
            (0..3).map(|i| body.damping().times(&[0, 1, 2].map(|j| f64::from(u8::from(i == j))))[i]).sum();
        assert!((lost - 40.0).abs() < 1e-9 && (trace - 40.0).abs() < 1e-9, "{lost} {trace}");
    }
    assert!(string(Prestress::Relaxed).body().is_err(), "a slack string is a mechanism");
    assert!(string(Prestress::Tension(-300.0)).body().is_err(), "and under pressure it buckles");
}

/// Energy of cables from tips that rotate exactly, differenced twice: the stiffness of a mast on two cables under tension, in the angles of
/// its hinge, to the curvature of its path.
#[test]
fn tension_stiffens_along_curved_paths() {
    let mut assembly = placed();
    let (tip, tension, k) = (V::from(TIP), 40.0, 90.0);
    let anchors = [tip + V::new(0.3, 0.5, -0.4), tip - V::new(0.3, 0.5, -0.4)];
    for anchor in anchors {
        let law = SpringLaw::Axial {
            stiffness: k,
            damping: 0.0,
            anchor: Some(anchor.into()),
            prestress: Prestress::Tension(tension),
        };
        assembly.springs.push(parts::spring(ON_TIP, End::Carrier, law));
    }
    let boom = assembly.hinged[0].clone();
    let axes: Vec<V> = boom.axes.iter().map(|axis| V::from(*axis).normalize()).collect();
    let hinge = V::from(boom.hinge);
    let energy = |q: [f64; 2]| -> f64 {
        let turn = |i: usize| *Rotation3::new(q[i] * axes[i]).matrix();
        let now = hinge + turn(0) * turn(1) * (tip - hinge);
        let cable = |anchor: &V| {
            let (rest, length) = ((anchor - tip).norm(), (anchor - now).norm());
            0.5 * k * (length - (rest - tension / k)).powi(2)
        };
        anchors.iter().map(cable).sum::<f64>() + 0.5 * (14.0 * q[0] * q[0] + 18.0 * q[1] * q[1])
    };
    let h = 1e-3;
    let body = assembly.body().unwrap();
    for i in 0..2 {
        let mut unit = vec![0.0; 5];
        unit[3 + i] = 1.0;
        let row = body.stiffness().times(&unit);
        for j in 0..2 {
            let at = |a: f64, b: f64| {
                let mut q = [0.0; 2];
                q[i] += a * h;
                q[j] += b * h;
                energy(q)
            };
            let expected = (at(1.0, 1.0) - at(1.0, -1.0) - at(-1.0, 1.0) + at(-1.0, -1.0)) / (4.0 * h * h);
            assert!((row[3 + j] - expected).abs() < 1e-4 * 100.0, "{i} {j}: {} {expected}", row[3 + j]);
        }
    }
}

#[test]
fn tensions_that_do_not_balance_are_refused() {
    let mut assembly = string(Prestress::Tension(300.0));
    if let SpringLaw::Axial { prestress, .. } = &mut assembly.springs[1].law {
        *prestress = Prestress::Tension(299.0);
    }
    let ElementError { field, problem, .. } = assembly.body().unwrap_err();
    assert_eq!(field, Field::TENSION);
    assert!(matches!(problem, Problem::Unbalanced { .. }), "{problem}");
}

#[test]
fn what_is_incomplete_is_known() {
    let mut assembly = placed();
    assert_eq!(assembly.incomplete_at(5), []);
    assert_eq!(assembly.incomplete_at(6), [Incomplete::Hinges]);
    let law = parts::isotropic(1.0, 0.0);
    assembly.springs.push(parts::spring(ON_TIP, End::Carrier, law));
    assert_eq!(assembly.incomplete_at(3), []);
    assert_eq!(assembly.incomplete_at(4), [Incomplete::SpringsOnAppendages]);
    assert_eq!(string(Prestress::Tension(1.0)).incomplete_at(4), [Incomplete::AxialSprings]);
}
