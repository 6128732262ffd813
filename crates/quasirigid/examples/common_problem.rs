//! The common problem, as one line of JSON: `common_problem --case A --tolerance 1e-9 [--method implicit]`. The time is
//! the least of five runs.
#![allow(non_snake_case, clippy::print_stdout)]

use std::error::Error;
use std::time::Instant;

use quasirigid::dynamics::{Forced, FullState, Method, Options, propagate_full};
use quasirigid::problems::CommonProblem;
use quasirigid_math::ode::Work;
use quasirigid_math::rotation::ALIGNED;

/// Runs until their total is so many times the least of them.
const ENOUGH: f64 = 5.0;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let value = |key: &str| {
        let place = arguments.iter().position(|argument| argument == key)?;
        arguments.get(place + 1).cloned()
    };
    let name = value("--case").unwrap_or_else(|| "A".into());
    let tolerance: f64 = value("--tolerance").map_or(Ok(1e-9), |text| text.parse())?;
    let method = value("--method").unwrap_or_else(|| "automatic".into());
    let chosen = match method.as_str() {
        "automatic" => Method::Automatic,
        "explicit" => Method::Explicit,
        "implicit" => Method::Implicit,
        other => return Err(format!("no method {other}: automatic, explicit, implicit").into()),
    };
    let case = CommonProblem::named(&name).ok_or("cases: A, B, C, over, soft, long")?;
    let body = case.assembly().body()?;
    let start = FullState::at_rest(&body, CommonProblem::SPIN, ALIGNED);
    let options = Options { tolerance, method: chosen, ..Options::default() };
    let (mut seconds, mut total) = (f64::INFINITY, 0.0);
    let run = loop {
        let clock = Instant::now();
        let run = propagate_full(Forced::not(&body), &start, &[case.duration], &options, &mut Vec::new())?;
        let elapsed = clock.elapsed().as_secs_f64();
        (seconds, total) = (elapsed.min(seconds), total + elapsed);
        if total > ENOUGH * seconds {
            break run;
        }
    };
    let [x, y, z] = run.last.omega;
    let Work { steps, implicit_steps, rejected, evaluations, factorizations, .. } = run.work;
    println!(
        "{{\"case\": \"{name}\", \"method\": \"{method}\", \"tolerance\": {tolerance:e}, \"omega\": [{x:?}, {y:?}, {z:?}], \
         \"energy\": {:?}, \"momentum_drift\": {:e}, \"seconds\": {seconds:e}, \"steps\": {steps}, \
         \"implicit_steps\": {implicit_steps}, \"rejected\": {rejected}, \"evaluations\": {evaluations}, \
         \"factorizations\": {factorizations}}}",
        run.last.energy, run.last.momentum_drift,
    );
    Ok(())
}
