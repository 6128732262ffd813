//! Tables of places against what they were taken from: polynomials and conics. (F26)

use nalgebra::Vector3;
use proptest::prelude::*;
use quasirigid::model::force::{Conic, Ephemeris, EphemerisProblem, OrbitPoint};
use quasirigid_math::taylor::Taylor;

use crate::support::{cases, vector};

type V = Vector3<f64>;

const FLYBY: Conic = Conic {
    mu: 3.986e14,
    periapsis_distance: 3.8e7,
    eccentricity: 4.25,
    inclination: 2.8,
    raan: 2.6,
    argument_of_periapsis: 0.6,
    time_of_periapsis: 5000.0,
};

/// Rows of a flyby, evenly apart.
fn rows(step: f64) -> Vec<(f64, [f64; 3])> {
    let count = (40_000.0 / step) as usize;
    (0..=count).map(|i| step * i as f64 - 15_000.0).map(|t| (t, FLYBY.at(t).place)).collect()
}

/// Greatest error between the rows, relative to the distance.
fn error(table: &Ephemeris) -> f64 {
    let all =
        table.times().windows(2).flat_map(|pair| [0.2, 0.5, 0.9].map(|x| pair[0] + x * (pair[1] - pair[0])));
    let one = |t: f64| {
        let (found, known): (OrbitPoint<f64>, OrbitPoint<f64>) = (table.at(t), FLYBY.at(t));
        (V::from(found.place) - V::from(known.place)).norm() / known.radius
    };
    all.map(one).fold(0.0, f64::max)
}

proptest! {
    #![proptest_config(cases(64))]

    /// Polynomials of fifth degree are reproduced through uneven rows in any units of time, with their derivatives.
    #[test]
    fn polynomials_of_fifth_degree_are_exact(
        parts in [vector(), vector(), vector(), vector(), vector(), vector()],
        gaps in prop::collection::vec(0.5..1.5, 7..20), unit in -9..9i32, at in 0.0..1.0,
    ) {
        let unit = 10f64.powi(unit);
        let times: Vec<f64> = gaps.iter().scan(0.0, |t, gap| { *t += gap; Some(*t) }).collect();
        let times: Vec<f64> = [0.0].into_iter().chain(times).collect();
        let last = times[times.len() - 1];
        // Far from the centre, so that no row is missed by much.
        let place = |x: f64| parts.iter().rev().fold(V::zeros(), |sum, part| sum * x + V::from(*part)) + V::new(1e3, 0.0, 0.0);
        let scaled = |x: f64| place(x / last);
        let rows: Vec<(f64, [f64; 3])> = times.iter().map(|t| (unit * t, scaled(*t).into())).collect();
        let table = Ephemeris::new(1.0, &rows).unwrap();
        let t = last * at;
        let found: OrbitPoint<f64> = table.at(unit * t);
        prop_assert!((V::from(found.place) - scaled(t)).norm() < 1e-12 * 1e3);
        let series = table.at(Taylor::<2>::variable(unit * t));
        for axis in 0..3 {
            let slope = (1..6).map(|k| k as f64 * parts[k][axis] * f64::powi(at, k as i32 - 1)).sum::<f64>() / (last * unit);
            // A difference of rows 1000 from the centre, over the gap.
            prop_assert!((found.velocity[axis] - slope).abs() < 1e-10 / unit, "{} {slope}", found.velocity[axis]);
            prop_assert!((series.place[axis].coefficient(1) - found.velocity[axis]).abs() < 1e-11 / unit);
        }
    }
}

/// Halved steps divide the error by 2⁶ where the polynomials err, by 2⁷ where the velocities of the rows do, and the estimate is an upper bound.
#[test]
fn tables_of_a_flyby_converge_with_the_sixth_power_of_their_step() {
    let steps = [1000.0, 500.0, 250.0];
    let tables = steps.map(|step| Ephemeris::new(FLYBY.mu, &rows(step)).unwrap());
    let errors = tables.each_ref().map(error);
    for (pair, table) in errors.windows(2).zip(&tables[1..]) {
        let order = (pair[0] / pair[1]).log2();
        assert!((5.8..7.2).contains(&order), "{errors:?}");
        assert!(table.error() > pair[1], "{} {}", table.error(), pair[1]);
    }
    assert!(errors[2] < 1e-6, "{errors:?}");
    let (nearest, attracted) = tables[2].nearest();
    assert!((nearest / FLYBY.periapsis_distance - 1.0).abs() < 1e-3, "{nearest}");
    assert!((attracted - 1.0).abs() < 1e-3, "{attracted}");
}

/// What is no table is refused, and beyond the rows there is no place.
#[test]
fn tables_that_mean_nothing_are_refused() {
    let good = rows(1000.0);
    let refused = |rows: &[(f64, [f64; 3])]| Ephemeris::new(1.0, rows).unwrap_err();
    assert_eq!(refused(&good[..7]), EphemerisProblem::Few { rows: 7 });
    assert!(Ephemeris::new(1.0, &good[..8]).is_ok());
    let changed = |index: usize, row: (f64, [f64; 3])| {
        let mut rows = good.clone();
        rows[index] = row;
        refused(&rows)
    };
    assert_eq!(changed(3, (good[3].0, [0.0; 3])), EphemerisProblem::NoPlace { index: 4 });
    assert_eq!(changed(2, (f64::NAN, good[2].1)), EphemerisProblem::NoPlace { index: 3 });
    assert!(matches!(changed(5, (good[4].0, good[5].1)), EphemerisProblem::Unsorted { index: 6, .. }));
    let jump = |(i, (t, place)): (usize, &(f64, [f64; 3]))| (*t, place.map(|part| part * [1.0, 1.2][i % 2]));
    let problem = refused(&good.iter().enumerate().map(jump).collect::<Vec<_>>());
    assert!(matches!(problem, EphemerisProblem::Coarse { missed } if missed > 0.05), "{problem}");
    let table = Ephemeris::new(1.0, &good).unwrap();
    let [from, to] = table.span();
    for t in [from - 1.0, to + 1.0] {
        let point: OrbitPoint<f64> = table.at(t);
        assert!(point.radius.is_nan() && point.place[0].is_nan());
    }
    assert!([from, to].iter().all(|t| table.at::<f64>(*t).radius.is_finite()));
}
