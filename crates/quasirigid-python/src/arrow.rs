//! Tables through the Arrow C data interface: three structs of C, filled in by hand.
//! pandas, polars, DuckDB and pyarrow read them without a copy and without a library of Arrow here. Numbers are `float64`, counts `int64`,
//! truth values `bool`, texts `large_utf8`; the unit of a column stands in the metadata of its field. One batch holds all rows.
//! Apache Arrow, The Arrow C data interface and The Arrow PyCapsule interface.
#![allow(unsafe_code)]

use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::ptr::{null, null_mut};
use std::sync::Arc;

use crate::series::{Series, Values};

/// Names that the capsules must have.
pub const STREAM: &CStr = c"arrow_array_stream";
pub const SCHEMA: &CStr = c"arrow_schema";

/// Flag of a field that may be null, which the interface expects of columns of a table.
const NULLABLE: i64 = 2;
const NO_MEMORY: c_int = 12;

/// `struct ArrowSchema`.
#[repr(C)]
pub struct Schema {
    format: *const c_char,
    name: *const c_char,
    metadata: *const c_char,
    flags: i64,
    n_children: i64,
    children: *mut *mut Schema,
    dictionary: *mut Schema,
    release: Option<unsafe extern "C" fn(*mut Schema)>,
    private: *mut c_void,
}

/// `struct ArrowArray`.
#[repr(C)]
pub struct Array {
    length: i64,
    null_count: i64,
    offset: i64,
    n_buffers: i64,
    n_children: i64,
    buffers: *mut *const c_void,
    children: *mut *mut Array,
    dictionary: *mut Array,
    release: Option<unsafe extern "C" fn(*mut Array)>,
    private: *mut c_void,
}

/// `struct ArrowArrayStream`.
#[repr(C)]
pub struct Stream {
    get_schema: Option<unsafe extern "C" fn(*mut Stream, *mut Schema) -> c_int>,
    get_next: Option<unsafe extern "C" fn(*mut Stream, *mut Array) -> c_int>,
    get_last_error: Option<unsafe extern "C" fn(*mut Stream) -> *const c_char>,
    release: Option<unsafe extern "C" fn(*mut Stream)>,
    private: *mut c_void,
}

// SAFETY: the structs own what they point to, and nothing in it belongs to one thread.
unsafe impl Send for Schema {}
// SAFETY: as for a schema.
unsafe impl Send for Stream {}

/// Memory behind a schema.
struct SchemaParts {
    _name: CString,
    _metadata: Vec<u8>,
    children: Vec<*mut Schema>,
}

/// Memory behind an array: the column itself, or its values in the form of the interface.
struct ArrayParts {
    _column: Option<Values>,
    _made: Made,
    buffers: Vec<*const c_void>,
    children: Vec<*mut Array>,
}

/// Values in the form of the interface: bits of the rows that are there, ends of the texts, and the texts joined or the bits of truth values.
#[derive(Default)]
struct Made {
    valid: Vec<u8>,
    ends: Vec<i64>,
    bytes: Vec<u8>,
}

/// Bits of the rows that are there, and the number of those that are not.
fn validity<T>(values: &[Option<T>]) -> (Vec<u8>, usize) {
    (bits(values.iter().map(Option::is_some)), values.iter().filter(|value| value.is_none()).count())
}

/// Truth values as bits, the first the lowest of the first byte.
fn bits(truths: impl Iterator<Item = bool>) -> Vec<u8> {
    let mut bytes = Vec::new();
    for (index, truth) in truths.enumerate() {
        if index % 8 == 0 {
            bytes.push(0);
        }
        if let Some(last) = bytes.last_mut() {
            *last |= u8::from(truth) << (index % 8);
        }
    }
    bytes
}

/// Memory behind a stream: the table, until it is handed on.
struct StreamParts {
    series: Arc<Vec<Series>>,
    rows: usize,
    done: bool,
}

impl Schema {
    /// The fields of a table.
    pub fn of(series: &[Series]) -> Self {
        let children = series.iter().map(|series| {
            let format = match series.values {
                Values::Numbers(_) => c"g",
                Values::Counts(_) => c"l",
                Values::Booleans(_) => c"b",
                Values::Texts(_) => c"U",
            };
            Box::into_raw(Box::new(Self::new(format, &series.name, unit(series), Vec::new())))
        });
        let mut schema = Self::new(c"+s", "", Vec::new(), children.collect());
        schema.flags = 0;
        schema
    }

    fn new(format: &'static CStr, name: &str, metadata: Vec<u8>, children: Vec<*mut Self>) -> Self {
        // A name ends at the first zero byte; names are printable texts.
        let name = CString::new(name.split('\0').next().unwrap_or_default()).unwrap_or_default();
        let mut parts = Box::new(SchemaParts { _name: name, _metadata: metadata, children });
        Self {
            format: format.as_ptr(),
            name: parts._name.as_ptr(),
            metadata: if parts._metadata.is_empty() { null() } else { parts._metadata.as_ptr().cast() },
            flags: NULLABLE,
            n_children: parts.children.len() as i64,
            children: parts.children.as_mut_ptr(),
            dictionary: null_mut(),
            release: Some(release_schema),
            private: Box::into_raw(parts).cast(),
        }
    }
}

impl Drop for Schema {
    fn drop(&mut self) {
        if let Some(release) = self.release {
            // SAFETY: a schema that was not moved out of still has its release function and its parts.
            unsafe { release(self) }
        }
    }
}

/// The unit of a column as metadata of a field: the number of pairs, and each text behind its length.
fn unit(series: &Series) -> Vec<u8> {
    if series.unit.is_empty() {
        return Vec::new();
    }
    let mut bytes = 1i32.to_ne_bytes().to_vec();
    for text in ["unit", &series.unit] {
        bytes.extend((text.len() as i32).to_ne_bytes());
        bytes.extend(text.as_bytes());
    }
    bytes
}

impl Array {
    /// The rows of a table.
    fn of(series: &[Series], rows: usize) -> Self {
        let children = series.iter().map(|series| Box::into_raw(Box::new(Self::column(series, rows))));
        Self::new(rows, vec![null()], children.collect(), None, Made::default())
    }

    fn column(series: &Series, rows: usize) -> Self {
        let plain = |values: *const c_void| {
            Self::new(rows, vec![null(), values], Vec::new(), Some(series.values.clone()), Made::default())
        };
        match &series.values {
            Values::Numbers(numbers) => plain(numbers.as_ptr().cast()),
            Values::Counts(counts) => plain(counts.as_ptr().cast()),
            Values::Booleans(truths) => {
                let truths = &truths[..rows];
                let (valid, nulls) = validity(truths);
                let bytes = bits(truths.iter().map(|truth| *truth == Some(true)));
                Self::made(rows, nulls, Made { valid, ends: Vec::new(), bytes })
            }
            Values::Texts(texts) => {
                let texts = &texts[..rows];
                let (valid, nulls) = validity(texts);
                let (mut ends, mut bytes) = (vec![0], Vec::new());
                for text in texts {
                    bytes.extend(text.as_deref().unwrap_or_default().as_bytes());
                    ends.push(bytes.len() as i64);
                }
                Self::made(rows, nulls, Made { valid, ends, bytes })
            }
        }
    }

    /// A column whose values are in the form of the interface.
    fn made(rows: usize, nulls: usize, made: Made) -> Self {
        let valid = if nulls == 0 { null() } else { made.valid.as_ptr().cast() };
        let ends = (!made.ends.is_empty()).then(|| made.ends.as_ptr().cast());
        let buffers = [valid].into_iter().chain(ends).chain([made.bytes.as_ptr().cast()]).collect();
        let mut array = Self::new(rows, buffers, Vec::new(), None, made);
        array.null_count = nulls as i64;
        array
    }

    fn new(
        rows: usize,
        buffers: Vec<*const c_void>,
        children: Vec<*mut Self>,
        column: Option<Values>,
        made: Made,
    ) -> Self {
        let mut parts = Box::new(ArrayParts { _column: column, _made: made, buffers, children });
        Self {
            length: rows as i64,
            null_count: 0,
            offset: 0,
            n_buffers: parts.buffers.len() as i64,
            n_children: parts.children.len() as i64,
            buffers: parts.buffers.as_mut_ptr(),
            children: parts.children.as_mut_ptr(),
            dictionary: null_mut(),
            release: Some(release_array),
            private: Box::into_raw(parts).cast(),
        }
    }
}

impl Stream {
    /// A stream of one batch.
    pub fn new(series: Arc<Vec<Series>>, rows: usize) -> Self {
        let parts = Box::new(StreamParts { series, rows, done: false });
        Self {
            get_schema: Some(stream_schema),
            get_next: Some(stream_next),
            get_last_error: Some(stream_error),
            release: Some(release_stream),
            private: Box::into_raw(parts).cast(),
        }
    }
}

impl Drop for Stream {
    fn drop(&mut self) {
        if let Some(release) = self.release {
            // SAFETY: a stream that was not moved out of still has its release function and its parts.
            unsafe { release(self) }
        }
    }
}

unsafe extern "C" fn stream_schema(stream: *mut Stream, out: *mut Schema) -> c_int {
    // SAFETY: the consumer calls with this stream, which is not released, and with room for a schema.
    unsafe {
        let parts = (*stream).private.cast::<StreamParts>();
        out.write(Schema::of(&(*parts).series));
    }
    0
}

unsafe extern "C" fn stream_next(stream: *mut Stream, out: *mut Array) -> c_int {
    // SAFETY: the consumer calls with this stream, which is not released, and with room for an array, one call at a time.
    unsafe {
        let Some(parts) = (*stream).private.cast::<StreamParts>().as_mut() else { return NO_MEMORY };
        if parts.done {
            // The end of a stream is an array that is released.
            out.write_bytes(0, 1);
        } else {
            parts.done = true;
            out.write(Array::of(&parts.series, parts.rows));
        }
    }
    0
}

unsafe extern "C" fn stream_error(_: *mut Stream) -> *const c_char {
    null()
}

unsafe extern "C" fn release_stream(stream: *mut Stream) {
    // SAFETY: released once, as the interface demands; the parts come from a box.
    unsafe {
        drop(Box::from_raw((*stream).private.cast::<StreamParts>()));
        (*stream).release = None;
    }
}

unsafe extern "C" fn release_schema(schema: *mut Schema) {
    // SAFETY: released once, as the interface demands; parts and children come from boxes, and a child that the consumer has moved
    // out of has no release function left, so that dropping its box frees the box alone.
    unsafe {
        let parts = Box::from_raw((*schema).private.cast::<SchemaParts>());
        for child in &parts.children {
            drop(Box::from_raw(*child));
        }
        (*schema).release = None;
    }
}

unsafe extern "C" fn release_array(array: *mut Array) {
    // SAFETY: released once, as the interface demands; parts and children come from boxes, and a child that the consumer has moved
    // out of has no release function left.
    unsafe {
        let parts = Box::from_raw((*array).private.cast::<ArrayParts>());
        for child in &parts.children {
            if let Some(release) = (**child).release {
                release(*child);
            }
            drop(Box::from_raw(*child));
        }
        (*array).release = None;
    }
}
