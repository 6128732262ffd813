//! Switches of a force by the motion that hold the body where they switch: the run ends in words at the time at which a constant force brings it there,
//! in every system and by both integrators; with a width the force is the one that holds the body, by Euler's equations. (Z7)

use quasirigid::dynamics::{Method, Missed, Outcome};
use quasirigid_io::model::System;
use quasirigid_study::settings::PartialRun;

use crate::support::{close, expression, history, study, table};

/// Rate about `z` (rad/s) at which the torque switches, and the torque (N m).
const RATE: f64 = 0.06;
const TORQUE: f64 = 0.05;
const INERTIA: [[f64; 3]; 3] = [[30.0, 1.0, 0.5], [1.0, 36.0, -0.7], [0.5, -0.7, 42.0]];

/// A carrier with a damped point, in units so many times as small as metre, kilogram and second, under a torque about `z`.
fn model([length, mass, time]: [f64; 3], torque: &str) -> String {
    let inertia = INERTIA.map(|row| row.map(|entry| entry * mass * length * length));
    let place = [0.5, 0.1, 0.4].map(|x| x * length);
    let rate = [0.02, 0.03, 0.05].map(|w| w / time);
    format!(
        "[carrier]\nmass = {}\ncenter_of_mass = [0, 0, 0]\ninertia = {inertia:?}\n\
         [[point]]\nname = \"d\"\nmass = {mass}\nposition = {place:?}\n\
         [[spring]]\nfrom = \"d\"\nto = \"carrier\"\nstiffness = {}\ndamping = {}\n\
         [initial]\nangular_velocity = {rate:?}\n{}",
        60.0 * mass,
        400.0 * mass / (time * time),
        20.0 * mass / time,
        expression(&format!("torque = [\"0\", \"0\", \"{torque}\"]"))
    )
}

/// Torque about `z` that keeps `wz`: `(J⁻¹(M e_z − ω × Jω))_z = 0` with the point where it is, at its recoil `mM/(m + M)`.
fn holding([wx, wy, wz]: [f64; 3]) -> f64 {
    let recoil = 60.0 / 61.0;
    let r = [0.5_f64, 0.1, 0.4];
    let square: f64 = r.iter().map(|x| x * x).sum();
    let J: [[f64; 3]; 3] = std::array::from_fn(|i| {
        std::array::from_fn(|j| INERTIA[i][j] + recoil * (f64::from(u8::from(i == j)) * square - r[i] * r[j]))
    });
    let L = J.map(|row| row[0] * wx + row[1] * wy + row[2] * wz);
    let gyroscopic = [wy * L[2] - wz * L[1], wz * L[0] - wx * L[2], wx * L[1] - wy * L[0]];
    // the row of the inverse that belongs to z, by cofactors; its determinant cancels
    let cofactor = |a: usize, b: usize| {
        let rows = [(a + 1) % 3, (a + 2) % 3];
        let columns = [(b + 1) % 3, (b + 2) % 3];
        J[rows[0]][columns[0]] * J[rows[1]][columns[1]] - J[rows[0]][columns[1]] * J[rows[1]][columns[0]]
    };
    (0..3).map(|axis| cofactor(2, axis) * gyroscopic[axis]).sum::<f64>() / cofactor(2, 2)
}

#[test]
fn a_body_that_slides_along_a_switch_ends_its_run_in_words() {
    let by = |method| PartialRun { integrator: Some(method), ..PartialRun::default() };
    for (unit, systems) in [([1.0; 3], 5), ([1e3, 3e-5, 70.0], 3)] {
        let [length, mass, time] = unit;
        let (rate, torque) = (RATE / time, mass * (length / time).powi(2));
        let switched = study(&model(unit, &format!("{}*step({rate}-wz)", TORQUE * torque)));
        for (system, settings) in [
            (System::Full, by(Method::Explicit)),
            (System::Full, by(Method::Implicit)),
            (System::Reduced, PartialRun::default()),
            (System::Rigid, PartialRun::default()),
            (System::Rigid, PartialRun { tolerance: Some(1e-8), ..PartialRun::default() }),
        ]
        .into_iter()
        .take(systems)
        {
            let found = history(&switched, &table(system, &[0.0, 100.0 * time]), settings);
            let told = format!("{system:?} {unit:?}: {} {}", found.status, found.message);
            assert!(!found.holds() && found.status == "sliding", "{told}");
            assert!(found.message.contains("force 1") && found.message.contains("tanh(x/width)"), "{told}");
            let work = found.run.work;
            assert!(work.steps + work.rejected < 20_000, "{told} {work:?}");
            let Outcome::Missed(Missed::Slides { t, .. }) = found.run.outcome else { panic!("{told}") };
            close(found.run.last.omega[2] * time, RATE, 1e-6);
            // the constant torque brings the body there, some fifty short steps before
            let constant = study(&model(unit, &format!("{}", TORQUE * torque)));
            let there = history(&constant, &table(system, &[0.0, t]), PartialRun::default());
            let excess = there.run.last.omega[2] * time / RATE - 1.0;
            assert!(excess > -1e-6 && excess < 5e-3, "{told} {excess}");
        }
    }
}

/// The same switch with a width is followed, and its torque is the one that holds the rate but for what the rate still gains within the width.
#[test]
fn a_switch_with_a_width_is_followed() {
    let study = study(&model([1.0; 3], "0.025*(1 + tanh((0.06-wz)/1e-6))"));
    for system in [System::Full, System::Reduced, System::Rigid] {
        let found = history(&study, &table(system, &[0.0, 9.5]), PartialRun::default());
        assert!(found.holds() && found.status == "finished", "{}", found.message);
        let omega = found.run.last.omega;
        let torque = 0.025 * (1.0 + ((RATE - omega[2]) / 1e-6).tanh());
        close(torque, holding(omega), 0.01);
    }
}

/// A torque that turns the body back wherever it is does not hold it: it swings through the switch, with the period `4 √(2θJ/M)`.
#[test]
fn a_body_that_swings_through_a_switch_is_followed() {
    let start = "[carrier]\nmass = 60\ncenter_of_mass = [0, 0, 0]\ninertia = [30, 36, 42]\n\
        [initial]\nangular_velocity = [0, 0, 0.05]\n";
    let force = expression("torque = [\"0\", \"0\", \"0.42*(1 - 2*step(qz))\"]");
    // through zero at 0.05 rad/s: back after 2 · 0.05 · 42/0.42 = 10 s
    let found = history(
        &study(&(start.to_owned() + &force)),
        &table(System::Rigid, &[0.0, 10.0, 20.0, 402.5]),
        PartialRun::default(),
    );
    assert!(found.holds() && found.status == "finished", "{}", found.message);
    // forty times through the switch, each located within the tolerance
    close(found.run.last.omega[2], 0.025, 1e-7);
}
