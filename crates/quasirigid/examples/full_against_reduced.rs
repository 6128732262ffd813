//! The full stiff system against the reduced equations, from the slow manifold and from rest.

use quasirigid::prelude::*;

/// Output of the program.
pub fn program() -> Result<String, quasirigid::Error> {
    let mut satellite = Assembly::default().with(Carrier::principal(40.0, [9.0, 13.0, 16.0]));
    let mass = satellite.add(Point::new("mass", 1.0, [0.8, 0.3, 0.5]));
    satellite.add(Spring::isotropic(600.0, 2.0).between(mass, CARRIER));
    let (body, options) = (satellite.body()?, Options { tolerance: 1e-11, ..Options::default() });
    let (system, reduced) = (Forced::not(&body), reduce(&body, 4)?);
    let times: Vec<f64> = (0..=100).map(f64::from).collect();
    let start = Start::new([1.2, 0.35, 0.2], ALIGNED);
    let difference = |state: FullState| {
        let (mut full, mut slow): (Vec<Sample>, Vec<Sample>) = Default::default();
        propagate_full(system, &state, &times, &options, &mut full)?;
        propagate(&reduced, Start::matched(&reduced, &body, &state), &times, &options, &mut slow)?;
        Ok::<_, quasirigid::Error>(Difference::between(&full, &slow).omega)
    };
    let [settled, at_rest] = [start.settled(system, 4)?, start.at_rest(&body)].map(difference);
    Ok(format!("spin differs by {:.0e} from the manifold, {:.0e} from rest\n", settled?, at_rest?))
}

#[allow(dead_code, clippy::print_stdout)] // a module of a test too
fn main() -> Result<(), quasirigid::Error> {
    print!("{}", program()?);
    Ok(())
}

// Prints:
// spin differs by 2e-8 from the manifold, 3e-4 from rest
