//! Noise of sensors, the same on every machine and after a restart: each sample has random numbers of its own.

use std::f64::consts::TAU;

use crate::math::random::Random;

/// Number of a normal distribution of mean 0 and deviation 1, for an input of a controller at a sample; by Box and Muller.
pub(super) fn normal(seed: u64, [controller, input]: [usize; 2], sample: u64) -> f64 {
    let mut mixed = Random::new(seed);
    let keys = [controller as u64, input as u64, sample];
    let key = keys.into_iter().fold(mixed.bits(), |key, part| Random::new(key ^ part).bits());
    let mut random = Random::new(key);
    let radius = (-2.0 * (1.0 - random.unit()).ln()).sqrt();
    radius * (TAU * random.unit()).cos()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_is_normal_and_uncorrelated() {
        let count = 20_000;
        let draw = |input| (0..count).map(move |sample| normal(7, [0, input], sample));
        let mean = |values: &mut dyn Iterator<Item = f64>| values.sum::<f64>() / count as f64;
        assert!(mean(&mut draw(0)).abs() < 0.02);
        assert!((mean(&mut draw(0).map(|x| x * x)) - 1.0).abs() < 0.03);
        assert!((mean(&mut draw(0).map(|x| x.powi(4))) - 3.0).abs() < 0.2);
        assert!(mean(&mut draw(0).zip(draw(1)).map(|(x, y)| x * y)).abs() < 0.02);
        assert!(mean(&mut draw(0).zip(draw(0).skip(1)).map(|(x, y)| x * y)).abs() < 0.02);
    }
}
