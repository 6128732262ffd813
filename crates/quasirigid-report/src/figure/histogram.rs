//! Histogram: how often a quantity of a study falls into each of equal bins, with its intervals.
//! Bins are equal on the axis as drawn, so that a quantity over decades is counted by decades.

use std::fmt::Write;

use maud::{Markup, html};

use super::axis::Axis;
use super::frame::{Frame, marked};
use super::trace::{HEIGHT, WIDTH};

/// Fewest and most bins.
const BINS: [f64; 2] = [8.0, 48.0];

/// A histogram of the finite values, with lines at the given percentiles (in percent, with their values); none without two different values.
pub fn histogram(
    id: &str,
    [name, unit]: [&str; 2],
    values: &[f64],
    percentiles: &[(f64, f64)],
) -> Option<Markup> {
    let x = Axis::fitting(values.iter().copied())?;
    let places: Vec<f64> =
        values.iter().map(|value| x.place(*value)).filter(|place| place.is_finite()).collect();
    let bins = (places.len() as f64).sqrt().clamp(BINS[0], BINS[1]).round();
    let mut counts = vec![0.0; bins as usize];
    for place in &places {
        counts[(place * bins).clamp(0.0, bins - 1.0) as usize] += 1.0;
    }
    let y = Axis::linear(std::iter::once(0.0).chain(counts.iter().copied()), 0.0)?;
    let mut bars = String::new();
    for (bin, count) in counts.iter().enumerate().filter(|(_, count)| **count > 0.0) {
        let [left, right] = [bin, bin + 1].map(|edge| WIDTH * edge as f64 / bins);
        let top = HEIGHT * (1.0 - y.place(*count));
        write!(bars, "M{left:.1} {HEIGHT}V{top:.1}H{right:.1}V{HEIGHT}Z").ok()?;
    }
    let over = html! {
        @for (percent, value) in percentiles {
            @let place = x.place(*value);
            @if (0.0..=1.0).contains(&place) { (marked(place, &format!("{percent} %"))) }
        }
    };
    let caption = format!("{} rows in {bins} bins; dashed, the percentiles.", places.len());
    let frame = Frame { id, title: name, caption: &caption, x: (&x, name, unit), y: (&y, "rows", "") };
    Some(frame.draw(&html! { path.bars.s1 d=(bars) {} }, &over))
}
