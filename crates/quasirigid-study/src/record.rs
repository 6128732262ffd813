//! Results of the library as parts of a run record.

use quasirigid::dynamics::{Event, Missed, Options, Outcome, Ringing, Run};
use quasirigid::model::{FlexibleBody, Principal, ReducedBody, Support};
use quasirigid::reduction::{Validity, Verdict, residual};
use quasirigid::verification::{AverageRow, Difference, OrderRow, VerificationPlan};
use quasirigid_io::model::{Model, Named, System};
use quasirigid_io::record::{
    AverageRecord, BodyRecord, Column, CriterionRecord, DegreeRecord, HistoryRecord, ModelRecord,
    OrderRecord, ReductionRecord, ResolutionRecord, RingingRecord, UNFINISHED, ValidityRecord,
    VerificationRecord,
};
use quasirigid_math::ode::Work;

use crate::history_sink::Followed;
use crate::inputs::named_files;
use crate::study::Study;
use crate::verification::Proof;
use crate::{resolution, words};

/// The model a record is made from.
pub fn model(model: &Model) -> ModelRecord {
    let file = model.source.file.file_name().unwrap_or(model.source.file.as_os_str());
    ModelRecord {
        name: model.name.clone(),
        file: file.to_string_lossy().into_owned(),
        sha256: model.source.sha256.clone(),
        files: named_files(model).collect(),
    }
}

/// The frozen body.
pub fn body(study: &Study) -> BodyRecord {
    let body = &study.body;
    let principal = Principal::compute(body.invariants().J);
    BodyRecord {
        mass: body.invariants().mass,
        center_of_mass: body.center_of_mass(),
        pole: body.pole(),
        support: match body.support() {
            Support::Free => "free".into(),
            Support::FixedPoint { .. } => "fixed-point".into(),
            Support::Prescribed { .. } => "prescribed".into(),
        },
        inertia: body.inertia(),
        kind: study.model.kind,
        principal_moments: principal.moments,
        principal_axes: principal.axes,
        coordinates: body.coordinates().iter().map(|coordinate| coordinate.name.clone()).collect(),
        resolution: resolution(study).next(),
    }
}

/// Resolution of the shape of a solid inside a surface.
pub fn resolution(study: &Study) -> impl Iterator<Item = ResolutionRecord> + '_ {
    let solids = study.model.assembly.surfaces.iter().zip(&study.resolution);
    solids.map(|(solid, found)| resolution::record(&solid.name, found))
}

/// Validity of the reduced equations.
pub fn validity(validity: &Validity) -> ValidityRecord {
    let criteria = validity.criteria.iter().map(|criterion| {
        let words = words::criterion(criterion, validity);
        CriterionRecord {
            name: words.name.into(),
            symbol: words.symbol.into(),
            value: criterion.value,
            limit: criterion.limit(),
            verdict: words::word(criterion.verdict()).into(),
            sentence: words.sentence,
        }
    });
    ValidityRecord {
        valid: validity.verdict() != Verdict::Fails,
        verdict: words::verdict(validity),
        overall: words::word(validity.verdict()).into(),
        T1: validity.T1,
        T2: validity.T2.is_finite().then_some(validity.T2),
        T3: validity.T3,
        frequencies: validity.vibrations.frequencies.clone(),
        decay_rates: validity.vibrations.decay_rates.clone(),
        relaxations: validity.relaxation.times.clone(),
        criteria: criteria.collect(),
    }
}

/// The reduced equations at the initial spin.
pub fn reduction(
    flexible: &FlexibleBody,
    reduced: &ReducedBody,
    validity: &Validity,
    omega: [f64; 3],
) -> ReductionRecord {
    let euler = validity.degrees.first().map_or(0.0, |degree| degree.size);
    let degrees = validity.degrees.iter().map(|degree| DegreeRecord {
        degree: degree.degree,
        size: degree.size,
        relative: if euler > 0.0 { degree.size / euler } else { 0.0 },
    });
    let residual = residual(flexible, reduced, omega);
    ReductionRecord {
        order: reduced.order,
        optimal_order: validity.optimal_order,
        residual: residual.elastic.max(residual.cyclic),
        degrees: degrees.collect(),
        power: reduced.dissipated_power(omega),
        dissipation: words::shares(&reduced.power_budget(omega)),
    }
}

/// The reduced equations against the full ones.
pub fn verification(plan: &VerificationPlan, Proof { verification, average }: &Proof) -> VerificationRecord {
    let row = |row: &OrderRow| {
        let of = |value: fn(&Difference) -> f64| row.differences.iter().map(value).collect();
        OrderRecord {
            p: row.p,
            form: row.form.recorded().into(),
            order: row.order,
            expected: row.p + 1,
            reached: row.reached(),
            epsilons: verification.epsilons.clone(),
            errors: of(|difference| difference.omega),
            attitude: of(|difference| difference.attitude),
            dissipated: of(|difference| difference.dissipated),
            dissipation: of(|difference| difference.dissipation),
        }
    };
    VerificationRecord {
        reached: verification.reached() && average.as_ref().map_or(true, AverageRow::reached),
        rotations: plan.rotations,
        duration: verification.duration,
        orders: verification.rows.iter().map(row).collect(),
        average_left_out: average.as_ref().err().map(|why| format!("The average is left out: {why}.")),
        average: average.as_ref().ok().map(|row| AverageRecord {
            epsilons: row.epsilons.clone(),
            errors: row.errors.clone(),
            order: row.order,
            expected: row.expected,
            reached: row.reached(),
        }),
    }
}

/// A history of some `equations`, in words, that is in work.
pub fn unfinished(system: System, equations: &str, options: &Options, columns: Vec<Column>) -> HistoryRecord {
    HistoryRecord {
        system: system.recorded().into(),
        form: equations.into(),
        method: method(system, Work::default()),
        status: UNFINISHED.into(),
        message: "the run was interrupted; quasirigid run with --resume continues it".into(),
        tolerance: options.tolerance,
        steps: 0,
        rejected: 0,
        revolutions: f64::NAN,
        energy: f64::NAN,
        dissipated: f64::NAN,
        dissipation: std::collections::BTreeMap::new(),
        work: f64::NAN,
        energy_drift: f64::NAN,
        left_out: f64::NAN,
        load_ratio: 0.0,
        ringing: None,
        momentum_drift: f64::NAN,
        rows: 0,
        columns,
        log: None,
    }
}

/// A spin history of some `equations`, in words.
pub fn history(
    system: System,
    equations: &str,
    options: &Options,
    followed: Followed,
    (study, run): (&Study, &Run),
) -> HistoryRecord {
    let (status, message) = status(study, run.outcome, run.last.t);
    HistoryRecord {
        system: system.recorded().into(),
        form: equations.into(),
        method: method(system, run.work),
        status: status.into(),
        message,
        tolerance: options.tolerance,
        steps: run.work.steps,
        rejected: run.work.rejected,
        revolutions: run.last.revolutions,
        energy: followed.energy,
        dissipated: run.last.dissipated,
        dissipation: words::shares(&followed.budget),
        work: run.last.work,
        energy_drift: run.last.energy_drift,
        left_out: run.left_out,
        load_ratio: run.load_ratio,
        ringing: run.ringing.map(|Ringing { from, to, omega, share }| RingingRecord {
            from,
            to,
            omega,
            share,
        }),
        momentum_drift: run.last.momentum_drift,
        rows: followed.rows,
        columns: followed.columns,
        log: followed.log,
    }
}

/// Integration of a system, in words.
fn method(system: System, work: Work) -> String {
    let explicit = work.steps - work.implicit_steps;
    match (system, work.implicit_steps, explicit) {
        (System::Reduced | System::Rigid | System::SpinManifold, ..) | (_, 0, _) => {
            "explicit Runge-Kutta of order 8 (DOP853)".into()
        }
        (_, _, 0) => "implicit Runge-Kutta of order 13 (Radau IIA)".into(),
        (_, implicit, explicit) => format!(
            "{explicit} steps explicit (DOP853) while vibrations had to be followed, {implicit} implicit (Radau IIA, order 13)"
        ),
    }
}

/// End of a run: a word, and a sentence.
pub fn status(study: &Study, outcome: Outcome, t: f64) -> (&'static str, String) {
    match outcome {
        Outcome::Finished => ("finished", "the run reached its end".into()),
        Outcome::Interrupted => ("interrupted", format!("the run was interrupted at t = {t} s")),
        Outcome::StepLimit => {
            ("step-limit", format!("the run reached its step limit at t = {t} s; loosen the tolerance"))
        }
        Outcome::LeftRange(left) => {
            ("left-validity", format!("{} at t = {t} s", words::displaced(&study.body, left)))
        }
        Outcome::Missed(slides @ Missed::Slides { .. }) => ("sliding", slides.to_string()),
        Outcome::Missed(missed) => ("missed-force", missed.to_string()),
        Outcome::Failed(error) => ("failed", error.to_string()),
        Outcome::Event(Event::Energy(energy)) => {
            ("event", format!("the energy passed {energy} J at t = {t} s, where the run was to stop"))
        }
        Outcome::Event(Event::Nutation { angle, .. }) => (
            "event",
            format!(
                "the {} passed {} degrees at t = {t} s, where the run was to stop",
                study.model.kind.nutation(),
                angle.to_degrees()
            ),
        ),
        Outcome::Event(Event::Validity { limit, .. }) => (
            "left-validity",
            format!(
                "the spin passed {limit} of the slowest elastic frequency at t = {t} s: the theory ends there"
            ),
        ),
    }
}
