//! The energy form as LaTeX displays for `amsmath`, three terms to a line.
//! Equations (R16), (R17), docs/theory/03-reduction.md.

use std::fmt::{self, Write};

use quasirigid_math::polynomial::Series;

use super::FreeBody;
use crate::export::latex::display;

impl FreeBody<'_> {
    /// The energy form with its polynomials, for a document that loads `amsmath`.
    pub(super) fn energy_form_latex(&self) -> String {
        let mut latex = String::new();
        self.write_energy_form(&mut latex).expect("a string takes any text");
        latex
    }

    fn write_energy_form(&self, out: &mut String) -> fmt::Result {
        for line in self.heading() {
            writeln!(out, "% {line}")?;
        }
        writeln!(out, "\\begin{{gather*}}")?;
        writeln!(
            out,
            "  \\dot K = \\frac{{a\\,v + K\\times Tv}}{{a^2 + K\\cdot\\operatorname{{adj}}(T)K}}, \\qquad"
        )?;
        writeln!(out, "  v = K\\times\\nabla E, \\qquad a = 1 + K\\cdot c, \\\\")?;
        writeln!(out, "  \\omega = \\nabla E - \\dot K\\times c + T\\dot K, \\qquad")?;
        writeln!(out, "  \\dot E = -\\dot K\\cdot T\\dot K")?;
        writeln!(out, "\\end{{gather*}}")?;
        let reduced = self.reduced;
        write_degrees(out, "E", &[""], &reduced.energy_of_momentum)?;
        write_degrees(out, "c", &["x", "y", "z"], &reduced.c)?;
        write_degrees(out, "T", &["xx", "yy", "zz", "yz", "zx", "xy"], &reduced.T)
    }
}

/// The degrees of a map that are not zero.
fn write_degrees(out: &mut String, symbol: &str, names: &[&str], map: &Series) -> fmt::Result {
    let names: Vec<_> = names.iter().map(|name| (*name).to_owned()).collect();
    let parts = (0..=map.degree()).map(|degree| map.part(degree)).filter(|part| part.amax() > 0.0);
    let mut parts = parts.peekable();
    if parts.peek().is_none() {
        return writeln!(out, "\\begin{{equation*}}\n  {symbol} = 0\n\\end{{equation*}}");
    }
    parts.try_for_each(|part| display(out, (symbol, "K"), &names, part))
}
