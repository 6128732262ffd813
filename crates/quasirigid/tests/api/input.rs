//! Meaningless input is refused on entry, on both sides of each limit.

use std::f64::consts::{FRAC_PI_2, PI};
use std::panic::{AssertUnwindSafe, catch_unwind};

use quasirigid::averaging::{Evolution, EvolutionError, FreeRotation, FreeRotationError};
use quasirigid::dynamics::{
    Event, Forced, FullState, Options, PropagateError, Sample, Start, propagate, propagate_full,
};
use quasirigid::model::Mode;
use quasirigid::problems::ring_of_points;
use quasirigid::reduction::reduce;
use quasirigid_math::polynomial::{Homogeneous, Series};

const OMEGA: [f64; 3] = [0.2, -0.1, 0.9];
const TURNED: [f64; 4] = [0.5, -0.5, 0.5, 0.5];

fn refused(attitude: [f64; 4], events: Vec<Event>) -> Option<PropagateError> {
    let body = reduce(&ring_of_points(4).body().unwrap(), 3).unwrap();
    let options = Options { events, tolerance: 1e-6, ..Options::default() };
    let start = Start::new(OMEGA, attitude);
    propagate(&body, start, &[0.1], &options, &mut Vec::<Sample>::new()).err()
}

#[test]
fn attitudes_that_are_no_unit_quaternions_are_refused() {
    let longer = |by: f64| TURNED.map(|part| part * (1.0 + by));
    for attitude in [[0.0; 4], [f64::NAN; 4], [2.0, 0.0, 0.0, 0.0], longer(1.1e-6), longer(-1.1e-6)] {
        let error = refused(attitude, Vec::new());
        assert!(matches!(error, Some(PropagateError::Attitude { .. })), "{attitude:?}: {error:?}");
    }
    for attitude in [TURNED, longer(0.9e-6), longer(-0.9e-6)] {
        assert_eq!(refused(attitude, Vec::new()), None);
    }
}

#[test]
fn events_that_can_never_happen_are_refused() {
    let axis = [0.0, 1e-9, 0.0];
    let bad = [
        Event::Nutation { axis: [0.0; 3], angle: 0.1 },
        Event::Nutation { axis: [f64::NAN, 0.0, 1.0], angle: 0.1 },
        Event::Nutation { axis, angle: 1.001 * PI },
        Event::Nutation { axis, angle: -1e-9 },
        Event::Energy(f64::NAN),
        Event::Validity { slowest: 0.0, limit: 1.0 },
        Event::Validity { slowest: 1.0, limit: f64::INFINITY },
    ];
    for event in bad {
        let error = refused(TURNED, vec![Event::Energy(-1.0), event]);
        assert!(matches!(error, Some(PropagateError::Event { .. })), "{event:?}: {error:?}");
    }
    let good = [Event::Nutation { axis, angle: PI }, Event::Energy(-1.0)];
    assert_eq!(refused(TURNED, good.into()), None);
}

#[test]
fn full_states_that_are_no_numbers_are_refused() {
    let body = ring_of_points(4).body().unwrap();
    let good = FullState::at_rest(&body, OMEGA, TURNED);
    let run = |state: &FullState| {
        let options = Options { tolerance: 1e-6, ..Options::default() };
        propagate_full(Forced::not(&body), state, &[0.01], &options, &mut Vec::<Sample>::new()).err()
    };
    let mut bad = [good.clone(), good.clone()];
    bad[0].q[1] = f64::NAN;
    bad[1].rate[0] = f64::INFINITY;
    assert_eq!(
        bad.map(|state| run(&state)),
        [Some(PropagateError::NotFinite), Some(PropagateError::NotFinite)]
    );
    assert_eq!(run(&good), None);
}

#[test]
fn rotations_that_no_body_makes_are_refused() {
    use FreeRotationError as E;
    let moments = [0.31, 0.76, 1.0];
    let at = |G: f64, angle: f64| FreeRotation::at_nutation(moments, G, Mode::ShortAxis, angle);
    for angle in [0.0, FRAC_PI_2, 20.0, -0.1, f64::NAN] {
        assert!(matches!(at(2.0, angle), Err(E::Nutation { .. })), "{angle}");
    }
    for G in [-2.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(at(G, 0.3), Err(E::AngularMomentum { .. })), "{G}");
    }
    assert!(at(2.0, 0.999_999 * FRAC_PI_2).is_ok() && at(0.0, 1e-9).is_ok());
    for wrong in [[3.0, 2.0, 1.0], [1.0, 3.0, 2.0], [0.0, 1.0, 2.0], [-1.0, 1.0, 2.0], [f64::NAN; 3]] {
        assert!(matches!(FreeRotation::through(wrong, OMEGA), Err(E::Moments { .. })), "{wrong:?}");
        let found = FreeRotation::at_nutation(wrong, 1.0, Mode::ShortAxis, 0.3);
        assert!(matches!(found, Err(E::Moments { .. })), "{wrong:?}");
    }
    assert!(FreeRotation::through([1e-9; 3], OMEGA).is_ok());
    assert!(matches!(FreeRotation::through(moments, [f64::NAN, 0.0, 1.0]), Err(E::Omega { .. })));
    let oblate = FreeRotation::at_nutation([1.0, 1.0, 2.0], 1.0, Mode::LongAxis, 0.3);
    assert!(matches!(oblate, Err(E::Mode { .. })));
}

#[test]
fn evolutions_of_no_angular_momentum_are_refused() {
    let body = ring_of_points(4).body().unwrap();
    let reduced = reduce(&body, 3).unwrap();
    for G in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = Evolution::compute(&body, &reduced, G).err();
        assert!(matches!(error, Some(EvolutionError::AngularMomentum { .. })), "{G}");
    }
    assert!(Evolution::compute(&body, &reduced, 1e-12).is_ok());
}

fn panics<T>(what: impl FnOnce() -> T) -> bool {
    catch_unwind(AssertUnwindSafe(what)).is_err()
}

/// Indices out of range and maps of other shapes are errors of the program, and never a silent wrong sum.
#[test]
fn indices_and_shapes_out_of_range_panic() {
    let reduced = reduce(&ring_of_points(4).body().unwrap(), 4).unwrap();
    assert!(panics(|| reduced.mu(7)) && !panics(|| reduced.mu(6)));
    let tensor = |indices: &[usize]| panics(|| reduced.tensor(indices));
    assert!(tensor(&[]) && tensor(&[0]) && tensor(&[0, 3]) && tensor(&[0; 7]));
    assert!(!tensor(&[0, 1]) && !tensor(&[2; 6]));
    let mu = reduced.mu(4);
    assert!(panics(|| mu.row(3).len()) && !panics(|| mu.row(2).len()));
    assert!(panics(|| mu.add_value(OMEGA, &mut [0.0; 4])) && !panics(|| mu.add_value(OMEGA, &mut [0.0; 1])));
    assert!(panics(|| reduced.energy.vector(OMEGA)) && panics(|| reduced.K.scalar(OMEGA)));
    assert!(panics(|| Series::zero(3, 3).set(Homogeneous::zero(5, 3))));
    for (degree, rows) in [(4, 2), (5, 3), (3, 3), (4, 1)] {
        let other = Homogeneous::zero(degree, rows);
        assert!(panics(|| mu.clone().add_scaled(1.0, &other)), "{degree} {rows}");
    }
    let (one, five) = (Homogeneous::zero(1, 1), Homogeneous::zero(5, 3));
    assert!(panics(|| one.cross(&mu)) && panics(|| one.dot(&mu)) && panics(|| mu.contracted(&[[1.0; 3]; 2])));
    assert!(panics(|| mu.clone().add_row(0, 1.0, (&five, 0))));
}
