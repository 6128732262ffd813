//! Histories of the full system beside the reduced ones, events, and the verification of one by the other.

use quasirigid::dynamics::{Form, Method};
use quasirigid_io::model::{EvolveMethod, PartialEvolve, System};
use quasirigid_io::record::VerificationRecord;
use quasirigid_study::Study;
use quasirigid_study::settings::{PartialRun, PartialVerify};

use crate::support::{
    MODEL, carrier, column, example, expression, finished, fixed, follow, gravity, history, model, point,
    rotor, spinning, study, study_of, table, told_history, try_evolve, vector, whole_table,
};

#[test]
fn full_and_reduced_histories_of_a_soft_start_agree_once_the_vibrations_are_gone() {
    let rest = study(&model("", "displacements = \"rest\"", ""));
    let [full, reduced] = [System::Full, System::Reduced].map(|system| {
        let (found, said) = told_history(&rest, &table(system, &[0.0, 60.0]), PartialRun::default());
        let told = said.contains("THE DISSIPATED ENERGY MAY BE WRONG");
        assert!(found.holds() && told == (system == System::Reduced), "{said}");
        found.run.last.omega
    });
    for axis in 0..3 {
        assert!((full[axis] - reduced[axis]).abs() < 1e-6, "{full:?} {reduced:?}");
    }
}

#[test]
fn record_says_which_methods_took_turns() {
    let stiff =
        MODEL.replace("stiffness = 600.0", "stiffness = 6e6").replace("damping = 30.0", "damping = 6e3");
    let study = study(&(stiff + "systems = [\"full\", \"reduced\", \"rigid\"]\n"));
    let found = study.run(&PartialRun::default(), &mut ()).unwrap();
    let histories = &found.record.histories;
    assert!(found.holds);
    assert!(histories.iter().map(|history| &*history.system).eq(["full", "reduced", "rigid"]));
    let method = &histories[0].method;
    assert!(method.contains("explicit (DOP853)") && method.contains("implicit (Radau IIA"), "{method}");
}

/// Verification of some orders.
fn verified(
    study: &Study,
    orders: &[usize],
    halvings: Option<usize>,
    revolutions: Option<f64>,
) -> VerificationRecord {
    let plan =
        study.verification_plan(PartialVerify { orders: Some(orders.to_vec()), halvings, revolutions });
    study.verify(&plan, &mut ()).unwrap().unwrap()
}

#[test]
fn verify_finds_the_orders() {
    let found = verified(&study_of("three-masses"), &[1, 3, 5], None, None);
    assert!(found.reached);
    for (row, p) in found.orders.iter().zip([1.0, 3.0, 5.0]) {
        assert!((row.order.unwrap() - (p + 1.0)).abs() < 0.15, "p = {p}: {:?}", row.order);
        assert_eq!(row.errors.len(), 5);
    }
}

/// The whips of this example are stiff and damped beside the step of the explicit method, whose outputs between steps once broke the order.
#[test]
fn outputs_between_stiff_steps_are_as_good_as_the_steps() {
    let found = verified(&study_of("explorer1-stiff"), &[3], None, None);
    assert!(found.reached, "{found:?}");
}

/// The mean power of the average comes closer to that of the full system as ε²; without an average the reason is told.
#[test]
fn verify_proves_the_average() {
    let average = verified(&study_of("axial-mass"), &[3], Some(3), None).average.unwrap();
    assert!((average.order.unwrap() - 2.0).abs() < 5e-3 && average.reached, "{average:?}");
    assert_eq!(average.errors.len(), 4);
    let held = verified(&study_of("heavy-top"), &[1], Some(1), Some(1.0)).average_left_out.unwrap();
    assert!(held.contains("The average is left out: the average is of a free body"), "{held}");
}

/// A boom of 6 m on a stage that spins and wobbles.
const BOOM: &str = "\
[material.cfrp]
density = 1600
young = \"90 GPa\"
poisson = 0.3
[section.tube]
shape = \"tube\"
radius = \"15 mm\"
thickness = \"1 mm\"
[[beam]]
name = \"boom\"
nodes = { root = [0, 0, 1.5], tip = [0, 0, 7.5] }
lines = [[\"root\", \"tip\"]]
section = \"tube\"
material = \"cfrp\"
masses = [{ node = \"tip\", mass = 3.0 }]
rayleigh = { stiffness = \"1 ms\" }
attach = \"root\"
[initial]
angular_velocity = [0.0, 0.05, \"10 rpm\"]
displacements = \"rest\"
";

/// Free vibrations alone in the stiff part allow implicit steps of a third of a millisecond on curved paths: 15 000 of these.
#[test]
fn implicit_steps_on_a_beam_are_as_long_as_its_motion_allows() {
    let study = study(&(carrier(900.0, [1100.0, 1150.0, 300.0]) + BOOM));
    let [implicit, explicit] = [Method::Implicit, Method::Explicit].map(|method| {
        let settings =
            PartialRun { tolerance: Some(1e-10), integrator: Some(method), ..PartialRun::default() };
        history(&study, &table(System::Full, &[0.0, 0.5]), settings).run
    });
    assert!(implicit.work.steps < 400, "{}", implicit.work.steps);
    let [a, b] = [implicit.last.omega, explicit.last.omega];
    assert!(a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 1e-9), "{a:?} {b:?}");
}

/// Panels on soft hinges, thrown far by the spin: their paths hold no further, and an angle of 12 degrees is told as such.
#[test]
fn panels_thrown_far_end_the_full_system_in_words() {
    let soft = example("solar-panels")
        .replace("stiffness = 900.0", "stiffness = 5.0")
        .replace("angle = \"5 deg\", rate = \"4 rpm\"", "angle = \"40 deg\", rate = \"12 rpm\"");
    let said = left_range(&study(&soft), 1.0);
    assert!(said.contains("beyond the 20.0 % to which its paths hold"), "{said}");
    assert!(said.contains("\"north\" node") || said.contains("\"south\" node"), "{said}");
}

/// The words of a history of the full system that leaves the range of its equations.
fn left_range(study: &Study, duration: f64) -> String {
    let found = follow(study, System::Full, &[0.0, duration]);
    assert!(!found.holds() && found.status == "left-validity", "{}", found.message);
    found.message
}

const SWINGING: &str = "\
[carrier]
mass = 40.0
center_of_mass = [0.0, 0.1, 0.0]
inertia = [9.0, 13.0, 16.0]
[[hinged]]
name = \"boom\"
mass = 0.5
center_of_mass = [1.2, 0.1, 0.3]
inertia = [0.01, 0.08, 0.08]
hinge = [0.8, 0.1, 0.3]
axes = [[0.0, 1.0, 0.0]]
stiffness = 0.01
damping = 0.001
places = { tip = [1.6, 0.1, 0.3] }
[initial]
angular_velocity = [0.5, 0.0, 0.6]
[initial.displacements]
boom = [\"10 deg\"]
";

/// Hinges turn to any angle in the full system: a boom that swings far is followed, and nothing drifts.
#[test]
fn a_hinge_that_turns_far_is_followed() {
    finished(&study(SWINGING), System::Full, &[0.0, 100.0]);
}

/// A spring at a place on a boom sees its displacement to first order: a boom that swings far is followed no further.
#[test]
fn a_hinge_with_a_spring_that_turns_far_ends_the_full_system_in_words() {
    let spring =
        "[[spring]]\nfrom = \"carrier\"\nto = { part = \"boom\", node = \"tip\" }\nstiffness = 1e-4\n";
    let said = left_range(&study(&format!("{SWINGING}{spring}")), 100.0);
    assert!(said.contains("\"boom\" turned on its hinge by"), "{said}");
    assert!(said.contains("beyond the 17.2 degrees to which the springs at places on it hold"), "{said}");
}

/// A flap on three axes, thrown into the gimbal lock of its hinge.
const GIMBAL: &str = "\
[carrier]
mass = 100
center_of_mass = [0, 0, 0]
inertia = [18.7972, 22.9428, 32.9804]
[[hinged]]
name = \"flap\"
mass = 1.34909
center_of_mass = [0.502087, 0.257969, 0.514757]
inertia = [0.00866766, 0.00824693, 0.0104069]
hinge = [0.585211, 0.421882, 0.404354]
axes = [[-0.38891, -0.765069, -0.513243], [0.917229, -0.269391, -0.29346], [0.0862544, -0.584891, 0.806512]]
stiffness = [0.0667958, 0.0736594, 0.0624067]
damping = [0.029424, 0.0308987, 0.0284408]
[initial]
wobble = { angle = \"25 deg\", rate = 0.985933, mode = \"short-axis\" }
";

/// Three axes that come into one plane give no rates: the history ends there in words, and `evolve` tells the reason.
#[test]
fn a_hinge_in_gimbal_lock_ends_the_full_system_in_words() {
    let study = study(GIMBAL);
    let said = left_range(&study, 20.0);
    assert!(said.contains("\"flap\" came to the gimbal lock of its hinge"), "{said}");
    let t: f64 = said.rsplit("t = ").next().and_then(|end| end.split(' ').next()).unwrap().parse().unwrap();
    assert!((9.5..9.75).contains(&t), "{t}"); // the middle axis is at 90 degrees at 9.745 s
    let asked = |asked: &mut PartialEvolve| asked.method = Some(EvolveMethod::Full);
    let said = try_evolve(&study, asked).map_or_else(|refused| refused, |found| found.record.message);
    assert!(said.contains("gimbal lock"), "{said}");
}

#[test]
fn a_formula_that_fails_ends_the_run_where_it_fails() {
    let force = expression("on = \"tip\"\nforce = [\"1e-30*sqrt(20 - t)\", \"0\", \"0\"]");
    let study = study(&model(&force, "", ""));
    for system in [System::Full, System::Reduced] {
        let found = follow(&study, system, &[0.0, 10.0, 19.0, 30.0]);
        assert!(!found.holds());
        let (_, reached) = found.message.split_once("not finite numbers beyond t = ").expect(&found.message);
        let reached: f64 = reached.split(' ').next().unwrap().parse().unwrap();
        assert!((19.99..=20.0).contains(&reached), "{system:?}: {}", found.message);
        for column in &found.columns {
            assert_eq!(column.values.len(), 3, "the table is valid up to there");
            assert!(column.values.iter().all(|value| value.is_finite()));
        }
    }
}

/// The derivatives of the root grow without bound before it ends: the truncated series runs away, and is stopped.
#[test]
fn a_series_that_runs_away_is_stopped() {
    let force = expression("on = \"tip\"\nforce = [\"sqrt(1 - t/20)\", \"0\", \"0\"]");
    let found = follow(&study(&model(&force, "", "")), System::Reduced, &[0.0, 10.0, 30.0]);
    assert!(!found.holds() && found.status == "left-validity", "{}", found.message);
}

#[test]
fn an_event_ends_the_run_and_is_no_failure() {
    let free = study(MODEL);
    let [start, end] = [0.0, 10_000.0].map(|t| follow(&free, System::Reduced, &[t]).run.last.energy);
    let mark = 0.5 * (start + end);
    let stop = study(&model("", "", &format!("stop = {{ energy = \"{mark} J\" }}\n")));
    let found = follow(&stop, System::Reduced, &[10_000.0]);
    assert!(found.holds() && found.status == "event", "{}", found.message);
    assert!((found.run.last.energy / mark - 1.0).abs() < 1e-13);
}

#[test]
fn forces_move_a_body_that_does_not_turn() {
    let top = model(&(fixed([0.0; 3]) + &gravity([0.0, 0.0, -9.81])), "", "");
    let last = finished(&study(&top), System::Full, &[0.0, 2.0]).run.last;
    let balance = last.energy_drift / last.work;
    assert!(balance.abs() < 1e-9, "what gravity does goes into energy and dashpots: {balance:e}");
    assert!(last.momentum_drift < 1e-9);
    let still = study(&top.replace("[0.12, 0.035, 0.02]", "[0, 0, 0]"));
    let [full, reduced] = [System::Full, System::Reduced].map(|system| {
        let found = finished(&still, system, &[0.0, 1.0, 2.0]);
        assert!(found.columns.iter().flat_map(|column| &column.values).all(|value| value.is_finite()));
        found.run.last.omega[0]
    });
    assert!(full > 0.5 && (full - reduced).abs() < 1e-3, "{full} {reduced}");
}

#[test]
fn coordinates_and_displacements_of_the_full_system_are_columns_of_the_table() {
    let study = study(&model("", "displacements = { tip = [0.01, 0, 0] }", ""));
    let table = whole_table(System::Full, &[0.0, 1.0, 30.0]);
    let columns = history(&study, &table, PartialRun::default()).columns;
    let displacement = column(&columns, "tip x");
    assert_eq!(displacement[0], 0.01);
    assert!(displacement[1].abs() > 1e-6 && displacement[2].abs() < 1e-4, "{displacement:?}");
    assert_eq!(column(&columns, "tip z rate").len(), 3);
    for axis in ["x", "y", "z"] {
        let [along, alone] = [format!("tip along {axis}"), format!("tip {axis}")];
        assert_eq!(column(&columns, &along), column(&columns, &alone));
    }
}

/// Nearly no damping, and a loose tolerance: the loss in the dashpots drowns in the integrator's error.
#[test]
fn an_integrator_that_imitates_the_dashpots_is_called_out() {
    let table = table(System::Full, &[0.0, 600.0]);
    let loose = PartialRun { tolerance: Some(1e-4), ..PartialRun::default() };
    let (_, note) = told_history(&study(&MODEL.replace("damping = 30.0", "damping = 1e-6")), &table, loose);
    assert!(
        note.contains("The integrator changed the energy") && note.contains("smaller tolerance"),
        "{note}"
    );
    let (tight, said) = told_history(&study(MODEL), &table, PartialRun::default());
    assert!(tight.holds() && said.is_empty(), "{said}");
}

/// A wheel that the spin does not slave turns with the body at the start, also where `displacements` are given: the energy is that
/// of the frozen body, `½ ω·Jω`, and not that of a series without meaning there.
#[test]
fn what_the_spin_does_not_slave_turns_with_a_displaced_body() {
    let wheel = carrier(30.0, [12.0, 14.0, 18.0]) + &rotor("wheel", [1.0, 0.0, 0.0], 1.0, 0.1);
    let start = spinning([0.2, 0.2, 0.4]);
    let energy = 0.5 * (12.0 * 0.04 + 14.0 * 0.04 + 18.0 * 0.16);
    let momentum = (12.0_f64 * 0.2).hypot(14.0 * 0.2).hypot(18.0 * 0.4);
    for displacements in ["\"rest\"", "\"slow-manifold\""] {
        let study = study(&format!("{wheel}{start}displacements = {displacements}\n"));
        let columns = follow(&study, System::Full, &[0.0, 1.0]).columns;
        let [found, K] = ["energy", "momentum"].map(|name| column(&columns, name)[0]);
        assert!((found / energy - 1.0).abs() < 1e-9 && (K / momentum - 1.0).abs() < 1e-9, "{found} {K}");
    }
}

/// Shares of the dissipators in the full history, nearly equal to those of the reduced one.
#[test]
fn histories_hold_the_shares_of_dissipators() {
    let study = study_of("three-masses");
    let [full, reduced] = [System::Full, System::Reduced].map(|system| {
        let budget = follow(&study, system, &[0.0, 20.0]).budget;
        let sum: f64 = budget.iter().map(|(_, energy)| energy).sum();
        budget.into_iter().map(|(name, energy)| (name, energy / sum)).collect::<Vec<_>>()
    });
    assert_eq!(full.len(), 6);
    for ((name, share), (other_name, other)) in full.iter().zip(&reduced) {
        assert!(name == other_name && (share - other).abs() < 0.02, "{name}: {share} {other}");
    }
}

/// Observed periods are those of the motion that a history starts.
#[test]
fn observed_periods_start_a_history() {
    let columns = follow(&study_of("apophis"), System::Reduced, &[0.0, 946_800.0]).columns;
    let [start, after] = [0, 1].map(|row| vector(&columns, crate::support::SPIN, row));
    for axis in 0..3 {
        assert!((start[axis] - after[axis]).abs() < 1e-8 * 6.4e-5, "{start:?} {after:?}"); // 263 h later
    }
}

/// A soft mast whose dissipation holds at the sixth order, not at the default one.
fn soft_mast(stiffness: f64) -> String {
    carrier(100.0, [30.0, 36.0, 10.0])
        + &point("tip", 1.0, [0.1, -0.2, 1.5], [stiffness, 0.1])
        + "[initial]\nwobble = { angle = \"12 deg\", rate = 1, mode = \"short-axis\" }\n"
}

/// A motion is followed at the order that holds unless one is asked for; that one says first that its dissipation is doubtful, or is not that
/// of the body.
#[test]
fn order_is_the_one_whose_dissipation_holds() {
    let dissipated = |stiffness: f64, system: System, order: Option<usize>| {
        let study = crate::support::of_order(&soft_mast(stiffness), order);
        let (found, said) = told_history(&study, &table(system, &[0.0, 500.0]), PartialRun::default());
        (found.run.last.dissipated, said, found.holds())
    };
    let (full, ..) = dissipated(80.0, System::Full, None);
    let (own, said, holds) = dissipated(80.0, System::Reduced, None);
    assert!((own / full - 1.0).abs() < 2e-3 && holds, "{own} {full}");
    assert!(said.contains("of order 6: at order 3, the default, dissipation or rates do not hold"), "{said}");
    let (third, said, holds) = dissipated(80.0, System::Reduced, Some(3));
    assert!((third / full - 1.0).abs() > 0.04 && holds, "{third} {full}");
    assert!(said.contains("Their dissipation is at the edge of its range at this order."), "{said}");
    let (_, said, holds) = dissipated(50.0, System::Reduced, None);
    assert!(!holds && said.contains("Their dissipation DOES NOT at this order."), "{said}");

    let weak = "[[force]]\nkind = \"torque\"\ntorque = [1e-5, 0.0, 2e-5]\nperiod = 3.0\n";
    let forced = |system: System, form: Option<Form>| {
        let asked = PartialRun { form, ..PartialRun::default() };
        let (found, said) =
            told_history(&study(&(soft_mast(80.0) + weak)), &table(system, &[0.0, 500.0]), asked);
        (found.run.last.dissipated, said)
    };
    let (driven, _) = forced(System::Full, None);
    let (own, said) = forced(System::Reduced, None);
    assert!((own / driven - 1.0).abs() < 2e-3, "{own} {driven}");
    assert!(said.contains("The torque-free part of the reduced equations is of order 6"), "{said}");
    let (_, said) = forced(System::Reduced, Some(Form::AngularVelocity));
    assert!(!said.contains("torque-free part"), "{said}");

    let long = PartialRun { duration: Some(500.0), ..PartialRun::default() };
    let run = study(&soft_mast(80.0)).run(&long, &mut ()).unwrap();
    assert!(run.holds && run.record.reduction.order == 6);
    assert!(run.record.notes.iter().any(|note| note.contains("The reduced equations are of order 6")));
    let taken = run.record.histories[0].dissipated;
    assert!((taken / full - 1.0).abs() < 2e-3, "{taken} {full}");
}
