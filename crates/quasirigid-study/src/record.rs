//! What the library computed, as a run record.

use quasirigid::dynamics::{Event, Nutation, Nutations, Options, Outcome, Run, Sample};
use quasirigid::model::{Coordinate, FlexibleBody, Marker, Principal, ReducedBody, Support};
use quasirigid::reduction::{Validity, Verdict, residual};
use quasirigid::verification::{AverageRow, Difference, OrderRow, VerificationPlan};
use quasirigid_io::model::{Model, Named, System};
use quasirigid_io::record::{
    AverageRecord, BodyRecord, Column, CriterionRecord, DegreeRecord, HistoryRecord, ModelRecord,
    OrderRecord, ReductionRecord, ResolutionRecord, ValidityRecord, VerificationRecord,
};
use quasirigid_math::ode::Work;
use quasirigid_math::vec3::{dot, norm};

use crate::study::Study;
use crate::verification::Proof;
use crate::visible::one_line;
use crate::{resolution, words};

/// The model a record is made from.
pub fn model(model: &Model) -> ModelRecord {
    let file = model.source.file.file_name().unwrap_or(model.source.file.as_os_str());
    ModelRecord {
        name: model.name.clone(),
        file: file.to_string_lossy().into_owned(),
        sha256: model.source.sha256.clone(),
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
        principal_moments: principal.moments,
        principal_axes: principal.axes,
        coordinates: body.coordinates().iter().map(|coordinate| coordinate.name.clone()).collect(),
        resolution: resolution(study).next(),
    }
}

/// How well the shape of a solid inside a surface is resolved.
pub fn resolution(study: &Study) -> impl Iterator<Item = ResolutionRecord> + '_ {
    let solids = study.model.assembly.surfaces.iter().zip(&study.resolution);
    solids.map(|(solid, found)| resolution::record(&solid.name, found))
}

/// How far the reduced equations hold.
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
            form: row.form.name().into(),
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

/// A spin history of some `equations`, in words, with the nutation by the `nutating` body.
pub fn history(
    system: System,
    equations: &str,
    options: &Options,
    (samples, budget): (&[Sample], &[(String, f64)]),
    (body, run): (&FlexibleBody, &Run),
    nutating: &ReducedBody,
) -> HistoryRecord {
    let (status, message) = status(body, run.outcome, run.last.t);
    HistoryRecord {
        system: system.name().into(),
        form: equations.into(),
        method: method(system, run.work),
        status: status.into(),
        message,
        tolerance: options.tolerance,
        steps: run.work.steps,
        rejected: run.work.rejected,
        turns: run.last.turns,
        energy: samples.first().map_or(f64::NAN, |first| first.energy),
        dissipated: run.last.dissipated,
        dissipation: words::shares(budget),
        work: run.last.work,
        energy_drift: run.last.energy_drift,
        momentum_drift: run.last.momentum_drift,
        columns: columns(body.support(), samples, Some(nutating)),
    }
}

/// How a system was integrated, in words.
fn method(system: System, work: Work) -> String {
    let explicit = work.steps - work.implicit_steps;
    match (system, work.implicit_steps, explicit) {
        (System::Reduced | System::Rigid, ..) | (_, 0, _) => {
            "explicit Runge-Kutta of order 8 (DOP853)".into()
        }
        (_, _, 0) => "implicit Runge-Kutta of order 13 (Radau IIA)".into(),
        (_, implicit, explicit) => format!(
            "{explicit} steps explicit (DOP853) while vibrations had to be followed, {implicit} implicit (Radau IIA, order 13)"
        ),
    }
}

/// How a run ended: a word, and a sentence.
pub fn status(body: &FlexibleBody, outcome: Outcome, t: f64) -> (&'static str, String) {
    match outcome {
        Outcome::Finished => ("finished", "the run reached its end".into()),
        Outcome::Interrupted => ("interrupted", format!("the run was interrupted at t = {t} s")),
        Outcome::StepLimit => {
            ("step-limit", format!("the run used up its steps at t = {t} s; loosen the tolerance"))
        }
        Outcome::LeftRange(left) => {
            ("left-validity", format!("{} at t = {t} s", words::displaced(body, left)))
        }
        Outcome::Failed(error) => ("failed", error.to_string()),
        Outcome::Event(Event::Energy(energy)) => {
            ("event", format!("the energy passed {energy} J at t = {t} s, where the run was to stop"))
        }
        Outcome::Event(Event::Nutation { angle, .. }) => (
            "event",
            format!(
                "the nutation passed {} degrees at t = {t} s, where the run was to stop",
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

/// The columns of a table of samples: nutation only with a body to count it by, places only of a body that can move away.
pub fn columns(support: &Support, samples: &[Sample], nutating: Option<&ReducedBody>) -> Vec<Column> {
    let column = |name: &str, unit: &str, value: &dyn Fn(&Sample) -> f64| Column {
        name: name.into(),
        unit: unit.into(),
        values: samples.iter().map(value).collect(),
    };
    let mut columns = vec![
        column("t", "s", &|s| s.t),
        column("wx", "rad/s", &|s| s.omega[0]),
        column("wy", "rad/s", &|s| s.omega[1]),
        column("wz", "rad/s", &|s| s.omega[2]),
        column("qw", "1", &|s| s.attitude[0]),
        column("qx", "1", &|s| s.attitude[1]),
        column("qy", "1", &|s| s.attitude[2]),
        column("qz", "1", &|s| s.attitude[3]),
        column("energy", "J", &|s| s.energy),
        column("momentum", "N m s", &|s| norm(s.momentum)),
        column("dissipated", "J", &|s| s.dissipated),
        column("work", "J", &|s| s.work),
        column("energy_drift", "J", &|s| s.energy_drift),
        column("momentum_drift", "1", &|s| s.momentum_drift),
    ];
    if let Some(body) = nutating {
        columns.extend(nutation_columns(body, samples));
    }
    if matches!(support, Support::FixedPoint { .. }) {
        return columns;
    }
    for (axis, name) in ["x", "y", "z"].iter().enumerate() {
        columns.push(column(name, "m", &|s| s.place[axis]));
    }
    for (axis, name) in ["vx", "vy", "vz"].iter().enumerate() {
        columns.push(column(name, "m/s", &|s| s.velocity[axis]));
    }
    if matches!(support, Support::Free) {
        for (axis, name) in ["R0x", "R0y", "R0z"].iter().enumerate() {
            columns.push(column(name, "m", &|s| s.pole[axis]));
        }
    }
    columns
}

/// The principal axis next to that circled, of least inertia first, and the least and the greatest angle of the nutation at each sample; not a number where there is none. (P8)
fn nutation_columns(body: &ReducedBody, samples: &[Sample]) -> [Column; 3] {
    let mut nutations = Nutations::new(body);
    let found: Vec<Option<Nutation>> = samples.iter().map(|sample| nutations.at(sample.momentum)).collect();
    let axes = Principal::compute(body.J).axes;
    let circled = |nutation: &Nutation| {
        let along = |axis: &usize| dot(axes[*axis], nutation.axis).abs();
        (0..3).max_by(|a, b| along(a).total_cmp(&along(b))).map_or(f64::NAN, |axis| (axis + 1) as f64)
    };
    let column = |name: &str, unit: &str, value: &dyn Fn(&Nutation) -> f64| Column {
        name: name.into(),
        unit: unit.into(),
        values: found.iter().map(|nutation| nutation.as_ref().map_or(f64::NAN, value)).collect(),
    };
    [
        column("circled_axis", "1", &circled),
        column("nutation_min", "rad", &|nutation| nutation.least),
        column("nutation_max", "rad", &|nutation| nutation.greatest),
    ]
}

/// Columns of the first `valued` internal coordinates, then of the rates of all, from one list of both per row.
pub fn coordinate_columns(coordinates: &[Coordinate], valued: usize, rows: &[Vec<f64>]) -> Vec<Column> {
    let column = |i: usize, name: String, unit: String| Column {
        name,
        unit,
        values: rows.iter().map(|row| row[i]).collect(),
    };
    let name = |coordinate: &Coordinate| one_line(&coordinate.name.replace('"', ""));
    let values = coordinates.iter().enumerate().take(valued);
    let values = values.map(|(i, each)| column(i, name(each), each.unit.to_owned()));
    let rates = coordinates.iter().enumerate().map(|(i, each)| {
        column(coordinates.len() + i, format!("{} rate", name(each)), format!("{}/s", each.unit))
    });
    values.chain(rates).collect()
}

/// Columns of the displacements of watched places, to the first order, from one list of internal coordinates per row.
pub fn displacement_columns(markers: &[Marker], rows: &[Vec<f64>]) -> Vec<Column> {
    let column = |marker: &Marker, axis: usize| {
        let displacement =
            |row: &Vec<f64>| marker.shapes.iter().map(|(j, shape)| row[*j] * shape[axis]).sum::<f64>();
        let name = format!("{} along {}", one_line(&marker.name.replace('"', "")), ["x", "y", "z"][axis]);
        Column { name, unit: "m".to_owned(), values: rows.iter().map(displacement).collect() }
    };
    let axes = |marker| [0, 1, 2].map(|axis| column(marker, axis));
    markers.iter().flat_map(axes).collect()
}
