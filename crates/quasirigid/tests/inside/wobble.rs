//! Rate at which a small wobble decays, at any friction, against the linear equations of a body of revolution.

use nalgebra::{Complex, Matrix2};
use quasirigid::averaging::{Evolution, Response};
use quasirigid::elements::{Assembly, Carrier, Cavity, CavityShape, Regime};
use quasirigid::model::Mode;
use quasirigid::modes::{RelativeEquilibrium, SpinMagnitude, SpinModes};
use quasirigid_math::rotation::turned;

use super::bodies::tank;
use crate::support::parts;
use crate::support::rotors::ball;

type C = Complex<f64>;

const A: f64 = 3.0;
const C3: f64 = 4.2;
const SPIN: f64 = 0.8;

fn carrier(moments: [f64; 3]) -> Carrier {
    let [x, y, z] = moments;
    parts::carrier(30.0, [0.1, -0.2, 0.4], parts::diag([x, y, z]))
}

fn rate(assembly: &Assembly) -> f64 {
    let response = Response::compute(&assembly.body().unwrap()).unwrap();
    Evolution::new(&response, C3 * SPIN).wobble_rate(Mode::ShortAxis)
}

/// Decay of the nutation `s ≈ i n(C−A)/A` in `A ω̇ + I Q̇ = i n(C−A) ω − i n I Q`, `I ω̇ + I Q̇ = −(i n I + κ) Q`, where `ω` and `Q`
/// are the spin across the axis and that of the ball relative to the body, as complex numbers.
fn decay_with_ball(inertia: f64, friction: f64) -> f64 {
    let i = C::i();
    let mass = Matrix2::new(A, inertia, inertia, inertia).map(C::from);
    let force = Matrix2::new(
        i * SPIN * (C3 - A),
        -i * SPIN * inertia,
        C::from(0.0),
        -(i * SPIN * inertia + friction),
    );
    let matrix = mass.try_inverse().unwrap() * force;
    let (half, determinant) = (matrix.trace() / 2.0, matrix.determinant());
    let root = (half * half - determinant).sqrt();
    let nutation = i * SPIN * (C3 - A) / A;
    let near = [half + root, half - root]
        .into_iter()
        .min_by(|a, b| (a - nutation).norm().total_cmp(&(b - nutation).norm()));
    -near.unwrap().re
}

/// Whatever the friction, the error of the average is of the order of the ball's share of the inertia.
#[test]
fn a_ball_with_any_friction() {
    for friction_per_inertia in [30.0, 0.7, 0.02] {
        let gaps = [1e-3, 1e-4].map(|share| {
            let (inertia, friction) = (share * A, friction_per_inertia * share * A);
            let assembly = Assembly {
                carrier: Some(carrier([A, A, C3])),
                rotors: vec![ball(inertia, friction)],
                ..Assembly::default()
            };
            (rate(&assembly) / decay_with_ball(inertia, friction) - 1.0).abs()
        });
        assert!(gaps[1] < 5e-4 && gaps[1] < 0.15 * gaps[0], "{friction_per_inertia}: {gaps:?}");
    }
}

/// `1 − χ` of a liquid ball: `χ = (5/z²)(z i₁′/i₁ − 1)`, in hyperbolic functions.
fn loose_share(z: C) -> C {
    let decayed = (-2.0 * z).exp();
    let tanh = (1.0 - decayed) / (1.0 + decayed);
    let slope = (z * z * tanh - 2.0 * z + 2.0 * tanh) / (z - tanh);
    1.0 - 5.0 / (z * z) * (slope - 1.0)
}

/// Decay of the nutation with a ball of liquid: `sA − i n(C−A) = I s (1 − χ)` at the frequency `s + i n` in space.
fn decay_with_liquid(inertia: f64, time: f64) -> f64 {
    let i = C::i();
    let gap = |s: C| s * A - i * SPIN * (C3 - A) - inertia * s * loose_share(((s + i * SPIN) * time).sqrt());
    let mut s = i * SPIN * (C3 - A) / A;
    for _ in 0..60 {
        s -= gap(s) / A;
    }
    assert!(gap(s).norm() < 1e-14);
    -s.re
}

fn with_liquid(radius: f64, density: f64, time: f64) -> Assembly {
    let inertia = density * 8.0 / 15.0 * std::f64::consts::PI * radius.powi(5);
    let own = [A - inertia, A - inertia, C3 - inertia];
    let cavities = vec![tank([0.1, -0.2, 0.4], radius, density, radius * radius / time)];
    Assembly { carrier: Some(carrier(own)), cavities, ..Assembly::default() }
}

fn frozen(radius: f64, density: f64) -> f64 {
    density * 8.0 / 15.0 * std::f64::consts::PI * radius.powi(5)
}

/// A flow that follows at once, at a Reynolds number of 0.08: the Coriolis force rotates its shells as the body rotates.
#[test]
fn a_liquid_ball_at_a_low_reynolds_number() {
    let (density, time) = (1000.0, 0.1);
    let gaps = [0.1_f64, 0.0631].map(|radius| {
        let expected = decay_with_liquid(frozen(radius, density), time);
        (rate(&with_liquid(radius, density, time)) / expected - 1.0).abs()
    });
    // The reference leaves out the flow between poles and equator, which is of the square of the Reynolds number.
    assert!(gaps[1] < 1e-5, "{gaps:?}");
}

/// Decay of the nutation with an ideal core and its layer, `15/8·∫(x − 1)²κ dx` with `κ = √(σ + 2iτx)`, the Coriolis force in both: the
/// root of `(s − iΩ)(A − sΠ) + iΩC = 0`, `Π = I a²/(νD)`.
fn decay_with_layer(inertia: f64, time: f64) -> f64 {
    let i = C::i();
    let tau = SPIN * time;
    let drag = |sigma: C| {
        let count = 40_000;
        let term = |place: i32| {
            let x = -1.0 + (f64::from(place) + 0.5) * 2.0 / f64::from(count);
            (x - 1.0).powi(2) * (sigma + 2.0 * i * tau * x).sqrt()
        };
        sigma - i * tau + 1.875 * 2.0 / f64::from(count) * (0..count).map(term).sum::<C>()
    };
    let mut s = i * SPIN * (1.0 - C3 / A);
    for _ in 0..8 {
        let ratio = inertia * time * s / drag(s * time);
        s = i * SPIN - i * SPIN * C3 / (A - ratio);
    }
    -s.re
}

/// At high Reynolds numbers the power tends to that of the layer as slowly as `E^{0.3}`; the modes, which hold for a heavy liquid too, have
/// the same rate. The law of shells that drag each other, without the flow between poles and equator, is off by more.
#[test]
fn a_liquid_ball_at_high_reynolds_numbers() {
    let density = 1000.0;
    let gaps = [1.0e4, 1.0e6].map(|time| {
        let assembly = with_liquid(0.0631, density, time);
        let (average, layer) = (rate(&assembly), decay_with_layer(frozen(0.0631, density), time));
        let body = assembly.body().unwrap();
        let spin = RelativeEquilibrium::extreme(&body, Mode::ShortAxis, SpinMagnitude::Rate(SPIN)).unwrap();
        let modes = SpinModes::about(&body, spin).unwrap();
        let decay = modes.nutation().unwrap().decay_rate;
        assert!((decay / average - 1.0).abs() < 1e-3, "{time}: {decay:e} {average:e}");
        (average / layer - 1.0).abs()
    });
    println!("{gaps:?}");
    assert!(gaps[0] < 0.12 && gaps[1] < 0.02, "{gaps:?}");
}

/// Coordinates of an ideal liquid behind its boundary layer lose the energy of the shells of a ball, but for the few rates that make up the
/// layer.
#[test]
fn a_boundary_layer_at_high_reynolds_numbers() {
    let (density, radius) = (100.0, 0.0631_f64);
    let gaps = [1.0e4, 1.0e6].map(|time| {
        let mut assembly = with_liquid(radius, density, time);
        let liquid = assembly.cavities.remove(0);
        assembly.cavities = vec![Cavity { regime: Regime::BoundaryLayer, modes: 3, ..liquid }];
        let response = Response::compute(&assembly.body().unwrap().without_memories()).unwrap();
        let rate = Evolution::new(&response, C3 * SPIN).wobble_rate(Mode::ShortAxis);
        (rate / decay_with_liquid(frozen(radius, density), time) - 1.0).abs()
    });
    println!("{gaps:?}");
    assert!(gaps.iter().all(|gap| *gap < 2e-3), "{gaps:?}");
}

/// `I_n(z)` by its power series.
fn bessel(n: i32, z: C) -> C {
    let quarter = z * z / 4.0;
    let mut term = (z / 2.0).powi(n) / (1..=n).map(f64::from).product::<f64>();
    let mut sum = term;
    for k in 1..60_i32 {
        term *= quarter / f64::from(k * (k + n));
        sum += term;
    }
    sum
}

/// A slender ring across the spin: the wobble rotates the ring at the frequency `σ` of the body, and the spin itself does nothing along its
/// tube. The mean power is `½ I σ w² Im(I₂/I₀)`, the energy of the wobble `½ A w² (1 − A/C)`.
#[test]
fn a_ring_across_the_spin_at_any_reynolds_number() {
    let (radius, tube) = (0.2_f64, 0.01_f64);
    let nutation = SPIN * (C3 - A) / A;
    for time in [2.0, 60.0, 900.0] {
        let z = (C::i() * nutation * time).sqrt();
        let lag = (bessel(2, z) / bessel(0, z)).im;
        let gaps = [100.0, 10.0].map(|density| {
            let mass = density * 2.0 * std::f64::consts::PI.powi(2) * radius * tube * tube;
            let along = mass * (radius * radius + 0.75 * tube * tube);
            let across = mass * (0.5 * radius * radius + 0.625 * tube * tube);
            let ring = Cavity {
                shape: CavityShape::Ring { radius, tube_radius: tube },
                attitude: turned([1.0, 0.0, 0.0, 0.0], [0.0, std::f64::consts::FRAC_PI_2, 0.0]),
                ..tank([0.1, -0.2, 0.4], 1.0, density, tube * tube / time)
            };
            let own = carrier([A - along, A - across, C3 - across]);
            let assembly = Assembly { carrier: Some(own), cavities: vec![ring], ..Assembly::default() };
            let expected = 0.5 * mass * radius * radius * nutation * lag / (A * (1.0 - A / C3));
            (rate(&assembly) / expected - 1.0).abs()
        });
        println!("{time}: {gaps:?}");
        assert!(gaps[1] < 2e-3 && gaps[1] < 0.2 * gaps[0].max(1e-6), "{time}: {gaps:?}");
    }
}
