//! Reasons why an evolution has no answer, in words.

use quasirigid::averaging::Way;
use quasirigid::model::Mode;
use quasirigid::secular::choice::{self, Instability, Work};
use quasirigid::secular::{AverageCriteria, DirectStopReason};
use quasirigid_io::model::{BodyKind, EvolveMethod, Named};
use quasirigid_math::vec3::{norm, scale};

use super::reason::Reason;
use crate::liquids::unknown;
use crate::words::{growth, significant, time};

/// Reason in words, without a full stop, for a body of a kind, with momentum wheels or without.
pub fn text(reason: &Reason, kind: BodyKind, wheels: bool) -> String {
    match reason {
        Reason::NoSolid(words) => words.clone(),
        Reason::ChangingWheel => {
            "a momentum wheel changes its speed: its motor does work on the body, whose energy then need \
             not fall, and no steady spin need be reached; `simulate` follows the history"
                .into()
        }
        Reason::Spent { seconds } => format!(
            "no method reached the end within {}, the limit of an automatic choice; a \
             method that is asked for has no limit",
            time(*seconds)
        ),
        Reason::Choice(reason) => of_choice(reason, kind, wheels),
        Reason::AfterLevels(reasons) => {
            reasons.each_ref().map(|reason| of_choice(reason, kind, wheels)).join("; ")
        }
    }
}

/// Reason of the choice in words.
fn of_choice(reason: &choice::Reason, kind: BodyKind, wheels: bool) -> String {
    use choice::Reason;
    let nutation = kind.nutation();
    match reason {
        Reason::Equilibrium(error) => error.to_string(),
        Reason::Modes(error) => {
            format!("the steady {}: {error}", if wheels { "spin" } else { "spins" })
        }
        Reason::NoAttractor => {
            "no steady spin of least energy was found: a spring may be too soft for the centrifugal load"
                .into()
        }
        Reason::Unstable(instability) => unstable(instability, kind),
        Reason::UnknownLiquidResponse(liquids) => unknown(liquids),
        Reason::LossesLeftOut { share } => left_out(*share, kind),
        Reason::AverageFails(criteria) => unfounded(*criteria, kind),
        Reason::NotPrepared => "this method is not one that can be asked for".into(),
        Reason::AverageUnderTorque(criteria) => format!(
            "under a torque the average alone is followed, and it does not hold: {}",
            unfounded(*criteria, kind)
        ),
        Reason::NoModalRate if wheels => format!("the modes give no rate of a small {nutation}"),
        Reason::NoModalRate => {
            format!("the modes about the steady spins give no rate at which a small {nutation} changes")
        }
        Reason::TooWideForModes { error, wobble } => format!(
            "the average is off by {} % at the axis, where the linear modes hold, and the {nutation} of {} degrees \
             is too wide for them",
            significant(100.0 * error, 2),
            degrees(*wobble)
        ),
        Reason::TooWideForLiquids { wobble } => format!(
            "the response of a spinning liquid is known for small {nutation}s, and {}",
            match wobble {
                Some(wobble) => format!("one of {} degrees is too wide for it", degrees(*wobble)),
                None => format!("the way to the end leads through the separatrix, where the {nutation} is 90 degrees"),
            }
        ),
        Reason::TooWideForNutation { widest } => format!(
            "the rates of the modes, which include every loss of this body, hold for {nutation}s below {} degrees",
            significant(widest.to_degrees(), 2)
        ),
        Reason::RatioOfLevels => {
            "elasticity changes a difference of the moments of inertia by more than 1 %, so that D/I3 says \
             little; say how far to go by an angle"
                .into()
        }
        Reason::NotOnLevels => {
            "level curves of the slow energy are for an elastic body without rotors, liquids and materials that lose \
             at each frequency by themselves, whose spin is at most 15 % of its slowest elastic frequency"
                .into()
        }
        Reason::Levels(error) => error.to_string(),
        Reason::LevelsFail { error } => levels_fail(*error),
        Reason::Separatrix { t, ways } if ways.is_empty() => {
            format!("the rotation reaches a separatrix after {}; what follows depends on the phase", time(*t))
        }
        Reason::Separatrix { t, ways } => undecided(*t, ways),
        Reason::Lossless if wheels => "the reduced equations dissipate nothing".into(),
        Reason::Lossless => "nothing is dissipated".into(),
        Reason::Submanifold(error) => error.to_string(),
        Reason::ManifoldThroughSeparatrix if wheels => {
            "the reduced equations about a spin do not reach through a separatrix".into()
        }
        Reason::ManifoldThroughSeparatrix => {
            "the reduced equations about a spin do not reach from one pole to the other".into()
        }
        Reason::BeyondManifold { .. } if wheels => {
            format!("the reduced equations about the steady spin do not hold at this {nutation}")
        }
        Reason::BeyondManifold { wobble } => format!(
            "the reduced equations about the spin do not hold at the {nutation} of the start, {} degrees, or the \
             start is too far off them",
            degrees(*wobble)
        ),
        Reason::ManifoldWithoutEnd => {
            "the reduced equations about the steady spin do not lead to the end".into()
        }
        Reason::LongManifold { seconds } => {
            format!("following the reduced equations about the spin takes longer than {}", time(*seconds))
        }
        Reason::Measured(error) => error.to_string(),
        Reason::ShortRunsWithWheels => "periodic motions and short runs cannot measure the power of a body with momentum wheels".into(),
        Reason::WithinRevolution { t } => format!(
            "the energy of the full system falls to the target within {}, less than a revolution: that is the \
             transient of the start, not the decay of a {nutation}; its history in the full system shows it",
            time(*t)
        ),
        Reason::Unfinished { t, ending, .. } if wheels => {
            let failure = match ending {
                DirectStopReason::Failed { reason } => format!(": {reason}"),
                _ => String::new(),
            };
            format!("the full system was followed for {} and did not reach the target{failure}", time(*t))
        }
        Reason::Unfinished { t, revolutions, ending, instability } => {
            let instability = instability.as_ref().map(|found| format!("; {}", unstable(found, kind)));
            format!(
                "the full system was followed for {} ({} revolutions) and did not reach the target: {}{}",
                time(*t),
                significant(*revolutions, 3),
                ended(ending),
                instability.unwrap_or_default()
            )
        }
        Reason::NothingDissipated => "nothing in the body dissipates: the rotation stays as it is".into(),
        Reason::UnknownLength if wheels => format!(
            "the modes give no rate of a small {nutation}, so the length of a run of the full system \
             cannot be estimated"
        ),
        Reason::UnknownLength => format!(
            "at one end the modes give no rate of a small {nutation} beyond rounding, so the length of a run of the \
             full system cannot be estimated; the method {}, asked for, needs no estimate",
            method(Work::History)
        ),
        Reason::TooLong { work: long, seconds, spent, most } => {
            // nothing of the clock where it did not decide
            let before = if seconds > most { String::new() } else { format!(" after the {} before", time(*spent)) };
            format!(
                "{} would take about {}{before}, and an automatic choice may take {}; ask for the method \
                 {} to do it all the same",
                work(*long),
                time(*seconds),
                time(*most),
                method(*long)
            )
        }
    }
}

/// Error of level curves of a body with momentum wheels that is too large, in words.
pub fn levels_fail(error: f64) -> String {
    format!(
        "by its rates, frequencies and settling beside the modes it may be {} % off",
        significant(100.0 * error, 2)
    )
}

/// Work in the full system, in words.
pub fn work(work: Work) -> &'static str {
    match work {
        Work::ShortRuns => "measuring the mean power by short runs of the full system",
        Work::History => "following the full system from start to end",
    }
}

/// Method that does work in the full system when it is asked for.
fn method(work: Work) -> &'static str {
    match work {
        Work::ShortRuns => EvolveMethod::MicroRuns.name(),
        Work::History => EvolveMethod::Full.name(),
    }
}

fn degrees(angle: f64) -> String {
    significant(angle.to_degrees(), 3)
}

/// Reason why an average does not hold, in words.
pub fn unfounded(criteria: AverageCriteria, kind: BodyKind) -> String {
    let nutation = kind.nutation();
    let AverageCriteria { poles, settling, moments, probed, rounding, liquids } = criteria;
    let percent = |share: f64| significant(100.0 * share, 2);
    if liquids >= criteria.error() {
        return format!(
            "the {nutation} is too wide for the response of a spinning liquid, which is known for small ones"
        );
    }
    if rounding >= criteria.error() {
        return "its power is hidden in rounding: two moments of inertia are nearly equal".into();
    }
    if probed > poles.max(settling).max(moments) {
        return format!("its power is {} % off that of short runs of the full system", percent(probed));
    }
    if moments >= poles && moments >= settling {
        return format!(
            "the deformation changes the differences between the moments of inertia by {} %",
            percent(moments)
        );
    }
    if settling > poles {
        return format!(
            "the {nutation} changes at {} of the relaxation rate of the internal motion",
            significant(settling, 2)
        );
    }
    format!("a small {nutation} changes at a rate that is {} % off that of the linear modes", percent(poles))
}

fn unstable(Instability { about, name, decay_rate }: &Instability, kind: BodyKind) -> String {
    let spin = match about {
        Some(Mode::ShortAxis) => "about the axis of greatest inertia",
        Some(Mode::LongAxis) => "about the axis of least inertia",
        None => "of least energy",
    };
    format!("the steady spin {spin} is unstable: {}", growth(&kind.mode_name(name), *decay_rate))
}

/// Sentence on losses that the equations of motion leave out, as a share of the rate of a small nutation.
fn left_out(share: f64, kind: BodyKind) -> String {
    let why = "the full system has no equations of motion for all that dissipates (materials and liquids whose \
               response is known only in the frequency domain)";
    if !share.is_finite() {
        return format!("{why}, and the modes do not tell their share");
    }
    format!(
        "{why}: with the losses that it has, the rate of a small {} is off by {} %",
        kind.nutation(),
        significant(100.0 * share, 2)
    )
}

/// Sentence on a separatrix at a time (s) behind which a fraction of a revolution chooses the way.
fn undecided(t: f64, ways: &[Way]) -> String {
    let way = |way: &Way| {
        let axis = scale(norm(way.attractor).recip(), way.attractor);
        let axis = axis.map(|entry| significant(entry, 3));
        format!(
            "that towards the steady spin with K along [{}] with the probability {}",
            axis.join(", "),
            significant(way.share, 2)
        )
    };
    format!(
        "the rotation reaches a separatrix after {}, and a fraction of a revolution decides which branch \
         its angular momentum follows: {}",
        time(t),
        ways.iter().map(way).collect::<Vec<_>>().join(", ")
    )
}

/// Reason why a history of the full system ended early.
fn ended(ending: &DirectStopReason) -> &str {
    match ending {
        DirectStopReason::Failed { reason } => reason,
        DirectStopReason::Settled => "it spins steadily about another axis than the modes were found for",
        DirectStopReason::TurnLimit => "that is more revolutions than can be followed one by one",
        _ => "the step limit was reached; the method full, asked for, has a higher one",
    }
}

#[cfg(test)]
mod tests {
    use super::choice::Reason;
    use super::*;

    /// Reasons that a body with momentum wheels shares have a sentence of their own for it.
    #[test]
    fn momentum_wheels_change_the_words() {
        let ending = DirectStopReason::StepLimit;
        let unfinished = Reason::Unfinished { t: 60.0, revolutions: 12.0, ending, instability: None };
        let rows = [
            (Reason::Lossless, "nothing is dissipated", "the reduced equations dissipate nothing"),
            (
                Reason::NoModalRate,
                "the modes about the steady spins give no rate at which a small nutation changes",
                "the modes give no rate of a small nutation",
            ),
            (
                Reason::ManifoldThroughSeparatrix,
                "the reduced equations about a spin do not reach from one pole to the other",
                "the reduced equations about a spin do not reach through a separatrix",
            ),
            (
                Reason::BeyondManifold { wobble: 0.25 },
                "the reduced equations about the spin do not hold at the nutation of the start, 14.3 degrees, or \
                 the start is too far off them",
                "the reduced equations about the steady spin do not hold at this nutation",
            ),
            (
                Reason::UnknownLength,
                "at one end the modes give no rate of a small nutation beyond rounding, so the length of \
                 a run of the full system cannot be estimated; the method full, asked for, needs no estimate",
                "the modes give no rate of a small nutation, so the length of a run of the full \
                 system cannot be estimated",
            ),
            (
                unfinished,
                "the full system was followed for 60.00 s (12.0 revolutions) and did not reach the target: the step \
                 limit was reached; the method full, asked for, has a higher one",
                "the full system was followed for 60.00 s and did not reach the target",
            ),
        ];
        for (reason, without, with) in rows {
            assert_eq!(
                [false, true].map(|wheels| of_choice(&reason, BodyKind::Spacecraft, wheels)),
                [without, with]
            );
        }
    }

    /// Level curves that were refused before the last method are named first; those that did not hold are not.
    #[test]
    fn level_curves_that_were_refused_are_told_first() {
        use quasirigid::secular::choice::{Method, Stop};
        let after = |levels: Reason| {
            let tried =
                vec![(Method::LevelCurves, levels), (Method::SpinManifold, Reason::ManifoldWithoutEnd)];
            let stop = Stop::Refused { reason: Reason::UnknownLength, tried };
            text(&super::Reason::of(stop).unwrap(), BodyKind::Spacecraft, true)
        };
        let last = of_choice(&Reason::UnknownLength, BodyKind::Spacecraft, true);
        assert_eq!(after(Reason::LevelsFail { error: 0.2 }), last);
        assert_eq!(after(Reason::Lossless), format!("the reduced equations dissipate nothing; {last}"));
    }
}
