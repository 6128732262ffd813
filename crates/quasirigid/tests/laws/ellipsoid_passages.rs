//! Passages of ellipsoids in lanes beside the evolution of each body by itself, whose displacements, harmonics and quadrature are others.

use std::f64::consts::PI;

use quasirigid::averaging::{
    EllipsoidLoss, EllipsoidPassage, EllipsoidRefusal, Evolution, Response, Wobble, WobblingEllipsoid,
    ellipsoid_passages,
};
use quasirigid::elements::{Assembly, Ellipsoid, Material};
use quasirigid::model::Rheology;
use quasirigid::prelude::Rounding;
use quasirigid_math::random::Random;

const HOUR: f64 = 3600.0;

/// Tumbling asteroids of any shape, material and rotation, one of each law of loss and each mode among four.
fn drawn(count: usize) -> Vec<WobblingEllipsoid> {
    let mut random = Random::new(1978);
    let mut unit = || random.unit();
    let mut asteroid = |i: usize| {
        let size = 10f64.powf(1.0 + 3.0 * unit());
        let mut semi_axes = [size, size * (0.25 + 0.7 * unit()), size * (0.25 + 0.7 * unit())];
        semi_axes.rotate_left(i % 3);
        let [a, b, c] = semi_axes.map(|axis| axis * axis);
        let mut moments = [b + c, c + a, a + b];
        moments.sort_by(f64::total_cmp);
        let least = moments[0] / moments[2];
        let ratio = |share: f64| Wobble::Ratio(least + (1.0 - least) * share);
        let shear = 10f64.powf(7.0 + 3.0 * unit());
        WobblingEllipsoid {
            semi_axes,
            density: 1000.0 + 2000.0 * unit(),
            shear,
            poisson: 0.45 * unit(),
            loss: if i.is_multiple_of(2) {
                EllipsoidLoss::QualityFactor(10.0 + 1000.0 * unit())
            } else {
                EllipsoidLoss::KelvinVoigt(1e-3 + 10.0 * unit())
            },
            spin: 2.0 * PI / (HOUR * 10f64.powf(1.0 + 1.5 * unit())),
            from: if i % 4 < 2 { ratio(0.02 + 0.7 * unit()) } else { Wobble::Nutation(0.4 + unit()) },
            until: if i.is_multiple_of(8) { ratio(0.98) } else { Wobble::Nutation(0.01 + 0.2 * unit()) },
        }
    };
    (0..count).map(&mut asteroid).collect()
}

/// Time (s), revolutions and power (W) at the start of the body by itself.
fn alone(body: &WobblingEllipsoid) -> [f64; 3] {
    let rheology = match body.loss {
        EllipsoidLoss::QualityFactor(factor) => Rheology::QualityFactor { factor },
        EllipsoidLoss::KelvinVoigt(time) => Rheology::KelvinVoigt { time },
    };
    let young = 2.0 * body.shear * (1.0 + body.poisson);
    let material = Material { density: body.density, young, poisson: body.poisson, rheology };
    let ellipsoid = Ellipsoid { name: "rock".into(), semi_axes: body.semi_axes, center: [0.0; 3], material };
    let flexible = Assembly { ellipsoids: vec![ellipsoid], ..Assembly::default() }.body().unwrap();
    let response = Response::compute(&flexible).unwrap();
    let evolution = Evolution::new(&response, body.spin * response.principal().moments[2]);
    let rotation_state = |wobble| match wobble {
        Wobble::Ratio(ratio) => evolution.rotation_state(ratio).unwrap(),
        Wobble::Nutation(angle) => evolution.wobbling(angle).unwrap(),
    };
    let passage = evolution.passage(rotation_state(body.from), rotation_state(body.until));
    [passage.time, passage.revolutions, evolution.power(rotation_state(body.from))]
}

fn one(body: WobblingEllipsoid) -> Result<EllipsoidPassage, EllipsoidRefusal> {
    ellipsoid_passages(&[body], Rounding::Fastest)[0]
}

#[test]
fn passages_are_those_of_each_body_by_itself() {
    let bodies = drawn(48);
    let passages = ellipsoid_passages(&bodies, Rounding::Fastest);
    let mut held = 0;
    for (body, passage) in bodies.iter().zip(&passages) {
        let Ok(passage) = passage else { continue };
        held += 1;
        let found = [passage.time, passage.revolutions, passage.power];
        for (found, known) in found.iter().zip(alone(body)) {
            // the static response leaves out inertia, a part of the bound
            let gap = (found / known - 1.0).abs();
            assert!(gap < 3e-9 + passage.error, "{body:?}: {found:e} {known:e}, {passage:?}");
        }
        assert!(passage.error < 0.04 && passage.quadrature_error < 1e-2 * passage.time);
    }
    assert!(held > 40, "{held}: {passages:?}");
}

#[test]
fn passages_do_not_depend_on_their_neighbours_or_the_registers() {
    let bodies = drawn(29);
    let together = ellipsoid_passages(&bodies, Rounding::Reproducible);
    for (body, passage) in bodies.iter().zip(&together) {
        assert_eq!(ellipsoid_passages(std::slice::from_ref(body), Rounding::Reproducible)[0], *passage);
    }
    let fastest = ellipsoid_passages(&bodies, Rounding::Fastest);
    for (a, b) in together.iter().zip(&fastest) {
        let [a, b] = [a, b].map(|passage| passage.as_ref().map_or(0.0, |passage| passage.time));
        assert!((a - b).abs() <= 1e-12 * a, "{a:e} {b:e}");
    }
}

/// A body in other units of length, mass and time has its time in these units; a way is the sum of its parts.
#[test]
fn passages_scale_and_add() {
    for body in drawn(16) {
        let Ok(passage) = one(body) else { continue };
        let [long, heavy, slow] = [3.7, 0.21, 11.0];
        let scaled = WobblingEllipsoid {
            semi_axes: body.semi_axes.map(|axis| long * axis),
            density: body.density * heavy / long.powi(3),
            shear: body.shear * heavy / (long * slow * slow),
            loss: match body.loss {
                EllipsoidLoss::KelvinVoigt(time) => EllipsoidLoss::KelvinVoigt(slow * time),
                quality => quality,
            },
            spin: body.spin / slow,
            ..body
        };
        let there = one(scaled).unwrap();
        assert!((there.time / (slow * passage.time) - 1.0).abs() < 1e-11, "{body:?}");
        assert!((there.error / passage.error - 1.0).abs() < 1e-9);
        let between = Wobble::Nutation(0.3);
        let [Ok(first), Ok(second)] = [
            one(WobblingEllipsoid { until: between, ..body }),
            one(WobblingEllipsoid { from: between, ..body }),
        ] else {
            continue;
        };
        assert!(((first.time + second.time) / passage.time - 1.0).abs() < 1e-8, "{body:?}");
    }
}

#[test]
fn what_no_ellipsoid_has_is_refused() {
    let body = drawn(4)[3];
    let refused = |change: fn(&mut WobblingEllipsoid)| {
        let mut other = body;
        change(&mut other);
        one(other).unwrap_err().to_string()
    };
    assert!(refused(|body| body.semi_axes[1] = -1.0).contains("a semi-axis is -1"));
    assert!(refused(|body| body.semi_axes[2] = f64::NAN).contains("NaN"));
    assert!(refused(|body| body.density = 0.0).contains("the density is 0"));
    assert!(refused(|body| body.shear = f64::INFINITY).contains("the shear modulus is inf"));
    assert!(refused(|body| body.spin = 0.0).contains("the spin is 0"));
    assert!(
        refused(|body| body.loss = EllipsoidLoss::QualityFactor(-3.0)).contains("the quality factor is -3")
    );
    assert!(
        refused(|body| body.loss = EllipsoidLoss::QualityFactor(0.9)).contains("the quality factor is 0.9")
    );
    assert!(
        refused(|body| body.loss = EllipsoidLoss::KelvinVoigt(0.0)).contains("the time of the material is 0")
    );
    assert!(refused(|body| body.poisson = 0.5).contains("Poisson's ratio 0.5"));
    for wobble in [
        Wobble::Nutation(0.0),
        Wobble::Nutation(1.6),
        Wobble::Ratio(1.0),
        Wobble::Ratio(0.01),
        Wobble::Ratio(f64::NAN),
    ] {
        let mut other = body;
        other.from = wobble;
        assert!(matches!(one(other), Err(EllipsoidRefusal::NoState { .. })), "{wobble:?}");
    }
    assert!(
        refused(|body| (body.from, body.until) = (Wobble::Nutation(0.1), Wobble::Nutation(0.2)))
            .contains("larger one")
    );
    assert!(refused(|body| body.semi_axes = [1.0, 1.0, 2.0]).contains("two greatest moments are equal"));
    assert!(refused(|body| body.semi_axes = [1.0; 3]).contains("two greatest moments are equal"));
}

/// Numbers that overflow or vanish on the way are refused, and no answer is NaN or infinite.
#[test]
fn what_has_no_numbers_is_refused() {
    let body = drawn(4)[2];
    for factor in [1e300, 1e150, 1e80, 1e-80, 1e-150, 1e-300] {
        let scaled = [
            WobblingEllipsoid { density: factor * body.density, ..body },
            WobblingEllipsoid { shear: factor * body.shear, ..body },
            WobblingEllipsoid { spin: factor * body.spin, ..body },
            WobblingEllipsoid { semi_axes: body.semi_axes.map(|axis| factor * axis), ..body },
            WobblingEllipsoid { loss: EllipsoidLoss::KelvinVoigt(factor), ..body },
            WobblingEllipsoid { loss: EllipsoidLoss::QualityFactor(factor), ..body },
        ];
        for body in scaled {
            let Ok(EllipsoidPassage { time, revolutions, power, quadrature_error, error }) = one(body) else {
                continue;
            };
            let numbers = [time, revolutions, power, quadrature_error, error];
            assert!(numbers.iter().all(|number| number.is_finite()) && power > 0.0, "{body:?}: {numbers:?}");
        }
    }
    let refused = one(WobblingEllipsoid { density: 1e-300, ..body }).unwrap_err();
    assert_eq!(refused, EllipsoidRefusal::OutOfRange);
    let still = one(WobblingEllipsoid { until: body.from, ..body }).unwrap();
    assert_eq!((still.time, still.revolutions), (0.0, 0.0));
}

/// Too soft, too lossy, too fast: refused, with the reason.
#[test]
fn what_does_not_hold_is_refused() {
    let rock = WobblingEllipsoid {
        semi_axes: [170.0, 130.0, 100.0],
        density: 2000.0,
        shear: 5e8,
        poisson: 0.25,
        loss: EllipsoidLoss::QualityFactor(100.0),
        spin: 6e-5,
        from: Wobble::Nutation(1.0),
        until: Wobble::Nutation(0.1),
    };
    assert!(one(rock).is_ok());
    let soft = one(WobblingEllipsoid { shear: 1e-2, ..rock }).unwrap_err().to_string();
    assert!(soft.contains("does not hold") && soft.contains("moments of inertia"), "{soft}");
    let fast = one(WobblingEllipsoid { spin: 3.0, ..rock }).unwrap_err().to_string();
    assert!(fast.contains("does not hold"), "{fast}");
    let forgetful = one(WobblingEllipsoid { loss: EllipsoidLoss::KelvinVoigt(1e17), ..rock }).unwrap();
    assert!(forgetful.time > 1e20, "a material that hardly yields takes little");
}
