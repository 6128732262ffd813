//! Grading: the degree of each term. (R1)

use nalgebra::Vector3;
use proptest::prelude::*;
use quasirigid::model::{ReducedBody, Support};
use quasirigid::reduction::{Comparison, MAX_ORDER, Validity, degree_sizes, reduce};
use quasirigid_math::polynomial::Series;
use quasirigid_math::sphere;

use super::compare::{difference, directions, scaled_gap, size, value};
use crate::support::transform::stiffened;
use crate::support::{assemblies, bodies, cases, direction};

/// Rounding of some hundred operations per coefficient, grown by the condition of `C` and `J`.
const ROUNDING: f64 = 1e-11;

/// The value of a series is the sum of its degrees, and degree `d` grows as the `d`-th power.
fn is_graded(series: &Series, x: [f64; 3], s: f64) -> bool {
    let whole = series.value(x.map(|x| s * x));
    let mut sum = vec![0.0; series.rows()];
    let mut terms = 0.0_f64;
    for degree in 0..=series.degree() {
        for (sum, part) in sum.iter_mut().zip(value(series.part(degree), x)) {
            *sum += s.powi(degree as i32) * part;
        }
        let length = s.abs() * x.iter().map(|x| x.abs()).sum::<f64>();
        terms = terms.max(length.powi(degree as i32) * series.part(degree).amax());
    }
    whole.iter().zip(&sum).all(|(a, b)| (a - b).abs() <= 1e-13 * terms)
}

proptest! {
    #![proptest_config(cases(32))]

    #[test]
    fn degree_d_grows_as_the_power_d_of_the_spin(
        assembly in assemblies(), x in direction(), s in -2.0..2.0
    ) {
        let body = reduce(&assembly.body().unwrap(), 4).unwrap();
        for series in [&body.f, &body.K, &body.energy, &body.power, &body.phi, &body.q, &body.rate] {
            prop_assert!(is_graded(series, x, s));
        }
    }

    /// Lowest degree of every quantity, for every order. (R1), (R2), (R8)–(R11)
    #[test]
    fn an_elastic_body_has_no_third_degree(assembly in bodies(), order in 1..6usize) {
        let body = reduce(&assembly.body().unwrap(), order).unwrap();
        let nothing = |series: &Series, degrees: std::ops::RangeInclusive<usize>| {
            degrees.into_iter().all(|d| d > series.degree() || series.part(d).amax() == 0.0)
        };
        prop_assert!(nothing(&body.f, 0..=1) && nothing(&body.f, 3..=3));
        prop_assert!(nothing(&body.K, 0..=0) && nothing(&body.K, 2..=2));
        prop_assert!(nothing(&body.Omega, 0..=0) && nothing(&body.Omega, 2..=2));
        prop_assert!(nothing(&body.energy, 0..=1) && nothing(&body.energy, 3..=3));
        prop_assert!(nothing(&body.power, 0..=5) && nothing(&body.phi, 0..=3));
        prop_assert!(nothing(&body.q, 0..=1) && nothing(&body.rate, 0..=2));
        let degrees = [&body.f, &body.K, &body.Omega, &body.energy, &body.energy_of_momentum].map(Series::degree);
        prop_assert_eq!(degrees, [order + 2, order + 1, order + 1, order + 2, order + 2]);
        prop_assert_eq!([body.q.degree(), body.rate.degree(), body.phi.degree()], [order, order + 1, order + 2]);
    }

    /// Without damping the motion can be run backwards: odd degrees of `q` and `f` come from dashpots alone. (R1)
    #[test]
    fn odd_degrees_come_from_damping(assembly in bodies()) {
        let body = reduce(&stiffened(&assembly, 1.0, 0.0).body().unwrap(), 5).unwrap();
        let damped = reduce(&assembly.body().unwrap(), 5).unwrap();
        prop_assert_eq!(body.power.part(6).amax(), 0.0);
        for degree in [3, 5] {
            prop_assert_eq!(body.q.part(degree).amax(), 0.0);
            prop_assert!(damped.q.part(degree).amax() > 0.0);
        }
        for degree in [5, 7] {
            prop_assert_eq!(body.f.part(degree).amax(), 0.0);
            prop_assert!(damped.f.part(degree).amax() > 0.0);
        }
    }

    /// `C → C/ε²`, `B → B/ε` multiplies degree `d` of `f` by `ε^{d−2}`: stiff is slow. (R1)
    #[test]
    fn a_stiffer_body_is_the_same_body_at_a_slower_spin(assembly in bodies(), epsilon in 0.1..10.0) {
        let stiff = stiffened(&assembly, epsilon * epsilon, epsilon);
        let soft = reduce(&assembly.body().unwrap(), 5).unwrap();
        let stiff = reduce(&stiff.body().unwrap(), 5).unwrap();
        let by = |lower: i32| move |d: i32| (1.0 / epsilon).powi(d - lower);
        prop_assert!(scaled_gap(&stiff.f, &soft.f, by(2)) < ROUNDING);
        prop_assert!(scaled_gap(&stiff.K, &soft.K, by(1)) < ROUNDING);
        prop_assert!(scaled_gap(&stiff.Omega, &soft.Omega, by(1)) < ROUNDING);
        prop_assert!(scaled_gap(&stiff.energy, &soft.energy, by(2)) < ROUNDING);
        prop_assert!(scaled_gap(&stiff.power, &soft.power, by(3)) < ROUNDING);
        prop_assert!(scaled_gap(&stiff.q, &soft.q, by(0)) < ROUNDING);
    }

    /// Lower orders are the beginning of higher ones.
    #[test]
    fn a_higher_order_only_adds_degrees(assembly in bodies(), order in 1..5usize) {
        let body = assembly.body().unwrap();
        let (low, high) = (reduce(&body, order).unwrap(), reduce(&body, order + 1).unwrap());
        prop_assert_eq!(&low.f, &high.f.truncated(order + 2));
        prop_assert_eq!(&low.K, &high.K.truncated(order + 1));
        prop_assert_eq!(&low.q, &high.q.truncated(order));
        prop_assert_eq!(&low.energy, &high.energy.truncated(order + 2));
        let gap = difference(
            0..=order + 1,
            |d, u| value(low.Omega.part(d), u),
            |d, u| value(high.Omega.part(d), u),
        );
        prop_assert!(gap < ROUNDING, "reversion goes in rounds that differ: {gap:e}");
    }

    /// A free body and the same body fixed at its centre of mass share `μ₄` and `μ₅`, whatever their order, and no degree above. (R15),
    /// (S6)
    #[test]
    fn the_translation_first_shows_in_the_sixth_degree(assembly in bodies()) {
        let mut free = assembly;
        free.support = Support::Free;
        let center = free.body().unwrap().center_of_mass();
        let mut held = free.clone();
        held.support = Support::FixedPoint { point: center };
        let (free, held) = (reduce(&free.body().unwrap(), 5).unwrap(), reduce(&held.body().unwrap(), 5).unwrap());
        let gap = |degree: usize| {
            let (a, b) = (free.mu(degree), held.mu(degree));
            difference([degree], |_, u| value(&a, u), |_, u| value(&b, u))
        };
        prop_assert!(gap(4) < ROUNDING && gap(5) < ROUNDING, "{:e} {:e}", gap(4), gap(5));
        prop_assert!(gap(6) > 1e-6 && gap(7) > 1e-6, "{:e} {:e}", gap(6), gap(7));
        for degree in [4, 5] {
            let (a, b) = (free.phi.part(degree), held.phi.part(degree));
            let gap = difference([degree], |_, u| value(a, u), |_, u| value(b, u));
            prop_assert!(size(a) > 0.0 && gap < ROUNDING, "φ{degree}: {gap:e}");
        }
    }

    /// Deviation from Euler's equations: `J ω̇ + ω × Jω = μ`. (R7)
    #[test]
    fn the_torque_is_the_deviation_from_euler(assembly in assemblies()) {
        let body = assembly.body().unwrap();
        let reduced = reduce(&body, 4).unwrap();
        let J = nalgebra::Matrix3::from(body.inertia());
        for u in directions() {
            let omega = Vector3::from(u);
            let rate = Vector3::from(reduced.f.vector(u));
            let left = J * rate + omega.cross(&(J * omega));
            let gap = (left - Vector3::from(reduced.torque(u))).norm();
            prop_assert!(gap < 1e-13 * J.amax(), "{gap:e}");
        }
    }
}

/// Largest size of a number over the directions at which a validity looks at the power.
fn greatest(map: impl Fn([f64; 3]) -> f64, length: f64) -> f64 {
    let values = sphere::directions(400).map(|u| map((Vector3::from(u) * length).into()));
    values.map(f64::abs).fold(0.0, f64::max)
}

/// Even degrees of the power, which alone have a mean.
fn mean_power(body: &ReducedBody, omega: [f64; 3]) -> f64 {
    (2..=body.power.degree()).step_by(2).map(|degree| value(body.power.part(degree), omega)[0]).sum()
}

fn criterion(validity: &Validity, comparison: Comparison) -> f64 {
    validity.criteria.iter().find(|criterion| criterion.comparison == comparison).unwrap().value
}

proptest! {
    #![proptest_config(cases(8))]

    /// The terms that a validity takes from one manifold of a higher order are those of the reduced equations of these orders. (R14), (V7),
    /// (V11)
    #[test]
    fn validity_looks_ahead_as_the_reduced_equations_do(
        assembly in assemblies(), u in direction(), order in prop::sample::select(vec![0usize, 1, 3, 4, 10, 11])
    ) {
        let body = assembly.body().unwrap();
        let omega = u.map(|u| 0.1 * u);
        let spin = Vector3::from(omega).norm();
        let validity = Validity::assess(&body, order, omega).unwrap();
        let ahead = reduce(&body, (order + 4).min(MAX_ORDER)).unwrap();
        // sizes at this spin follow from those at another by powers
        for (found, known) in validity.degrees.iter().zip(degree_sizes(&ahead, omega)) {
            prop_assert!(found.degree == known.degree && (found.size - known.size).abs() <= 1e-10 * known.size, "{found:?} {known:?}");
        }
        prop_assert_eq!(validity.degrees.len(), ahead.f.degree() - 1);
        let reduced = reduce(&body, order).unwrap();
        let angular_momentum = Vector3::from(reduced.angular_momentum(omega)).norm();
        let length = |degree, u: [f64; 3]| {
            let value = value(ahead.Omega.part(degree), u.map(|u| angular_momentum * u));
            value.iter().map(|x| x * x).sum::<f64>().sqrt()
        };
        let size = |degree: usize| sphere::greatest(1000, |u| length(degree, u));
        let ratio = |from: f64, to: f64| if from > 0.0 { to / from } else { 0.0 };
        let series = ratio(size(1), size(3)).max(ratio(size(3), size(5)));
        let found = criterion(&validity, Comparison::Series);
        prop_assert!((found - series).abs() <= 1e-9 * series + 1e-13, "{found} {series}");
        let (low, high) = if order + 2 <= MAX_ORDER { (order, order + 2) } else { (order - 2, order) };
        let [low, high] = [low, high].map(|order| reduce(&body, order).unwrap());
        let whole = greatest(|x| mean_power(&low, x), spin);
        let change = ratio(whole, greatest(|x| mean_power(&high, x) - mean_power(&low, x), spin));
        let found = criterion(&validity, Comparison::Power);
        prop_assert!((found - change).abs() <= 1e-9 * change + 1e-13, "{found} {change}");
    }

    /// A reduced body is judged as given, not reduced again.
    #[test]
    fn what_is_handed_in_is_judged(assembly in bodies(), u in direction()) {
        let body = assembly.body().unwrap();
        let mut reduced = reduce(&body, 3).unwrap();
        let own = Validity::assess_reduced(&body, &reduced, u).unwrap();
        prop_assert_eq!(&own, &Validity::assess(&body, 3, u).unwrap());
        reduced.q = reduced.q.scaled(2.0);
        let doubled = Validity::assess_reduced(&body, &reduced, u).unwrap();
        let [before, after] = [own, doubled].map(|validity| criterion(&validity, Comparison::Linearity));
        prop_assert!((after / before - 2.0).abs() < 1e-12, "{after} {before}");
    }
}
