//! Nutation as an envelope: against rigid bodies in closed form, against the motion itself, and with momentum wheels. (P8)

use quasirigid::averaging::FreeRotation;
use quasirigid::dynamics::{Nutations, Observer, Options, Sample, Start, propagate, steady_spins};
use quasirigid::elements::{Assembly, End, Wheel, WheelSpeed};
use quasirigid::model::{Mode, Principal, ReducedBody};
use quasirigid::problems::ring_of_points;
use quasirigid::reduction::reduce;
use quasirigid_math::rotation::angle;
use quasirigid_math::vec3::{dot, norm};

use crate::support::parts;

fn rigid(inertia: [[f64; 3]; 3], wheels: Vec<Wheel>) -> ReducedBody {
    let carrier = parts::carrier(3.0, [0.4, -0.2, 0.1], inertia);
    let body = Assembly { carrier: Some(carrier), wheels, ..Assembly::default() }.body().unwrap();
    reduce(&body, 0).unwrap()
}

/// Both modes of a rotated triaxial body, from anywhere on the polhode: the closed form.
#[test]
fn a_rigid_body_nutates_as_in_closed_form() {
    let body = rigid([[9.0, 0.4, -0.2], [0.4, 13.0, 0.3], [-0.2, 0.3, 16.0]], Vec::new());
    let Principal { moments, axes } = Principal::compute(body.J);
    for (mode, degrees) in [(Mode::ShortAxis, 1e-3), (Mode::ShortAxis, 50.0), (Mode::LongAxis, 30.0)] {
        let motion = FreeRotation::at_nutation(moments, 7.0, mode, f64::to_radians(degrees)).unwrap();
        for share in [0.0, 0.13, 0.71] {
            let omega = motion.omega(share * motion.polhode_period());
            let K = [0, 1, 2].map(|i| (0..3).map(|k| moments[k] * omega[k] * axes[k][i]).sum());
            let found = Nutations::new(&body).at(K).unwrap();
            let [least, greatest] = motion.nutation();
            assert!((found.least / least - 1.0).abs() < 1e-7, "{mode:?} {degrees}: {found:?} {least}");
            assert!((found.greatest / greatest - 1.0).abs() < 1e-7, "{mode:?} {degrees}: {found:?}");
            assert!(dot(found.axis, axes[mode.circled()]).abs() > 1.0 - 1e-12);
        }
    }
}

/// Oblate and prolate bodies of revolution keep the angle from their axis; so does one in a flat spin, of ninety degrees.
#[test]
fn a_body_of_revolution_keeps_its_angle() {
    for axial in [3.0, 9.0] {
        let body = rigid(parts::diag([5.0, axial, 5.0]), Vec::new());
        for degrees in [0.01_f64, 20.0, 70.0, 90.0] {
            let (sine, cosine) = degrees.to_radians().sin_cos();
            let found = Nutations::new(&body).at([0.6 * sine, cosine, 0.8 * sine]).unwrap();
            for angle in [found.least, found.greatest] {
                assert!(
                    (angle.to_degrees() - degrees).abs() < 1e-8 * degrees,
                    "{axial} {degrees}: {found:?}"
                );
            }
        }
    }
}

/// Angles sampled during a motion.
#[derive(Default)]
struct Seen(Vec<[f64; 3]>);

impl Observer for Seen {
    fn sample(&mut self, sample: &Sample) {
        self.0.push(sample.angular_momentum);
    }
}

/// Asserts for a body whose steady spins are not about its principal axes that one revolution of the motion shows the envelope, and that
/// the envelope is the same from every place on it.
fn assert_seen(body: &ReducedBody, omega: [f64; 3], period: f64) {
    let times: Vec<f64> = (0..=4000).map(|i| 1.1 * period * f64::from(i) / 4000.0).collect();
    let mut seen = Seen::default();
    let start = Start::new(omega, [1.0, 0.0, 0.0, 0.0]);
    propagate(body, start, &times, &Options { tolerance: 1e-12, ..Options::default() }, &mut seen).unwrap();
    let first = Nutations::new(body).at(seen.0[0]).unwrap();
    let angles = seen.0.iter().map(|K| angle(first.axis, *K));
    let (low, high) = angles.fold((f64::INFINITY, 0.0_f64), |(l, h), a| (l.min(a), h.max(a)));
    println!("{:?} {low} {high}", first);
    assert!((first.least / low - 1.0).abs() < 2e-4 && (first.greatest / high - 1.0).abs() < 2e-4);
    let mut nutations = Nutations::new(body);
    for K in seen.0.iter().step_by(500) {
        let found = nutations.at(*K).unwrap();
        assert!((found.least / first.least - 1.0).abs() < 2e-4, "{found:?} {first:?}");
        assert!((found.greatest / first.greatest - 1.0).abs() < 2e-4, "{found:?} {first:?}");
    }
}

/// Wheels shift the axis of steady spin far from every principal axis, and the angle is counted from there.
#[test]
fn momentum_wheels_turn_the_axis_that_is_circled() {
    let wheel = Wheel {
        name: "wheel".into(),
        axis: [0.5, 1.0, 0.2],
        speed: WheelSpeed::Constant { angular_momentum: 6.0 },
    };
    let body = rigid([[9.0, 0.4, -0.2], [0.4, 13.0, 0.3], [-0.2, 0.3, 16.0]], vec![wheel]);
    let omega = [0.05, 0.1, 0.7];
    let axis = Nutations::new(&body).at(body.angular_momentum(omega)).unwrap().axis;
    assert!(Principal::compute(body.J).axes.iter().all(|principal| dot(*principal, axis).abs() < 0.99));
    let spin = body.Omega.vector(axis.map(|entry| norm(body.angular_momentum(omega)) * entry));
    assert!(angle(spin, axis).min(angle(spin, axis.map(|entry| -entry))) < 1e-9, "a steady spin");
    assert_seen(&body, omega, 60.0);
}

/// Asserts that the angles of the rows of a motion are those that each has alone.
fn assert_rows_stand_alone(body: &ReducedBody, omega: [f64; 3]) {
    let times: Vec<f64> = (0..=300).map(|i| 40.0 * f64::from(i)).collect();
    let mut seen = Seen::default();
    propagate(body, Start::new(omega, [1.0, 0.0, 0.0, 0.0]), &times, &Options::default(), &mut seen).unwrap();
    let mut rows = Nutations::new(body);
    let mut followed = 0;
    for K in &seen.0 {
        let (row, alone) = (rows.at(*K), Nutations::new(body).at(*K));
        let (Some(row), Some(alone)) = (row, alone) else { continue };
        assert!(angle(row.axis, alone.axis) < 1e-9, "{row:?} {alone:?}");
        assert!((row.least - alone.least).abs() < 1e-9 * alone.least, "{row:?} {alone:?}");
        assert!((row.greatest - alone.greatest).abs() < 1e-9 * alone.greatest, "{row:?} {alone:?}");
        followed += 1;
    }
    assert!(followed > 290, "{followed}");
}

/// With a separatrix on the way.
#[test]
fn rows_have_the_angles_that_each_has_alone() {
    assert_rows_stand_alone(&reduce(&ring_of_points(7).body().unwrap(), 3).unwrap(), [0.9, 0.05, 0.1]);
}

/// Exactly, and as nearly as circuits are told from circles.
#[test]
fn rows_of_a_body_of_revolution_have_the_angles_that_each_has_alone() {
    for unequal in [0.0, 1e-12, 1e-10, 1e-8, 1e-5] {
        let assembly = Assembly {
            carrier: Some(parts::carrier(7.0, [0.0; 3], parts::diag([1.0, 1.0 + unequal, 1.5]))),
            points: vec![parts::free_point("mass", 0.1, [0.0, 0.0, 0.5])],
            springs: vec![parts::spring(End::Point(0), End::Carrier, parts::isotropic(40.0, 0.4))],
            ..Assembly::default()
        };
        assert_rows_stand_alone(&reduce(&assembly.body().unwrap(), 3).unwrap(), [0.4, 0.0, 1.0]);
    }
}

/// An elastic body: the axis is that of the deformed body.
#[test]
fn the_axis_is_that_of_the_deformed_body() {
    let body = reduce(&ring_of_points(7).body().unwrap(), 2).unwrap();
    let omega = [0.03, 0.05, 0.9];
    let found = Nutations::new(&body).at(body.angular_momentum(omega)).unwrap();
    let steady = steady_spins(&body, norm(body.angular_momentum(omega)));
    let nearest = steady.iter().flatten().map(|spin| {
        let K = body.angular_momentum(spin.omega);
        angle(K, found.axis).min(angle(K, found.axis.map(|entry| -entry)))
    });
    assert!(nearest.fold(f64::INFINITY, f64::min) < 1e-8);
    let frequency = steady.iter().flatten().map(|spin| spin.frequency).filter(|f| *f > 0.0);
    assert_seen(&body, omega, std::f64::consts::TAU / frequency.fold(f64::INFINITY, f64::min));
}
