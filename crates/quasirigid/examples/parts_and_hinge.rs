//! Three sprung parts and a hinge: the reduced equations to order 4.

use quasirigid::prelude::*;

/// Output of the program.
pub fn program() -> Result<String, quasirigid::Error> {
    let mut satellite = Assembly::default().with(Carrier::principal(40.0, [9.0, 13.0, 16.0]));
    for (name, place) in [("left", [0.8, 0.3, 0.5]), ("right", [-0.7, 0.2, 0.4]), ("top", [0.1, -0.2, 0.9])] {
        let part = satellite.add(Point::new(name, 1.0, place));
        satellite.add(Spring::isotropic(600.0, 2.0).between(part, CARRIER));
    }
    let inertia = [[0.2, 0.0, 0.0], [0.0, 1e-3, 0.0], [0.0, 0.0, 0.2]];
    let boom = Hinged::new("boom", 2.0, [0.0, -1.5, 0.2], inertia).on([0.0, -1.0, 0.2]);
    satellite.add(boom.about([1.0, 0.0, 0.0], 200.0, 0.5));
    let reduced = reduce(&satellite.body()?, 4)?;
    let torque = reduced.mu(4).value([1.2, 0.35, 0.2]);
    let tensor = reduced.tensor(&[0, 0, 1, 1]);
    Ok(format!("mu_4 = {torque:.5?} N m at (1.2, 0.35, 0.2) rad/s\nD_xxyy = {tensor:.5?} N m s^4\n"))
}

#[allow(dead_code, clippy::print_stdout)] // a module of a test too
fn main() -> Result<(), quasirigid::Error> {
    print!("{}", program()?);
    Ok(())
}

// Prints:
// mu_4 = [0.00033, -0.00118, -0.00154] N m at (1.2, 0.35, 0.2) rad/s
// D_xxyy = [-0.00015, -0.00001, -0.00001] N m s^4
