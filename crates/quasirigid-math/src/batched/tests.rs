use nalgebra::{Complex, DMatrix};

use super::*;
use crate::random::Random;
use crate::simd::Plain;

/// A matrix of random entries between −1 and 1.
fn random(size: usize, seed: u64) -> Dense {
    let mut draws = Random::new(seed);
    from(size, |_, _| 2.0 * draws.unit() - 1.0)
}

fn from(size: usize, mut entry: impl FnMut(usize, usize) -> f64) -> Dense {
    let mut matrix = Dense::zero(size);
    for place in 0..size * size {
        matrix.add(place / size, place % size, entry(place / size, place % size));
    }
    matrix
}

/// Eigenvalues of one matrix.
fn of(matrix: &Dense) -> Vec<[f64; 2]> {
    let [found] =
        <[Eigenvalues; 1]>::try_from(eigenvalues(std::slice::from_ref(matrix), Rounding::Fastest)).unwrap();
    found.unwrap()
}

fn norm(matrix: &Dense) -> f64 {
    let size = matrix.size();
    (0..size * size).fold(0.0_f64, |sum, place| sum.hypot(matrix.at(place / size, place % size)))
}

/// Largest distance between two lists of eigenvalues, each taken with the nearest of the other that is left.
fn gap(found: &[[f64; 2]], known: &[[f64; 2]]) -> f64 {
    assert_eq!(found.len(), known.len());
    let mut left = known.to_vec();
    let mut gap = 0.0_f64;
    for [re, im] in found {
        let off = |other: &[f64; 2]| (other[0] - re).hypot(other[1] - im);
        let nearest = (0..left.len()).min_by(|a, b| off(&left[*a]).total_cmp(&off(&left[*b]))).unwrap();
        gap = gap.max(off(&left.swap_remove(nearest)));
    }
    gap
}

/// Least relative change of a matrix by which each value becomes an eigenvalue: by its least singular value, an independent road.
fn backward_error(matrix: &Dense, values: &[[f64; 2]]) -> f64 {
    let size = matrix.size();
    let shifted = |[re, im]: [f64; 2]| {
        let shift = Complex::new(re, im);
        let entry = |row, column| {
            Complex::from(matrix.at(row, column)) - if row == column { shift } else { 0.0.into() }
        };
        DMatrix::from_fn(size, size, entry).singular_values().min()
    };
    values.iter().map(|value| shifted(*value)).fold(0.0, f64::max) / norm(matrix)
}

#[test]
fn eigenvalues_are_those_of_the_general_solver() {
    for size in 1..=16 {
        let all: Vec<Dense> = (0..20).map(|seed| random(size, seed)).collect();
        for (matrix, found) in all.iter().zip(eigenvalues(&all, Rounding::Fastest)) {
            let found = found.unwrap();
            let error = backward_error(matrix, &found);
            assert!(error < 8e-15, "{size}: {error:e}");
            // of the worst conditioned among them
            let gap = gap(&found, &eigen::eigenvalues(matrix).unwrap());
            assert!(gap < 1e-11 * norm(matrix), "{size}: {gap:e}");
        }
    }
}

/// Rotations, undamped oscillators, nilpotent, defective, multiple, zero and triangular ones, with their eigenvalues.
fn known() -> Vec<(&'static str, Dense, Vec<[f64; 2]>, f64)> {
    let turn = |k: usize, n: usize| {
        let angle = std::f64::consts::TAU * k as f64 / n as f64;
        [angle.cos(), angle.sin()]
    };
    let root = f64::EPSILON.sqrt();
    let roots: Vec<[f64; 2]> = (1..=6).map(|root| [f64::from(root), 0.0]).collect();
    let companion = [21.0, -175.0, 735.0, -1624.0, 1764.0, -720.0];
    let mut all = vec![
        (
            "companion",
            from(6, |i, j| if i == 0 { companion[j] } else { f64::from(u8::from(i == j + 1)) }),
            roots,
            1e-9,
        ),
        (
            "two defective pairs",
            from(4, |i, j| {
                [[-0.1, 2.0, 1.0, 0.0], [-2.0, -0.1, 0.0, 1.0], [0.0, 0.0, -0.1, 2.0], [0.0, 0.0, -2.0, -0.1]]
                    [i][j]
            }),
            vec![[-0.1, 2.0], [-0.1, 2.0], [-0.1, -2.0], [-0.1, -2.0]],
            4.0 * root,
        ),
        ("two by two, defective", from(2, |i, j| [[1.0, 1.0], [0.0, 1.0]][i][j]), vec![[1.0, 0.0]; 2], 0.0),
        (
            "stiff pair",
            from(2, |i, j| [[0.0, 1.0], [-1e16, -1e-3]][i][j]),
            vec![[-5e-4, 1e8], [-5e-4, -1e8]],
            1e-6,
        ),
    ];
    for size in 1..=16 {
        all.push(("zero", Dense::zero(size), vec![[0.0; 2]; size], 0.0));
        all.push((
            "multiple",
            from(size, |i, j| if i == j { 3.0 } else { 0.0 }),
            vec![[3.0, 0.0]; size],
            0.0,
        ));
        all.push((
            "nilpotent",
            from(size, |i, j| f64::from(u8::from(j == i + 1))),
            vec![[0.0; 2]; size],
            0.0,
        ));
        let below = from(size, |i, j| f64::from(u8::from(i == j + 1)));
        all.push((
            "nilpotent, from below",
            below,
            vec![[0.0; 2]; size],
            2.0 * f64::EPSILON.powf((size as f64).recip()),
        ));
        let cyclic = from(size, |i, j| f64::from(u8::from(i == (j + 1) % size)));
        all.push(("cyclic", cyclic, (0..size).map(|k| turn(k, size)).collect(), 1e-14));
        let ones = from(size, |_, _| 1.0);
        let mut values = vec![[0.0; 2]; size];
        values[0] = [size as f64, 0.0];
        all.push(("of rank one", ones, values, 1e-14 * size as f64));
        let triangle = from(size, |i, j| if i > j { 0.0 } else { (1 + i) as f64 });
        all.push(("triangular", triangle, (1..=size).map(|k| [k as f64, 0.0]).collect(), 0.0));
    }
    all
}

#[test]
fn eigenvalues_of_special_matrices_are_the_known_ones() {
    for (name, matrix, known, allowed) in known() {
        let found = of(&matrix);
        let gap = gap(&found, &known);
        assert!(gap <= allowed, "{name} of {}: {gap:e}, {found:?}", matrix.size());
        assert!(
            found.iter().flatten().all(|part| part.to_bits() != (-0.0_f64).to_bits()),
            "{name}: {found:?}"
        );
    }
}

/// Oscillators that share no conserved quantity but two, in turned coordinates: four eigenvalues are zero, and two pairs have no second vector.
#[test]
fn conserved_quantities_give_zero() {
    let mut system = DMatrix::<f64>::zeros(12, 12);
    for (pair, frequency) in [0.0, 0.0, 1.3, 1.3, 2.9, 0.4].into_iter().enumerate() {
        system[(2 * pair, 2 * pair + 1)] = 1.0;
        system[(2 * pair + 1, 2 * pair)] = -frequency * frequency;
    }
    let basis = DMatrix::from_fn(12, 12, |i, j| ((i * 7 + j * 3 + 1) as f64).sin()).qr().q();
    let turned = &basis * &system * basis.transpose();
    let found = of(&from(12, |i, j| turned[(i, j)]));
    let zeros = found.iter().filter(|[re, im]| re.hypot(*im) < 1e-6).count();
    let alike = found.iter().filter(|[re, im]| re.hypot(im - 1.3) < 1e-13).count();
    assert_eq!((zeros, alike), (4, 2), "{found:?}");
}

#[test]
fn units_of_the_coordinates_change_no_eigenvalue() {
    for size in 2..=16 {
        let plain = random(size, 77);
        let known = of(&plain);
        for (power, factor) in [(1, 1.0), (1, 1e-140), (1, 3e140), (5, 1.0)] {
            let exponent = |i: usize| power * [8, -8, 3, -5, 7, 0][(i * 5 + size) % 6];
            let unit = |i: usize| 10.0_f64.powi(exponent(i)) * (1.0 + 0.1 * i as f64);
            let scaled = from(size, |i, j| factor * plain.at(i, j) * unit(i) / unit(j));
            let found: Vec<[f64; 2]> =
                of(&scaled).iter().map(|value| value.map(|part| part / factor)).collect();
            let gap = gap(&found, &known);
            assert!(gap < 1e-12 * norm(&plain), "{size} {factor:e}: {gap:e}");
        }
    }
}

/// Matrices of one size whose iterations differ much in length.
fn mixed(size: usize) -> Vec<Dense> {
    let mut all: Vec<Dense> = (0..11).map(|seed| random(size, seed)).collect();
    all.extend(known().into_iter().map(|(_, matrix, ..)| matrix).filter(|matrix| matrix.size() == size));
    all.insert(3, from(size, |_, _| f64::NAN));
    all.insert(5, from(size, |i, j| if i == j { f64::INFINITY } else { 1.0 }));
    all.push(from(size, |i, j| random(size, 5).at(i, j) * 10.0_f64.powi(4 * (i as i32 - j as i32))));
    all
}

/// Bits of eigenvalues; no bits of an error.
fn bits_of(found: &Eigenvalues) -> Option<Vec<[u64; 2]>> {
    found.as_ref().ok().map(|values| values.iter().map(|value| value.map(f64::to_bits)).collect())
}

#[test]
fn a_matrix_has_the_same_bits_in_any_lane_and_alone() {
    for size in 1..=16 {
        let all = mixed(size);
        for rounding in [Rounding::Fastest, Rounding::Reproducible] {
            let together = eigenvalues(&all, rounding);
            let lost = dispatch_lanes(rounding, Batch { matrices: &all });
            let lost: Vec<usize> = (0..all.len()).filter(|place| lost[*place].is_none()).collect();
            assert_eq!(lost, [3, 5], "{size}: those of numbers that are not finite");
            for (place, matrix) in all.iter().enumerate() {
                let alone = eigenvalues(std::slice::from_ref(matrix), rounding);
                assert_eq!(bits_of(&together[place]), bits_of(&alone[0]), "{size}: {place}");
            }
            for step in [3, 5, 7] {
                let order: Vec<usize> = (0..all.len()).map(|k| (k * step + size) % all.len()).collect();
                let shuffled: Vec<Dense> = order.iter().map(|k| all[*k].clone()).collect();
                for (k, found) in order.iter().zip(eigenvalues(&shuffled, rounding)) {
                    assert_eq!(bits_of(&together[*k]), bits_of(&found), "{size}: {k}");
                }
            }
        }
    }
}

#[test]
fn registers_change_no_bit_of_reproducible_eigenvalues() {
    for size in 1..=16 {
        let all = mixed(size);
        let batch = || Batch { matrices: &all };
        let bits = |found: Vec<Option<Vec<[f64; 2]>>>| -> Vec<_> {
            found.iter().map(|found| bits_of(&found.clone().ok_or(NoConvergence { size }))).collect()
        };
        let plain = bits(batch().run::<Plain>());
        let public: Vec<_> = eigenvalues(&all, Rounding::Reproducible).iter().map(bits_of).collect();
        assert_eq!(public, plain, "{size}");
        #[cfg(target_arch = "x86_64")]
        if std::arch::is_x86_feature_detected!("avx2") && std::arch::is_x86_feature_detected!("fma") {
            use crate::simd::{Fused, Vector};
            assert_eq!(bits(Vector::<Plain, 4>::call(batch())), plain, "{size}");
            assert_eq!(
                bits(Fused::call(batch())),
                bits(dispatch_lanes(Rounding::Fastest, batch())),
                "{size}"
            );
        }
    }
}

#[test]
fn sizes_may_alternate() {
    let all: Vec<Dense> = [0, 3, 3, 16, 3, 1, 0, 5].into_iter().map(|size| random(size, 9)).collect();
    for (matrix, found) in all.iter().zip(eigenvalues(&all, Rounding::Fastest)) {
        assert_eq!(found.unwrap(), of(matrix));
    }
}

/// Of a million matrices of four rows thirty, among them these, never end under the shifts of both real eigenvalues; none does under the nearer one
/// twice. `[@day1996]`
#[test]
fn matrices_of_four_rows_end() {
    let all = [108_269, 112_419, 128_326, 142_068, 202_504].map(|seed| random(4, seed));
    assert!(dispatch_lanes(Rounding::Fastest, Batch { matrices: &all }).iter().all(Option::is_some));
}

/// Eigenvalues that are not those of the matrix by more than rounding are told by their first two moments.
#[test]
fn moments_tell_wrong_eigenvalues() {
    let matrix = random(7, 3);
    let mut scaled = Matrices::of(std::slice::from_ref(&matrix));
    let unit = scaled.normalize();
    let moments = Moments::of::<Plain>(&scaled);
    let right: Vec<[f64; 2]> = of(&matrix).iter().map(|value| value.map(|part| part / unit.0[0])).collect();
    assert!(moments.agree(0, &right));
    let complex = (0..7).find(|k| right[*k][1] > 0.0).unwrap();
    for (k, part, sign) in [(0, 0, 1.0), (complex, 1, 1.0), (complex, 1, -1.0)] {
        let mut wrong = right.clone();
        wrong[k][part] += sign * 1e-11;
        assert!(!moments.agree(0, &wrong), "{k} {part}");
        wrong[k][part] = f64::NAN;
        assert!(!moments.agree(0, &wrong), "{k} {part}");
    }
}
