//! Two hundred stiffnesses in parallel: the one that damps nutation fastest while the theory holds.

use quasirigid::prelude::*;
use rayon::prelude::*;

/// Stiffness, growth rate of a small nutation about the axis of greatest inertia, and the verdict on the theory.
fn rate(i: u32) -> Result<(f64, f64, Verdict), quasirigid::Error> {
    let stiffness = 50.0 * 100.0_f64.powf(f64::from(i) / 199.0);
    let mut satellite = Assembly::default().with(Carrier::principal(40.0, [9.0, 13.0, 16.0]));
    let mass = satellite.add(Point::new("mass", 1.0, [0.8, 0.3, 0.5]));
    satellite.add(Spring::isotropic(stiffness, 2.0).between(mass, CARRIER));
    let (body, omega) = (satellite.body()?, [0.1, 0.0, 1.0]);
    let reduced = reduce(&body, 3)?;
    let verdict = Validity::assess_reduced(&body, &reduced, omega)?.verdict();
    let spin = steady_spins(&reduced, norm(reduced.angular_momentum(omega)))[2];
    Ok((stiffness, spin.map_or(f64::NAN, |spin| spin.growth), verdict))
}

/// Output of the program.
pub fn program() -> Result<String, quasirigid::Error> {
    let rates = (0..200).into_par_iter().map(rate).collect::<Result<Vec<_>, _>>()?;
    let holding = rates.iter().filter(|(.., verdict)| *verdict != Verdict::Fails);
    let best = holding.clone().min_by(|a, b| a.1.total_cmp(&b.1)).expect("a stiffness that holds");
    Ok(format!("{} of {} hold; best {:.0} N/m, {:.3e} 1/s\n", holding.count(), rates.len(), best.0, best.1))
}

#[allow(dead_code, clippy::print_stdout)] // a module of a test too
fn main() -> Result<(), quasirigid::Error> {
    print!("{}", program()?);
    Ok(())
}

// Prints:
// 200 of 200 hold; best 50 N/m, -1.902e-5 1/s
