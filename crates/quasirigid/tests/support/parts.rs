//! Constructors of elements as most tests have them: elastic, unnamed, free.

use quasirigid::elements::{
    Anchor, Carrier, Coefficient, Connection, End, Material, Member, Point, PointMotion, Prestress,
    SectionShape, Spring, SpringLaw,
};
use quasirigid::model::Rheology;

use super::Sprung;

pub const fn carrier(mass: f64, center_of_mass: [f64; 3], inertia: [[f64; 3]; 3]) -> Carrier {
    Carrier { mass, center_of_mass, inertia }
}

pub fn free_point(name: impl Into<String>, mass: f64, position: [f64; 3]) -> Point {
    Point { name: name.into(), mass, position, motion: PointMotion::Free }
}

pub const fn sprung(mass: f64, position: [f64; 3], stiffness: [f64; 3], damping: [f64; 3]) -> Sprung {
    Sprung { mass, position, stiffness, damping }
}

pub fn spring(from: End, to: End, law: SpringLaw) -> Spring {
    Spring { name: String::new(), from, to, law, rheology: Rheology::Elastic }
}

pub fn isotropic(stiffness: f64, damping: f64) -> SpringLaw {
    SpringLaw::Spatial {
        stiffness: Coefficient::Isotropic(stiffness),
        damping: Coefficient::Isotropic(damping),
    }
}

pub fn diagonal(stiffness: [f64; 3], damping: [f64; 3]) -> SpringLaw {
    SpringLaw::Spatial {
        stiffness: Coefficient::Diagonal(stiffness),
        damping: Coefficient::Diagonal(damping),
    }
}

pub fn axial(stiffness: f64, damping: f64, anchor: Option<[f64; 3]>) -> SpringLaw {
    SpringLaw::Axial { stiffness, damping, anchor, prestress: Prestress::Relaxed }
}

pub fn elastic(density: f64, young: f64, poisson: f64) -> Material {
    Material { density, young, poisson, rheology: Rheology::Elastic }
}

/// Diagonal matrix: an inertia tensor along its principal axes, or upright axes.
pub const fn diag([x, y, z]: [f64; 3]) -> [[f64; 3]; 3] {
    [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]]
}

pub fn line_point(name: impl Into<String>, mass: f64, position: [f64; 3], along: [f64; 3]) -> Point {
    Point { motion: PointMotion::Line(along), ..free_point(name, mass, position) }
}

pub fn member(ends: [usize; 2], section: SectionShape, material: Material, elements: usize) -> Member {
    Member { name: String::new(), ends, section, up: None, material, elements }
}

pub fn weld(from: Anchor, to: Anchor) -> Connection {
    let (axes, stiffness, damping) = (Vec::new(), Vec::new(), Vec::new());
    Connection { from, to, axes, stiffness, damping, rheology: Rheology::Elastic }
}
