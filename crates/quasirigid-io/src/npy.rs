//! NumPy arrays of version 1 as they are written: name in an archive, header, texts.

/// Alignment of the data of an array.
const ALIGNED: usize = 64;
/// Beginning of an array file of version 1.
pub(crate) const MAGIC: &[u8] = b"\x93NUMPY\x01\x00";

/// Name of the file of a column in the archive; what a path could not hold is replaced.
pub(crate) fn member(name: &str) -> String {
    format!("{}.npy", name.replace(['/', '\\', '\0'], "_"))
}

/// A text as an array without dimensions, in UTF-32.
pub(crate) fn text(text: &str) -> Vec<u8> {
    let letters: Vec<u32> = text.chars().map(u32::from).collect();
    let mut bytes = header(&format!("<U{}", letters.len()), "()");
    bytes.extend(letters.into_iter().flat_map(u32::to_le_bytes));
    bytes
}

/// Header of an array of this type and shape.
pub(crate) fn header(kind: &str, shape: &str) -> Vec<u8> {
    let text = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}");
    let before = MAGIC.len() + 2;
    let whole = (before + text.len() + 1).next_multiple_of(ALIGNED);
    let length = whole - before;
    let mut bytes = MAGIC.to_vec();
    bytes.extend((length as u16).to_le_bytes());
    bytes.extend(format!("{text:<width$}\n", width = length - 1).bytes());
    bytes
}
