//! Tests of the factor: against dense solvers, in every order and precision, and on singular and indefinite matrices.
//! Rows have units from 1e-9 to 1e9, because scaling to a unit diagonal has to make results independent of them.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use nalgebra::{DMatrix, DVector};
use quasirigid_linear::factor::{Analysis, Factor, Method, Ordering, Precision};
use quasirigid_linear::symmetric::{Pattern, Symmetric};
use quasirigid_linear::{threads, watch};

use self::samples::{cut, grid, odd_unit, uneven};

#[path = "../../src/factor/tests/samples.rs"]
mod samples;

fn dense(matrix: &Symmetric) -> DMatrix<f64> {
    let mut dense = DMatrix::zeros(matrix.size(), matrix.size());
    for column in 0..matrix.size() {
        for (row, entry) in matrix.column(column) {
            dense[(row, column)] = entry;
            dense[(column, row)] = entry;
        }
    }
    dense
}

fn right(length: usize) -> Vec<f64> {
    (0..length).map(|i| (i as f64 * 0.7).cos()).collect()
}

fn method(precision: Precision, ordering: Ordering) -> Method {
    Method { precision, ordering }
}

const AUTOMATIC: Method = Method { precision: Precision::Automatic, ordering: Ordering::Automatic };

/// Largest difference of two blocks relative to the largest entry, in units of each unknown.
fn difference(a: &[f64], b: &[f64], unit: impl Fn(usize) -> f64) -> f64 {
    let width = 2;
    let largest = a.iter().enumerate().fold(0.0, |most: f64, (i, a)| most.max((a * unit(i / width)).abs()));
    let gap = a.iter().zip(b).enumerate().map(|(i, (a, b))| ((a - b) * unit(i / width)).abs());
    gap.fold(0.0, f64::max) / largest
}

#[test]
fn solutions_are_those_of_a_dense_solver() {
    for precision in [Precision::Double, Precision::Single] {
        let matrix = grid(4, 5, 0.0, odd_unit);
        let plain = grid(4, 5, 0.0, |_| 1.0);
        let units: Vec<f64> = (0..matrix.size()).map(odd_unit).collect();
        let b: Vec<f64> =
            right(2 * matrix.size()).iter().enumerate().map(|(i, b)| b * units[i / 2]).collect();
        let factor = Factor::new(&matrix, method(precision, Ordering::Automatic)).unwrap();
        let mut x = b;
        assert!(factor.solve(&mut x, 2).residual < 1e-13);
        assert_eq!(factor.work().precision, precision);
        let columns = DMatrix::from_row_slice(matrix.size(), 2, &right(2 * matrix.size()));
        let y = dense(&plain).lu().solve(&columns).unwrap().transpose();
        let expected: Vec<f64> = y.iter().enumerate().map(|(i, y)| y / units[i / 2]).collect();
        // The condition is about 1e3.
        assert!(difference(&expected, &x, odd_unit) < 1e-12, "{precision:?}");
    }
}

#[test]
fn every_order_of_elimination_gives_the_same_solution() {
    let matrix = grid(10, 1, 0.002, |_| 1.0);
    let mut solutions = Vec::new();
    let orderings = [
        Ordering::MinimumDegree,
        #[cfg(feature = "metis")]
        Ordering::Metis,
        Ordering::Scotch,
    ];
    for ordering in orderings {
        let factor = Factor::new(&matrix, method(Precision::Double, ordering)).unwrap();
        assert_eq!(factor.work().ordering, ordering);
        let mut x = right(2 * matrix.size());
        assert!(factor.solve(&mut x, 2).residual < 1e-13);
        solutions.push(x);
    }
    assert!(solutions.iter().all(|x| difference(&solutions[0], x, |_| 1.0) < 1e-12));
    let dissection = Factor::new(&matrix, AUTOMATIC).unwrap().work();
    assert_ne!(dissection.ordering, Ordering::MinimumDegree);
    assert_eq!(dissection.unknowns, matrix.size());
}

#[test]
fn work_is_that_of_a_dense_factor_where_the_matrix_is_full() {
    let matrix = grid(2, 0, 0.1, |_| 1.0);
    let work = Factor::new(&matrix, AUTOMATIC).unwrap().work();
    assert_eq!(work.multiplications, (1..=24).map(|length| f64::from(length * length)).sum::<f64>());
    assert!((24 * 25 / 2..=24 * 24).contains(&work.entries));
}

#[test]
fn an_analysis_tells_what_the_factor_will_take() {
    let matrix = grid(9, 10, 0.0, odd_unit);
    let analysis = Analysis::new(&matrix, Ordering::Automatic).unwrap();
    let told = (analysis.entries(), analysis.multiplications());
    let work = analysis.factor(Precision::Double).unwrap().work();
    assert_eq!((work.entries, work.multiplications), told);
    assert!(told.0 >= matrix.entries().len());
}

#[test]
fn the_same_matrix_gives_the_same_bits() {
    let matrix = grid(9, 10, 0.0, odd_unit);
    for precision in [Precision::Double, Precision::Single] {
        let solution = || {
            let mut x = right(2 * matrix.size());
            let _ = Factor::new(&matrix, method(precision, Ordering::Automatic)).unwrap().solve(&mut x, 2);
            x
        };
        assert!(solution().iter().zip(solution()).all(|(a, b)| a.to_bits() == b.to_bits()));
    }
}

/// A unit diagonal and the smallest eigenvalue `softness`, in units of its own for each row.
fn pair(softness: f64) -> Symmetric {
    let units = [3e-6, 7e5];
    let entry = |i: usize, j: usize| units[i] * units[j] * if i == j { 1.0 } else { softness - 1.0 };
    let mut matrix = Symmetric::zero(Arc::new(Pattern::new(&[0, 2], [&[0][..]].into_iter()).unwrap()));
    matrix.add(&[Some(0), Some(1)], &[entry(0, 0), entry(0, 1), entry(1, 0), entry(1, 1)]).unwrap();
    matrix
}

#[test]
fn a_matrix_is_singular_below_the_line_and_not_above() {
    for precision in [Precision::Double, Precision::Single] {
        let method = method(precision, Ordering::Automatic);
        assert!(Factor::new(&pair(1.02e-13), method).is_ok());
        for softness in [0.98e-13, 1e-15, 0.0, -1e-15, -1e-9, -1e-3] {
            let direction = Factor::new(&pair(softness), method).expect_err("a singular matrix").direction;
            assert!((direction[0] - 1.0).abs() < 1e-9, "{softness:e}: {direction:?}");
            assert!((direction[1] / (3e-6 / 7e5) - 1.0).abs() < 1e-9, "{softness:e}: {direction:?}");
        }
    }
}

#[test]
fn a_free_grid_is_singular_along_its_rigid_motions() {
    for precision in [Precision::Double, Precision::Single] {
        let matrix = grid(9, 0, 0.0, odd_unit);
        let error = Factor::new(&matrix, method(precision, Ordering::Automatic)).unwrap_err();
        let plain = grid(9, 0, 0.0, |_| 1.0);
        let motion: Vec<f64> = error.direction.iter().enumerate().map(|(i, x)| x * odd_unit(i)).collect();
        let most = motion.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let force = plain.times(&motion).iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        assert!(force < 1e-8 * most, "{precision:?}: {force:e} of {most:e}");
    }
}

/// A negative stiffness far from rounding must be found, and the direction must have a negative form.
#[test]
fn an_indefinite_matrix_is_refused_along_a_direction_of_negative_form() {
    let mut matrix = grid(5, 6, 0.0, |_| 1.0);
    let stiffness = matrix.diagonal()[101];
    matrix.add(&[Some(101)], &[-0.8 * stiffness]).unwrap();
    let smallest = dense(&matrix).symmetric_eigenvalues().min();
    assert!(smallest < 0.0, "{smallest}");
    let x = DVector::from(Factor::new(&matrix, AUTOMATIC).unwrap_err().direction);
    let form = x.dot(&(dense(&matrix) * &x)) / x.norm_squared();
    assert!(form < 0.0, "{form} {smallest}");
}

#[test]
fn a_row_without_stiffness_is_named() {
    let mut matrix = Symmetric::zero(Arc::new(Pattern::new(&[0, 3], [].into_iter()).unwrap()));
    for (i, entry) in [2.0, 0.0, f64::NAN].iter().enumerate() {
        matrix.add(&[Some(i as u32)], &[*entry]).unwrap();
    }
    assert_eq!(Factor::new(&matrix, AUTOMATIC).unwrap_err().direction, [0.0, 1.0, 1.0]);
}

/// Second differences of a clamped beam of many short pieces: a condition of 4e9, beyond 32 bits.
#[test]
fn a_slender_beam_falls_back_to_double_precision() {
    let nodes = 300_u32;
    let first: Vec<u32> = (0..=nodes).collect();
    let elements: Vec<[u32; 3]> = (2..nodes).map(|end| [end - 2, end - 1, end]).collect();
    let pattern = Pattern::new(&first, elements.iter().map(|nodes| nodes.as_slice())).unwrap();
    let mut matrix = Symmetric::zero(Arc::new(pattern));
    let bend = [1.0, -2.0, 1.0];
    for nodes in &elements {
        let element: Vec<f64> = (0..9).map(|place| bend[place / 3] * bend[place % 3]).collect();
        matrix.add(&nodes.map(Some), &element).unwrap();
    }
    matrix.add(&[Some(0), Some(1)], &[5.0, -2.0, -2.0, 1.0]).unwrap();
    let eigenvalues = dense(&matrix).symmetric_eigenvalues();
    assert!(eigenvalues.max() / eigenvalues.min() > 1e9);
    let factor = Factor::new(&matrix, method(Precision::Single, Ordering::Automatic)).unwrap();
    assert_eq!(factor.work().precision, Precision::Double);
    let mut x = matrix.times(&vec![1.0; 300]);
    let _ = factor.solve(&mut x, 1);
    // The condition times the rounding.
    assert!(x.iter().all(|x| (x - 1.0).abs() < 1e-5));
}

#[test]
fn nothing_to_solve_is_solved() {
    let empty = Symmetric::zero(Arc::new(Pattern::new(&[0], [].into_iter()).unwrap()));
    let _ = Factor::new(&empty, AUTOMATIC).unwrap().solve(&mut [], 3);
    let mut zero = vec![0.0; 4];
    assert_eq!(Factor::new(&pair(0.5), AUTOMATIC).unwrap().solve(&mut zero, 2).residual, 0.0);
    assert_eq!(zero, [0.0; 4]);
}

#[test]
fn the_bits_do_not_depend_on_the_number_of_threads() {
    let matrix = cut();
    for precision in [Precision::Double, Precision::Single] {
        let solution = |count: usize| {
            let count = count.try_into().unwrap();
            threads::limited(count, || {
                let factor = Factor::new(&matrix, method(precision, Ordering::Automatic)).unwrap();
                let mut x = right(2 * matrix.size());
                let refinement = factor.solve(&mut x, 2);
                assert_eq!(factor.work().precision, precision);
                assert!(refinement.residual < 1e-13, "{precision:?}: {refinement:?}");
                x.into_iter().map(f64::to_bits).collect::<Vec<_>>()
            })
        };
        let alone = solution(1);
        assert!([2, 3, 4].iter().all(|count| solution(*count) == alone), "{precision:?}");
    }
}

/// The same matrix in an order of elimination that shares no supernode with the first.
#[test]
fn branches_and_separators_give_the_solution_of_another_order() {
    let matrix = cut();
    let solution = |ordering: Ordering| {
        let mut x = right(2 * matrix.size());
        let factor = Factor::new(&matrix, method(Precision::Double, ordering)).unwrap();
        assert!(factor.solve(&mut x, 2).residual < 1e-13);
        x
    };
    let gap = difference(&solution(Ordering::Scotch), &solution(Ordering::MinimumDegree), odd_unit);
    assert!(gap < 1e-11, "{gap:e}");
}

#[test]
fn nodes_of_any_size_fill_as_their_unknowns_do() {
    let matrix = uneven();
    let solution = |ordering: Ordering| {
        let mut x = right(2 * matrix.size());
        let factor = Factor::new(&matrix, method(Precision::Double, ordering)).unwrap();
        let refinement = factor.solve(&mut x, 2);
        assert!(refinement.iterations == 0 && refinement.residual < 1e-13, "{refinement:?}");
        (x, factor.work().entries)
    };
    let (reference, least) = solution(Ordering::MinimumDegree);
    for ordering in [
        #[cfg(feature = "metis")]
        Ordering::Metis,
        Ordering::Scotch,
    ] {
        let (x, entries) = solution(ordering);
        assert!(difference(&x, &reference, odd_unit) < 1e-11);
        assert!(entries < 2 * least, "{ordering:?}: {entries}, {least}");
    }
}

#[test]
fn a_negative_pivot_is_found_in_a_branch_and_in_a_separator() {
    let matrix = cut();
    assert!(Factor::new(&matrix, AUTOMATIC).is_ok());
    for unknown in [0, matrix.size() / 3, matrix.size() / 2, matrix.size() - 1] {
        let mut indefinite = matrix.clone();
        indefinite.add(&[Some(unknown as u32)], &[-0.9 * matrix.diagonal()[unknown]]).unwrap();
        assert!(Factor::new(&indefinite, AUTOMATIC).is_err(), "{unknown}");
    }
}

#[test]
fn a_factorisation_tells_how_far_it_is_and_ends_where_it_is_cancelled() {
    let matrix = cut();
    for count in [1, 2] {
        let analysis = Analysis::new(&matrix, Ordering::Automatic).unwrap();
        let cancelled = Arc::new(AtomicBool::new(true));
        let count = count.try_into().unwrap();
        let work =
            || threads::limited(count, || analysis.factor(Precision::Double).map(|factor| factor.work()));
        assert_eq!(watch::cancellable(&cancelled, work), Err(watch::Cancelled));
    }
    let (mut last, mut rises) = (0.0, true);
    let watch = &mut |_: &str, share: f64| {
        rises &= share >= last && share <= 1.0 + 1e-9;
        last = share;
        std::ops::ControlFlow::Continue(())
    };
    let factored =
        watch::watched(watch, || Factor::new(&matrix, AUTOMATIC).map(|factor| factor.work().entries));
    assert!(factored.unwrap().is_ok() && rises);
}

/// What is asked for is no less than what the pieces take: the factor, the matrix in its order, and the updates of as many branches as
/// wait at once.
#[test]
fn memory_is_asked_for_the_threads_that_work() {
    let matrix = cut();
    let analysis = Analysis::new(&matrix, Ordering::Automatic).unwrap();
    let asked =
        |count: usize| threads::limited(count.try_into().unwrap(), || analysis.bytes(Precision::Double));
    let least = 8.0 * analysis.entries() as f64 + 12.0 * matrix.entries().len() as f64;
    assert!(asked(1) > least && asked(2) > asked(1) && asked(4) >= asked(2));
}
