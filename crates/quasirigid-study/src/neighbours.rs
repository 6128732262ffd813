//! Parting of neighbours under forces, as in chaos: from when on a history is one of many that start alike to the errors of its steps. (E10)

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use quasirigid::dynamics::{Observer, Options, Sample, Start};
use quasirigid_math::rotation::{angle_between, turned};
use quasirigid_math::vec3::{add, norm, scale};

use crate::histories::even_times;
use crate::motion::Motion;
use crate::watch::Watch;
use crate::words::significant;

/// Angle (rad) by which the neighbour starts turned, and share of the spin by which it is faster, over the tolerance of a step, and the largest;
/// along a direction off every axis.
const PER_TOLERANCE: f64 = 10.0;
const MOST_APART: f64 = 1e-6;
const TOWARDS: [f64; 3] = [0.48, -0.64, 0.6];
/// Distance (rad) from which a history is told not to be known.
const UNKNOWN: f64 = 1e-2;
/// Distance beside that of a regular motion, which is linear in the angle turned, above which it is told.
const REGULAR: f64 = 100.0;
/// Times at which the two are compared, and steps of each at most: some thousand revolutions, in which chaos shows.
const TIMES: usize = 400;
const MOST_STEPS: u64 = 100_000;

/// Parting of two neighbouring motions. (E10)
#[derive(Clone, Copy, Debug)]
pub struct Parting {
    /// Distance of the two (rad) at the start.
    pub apart: f64,
    /// Time (s) from which the attitude is not known at the tolerance of the run.
    pub unknown_from: f64,
}

/// Parting of the motion to a time (s) from its neighbours, as rigid bodies under the same controllers; none of a regular motion, of one that is
/// known to the end, and of one on which nothing acts, and where parts are driven, the rigid body is not followed or the watch ends it.
pub(crate) fn parting(
    motion: &Motion,
    end: f64,
    options: &Options,
    watch: &mut dyn Watch,
) -> Option<Parting> {
    if !motion.is_acted_on() || !(end > 0.0) || !motion.body.drives().is_empty() {
        return None;
    }
    let apart = (PER_TOLERANCE * options.tolerance).min(MOST_APART);
    let options = Options { most_steps: MOST_STEPS, events: Vec::new(), ..options.clone() };
    let times = even_times(TIMES, end);
    let start = motion.start;
    let beside = Start {
        attitude: turned(start.attitude, scale(apart, TOWARDS)),
        omega: add(start.omega, scale(apart * norm(start.omega), TOWARDS)),
        ..start
    };
    let mut followed = |motion: &Motion| {
        let mut rows = Rows { rows: Vec::new(), end, watch: &mut *watch, stopped: false };
        motion.follow_rigid(&times, &options, &mut rows).ok()?;
        (!rows.stopped).then_some(rows.rows)
    };
    let (own, other) = (followed(motion)?, followed(&Motion::new(motion.study(), beside))?);
    let unknown_from = parted_from(&own, &other, apart)?;
    Some(Parting { apart, unknown_from })
}

/// Time (s) from which two motions that start so far (rad) apart have parted; none of regular ones. (E10)
fn parted_from(own: &[Sample], other: &[Sample], apart: f64) -> Option<f64> {
    let mut both = own.iter().zip(other).filter(|(a, b)| a.t == b.t);
    let parted = both.find(|(a, b)| {
        let regular = apart * (1.0 + TAU * a.revolutions);
        angle_between(a.attitude, b.attitude) > UNKNOWN.max(REGULAR * regular)
    });
    parted.map(|(a, _)| a.t)
}

impl Parting {
    /// The doubt in a sentence.
    pub fn doubt(&self) -> String {
        let [apart, from] = [self.apart, self.unknown_from].map(|number| significant(number, 2));
        format!(
            "THE MOTION IS NOT KNOWN from about t = {from} s on, however small its drift: a rigid body that starts {apart} rad aside, as far as the steps err, is {UNKNOWN} rad away there. The history is one of many that start alike, as of a chaotic motion: ask for shares of many of them (sweep), or for a smaller tolerance."
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

    /// Distances that grow e-fold in 30 s beside a regular motion: told at the first row behind the time at which the law gives 0.01 rad.
    #[test]
    fn motions_part_where_their_distance_has_grown_to_a_hundredth() {
        for apart in [1e-13, 1e-11, 1e-8] {
            let law = |t: f64| apart * (1.0 + t) * (t / 30.0).exp();
            let [own, other] = parted(|t| law(t).min(1.0));
            let from = parted_from(&own, &other, apart).unwrap();
            assert!(law(from) > UNKNOWN && law(from - 2.5) <= UNKNOWN, "{from}");
        }
    }

    #[test]
    fn a_regular_motion_parts_in_proportion_to_the_angle_turned() {
        for (factor, apart) in [(0.1, 1e-11), (20.0, 1e-11), (3.0, 1e-4), (99.0, 1e-6)] {
            let [own, other] = parted(|t| factor * apart * (1.0 + t));
            assert!(parted_from(&own, &other, apart).is_none(), "{factor}");
        }
    }
}
