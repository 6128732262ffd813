//! Moments of closed surfaces: closed forms, and invariances.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use proptest::array::uniform3;
use proptest::collection::vec;
use proptest::prelude::*;
use quasirigid_math::polynomial::monomial::exponents;
use quasirigid_mesh::surface::Moments;

use super::cases;
use super::shapes::{
    Mesh, block, both, closed, det, icosphere, inside_out, mapped, split_in_four, star, tetrahedron,
};

fn all(degree: usize) -> impl Iterator<Item = [usize; 3]> {
    (0..=degree).flat_map(exponents)
}

/// Largest difference of two sets of moments, relative to those of `sizes`: even ones, which are integrals of `|x^i y^j z^k|`.
fn difference(a: &Moments, b: &Moments, degree: usize) -> f64 {
    // ∫|x^a y^b z^c| is at least of the order of the geometric mean of its even neighbours.
    let size = |m: [usize; 3]| {
        let low = m.map(|n| n / 2 * 2);
        let high = m.map(|n| n.div_ceil(2) * 2);
        if high.iter().sum::<usize>() > degree { a.of(low) } else { (a.of(low) * a.of(high)).sqrt() }
    };
    all(degree).map(|m| (a.of(m) - b.of(m)).abs() / size(m)).fold(0.0, f64::max)
}

fn binomial(n: usize, k: usize) -> f64 {
    (0..k).map(|i| (n - i) as f64 / (i + 1) as f64).product()
}

fn factorial(n: usize) -> f64 {
    (1..=n).map(|k| k as f64).product()
}

/// `∫ ξ^i` over an interval is `(b^{i+1} − a^{i+1})/(i+1)`; of its absolute value, the same from the origin both ways.
#[test]
fn moments_of_a_box_are_those_of_its_sides() {
    let sides = [[-0.3, 0.2, -4.0], [0.9, 1.1, 7.0]];
    let (origin, scale) = ([0.1, -0.2, 0.5], [0.5, 0.9, 6.0]);
    let moments = closed(&block(sides)).moments(8, origin, scale);
    for m in all(8) {
        let side = |axis: usize| {
            let end = |side: usize| (sides[side][axis] - origin[axis]) / scale[axis];
            let power = |x: f64| x.powi(m[axis] as i32 + 1) / (m[axis] + 1) as f64;
            let size = |x: f64| power(x.abs()) * x.signum();
            [power(end(1)) - power(end(0)), size(end(1)) - size(end(0))]
        };
        let [exact, size] = [0, 1].map(|n| (0..3).map(|axis| side(axis)[n]).product::<f64>());
        assert!((moments.of(m) - exact).abs() <= 1e-14 * size, "{m:?}: {:e} {exact:e}", moments.of(m));
    }
}

/// In barycentric coordinates `∫ λ^α dV = 6V α!/(|α|+3)!`; a monomial is a product of sums `Σ λ_n x_n`.
#[test]
fn moments_of_a_tetrahedron_are_those_in_barycentric_coordinates() {
    let corners = [[0.1, 0.2, -0.3], [1.3, -0.2, 0.1], [0.3, 1.7, 0.4], [-0.4, 0.2, 2.1]];
    let (origin, scale) = ([0.2, 0.1, 0.4], [0.8, 1.1, 1.4]);
    let moments = closed(&tetrahedron(corners)).moments(8, origin, scale);
    let [a, b, c, d] = corners.map(|corner| std::array::from_fn(|i| (corner[i] - origin[i]) / scale[i]));
    let minus = |p: [f64; 3]| std::array::from_fn(|i| p[i] - a[i]);
    let six_volumes = det(minus(b), minus(c), minus(d));
    let integral = |m: [usize; 3], of: fn(f64) -> f64| -> f64 {
        let mut polynomial = BTreeMap::from([([0usize; 4], 1.0)]);
        for axis in [0, 1, 2].into_iter().flat_map(|axis| std::iter::repeat_n(axis, m[axis])) {
            let mut product = BTreeMap::new();
            for (alpha, factor) in polynomial {
                for (n, corner) in [a, b, c, d].into_iter().enumerate() {
                    let mut alpha: [usize; 4] = alpha;
                    alpha[n] += 1;
                    *product.entry(alpha).or_insert(0.0) += factor * of(corner[axis]);
                }
            }
            polynomial = product;
        }
        let term = |(alpha, factor): ([usize; 4], f64)| {
            let (all, each) =
                (alpha.iter().sum::<usize>(), alpha.into_iter().map(factorial).product::<f64>());
            factor * each / factorial(all + 3)
        };
        six_volumes * polynomial.into_iter().map(term).sum::<f64>()
    };
    for m in all(8) {
        let (exact, size) = (integral(m, |x| x), integral(m, f64::abs));
        assert!((moments.of(m) - exact).abs() <= 1e-14 * size, "{m:?}: {:e} {exact:e}", moments.of(m));
    }
}

/// Inscribed spheres lack a layer of thickness h²; moments of the ball are
/// `4π (i−1)!!(j−1)!!(k−1)!! / ((d+1)!! (d+3))`, and zero where an exponent is odd.
#[test]
fn a_refined_sphere_becomes_a_ball_with_order_two() {
    let spheres = [2, 3, 4].map(|splits| closed(&icosphere(splits)).moments(12, [0.0; 3], [1.0; 3]));
    let double = |n: usize| (1..n).step_by(2).map(|k| k as f64).product::<f64>(); // (n−1)!!, n even
    for m in all(12) {
        let found = spheres.each_ref().map(|moments| moments.of(m));
        if m.iter().any(|n| n % 2 == 1) {
            assert!(found.iter().all(|x| x.abs() < 1e-15), "{m:?}: {found:?}");
            continue;
        }
        let degree: usize = m.iter().sum();
        let exact =
            4.0 * PI * m.map(double).iter().product::<f64>() / (double(degree + 2) * (degree + 3) as f64);
        let errors = found.map(|x| exact - x);
        for [coarse, fine] in [[errors[0], errors[1]], [errors[1], errors[2]]] {
            assert!((3.4..4.1).contains(&(coarse / fine)), "{m:?}: {errors:?} of {exact}");
        }
        assert!(errors[2] / exact < 0.03, "{m:?}: {errors:?} of {exact}");
    }
}

proptest! {
    #![proptest_config(cases(24))]

    /// Moments about one origin follow from those about another by the binomial theorem.
    #[test]
    fn moments_about_another_origin_follow_by_shifting(mesh in star(1), from in uniform3(-0.4..0.4), to in uniform3(-0.4..0.4)) {
        let surface = closed(&mesh);
        let [a, b] = [from, to].map(|origin| surface.moments(10, origin, [1.0; 3]));
        let shift: [f64; 3] = std::array::from_fn(|i| from[i] - to[i]);
        for [i, j, k] in all(10) {
            let (mut sum, mut size) = (0.0, 0.0);
            for [p, q, r] in all(i + j + k).filter(|[p, q, r]| *p <= i && *q <= j && *r <= k) {
                let power = |axis: usize, n: usize| shift[axis].powi(n as i32);
                let chosen = binomial(i, p) * binomial(j, q) * binomial(k, r);
                let term = chosen * a.of([p, q, r]) * power(0, i - p) * power(1, j - q) * power(2, k - r);
                sum += term;
                size += term.abs();
            }
            let scale = size.max(b.of([0, 0, 0]) * 0.5f64.powi((i + j + k) as i32));
            prop_assert!((b.of([i, j, k]) - sum).abs() <= 1e-13 * scale, "{:?}", [i, j, k]);
        }
    }

    /// The order of corners and triangles and vertices of no triangle do not matter; nor do triangles split in four.
    #[test]
    fn the_body_matters_and_not_its_triangles(mesh in star(1), turns in vec(0..3usize, 80), start in 0..80usize) {
        let (vertices, triangles) = mesh.clone();
        let mut turned: Vec<[usize; 3]> = triangles
            .iter()
            .zip(&turns)
            .map(|(corners, turn)| std::array::from_fn(|i| vertices.len() - corners[(i + turn) % 3]))
            .collect();
        turned.rotate_left(start);
        let mut renumbered = vec![[7.0, 8.0, 9.0]];
        renumbered.extend(vertices.iter().rev());
        let frame = ([0.1, -0.1, 0.05], [0.9, 1.0, 1.1]);
        let surface = closed(&mesh);
        let expected = surface.moments(12, frame.0, frame.1);
        let other = closed(&(renumbered, turned));
        prop_assert_eq!(surface.bounds(), other.bounds());
        prop_assert_eq!((surface.edges().count(), other.edges().count()), (120, 120));
        for other in [other, closed(&split_in_four(&mesh)), closed(&split_in_four(&split_in_four(&mesh)))] {
            let found = other.moments(12, frame.0, frame.1);
            prop_assert!(difference(&expected, &found, 12) < 1e-13, "{}", difference(&expected, &found, 12));
        }
    }

    /// A cavity takes its moments away, bodies side by side add theirs.
    #[test]
    fn shells_add(outer in star(1), inner in star(0), place in uniform3(-0.05..0.05)) {
        let inner = mapped(&inner, |x| std::array::from_fn(|i| 0.2 * x[i] + place[i]));
        let beside = mapped(&inner, |[x, y, z]| [x, y, z + 2.0]);
        let of = |mesh: &Mesh| closed(mesh).moments(6, [0.1, 0.0, 0.2], [1.0; 3]);
        let hollow = of(&both(both(outer.clone(), beside.clone()), inside_out(inner.clone())));
        let parts = [outer, beside, inner].map(|mesh| of(&mesh));
        for m in all(6) {
            let [outer, beside, inner] = parts.each_ref().map(|moments| moments.of(m));
            let size = 2f64.powi(m.iter().sum::<usize>() as i32);
            prop_assert!((hollow.of(m) - (outer + beside - inner)).abs() < 1e-14 * size, "{m:?}");
        }
    }

    /// Moments do not depend on the unit of length, nor on the origin of the file's axes.
    #[test]
    fn moments_do_not_know_units(mesh in star(1), unit in -9..=9i32, shift in uniform3(-3.0..3.0)) {
        let unit = 10f64.powi(unit);
        let place = |x: [f64; 3]| -> [f64; 3] { std::array::from_fn(|i| unit * (x[i] + shift[i])) };
        let other = closed(&mapped(&mesh, place));
        let here = closed(&mesh);
        let expected = here.moments(16, here.centroid(), [0.8; 3]);
        let found = other.moments(16, other.centroid(), [0.8 * unit; 3]);
        prop_assert!(difference(&expected, &found, 16) < 1e-13, "{}", difference(&expected, &found, 16));
        prop_assert!((other.volume() / unit.powi(3) / here.volume() - 1.0).abs() < 1e-13);
        for (found, expected) in other.centroid().into_iter().zip(place(here.centroid())) {
            prop_assert!((found - expected).abs() < 1e-14 * unit);
        }
    }
}
