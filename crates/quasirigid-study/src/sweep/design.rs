//! Places of the draws of a study between 0 and 1: independent, in a Latin hypercube, or along a scrambled Sobol sequence.
//! Each number is a function of seed, block, sample and key, where a block is one grid point of one body; blocks are independent.

use quasirigid_io::study_file::Sampling;

use super::generator::{Stream, permuted, uniform, word};

/// Keys that a Sobol sequence can draw.
pub(super) const MOST_SOBOL_KEYS: usize = 256;

/// Design of the draws of a study.
#[derive(Clone, Copy, Debug)]
pub(super) struct Design {
    pub(super) sampling: Sampling,
    pub(super) seed: u64,
    /// Draws of a block.
    pub(super) samples: u64,
}

impl Design {
    /// The number between 0 and 1 from which a row draws a key, given by the number of the key among those drawn.
    pub(super) fn at(&self, row: u64, key: u32) -> f64 {
        let (block, sample) = (row / self.samples, row % self.samples);
        let inside = uniform(self.seed, row, key);
        match self.sampling {
            Sampling::Random => inside,
            Sampling::LatinHypercube => {
                let order = word(self.seed, block, key, Stream::Permutation);
                let interval = permuted(sample, self.samples, order);
                ((interval as f64 + inside) / self.samples as f64)
                    .clamp(f64::MIN_POSITIVE, 1.0 - f64::EPSILON / 2.0)
            }
            Sampling::Sobol => {
                let scrambling = word(self.seed, block, 0, Stream::Scrambling) as u32;
                let place = sobol_burley::sample(sample as u32, key, scrambling);
                // the sequence has 24 digits; those behind are random
                f64::from(place) + inside * 2f64.powi(-24)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(sampling: Sampling, samples: u64, block: u64, key: u32) -> Vec<f64> {
        let design = Design { sampling, seed: 7, samples };
        (0..samples).map(|sample| design.at(block * samples + sample, key)).collect()
    }

    fn counts(draws: &[f64], intervals: usize) -> Vec<usize> {
        let mut counts = vec![0; intervals];
        draws.iter().for_each(|u| counts[(u * intervals as f64) as usize] += 1);
        counts
    }

    #[test]
    fn latin_hypercube_and_sobol_meet_every_interval_once() {
        for block in [0, 3] {
            for key in 0..5 {
                assert_eq!(counts(&drawn(Sampling::LatinHypercube, 100, block, key), 100), [1; 100]);
                assert_eq!(counts(&drawn(Sampling::Sobol, 256, block, key), 256), [1; 256]);
            }
        }
    }

    /// A Sobol sequence of 256 points has one in each of 16 x 16 cells of its first two keys.
    #[test]
    fn sobol_meets_every_cell_of_two_keys() {
        let [x, y] = [0, 1].map(|key| drawn(Sampling::Sobol, 256, 2, key));
        let cell = |(x, y): (&f64, &f64)| ((x * 16.0).floor() * 16.0 + (y * 16.0).floor()) / 256.0;
        let cells: Vec<f64> = x.iter().zip(&y).map(cell).collect();
        assert_eq!(counts(&cells, 256), [1; 256]);
    }

    /// Mean and correlation of independent draws: 4 standard errors of 10000.
    #[test]
    fn draws_of_keys_and_blocks_are_independent() {
        for sampling in [Sampling::Random, Sampling::LatinHypercube, Sampling::Sobol] {
            let all = [(0, 0), (0, 1), (1, 0)].map(|(block, key)| drawn(sampling, 10_000, block, key));
            for draws in &all {
                let mean = draws.iter().sum::<f64>() / 1e4;
                assert!((mean - 0.5).abs() < 4.0 * 0.2887 / 100.0, "{sampling:?}: {mean}");
                assert!(draws.iter().all(|u| *u > 0.0 && *u < 1.0));
            }
            for other in &all[1..] {
                let product: f64 = all[0].iter().zip(other).map(|(a, b)| (a - 0.5) * (b - 0.5)).sum();
                assert!((product / 1e4 * 12.0).abs() < 0.04, "{sampling:?}");
            }
        }
    }
}
