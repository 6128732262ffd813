//! Elliptic functions and integrals against an independent library of any precision.

use quasirigid_math::elliptic::{
    complete_third_excess, first_of_complement, first_to, jacobi, third_excess_to,
};

const FUNCTIONS: &str = include_str!("../../../../data/published/elliptic/functions.csv");
const INTEGRALS: &str = include_str!("../../../../data/published/elliptic/integrals.csv");

fn rows(table: &str) -> impl Iterator<Item = Vec<f64>> {
    table.lines().skip(1).map(|line| line.split(',').map(|field| field.parse().unwrap()).collect())
}

/// Accuracy is 1e-14 up to `u = 24`, and beyond two roundings of `u` itself, down to `1 − k² = 1e-300`.
#[test]
fn functions_have_the_tabulated_values() {
    let mut worst = 0.0_f64;
    for row in rows(FUNCTIONS) {
        let [u, complement, ref expected @ ..] = row[..] else { panic!("five columns") };
        for (found, expected) in jacobi(u, complement).iter().zip(expected) {
            let error = (found - expected).abs() / u.abs().max(1.0);
            worst = worst.max(error);
            assert!(error < 4e-16, "u = {u}, 1 - m = {complement:e}: {found} {expected}");
        }
    }
    println!("{worst:e} of the larger of u and 1");
    assert!(rows(FUNCTIONS).count() == 108);
}

#[test]
fn integrals_have_the_tabulated_values() {
    for row in rows(INTEGRALS) {
        let [angle, complement, n, first, excess, complete, mean] = row[..] else { panic!("seven columns") };
        let close = |found: f64, expected: f64, tolerance: f64| {
            assert!(
                (found / expected - 1.0).abs() < tolerance,
                "angle {angle}, 1 - m = {complement:e}, n = {n}: {found:e} {expected:e}"
            );
        };
        close(first_of_complement(complement), complete, 1e-14);
        close(complete_third_excess(n, complement), mean, 1e-14);
        close(first_to(angle, complement), first, 1e-14 + 4e-16 * sensitivity(angle, complement));
        close(third_excess_to(first, n, complement), excess, 1e-13);
    }
    assert!(rows(INTEGRALS).count() == 144);
}

/// Relative change of `F` over that of the angle: large where the modulus is near 1 and the angle near a right one.
fn sensitivity(angle: f64, complement: f64) -> f64 {
    let cosine = angle.cos();
    let slope = (cosine * cosine + complement * angle.sin().powi(2)).sqrt().recip();
    slope * angle / first_to(angle, complement)
}
