//! Partly full rings: the full system against Newton's laws for the cells of the slug, closed forms of its friction, the decay of a nutation
//! with which it runs around, and its small motions in a spin. (U10)–(U14)

use nalgebra::{Matrix4, Vector3, Vector4};
use quasirigid::dynamics::{
    Forced, FullState, Method, Options, Outcome, PropagateError, Sample, propagate_full,
};
use quasirigid::elements::{
    Assembly, ElementError, Field, HingeCoefficient, Hinged, Problem, Slug, TankContents, TankError, Tube,
    TubeError,
};
use quasirigid::model::{FlexibleBody, Rheology, TubeFlow};
use quasirigid::modes::{EquilibriumError, RelativeEquilibrium, SpinMagnitude, SpinModes};
use quasirigid::reduction::{ReductionError, reduce};
use std::f64::consts::PI;

use super::common::turned_axes;
use crate::support::parts;

type V = Vector3<f64>;

/// Units in which a test is repeated: metre, second and kilogram as multiples of those of the SI.
const UNITS: [[f64; 3]; 3] = [[1.0, 1.0, 1.0], [1e-3, 60.0, 1e-4], [250.0, 1e-2, 3e5]];

/// A ring of mercury as of 1973.
fn mercury() -> Tube {
    Tube {
        name: "ring".into(),
        radius: 0.127,
        tube_radius: 0.0046,
        center: [0.0, 0.0, 0.1],
        axis: [0.0, 0.0, 1.0],
        towards: None,
        contents: TankContents::Mass(0.12),
        density: 13_530.0,
        viscosity: 1.13e-7,
        surface_tension: None,
        held: false,
    }
}

/// The same numbers in other units.
fn scaled(tube: &Tube, [m, s, kg]: [f64; 3]) -> Tube {
    let contents = match tube.contents {
        TankContents::Mass(mass) => TankContents::Mass(mass * kg),
        fill @ TankContents::Fill(_) => fill,
    };
    Tube {
        radius: tube.radius * m,
        tube_radius: tube.tube_radius * m,
        center: tube.center.map(|entry| entry * m),
        contents,
        density: tube.density * kg / m.powi(3),
        viscosity: tube.viscosity * m * m / s,
        ..tube.clone()
    }
}

/// A carrier, of numbers in such units.
fn hub(
    mass: f64,
    center: [f64; 3],
    inertia: [[f64; 3]; 3],
    [m, _, kg]: [f64; 3],
) -> quasirigid::elements::Carrier {
    let inertia = inertia.map(|row| row.map(|entry| entry * kg * m * m));
    parts::carrier(mass * kg, center.map(|entry| entry * m), inertia)
}

fn slug(assembly: &Assembly) -> Slug {
    assembly.build().unwrap().slugs.into_iter().next().unwrap()
}

/// Times, states and samples of a motion.
fn followed(
    body: &FlexibleBody,
    start: &FullState,
    times: &[f64],
    method: Method,
) -> (Vec<Sample>, Vec<(f64, f64)>) {
    struct Seen(Vec<Sample>, Vec<(f64, f64)>);
    impl quasirigid::dynamics::Observer for Seen {
        fn sample(&mut self, sample: &Sample) {
            self.0.push(*sample);
        }
        fn keeps_coordinates(&self) -> bool {
            true
        }
        fn coordinates(&mut self, q: &[f64], rate: &[f64]) {
            self.1.push((q[0], rate[0]));
        }
    }
    let options = Options { tolerance: 1e-11, method, ..Options::default() };
    let mut seen = Seen(Vec::new(), Vec::new());
    let run = propagate_full(Forced::not(body), start, times, &options, &mut seen).unwrap();
    assert_eq!(run.outcome, Outcome::Finished);
    (seen.0, seen.1)
}

/// Cells of the slug, each with its mass and its place from the centre of the ring: Gauss's places along the arc, and four across the tube, which
/// give the moments of the section to the third degree.
fn cells(slug: &Slug) -> Vec<(f64, V)> {
    let [R, a] = slug.radii;
    let [_, axis, first] = slug.frame.map(V::from);
    let second = axis.cross(&first);
    let side = a / 2f64.sqrt();
    let mut cells = Vec::new();
    for (node, weight) in gauss(20) {
        let angle = 0.5 * slug.arc * node;
        let out = angle.cos() * first + angle.sin() * second;
        for [x, z] in [[side, 0.0], [-side, 0.0], [0.0, side], [0.0, -side]] {
            let share = 0.5 * weight * 0.25 * (R + x) / R;
            cells.push((slug.liquid_mass * share, (R + x) * out + z * axis));
        }
    }
    cells
}

/// Nodes and weights of Gauss on [−1, 1], by Newton on Legendre's polynomial.
fn gauss(n: usize) -> Vec<(f64, f64)> {
    let legendre = |x: f64| {
        let (mut last, mut own) = (1.0, x);
        for k in 2..=n {
            let k = k as f64;
            (last, own) = (own, ((2.0 * k - 1.0) * x * own - (k - 1.0) * last) / k);
        }
        (own, n as f64 * (x * own - last) / (x * x - 1.0))
    };
    let node = |i: usize| {
        let mut x = (PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
        for _ in 0..50 {
            let (value, slope) = legendre(x);
            x -= value / slope;
        }
        (x, 2.0 / ((1.0 - x * x) * legendre(x).1.powi(2)))
    };
    (0..n).map(node).collect()
}

/// Newton and Euler for a free carrier and the cells, all turned by one angle about the axis of the ring: rates of angular velocity, angle and
/// its rate.
struct Newton<'a> {
    slug: &'a Slug,
    cells: Vec<(f64, V)>,
    mass: f64,
    center: V,
    inertia: nalgebra::Matrix3<f64>,
    friction: &'a dyn Fn(f64) -> f64,
}

impl Newton<'_> {
    fn rates(&self, [x, y, z, angle, rate]: [f64; 5]) -> [f64; 5] {
        let omega = V::new(x, y, z);
        let [base, axis, _] = self.slug.frame.map(V::from);
        let turn = nalgebra::Rotation3::from_axis_angle(&nalgebra::Unit::new_normalize(axis), angle);
        let moved: Vec<(f64, V, V)> =
            self.cells.iter().map(|(m, s)| (*m, base + turn * s, axis.cross(&(turn * s)))).collect();
        let whole = self.mass + self.slug.liquid_mass;
        let middle = (self.mass * self.center + moved.iter().map(|(m, r, _)| *m * r).sum::<V>()) / whole;
        // accelerations of places beside that of the centre of mass: those of no second derivative, then one for each of the four unknowns
        let parts = |r: &V, along: &V| {
            let own = omega.cross(&omega.cross(r))
                + 2.0 * rate * omega.cross(along)
                + rate * rate * axis.cross(along);
            [own, V::x().cross(r), V::y().cross(r), V::z().cross(r), *along]
        };
        let carried = parts(&self.center, &V::zeros());
        let mut mean = carried.map(|part| part * self.mass / whole);
        for (m, r, along) in &moved {
            for (mean, part) in mean.iter_mut().zip(parts(r, along)) {
                *mean += part * *m / whole;
            }
        }
        let mut moments = [V::zeros(); 5];
        let mut about = [0.0; 5];
        for k in 0..5 {
            moments[k] += self.mass * (self.center - middle).cross(&(carried[k] - mean[k]));
            for (m, r, along) in &moved {
                let force = *m * (parts(r, along)[k] - mean[k]);
                moments[k] += (r - middle).cross(&force);
                about[k] += axis.dot(&(r - base).cross(&force));
            }
        }
        moments[0] += omega.cross(&(self.inertia * omega));
        for (k, unit) in [V::x(), V::y(), V::z()].iter().enumerate() {
            moments[k + 1] += self.inertia * unit;
        }
        let row = |k: usize| V::new(moments[1][k], moments[2][k], moments[3][k]);
        let [a, b, c] = [row(0), row(1), row(2)];
        let system = Matrix4::new(
            a.x,
            a.y,
            a.z,
            moments[4].x,
            b.x,
            b.y,
            b.z,
            moments[4].y,
            c.x,
            c.y,
            c.z,
            moments[4].z,
            about[1],
            about[2],
            about[3],
            about[4],
        );
        let right =
            Vector4::new(-moments[0].x, -moments[0].y, -moments[0].z, -about[0] - (self.friction)(rate));
        let found = system.lu().solve(&right).unwrap();
        [found[0], found[1], found[2], rate, found[3]]
    }

    fn end(&self, mut y: [f64; 5], end: f64, steps: usize) -> [f64; 5] {
        let h = end / steps as f64;
        let plus = |y: [f64; 5], k: [f64; 5], h: f64| std::array::from_fn(|i| y[i] + h * k[i]);
        for _ in 0..steps {
            let k1 = self.rates(y);
            let k2 = self.rates(plus(y, k1, 0.5 * h));
            let k3 = self.rates(plus(y, k2, 0.5 * h));
            let k4 = self.rates(plus(y, k3, h));
            y = std::array::from_fn(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
        }
        y
    }
}

/// Friction of a slug (N·m) by Blasius and Ito, or Poiseuille and White, from the shear at the wall: `τ = f ρ v²/8` on `2πa L`, at the arm `R`.
fn by_shear(slug: &Slug, rate: f64) -> f64 {
    let ([R, a], [rho, nu]) = (slug.radii, slug.liquid);
    let v = R * rate.abs();
    let Re = 2.0 * a * v / nu;
    let dean = Re * (a / R).sqrt();
    let f = match slug.friction.flow(rate) {
        TubeFlow::Laminar if dean <= 11.6 => 64.0 / Re,
        TubeFlow::Laminar => 64.0 / Re / (1.0 - (1.0 - (11.6 / dean).powf(0.45)).powf(1.0 / 0.45)),
        TubeFlow::Turbulent => {
            f64::max(0.3164 * Re.powf(-0.25), 0.304 * Re.powf(-0.25) + 0.029 * (a / R).sqrt())
        }
        TubeFlow::Transitional => panic!("Reynolds number {Re}"),
    };
    f * rho * v * v / 8.0 * 2.0 * PI * a * slug.arc * R * R * rate.signum()
}

/// A skew ring of a wide tube off the centre of a skew carrier, sliding by half a turn, turbulent in a curved tube: every component, in
/// three systems of units, by both methods of integration.
#[test]
fn a_slug_moves_by_newtons_laws() {
    let axes = turned_axes();
    for unit in UNITS {
        let [m, s, kg] = unit;
        let ring = Tube {
            axis: (axes * V::new(0.3, -0.4, 2.0)).into(),
            center: [0.05, -0.11, 0.16],
            radius: 0.2,
            tube_radius: 0.01,
            contents: TankContents::Fill(0.3),
            density: 3000.0,
            viscosity: 2e-6,
            ..mercury()
        };
        let (mass, center, inertia) =
            (9.0, [0.02, 0.03, -0.05], [[0.9, 0.03, -0.02], [0.03, 0.8, 0.05], [-0.02, 0.05, 1.3]]);
        let body = Assembly::default().with(hub(mass, center, inertia, unit)).with(scaled(&ring, unit));
        let slug = slug(&body);
        let body = body.body().unwrap();
        let friction = |rate: f64| by_shear(&slug, rate);
        let newton = Newton {
            slug: &slug,
            cells: cells(&slug),
            mass: mass * kg,
            center: V::from(center) * m,
            inertia: nalgebra::Matrix3::from(inertia) * kg * m * m,
            friction: &friction,
        };
        let start = [0.7 / s, -0.4 / s, 2.9 / s, 0.0, 14.0 / s];
        let end = newton.end(start, 0.28 * s, 600);
        let state = FullState {
            rate: vec![start[4]],
            ..FullState::at_rest(&body, [start[0], start[1], start[2]], [1.0, 0.0, 0.0, 0.0])
        };
        for method in [Method::Explicit, Method::Implicit] {
            let (samples, inside) = followed(&body, &state, &[0.0, 0.28 * s], method);
            let (sample, (angle, rate)) = (samples[1], inside[1]);
            assert!(angle > 3.0, "{angle}");
            for i in 0..3 {
                assert!(
                    (sample.omega[i] - end[i]).abs() * s < 1e-8,
                    "{unit:?} {method:?}: {sample:?} {end:?}"
                );
            }
            assert!(
                (angle - end[3]).abs() < 1e-8 && (rate - end[4]).abs() * s < 1e-8,
                "{method:?} {angle} {end:?}"
            );
            let balance = (sample.energy + sample.dissipated - samples[0].energy) / samples[0].energy;
            assert!(balance.abs() < 1e-10, "{balance:e}");
            assert!(sample.dissipated > 0.05 * samples[0].energy);
            let K = |sample: &Sample| V::from(sample.angular_momentum).norm();
            assert!((K(&sample) / K(&samples[0]) - 1.0).abs() < 1e-10);
        }
    }
}

/// A laminar slug is the appendage with its mass and inertia on a hinge with the same damping.
#[test]
fn a_slow_slug_is_a_hinged_arc() {
    let ring = Tube { viscosity: 2e-3, axis: [0.4, 0.2, 1.0], towards: Some([1.0, 1.0, 0.0]), ..mercury() };
    let carrier = parts::carrier(
        30.0,
        [0.01, -0.02, 0.03],
        [[0.9, 0.03, -0.02], [0.03, 0.8, 0.05], [-0.02, 0.05, 1.3]],
    );
    let with_ring = Assembly::default().with(carrier.clone()).with(ring.clone());
    let slug = slug(&with_ring);
    let (mut first, mut second) = (V::zeros(), nalgebra::Matrix3::zeros());
    for (m, s) in cells(&slug) {
        first += m * s;
        second += m * s * s.transpose();
    }
    let middle = first / slug.liquid_mass;
    let own: nalgebra::Matrix3<f64> = second - slug.liquid_mass * middle * middle.transpose();
    let arc = Hinged {
        name: "ring".into(),
        mass: slug.liquid_mass,
        center_of_mass: (V::from(ring.center) + middle).into(),
        inertia: (own.trace() * nalgebra::Matrix3::identity() - own).into(),
        hinge: ring.center,
        axes: vec![ring.axis],
        stiffness: HingeCoefficient::PerAxis(vec![0.0]),
        damping: HingeCoefficient::PerAxis(vec![by_shear(&slug, 1e-3) / 1e-3]),
        rheology: Rheology::Elastic,
        places: Vec::new(),
        angle: None,
    };
    let bodies = [with_ring.body().unwrap(), Assembly::default().with(carrier).with(arc).body().unwrap()];
    let ends = bodies.each_ref().map(|body| {
        let state = FullState {
            rate: vec![0.2],
            ..FullState::at_rest(body, [0.05, -0.02, 0.3], [1.0, 0.0, 0.0, 0.0])
        };
        let (samples, inside) = followed(body, &state, &[0.0, 40.0], Method::Automatic);
        (samples[1], inside[1])
    });
    let [(one, inside), (other, within)] = ends;
    assert!(one.dissipated > 0.0 && (one.dissipated / other.dissipated - 1.0).abs() < 1e-8);
    assert!((inside.0 - within.0).abs() < 1e-8 && (V::from(one.omega) - V::from(other.omega)).norm() < 1e-9);
}

/// A ring about the axis of a spin, its centre that of the carrier: the rates of both come together, as an exponential where the flow is laminar,
/// `q̇ = q̇₀ e^{−kt}`, and by Blasius' law in a slender ring as `q̇^{−3/4} = q̇₀^{−3/4} + ¾ k t`.
#[test]
fn a_ring_about_a_spin_comes_to_the_rate_of_the_spin() {
    let own = turned_axes() * V::new(0.0, 0.0, 1.0);
    for unit in UNITS {
        let [m, s, _] = unit;
        for (tube_radius, viscosity, rate) in [(0.002, 3e-3, 4.0), (0.0001, 1.27e-8, 20.0)] {
            let ring = Tube {
                radius: 0.127,
                tube_radius,
                viscosity,
                center: [0.3, -0.2, 0.1],
                axis: own.into(),
                contents: TankContents::Fill(0.35),
                ..mercury()
            };
            let inertia = nalgebra::Matrix3::identity() * 1e-5 + own * own.transpose() * 1e-6;
            let body = Assembly::default()
                .with(hub(0.05, ring.center, inertia.into(), unit))
                .with(scaled(&ring, unit));
            let slug = slug(&body);
            let body = body.body().unwrap();
            let [R, a] = slug.radii;
            // the carrier recoils, so that the moment of the slug is less by that of its mass at its centre, at the share of its mass
            let middle = (V::from(slug.center_of_mass) - V::from(slug.frame[0])).norm();
            let whole = body.invariants().mass;
            let moment =
                slug.liquid_mass * (R * R + 0.75 * a * a - slug.liquid_mass / whole * middle * middle);
            let carrier = 1.1e-5 * unit[2] * m * m;
            let k = |rate: f64| by_shear(&slug, rate) * (1.0 / moment + 1.0 / carrier) / rate;
            let state = FullState {
                rate: vec![rate / s],
                ..FullState::at_rest(&body, (0.5 / s * own).into(), [1.0, 0.0, 0.0, 0.0])
            };
            let end = 0.7 / k(rate / s);
            let (samples, inside) = followed(&body, &state, &[0.0, end], Method::Automatic);
            let known = match slug.friction.flow(rate / s) {
                TubeFlow::Laminar => rate / s * (-0.7_f64).exp(),
                _ => rate / s * (1.0 + 0.75 * 0.7_f64).powf(-4.0 / 3.0),
            };
            assert!(
                (inside[1].1 / known - 1.0).abs() < 1e-7,
                "{unit:?} {tube_radius}: {:?} {known}",
                inside[1]
            );
            let spin = V::from(samples[1].omega);
            let kept = (carrier + moment) * 0.5 / s + moment * rate / s;
            assert!((spin.dot(&own) * (carrier + moment) + moment * inside[1].1 - kept).abs() < 1e-9 * kept);
        }
    }
}

/// While the slug runs around with the nutation, `sin²θ` falls as `2Qt/G` with the friction `Q` at the rate of the nutation in the body, whatever
/// the moment of inertia across the spin and the place of the ring along it: the lighter the slug, the better. (U14)
#[test]
fn a_nutation_with_which_the_slug_runs_falls_by_the_torque_over_the_momentum() {
    for (height, across, span) in [(0.1, 1.1, 0.2), (0.25, 0.9, 0.06)] {
        let error = |mass: f64| {
            // the slug runs opposite to the angular velocity across the spin
            let ring = Tube {
                center: [0.0, 0.0, height],
                towards: Some([-1.0, 0.0, 0.0]),
                contents: TankContents::Mass(mass),
                ..mercury()
            };
            let inertia = [[across, 0.0, 0.0], [0.0, across, 0.0], [0.0, 0.0, 1.5]];
            let body = Assembly::default().with(parts::carrier(5e3, [0.0; 3], inertia)).with(ring);
            let slug = slug(&body);
            let body = body.body().unwrap();
            let (spin, tilt) = (12.57, 3f64.to_radians());
            let omega = [1.5 / across * spin * tilt.tan(), 0.0, spin];
            let nutation = (1.5 / across - 1.0) * spin;
            let state =
                FullState { rate: vec![nutation], ..FullState::at_rest(&body, omega, [1.0, 0.0, 0.0, 0.0]) };
            let times = [0.0, 0.2 * span / mass, span / mass];
            let (samples, inside) = followed(&body, &state, &times, Method::Automatic);
            let square = |sample: &Sample| {
                let K = V::from(sample.angular_momentum);
                1.0 - (K.z / K.norm()).powi(2)
            };
            let mean = (inside[2].0 - inside[1].0) / (times[2] - times[1]);
            // it runs around with the nutation, whose rate it changes
            assert!((mean / nutation - 1.0).abs() < 0.1, "{mean} {nutation}");
            let slope = (square(&samples[2]) - square(&samples[1])) / (times[2] - times[1]);
            let known = -2.0 * by_shear(&slug, nutation) / V::from(samples[0].angular_momentum).norm();
            (slope / known - 1.0).abs()
        };
        let errors = [0.02, 0.005, 0.00125].map(error);
        assert!(errors[1] < 0.3 * errors[0] && errors[2] < 0.3 * errors[1] && errors[2] < 0.01, "{errors:?}");
    }
}

/// Across the spin of a heavy carrier the middle of the slug swings about the place farthest from the axis at `Ω √(sin φ/φ)`, `φ` its arc; its
/// motion decays by half the friction over the moment. About the spin every place is the same.
#[test]
fn small_motions_in_a_spin() {
    let axes = turned_axes();
    for [m, s, kg] in UNITS {
        for arc in [0.3, 1.4] {
            let ring = Tube {
                center: [0.0; 3],
                axis: (axes * V::y()).into(),
                towards: Some((axes * V::new(1.0, 0.0, 0.0)).into()),
                contents: TankContents::Fill(arc / (2.0 * PI)),
                ..mercury()
            };
            let inertia: nalgebra::Matrix3<f64> =
                1e4 * (nalgebra::Matrix3::identity() + axes * V::z() * (axes * V::z()).transpose());
            let body = Assembly::default()
                .with(hub(1e6, [0.0; 3], inertia.into(), [m, s, kg]))
                .with(scaled(&ring, [m, s, kg]));
            let slug = slug(&body);
            let body = body.body().unwrap();
            let rate = 3.0 / s;
            let steady =
                RelativeEquilibrium::near(&body, (axes * V::z()).into(), SpinMagnitude::Rate(rate)).unwrap();
            assert!(steady.q[0].abs() < 1e-6);
            let modes = SpinModes::about(&body, steady).unwrap().modes;
            let mode = modes.iter().find(|mode| mode.name.contains("along the ring")).unwrap();
            let known = rate * (arc.sin() / arc).sqrt();
            assert!((mode.frequency.hypot(mode.decay_rate) / known - 1.0).abs() < 1e-5, "{mode:?} {known}");
            let [R, a] = slug.radii;
            let decay = 0.5 * slug.friction.at_rest() / (slug.liquid_mass * (R * R + 0.75 * a * a));
            assert!((mode.decay_rate / decay - 1.0).abs() < 1e-4, "{mode:?} {decay}");
            let about = Tube { axis: (axes * V::z()).into(), ..scaled(&ring, [m, s, kg]) };
            let body = Assembly::default()
                .with(hub(1e6, [0.0; 3], inertia.into(), [m, s, kg]))
                .with(about)
                .body()
                .unwrap();
            let steady = RelativeEquilibrium::near(&body, (axes * V::z()).into(), SpinMagnitude::Rate(rate));
            assert!(matches!(steady, Err(EquilibriumError::Unrestored { .. })), "{steady:?}");
            assert!(matches!(reduce(&body, 3), Err(ReductionError::Hung { .. })));
        }
    }
}

/// What two dissipators take adds up to what is lost.
#[test]
fn each_dissipator_takes_its_own() {
    struct Shares(Vec<(String, f64)>, f64);
    impl quasirigid::dynamics::Observer for Shares {
        fn sample(&mut self, sample: &Sample) {
            self.1 = sample.dissipated;
        }
        fn budget(&mut self, energies: &[(String, f64)]) {
            self.0 = energies.to_vec();
        }
    }
    let other = Tube { name: "other".into(), axis: [1.0, 0.0, 0.0], viscosity: 1e-4, ..mercury() };
    let inertia = [[1.1, 0.0, 0.0], [0.0, 1.2, 0.0], [0.0, 0.0, 1.5]];
    let body = Assembly::default().with(parts::carrier(50.0, [0.0; 3], inertia)).with(mercury()).with(other);
    let body = body.body().unwrap();
    let state = FullState {
        rate: vec![6.0, -5.0],
        ..FullState::at_rest(&body, [1.0, 0.5, 8.0], [1.0, 0.0, 0.0, 0.0])
    };
    let mut shares = Shares(Vec::new(), 0.0);
    let run = propagate_full(Forced::not(&body), &state, &[0.0, 3.0], &Options::default(), &mut shares);
    assert_eq!(run.map(|run| run.outcome), Ok::<_, PropagateError>(Outcome::Finished));
    let names: Vec<&str> = shares.0.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["ring", "other"]);
    assert!(shares.0.iter().all(|(_, energy)| *energy > 1e-3 * shares.1));
    let sum: f64 = shares.0.iter().map(|(_, energy)| energy).sum();
    assert!((sum / shares.1 - 1.0).abs() < 1e-10, "{sum} {}", shares.1);
}

/// A ring whose liquid is held is a part of the carrier with the same mass, place and inertia, as at rest with the liquid free.
#[test]
fn a_held_liquid_is_a_part_of_the_carrier() {
    let carrier = parts::carrier(5.0, [0.1, 0.0, -0.3], [[1.1, 0.0, 0.0], [0.0, 1.2, 0.0], [0.0, 0.0, 1.5]]);
    let ring = Tube { axis: [1.0, 2.0, -0.3], contents: TankContents::Fill(0.7), ..mercury() };
    let [free, held] = [false, true].map(|held| {
        Assembly::default().with(carrier.clone()).with(Tube { held, ..ring.clone() }).body().unwrap()
    });
    assert_eq!((free.coordinates().len(), held.coordinates().len()), (1, 0));
    let gaps = free.invariants().J.iter().zip(held.invariants().J).map(|(free, held)| (free - held).abs());
    assert!(gaps.fold(0.0, f64::max) < 1e-14);
    assert!((V::from(free.center_of_mass()) - V::from(held.center_of_mass())).norm() < 1e-15);
}

#[test]
fn rings_that_cannot_be_are_refused() {
    let refused = |tube: Tube| -> ElementError {
        let carrier = parts::carrier(5.0, [0.0; 3], [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
        let assembly = Assembly::default().with(carrier).with(tube);
        assembly.check().into_iter().next().expect("a ring that is refused")
    };
    let wide = refused(Tube { tube_radius: 0.03, ..mercury() });
    assert!(matches!(wide.problem, Problem::Tube(TubeError::Thick { .. })), "{wide:?}");
    let along = refused(Tube { towards: Some([0.0, 0.0, -2.0]), ..mercury() });
    assert!(matches!(along.problem, Problem::Tube(TubeError::AlongAxis)), "{along:?}");
    let full = refused(Tube { contents: TankContents::Mass(1.0), ..mercury() });
    assert!(matches!(full.problem, Problem::Tank(TankError::Overfull { .. })), "{full:?}");
    let fill = refused(Tube { contents: TankContents::Fill(1.0), ..mercury() });
    assert!(matches!(fill.problem, Problem::Tank(TankError::Fill { .. })), "{fill:?}");
    let thin = refused(Tube { viscosity: 0.0, ..mercury() });
    assert_eq!(thin.field, Field::VISCOSITY);
    let tiny = refused(Tube { viscosity: 1e-200, ..mercury() });
    assert!(matches!(tiny.problem, Problem::NotFinite { .. }), "{tiny:?}");
}
