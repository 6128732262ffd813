//! Effective modal masses that a user asks for: cantilever modes, participation factors, and what is left that no mode carries.
//! Equations (M18) to (M20), docs/theory/15-modes.md.

use std::fmt::{self, Write};

use quasirigid::elements::Carrier;
use quasirigid::modes::{CantileverMode, CantileverModes, FreeMode};
use quasirigid_math::vec3::{add, scale};
use serde::Serialize;
use serde_json::{Value, json};

use crate::error::StudyError;
use crate::layout::paragraph;
use crate::study::Study;
use crate::words::{significant, tidied};

/// Effective modal masses of the parts on a held carrier, and modes of the free body at rest; the first paragraph of a field is the reference
/// of `--json` in the guide.
#[derive(Clone, Debug, Serialize)]
pub struct EffectiveMasses {
    /// Title of the model.
    pub name: String,
    /// The answer in words.
    pub sentence: String,
    /// Point that rotations and inertia are about (m), file's frame.
    pub about: [f64; 3],
    /// The whole body.
    pub body: RigidObject,
    /// Parts on the carrier.
    pub parts: RigidObject,
    /// Modes with the carrier held.
    pub cantilever: Vec<CantileverObject>,
    /// Participation factors in translations, a row for each mode (kg^½).
    pub delta_t: Vec<[f64; 3]>,
    /// Participation factors in rotations, a row for each mode (kg^½·m).
    pub delta_r: Vec<[f64; 3]>,
    /// Mass of the parts along each axis that no mode carries (kg).
    pub residual_mass: [f64; 3],
    /// Inertia of the parts about each axis that no mode carries (kg·m²).
    pub residual_inertia: [f64; 3],
    /// Largest share of one mode that dashpots bring into another.
    pub damping_coupling: f64,
    /// Modes of the body at rest, on its support or free.
    pub free: Vec<FreeObject>,
}

/// Mass properties of a rigid body.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct RigidObject {
    /// Mass (kg).
    pub mass: f64,
    /// Centre of mass (m), file's frame.
    pub center_of_mass: [f64; 3],
    /// Inertia tensor about the point (kg·m²).
    pub inertia: [[f64; 3]; 3],
}

/// Cantilever mode.
#[derive(Clone, Debug, Serialize)]
pub struct CantileverObject {
    /// Part or coordinate that moves most.
    pub name: String,
    /// Frequency (rad/s).
    pub frequency: f64,
    /// Damping ratio of the mode alone.
    pub damping_ratio: f64,
    /// Effective masses along the axes (kg).
    pub effective_mass: [f64; 3],
    /// Effective inertias about the axes (kg·m²).
    pub effective_inertia: [f64; 3],
    /// Share of the parts' mass that modes up to this one carry.
    pub cumulative_mass: [f64; 3],
    /// Share of the parts' inertia that modes up to this one carry.
    pub cumulative_inertia: [f64; 3],
}

/// Mode of the body at rest.
#[derive(Clone, Debug, Serialize)]
pub struct FreeObject {
    /// Part or coordinate that moves most.
    pub name: String,
    /// Frequency (rad/s).
    pub frequency: f64,
    /// Damping ratio of the mode alone.
    pub damping_ratio: f64,
    /// Displacement of the carrier at the point, of unit modal mass (kg^-½).
    pub displacement: [f64; 3],
    /// Rotation of the carrier, of unit modal mass (rad kg^-½·m⁻¹).
    pub rotation: [f64; 3],
}

/// Modes listed for people.
const LISTED: usize = 12;
/// Coupling by damping above which people are told.
const COUPLED: f64 = 0.05;
/// Share of the body below which what is left of its parts is rounding.
const LEFT_ROUNDING: f64 = 1e-13;
/// Share of the largest entry below which an entry is rounding.
const ROUNDING: f64 = 1e-9;

impl Study {
    /// Effective modal masses, with rotations about a point (m, file's frame), or about the pole of the body.
    ///
    /// # Errors
    /// [`StudyError::NothingHeld`] for a body without a carrier, [`StudyError::Cantilever`] for one without cantilever modes.
    pub fn effective_masses(&self, about: Option<[f64; 3]>) -> Result<EffectiveMasses, StudyError> {
        self.undriven("effective masses")?;
        let carrier = self.model.assembly.locked_carrier().map_err(|error| self.model.diagnose(&error))?;
        let carrier = carrier.ok_or(StudyError::NothingHeld)?;
        let pole = self.body.pole();
        let about = about.unwrap_or(pole);
        let found = CantileverModes::about(&self.body, add(about, scale(-1.0, pole)));
        let found = found.map_err(StudyError::Cantilever)?;
        let body = RigidObject {
            mass: found.mass,
            center_of_mass: add(about, found.center_of_mass),
            inertia: found.inertia,
        };
        let parts = body.without(&carrier, about);
        let whole = parts.along();
        let mut carried = [0.0; 6];
        let cantilever: Vec<_> =
            found.modes.iter().map(|mode| CantileverObject::new(mode, &mut carried, whole)).collect();
        let left = |axis: usize| {
            let left = whole[axis] - carried[axis];
            if left.abs() > LEFT_ROUNDING * body.along()[axis] { left } else { 0.0 }
        };
        Ok(EffectiveMasses {
            name: self.model.name.clone(),
            sentence: sentence(&cantilever, &parts),
            about,
            body,
            parts,
            delta_t: found.modes.iter().map(|mode| mode.translation).collect(),
            delta_r: found.modes.iter().map(|mode| mode.rotation).collect(),
            cantilever,
            residual_mass: std::array::from_fn(left),
            residual_inertia: std::array::from_fn(|axis| left(3 + axis)),
            damping_coupling: found.damping_coupling,
            free: found.free.into_iter().map(FreeObject::from).collect(),
        })
    }
}

impl RigidObject {
    /// What is left of the body without its carrier, with the inertia about a point.
    fn without(self, carrier: &Carrier, about: [f64; 3]) -> Self {
        let mass = self.mass - carrier.mass;
        let first = add(scale(self.mass, self.center_of_mass), scale(-carrier.mass, carrier.center_of_mass));
        let taken = carrier.inertia_about(about);
        let entry = |i: usize, j: usize| self.inertia[i][j] - taken[i][j];
        Self {
            mass,
            center_of_mass: if mass > 0.0 { scale(mass.recip(), first) } else { self.center_of_mass },
            inertia: std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j))),
        }
    }

    /// Mass along, and inertia about, each axis.
    fn along(&self) -> [f64; 6] {
        std::array::from_fn(|axis| if axis < 3 { self.mass } else { self.inertia[axis - 3][axis - 3] })
    }
}

impl CantileverObject {
    /// The mode, with what it adds to the mass and inertia carried so far.
    fn new(mode: &CantileverMode, carried: &mut [f64; 6], whole: [f64; 6]) -> Self {
        let factors = mode.factors();
        (0..6).for_each(|axis| carried[axis] += factors[axis] * factors[axis]);
        let share = |axis: usize| if whole[axis] > 0.0 { carried[axis] / whole[axis] } else { 0.0 };
        Self {
            name: mode.name.clone(),
            frequency: mode.frequency,
            damping_ratio: mode.damping_ratio,
            effective_mass: mode.effective_mass(),
            effective_inertia: mode.effective_inertia(),
            cumulative_mass: std::array::from_fn(share),
            cumulative_inertia: std::array::from_fn(|axis| share(3 + axis)),
        }
    }
}

impl From<FreeMode> for FreeObject {
    fn from(mode: FreeMode) -> Self {
        let FreeMode { name, frequency, damping_ratio, displacement, rotation } = mode;
        Self { name, frequency, damping_ratio, displacement, rotation }
    }
}

fn sentence(modes: &[CantileverObject], parts: &RigidObject) -> String {
    let Some(last) = modes.last() else { return "There are no parts that move on the carrier.".into() };
    let [x, y, z] = last.cumulative_mass.map(|share| percent(share, 4));
    let count = modes.len();
    let carry = if count == 1 { "cantilever mode carries" } else { "cantilever modes carry" };
    format!(
        "With the carrier held, {count} {carry} {x}, {y} and {z} % of the parts' mass, {} kg, along x, y and z.",
        significant(parts.mass, 4)
    )
}

fn percent(share: f64, digits: i32) -> String {
    significant(percentage(share), digits)
}

/// A share in per cent, without the rounding of its last digits.
fn percentage(share: f64) -> f64 {
    (1e11 * share).round() / 1e9
}

impl EffectiveMasses {
    /// For a terminal of 80 columns: every mode if asked for `all`, else the first.
    #[must_use]
    pub fn text(&self, all: bool) -> String {
        let mut text = String::new();
        self.write(&mut text, if all { usize::MAX } else { LISTED }).expect("a string takes any text");
        text
    }

    /// For machines.
    #[must_use]
    pub fn json(&self) -> Value {
        json!(self)
    }

    fn write(&self, out: &mut String, listed: usize) -> fmt::Result {
        writeln!(out, "{}", paragraph(&format!("{}: {}", self.name, self.sentence), "", "  "))?;
        if self.damping_coupling > COUPLED {
            let share = significant(100.0 * self.damping_coupling, 2);
            let told =
                format!("Dashpots couple the modes by up to {share} %: zeta is that of each mode alone.");
            writeln!(out, "{}", paragraph(&told, "  ", "  "))?;
        }
        let [x, y, z] = tidied(self.about).map(|entry| significant(entry, 6));
        writeln!(out, "  rotations about ({x}, {y}, {z}) m")?;
        writeln!(out, "\n  {:>3} {:>12} {:>12} {:>9}  mode", "", "rad/s", "Hz", "zeta")?;
        for (number, mode) in (1..).zip(&self.cantilever).take(listed) {
            let rates = [mode.frequency, mode.frequency / std::f64::consts::TAU];
            let [rate, hertz] = rates.map(|value| significant(value, 5));
            let zeta = significant(mode.damping_ratio, 3);
            writeln!(out, "  {number:>3} {rate:>12} {hertz:>12} {zeta:>9}  {}", mode.name)?;
        }
        let factors = self.delta_t.iter().zip(&self.delta_r);
        let title = "participation factors: translations (kg^1/2), rotations (kg^1/2 m)";
        rows(out, title, factors.map(|(t, r)| joined(t, r)).take(listed), "")?;
        let effective =
            self.cantilever.iter().map(|mode| joined(&mode.effective_mass, &mode.effective_inertia));
        rows(out, "effective masses (kg) and inertias (kg m^2)", effective.take(listed), "")?;
        let residual = joined(&self.residual_mass, &self.residual_inertia);
        rows(out, "mass and inertia of the parts that no mode carries", std::iter::once(residual), "-")?;
        let shares = self
            .cantilever
            .iter()
            .map(|mode| joined(&mode.cumulative_mass, &mode.cumulative_inertia).map(percentage));
        rows(out, "carried up to each mode, % of the parts", shares.take(listed), "")?;
        if self.cantilever.len() > listed {
            writeln!(out, "  and {} more (--all lists them)", self.cantilever.len() - listed)?;
        }
        let free = self.free.iter().take(listed).map(|mode| significant(mode.frequency, 5));
        let free = free.collect::<Vec<_>>().join(", ");
        writeln!(out, "\n{}", paragraph(&format!("free at rest: {free} rad/s"), "  ", "    "))
    }
}

/// Three entries for translations, three for rotations.
fn joined([x, y, z]: &[f64; 3], [a, b, c]: &[f64; 3]) -> [f64; 6] {
    [*x, *y, *z, *a, *b, *c]
}

/// A table of six columns; rows are numbered, or have one mark.
fn rows(out: &mut String, title: &str, rows: impl Iterator<Item = [f64; 6]>, mark: &str) -> fmt::Result {
    let rows: Vec<[f64; 6]> = rows.collect();
    let largest = |range: std::ops::Range<usize>| {
        rows.iter().flat_map(|row| &row[range.clone()]).fold(0.0_f64, |most, entry| most.max(entry.abs()))
    };
    let least = [ROUNDING * largest(0..3), ROUNDING * largest(3..6)];
    writeln!(out, "\n  {title}")?;
    writeln!(out, "      {}", ["x", "y", "z", "x", "y", "z"].map(|axis| format!("{axis:>11}")).concat())?;
    for (number, row) in (1..).zip(&rows) {
        let number = if mark.is_empty() { number.to_string() } else { mark.to_owned() };
        let entry = |(axis, entry): (usize, &f64)| {
            let rounding = entry.abs() <= least[axis / 3];
            format!("{:>11}", significant(if rounding { 0.0 } else { *entry }, 4))
        };
        writeln!(out, "  {number:>3} {}", row.iter().enumerate().map(entry).collect::<String>())?;
    }
    Ok(())
}
