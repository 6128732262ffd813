//! The full system without dissipation, linearised about a state by differences of its rates.

use quasirigid::model::{FlexibleBody, Kinetics};
use quasirigid_math::eigen::Dense;
use quasirigid_math::vec3::cross;

/// Rates of the full state: angular momentum, momenta of the coordinates, coordinates.
pub fn rates(body: &FlexibleBody, state: &[f64]) -> Vec<f64> {
    let n = body.coordinates().len();
    let (K, p, q) = ([state[0], state[1], state[2]], &state[3..3 + n], &state[3 + n..]);
    let mut kinetics = Kinetics::new(body).unwrap();
    let (mut load, mut rate) = (vec![0.0; n], vec![0.0; n]);
    let velocities = kinetics.velocities(K, p, q, &mut rate);
    velocities.add_loads(q, &rate, &mut load);
    [&cross(K, velocities.omega)[..], &load, &rate].concat()
}

/// Derivative of the rates by central differences of sixth order over a share of the sizes, which scale the matrix.
pub fn linearised(body: &FlexibleBody, state: &[f64], sizes: &[f64], share: f64) -> Dense {
    let mut matrix = Dense::zero(state.len());
    for column in 0..state.len() {
        let h = share * sizes[column];
        let at = |steps: f64| {
            let mut moved = state.to_vec();
            moved[column] += steps * h;
            rates(body, &moved)
        };
        let sides = [(1.0, 0.75), (2.0, -0.15), (3.0, 1.0 / 60.0)]
            .map(|(steps, weight)| (at(steps), at(-steps), weight));
        for row in 0..state.len() {
            let slope: f64 = sides.iter().map(|(up, down, weight)| weight * (up[row] - down[row])).sum();
            matrix.add(row, column, slope / h * sizes[column] / sizes[row]);
        }
    }
    matrix
}
