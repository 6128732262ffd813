//! Angular momentum of every kind of start, against the sum over the parts written out here. (Q8)

use std::path::Path;

use quasirigid::dynamics::{Options, Sample};
use quasirigid_io::model::{PartialSpinManifold, System};
use quasirigid_math::vec3::cross;

use super::*;
use crate::modes::SteadySpinSettings;

type V = [f64; 3];

const CARRIER: V = [12.0, 14.0, 18.0];
const MASSES: [f64; 2] = [30.0, 0.4];
const PLACE: V = [0.5, 0.2, 0.6];
const BODIES: usize = 24;
const COMPARED: usize = 8;

/// Numbers of a random body, from a linear congruence.
struct Draw(u64);

impl Draw {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, [low, high]: [f64; 2]) -> f64 {
        low * (high / low).powf(self.unit())
    }

    fn vector(&mut self, size: f64) -> V {
        let v = [0; 3].map(|_| self.unit() - 0.5);
        scale(size / norm(v), v)
    }
}

/// Carrier with a sprung mass, a rotor and a ball of liquid, from strong friction to hardly any.
struct Body {
    axis: V,
    inertia: f64,
    friction: f64,
    radius: f64,
    viscosity: f64,
    omega: V,
}

impl Body {
    fn drawn(draw: &mut Draw) -> Self {
        Self {
            axis: draw.vector(1.0),
            inertia: draw.between([0.05, 2.0]),
            friction: draw.between([1e-3, 30.0]),
            radius: draw.between([0.1, 0.4]),
            viscosity: draw.between([1e-4, 1.0]),
            omega: {
                let size = draw.between([0.05, 1.0]);
                draw.vector(size)
            },
        }
    }

    /// Model with a start.
    fn model(&self, speed: Option<f64>, initial: &str, force: &str) -> String {
        let Self { axis, inertia, friction, radius, viscosity, omega } = self;
        let speed = speed.map_or_else(String::new, |speed| format!("speed = {speed:?}\n"));
        format!(
            "[carrier]\nmass = {:?}\ncenter_of_mass = [0.0, 0.0, 0.0]\ninertia = {CARRIER:?}\n\
             [[point]]\nname = \"tip\"\nmass = {:?}\nposition = {PLACE:?}\n\
             [[spring]]\nfrom = \"tip\"\nto = \"carrier\"\nstiffness = 4000.0\ndamping = 8.0\n\
             [[rotor]]\nname = \"wheel\"\naxis = {axis:?}\ninertia = {inertia:?}\nfriction = {friction:?}\n{speed}\
             [[cavity]]\nname = \"liquid\"\nshape = \"sphere\"\nradius = {radius:?}\ncenter = [0.0, 0.0, 0.0]\n\
             density = 80.0\nkinematic_viscosity = {viscosity:?}\n\
             [initial]\nangular_velocity = {omega:?}\n{initial}\n{force}",
            MASSES[0], MASSES[1]
        )
    }

    /// Mass (kg) and inertia (kg·m²) of the liquid as a rigid ball.
    fn liquid(&self) -> [f64; 2] {
        let mass = 80.0 * 4.0 / 3.0 * std::f64::consts::PI * self.radius.powi(3);
        [mass, 0.4 * mass * self.radius.powi(2)]
    }

    /// Angular momentum of the locked body with the sprung mass displaced and in motion, and the rotor at a speed: carrier and liquid about
    /// their common centre, reduced mass and distance, rotor.
    fn angular_momentum(&self, displaced: V, rate: V, speed: f64) -> V {
        let [mass, ball] = self.liquid();
        let held = MASSES[0] + mass;
        let reduced = held * MASSES[1] / (held + MASSES[1]);
        let arm = add(PLACE, displaced);
        let turned = [0, 1, 2].map(|i| (CARRIER[i] + ball) * self.omega[i]);
        let moved = scale(reduced, cross(arm, add(cross(self.omega, arm), rate)));
        add(add(turned, moved), scale(self.inertia * speed, self.axis))
    }
}

/// A start of each kind, with a force or without one.
const STARTS: [(Option<f64>, &str); 6] = [
    (None, ""),
    (None, "displacements = \"rest\""),
    (None, "displacements = { tip = [0.01, 0.0, -0.02] }"),
    (None, "displacements = \"rest\"\ndisplacement_rates = { tip = [0.1, 0.2, 0.0] }"),
    (Some(0.0), ""),
    (Some(3.0), "displacements = \"rest\""),
];
const TORQUE: &str = "[[force]]\nkind = \"torque\"\ntorque = [0.0, 0.02, 0.01]\n";

fn study(model: &str) -> Study {
    Study::read_from(Path::new("random"), model.as_bytes(), None).unwrap()
}

/// Weakly damped rotors and liquids start at rest in the body or as the file says, strongly damped ones slaved; what the liquid and a slaved
/// rotor carry is less than half of the whole, and their momentum is that of the leading order, `−I²/κ a·ω̇` and less, never a diverged series.
#[test]
fn angular_momentum_of_every_start_is_the_sum_over_the_parts() {
    let mut draw = Draw(20);
    let (mut slaved, mut loose) = (0, 0);
    for number in 0..BODIES {
        let body = Body::drawn(&mut draw);
        let force = if number % 4 == 3 { TORQUE } else { "" };
        for (speed, initial) in STARTS {
            let study = study(&body.model(speed, initial, force));
            let motion = Motion::new(&study, study.initial().unwrap());
            let full = motion.full().unwrap();
            let [wheel, tip] = ["wheel", "tip"].map(|name| place(&study, name));
            let part = |values: &[f64]| [0, 1, 2].map(|i| values[tip + i]);
            let held = body.angular_momentum(part(&full.q), part(&full.rate), full.rate[wheel]);
            let whole = norm(body.angular_momentum([0.0; 3], [0.0; 3], 0.0));
            let gap = norm(add(full.angular_momentum(&study.body), scale(-1.0, held)));
            let told = format!("{number} {speed:?} {initial:?}: {gap:e} of {whole}");
            let own = body.inertia * full.rate[wheel].abs();
            assert!(gap <= 0.5 * whole, "the liquid: {told}");
            match speed {
                Some(speed) => assert_eq!(full.rate[wheel], speed, "{told}"),
                None => assert!(own <= 0.5 * whole, "the rotor: {told}, {own}"),
            }
            if study.body.cyclic().all(|j| j == wheel || full.rate[j] == 0.0) {
                loose += 1;
                assert!(gap < 1e-12 * whole, "{told}");
            } else {
                slaved += 1;
                let slope = body.inertia / body.friction * norm(body.omega).powi(2);
                assert!(speed.is_some() || full.rate[wheel].abs() < 2.0 * slope + 0.1, "{told}");
            }
        }
    }
    assert!(slaved > BODIES && loose > BODIES, "{slaved} {loose}");
}

/// The reduced equations and the steady spins have the angular momentum of the full start, or refuse.
#[test]
fn every_system_starts_with_the_angular_momentum_of_the_full_start_or_refuses() {
    let mut draw = Draw(21);
    let (mut followed, mut refused) = (0, 0);
    for number in 0..COMPARED {
        let body = Body::drawn(&mut draw);
        let force = if number % 4 == 3 { TORQUE } else { "" };
        let (speed, initial) = STARTS[number % STARTS.len()];
        let study = study(&body.model(speed, initial, force));
        let motion = Motion::new(&study, study.initial().unwrap());
        let whole = motion.angular_momentum().unwrap();
        let told = format!("{number} {speed:?} {initial:?} {force:?}");
        let mut samples: Vec<Sample> = Vec::new();
        let asked = SpinManifoldSettings::resolve(PartialSpinManifold::default(), None, &study).unwrap();
        match motion.follow(System::Reduced, &asked, &[0.0], &Options::default(), &mut samples) {
            Ok(_) => {
                followed += 1;
                let K = norm(samples[0].angular_momentum);
                assert!((K / whole - 1.0).abs() < 0.05, "{told}: {K} {whole}");
            }
            Err(error) => {
                refused += 1;
                assert!(error.is_of_the_series(), "{told}: {error}");
            }
        }
        if force.is_empty() {
            let spins = study.modes(SteadySpinSettings::default()).unwrap().spins;
            let K = spins[0].angular_momentum.map(norm);
            assert!(K.is_none_or(|K| (K / whole - 1.0).abs() < 1e-6), "{told}: {K:?} {whole}");
        }
    }
    assert!(followed > 0 && refused > 0, "{followed} {refused}");
}

/// Number of the first coordinate of a part.
fn place(study: &Study, name: &str) -> usize {
    study.body.coordinates().iter().position(|coordinate| coordinate.name.contains(name)).unwrap()
}
