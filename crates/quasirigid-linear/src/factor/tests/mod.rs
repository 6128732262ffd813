//! Tests of what the factor does not show: refinements that are left out, and the pieces of large matrices.
//! Solutions are tested in `tests/suite`, against the library as it is compiled already.

mod samples;

use super::*;
use crate::symmetric::Pattern;

/// Solutions are large along (1, −1), which is soft, and wrong along (1, 1), whose stiffness is 2.
#[test]
fn a_residual_of_a_few_roundings_is_not_refined() {
    let softness = 1e-6;
    let times = |x: &[f64]| {
        let (stiff, soft) = ((2.0 - softness) * (x[0] + x[1]) / 2.0, softness * (x[0] - x[1]) / 2.0);
        vec![stiff + soft, stiff - soft]
    };
    let products = |roundings: f64| {
        let count = std::cell::Cell::new(0);
        let precondition = |x: &mut [f64]| {
            count.set(count.get() + 1);
            let (stiff, soft) = ((x[0] + x[1]) / 2.0 / (2.0 - softness), (x[0] - x[1]) / 2.0 / softness);
            let error = roundings * f64::EPSILON * soft / 2.0;
            x.copy_from_slice(&[stiff + soft + error, stiff - soft + error]);
        };
        let system =
            System { width: 1, scale: &[1.0; 2], times: &times, exact: true, precondition: &precondition };
        let _ = system.solve(&mut [1.0, -1.0], 1e-14, 10);
        count.get()
    };
    assert_eq!([products(7.0), products(9.0)], [1, 2]);
}

#[test]
fn large_matrices_are_cut_into_branches_and_separators() {
    let pieces = |matrix: &Symmetric, ordering| Structure::new(matrix, ordering).unwrap().pieces();
    let [branches, separators] = pieces(&samples::cut(), Ordering::Automatic);
    assert!(branches > 4 && separators > 2, "{branches} branches, {separators} separators");
    for ordering in [
        Ordering::MinimumDegree,
        #[cfg(feature = "metis")]
        Ordering::Metis,
        Ordering::Scotch,
    ] {
        assert!(pieces(&samples::uneven(), ordering)[0] > 0, "{ordering:?}");
    }
}
