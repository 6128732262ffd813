//! The rate at which a small wobble falls or grows, against the eigenvalues of the full system linearised about the steady spin.

use quasirigid::averaging::{Evolution, MeanPower, PolynomialPower, Response};
use quasirigid::dynamics::steady_spins;
use quasirigid::model::{FlexibleBody, Mode, Principal};
use quasirigid::reduction::reduce;
use quasirigid_math::eigen::eigenvalues;
use quasirigid_math::vec3::{add, norm, scale};

use super::evolution::tumbler;
use crate::support::linearised::{linearised, rates};

/// Growth rate of the pair of eigenvalues next to the nutation of the frozen body; sizes make the matrix well scaled.
fn eigenvalue_rate(body: &FlexibleBody, mode: Mode, G: f64) -> f64 {
    let reduced = reduce(body, 7).unwrap();
    let Principal { moments: [I1, I2, I3], .. } = Principal::compute(reduced.J);
    let omega = steady_spins(&reduced, G)[mode.circled()].unwrap().omega;
    let q = reduced.q.value(omega);
    let n = q.len();
    // p = h(q)ω + A·0 of a steady state, at which the rates of the coordinates vanish.
    let mut p = vec![0.0; n];
    let K = reduced.angular_momentum(omega);
    for _ in 0..30 {
        let state: Vec<f64> = [&K[..], &p, &q].concat();
        let rate = rates(body, &state);
        let correction = body.mass_times(&rate[3 + n..]);
        p.iter_mut().zip(correction).for_each(|(p, part)| *p -= part);
    }
    let state: Vec<f64> = [&K[..], &p, &q].concat();
    let slow = G / I3;
    let sizes: Vec<f64> = [vec![G; 3], vec![slow; n], vec![1.0; n]].concat();
    // truncation and rounding of the differences are alike, 1e-14, at this share
    let values = eigenvalues(&linearised(body, &state, &sizes, 5e-3)).unwrap();
    let spin = norm(omega);
    let square = match mode {
        Mode::ShortAxis => (I3 - I1) * (I3 - I2) / (I1 * I2),
        Mode::LongAxis => (I2 - I1) * (I3 - I1) / (I2 * I3),
    };
    let nutation = spin * square.sqrt();
    let distance =
        |value: &&[f64; 2]| add([value[0], value[1].abs(), 0.0], scale(-1.0, [0.0, nutation, 0.0]));
    values.iter().min_by(|a, b| norm(distance(a)).total_cmp(&norm(distance(b)))).unwrap()[0]
}

#[test]
fn wobble_rates_are_the_eigenvalues_of_the_full_system() {
    let G = 15.0;
    for (mode, sign) in [(Mode::ShortAxis, -1.0), (Mode::LongAxis, 1.0)] {
        let gaps = [0.6, 0.3, 0.15].map(|epsilon| {
            let body = tumbler(epsilon).body().unwrap();
            let exact = eigenvalue_rate(&body, mode, G);
            let powers = [
                Box::new(PolynomialPower::from_reduced(&reduce(&body, 3).unwrap())) as Box<dyn MeanPower>,
                Box::new(Response::compute(&body).unwrap()),
            ];
            powers.map(|power| sign * Evolution::new(&*power, G).wobble_rate(mode) / exact - 1.0)
        });
        for method in 0..2 {
            let order = (gaps[1][method] / gaps[2][method]).log2();
            println!("{mode:?}, method {method}: {gaps:?}, order {order}");
            assert!((order - 2.0).abs() < 0.1, "{mode:?} {method}: {gaps:?} {order}");
        }
    }
}
