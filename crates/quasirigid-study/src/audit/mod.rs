//! Audit of a history that another program wrote: does a simulator invent damping?
//!
//! A free rigid body keeps its energy and its angular momentum, and its wobble neither decays nor grows. What a history shows beside that was
//! made by the integrator, or by a torque, or is the body's own dissipation, which its model tells. Equations (J1) to (J4),
//! docs/theory/22-audit.md.

mod answer;
mod attitude_alone;
mod attitude_rates;
mod badge;
mod convention;
mod drift;
mod error;
mod euler;
mod measure;
mod model;
mod order;
mod rigid;
mod trend;
mod units;
mod words;

use std::path::{Path, PathBuf};

use quasirigid::model::Inertia;
use quasirigid_io::history_file::{identity, read_history};
use quasirigid_io::model::BodyKind;
use quasirigid_io::record::{InputsRecord, ValueRecord};
use quasirigid_math::sym3::Sym;
use serde_json::json;

pub use answer::{AttitudeObject, Audit, IntervalObject, RoundingObject, UnitsObject};
pub use error::AuditError;
pub use order::OrderObject;

use crate::study::Study;
use answer::{Explained, mode_name, time_constant};
use drift::Drift;
use measure::Measured;
use model::{OfModel, of_model};
use order::{Limits, Run, order};
use rigid::Rigid;
use words::{ROUGH, Told};

/// Body that a history is compared with.
#[derive(Clone, Copy, Debug)]
pub enum AuditBody<'a> {
    /// Rigid body with this tensor, in the axes of the rates; where only relative drifts are asked for, its unit has no effect.
    Inertia(Inertia),
    /// Body of a model, in its axes.
    Model(&'a Study),
}

impl AuditBody<'_> {
    /// Noun of the angle: that of the kind of a model; of a simulator's rigid body, wobble.
    fn nutation(self) -> &'static str {
        match self {
            Self::Model(study) => study.model.kind,
            Self::Inertia(_) => BodyKind::SmallBody,
        }
        .nutation()
    }
}

/// Limits that a history is held to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AuditSettings {
    /// Largest relative change of energy and of angular momentum.
    pub limit: Option<f64>,
    /// Least time constant (s) of an invented change of the wobble.
    pub min_time_constant: Option<f64>,
    /// Step (s) of each of several histories; by default that of its rows.
    pub steps: Vec<f64>,
}

/// The tensor of three moments or of six entries `XX,YY,ZZ,XY,XZ,YZ` (kg·m²), where `XY` is the entry of the tensor, `−∫ x y dm`.
///
/// # Errors
/// [`AuditError`] for another number of entries, and for a tensor that no body has.
pub fn inertia(entries: &[f64]) -> Result<Inertia, AuditError> {
    let rows = match *entries {
        [xx, yy, zz] => [[xx, 0.0, 0.0], [0.0, yy, 0.0], [0.0, 0.0, zz]],
        [xx, yy, zz, xy, xz, yz] => [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]],
        _ => return Err(AuditError::Entries { count: entries.len() }),
    };
    let inertia = Inertia::new(rows)?;
    let moment = inertia.principal_moments()[0];
    if moment > 0.0 { Ok(inertia) } else { Err(AuditError::NoMoment { moment }) }
}

/// Audits histories of one run: the first in full, and the order of its integrator if there are more, at other steps.
///
/// # Errors
/// [`AuditError`] for files that are not read, and for histories that no units make one of this body.
pub fn audit(files: &[PathBuf], body: AuditBody<'_>, asked: &AuditSettings) -> Result<Audit, AuditError> {
    let Some(file) = files.first() else { return Err(AuditError::NoFile) };
    let rigid = Rigid::new(tensor(body)?);
    let measured = read(file, &rigid)?;
    let drift = Drift::of(&measured, &rigid);
    let model = match body {
        AuditBody::Model(study) => Some(of_model(study, &rigid, &measured, &drift)),
        AuditBody::Inertia(_) => None,
    };
    let limits = Limits { drift: asked.limit, time_constant: asked.min_time_constant };
    let order = if files.len() > 1 || !asked.steps.is_empty() {
        Some(order_of(files, &rigid, asked, (limits, body.nutation()))?)
    } else {
        None
    };
    let inputs = inputs(files, body)?;
    let (measured, drift) = (&measured, &drift);
    let (model, nutation) = (model.as_ref(), body.nutation());
    Ok(answered(&Found { file, measured, drift, body: &rigid, model, nutation, limits }, order, inputs))
}

fn read(file: &Path, rigid: &Rigid) -> Result<Measured, AuditError> {
    Measured::of(file, read_history(file)?, rigid)
}

fn tensor(body: AuditBody<'_>) -> Result<Sym, AuditError> {
    let [[xx, xy, xz], [_, yy, yz], [_, _, zz]] = match body {
        AuditBody::Inertia(inertia) => inertia.rows(),
        AuditBody::Model(study) => {
            let assembly = &study.model.assembly;
            let wheels =
                !(assembly.rotors.is_empty() && assembly.cavities.is_empty() && assembly.tubes.is_empty());
            if wheels {
                return Err(AuditError::Rotors);
            }
            let [xx, yy, zz, yz, zx, xy] = study.body.invariants().J;
            inertia(&[xx, yy, zz, xy, zx, yz])?.rows()
        }
    };
    Ok([xx, yy, zz, yz, xz, xy])
}

fn order_of(
    files: &[PathBuf],
    rigid: &Rigid,
    asked: &AuditSettings,
    (limits, nutation): (Limits, &str),
) -> Result<OrderObject, AuditError> {
    if !asked.steps.is_empty() && asked.steps.len() != files.len() || files.len() < 2 {
        let problem = format!(
            "{} steps for {} histories; give one step for each of two or more histories",
            asked.steps.len(),
            files.len()
        );
        return Err(AuditError::Steps { problem });
    }
    let runs = files.iter().enumerate().map(|(k, file)| {
        let measured = read(file, rigid)?;
        let drift = Drift::of(&measured, rigid);
        Ok(Run::of(&measured, &drift, asked.steps.get(k).copied()))
    });
    order(&runs.collect::<Result<Vec<_>, AuditError>>()?, limits, nutation)
}

/// What an audit found.
struct Found<'a> {
    file: &'a Path,
    measured: &'a Measured,
    drift: &'a Drift,
    body: &'a Rigid,
    model: Option<&'a OfModel>,
    nutation: &'static str,
    limits: Limits,
}

fn answered(found: &Found<'_>, order: Option<OrderObject>, inputs: InputsRecord) -> Audit {
    let Found { file, measured, drift, body, model, .. } = found;
    let explained = Explained::of(drift, *model);
    let (left, nutation, alone) = (explained.left, found.nutation, order.is_none());
    let told = Told { measured, body, drift, model: *model, left, nutation, alone };
    let trend = drift.wobble_trend.as_ref().filter(|trend| trend.is_seen());
    let attitude =
        measured.attitude.zip(measured.direction(body)).map(|(found, [last, largest])| AttitudeObject {
            convention: found.convention.words(),
            misfit: found.misfit,
            direction_drift: last,
            direction_excursion: largest,
        });
    let longest = drift.wobble_trend.map(|trend| {
        let least = (3.0 * trend.error).max(trend.resolution / trend.span);
        least.recip()
    });
    let mut sentence = told.sentence();
    let within_limits = within(found, explained.left, longest, attitude.as_ref());
    if within_limits == Some(false) {
        sentence = format!("{sentence} This is NOT within the limits asked for.");
    }
    if let Some(order) = &order {
        sentence = format!("{sentence} {}", order.sentence);
    }
    let t = &measured.file.t;
    Audit {
        sentence,
        momentum_drift: drift.momentum_change.last,
        energy_drift: drift.energy_change.last,
        momentum_excursion: drift.momentum_change.largest,
        energy_excursion: drift.energy_change.largest,
        invented_time_constant: explained.left.map(f64::recip),
        time_constant_error: trend.map(|trend| trend.error / (trend.slope * trend.slope)),
        longest_time_constant: longest.filter(|longest| longest.is_finite()),
        seen_time_constant: time_constant(trend),
        model_time_constant: model.and_then(|model| match model {
            OfModel::Rate(rate) if *rate != 0.0 => Some(rate.recip()),
            _ => None,
        }),
        explained: explained.share,
        worst_interval: drift.worst,
        mode: body.wobbles().then(|| mode_name(drift.mode)),
        wobble: drift.wobble(),
        crossing: drift.crossing.filter(|_| drift.has_wobble),
        dissipation: drift.intervals.iter().map(IntervalObject::of).collect(),
        rounding: RoundingObject {
            digits: measured.digits(),
            momentum: drift.momentum_change.rounding,
            energy: drift.energy_change.rounding,
        },
        units: UnitsObject::of(measured),
        attitude,
        order,
        nutation,
        file: file.file_name().unwrap_or(file.as_os_str()).to_string_lossy().into_owned(),
        rows: t.len(),
        duration: t[t.len() - 1] - t[0],
        turns: drift.turns,
        within_limits,
        holds: measured.left_out.is_none() && measured.fit.is_none_or(|fit| fit.misfit <= ROUGH),
        notes: told.notes(),
        inputs,
    }
}

/// Whether the limits are kept, so far as the digits of the file can show it; none without limits.
fn within(
    found: &Found<'_>,
    left: Option<f64>,
    longest: Option<f64>,
    attitude: Option<&AttitudeObject>,
) -> Option<bool> {
    let Found { measured, drift, limits, .. } = found;
    let changes = [drift.energy_change, drift.momentum_change];
    let drifts = limits.drift.map(|limit| {
        let turned = attitude
            .is_none_or(|found| found.direction_excursion <= limit + 4.0 * measured.file.attitude_rounding);
        turned && changes.iter().all(|change| change.largest <= limit && change.rounding <= limit)
    });
    let constants = limits.time_constant.map(|least| match (left, longest) {
        (Some(rate), _) => rate.abs().recip() >= least,
        (None, Some(longest)) => longest >= least,
        (None, None) => !drift.has_wobble && drift.crossing.is_none(),
    });
    match (drifts, constants) {
        (None, None) => None,
        (first, second) => Some(first.unwrap_or(true) && second.unwrap_or(true)),
    }
}

fn inputs(files: &[PathBuf], body: AuditBody<'_>) -> Result<InputsRecord, AuditError> {
    let histories = files.iter().map(|file| identity(file)).collect::<Result<Vec<_>, _>>()?;
    let mut inputs = match body {
        AuditBody::Model(study) => study.inputs(),
        AuditBody::Inertia(inertia) => {
            let [[xx, xy, xz], [_, yy, yz], [_, _, zz]] = inertia.rows();
            let named = [("xx", xx), ("yy", yy), ("zz", zz), ("xy", xy), ("xz", xz), ("yz", yz)];
            let value = |(name, value): (&str, f64)| ValueRecord {
                key: format!("inertia.{name}"),
                value: json!(value),
                unit: "kg m^2".to_owned(),
                default: false,
            };
            let version = env!("CARGO_PKG_VERSION").to_owned();
            InputsRecord { version, values: named.map(value).into(), ..InputsRecord::default() }
        }
    };
    inputs.files.extend(histories);
    Ok(inputs)
}
