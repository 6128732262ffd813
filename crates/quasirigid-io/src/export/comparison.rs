use std::fmt::{self, Write};

/// A mechanism with the others locked: how large its torque is, degree by degree.
#[derive(Clone, Debug)]
pub struct Mechanism {
    /// Mechanism: internal rotors, liquids, or springs and dashpots.
    pub name: &'static str,
    /// Degrees with the size of each at a spin of 1 rad/s (rad/s²).
    pub sizes: Vec<(usize, f64)>,
}

/// Degrees in words, from the first one that a torque can have.
const DEGREES: [(usize, &str); 3] = [(3, "cubic"), (4, "quartic"), (5, "quintic")];

/// Writes the torques of liquids and rotors beside those of springs and dashpots: the comparison of the paper's section 6.
pub(super) fn write(out: &mut String, mechanisms: &[Mechanism]) -> fmt::Result {
    writeln!(out, "\nlargest mu/J by degree at 1 rad/s, rotors and liquids locked, rad/s^2")?;
    let heads = DEGREES.map(|(_, word)| format!("{word:>12}"));
    writeln!(out, "  {:<22}{}", "", heads.concat())?;
    mechanisms.iter().try_for_each(|mechanism| {
        let sizes = DEGREES.map(|(degree, _)| size(mechanism, degree));
        writeln!(out, "  {:<22}{}", mechanism.name, sizes.concat())
    })
}

fn size(mechanism: &Mechanism, degree: usize) -> String {
    match mechanism.sizes.iter().find(|(kept, _)| *kept == degree) {
        None => format!("{:>12}", "not kept"),
        Some((_, 0.0)) => format!("{:>12}", "none"),
        Some((_, size)) => format!("{size:>12.3e}"),
    }
}
