//! Chaos under forces: how fast two rigid bodies of neighbouring starts part, and from when on a history is one of many. (E10)

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use quasirigid::dynamics::{Observer, Options, Sample, Start};
use quasirigid_math::rotation::{angle_between, turned};
use quasirigid_math::vec3::{add, norm, scale};

use crate::histories::even_times;
use crate::motion::Motion;
use crate::watch::Watch;
use crate::words::significant;

/// Angle (rad) by which the neighbour starts turned, and share of the spin by which it is faster; along a direction off every axis.
const APART: f64 = 1e-9;
const TOWARDS: [f64; 3] = [0.48, -0.64, 0.6];
/// Angle (rad) at which two motions have parted, and error of the attitude (rad) from which a history is told not to be known.
const PARTED: f64 = 0.1;
const UNKNOWN: f64 = 1e-2;
/// Growth beside that of a regular motion, which is linear in the angle turned, from which a motion is chaotic.
const CHAOTIC: f64 = 100.0;
/// Times at which the two are compared, and steps of each at most: some thousand revolutions, in which chaos shows.
const TIMES: usize = 400;
const MOST_STEPS: u64 = 100_000;

/// Growth of the distance of two neighbouring motions. (E10)
#[derive(Clone, Copy, Debug)]
pub struct Parting {
    /// Time (s) in which the distance grows e-fold.
    pub e_fold: f64,
    /// Time (s) from which the attitude is not known at the tolerance of the run.
    pub unknown_from: f64,
}

/// Parting of the motion to a time (s) from its neighbours, as rigid bodies; none of a regular motion, of one that is known to the end, and of
/// one on which no force acts, and where the rigid body is not followed or the watch ends it.
pub(crate) fn parting(
    motion: &Motion,
    end: f64,
    options: &Options,
    watch: &mut dyn Watch,
) -> Option<Parting> {
    if !motion.system().acts() || !motion.study().controls.is_empty() || !(end > 0.0) {
        return None;
    }
    let tolerance = options.tolerance;
    let options = Options { most_steps: MOST_STEPS, events: Vec::new(), ..options.clone() };
    let times = even_times(TIMES, end);
    let start = motion.start;
    let beside = Start {
        attitude: turned(start.attitude, scale(APART, TOWARDS)),
        omega: add(start.omega, scale(APART * norm(start.omega), TOWARDS)),
        ..start
    };
    let mut followed = |motion: &Motion| {
        let mut rows = Rows { rows: Vec::new(), end, watch: &mut *watch, stopped: false };
        motion.follow_rigid(&times, &options, &mut rows).ok()?;
        (!rows.stopped).then_some(rows.rows)
    };
    let (own, other) = (followed(motion)?, followed(&Motion::new(motion.study(), beside))?);
    growth(&own, &other, tolerance).filter(|parting| parting.unknown_from < end)
}

/// Growth of the distance of two motions; none where it is that of a regular motion. (E10)
fn growth(own: &[Sample], other: &[Sample], tolerance: f64) -> Option<Parting> {
    let mut widest: Option<(f64, f64, f64)> = None;
    for (a, b) in own.iter().zip(other).filter(|(a, b)| a.t == b.t && a.t > 0.0) {
        let gap = angle_between(a.attitude, b.attitude);
        let regular = 1.0 + TAU * a.revolutions;
        if widest.is_none_or(|(_, widest, _)| gap > widest) {
            widest = Some((a.t, gap, regular));
        }
        if gap > PARTED {
            break;
        }
    }
    let (t, gap, regular) = widest?;
    let excess = gap / (APART * regular);
    if !(excess > CHAOTIC) {
        return None;
    }
    let e_fold = t / excess.ln();
    let per_time = regular / t;
    let error = |t: f64| tolerance * (1.0 + per_time * t) * (t / e_fold).exp();
    let mut unknown_from = e_fold * (UNKNOWN / tolerance).ln();
    for _ in 0..REFINEMENTS {
        unknown_from += e_fold * (UNKNOWN / error(unknown_from)).ln();
    }
    Some(Parting { e_fold, unknown_from: unknown_from.max(0.0) })
}

/// Steps to the time at which the error is told, each of which leaves out the slow factor's change.
const REFINEMENTS: usize = 6;

impl Parting {
    /// The doubt in a sentence.
    pub fn doubt(&self) -> String {
        let [e_fold, from] = [self.e_fold, self.unknown_from].map(|time| significant(time, 2));
        format!(
            "THE MOTION IS CHAOTIC: the distance between rigid bodies of neighbouring starts grows e-fold in {e_fold} s, and so do the errors of the start and of the steps. From about t = {from} s on the history is one of many that start alike, however small its drift: ask for shares of many of them (sweep), not for one."
        )
    }
}

/// Rows of a motion, to be compared.
struct Rows<'a> {
    rows: Vec<Sample>,
    end: f64,
    watch: &'a mut dyn Watch,
    stopped: bool,
}

impl Observer for Rows<'_> {
    fn sample(&mut self, sample: &Sample) {
        self.rows.push(*sample);
    }

    fn progress(&mut self, t: f64) -> ControlFlow<()> {
        let asked = self.watch.at("neighbouring starts", t / self.end);
        self.stopped |= asked.is_break();
        asked
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Motions that turn once in 6.28 s and part as a law of the time says.
    fn parted(law: impl Fn(f64) -> f64) -> [Vec<Sample>; 2] {
        let own = [0.6, 0.0, 0.0, 0.8];
        let rows = |law: &dyn Fn(f64) -> f64| {
            let row = |i: u32| {
                let t = 2.5 * f64::from(i);
                let attitude = turned(own, [0.0, law(t), 0.0]);
                Sample { t, attitude, revolutions: t / TAU, ..Sample::default() }
            };
            (0..400).map(row).collect()
        };
        [rows(&|_| 0.0), rows(&law)]
    }

    /// Distances that grow e-fold in 30 s beside a regular motion: the time at which an error of each step has grown to 0.01 rad, put into the
    /// law, gives 0.01 rad.
    #[test]
    fn a_distance_that_grows_e_fold_tells_from_when_on_nothing_is_known() {
        let law = |t: f64| APART * (1.0 + t) * (t / 30.0).exp();
        let [own, other] = parted(|t| law(t).min(1.0));
        for tolerance in [1e-14, 1e-12, 1e-9] {
            let found = growth(&own, &other, tolerance).unwrap();
            assert!((found.e_fold / 30.0 - 1.0).abs() < 1e-3, "{found:?}");
            let error = tolerance / APART * law(found.unknown_from);
            assert!((error / UNKNOWN).ln().abs() < 0.1, "{error}");
        }
    }

    #[test]
    fn a_regular_motion_parts_in_proportion_to_the_angle_turned() {
        for factor in [0.1, 1.0, 20.0, 1e5] {
            let [own, other] = parted(|t| factor * APART * (1.0 + t));
            assert!(growth(&own, &other, 1e-12).is_none() == (factor < 100.0), "{factor}");
        }
        let [own, other] = parted(|t| 3.0 * APART * t);
        assert!(growth(&own, &other, 1e-12).is_none());
    }
}
