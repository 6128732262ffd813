//! One run of the common problem, as one line of JSON: `common_problem --case A --tolerance 1e-9 [--method implicit]`.
#![allow(non_snake_case, clippy::print_stdout)]

use std::error::Error;
use std::time::Instant;

use quasirigid::dynamics::{Forced, FullState, Method, Options, propagate_full};
use quasirigid::math::rotation::ALIGNED;
use quasirigid::problems::CommonProblem;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let value = |key: &str| {
        let place = arguments.iter().position(|argument| argument == key)?;
        arguments.get(place + 1).cloned()
    };
    let name = value("--case").unwrap_or_else(|| "A".into());
    let tolerance: f64 = value("--tolerance").map_or(Ok(1e-9), |text| text.parse())?;
    let method = match value("--method").as_deref() {
        None | Some("automatic") => Method::Automatic,
        Some("explicit") => Method::Explicit,
        Some("implicit") => Method::Implicit,
        Some(other) => return Err(format!("no method {other}: automatic, explicit, implicit").into()),
    };
    let case = CommonProblem::named(&name).ok_or("cases: A, B, C, over, soft, long")?;
    let body = case.assembly().body()?;
    let start = FullState::at_rest(&body, CommonProblem::SPIN, ALIGNED);
    let options = Options { tolerance, method, ..Options::default() };
    let clock = Instant::now();
    let run = propagate_full(Forced::not(&body), &start, &[case.duration], options, &mut Vec::new())?;
    let seconds = clock.elapsed().as_secs_f64();
    let [x, y, z] = run.last.omega;
    println!(
        "{{\"case\": \"{name}\", \"tolerance\": {tolerance:e}, \"omega\": [{x:?}, {y:?}, {z:?}], \
         \"energy\": {:?}, \"momentum_drift\": {:e}, \"seconds\": {seconds:e}, \"steps\": {}, \"implicit_steps\": {}, \"rejected\": {}, \"evaluations\": {}, \"factorizations\": {}}}",
        run.last.energy, run.last.momentum_drift, run.work.steps, run.work.implicit_steps, run.work.rejected, run.work.evaluations, run.work.factorizations
    );
    Ok(())
}
