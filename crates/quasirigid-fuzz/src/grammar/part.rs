//! Tables of finite elements, of their materials and sections, and of what joins them.

use super::choice::below;
use super::model::Draft;

pub fn beam(d: &mut Draft<'_, '_>) {
    d.head("[[beam]]");
    let name = d.name("boom");
    let (root, tip) = (d.numbers.vector(0.3), d.numbers.vector(2.0));
    d.line("nodes", &format!("{{ root = {root}, tip = {tip}, side = [0.5, 1.5, 0.2] }}"));
    let lines = d.pick(&[
        "[[\"root\", \"tip\"]]",
        "[[\"root\", \"tip\"], [\"tip\", \"side\"]]",
        "[[\"root\", \"root\"]]",
        "[[\"root\", \"nowhere\"]]",
    ]);
    d.line("lines", lines);
    d.word("section", &["tube", "bar", "general", "I", "none"]);
    d.line("material", "\"aluminium\"");
    d.draw("elements", |n| n.count(4));
    if d.chance(40) {
        d.draw("up", |n| n.direction());
    }
    if d.chance(60) {
        let (mass, inertia) = (d.numbers.near(0.5), d.numbers.moments(0.01));
        d.line("masses", &format!("[{{ node = \"tip\", mass = {mass}, inertia = {inertia} }}]"));
    }
    attached(d, "root");
    d.parts.push((name, "\"tip\""));
}

fn attached(d: &mut Draft<'_, '_>, node: &str) {
    if !d.chance(8) {
        d.line("attach", &format!("\"{node}\""));
    }
    if d.chance(80) {
        let (mass, stiffness) = (d.numbers.near(0.1), d.numbers.near(1e-3));
        d.line("rayleigh", &format!("{{ mass = {mass}, stiffness = {stiffness} }}"));
    }
}

pub fn panel(d: &mut Draft<'_, '_>) {
    d.head("[[panel]]");
    let name = d.name("wing");
    let (first, second) = (d.numbers.near(2.0), d.numbers.near(1.0));
    let cells = [d.numbers.count(3), d.numbers.count(3)];
    d.line(
        "rectangle",
        &format!("{{ sides = [[{first}, 0, 0], [0, {second}, 0]], cells = [{}, {}] }}", cells[0], cells[1]),
    );
    d.draw("position", |n| n.vector(0.4));
    let (thickness, angle) = (d.numbers.near(2e-3), d.numbers.signed(0.5));
    let layer = format!("{{ material = \"aluminium\", thickness = {thickness} }}");
    let core = format!("{{ material = \"carbon\", thickness = {thickness}, angle = {angle} }}");
    let layers = if d.chance(100) { format!("[{layer}, {core}, {layer}]") } else { format!("[{layer}]") };
    d.line("layers", &layers);
    attached(d, "left");
    d.parts.push((name, "\"right top\""));
}

pub fn solid(d: &mut Draft<'_, '_>) {
    d.head("[[solid]]");
    let name = d.name("block");
    let file = d.pick(&["spur.msh", "brick.inp", "hook.inp", "nothing.msh"]);
    d.line("file", &format!("\"../../../quasirigid-io/tests/data/bodies/{file}\""));
    d.line("material", "\"aluminium\"");
    d.word("unit", &["m", "mm", "km"]);
    d.draw("position", |n| n.vector(0.4));
    let node = d.pick(&["ROOT", "root", "clamp", "1"]);
    attached(d, node);
    d.parts.push((name, "1"));
}

pub fn matrices(d: &mut Draft<'_, '_>) {
    const BODIES: &str = "../../../quasirigid-io/tests/data/bodies";
    d.head("[[matrices]]");
    let name = d.name("imported");
    let body = d.pick(&["brick", "spur"]);
    let nodes = if body == "brick" { "brick-nodes.csv" } else { "spur.inp" };
    d.line("nodes", &format!("\"{BODIES}/{nodes}\""));
    d.line("dofs", &format!("\"{BODIES}/{body}.dof\""));
    d.line("mass", &format!("\"{BODIES}/{body}.mas\""));
    d.line("stiffness", &format!("\"{BODIES}/{body}.sti\""));
    if d.chance(60) {
        d.word("length_unit", &["mm", "m", "in"]);
        d.line("mass_unit", "\"t\"");
    }
    let node = d.pick(&["1", "2", "[1, 2, 3]"]);
    d.line("attach", node);
    d.parts.push((name, "4"));
}

/// Modes, of which a file gives the shapes.
pub fn modes(d: &mut Draft<'_, '_>) {
    const BODIES: &str = "../../../quasirigid-io/tests/data/bodies";
    d.head("[[modes]]");
    let name = d.name("modal");
    d.line("nodes", &format!("\"{BODIES}/brick-nodes.csv\""));
    d.line("dofs", &format!("\"{BODIES}/brick.dof\""));
    d.line("mass", &format!("\"{BODIES}/brick.mas\""));
    let shapes = d.pick(&["brick.mas", "brick.sti"]);
    d.line("shapes", &format!("\"{BODIES}/{shapes}\""));
    d.draw("frequencies", |n| n.triple(10.0));
    d.draw("damping_ratios", |n| n.near(0.01));
    d.line("attach", "1");
    d.parts.push((name, "4"));
}

pub fn connection(d: &mut Draft<'_, '_>) {
    d.head("[[connection]]");
    let (from, to) = (d.node(), d.end());
    d.line("from", &from);
    d.line("to", &to);
    match below(d.numbers.u, 3) {
        0 => {
            d.draw("hinge", |n| n.direction());
        }
        1 => d.line("ball", "true"),
        _ => return,
    }
    d.draw("stiffness", |n| n.near(20.0));
    d.draw("damping", |n| n.near(0.3));
}

/// Materials, sections and the reduction, which elements share.
pub fn shared(d: &mut Draft<'_, '_>) {
    d.head("[material.rock]");
    let (density, young, poisson) = (d.numbers.near(2500.0), d.numbers.near(1e9), d.numbers.near(0.1));
    d.line("density", &density);
    let modulus = d.pick(&["young", "shear", "mu_Q"]);
    d.line(modulus, &young);
    d.line("poisson", &poisson);
    d.rheology();
    d.head("[material.aluminium]");
    d.draw("density", |n| n.near(2700.0));
    d.draw("young", |n| n.near(7e10));
    d.line("poisson", "0.33");
    if d.chance(128) {
        d.rheology();
    }
    d.head("[material.carbon]");
    let moduli = d.numbers.triple(3e10);
    d.line("density", "1580");
    d.line("young", &moduli);
    d.line("poisson", "[0.05, 0.2, 0.2]");
    d.draw("shear", |n| n.triple(4e9));
    d.head("[section.tube]");
    d.line("shape", "\"tube\"");
    d.draw("radius", |n| n.near(0.03));
    d.draw("thickness", |n| n.near(0.001));
    d.head("[section.bar]");
    let (height, width) = (d.numbers.near(0.03), d.numbers.near(0.02));
    d.text += &format!("shape = \"rectangle\"\nheight = {height}\nwidth = {width}\n");
    d.head("[section.I]");
    d.text += &format!("shape = \"I\"\nheight = {height}\nwidth = {width}\nweb = 0.002\nflange = 0.003\n");
    d.head("[section.general]");
    let (area, second) = (d.numbers.near(1e-4), d.numbers.near(1e-8));
    d.text += &format!(
        "shape = \"general\"\narea = {area}\nsecond_y = {second}\nsecond_z = {second}\ntorsion = {second}\n"
    );
    if d.chance(40) {
        d.head("[reduction]");
        d.draw("modes", |n| n.count(4));
    }
}
