//! Curve with a band: the median of a quantity at each value of one input, between its 16th and 84th percentile.
//! The band is drawn only where several rows share the input, as draws and tables make them.

use std::fmt::Write;

use maud::{Markup, html};

use super::axis::Axis;
use super::frame::Frame;
use super::trace::{HEIGHT, WIDTH};

/// One input value with the least, middle and greatest of the quantity there.
pub struct Stop {
    /// Value of the input.
    pub x: f64,
    /// 16th percentile, median and 84th percentile of the quantity.
    pub y: [f64; 3],
}

/// The curve over the stops, in the order of the input; none without two of them.
pub fn band(
    id: &str,
    [x_name, x_unit]: [&str; 2],
    [y_name, y_unit]: [&str; 2],
    stops: &[Stop],
) -> Option<Markup> {
    let stops: Vec<&Stop> = stops.iter().filter(|stop| stop.x.is_finite() && stop.y[1].is_finite()).collect();
    if stops.len() < 2 {
        return None;
    }
    let x = Axis::fitting(stops.iter().map(|stop| stop.x))?;
    let y = Axis::fitting(stops.iter().flat_map(|stop| stop.y))?;
    let point = |stop: &Stop, of: usize| (WIDTH * x.place(stop.x), HEIGHT * (1.0 - y.place(stop.y[of])));
    let line = |points: Vec<(f64, f64)>| {
        points.iter().enumerate().fold(String::new(), |mut path, (i, (x, y))| {
            let _ = write!(path, "{}{x:.1} {y:.1}", if i == 0 { 'M' } else { 'L' });
            path
        })
    };
    let middle = line(stops.iter().map(|stop| point(stop, 1)).collect());
    let lower = stops.iter().map(|stop| point(stop, 0));
    let around = line(lower.chain(stops.iter().rev().map(|stop| point(stop, 2))).collect()) + "Z";
    let wide = stops.iter().any(|stop| stop.y[2] > stop.y[0]);
    let drawing = html! {
        @if wide { path.band.s1 d=(around) {} }
        path.curve.s1 d=(middle) {}
    };
    let title = format!("{y_name} against {x_name}");
    let caption =
        if wide { "Median, and the band from the 16th to the 84th percentile." } else { "One value each." };
    let frame = Frame { id, title: &title, caption, x: (&x, x_name, x_unit), y: (&y, y_name, y_unit) };
    Some(frame.draw(&drawing, &html! {}))
}
