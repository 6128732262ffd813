//! Histories by the reduced equations about the steady spin, and the verdict on them.

use std::ops::ControlFlow;

use quasirigid::dynamics::{Observer, Options, Outcome, Run, Scan};
use quasirigid::submanifold::{AmplitudeRange, Defect, ManifoldRun, propagate_on_manifold};
use quasirigid_io::model::BodyKind;
use serde::Serialize;

use super::json::RangeObject;
use super::{SHARE, derived};
use crate::error::StudyError;
use crate::motion::Motion;
use crate::settings::SpinManifoldSettings;
use crate::words::{growth, significant};

/// Verdict on a history by the reduced equations about a spin.
#[derive(Clone, Debug)]
pub struct OnManifold {
    /// Degree of the equations.
    pub degree: usize,
    /// Range of the nutation.
    pub range: AmplitudeRange,
    /// Largest defect met.
    pub worst: Defect,
    /// Its time (s).
    pub worst_time: f64,
    /// Share of the internal energy of the start that the equations leave out: its vibrations.
    pub left_out: f64,
    /// Motion left out that grows, in words.
    pub growing: Option<String>,
    /// Kind of the body.
    kind: BodyKind,
}

/// Share of the internal energy of a start from which the vibrations left out are told, and above which the start is not near the spin manifold.
const TOLD: f64 = 1e-3;
const FAR_FROM_MANIFOLD: f64 = 1.0;
/// Ratio of energies above which it is not told.
const MAX_RATIO_TOLD: f64 = 1000.0;

/// Follows the reduced equations about the steady spin of a motion.
pub(crate) fn follow(
    motion: &Motion,
    settings: &SpinManifoldSettings,
    times: &[f64],
    options: &Options,
    observer: &mut dyn Observer,
) -> Result<(Run, OnManifold), StudyError> {
    if motion.system().acts() {
        let names = motion.forces.iter().map(|force| force.name.clone()).collect();
        return Err(StudyError::ForcesAboutSpin { names });
    }
    if !options.events.is_empty() {
        return Err(StudyError::EventsAboutSpin);
    }
    let found = derived(motion, settings, &mut |_| observer.progress(0.0));
    let found = match found {
        Err(StudyError::Interrupted) if observer.progress(0.0) == ControlFlow::Continue(()) => {
            return Err(StudyError::Interrupted);
        }
        found => found?,
    };
    let kind = motion.study().model.kind;
    let (manifold, Some(state)) = (found.manifold, found.state) else {
        return Err(StudyError::MiddleAxis { kind });
    };
    let start = manifold.start(&state);
    let range = manifold.range(SHARE);
    let ManifoldRun { outcome, last, worst, work, .. } =
        propagate_on_manifold(&manifold, &start, times, options, observer)?;
    let verdict = OnManifold {
        degree: manifold.degree(),
        range,
        worst: worst.0,
        worst_time: worst.1,
        left_out: start.left_out,
        growing: manifold
            .growing_outside()
            .map(|(name, decay_rate)| growth(&kind.mode_name(name), decay_rate)),
        kind,
    };
    Ok((
        Run { outcome, last, work, scan: Scan::default(), left_out: 0.0, load_ratio: 0.0, ringing: None },
        verdict,
    ))
}

impl OnManifold {
    /// Whether the start was near the spin manifold, nothing grows away from it, and the history stayed within the range.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.growing.is_none()
            && self.left_out <= FAR_FROM_MANIFOLD
            && self.worst.largest() <= self.range.share
    }

    /// The verdict in a sentence.
    #[must_use]
    pub fn sentence(&self) -> String {
        let Self { degree, range, worst, worst_time, left_out, growing, kind } = self;
        if let Some(growing) = growing {
            return format!(
                "The history DOES NOT HOLD: {growing}, which the reduced equations about the spin leave out."
            );
        }
        if !(*left_out <= FAR_FROM_MANIFOLD) {
            let times = if *left_out < MAX_RATIO_TOLD {
                significant(*left_out, 2)
            } else {
                format!("over {MAX_RATIO_TOLD}")
            };
            return format!(
                "The history DOES NOT HOLD: the vibrations of the start, which the reduced equations about the spin leave out, have {times} \
                 times the energy of the motion that they follow."
            );
        }
        let held = format!(
            "hold to a {} of {} degrees within {} % at degree {degree}",
            kind.nutation(),
            significant(range.nutation.to_degrees(), 3),
            significant(100.0 * range.share, 1)
        );
        let defect = worst.largest();
        let met = if defect.is_finite() {
            format!("{} % at t = {worst_time} s", significant(100.0 * defect, 2))
        } else {
            format!("without bound at t = {worst_time} s")
        };
        if self.holds() {
            return format!("The reduced equations about the spin {held}; the largest defect met is {met}.");
        }
        format!(
            "The history LEFT THE RANGE of the reduced equations about the spin, which {held}: the largest defect met is {met}."
        )
    }

    /// Note on the vibrations of the start that are left out; none where they are small.
    #[must_use]
    pub fn note(&self) -> Option<String> {
        (self.left_out > TOLD).then(|| {
            format!(
                "Of the energy that the start has beyond its steady spin, {} % is in vibrations off the spin manifold, which are left out.",
                significant(100.0 * self.left_out, 2)
            )
        })
    }

    /// For machines.
    pub(crate) fn for_machines(&self) -> HistoryVerdict {
        let finite = |value: f64| Some(value).filter(|value| value.is_finite());
        let Self { degree, range, worst, worst_time, left_out, .. } = self;
        HistoryVerdict {
            holds: self.holds(),
            sentence: self.sentence(),
            degree: *degree,
            range: RangeObject::new(range),
            defect: WorstDefect {
                motion: finite(worst.motion),
                power: finite(worst.power),
                time: *worst_time,
            },
            left_out: finite(*left_out),
        }
    }
}

/// Verdict on a history for machines; the first paragraph of a field is the reference of `--json` in the guide.
#[derive(Serialize)]
pub(crate) struct HistoryVerdict {
    /// To the end.
    holds: bool,
    /// In words.
    sentence: String,
    /// In the amplitude.
    degree: usize,
    /// As of `derive --about spin`.
    range: RangeObject,
    /// Largest met.
    defect: WorstDefect,
    /// Share of energy off the spin manifold.
    left_out: Option<f64>,
}

/// Largest defect of a history.
#[derive(Serialize)]
struct WorstDefect {
    /// Share, or `null`.
    motion: Option<f64>,
    /// Share, or `null`.
    power: Option<f64>,
    /// s.
    time: f64,
}

impl OnManifold {
    /// Whether an outcome is that of a history which was followed to its end.
    #[must_use]
    pub fn status(&self, outcome: Outcome) -> Option<(&'static str, String)> {
        (matches!(outcome, Outcome::Finished) && !self.holds()).then(|| ("left-validity", self.sentence()))
    }
}
