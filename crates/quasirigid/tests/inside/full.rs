//! The full system against equations written for a gyrostat alone.

use nalgebra::{Matrix3, Vector3};
use quasirigid::dynamics::{Forced, FullState, Method, Options, Outcome, Sample, propagate_full};
use quasirigid::elements::{Assembly, WheelSpeed};
use quasirigid_math::expression::Expression;
use quasirigid_math::vec3::{add, norm, scale};

use super::bodies::{bare, wheel};
use super::oracle::Gyrostat;
use crate::support::rotors::{ball, flywheel};

const OMEGA: [f64; 3] = [1.2, 0.35, 0.2];
const AXIS: [f64; 3] = [0.3, 1.0, -0.5];
const END: f64 = 7.0;

fn gyrostat(wheel: fn(f64) -> Vector3<f64>) -> Gyrostat {
    let inertia = Matrix3::new(9.0, 0.2, 0.0, 0.2, 13.0, -0.4, 0.0, -0.4, 16.0);
    Gyrostat { inertia, flywheel: (Vector3::from(AXIS).normalize(), 1.1, 0.7), ball: (1.4, 2.5), wheel }
}

/// Body with a wheel about z, a flywheel and a ball started at given speeds.
fn assembly(speed: WheelSpeed) -> Assembly {
    let mut rotors = vec![flywheel(AXIS, 1.1, 0.7), ball(1.4, 2.5)];
    rotors[0].speed = Some(vec![4.0]);
    rotors[1].speed = Some(vec![-2.0, 1.5, 0.5]);
    Assembly { rotors, wheels: vec![wheel([0.0, 0.0, 2.0], speed)], ..bare() }
}

fn run(assembly: &Assembly, method: Method) -> Sample {
    let built = assembly.build().unwrap();
    let mut start = FullState::at_rest(&built.body, OMEGA, [1.0, 0.0, 0.0, 0.0]);
    built.speeds.iter().for_each(|(coordinate, speed)| start.rate[*coordinate] = *speed);
    let mut samples = Vec::new();
    let options = Options { tolerance: 1e-13, method, ..Options::default() };
    let run = propagate_full(Forced::not(&built.body), &start, &[END], &options, &mut samples).unwrap();
    assert_eq!(run.outcome, Outcome::Finished);
    samples[0]
}

fn expected(gyrostat: &Gyrostat) -> [f64; 3] {
    let start = gyrostat.state(OMEGA.into(), 4.0, Vector3::new(-2.0, 1.5, 0.5));
    gyrostat.spin(END, &gyrostat.after(start, END, 20_000)).into()
}

#[test]
fn rotors_and_a_wheel_of_constant_speed() {
    let assembly = assembly(WheelSpeed::Constant { angular_momentum: 12.0 });
    let spin = expected(&gyrostat(|_| Vector3::new(0.0, 0.0, 12.0)));
    for method in [Method::Explicit, Method::Implicit, Method::Automatic] {
        let last = run(&assembly, method);
        assert!(norm(add(last.omega, scale(-1.0, spin))) < 1e-10 * norm(spin), "{:?} {spin:?}", last.omega);
        assert!(last.energy_drift.abs() < 1e-10 * last.dissipated, "{:e}", last.energy_drift);
        assert!(last.dissipated > 1.0);
    }
}

/// The motor does work on the body, which is accounted for.
#[test]
fn a_wheel_of_prescribed_speed() {
    let speed = Expression::parse("20 * sin(0.8 * t) + 5 * t", &["t"]).unwrap();
    let assembly = assembly(WheelSpeed::Prescribed { inertia: 0.3, speed });
    let spin = expected(&gyrostat(|t| Vector3::new(0.0, 0.0, 0.3 * (20.0 * (0.8 * t).sin() + 5.0 * t))));
    for method in [Method::Explicit, Method::Implicit] {
        let last = run(&assembly, method);
        assert!(norm(add(last.omega, scale(-1.0, spin))) < 1e-10 * norm(spin), "{:?} {spin:?}", last.omega);
        assert!(last.energy_drift.abs() < 1e-10 * last.energy, "{:e}", last.energy_drift);
        assert!(last.work.abs() > 0.05 && last.momentum_drift < 1e-11, "{last:?}");
    }
}
