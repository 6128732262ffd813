//! Tables of forces, the support, the start and the run.

use super::choice::below;
use super::formula::formula;
use super::model::Draft;

pub fn force(d: &mut Draft<'_, '_>) {
    d.head("[[force]]");
    let kind = d.pick(&[
        "uniform-gravity",
        "central-gravity",
        "drag",
        "spin-drag",
        "torque",
        "thrust",
        "magnetic-dipole",
        "eddy-current",
        "expression",
    ]);
    d.line("kind", &format!("\"{kind}\""));
    if matches!(kind, "drag" | "thrust" | "expression") {
        let on = d.end();
        d.line("on", &on);
        if d.chance(100) {
            d.draw("at", |n| n.vector(0.5));
        }
    }
    match kind {
        "uniform-gravity" => {
            d.draw("acceleration", |n| n.vector(9.81));
        }
        "central-gravity" => orbit(d),
        "drag" | "spin-drag" => {
            d.draw("coefficient", |n| n.near(1e-3));
        }
        "torque" | "thrust" => {
            let vector = d.numbers.vector(0.05);
            d.line(if kind == "torque" { "torque" } else { "force" }, &vector);
            d.word("axes", &["body", "inertial"]);
            if d.chance(80) {
                let (key, value) = (d.pick(&["frequency", "period"]), d.numbers.near(2.0));
                d.line(key, &value);
            }
        }
        "magnetic-dipole" => {
            d.draw("moment", |n| n.vector(0.2));
            field(d);
        }
        "eddy-current" => {
            if d.chance(128) {
                d.draw("tensor", |n| n.near(1e3));
            } else {
                d.draw("conductivity", |n| n.near(2e7));
                d.word("shape", &["sphere", "shell"]);
                d.draw("radius", |n| n.near(0.3));
                if d.chance(128) {
                    d.draw("thickness", |n| n.near(0.02));
                }
            }
            field(d);
        }
        _ => {
            let each: Vec<String> = (0..3).map(|_| format!("\"{}\"", formula(d.numbers.u))).collect();
            d.line("force", &format!("[{}]", each.join(", ")));
        }
    }
}

fn field(d: &mut Draft<'_, '_>) {
    if d.chance(128) {
        d.draw("field", |n| n.vector(3e-5));
        return;
    }
    d.line("dipole", "[0, 3e14, 7.8e15]");
    if d.chance(128) {
        d.draw("dipole_rate", |n| n.near(7.3e-5));
    }
    orbit(d);
}

fn orbit(d: &mut Draft<'_, '_>) {
    let (axis, eccentricity) = (d.numbers.near(7e6), d.numbers.near(0.1));
    d.line("orbit", &format!("{{ body = \"Earth\", semi_major_axis = {axis}, eccentricity = {eccentricity}, inclination = \"51 deg\" }}"));
}

/// The support, the start and the run.
pub fn settings(d: &mut Draft<'_, '_>) {
    support(d);
    initial(d);
    run(d);
    if d.chance(20) {
        d.head("[uncertainty]");
        let (low, high) = (d.numbers.near(20.0), d.numbers.near(80.0));
        d.line("\"carrier.mass\"", &format!("{{ uniform = [{low}, {high}] }}"));
    }
}

fn support(d: &mut Draft<'_, '_>) {
    match below(d.numbers.u, 8) {
        0 => {
            let point = d.numbers.vector(0.3);
            d.text += &format!("[support]\nkind = \"fixed-point\"\npoint = {point}\n");
        }
        1 => {
            let (point, acceleration) = (d.numbers.vector(0.3), formula(d.numbers.u));
            d.text += &format!(
                "[support]\nkind = \"prescribed\"\npoint = {point}\nacceleration = [\"{acceleration}\", \"0\", \"0.3*cos(2*t)\"]\n"
            );
        }
        _ => {}
    }
}

fn initial(d: &mut Draft<'_, '_>) {
    d.head("[initial]");
    match below(d.numbers.u, 4) {
        0 | 1 => {
            d.draw("angular_velocity", |n| n.vector(0.5));
        }
        2 => {
            let (angle, rate, mode) =
                (d.numbers.near(0.1), d.numbers.near(0.5), d.pick(&["short-axis", "long-axis", "SAM"]));
            d.line("wobble", &format!("{{ angle = {angle}, rate = {rate}, mode = \"{mode}\" }}"));
        }
        _ => {
            let (rotation, precession) = (d.numbers.near(3e4), d.numbers.near(9e4));
            d.line(
                "periods",
                &format!("{{ rotation = {rotation}, precession = {precession}, mode = \"long-axis\" }}"),
            );
        }
    }
    if d.chance(60) {
        d.line("displacements", "\"rest\"");
    } else if d.chance(60) && !d.names.is_empty() {
        let (name, displacement) = (d.names[0].clone(), d.numbers.vector(0.01));
        d.line("displacements", &format!("{{ {name} = {displacement} }}"));
    }
    if d.chance(40) {
        d.line("attitude", "[0.5, 0.5, -0.5, 0.5]");
    }
}

fn run(d: &mut Draft<'_, '_>) {
    d.head("[run]");
    d.draw("order", |n| n.count(4));
    d.draw("duration", |n| n.near(60.0));
    if d.chance(60) {
        let (key, value) =
            (d.pick(&["samples", "tolerance", "integrator", "form", "systems"]), d.numbers.near(1e-9));
        let word = d.pick(&["\"full\"", "[\"full\", \"reduced\"]", "\"automatic\"", "100", "[]"]).to_owned();
        let value = if d.chance(128) { value } else { word };
        d.line(key, &value);
    }
    if d.chance(60) {
        let (revolutions, halvings) = (d.numbers.near(2.0), d.numbers.count(4));
        d.line(
            "verify",
            &format!("{{ revolutions = {revolutions}, orders = [1, 2], halvings = {halvings} }}"),
        );
    }
    if d.chance(60) {
        let until = d.pick(&["\"98% of I3\"", "\"5 deg\"", "0.9", "\"-3 deg\"", "2", "\"90 deg\""]);
        d.line("evolve", &format!("{{ until = {until} }}"));
    }
    if d.chance(40) {
        let degree = d.numbers.count(5);
        d.line("spin_manifold", &format!("{{ degree = {degree}, masters = \"automatic\" }}"));
    }
}
