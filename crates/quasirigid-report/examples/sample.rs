//! Writes reports of made-up runs into a folder, to be looked at: `cargo run --example sample -- FOLDER`.
#![allow(clippy::unwrap_used)]

#[allow(dead_code)]
#[path = "../tests/support/mod.rs"]
mod support;

use std::path::Path;

use quasirigid_io::record::RunRecord;
use quasirigid_report::page;

fn main() {
    let folder = std::env::args().nth(1).unwrap_or_else(|| ".".into());
    let save = |name: &str, record: &RunRecord| {
        std::fs::write(Path::new(&folder).join(name), page(record)).unwrap();
    };
    save("report.html", &support::record(6000, 1200.0, 1.5e-3));
    save("long.html", &support::record(200_000, 20_000.0, 2e-6));
    save("ageing.html", &asteroid());
    save("bare.html", &hostile());
}

/// A tumbling asteroid with a secular evolution and no histories.
fn asteroid() -> RunRecord {
    let mut record = support::without_histories();
    record.model.name = "99942 Apophis".into();
    record.model.file = "apophis.toml".into();
    record.notes.clear();
    record.body.mass = 5.3e10;
    record.body.principal_moments = support::secular::ASTEROID.map(|moment| moment * 5e14);
    let mut evolution = support::secular::evolution(1.0 / 1.024);
    evolution.resonances.clear();
    record.evolution = Some(evolution);
    record
}

/// A record with few values, each of them awkward.
fn hostile() -> RunRecord {
    let mut record = support::without_histories();
    record.model.name = "<script>alert(1)</script> & a very long name that goes on and on".into();
    record.validity.criteria.clear();
    record.validity.valid = false;
    record.validity.verdict = "The spin is faster than the slowest vibration.".into();
    record.validity.T2 = None;
    record.validity.decay_rates.clear();
    record.histories = vec![support::history("rigid", 1, 1.0, 0.0)];
    record.histories[0].status = "left validity".into();
    record.histories[0].message = "The run stopped at 0 s, where |ω|/Ω₁ passed 0.5.".into();
    record
}
