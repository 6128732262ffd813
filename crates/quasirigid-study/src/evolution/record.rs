//! Record of an evolution: the fields that every method fills, those of one without an answer, and those of a principal axis.

use std::collections::BTreeMap;

use quasirigid::averaging::{Evolution, FreeRotation, MeanPower, RotationState};
use quasirigid::model::Mode;
use quasirigid_io::model::BodyKind;
use quasirigid_io::record::{Column, CrossingRecord, EvolutionRecord, HarmonicRecord, ObservedRecord};

use super::answer::{Answer, modal_folding};
use super::approach::approach;
use super::columns::observed;
use super::method::Rates;
use super::reason::Reason;
use super::table::EvolutionTable;
use super::verdict::{Verdict, road, source_of_power};
use super::{refusals, words};
use crate::settings::EvolveSettings;
use crate::words::shares;

/// Shares of harmonics below this are negligible and not listed, nor are more than so many harmonics.
pub const FAINT: f64 = 1e-4;
const MOST_HARMONICS: usize = 12;
/// Resonances listed.
const MOST_CROSSINGS: usize = 12;

/// Record without a result, of an angular momentum (N·m·s) and the name of a mode.
pub fn blank(angular_momentum: f64, mode: &str) -> EvolutionRecord {
    EvolutionRecord {
        sentence: String::new(),
        road: String::new(),
        verdict: String::new(),
        method: String::new(),
        status: String::new(),
        message: String::new(),
        angular_momentum,
        mode_start: mode.into(),
        mode_end: mode.into(),
        ratio_start: f64::NAN,
        ratio_end: f64::NAN,
        start: None,
        end: None,
        time: f64::NAN,
        time_error: None,
        time_range: None,
        revolutions: f64::NAN,
        power: f64::NAN,
        dissipation: BTreeMap::new(),
        separatrix_time: None,
        lingering: None,
        damping_time: f64::NAN,
        growth_time: f64::NAN,
        not_known: Vec::new(),
        estimates: Vec::new(),
        homogeneous: None,
        harmonics: Vec::new(),
        resonances: Vec::new(),
        approach: None,
        columns: Vec::new(),
    }
}

/// Record of an evolution that no method leads along, with the times (s) in which a small wobble falls and grows.
pub fn refused(
    message: &str,
    [damping_time, growth_time]: [f64; 2],
    blank: EvolutionRecord,
) -> EvolutionRecord {
    EvolutionRecord {
        sentence: format!("NO ANSWER: {message}."),
        road: "none".into(),
        method: "none: no method holds here".into(),
        status: "refused".into(),
        message: format!("No answer: {message}."),
        damping_time,
        growth_time,
        ..blank
    }
    .with_unknown_named()
}

/// Record of a body without momentum wheels that no method leads along, from a rotation of it.
pub fn refused_from(
    initial: &FreeRotation,
    reason: &Reason,
    rates: Option<Rates>,
    kind: BodyKind,
) -> EvolutionRecord {
    let times = [Mode::ShortAxis, Mode::LongAxis].map(|mode| modal_folding(rates, mode).unwrap_or(f64::NAN));
    let blank = blank(initial.angular_momentum(), mode(initial.mode()));
    refused(&refusals::text(reason, kind, false), times, blank)
}

impl Answer<'_> {
    /// Whether anything changes from a rotation state on.
    pub fn ages(&self, from: RotationState, rows: &EvolutionTable) -> bool {
        !rows.steady() || rows.powers.is_some() || self.evolution().power(from) > 0.0
    }

    /// Record of the rows and their columns, from a rotation state on; `time_range` are the times (s) over the ranges of the materials.
    pub fn record(
        &self,
        verdict: Verdict,
        from: RotationState,
        rows: &EvolutionTable,
        asked: &EvolveSettings,
        time_range: Option<[f64; 2]>,
        columns: Vec<Column>,
    ) -> EvolutionRecord {
        let evolution = &self.evolution();
        let last = rows.last();
        let to = last.rotation_state;
        let power = rows.powers.as_ref().map_or_else(|| evolution.power(from), |powers| powers[0]);
        let ages = self.ages(from, rows);
        let [start, end] = [0, rows.states.len().saturating_sub(1)].map(|row| observed(&columns, row));
        // Levels of the slow energy have ratios of their own, which the rotation states of a rigid body do not tell.
        let of_levels = |observed: &Option<ObservedRecord>, rotation_state| {
            let level = rows.levels.as_ref().and(observed.as_ref());
            level.map_or_else(|| evolution.ratio(rotation_state), |level| level.energy_ratio.recip())
        };
        let [ratio_start, ratio_end] = [of_levels(&start, from), of_levels(&end, to)];
        let mut record = EvolutionRecord {
            road: road(self.method).into(),
            method: source_of_power(self.method, self.source, self.inputs.order, asked.kind),
            status: if verdict.fails { "does-not-hold" } else { rows.status }.into(),
            message: if verdict.fails { verdict.sentence.clone() } else { words::message(rows, asked, ages) },
            verdict: verdict.sentence,
            mode_end: mode(to.mode).into(),
            ratio_start,
            ratio_end,
            start,
            end, // none of work that was told to end before its first row
            time: if ages { last.t } else { f64::INFINITY },
            time_error: verdict.error,
            time_range,
            revolutions: if ages { last.revolutions } else { f64::INFINITY },
            power,
            dissipation: shares(self.budget.as_ref().unwrap_or(&evolution.budget(from))),
            separatrix_time: if rows.steady() {
                evolution.separatrix_time(from, to)
            } else {
                rows.crossing()
            },
            lingering: if rows.steady() && self.has_separatrix() {
                evolution.lingering(from, to)
            } else {
                None
            },
            damping_time: modal_folding(self.rates, Mode::ShortAxis)
                .unwrap_or_else(|| self.damping_time(evolution)),
            growth_time: modal_folding(self.rates, Mode::LongAxis)
                .unwrap_or_else(|| folding(evolution, Mode::LongAxis)),
            harmonics: self.harmonics(&evolution.motion(from)),
            resonances: self.resonances(evolution, from, to),
            approach: approach(&self.inputs.powers.response, evolution, [from, to]),
            columns,
            ..blank(self.initial.angular_momentum(), mode(from.mode))
        };
        record.sentence = words::sentence(&record, rows.drift.as_ref(), asked.kind);
        let takes = |motion: FreeRotation| self.inputs.powers.response.mean_power(&motion) > 0.0;
        if !ages && self.by_polynomial() && takes(evolution.motion(from)) {
            record.sentence = words::lossless(self.inputs.order, asked.kind);
        }
        record.with_unknown_named()
    }

    /// Whether three moments differ, so that a separatrix lies between the axes.
    fn has_separatrix(&self) -> bool {
        [Mode::LongAxis, Mode::ShortAxis].iter().all(|mode| mode.exists(self.principal.moments))
    }

    /// Time (s) in which a small wobble about the axis of greatest inertia, or about the plane of the two greatest equal moments, falls by e.
    fn damping_time(&self, evolution: &Evolution) -> f64 {
        if Mode::ShortAxis.exists(self.principal.moments) {
            return folding(evolution, Mode::ShortAxis);
        }
        evolution.plane_rate().map_or(f64::NAN, f64::recip)
    }

    fn harmonics(&self, motion: &FreeRotation) -> Vec<HarmonicRecord> {
        let response = &self.inputs.powers.response;
        let powers: Vec<(f64, f64)> = response.harmonic_powers(motion).collect();
        let sum: f64 = powers.iter().map(|(_, power)| power).sum();
        let names: Vec<&str> = response.dissipators().collect();
        let parts = |taken: Vec<f64>| {
            names.iter().zip(taken).map(|(name, power)| ((*name).to_owned(), power / sum)).collect()
        };
        let listed = powers.iter().zip(response.harmonic_budgets(motion)).enumerate();
        let record = |(i, ((frequency, power), taken)): (usize, (&(f64, f64), Vec<f64>))| HarmonicRecord {
            number: i + 1,
            frequency: *frequency,
            share: power / sum,
            dissipation: parts(taken),
        };
        listed.map(record).filter(|harmonic| harmonic.share > FAINT).take(MOST_HARMONICS).collect()
    }

    fn resonances(
        &self,
        evolution: &Evolution,
        from: RotationState,
        to: RotationState,
    ) -> Vec<CrossingRecord> {
        let way = evolution.ratio(from)..=evolution.ratio(to);
        let crossings = self.inputs.powers.response.resonances(evolution).into_iter();
        crossings
            .filter(|crossing| way.contains(&evolution.ratio(crossing.rotation_state)))
            .take(MOST_CROSSINGS)
            .map(|crossing| CrossingRecord {
                harmonic: crossing.harmonic,
                frequency: crossing.frequency,
                ratio: evolution.ratio(crossing.rotation_state),
                mode: mode(crossing.rotation_state.mode).into(),
                coordinate: crossing.coordinate,
                share: crossing.share,
            })
            .collect()
    }
}

/// Time (s) in which a small wobble about the axis of a mode changes by e; infinite where there is no such axis, or no loss.
fn folding(evolution: &Evolution, mode: Mode) -> f64 {
    let rate = evolution.wobble_rate(mode);
    if rate > 0.0 { rate.recip() } else { f64::INFINITY }
}

/// The name of a mode.
fn mode(mode: Mode) -> &'static str {
    match mode {
        Mode::ShortAxis => "short-axis",
        Mode::LongAxis => "long-axis",
    }
}
