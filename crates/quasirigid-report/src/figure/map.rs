//! Map: a quantity over two inputs of a grid, as coloured cells with contour lines.
//! Colours go in steps, which the lines bound, so that a value can be read off; a cell without a value is left empty.

use std::fmt::Write;

use maud::{Markup, html};

use super::axis::Axis;
use super::contour::contour;
use super::frame::Frame;
use super::trace::{HEIGHT, WIDTH};
use crate::number::tidy;

/// Steps of colour.
const COLOUR_STEPS: usize = 8;

/// Values over a grid: `values[row][column]` belongs to `y[row]` and `x[column]`, both ascending.
pub struct Grid {
    /// Values of the first input.
    pub x: Vec<f64>,
    /// Values of the second input.
    pub y: Vec<f64>,
    /// The quantity; not finite where it is missing.
    pub values: Vec<Vec<f64>>,
}

/// The map; none without two values along both inputs, and without two different values of the quantity.
pub fn map(id: &str, x: [&str; 2], y: [&str; 2], [name, unit]: [&str; 2], grid: &Grid) -> Option<Markup> {
    if grid.x.len() < 2 || grid.y.len() < 2 {
        return None;
    }
    let x_axis = Axis::fitting(grid.x.iter().copied())?;
    let y_axis = Axis::fitting(grid.y.iter().copied())?;
    let scale = Axis::fitting(grid.values.iter().flatten().copied())?;
    let across: Vec<f64> = grid.x.iter().map(|value| WIDTH * x_axis.place(*value)).collect();
    let along: Vec<f64> = grid.y.iter().map(|value| HEIGHT * (1.0 - y_axis.place(*value))).collect();
    let heights: Vec<Vec<f64>> =
        grid.values.iter().map(|row| row.iter().map(|value| scale.place(*value)).collect()).collect();
    let level = |step: usize| step as f64 / COLOUR_STEPS as f64;
    let lines = |step: usize| {
        contour(&across, &along, &heights, level(step)).iter().fold(String::new(), |mut path, [a, b]| {
            let _ = write!(path, "M{:.1} {:.1}L{:.1} {:.1}", a[0], a[1], b[0], b[1]);
            path
        })
    };
    let drawing = html! {
        @for (step, d) in cells(&across, &along, &heights).iter().enumerate() {
            @if !d.is_empty() { path class={ "cell m" (step) } d=(d) {} }
        }
        @for step in 1..COLOUR_STEPS { path.contour d=(lines(step)) {} }
    };
    let bound = |step: usize| tidy(scale.value(level(step)), 3);
    let title = format!("{name} over {} and {}", x[0], y[0]);
    let caption = "Colour by the value of each cell, the median where several rows share it; lines at the bounds of the colours.";
    let frame = Frame { id, title: &title, caption, x: (&x_axis, x[0], x[1]), y: (&y_axis, y[0], y[1]) };
    Some(html! {
        (frame.draw(&drawing, &html! {}))
        p.levels aria-label={ "Colours of " (name) } {
            span { (name) @if !unit.is_empty() && unit != "1" { " [" (unit) "]" } }
            @for step in 0..COLOUR_STEPS {
                span.level { span class={ "swatch m" (step) } {} (bound(step)) @if step + 1 == COLOUR_STEPS { " to " (bound(COLOUR_STEPS)) } }
            }
        }
    })
}

/// Path data of the cells of each colour: a cell reaches halfway to its neighbours.
fn cells(across: &[f64], along: &[f64], heights: &[Vec<f64>]) -> Vec<String> {
    let mut paths = vec![String::new(); COLOUR_STEPS];
    let (columns, rows) = (edges(across), edges(along));
    for (row, heights) in heights.iter().enumerate() {
        for (column, height) in heights.iter().enumerate().filter(|(_, height)| height.is_finite()) {
            let step = (height * COLOUR_STEPS as f64).clamp(0.0, COLOUR_STEPS as f64 - 1.0) as usize;
            let ([left, right], [top, bottom]) =
                ([columns[column], columns[column + 1]], [rows[row], rows[row + 1]]);
            let _ = write!(paths[step], "M{left:.1} {top:.1}H{right:.1}V{bottom:.1}H{left:.1}Z");
        }
    }
    paths
}

fn edges(places: &[f64]) -> Vec<f64> {
    let (first, last) = (places[0], places[places.len() - 1]);
    let between = places.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
    std::iter::once(first).chain(between).chain(std::iter::once(last)).collect()
}
