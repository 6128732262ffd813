//! Place of the body: the pole beside the centre of mass. (P7)

use std::ops::ControlFlow;

use nalgebra::Vector3;
use quasirigid::dynamics::{
    Forced, Form, FullState, Observer, Options, Sample, SlowEquations, SlowState, Start, propagate,
    propagate_forced, propagate_full,
};
use quasirigid::elements::{ApplicationPoint, Assembly, End};
use quasirigid::model::force::{Force, ForceLaw};
use quasirigid::reduction::reduce;
use quasirigid_math::vec3::{add, norm, scale};

use super::wobbler::{assembly, attitude, inertial, times_to};
use crate::support::parts;
use crate::support::sprung_body;

type V = Vector3<f64>;

const OMEGA: [f64; 3] = [0.5, 0.7, 0.9];
const PLACE: [f64; 3] = [3.0, -2.0, 7.0];
const VELOCITY: [f64; 3] = [0.4, 0.1, -0.3];

/// Two masses off every axis of a carrier off its origin.
fn body(forces: bool) -> Assembly {
    let carrier =
        parts::carrier(3.0, [0.1, -0.2, 0.05], [[1.9, 0.3, -0.2], [0.3, 2.2, 0.5], [-0.2, 0.5, 2.4]]);
    let sprung =
        |mass, position, stiffness| parts::sprung(mass, position, stiffness, scale(0.012, stiffness));
    let masses = [
        sprung(0.5, [0.9, 0.3, 0.4], [200.0, 300.0, 250.0]),
        sprung(0.3, [-0.5, 0.8, -0.6], [150.0, 180.0, 130.0]),
    ];
    let drag = |on| ForceLaw::Drag {
        at: ApplicationPoint { on, at: matches!(on, End::Carrier).then_some([0.4, 0.3, -0.2]) },
        coefficient: 0.2,
    };
    let laws = if forces { vec![drag(End::Carrier), drag(End::Point(1))] } else { Vec::new() };
    let forces = laws.into_iter().map(|law| Force { name: "drag".into(), law }).collect();
    Assembly { forces, ..sprung_body(carrier, &masses) }
}

/// Samples with the coordinates that belong to them.
#[derive(Default)]
struct Both(Vec<(Vec<f64>, Sample)>, Vec<f64>);

impl Observer for Both {
    fn keeps_coordinates(&self) -> bool {
        true
    }

    fn coordinates(&mut self, q: &[f64], _: &[f64]) {
        self.1 = q.to_vec();
    }

    fn sample(&mut self, sample: &Sample) {
        self.0.push((std::mem::take(&mut self.1), *sample));
    }

    fn progress(&mut self, _: f64) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

/// Centre of mass of the displaced parts, piece by piece, with the pole of the sample.
fn center(assembly: &Assembly, q: &[f64], sample: &Sample) -> V {
    let carrier = assembly.carrier.as_ref().unwrap();
    let rest = std::iter::once((carrier.mass, V::from(carrier.center_of_mass), V::zeros()));
    let points = assembly.points.iter().zip(q.chunks(3));
    let points = points.map(|(point, q)| (point.mass, V::from(point.position), V::from_column_slice(q)));
    let pole = V::from(assembly.body().unwrap().pole());
    let (mass, moment) = rest
        .chain(points)
        .fold((0.0, V::zeros()), |(mass, moment), (m, place, r)| (mass + m, moment + m * (place + r - pole)));
    V::from(sample.pole) + V::from(inertial(sample.attitude, (moment / mass).into()))
}

/// Full and reduced, free and under drags, in both forms: the parts are displaced about the pole so that their centre of mass is the place
/// of the sample. Without forces that place moves evenly.
#[test]
fn parts_displaced_about_the_pole_have_their_centre_of_mass_at_the_place() {
    let options = |form| Options { form, tolerance: 1e-12, ..Options::default() };
    let attitude = attitude();
    let times = times_to(8.0, 5);
    for forces in [false, true] {
        let assembly = body(forces);
        let (body, forces) = (assembly.body().unwrap(), assembly.forces().unwrap());
        let system = Forced { body: &body, forces: &forces };
        let start = Start { omega: OMEGA, attitude, place: PLACE, velocity: VELOCITY };
        let full: FullState = start.settled(system, 3).unwrap();
        let mut runs = [Both::default(), Both::default(), Both::default()];
        propagate_full(system, &full, &times, &options(Form::AngularMomentum), &mut runs[0]).unwrap();
        for (run, form) in runs[1..].iter_mut().zip([Form::AngularMomentum, Form::AngularVelocity]) {
            if forces.is_empty() {
                let spin = Start { omega: OMEGA, attitude, place: PLACE, velocity: VELOCITY };
                propagate(&reduce(&body, 3).unwrap(), spin, &times, &options(form), run).unwrap();
            } else {
                let still =
                    SlowState { angular_momentum: [0.0; 3], attitude, place: PLACE, velocity: VELOCITY };
                let slow = still.with_spin(system, 3, OMEGA).unwrap();
                propagate_forced(SlowEquations::series(system, 3), &slow, &times, &options(form), run)
                    .unwrap();
            }
        }
        for (number, Both(rows, _)) in runs.iter().enumerate() {
            for (q, sample) in rows {
                let gap = (center(&assembly, q, sample) - V::from(sample.place)).norm();
                assert!(gap < 1e-13 * norm(sample.place), "{number}, t = {}: {gap:e}", sample.t);
                let apart = norm(add(sample.pole, scale(-1.0, sample.place)));
                assert!(apart > 1e-4, "the pole is {apart:e} m from the centre of mass");
                if forces.is_empty() {
                    let even = add(PLACE, scale(sample.t, VELOCITY));
                    let gap = norm(add(sample.place, scale(-1.0, even)));
                    assert!(gap < 1e-12 * norm(even) && sample.velocity == VELOCITY, "{number}: {gap:e}");
                }
            }
        }
    }
}

/// Paper, (1.15): `m* R̈₀ = φ`, the left side from differences of the history, on a body with curved paths.
#[test]
fn the_pole_accelerates_as_its_force_says() {
    let assembly = assembly();
    let reduced = reduce(&assembly.body().unwrap(), 9).unwrap();
    let h = 0.02;
    let times: Vec<f64> = (0..7).map(|i| 1.0 + h * f64::from(i)).collect();
    let spin = Start { place: [0.3, 0.2, 0.1], velocity: VELOCITY, ..Start::new(OMEGA, attitude()) };
    let mut samples: Vec<Sample> = Vec::new();
    let options = Options { tolerance: 1e-14, ..Options::default() };
    propagate(&reduced, spin, &times, &options, &mut samples).unwrap();
    let weights = [2.0, -27.0, 270.0, -490.0, 270.0, -27.0, 2.0].map(|weight| weight / (180.0 * h * h));
    let parts = samples.iter().zip(weights);
    let second = parts.fold([0.0; 3], |sum, (sample, weight)| add(sum, scale(weight, sample.pole)));
    let middle = &samples[3];
    let force = inertial(middle.attitude, reduced.phi.vector(middle.omega));
    let gap = norm(add(scale(reduced.mass, second), scale(-1.0, force)));
    println!("{second:?} {force:?} {gap:e}");
    assert!(gap < 1e-6 * norm(force), "{gap:e} of {:e}", norm(force));
}

/// The pole of the reduced motion is as accurate as its spin: its error falls as `ε^{p+1}`.
#[test]
fn the_pole_is_right_to_the_order() {
    for p in 2..=4 {
        let errors = [0.25, 0.125].map(|epsilon| {
            let body = body(false).body().unwrap().stiffened(epsilon).unwrap();
            let start = Start::new(OMEGA, attitude());
            let full = start.settled(Forced::not(&body), p).unwrap();
            let reduced = reduce(&body, p).unwrap();
            let spin = Start::new(reduced.Omega.vector(full.angular_momentum(&body)), full.attitude);
            let (mut truth, mut samples): (Vec<Sample>, Vec<Sample>) = Default::default();
            let options = Options { tolerance: 1e-14, ..Options::default() };
            let times = times_to(6.0, 12);
            propagate_full(Forced::not(&body), &full, &times, &options, &mut truth).unwrap();
            propagate(&reduced, spin, &times, &options, &mut samples).unwrap();
            let gap = |(a, b): (&Sample, &Sample)| norm(add(a.pole, scale(-1.0, b.pole)));
            truth.iter().zip(&samples).map(gap).fold(0.0, f64::max)
        });
        let order = (errors[0] / errors[1]).log2();
        println!("p = {p}: {errors:?} {order:.3}");
        assert!((order - (p + 1) as f64).abs() < 0.3, "p = {p}: {order}");
    }
}
