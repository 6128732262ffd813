//! Cantilever that rotates about its root: stiffening by its centrifugal tension.

use super::*;
use crate::math::quadrature::gauss_legendre;

const LENGTH: f64 = 1.7;

/// Frequencies over `√(EI/ρA)/L²` at this spin over the same unit, across the plane of the rotation and in it.
fn frequencies(count: usize, spin: f64, sharp: bool) -> [Vec<f64>; 2] {
    let section = thin(2e-4, 1e-5, 1e-5);
    let chain = Chain::even([[0.0; 3], [0.0, LENGTH, 0.0]], [1.0, 0.0, 0.0], section, ALLOY, count);
    let line = ALLOY.density * section.area;
    let unit = (ALLOY.young * section.second_z / line).sqrt() / LENGTH.powi(2);
    let places = DVector::from_fn(chain.size(), |i, _| if i % 6 == 1 { chain.nodes()[i / 6].y } else { 0.0 });
    let mass = chain.sum(Beam::mass);
    let u = chain.clamped(&(&mass * places));
    let load = |beam: &Beam| if sharp { beam.ends.map(|end| line * end) } else { [Vector3::zeros(); 2] };
    let geometric = chain.sum_by_place(|i, beam| beam.geometric_under(&own(&u, i), Load::of(load(beam))));
    let square = (spin * unit).powi(2);
    let stiff = chain.sum(Beam::stiffness) + square * geometric;
    let of = |place: usize, turn: usize, softer: f64| {
        let kept: Vec<usize> = (1..=count).flat_map(|node| [6 * node + place, 6 * node + turn]).collect();
        let mass = part(&mass, &kept);
        let (squares, _) = eigen(&(part(&stiff, &kept) - softer * &mass), &mass);
        squares.into_iter().map(|value| value.sqrt() / unit).collect()
    };
    // About the third axis of the body: the load −Ω² of the motion in the plane softens it.
    [of(2, 3, 0.0), of(0, 5, square)]
}

/// Frequencies across the plane by Ritz's method with the polynomials `x² P_k(2x − 1)`.
fn ritz(spin: f64) -> Vec<f64> {
    const SIZE: usize = 14;
    let mut matrices = [DMatrix::zeros(SIZE, SIZE), DMatrix::zeros(SIZE, SIZE)];
    for [node, weight] in gauss_legendre(24) {
        let (x, weight) = (0.5 * (1.0 + node), 0.5 * weight);
        let mut P = [[0.0; 3]; SIZE + 1];
        (P[0], P[1]) = ([1.0, 0.0, 0.0], [node, 1.0, 0.0]);
        for k in 1..SIZE {
            let n = k as f64;
            P[k + 1][0] = ((2.0 * n + 1.0) * node * P[k][0] - n * P[k - 1][0]) / (n + 1.0);
            for order in 1..3 {
                P[k + 1][order] = P[k - 1][order] + (2.0 * n + 1.0) * P[k][order - 1];
            }
        }
        let f = P.map(|[p, slope, bend]| {
            let (slope, bend) = (2.0 * slope, 4.0 * bend);
            [x * x * p, 2.0 * x * p + x * x * slope, 2.0 * p + 4.0 * x * slope + x * x * bend]
        });
        for i in 0..SIZE {
            for j in 0..SIZE {
                let tension = 0.5 * spin * spin * (1.0 - x * x);
                matrices[0][(i, j)] += weight * (f[i][2] * f[j][2] + tension * f[i][1] * f[j][1]);
                matrices[1][(i, j)] += weight * f[i][0] * f[j][0];
            }
        }
    }
    eigen(&matrices[0], &matrices[1]).0.into_iter().map(f64::sqrt).collect()
}

#[test]
fn a_turning_cantilever_has_the_published_frequencies() {
    let published = [
        (0.0, [3.5160, 22.0345, 61.6972], 3.5160),
        (1.0, [3.6816, 22.1810, 61.8418], 3.5432),
        (2.0, [4.1373, 22.6149, 62.2732], 3.6218),
        (3.0, [4.7973, 23.3203, 62.9850], 3.7435),
        (5.0, [6.4495, 25.4461, 65.2050], 4.0739),
        (10.0, [11.2023, 33.6404, 74.6493], 5.0490),
        (12.0, [13.1702, 37.6031, 79.6145], 5.4270),
    ];
    for (count, sharp, tolerance) in
        [(10, false, 3.1e-3), (10, true, 3e-4), (20, false, 8e-4), (20, true, 3e-5)]
    {
        let mut worst: [f64; 4] = [0.0; 4];
        for (spin, flap, lag) in published {
            let [across, along] = frequencies(count, spin, sharp);
            let found = [across[0], across[1], across[2], along[0]];
            let wanted = [flap[0], flap[1], flap[2], lag];
            for i in 0..4 {
                worst[i] = worst[i].max((found[i] / wanted[i] - 1.0).abs());
            }
        }
        assert!(worst.iter().all(|error| *error < tolerance), "{count} {sharp}: {worst:?}");
    }
}

#[test]
fn the_load_inside_the_elements_doubles_the_order_of_convergence() {
    for spin in [3.0, 12.0] {
        let exact = ritz(spin);
        for (sharp, order) in [(false, 2.0), (true, 4.0)] {
            let found = [8, 16, 32].map(|count| frequencies(count, spin, sharp)[0].clone());
            for mode in 0..3 {
                let errors = [0, 1, 2].map(|i| found[i][mode] / exact[mode] - 1.0);
                let orders = orders(&errors);
                // At slow spin the fourth power of the third mode still hides the second.
                assert!((orders[1] - order).abs() < 0.15 || (!sharp && spin < 10.0), "{errors:?} {orders:?}");
            }
        }
    }
}
