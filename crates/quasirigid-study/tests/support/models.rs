//! Texts of models: a function for each table, whose texts a test puts together.

use std::fmt::Debug;

/// A rigid body with one mass on a spring, slow and stiff; tests replace its numbers.
pub const MODEL: &str = include_str!("model.toml");

/// Carrier with its centre of mass at the origin.
pub fn carrier(mass: f64, inertia: [f64; 3]) -> String {
    format!("[carrier]\nmass = {mass:?}\ncenter_of_mass = [0, 0, 0]\ninertia = {inertia:?}\n")
}

/// Point on a spring to the carrier, with a stiffness and a damping.
pub fn point(name: &str, mass: f64, position: [f64; 3], spring: [f64; 2]) -> String {
    let [stiffness, damping] = spring;
    format!(
        "[[point]]\nname = \"{name}\"\nmass = {mass:?}\nposition = {position:?}\n\
         [[spring]]\nfrom = \"{name}\"\nto = \"carrier\"\nstiffness = {stiffness:?}\ndamping = {damping:?}\n"
    )
}

/// Rigid part on a hinge with two axes.
pub fn hinged(
    name: &str,
    [mass, inertia]: [f64; 2],
    [center, hinge]: [[f64; 3]; 2],
    axes: &str,
    [stiffness, damping]: [f64; 2],
) -> String {
    format!(
        "[[hinged]]\nname = \"{name}\"\nmass = {mass:?}\ncenter_of_mass = {center:?}\n\
         inertia = [{inertia:?}, {inertia:?}, {inertia:?}]\nhinge = {hinge:?}\naxes = {axes}\n\
         stiffness = {stiffness:?}\ndamping = {damping:?}\n"
    )
}

/// Rotor on friction.
pub fn rotor(name: &str, axis: [f64; 3], inertia: f64, friction: f64) -> String {
    format!("[[rotor]]\nname = \"{name}\"\naxis = {axis:?}\ninertia = {inertia:?}\nfriction = {friction:?}\n")
}

/// Ellipsoid of a material with a density, a Poisson's ratio, and a modulus, such as `young = 1e9`.
pub fn ellipsoid(semi_axes: &str, [density, poisson]: [f64; 2], modulus: &str, rheology: &str) -> String {
    format!(
        "[material.rock]\ndensity = {density:?}\n{modulus}\npoisson = {poisson:?}\nrheology = {{ {rheology} }}\n\
         [[ellipsoid]]\nname = \"rock\"\nsemi_axes = {semi_axes}\nmaterial = \"rock\"\n"
    )
}

/// Force of the kind `expression`, by its further keys.
pub fn expression(keys: &str) -> String {
    format!("[[force]]\nkind = \"expression\"\n{keys}\n")
}

/// Force of uniform gravity.
pub fn gravity(acceleration: [f64; 3]) -> String {
    format!("[[force]]\nname = \"weight\"\nkind = \"uniform-gravity\"\nacceleration = {acceleration:?}\n")
}

/// Support at a fixed point.
pub fn fixed(point: [f64; 3]) -> String {
    format!("[support]\nkind = \"fixed-point\"\npoint = {point:?}\n")
}

/// Start with an angular velocity (rad/s).
pub fn spinning(omega: impl Debug) -> String {
    format!("[initial]\nangular_velocity = {omega:?}\n")
}

/// Start with a wobble in one of its modes.
pub fn wobbling(angle: &str, rate: &str, mode: &str) -> String {
    format!("[initial]\nwobble = {{ angle = \"{angle}\", rate = \"{rate}\", mode = \"{mode}\" }}\n")
}

/// Target of an evolution.
pub fn until(angle: &str) -> String {
    format!("[run]\nevolve = {{ until = \"{angle}\" }}\n")
}

/// The model with further lines before `[initial]`, in it, and in `[run]`, which is last.
pub fn model(before: &str, initial: &str, run: &str) -> String {
    MODEL.replace("[initial]", &format!("{before}\n[initial]\n{initial}")) + run
}
