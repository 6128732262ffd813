//! Time to derive the reduced equations of ten sprung points (30 coordinates), and of more of them.
#![allow(missing_docs)]

use divan::Bencher;
use quasirigid::problems::ring_of_points;
use quasirigid::reduction::reduce;

fn main() {
    divan::main();
}

#[divan::bench(args = [1, 2, 3, 5, 7])]
fn ten_points_at_order(bencher: Bencher, order: usize) {
    let body = ring_of_points(10).body().expect("the ring has an equilibrium");
    bencher.bench(|| reduce(&body, order));
}

#[divan::bench(args = [10, 100, 1000, 10_000, 100_000], sample_count = 5)]
fn assembly_of_points(bencher: Bencher, count: usize) {
    let assembly = ring_of_points(count);
    bencher.bench(|| assembly.body());
}

#[divan::bench(args = [10, 100, 1000, 10_000, 100_000], sample_count = 5)]
fn points_at_order_three(bencher: Bencher, count: usize) {
    let body = ring_of_points(count).body().expect("the ring has an equilibrium");
    bencher.bench(|| reduce(&body, 3));
}
