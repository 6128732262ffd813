//! A light curve: brightness over the time, measured points and what they leave.

use quasirigid_io::record::Column;

use crate::columns::{TimeUnit, column};
use crate::figure::{Figure, Quantity, Series};

/// Distance of the residuals below the curve, in their greatest size.
const BELOW: f64 = 1.5;

/// Brightness of a light curve over its mean, as an SVG file of its own; measured points and below them the residuals, where there are any.
/// None of a table without rows.
#[must_use]
pub fn light_curve_picture(columns: &[Column]) -> Option<String> {
    figure(columns)?.picture()
}

fn figure(columns: &[Column]) -> Option<Figure> {
    let unit = TimeUnit::of(columns, usize::MAX);
    let t: Vec<f64> = column(columns, "t")?.values.iter().map(|t| t / unit.length).collect();
    let computed = &column(columns, "brightness")?.values;
    let mean = computed.iter().sum::<f64>() / computed.len() as f64;
    let over = |values: &[f64]| values.iter().map(|value| value / mean).collect::<Vec<f64>>();
    let curve = Series::line("computed", "s1", t.clone(), over(computed));
    let listed = column(columns, "sun_distance").is_some();
    let mut series = vec![if listed { curve.of_points() } else { curve }];
    let mut caption = "Brightness at one astronomical unit over its mean.".to_owned();
    if let (Some(measured), Some(residual)) = (column(columns, "measured"), column(columns, "residual")) {
        let least = series[0].y.iter().copied().fold(f64::INFINITY, f64::min);
        let size = residual.values.iter().fold(0.0, |size: f64, value| size.max(value.abs()));
        let zero = least - BELOW * size;
        let below = residual.values.iter().map(|value| zero + value).collect();
        series.insert(0, Series::line("measured", "s2", t.clone(), over(&measured.values)).of_points());
        let ends = [t.first(), t.last()].into_iter().flatten().copied().collect::<Vec<f64>>();
        let level = vec![zero; ends.len()];
        series.push(Series::line("residual", "s3", t, below).of_points());
        series.push(Series::line("", "s3 dashed", ends, level));
        caption.push_str(" Residuals, relative, about the dashed line.");
    }
    let quantity = |name: &'static str, unit: &str| Quantity { name, unit: unit.to_owned(), log: false };
    Some(Figure {
        id: "light-curve",
        title: "Light curve".into(),
        caption,
        series,
        ..Figure::new(quantity("t", &unit.name), quantity("brightness", "1"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(measured: bool) -> Vec<Column> {
        let column = |name: &str, unit: &str, values: [f64; 3]| Column {
            name: name.into(),
            unit: unit.into(),
            values: values.to_vec(),
        };
        let mut columns =
            vec![column("t", "s", [0.0, 3600.0, 7200.0]), column("brightness", "m^2", [1.0, 2.0, 3.0])];
        if measured {
            columns.push(column("measured", "m^2", [1.1, 2.0, 2.9]));
            columns.push(column("residual", "1", [0.1, 0.0, -0.03]));
        }
        columns
    }

    #[test]
    fn residuals_are_drawn_below_the_curve() {
        let drawn = figure(&table(true)).unwrap();
        let [measured, computed, residual, zero] = &drawn.series[..] else { panic!() };
        assert_eq!(computed.y, [0.5, 1.0, 1.5]);
        assert!(measured.points && residual.y.iter().all(|value| *value < 0.5));
        assert!((residual.y[0] - zero.y[0] - 0.1).abs() < 1e-15 && zero.y[0] == zero.y[1]);
        assert_eq!(figure(&table(false)).unwrap().series.len(), 1);
        assert!(light_curve_picture(&table(true)).unwrap().contains("measured"));
        assert!(light_curve_picture(&[]).is_none());
    }
}
