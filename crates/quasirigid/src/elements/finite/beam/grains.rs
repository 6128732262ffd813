use nalgebra::{Matrix3xX, Vector3};

use super::element::Beam;
use super::mass::Slice;
use crate::elements::finite::{Grain, Site, Turn};

impl Beam {
    /// Places of its nodes (m).
    pub(in crate::elements) fn ends(&self) -> [Vector3<f64>; 2] {
        self.ends
    }

    /// Mass per length (kg/m).
    pub fn mass_per_length(&self) -> f64 {
        self.density * self.section.area
    }

    /// Its mass as material points: four in each section that have its area and second moments, `p = ±√(2 I/A)` along
    /// `y` and `z`, and move by `U + Θ × p`.
    pub fn grains(&self) -> Vec<Grain> {
        let [_, y, z] = self.directions();
        let arm = |second: f64| (2.0 * second / self.section.area).sqrt();
        let (wide, high) = (arm(self.section.second_z) * y, arm(self.section.second_y) * z);
        let slices = self.slices();
        let around = |slice: &Slice| {
            let mass = 0.25 * self.mass_per_length() * slice.length;
            [wide, -wide, high, -high].map(|arm| self.grain(slice, mass, arm))
        };
        slices.iter().flat_map(around).collect()
    }

    fn grain(&self, Slice { t, fields, .. }: &Slice, mass: f64, arm: Vector3<f64>) -> Grain {
        let center = (0.5 - t) * self.ends[0] + (0.5 + t) * self.ends[1];
        let shapes = fields.place - arm.cross_matrix() * fields.turn;
        let turns = Matrix3xX::from_column_slice(fields.turn.as_slice());
        Grain {
            mass,
            site: Site::At(center + arm),
            shapes: Matrix3xX::from_column_slice(shapes.as_slice()),
            turn: Some(Turn { arm, shapes: turns }),
        }
    }
}
