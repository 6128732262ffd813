//! Tables of the carrier and of the elements on it, and of bodies without a carrier.

use super::choice::below;
use super::model::Draft;

pub fn carrier(d: &mut Draft<'_, '_>) {
    d.head("[carrier]");
    d.draw("mass", |n| n.near(40.0));
    d.draw("center_of_mass", |n| n.vector(0.1));
    let inertia = d.numbers.moments(12.0);
    let inertia = if d.chance(30) { "[[9, 0.5, 0], [0.5, 12, -1], [0, -1, 14]]".to_owned() } else { inertia };
    d.line("inertia", &inertia);
}

/// A body that is elastic throughout.
pub fn alone(d: &mut Draft<'_, '_>) {
    match below(d.numbers.u, 5) {
        0 | 1 => ellipsoid(d),
        2 => surface(d),
        3 => network(d),
        _ => (0..4).for_each(|_| point(d)),
    }
}

pub fn point(d: &mut Draft<'_, '_>) {
    d.head("[[point]]");
    let name = d.name("point");
    d.draw("mass", |n| n.near(1.0));
    d.draw("position", |n| n.vector(0.6));
    match below(d.numbers.u, 6) {
        0 => {
            let direction = d.numbers.direction();
            d.line("motion", &format!("{{ line = {direction} }}"));
        }
        1 => {
            let direction = d.numbers.direction();
            d.line("motion", &format!("{{ plane = {direction} }}"));
        }
        _ => {}
    }
    d.names.push(name.clone());
    if !d.chance(8) {
        d.head("[[spring]]");
        d.line("from", &format!("\"{name}\""));
        d.line("to", "\"carrier\"");
        law(d);
    }
}

pub fn spring(d: &mut Draft<'_, '_>) {
    d.head("[[spring]]");
    if d.chance(60) {
        d.name("spring");
    }
    let (from, to) = (d.end(), d.end());
    d.line("from", &from);
    d.line("to", &to);
    law(d);
}

fn law(d: &mut Draft<'_, '_>) {
    let axial = d.chance(40);
    if axial {
        d.line("axial", "true");
        match below(d.numbers.u, 4) {
            0 => {
                d.draw("anchor", |n| n.vector(0.3));
            }
            1 => {
                d.draw("tension", |n| n.signed(1.0));
            }
            2 => {
                d.draw("natural_length", |n| n.near(0.3));
            }
            _ => {}
        }
    }
    for (key, typical) in [("stiffness", 600.0), ("damping", 3.0)] {
        let value = match below(d.numbers.u, 5) {
            0 if !axial => d.numbers.triple(typical),
            1 if !axial => format!(
                "[[{0}, 0, 0], [0, {0}, {1}], [0, {1}, {0}]]",
                d.numbers.near(typical),
                d.numbers.near(0.1 * typical)
            ),
            _ => d.numbers.near(typical),
        };
        d.line(key, &value);
    }
    if d.chance(20) {
        d.rheology();
    }
}

pub fn hinged(d: &mut Draft<'_, '_>) {
    d.head("[[hinged]]");
    let name = d.name("whip");
    d.draw("mass", |n| n.near(0.5));
    d.line("center_of_mass", "[1.5, 0.0, 0.1]");
    let inertia = d.pick(&["[0.0, 0.3, 0.3]", "[0.1, 0.3, 0.35]", "[0, 0, 0]", "[1, 3, 1]"]);
    d.line("inertia", inertia);
    d.draw("hinge", |n| n.vector(0.4));
    let axes = match below(d.numbers.u, 4) {
        0 => "[[0, 0, 1]]".to_owned(),
        1 => "[[0, 1, 0], [0, 0, 1]]".to_owned(),
        2 => "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]".to_owned(),
        _ => format!("[{}, {}]", d.numbers.direction(), d.numbers.direction()),
    };
    d.line("axes", &axes);
    d.draw("stiffness", |n| n.near(60.0));
    d.draw("damping", |n| n.near(1.0));
    if d.chance(20) {
        d.rheology();
    }
    d.names.push(name);
}

pub fn rotor(d: &mut Draft<'_, '_>) {
    d.head("[[rotor]]");
    d.name("rotor");
    if d.chance(60) {
        d.line("shape", "\"sphere\"");
    } else {
        d.draw("axis", |n| n.direction());
    }
    d.draw("inertia", |n| n.near(0.2));
    d.draw("friction", |n| n.near(0.5));
    if d.chance(40) {
        d.draw("speed", |n| n.signed(3.0));
    }
}

pub fn wheel(d: &mut Draft<'_, '_>) {
    d.head("[[wheel]]");
    d.name("wheel");
    d.draw("axis", |n| n.direction());
    if d.chance(128) {
        d.draw("momentum", |n| n.signed(2.0));
        return;
    }
    let (inertia, speed) = (d.numbers.near(0.02), d.numbers.signed(100.0));
    d.line("inertia", &inertia);
    let formula = d.chance(80);
    let speed =
        if formula { format!("{{ formula = \"{}\" }}", super::formula::formula(d.numbers.u)) } else { speed };
    d.line("speed", &speed);
}

pub fn cavity(d: &mut Draft<'_, '_>) {
    d.head("[[cavity]]");
    d.name("tank");
    let shape =
        d.pick(&["sphere", "ellipsoid", "cylinder", "annulus", "ring", "box", "shell", "mesh", "surface"]);
    d.line("shape", &format!("\"{shape}\""));
    let keys: &[(&str, f64)] = match shape {
        "sphere" => &[("radius", 0.3)],
        "cylinder" => &[("radius", 0.2), ("height", 0.5)],
        "annulus" => &[("height", 0.1)],
        "ring" => &[("radius", 0.3), ("tube_radius", 0.01)],
        _ => &[],
    };
    for (key, typical) in keys {
        d.draw(key, |n| n.near(*typical));
    }
    match shape {
        "ellipsoid" | "shell" => {
            d.draw("semi_axes", |n| n.triple(0.2));
        }
        "box" => {
            d.draw("sides", |n| n.triple(0.2));
        }
        "annulus" => {
            let radii = format!("[{}, {}]", d.numbers.near(0.05), d.numbers.near(0.3));
            d.line("radii", &radii);
        }
        "mesh" => d.line("file", "\"../../../quasirigid-io/tests/data/bodies/spur.msh\""),
        "surface" => d.line("file", "\"cube.obj\""),
        _ => {}
    }
    if shape == "shell" {
        d.draw("inner_semi_axes", |n| n.triple(0.05));
    }
    if matches!(shape, "cylinder" | "annulus" | "ring") && d.chance(128) {
        d.draw("axis", |n| n.direction());
    }
    let (density, viscosity) = (d.numbers.near(1000.0), d.numbers.near(1e-4));
    d.line("density", &density);
    let key = d.pick(&["kinematic_viscosity", "dynamic_viscosity"]);
    d.line(key, &viscosity);
    if d.chance(40) {
        d.line("flow", "\"boundary-layer\"");
    }
    if d.chance(40) {
        d.draw("modes", |n| n.count(6));
    }
    d.draw("resolution", |n| n.count(4));
}

pub fn bushing(d: &mut Draft<'_, '_>) {
    d.head("[[bushing]]");
    d.name("bushing");
    let (from, to) = (d.end(), d.end());
    d.line("from", &from);
    d.line("to", &to);
    d.draw("stiffness", |n| n.triple(900.0));
    d.draw("rotational_stiffness", |n| n.triple(60.0));
    if d.chance(128) {
        d.draw("damping", |n| n.triple(9.0));
    }
    if d.chance(20) {
        d.rheology();
    }
}

pub fn network(d: &mut Draft<'_, '_>) {
    d.head("[[network]]");
    d.name("rubble");
    d.draw("mass", |n| n.near(3.0));
    d.draw("semi_axes", |n| n.triple(1.0));
    d.draw("spacing", |n| n.near(0.7));
    d.draw("stiffness", |n| n.near(0.1));
    if d.chance(80) {
        d.draw("reach", |n| n.near(1.5));
    }
    d.rheology();
}

pub fn ellipsoid(d: &mut Draft<'_, '_>) {
    d.head("[[ellipsoid]]");
    if d.chance(200) {
        d.draw("semi_axes", |n| n.triple(300.0));
    } else {
        let (diameter, ratios) = (d.numbers.near(340.0), d.numbers.triple(1.0));
        d.line("diameter", &diameter);
        let key = d.pick(&["axis_ratios", "moment_ratios"]);
        d.line(key, &ratios);
    }
    d.line("material", "\"rock\"");
}

pub fn surface(d: &mut Draft<'_, '_>) {
    d.head("[[surface]]");
    d.line("file", "\"cube.obj\"");
    d.line("material", "\"rock\"");
    d.word("unit", &["m", "km", "in", "kg"]);
    let key = d.pick(&["degree", "cells"]);
    d.draw(key, |n| n.count(5));
}
