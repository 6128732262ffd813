//! Range of appendages that are known by their sheet alone: terms of second order under spin are not in a sheet.
//! Equation (K17), docs/theory/12-structures.md.

use quasirigid::elements::{Appendage, Assembly, Extent};
use quasirigid_math::vec3::norm;

use crate::words::{MAY_NOT_HOLD, significant};

/// Spin over the lowest frequency above which an answer may not hold.
const SLOW: f64 = 0.1;

/// Note on what sheets leave out at an angular velocity (rad/s); none at rest, and without such appendages.
pub fn note(assembly: &Assembly, omega: [f64; 3]) -> Option<String> {
    let (softest, ratio) = softest(assembly, omega)?;
    let unknown = assembly.appendages.iter().any(|appendage| appendage.extent == Extent::Unknown);
    let warning = if unknown || ratio > SLOW { format!("{MAY_NOT_HOLD}: ") } else { String::new() };
    let load = if unknown {
        " Without `line` or `normal` the load of a steady spin on its modes is left out too, and with it their part in reduced equations and evolutions."
    } else {
        ""
    };
    Some(format!(
        "{warning}The sheet of appendage {:?} has no shapes, so that stiffening by the spin and Coriolis forces between its modes are left out: the spin at the start is {} % of its lowest frequency, and its vibrations under spin are good to about as much.{load}",
        softest.name,
        significant(100.0 * ratio, 3)
    ))
}

/// Warning to stand before an answer about a steady spin (rad/s) that is not slow beside the vibrations of a sheet.
pub fn warning(assembly: &Assembly, omega: [f64; 3]) -> Option<String> {
    let (softest, ratio) = softest(assembly, omega).filter(|(_, ratio)| *ratio > SLOW)?;
    Some(format!(
        "{MAY_NOT_HOLD}, since the spin is {} % of the lowest frequency of appendage {:?}, whose sheet has no shapes.",
        significant(100.0 * ratio, 3),
        softest.name
    ))
}

/// Appendage of the lowest frequency, and the spin as a share of that.
fn softest(assembly: &Assembly, omega: [f64; 3]) -> Option<(&Appendage, f64)> {
    let lowest = |appendage: &&Appendage| appendage.lowest_frequency();
    let softest = assembly.appendages.iter().min_by(|a, b| lowest(a).total_cmp(&lowest(b)))?;
    let spin = norm(omega);
    (spin > 0.0).then(|| (softest, spin / softest.lowest_frequency()))
}
