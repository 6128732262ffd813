//! Estimate of the error against the error.

use super::super::StokesFlow;
use super::lattice::{ball, block, cylinder};
use super::{AXES, distance, loads};
use crate::math::krylov::dot;
use crate::math::vec3::{add, cross, dot as scalar, scale};

/// `u = −(1 − r²)/10 e × r` in the unit ball.
#[test]
fn the_estimate_is_that_of_the_gradient_in_a_ball() {
    for n in [3, 6] {
        let flow = StokesFlow::new(&ball(n, &|x| x)).unwrap();
        let flows = flow.solve(&loads(&flow), 0.0).unwrap();
        for (axis, u) in AXES.into_iter().zip(&flows) {
            let exact = |x: [f64; 3]| {
                let (swirl, share) = (cross(axis, x), 0.1 * (scalar(x, x) - 1.0));
                let along = |e| add(scale(0.2 * scalar(e, x), swirl), scale(share, cross(axis, e)));
                let columns = AXES.map(along);
                [0, 1, 2].map(|i| [0, 1, 2].map(|k| columns[k][i]))
            };
            let (estimate, error) = (flow.error_energy(u), distance(&flow, u, exact));
            assert!((0.5..2.0).contains(&(estimate / error)), "{estimate:e} for {error:e}");
        }
    }
}

/// Error of the tensor, of which the share of the curved wall is no error of the gradient.
#[test]
fn the_estimate_is_of_the_size_of_the_error_of_the_tensor() {
    let round = (8.0 * std::f64::consts::PI / 525.0, ball(6, &|x| x), 0);
    let upright = (0.034_506_63, cylinder(6), 2);
    let square = (9.8571e-4, block(5), 0);
    for (exact, mesh, axis) in [round, upright, square] {
        let flow = StokesFlow::new(&mesh).unwrap();
        let load = loads(&flow).swap_remove(axis);
        let u = flow.solve(std::slice::from_ref(&load), 0.0).unwrap().remove(0);
        let (estimate, error) = (flow.error_energy(&u), exact - dot(&load, &u));
        assert!((0.3..3.0).contains(&(estimate / error)), "{estimate:e} for {error:e}");
    }
}
