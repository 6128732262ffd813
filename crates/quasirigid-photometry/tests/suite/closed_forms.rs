//! Spheres and ellipsoids, (O9) and (O15).

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use quasirigid_math::vec3::{dot, norm, unit};
use quasirigid_photometry::{Facets, Hapke, Scattering};

use crate::support::{V, at_phase, law};

const LAWS: [Scattering; 3] =
    [Scattering::LommelSeeliger, Scattering::Lambert, Scattering::Mixed { lambert: 0.1 }];

/// Spheres of odd sizes follow the closed phase functions, and at opposition have their cross-section. (O8), (O9)
#[test]
fn spheres_follow_their_phase_functions() {
    for radius in [1e-3, 1.0, 3e5] {
        let facets = Facets::of_ellipsoid([radius; 3], 5);
        for scattering in LAWS {
            for degrees in [0.0_f64, 1.0, 20.0, 75.0, 130.0, 165.0] {
                let alpha = degrees.to_radians();
                let [sun, observer] = at_phase(alpha);
                let found =
                    facets.brightness(&law(scattering, alpha), sun, observer) / (PI * radius * radius);
                let known = scattering.sphere(alpha);
                // facets of 1/40 of the radius cut the limb and the terminator
                assert!(
                    (found - known).abs() < 1e-3 * (known + 0.1),
                    "{scattering:?} {degrees}: {found} {known}"
                );
            }
        }
    }
}

/// The closed phase functions are integrals over latitude and longitude of the laws themselves.
#[test]
fn closed_phase_functions_are_integrals_over_the_sphere() {
    let steps = 400;
    for scattering in LAWS {
        for alpha in [1e-9_f64, 0.3, 1.2, 2.5] {
            let law = law(scattering, alpha);
            let mut sum = 0.0;
            for i in 0..steps {
                // longitude between terminator and limb, in the plane of Sun and observer
                let width = PI - alpha;
                let longitude = alpha - FRAC_PI_2 + width * (f64::from(i) + 0.5) / f64::from(steps);
                for k in 0..steps {
                    let latitude = PI * ((f64::from(k) + 0.5) / f64::from(steps) - 0.5);
                    let [e, i] = [longitude - alpha, longitude].map(|angle| angle.cos() * latitude.cos());
                    sum += law.light(e, i) * latitude.cos() * width * PI / f64::from(steps * steps);
                }
            }
            let known = PI * scattering.sphere(alpha);
            assert!((sum / known - 1.0).abs() < 1e-4, "{scattering:?} {alpha}: {sum} {known}");
        }
    }
}

/// Brightness of an ellipsoid by the law of Lommel and Seeliger in closed form: the sphere it is stretched from has an integral along the
/// parallels, and one over the lune that is lit and seen. (O15)
fn ellipsoid(semi_axes: V, sun: V, observer: V) -> f64 {
    let volume: f64 = semi_axes.iter().product();
    let [e0, e] = [sun, observer].map(|direction| [0, 1, 2].map(|axis| direction[axis] / semi_axes[axis]));
    let [S0, S] = [norm(e0), norm(e)];
    let angle = (dot(e0, e) / (S0 * S)).clamp(-1.0, 1.0).acos();
    let T = norm([0, 1, 2].map(|axis| e0[axis] + e[axis]));
    let place = (S * angle.sin()).atan2(S0 + S * angle.cos());
    let [from, to] = [angle - FRAC_PI_2 - place, FRAC_PI_2 - place];
    let delta = 2.0 * place - angle;
    let gudermann = |x: f64| (FRAC_PI_4 + 0.5 * x).tan().abs().ln();
    let smooth = delta.cos() * (to.sin() - from.sin()) + delta.sin() * (to.cos() - from.cos());
    let steep = angle.cos() - delta.cos();
    // at opposition the second part is zero times an infinity
    let second = if steep.abs() < 1e-14 { 0.0 } else { 0.5 * steep * (gudermann(to) - gudermann(from)) };
    volume * PI * S * S0 / T * (smooth + second)
}

#[test]
fn ellipsoids_have_their_closed_form_at_every_phase() {
    for semi_axes in [[2.3, 1.06, 0.93], [7e-4, 2e-3, 4e-4], [5e4, 5e4, 2e4]] {
        let facets = Facets::of_ellipsoid(semi_axes, 6);
        for degrees in [0.0_f64, 10.0, 60.0, 120.0] {
            let [sun, observer] = at_phase(degrees.to_radians());
            let found =
                facets.brightness(&law(Scattering::LommelSeeliger, degrees.to_radians()), sun, observer);
            let known = ellipsoid(semi_axes, sun, observer);
            assert!((found / known - 1.0).abs() < 2e-3, "{semi_axes:?} {degrees}: {found} {known}");
        }
        let [view, _] = at_phase(0.0);
        let area = PI
            * norm([0, 1, 2].map(|axis| semi_axes[(axis + 1) % 3] * semi_axes[(axis + 2) % 3] * view[axis]));
        assert!((ellipsoid(semi_axes, view, view) / area - 1.0).abs() < 1e-9);
    }
    // of a sphere the closed form is that of its phase function
    let [sun, observer] = at_phase(1.1);
    let known = PI * 9.0 * Scattering::LommelSeeliger.sphere(1.1);
    assert!((ellipsoid([3.0; 3], sun, observer) / known - 1.0).abs() < 1e-12);
}

/// The error falls as the square of the size of the facets: by four with each level.
#[test]
fn brightness_converges_with_the_facets() {
    let semi_axes = [2.3, 1.06, 0.93];
    let error = |level: usize| {
        let facets = Facets::of_ellipsoid(semi_axes, level);
        let directions = (0..12).map(|k| {
            let [sun, observer] = at_phase(0.1 + 0.1 * f64::from(k));
            let turn = |v: V| unit([v[0] + 0.3 * f64::from(k), v[1], v[2]]);
            [turn(sun), turn(observer)]
        });
        let off = directions.map(|[sun, observer]| {
            let alpha = dot(sun, observer).acos();
            let found = facets.brightness(&law(Scattering::LommelSeeliger, alpha), sun, observer);
            (found / ellipsoid(semi_axes, sun, observer) - 1.0).powi(2)
        });
        (off.sum::<f64>() / 12.0).sqrt()
    };
    let errors: Vec<f64> = (2..=5).map(error).collect();
    let order = (errors[0] / errors[3]).log2() / 3.0;
    assert!((1.6..3.0).contains(&order), "{order}: {errors:?}");
}

/// A smooth surface that scatters once and alike in all directions is one of Lommel and Seeliger: `w/8` of its brightness. (O12)
#[test]
fn hapke_of_single_scattering_is_lommel_seeliger() {
    let dark = Hapke { w: 1e-9, g: 0.0, B0: 0.0, h: 0.05, roughness: 0.0 };
    for (e, i, alpha) in [(0.9, 0.3, 0.7), (0.2, 0.5, 1.4), (0.6, 0.6, 0.0)] {
        let [hapke, single] =
            [Scattering::Hapke(dark), Scattering::LommelSeeliger].map(|of| law(of, alpha).light(e, i));
        assert!((hapke / single / (dark.w / 8.0) - 1.0).abs() < 1e-7, "{hapke} {single}");
    }
}
