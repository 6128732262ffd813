//! The check for machines. First paragraphs of the fields are the reference of `--json` in the guide.

use std::collections::BTreeMap;

use quasirigid_io::record::{
    CriterionRecord, LiquidRecord, ResolutionRecord, ShapeFileRecord, SteadySpinRecord,
};
use serde::Serialize;
use serde_json::{Value, json};

use quasirigid::reduction::Verdict;

use super::CheckReport;
use crate::liquids::{Liquid, liquids};
use crate::record;
use crate::shapes;
use crate::tanks::TankObject;
use crate::words::{reasons, word};

/// Validity of the reduced equations.
#[derive(Serialize)]
struct CheckObject<'a> {
    /// Title of the model.
    name: &'a str,
    /// Order that is judged.
    order: usize,
    /// Whether no criterion fails.
    valid: bool,
    /// On the motion: `holds`, `marginal` or `fails` (not valid), as every verdict.
    verdict: &'a str,
    /// On the power, (V11).
    dissipation_verdict: &'a str,
    /// On averages along rigid polhodes, (V10).
    averages: &'a str,
    /// Reasons for the verdict.
    reasons: Vec<String>,
    /// Time (s), (V1).
    T1: f64,
    /// Time (s), `null` for a vibration that does not decay.
    T2: Option<f64>,
    /// Time (s).
    T3: f64,
    /// With the attitude fixed (rad/s).
    frequencies: &'a [f64],
    /// With the attitude free (rad/s).
    free_frequencies: &'a [f64],
    /// Decay rates (1/s).
    decay_rates: &'a [f64],
    /// Of rotors and liquids (s).
    relaxation_times: &'a [f64],
    /// Criteria.
    criteria: Vec<CriterionRecord>,
    /// Sizes of the degrees, (R14).
    degrees: Vec<DegreeObject>,
    /// Order at which the terms are smallest.
    optimal_order: usize,
    /// Which equations hold: `rest`, `spin`, or `none`.
    reduction: &'a str,
    /// Where `rest` fails, or `null`.
    about_spin: Option<AboutSpinObject<'a>>,
    /// Shares.
    dissipation: &'a BTreeMap<String, f64>,
    /// As above.
    steady_spins: &'a [SteadySpinRecord],
    /// Effects left out of the equations of motion.
    left_out: Vec<String>,
    /// Left out of files or repaired in them, with counts.
    files: &'a [String],
    /// In cavities.
    liquids: Vec<LiquidRecord>,
    /// Partly full, with their slosh.
    tanks: Vec<TankObject<'a>>,
    /// Files of shapes, as they were read.
    shapes: Vec<ShapeFileRecord>,
    /// Of a solid inside a surface, or `null`.
    resolution: Option<ResolutionRecord>,
    /// Of finite elements, or `null`.
    condensation: Option<CondensationObject>,
}

/// Size of one degree of the equations.
#[derive(Serialize)]
struct DegreeObject {
    /// In the angular velocity.
    degree: usize,
    /// Largest over directions of the spin (rad/s²).
    size: f64,
}

/// Reduced equations about the spin, where those about rest fail.
#[derive(Serialize)]
struct AboutSpinObject<'a> {
    /// At the start.
    holds: bool,
    /// In words.
    sentence: &'a str,
    /// As of `derive --about spin`, without polynomials.
    equations: &'a Value,
}

/// Condensation of finite elements.
#[derive(Serialize)]
struct CondensationObject {
    /// Before.
    unknowns: usize,
    /// After.
    coordinates: usize,
    /// Bound on the relative energy lost.
    left_out: f64,
}

impl CheckReport<'_> {
    /// For machines.
    #[must_use]
    pub fn json(&self) -> Value {
        let Self { study, validity, budget, spins, left_out, .. } = self;
        let degrees =
            validity.degrees.iter().map(|each| DegreeObject { degree: each.degree, size: each.size });
        json!(CheckObject {
            name: &study.model.name,
            order: self.order,
            valid: validity.verdict() != Verdict::Fails && left_out.flow.is_none() && self.sliding.is_none(),
            verdict: word(if self.sliding.is_some() { Verdict::Fails } else { validity.verdict() }),
            dissipation_verdict: word(validity.dissipation()),
            averages: word(validity.averages()),
            reasons: self.sliding.iter().cloned().chain(reasons(validity)).collect(),
            T1: validity.T1,
            T2: Some(validity.T2).filter(|time| time.is_finite()),
            T3: validity.T3,
            frequencies: &validity.vibrations.frequencies,
            free_frequencies: &validity.vibrations.free_frequencies,
            decay_rates: &validity.vibrations.decay_rates,
            relaxation_times: &validity.relaxation.times,
            criteria: record::validity(validity).criteria,
            degrees: degrees.collect(),
            optimal_order: validity.optimal_order,
            reduction: self.reduction(),
            about_spin: self.about_spin.as_ref().map(|about| AboutSpinObject {
                holds: about.holds,
                sentence: &about.sentence,
                equations: &about.json,
            }),
            dissipation: budget,
            steady_spins: spins,
            left_out: left_out.notes(),
            files: &study.model.file_notes,
            liquids: liquids(study, validity.T3.recip()).iter().map(Liquid::record).collect(),
            tanks: TankObject::all(study),
            shapes: shapes::records(study),
            resolution: record::resolution(study).next(),
            condensation: study.condensation.map(|known| CondensationObject {
                unknowns: known.unknowns,
                coordinates: known.coordinates,
                left_out: known.left_out,
            }),
        })
    }
}
