//! Coefficients of the field by degree, order and year, from the file that the authors of the field publish.

use std::sync::OnceLock;

use super::EarthField;

/// Years between two columns.
const STEP: f64 = 5.0;
/// Coefficients in nanotesla.
const NANO: f64 = 1e-9;
/// Pairs `g, h` of all degrees and orders to 13, by `n(n+1)/2 + m`; the first is of no use.
pub(super) const PAIRS: usize = 105;

type Pairs = [[f64; 2]; PAIRS];

/// Coefficients `g, h` (T) of polynomials that are not normalised, at a decimal year of the table.
pub(super) fn coefficients(year: f64) -> Pairs {
    let columns = columns();
    let along = ((year - EarthField::YEARS[0]) / STEP).clamp(0.0, (columns.len() - 1) as f64);
    let before = (along.floor() as usize).min(columns.len() - 2);
    let share = along - before as f64;
    let (first, second) = (&columns[before], &columns[before + 1]);
    std::array::from_fn(|i| [0, 1].map(|k| (1.0 - share) * first[i][k] + share * second[i][k]))
}

/// Columns of the file, a year each, with the factors of Schmidt's normalisation taken in.
fn columns() -> &'static [Pairs] {
    static COLUMNS: OnceLock<Vec<Pairs>> = OnceLock::new();
    COLUMNS.get_or_init(|| {
        let mut lines = include_str!("coefficients.csv").lines();
        let years = lines.next().map_or(0, |heading| heading.split(',').count() - 2);
        let mut columns = vec![[[0.0; 2]; PAIRS]; years];
        for line in lines {
            let cells: Vec<f64> = line.split(',').filter_map(|cell| cell.parse().ok()).collect();
            let [n, m, ref values @ ..] = cells[..] else { continue };
            let (n, m, which) = (n as usize, m.abs() as usize, usize::from(m < 0.0));
            let factor = NANO * schmidt(n, m);
            for (column, value) in columns.iter_mut().zip(values) {
                column[n * (n + 1) / 2 + m][which] = factor * value;
            }
        }
        columns
    })
}

/// Factor of Schmidt's normalisation, `√((2 − δ₀ₘ)(n−m)!/(n+m)!)`.
fn schmidt(n: usize, m: usize) -> f64 {
    if m == 0 {
        return 1.0;
    }
    let product: f64 = (n - m + 1..=n + m).map(|k| k as f64).product();
    (2.0 / product).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The file is whole: 26 epochs and the extrapolation, 195 coefficients, and values seen in the file of the British Geological Survey.
    #[test]
    fn the_table_is_whole() {
        assert_eq!(columns().len(), 27);
        let at = |year: f64, n: usize, m: usize| {
            coefficients(year)[n * (n + 1) / 2 + m].map(|c| c / NANO / schmidt(n, m))
        };
        assert!((at(2025.0, 1, 0)[0] + 29_350.0).abs() < 1e-9);
        assert!((at(2025.0, 13, 13)[0] + 0.4).abs() < 1e-12 && (at(2025.0, 13, 13)[1] + 0.5).abs() < 1e-12);
        assert!((at(1900.0, 2, 1)[1] + 1061.0).abs() < 1e-10);
        assert!((at(2022.5, 1, 1)[1] - 0.5 * (4653.35 + 4545.5)).abs() < 1e-9);
        assert!(columns().iter().all(|column| column[1..].iter().all(|pair| pair[0].is_finite())));
    }
}
