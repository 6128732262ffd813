//! Laws that hold of every surface: turning, units, reciprocity, and refusals.

use quasirigid_math::vec3::scale;
use quasirigid_mesh::surface::ClosedSurface;
use quasirigid_photometry::{Facets, Hapke, Law, Phase, PhotometryError, Scattering, albedo, magnitude};

use crate::support::{V, at_phase, boxes, law, turned};

const HAPKE: Hapke = Hapke { w: 0.23, g: -0.27, B0: 1.6, h: 0.08, roughness: 0.35 };
const LAWS: [Scattering; 4] = [
    Scattering::LommelSeeliger,
    Scattering::Lambert,
    Scattering::Mixed { lambert: 0.4 },
    Scattering::Hapke(HAPKE),
];

/// Two boxes that throw shadows on each other.
fn pair(place: impl Fn(V) -> V) -> ClosedSurface {
    boxes(&[[[-2.0, -1.0, -0.5], [-0.5, 1.2, 0.4]], [[0.3, -0.7, -1.5], [0.9, 0.8, 1.7]]], place)
}

#[test]
fn brightness_turns_with_the_body_and_scales_as_an_area() {
    let [sun, observer] = at_phase(0.9);
    for scattering in LAWS {
        let law = law(scattering, 0.9);
        let own = pair(|corner| corner);
        let known = Facets::of_surface(&own).refined(&own, 2).brightness(&law, sun, observer);
        assert!(known > 0.1);
        for unit in [1e-9, 1.0, 1e9] {
            let surface = pair(|corner| scale(unit, turned(corner)));
            let facets = Facets::of_surface(&surface).refined(&surface, 2);
            let found = facets.brightness(&law, turned(sun), turned(observer)) / (unit * unit);
            assert!((found / known - 1.0).abs() < 1e-11, "{scattering:?} {unit}: {found} {known}");
        }
    }
}

/// Helmholtz: Sun and observer may change places, with shadows and rough surfaces too.
#[test]
fn sun_and_observer_may_change_places() {
    let surface = pair(turned);
    let facets = Facets::of_surface(&surface).refined(&surface, 1);
    for scattering in LAWS {
        for alpha in [0.05, 0.9, 2.2] {
            let ([sun, observer], law) = (at_phase(alpha), law(scattering, alpha));
            let [there, back] =
                [facets.brightness(&law, sun, observer), facets.brightness(&law, observer, sun)];
            assert!(there > 0.0 && (there / back - 1.0).abs() < 1e-12, "{scattering:?}: {there} {back}");
        }
    }
}

/// A rough surface is continuous where the directions change roles, darker than a smooth one away from opposition, and tends to it. (O13)
#[test]
fn roughness_darkens_and_vanishes() {
    let of = |roughness: f64| law(Scattering::Hapke(Hapke { roughness, ..HAPKE }), 1.2);
    let [smooth, rough] = [of(0.0), of(0.5)];
    assert!(rough.light(0.5, 0.4) < 0.9 * smooth.light(0.5, 0.4));
    let nearly = of(1e-6).light(0.5, 0.4) / smooth.light(0.5, 0.4);
    assert!((nearly - 1.0).abs() < 1e-5, "{nearly}");
    let [below, above] = [-1e-9, 1e-9].map(|step| rough.light(0.45, 0.45 + step));
    assert!((below / above - 1.0).abs() < 1e-7);
}

/// Values of the same formulas written out case by case, in double precision: the effective cosines and the shadows of `hapke.f90` in xitau (M. Brož,
/// after Hapke 1984, commit 08a136ed) without its factor `µ'/µ`, which reciprocity forbids, and `H` as in (O12). (O13)
#[test]
fn rough_surfaces_have_the_light_of_another_program() {
    let known = [
        (0.9, 0.3, 1.1, 1.815605591024e-2),
        (0.3, 0.9, 1.1, 1.815605591024e-2),
        (0.25, 0.2, 0.4, 1.507364624159e-2),
        (0.15, 0.35, 2.4, 1.218727619294e-3),
        (0.8, 0.7, 0.3, 7.738786427338e-2),
    ];
    for (emission, incidence, alpha, value) in known {
        let found = law(Scattering::Hapke(HAPKE), alpha).light(emission, incidence);
        assert!((found / value - 1.0).abs() < 1e-11, "{emission} {incidence} {alpha}: {found}");
    }
}

/// The H,G factor makes a sphere follow the H,G system, whatever the law. (O11)
#[test]
fn a_sphere_follows_the_hg_system() {
    for scattering in [Scattering::LommelSeeliger, Scattering::Lambert] {
        let hg = Law::new(scattering, Phase::HG { G: 0.15 }).unwrap();
        let whole = |alpha: f64| {
            hg.at(alpha).unwrap().light(0.7, 0.5) / law(scattering, alpha).light(0.7, 0.5)
                * scattering.sphere(alpha)
        };
        // Bowell et al. (1989) by hand at 20 degrees: tan 10° = 0.176327, exponents 3.33 · 0.335096 and 1.87 · 0.120352
        let known = 0.85 * (-3.33_f64 * 0.335_105).exp() + 0.15 * (-1.87_f64 * 0.120_367).exp();
        assert!((whole(20_f64.to_radians()) - known).abs() < 1e-5, "{} {known}", whole(20_f64.to_radians()));
        assert!((whole(0.0) - 1.0).abs() < 1e-15);
    }
}

/// A body of 1 km with the albedo 0.15: `1329 km / √p` is the diameter of magnitude zero, to the four digits of the constant.
#[test]
fn magnitudes_are_those_of_the_standard_relation() {
    let (p, diameter) = (0.15, 1e3);
    let cross_section = std::f64::consts::PI * 0.25 * diameter * diameter;
    let known = 5.0 * (1329e3_f64 / (diameter * f64::sqrt(p))).log10();
    let found = magnitude(p * cross_section);
    assert!((found - known).abs() < 3e-3, "{found} {known}");
    assert!((albedo(found, cross_section) / p - 1.0).abs() < 1e-13);
}

#[test]
fn laws_out_of_range_are_refused() {
    let parameter = |scattering, phase| match Law::new(scattering, phase) {
        Err(PhotometryError::Parameter { .. }) => {}
        other => panic!("{other:?}"),
    };
    let seeliger = Scattering::LommelSeeliger;
    parameter(Scattering::Mixed { lambert: -0.1 }, Phase::Flat);
    parameter(Scattering::Hapke(Hapke { w: 0.0, ..HAPKE }), Phase::Flat);
    parameter(Scattering::Hapke(Hapke { g: 1.0, ..HAPKE }), Phase::Flat);
    parameter(Scattering::Hapke(Hapke { h: 0.0, ..HAPKE }), Phase::Flat);
    parameter(Scattering::Hapke(Hapke { roughness: f64::NAN, ..HAPKE }), Phase::Flat);
    parameter(seeliger, Phase::HG { G: 1.5 });
    parameter(seeliger, Phase::ExponentialLinear { amplitude: 0.5, width: 0.0, slope: 0.0 });
    let own = Law::new(Scattering::Hapke(HAPKE), Phase::HG { G: 0.15 });
    assert_eq!(own, Err(PhotometryError::OwnPhase));
    let hg = Law::new(seeliger, Phase::HG { G: 0.15 }).unwrap();
    assert!(hg.at(119_f64.to_radians()).is_ok());
    assert!(matches!(hg.at(121_f64.to_radians()), Err(PhotometryError::PhaseRange { .. })));
    let steep = Phase::ExponentialLinear { amplitude: 0.5, width: 0.1, slope: -1.0 };
    let steep = Law::new(seeliger, steep).unwrap();
    assert!(steep.at(0.9).is_ok() && matches!(steep.at(1.1), Err(PhotometryError::NoLight { .. })));
}
