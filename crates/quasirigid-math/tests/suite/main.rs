//! Laws of formulas over random ones, elliptic functions against an independent library, checkpoints of the integrators.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

mod checkpoints;
mod elliptic;
mod formulas;
mod submanifold;

use proptest::prelude::ProptestConfig;
use proptest::test_runner::RngSeed;

/// Number of cases on which a law is tried; the same ones in every run unless the environment says otherwise.
fn cases(count: u32) -> ProptestConfig {
    let number = |name: &str| std::env::var(name).ok().and_then(|text| text.parse::<u64>().ok());
    ProptestConfig {
        cases: number("PROPTEST_CASES").map_or(count, |cases| cases as u32),
        rng_seed: RngSeed::Fixed(number("PROPTEST_RNG_SEED").unwrap_or(1978)),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}
