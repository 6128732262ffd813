//! Rows of a VOTable in binary form, `BINARY` and `BINARY2` (IVOA Recommendation 1.4, §§ 2, 5.2 and 5.3), in base64 within the file.
//! Each value becomes the text that `TABLEDATA` would have; numbers keep every bit.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use roxmltree::Node;

use super::super::bodies::BodyTable;

/// What a field holds, by its `datatype`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Boolean,
    Bit,
    UnsignedByte,
    Short,
    Int,
    Long,
    Char,
    UnicodeChar,
    Float,
    Double,
    FloatComplex,
    DoubleComplex,
}

impl Kind {
    fn of(datatype: &str) -> Option<Self> {
        Some(match datatype {
            "boolean" => Self::Boolean,
            "bit" => Self::Bit,
            "unsignedByte" => Self::UnsignedByte,
            "short" => Self::Short,
            "int" => Self::Int,
            "long" => Self::Long,
            "char" => Self::Char,
            "unicodeChar" => Self::UnicodeChar,
            "float" => Self::Float,
            "double" => Self::Double,
            "floatComplex" => Self::FloatComplex,
            "doubleComplex" => Self::DoubleComplex,
            _ => return None,
        })
    }

    /// Bytes of some values.
    fn size(self, count: usize) -> Option<usize> {
        match self {
            Self::Bit => Some(count.div_ceil(8)),
            Self::Boolean | Self::UnsignedByte | Self::Char => Some(count),
            Self::Short | Self::UnicodeChar => count.checked_mul(2),
            Self::Int | Self::Float => count.checked_mul(4),
            Self::Long | Self::Double | Self::FloatComplex => count.checked_mul(8),
            Self::DoubleComplex => count.checked_mul(16),
        }
    }

    /// Text of some values, with blanks between; a missing number is empty.
    fn text(self, bytes: &[u8], count: usize) -> Vec<u8> {
        let words: Vec<String> = match self {
            Self::Char => return bytes.split(|byte| *byte == 0).next().unwrap_or_default().to_vec(),
            Self::UnicodeChar => {
                let units: Vec<u16> =
                    bytes.as_chunks::<2>().0.iter().map(|unit| u16::from_be_bytes(*unit)).collect();
                let text = units.split(|unit| *unit == 0).next().unwrap_or_default();
                return String::from_utf16_lossy(text).into_bytes();
            }
            Self::Bit => {
                (0..count).map(|k| u8::from(bytes[k / 8] & (0x80 >> (k % 8)) != 0).to_string()).collect()
            }
            Self::Boolean => bytes.iter().map(|byte| truth(*byte).to_owned()).collect(),
            Self::UnsignedByte => bytes.iter().map(u8::to_string).collect(),
            Self::Short => words(bytes, |value| i16::from_be_bytes(value).to_string()),
            Self::Int => words(bytes, |value| i32::from_be_bytes(value).to_string()),
            Self::Long => words(bytes, |value| i64::from_be_bytes(value).to_string()),
            Self::Float | Self::FloatComplex => {
                words(bytes, |value| number(f32::from_be_bytes(value).into()))
            }
            Self::Double | Self::DoubleComplex => words(bytes, |value| number(f64::from_be_bytes(value))),
        };
        words.join(" ").into_bytes()
    }
}

fn words<const N: usize>(bytes: &[u8], word: impl Fn([u8; N]) -> String) -> Vec<String> {
    bytes.as_chunks::<N>().0.iter().map(|value| word(*value)).collect()
}

fn number(value: f64) -> String {
    if value.is_nan() { String::new() } else { format!("{value:?}") }
}

fn truth(byte: u8) -> &'static str {
    match byte {
        b'T' | b't' | b'1' => "true",
        b'F' | b'f' | b'0' => "false",
        _ => "",
    }
}

/// A field: its kind, and the number of its values, none where each row has its own.
struct Field {
    kind: Kind,
    count: Option<usize>,
}

impl Field {
    fn of(node: &Node<'_, '_>) -> Result<Self, String> {
        let datatype = node.attribute("datatype").unwrap_or("char");
        let kind = Kind::of(datatype)
            .ok_or_else(|| format!("a field has the datatype {datatype:?}, which VOTable does not know"))?;
        let size = node.attribute("arraysize").unwrap_or("1").trim();
        let unread =
            || format!("a field has the arraysize {size:?}; give numbers between x, the last perhaps with *");
        if size.ends_with('*') {
            return Ok(Self { kind, count: None });
        }
        let lengths = size.split('x').map(|length| length.trim().parse::<usize>().ok());
        let count = lengths.reduce(|a, b| a?.checked_mul(b?)).flatten().ok_or_else(unread)?;
        Ok(Self { kind, count: Some(count) })
    }

    /// Takes the text of the next value.
    fn take(&self, rest: &mut &[u8]) -> Option<Vec<u8>> {
        let count = match self.count {
            Some(count) => count,
            None => u32::from_be_bytes(*rest.split_off(..4)?.first_chunk()?) as usize,
        };
        let bytes = rest.split_off(..self.kind.size(count)?)?;
        Some(self.kind.text(bytes, count))
    }
}

/// Adds the rows of a stream; `flagged` where a row begins with the marks of its missing values, as in `BINARY2`.
pub(super) fn rows(
    stream: &Node<'_, '_>,
    fields: &[Node<'_, '_>],
    nulls: &[Option<&str>],
    flagged: bool,
    read: &mut BodyTable,
) -> Result<(), String> {
    if stream.attribute("href").is_some() {
        return Err("its rows stand in another file; save the VOTable as TABLEDATA, or as CSV".to_owned());
    }
    let encoding = stream.attribute("encoding").unwrap_or("base64");
    if encoding != "base64" {
        return Err(format!(
            "its rows are encoded as {encoding:?}; save the VOTable as TABLEDATA, or as CSV"
        ));
    }
    let fields = fields.iter().map(Field::of).collect::<Result<Vec<Field>, String>>()?;
    let mut text = stream.text().unwrap_or_default().as_bytes().to_vec();
    text.retain(|byte| !byte.is_ascii_whitespace());
    let bytes = STANDARD.decode(text).map_err(|cause| format!("its rows are not base64: {cause}"))?;
    let mut rest = bytes.as_slice();
    let mut row = 0;
    while !rest.is_empty() {
        let before = rest.len();
        row += 1;
        let cut = || {
            format!(
                "row {row} of its binary rows ends within a value; the file is cut or its fields are not those of the rows"
            )
        };
        let flags = if flagged { rest.split_off(..fields.len().div_ceil(8)).ok_or_else(cut)? } else { &[] };
        let mut values = Vec::with_capacity(fields.len());
        for (k, field) in fields.iter().enumerate() {
            let value = field.take(&mut rest).ok_or_else(cut)?;
            let missing = flags.get(k / 8).is_some_and(|byte| byte & (0x80 >> (k % 8)) != 0);
            let null = nulls.get(k).copied().flatten().is_some_and(|null| null.as_bytes() == value);
            values.push(if missing || null { Vec::new() } else { value });
        }
        if rest.len() == before {
            return Err("its fields have no length; the rows cannot be told apart".to_owned());
        }
        read.add(row, Some(values));
    }
    Ok(())
}
