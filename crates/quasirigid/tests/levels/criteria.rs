use quasirigid::reduction::{Comparison, Validity, Verdict};

use super::bodies::{SPIN, near_sphere, nearly_equal};

fn value(validity: &Validity, comparison: Comparison) -> f64 {
    validity.criteria.iter().find(|criterion| criterion.comparison == comparison).unwrap().value
}

/// Verdicts: the equations hold, the power of order 3 and averages along the rigid polhode do not; order 5 corrects the power alone.
#[test]
fn nearly_equal_moments_are_judged_in_three_parts() {
    let body = near_sphere().body().unwrap();
    let [third, fifth] = [3, 5].map(|order| Validity::assess(&body, order, SPIN).unwrap());
    println!("{:?}\n{:?}", third.criteria, fifth.criteria);
    assert_eq!([third.verdict(), fifth.verdict()], [Verdict::Holds; 2]);
    assert_eq!([third.dissipation(), third.averages()], [Verdict::Fails; 2]);
    assert_eq!([fifth.dissipation(), fifth.averages()], [Verdict::Holds, Verdict::Fails]);
    // 7.9e-4 over 1.2e-4 rad/s², as an independent derivation has them; more across the axes of the two nearest moments.
    let size = |degree: usize| third.degrees.iter().find(|size| size.degree == degree).unwrap().size;
    assert!((size(4) / size(2) / (7.9 / 1.2) - 1.0).abs() < 0.1);
    let ratio = value(&third, Comparison::Levels) / (size(4) / size(2));
    assert!((1.0..3.0).contains(&ratio), "{ratio}");
}

/// Both ratios fall as the first power of the stiffness, and as the differences grow.
#[test]
fn stiffer_bodies_and_larger_differences_pass() {
    let of = |difference: f64| {
        let body = nearly_equal(difference, [0.4, -1.3, 0.8]).body().unwrap();
        let validity = Validity::assess(&body, 3, SPIN).unwrap();
        [Comparison::Levels, Comparison::Power].map(|comparison| value(&validity, comparison))
    };
    let [narrow, wide] = [1e-3, 1e-1].map(of);
    println!("{narrow:?} {wide:?}");
    assert!((narrow[0] / wide[0] / 100.0 - 1.0).abs() < 0.3, "{narrow:?} {wide:?}");
    assert!(narrow[1] > 10.0 * wide[1] && wide[0] < 0.1 && wide[1] < 0.1);
    let slow = Validity::assess(&near_sphere().body().unwrap(), 3, SPIN.map(|w| w / 100.0)).unwrap();
    assert_eq!([slow.dissipation(), slow.averages()], [Verdict::Holds; 2]);
}
