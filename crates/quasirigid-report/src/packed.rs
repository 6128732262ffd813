//! Data that the page holds for its scripts: JSON, and behind it the arrays as bytes, deflated and in base64.
//! The counterpart is `assets/unpack.js`.
//!
//! Neighbours in an array are close, so that its numbers are taken as whole ones, differenced, and written byte by byte: all lowest bytes
//! first. The width, the distance and the number of the differences are those which make the array smallest; nothing is lost.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use maud::{Markup, PreEscaped, html};
use miniz_oxide::deflate::compress_to_vec;
use serde_json::{Value, json};

/// Script that reads the data.
pub const SCRIPT: &str = include_str!("assets/unpack.js");

/// Keys whose texts are arrays in base64.
const ARRAYS: [&str; 11] = [
    "attitude",
    "dissipated",
    "grids",
    "lines",
    "momentum",
    "omega",
    "q",
    "rotors",
    "t",
    "triangles",
    "values",
];
/// Bytes below which no coding is tried.
const UNCODED_BYTES: usize = 256;
/// Effort of the trials, and of the result, from 0 to 10.
const TRIAL: u8 = 1;
const RESULT: u8 = 9;

/// Data as the content of a script that no browser runs.
pub fn data(document: Value) -> Markup {
    html! { (PreEscaped(pack(document))) }
}

/// Text of a line of JSON and the bytes of its arrays.
fn pack(mut document: Value) -> String {
    let mut arrays = Vec::new();
    take_arrays(&mut document, "", &mut arrays);
    let mut bytes = document.to_string().into_bytes();
    bytes.push(b'\n');
    bytes.append(&mut arrays);
    STANDARD.encode(compress_to_vec(&bytes, RESULT))
}

/// Moves the arrays to the bytes; each leaves its offset, length, width, distance and number of differences.
fn take_arrays(value: &mut Value, key: &str, arrays: &mut Vec<u8>) {
    match value {
        Value::Object(entries) => {
            entries.iter_mut().for_each(|(key, value)| take_arrays(value, key, arrays));
        }
        Value::Array(entries) => entries.iter_mut().for_each(|value| take_arrays(value, key, arrays)),
        Value::String(text) if ARRAYS.contains(&key) => {
            if let Ok(bytes) = STANDARD.decode(&*text) {
                let (coding, mut coded) = Coding::smallest(&bytes);
                let Coding { width, distance, times } = coding;
                *value = json!({ "packed": [arrays.len(), coded.len(), width, distance, times] });
                arrays.append(&mut coded);
            }
        }
        _ => {}
    }
}

/// Way to write an array.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Coding {
    /// Bytes of a number.
    width: usize,
    /// Numbers from one to that which is taken from it.
    distance: usize,
    /// Number of times that differences are taken.
    times: usize,
}

impl Coding {
    const PLAIN: Self = Self { width: 1, distance: 1, times: 0 };

    /// The coding that deflates best, and the array in it.
    fn smallest(bytes: &[u8]) -> (Self, Vec<u8>) {
        if bytes.len() < UNCODED_BYTES {
            return (Self::PLAIN, bytes.to_vec());
        }
        let widths = [2, 4, 8].into_iter().filter(|width| bytes.len().is_multiple_of(*width));
        let codings = widths.flat_map(|width| {
            let differences =
                [1, 2, 3].map(|times| [1, 3, 4, 6].map(|distance| Self { width, distance, times }));
            differences.into_iter().flatten().chain([Self { width, ..Self::PLAIN }])
        });
        let coded = std::iter::once(Self::PLAIN).chain(codings).map(|coding| (coding, coding.write(bytes)));
        let least = coded.min_by_key(|(_, coded)| compress_to_vec(coded, TRIAL).len());
        least.expect("plain bytes are among the codings")
    }

    /// The array, coded.
    fn write(self, bytes: &[u8]) -> Vec<u8> {
        let mut numbers: Vec<u64> = bytes.chunks(self.width).map(little_endian).collect();
        for _ in 0..self.times {
            for i in (self.distance..numbers.len()).rev() {
                numbers[i] = numbers[i].wrapping_sub(numbers[i - self.distance]);
            }
        }
        let byte = |place: usize| numbers.iter().map(move |number| (number >> (8 * place)) as u8);
        (0..self.width).flat_map(byte).collect()
    }
}

fn little_endian(bytes: &[u8]) -> u64 {
    bytes.iter().rev().fold(0, |number, byte| (number << 8) | u64::from(*byte))
}
