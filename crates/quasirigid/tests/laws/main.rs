//! Laws that hold for every body: random carriers, points, springs and hinges, in random units.
//!
//! `PROPTEST_CASES` and `PROPTEST_RNG_SEED` widen the search; without them every run tries the same bodies.
#![allow(non_snake_case, clippy::unwrap_used)]

mod compare;
mod ray;
mod support;
mod transform;

mod axes_and_units;
mod cutting;
mod degrees;
mod invariants;
mod lagrangian;
mod momentum_form;
mod orders;
