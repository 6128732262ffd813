//! Figure of the verification: differences between reduced and full equations as the body is stiffened, with the slopes of their orders.

use quasirigid_io::record::OrderRecord;

use crate::figure::{Figure, Quantity, Series};

/// Colours of curves, which limit the number of orders drawn together, and of the lines of their slopes.
const COLOURS: [[&str; 2]; 4] =
    [["s1", "s1 dashed"], ["s2", "s2 dashed"], ["s3", "s3 dashed"], ["s4", "s4 dashed"]];

/// Difference in spin of each order against the halvings of `ε`, and the line that the theory expects through its first point.
pub fn convergence(orders: &[OrderRecord]) -> Figure {
    let curves =
        orders.iter().filter(|row| row.form == "momentum").zip(COLOURS).flat_map(|(row, [class, dashed])| {
            let halvings: Vec<f64> = row.epsilons.iter().map(|epsilon| -epsilon.log2()).collect();
            let label = match row.order {
                Some(order) => format!("p = {}, {order:.2}", row.p),
                None => format!("p = {}", row.p),
            };
            [Series::line(&label, class, halvings, row.errors.clone()), expected(row, dashed)]
        });
    Figure {
        id: "convergence",
        title: "Difference in spin as the body is stiffened".into(),
        caption: "Largest difference between the full and the reduced system, relative to the spin, with the measured slope of each \
                  order. Dashed: each halving of ε divides it by 2ᵖ⁺¹, as the theory predicts, until rounding levels it."
            .into(),
        series: curves.filter(|series| !series.x.is_empty()).collect(),
        x: Quantity { name: "halvings of ε", unit: "1".into(), log: false },
        y: Quantity { name: "difference", unit: "1".into(), log: true },
        link: None,
        marks: Vec::new(),
    }
}

/// The line of the expected slope through the first difference, as far as the last one.
fn expected(row: &OrderRecord, class: &'static str) -> Series {
    let least = row.errors.iter().copied().filter(|error| *error > 0.0).fold(f64::INFINITY, f64::min);
    let (Some(first), Some(start)) = (row.errors.first(), row.epsilons.first()) else {
        return Series::line("", class, Vec::new(), Vec::new());
    };
    let error = |epsilon: &f64| first * (epsilon / start).powi(row.expected as i32);
    let points = row.epsilons.iter().map(|epsilon| (-epsilon.log2(), error(epsilon)));
    let (x, y) = points.take_while(|(_, error)| *error >= 0.5 * least).unzip();
    Series::line("", class, x, y)
}
