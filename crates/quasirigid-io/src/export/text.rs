//! Text export: the derived body in 80 columns, with tables of the coefficients of `μ`, `K` and the displacements.
//! Only entries above a share of the largest of their degree are printed: the others are rounding of exact zeros.
//! Equations (R4) and (R7), docs/theory/03-reduction.md.

use std::fmt::{self, Write};

use quasirigid_body::{Principal, Support};
use quasirigid_math::polynomial::Homogeneous;

use super::{Derived, MAX_PRINTED, comparison, forces, rows};
use crate::visible::one_line;

/// Terms smaller than this share of the largest of their degree are rounding and not shown.
const SHOWN: f64 = 1e-13;

impl Derived<'_> {
    /// The derived body as a text for people, 80 columns wide.
    #[must_use]
    pub fn text(&self) -> String {
        let mut text = String::new();
        self.write(&mut text).expect("a string takes any text");
        text
    }

    fn write(&self, out: &mut String) -> fmt::Result {
        let Derived { name, body, reduced, frequencies, mechanisms, forces } = *self;
        let principal = Principal::compute(reduced.J);
        writeln!(out, "{}: reduced equations of order {}", one_line(name), reduced.order)?;
        let wheels = body.wheels().angular_momentum(0.0);
        let equation = match (body.wheels().is_empty(), forces.is_some()) {
            (true, false) => "J w' + w x Jw = mu(w)        w in rad/s",
            (false, false) => "J w' + w x (Jw + k) = mu(w)  w in rad/s",
            (true, true) if self.turns_inside() => "J w' + w x Jw = M* + ...     w in rad/s",
            (true, true) => "J w' + w x Jw = M* + mu      w in rad/s",
            (false, true) => "J w' + w x (Jw + k) = M* + ...  w in rad/s",
        };
        writeln!(out, "\n  {equation}, body axes, SI units throughout")?;
        if forces.is_some() && matches!(body.support(), Support::Free) {
            writeln!(out, "  m* R0'' = F* + phi           of the pole, inertial axes")?;
        }
        writeln!(out)?;
        writeln!(out, "mass              {} kg", number(reduced.mass))?;
        writeln!(out, "centre of mass    {} m", vector(body.center_of_mass()))?;
        let support = match body.support() {
            Support::Free => "free: the pole is the centre of mass",
            Support::FixedPoint { .. } => "the pole is a fixed point",
            Support::Prescribed { .. } => "the pole is driven",
        };
        writeln!(out, "pole              {} m", vector(body.pole()))?;
        writeln!(out, "                  {support}")?;
        writeln!(out, "inertia J         {} kg m^2", vector(body.inertia()[0]))?;
        for row in &body.inertia()[1..] {
            writeln!(out, "                  {}", vector(*row))?;
        }
        writeln!(out, "principal moments {} kg m^2", vector(principal.moments))?;
        if !body.wheels().is_empty() {
            writeln!(out, "wheels k          {} N m s", vector(wheels))?;
        }
        match frequencies {
            [] if self.turns_inside() => writeln!(out, "frequencies       none: nothing vibrates")?,
            [] => writeln!(out, "frequencies       none: the body is rigid")?,
            [only] => writeln!(out, "frequency         {} rad/s", number(*only))?,
            [lowest, .., highest] => {
                let (found, all) = (frequencies.len(), body.elastic());
                let count = if found < all { format!("lowest {found} of {all}") } else { found.to_string() };
                writeln!(
                    out,
                    "frequencies       {count}, from {} to {} rad/s",
                    number(*lowest),
                    number(*highest)
                )?;
            }
        }
        if !mechanisms.is_empty() {
            comparison::write(out, mechanisms)?;
        }
        if let Some(forces) = forces {
            let gap = if mechanisms.is_empty() { "" } else { "\n" };
            writeln!(out, "{gap}forces            {}", one_line(&forces.names.join(", ")))?;
            forces::write(out, forces, self.elastic_only())?;
        }
        for part in self.mu() {
            let kind = if part.degree() % 2 == 0 { "conservative" } else { "dissipative" };
            let kind = if self.turns_inside() || kind == "dissipative" { kind } else { "elastic" };
            section(out, &format!("torque mu, degree {} ({kind}), N m", part.degree()), &part)?;
        }
        for part in self.angular_momentum() {
            section(out, &format!("angular momentum K, degree {}, N m s", part.degree()), part)?;
        }
        self.write_displacements(out)
    }
}

impl Derived<'_> {
    /// Displacements on the slow manifold, three at a time; above [`MAX_PRINTED`] coordinates a line names the JSON export. (R4)
    fn write_displacements(&self, out: &mut String) -> fmt::Result {
        let (elastic, degrees) = (self.body.elastic(), self.displacements());
        if elastic == 0 || degrees.is_empty() {
            return Ok(());
        }
        if elastic > MAX_PRINTED {
            return writeln!(
                out,
                "\ndisplacements q(w)  of {elastic} internal coordinates: with --format json"
            );
        }
        writeln!(out, "\ninternal coordinates")?;
        for (number, coordinate) in self.body.coordinates()[..elastic].iter().enumerate() {
            writeln!(
                out,
                "  q{:<3} {}, {}",
                number + 1,
                one_line(&coordinate.name.replace('"', "")),
                coordinate.unit
            )?;
        }
        for part in &degrees {
            for start in (0..elastic).step_by(3) {
                let some = rows(part, start..elastic.min(start + 3));
                let names: Vec<String> = (0..some.rows()).map(|i| format!("q{}", start + i + 1)).collect();
                let title = format!("displacements {}, degree {}", names.join(" "), part.degree());
                table(out, &title, &names, &some, SHOWN * part.amax())?;
            }
        }
        Ok(())
    }
}

fn section(out: &mut String, title: &str, part: &Homogeneous) -> fmt::Result {
    table(out, title, &["x".into(), "y".into(), "z".into()], part, SHOWN * part.amax())
}

/// A map, a row for each monomial with a coefficient above the smallest.
fn table(out: &mut String, title: &str, names: &[String], part: &Homogeneous, smallest: f64) -> fmt::Result {
    writeln!(out, "\n{title}")?;
    let mut shown = part.terms().filter(|(_, value)| value.iter().any(|c| c.abs() > smallest)).peekable();
    if shown.peek().is_none() {
        return writeln!(out, "  zero");
    }
    let line = |entries: &[String]| entries.iter().map(|entry| format!(" {entry:>17}")).collect::<String>();
    writeln!(out, "  {:<18}{}", "monomial", line(names))?;
    for (exponents, value) in shown {
        let clean = |c: &f64| if c.abs() > smallest { format!("{c:.9e}") } else { "0".into() };
        let entries: Vec<String> = value.iter().map(clean).collect();
        writeln!(out, "  {:<18}{}", monomial(exponents), line(&entries))?;
    }
    Ok(())
}

/// A monomial as people write it: `wx^2 wz`.
fn monomial(exponents: [usize; 3]) -> String {
    let factors = exponents.iter().zip(["wx", "wy", "wz"]).filter(|(power, _)| **power > 0);
    let texts =
        factors.map(|(power, name)| if *power == 1 { name.into() } else { format!("{name}^{power}") });
    texts.collect::<Vec<String>>().join(" ")
}

pub(super) fn vector(entries: [f64; 3]) -> String {
    let size = entries.iter().fold(0.0_f64, |size, entry| size.max(entry.abs()));
    let entries = entries.map(|entry| if entry.abs() > SHOWN * size { entry } else { 0.0 });
    entries.map(|entry| format!("{:>13}", number(entry))).join(" ")
}

/// Seven significant digits, without exponent where that is readable.
pub(super) fn number(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 {
        "0".into()
    } else if (1e-3..1e6).contains(&size) {
        let decimals = (6 - size.log10().floor() as i32).max(0) as usize;
        format!("{value:.decimals$}")
    } else {
        format!("{value:.6e}")
    }
}
