//! Damaged files are refused without a panic and without more memory than their size explains.

use std::path::Path;

use proptest::prelude::*;
use quasirigid_io::mesh::mesh_of;

use super::bytes;
use super::zoo::{CONTAINERS, GMSH, VTK};
use crate::heap::watched;

/// No file of 20 kB needs more, even if it is compressed a thousand times.
const MOST: usize = 32 * 1024 * 1024;

/// Reads bytes; a mesh that results is consistent.
fn read(bytes: &[u8]) -> Result<(), TestCaseError> {
    let (mesh, largest) = watched(|| mesh_of(Path::new("nowhere/a"), bytes));
    if let Ok(mesh) = mesh {
        prop_assert_eq!(mesh.nodes.len(), mesh.node_labels.len());
        prop_assert!(mesh.nodes.iter().flatten().all(|x| x.is_finite()));
        for cell in &mesh.cells {
            prop_assert_eq!(cell.nodes.len(), cell.shape.nodes());
            prop_assert!(cell.nodes.iter().all(|node| *node < mesh.nodes.len()));
        }
        for set in &mesh.sets {
            prop_assert!(set.nodes.is_sorted_by(|a, b| a < b) && set.cells.is_sorted_by(|a, b| a < b));
            prop_assert!(set.nodes.last().is_none_or(|node| *node < mesh.nodes.len()));
            prop_assert!(set.cells.last().is_none_or(|cell| *cell < mesh.cells.len()));
        }
    }
    prop_assert!(largest < MOST, "{} bytes at once", largest);
    Ok(())
}

fn file() -> impl Strategy<Value = Vec<u8>> {
    let files = [&GMSH[..], &VTK, &CONTAINERS, &["zoo.inp", "block.vtk", "mixed.bdf"]].concat();
    prop::sample::select(files).prop_map(bytes)
}

/// Runs of digits in a text, as ranges.
fn numbers(bytes: &[u8]) -> Vec<std::ops::Range<usize>> {
    let mut numbers: Vec<std::ops::Range<usize>> = Vec::new();
    for (at, byte) in bytes.iter().enumerate() {
        match numbers.last_mut() {
            Some(number) if byte.is_ascii_digit() && number.end == at => number.end += 1,
            _ if byte.is_ascii_digit() => numbers.push(at..at + 1),
            _ => {}
        }
    }
    numbers
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1500, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn beginnings_are_read_or_refused(file in file(), end in any::<prop::sample::Index>()) {
        read(&file[..end.index(file.len())])?;
    }

    #[test]
    fn changed_bytes_are_read_or_refused(
        file in file(),
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..4),
    ) {
        let mut file = file;
        for (at, byte) in changes {
            let at = at.index(file.len());
            file[at] = byte;
        }
        read(&file)?;
    }

    #[test]
    fn changed_numbers_are_read_or_refused(
        file in file(),
        which in any::<prop::sample::Index>(),
        number in prop::sample::select(
            ["0", "-1", "7", "1000000000", "18446744073709551615", "99999999999999999999", "nan", "1e999", ""].as_slice(),
        ),
    ) {
        let mut file = file;
        let numbers = numbers(&file);
        file.splice(numbers[which.index(numbers.len())].clone(), number.bytes());
        read(&file)?;
    }

    /// Eight bytes of a binary file at once: counts, types and offsets.
    #[test]
    fn changed_words_are_read_or_refused(
        file in file(),
        at in any::<prop::sample::Index>(),
        word in prop::sample::select([0, 1, 5, 1 << 32, 1_000_000_000, i64::MAX as u64, u64::MAX].as_slice()),
    ) {
        let mut file = file;
        let at = at.index(file.len() - 8);
        file[at..at + 8].copy_from_slice(&word.to_le_bytes());
        read(&file)?;
    }
}
