//! What belongs to which degree. (R1)

use nalgebra::Vector3;
use proptest::prelude::*;
use quasirigid::math::polynomial::Series;
use quasirigid::model::Support;
use quasirigid::reduction::reduce;

use crate::compare::{difference, directions, scaled_gap, size, value};
use crate::support::{assemblies, bodies, cases, direction};
use crate::transform::stiffened;

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

    /// The lowest degree of everything, for every order. (R1), (R2), (R8)–(R11)
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

    /// A free body and the same body held at its centre of mass share `μ₄` and `μ₅`, whatever their order, and no
    /// degree above. (R15), (S6)
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

    /// (R7): `J ω̇ + ω × Jω = μ`.
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
