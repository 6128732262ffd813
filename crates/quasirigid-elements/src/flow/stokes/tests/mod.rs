//! Flows in balls, ellipsoids, cylinders and boxes against closed forms.

mod convergence;
mod estimate;
mod lattice;
mod laws;
mod refusals;

use super::StokesFlow;
use super::cell::points;
use crate::math::krylov::dot;
use crate::math::vec3::{add, cross, scale};

const AXES: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Loads of unit angular accelerations about the axes, `−e × r`.
fn loads(flow: &StokesFlow) -> Vec<Vec<f64>> {
    let from_center = |x: [f64; 3]| add(x, scale(-1.0, flow.moments().center));
    AXES.iter().map(|axis| flow.load(&|x| cross(from_center(x), *axis))).collect()
}

/// `P_kl = −e_k·∫ r × u_l dV`. (L5)
fn tensor(flow: &StokesFlow) -> [[f64; 3]; 3] {
    let loads = loads(flow);
    let flows = flow.solve(&loads, 0.0).unwrap();
    [0, 1, 2].map(|k| [0, 1, 2].map(|l| dot(&loads[k], &flows[l])))
}

/// The tensor of an ellipsoid with these half-axes, diagonal.
fn ellipsoid(axes: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| {
        let [a, b, c] = [0, 1, 2].map(|i| axes[(k + i) % 3]);
        let [aa, bb, cc] = [a * a, b * b, c * c];
        let below =
            3.0 * aa * bb * bb + 2.0 * aa * bb * cc + 3.0 * aa * cc * cc + bb * bb * cc + bb * cc * cc;
        16.0 * std::f64::consts::PI * a.powi(3) * (b * c).powi(5) / (105.0 * below)
    })
}

/// Largest entry of a difference beside the largest of `exact`.
fn gap(found: [[f64; 3]; 3], exact: [[f64; 3]; 3]) -> f64 {
    let largest = exact.as_flattened().iter().fold(0.0_f64, |largest, entry| largest.max(entry.abs()));
    let gaps = found.as_flattened().iter().zip(exact.as_flattened()).map(|(a, b)| (a - b).abs() / largest);
    gaps.fold(0.0, |worst, gap| if gap <= worst { worst } else { gap })
}

fn diagonal([x, y, z]: [f64; 3]) -> [[f64; 3]; 3] {
    [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]]
}

/// Place rotated by 0.7 about the third axis, then by −1.1 about the first.
fn turned([x, y, z]: [f64; 3]) -> [f64; 3] {
    let ([s, c], [t, d]) = ([0.7_f64.sin(), 0.7_f64.cos()], [-1.1_f64.sin(), 1.1_f64.cos()]);
    let [x, y] = [c * x - s * y, s * x + c * y];
    [x, d * y - t * z, t * y + d * z]
}

/// `R A Rᵀ` with the rotation `R` of [`turned`].
fn turned_tensor(A: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let R = AXES.map(turned);
    let entry = |i: usize, j: usize| (0..9).map(|k| R[k / 3][i] * A[k / 3][k % 3] * R[k % 3][j]).sum();
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| entry(i, j)))
}

/// The velocities of the nodes that move in a field.
fn nodal(flow: &StokesFlow, field: impl Fn([f64; 3]) -> [f64; 3]) -> Vec<f64> {
    let mut u = vec![0.0; flow.unknowns()];
    for (place, unknown) in flow.grid.places.iter().zip(&flow.assembly.unknowns) {
        if let Some(unknown) = unknown {
            u[3 * *unknown as usize..][..3].copy_from_slice(&field(*place));
        }
    }
    u
}

/// `∫ |∇v − ∇u|² dV` for a gradient `∂v_i/∂x_k`, rows `i`.
fn distance(flow: &StokesFlow, u: &[f64], gradient: impl Fn([f64; 3]) -> [[f64; 3]; 3]) -> f64 {
    let velocity = |node: usize| match flow.assembly.unknowns[node] {
        Some(unknown) => [0, 1, 2].map(|axis| u[3 * unknown as usize + axis]),
        None => [0.0; 3],
    };
    let mut sum = 0.0;
    for cell in &flow.grid.cells {
        let u = cell.map(velocity);
        for point in points(&cell.map(|node| flow.grid.places[node])) {
            let (found, exact) = (point.gradient(&u), gradient(point.place));
            let squares = found.as_flattened().iter().zip(exact.as_flattened()).map(|(a, b)| (a - b).powi(2));
            sum += point.volume * squares.sum::<f64>();
        }
    }
    sum
}
