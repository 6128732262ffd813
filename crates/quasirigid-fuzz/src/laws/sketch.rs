//! Bodies of moderate numbers, and the texts of their model files along any axes and in any units.

use std::fmt::Write;

use arbitrary::Unstructured;
use quasirigid_math::rotation::{self, ALIGNED};

use crate::grammar::choice::below;

/// Axes and units of a description.
#[derive(Clone, Copy, Debug)]
pub struct View {
    /// Attitude: from components along the axes of the body to those of the file.
    pub attitude: [f64; 4],
    /// One metre, one kilogram and one second in the units of the file.
    units: [f64; 3],
}

impl Default for View {
    fn default() -> Self {
        Self { attitude: ALIGNED, units: [1.0; 3] }
    }
}

impl View {
    pub fn drawn(u: &mut Unstructured<'_>) -> Self {
        let axis: [f64; 3] = std::array::from_fn(|_| signed(u, 2.0));
        let units = std::array::from_fn(|_| {
            10f64.powi(below(u, 13) as i32 - 6) * (1.0 + below(u, 100) as f64 / 37.0)
        });
        Self { attitude: rotation::turned(ALIGNED, axis), units }
    }

    /// Factor of a quantity with these exponents of length, mass and time.
    pub fn factor(&self, exponents: [i32; 3]) -> f64 {
        (0..3).map(|unit| self.units[unit].powi(exponents[unit])).product()
    }

    fn number(&self, value: f64, exponents: [i32; 3]) -> String {
        format!("{:e}", self.factor(exponents) * value)
    }

    fn vector(&self, vector: [f64; 3], exponents: [i32; 3]) -> String {
        let [x, y, z] =
            rotation::to_inertial(self.attitude, vector).map(|entry| self.number(entry, exponents));
        format!("[{x}, {y}, {z}]")
    }

    fn tensor(&self, rows: [[f64; 3]; 3], exponents: [i32; 3]) -> String {
        let half: [[f64; 3]; 3] = rows.map(|row| rotation::to_inertial(self.attitude, row));
        let columns: [[f64; 3]; 3] = std::array::from_fn(|j| {
            rotation::to_inertial(self.attitude, [half[0][j], half[1][j], half[2][j]])
        });
        let entry = |i: usize, j: usize| self.number(0.5 * (columns[j][i] + columns[i][j]), exponents);
        let row = |i: usize| format!("[{}, {}, {}]", entry(i, 0), entry(i, 1), entry(i, 2));
        format!("[{}, {}, {}]", row(0), row(1), row(2))
    }
}

/// A body on a carrier.
#[derive(Clone, Debug)]
pub struct Sketch {
    mass: f64,
    center: [f64; 3],
    inertia: [f64; 3],
    points: Vec<Mass>,
    hinged: Vec<Whip>,
    rotors: Vec<([f64; 3], f64, f64)>,
    balls: Vec<([f64; 3], f64, f64)>,
    fixed: Option<[f64; 3]>,
}

#[derive(Clone, Debug)]
struct Mass {
    mass: f64,
    position: [f64; 3],
    motion: usize,
    direction: [f64; 3],
    stiffness: [f64; 3],
    damping: f64,
    axial: Option<[f64; 2]>,
}

#[derive(Clone, Debug)]
struct Whip {
    mass: f64,
    hinge: [f64; 3],
    arm: [f64; 3],
    inertia: [f64; 3],
    axes: usize,
    stiffness: f64,
    damping: f64,
}

/// A number from one to three times a size.
fn positive(u: &mut Unstructured<'_>, size: f64) -> f64 {
    size * (1.0 + below(u, 256) as f64 / 128.0)
}

/// A number between minus and plus a size.
fn signed(u: &mut Unstructured<'_>, size: f64) -> f64 {
    size * (below(u, 255) as f64 - 127.0) / 127.0
}

fn place(u: &mut Unstructured<'_>, size: f64) -> [f64; 3] {
    std::array::from_fn(|_| signed(u, size))
}

impl Sketch {
    pub fn drawn(u: &mut Unstructured<'_>) -> Self {
        let several = |u: &mut Unstructured<'_>, most: usize| 0..below(u, most + 1);
        let base = positive(u, 10.0);
        Self {
            mass: positive(u, 30.0),
            center: place(u, 0.2),
            inertia: std::array::from_fn(|_| base + positive(u, 2.0)),
            points: several(u, 3).map(|_| Mass::drawn(u)).collect(),
            hinged: several(u, 2).map(|_| Whip::drawn(u)).collect(),
            rotors: several(u, 1).map(|_| (unit(u), positive(u, 0.1), positive(u, 0.3))).collect(),
            balls: several(u, 1).map(|_| (place(u, 0.3), positive(u, 0.1), positive(u, 1e-3))).collect(),
            fixed: (below(u, 4) == 1).then(|| place(u, 0.4)),
        }
    }

    /// The model file of the body along the axes and in the units of a view.
    pub fn text(&self, view: &View) -> String {
        const LENGTH: [i32; 3] = [1, 0, 0];
        const MASS: [i32; 3] = [0, 1, 0];
        const INERTIA: [i32; 3] = [2, 1, 0];
        let diagonal = |J: [f64; 3]| [[J[0], 0.0, 0.0], [0.0, J[1], 0.0], [0.0, 0.0, J[2]]];
        let mut text = String::new();
        let mut line =
            |words: std::fmt::Arguments<'_>| text.write_fmt(words).expect("a string takes every text");
        line(format_args!("[carrier]\nmass = {}\n", view.number(self.mass, MASS)));
        line(format_args!("center_of_mass = {}\n", view.vector(self.center, LENGTH)));
        line(format_args!("inertia = {}\n", view.tensor(diagonal(self.inertia), INERTIA)));
        for (index, point) in self.points.iter().enumerate() {
            line(format_args!("[[point]]\nname = \"p{index}\"\nmass = {}\n", view.number(point.mass, MASS)));
            line(format_args!("position = {}\n", view.vector(point.position, LENGTH)));
            let kind = ["", "line", "plane"][point.motion];
            if point.motion > 0 {
                line(format_args!("motion = {{ {kind} = {} }}\n", view.vector(point.direction, [0; 3])));
            }
            line(format_args!("[[spring]]\nfrom = \"p{index}\"\nto = \"carrier\"\n"));
            line(format_args!("stiffness = {}\n", view.tensor(diagonal(point.stiffness), [0, 1, -2])));
            line(format_args!("damping = {}\n", view.number(point.damping, [0, 1, -1])));
            if let Some([stiffness, damping]) = point.axial {
                line(format_args!("[[spring]]\nfrom = \"p{index}\"\nto = \"carrier\"\naxial = true\n"));
                line(format_args!("anchor = {}\n", view.vector([0.9, 0.8, -1.1], LENGTH)));
                line(format_args!("stiffness = {}\n", view.number(stiffness, [0, 1, -2])));
                line(format_args!("damping = {}\n", view.number(damping, [0, 1, -1])));
            }
        }
        for (index, whip) in self.hinged.iter().enumerate() {
            line(format_args!("[[hinged]]\nname = \"h{index}\"\nmass = {}\n", view.number(whip.mass, MASS)));
            let center = std::array::from_fn(|axis| whip.hinge[axis] + whip.arm[axis]);
            line(format_args!("center_of_mass = {}\n", view.vector(center, LENGTH)));
            line(format_args!("inertia = {}\n", view.tensor(diagonal(whip.inertia), INERTIA)));
            line(format_args!("hinge = {}\n", view.vector(whip.hinge, LENGTH)));
            let axes =
                [[0.6, 0.8, 0.0], [0.0, 0.0, 1.0], [-0.8, 0.6, 0.0]].map(|axis| view.vector(axis, [0; 3]));
            line(format_args!("axes = [{}]\n", axes[..whip.axes].join(", ")));
            line(format_args!("stiffness = {}\n", view.number(whip.stiffness, [2, 1, -2])));
            line(format_args!("damping = {}\n", view.number(whip.damping, [2, 1, -1])));
        }
        for (axis, inertia, friction) in &self.rotors {
            line(format_args!("[[rotor]]\naxis = {}\n", view.vector(*axis, [0; 3])));
            line(format_args!("inertia = {}\n", view.number(*inertia, INERTIA)));
            line(format_args!("friction = {}\n", view.number(*friction, [2, 1, -1])));
        }
        for (center, radius, viscosity) in &self.balls {
            line(format_args!("[[cavity]]\nshape = \"sphere\"\nradius = {}\n", view.number(*radius, LENGTH)));
            line(format_args!("center = {}\n", view.vector(*center, LENGTH)));
            line(format_args!("density = {}\n", view.number(700.0, [-3, 1, 0])));
            line(format_args!("kinematic_viscosity = {}\n", view.number(*viscosity, [2, 0, -1])));
        }
        if let Some(point) = self.fixed {
            line(format_args!("[support]\nkind = \"fixed-point\"\npoint = {}\n", view.vector(point, LENGTH)));
        }
        text
    }
}

/// A direction.
fn unit(u: &mut Unstructured<'_>) -> [f64; 3] {
    let [x, y, z] = place(u, 1.0);
    let size = x.hypot(y).hypot(z);
    if size > 0.1 { [x / size, y / size, z / size] } else { [0.0, 0.6, 0.8] }
}

impl Mass {
    fn drawn(u: &mut Unstructured<'_>) -> Self {
        Self {
            mass: positive(u, 0.5),
            position: place(u, 0.8),
            motion: below(u, 3),
            direction: unit(u),
            stiffness: std::array::from_fn(|_| positive(u, 400.0)),
            damping: positive(u, 3.0),
            axial: (below(u, 3) == 1).then(|| [positive(u, 100.0), positive(u, 1.0)]),
        }
    }
}

impl Whip {
    fn drawn(u: &mut Unstructured<'_>) -> Self {
        let thin = positive(u, 0.05);
        Self {
            mass: positive(u, 0.3),
            hinge: place(u, 0.5),
            arm: place(u, 0.7),
            inertia: std::array::from_fn(|_| thin + positive(u, 0.01)),
            axes: 1 + below(u, 3),
            stiffness: positive(u, 60.0),
            damping: positive(u, 2.0),
        }
    }
}
