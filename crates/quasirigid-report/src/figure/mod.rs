//! Line charts: SVG whose text keeps its size while the plot takes the width of the page.

mod axis;
mod band;
mod contour;
mod data;
mod frame;
mod histogram;
mod map;
mod panels;
mod picture;
mod rows;
mod trace;

use maud::{Markup, html};

use crate::columns::TimeUnit;
use crate::number::unit_with_power;
use axis::{Axis, Tick};
use trace::{HEIGHT, PAGE, Trace, WIDTH};

pub use band::{Stop, band};
pub use histogram::histogram;
pub use map::{Grid, map};
pub use panels::{Compared, Panels};
pub use rows::{Drawn, MORE_AND_LESS, Row, tornado};

/// Most characters of a name beside its curve.
const BESIDE: usize = 8;
/// Distance of the labels of events (em), their reach along the axis, and the height that they take, as parts of the box.
const MARK_ROW: f64 = 1.4;
const MARK_REACH: f64 = 0.3;
const MARK_HEIGHT: f64 = 0.2;

/// A curve, or a set of points.
pub struct Series {
    /// Label at the right end of the curve.
    pub label: String,
    /// CSS class of the colour, `s1` to `s4`.
    pub class: &'static str,
    /// Places along the horizontal axis.
    pub x: Vec<f64>,
    /// Values, one per place.
    pub y: Vec<f64>,
    /// Rows of the record that the places stand for, where they are its extremes alone.
    pub rows: u64,
    /// Whether the places are points that no line joins.
    pub points: bool,
    /// Left and right edge of the bars from zero to each value, from its place; none of curves and points.
    pub bar: Option<[f64; 2]>,
}

/// A quantity with its unit, as an axis names it.
pub struct Quantity {
    /// Name.
    pub name: &'static str,
    /// Unit.
    pub unit: String,
    /// Whether its axis is logarithmic.
    pub log: bool,
}

/// Link of the horizontal axis to those of other figures, which show the same range.
pub struct Link {
    /// Name of the group.
    pub group: &'static str,
    /// Length of the unit of the axis in that of the group.
    pub factor: f64,
}

/// An event: a place on the horizontal axis with a label.
pub struct Mark {
    /// Place along the axis.
    pub x: f64,
    /// Name of the event.
    pub label: String,
}

/// A chart of curves.
pub struct Figure {
    /// Identifier within the page.
    pub id: &'static str,
    /// Title.
    pub title: String,
    /// Caption: the content, and the way of drawing.
    pub caption: String,
    /// The horizontal axis.
    pub x: Quantity,
    /// The vertical axis.
    pub y: Quantity,
    /// Link of the horizontal axis.
    pub link: Option<Link>,
    /// The curves, the most important first: it is drawn over the others.
    pub series: Vec<Series>,
    /// Events, each drawn as a line across the curves.
    pub marks: Vec<Mark>,
}

impl Figure {
    /// A chart of two quantities, without curves, names and caption.
    pub fn new(x: Quantity, y: Quantity) -> Self {
        let (series, marks) = (Vec::new(), Vec::new());
        Self { id: "", title: String::new(), caption: String::new(), x, y, link: None, series, marks }
    }

    /// A chart over the time, which figures of a group show in the same range, without curves, names and caption.
    pub fn over_time(group: &'static str, time: &TimeUnit, y: Quantity) -> Self {
        let t = Quantity { name: "t", unit: time.name.clone(), log: false };
        Self { link: Some(Link { group, factor: time.length }), ..Self::new(t, y) }
    }

    /// The chart, or a sentence when it has nothing to draw.
    pub fn draw(&self) -> Markup {
        let axes = self.axes();
        html! {
            figure.keyed[self.is_keyed()] {
                h3 { (self.title) }
                @if let Some([x, y]) = axes {
                    @if self.is_keyed() { (self.key()) }
                    (self.chart(&x, &y))
                    figcaption { (self.caption) }
                    (data::script(self, &x, &y))
                } @else {
                    p.absent { "The record has no data for this figure." }
                }
            }
        }
    }

    /// Whether a curve has a value.
    pub fn has_curves(&self) -> bool {
        self.axes().is_some()
    }

    /// The axes; none of a figure that has nothing to draw.
    fn axes(&self) -> Option<[Axis; 2]> {
        let values = || self.series.iter().flat_map(|series| series.y.iter().copied());
        let places = || self.series.iter().flat_map(|series| series.x.iter().copied());
        if self.has_bars() {
            return Some([Axis::counting(places())?, Axis::from_zero(values())?]);
        }
        let x = if self.x.log { Axis::spanning(places()) } else { Axis::linear(places(), 0.0) };
        let y = match (self.y.log, self.y.unit.as_str()) {
            (true, _) => Axis::logarithmic(values()),
            (_, "%") => Axis::from_zero(values()),
            _ => Axis::linear(values(), 0.05),
        };
        Some([x?, y?])
    }

    /// Whether values are drawn as bars.
    fn has_bars(&self) -> bool {
        self.series.iter().any(|series| series.bar.is_some())
    }

    /// Whether the label of an event stands at the top of the box: where curves near the event run at the bottom and not at the top.
    fn is_above(&self, mark: &Mark, x: &Axis, y: &Axis) -> bool {
        let points = self.series.iter().flat_map(|series| series.x.iter().zip(&series.y));
        let near = points.filter(|(at, _)| (x.place(**at) - x.place(mark.x)).abs() < MARK_REACH);
        let [mut low, mut high] = [false; 2];
        for place in near.map(|(_, value)| y.place(*value)) {
            low |= place < MARK_HEIGHT;
            high |= place > 1.0 - MARK_HEIGHT;
        }
        low && !high
    }

    /// Whether a name is too long for the right end of its curve, so that the names stand above the chart.
    fn is_keyed(&self) -> bool {
        !self.has_bars() && self.series.iter().any(|series| series.label.chars().count() > BESIDE)
    }

    /// The names above the chart; those at the ends of the curves are left to pictures that are saved.
    fn key(&self) -> Markup {
        html! {
            p.key {
                @for series in self.series.iter().filter(|series| !series.label.is_empty()) {
                    span.(series.class) { (series.label) }
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
                            @let Trace { line, dots } = series.trace(x, y, PAGE);
                            path.curve.(series.class) data-label=(series.label) d=(line) {}
                            path.dots.(series.class) d=(dots) {}
                        }
                    }
                    @for (place, series) in self.labels(y) {
                        text.label.(series.class).end[self.has_bars()] x="100%" y=(percent(place))
                            dx=(if self.has_bars() { "-0.6em" } else { "0.6em" }) dy="0.35em" { (series.label) }
                    }
                    @for (row, mark) in self.marks.iter().enumerate() { (mark.draw(x, row, self.is_above(mark, x, y))) }
                }
            }
        }
    }

    fn description(&self, x: &str, y: &str) -> String {
        let labels = self.series.iter().map(|series| series.label.as_str());
        let labels: Vec<&str> = labels.filter(|label| !label.is_empty()).collect();
        format!("Curves of {}: {y} against {x}. {}", labels.join(", "), self.caption)
    }

    /// The names of bars below each other in the upper right corner, or the curves with names at their right ends, by places from the top that are pushed apart where names would overlap.
    fn labels(&self, y: &Axis) -> Vec<(f64, &Series)> {
        if self.has_bars() {
            let line = |i: usize| (i as f64 + 0.7) * LINE;
            let named = self.series.iter().filter(|series| !series.label.is_empty());
            return named.enumerate().map(|(i, series)| (line(i), series)).collect();
        }
        let end =
            |series: &Series| series.y.iter().rev().map(|&v| y.place(v)).find(|place| place.is_finite());
        let named = self.series.iter().filter(|series| !series.label.is_empty());
        let mut labels: Vec<(f64, &Series)> =
            named.filter_map(|series| Some((1.0 - end(series)?.clamp(0.0, 1.0), series))).collect();
        labels.sort_by(|a, b| a.0.total_cmp(&b.0));
        let places = apart(labels.iter().map(|label| label.0).collect());
        places.into_iter().zip(labels).map(|(place, (_, series))| (place, series)).collect()
    }
}

impl Mark {
    /// Draws the line and its label, on the side with more room and in a row of its own; nothing if the line lies off the axis.
    fn draw(&self, x: &Axis, row: usize, above: bool) -> Markup {
        let place = x.place(self.x);
        let (at, left) = (percent(place), place > 0.5);
        let (edge, down) =
            if above { ("0%", 1.1 + MARK_ROW * row as f64) } else { ("100%", -0.6 - MARK_ROW * row as f64) };
        html! {
            @if (0.0..=1.0).contains(&place) {
                line.event x1=(at) x2=(at) y1="0" y2="100%" {}
                text.name.event.end[left] x=(at) y=(edge) dx=(if left { "-0.5em" } else { "0.5em" }) dy={ (format!("{down:.1}")) "em" } {
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
    /// A curve through all rows of a table.
    pub fn line(label: &str, class: &'static str, x: Vec<f64>, y: Vec<f64>) -> Self {
        let rows = x.len() as u64;
        Self { label: label.into(), class, x, y, rows, points: false, bar: None }
    }

    /// The values as bars with these edges.
    pub fn of_bars(mut self, edges: [f64; 2]) -> Self {
        self.bar = Some(edges);
        self
    }

    /// The places as points that no line joins.
    pub fn of_points(mut self) -> Self {
        self.points = true;
        self
    }

    /// The curve as the extremes of so many rows of a record.
    pub fn of_rows(mut self, rows: u64) -> Self {
        self.rows = rows;
        self
    }

    fn trace(&self, x: &Axis, y: &Axis, size: [f64; 2]) -> Trace {
        let places = self.x.iter().zip(&self.y).map(|(&t, &value)| (x.place(t), y.place(value)));
        if let Some([left, right]) = self.bar {
            let edges = |x_value: f64| [left, right].map(|edge| x.place(x_value + edge));
            let bars = self.x.iter().zip(&self.y).map(|(&t, &value)| (edges(t), y.place(value)));
            return Trace::of_bars(size, y.place(0.0), bars);
        }
        if self.points { Trace::of_points(size, places) } else { Trace::new(size, places) }
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

/// Height of a line of text.
const LINE: f64 = 16.0 / HEIGHT;

/// Moves sorted places apart to the height of a line of text, keeping them within the plot.
fn apart(mut places: Vec<f64>) -> Vec<f64> {
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

    fn shares(names: [&str; 2]) -> Figure {
        let curve = |name: &str| Series::line(name, "s1", vec![0.0, 40.0], vec![25.0, 25.0]);
        let quantity = |name, unit: &str| Quantity { name, unit: unit.into(), log: false };
        let mark = |x: f64| Mark { x, label: "start".into() };
        Figure {
            id: "shares",
            title: "Shares".into(),
            caption: String::new(),
            x: quantity("nutation", "°"),
            y: quantity("share", "%"),
            link: None,
            series: names.map(curve).into(),
            marks: vec![mark(10.0), mark(12.0)],
        }
    }

    #[test]
    fn long_names_stand_above_the_chart_and_labels_of_events_in_rows() {
        let long = shares(["whip", "spring damper-carrier"]).draw().into_string();
        assert!(
            long.contains("class=\"keyed\"")
                && long.contains("<p class=\"key\"><span class=\"s1\">whip</span>")
        );
        let short = shares(["whip +x", "whip -x"]).draw().into_string();
        assert!(!short.contains("key"));
        assert!(short.contains("dy=\"-0.6em\"") && short.contains("dy=\"-2.0em\""));
    }

    #[test]
    fn shares_are_drawn_from_zero() {
        let [_, y] = shares(["a", "b"]).axes().unwrap();
        assert!(y.low == 0.0 && (25.0..30.0).contains(&y.high));
    }
}
