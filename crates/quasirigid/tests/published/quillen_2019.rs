//! Wobble damping of N-body mass-spring bodies, simulated by other people, against the Kelvin–Voigt ellipsoid: no
//! parameter is adjusted.

use super::quillen_runs::{SteadyRun, ellipsoid, power, steady_runs, summary};

#[test]
fn dissipation_of_every_steady_run_is_predicted() {
    let mut ratios = Vec::new();
    println!("run       measured    predicted  ratio");
    for SteadyRun { name, shape, omega, outer, time, measured } in steady_runs() {
        let power = power(&ellipsoid(shape, outer, time), omega);
        let ratio = -measured / power;
        println!("{name:<6} {measured:>12.4e} {:>12.4e}  {ratio:.3}", -power);
        ratios.push(ratio);
    }
    let (median, near) = summary(&mut ratios);
    println!("{} runs, median {median:.3}, {near} within 20 %", ratios.len());
    assert!((median - 1.11).abs() < 0.03, "{median}");
    assert!(near as f64 >= 0.88 * ratios.len() as f64, "{near} of {}", ratios.len());
}
