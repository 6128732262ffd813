//! Order of the reduced equations about a spin in the amplitude of the nutation, measured against the full system. (W3)

use std::ops::ControlFlow;

use quasirigid::dynamics::{Forced, Options, Sample, propagate_full};
use quasirigid::elements::Assembly;
use quasirigid::model::{Mode, Principal};
use quasirigid::submanifold::{
    ManifoldStart, Masters, SpinManifold, SpinManifoldPlan, Style, propagate_on_manifold,
};
use quasirigid_math::vec3::{add, norm, scale};

use super::bodies;

/// Angular momentum (N·m·s), with that of the wheels, of a spin (rad/s) about the axis of greatest inertia.
fn angular_momentum(assembly: &Assembly, spin: f64) -> f64 {
    let body = assembly.body().unwrap();
    let Principal { moments, axes } = Principal::compute(body.invariants().J);
    norm(add(scale(spin * moments[2], axes[2]), body.wheels().constant))
}

/// Differences in angular velocity, relative to the spin, and in attitude, between the reduced and the full motion after a time, for an
/// amplitude.
fn difference(manifold: &SpinManifold, amplitude: f64, duration: f64) -> [f64; 2] {
    let mut z = vec![[0.0; 2]; manifold.expansion().free()];
    let rest = 0.3 * amplitude;
    z.fill([rest, 0.2 * rest]);
    z[0] = [amplitude * 0.4_f64.cos(), amplitude * 0.4_f64.sin()];
    for (z, lead) in z.iter_mut().zip(manifold.masters.iter()) {
        if lead.frequency == 0.0 {
            z[1] = 0.0;
        }
    }
    let attitude = quasirigid_math::rotation::turned([1.0, 0.0, 0.0, 0.0], [0.3, -0.2, 0.4]);
    let state = manifold.full_state(&z, attitude);
    let start = ManifoldStart { z, attitude, place: [0.0; 3], velocity: [0.0; 3], left_out: 0.0 };
    let options = Options { tolerance: 1e-13, ..Options::default() };
    let times = [0.0, duration];
    let (mut full, mut reduced): (Vec<Sample>, Vec<Sample>) = Default::default();
    propagate_full(Forced::not(manifold.body), &state, &times, &options, &mut full).unwrap();
    propagate_on_manifold(manifold, &start, &times, &options, &mut reduced).unwrap();
    let gap = norm(add(full[1].omega, scale(-1.0, reduced[1].omega))) / manifold.rate();
    let turned = quasirigid_math::rotation::angle_between(full[1].attitude, reduced[1].attitude);
    [gap, turned]
}

/// Slopes in the amplitude of both differences over two halvings, for degrees 1 to 4.
fn slopes(assembly: &Assembly, spin: f64, masters: &Masters, style: Style, amplitude: f64) -> Vec<[f64; 2]> {
    let body = assembly.body().unwrap();
    let angular_momentum = angular_momentum(assembly, spin);
    (1..=4)
        .map(|degree| {
            let plan = SpinManifoldPlan {
                mode: Mode::ShortAxis,
                angular_momentum,
                masters: masters.clone(),
                degree,
                style,
            };
            let manifold = SpinManifold::derive(&body, &plan, &mut |_| ControlFlow::Continue(())).unwrap();
            let duration = 6.0 / manifold.masters[0].frequency;
            let gaps: Vec<[f64; 2]> = [1.0, 0.5, 0.25]
                .iter()
                .map(|share| difference(&manifold, amplitude * share, duration))
                .collect();
            let slope = |i: usize| (gaps[1][i] / gaps[2][i]).log2();
            println!(
                "spin {spin} degree {degree} {:?} {gaps:?} {:.2} {:.2}",
                manifold.masters,
                slope(0),
                slope(1)
            );
            [slope(0), slope(1)]
        })
        .collect()
}

/// Shortfall of a measured slope.
const SHORT: f64 = 0.35;

fn falls(slopes: &[[f64; 2]]) {
    for (i, [omega, attitude]) in slopes.iter().enumerate() {
        let expected = (i + 2) as f64;
        assert!(*omega > expected - SHORT && *attitude > expected - SHORT, "degree {}: {slopes:?}", i + 1);
    }
}

#[test]
fn two_masses_at_any_spin() {
    for spin in [0.5, 2.0, 5.0, 40.0] {
        falls(&slopes(&bodies::two_masses(), spin, &Masters::Nutation, Style::NormalForm, 0.08));
    }
}

#[test]
fn in_graph_style() {
    falls(&slopes(&bodies::two_masses(), 5.0, &Masters::Nutation, Style::Graph, 0.08));
}

#[test]
fn with_a_second_pair() {
    falls(&slopes(&bodies::two_masses(), 2.0, &Masters::With(vec![5.0]), Style::NormalForm, 0.08));
}

#[test]
fn along_curved_paths() {
    for spin in [0.5, 5.0, 40.0] {
        falls(&slopes(&bodies::hinged(), spin, &Masters::Nutation, Style::NormalForm, 0.08));
    }
}

#[test]
fn with_rotors_and_a_wheel() {
    for spin in [0.5, 5.0] {
        falls(&slopes(&bodies::rotors(), spin, &Masters::Nutation, Style::NormalForm, 0.08));
    }
}

#[test]
fn with_a_liquid() {
    falls(&slopes(&bodies::liquid(), 2.0, &Masters::Nutation, Style::NormalForm, 0.08));
}

#[test]
fn with_everything_together() {
    falls(&slopes(&bodies::everything(), 3.0, &Masters::Nutation, Style::NormalForm, 0.08));
}
