//! One body described by different parts: equal in everything that does not name the coordinates.

use proptest::prelude::*;
use quasirigid::elements::{Assembly, HingeCoefficient, PointMotion, SpringLaw};
use quasirigid::model::ReducedBody;
use quasirigid::reduction::reduce;

use super::compare::{gap, list_gap, motion_gap};
use crate::support::transform::{hinge_times, strengthened, with_hinged_cut, with_point_cut};
use crate::support::{bodies, cases};

/// Rounding of some hundred operations per coefficient, grown by the condition of `C` and `J`.
const ROUNDING: f64 = 1e-11;

fn reduced(assembly: &Assembly, order: usize) -> ReducedBody {
    reduce(&assembly.body().unwrap(), order).unwrap()
}

/// The stiffness or damping of a hinge as a matrix.
fn matrix(coefficient: &HingeCoefficient) -> Vec<Vec<f64>> {
    match coefficient {
        HingeCoefficient::Full(rows) => rows.clone(),
        HingeCoefficient::PerAxis(values) => {
            let entry = |i: usize, j: usize| if i == j { values[i] } else { 0.0 };
            (0..values.len()).map(|i| (0..values.len()).map(|j| entry(i, j)).collect()).collect()
        }
    }
}

/// The matrix in the order of permuted axes.
fn permuted(coefficient: &HingeCoefficient, order: &[usize]) -> HingeCoefficient {
    let rows = matrix(coefficient);
    HingeCoefficient::Full(order.iter().map(|i| order.iter().map(|j| rows[*i][*j]).collect()).collect())
}

/// The matrix after the first axis has changed its sense.
fn reversed(coefficient: &HingeCoefficient) -> HingeCoefficient {
    let mut rows = matrix(coefficient);
    for (i, row) in rows.iter_mut().enumerate() {
        for (j, entry) in row.iter_mut().enumerate() {
            *entry *= if (i == 0) == (j == 0) { 1.0 } else { -1.0 };
        }
    }
    HingeCoefficient::Full(rows)
}

proptest! {
    #![proptest_config(cases(32))]

    /// The parts of a point move together, since they have the same springs per mass. Unequal parts. (I2)–(I6), (I9)
    #[test]
    fn cutting_a_point_in_two_changes_nothing(
        assembly in bodies(), which in 0..9usize, share in 0.1..0.9
    ) {
        let cut = with_point_cut(&assembly, which % assembly.points.len(), share);
        let gap = motion_gap(&reduced(&cut, 5), &reduced(&assembly, 5));
        prop_assert!(gap < ROUNDING, "{gap:e}");
    }

    /// The curvature of the paths takes part from order 4. (I6), (I8)
    #[test]
    fn cutting_an_appendage_in_two_changes_nothing(
        assembly in bodies().prop_filter("a hinge", |a| !a.hinged.is_empty()), share in 0.1..0.9
    ) {
        let cut = with_hinged_cut(&assembly, 0, share);
        let gap = motion_gap(&reduced(&cut, 5), &reduced(&assembly, 5));
        prop_assert!(gap < ROUNDING, "{gap:e}");
    }

    /// Springs in parallel sum up. (I9)
    #[test]
    fn springs_in_parallel_are_one_spring(assembly in bodies(), which in 0..9usize, share in 0.1..0.9) {
        let mut parallel = assembly.clone();
        let index = which % assembly.springs.len();
        let law = assembly.springs[index].law;
        parallel.springs[index].law = strengthened(law, share, 1.0 - share);
        let mut other = parallel.springs[index].clone();
        other.law = strengthened(law, 1.0 - share, share);
        parallel.springs.push(other);
        let (one, two) = (reduced(&assembly, 4), reduced(&parallel, 4));
        prop_assert!(motion_gap(&two, &one) < ROUNDING);
        prop_assert!(gap(&two.q, &one.q) < ROUNDING);
    }

    /// A spring is symmetric in its ends. (I9)
    #[test]
    fn a_spring_has_no_first_end(assembly in bodies()) {
        let mut turned = assembly.clone();
        for spring in &mut turned.springs {
            std::mem::swap(&mut spring.from, &mut spring.to);
        }
        let (one, other) = (reduced(&assembly, 4), reduced(&turned, 4));
        prop_assert!(motion_gap(&other, &one) < ROUNDING);
        prop_assert!(gap(&other.q, &one.q) < ROUNDING);
    }

    /// Only the coordinates change places.
    #[test]
    fn the_order_of_the_elements_is_of_no_consequence(assembly in bodies()) {
        let mut other = assembly.clone();
        let last = assembly.points.len() - 1;
        other.points.reverse();
        other.springs.reverse();
        other.hinged.reverse();
        for spring in &mut other.springs {
            for end in [&mut spring.from, &mut spring.to] {
                if let quasirigid::elements::End::Point(index) = end {
                    *index = last - *index;
                }
            }
        }
        let (before, after) = (assembly.body().unwrap(), other.body().unwrap());
        let (one, two) = (reduce(&before, 4).unwrap(), reduce(&after, 4).unwrap());
        prop_assert!(motion_gap(&two, &one) < ROUNDING);
        for degree in 2..=4 {
            for (row, coordinate) in before.coordinates().iter().enumerate() {
                let same = after.coordinates().iter().position(|c| c.name == coordinate.name).unwrap();
                let gap = list_gap(two.q.part(degree).row(same), one.q.part(degree).row(row));
                prop_assert!(gap < 1e-9, "{}: {gap:e}; one coordinate may be small", coordinate.name);
            }
        }
    }

    /// Lengths and senses of directions mean nothing; an axial spring is a spatial one along its line. (I8), (I9)
    #[test]
    fn the_sense_of_a_direction_means_nothing(assembly in bodies()) {
        let mut other = assembly.clone();
        for point in &mut other.points {
            if let PointMotion::Line(direction) | PointMotion::Plane(direction) = &mut point.motion {
                *direction = direction.map(|x| -3.0 * x);
            }
        }
        for hinged in &mut other.hinged {
            hinged.axes[0] = hinged.axes[0].map(|x| -0.2 * x);
            hinged.stiffness = reversed(&hinged.stiffness);
            hinged.damping = reversed(&hinged.damping);
        }
        for spring in &mut other.springs {
            if let SpringLaw::Axial { anchor: Some(anchor), .. } = &mut spring.law {
                let quasirigid::elements::End::Point(index) = spring.from else { continue };
                let place = assembly.points[index].position;
                *anchor = std::array::from_fn(|i| place[i] - 2.0 * (anchor[i] - place[i]));
            }
        }
        let gap = motion_gap(&reduced(&other, 5), &reduced(&assembly, 5));
        prop_assert!(gap < ROUNDING, "{gap:e}");
    }

    /// Up to the paper's order the paths of the appendages may as well be straight; beyond it the order of the axes matters, because
    /// rotations do not commute. (I6), (I8)
    #[test]
    fn the_order_of_hinge_axes_shows_beyond_the_third_order_only(
        assembly in bodies().prop_filter("two axes", |a| a.hinged.iter().any(|h| h.axes.len() > 1))
    ) {
        let mut other = assembly.clone();
        for hinged in &mut other.hinged {
            let order: Vec<usize> = (0..hinged.axes.len()).rev().collect();
            hinged.axes.reverse();
            hinged.stiffness = permuted(&hinged.stiffness, &order);
            hinged.damping = permuted(&hinged.damping, &order);
        }
        let gap = motion_gap(&reduced(&other, 3), &reduced(&assembly, 3));
        // φ contains the curvature from degree 6 on, which order 3 does not reach.
        prop_assert!(gap < ROUNDING, "{gap:e}");
        let gap = motion_gap(&reduced(&other, 4), &reduced(&assembly, 4));
        prop_assert!(gap > 1e-7, "{gap:e}");
    }
}

/// Two halves make a whole: the transformations of this file do what they say.
#[test]
fn hinge_coefficients_are_multiplied_entry_by_entry() {
    let full = HingeCoefficient::Full(vec![vec![2.0, 1.0], vec![1.0, 4.0]]);
    let half = HingeCoefficient::Full(vec![vec![1.0, 0.5], vec![0.5, 2.0]]);
    assert_eq!(hinge_times(&full, 0.5), half);
    assert_eq!(permuted(&full, &[1, 0]), HingeCoefficient::Full(vec![vec![4.0, 1.0], vec![1.0, 2.0]]));
}
