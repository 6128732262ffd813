//! Pages of studies: what they show for grids, draws and tables, and what names of users cannot do to them.

use std::collections::BTreeMap;

use quasirigid_io::record::{
    CorrelationRecord, InputRecord, PercentileRecord, QuantityRecord, ReasonRecord, SweepColumn, SweepRecord,
};
use quasirigid_report::study_page;

/// A study of columns: name, unit and kind of each, quantities after the inputs; three rows have no answer.
fn record(columns: Vec<(&str, &str, &str, Vec<f64>)>) -> (SweepRecord, Vec<SweepColumn>) {
    let rows = columns[0].3.len() as u64;
    let (asked, given): (Vec<_>, Vec<_>) = columns.iter().partition(|(_, _, kind, _)| *kind == "number");
    let quantity = |(name, unit, kind, values): &&(&str, &str, &str, Vec<f64>)| {
        let mut sorted: Vec<f64> = values.iter().copied().filter(|value| value.is_finite()).collect();
        sorted.sort_by(f64::total_cmp);
        let at = |percent: f64| {
            let value = *sorted.get((sorted.len().saturating_sub(1) as f64 * percent / 100.0) as usize)?;
            Some(PercentileRecord { percent, value })
        };
        QuantityRecord {
            name: (*name).into(),
            unit: (*unit).into(),
            kind: (*kind).into(),
            count: sorted.len() as u64,
            nulls: rows - sorted.len() as u64,
            infinite: 0,
            percentiles: [16.0, 50.0, 84.0].into_iter().filter_map(at).collect(),
            mean: None,
            min: sorted.first().copied(),
            max: sorted.last().copied(),
            counts: BTreeMap::new(),
        }
    };
    let input = |(name, unit, kind, _): &&(&str, &str, &str, Vec<f64>)| InputRecord {
        name: (*name).into(),
        key: String::new(),
        unit: (*unit).into(),
        kind: (*kind).into(),
        points: Vec::new(),
        geometric: false,
    };
    let record = SweepRecord {
        version: "0.1.0".into(),
        name: "dampers".into(),
        sha256: "0".into(),
        files: Vec::new(),
        notes: Vec::new(),
        study: "model = \"model.toml\"\n".into(),
        model: String::new(),
        rows,
        status: [("answered".to_owned(), rows - 3), ("refused".to_owned(), 3)].into(),
        inputs: given.iter().map(input).collect(),
        quantities: asked.iter().map(quantity).collect(),
        correlations: vec![CorrelationRecord {
            input: "point.mass.mass".into(),
            quantity: "modes.nutation.time_constant".into(),
            rho: Some(-0.82),
            rows: rows - 3,
            p: None,
        }],
        reasons: vec![ReasonRecord {
            status: "refused".into(),
            reason: "the spin is unstable".into(),
            count: 3,
            first_row: 17,
            example: "the spin is unstable".into(),
        }],
    };
    let columns = columns.into_iter().map(|(name, _, _, values)| SweepColumn { name: name.into(), values });
    (record, columns.collect())
}

/// A damper of a mass and a tuning: time constants with an optimum, three rows missing.
fn two_grids() -> (SweepRecord, Vec<SweepColumn>) {
    let (mass, tuning): (Vec<f64>, Vec<f64>) =
        (0..21 * 31).map(|i| (0.2 * 1.2_f64.powi(i / 31), 0.5 + 0.04 * f64::from(i % 31))).unzip();
    let time = mass.iter().zip(&tuning).enumerate().map(|(row, (mass, tuning))| {
        let off = (tuning - 1.1) / (0.1 + 0.1 * mass.sqrt());
        if (100..103).contains(&row) { f64::NAN } else { 40.0 / mass * (1.0 + off * off) }
    });
    let time = time.collect();
    record(vec![
        ("point.mass.mass", "kg", "grid", mass),
        ("spring.mass.tuning", "", "grid", tuning),
        ("modes.nutation.time_constant", "s", "number", time),
    ])
}

fn page((record, columns): &(SweepRecord, Vec<SweepColumn>)) -> String {
    study_page(record, columns)
}

#[test]
fn two_grids_are_a_map_with_contour_lines() {
    let page = page(&two_grids());
    assert!(page.contains("648 of 651 rows are answered") && page.contains("id=\"map-0-title\""));
    for step in 0..8 {
        assert!(page.contains(&format!("class=\"cell m{step}\"")), "no colour {step}");
    }
    assert!(page.matches("class=\"contour\"").count() == 7 && !page.contains("histogram-0"));
    assert!(page.contains("the spin is unstable") && page.contains("−0.82"));
}

#[test]
fn one_grid_with_draws_is_a_curve_with_a_band_and_a_histogram() {
    let x: Vec<f64> = (0..400).map(|i| f64::from(i / 40)).collect();
    let drawn: Vec<f64> = (0..400).map(|i| f64::from(i * 7919 % 400) / 400.0).collect();
    let y = x.iter().zip(&drawn).map(|(x, d)| 3.0 + x + d).collect();
    let page = page(&record(vec![
        ("run.order", "", "grid", x),
        ("material.rock.rheology.Q", "", "distribution", drawn),
        ("evolve.time", "s", "number", y),
    ]));
    assert!(page.contains("id=\"curve-0-title\"") && page.contains("class=\"band s1\""));
    assert!(page.contains("id=\"histogram-0-title\"") && page.contains("84 %"));
}

#[test]
fn a_page_needs_no_network_and_no_name_becomes_markup() {
    let hostile = "<script>alert(1)</script>\"'&";
    let mut study = two_grids();
    study.0.name = hostile.into();
    (study.0.inputs[0].name, study.1[0].name) = (hostile.into(), hostile.into());
    study.0.inputs[0].unit = "</script><b>".into();
    (study.0.reasons[0].example, study.0.study) = (hostile.into(), hostile.into());
    let page = page(&study);
    assert!(!page.contains("<script>alert") && !page.contains("</script><b>"));
    assert!(!page.contains("http://") && !page.contains("https://"), "an address");
    assert_eq!(page.matches("<script").count(), 2);
}

#[test]
fn a_page_of_any_study_stays_small() {
    let many: Vec<f64> = (0..300_000).map(|i| f64::from(i).sin()).collect();
    let page = page(&record(vec![("a", "", "distribution", many.clone()), ("b", "m", "number", many)]));
    assert!(page.len() < 1_000_000, "{} bytes", page.len());
    let none = super::study::page(&record(vec![("b", "m", "number", vec![f64::NAN; 5])]));
    assert!(none.contains("2 of 5 rows"));
}
