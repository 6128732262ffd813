//! Responses of liquids to changes of the spin at a frequency; flows of a cavity by two methods.

use std::f64::consts::PI;

use nalgebra::{Complex, Vector3};

use super::flowing::Flowing;
use super::liquid::{Liquid, Memory, Relaxations};
use super::meshed::MeshedFlow;
use super::revolved::MeridianFlow;
use super::shape::CavityShape;
use crate::flow::revolution::Fineness;
use crate::math::krylov::dot;
use quasirigid_mesh::meshing;

type C = Complex<f64>;

const AXES: [usize; 3] = [0, 1, 2];

fn relaxations(shape: &CavityShape, resolution: usize, memory: Memory) -> Relaxations {
    Flowing::new(shape, resolution, memory).unwrap().relaxations
}

/// Angular momentum about an axis that the liquid lacks relative to a frozen one, of unit density and viscosity, when the body rotates
/// about it with `e^{st}`.
fn lacking(relaxations: &Relaxations, axis: usize, s: C) -> C {
    let pairs = relaxations.momentum.iter().zip(&relaxations.friction);
    pairs.map(|(h, friction)| s * h[axis] * h[axis] / (s * relaxations.mass + friction)).sum()
}

/// `I_{n+1}(z)/I_n(z)` by the continued fraction of Bessel's functions, from so far out that the error of the tail, which is taken for that
/// of equal terms, is rounding.
fn ratio(n: f64, z: C) -> C {
    let last = 60 + (8.0 * z.norm().sqrt()) as i32;
    let term = |k: i32| 2.0 * (n + f64::from(k)) / z;
    let tail = 0.5 * ((term(last) * term(last) + 4.0).sqrt() - term(last));
    (1..last).rev().fold(tail, |tail, k| C::from(1.0) / (term(k) + tail))
}

/// Angular momentum that a ball, a slender ring or an endless cylinder lacks, by the index of its Bessel functions. (C11)
fn closed_form(index: f64, inertia: f64, radius: f64, s: C) -> C {
    let z = s.sqrt() * radius;
    inertia * ratio(index, z) * ratio(index + 1.0, z)
}

/// Angular momentum that a cylinder lacks about its axis: the series of sines along the axis.
fn cylinder(radius: f64, height: f64, s: C) -> C {
    let term = |k: i32| {
        let n = f64::from(2 * k + 1);
        let x = radius * (s + (n * PI / height).powi(2)).sqrt();
        32.0 * radius.powi(6) * height / (PI * n * n * x * x) * (0.125 - 0.5 * ratio(1.0, x) / x)
    };
    let last = 400 + 2 * (s.norm().sqrt() * height) as i32;
    s * (0..last).map(term).sum::<C>()
}

/// Largest relative error of the power, the imaginary part, at frequencies over the slowest rate of relaxation.
fn worst(found: &Relaxations, axis: usize, frequencies: &[f64], exact: impl Fn(C) -> C) -> f64 {
    let gap = |frequency: &f64| {
        let s = C::i() * frequency;
        (lacking(found, axis, s).im / exact(s).im - 1.0).abs()
    };
    frequencies.iter().map(gap).fold(0.0, f64::max)
}

/// With `n` rates the power is right to a tenth up to `5·8^{n−1}` times the slowest rate. (L11)
#[test]
fn answers_to_fast_changes_reach_as_far_as_their_rates() {
    let (a, tube, height) = (0.3, 0.01, 0.4);
    let ball = CavityShape::Ellipsoid { semi_axes: [a; 3] };
    let ring = CavityShape::Ring { radius: a, tube_radius: tube };
    let can = CavityShape::Cylinder { radius: a, height };
    let tall = CavityShape::Cylinder { radius: a, height: 200.0 * a };
    let frozen = 8.0 / 15.0 * PI * a.powi(5);
    let pipe = 2.0 * PI * PI * a.powi(3) * tube * tube;
    let endless = 0.5 * PI * a.powi(4) * 200.0 * a;
    for modes in [0, 1, 2, 4, 6] {
        let reach = |slowest: f64| {
            let most = if modes == 0 { 0.3 } else { 5.0 * 8.0_f64.powi(modes - 1) };
            [0.01, 0.1, 0.3, 1.0, 1.0 / 8.0, 1.0 / 64.0].map(|share| share * most * slowest)
        };
        // the boundary layers of six rates are thin; for the others the coarsest polynomials are enough
        let [by_ball, by_ring, by_can] = if modes == 6 { [8, 6, 7] } else { [4; 3] };
        let memory = Memory { depth: 1 + usize::from(modes == 0), modes: modes as usize };
        let kept = |shape: &CavityShape, resolution: usize| relaxations(shape, resolution, memory);
        let mut gaps = vec![
            worst(&kept(&ball, by_ball), 0, &reach(20.19 / (a * a)), |s| closed_form(1.5, frozen, a, s)),
            worst(&kept(&ring, by_ring), 2, &reach(5.783 / (tube * tube)), |s| {
                closed_form(0.0, pipe, tube, s)
            }),
            worst(&kept(&can, by_can), 2, &reach(14.68 / (a * a) + (PI / height).powi(2)), |s| {
                cylinder(a, height, s)
            }),
        ];
        if modes < 4 {
            let slowest = 14.68 / (a * a);
            gaps.push(worst(&kept(&tall, by_can), 2, &reach(slowest), |s| closed_form(1.0, endless, a, s)));
        }
        // The ends of the tall cylinder are half a percent of it.
        let most = if modes == 0 { 3e-3 } else { 0.1 };
        assert!(gaps.iter().all(|gap| *gap < most), "{modes}: {gaps:?}");
    }
}

/// Finite elements and polynomials of the meridian agree on a cylinder: angular momenta, inertia and rotation of the slow flows and of
/// those that they drive.
#[test]
fn two_roads_to_the_flows_of_a_cylinder() {
    let (radius, height) = (0.4, 0.7);
    let mesh = meshing::cylinder(radius, height, 8, 1.0).unwrap();
    let (outline, axis) = CavityShape::Cylinder { radius, height }.revolution().unwrap();
    let (cells, meridian) = (
        MeshedFlow::new(&mesh).unwrap(),
        MeridianFlow::new(&outline, axis, Fineness { degree: 8, layers: 1, harmonics: 2 }).unwrap(),
    );
    let [by_cells, by_meridian] = [products(&cells), products(&meridian)];
    for (place, (cells, meridian)) in by_cells.iter().zip(&by_meridian).enumerate() {
        let gap = (cells - meridian).amax() / meridian.amax();
        assert!(gap < 8e-3, "{place}: {gap}");
    }
}

/// `load·u`, `u·u` and `u_j·(e × u_k)` of the slow flows and of those that they drive.
fn products(liquid: &dyn Liquid) -> Vec<nalgebra::DMatrix<f64>> {
    let slow = liquid.slow().unwrap();
    let loads: Vec<Vec<f64>> =
        AXES.iter().flat_map(|axis| slow.iter().map(|u| liquid.turned(*axis, u))).collect();
    let driven = liquid.flows(&loads, 30.0).unwrap();
    let all = |from: &[Vec<f64>], image: &dyn Fn(&Vec<f64>) -> Vec<f64>| {
        let images: Vec<Vec<f64>> = from.iter().map(image).collect();
        nalgebra::DMatrix::from_fn(from.len(), from.len(), |j, k| dot(&from[j], &images[k]))
    };
    let mut products = vec![
        nalgebra::DMatrix::from_fn(3, 3, |j, k| dot(&liquid.load(j), &slow[k])),
        all(&slow, &|u| liquid.mass(u)),
        nalgebra::DMatrix::from_fn(9, 9, |j, k| dot(&loads[j], &driven[k])),
        all(&driven, &|u| liquid.mass(u)),
    ];
    products.extend(AXES.map(|axis| all(&slow, &|u| liquid.turned(axis, u))));
    products.extend(AXES.map(|axis| all(&driven, &|u| liquid.turned(axis, u))));
    products
}

/// Equivalent body and angular momenta behind a boundary layer of a shell of revolution about each of its axes.
#[test]
fn layers_may_lie_along_any_axis() {
    let found = |outer: [f64; 3], inner: [f64; 3]| {
        let flowing = layers(&CavityShape::Shell { outer, inner }, 0);
        let momenta = flowing.relaxations.momentum.iter().map(|h| h.component_mul(h)).sum::<Vector3<f64>>();
        (flowing.equivalent.unwrap().diagonal(), momenta, flowing.relaxations.slow_tensor().diagonal())
    };
    let [z, x, y] = [
        found([0.5, 0.5, 0.8], [0.2, 0.2, 0.6]),
        found([0.8, 0.5, 0.5], [0.6, 0.2, 0.2]),
        found([0.5, 0.8, 0.5], [0.2, 0.6, 0.2]),
    ];
    for (along, axis) in [(x, 0), (y, 1)] {
        let place = |own: usize| if own == axis { 2 } else { own % 2 };
        for (found, known) in [(along.0, z.0), (along.1, z.1), (along.2, z.2)] {
            for own in AXES {
                let gap = (found[own] - known[place(own)]).abs();
                assert!(gap < 1e-10 * known.amax(), "{axis} {own}: {found} {known}");
            }
        }
    }
    assert!(z.0.z.abs() < 1e-12 * z.0.x && z.1.x > 1.05 * z.1.z, "{} {}", z.0, z.1);
}

/// A shell of revolution about each of its axes.
#[test]
fn shells_of_revolution_may_lie_along_any_axis() {
    let memory = Memory { depth: 1, modes: 0 };
    let tensor = |outer: [f64; 3], inner: [f64; 3]| {
        relaxations(&CavityShape::Shell { outer, inner }, 8, memory).slow_tensor().diagonal()
    };
    let about_z = tensor([0.5, 0.5, 0.8], [0.2, 0.2, 0.6]);
    assert!((about_z.x / about_z.y - 1.0).abs() < 1e-10 && (about_z.z / about_z.x - 1.0).abs() > 0.1);
    assert!(
        (tensor([0.8, 0.5, 0.5], [0.6, 0.2, 0.2]) - Vector3::new(about_z.z, about_z.x, about_z.x)).amax()
            < 1e-12 * about_z.amax()
    );
    assert!(
        (tensor([0.5, 0.8, 0.5], [0.2, 0.6, 0.2]) - Vector3::new(about_z.x, about_z.z, about_z.x)).amax()
            < 1e-12 * about_z.amax()
    );
}

/// An ideal liquid behind its layers.
fn layers(shape: &CavityShape, modes: usize) -> Flowing {
    Flowing::layered(shape, 8, modes).unwrap()
}

/// Behind a boundary layer a liquid lacks the angular momentum of the exact response, but for the next power of its depth: a ball, a
/// cylinder about its axis. At rest it follows as a whole.
#[test]
fn a_boundary_layer_is_the_answer_at_high_frequency() {
    let (a, height) = (0.3, 0.8);
    let ball = layers(&CavityShape::Ellipsoid { semi_axes: [a; 3] }, 3);
    let can = layers(&CavityShape::Cylinder { radius: a, height }, 3);
    let frozen = 8.0 / 15.0 * PI * a.powi(5);
    let gaps = [1e3, 1.6e4, 2.56e5].map(|reynolds| {
        let s = C::i() * reynolds / (a * a);
        [
            (lacking(&ball.relaxations, 1, s).im / closed_form(1.5, frozen, a, s).im - 1.0).abs(),
            (lacking(&can.relaxations, 2, s).im / cylinder(a, height, s).im - 1.0).abs(),
        ]
    });
    for gap in 0..2 {
        assert!(gaps[0][gap] < 0.02 && gaps[2][gap] < 3e-3, "{gaps:?}");
    }
    let equivalent = ball.equivalent.unwrap();
    assert!(equivalent.amax() < 1e-14 * frozen, "{equivalent}");
    let whole: f64 = can.relaxations.momentum.iter().map(|h| h.z * h.z / can.relaxations.mass).sum();
    assert!((whole / (0.5 * PI * a.powi(4) * height) - 1.0).abs() < 1e-12, "{whole}");
}

/// Ellipsoids in closed form, by the meridian and by finite elements; the equivalent body of Zhukovsky.
#[test]
fn three_roads_to_an_ideal_liquid() {
    let semi_axes = [0.5, 0.5, 0.8];
    let exact = super::ideal::in_ellipsoid(semi_axes);
    let outline = CavityShape::Ellipsoid { semi_axes }.revolution().unwrap().0;
    let meridian = crate::flow::revolution::slip(&outline, 10).unwrap();
    let mesh = meshing::ellipsoid(semi_axes, 8, 1.0).unwrap();
    let (_, cells) = crate::flow::stokes::slip(&mesh).unwrap();
    for (found, most) in [(meridian, 1e-9), (cells, 3e-3)] {
        let turning = (0..3)
            .map(|axis| (found.turning[axis] - exact.turning[axis]).amax() / exact.turning[axis].amax());
        let gaps = [
            (found.volume - exact.volume).amax() / exact.volume.amax(),
            (found.surface - exact.surface).amax() / exact.surface.amax(),
            turning.fold(0.0, f64::max),
        ];
        assert!(gaps.iter().all(|gap| *gap < most), "{gaps:?}");
    }
    let equivalent = layers(&CavityShape::Ellipsoid { semi_axes: [0.9, 0.5, 0.7] }, 0).equivalent.unwrap();
    let closed = 4.0 / 15.0 * PI * 0.9 * 0.5 * 0.7 * (0.81_f64 - 0.25).powi(2) / (0.81 + 0.25);
    assert!((equivalent[(2, 2)] / closed - 1.0).abs() < 1e-12, "{equivalent} {closed}");
}

/// A box lacks its length times the torsion constant of Saint-Venant about an axis: the warping is the potential.
#[test]
fn a_box_of_ideal_liquid_twists() {
    let [a, b, c] = [0.6, 0.4, 0.5];
    let frozen = a * b * c * (a * a + b * b) / 12.0;
    let equivalent = layers(&CavityShape::Cuboid { sides: [a, b, c] }, 0).equivalent.unwrap();
    let series: f64 =
        (0..40).map(|k| f64::from(2 * k + 1)).map(|n| (0.5 * n * PI * a / b).tanh() / n.powi(5)).sum();
    let torsion = a * b.powi(3) * (1.0 / 3.0 - 64.0 * b / (PI.powi(5) * a) * series);
    let gap = (frozen - equivalent[(2, 2)]) / (c * torsion) - 1.0;
    assert!(gap.abs() < 1e-3, "{gap}");
}
