//! Contour lines of a quantity on a rectangular grid, by marching squares.
//! The grid need not be even: places along both axes are given. Cells with a missing corner have no line.

/// A piece of a contour line between two places, each along x and y.
pub type Segment = [[f64; 2]; 2];

/// Pieces of the line on which the quantity has a level; `values[row][column]` belongs to `y[row]` and `x[column]`.
pub fn contour(x: &[f64], y: &[f64], values: &[Vec<f64>], level: f64) -> Vec<Segment> {
    let mut segments = Vec::new();
    for row in 1..y.len() {
        for column in 1..x.len() {
            let corners = [(row - 1, column - 1), (row - 1, column), (row, column), (row, column - 1)];
            let heights = corners.map(|(row, column)| values[row][column] - level);
            if heights.iter().all(|height| height.is_finite()) {
                let places = corners.map(|(row, column)| [x[column], y[row]]);
                segments.extend(in_cell(places, heights));
            }
        }
    }
    segments
}

/// Pieces in one cell, whose corners go round it; at a saddle the middle decides which corners are joined.
fn in_cell(places: [[f64; 2]; 4], heights: [f64; 4]) -> Vec<Segment> {
    let crossing = |edge: usize| {
        let (a, b) = (edge, (edge + 1) % 4);
        // the neighbour that shares the edge goes the same way along it, so that both find the same place to the last bit
        let (a, b) = if places[a] < places[b] { (a, b) } else { (b, a) };
        ((heights[a] < 0.0) != (heights[b] < 0.0)).then(|| {
            let share = heights[a] / (heights[a] - heights[b]);
            [0, 1].map(|k| places[a][k] + share * (places[b][k] - places[a][k]))
        })
    };
    let crossings: Vec<[f64; 2]> = (0..4).filter_map(crossing).collect();
    match crossings[..] {
        [a, b] => vec![[a, b]],
        [a, b, c, d] => {
            let middle = heights.iter().sum::<f64>() < 0.0;
            if middle == (heights[0] < 0.0) { vec![[a, b], [c, d]] } else { vec![[d, a], [b, c]] }
        }
        _ => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_a_plane_are_straight_on_an_uneven_grid() {
        let (x, y) = ([0.0, 0.1, 0.7, 1.0], [-1.0, 0.5, 0.6, 2.0]);
        let values: Vec<Vec<f64>> = y.iter().map(|y| x.iter().map(|x| 2.0 * x - 0.5 * y).collect()).collect();
        let pieces = contour(&x, &y, &values, 0.3);
        assert!(!pieces.is_empty());
        for [px, py] in pieces.iter().flatten() {
            assert!((2.0 * px - 0.5 * py - 0.3).abs() < 1e-14, "{px} {py}");
        }
    }

    #[test]
    fn a_hill_has_closed_lines_and_a_hole_has_none() {
        let x: Vec<f64> = (0..21).map(|i| f64::from(i) / 10.0 - 1.0).collect();
        let hill: Vec<Vec<f64>> = x.iter().map(|y| x.iter().map(|x| 1.0 - x * x - y * y).collect()).collect();
        let pieces = contour(&x, &x, &hill, 0.503);
        // each place where a piece ends is the end of exactly one other
        let ends: Vec<[f64; 2]> = pieces.iter().flatten().copied().collect();
        for end in &ends {
            assert_eq!(ends.iter().filter(|other| *other == end).count(), 2, "{end:?}");
        }
        let missing = vec![vec![f64::NAN; 21]; 21];
        assert!(contour(&x, &x, &missing, 0.5).is_empty());
    }

    #[test]
    fn the_middle_of_a_saddle_decides() {
        let saddle = |a: f64, b: f64| contour(&[0.0, 1.0], &[0.0, 1.0], &[vec![a, b], vec![b, a]], 0.0);
        let [high, low] = [saddle(2.0, -1.0), saddle(1.0, -2.0)];
        assert_eq!((high.len(), low.len()), (2, 2));
        assert_ne!(high, low);
    }
}
