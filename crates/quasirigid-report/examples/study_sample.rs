#![allow(missing_docs, clippy::unwrap_used)]
// Pages of studies: what they show for grids, draws and tables, and what names of users cannot do to them.

use quasirigid_io::record::{StudyColumn, StudyInfluence, StudyRecord, StudyRefusal, StudyRole};
use quasirigid_report::study_page;

fn column(name: &str, unit: &str, role: StudyRole, values: Vec<f64>) -> StudyColumn {
    let mut sorted: Vec<f64> = values.iter().copied().filter(|value| value.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    let at = |percent: f64| sorted[((sorted.len() - 1) as f64 * percent / 100.0) as usize];
    let percentiles = if role == StudyRole::Quantity && !sorted.is_empty() {
        [16.0, 50.0, 84.0].map(|percent| (percent, at(percent))).to_vec()
    } else {
        Vec::new()
    };
    StudyColumn { name: name.into(), unit: unit.into(), role, values, percentiles }
}

fn record(columns: Vec<StudyColumn>) -> StudyRecord {
    let rows = columns[0].values.len();
    StudyRecord {
        name: "dampers".into(),
        version: "0.1.0".into(),
        rows,
        answered: rows - 3,
        text: "model = \"model.toml\"\n".into(),
        columns,
        influences: vec![StudyInfluence {
            input: "point.mass.mass".into(),
            quantity: "modes.nutation.time_constant".into(),
            rank_correlation: -0.82,
            rows: rows - 3,
        }],
        refusals: vec![StudyRefusal {
            status: "refused".into(),
            reason: "the spin is unstable".into(),
            rows: 3,
            first: 17,
        }],
    }
}

/// A damper of a mass and a tuning: time constants with an optimum, three rows missing.
fn two_grids() -> StudyRecord {
    let (mass, tuning): (Vec<f64>, Vec<f64>) =
        (0..21 * 31).map(|i| (0.2 * 1.2_f64.powi(i / 31), 0.5 + 0.04 * f64::from(i % 31))).unzip();
    let time = mass.iter().zip(&tuning).enumerate().map(|(row, (mass, tuning))| {
        let off = (tuning - 1.1) / (0.1 + 0.1 * mass.sqrt());
        if (100..103).contains(&row) { f64::NAN } else { 40.0 / mass * (1.0 + off * off) }
    });
    let time = time.collect();
    record(vec![
        column("point.mass.mass", "kg", StudyRole::Grid, mass),
        column("spring.mass.tuning", "", StudyRole::Grid, tuning),
        column("modes.nutation.time_constant", "s", StudyRole::Quantity, time),
    ])
}

fn main() {
    std::fs::write("/tmp/st/map.html", study_page(&two_grids())).unwrap();
    let mut seed = 1u64;
    let mut next = || {
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (seed >> 11) as f64 / (1u64 << 53) as f64
    };
    let x: Vec<f64> = (0..4000).map(|i| 10f64.powf(1.0 + f64::from(i / 200) / 10.0)).collect();
    let drawn: Vec<f64> =
        (0..4000).map(|_| 100.0 * 10f64.powf(2.0 * ((next() + next() + next()) / 3.0 - 0.5))).collect();
    let y = x.iter().zip(&drawn).map(|(x, d)| 3e4 * d / x.powf(1.5) * (1.0 + 0.2 * next())).collect();
    let page = study_page(&record(vec![
        column("ellipsoid.1.semi_axes.1", "m", StudyRole::Grid, x),
        column("material.rock.rheology.Q", "", StudyRole::Drawn, drawn),
        column("evolve.time", "s", StudyRole::Quantity, y),
    ]));
    std::fs::write("/tmp/st/curve.html", page).unwrap();
}
