//! Table of decisions: rows of criteria, and the methods that are tried for them in order.

use super::Method::{
    Average, FullSystem, LevelCurves, MicroRuns, ModalRates, PeriodicMotions, SpinManifold, SpinningFrame,
};
use super::{
    Criteria, Decision, GrowingVibration, GyrostatCriteria, Last, Limits, Method, Reason, UnknownLiquid,
    choose, choose_for_gyrostat, try_in_order,
};
use super::{Stop, Work};
use crate::averaging::PowerSource::{Harmonics, Polynomial};
use crate::secular::AverageCriteria;

/// A small body of moderate spin on a long way about one axis.
fn body() -> Criteria {
    Criteria {
        first_power: Polynomial,
        power_asked: false,
        unknown_liquids: Vec::new(),
        parametric: None,
        spinning_frame: true,
        spin_ratio: Some(0.05),
        moments_change: 0.0,
        equal_moments: false,
        level_equations: false,
        internal_rotation: false,
        viscoelastic: false,
        left_out: 0.0,
        decay_per_period: 1e-4,
        internal_growth: false,
        revolutions: Some(1e6),
        coordinates: 3,
        between_axes: false,
    }
}

/// A body whose elasticity changes its moments.
fn bent() -> Criteria {
    Criteria { moments_change: 0.02, level_equations: true, ..body() }
}

/// A body of revolution.
fn turned() -> Criteria {
    Criteria { equal_moments: true, level_equations: true, ..body() }
}

fn liquid() -> UnknownLiquid {
    UnknownLiquid { cavity: "tank".into(), reynolds: 1e6 }
}

fn vibration() -> GrowingVibration {
    GrowingVibration { coordinate: "boom".into(), frequency: 2.0, rate: 0.1, wobble: 0.3 }
}

const AVERAGES: [Method; 3] = [Average(Polynomial), Average(Harmonics), SpinningFrame];

/// Trials of a free choice, behind the averages, with the last method.
fn behind(criteria: &Criteria) -> (Vec<Method>, Last) {
    let Decision { trials, last, asked } = choose(criteria, None, &Limits::default());
    assert!(!asked);
    assert_eq!(trials[..3], AVERAGES);
    (trials[3..].to_vec(), last)
}

#[test]
fn averages_come_first() {
    let trials = |criteria: Criteria| choose(&criteria, None, &Limits::default()).trials;
    let rows: [(Criteria, &[Method]); 8] = [
        (body(), &[Average(Polynomial), Average(Harmonics), SpinningFrame, SpinManifold, PeriodicMotions]),
        (
            Criteria { first_power: Harmonics, ..body() },
            &[Average(Harmonics), SpinningFrame, SpinManifold, PeriodicMotions],
        ),
        (Criteria { power_asked: true, ..body() }, &[Average(Polynomial), SpinManifold, PeriodicMotions]),
        (
            Criteria { power_asked: true, first_power: Harmonics, ..body() },
            &[Average(Harmonics), SpinManifold, PeriodicMotions],
        ),
        (
            Criteria { spinning_frame: false, ..body() },
            &[Average(Polynomial), Average(Harmonics), SpinManifold, PeriodicMotions],
        ),
        (
            Criteria { coordinates: 150, ..body() },
            &[Average(Polynomial), Average(Harmonics), SpinningFrame, SpinManifold],
        ),
        (
            Criteria { coordinates: 151, spinning_frame: false, ..body() },
            &[Average(Polynomial), Average(Harmonics)],
        ),
        (Criteria { parametric: Some(vibration()), ..body() }, &[SpinManifold, PeriodicMotions]),
    ];
    for (criteria, expected) in rows {
        assert_eq!(trials(criteria.clone()), expected, "{criteria:?}");
    }
}

#[test]
fn other_methods_come_behind_the_averages() {
    let last = Last::Method;
    let rows: [(Criteria, &[Method], Last); 24] = [
        (body(), &[SpinManifold, PeriodicMotions], last(MicroRuns)),
        (Criteria { revolutions: Some(3_000.0), ..body() }, &[SpinManifold], last(FullSystem)),
        (
            Criteria { revolutions: Some(3_001.0), ..body() },
            &[SpinManifold, PeriodicMotions, MicroRuns],
            last(FullSystem),
        ),
        (
            Criteria { revolutions: Some(2e5), ..body() },
            &[SpinManifold, PeriodicMotions, MicroRuns],
            last(FullSystem),
        ),
        (Criteria { revolutions: Some(2.1e5), ..body() }, &[SpinManifold, PeriodicMotions], last(MicroRuns)),
        (Criteria { coordinates: 41, ..body() }, &[SpinManifold], last(MicroRuns)),
        (Criteria { between_axes: true, ..body() }, &[PeriodicMotions], last(MicroRuns)),
        (
            Criteria { between_axes: true, revolutions: Some(1e4), ..body() },
            &[PeriodicMotions, MicroRuns],
            last(FullSystem),
        ),
        (Criteria { decay_per_period: 0.051, ..body() }, &[SpinManifold], last(FullSystem)),
        (Criteria { decay_per_period: 0.05, ..body() }, &[SpinManifold, PeriodicMotions], last(MicroRuns)),
        (
            Criteria { decay_per_period: f64::INFINITY, revolutions: None, ..body() },
            &[SpinManifold],
            last(FullSystem),
        ),
        (Criteria { internal_growth: true, ..body() }, &[SpinManifold], last(FullSystem)),
        (Criteria { revolutions: None, ..body() }, &[SpinManifold], Last::Refused(Reason::UnknownLength)),
        (
            Criteria { revolutions: None, between_axes: true, ..body() },
            &[],
            Last::Refused(Reason::UnknownLength),
        ),
        (Criteria { left_out: 0.02, ..body() }, &[SpinManifold, PeriodicMotions], last(MicroRuns)),
        (Criteria { left_out: 0.021, ..body() }, &[], last(ModalRates)),
        (Criteria { left_out: f64::INFINITY, decay_per_period: 1.0, ..body() }, &[], last(ModalRates)),
        (Criteria { spin_ratio: Some(0.16), ..turned() }, &[SpinManifold, PeriodicMotions], last(MicroRuns)),
        (Criteria { left_out: 0.5, ..turned() }, &[], last(ModalRates)),
        (bent(), &[], last(LevelCurves)),
        (Criteria { spin_ratio: Some(0.16), ..bent() }, &[SpinManifold, PeriodicMotions], last(MicroRuns)),
        (Criteria { spin_ratio: None, ..bent() }, &[SpinManifold, PeriodicMotions], last(MicroRuns)),
        (Criteria { internal_rotation: true, ..bent() }, &[SpinManifold, PeriodicMotions], last(MicroRuns)),
        (Criteria { level_equations: false, ..bent() }, &[SpinManifold, PeriodicMotions], last(MicroRuns)),
    ];
    for (criteria, trials, last) in rows {
        assert_eq!(behind(&criteria), (trials.to_vec(), last), "{criteria:?}");
    }
    let viscoelastic = Criteria { viscoelastic: true, left_out: 0.5, ..bent() };
    assert_eq!(behind(&viscoelastic), (vec![], last(ModalRates)), "the level curves have no loss of it");
    let resonant = Criteria { parametric: Some(vibration()), ..bent() };
    assert_eq!(choose(&resonant, None, &Limits::default()), Decision::unasked(vec![], LevelCurves));
}

#[test]
fn level_curves_come_first_for_a_body_of_revolution() {
    let Decision { trials, last, asked } = choose(&turned(), None, &Limits::default());
    assert_eq!(trials, [&[LevelCurves], &AVERAGES[..], &[SpinManifold, PeriodicMotions]].concat());
    assert_eq!((last, asked), (Last::Method(MicroRuns), false));
}

#[test]
fn a_method_that_is_asked_for_is_the_only_one() {
    let limits = Limits::default();
    for criteria in [body(), bent(), Criteria { revolutions: None, parametric: Some(vibration()), ..body() }]
    {
        for method in [
            Average(Polynomial),
            Average(Harmonics),
            ModalRates,
            SpinManifold,
            PeriodicMotions,
            MicroRuns,
            FullSystem,
        ] {
            assert_eq!(choose(&criteria, Some(method), &limits), Decision::asked(method));
        }
    }
    assert_eq!(choose(&body(), Some(LevelCurves), &limits), Decision::asked(LevelCurves));
    let fast = Criteria { spin_ratio: Some(0.16), ..bent() };
    for criteria in
        [fast, Criteria { internal_rotation: true, ..bent() }, Criteria { viscoelastic: true, ..bent() }]
    {
        assert_eq!(choose(&criteria, Some(LevelCurves), &limits), Decision::refused(Reason::NotOnLevels));
    }
    let incomplete = Criteria { left_out: 0.3, ..body() };
    for method in [SpinManifold, PeriodicMotions, MicroRuns, FullSystem] {
        let refusal = Decision::refused(Reason::LossesLeftOut { share: 0.3 });
        assert_eq!(choose(&incomplete, Some(method), &limits), refusal);
    }
    for method in [Average(Harmonics), ModalRates] {
        assert_eq!(choose(&incomplete, Some(method), &limits), Decision::asked(method));
    }
}

#[test]
fn liquids_of_unknown_response_refuse_every_method() {
    let criteria = Criteria { unknown_liquids: vec![liquid()], ..bent() };
    let refusal = Decision::refused(Reason::UnknownLiquidResponse(vec![liquid()]));
    for asked in [None, Some(Average(Polynomial)), Some(FullSystem), Some(ModalRates)] {
        assert_eq!(choose(&criteria, asked, &Limits::default()), refusal);
    }
}

#[test]
fn momentum_wheels_have_an_order_of_their_own() {
    let body = GyrostatCriteria {
        spin_ratio: 0.05,
        internal_rotation: false,
        viscoelastic: false,
        left_out: 0.0,
        settled: true,
        coordinates: 3,
    };
    let incomplete = GyrostatCriteria { left_out: 0.5, ..body };
    let above = GyrostatCriteria { settled: false, ..body };
    let free = |trials: &[Method]| Decision::unasked(trials.to_vec(), FullSystem);
    let rows = [
        (body, None, free(&[LevelCurves, SpinManifold])),
        (GyrostatCriteria { spin_ratio: 0.1, ..body }, None, free(&[SpinManifold])),
        (GyrostatCriteria { spin_ratio: f64::NAN, ..body }, None, free(&[SpinManifold])),
        (GyrostatCriteria { internal_rotation: true, ..body }, None, free(&[SpinManifold])),
        (GyrostatCriteria { viscoelastic: true, ..body }, None, free(&[SpinManifold])),
        (above, None, free(&[LevelCurves])),
        (GyrostatCriteria { coordinates: 151, ..body }, None, free(&[LevelCurves])),
        (incomplete, None, Decision::asked(ModalRates)),
        (incomplete, Some(FullSystem), Decision::asked(ModalRates)),
        (incomplete, Some(Average(Polynomial)), Decision::asked(LevelCurves)),
        (incomplete, Some(MicroRuns), Decision::refused(Reason::ShortRunsWithWheels)),
        (body, Some(PeriodicMotions), Decision::refused(Reason::ShortRunsWithWheels)),
        (above, Some(SpinManifold), Decision::refused(Reason::ManifoldThroughSeparatrix)),
        (above, Some(FullSystem), Decision::asked(FullSystem)),
        (body, Some(SpinManifold), Decision::asked(SpinManifold)),
        (body, Some(ModalRates), Decision::asked(ModalRates)),
    ];
    for (criteria, asked, expected) in rows {
        assert_eq!(choose_for_gyrostat(&criteria, asked, &Limits::default()), expected, "{criteria:?}");
    }
}

/// The next method runs where one does not hold, and none behind work that would take too long.
#[test]
fn methods_are_tried_in_order() {
    let decision = Decision::unasked(vec![Average(Polynomial), MicroRuns], FullSystem);
    let fails = Reason::AverageFails(AverageCriteria::default());
    let long = Reason::TooLong { work: Work::ShortRuns, seconds: 100.0, spent: 0.0, most: 60.0 };
    let run = |reasons: [Option<&Reason>; 3]| {
        let mut reasons = reasons.into_iter();
        let attempt = |method: Method| match reasons.next().flatten() {
            Some(reason) => Err(Stop::<()>::from(reason.clone())),
            None => Ok(method),
        };
        try_in_order(decision.clone(), attempt)
    };
    assert_eq!(run([None; 3]), Ok((Average(Polynomial), vec![])));
    let tried = vec![(Average(Polynomial), fails.clone())];
    assert_eq!(run([Some(&fails), None, None]), Ok((MicroRuns, tried.clone())));
    assert_eq!(
        run([Some(&fails), Some(&long), None]),
        Err(Stop::Refused { reason: long.clone(), tried: tried.clone() })
    );
    let both = [tried, vec![(MicroRuns, Reason::Lossless)]].concat();
    let refused = run([Some(&fails), Some(&Reason::Lossless), Some(&Reason::NoModalRate)]);
    assert_eq!(refused, Err(Stop::Refused { reason: Reason::NoModalRate, tried: both }));
    let none =
        Decision { trials: vec![ModalRates], last: Last::Refused(Reason::UnknownLength), asked: false };
    let stop = try_in_order(none, |_| Err::<(), _>(Stop::<()>::from(Reason::NoModalRate)));
    let tried = vec![(ModalRates, Reason::NoModalRate)];
    assert_eq!(stop, Err(Stop::Refused { reason: Reason::UnknownLength, tried }));
}
