//! Laws that hold on every mesh.

use super::super::StokesFlow;
use super::lattice::{Lattice, ball, block, cylinder};
use super::{AXES, diagonal, gap, loads, nodal, tensor, turned, turned_tensor};
use crate::math::krylov::dot;
use crate::math::vec3::{add, cross, scale};
use quasirigid_mesh::Shape;

/// An octahedron of eight cells, off the origin, with the share `λ` of its middle at a place.
fn octahedron() -> (StokesFlow, impl Fn([f64; 3]) -> f64 + Copy) {
    let middle = [0.4, -2.0, 0.7];
    let mesh = Lattice::octahedron(1).straight(&|x| add(middle, x));
    let share = move |x: [f64; 3]| 1.0 - (0..3).map(|axis| (x[axis] - middle[axis]).abs()).sum::<f64>();
    (StokesFlow::new(&mesh).unwrap(), share)
}

fn close(found: f64, exact: f64) {
    assert!((found - exact).abs() < 1e-14 * exact.abs().max(1.0), "{found} is not {exact}");
}

/// `λ²` is a quadratic velocity without slip; `∫ λ^n = 8 n! / (n + 3)!`, and `|∇λ|² = 3`.
#[test]
fn integrals_over_straight_cells_are_exact() {
    let (flow, share) = octahedron();
    let [a, b] = [[0.3, -1.0, 0.8], [1.2, 0.5, 0.7]];
    let [u, v] = [a, b].map(|a| nodal(&flow, |x| scale(share(x).powi(2), a)));
    let product = crate::math::vec3::dot(a, b);
    close(dot(&v, &flow.mass_times(&u)), product * 8.0 * 24.0 / 5040.0);
    close(dot(&v, &flow.stiffness_times(&u)), product * 12.0 * 8.0 * 2.0 / 120.0);
    let axis = [-0.7, 0.9, 0.4];
    let triple = crate::math::vec3::dot(b, cross(axis, a));
    assert!(triple.abs() > 0.1);
    close(dot(&v, &flow.turned(axis, &u)), triple * 8.0 * 24.0 / 5040.0);
    // ∫ λ² y² dV = 8·2·2/7! about the middle, where odd powers vanish.
    let load = flow.load(&|[x, y, z]| [1.0 + x, y * y, x * z - 3.0]);
    let [whole, square] = [8.0 * 2.0 / 120.0, 8.0 * 4.0 / 5040.0];
    let exact = [1.4 * whole, 4.0 * whole + square, (0.4 * 0.7 - 3.0) * whole];
    close(dot(&u, &load), crate::math::vec3::dot(a, exact));
}

#[test]
fn moments_are_about_the_center() {
    let mut mesh = block(2);
    let place = |x| scale(1e-3, add([80.0, -30.0, 50.0], turned(x)));
    mesh.nodes.iter_mut().for_each(|x| *x = place(*x));
    // The first node of the first cell is no longer in the middle.
    mesh.cells.reverse();
    let flow = StokesFlow::new(&mesh).unwrap();
    let volume = 1.04e-9;
    assert!((flow.moments().volume / volume - 1.0).abs() < 1e-12);
    let center = [80e-3, -30e-3, 50e-3];
    assert!((0..3).all(|axis| (flow.moments().center[axis] / center[axis] - 1.0).abs() < 1e-14));
    let exact = turned_tensor(diagonal([1.0, 0.64, 1.69].map(|square| volume * square * 1e-6 / 12.0)));
    assert!(gap(flow.moments().second, exact) < 1e-12);
    // Curved cells miss 0.03 % of the volume of the ball.
    let flow = StokesFlow::new(&ball(6, &|x| x)).unwrap();
    assert!(gap(flow.moments().second, diagonal([4.0 * std::f64::consts::PI / 15.0; 3])) < 1e-3);
}

#[test]
fn units_and_axes_do_not_matter() {
    let lone = tensor(&StokesFlow::new(&cylinder(2)).unwrap());
    for unit in [1e-3, 1e3] {
        let mut mesh = cylinder(2);
        mesh.nodes.iter_mut().for_each(|x| *x = scale(unit, add(turned(*x), [30.0, -20.0, 10.0])));
        let moved = tensor(&StokesFlow::new(&mesh).unwrap());
        let exact = turned_tensor(lone.map(|row| row.map(|P| unit.powi(7) * P)));
        // Places 40 radii from the origin have that many roundings.
        assert!(gap(moved, exact) < 1e-11, "{:e}", gap(moved, exact));
        assert!(gap(moved, [0, 1, 2].map(|i| [0, 1, 2].map(|j| moved[j][i]))) < 1e-12);
    }
}

#[test]
fn flows_have_no_divergence() {
    for mesh in [ball(4, &|x| x), cylinder(3), block(3)] {
        let flow = StokesFlow::new(&mesh).unwrap();
        let loads = loads(&flow);
        for u in flow.solve(&loads, 0.0).unwrap() {
            assert!(flow.divergence(&u) < 1e-11, "{:e}", flow.divergence(&u));
        }
        assert!(flow.divergence(&loads[0]) > 1e-2);
        assert_eq!(flow.divergence(&vec![0.0; flow.unknowns()]), 0.0);
    }
}

/// `f·u = ∫|∇u|²`, and a force that is the gradient of a linear pressure moves nothing.
#[test]
fn the_work_of_the_load_is_dissipated() {
    let flow = StokesFlow::new(&block(2)).unwrap();
    let mut loads = loads(&flow);
    let push = flow.load(&|_| [1.0, 2.0, -3.0]);
    loads.push(loads[1].iter().zip(&push).map(|(a, b)| a + b).collect());
    loads.push(vec![0.0; flow.unknowns()]);
    let flows = flow.solve(&loads, 0.0).unwrap();
    for (load, u) in loads.iter().zip(&flows).take(3) {
        let [work, dissipated] = [dot(load, u), dot(u, &flow.stiffness_times(u))];
        assert!(work > 0.0 && (work / dissipated - 1.0).abs() < 1e-11, "{work} {dissipated}");
    }
    let largest = flows[1].iter().fold(0.0_f64, |largest, u| largest.max(u.abs()));
    assert!(flows[1].iter().zip(&flows[3]).all(|(a, b)| (a - b).abs() < 1e-10 * largest));
    assert!(flows[4].iter().all(|u| *u == 0.0));
    assert!(flow.solve(&[], 0.0).unwrap().is_empty());
}

#[test]
fn middle_nodes_are_made_where_cells_have_none() {
    let four = block(2);
    let ten = Lattice::block([2; 3]).quadratic(&|_| false, &|at| [0.25 * at[0], 0.2 * at[1], 0.325 * at[2]]);
    assert!(ten.cells.iter().all(|cell| cell.shape == Shape::Tet10));
    let flows = [four, ten.clone()].map(|mesh| StokesFlow::new(&mesh).unwrap());
    assert_eq!(flows[0].unknowns(), flows[1].unknowns());
    assert!(gap(tensor(&flows[0]), tensor(&flows[1])) < 1e-13);
    // One cell of 4 nodes among the others takes the nodes that they have on its edges.
    let mut mixed = ten;
    mixed.cells[30].shape = Shape::Tet4;
    mixed.cells[30].nodes = mixed.cells[30].nodes[..4].into();
    let mixed = StokesFlow::new(&mixed).unwrap();
    assert_eq!(mixed.unknowns(), flows[1].unknowns());
    assert!(gap(tensor(&mixed), tensor(&flows[1])) < 1e-13);
}

/// Flow per axis of a ball of exact swirls `φ e × r`, `φ = −(1 − r²)/10`: `∫ u_3·(e_2 × u_1) = −∫ φ² y² dV`.
#[test]
fn products_of_flows_converge_in_a_ball() {
    let flow = StokesFlow::new(&ball(6, &|x| x)).unwrap();
    let flows = flow.solve(&loads(&flow), 0.0).unwrap();
    let product = dot(&flows[2], &flow.turned(AXES[1], &flows[0]));
    // ∫ r⁴ (1 − r²)² dr = 1/5 − 2/7 + 1/9 = 8/315, times 4π/3 · 1/100.
    let exact = -8.0 / 315.0 * 4.0 * std::f64::consts::PI / 300.0;
    assert!((product / exact - 1.0).abs() < 3e-3, "{product} {exact}");
    let square = dot(&flows[0], &flow.mass_times(&flows[0]));
    assert!((square / (-2.0 * exact) - 1.0).abs() < 3e-3, "{square}");
}
