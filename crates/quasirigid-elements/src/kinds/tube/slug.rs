//! Slug of liquid in a ring: its mass as an arc of the torus, and its friction.

use std::f64::consts::PI;

use nalgebra::{Matrix3, Vector3};

use super::Tube;
use crate::contribution::{Field as Shape, MovingBody, Piece};
use crate::model::{Coordinate, TubeFriction};

/// Liquid of a ring that is partly full: one slug that slides along it. (U10)–(U14)
#[derive(Clone, Debug, PartialEq)]
pub struct Slug {
    /// Name of the tank.
    pub name: String,
    /// Share of the volume that is full.
    pub fill: f64,
    /// Mass of the liquid (kg).
    pub liquid_mass: f64,
    /// Centre of mass of the liquid (m) where it lies at rest, in the file's frame.
    pub center_of_mass: [f64; 3],
    /// Angle of the arc (rad).
    pub arc: f64,
    /// Mean radius of the ring, and radius of the tube (m).
    pub radii: [f64; 2],
    /// Centre (m), axis and direction to the middle of the liquid, in the file's frame; the last two are unit vectors across each other.
    pub frame: [[f64; 3]; 3],
    /// Density (kg/m³) and kinematic viscosity (m²/s).
    pub liquid: [f64; 2],
    /// Surface tension (N/m), and whether it is that of water for want of another.
    pub surface_tension: (f64, bool),
    /// Friction by the rate at which it slides.
    pub friction: TubeFriction,
    /// Whether it is held where it lies at rest.
    pub held: bool,
}

/// Surface tension of water (N/m), where none is given.
const WATER: f64 = 0.07;

/// Volume (m³) of a ring.
pub(super) fn capacity(radius: f64, tube_radius: f64) -> f64 {
    2.0 * PI * PI * radius * tube_radius * tube_radius
}

impl Slug {
    /// The slug of a ring that is full to this share, whose axis and direction are unit vectors across each other.
    pub(super) fn of(tube: &Tube, fill: f64, [axis, towards]: [[f64; 3]; 2]) -> Self {
        let Tube { radius, tube_radius, density, viscosity, .. } = *tube;
        let arc = 2.0 * PI * fill;
        let middle = Vector3::from(tube.center) + middle(arc, [radius, tube_radius]) * Vector3::from(towards);
        Self {
            name: tube.name.clone(),
            fill,
            liquid_mass: density * fill * capacity(radius, tube_radius),
            center_of_mass: middle.into(),
            arc,
            radii: [radius, tube_radius],
            frame: [tube.center, axis, towards],
            liquid: [density, viscosity],
            surface_tension: (tube.surface_tension.unwrap_or(WATER), tube.surface_tension.is_none()),
            friction: TubeFriction::of_ring([density, viscosity], arc * radius, [tube_radius, radius]),
            held: tube.held,
        }
    }

    /// Reynolds number of a slug that slides at a rate (rad/s), `2 a R |q̇|/ν`.
    #[must_use]
    pub fn reynolds(&self, rate: f64) -> f64 {
        self.friction.reynolds * rate.abs()
    }

    /// Womersley number of an oscillation at a frequency (rad/s), `a √(ω/ν)`.
    #[must_use]
    pub fn womersley(&self, frequency: f64) -> f64 {
        self.radii[1] * (frequency / self.liquid[1]).sqrt()
    }

    /// Bond number `ρ g a²/σ` under an acceleration (m/s²) across the tube.
    #[must_use]
    pub fn bond(&self, acceleration: f64) -> f64 {
        self.liquid[0] * acceleration * self.radii[1] * self.radii[1] / self.surface_tension.0
    }

    /// Moments about the centre of the ring: those of a sector of the torus with flat ends. (U13)
    fn piece(&self) -> Piece {
        let [R, a] = self.radii;
        let [_, axis, first] = self.frame.map(Vector3::from);
        let second = axis.cross(&first);
        let across = self.liquid_mass * (R * R + 0.75 * a * a);
        let turned = self.arc.sin() / self.arc;
        let line = |direction: Vector3<f64>| -> Matrix3<f64> { direction * direction.transpose() };
        Piece {
            mass: self.liquid_mass,
            first: self.liquid_mass * middle(self.arc, self.radii) * first,
            second: 0.5 * across * ((1.0 + turned) * line(first) + (1.0 - turned) * line(second))
                + 0.25 * self.liquid_mass * a * a * line(axis),
        }
    }

    /// The slug as an appendage hinged at the centre of the ring about its axis.
    pub(super) fn moving_body(&self) -> MovingBody {
        let [center, axis, _] = self.frame.map(Vector3::from);
        let turn = axis.cross_matrix();
        let piece = self.piece();
        MovingBody {
            base: center,
            pose: Matrix3::identity(),
            shapes: vec![Shape::linear(turn)],
            curvature: vec![vec![Shape::linear(turn * turn)]],
            axes: vec![axis],
            oriented: true,
            coordinates: vec![Coordinate { name: format!("\"{}\" along the ring", self.name), unit: "rad" }],
            marker: (self.name.clone(), piece.first / piece.mass),
            places: Vec::new(),
            law: None,
            piece,
        }
    }

    /// The slug as a rigid piece of the carrier, with the place (m) about which its moments are.
    pub(super) fn frozen(&self) -> (Piece, Vector3<f64>) {
        let Piece { mass, first, second } = self.piece();
        let middle = first / mass;
        let own =
            Piece { mass, first: Vector3::zeros(), second: second - mass * middle * middle.transpose() };
        (own, Vector3::from(self.frame[0]) + middle)
    }
}

/// Distance (m) of the centre of mass of an arc from the centre of the ring. (U13)
fn middle(arc: f64, [R, a]: [f64; 2]) -> f64 {
    (R + 0.25 * a * a / R) * (0.5 * arc).sin() / (0.5 * arc)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::ElementKind;
    use crate::kinds::tank::TankContents;

    /// Sums over small cells of the torus, by midpoints: an axis and a direction that are none of the frame's, a wide tube.
    #[test]
    fn moments_are_those_of_a_sector_of_the_torus() {
        let tube = Tube {
            name: "ring".into(),
            radius: 0.3,
            tube_radius: 0.06,
            center: [0.1, -0.2, 0.3],
            axis: [1.0, -2.0, 2.0],
            towards: Some([0.3, 1.0, 0.4]),
            contents: TankContents::Fill(0.31),
            density: 870.0,
            viscosity: 1e-6,
            surface_tension: None,
            held: false,
        };
        let slug = tube.slug(ElementKind::Tube.at(0)).unwrap();
        let [_, axis, first] = slug.frame.map(Vector3::from);
        let second = axis.cross(&first);
        let (mut mass, mut sum, mut moments) = (0.0, Vector3::zeros(), Matrix3::zeros());
        let n = 60;
        let half = |i: usize| (i as f64 + 0.5) / n as f64;
        for i in 0..n {
            let angle = slug.arc * (half(i) - 0.5);
            let out = angle.cos() * first + angle.sin() * second;
            for j in 0..n {
                let s = 0.06 * half(j);
                for k in 0..n {
                    let psi = 2.0 * PI * half(k);
                    let distance = 0.3 + s * psi.cos();
                    let place = distance * out + s * psi.sin() * axis;
                    let dm = 870.0
                        * s
                        * distance
                        * (0.06 / n as f64)
                        * (slug.arc / n as f64)
                        * (2.0 * PI / n as f64);
                    mass += dm;
                    sum += dm * place;
                    moments += dm * place * place.transpose();
                }
            }
        }
        let piece = slug.piece();
        assert!((piece.mass / mass - 1.0).abs() < 1e-12);
        assert!((piece.first - sum).norm() < 1e-3 * sum.norm()); // midpoints: 1/n²
        assert!((piece.second - moments).norm() < 1e-3 * moments.norm());
        assert!((piece.second - piece.second.transpose()).norm() < 1e-14 * moments.norm());
        assert!((Vector3::from(slug.center_of_mass) - Vector3::from(tube.center) - sum / mass).norm() < 3e-4);
    }
}
