//! A sampled history: nutation, energy and numerical drift of a satellite with a damped mass.

use quasirigid::prelude::*;

/// Output of the program.
pub fn program() -> Result<String, quasirigid::Error> {
    let mut satellite = Assembly::default().with(Carrier::principal(40.0, [9.0, 13.0, 16.0]));
    let mass = satellite.add(Point::new("mass", 1.0, [0.8, 0.3, 0.5]));
    satellite.add(Spring::isotropic(600.0, 30.0).between(mass, CARRIER));
    let reduced = reduce(&satellite.body()?, 4)?;
    let start = Start::wobbling(&reduced, Mode::ShortAxis, 0.5, 1.0)?;
    let (times, mut samples): (_, Vec<Sample>) = ([0.0, 1000.0, 2000.0, 3000.0], Vec::new());
    propagate(&reduced, start, &times, &Options::default(), &mut samples)?;
    let axis = Principal::compute(reduced.J).axes[2];
    let row = |s: &Sample| {
        let (nutation, small) = (angle(s.angular_momentum, axis).to_degrees(), s.energy_drift.abs() < 1e-9);
        format!("{:4} s: {nutation:.3} deg, {:.4} J, drift below 1 nJ: {small}\n", s.t, s.energy)
    };
    Ok(samples.iter().map(row).collect())
}

#[allow(dead_code, clippy::print_stdout)] // a module of a test too
fn main() -> Result<(), quasirigid::Error> {
    print!("{}", program()?);
    Ok(())
}

// Prints:
//    0 s: 14.093 deg, 8.7662 J, drift below 1 nJ: true
// 1000 s: 27.682 deg, 8.7647 J, drift below 1 nJ: true
// 2000 s: 18.074 deg, 8.7632 J, drift below 1 nJ: true
// 3000 s: 25.850 deg, 8.7616 J, drift below 1 nJ: true
