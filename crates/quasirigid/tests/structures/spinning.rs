//! Vibrations of a beam that rotates with its hub: eigenvalues of the whole system about the steady spin.

use nalgebra::{DMatrix, DVector, Vector3};
use quasirigid::elements::{PartReduction, SectionShape};
use quasirigid::model::{FlexibleBody, MotionState};
use quasirigid_math::eigen::eigenvectors;

use super::beams::Cantilever;
use super::common::turned_axes;
use crate::support::linearised::linearised;
use crate::support::matrices::dense;
use crate::support::parts;

const LENGTH: f64 = 1.7;
/// Radius of gyration of the section over the length: rotary inertia and stretch by the spin are its square.
const THIN: f64 = 5e-4;

/// Ω, flap 1 to 3 and lag 1 over `√(EI/ρA)/L²` `[@wright1982]`.
const PUBLISHED: [(f64, [f64; 4]); 7] = [
    (0.0, [3.5160, 22.0345, 61.6972, 3.5160]),
    (1.0, [3.6816, 22.1810, 61.8418, 3.5432]),
    (2.0, [4.1373, 22.6149, 62.2732, 3.6218]),
    (3.0, [4.7973, 23.3203, 62.9850, 3.7435]),
    (5.0, [6.4495, 25.4461, 65.2050, 4.0739]),
    (10.0, [11.2023, 33.6404, 74.6493, 5.0490]),
    (12.0, [13.1702, 37.6031, 79.6145, 5.4270]),
];

fn blade() -> Cantilever {
    let area = 3e-4;
    let second = area * (THIN * LENGTH).powi(2);
    // Slightly stiffer in one plane, so that the two are not mixed when nothing rotates.
    let (second_y, second_z, torsion) = (second, second * (1.0 + 1e-5), second);
    let section = SectionShape::General { area, second_y, second_z, torsion, shear: None };
    let material = parts::elastic(2700.0, 70e9, 0.3);
    let reduction = PartReduction { order: 5, modes: 8 };
    Cantilever { length: LENGTH, elements: 20, section, material, hub: 4e6, reduction }
}

/// `√(EI/ρA)/L²`.
fn unit() -> f64 {
    (70e9_f64 / 2700.0).sqrt() * THIN / LENGTH
}

/// Share of the sizes within which the rates hardly curve, so that differences are exact to rounding.
pub const SHARE: f64 = 1e-3;

/// Steady state at a spin: the load is linear in the coordinates, and the springs balance it.
pub fn steady(body: &FlexibleBody, omega: [f64; 3]) -> Vec<f64> {
    let n = body.coordinates().len();
    let still = vec![0.0; n];
    let load = |q: &[f64]| DVector::from(body.load(MotionState { omega, q, rate: &still }));
    let constant = load(&still);
    let mut softer = DMatrix::zeros(n, n);
    for j in 0..n {
        let mut q = still.clone();
        q[j] = 1.0;
        softer.set_column(j, &(load(&q) - &constant));
    }
    let q = (dense(body.stiffness()) - softer).lu().solve(&constant).unwrap();
    let motion = MotionState { omega, q: q.as_slice(), rate: &still };
    [&body.angular_momentum(motion)[..], &body.generalized_momentum(motion), q.as_slice()].concat()
}

/// Squares of the frequencies over the unit, of vibrations whose tip moves along the spin, and across beam and spin.
fn squares(blade: &Cantilever, body: &FlexibleBody, spin: f64) -> [Vec<f64>; 2] {
    let n = body.coordinates().len();
    // Without any spin there is no steady angular momentum.
    let omega = (turned_axes() * (spin.max(1e-6) * unit() * Vector3::z())).into();
    let state = steady(body, omega);
    let A = body.mass_matrix();
    let momenta = (0..n).map(|j| 1e-2 * LENGTH * unit() * A.at(j, j));
    let sizes = [blade.hub * unit(); 3].into_iter().chain(momenta).chain(vec![1e-2 * LENGTH; n]);
    let matrix = linearised(body, &state, &sizes.collect::<Vec<f64>>(), SHARE);
    let (values, vectors) = eigenvectors(&matrix).unwrap();
    let mut found = [Vec::new(), Vec::new()];
    for ([re, im], vector) in values.iter().zip(&vectors) {
        let parts = [0, 1].map(|part| vector[3 + n..].iter().map(|entry| entry[part]).collect::<Vec<f64>>());
        let [real, imaginary] = parts.map(|q| blade.tip_shape(body, &q));
        let moved = Vector3::from_fn(|axis, _| real[axis].hypot(imaginary[axis]));
        let hub: f64 = vector[..3].iter().map(|[a, b]| a.hypot(*b)).sum();
        // The hub nods with a beam that leaves the axis; a beam vibrates on a hub at rest.
        if hub > 1e-2 * moved.amax() || moved[0] > moved[1].max(moved[2]) {
            continue;
        }
        let square = (im * im - re * re) / (unit() * unit());
        let family = &mut found[if moved[2] > moved[1] { 0 } else { 1 }];
        if *im >= 0.0 && (*im > 0.0 || *re > 0.0) {
            family.push(square);
        }
    }
    found.iter_mut().for_each(|family| family.sort_by(f64::total_cmp));
    found
}

/// Frequencies through the whole program: elements, Krylov space, curved paths by reciprocity, equations of motion.
#[test]
fn a_turning_beam_has_the_published_frequencies() {
    let blade = blade();
    let body = blade.assembly(Vec::new()).body().unwrap();
    println!("{} coordinates", body.coordinates().len());
    println!("  spin   flap 1    flap 2    flap 3    lag 1     largest error");
    for (spin, published) in PUBLISHED {
        let [flap, lag] = squares(&blade, &body, spin);
        let found = [flap[0], flap[1], flap[2], lag[0]].map(f64::sqrt);
        let errors = [0, 1, 2, 3].map(|i| (found[i] / published[i] - 1.0).abs());
        let worst = errors.into_iter().fold(0.0, f64::max);
        let [a, b, c, d] = found;
        println!("{spin:>6}  {a:8.4}  {b:8.4}  {c:8.4}  {d:8.4}   {worst:.1e}");
        // Twenty elements, and five digits in the table.
        assert!(worst < 5e-5, "spin {spin}: {found:?}, published {published:?}");
    }
}

/// Straight paths lose the work of the centrifugal load on the shortening. Their frequencies have a closed form: flap does not depend on
/// the spin, the square of lag falls by that of the spin, and beyond the lowest frequency the beam leaves its place.
#[test]
fn straight_paths_soften_where_the_beam_stiffens() {
    let blade = blade();
    let body = blade.straightened(&blade.assembly(Vec::new()).body().unwrap());
    let still = 3.5160_f64;
    for (spin, published) in PUBLISHED {
        let [flap, lag] = squares(&blade, &body, spin);
        let error = (lag[0] - (still * still - spin * spin)) / (still * still + spin * spin);
        println!("spin {spin:>4}: flap {:.4}, square of lag {:.4}", flap[0].sqrt(), lag[0]);
        assert!(
            (flap[0].sqrt() / still - 1.0).abs() < 2e-4 && error.abs() < 2e-4,
            "{spin}: {flap:?} {lag:?}"
        );
        assert!(spin < 2.0 || flap[0].sqrt() < 0.9 * published[0]);
        assert_eq!(lag[0] < 0.0, spin > still, "the beam leaves its place");
    }
}
