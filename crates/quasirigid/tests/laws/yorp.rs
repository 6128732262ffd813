//! Mean torque of sunlight: against closed means over the rotation of each facet, sums over rotation and orbit, and a lag of each facet. (F30)–(F32)

use std::f64::consts::{PI, TAU};

use nalgebra::Vector3;
use quasirigid::elements::SunlitShape;
use quasirigid::model::force::{MeanSunlight, SunlightLoads};

use super::sunlight::{elbow, tetrahedron};

type V = Vector3<f64>;

/// Without a lag.
const PROMPT: [f64; 2] = [1.0, 0.0];

/// Area, normal and middle of each face.
fn faces(center: V) -> Vec<(f64, V, V)> {
    let surface = tetrahedron(|r| r);
    let corner = |k: usize| V::from(surface.vertices()[k]);
    let face = |[a, b, c]: &[usize; 3]| {
        let (a, b, c) = (corner(*a), corner(*b), corner(*c));
        let area = (b - a).cross(&(c - a)) / 2.0;
        (area.norm(), area.normalize(), (a + b + c) / 3.0 - center)
    };
    surface.triangles().iter().map(face).collect()
}

/// Mean of `max(0, a + b cos φ)` over the angle.
fn clipped(a: f64, b: f64) -> f64 {
    if a >= b.abs() {
        a
    } else if a <= -b.abs() {
        0.0
    } else {
        (a * (-a / b.abs()).acos() + (b * b - a * a).sqrt()) / PI
    }
}

/// The recoil alone, facet by facet, each with its closed mean over the rotation about an axis. What comes in is left out.
fn recoil_along(axis: V, point: V, obliquity: f64) -> f64 {
    let steps = 720;
    let faces = faces(point);
    let sum: f64 = (0..steps)
        .map(|step| {
            let height = obliquity.sin() * (TAU * f64::from(step) / f64::from(steps)).sin();
            let of = |(area, normal, middle): &(f64, V, V)| {
                let up = normal.dot(&axis);
                let mean = clipped(up * height, ((1.0 - up * up) * (1.0 - height * height)).sqrt());
                -2.0 / 3.0 * area * mean * middle.cross(normal).dot(&axis)
            };
            faces.iter().map(of).sum::<f64>()
        })
        .sum();
    sum / f64::from(steps)
}

fn loads() -> SunlightLoads {
    SunlitShape::of_surface(&tetrahedron(|r| r), true).harmonics(1e-4).0
}

/// About an axis and a point of its own, at every obliquity: the harmonics against the means of the facets, and the second degree's law.
#[test]
fn the_torque_along_the_spin_is_that_of_the_recoil_of_each_facet() {
    let (axis, point) = (V::new(0.3, -0.5, 0.8).normalize(), V::new(0.4, 0.1, -0.2));
    let means = MeanSunlight::about(&loads(), point.into(), (2.0 * axis).into());
    let found: Vec<[f64; 2]> = (0..=12)
        .map(|k| {
            let obliquity = PI * f64::from(k) / 12.0;
            [means.torque(obliquity, PROMPT).spin, recoil_along(axis, point, obliquity)]
        })
        .collect();
    let most = found.iter().map(|[_, known]| known.abs()).fold(0.0, f64::max);
    assert!(found.iter().all(|[found, known]| (found - known).abs() < 4e-3 * most), "{found:?}");
    assert!(found.iter().zip(found.iter().rev()).all(|([one, _], [other, _])| (one - other).abs() < 1e-12));
    // against another axis the spin turns the other way
    let other = MeanSunlight::about(&loads(), point.into(), (-axis).into());
    assert!((other.torque(0.7, PROMPT).spin + means.torque(0.7, PROMPT).spin).abs() < 1e-12);
}

/// Sums over rotation and orbit of the torque in plain vectors, with the heat of each facet behind by the same response, about an axis and a point.
#[test]
fn the_torque_across_the_spin_is_that_of_rotation_and_orbit() {
    let (axis, point) = (V::new(-0.2, 0.9, 0.3).normalize(), V::new(0.4, 0.1, -0.2));
    let loads = loads();
    let means = MeanSunlight::about(&loads, point.into(), axis.into());
    let [x, y] = [axis.cross(&V::x()).normalize(), axis.cross(&axis.cross(&V::x())).normalize()];
    assert!((x.cross(&y) - axis).norm() < 1e-14);
    for obliquity in [0.4_f64, 1.2, 2.5] {
        let normal = obliquity.cos() * axis - obliquity.sin() * x;
        let (steps, turns) = (120, 240);
        let mut plain = V::zeros();
        // of each facet cosine and sine of the first harmonic in the hour angle, and the mean
        let mut lagging = V::zeros();
        let (size, lag) = (0.6_f64, 0.5_f64);
        for step in 0..steps {
            let (sin, cos) = (TAU * f64::from(step) / f64::from(steps)).sin_cos();
            let sun = cos * y + sin * normal.cross(&y);
            let at = |turn: u32| {
                nalgebra::Rotation3::from_axis_angle(
                    &nalgebra::Unit::new_unchecked(axis),
                    TAU * f64::from(turn) / f64::from(turns),
                )
            };
            for turn in 0..turns {
                let torque = V::from(loads.about(point.into(), (at(turn).inverse() * sun).into())[1]);
                plain += at(turn) * torque / f64::from(steps * turns);
            }
            for (area, facing, middle) in faces(point) {
                let light: Vec<f64> = (0..turns).map(|turn| (at(turn) * facing).dot(&sun).max(0.0)).collect();
                let harmonic = |of: fn(f64) -> f64| -> f64 {
                    light
                        .iter()
                        .enumerate()
                        .map(|(turn, light)| 2.0 * light * of(TAU * turn as f64 / f64::from(turns)))
                        .sum::<f64>()
                        / f64::from(turns)
                };
                let (c, s) = (harmonic(f64::cos), harmonic(f64::sin));
                for turn in 0..turns {
                    let angle = TAU * f64::from(turn) / f64::from(turns) - lag;
                    let heat = size * (c * angle.cos() + s * angle.sin());
                    lagging -= at(turn)
                        * middle.cross(&facing)
                        * (2.0 / 3.0 * area * heat / f64::from(steps * turns));
                }
            }
        }
        let away = (axis * obliquity.cos() - normal) / obliquity.sin();
        let found = means.torque(obliquity, PROMPT);
        assert!(
            (found.spin - plain.dot(&axis)).abs() < 1e-12
                && (found.obliquity - plain.dot(&away)).abs() < 1e-12,
            "{found:?} {plain}"
        );
        let behind = means.torque(obliquity, [size * lag.cos(), size * lag.sin()]);
        println!(
            "{obliquity}: {} without a lag, {} with it, {}",
            found.obliquity,
            behind.obliquity,
            lagging.dot(&away)
        );
        assert!((behind.obliquity - lagging.dot(&away)).abs() < 2e-4, "{behind:?} {}", lagging.dot(&away));
        assert_eq!(behind.spin, found.spin);
    }
}

/// Breiter et al. (2007), abstract: without thermal inertia the mean torques on a spheroid vanish; a lag drives the obliquity and leaves the spin.
/// The numbers are those of another program, which sums 320 facets of a sphere that is stretched, each with its own Fourier series.
#[test]
fn a_lag_drives_the_obliquity_of_spheroids_alone() {
    let behind = [0.6 * 0.5_f64.cos(), 0.6 * 0.5_f64.sin()];
    for (semi_axes, known) in [
        ([1.0, 1.0, 0.7], [-0.017538, -0.015685, 0.015685]),
        ([0.8, 0.8, 1.2], [0.016844, 0.018961, -0.018961]),
    ] {
        let (loads, _) = SunlitShape::of_ellipsoid(semi_axes, [0.0; 3]).harmonics(0.001);
        let means = MeanSunlight::about(&loads, [0.0; 3], [0.0, 0.0, 1.0]);
        for (degrees, known) in [30.0_f64, 60.0, 120.0].into_iter().zip(known) {
            let [bare, warm] = [PROMPT, behind].map(|response| means.torque(degrees.to_radians(), response));
            assert!(
                bare.spin.abs() < 1e-12 && bare.obliquity.abs() < 1e-12 && warm.spin.abs() < 1e-12,
                "{bare:?} {warm:?}"
            );
            println!("{semi_axes:?} {degrees}: {} and {known}", warm.obliquity);
            // the coarse facets of the other program
            assert!((warm.obliquity / known - 1.0).abs() < 0.06, "{} {known}", warm.obliquity);
        }
    }
}

/// Ellipsoids have an axis of two-fold symmetry across the spin, the L a plane of symmetry through its diagonal; both lose the torque along it.
#[test]
fn symmetric_bodies_keep_their_spin() {
    let (ellipsoid, _) = SunlitShape::of_ellipsoid([2.0, 1.4, 0.9], [0.3, 0.2, 0.1]).harmonics(0.01);
    for axis in [V::x(), V::y(), V::z()] {
        let means = MeanSunlight::about(&ellipsoid, [0.3, 0.2, 0.1], axis.into());
        for k in 0..=6 {
            assert!(means.torque(PI * f64::from(k) / 6.0, PROMPT).spin.abs() < 1e-12, "{axis} {k}");
        }
    }
    let (elbow, accuracy) = SunlitShape::of_surface(&elbow(), true).harmonics(0.02);
    let center = [5.0 / 6.0, 5.0 / 6.0, 0.5];
    for axis in [V::new(1.0, 1.0, 0.0), V::z()] {
        let means = MeanSunlight::about(&elbow, center, axis.into());
        for k in 0..=6 {
            let torque = means.torque(PI * f64::from(k) / 6.0, PROMPT).spin;
            assert!(torque.abs() < 5e-3 * accuracy.torque, "{axis} {k} {torque} {accuracy:?}");
        }
    }
}
