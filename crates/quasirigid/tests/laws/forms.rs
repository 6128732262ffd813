//! Two forms of the same equations, and two orders of the same series, differ as their order says.

use quasirigid::dynamics::{Form, Options, spin_path};
use quasirigid::reduction::reduce;
use quasirigid_math::vec3::norm;

use super::wobbler::{assembly, times_to};
use crate::support::transform::stiffened;

/// Spin whose share of the lowest frequency is about a seventh before the body is stiffened.
const START: [f64; 3] = [1.0, -0.6, 1.6];

/// Spins at some times of the body with `C/ε²`, `B/ε`.
fn spins(order: usize, form: Form, epsilon: f64) -> Vec<[f64; 3]> {
    let body = stiffened(&assembly(), epsilon.powi(-2), epsilon.recip()).body().unwrap();
    let options = Options { form, tolerance: 1e-14, ..Options::default() };
    spin_path(&reduce(&body, order).unwrap(), START, &times_to(4.0, 8), &options).unwrap().omega
}

/// Power of `ε` with which two sets of runs converge, the linear part of its change with `ε` removed.
fn order_of(difference: impl Fn(f64) -> f64) -> f64 {
    let [first, second, third] = [0.4, 0.2, 0.1].map(difference);
    let (coarse, fine) = ((first / second).log2(), (second / third).log2());
    2.0 * fine - coarse
}

fn gap(left: &[[f64; 3]], right: &[[f64; 3]]) -> f64 {
    let gaps = left.iter().zip(right).map(|(a, b)| norm(std::array::from_fn(|i| a[i] - b[i])));
    gaps.fold(0.0, f64::max)
}

/// Both forms err by `ε^{p+1}`, (R11). At `p = 2` nothing is odd, so they agree to one power more.
#[test]
fn momentum_and_paper_form_agree_to_their_order() {
    for (p, expected) in [(2, 4.0), (3, 4.0), (4, 5.0)] {
        let order =
            order_of(|e| gap(&spins(p, Form::AngularMomentum, e), &spins(p, Form::AngularVelocity, e)));
        assert!((order - expected).abs() < 0.1, "p = {p}: order {order}");
    }
}

/// Order `p` errs by `ε^{p+1}` over a fixed time, whatever the form. (R1)
#[test]
fn the_error_of_an_order_falls_with_its_power() {
    for form in [Form::AngularMomentum, Form::AngularVelocity] {
        for p in 1..=4 {
            let order = order_of(|e| gap(&spins(p, form, e), &spins(p + 3, form, e)));
            assert!((order - (p as f64 + 1.0)).abs() < 0.1, "{form:?}, p = {p}: order {order}");
        }
    }
}
