//! Ten billion years of a tumbling asteroid.

use quasirigid::prelude::*;

const YEAR: f64 = 365.25 * 86400.0;

/// Output of the program.
pub fn program() -> Result<String, quasirigid::Error> {
    let rock = Material::new(2000.0, 1e9, 0.25).quality(100.0);
    let body = Assembly::default().with(Ellipsoid::new("rock", [200.0, 140.0, 120.0], rock)).body()?;
    let reduced = reduce(&body, 3)?;
    let moments = Principal::compute(reduced.J).moments;
    let angular_momentum = moments[2] * std::f64::consts::TAU / (30.0 * 3600.0);
    let motion = FreeRotation::at_nutation(moments, angular_momentum, Mode::LongAxis, 20_f64.to_radians())?;
    let evolution = Evolution::compute(&body, &reduced, angular_momentum)?;
    let start = RotationState::from_motion(&motion);
    let row = |t: f64| {
        let rotation_state = evolution.after(start?, t * 1e9 * YEAR)?;
        let wobble = evolution.motion(rotation_state).nutation()[1].to_degrees();
        Some(format!("{t:2} Gyr: {:?}, wobble {wobble:.2} deg\n", rotation_state.mode))
    };
    Ok([0.0, 1.0, 2.0, 5.0, 10.0].into_iter().filter_map(row).collect())
}

#[allow(dead_code, clippy::print_stdout)] // a module of a test too
fn main() -> Result<(), quasirigid::Error> {
    print!("{}", program()?);
    Ok(())
}

// Prints:
//  0 Gyr: LongAxis, wobble 20.00 deg
//  1 Gyr: LongAxis, wobble 75.88 deg
//  2 Gyr: ShortAxis, wobble 32.05 deg
//  5 Gyr: ShortAxis, wobble 1.52 deg
// 10 Gyr: ShortAxis, wobble 0.01 deg
