//! Mutations of inputs: bytes, ranges, words of the format, numbers in text and in binary headers, and splices of two inputs.

use crate::random::Random;

/// Most bytes of an input.
pub const MAX_INPUT: usize = 64 * 1024;
/// Most bytes of an input of random bytes alone.
const LONGEST_RANDOM: usize = 2048;
/// Share of the inputs that are random bytes alone, one in so many.
const RANDOM: usize = 16;
/// Most mutations of one input are two to this power.
const POWER: usize = 5;

/// Numbers that headers lie about.
const COUNTS: [u64; 14] = [
    0,
    1,
    2,
    3,
    0x7f,
    0xff,
    0xffff,
    1_000_000,
    0x7fff_ffff,
    0x8000_0000,
    0xffff_ffff,
    1_000_000_000_000,
    i64::MAX as u64,
    u64::MAX,
];

/// Numbers as text, on the edges of what readers accept.
const NUMBERS: [&str; 24] = [
    "0",
    "-0",
    "1",
    "-1",
    "2",
    "1e308",
    "-1e308",
    "1e-308",
    "5e-324",
    "1e400",
    "1e30",
    "1e-30",
    "nan",
    "inf",
    "-inf",
    "255",
    "65536",
    "1000000",
    "2147483648",
    "4294967296",
    "9223372036854775807",
    "18446744073709551616",
    "1.5D-3",
    "0.1",
];

/// Source of inputs for a target.
#[derive(Debug)]
pub struct Mutator<'c> {
    random: Random,
    corpus: &'c [Vec<u8>],
    words: &'c [&'c str],
}

impl<'c> Mutator<'c> {
    /// Mutator of a corpus with the words of its format.
    #[must_use]
    pub fn new(seed: u64, corpus: &'c [Vec<u8>], words: &'c [&'c str]) -> Self {
        Self { random: Random::new(seed), corpus, words }
    }

    /// The next input.
    pub fn input(&mut self) -> Vec<u8> {
        if self.corpus.is_empty() || self.random.below(RANDOM) == 0 {
            let count = self.random.below(LONGEST_RANDOM);
            return self.random.bytes(count);
        }
        let mut input = self.random.pick(self.corpus).clone();
        for _ in 0..1usize << self.random.below(POWER + 1) {
            self.mutate(&mut input);
        }
        input.truncate(MAX_INPUT);
        input
    }

    fn mutate(&mut self, input: &mut Vec<u8>) {
        match self.random.below(13) {
            0 => self.flip(input),
            1 => self.overwrite_byte(input),
            2 => {
                let count = 1 + self.random.below(8);
                let bytes = self.random.bytes(count);
                self.insert(input, &bytes);
            }
            3 => {
                let range = self.range(input);
                input.drain(range);
            }
            4 => {
                let range = self.range(input);
                let copy = input[range].to_vec();
                self.insert(input, &copy);
            }
            5 => self.move_range(input),
            6 => self.splice(input),
            7 | 8 => self.word(input),
            9 | 10 => self.number(input),
            11 => self.count(input),
            _ => self.line(input),
        }
    }

    fn flip(&mut self, input: &mut [u8]) {
        let (place, bit) = (self.random.below(input.len()), self.random.below(8));
        if let Some(byte) = input.get_mut(place) {
            *byte ^= 1 << bit;
        }
    }

    fn overwrite_byte(&mut self, input: &mut [u8]) {
        let place = self.random.below(input.len());
        let value = *self.random.pick(b"\0\x01\x7f\x80\xff \n\"'[]{}=.,-+*/e0159#$<>:");
        if let Some(byte) = input.get_mut(place) {
            *byte = value;
        }
    }

    fn insert(&mut self, input: &mut Vec<u8>, bytes: &[u8]) {
        if input.len() + bytes.len() <= MAX_INPUT {
            let place = self.random.below(input.len() + 1);
            input.splice(place..place, bytes.iter().copied());
        }
    }

    fn range(&mut self, input: &[u8]) -> std::ops::Range<usize> {
        let longest = 1usize << self.random.below(11);
        let start = self.random.below(input.len());
        start..(start + 1 + self.random.below(longest)).min(input.len())
    }

    fn move_range(&mut self, input: &mut [u8]) {
        let range = self.range(input);
        let place = self.random.below(input.len() - range.len() + 1);
        input.copy_within(range, place);
    }

    fn splice(&mut self, input: &mut Vec<u8>) {
        let other = self.random.pick(self.corpus);
        let (end, start) = (self.random.below(input.len() + 1), self.random.below(other.len() + 1));
        input.truncate(end);
        input.extend_from_slice(&other[start..]);
    }

    fn word(&mut self, input: &mut Vec<u8>) {
        if !self.words.is_empty() {
            let word = self.random.pick(self.words).as_bytes();
            self.insert(input, word);
        }
    }

    /// Replaces a number that is written in digits.
    fn number(&mut self, input: &mut Vec<u8>) {
        let part = |byte: &u8| byte.is_ascii_digit() || matches!(byte, b'.' | b'-' | b'+' | b'e' | b'E');
        let from = self.random.below(input.len());
        let Some(start) = input.iter().skip(from).position(u8::is_ascii_digit).map(|found| from + found)
        else {
            return;
        };
        let end = start + input[start..].iter().take_while(|byte| part(byte)).count();
        let number = self.random.pick(&NUMBERS).as_bytes();
        input.splice(start..end, number.iter().copied());
    }

    /// Overwrites bytes by a binary integer of either byte order.
    fn count(&mut self, input: &mut [u8]) {
        let value = *self.random.pick(&COUNTS);
        let width = *self.random.pick(&[2, 4, 8]);
        let bytes = if self.random.below(2) == 0 {
            value.to_le_bytes()
        } else {
            (value << (64 - 8 * width)).to_be_bytes()
        };
        let place = self.random.below(input.len());
        for (byte, new) in input.iter_mut().skip(place).zip(&bytes[..width]) {
            *byte = *new;
        }
    }

    /// Repeats or removes a line.
    fn line(&mut self, input: &mut Vec<u8>) {
        let from = self.random.below(input.len());
        let before = input.iter().take(from).rposition(|byte| *byte == b'\n').map_or(0, |place| place + 1);
        let after = input
            .iter()
            .skip(from)
            .position(|byte| *byte == b'\n')
            .map_or(input.len(), |place| from + place + 1);
        if self.random.below(2) == 0 {
            input.drain(before..after);
        } else {
            let line = input[before..after].to_vec();
            self.insert(input, &line);
        }
    }
}
