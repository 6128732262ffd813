//! Convergence of refined cells to closed forms.

use std::f64::consts::PI;

use super::super::StokesFlow;
use super::lattice::{SIDES, ball, block, cylinder, faceted_ball};
use super::{diagonal, distance, ellipsoid, gap, tensor, turned, turned_tensor};
use crate::math::vec3::{add, scale};
use quasirigid_mesh::Mesh;

/// Errors of the tensor on two meshes and the order in which they fall.
fn order(counts: [i64; 2], mesh: &dyn Fn(i64) -> Mesh, exact: [[f64; 3]; 3]) -> ([f64; 2], f64) {
    let errors = counts.map(|n| gap(tensor(&StokesFlow::new(&mesh(n)).unwrap()), exact));
    (errors, (errors[0] / errors[1]).ln() / (counts[1] as f64 / counts[0] as f64).ln())
}

#[test]
fn curved_cells_converge_in_a_ball() {
    let exact = diagonal([8.0 * PI / 525.0; 3]);
    let (errors, order) = order([3, 6], &|n| ball(n, &|x| x), exact);
    assert!(order > 3.7 && errors[1] < 1.7e-3, "{errors:?}, order {order}");
}

/// Ellipsoid off the origin, on rotated axes and in odd units: all six components.
#[test]
fn curved_cells_converge_in_an_ellipsoid() {
    let unit = 1e-3;
    let half = [1.3, 0.8, 0.6];
    let moved = |x: [f64; 3]| {
        scale(unit, add([7.0, -5.0, 3.0], turned(std::array::from_fn(|axis| half[axis] * x[axis]))))
    };
    let exact = turned_tensor(diagonal(ellipsoid(half).map(|P| unit.powi(7) * P)));
    let (errors, order) = order([3, 6], &|n| ball(n, &moved), exact);
    assert!(order > 3.5 && errors[1] < 1.4e-3, "{errors:?}, order {order}");
}

#[test]
fn straight_cells_lose_what_lies_between_them_and_a_round_wall() {
    let exact = diagonal([8.0 * PI / 525.0; 3]);
    let (errors, order) = order([4, 8], &faceted_ball, exact);
    assert!((order - 2.0).abs() < 0.2, "{errors:?}, order {order}");
}

#[test]
fn curved_cells_converge_in_a_cylinder() {
    let found = [3, 6].map(|n| tensor(&StokesFlow::new(&cylinder(n)).unwrap())[2][2]);
    let errors = found.map(|P| (P / 0.034_506_63 - 1.0).abs());
    let order = (errors[0] / errors[1]).log2();
    assert!(order > 3.3 && errors[1] < 3e-3, "{errors:?}, order {order}");
}

/// Two families of meshes, extrapolated with the fourth power of the size of their cells, agree to 1e-5. The error of the tensor has parts
/// of either sign here, so that it is small before its asymptotic fall.
#[test]
fn straight_cells_converge_in_a_box() {
    let exact = diagonal([9.8571e-4, 1.612_82e-3, 7.9914e-4]);
    let (errors, order) = order([3, 5], &block, exact);
    assert!(order > 2.5 && errors[1] < 1.2e-3, "{errors:?}, order {order}");
}

/// `s²(1 − s)²` for `s` from 0 to 1 along a length, and its derivatives.
fn bump(x: f64, length: f64) -> [f64; 4] {
    let s = x / length + 0.5;
    let values = [
        (s * (1.0 - s)).powi(2),
        2.0 * s * (1.0 - s) * (1.0 - 2.0 * s),
        2.0 - 12.0 * s + 12.0 * s * s,
        24.0 * s - 12.0,
    ];
    std::array::from_fn(|k| values[k] / length.powi(k as i32))
}

const FIRST: [[usize; 3]; 3] = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];

/// The flow `∇ × (0, 0, b(x) b(y) b(z))` in a box with these sides, on whose walls it vanishes.
struct Eddy([f64; 3]);

impl Eddy {
    /// Derivative of `b(x) b(y) b(z)` of the sum of these orders.
    fn derivative(&self, x: [f64; 3], orders: &[[usize; 3]]) -> f64 {
        let order = |axis: usize| orders.iter().map(|order| order[axis]).sum::<usize>();
        (0..3).map(|axis| bump(x[axis], self.0[axis])[order(axis)]).product()
    }

    fn gradient(&self, x: [f64; 3]) -> [[f64; 3]; 3] {
        let row = |sign: f64, own| FIRST.map(|axis| sign * self.derivative(x, &[own, axis]));
        [row(1.0, FIRST[1]), row(-1.0, FIRST[0]), [0.0; 3]]
    }

    /// Force that drives the flow against the pressure `x y z / 1000`.
    fn force(&self, x: [f64; 3]) -> [f64; 3] {
        let laplacian = |own| FIRST.map(|axis| self.derivative(x, &[own, axis, axis])).iter().sum::<f64>();
        let pressure = scale(1e-3, [x[1] * x[2], x[2] * x[0], x[0] * x[1]]);
        add(pressure, [-laplacian(FIRST[1]), laplacian(FIRST[0]), 0.0])
    }

    /// Energy of the error and its estimate.
    fn errors(&self, n: i64) -> [f64; 2] {
        let mut mesh = block(n);
        mesh.nodes
            .iter_mut()
            .for_each(|x| *x = std::array::from_fn(|axis| self.0[axis] * x[axis] / SIDES[axis]));
        let flow = StokesFlow::new(&mesh).unwrap();
        let u = flow.solve(&[flow.load(&|x| self.force(x))], 0.0).unwrap().remove(0);
        [distance(&flow, &u, |x| self.gradient(x)), flow.error_energy(&u)]
    }
}

#[test]
fn the_energy_of_the_error_falls_with_the_fourth_power_in_a_box() {
    let errors = [3, 5].map(|n| Eddy(SIDES).errors(n));
    let order = (errors[0][0] / errors[1][0]).ln() / (5.0_f64 / 3.0).ln();
    assert!((order - 4.0).abs() < 0.4, "{errors:?}, order {order}");
    for [error, estimate] in errors.into_iter().chain([Eddy([1.0, 0.8, 1e-3]).errors(3)]) {
        assert!((0.5..2.0).contains(&(estimate / error)), "{estimate:e} for {error:e}");
    }
}
