//! Tests of symmetric matrices: sums of elements, products, sharing of entries, and refusals.
//! Each sum is formed twice, on the pattern and dense; one element names a node twice, whose mirror images fall on the diagonal.

use std::sync::Arc;

use nalgebra::DMatrix;
use proptest::prelude::*;
use quasirigid_linear::sparse::SparseRows;
use quasirigid_linear::symmetric::{Pattern, Symmetric, SymmetricError};
use quasirigid_linear::threads::{self, Team};

/// Nodes with 3, 0, 1 and 2 unknowns, and elements that overlap; the last names a node twice.
const FIRST: [u32; 5] = [0, 3, 3, 4, 6];
const ELEMENTS: [&[u32]; 4] = [&[3, 0], &[1, 2, 0], &[2], &[0, 0]];

/// Unknowns of an element; of three for each node, those that the node lacks are constrained.
fn unknowns(nodes: &[u32]) -> Vec<Option<u32>> {
    let of_node =
        |node: usize| (0..3).map(move |i| FIRST[node] + i).map(move |i| (i < FIRST[node + 1]).then_some(i));
    nodes.iter().flat_map(|node| of_node(*node as usize)).collect()
}

fn symmetric(size: usize, seed: f64) -> Vec<f64> {
    (0..size * size)
        .map(|i| ((i / size * (i % size) + i / size + i % size) as f64 * 1.7 + seed).sin())
        .collect()
}

/// One sum of elements, formed on the pattern and dense.
fn assembled(seed: f64) -> (Symmetric, DMatrix<f64>) {
    let mut sparse = Symmetric::zero(Arc::new(Pattern::new(&FIRST, ELEMENTS.into_iter()).unwrap()));
    let mut dense = DMatrix::zeros(6, 6);
    for (index, nodes) in ELEMENTS.iter().enumerate() {
        let unknowns = unknowns(nodes);
        let element = symmetric(unknowns.len(), seed + index as f64);
        sparse.add(&unknowns, &element).unwrap();
        for (i, row) in unknowns.iter().enumerate() {
            for (j, column) in unknowns.iter().enumerate() {
                if let (Some(row), Some(column)) = (row, column) {
                    dense[(*row as usize, *column as usize)] += element[i * unknowns.len() + j];
                }
            }
        }
    }
    (sparse, dense)
}

/// Many elements over few unknowns, so that every entry is a sum whose order counts.
#[test]
fn elements_added_by_any_number_of_threads_give_the_same_bits() {
    let zero = Symmetric::zero(Arc::new(Pattern::new(&FIRST, ELEMENTS.into_iter()).unwrap()));
    let made: Vec<(Vec<Option<u32>>, Vec<f64>)> = (0..200)
        .map(|index| {
            let unknowns = unknowns(ELEMENTS[index * 7 % 4]);
            let element = symmetric(unknowns.len(), 0.37 * index as f64);
            (unknowns, element)
        })
        .collect();
    let mut expected = zero.clone();
    made.iter().for_each(|(unknowns, element)| expected.add(unknowns, element).unwrap());
    let parts: Vec<(&[Option<u32>], &[f64])> =
        made.iter().map(|(u, e)| (u.as_slice(), e.as_slice())).collect();
    for count in [1, 2, 3, 4, 9] {
        let team = threads::limited(count.try_into().unwrap(), Team::new);
        let mut sum = zero.clone();
        sum.add_all(&parts, &team).unwrap();
        let equal = sum.entries().iter().zip(expected.entries()).all(|(a, b)| a.to_bits() == b.to_bits());
        assert!(equal, "{count} threads");
        assert_eq!(
            sum.add_all(&[(&[Some(1), Some(3)], &[0.0; 3])], &team),
            Err(SymmetricError::Shape { unknowns: 2, entries: 3 })
        );
        let far = [(&[Some(3), Some(5)][..], &[1.0; 4][..])];
        assert_eq!(sum.add_all(&far, &team), Err(SymmetricError::Outside { row: 5, column: 3 }));
    }
    zero.clone().add_all(&[], &Team::alone()).unwrap();
}

/// Every entry, from products with unit vectors.
fn shown(matrix: &Symmetric) -> DMatrix<f64> {
    let columns = (0..6).flat_map(|j| {
        let unit: Vec<f64> = (0..6).map(|i| f64::from(u8::from(i == j))).collect();
        matrix.times(&unit)
    });
    DMatrix::from_iterator(6, 6, columns)
}

#[test]
fn sum_of_elements_is_the_dense_sum() {
    let (sparse, dense) = assembled(0.3);
    assert!((shown(&sparse) - &dense).amax() < 1e-14);
    assert_eq!(sparse.diagonal(), dense.diagonal().as_slice());
    let rows = dense.row_iter().map(|row| row.iter().map(|entry| entry.abs()).sum::<f64>());
    assert!((sparse.norm() - rows.fold(0.0, f64::max)).abs() < 1e-14);
    assert_eq!(sparse.pattern().places(), 6 + 3 + 3 + 6 + 1);
}

#[test]
fn products_of_blocks_are_products_of_their_columns() {
    let (sparse, dense) = assembled(1.1);
    let x = DMatrix::from_fn(6, 4, |i, j| ((3 * i + 5 * j) as f64).cos());
    let rows: Vec<f64> = x.transpose().iter().copied().collect();
    let product = DMatrix::from_row_slice(6, 4, &sparse.times_block(&rows, 4));
    assert!((product - dense * x).amax() < 1e-14);
}

#[test]
fn matrices_on_one_pattern_add_and_scale() {
    let ((a, A), (b, B)) = (assembled(0.2), assembled(2.5));
    let sum = a.plus(-0.7, &b.scaled(3.0)).unwrap();
    assert!((shown(&sum) - (A - 2.1 * B)).amax() < 1e-14);
    let other = Symmetric::zero(Arc::new(Pattern::new(&[0, 2], [].into_iter()).unwrap()));
    assert_eq!(a.plus(1.0, &other), Err(SymmetricError::Patterns { left: 6, right: 2 }));
}

#[test]
fn a_clone_keeps_its_entries_when_the_other_changes() {
    let (mut matrix, dense) = assembled(0.0);
    let copy = matrix.clone();
    matrix.add(&[Some(3)], &[5.0]).unwrap();
    assert!((shown(&copy) - &dense).amax() < 1e-14);
    assert!((shown(&matrix)[(3, 3)] - dense[(3, 3)] - 5.0).abs() < 1e-14);
}

#[test]
fn what_has_no_place_is_refused() {
    let (mut matrix, _) = assembled(0.0);
    let outside = |row, column| Err(SymmetricError::Outside { row, column });
    assert_eq!(matrix.add(&[Some(3), Some(4)], &[1.0; 4]), outside(4, 3));
    assert_eq!(matrix.add(&[Some(6)], &[1.0]), outside(6, 6));
    assert_eq!(matrix.add(&[None; 2], &[1.0; 3]), Err(SymmetricError::Shape { unknowns: 2, entries: 3 }));
    let element: &[u32] = &[1, 4];
    let node = SymmetricError::Node { element: 0, node: 4, count: 4 };
    assert_eq!(Pattern::new(&FIRST, [element].into_iter()), Err(node));
    let unordered = SymmetricError::Unordered { node: 2, first: 1, before: 2 };
    assert_eq!(Pattern::new(&[0, 2, 1], [].into_iter()), Err(unordered));
    assert_eq!(Pattern::new(&[], [].into_iter()).unwrap().size(), 0);
}

proptest! {
    /// A matrix by rows and the matrix of its lower triangle have equal products.
    #[test]
    fn rows_and_triangle_are_one_matrix(parts in prop::collection::vec((0..9_usize, 0..9_usize, -1.0..1.0), 0..40)) {
        let both = parts.iter().flat_map(|(i, j, entry)| [(*i, *j, *entry), (*j, *i, *entry)]).collect();
        let rows = SparseRows::sum(9, both);
        let x: Vec<f64> = (0..9).map(|i| f64::from(i).cos()).collect();
        for (a, b) in Symmetric::from(&rows).times(&x).iter().zip(rows.times(&x)) {
            prop_assert!((a - b).abs() < 1e-13);
        }
    }
}
