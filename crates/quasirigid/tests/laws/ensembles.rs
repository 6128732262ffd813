//! Trajectories in lanes have the bits that each has alone, whatever runs beside them and however long.

use proptest::prelude::*;
use quasirigid::dynamics::{Form, Options, Outcome, Rounding, SpinPath, spin_path, spin_paths};
use quasirigid::model::ReducedBody;
use quasirigid::prelude::*;
use quasirigid::problems::QuarticQuintic;
use quasirigid::reduction::Vibrations;

use crate::support::{bodies, cases, direction};

/// Starts of unlike rates, so that lanes take unlike steps and end at unlike moments, with some that are none.
fn starts(u: [f64; 3], rate: f64) -> Vec<[f64; 3]> {
    let mut starts: Vec<[f64; 3]> = (0..21)
        .map(|i| {
            let size = rate * 10f64.powf(f64::from(i % 7) / 3.0 - 2.0);
            let turned = [u[i as usize % 3], u[(i as usize + 1) % 3], -u[(i as usize + 2) % 3]];
            turned.map(|x| size * x)
        })
        .collect();
    starts[4] = [0.0; 3];
    starts[13] = [f64::NAN, 0.0, 1.0];
    starts
}

fn assert_alone(body: &ReducedBody, starts: &[[f64; 3]], times: &[f64], options: &Options) {
    let together = spin_paths(body, starts, times, options, &mut |_| true);
    assert_eq!(together.len(), starts.len());
    for (omega, path) in starts.iter().zip(&together) {
        let alone = spin_path(body, *omega, times, options);
        // NaN in a refusal is unequal to itself
        assert_eq!(path.as_ref().ok(), alone.as_ref().ok(), "{omega:?} {options:?}");
        assert_eq!(path.is_err(), alone.is_err());
    }
}

proptest! {
    #![proptest_config(cases(12))]

    #[test]
    fn lanes_have_the_bits_of_single_trajectories(assembly in bodies(), u in direction(), order in 1..6usize, paper in any::<bool>(), exact in any::<bool>()) {
        let body = assembly.body().unwrap();
        let frequency = Vibrations::compute(&body).unwrap().frequencies[0];
        let body = reduce(&body, order).unwrap();
        let form = if paper { Form::AngularVelocity } else { Form::AngularMomentum };
        let rounding = if exact { Rounding::Reproducible } else { Rounding::Fastest };
        let rate = 0.1 * frequency;
        let times = [0.0, 0.3, 0.31, 7.0, 40.0].map(|turns| turns / rate);
        for most_steps in [Options::default().most_steps, 9, 0] {
            let options = Options { form, rounding, tolerance: 1e-11, most_steps, ..Options::default() };
            assert_alone(&body, &starts(u, rate), &times, &options);
        }
    }
}

#[test]
fn a_trajectory_that_runs_away_fails_alone() {
    let problem = QuarticQuintic::published();
    let mut starts = vec![problem.omega; 11];
    starts[3] = [90.0, 200.0, 100.0];
    starts[10] = [-900.0, 200.0, 100.0];
    let options = Options { form: Form::AngularVelocity, tolerance: 1e-10, ..Options::default() };
    assert_alone(&problem.body, &starts, &[10.0, 20.0], &options);
    let paths = spin_paths(&problem.body, &starts, &[10.0, 20.0], &options, &mut |_| true);
    let outcomes: Vec<bool> =
        paths.iter().map(|path| matches!(path, Ok(SpinPath { outcome: Outcome::Failed(_), .. }))).collect();
    assert!(
        outcomes[3] && outcomes[10] && outcomes.iter().filter(|failed| **failed).count() == 2,
        "{paths:?}"
    );
}

#[test]
fn an_ensemble_can_be_interrupted() {
    let problem = QuarticQuintic::published();
    let options = Options { form: Form::AngularVelocity, ..Options::default() };
    let mut asked = 0;
    let mut stop = |_: usize| {
        asked += 1;
        asked < 2
    };
    let paths = spin_paths(&problem.body, &[problem.omega; 30], &[100.0, 1000.0], &options, &mut stop);
    let interrupted: Vec<_> =
        paths.iter().flatten().filter(|path| path.outcome == Outcome::Interrupted).collect();
    assert!(asked == 2 && (1..30).contains(&interrupted.len()), "{asked} {}", interrupted.len());
    assert!(interrupted.iter().any(|path| path.omega.is_empty()));
    assert!(
        paths
            .iter()
            .flatten()
            .filter(|path| path.outcome == Outcome::Finished)
            .all(|path| path.omega.len() == 2)
    );
}

#[test]
fn lanes_keep_the_error_of_the_published_reference() {
    let problem = QuarticQuintic::published();
    let times: Vec<f64> = problem.reference.iter().map(|(t, _)| *t).collect();
    for rounding in [Rounding::Fastest, Rounding::Reproducible] {
        let options =
            Options { form: Form::AngularVelocity, tolerance: 1e-11, rounding, ..Options::default() };
        let paths = spin_paths(&problem.body, &[problem.omega; 9], &times, &options, &mut |_| true);
        for path in paths {
            let omega = path.unwrap().omega;
            let gaps = omega
                .iter()
                .zip(&problem.reference)
                .flat_map(|(omega, (_, known))| (0..3).map(move |i| (omega[i] - known[i]).abs()));
            let worst = gaps.fold(0.0, f64::max);
            assert!(omega.len() == times.len() && worst < 5e-9, "{worst:e}");
        }
    }
}
