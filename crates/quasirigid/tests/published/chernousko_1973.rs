//! One sprung mass: closed forms, and exact rationals for a triaxial body [@chernousko1973].

use quasirigid::dynamics::{Forced, Form, Options, Sample, Start, propagate_full, spin_path};
use quasirigid::elements::{Assembly, End};
use quasirigid::model::{FlexibleBody, Support};
use quasirigid::problems::AxialMass;
use quasirigid::reduction::reduce;
use quasirigid_math::polynomial::Homogeneous;
use quasirigid_math::rotation::ALIGNED;
use quasirigid_math::vec3::dot;

use crate::support::parts;

const AXIAL: AxialMass = AxialMass { carrier: 7.0, A: 1.0, C: 1.5, m: 0.1, rho: 0.5, c: 40.0, b: 0.3 };

/// A body whose frozen inertia about the fixed pole is `J`, with one mass on an isotropic spring.
fn body(J: [f64; 3], mass: f64, rho: [f64; 3], stiffness: f64, damping: f64) -> FlexibleBody {
    let square: f64 = rho.iter().map(|x| x * x).sum();
    let inertia = std::array::from_fn(|i| {
        std::array::from_fn(|k| {
            let diagonal = if i == k { J[i] - mass * square } else { 0.0 };
            diagonal + mass * rho[i] * rho[k]
        })
    });
    Assembly {
        carrier: Some(parts::carrier(5.0, [0.0; 3], inertia)),
        points: vec![parts::free_point("mass", mass, rho)],
        springs: vec![parts::spring(End::Point(0), End::Carrier, parts::isotropic(stiffness, damping))],
        hinged: vec![],
        support: Support::FixedPoint { point: [0.0; 3] },
        ..Assembly::default()
    }
    .body()
    .unwrap()
}

fn value(part: &Homogeneous, x: [f64; 3]) -> [f64; 3] {
    let mut value = [0.0; 3];
    part.add_value(x, &mut value);
    value
}

fn assert_close(name: &str, found: [f64; 3], expected: [f64; 3], tolerance: f64) {
    let size = expected.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
    for axis in 0..3 {
        let error = (found[axis] - expected[axis]).abs() / size;
        assert!(error < tolerance, "{name}[{axis}]: found {}, expected {}", found[axis], expected[axis]);
    }
}

/// The angular-velocity form of the paper (R15) gives these by hand.
#[test]
fn triaxial_body_has_the_rational_torque() {
    let body = body([2.0, 3.0, 4.0], 0.1, [0.5, -0.3, 0.8], 1000.0, 2.0);
    let omega = [0.3, -0.2, 0.5];
    let reduced = reduce(&body, 3).unwrap();
    assert_close("r0", value(reduced.q.part(2), omega), [-7.75e-6, 4.05e-6, 6.4e-6], 1e-12);
    let r1 = [8.866_666_666_666_67e-9, 1.548e-8, 1.173_333_333_333_33e-9];
    assert_close("r1", value(reduced.q.part(3), omega), r1, 1e-12);
    let mu4 = [-8.632_066_666_666_67e-7, -1.498_606_666_666_67e-6, -2.247_333_333_333_33e-8];
    assert_close("mu4", value(&reduced.mu(4), omega), mu4, 1e-12);
    let mu5 = [-9.524_126_666_666_67e-10, 6.337_015_555_555_56e-10, 1.072_416e-9];
    assert_close("mu5", value(&reduced.mu(5), omega), mu5, 1e-12);
    let power = reduced.dissipated_power(omega);
    assert!((power / 1.598_124_444_444_44e-10 - 1.0).abs() < 1e-12, "{power}");
}

#[test]
fn axial_mass_has_the_closed_torque() {
    let body = AXIAL.assembly().body().unwrap();
    let reduced = reduce(&body, 3).unwrap();
    for omega in [[0.4, 0.0, 1.0], [-0.3, 0.7, 0.2], [1.1, -0.4, -0.9]] {
        assert_close("mu", reduced.torque(omega), AXIAL.torque(omega), 1e-12);
    }
}

/// Coefficients themselves, read off the derived polynomial.
#[test]
fn axial_mass_has_the_closed_coefficients() {
    let reduced = reduce(&AXIAL.assembly().body().unwrap(), 3).unwrap();
    let coefficient = |degree: usize, exponents: [usize; 3], axis: usize| {
        let mu = reduced.mu(degree);
        let mut terms = mu.terms();
        terms.find(|(monomial, _)| *monomial == exponents).map(|(_, value)| value[axis]).unwrap()
    };
    let (F, D) = (AXIAL.F(), AXIAL.D());
    let close =
        |found: f64, expected: f64| assert!((found / expected - 1.0).abs() < 1e-12, "{found} {expected}");
    close(coefficient(4, [0, 1, 3], 0), F * AXIAL.C * AXIAL.C);
    close(coefficient(4, [2, 1, 1], 0), F * AXIAL.A * AXIAL.A);
    close(coefficient(5, [1, 0, 4], 0), D);
    close(coefficient(5, [0, 2, 3], 2), -AXIAL.A / AXIAL.C * D);
}

/// The paper writes `μ₄` and `μ₅` as tensors contracted with the spin (4.4), (R7).
#[test]
fn tensors_contract_to_the_torque() {
    let body = body([2.0, 3.0, 4.0], 0.1, [0.5, -0.3, 0.8], 1000.0, 2.0);
    let reduced = reduce(&body, 3).unwrap();
    let omega = [0.3, -0.2, 0.5];
    for degree in [4, 5] {
        let mut sum = [0.0; 3];
        for number in 0..3_usize.pow(degree) {
            let indices: Vec<usize> = (0..degree).map(|place| number / 3_usize.pow(place) % 3).collect();
            let product: f64 = indices.iter().map(|axis| omega[*axis]).product();
            let entry = reduced.tensor(&indices);
            sum = std::array::from_fn(|axis| sum[axis] + entry[axis] * product);
        }
        assert_close("contraction", sum, value(&reduced.mu(degree as usize), omega), 1e-12);
    }
}

/// Secular evolution from 79° to 5.7° off the axis. In the angular-velocity form the law is exact, so only the integrator is between the
/// two.
#[test]
fn axial_mass_keeps_its_law_in_time() {
    let problem = AxialMass { c: 10.0, b: 3.0, ..AXIAL };
    let reduced = reduce(&problem.assembly().body().unwrap(), 3).unwrap();
    let omega = [3.0, 0.0, 0.4];
    let (across, along) = (problem.A * omega[0], problem.C * omega[2]);
    let G = across.hypot(along);
    let start = (along / G).powi(2);
    let passage = problem.time(G, start, 0.99);
    let times: Vec<f64> = (1..=50).map(|i| passage * f64::from(i) / 50.0).collect();
    let options = Options { form: Form::AngularVelocity, tolerance: 1e-13, ..Options::default() };
    let path = spin_path(&reduced, omega, &times, &options).unwrap();
    for (t, omega) in times.iter().zip(&path.omega) {
        let u = (problem.C * omega[2] / G).powi(2);
        let error = (problem.time(G, start, u) - t).abs() / passage;
        assert!(error < 1e-8, "t = {t}: u = {u}, error {error:e}");
    }
    let end = (problem.C * path.omega[49][2] / G).powi(2);
    assert!((end - 0.99).abs() < 1e-8, "{end}");
}

/// Dissipation in a full run over the power of an order at the same spins, and the shift of the precession likewise.
fn full_over_reduced(case: &AxialMass, order: usize) -> [f64; 2] {
    let body = case.assembly().body().unwrap();
    let start = Start::new([0.4, 0.0, 1.0], ALIGNED);
    let full = start.settled(Forced::not(&body), 9).unwrap();
    let times: Vec<f64> = (0..=100).map(|i| f64::from(i) * 0.01).collect();
    let options = Options { tolerance: 1e-14, ..Options::default() };
    let mut samples = Vec::new();
    propagate_full(Forced::not(&body), &full, &times, &options, &mut samples).unwrap();
    let reduced = reduce(&body, order).unwrap();
    let power = |sample: &Sample| reduced.power.scalar(sample.omega);
    let mean = samples.iter().map(power).sum::<f64>() / samples.len() as f64;
    let Sample { omega, angular_momentum: K, .. } = samples[0];
    let precession = (K[2] * omega[0] - K[0] * omega[2]) / K[0];
    let rigid = (case.C - case.A) / case.A * omega[2];
    [samples[100].dissipated / mean, (precession - rigid) / (-case.F() * dot(K, K) * omega[2])]
}

/// Departures `4.09/Ω₀²` in the power and `2.1/Ω₀²` in the precession, as simulated by others. They do not say how heavy their body was;
/// the rest of the departure at 2 kg altogether is of the next order.
#[test]
fn full_dynamics_departs_from_the_closed_form_as_simulated() {
    for (frequency, power, rate) in
        [(10.0_f64, 1.04199, 1.02150), (20.0, 1.01028, 1.00530), (40.0, 1.002557, 1.00132)]
    {
        let case = AxialMass { carrier: 1.9, c: 0.1 * frequency * frequency, b: 0.02 * frequency, ..AXIAL };
        let [third, shift] = full_over_reduced(&case, 3);
        let [fifth, _] = full_over_reduced(&case, 5);
        println!(
            "{frequency}: power {third:.6}, table {power}; p = 5 {fifth:.6}; shift {shift:.6}, table {rate}"
        );
        let next = frequency.powi(-4);
        assert!((third - power).abs() < 2.5 * next + 2e-6, "{frequency}: {third}, table {power}");
        assert!(
            (shift - rate).abs() < 2e-2 * frequency.powi(-2) + 5e-6,
            "{frequency}: {shift}, table {rate}"
        );
        assert!((fifth - 1.0).abs() < 12.0 * next, "{frequency}: at p = 5 {fifth}");
    }
}
