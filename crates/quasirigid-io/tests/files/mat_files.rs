//! MAT files of MATLAB, written here byte by byte in either order; tests of Python read those of SciPy.

use std::path::Path;

use miniz_oxide::deflate::compress_to_vec_zlib;
use quasirigid_io::matrix::{MatrixFile, matrix_of};

/// Writer of one order of bytes.
#[derive(Clone, Copy)]
struct Writer {
    big_endian: bool,
}

/// Numbers of a data element: type, and bytes of each, the lowest first.
type Numbers = (u32, Vec<Vec<u8>>);

impl Writer {
    fn bytes(self, mut bytes: Vec<u8>) -> Vec<u8> {
        if self.big_endian {
            bytes.reverse();
        }
        bytes
    }

    fn element(self, (kind, numbers): Numbers) -> Vec<u8> {
        let data: Vec<u8> = numbers.into_iter().flat_map(|number| self.bytes(number)).collect();
        let mut element = if (1..=4).contains(&data.len()) {
            let tag = ((data.len() as u32) << 16) | kind;
            [self.bytes(tag.to_le_bytes().into()), data].concat()
        } else {
            let tag = [kind, data.len() as u32].map(|word| self.bytes(word.to_le_bytes().into())).concat();
            [tag, data].concat()
        };
        element.resize(element.len().next_multiple_of(8), 0);
        element
    }

    fn matrix(self, (class, flags): (u32, u32), size: &[i32], name: &str, parts: Vec<Numbers>) -> Vec<u8> {
        let head = [
            (6, words(&[class | flags, 0])),
            (5, size.iter().map(|length| length.to_le_bytes().into()).collect()),
            (1, name.bytes().map(|byte| vec![byte]).collect()),
        ];
        let data: Vec<u8> = head.into_iter().chain(parts).flat_map(|part| self.element(part)).collect();
        let tag = [14, data.len() as u32].map(|word| self.bytes(word.to_le_bytes().into())).concat();
        [tag, data].concat()
    }

    fn compressed(self, element: &[u8]) -> Vec<u8> {
        let packed = compress_to_vec_zlib(element, 6);
        let tag = [15, packed.len() as u32].map(|word| self.bytes(word.to_le_bytes().into())).concat();
        [tag, packed].concat()
    }

    fn file(self, elements: &[Vec<u8>]) -> Vec<u8> {
        let header = format!("{:124}", "MATLAB 5.0 MAT-file, by a test").into_bytes();
        let version = [self.bytes(vec![0, 1]), self.bytes(b"IM".to_vec())].concat();
        [header, version, elements.concat()].concat()
    }
}

fn words(words: &[u32]) -> Vec<Vec<u8>> {
    words.iter().map(|word| word.to_le_bytes().into()).collect()
}

fn doubles(numbers: &[f64]) -> Numbers {
    (9, numbers.iter().map(|number| number.to_le_bytes().into()).collect())
}

const BOTH: [Writer; 2] = [Writer { big_endian: false }, Writer { big_endian: true }];

fn read(bytes: &[u8], name: Option<&str>) -> Result<MatrixFile, String> {
    matrix_of(Path::new("a.mat"), bytes, name).map_err(|error| error.to_string())
}

#[test]
fn full_matrices_of_every_type_are_read_by_columns() {
    let types: [Numbers; 5] = [
        (1, [3i8, -4, 0, 7, 5, 2].map(|n| n.to_le_bytes().into()).into()),
        (3, [3i16, -4, 0, 7, 5, 2].map(|n| n.to_le_bytes().into()).into()),
        (5, [3i32, -4, 0, 7, 5, 2].map(|n| n.to_le_bytes().into()).into()),
        (7, [3f32, -4.0, 0.0, 7.0, 5.0, 2.0].map(|n| n.to_le_bytes().into()).into()),
        doubles(&[3.0, -4.0, 0.0, 7.0, 5.0, 2.0]),
    ];
    let known = vec![(0, 0, 3.0), (0, 2, 5.0), (1, 0, -4.0), (1, 1, 7.0), (1, 2, 2.0)];
    for writer in BOTH {
        for numbers in types.clone() {
            let kind = numbers.0;
            let one = writer.matrix((6, 0), &[2, 3], "A", vec![numbers]);
            let text = writer.matrix((4, 0), &[1, 1], "about", vec![(4, vec![vec![b'x', 0]])]);
            let other = writer.matrix((6, 0), &[1, 1], "long_name", vec![doubles(&[1.5])]);
            let file = writer.file(&[text, writer.compressed(&one), other]);
            let found = read(&file, Some("A")).unwrap();
            assert_eq!((found.rows, found.columns, &found.entries), (2, 3, &known), "type {kind}");
            assert_eq!(read(&file, Some("long_name")).unwrap().entries, [(0, 0, 1.5)]);
            assert_eq!(
                read(&file, None).unwrap_err(),
                "a.mat: the file has \"A\", \"long_name\"; name one of them"
            );
        }
    }
}

#[test]
fn sparse_matrices_are_read() {
    for writer in BOTH {
        let parts = vec![(5, words(&[0, 2, 1])), (5, words(&[0, 2, 2, 3])), doubles(&[1.5, -2.0, 4.0])];
        let file = writer.file(&[writer.matrix((5, 0), &[3, 3], "K", parts)]);
        assert_eq!(read(&file, None).unwrap().entries, [(0, 0, 1.5), (1, 2, 4.0), (2, 0, -2.0)]);
    }
}

#[test]
fn what_is_no_matrix_is_refused() {
    let writer = BOTH[0];
    let whole = writer.file(&[writer.matrix((6, 0), &[2, 1], "A", vec![doubles(&[1.0, 2.0])])]);
    let with = |class: u32, flags: u32, size: &[i32], parts: Vec<Numbers>| {
        read(&writer.file(&[writer.matrix((class, flags), size, "A", parts)]), None).unwrap_err()
    };
    let ones = || doubles(&[1.0, 1.0]);
    for (found, known) in [
        (read(&whole, Some("B")).unwrap_err(), "there is no matrix \"B\"; the file has \"A\""),
        (read(&whole[..whole.len() - 4], None).unwrap_err(), "the file ends within a matrix"),
        (with(6, 0x0800, &[2, 1], vec![ones(), ones()]), "the matrix is complex"),
        (with(6, 0, &[2, 2], vec![ones()]), "the file ends after 2 of 4 entries"),
        (with(6, 0, &[2, 1], vec![doubles(&[1.0, f64::NAN])]), "NaN is not finite"),
        (with(6, 0, &[2, 1], vec![(99, words(&[1, 2]))]), "numbers of the type 99 are not known"),
        (with(1, 0, &[2, 1], vec![]), "the file has no matrix of numbers"),
        (
            with(5, 0, &[2, 2], vec![(5, words(&[0, 1])), (5, words(&[0, 9, 2])), ones()]),
            "9 stands among the row or column pointers",
        ),
        (
            with(5, 0, &[2, 2], vec![(5, words(&[0, 7])), (5, words(&[0, 1, 2])), ones()]),
            "row 8, column 2 lies outside a matrix of 2 rows and 2 columns",
        ),
    ] {
        assert!(found.contains(known), "{found}");
    }
    let mut newer = whole;
    newer[..19].copy_from_slice(b"MATLAB 7.3 MAT-file");
    newer[124..126].copy_from_slice(&[0, 2]);
    assert!(read(&newer, None).unwrap_err().contains("save it with '-v7'"));
}
