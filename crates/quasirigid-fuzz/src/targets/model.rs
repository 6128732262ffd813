//! Model files: read, built, and held to the laws of every body.

use crate::laws;

/// Words of model files.
pub const WORDS: &[&str] = &[
    "[carrier]\n",
    "[[point]]\n",
    "[[spring]]\n",
    "[[hinged]]\n",
    "[[rotor]]\n",
    "[[wheel]]\n",
    "[[cavity]]\n",
    "[[force]]\n",
    "[[beam]]\n",
    "[[panel]]\n",
    "[[solid]]\n",
    "[[matrices]]\n",
    "[[modes]]\n",
    "[[network]]\n",
    "[[ellipsoid]]\n",
    "[[surface]]\n",
    "[[bushing]]\n",
    "[[appendage]]\n",
    "[[connection]]\n",
    "[initial]\n",
    "[run]\n",
    "[support]\n",
    "[reduction]\n",
    "[uncertainty]\n",
    "mass = ",
    "inertia = ",
    "position = ",
    "stiffness = ",
    "damping = ",
    "axial = true\n",
    "tension = ",
    "motion = { line = ",
    "motion = { plane = ",
    "to = \"carrier\"\n",
    "rheology = { kind = \"maxwell\", time = ",
    "range = [",
    "angular_velocity = ",
    "displacements = \"rest\"\n",
    "wobble = {",
    "periods = {",
    "order = ",
    "evolve = {",
    "verify = {",
    "axes = ",
    "\"1 km\"",
    "\"3 deg\"",
    "[[",
    "]]",
    "{",
    "}",
    "nan",
    "inf",
    "'''",
    "\"\"\"",
    "#",
    "\\u0000",
];

pub fn text(bytes: &[u8]) {
    if let Ok(text) = std::str::from_utf8(bytes) {
        laws::model::check(text);
    }
}
