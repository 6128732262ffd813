use std::fmt::{self, Write};

use quasirigid::reduction::DegreeSize;

/// A mechanism with the others locked: how large its torque is, degree by degree.
#[derive(Clone, Debug)]
pub struct Mechanism {
    /// What moves.
    pub name: &'static str,
    /// Sizes of the degrees at a spin of 1 rad/s.
    pub sizes: Vec<DegreeSize>,
}

/// Degrees in words, from the first one that a torque can have.
const DEGREES: [(usize, &str); 3] = [(3, "cubic"), (4, "quartic"), (5, "quintic")];

/// Writes what liquids and rotors do beside what springs and dashpots do: the comparison of the paper's section 6.
pub(super) fn write(out: &mut String, mechanisms: &[Mechanism]) -> fmt::Result {
    writeln!(out, "\nlargest mu/J by degree at 1 rad/s, what else moves locked, rad/s^2")?;
    let heads = DEGREES.map(|(_, word)| format!("{word:>12}"));
    writeln!(out, "  {:<22}{}", "", heads.concat())?;
    mechanisms.iter().try_for_each(|mechanism| {
        let sizes = DEGREES.map(|(degree, _)| size(mechanism, degree));
        writeln!(out, "  {:<22}{}", mechanism.name, sizes.concat())
    })
}

fn size(mechanism: &Mechanism, degree: usize) -> String {
    match mechanism.sizes.iter().find(|size| size.degree == degree) {
        None => format!("{:>12}", "not kept"),
        Some(found) if found.size == 0.0 => format!("{:>12}", "none"),
        Some(found) => format!("{:>12.3e}", found.size),
    }
}
