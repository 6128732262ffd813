//! Reduced equations about a spin, for a terminal of 80 columns.

use std::fmt::{self, Write};

use quasirigid::submanifold::{BackbonePoint, Style};
use quasirigid_io::record::place_of_spin;
use quasirigid_io::visible::one_line;
use quasirigid_math::vec3::norm;

use super::{AboutSpin, WITHIN};
use crate::layout::paragraph;
use crate::words::{dissipation, shares, significant, time};

/// Rows of the backbone.
const BACKBONE_ROWS: usize = 8;
/// Modes left out that are listed, and coefficients of each rate.
const LISTED: usize = 8;
const COEFFICIENTS: usize = 40;
/// Share of the largest coefficient of a degree below which a coefficient is rounding.
const COEFFICIENT_ROUNDING: f64 = 1e-13;

impl AboutSpin<'_> {
    /// For a terminal of 80 columns.
    #[must_use]
    pub fn text(&self) -> String {
        let mut text = String::new();
        self.write(&mut text).expect("a string takes any text");
        text
    }

    /// Masters that lead their pair of conjugates.
    pub(super) fn leads(&self) -> impl Iterator<Item = usize> + '_ {
        let masters = &self.manifold.expansion().masters;
        (0..masters.len()).filter(|k| masters[*k].partner >= *k)
    }

    /// Names of the coordinates: `z1` and its conjugate `z1*`, then those of the next master.
    pub(super) fn variables(&self) -> Vec<String> {
        let masters = &self.manifold.expansion().masters;
        let mut names = vec![String::new(); masters.len()];
        for (number, lead) in self.leads().enumerate() {
            let partner = masters[lead].partner;
            names[partner] = format!("z{}*", number + 1);
            names[lead] = format!("z{}", number + 1);
        }
        names
    }

    fn write(&self, out: &mut String) -> fmt::Result {
        let told = format!("{}: {}", one_line(&self.study.model.name), self.sentence());
        writeln!(out, "{}", paragraph(&told, "", "  "))?;
        self.left_out.notes().iter().try_for_each(|note| writeln!(out, "{}", paragraph(note, "  ", "  ")))?;
        self.write_spin(out)?;
        self.write_masters(out)?;
        self.write_backbone(out)?;
        self.write_outer(out)?;
        self.write_resonances(out)?;
        self.write_rates(out)
    }

    /// The place of the steady spin, in words.
    fn about(&self) -> String {
        match self.name {
            energy if energy.ends_with("energy") => format!(" of {energy}"),
            axis => format!(" about {}", place_of_spin(axis)),
        }
    }

    fn write_spin(&self, out: &mut String) -> fmt::Result {
        let spin = &self.manifold.spin;
        let list = |vector: [f64; 3]| vector.map(|entry| significant(entry, 6)).join(", ");
        writeln!(out, "\nSteady spin{}", self.about())?;
        writeln!(out, "  angular velocity ({}) rad/s", list(spin.omega))?;
        writeln!(out, "  angular momentum {} N m s", significant(norm(spin.angular_momentum), 6))?;
        let coordinates = self.manifold.body.coordinates().iter().zip(&spin.q);
        if let Some((coordinate, q)) = coordinates.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))
            && *q != 0.0
        {
            writeln!(out, "  largest displacement {}: {}", coordinate.name, significant(*q, 3))?;
        }
        if let Some(start) = &self.start {
            let (noun, angle) =
                (self.study.model.kind.nutation(), significant(start.nutation.to_degrees(), 3));
            writeln!(out, "  {noun} of the start {angle} degrees")?;
        }
        Ok(())
    }

    fn write_masters(&self, out: &mut String) -> fmt::Result {
        let style = match self.manifold.style {
            Style::NormalForm => "normal form",
            Style::Graph => "graph",
        };
        let heading = format!("Masters, degree {}, {style}", self.manifold.degree());
        writeln!(out, "\n{heading:<42} {:>14} {:>12}", "e-fold", "rad/s")?;
        for (k, master) in self.manifold.masters.iter().enumerate() {
            let name = format!("z{} {}", k + 1, self.study.model.kind.mode_name(&master.name));
            writeln!(
                out,
                "  {name:<40} {:>14} {:>12}",
                fold(master.decay_rate),
                significant(master.frequency, 6)
            )?;
        }
        Ok(())
    }

    fn write_backbone(&self, out: &mut String) -> fmt::Result {
        let nutation = self.study.model.kind.nutation();
        writeln!(out, "\nBackbone: the {nutation} by its amplitude, other masters at rest")?;
        writeln!(
            out,
            "  {:>10} {:>10} {:>16} {:>12} {:>12} {:>10}",
            "degrees", "|z1|", "e-fold", "rad/s", "W", "defect"
        )?;
        let inner = self.inner();
        let row = |out: &mut String, point: &BackbonePoint| {
            let power: f64 = point.power.iter().map(|(_, power)| power).sum();
            writeln!(
                out,
                "  {:>10} {:>10} {:>16} {:>12} {:>12} {:>10}",
                significant(point.nutation.to_degrees(), 3),
                significant(point.amplitude, 3),
                fold(point.decay_rate),
                significant(point.frequency, 6),
                significant(power, 3),
                percent(point.defect.largest())
            )
        };
        inner.iter().step_by(WITHIN / BACKBONE_ROWS).try_for_each(|point| row(out, point))?;
        for (place, point) in [("small", &inner[1]), ("the widest", &inner[WITHIN])] {
            if let Some(words) = dissipation(&shares(&point.power)) {
                writeln!(out, "{}", paragraph(&format!("at {place} {nutation} {words}"), "  ", "    "))?;
            }
        }
        Ok(())
    }

    fn write_outer(&self, out: &mut String) -> fmt::Result {
        let outer = &self.manifold.outer;
        if outer.is_empty() {
            return Ok(());
        }
        writeln!(out, "\n{:<42} {:>14} {:>12}", "Modes left out", "e-fold", "rad/s")?;
        for mode in outer.iter().take(LISTED) {
            let (fold, frequency) = (fold(mode.decay_rate), significant(mode.frequency, 6));
            writeln!(out, "  {:<40} {fold:>14} {frequency:>12}", mode.name)?;
        }
        if outer.len() > LISTED {
            writeln!(out, "  and {} more (all in JSON)", outer.len() - LISTED)?;
        }
        Ok(())
    }

    /// Resonances with modes left out, near or met within the range, and the onset of whirl, in sentences.
    pub(super) fn resonances(&self) -> Vec<String> {
        let variables = self.variables();
        let near = self.manifold.near_resonances();
        let mut words: Vec<String> = near
            .iter()
            .take(LISTED)
            .map(|(resonance, mode)| {
                format!(
                    "near resonance: {} turns within {} % of {}, {} rad/s",
                    monomial(&variables, &resonance.exponents),
                    significant(100.0 * resonance.distance, 2),
                    mode.name,
                    significant(mode.frequency, 4)
                )
            })
            .collect();
        if near.len() > LISTED {
            words.push(format!("and {} more near resonances (all in JSON)", near.len() - LISTED));
        }
        words.extend(self.crossed.iter().take(LISTED).map(|crossed| {
            format!(
                "at a {} of {} degrees harmonic {} meets {}, {} rad/s, which may be captured: follow its mode too",
                self.study.model.kind.nutation(),
                significant(crossed.nutation.to_degrees(), 3),
                crossed.harmonic,
                crossed.name,
                significant(crossed.frequency, 4)
            )
        }));
        words.extend(self.onset.as_ref().map(|onset| {
            format!(
                "onset of whirl: from {} rad/s on, {} times this spin, a motion of {} grows",
                significant(onset.spin, 4),
                significant(onset.spin / self.manifold.rate(), 3),
                onset.name
            )
        }));
        words
    }

    fn write_resonances(&self, out: &mut String) -> fmt::Result {
        let resonances = self.resonances();
        resonances.iter().try_for_each(|words| writeln!(out, "{}", paragraph(words, "  ", "    ")))
    }

    fn write_rates(&self, out: &mut String) -> fmt::Result {
        let expansion = self.manifold.expansion();
        let variables = self.variables();
        for lead in self.leads() {
            let rates = &expansion.rates[lead];
            writeln!(
                out,
                "\n{:<34} {:>18} {:>18}",
                format!("{}' =", variables[lead]),
                "real, 1/s",
                "imaginary, rad/s"
            )?;
            let size = |at: usize| {
                let [re, im] = rates.coefficient(at);
                re.hypot(im)
            };
            let exponents = expansion.ring.exponents();
            let degree = |at: usize| exponents[at].iter().map(|power| usize::from(*power)).sum::<usize>();
            let largest =
                |of: usize| (0..exponents.len()).filter(|at| degree(*at) == of).map(size).fold(0.0, f64::max);
            let kept: Vec<usize> = (0..exponents.len())
                .filter(|at| size(*at) > COEFFICIENT_ROUNDING * largest(degree(*at)))
                .collect();
            for at in kept.iter().take(COEFFICIENTS) {
                let [re, im] = rates.coefficient(*at);
                let monomial = monomial(&variables, &exponents[*at]);
                writeln!(out, "  {monomial:<32} {:>18} {:>18}", significant(re, 10), significant(im, 10))?;
            }
            if kept.len() > COEFFICIENTS {
                writeln!(out, "  and {} more (all in JSON)", kept.len() - COEFFICIENTS)?;
            }
        }
        Ok(())
    }
}

/// Time in which a motion falls by e.
fn fold(decay_rate: f64) -> String {
    if decay_rate < 0.0 {
        format!("GROWS {}", time(-decay_rate.recip()))
    } else if decay_rate > 0.0 {
        time(decay_rate.recip())
    } else {
        "never".into()
    }
}

fn percent(share: f64) -> String {
    if share.is_finite() { format!("{} %", significant(100.0 * share, 2)) } else { "no end".into() }
}

fn monomial(variables: &[String], exponents: &[u8]) -> String {
    let factor = |(name, power): (&String, &u8)| match power {
        0 => None,
        1 => Some(name.clone()),
        power => Some(format!("{name}^{power}")),
    };
    let factors: Vec<String> = variables.iter().zip(exponents).filter_map(factor).collect();
    if factors.is_empty() { "1".into() } else { factors.join(" ") }
}
