//! Every coefficient of the paper's torque for one sprung mass on a free hub, from rational arithmetic:
//! `data/published/one_sprung_mass`.
#![allow(clippy::print_stdout, clippy::unwrap_used)]

use quasirigid::problems::CommonProblem;
use quasirigid::reduction::reduce;
use quasirigid_math::polynomial::monomial::count;

const TABLE: &str = include_str!("../../../../data/published/one_sprung_mass/mu_A.csv");

/// Tolerance relative to the largest coefficient of the degree; the table has 17 digits and a coefficient some fifty operations.
const TOLERANCE: f64 = 1e-12;

/// Degree, exponents and torque of every row.
fn rows() -> Vec<(usize, [usize; 3], [f64; 3])> {
    let row = |line: &str| {
        let fields: Vec<&str> = line.split(',').collect();
        let whole = |i: usize| fields[i].parse().unwrap();
        let number = |i: usize| fields[i].parse().unwrap();
        (whole(0), [whole(1), whole(2), whole(3)], [number(4), number(5), number(6)])
    };
    TABLE.lines().skip(1).map(row).collect()
}

#[test]
fn torque_of_one_sprung_mass_has_the_rational_coefficients() {
    let reduced = reduce(&CommonProblem::A.assembly().body().unwrap(), 3).unwrap();
    let rows = rows();
    println!("degree exponents axis {:>24} {:>24} error", "published", "found");
    for degree in [4, 5] {
        let mu = reduced.mu(degree);
        let of_degree: Vec<_> = rows.iter().filter(|row| row.0 == degree).collect();
        assert_eq!(of_degree.len(), count(degree), "every monomial is in the table");
        let largest = of_degree.iter().flat_map(|row| row.2).fold(0.0_f64, |largest, x| largest.max(x.abs()));
        let mut worst: f64 = 0.0;
        for (_, exponents, published) in of_degree {
            let (_, found) = mu.terms().find(|(monomial, _)| monomial == exponents).unwrap();
            for axis in 0..3 {
                let error = (found[axis] - published[axis]).abs() / largest;
                println!(
                    "{degree:>6} {exponents:?} {:>4} {:>24e} {:>24e} {error:.1e}",
                    axis + 1,
                    published[axis],
                    found[axis]
                );
                assert!(error < TOLERANCE, "degree {degree}, {exponents:?}, axis {axis}: {error:e}");
                worst = worst.max(error);
            }
        }
        println!("degree {degree}: worst error {worst:.1e} of the largest coefficient, {largest:e} N m");
    }
    assert_eq!(rows.len(), count(4) + count(5));
}
