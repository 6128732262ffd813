//! Line charts: SVG whose text keeps its size while the plot takes the width of the page.

mod axis;
mod band;
mod contour;
mod frame;
mod histogram;
mod map;
mod trace;

use maud::{Markup, html};

use crate::number::unit_with_power;
use axis::{Axis, Tick};
use trace::{HEIGHT, Trace, WIDTH};

pub use band::{Stop, band};
pub use histogram::histogram;
pub use map::{Grid, map};

/// A curve.
pub struct Series {
    /// Label at the right end of the curve.
    pub label: String,
    /// CSS class of the colour, `s1` to `s4`.
    pub class: &'static str,
    /// Places along the time axis.
    pub x: Vec<f64>,
    /// Values, one per place.
    pub y: Vec<f64>,
}

/// A quantity with its unit, as an axis names it.
pub struct Quantity {
    /// Name.
    pub name: &'static str,
    /// Unit.
    pub unit: String,
}

/// An event: a place on the horizontal axis with a label.
pub struct Mark {
    /// Place along the axis.
    pub x: f64,
    /// Name of the event.
    pub label: String,
}

/// A chart of curves against time.
pub struct Figure {
    /// Identifier within the page.
    pub id: &'static str,
    /// Title.
    pub title: &'static str,
    /// Caption: the content, and the way of drawing.
    pub caption: String,
    /// The horizontal axis.
    pub x: Quantity,
    /// The vertical axis.
    pub y: Quantity,
    /// Whether the vertical axis is logarithmic.
    pub log: bool,
    /// The curves, the most important first: it is drawn over the others.
    pub series: Vec<Series>,
    /// Events, each drawn as a line across the curves.
    pub marks: Vec<Mark>,
}

impl Figure {
    /// The chart, or a sentence when it has nothing to draw.
    pub fn draw(&self) -> Markup {
        let values = || self.series.iter().flat_map(|series| series.y.iter().copied());
        let x = Axis::linear(self.series.iter().flat_map(|series| series.x.iter().copied()), 0.0);
        let y = if self.log { Axis::logarithmic(values()) } else { Axis::linear(values(), 0.05) };
        html! {
            figure {
                h3 { (self.title) }
                @if let (Some(x), Some(y)) = (x, y) {
                    (self.chart(&x, &y))
                    figcaption { (self.caption) }
                } @else {
                    p.absent { "The record holds nothing that this figure could show." }
                }
            }
        }
    }

    fn chart(&self, x: &Axis, y: &Axis) -> Markup {
        let [title, desc] = ["title", "desc"].map(|part| format!("{}-{part}", self.id));
        let x_name = self.x.text(x.power);
        let y_name = self.y.text(y.power);
        html! {
            div.chart data-x={ (x.low) " " (x.high) } data-y={ (y.low) " " (y.high) } data-log[y.log] {
                svg.plot role="img" aria-labelledby={ (title) " " (desc) } {
                    title id=(title) { (self.title) }
                    desc id=(desc) { (self.description(&x_name, &y_name)) }
                    (grid(&x.ticks(), &y.ticks()))
                    text.name x="-3.6em" y="-0.9em" { (y_name) }
                    text.name.end x="100%" y="100%" dy="3.1em" { (x_name) }
                    svg viewBox={ "0 0 " (WIDTH) " " (HEIGHT) } preserveAspectRatio="none" width="100%" height="100%" {
                        @for series in self.series.iter().rev() {
                            @let Trace { line, dots } = series.trace(x, y);
                            path.curve.(series.class) data-label=(series.label) d=(line) {}
                            path.dots.(series.class) d=(dots) {}
                        }
                    }
                    (self.labels(y))
                    @for mark in &self.marks { (mark.draw(x)) }
                }
            }
        }
    }

    fn description(&self, x: &str, y: &str) -> String {
        let labels: Vec<&str> = self.series.iter().map(|series| series.label.as_str()).collect();
        format!("Curves of {}: {y} against {x}. {}", labels.join(", "), self.caption)
    }

    /// The names of the curves at their right ends, pushed apart where they would overlap.
    fn labels(&self, y: &Axis) -> Markup {
        let end =
            |series: &Series| series.y.iter().rev().map(|&v| y.place(v)).find(|place| place.is_finite());
        let mut labels: Vec<(f64, &Series)> = self
            .series
            .iter()
            .filter_map(|series| Some((1.0 - end(series)?.clamp(0.0, 1.0), series)))
            .collect();
        labels.sort_by(|a, b| a.0.total_cmp(&b.0));
        let places = apart(labels.iter().map(|label| label.0).collect());
        html! {
            @for (place, (_, series)) in places.into_iter().zip(labels) {
                text.label.(series.class) x="100%" y=(percent(place)) dx="0.6em" dy="0.35em" { (series.label) }
            }
        }
    }
}

impl Mark {
    /// Draws the line and its label, on the side with more room; nothing if the line lies off the axis.
    fn draw(&self, x: &Axis) -> Markup {
        let place = x.place(self.x);
        let (at, left) = (percent(place), place > 0.5);
        html! {
            @if (0.0..=1.0).contains(&place) {
                line.event x1=(at) x2=(at) y1="0" y2="100%" {}
                text.name.event.end[left] x=(at) y="100%" dx=(if left { "-0.5em" } else { "0.5em" }) dy="-0.6em" {
                    (self.label)
                }
            }
        }
    }
}

impl Quantity {
    fn text(&self, power: i32) -> String {
        format!("{} [{}]", self.name, unit_with_power(power, &self.unit))
    }
}

impl Series {
    fn trace(&self, x: &Axis, y: &Axis) -> Trace {
        let places = |(&t, &value): (&f64, &f64)| (x.place(t), y.place(value));
        Trace::new(self.x.iter().zip(&self.y).map(places))
    }
}

fn grid(x: &[Tick], y: &[Tick]) -> Markup {
    html! {
        line.base x1="0" x2="100%" y1="100%" y2="100%" {}
        @for tick in y {
            @let at = percent(1.0 - tick.at);
            line.grid x1="0" x2="100%" y1=(at) y2=(at) {}
            text.tick.end x="0" y=(at) dx="-0.6em" dy="0.35em" { (tick.label) }
        }
        @for (i, tick) in x.iter().enumerate() {
            @let at = percent(tick.at);
            line.grid x1=(at) x2=(at) y1="0" y2="100%" {}
            text.tick.middle.spare[i % 2 == 1] x=(at) y="100%" dy="1.5em" { (tick.label) }
        }
    }
}

fn percent(place: f64) -> String {
    format!("{:.2}%", 100.0 * place)
}

/// Moves sorted places apart to the height of a line of text, keeping them within the plot.
fn apart(mut places: Vec<f64>) -> Vec<f64> {
    const LINE: f64 = 16.0 / HEIGHT;
    for i in 1..places.len() {
        places[i] = places[i].max(places[i - 1] + LINE);
    }
    let mut limit = 1.0;
    for place in places.iter_mut().rev() {
        *place = place.min(limit);
        limit = *place - LINE;
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_keep_a_line_apart_and_stay_on_the_plot() {
        let line = 16.0 / HEIGHT;
        assert_eq!(apart(vec![0.1, 0.5]), [0.1, 0.5]);
        assert_eq!(apart(vec![0.0, 0.0, 0.01]), [0.0, line, 2.0 * line]);
        let [a, b, c] = apart(vec![0.99, 1.0, 1.0])[..] else { panic!("three labels stay three") };
        assert!(c <= 1.0 && c - b > 0.999 * line && b - a > 0.999 * line);
    }
}
