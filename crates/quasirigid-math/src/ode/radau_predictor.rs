//! First guess of the stages of a step: the polynomial through the last step and the end of the one before continues.
//! Steps are short beside the motion, so that the further nodes make the guess better by several sweeps.

use super::Checkpoint;
use super::radau_search::knob;
use super::radau_tableau::{C, STAGES};
use crate::lanes::{LANES, Lanes};
use crate::simd::Arithmetic;

/// Extrapolation of the tracks of a motion, values or changes since the start of a step, from its last two steps.
#[derive(Clone, Debug)]
pub(super) struct Predictor {
    /// Tracks of the last step, its start in the last lane, and of the step before, relative to the start of the last.
    last: Vec<Lanes>,
    before: Vec<Lanes>,
    /// Lengths of these steps; zero where none is kept.
    lengths: [f64; 2],
    /// Length of the new step and of the one before the last, in lengths of the last, that the weights are for.
    ratios: [f64; 2],
    /// Weights of the nodes in the new stages, the last ones those of the step before.
    weights: [Lanes; LANES + EARLIER],
    /// Weight of the end of the last step in a change since then.
    end: Lanes,
}

/// Stages of the step before the last that are nodes, the latest ones before its end.
const EARLIER: usize = 4;
const FIRST: usize = STAGES - 1 - EARLIER;
const END: usize = STAGES - 1;
/// Limits of the ratio of two steps for which the polynomial goes through both: beyond, the nodes lie too far apart.
const EVEN: std::ops::Range<f64> = 0.6..1.7;

impl Predictor {
    pub fn new(tracks: usize) -> Self {
        let zero = Lanes::splat(0.0);
        Self {
            last: vec![zero; tracks],
            before: vec![zero; tracks],
            lengths: [0.0; 2],
            ratios: [0.0; 2],
            weights: [zero; LANES + EARLIER],
            end: zero,
        }
    }

    /// Forgets the steps kept.
    pub fn forget(&mut self) {
        self.lengths = [0.0; 2];
    }

    /// Keeps the tracks of a step of length `h`: values up to a number, then changes.
    pub fn keep<'a>(&mut self, h: f64, values: usize, tracks: impl Iterator<Item = &'a Lanes>) {
        std::mem::swap(&mut self.last, &mut self.before);
        self.last.iter_mut().zip(tracks).for_each(|(kept, track)| *kept = *track);
        for change in &mut self.before[values..] {
            *change = *change - Lanes::splat(change.0[END]);
        }
        self.lengths = [h, self.lengths[0]];
    }

    /// Prepares the guess of a step `ratio` times as long as the last.
    pub fn prepare(&mut self, ratio: f64) {
        let ratios = [ratio, self.lengths[1] / self.lengths[0]];
        if ratios != self.ratios {
            self.ratios = ratios;
            self.weigh();
        }
    }

    fn weigh(&mut self) {
        let [ratio, before] = self.ratios;
        let mut nodes = [0.0; LANES + EARLIER];
        nodes[..STAGES].copy_from_slice(&C);
        (0..EARLIER).for_each(|i| nodes[LANES + i] = before * (C[FIRST + i] - 1.0));
        let both = knob(2, 1.0) > 0.5 && EVEN.contains(&before) && EVEN.contains(&ratio);
        let nodes = &nodes[..if both { LANES + EARLIER } else { LANES }];
        self.weights.fill(Lanes::splat(0.0));
        for (stage, c) in C.iter().enumerate() {
            let x = 1.0 + ratio * c;
            for (i, node) in nodes.iter().enumerate() {
                let others = nodes.iter().enumerate().filter(|(j, _)| *j != i);
                let [above, below] = others.fold([1.0, 1.0], |[above, below], (_, other)| {
                    [above * (x - other), below * (node - other)]
                });
                self.weights[i].0[stage] = above / below;
            }
        }
        self.end = self.weights[END];
        self.end.0[..STAGES].iter_mut().for_each(|weight| *weight -= 1.0);
    }

    /// Values of a track at the new stages.
    #[inline(always)]
    pub fn value<R: Arithmetic>(&self, track: usize) -> Lanes {
        self.combined::<R>(track, self.weights[END])
    }

    /// Changes of a track from the end of the last step to the new stages.
    #[inline(always)]
    pub fn change<R: Arithmetic>(&self, track: usize) -> Lanes {
        self.combined::<R>(track, self.end)
    }

    #[inline(always)]
    fn combined<R: Arithmetic>(&self, track: usize, end: Lanes) -> Lanes {
        let (last, before) = (self.last[track], self.before[track]);
        let mut sum = end * Lanes::splat(last.0[END]);
        for i in 0..END {
            sum = self.weights[i].mul_add::<R>(Lanes::splat(last.0[i]), sum);
        }
        sum = self.weights[STAGES].mul_add::<R>(Lanes::splat(last.0[STAGES]), sum);
        for i in 0..EARLIER {
            sum = self.weights[LANES + i].mul_add::<R>(Lanes::splat(before.0[FIRST + i]), sum);
        }
        sum
    }

    /// Saves the steps kept.
    pub fn save(&self, checkpoint: &mut Checkpoint) {
        self.lengths.into_iter().for_each(|length| checkpoint.save(length));
        for lanes in self.last.iter().chain(&self.before) {
            checkpoint.save_list(&lanes.0);
        }
    }

    /// Loads saved steps.
    pub fn load(&mut self, checkpoint: &mut Checkpoint) -> Option<()> {
        for length in &mut self.lengths {
            *length = checkpoint.load()?;
        }
        for lanes in self.last.iter_mut().chain(&mut self.before) {
            lanes.0.copy_from_slice(&checkpoint.load_list()?.get(..LANES)?);
        }
        self.ratios = [0.0; 2];
        Some(())
    }
}
