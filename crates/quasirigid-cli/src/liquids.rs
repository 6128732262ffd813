//! Liquids of a model at a spin, in words and numbers.

use quasirigid::elements::SlowLiquid;
use quasirigid_io::model::Model;
use serde_json::{Value, json};

use crate::describe::significant;
use crate::layout::paragraph;

/// A liquid of a model at a spin.
pub struct Liquid<'a> {
    name: &'a str,
    slow: SlowLiquid,
    reynolds: f64,
}

/// The liquids of a model at a spin (rad/s).
pub fn liquids(model: &Model, spin: f64) -> Vec<Liquid<'_>> {
    let cavities = model.assembly.cavities.iter().enumerate();
    cavities
        .filter_map(|(index, cavity)| {
            let slow = cavity.slow(index).ok()?;
            Some(Liquid { name: &cavity.name, reynolds: slow.reynolds(spin), slow })
        })
        .collect()
}

impl Liquid<'_> {
    /// For a terminal.
    pub fn text(&self) -> String {
        let SlowLiquid { mass, radius, tensor, .. } = &self.slow;
        let title = format!(
            "{:?}: {} kg of liquid; Reynolds number |w| a^2/nu = {} with a = {} m, the radius of a ball of as much inertia.",
            self.name,
            significant(*mass, 4),
            significant(self.reynolds, 3),
            significant(*radius, 3)
        );
        let largest = tensor.iter().flatten().fold(0.0_f64, |largest, entry| largest.max(entry.abs()));
        let clean =
            |entry: &f64| if entry.abs() > 1e-12 * largest { significant(*entry, 6) } else { "0".into() };
        let row = |row: &[f64; 3]| {
            format!("    {}\n", row.each_ref().map(|entry| format!("{:>13}", clean(entry))).join(" "))
        };
        let rows: String = tensor.iter().map(row).collect();
        format!("\n{}\n  P of its slow flow, in m^7: Pi = (rho/nu) P\n{rows}", paragraph(&title, "", "  "))
    }

    /// For machines.
    pub fn object(&self) -> Value {
        let SlowLiquid { mass, radius, tensor, viscosity } = &self.slow;
        json!({
            "name": self.name, "mass": mass, "radius": radius, "viscosity": viscosity,
            "reynolds": self.reynolds, "P": tensor,
        })
    }
}
