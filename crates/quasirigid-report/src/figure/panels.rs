//! Picture of several panels below each other over one horizontal axis: curves with measured points, and what they leave.

use std::fmt::Write;

use maud::{Markup, html};

use super::axis::Axis;
use super::picture::{COLOURS, INK, MUTED, RULE, WIDTH, number, raised, whole};
use super::rows::{self, Row};
use super::trace::Trace;

/// Margins (px), and the column of the histogram with the gap before it.
const LEFT: f64 = 66.0;
const TOP: f64 = 34.0;
const BOTTOM: f64 = 50.0;
const BESIDE: f64 = 96.0;
const GAP: f64 = 14.0;
/// Width of the panels.
const WIDE: f64 = WIDTH - LEFT - BESIDE - GAP - 14.0;
/// Distance of panels, with the name of the lower one.
const BETWEEN: f64 = 34.0;
/// Heights: least and greatest of a panel of curves, what all of them share, and that of the residuals.
const HEIGHTS: [f64; 2] = [72.0, 150.0];
const SHARED: f64 = 380.0;
const RESIDUALS: f64 = 120.0;
/// Least and greatest reach of the axis of residuals, in deviations.
const REACH: [f64; 2] = [3.5, 8.0];
/// Room beyond the greatest residual.
const ROOM: f64 = 0.25;
/// Fewest and most bins of the histogram.
const BINS: [f64; 2] = [7.0, 31.0];

/// A measured column beside the one that fits best.
pub struct Compared {
    /// Name.
    pub name: String,
    /// Unit.
    pub unit: String,
    /// Measured values.
    pub measured: Vec<f64>,
    /// Values that fit best.
    pub fitted: Vec<f64>,
    /// Residuals over their deviations.
    pub residuals: Vec<f64>,
}

/// What is drawn: columns over the time, residuals, and single measurements.
pub struct Panels {
    /// Title.
    pub title: String,
    /// Places along the horizontal axis.
    pub x: Vec<f64>,
    /// Name of that axis.
    pub x_name: String,
    /// The columns.
    pub columns: Vec<Compared>,
    /// Single measurements, in their deviations.
    pub rows: Vec<Row>,
}

impl Panels {
    /// The picture as an SVG file of its own; none without anything to draw.
    pub fn picture(&self) -> Option<String> {
        let mut top = TOP;
        let mut parts = Vec::new();
        if !self.columns.is_empty() {
            let x = Axis::linear(self.x.iter().copied(), 0.0)?;
            let tall = (SHARED / self.columns.len() as f64).clamp(HEIGHTS[0], HEIGHTS[1]);
            for (place, column) in self.columns.iter().enumerate() {
                parts.push(placed(LEFT, top, &self.curves(column, colour(place), &x, tall)?));
                top += tall + BETWEEN;
            }
            let reach = Reach::of(&self.columns);
            parts.push(placed(
                LEFT,
                TOP,
                &html! {
                    text x=(WIDE) y="-10" text-anchor="end" fill=(MUTED) { "points: measured, line: fitted" }
                },
            ));
            parts.push(placed(LEFT, top, &self.residuals(&x, &reach)?));
            parts.push(placed(LEFT + WIDE + GAP, top, &self.histogram(&reach)));
            top += RESIDUALS + BOTTOM + if self.rows.is_empty() { 0.0 } else { BETWEEN };
        }
        if !self.rows.is_empty() {
            let left = rows::names_width(&self.rows) + 14.0;
            let x = rows::axis(&self.rows, 2.5, 0.05)?;
            let drawn = rows::draw(&self.rows, &x, "off by [deviations]", WIDTH - left - 28.0);
            parts.push(placed(left, top, &drawn));
            top += rows::height(&self.rows) + rows::BELOW;
        }
        (!parts.is_empty()).then(|| whole(&self.title, top.ceil(), &html! { @for part in &parts { (part) } }))
    }

    /// Measured points on the curve that fits best.
    fn curves(&self, column: &Compared, colour: &str, x: &Axis, tall: f64) -> Option<Markup> {
        let values = column.measured.iter().chain(&column.fitted).copied();
        let y = Axis::linear(values, 0.06)?;
        let size = [WIDE, tall];
        let places = |values: &[f64]| -> Vec<(f64, f64)> {
            self.x.iter().zip(values).map(|(t, value)| (x.place(*t), y.place(*value))).collect()
        };
        let points = Trace::of_points(size, places(&column.measured).into_iter());
        let curve = Trace::new(size, places(&column.fitted).into_iter());
        let unit = crate::number::unit_with_power(y.power, &column.unit);
        Some(html! {
            (rules(x, &y, size, false))
            text x=(8.0 - LEFT) y="-10" fill=(INK) { (raised(&format!("{} [{unit}]", column.name))) }
            g fill="none" stroke-linejoin="round" stroke-linecap="round" {
                path stroke=(colour) stroke-width="1.6" d=(curve.line) {}
                path stroke=(INK) stroke-opacity="0.6" stroke-width="2.8" d=(points.dots) {}
            }
        })
    }

    /// Residuals of all columns, those beyond the axis at its edge.
    fn residuals(&self, x: &Axis, reach: &Reach) -> Option<Markup> {
        let y = Axis::linear([-reach.end, reach.end].into_iter(), 0.0)?;
        let size = [WIDE, RESIDUALS];
        let band = [1.0, -1.0].map(|edge| (1.0 - y.place(edge)) * RESIDUALS);
        let dots = |column: &Compared| {
            let each = self.x.iter().zip(&column.residuals);
            let places = each.map(|(t, r)| (x.place(*t), y.place(r.clamp(-reach.end, reach.end))));
            Trace::of_points(size, places).dots
        };
        let beyond =
            (reach.beyond > 0).then(|| format!("{} beyond ±{}, at the edge", reach.beyond, reach.end));
        Some(html! {
            rect width=(WIDE) y=(number(band[0])) height=(number(band[1] - band[0])) fill=(RULE) fill-opacity="0.5" {}
            (rules(x, &y, size, true))
            text x=(8.0 - LEFT) y="-10" fill=(INK) { "residuals [deviations]" }
            @if let Some(beyond) = beyond {
                text x=(WIDE) y="-10" text-anchor="end" fill=(MUTED) { (beyond) }
            }
            g fill="none" stroke-linecap="round" {
                @for (place, column) in self.columns.iter().enumerate() {
                    path stroke=(colour(place)) stroke-width="3.2" d=(dots(column)) {}
                }
            }
            text x=(WIDE) y=(RESIDUALS + 40.0) text-anchor="end" fill=(INK) { (raised(&self.x_name)) }
        })
    }

    /// How often residuals fall into equal bins, lying on the axis of the residuals, beside the normal distribution.
    fn histogram(&self, reach: &Reach) -> Markup {
        let all = || self.columns.iter().flat_map(|column| &column.residuals);
        let total = all().count() as f64;
        let bins = total.sqrt().clamp(BINS[0], BINS[1]).round() as usize;
        let mut counts = vec![0.0; bins];
        for r in all().filter(|r| r.abs() <= reach.end) {
            counts[((0.5 + 0.5 * r / reach.end) * bins as f64).min(bins as f64 - 1.0) as usize] += 1.0;
        }
        let width = 2.0 * reach.end / bins as f64;
        let normal = |r: f64| total * width * (-0.5 * r * r).exp() / std::f64::consts::TAU.sqrt();
        let most = counts.iter().copied().fold(normal(0.0), f64::max);
        let tall = RESIDUALS / bins as f64;
        let bars = counts.iter().enumerate().fold(String::new(), |mut path, (bin, count)| {
            let (top, right) = (RESIDUALS - tall * (bin as f64 + 1.0), BESIDE * count / most);
            let _ = write!(path, "M0 {top:.1}H{right:.1}v{:.1}H0Z", tall - 0.6);
            path
        });
        let curve = (0..=80).fold(String::new(), |mut path, k| {
            let r = reach.end * (f64::from(k) / 40.0 - 1.0);
            let (x, y) = (BESIDE * normal(r) / most, 0.5 * RESIDUALS * (1.0 - r / reach.end));
            let _ = write!(path, "{}{x:.1} {y:.1}", if k == 0 { 'M' } else { 'L' });
            path
        });
        html! {
            path fill=(MUTED) fill-opacity="0.4" d=(bars) {}
            path fill="none" stroke=(INK) stroke-width="1.2" stroke-dasharray="4 3" d=(curve) {}
            line x1="0" x2="0" y1="0" y2=(RESIDUALS) stroke=(MUTED) {}
            text x="0" y="-10" fill=(MUTED) { "normal: dashed" }
        }
    }
}

/// How far the axis of residuals reaches, and the number of residuals beyond.
struct Reach {
    end: f64,
    beyond: usize,
}

impl Reach {
    fn of(columns: &[Compared]) -> Self {
        let all = || columns.iter().flat_map(|column| column.residuals.iter().map(|r| r.abs()));
        let end = (all().fold(0.0, f64::max) + ROOM).clamp(REACH[0], REACH[1]);
        let end = (2.0 * end).ceil() / 2.0;
        Self { end, beyond: all().filter(|r| *r > end).count() }
    }
}

fn colour(place: usize) -> &'static str {
    COLOURS[place % COLOURS.len()].1
}

fn placed(left: f64, top: f64, part: &Markup) -> Markup {
    html! { g transform={ "translate(" (number(left)) " " (number(top)) ")" } { (part) } }
}

/// Lines at the ticks of a panel, the labels of the horizontal axis where it is the last.
fn rules(x: &Axis, y: &Axis, [width, height]: [f64; 2], last: bool) -> Markup {
    html! {
        @for tick in thinned(y, height) {
            @let at = (1.0 - tick.0) * height;
            line x1="0" x2=(width) y1=(number(at)) y2=(number(at)) stroke=(RULE) {}
            text x="-8" y=(number(at + 4.5)) text-anchor="end" fill=(MUTED) { (raised(&tick.1)) }
        }
        @for tick in x.ticks() {
            @let at = number(tick.at * width);
            line x1=(at) x2=(at) y1="0" y2=(height) stroke=(RULE) {}
            @if last { text x=(at) y=(height + 20.0) text-anchor="middle" fill=(MUTED) { (raised(&tick.label)) } }
        }
        line x1="0" x2=(width) y1=(height) y2=(height) stroke=(MUTED) {}
    }
}

/// Ticks of a vertical axis, every second or third where their labels would touch.
fn thinned(y: &Axis, height: f64) -> Vec<(f64, String)> {
    let ticks: Vec<(f64, String)> = y.ticks().into_iter().map(|tick| (tick.at, tick.label)).collect();
    let room = (height / 17.0).max(1.0);
    let every = (ticks.len() as f64 / room).ceil().max(1.0) as usize;
    let zero = ticks.iter().position(|(_, label)| label.trim_matches(['0', '.']).is_empty()).unwrap_or(0);
    let kept = ticks.into_iter().enumerate().filter(|(place, _)| place % every == zero % every);
    kept.map(|(_, tick)| tick).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn panels(residuals: [f64; 3]) -> Panels {
        let column = Compared {
            name: "wx".into(),
            unit: "rad/s".into(),
            measured: vec![1.0, 2.0, 3.0],
            fitted: vec![1.1, 2.0, 2.9],
            residuals: residuals.to_vec(),
        };
        Panels {
            title: "Fit".into(),
            x: vec![0.0, 1.0, 2.0],
            x_name: "t [s]".into(),
            columns: vec![column],
            rows: vec![],
        }
    }

    #[test]
    fn residuals_beyond_the_axis_are_told_and_stay_on_it() {
        let picture = panels([1.0, -20.0, 0.5]).picture().unwrap();
        assert!(picture.contains("1 beyond ±8, at the edge") && picture.contains("wx [rad/s]"));
        assert!(!panels([1.0, -2.0, 0.5]).picture().unwrap().contains("beyond"));
    }

    #[test]
    fn nothing_to_draw_is_no_picture() {
        let empty = Panels { columns: vec![], ..panels([0.0; 3]) };
        assert!(empty.picture().is_none());
    }
}
