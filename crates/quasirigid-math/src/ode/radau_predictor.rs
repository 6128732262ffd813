//! First guess of the stages in lanes: the polynomial through the last step continues.

use super::Checkpoint;
use super::radau_stages::lagrange;
use super::radau_tableau::{C, STAGES};
use crate::lanes::{LANES, Lanes};
use crate::simd::Arithmetic;

/// Extrapolation of the tracks of a motion, values or changes since the start of a step, from the last step.
#[derive(Clone, Debug)]
pub(super) struct Predictor {
    /// Tracks of the last step, its start in the last lane.
    last: Vec<Lanes>,
    /// Length of the new step in lengths of the last that the weights are for.
    ratio: f64,
    /// Weights of the stages and the start of the last step in the new stages.
    weights: [Lanes; LANES],
    /// Weight of the end of the last step in a change since then.
    end: Lanes,
}

const END: usize = STAGES - 1;

impl Predictor {
    pub fn new(tracks: usize) -> Self {
        let zero = Lanes::splat(0.0);
        Self { last: vec![zero; tracks], ratio: 0.0, weights: [zero; LANES], end: zero }
    }

    /// Keeps the tracks of a step.
    pub fn keep<'a>(&mut self, tracks: impl Iterator<Item = &'a Lanes>) {
        self.last.iter_mut().zip(tracks).for_each(|(kept, track)| *kept = *track);
    }

    /// Prepares the guess of a step `ratio` times as long as the last.
    pub fn prepare(&mut self, ratio: f64) {
        if ratio == self.ratio {
            return;
        }
        self.ratio = ratio;
        for (stage, c) in C.iter().enumerate() {
            let (start, stages) = lagrange(1.0 + ratio * c);
            for (weights, weight) in self.weights.iter_mut().zip(stages.into_iter().chain([start])) {
                weights.0[stage] = weight;
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
        let last = self.last[track];
        let mut sum = end * Lanes::splat(last.0[END]);
        for i in 0..END {
            sum = self.weights[i].mul_add::<R>(Lanes::splat(last.0[i]), sum);
        }
        self.weights[STAGES].mul_add::<R>(Lanes::splat(last.0[STAGES]), sum)
    }

    /// Saves the step kept.
    pub fn save(&self, checkpoint: &mut Checkpoint) {
        self.last.iter().for_each(|lanes| checkpoint.save_list(&lanes.0));
    }

    /// Loads a saved step.
    pub fn load(&mut self, checkpoint: &mut Checkpoint) -> Option<()> {
        self.last.iter_mut().try_for_each(|lanes| checkpoint.load_into(&mut lanes.0))
    }
}
