//! Counter-based random numbers: each number is a function of the seed and of its place in the study, never of a state.
//! Any row of a study can so be computed alone, in any order, on any number of threads.
//! Philox4x32-10 of Salmon, Moraes, Dror and Shaw, "Parallel random numbers: as easy as 1, 2, 3" (2011).

const MULTIPLIERS: [u32; 2] = [0xD251_1F53, 0xCD9E_8D57];
const WEYL: [u32; 2] = [0x9E37_79B9, 0xBB67_AE85];
const ROUNDS: usize = 10;

/// Four random words of a counter and a key.
pub(super) fn philox(mut counter: [u32; 4], mut key: [u32; 2]) -> [u32; 4] {
    for _ in 0..ROUNDS {
        let [first, second] = [0, 1].map(|i| u64::from(MULTIPLIERS[i]) * u64::from(counter[2 * i]));
        let high = |product: u64| (product >> 32) as u32;
        counter = [
            high(second) ^ counter[1] ^ key[0],
            second as u32,
            high(first) ^ counter[3] ^ key[1],
            first as u32,
        ];
        key = [key[0].wrapping_add(WEYL[0]), key[1].wrapping_add(WEYL[1])];
    }
    counter
}

/// Purposes of random numbers, which are independent of each other at the same place.
#[derive(Clone, Copy)]
pub(super) enum Stream {
    /// Draws.
    Draw = 0,
    /// Permutations of a Latin hypercube.
    Permutation = 1,
    /// Scrambling of a Sobol sequence.
    Scrambling = 2,
}

/// A random word at a place of a study.
pub(super) fn word(seed: u64, place: u64, key: u32, stream: Stream) -> u64 {
    let [low, high] = [place as u32, (place >> 32) as u32];
    let [a, b, ..] = philox([low, high, key, stream as u32], [seed as u32, (seed >> 32) as u32]);
    u64::from(a) << 32 | u64::from(b)
}

/// A random number between 0 and 1, never equal to either.
pub(super) fn uniform(seed: u64, place: u64, key: u32) -> f64 {
    ((word(seed, place, key, Stream::Draw) >> 11) as f64 + 0.5) * 2f64.powi(-53)
}

/// Place of an index in a random permutation of `count` indices, by a Feistel network walked until it meets one of them.
pub(super) fn permuted(index: u64, count: u64, key: u64) -> u64 {
    let half = (u64::BITS - count.saturating_sub(1).leading_zeros()).div_ceil(2).max(1);
    let mask = (1u64 << half) - 1;
    let mut place = index;
    loop {
        let (mut left, mut right) = (place >> half, place & mask);
        for round in 0..6 {
            let mixed = word(key, right, round, Stream::Permutation) & mask;
            (left, right) = (right, left ^ mixed);
        }
        place = left << half | right;
        if place < count {
            return place;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Known answers of the authors' own test (Random123, kat_vectors).
    #[test]
    fn philox_gives_the_words_of_its_authors() {
        let ones = u32::MAX;
        assert_eq!(philox([0; 4], [0; 2]), [0x6627_e8d5, 0xe169_c58d, 0xbc57_ac4c, 0x9b00_dbd8]);
        assert_eq!(philox([ones; 4], [ones; 2]), [0x408f_276d, 0x41c8_3b0e, 0xa20b_c7c6, 0x6d54_51fd]);
        let pi = [0x243f_6a88, 0x85a3_08d3, 0x1319_8a2e, 0x0370_7344];
        assert_eq!(
            philox(pi, [0xa409_3822, 0x299f_31d0]),
            [0xd16c_fe09, 0x94fd_cceb, 0x5001_e420, 0x2412_6ea1]
        );
    }

    #[test]
    fn permutation_meets_every_index_once() {
        for count in [1, 2, 3, 7, 64, 1000] {
            let mut met: Vec<u64> = (0..count).map(|index| permuted(index, count, 5)).collect();
            assert!(
                count < 64 || met.windows(2).any(|pair| pair[0] > pair[1]),
                "a permutation of {count} is the identity"
            );
            met.sort_unstable();
            assert!(met.into_iter().eq(0..count));
        }
    }
}
