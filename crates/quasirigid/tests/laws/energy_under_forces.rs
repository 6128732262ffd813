//! Energy form under forces: what a cut-off series does not balance is no larger than what the forces do. (E6)

use proptest::prelude::*;
use quasirigid::dynamics::{
    Forced, Options, Outcome, Sample, SlowEquations, SlowState, Start, propagate, propagate_forced,
};
use quasirigid::expression::Expression;
use quasirigid::model::force::{Axes, Force, ForceLaw, Wave};
use quasirigid::model::{FlexibleBody, Marker, Support};
use quasirigid::reduction::{Vibrations, reduce};
use quasirigid_math::rotation::ALIGNED;
use quasirigid_math::sym3::times;
use quasirigid_math::vec3::{add, norm, scale};

use crate::support::rotors::flywheel;
use crate::support::{bodies, cases, vector};

const STILL: SlowState =
    SlowState { angular_momentum: [0.0; 3], attitude: ALIGNED, place: [0.0; 3], velocity: [0.0; 3] };

fn torque(torque: [f64; 3], axes: Axes, frequency: f64) -> Force<Marker> {
    Force {
        name: String::new(),
        law: ForceLaw::Torque { torque, axes, wave: Wave { frequency, phase: 0.4 } },
    }
}

/// Last samples of a run by the energy form and by the series alone, and the first energy.
fn both(
    body: &FlexibleBody,
    forces: &[Force<Marker>],
    order: usize,
    omega: [f64; 3],
    end: f64,
) -> [Sample; 2] {
    let system = Forced { body, forces };
    let above = reduce(body, order + 1).unwrap();
    [SlowEquations::energy_form(system, order, Some(&above)), SlowEquations::series(system, order)].map(
        |equations| {
            let start = equations.state(STILL, omega).unwrap();
            assert!(
                norm(add(equations.angular_velocity(&start).unwrap(), scale(-1.0, omega)))
                    < 1e-9 * norm(omega)
            );
            let run =
                propagate_forced(equations, &start, &[end], &Options::default(), &mut Vec::new()).unwrap();
            assert_eq!(run.outcome, Outcome::Finished);
            run.last
        },
    )
}

proptest! {
    #![proptest_config(cases(5))]

    /// The imbalance of the energy is in proportion to the forces: a hundredth of the force, a hundredth of it.
    #[test]
    fn imbalance_is_in_proportion_to_the_forces(assembly in bodies(), p in 2..5usize, u in vector()) {
        let body = assembly.body().unwrap();
        let frequency = Vibrations::compute(&body).unwrap().frequencies[0];
        let omega = scale(0.1 * frequency / norm(u), u);
        let K = times(body.invariants().J, omega);
        let end = 30.0 / norm(omega);
        let [strong, weak] = [1e-4, 1e-6].map(|weakness| {
            let strength = weakness * norm(K) * norm(omega);
            let forces = [
                torque([0.6 * strength, -0.5 * strength, 0.7 * strength], Axes::Body, 0.0),
                torque([-0.2 * strength, 0.9 * strength, 0.3 * strength], Axes::Inertial, 0.3 * norm(omega)),
            ];
            both(&body, &forces, p, omega, end)
        });
        let of = |sample: &Sample| sample.energy_drift.abs() / sample.energy;
        println!("p {p} {:?} form {:e} {:e} series {:e} {:e}", body.support(), of(&strong[0]), of(&weak[0]), of(&strong[1]), of(&weak[1]));
        prop_assert!(of(&strong[0]) <= 1e-4 * 1e-2);
        prop_assert!(of(&weak[0]) <= 2e-2 * of(&strong[0]) + 1e-13);
    }
}

/// Without a force under forces, free, held or driven without acceleration, with a rotor inside: the run is that of the torque-free equations.
#[test]
fn forces_of_no_strength_leave_the_energy_form() {
    let zero = || Expression::parse("0", &["t"]).unwrap();
    let point = [0.2, -0.1, 0.3];
    let driven = Support::Prescribed {
        point,
        acceleration: [zero(), zero(), zero()],
        velocity: [0.0; 3],
        position: [0.0; 3],
    };
    for support in [Support::Free, Support::FixedPoint { point }, driven] {
        let mut assembly = super::wobbler::assembly();
        assembly.rotors.push(flywheel([0.2, 0.9, -0.3], 0.02, 0.7));
        assembly.support = support;
        let body = assembly.body().unwrap();
        let forces = [torque([0.0; 3], Axes::Inertial, 0.7)];
        let (omega, end) = ([0.5, 0.3, -0.9], 40.0);
        let [form, _] = both(&body, &forces, 3, omega, end);
        let above = reduce(&body, 4).unwrap();
        let mut samples: Vec<Sample> = Vec::new();
        propagate(&above, Start::new(omega, ALIGNED), &[end], &Options::default(), &mut samples).unwrap();
        let gap = norm(add(form.omega, scale(-1.0, samples[0].omega)));
        println!("{:?}: {gap:e} {:e} of {:e}", body.support(), form.energy_drift, form.dissipated);
        assert!(gap < 1e-8 * norm(omega), "{:?}: {gap:e}", body.support());
        assert!(form.energy_drift.abs() < 1e-9 * form.dissipated, "{form:?}");
        assert!((form.dissipated / samples[0].dissipated - 1.0).abs() < 1e-8);
    }
}

/// A body of light damping that the series alone drives away from its balance by a tenth of what it dissipates in a weak field of force.
#[test]
fn light_damping_is_not_lost_in_weak_forces() {
    let mut assembly = super::wobbler::assembly();
    for spring in &mut assembly.springs {
        spring.law = quasirigid::elements::SpringLaw::Spatial {
            stiffness: quasirigid::elements::Coefficient::Diagonal([60.0, 90.0, 75.0]),
            damping: quasirigid::elements::Coefficient::Isotropic(1.5e-3),
        };
    }
    assembly.hinged.clear();
    let body = assembly.body().unwrap();
    let forces = [torque([1e-9, -2e-9, 3e-9], Axes::Inertial, 0.2)];
    let [form, series] = both(&body, &forces, 3, [1.9, 0.9, -2.1], 60.0);
    println!("{:e} {:e} of {:e}", form.energy_drift, series.energy_drift, form.dissipated);
    assert!(form.energy_drift.abs() < 1e-5 * form.dissipated, "{form:?}");
    assert!(series.energy_drift.abs() > 1e-2 * series.dissipated, "{series:?}");
}
