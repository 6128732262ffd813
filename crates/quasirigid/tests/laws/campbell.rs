//! Eigenvalues at many spins against the modes of each, which come from the general solver with its vectors. (M2), (M11)

use proptest::prelude::*;
use quasirigid::elements::{Assembly, Wheel, WheelSpeed};
use quasirigid::model::{FlexibleBody, Mode};
use quasirigid::modes::{
    CampbellError, EquilibriumError, RelativeEquilibrium, SpinMagnitude, SpinModes, campbell,
};
use quasirigid::problems::{AxialMass, CommonProblem, Explorer1, ring_of_points};

use crate::support::rotors::{ball, flywheel};
use crate::support::{assemblies, cases};

/// Difference of the eigenvalues at a spin from those of the modes there, relative to the largest; none without modes.
fn difference(body: &FlexibleBody, mode: Mode, spin: f64, found: &[[f64; 2]]) -> Option<f64> {
    let steady = RelativeEquilibrium::extreme(body, mode, SpinMagnitude::Rate(spin)).ok()?;
    let modes = SpinModes::about(body, steady).ok()?;
    let mut left: Vec<[f64; 2]> =
        modes.modes.iter().filter(|mode| !mode.neutral).map(|mode| mode.of_motion).collect();
    assert_eq!(left.len(), found.len(), "{left:?} {found:?}");
    let largest = found.iter().fold(0.0_f64, |largest, [re, im]| largest.max(re.hypot(*im)));
    let mut gap = 0.0_f64;
    for [growth, frequency] in found {
        let off = |other: &[f64; 2]| (other[0] + growth).hypot(other[1] - frequency);
        let nearest = (0..left.len()).min_by(|a, b| off(&left[*a]).total_cmp(&off(&left[*b])))?;
        gap = gap.max(off(&left.swap_remove(nearest)));
    }
    Some(if largest > 0.0 { gap / largest } else { 0.0 })
}

/// Bodies with all kinds of coordinates, none in its principal axes, with the spins (rad/s) to try.
fn bodies() -> Vec<(&'static str, Assembly, [f64; 2])> {
    let mut inside = ring_of_points(1);
    inside.rotors.push(flywheel([0.3, -0.8, 0.5], 0.2, 0.05));
    inside.rotors.push(ball(0.1, 0.02));
    vec![
        (
            "axial mass",
            AxialMass { carrier: 7.0, A: 1.0, C: 1.5, m: 0.1, rho: 0.5, c: 40.0, b: 0.3 }.assembly(),
            [0.1, 15.0],
        ),
        ("common problem", CommonProblem::SOFT.assembly(), [0.1, 4.0]),
        ("explorer", Explorer1::stiffened(5.0, 0.01).assembly(), [10.0, 150.0]),
        ("ring", ring_of_points(4), [0.05, 20.0]),
        ("rotors", inside, [0.1, 20.0]),
        ("wheel", wheeled([0.2, 0.5, -0.9]), [0.1, 20.0]),
    ]
}

/// A ring with a momentum wheel about an axis.
fn wheeled(axis: [f64; 3]) -> Assembly {
    let speed = WheelSpeed::Constant { angular_momentum: 0.4 };
    Assembly { wheels: vec![Wheel { name: "wheel".into(), axis, speed }], ..ring_of_points(2) }
}

#[test]
fn a_campbell_diagram_has_the_eigenvalues_of_the_modes() {
    for (name, assembly, [from, to]) in bodies() {
        let body = assembly.body().unwrap();
        let spins: Vec<f64> = (0..20).map(|k| from * (to / from).powf(f64::from(k) / 19.0)).collect();
        for mode in [Mode::ShortAxis, Mode::LongAxis] {
            let mut compared = 0;
            for (spin, found) in spins.iter().zip(campbell(&body, mode, &spins)) {
                let Ok(column) = found else { continue };
                assert!(
                    (quasirigid::vec3::norm(column.equilibrium.omega) / spin - 1.0).abs() < 1e-9,
                    "{name}"
                );
                let ascending = |pair: &[[f64; 2]]| pair[0][1] <= pair[1][1];
                assert!(column.eigenvalues.windows(2).all(ascending), "{name}: {:?}", column.eigenvalues);
                let gap = difference(&body, mode, *spin, &column.eigenvalues).unwrap();
                assert!(gap < 1e-12, "{name} at {spin} rad/s: {gap:e}");
                compared += 1;
            }
            assert!(compared > 5, "{name}: {compared}");
        }
    }
}

/// A momentum wheel leaves slow spins about an axis across it without a steady state, and the others as they are.
#[test]
fn spins_without_a_steady_state_are_refused_one_by_one() {
    let body = wheeled([0.9, 0.4, 0.1]).body().unwrap();
    let found = campbell(&body, Mode::ShortAxis, &[5.0, 1e-4, -1.0, 0.0, f64::NAN, 5.0]);
    assert!(found[0].is_ok() && found[0] == found[5], "{:?}", found[0]);
    let error = |k: usize| match &found[k] {
        Err(CampbellError::Equilibrium(error)) => error,
        other => panic!("{k}: {other:?}"),
    };
    assert!(matches!(error(1), EquilibriumError::NotFound { .. }), "{}", error(1));
    for k in 2..5 {
        assert!(matches!(error(k), EquilibriumError::NoSpin { .. }), "{}", error(k));
    }
    assert!(campbell(&body, Mode::ShortAxis, &[]).is_empty());
}

proptest! {
    #![proptest_config(cases(24))]

    #[test]
    fn campbell_diagrams_of_random_bodies_have_the_eigenvalues_of_the_modes(assembly in assemblies(), inside in 0..3u8) {
        let mut assembly = assembly;
        if inside > 0 {
            assembly.rotors.push(flywheel([0.3, -0.8, 0.5], 1e-3, 0.004));
        }
        if inside > 1 {
            let speed = WheelSpeed::Constant { angular_momentum: 0.02 };
            assembly.wheels.push(Wheel { name: "wheel".into(), axis: [0.2, 0.5, -0.9], speed });
        }
        let body = assembly.body().unwrap();
        let lowest = quasirigid::reduction::frequencies(&body).unwrap()[0];
        let spins: Vec<f64> = [0.02, 0.1, 0.3, 0.6].iter().map(|share| share * lowest).collect();
        for mode in [Mode::ShortAxis, Mode::LongAxis] {
            for (spin, found) in spins.iter().zip(campbell(&body, mode, &spins)) {
                let Ok(column) = found else { continue };
                let Some(gap) = difference(&body, mode, *spin, &column.eigenvalues) else { continue };
                prop_assert!(gap < 1e-12, "{mode:?} {spin}: {gap:e}");
            }
        }
    }
}
