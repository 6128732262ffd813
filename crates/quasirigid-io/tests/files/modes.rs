//! Matrices and modes of NASTRAN in its own files: OUTPUT2, print and punch, with numbers written here.

use std::path::Path;

use insta::assert_snapshot;
use quasirigid_io::matrix::{Dof, MatrixFile, matrix_of, nodes_of};

use crate::files::op2::{Tape, Word, words};

fn read(name: &str, bytes: &[u8], matrix: Option<&str>) -> MatrixFile {
    matrix_of(Path::new(name), bytes, matrix).unwrap()
}

fn says(name: &str, bytes: &[u8], matrix: Option<&str>) -> String {
    matrix_of(Path::new(name), bytes, matrix).unwrap_err().to_string()
}

/// Two grid points and a scalar point, in an order that is not that of their labels' digits.
const POINTS: [(i64, i64); 3] = [(7, 1), (20, 1), (100, 2)];

fn dofs() -> Vec<Dof> {
    let of = |(node, kind): (i64, i64)| {
        let components = if kind == 1 { 1..=6 } else { 0..=0 };
        components.map(move |component| Dof { node: node as u64, component })
    };
    POINTS.into_iter().flat_map(of).collect()
}

/// Stiffness of thirteen rows: a few strings in each column, one empty column.
fn stiffness() -> Vec<Vec<(i64, Vec<f64>)>> {
    let column = |j: i64| match j {
        4 => Vec::new(),
        _ => vec![(1, vec![0.5 + j as f64, -2.25]), (j.max(4), vec![1e6 + 0.125 * j as f64])],
    };
    (1..=13).map(column).collect()
}

fn expected() -> Vec<(usize, usize, f64)> {
    let mut entries = Vec::new();
    for (column, strings) in stiffness().iter().enumerate() {
        for (first, values) in strings {
            let row = |index: usize| *first as usize - 1 + index;
            entries.extend(values.iter().enumerate().map(|(index, value)| (row(index), column, *value)));
        }
    }
    entries.sort_by_key(|entry| (entry.0, entry.1));
    entries
}

const OMEGA: [f64; 2] = [12.5, 31.25];

/// Value of a shape: mode, point and component, from 0.
fn shape(mode: usize, point: usize, component: usize) -> f64 {
    (1.0 + mode as f64) * 0.5 - 0.25 * point as f64 + 0.125 * component as f64
}

/// Matrices in single and double precision, the rows of the grid points, and modes of two subcases, the first of which is static.
fn tape(mut tape: Tape) -> Vec<u8> {
    let mut rows = Vec::new();
    let (mut first, mut pairs) = (1, Vec::new());
    for (node, kind) in POINTS {
        rows.extend(words![node, first]);
        pairs.extend(words![node, 10 * first + kind]);
        first += if kind == 1 { 6 } else { 1 };
    }
    tape.table("EQEXINS ", &[rows, pairs]);
    tape.matrix("KGG     ", 13, true, &stiffness());
    tape.matrix("MGG     ", 13, false, &stiffness());
    tape.matrix("D       ", 2, false, &[vec![(2, vec![3.5])], vec![], vec![(1, vec![1.0, -1.0])]]);
    let about = |approach: i64, table: i64, subcase: i64, mode: i64| {
        let mut words = words![10 * approach, table, 0, subcase, mode, 0.0, 0.0, 0, 1, 8];
        words.extend(vec![Word::Integer(0); 136]);
        words
    };
    let mut modes = Vec::new();
    for (mode, omega) in (1..).zip(OMEGA) {
        modes.extend(words![mode, mode, omega * omega, omega, omega / 6.25, 1.0, omega * omega]);
    }
    tape.table("LAMA    ", &[about(2, 6, 2, 0), modes]);
    let points = |mode: usize| {
        let mut words = Vec::new();
        for (point, (node, kind)) in POINTS.iter().enumerate() {
            words.extend(words![10 * node + 1, *kind]);
            words.extend((0..6).map(|component| Word::Real(shape(mode, point, component))));
        }
        words
    };
    let static_one = points(9);
    tape.table(
        "OUGV1   ",
        &[about(1, 1, 1, 0), static_one, about(2, 7, 2, 1), points(0), about(2, 7, 2, 2), points(1)],
    );
    tape.end()
}

#[test]
fn matrices_and_modes_of_op2_are_what_was_written() {
    for layout in Tape::each() {
        let bytes = tape(layout);
        for name in ["KGG", "mgg"] {
            let matrix = read("a.op2", &bytes, Some(name));
            assert_eq!((matrix.rows, matrix.columns, matrix.labels), (13, 13, Some(dofs())));
            assert_eq!(matrix.entries, expected(), "{name}");
        }
        let small = read("a.op2", &bytes, Some("D"));
        assert_eq!((small.rows, small.columns, small.labels), (2, 3, None));
        assert_eq!(small.entries, [(0, 2, 1.0), (1, 0, 3.5), (1, 2, -1.0)]);
        let frequencies = read("a.op2", &bytes, Some("frequencies"));
        assert_eq!(frequencies.entries, [(0, 0, OMEGA[0]), (1, 0, OMEGA[1])]);
        assert_shapes(&read("a.op2", &bytes, Some("SHAPES")), &[7, 20]);
    }
}

/// Fails unless the columns are the shapes at the points of these numbers, which are the first ones.
fn assert_shapes(matrix: &MatrixFile, nodes: &[u64]) {
    let dof = |node: u64| (1..=6).map(move |component| Dof { node, component });
    assert_eq!(matrix.labels, Some(nodes.iter().copied().flat_map(dof).collect()));
    assert_eq!((matrix.rows, matrix.columns), (6 * nodes.len(), 2));
    let mut found = vec![[0.0; 2]; matrix.rows];
    matrix.entries.iter().for_each(|(row, column, value)| found[*row][*column] = *value);
    for (row, values) in found.iter().enumerate() {
        assert_eq!(*values, [0, 1].map(|mode| shape(mode, row / 6, row % 6)), "{row}");
    }
}

/// Eigenvectors along the basic axes are turned to those of a grid point: here x, y, z become −y, x, z of a system a quarter turn on.
#[test]
fn shapes_along_the_basic_axes_are_turned_to_those_of_the_points() {
    let mut tape = Tape::new(false, false);
    let system = words![2101, 21, 8, 5, 1, 2, 0, 1.0, 2.0, 3.0, 1.0, 2.0, 4.0, 1.0, 3.0, 3.0];
    tape.table(
        "GEOM1   ",
        &[system, words![4501, 45, 1, 7, 0, 1.0, 2.0, 3.0, 5, 0, 0, 8, 0, 4.0, 5.0, 6.0, 0, 0, 0]],
    );
    let mut about = words![20, 7, 0, 1, 1, 0.0, 0.0, 0, 1, 8];
    about.extend(vec![Word::Integer(0); 136]);
    let points = words![71, 1, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 81, 1, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
    tape.table("BOUGV1  ", &[about, points]);
    let bytes = tape.end();
    let values: Vec<f64> = read("a.op2", &bytes, None).entries.iter().map(|entry| entry.2).collect();
    // x̂ of the system is y, ŷ is −x
    assert_eq!(values, [2.0, -1.0, 3.0, 5.0, -4.0, 6.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    let nodes = nodes_of(Path::new("a.op2"), &bytes).unwrap();
    assert_eq!(nodes.nodes()[0].axes, Some([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]));
    assert_eq!(nodes.nodes()[1].place, [4.0, 5.0, 6.0]);
}

const PRINTED: &str = "1    NASTRAN                                 JANUARY   1, 2020  PAGE 3\n\
    0                                      SUBCASE 1\n\
    \x20                                      R E A L   E I G E N V A L U E S\n\
    \x20  MODE    EXTRACTION      EIGENVALUE            RADIANS             CYCLES            GENERALIZED         GENERALIZED\n\
    \x20   NO.       ORDER                                                                       MASS              STIFFNESS\n\
    \x20       1         1        1.562500E+02        1.250000E+01        1.989437E+00        1.000000E+00        1.562500E+02\n\
    1    NASTRAN                                 JANUARY   1, 2020  PAGE 4\n\
    \x20                                      R E A L   E I G E N V A L U E S\n\
    \x20       2         2        9.765625E+02        3.125000E+01        4.973592E+00        1.000000E+00        9.765625E+02\n\
    1    NASTRAN                                 JANUARY   1, 2020  PAGE 5\n\
    0                                      SUBCASE 2\n\
    \x20                                      R E A L   E I G E N V A L U E S\n\
    \x20       1         1        1.000000E+00        1.000000E+00        1.591549E-01        1.000000E+00        1.000000E+00\n";

/// Shapes as they are printed, and the same punched.
fn tables() -> [String; 2] {
    let (mut printed, mut punched) = (PRINTED.to_owned(), "$TITLE   =A BOX = B\n".to_owned());
    for mode in 0..2 {
        printed += &format!(
            "1    NASTRAN  PAGE {mode}\n0   EIGENVALUE =  {:.6E}\n\
             \x20  CYCLES =  1.0E+00         R E A L   E I G E N V E C T O R   N O .          {}\n\
             \x20     POINT ID.   TYPE          T1             T2             T3             R1             R2             R3\n",
            OMEGA[mode] * OMEGA[mode],
            mode + 1,
        );
        punched += &format!(
            "$SUBTITLE=\n$LABEL   =X\n$EIGENVECTOR\n$REAL OUTPUT\n$SUBCASE ID =           1\n\
             $EIGENVALUE = {:>13.7E}  MODE = {:>5}\n",
            OMEGA[mode] * OMEGA[mode],
            mode + 1,
        );
        for (point, (node, kind)) in POINTS.iter().enumerate() {
            let letter = if *kind == 1 { "G" } else { "S" };
            let value = |component: usize| shape(mode, point, component);
            let all: String = (0..6).map(|component| format!("  {:>13.6E}", value(component))).collect();
            printed += &format!("      {node:>8}      {letter}   {all}\n");
            let three = |first: usize| -> String {
                (first..first + 3).map(|component| format!("{:>18.6E}", value(component))).collect()
            };
            punched += &format!(
                "{node:>10}{letter:>8}{}{:>8}\n-CONT-            {}{:>8}\n",
                three(0),
                7,
                three(3),
                8
            );
        }
    }
    punched += "$TITLE   =A BOX\n$SUBTITLE=\n$LABEL   =X\n$DISPLACEMENTS\n$REAL OUTPUT\n\
        \x20        7       G      1.000000E+00      1.000000E+00      1.000000E+00       9\n";
    [printed, punched]
}

#[test]
fn printed_and_punched_modes_are_those_of_the_first_subcase() {
    for (name, text) in ["a.f06", "a.pch"].iter().zip(tables()) {
        let frequencies = read(name, text.as_bytes(), Some("FREQUENCIES"));
        assert_eq!(frequencies.entries, [(0, 0, OMEGA[0]), (1, 0, OMEGA[1])], "{name}");
        assert_shapes(&read(name, text.as_bytes(), Some("shapes")), &[7, 20]);
        let folded = text.replace('\n', "\r\n");
        assert_shapes(&read(name, folded.as_bytes(), Some("shapes")), &[7, 20]);
    }
    let bad = tables()[0].replacen("3.125000E+01", "3.1250Q0E+01", 1);
    assert_snapshot!(says("a.f06", bad.as_bytes(), Some("FREQUENCIES")), @r#"a.f06:9: "3.1250Q0E+01" is not a number that is allowed here; a mode has its number, order, eigenvalue, frequencies, mass and stiffness, a point its six components"#);
}

/// Eigenvalues with residual vectors replace those without, which come first, on every page of both.
#[test]
fn eigenvalues_after_augmentation_count() {
    let before = PRINTED.replace(
        "E I G E N V A L U E S",
        "E I G E N V A L U E S\n (BEFORE AUGMENTATION OF RESIDUAL VECTORS)",
    );
    let before =
        before.split_once("SUBCASE 2").map(|(first, _)| first.replace("3.125000E+01", "7.0")).unwrap();
    let after = PRINTED
        .replace("E I G E N V A L U E S", "E I G E N V A L U E S\n (AFTER AUGMENTATION OF RESIDUAL VECTORS)");
    let read = read("a.f06", format!("{before}\n{after}").as_bytes(), None);
    assert_eq!(read.entries, [(0, 0, OMEGA[0]), (1, 0, OMEGA[1])]);
}

#[test]
fn what_op2_lacks_is_said() {
    let bytes = tape(Tape::new(false, false));
    assert_snapshot!(says("a.op2", &bytes, None), @r#"a.op2: byte 0: the file has "KGG", "MGG", "D", "FREQUENCIES", "SHAPES"; name one of them"#);
    assert_snapshot!(says("a.op2", &bytes, Some("KAA")), @r#"a.op2: byte 0: there is no matrix "KAA"; the file has "KGG", "MGG", "D", "FREQUENCIES", "SHAPES""#);
    assert_snapshot!(nodes_of(Path::new("a.op2"), &bytes).unwrap_err(), @r#"a.op2: byte 0: the file has no geometry, only "EQEXINS", "KGG", "MGG", "D", "LAMA", "OUGV1"; write it with PARAM,POST,-1 or take the deck"#);
    assert!(says("a.op2", &bytes[..1000], Some("KGG")).contains("was the file cut off"));
}

/// A file cut off anywhere, or with a changed byte, is read or refused.
#[test]
fn damaged_op2_is_refused() {
    let bytes = tape(Tape::new(true, false));
    for end in 0..bytes.len() {
        let _ = matrix_of(Path::new("a.op2"), &bytes[..end], Some("KGG"));
        for value in [0x00, 0x7F, 0xFF] {
            let mut changed = bytes.clone();
            changed[end] = value;
            for name in ["KGG", "SHAPES"] {
                let _ = matrix_of(Path::new("a.op2"), &changed, Some(name));
            }
        }
    }
}
