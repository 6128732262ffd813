//! Streams of tables as a consumer in C takes them: every buffer is read, every release called, once. Needs no Python, and runs under Miri.
#![allow(unsafe_code)]

#[path = "../src/arrow.rs"]
mod arrow;
#[path = "../src/series.rs"]
mod series;

use std::ffi::{CStr, c_char, c_int, c_void};
use std::mem::MaybeUninit;
use std::sync::Arc;

use series::{Series, Values};

/// The structs as the interface has them, written down here again.
#[repr(C)]
struct Schema {
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

#[repr(C)]
struct Array {
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

#[repr(C)]
struct Stream {
    get_schema: unsafe extern "C" fn(*mut Stream, *mut Schema) -> c_int,
    get_next: unsafe extern "C" fn(*mut Stream, *mut Array) -> c_int,
    get_last_error: unsafe extern "C" fn(*mut Stream) -> *const c_char,
    release: Option<unsafe extern "C" fn(*mut Stream)>,
    private: *mut c_void,
}

const ROWS: usize = 9;

fn table() -> Arc<Vec<Series>> {
    let column = |name: &str, values| Series { name: name.into(), unit: String::new(), values };
    let truths = (0..ROWS).map(|row| (row != 2).then_some(row % 2 == 0)).collect();
    let texts = (0..ROWS).map(|row| (row != 8).then(|| "é".repeat(row))).collect();
    let series = vec![
        Series::numbers("wx", "rad/s", (0..ROWS).map(|row| row as f64).collect()),
        column("row", Values::Counts(Arc::new((0..ROWS as i64).collect()))),
        column("valid", Values::Booleans(Arc::new(truths))),
        column("note", Values::Texts(Arc::new(texts))),
        Series::texts("cut\0off", vec!["a".to_owned(); ROWS]),
    ];
    assert!(series.iter().all(|series| series.rows() == ROWS));
    Arc::new(series)
}

/// A struct that a function of the interface fills.
fn filled<T>(fill: impl FnOnce(*mut T) -> c_int) -> T {
    let mut place = MaybeUninit::uninit();
    assert_eq!(fill(place.as_mut_ptr()), 0);
    // SAFETY: a function that returns zero has filled the struct.
    unsafe { place.assume_init() }
}

#[test]
fn consumer_reads_every_value_and_releases_everything() {
    assert_eq!((arrow::STREAM, arrow::SCHEMA), (c"arrow_array_stream", c"arrow_schema"));
    let table = table();
    let mut made = arrow::Stream::new(Arc::clone(&table), ROWS);
    let stream: *mut Stream = (&raw mut made).cast();
    // SAFETY: calls as the interface allows them, on structs that are not released yet; buffers are read within their lengths.
    unsafe {
        let mut schema: Schema = filled(|out| ((*stream).get_schema)(stream, out));
        let names: Vec<_> = (0..schema.n_children as usize)
            .map(|child| {
                let child = &**schema.children.add(child);
                (CStr::from_ptr(child.format).to_str().unwrap(), CStr::from_ptr(child.name).to_str().unwrap())
            })
            .collect();
        assert_eq!(names, [("g", "wx"), ("l", "row"), ("b", "valid"), ("U", "note"), ("U", "cut")]);
        let unit = std::slice::from_raw_parts((**schema.children).metadata.cast::<u8>(), 4 + 4 + 4 + 4 + 5);
        assert_eq!(&unit[8..12], b"unit");
        assert_eq!(&unit[16..], b"rad/s");
        assert_eq!((schema.flags, CStr::from_ptr(schema.format)), (0, c"+s"));
        assert!(schema.dictionary.is_null() && schema.metadata.is_null() && !schema.private.is_null());

        let mut array: Array = filled(|out| ((*stream).get_next)(stream, out));
        assert_eq!((array.length, array.n_children, array.null_count, array.offset), (9, 5, 0, 0));
        let column = |index: usize| &**array.children.add(index);
        let buffer = |column: &Array, index: usize| *column.buffers.add(index);
        let numbers = std::slice::from_raw_parts(buffer(column(0), 1).cast::<f64>(), ROWS);
        assert_eq!(numbers[8], 8.0);
        let counts = std::slice::from_raw_parts(buffer(column(1), 1).cast::<i64>(), ROWS);
        assert_eq!(counts[7], 7);
        let bits = |index: usize| std::slice::from_raw_parts(buffer(column(2), index).cast::<u8>(), 2);
        assert_eq!((bits(0), bits(1)), (&[0b1111_1011, 1][..], &[0b0101_0001, 1][..]));
        let ends = std::slice::from_raw_parts(buffer(column(3), 1).cast::<i64>(), ROWS + 1);
        let bytes = std::slice::from_raw_parts(buffer(column(3), 2).cast::<u8>(), ends[ROWS] as usize);
        assert_eq!(std::str::from_utf8(&bytes[ends[2] as usize..ends[3] as usize]), Ok("éé"));
        assert_eq!(
            (column(3).null_count, column(3).n_buffers, buffer(column(4), 0)),
            (1, 3, std::ptr::null())
        );
        assert!(array.dictionary.is_null() && !array.private.is_null());

        let end: Array = filled(|out| ((*stream).get_next)(stream, out));
        assert!(end.release.is_none(), "an array that is released is the end");
        assert!(((*stream).get_last_error)(stream).is_null() && !(*stream).private.is_null());

        // A child may be moved out, and outlives its parent.
        let mut moved = std::ptr::read(*array.children.add(3));
        (**array.children.add(3)).release = None;
        array.release.unwrap()(&raw mut array);
        assert!(array.release.is_none());
        let ends = std::slice::from_raw_parts((*moved.buffers.add(1)).cast::<i64>(), ROWS + 1);
        assert_eq!(ends[ROWS], 56);
        moved.release.unwrap()(&raw mut moved);
        let mut child = std::ptr::read(*schema.children);
        (**schema.children).release = None;
        schema.release.unwrap()(&raw mut schema);
        child.release.unwrap()(&raw mut child);
        (*stream).release.unwrap()(stream);
        assert!((*stream).release.is_none());
    }
    drop(made);
    assert_eq!(Arc::strong_count(&table), 1, "nothing is left");
}

#[test]
fn what_no_consumer_takes_is_dropped() {
    let table = table();
    drop(arrow::Schema::of(&table));
    drop(arrow::Stream::new(Arc::clone(&table), ROWS));
    assert_eq!(Arc::strong_count(&table), 1);
}
