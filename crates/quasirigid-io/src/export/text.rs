use std::fmt::{self, Write};

use quasirigid::math::polynomial::Homogeneous;
use quasirigid::model::{Principal, Support};

use super::{Derived, comparison};

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
        let Derived { name, body, reduced, frequencies, mechanisms } = *self;
        let principal = Principal::of(reduced.J);
        writeln!(out, "{name}: reduced equations of order {}", reduced.order)?;
        let wheels = body.wheels().momentum(0.0);
        let equation = if body.wheels().is_none() {
            "J w' + w x Jw = mu(w)        w in rad/s"
        } else {
            "J w' + w x (Jw + k) = mu(w)  w in rad/s"
        };
        writeln!(out, "\n  {equation}, body axes, SI units throughout\n")?;
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
        if !body.wheels().is_none() {
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
        for part in self.mu() {
            let kind = if part.degree() % 2 == 0 { "conservative" } else { "dissipative" };
            let kind = if self.turns_inside() || kind == "dissipative" { kind } else { "elastic" };
            section(out, &format!("torque mu, degree {} ({kind}), N m", part.degree()), &part)?;
        }
        for part in self.momentum() {
            section(out, &format!("momentum K, degree {}, N m s", part.degree()), part)?;
        }
        Ok(())
    }
}

fn section(out: &mut String, title: &str, part: &Homogeneous) -> fmt::Result {
    writeln!(out, "\n{title}")?;
    let smallest = SHOWN * part.amax();
    let mut shown = part.terms().filter(|(_, value)| value.iter().any(|c| c.abs() > smallest)).peekable();
    if shown.peek().is_none() {
        return writeln!(out, "  zero");
    }
    writeln!(out, "  {:<18} {:>17} {:>17} {:>17}", "monomial", "x", "y", "z")?;
    for (exponents, value) in shown {
        let clean = |c: f64| if c.abs() > smallest { format!("{c:.9e}") } else { "0".into() };
        let [x, y, z] = [value[0], value[1], value[2]].map(clean);
        writeln!(out, "  {:<18} {x:>17} {y:>17} {z:>17}", monomial(exponents))?;
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

fn vector(entries: [f64; 3]) -> String {
    let size = entries.iter().fold(0.0_f64, |size, entry| size.max(entry.abs()));
    let entries = entries.map(|entry| if entry.abs() > SHOWN * size { entry } else { 0.0 });
    entries.map(|entry| format!("{:>13}", number(entry))).join(" ")
}

/// Seven significant digits, without exponent where that is readable.
fn number(value: f64) -> String {
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
