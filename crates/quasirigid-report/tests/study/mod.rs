//! Pages of studies: what they show for grids, draws and tables, and what names of users cannot do to them.

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

#[test]
fn two_grids_are_a_map_with_contour_lines() {
    let page = study_page(&two_grids());
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
    let page = study_page(&record(vec![
        column("run.order", "", StudyRole::Grid, x),
        column("material.rock.rheology.Q", "", StudyRole::Drawn, drawn),
        column("evolve.time", "s", StudyRole::Quantity, y),
    ]));
    assert!(page.contains("id=\"curve-0-title\"") && page.contains("class=\"band s1\""));
    assert!(page.contains("id=\"histogram-0-title\"") && page.contains("84 %"));
}

#[test]
fn a_page_needs_no_network_and_no_name_becomes_markup() {
    let hostile = "<script>alert(1)</script>\"'&";
    let mut study = two_grids();
    study.name = hostile.into();
    study.columns[0].name = hostile.into();
    study.columns[0].unit = "</script><b>".into();
    study.refusals[0].reason = hostile.into();
    let page = study_page(&study);
    assert!(!page.contains("<script>alert") && !page.contains("</script><b>"));
    assert!(!page.contains("http://") && !page.contains("https://"), "an address");
    assert_eq!(page.matches("<script").count(), 2);
}

#[test]
fn a_page_of_any_study_stays_small() {
    let many: Vec<f64> = (0..300_000).map(|i| f64::from(i).sin()).collect();
    let page = study_page(&record(vec![
        column("a", "", StudyRole::Drawn, many.clone()),
        column("b", "m", StudyRole::Quantity, many),
    ]));
    assert!(page.len() < 1_000_000, "{} bytes", page.len());
    let none = study_page(&record(vec![column("b", "m", StudyRole::Quantity, vec![f64::NAN; 5])]));
    assert!(none.contains("2 of 5 rows"));
}
