//! Archive of NumPy arrays.

use std::io::{self, Cursor, Write};

use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

use super::{ArrayValue, NamedArray};
use crate::npy::{header, member, text};

/// The bytes of an archive.
pub fn archive(arrays: &[NamedArray]) -> io::Result<Vec<u8>> {
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Stored)
        .last_modified_time(zip::DateTime::default());
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for NamedArray { name, value } in arrays {
        archive.start_file(member(name), options)?;
        archive.write_all(&array(value))?;
    }
    Ok(archive.finish()?.into_inner())
}

fn array(value: &ArrayValue) -> Vec<u8> {
    match value {
        ArrayValue::Matrix { size: [rows, columns], entries } => {
            let mut bytes = header("<f8", &format!("({rows}, {columns})"));
            bytes.extend(entries.iter().flat_map(|entry| entry.to_le_bytes()));
            bytes
        }
        ArrayValue::Text(own) => text(own),
        ArrayValue::Texts(texts) => {
            let width = texts.iter().map(|text| text.chars().count()).max().unwrap_or(0).max(1);
            let mut bytes = header(&format!("<U{width}"), &format!("({},)", texts.len()));
            for text in texts {
                let letters = text.chars().map(u32::from).chain(std::iter::repeat(0)).take(width);
                bytes.extend(letters.flat_map(u32::to_le_bytes));
            }
            bytes
        }
    }
}
