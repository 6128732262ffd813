//! The result from the least that was found: residuals by column, what the data do not tell, and what is to be said first.

use quasirigid_io::measured_file::{MeasuredColumn, Measurements};

use super::data::is_exact;
use super::loss::Loss;
use super::problem::Problem;
use super::search::Found;
use super::{Alternative, Change, Combination, FittedAnswer, FittedColumn, Inferred, Parameter};
use crate::words::significant;

/// Standard deviations of χ² within which the model explains the data.
const EXPLAINED: f64 = 4.0;
/// Correlation of neighbouring residuals, over its deviation in noise, from which they are no noise.
const CORRELATED: f64 = 4.0;
/// Values below which noise and misfit look the same.
const FEW: usize = 50;
/// Values below which none is told from an outlier.
const ENOUGH: usize = 10;
/// Deviations from which a value is an outlier, and the share of outliers that no loss makes good.
const OUTLIER: f64 = 4.0;
const MANY: f64 = 0.2;
/// Share of the deviation known beforehand from which the data add nothing to it.
const NOTHING_NEW: f64 = 0.95;

pub(super) fn told(problem: &Problem<'_>, found: &Found, mut notes: Vec<String>) -> Inferred {
    let residuals = problem.residuals(&found.least.parameters).unwrap_or_default();
    let fit = Fit::of(problem, found, &residuals);
    notes.extend(fit.notes(problem, found));
    let keys = problem.keys.iter().enumerate();
    let parameters: Vec<Parameter> = keys.map(|(i, _)| parameter(problem, found, i)).collect();
    notes.extend(parameters.iter().zip(problem.keys).filter_map(|(parameter, key)| {
        let [_, prior] = key.prior?;
        let idle = parameter.sigma.is_some_and(|sigma| sigma > NOTHING_NEW * prior);
        idle.then(|| format!("the data add nothing to what is known beforehand of {}", parameter.key))
    }));
    let scale = |i: usize| problem.keys[i].number.scale;
    let covariance = found.curvature.covariance.iter().enumerate().map(|(i, row)| {
        let row = row.iter().enumerate();
        row.map(|(j, entry)| entry.map(|entry| entry * scale(i) * scale(j))).collect()
    });
    let key = |i: usize| problem.keys[i].number.path.to_string();
    let unseen = found.curvature.unseen.iter().map(|unseen| Combination {
        changes: unseen
            .changes
            .iter()
            .map(|(i, relative)| Change { key: key(*i), relative: *relative })
            .collect(),
        sigma: unseen.sigma,
    });
    let history = problem.data.history.as_ref();
    let mut inferred = Inferred {
        name: problem.study.model.name.clone(),
        sentence: String::new(),
        covariance: covariance.collect(),
        not_distinguished: unseen.collect(),
        alternatives: alternatives(problem, found),
        chi2: fit.chi2,
        degrees_of_freedom: fit.freedom,
        scatter: found.curvature.scatter,
        correlation: fit.correlation,
        outliers: fit.outliers,
        columns: history.map_or_else(Vec::new, |data| columns(problem, data, &residuals)),
        measured: answers(problem, &residuals),
        converged: found.least.converged,
        explained: fit.explained,
        models: problem.models.load(std::sync::atomic::Ordering::Relaxed),
        t: history.map_or_else(Vec::new, |data| data.t.clone()),
        parameters,
        notes,
    };
    inferred.sentence = inferred.told();
    inferred
}

/// Places elsewhere, unless the data do not tell keys apart and all minima lie in one valley.
fn alternatives(problem: &Problem<'_>, found: &Found) -> Vec<Alternative> {
    if !found.curvature.unseen.is_empty() {
        return Vec::new();
    }
    let each = found.alternatives.iter();
    each.map(|(point, rise)| Alternative {
        values: problem.keys.iter().zip(point).map(|(key, x)| x * key.number.scale).collect(),
        rise: *rise,
    })
    .collect()
}

fn parameter(problem: &Problem<'_>, found: &Found, i: usize) -> Parameter {
    let number = &problem.keys[i].number;
    let x = found.least.parameters[i];
    let [low, _] = problem.keys[i].bounds();
    let profile = &found.profiles[i];
    let [interval_68, interval_95] =
        profile.intervals.map(|ends| ends.map(|end| end.map(|end| end * number.scale)));
    Parameter {
        key: number.path.to_string(),
        value: x * number.scale,
        sigma: found.curvature.covariance[i][i].map(|square| square.sqrt() * number.scale),
        interval_68,
        interval_95,
        profiled: profile.is_followed,
        at_bound: found.least.held[i].then_some(if x <= low { "low" } else { "high" }),
        unit: number.unit.clone().unwrap_or_default(),
        before: number.number,
    }
}

/// How well the model fits.
struct Fit {
    chi2: f64,
    freedom: usize,
    outliers: usize,
    correlation: f64,
    /// Whether neighbouring residuals are alike.
    is_no_noise: bool,
    explained: Option<bool>,
}

impl Fit {
    fn of(problem: &Problem<'_>, found: &Found, residuals: &[f64]) -> Self {
        let measured = problem.data.count();
        let unit = found.curvature.scatter.unwrap_or(1.0);
        let far: Vec<bool> =
            residuals[..measured].iter().map(|r| r.abs() > OUTLIER * unit && unit > 0.0).collect();
        let outliers = far.iter().filter(|far| **far).count();
        let is_robust = problem.loss.kind != Loss::Squares;
        let left_out = |row: usize| is_robust && far.get(row) == Some(&true);
        let counted = residuals.iter().enumerate().filter(|(row, _)| !left_out(*row));
        let squares: Vec<f64> = counted.map(|(_, r)| r * r).collect();
        let free = found.least.held.iter().filter(|held| !**held).count();
        let (chi2, freedom) = (squares.iter().sum::<f64>(), squares.len().saturating_sub(free));
        let clipped: Vec<f64> = residuals[..measured]
            .iter()
            .map(|r| if is_robust { problem.loss.influence(*r) } else { *r })
            .collect();
        let history = problem.data.history.as_ref();
        let correlation = history.map_or(0.0, |data| correlation(data, &clipped));
        let rows = history.map_or(0, |data| data.t.len());
        let is_no_noise = correlation > CORRELATED / (rows as f64).sqrt();
        let explained = if problem.data.has_deviations() {
            let spread = (2.0 * freedom as f64).sqrt().max(1.0);
            let few = outliers as f64 <= MANY * measured as f64 || !is_robust;
            Some(chi2 - freedom as f64 <= EXPLAINED * spread && few)
        } else {
            is_no_noise.then_some(false)
        };
        Self { chi2, freedom, outliers, correlation, is_no_noise, explained }
    }

    fn notes(&self, problem: &Problem<'_>, found: &Found) -> Vec<String> {
        let mut notes = Vec::new();
        let given = problem.data.has_deviations();
        if given && self.is_no_noise {
            notes.push(format!(
                "neighbouring residuals are alike (correlation {}): the deviations given cover a misfit or errors that last, and sigma knows of neither",
                significant(self.correlation, 2)
            ));
        }
        if !given && problem.data.count() < FEW {
            notes.push(
                "so few values cannot show whether what is left is noise or a misfit; give their deviations"
                    .to_owned(),
            );
        }
        let many = problem.data.count() >= ENOUGH;
        if given && many && self.outliers > 0 && problem.loss.kind == Loss::Squares {
            notes.push(format!(
                "{} of {} values are more than four deviations off, and pull as squares; --loss huber lets them decide less",
                self.outliers,
                problem.data.count()
            ));
        }
        if found.has_others {
            notes.push(
                "some starts end in shallower minima: the deepest one that was found is told".to_owned(),
            );
        }
        notes
    }
}

/// Largest correlation of neighbouring residuals among the columns; zero of those that are missed by no more than the error of a history.
fn correlation(data: &Measurements, residuals: &[f64]) -> f64 {
    let rows = data.t.len();
    let columns = data.columns.iter().zip(residuals.chunks_exact(rows));
    let correlations = columns.map(|(column, residuals)| {
        let neighbours: f64 = residuals.windows(2).map(|pair| pair[0] * pair[1]).sum();
        if is_exact(column, residuals) {
            0.0
        } else {
            neighbours / residuals.iter().map(|r| r * r).sum::<f64>()
        }
    });
    correlations.fold(0.0, f64::max)
}

fn columns(problem: &Problem<'_>, data: &Measurements, residuals: &[f64]) -> Vec<FittedColumn> {
    let each = data.columns.iter().zip(residuals.chunks_exact(data.t.len())).zip(&problem.data.units);
    let fitted = |column: &MeasuredColumn, residuals: &[f64]| {
        let rows = column.values.iter().zip(residuals).enumerate();
        rows.map(|(row, (value, r))| value + r * column.deviation(row)).collect()
    };
    each.map(|((column, residuals), unit)| FittedColumn {
        name: column.name.clone(),
        rms: (residuals.iter().map(|r| r * r).sum::<f64>() / residuals.len() as f64).sqrt(),
        largest: residuals.iter().fold(0.0, |most: f64, r| most.max(r.abs())),
        unit: unit.clone(),
        measured: column.values.clone(),
        fitted: fitted(column, residuals),
        residuals: residuals.to_vec(),
    })
    .collect()
}

fn answers(problem: &Problem<'_>, residuals: &[f64]) -> Vec<FittedAnswer> {
    let before = problem.data.count() - problem.data.answers.len();
    let each = problem.data.answers.iter().zip(residuals.iter().skip(before));
    each.map(|(measured, residual)| FittedAnswer {
        quantity: measured.quantity.name.clone(),
        value: measured.value,
        sigma: measured.sigma,
        fitted: measured.value + residual * measured.sigma,
        residual: *residual,
        unit: measured.unit.to_owned(),
    })
    .collect()
}
