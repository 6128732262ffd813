//! Energy that rotors and liquids take, by name.

use quasirigid::averaging::{FreeRotation, MeanPower, PolynomialPower, Response};
use quasirigid::elements::Assembly;
use quasirigid::model::{Mode, Principal};
use quasirigid::reduction::reduce;

use super::bodies::everything;

fn names(assembly: &Assembly) -> Vec<String> {
    assembly.body().unwrap().dissipators().iter().map(|part| part.name.clone()).collect()
}

/// Springs, rotors, a liquid in finite coordinates, and one whose response is known at every frequency: with and without the mean spin, at
/// slow and at fast spins.
#[test]
fn springs_rotors_and_liquids_share_the_power() {
    let mut assembly = everything();
    assembly.wheels.clear();
    let expected = [
        "spring mass-carrier",
        "spring other-mass",
        "spring other-carrier",
        "flywheel",
        "ball",
        "tank",
        "round",
    ];
    assert_eq!(names(&assembly), expected);
    let body = assembly.body().unwrap();
    assert_eq!(body.stiff_outside().dissipators().len(), 4);
    assert_eq!(body.locked_inside().dissipators().len(), 3);
    let Principal { moments, .. } = Principal::compute(body.invariants().J);
    let (response, reduced) = (Response::compute(&body).unwrap(), reduce(&body, 3).unwrap());
    let polynomial = PolynomialPower::from_reduced(&reduced);
    for (spin, close) in [(0.002, true), (0.3, false), (4.0, false)] {
        let motion = FreeRotation::at_logit(moments, spin * moments[1], Mode::LongAxis, 0.4);
        let [harmonics, low] = [response.budget(&motion), MeanPower::budget(&polynomial, &motion)];
        let [all, slow] = [response.mean_power(&motion), polynomial.mean_power(&motion)];
        let sum = |budget: &[(String, f64)]| budget.iter().map(|(_, power)| power).sum::<f64>();
        assert!((sum(&harmonics) / all - 1.0).abs() < 1e-10, "{spin}: {harmonics:?} {all}");
        assert!((sum(&low) / slow - 1.0).abs() < 1e-12, "{spin}: {low:?} {slow}");
        for ((name, power), (_, low)) in harmonics.iter().zip(&low) {
            assert!(*power > 0.0, "{name}");
            assert!(!close || (power / low - 1.0).abs() < 0.02, "{name}: {power} {low}");
        }
    }
}
