//! Tests of flows in cavities of revolution: closed forms, symmetries and incompressibility.
//! Balls, cylinders and slender rings have exact tensors; the laws of the rest hold in every shape, on every patch layout.
//! Equations (L5), (L8) and (L9), docs/theory/13-inside.md.

use std::f64::consts::PI;

use super::*;
use crate::math::krylov::dot;

const AXES: [usize; 3] = [0, 1, 2];

/// Ratio `I₂(x)/I₁(x)` by the continued fraction of Bessel functions.
fn ratio(x: f64) -> f64 {
    (2..200).rev().fold(0.0, |tail, n| 1.0 / (2.0 * f64::from(n) / x + tail))
}

/// `∫r × u dV` about the axis of a cylinder under `e × r`, with a rate of inertia: the series of sines along the axis.
fn axial(radius: f64, height: f64, rate: f64) -> f64 {
    let term = |k: i32| {
        let n = f64::from(2 * k + 1);
        let x = radius * (rate + (n * PI / height).powi(2)).sqrt();
        32.0 * radius.powi(6) * height / (PI * (n * x).powi(2)) * (0.125 - 0.5 * ratio(x) / x)
    };
    // The terms far out are 4 a⁴H³/(π³ n⁴) at most; the rest of them is an integral.
    let last = 4000;
    (0..last).map(term).sum::<f64>() + term(last) * f64::from(2 * last + 1) / 6.0
}

/// Angular momentum `∫r × u dV` between concentric balls, for any axis: `u = f(r) e × r` with `f = −r²/10 + A + B/r³`.
fn between_balls(inner: f64, outer: f64) -> f64 {
    let moment = |power: i32| (outer.powi(power) - inner.powi(power)) / f64::from(power);
    let b = 0.1 * (outer * outer - inner * inner) / (outer.powi(-3) - inner.powi(-3));
    let a = 0.1 * outer * outer - b * outer.powi(-3);
    8.0 * PI / 3.0 * (-0.1 * moment(7) + a * moment(5) + b * moment(2))
}

fn fine(degree: usize, harmonics: usize) -> Fineness {
    Fineness { degree, layers: 1, harmonics }
}

fn answers(outline: &Outline, degree: usize, rate: f64) -> [f64; 3] {
    let flow = RevolvedFlow::new(outline, fine(degree, 1)).unwrap();
    let loads = AXES.map(|axis| flow.load(axis));
    let flows = flow.solve(&loads, rate).unwrap();
    AXES.map(|axis| dot(&loads[axis], &flows[axis]))
}

/// Cylinders from a disc to a long tube, slow and fast.
#[test]
fn cylinders_answer_as_the_series() {
    for (height, rate) in [(0.2, 0.0), (1.0, 0.0), (2.0, 0.0), (2.0, 4e3), (20.0, 0.0), (20.0, 300.0)] {
        let radius = 0.7;
        let outline = Outline::Cylinder { radius, height: radius * height };
        let exact = axial(radius, radius * height, rate);
        let gaps = [6, 8, 10].map(|degree| (answers(&outline, degree, rate)[2] / exact - 1.0).abs());
        assert!(
            gaps[1] < 0.1 * gaps[0] && gaps[2] < 0.2 * gaps[1] && gaps[2] < 1e-7,
            "{height} {rate}: {gaps:?}"
        );
    }
}

/// The flows about the axis and across it are of different harmonics.
#[test]
fn between_concentric_balls_all_axes_are_alike() {
    for (inner, outer) in [(0.5, 1.0), (0.05, 0.9), (0.97, 1.0)] {
        let exact = between_balls(inner, outer);
        let outline = Outline::Shell { across: [inner, outer], along: [inner, outer] };
        let answers = answers(&outline, 12, 0.0);
        let gaps = answers.map(|answer| (answer / exact - 1.0).abs());
        assert!(gaps.iter().all(|gap| *gap < 2e-8), "{gaps:?}");
    }
}

/// Ellipsoids of revolution, whose flow is a polynomial.
#[test]
fn spheroids_answer_as_the_closed_form() {
    let (a, c) = (0.8_f64, 0.5_f64);
    let volume = 4.0 / 3.0 * PI * a * a * c;
    let closed = |a: f64, b: f64, c: f64| {
        let [ab, c] = [a * a / (b * b), (a * a + b * b) / (c * c)];
        4.0 / 35.0 * volume * a * a * b * b / (2.0 + 3.0 * (ab + 1.0 / ab) + c)
    };
    let answers = answers(&Outline::Spheroid { across: a, along: c }, 10, 0.0);
    for (axis, exact) in [closed(a, c, a), closed(c, a, a), closed(a, a, c)].into_iter().enumerate() {
        assert!((answers[axis] / exact - 1.0).abs() < 1e-10, "{axis}: {} {exact}", answers[axis]);
    }
}

/// A slender ring is a pipe: `P = π²R³a⁴/4 (1 + O(a²/R²))`.
#[test]
fn a_slender_ring_is_a_pipe() {
    let gap = |tube_radius: f64| {
        let outline = Outline::Ring { radius: 1.0, tube_radius };
        answers(&outline, 8, 0.0)[2] / (0.25 * PI * PI * tube_radius.powi(4)) - 1.0
    };
    let [near, far] = [gap(0.02), gap(0.04)];
    assert!(near.abs() < 2e-3 && (far / near - 4.0).abs() < 0.02, "{near} {far}");
}

fn outlines() -> [Outline; 5] {
    [
        Outline::Cylinder { radius: 0.7, height: 1.1 },
        Outline::Annulus { radii: [0.3, 0.8], height: 0.4 },
        Outline::Ring { radius: 0.6, tube_radius: 0.25 },
        Outline::Shell { across: [0.3, 0.8], along: [0.5, 0.7] },
        Outline::Spheroid { across: 0.4, along: 0.9 },
    ]
}

/// Flows conserve the volume, to the degree of the pressure; the flow of a load is that of least action among them.
#[test]
fn flows_keep_their_volume_and_are_symmetric() {
    for outline in outlines() {
        let flow = RevolvedFlow::new(&outline, fine(6, 3)).unwrap();
        let loads = AXES.map(|axis| flow.load(axis));
        let slow = flow.solve(&loads, 0.0).unwrap();
        let turned: Vec<Vec<f64>> = AXES
            .iter()
            .flat_map(|axis| slow.iter().map(|u| flow.turned(*axis, u)).collect::<Vec<_>>())
            .collect();
        let next = flow.solve(&turned, 2.0).unwrap();
        for (a, u) in next.iter().enumerate() {
            for (b, v) in next.iter().enumerate() {
                let energy = dot(v, &flow.stiffness_times(u)) + 2.0 * dot(v, &flow.mass_times(u));
                let scale = (dot(&turned[a], u) * dot(&turned[b], v)).abs().sqrt();
                assert!((energy - dot(&turned[a], v)).abs() < 1e-10 * scale, "{outline:?} {a} {b}");
            }
        }
    }
}

/// Rotation takes no power: `u·(e × v) = −v·(e × u)`.
#[test]
fn turning_takes_no_power() {
    for outline in outlines() {
        let flow = RevolvedFlow::new(&outline, fine(5, 3)).unwrap();
        let loads = AXES.map(|axis| flow.load(axis));
        let slow = flow.solve(&loads, 0.0).unwrap();
        let along = |axis: usize, a: usize, b: usize| dot(&slow[a], &flow.turned(axis, &slow[b]));
        let scale = dot(&slow[0], &flow.mass_times(&slow[0]));
        for axis in AXES {
            for a in AXES {
                for b in AXES {
                    assert!((along(axis, a, b) + along(axis, b, a)).abs() < 1e-13 * scale);
                }
            }
        }
        assert!(
            [[0, 1, 2], [1, 2, 0], [2, 0, 1]]
                .iter()
                .all(|[axis, a, b]| along(*axis, *a, *b).abs() > 1e-3 * scale)
        );
    }
}

/// Between concentric balls no axis is singled out, whatever the harmonics.
#[test]
fn turning_between_concentric_balls_is_the_same_about_all_axes() {
    let flow =
        RevolvedFlow::new(&Outline::Shell { across: [0.4, 1.0], along: [0.4, 1.0] }, fine(10, 3)).unwrap();
    let loads = AXES.map(|axis| flow.load(axis));
    let slow = flow.solve(&loads, 0.0).unwrap();
    let along = |[axis, a, b]: [usize; 3]| dot(&slow[a], &flow.turned(axis, &slow[b]));
    let exact = along([2, 0, 1]);
    for cycle in [[0, 1, 2], [1, 2, 0]] {
        assert!((along(cycle) / exact - 1.0).abs() < 1e-8, "{} {exact}", along(cycle));
    }
    // ½ of the mass: ∫(e_l × r)×(e_m × r) is half of ∫|e × r|² along the third axis.
    let half = 0.5 * dot(&slow[0], &flow.mass_times(&slow[0]));
    assert!((exact.abs() / half - 1.0).abs() < 1e-8, "{exact} {half}");
    // Flows that the rotation drives about the first axis from the second, and so on round.
    let pairs = [[0, 1], [1, 2], [2, 0], [1, 0], [2, 1], [0, 2]];
    let turned: Vec<Vec<f64>> = pairs.iter().map(|[axis, of]| flow.turned(*axis, &slow[*of])).collect();
    let next = flow.solve(&turned, 0.0).unwrap();
    let work: Vec<f64> = turned.iter().zip(&next).map(|(load, u)| dot(load, u)).collect();
    assert!(work.iter().all(|own| (own / work[0] - 1.0).abs() < 1e-7), "{work:?}");
}
