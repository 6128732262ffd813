//! MAT file of version 5, little-endian, without compression.

use super::{ArrayValue, NamedArray};

/// Types of data elements.
const INT8: u32 = 1;
const UINT16: u32 = 4;
const INT32: u32 = 5;
const UINT32: u32 = 6;
const DOUBLE: u32 = 9;
const MATRIX: u32 = 14;
/// Classes of arrays.
const CELL_CLASS: u32 = 1;
const CHAR_CLASS: u32 = 4;
const DOUBLE_CLASS: u32 = 6;
/// Length of the description at the beginning, and what follows it: no subsystem, version 1.0, the order of bytes.
const DESCRIPTION: usize = 116;
const VERSION: [u8; 12] = *b"\0\0\0\0\0\0\0\0\0\x01IM";
/// Bytes that every element fills up to.
const ALIGNED: usize = 8;

/// The bytes of a file.
pub fn file(arrays: &[NamedArray]) -> Vec<u8> {
    let mut bytes = format!("{:DESCRIPTION$}", "MATLAB 5.0 MAT-file, written by quasirigid").into_bytes();
    bytes.extend(VERSION);
    arrays.iter().for_each(|NamedArray { name, value }| bytes.extend(array(name, value)));
    bytes
}

fn array(name: &str, value: &ArrayValue) -> Vec<u8> {
    match value {
        ArrayValue::Matrix { size: [rows, columns], entries } => {
            let by_columns = (0..*columns).flat_map(|k| (0..*rows).map(move |i| entries[i * columns + k]));
            let numbers: Vec<u8> = by_columns.flat_map(f64::to_le_bytes).collect();
            matrix(DOUBLE_CLASS, [*rows, *columns], name, &element(DOUBLE, &numbers))
        }
        ArrayValue::Text(text) => {
            let letters: Vec<u16> = text.encode_utf16().collect();
            let bytes: Vec<u8> = letters.iter().flat_map(|letter| letter.to_le_bytes()).collect();
            matrix(CHAR_CLASS, [1, letters.len()], name, &element(UINT16, &bytes))
        }
        ArrayValue::Texts(texts) => {
            let cells: Vec<u8> =
                texts.iter().flat_map(|text| array("", &ArrayValue::Text(text.clone()))).collect();
            matrix(CELL_CLASS, [texts.len(), 1], name, &cells)
        }
    }
}

fn matrix(class: u32, size: [usize; 2], name: &str, data: &[u8]) -> Vec<u8> {
    let flags: Vec<u8> = [class, 0].into_iter().flat_map(u32::to_le_bytes).collect();
    let size: Vec<u8> = size.into_iter().flat_map(|length| (length as i32).to_le_bytes()).collect();
    let parts =
        [element(UINT32, &flags), element(INT32, &size), element(INT8, name.as_bytes()), data.to_vec()];
    element(MATRIX, &parts.concat())
}

/// Data with its type and length, filled up.
fn element(kind: u32, data: &[u8]) -> Vec<u8> {
    let mut bytes: Vec<u8> = [kind, data.len() as u32].into_iter().flat_map(u32::to_le_bytes).collect();
    bytes.extend(data);
    bytes.resize(bytes.len().next_multiple_of(ALIGNED), 0);
    bytes
}
