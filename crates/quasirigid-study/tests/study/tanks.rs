//! Partly full tanks of a model: the answer of `check`, what is told first, and the same liquid in every answer.

use quasirigid::elements::SettledTank;
use quasirigid_io::model::System;
use quasirigid_study::Study;

use crate::support::{
    carrier, close, evolve, finished, fixed, gravity, modes, numbers, spinning, study, until,
};

/// A tank half as deep in liquid as it is wide, under a weight along −z.
fn upright(lines: &str) -> String {
    format!(
        "[[tank]]\nname = \"fuel\"\nshape = \"cylinder\"\nradius = 0.3\nheight = 0.6\ncenter = [0, 0, 0.5]\nfill = 0.5\n\
         density = 900\nkinematic_viscosity = \"1 cSt\"\nsurface_tension = 0.02\n{lines}"
    )
}

/// A ball, a third full, far from the axis of the spin.
fn flung(lines: &str) -> String {
    format!(
        "[[tank]]\nname = \"ball\"\nshape = \"sphere\"\nradius = 0.15\ncenter = [2, 0, 0.1]\nfill = 0.35\n\
         density = 1000\nkinematic_viscosity = \"1 cSt\"\nsettled_by = \"spin\"\n{lines}"
    )
}

fn thrust(force: f64) -> String {
    format!(
        "[[force]]\nname = \"engine\"\nkind = \"thrust\"\non = \"carrier\"\nat = [0, 0, -1]\nforce = [0, 0, {force:?}]\n"
    )
}

const DOWN: &str = "settled_by = { acceleration = [0, 0, -0.4] }\n";
const INERTIA: [f64; 3] = [150.0, 160.0, 220.0];

fn hub() -> String {
    carrier(260.0, INERTIA)
}

fn only(study: &Study) -> &SettledTank {
    let [tank] = &study.tanks[..] else { panic!("one tank") };
    tank
}

/// Notes of a model that say that an answer may not hold.
fn doubts(model: &str) -> Vec<String> {
    let notes = study(model).model.notes;
    let doubts: Vec<String> = notes.iter().filter(|note| note.starts_with("MAY NOT HOLD")).cloned().collect();
    assert_eq!(notes[..doubts.len()], doubts[..], "doubts come first");
    doubts
}

/// (U1), (U3) in a cylinder as deep as its radius: `ξ tanh ξ`, mass ratio `2 tanh ξ/(ξ(ξ² − 1))`, height `−(2/ξ) tanh ξ/2` below the surface,
/// with `ξ = 1.841 183 781`.
#[test]
fn check_tells_the_slosh_of_tanks() {
    let study = study(&(hub() + &upright(DOWN) + &thrust(1.0) + &spinning([0.0, 0.0, 1e-4])));
    let answer = study.check().unwrap().json();
    let tank = &answer["tanks"][0];
    let mass = 900.0 * std::f64::consts::PI * 0.09 * 0.3;
    assert_eq!(tank["name"], "fuel");
    close(tank["fill"].as_f64().unwrap(), 0.5, 1e-12);
    close(tank["liquid_mass"].as_f64().unwrap(), mass, 1e-12);
    close(numbers(&tank["center_of_mass"])[2], 0.5 - 0.15, 1e-12);
    assert_eq!(tank["slosh"].as_array().unwrap().len(), 2);
    let xi = 1.841_183_781_340_66_f64;
    let first = |key: &str| tank["slosh"][0][key].as_f64().unwrap();
    let wavenumber = xi * xi.tanh() / 0.3;
    close(first("wavenumber"), wavenumber, 1e-8);
    close(first("frequency"), (0.4 * wavenumber).sqrt(), 1e-8);
    close(first("length"), wavenumber.recip(), 1e-8);
    close(first("mass"), mass * 2.0 * xi.tanh() / (xi * (xi * xi - 1.0)), 1e-8);
    close(first("height"), -0.6 / xi * (0.5 * xi).tanh(), 1e-8);
    let layer = (0.5e-6 / first("frequency")).sqrt() * 0.5;
    // the bottom adds nothing beside the wall where the depth is the radius
    close(first("damping_ratio"), layer * (xi * xi + 1.0) / (xi * xi - 1.0) / 0.3, 1e-6);
    let text = study.check().unwrap().text();
    assert!(text.contains("\"fuel\": 76.34 kg of liquid, 50.00 % of the tank"), "{text}");
}

/// The weight of displaced liquid needs the thrust as a force; on a support it needs gravity.
#[test]
fn the_cause_of_the_weight_is_asked_for() {
    let free = |force: &str| doubts(&(hub() + &upright(DOWN) + force + &spinning([0.0; 3])));
    let mass = 260.0 + 900.0 * std::f64::consts::PI * 0.09 * 0.3;
    assert_eq!(free(&thrust(0.4 * mass)), Vec::<String>::new());
    for lacking in [free(""), free(&thrust(0.3 * mass)), free(&gravity([0.0, 0.0, -0.4]))] {
        assert!(lacking.len() == 1 && lacking[0].contains("write the thrust as a [[force]]"), "{lacking:?}");
    }
    let held = |force: &str| {
        doubts(&(hub() + &fixed([0.0, 0.0, 2.0]) + &upright(DOWN) + force + &spinning([0.0; 3])))
    };
    assert_eq!(held(&gravity([0.0, 0.0, -0.4])), Vec::<String>::new());
    assert_eq!(held("").len(), 1);
}

/// A tank whose middle hangs in the pivot is a pendulum of its own: `ω² = g/L` of the sphere, whatever the carrier; and the carrier swings as
/// one body with the rest of the liquid, without the moment of the liquid that a sphere leaves behind.
#[test]
fn a_sphere_about_its_pivot_swings_alone() {
    let ball = "[[tank]]\nname = \"ball\"\nshape = \"sphere\"\nradius = 0.3\nfill = 0.5\ndensity = 1000\ndamping_ratio = 0\n\
                settled_by = { acceleration = [0, 0, -9.8] }\nmodes = 1\n";
    let hub = "[carrier]\nmass = 20.0\ncenter_of_mass = [0, 0, -0.2]\ninertia = [3.0, 4.0, 5.0]\n";
    let study =
        study(&(hub.to_owned() + &fixed([0.0; 3]) + ball + &gravity([0.0, 0.0, -9.8]) + &spinning([0.0; 3])));
    let tank = only(&study);
    let mut known = vec![(9.8 * tank.slosh[0].wavenumber).sqrt(); 2];
    // the second mode of a sphere and all others are in the rest, which then has a moment of its own about the pivot
    let rest =
        tank.liquid_mass * 0.4 * 0.09 - tank.drag[0] - tank.slosh[0].mass * tank.slosh[0].length.powi(2);
    let first = tank.liquid_mass * 0.375 * 0.3 - tank.slosh[0].mass * tank.slosh[0].length;
    let arm = 20.0 * 0.2;
    known.extend([3.0, 4.0].map(|moment: f64| (9.8 * (arm + first) / (moment + 20.0 * 0.04 + rest)).sqrt()));
    known.sort_by(f64::total_cmp);
    let modes = &modes(&study).spins[0].modes;
    let mut found: Vec<f64> = modes.iter().map(|mode| mode.frequency).filter(|rate| *rate > 0.0).collect();
    found.sort_by(f64::total_cmp);
    assert_eq!(found.len(), 4, "{found:?}");
    found.iter().zip(&known).for_each(|(found, known)| close(*found, *known, 1e-6));
}

/// A liquid that a spin settled is told at another spin.
#[test]
fn another_spin_is_told() {
    let body = hub() + &flung("");
    let with = study(&(body.clone() + &spinning([0.0, 0.0, 3.0])));
    let told = &with.model.notes[0];
    let names: Vec<&str> = with.body.coordinates().iter().map(|each| each.name.as_str()).collect();
    assert_eq!(names[..2], ["\"ball\" slosh 1 y", "\"ball\" slosh 1 z"]);
    assert!(with.model.notes.iter().any(|note| note.contains("known near this spin alone")), "{told}");
    let found = modes(&with);
    let [near, far] = [&found.spins[0], &found.spins[1]];
    assert!(!near.sentence.contains("another spin"), "{}", near.sentence);
    assert!(far.sentence.starts_with("MAY NOT HOLD, since the liquid of tank \"ball\""), "{}", far.sentence);
    let small =
        hub() + &upright("settled_by = { acceleration = [0, 0, -9.8] }\n") + &spinning([0.0, 1.0, 0.0]);
    assert!(doubts(&small).iter().any(|doubt| doubt.contains("neither its level nor its slosh follows")));
}

/// An evolution whose mean spin is not that of the start leaves the liquid where it did not settle, and does not hold; near it, it does.
#[test]
fn an_evolution_away_from_the_settled_spin_does_not_hold() {
    let from = |across: f64| evolve(&(hub() + &flung("") + &spinning([across, 0.0, 3.0]) + &until("1 deg")));
    let far = from(0.9).message;
    assert!(far.contains("DOES NOT HOLD: the mean spin of this evolution"), "{far}");
    let near = from(0.3).message;
    assert!(!near.contains("DOES NOT HOLD"), "{near}");
}

/// A spin about the axis of a tank presses the liquid outwards at the rim of its surface, `Ω²R/g`, whose middle it leaves alone; the layers of
/// a spin carry the liquid along in `R/√(νΩ)`.
#[test]
fn a_spin_about_the_axis_of_a_tank_is_told_by_its_rim() {
    let spun = |spin: f64| hub() + &upright(DOWN) + &thrust(134.6) + &spinning([0.0, 0.0, spin]);
    let rim = |share: f64| (share * 0.4 / 0.3).sqrt();
    assert_eq!(doubts(&spun(rim(0.0174))), Vec::<String>::new());
    let told = doubts(&spun(rim(0.0176)));
    assert!(
        told.len() == 1 && told[0].contains("presses the liquid of tank \"fuel\" with 1.8 %"),
        "{told:?}"
    );
    let carried = study(&spun(0.01)).model.notes;
    assert!(
        carried.iter().any(|note| note.contains("about the axis of the tank in about 50.00 min")),
        "{carried:?}"
    );
}

/// A slosh that is slow in the body is not the nutation, whose rate is that of the body with its liquid held.
#[test]
fn under_a_thrust_the_nutation_is_that_of_the_body() {
    let ball = "[[tank]]\nname = \"fuel\"\nshape = \"sphere\"\nradius = 0.2\ncenter = [0, 0, 0.6]\nfill = 0.16\ndensity = 1008\n\
                kinematic_viscosity = \"1 cSt\"\nsettled_by = { acceleration = [0, 0, -0.5] }\n";
    let study =
        study(&(carrier(260.0, [150.0, 150.0, 60.0]) + ball + &thrust(132.7) + &spinning([0.0, 0.0, 2.0])));
    let [across, _, along, ..] = study.body.invariants().J;
    let found = modes(&study);
    let nutation = found.spins[0].modes.iter().find(|mode| mode.nutation).unwrap();
    close(nutation.frequency, 2.0 * (1.0 - along / across), 1e-2); // the liquid moves it
    let slow = found.spins[0].modes.iter().find(|mode| mode.frequency < 0.5).unwrap();
    assert!(!slow.nutation && slow.frequency > 0.1, "{slow:?}");
}

/// Capillarity and thick layers are told, with what was assumed.
#[test]
fn small_bond_numbers_and_thick_layers_are_told() {
    let weak = upright("settled_by = { acceleration = [0, 0, -0.005] }\n");
    let weak = doubts(&(hub() + &weak + &thrust(1.68) + &spinning([0.0; 3])));
    assert!(weak.len() == 1 && weak[0].contains("Bond number") && !weak[0].contains("water"), "{weak:?}");
    let water =
        upright("settled_by = { acceleration = [0, 0, -0.005] }\n").replace("surface_tension = 0.02\n", "");
    let water = doubts(&(hub() + &water + &thrust(1.68) + &spinning([0.0; 3])));
    assert!(
        water.len() == 1 && water[0].contains("that of water") || water[0].contains("of water, 0.07"),
        "{water:?}"
    );
    let thick = upright(DOWN).replace("1 cSt", "1500 cSt");
    let thick = doubts(&(hub() + &thick + &thrust(134.6) + &spinning([0.0; 3])));
    assert!(thick.len() == 1 && thick[0].contains("is not thin"), "{thick:?}");
}

/// Energy and angular momentum of a spinning body with a tank: what the bobs' dashpots take is what the body loses.
#[test]
fn histories_carry_the_liquid() {
    let study = study(&(hub() + &flung("") + &spinning([0.2, 0.1, 3.0])).replace("[2, 0, 0.1]", "[2, 0, 0]"));
    let run = finished(&study, System::Full, &[0.0, 20.0]);
    let drift = &run.run.last;
    assert!(drift.energy.is_finite() && study.body.coordinates().len() == 4);
}
