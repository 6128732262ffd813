//! Checkpoints: a propagation that goes on from one gives the bits of one that never stopped, by every method and form.

use proptest::prelude::*;
use quasirigid::dynamics::{
    Checkpoint, Event, Forced, Form, FullState, Method, Observer, Options, Outcome, PropagateError, Run,
    Sample, SlowEquations, SlowState, Start, propagate, propagate_controlled, propagate_forced,
    propagate_full,
};
use quasirigid::elements::Assembly;
use quasirigid::model::control::{
    Actuator, ControlLaw, Controller, Input, LinearLaw, Measurement, Output, Sampling,
};
use quasirigid::model::force::{Axes, Force, ForceLaw, Wave};
use quasirigid::model::{FlexibleBody, Support};
use quasirigid::problems::AxialMass;
use quasirigid::reduction::reduce;
use quasirigid_math::rotation::ALIGNED;

use super::wobbler::{assembly, times_to};
use crate::support::{assemblies, cases};

const AXIAL: AxialMass = AxialMass { carrier: 7.0, A: 1.0, C: 1.5, m: 0.1, rho: 0.5, c: 4e4, b: 3e2 };

/// What a propagation tells: everything, and its checkpoints.
#[derive(Clone, Debug, Default)]
struct Told {
    samples: Vec<Sample>,
    coordinates: Vec<[Vec<f64>; 2]>,
    budget: Vec<(String, f64)>,
    checkpoints: Vec<(usize, Checkpoint)>,
    resumes: Option<Checkpoint>,
}

impl Observer for Told {
    fn sample(&mut self, sample: &Sample) {
        self.samples.push(*sample);
    }

    fn keeps_coordinates(&self) -> bool {
        true
    }

    fn coordinates(&mut self, q: &[f64], rate: &[f64]) {
        self.coordinates.push([q.to_vec(), rate.to_vec()]);
    }

    fn budget(&mut self, energies: &[(String, f64)]) {
        self.budget = energies.to_vec();
    }

    fn resumes(&mut self) -> Option<Checkpoint> {
        self.resumes.take()
    }

    fn wants_checkpoint(&self) -> bool {
        true
    }

    fn checkpoint(&mut self, checkpoint: Checkpoint) {
        let read_back = Checkpoint::from_words(checkpoint.words().to_vec());
        self.checkpoints.push((self.samples.len(), read_back));
    }
}

type Propagation<'a> = dyn Fn(&mut Told) -> Result<Run, PropagateError> + 'a;

/// Runs through, then from each checkpoint and from those of the runs that went on, and compares all bits. Returns the number of
/// checkpoints.
fn assert_resumes(propagation: &Propagation<'_>) -> usize {
    let mut whole = Told::default();
    let run = propagation(&mut whole).unwrap();
    let resumed = |(rows, checkpoint): &(usize, Checkpoint)| {
        let mut rest = Told { resumes: Some(checkpoint.clone()), ..Told::default() };
        let again = propagation(&mut rest).unwrap();
        assert_eq!(format!("{again:?}"), format!("{run:?}"), "from row {rows}");
        assert_eq!(rest.samples, whole.samples[*rows..], "from row {rows}");
        assert_eq!(rest.coordinates, whole.coordinates[*rows..]);
        assert_eq!(rest.budget, whole.budget);
        rest.checkpoints
            .into_iter()
            .map(|(further, checkpoint)| (rows + further, checkpoint))
            .collect::<Vec<_>>()
    };
    let others: Vec<_> = whole.checkpoints.iter().flat_map(resumed).collect();
    others.iter().step_by(5).for_each(|checkpoint| drop(resumed(checkpoint)));
    whole.checkpoints.len() + others.len()
}

fn options(method: Method, form: Form) -> Options {
    Options { tolerance: 1e-9, method, form, ..Options::default() }
}

fn spun(body: &FlexibleBody) -> Start {
    let slowest = quasirigid::reduction::frequencies(body).unwrap()[0];
    Start::new([0.02, 0.013, 0.05].map(|part| part * slowest), ALIGNED)
}

proptest! {
    #![proptest_config(cases(6))]

    #[test]
    fn full_and_reduced_systems_go_on_with_the_same_bits(assembly in assemblies()) {
        let body = Assembly { support: Support::Free, ..assembly }.body().unwrap();
        prop_assume!(body.elastic() > 0);
        let start = spun(&body);
        let times = times_to(3.0 / start.omega[2], 40);
        let settled = start.settled(Forced::not(&body), 1).unwrap();
        for method in [Method::Explicit, Method::Implicit, Method::Automatic] {
            let options = options(method, Form::AngularMomentum);
            assert_resumes(&|told| propagate_full(Forced::not(&body), &settled, &times, &options, told));
        }
        let reduced = reduce(&body, 3).unwrap();
        for form in [Form::AngularMomentum, Form::AngularVelocity] {
            let options = options(Method::Automatic, form);
            assert_resumes(&|told| propagate(&reduced, start, &times, &options, told));
        }
    }
}

/// Long enough for changes of method, evaluations of the linear part and the event at the end.
#[test]
fn stiff_run_with_an_event_goes_on_with_the_same_bits() {
    let body = AXIAL.assembly().body().unwrap();
    let start = Start::new([0.3, 0.1, 1.0], ALIGNED);
    let settled = start.settled(Forced::not(&body), 3).unwrap();
    let times = times_to(400.0, 300);
    let mut whole = Told::default();
    let free = options(Method::Automatic, Form::AngularMomentum);
    let run = propagate_full(Forced::not(&body), &settled, &times, &free, &mut whole).unwrap();
    assert!(run.work.implicit_steps > 0);
    let level = whole.samples[250].energy;
    let options = Options { events: vec![Event::Energy(level)], ..free };
    let outcome = propagate_full(Forced::not(&body), &settled, &times, &options, &mut Told::default());
    assert_eq!(outcome.unwrap().outcome, Outcome::Event(Event::Energy(level)));
    let count = assert_resumes(&|told| propagate_full(Forced::not(&body), &settled, &times, &options, told));
    assert!(count > 5, "{count} checkpoints");
}

/// The linear part of this body changes with the angles of its hinges.
#[test]
fn implicit_run_of_a_hinged_body_goes_on_with_the_same_bits() {
    let body = assembly().body().unwrap();
    assert!(body.paths().is_some());
    let start = Start::new([0.5, -0.3, 0.9], ALIGNED);
    let settled = start.settled(Forced::not(&body), 1).unwrap();
    let options = options(Method::Implicit, Form::AngularMomentum);
    let times = times_to(60.0, 200);
    let mut whole = Told::default();
    let run = propagate_full(Forced::not(&body), &settled, &times, &options, &mut whole).unwrap();
    assert!(run.work.factorizations > 2 && run.work.factorizations < run.work.steps, "{:?}", run.work);
    let count = assert_resumes(&|told| propagate_full(Forced::not(&body), &settled, &times, &options, told));
    assert!(count > 4, "{count} checkpoints");
}

#[test]
fn forced_run_goes_on_with_the_same_bits() {
    let body = AXIAL.assembly().body().unwrap();
    let wave = Wave { frequency: 0.7, phase: 0.2 };
    let law = ForceLaw::Torque { torque: [0.02, -0.01, 0.03], axes: Axes::Body, wave };
    let forces = [Force { name: "torque".into(), law }];
    let system = Forced { body: &body, forces: &forces };
    let start = Start::new([0.3, 0.1, 1.0], ALIGNED);
    let times = times_to(60.0, 100);
    let still =
        SlowState { angular_momentum: [0.0; 3], attitude: ALIGNED, place: [0.0; 3], velocity: [0.0; 3] };
    let slow = still.with_spin(system, 3, start.omega).unwrap();
    for form in [Form::AngularMomentum, Form::AngularVelocity] {
        let options = options(Method::Automatic, form);
        assert!(
            assert_resumes(&|told| propagate_forced(
                SlowEquations::series(system, 3),
                &slow,
                &times,
                &options,
                told
            )) > 3
        );
    }
}

#[test]
fn checkpoint_of_another_propagation_is_refused() {
    let (one, other) =
        (AXIAL.assembly().body().unwrap(), quasirigid::problems::ring_of_points(4).body().unwrap());
    let start = Start::new([0.3, 0.1, 1.0], ALIGNED);
    let options = options(Method::Explicit, Form::AngularMomentum);
    let times = times_to(10.0, 20);
    let mut told = Told::default();
    let settled = start.settled(Forced::not(&one), 1).unwrap();
    propagate_full(Forced::not(&one), &settled, &times, &options, &mut told).unwrap();
    let mut foreign = Told { resumes: Some(told.checkpoints[0].1.clone()), ..Told::default() };
    let settled = start.settled(Forced::not(&other), 1).unwrap();
    let refused = propagate_full(Forced::not(&other), &settled, &times, &options, &mut foreign);
    assert_eq!(refused.unwrap_err(), PropagateError::Checkpoint);
    for words in [vec![], vec![3], vec![u64::MAX; 40]] {
        let mut broken = Told { resumes: Some(Checkpoint::from_words(words)), ..Told::default() };
        let refused = propagate_full(Forced::not(&other), &settled, &times, &options, &mut broken);
        assert_eq!(refused.unwrap_err(), PropagateError::Checkpoint);
    }
}

/// Samples with noise, commands that wait, and a state of a continuous law on a flexible body.
#[test]
fn run_under_controllers_goes_on_with_the_same_bits() {
    let input = |axis| Input {
        of: Measurement::Rate { axis },
        reference: 0.0,
        deadband: 0.0,
        quantum: 1e-4,
        noise: 0.01,
    };
    let output = |axis| Output { to: Actuator::Torque { axis }, limit: Some(0.02) };
    let law = |gain: f64, step: f64| {
        ControlLaw::Linear(LinearLaw {
            A: vec![vec![0.9 * step]],
            B: vec![vec![0.1]],
            C: vec![vec![gain]],
            D: vec![vec![-0.02]],
            E: vec![Vec::new()],
        })
    };
    let sampled = Controller {
        name: "sampled".into(),
        inputs: vec![input(2)],
        law: law(-0.3, 1.0),
        outputs: vec![output(0)],
        start: vec![0.0],
        sampling: Some(Sampling { period: 0.3, delay: 0.7, seed: 11 }),
    };
    let continuous = Controller {
        name: "continuous".into(),
        inputs: vec![Input { quantum: 0.0, noise: 0.0, ..input(1) }],
        law: law(0.2, -1.0),
        outputs: vec![output(1)],
        start: vec![0.3],
        sampling: None,
    };
    let assembly =
        Assembly { controllers: vec![sampled, continuous], ..quasirigid::problems::ring_of_points(2) };
    let built = assembly.build().unwrap();
    let system = Forced::not(&built.body);
    let start = FullState::at_rest(&built.body, [0.1, -0.2, 0.6], ALIGNED);
    let times = times_to(6.0, 40);
    for method in [Method::Explicit, Method::Implicit] {
        let options = options(method, Form::AngularMomentum);
        let run =
            |told: &mut Told| propagate_controlled(system, &built.controls, &start, &times, &options, told);
        assert!(assert_resumes(&run) > 0);
        let seeded = |seed| {
            let mut controls = built.controls.clone();
            controls.controllers[0].sampling = Some(Sampling { period: 0.3, delay: 0.7, seed });
            let mut told = Told::default();
            propagate_controlled(system, &controls, &start, &times, &options, &mut told).unwrap();
            told.samples
        };
        assert_eq!(seeded(11), seeded(11));
        assert_ne!(seeded(11)[39], seeded(12)[39]);
    }
}
