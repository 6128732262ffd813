//! Directions of the angular momentum in the body, and the stretches of them that are drawn.

use quasirigid_io::record::Column;

use super::vector::{Vector, direction, dot};
use super::view::{Halves, View};
use crate::columns::vectors;

/// Shades that tell early from late.
const SHADES: usize = 6;
/// Rows drawn of a path that is too long.
const SAMPLE: usize = 4000;
/// Stretches that these rows make up.
const STRETCHES: usize = 20;
/// Most characters of path data that the whole path may take.
const MAX_PATH_DATA: usize = 150_000;

/// Consecutive points drawn in one shade.
struct Stretch<'a> {
    /// 0 for the earliest.
    shade: usize,
    /// Directions; none where the history has a gap.
    points: &'a [Option<Vector>],
}

/// Direction of `J ω` in every row; none unless some row has one.
pub fn momentum_directions(J: [Vector; 3], columns: &[Column]) -> Option<Vec<Option<Vector>>> {
    let angular_momentum = |omega: Vector| {
        let unit = direction(omega)?;
        direction(J.map(|row| dot(row, unit)))
    };
    let path: Vec<_> = vectors(columns, ["wx", "wy", "wz"])?.into_iter().map(angular_momentum).collect();
    path.iter().any(Option::is_some).then_some(path)
}

/// The path as drawn, with the shade of each piece: the whole, or, where that would be too long, a sample (true).
pub fn pieces(view: &View, path: &[Option<Vector>]) -> (Vec<(usize, Halves)>, bool) {
    let curves = |stretches: Vec<Stretch>| -> Vec<(usize, Halves)> {
        stretches.iter().map(|stretch| (stretch.shade, view.curve(stretch.points.iter().copied()))).collect()
    };
    let all = curves(whole(path));
    let length: usize = all.iter().map(|(_, Halves { near, far })| near.len() + far.len()).sum();
    match sample(path) {
        Some(stretches) if length > MAX_PATH_DATA => (curves(stretches), true),
        _ => (all, false),
    }
}

/// The whole path, one stretch per shade, each beginning where the one before ended.
fn whole(path: &[Option<Vector>]) -> Vec<Stretch<'_>> {
    let start = |shade: usize| shade * path.len() / SHADES;
    let end = |shade: usize| (start(shade + 1) + 1).min(path.len());
    (0..SHADES).map(|shade| Stretch { shade, points: &path[start(shade)..end(shade)] }).collect()
}

/// Stretches of consecutive points evenly spaced over a long path, its first and last included; none of a short path.
///
/// Stretches, because all revolutions of a long history drawn over each other would only fill the sphere.
fn sample(path: &[Option<Vector>]) -> Option<Vec<Stretch<'_>>> {
    let length = SAMPLE / STRETCHES;
    let room = path.len().checked_sub(SAMPLE)? + SAMPLE - length;
    let start = |i: usize| i * room / (STRETCHES - 1);
    let stretch =
        |i: usize| Stretch { shade: i * SHADES / STRETCHES, points: &path[start(i)..start(i) + length] };
    Some((0..STRETCHES).map(stretch).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `J ω` of an inertia with products, in any units: (3, 1, 0; 1, 4, 2; 0, 2, 5)(1, −1, 2) = (2, 1, 8).
    #[test]
    fn direction_is_that_of_inertia_times_spin() {
        for (J, omega) in [(1.0, 1.0), (1e300, 1e300), (1e-300, 1e-300)] {
            let column = |name: &str, value: f64| Column {
                name: name.into(),
                unit: String::new(),
                values: vec![value],
            };
            let columns = vec![column("wx", omega), column("wy", -omega), column("wz", 2.0 * omega)];
            let J = [[3.0 * J, J, 0.0], [J, 4.0 * J, 2.0 * J], [0.0, 2.0 * J, 5.0 * J]];
            let k = momentum_directions(J, &columns).unwrap()[0].unwrap();
            let expected = [2.0, 1.0, 8.0].map(|x| x / 69f64.sqrt());
            assert!(k.iter().zip(expected).all(|(k, expected)| (k - expected).abs() < 1e-14), "{k:?}");
        }
    }

    fn numbered(rows: usize) -> Vec<Option<Vector>> {
        (0..rows).map(|i| Some([i as f64, 0.0, 0.0])).collect()
    }

    /// Numbers of the first and last point of each stretch that has points.
    fn ends(stretches: &[Stretch]) -> Vec<(f64, f64)> {
        let number = |point: Option<&Option<Vector>>| Some((*point?)?[0]);
        stretches.iter().filter_map(|s| Some((number(s.points.first())?, number(s.points.last())?))).collect()
    }

    #[test]
    fn whole_path_is_joined_and_complete() {
        for rows in [1, 2, 7, 1000] {
            let path = numbered(rows);
            let ends = ends(&whole(&path));
            assert_eq!((ends[0].0, ends[ends.len() - 1].1), (0.0, (rows - 1) as f64));
            assert!(ends.windows(2).all(|pair| pair[0].1 >= pair[1].0), "{rows}: {ends:?}");
        }
        assert!(ends(&whole(&[])).is_empty());
    }

    #[test]
    fn sample_spans_a_long_path() {
        assert!(sample(&numbered(SAMPLE - 1)).is_none());
        for rows in [SAMPLE, SAMPLE + 1, 1_000_000] {
            let path = numbered(rows);
            let stretches = sample(&path).unwrap();
            let ends = ends(&stretches);
            assert_eq!((ends[0].0, ends[ends.len() - 1].1), (0.0, (rows - 1) as f64));
            assert!(ends.windows(2).all(|pair| pair[0].1 < pair[1].0));
            assert_eq!(stretches.iter().map(|stretch| stretch.points.len()).sum::<usize>(), SAMPLE);
        }
    }
}
