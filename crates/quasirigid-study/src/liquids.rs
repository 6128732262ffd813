//! Liquids of a model at a spin, in words and numbers.

use quasirigid::elements::{
    Assembly, MAX_REYNOLDS_OF_BALL, MAX_REYNOLDS_OF_CYLINDER, MAX_REYNOLDS_OF_SPHEROID, SlowLiquid,
};
use quasirigid::secular::choice::UnknownLiquid;
use quasirigid_io::record::LiquidRecord;
use quasirigid_math::vec3::norm;

use crate::layout::paragraph;
use crate::study::Study;
use crate::words::significant;

/// A liquid of a model at a spin.
pub struct Liquid<'a> {
    name: &'a str,
    slow: &'a SlowLiquid,
    reynolds: f64,
}

/// The liquids of a model at a spin (rad/s).
pub fn liquids(study: &Study, spin: f64) -> Vec<Liquid<'_>> {
    let cavities = study.model.assembly.cavities.iter().zip(&study.liquids);
    cavities
        .map(|(cavity, slow)| Liquid { name: &cavity.name, reynolds: slow.reynolds(spin), slow })
        .collect()
}

/// Liquids of unknown response to a motion at a frequency (rad/s, body axes) about a steady spin (rad/s).
pub fn unknown_liquids(study: &Study, spin: [f64; 3], frequency: f64) -> Vec<UnknownLiquid> {
    let cavities = study.model.assembly.cavities.iter().zip(&study.liquids);
    let unknown = cavities.filter(|(cavity, slow)| !cavity.answers(slow, study.order, spin, frequency));
    unknown
        .map(|(cavity, slow)| UnknownLiquid {
            cavity: cavity.name.clone(),
            reynolds: slow.reynolds(norm(spin)),
        })
        .collect()
}

/// The same in words; none if all are known.
pub fn unanswered(study: &Study, spin: [f64; 3], frequency: f64) -> Option<String> {
    let liquids = unknown_liquids(study, spin, frequency);
    (!liquids.is_empty()).then(|| unknown(&liquids))
}

/// Liquids of unknown response about an axis, in words.
pub fn unknown(liquids: &[UnknownLiquid]) -> String {
    let name = |UnknownLiquid { cavity, reynolds }: &UnknownLiquid| {
        format!("{cavity:?} (Reynolds number {})", significant(*reynolds, 2))
    };
    format!(
        "liquid that spins has waves at frequencies below twice the spin, and about this axis those of {} are not known: only slow flow is, a sphere up to a \
         Reynolds number of {MAX_REYNOLDS_OF_BALL:e}, and where it spins about its axis a spheroid up to {MAX_REYNOLDS_OF_SPHEROID:e} or a cylinder up to {MAX_REYNOLDS_OF_CYLINDER:e}",
        liquids.iter().map(name).collect::<Vec<_>>().join(", ")
    )
}

/// Relative error of a flow from which a note is given.
pub const NOTABLE: f64 = 0.01;

/// Relative error of the slow flow of a liquid; zero where it is exact.
pub fn unresolved(liquid: &SlowLiquid) -> f64 {
    liquid.errors.map_or(0.0, |errors| errors.into_iter().fold(0.0, f64::max))
}

/// Notes on flows to read before the numbers; none where they are well resolved.
pub fn notes(assembly: &Assembly, liquids: &[SlowLiquid]) -> Vec<String> {
    let coarse = assembly.cavities.iter().zip(liquids).filter(|(_, liquid)| unresolved(liquid) > NOTABLE);
    coarse
        .map(|(cavity, liquid)| {
            format!(
                "The flow in {:?} is known to about {} %: raise its `resolution`, or give it a finer mesh.",
                cavity.name,
                significant(100.0 * unresolved(liquid), 2)
            )
        })
        .collect()
}

impl Liquid<'_> {
    /// For a terminal.
    pub fn text(&self) -> String {
        let SlowLiquid { mass, radius, tensor, errors, equivalent, .. } = self.slow;
        let title = format!(
            "{:?}: {} kg of liquid; Reynolds number |w| a^2/nu = {} with a = {} m, the radius of a ball of liquid that follows as slowly.",
            self.name,
            significant(*mass, 4),
            significant(self.reynolds, 3),
            significant(*radius, 3)
        );
        let made = errors.map_or_else(String::new, |errors| {
            let shares = errors.map(|error| format!("{} %", significant(100.0 * error, 1)));
            format!("  found numerically, in error by about {}\n", shares.join(", "))
        });
        let answer = match equivalent {
            Some(inertia) => format!(
                "  Ideal behind a boundary layer: inertia of the equivalent body, in kg m^2\n{}",
                rows(inertia)
            ),
            None => format!("  P of its slow flow, in m^7: Pi = (rho/nu) P\n{}{made}", rows(tensor)),
        };
        format!("\n{}\n{answer}", paragraph(&title, "", "  "))
    }

    /// For a record, and for machines.
    pub fn record(&self) -> LiquidRecord {
        let SlowLiquid { mass, radius, tensor, errors, equivalent, viscosity } = *self.slow;
        LiquidRecord {
            name: self.name.into(),
            mass,
            radius,
            viscosity,
            reynolds: self.reynolds,
            P: tensor,
            errors,
            equivalent_inertia: equivalent,
        }
    }
}

/// A matrix for a terminal, without the rounding of its zeros.
fn rows(matrix: &[[f64; 3]; 3]) -> String {
    let largest = matrix.iter().flatten().fold(0.0_f64, |largest, entry| largest.max(entry.abs()));
    let clean = |entry: &f64| if entry.abs() > 1e-12 * largest { significant(*entry, 6) } else { "0".into() };
    let row = |row: &[f64; 3]| {
        format!("    {}\n", row.each_ref().map(|entry| format!("{:>13}", clean(entry))).join(" "))
    };
    matrix.iter().map(row).collect()
}
