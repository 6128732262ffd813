//! Any record makes a page.

use std::collections::BTreeMap;

use proptest::collection::vec;
use proptest::num::f64::{ANY, INFINITE, NEGATIVE, NORMAL, POSITIVE, SUBNORMAL, ZERO};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use quasirigid_io::record::{EvolutionRecord, RunRecord};
use quasirigid_report::page;

/// Numbers of any size, near each other in some runs so that ranges are narrow in some.
fn numbers() -> impl Strategy<Value = Vec<f64>> {
    let finite = || POSITIVE | NEGATIVE | NORMAL | SUBNORMAL | ZERO;
    prop_oneof![
        vec(finite(), 0..40),
        (finite(), vec(-1e-12..1e-12, 0..40))
            .prop_map(|(value, noise)| noise.iter().map(|x| value * (1.0 + x)).collect()),
        vec(prop_oneof![ANY, INFINITE], 0..40),
        vec(-1.0..1.0, 0..40),
    ]
}

fn record() -> impl Strategy<Value = RunRecord> {
    (vec(numbers(), 25), vec(ANY, 60), any::<bool>()).prop_map(|(columns, numbers, keep_axes)| {
        let mut record = crate::support::record(2, 1.0, 0.1);
        let evolution = record.evolution.iter_mut().flat_map(|evolution| &mut evolution.columns);
        for (column, values) in record.histories[0].columns.iter_mut().chain(evolution).zip(columns) {
            column.values = values;
        }
        let mut numbers = numbers.into_iter().cycle();
        let mut set = |place: &mut f64| *place = numbers.next().unwrap_or_default();
        let history = &mut record.histories[0];
        [&mut history.revolutions, &mut history.energy, &mut history.dissipated, &mut history.energy_drift]
            .into_iter()
            .for_each(&mut set);
        record.body.inertia.as_flattened_mut().iter_mut().for_each(&mut set);
        record.body.principal_moments.iter_mut().for_each(&mut set);
        if !keep_axes {
            record.body.principal_axes.as_flattened_mut().iter_mut().for_each(&mut set);
        }
        record.validity.frequencies.iter_mut().for_each(&mut set);
        record.reduction.degrees.iter_mut().for_each(|degree| set(&mut degree.size));
        let shares = [&mut record.reduction.dissipation].into_iter();
        let shares = shares.chain(record.histories.iter_mut().map(|history| &mut history.dissipation));
        shares.flat_map(BTreeMap::values_mut).for_each(&mut set);
        for row in record.verification.iter_mut().flat_map(|verification| &mut verification.orders) {
            row.errors.iter_mut().chain(&mut row.epsilons).chain(&mut row.attitude).for_each(&mut set);
        }
        record.evolution.iter_mut().for_each(|evolution| evolution_numbers(evolution).for_each(&mut set));
        set(&mut record.validity.T1);
        set(&mut record.reduction.residual);
        record
    })
}

fn evolution_numbers(evolution: &mut EvolutionRecord) -> impl Iterator<Item = &mut f64> {
    let EvolutionRecord {
        time,
        revolutions,
        power,
        angular_momentum,
        damping_time,
        growth_time,
        ratio_start,
        ratio_end,
        ..
    } = evolution;
    let numbers =
        [time, revolutions, power, angular_momentum, damping_time, growth_time, ratio_start, ratio_end];
    let harmonics = evolution.harmonics.iter_mut().flat_map(|row| [&mut row.frequency, &mut row.share]);
    let crossings = evolution.resonances.iter_mut().flat_map(|row| [&mut row.frequency, &mut row.ratio]);
    let maybe = evolution.separatrix_time.iter_mut().chain(&mut evolution.lingering);
    numbers
        .into_iter()
        .chain(harmonics)
        .chain(crossings)
        .chain(maybe)
        .chain(evolution.time_range.iter_mut().flatten())
}

proptest! {
    #![proptest_config(ProptestConfig { rng_seed: RngSeed::Fixed(1978), ..ProptestConfig::default() })]

    #[test]
    fn any_numbers_make_a_page_of_finite_geometry(record in record()) {
        let page = page(&record);
        prop_assert!(page.ends_with("</html>") && page.len() < 1_000_000);
        for path in page.split(" d=\"").skip(1) {
            let path = path.split('"').next().unwrap_or_default();
            prop_assert!(!path.contains("NaN") && !path.contains("inf"), "{path}");
        }
        for label in page.split("<text").skip(1) {
            let label = label.split("</text>").next().unwrap_or_default();
            prop_assert!(!label.contains("NaN") && !label.contains("inf"), "{label}");
        }
    }
}
