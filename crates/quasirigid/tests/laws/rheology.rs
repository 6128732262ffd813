//! Laws of material: their limits, their bounds, and each against complex arithmetic written out here.

use nalgebra::Complex;
use proptest::prelude::*;
use quasirigid::model::{Measured, Rheology, RheologyError};

use crate::support::cases;

fn laws() -> impl Strategy<Value = Rheology> {
    let time = || (-3.0..3.0).prop_map(|exponent: f64| 10f64.powf(exponent));
    prop_oneof![
        time().prop_map(|time| Rheology::KelvinVoigt { time }),
        time().prop_map(|time| Rheology::QualityFactor { factor: 1.0 + time }),
        time().prop_map(|time| Rheology::Maxwell { time }),
        (time(), time()).prop_map(|(time, strength)| Rheology::StandardLinear { time, strength }),
        (time(), time(), 0.05..0.95).prop_map(|(time, creep_time, exponent)| Rheology::Andrade {
            time,
            creep_time,
            exponent
        }),
    ]
}

/// Modulus in complex numbers.
fn expected(law: &Rheology, frequency: f64) -> Complex<f64> {
    let (one, i) = (Complex::new(1.0, 0.0), Complex::new(0.0, 1.0));
    let at = |time: f64| i * (frequency * time);
    match *law {
        Rheology::KelvinVoigt { time } => one + at(time),
        Rheology::QualityFactor { factor } => one + i / factor,
        Rheology::Maxwell { time } => at(time) / (one + at(time)),
        Rheology::StandardLinear { time, strength } => one + at(time) / (one + at(time)) * strength,
        Rheology::Andrade { time, creep_time, exponent } => {
            let creep = at(creep_time).powf(-exponent) * integral_of_gamma(1.0 + exponent);
            one / (one + creep + one / at(time))
        }
        Rheology::Elastic | Rheology::Table(_) => one,
    }
}

/// `Γ(x)` for `1 < x < 2` by its integral, with `s = e^v` and the trapezoidal rule.
fn integral_of_gamma(x: f64) -> f64 {
    let step = 0.01;
    (-4000..800).map(|k| f64::from(k) * step).map(|v| (x * v - v.exp()).exp() * step).sum()
}

proptest! {
    #![proptest_config(cases(300))]

    #[test]
    fn modulus_is_the_formula_and_takes_energy(law in laws(), exponent in -6.0..6.0) {
        prop_assert!(law.check().is_ok());
        let frequency = 10f64.powf(exponent);
        let [re, im] = law.modulus(frequency);
        let expected = expected(&law, frequency);
        prop_assert!(im > 0.0 && re > 0.0);
        prop_assert!((Complex::new(re, im) - expected).norm() < 1e-12 * expected.norm(), "{law:?} {re} {im} {expected}");
    }

    /// Between its rows a table is a straight line in the logarithms, at them the row itself, beyond them constant.
    #[test]
    fn measured_values_are_joined_in_the_logarithms(share in 0.0..1.0) {
        let table = Rheology::Table(Measured::new(vec![[1e-2, 0.5, 0.2], [1e3, 2.0, 0.002]]).unwrap());
        let [re, im] = table.modulus(1e-2 * 1e5_f64.powf(share));
        prop_assert!((re / (0.5 * 4_f64.powf(share)) - 1.0).abs() < 1e-12);
        prop_assert!((im / re / (0.2 * 0.01_f64.powf(share)) - 1.0).abs() < 1e-12);
    }
}

#[test]
fn measured_values_end_at_the_first_and_the_last() {
    let table =
        Rheology::Table(Measured::new(vec![[1e-2, 0.5, 0.2], [1.0, 1.0, 0.1], [1e3, 2.0, 0.002]]).unwrap());
    assert_eq!(table.modulus(1e-9), [0.5, 0.1]);
    assert_eq!(table.modulus(1.0), [1.0, 0.1]);
    assert_eq!(table.modulus(1e9), [2.0, 0.004]);
    assert_eq!(table.measured_between(), Some([1e-2, 1e3]));
}

#[test]
fn laws_that_no_material_has_are_refused() {
    let refused = |law: Rheology| law.check().unwrap_err();
    for time in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(refused(Rheology::KelvinVoigt { time }), RheologyError::NotPositive { .. }));
        assert!(matches!(refused(Rheology::Maxwell { time }), RheologyError::NotPositive { .. }));
        assert!(matches!(
            refused(Rheology::QualityFactor { factor: time }),
            RheologyError::NotPositive { .. }
        ));
        let linear = Rheology::StandardLinear { time: 1.0, strength: time };
        assert!(matches!(refused(linear), RheologyError::NotPositive { .. }));
    }
    let lossy = Rheology::QualityFactor { factor: 0.99 };
    assert_eq!(refused(lossy), RheologyError::Quality { value: 0.99 });
    Rheology::QualityFactor { factor: 1.0 }.check().unwrap();
    for exponent in [0.0, 1.0, f64::NAN] {
        let andrade = Rheology::Andrade { time: 1.0, creep_time: 1.0, exponent };
        assert!(matches!(refused(andrade), RheologyError::Exponent { .. }));
    }
    assert_eq!(Measured::new(Vec::new()), Err(RheologyError::NoRows));
    assert_eq!(Measured::new(vec![[1.0, 0.0, 0.1]]), Err(RheologyError::NotPositive { value: 0.0 }));
    let back = Measured::new(vec![[2.0, 1.0, 0.1], [2.0, 1.0, 0.1]]);
    assert_eq!(back, Err(RheologyError::NotAscending { previous: 2.0, next: 2.0 }));
}
