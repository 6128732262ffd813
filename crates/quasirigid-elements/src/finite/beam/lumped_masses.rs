use nalgebra::{Matrix3xX, Vector3};

use super::element::Beam;
use super::forces::Load;
use super::mass::Slice;
use crate::finite::{LumpedMass, MassLocation, Turn};

impl Beam {
    /// Mass per length (kg/m).
    pub(crate) fn mass_per_length(&self) -> f64 {
        self.density * self.section.area
    }

    /// Load per length of the beam of a force per mass (N/kg, by place, at most linear in it).
    pub(crate) fn load(&self, force: &dyn Fn(Vector3<f64>) -> Vector3<f64>) -> Load {
        let line = self.mass_per_length();
        let center = 0.5 * (self.ends[0] + self.ends[1]);
        let around = self.arms().map(|arm| 0.5 * arm.cross(&(force(center + arm) - force(center))));
        Load {
            force: self.ends.map(|place| line * force(place)),
            moment: line * around.iter().sum::<Vector3<f64>>(),
        }
    }

    /// Lumped masses of the beam: four in each section that have its area and second moments, `p = ±√(2 I/A)` along `y` and `z`, and move
    /// by `U + Θ × p`.
    pub(crate) fn lumped_masses(&self) -> Vec<LumpedMass> {
        let [wide, high] = self.arms();
        let slices = self.slices();
        let around = |slice: &Slice| {
            let mass = 0.25 * self.mass_per_length() * slice.length;
            [wide, -wide, high, -high].map(|arm| self.lumped_mass(slice, mass, arm))
        };
        slices.iter().flat_map(around).collect()
    }

    /// Arms from the centroid that with their opposites have the area and second moments of a section.
    fn arms(&self) -> [Vector3<f64>; 2] {
        let [_, y, z] = self.directions();
        let arm = |second: f64| (2.0 * second / self.section.area).sqrt();
        [arm(self.section.second_z) * y, arm(self.section.second_y) * z]
    }

    fn lumped_mass(&self, Slice { t, fields, .. }: &Slice, mass: f64, arm: Vector3<f64>) -> LumpedMass {
        let center = (0.5 - t) * self.ends[0] + (0.5 + t) * self.ends[1];
        let shapes = fields.place - arm.cross_matrix() * fields.turn;
        let rotations = Matrix3xX::from_column_slice(fields.turn.as_slice());
        LumpedMass {
            mass,
            location: MassLocation::At(center + arm),
            shapes: Matrix3xX::from_column_slice(shapes.as_slice()),
            turn: Some(Turn { arm, shapes: rotations }),
        }
    }
}
