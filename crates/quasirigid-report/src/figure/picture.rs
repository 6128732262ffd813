//! Picture of a chart for a paper or a slide: an SVG file of its own, with places in pixels and every style in the file.
//! It takes no style sheet and no units but pixels, so that every program that reads SVG draws the same.

use maud::{Markup, html};
use quasirigid_io::visible::visible;

use super::Figure;
use super::axis::Axis;
use super::trace::Trace;

/// Size of the picture (px): 170 mm by 106 mm at 96 px per inch.
pub(super) const WIDTH: f64 = 640.0;
const HEIGHT: f64 = 400.0;
/// Margins: left for the ticks, top for the name of the vertical axis, right for the names of the curves, bottom.
const LEFT: f64 = 66.0;
const TOP: f64 = 34.0;
const RIGHT: f64 = 96.0;
const BOTTOM: f64 = 52.0;
/// Size of the box of the curves.
const BOX: [f64; 2] = [WIDTH - LEFT - RIGHT, HEIGHT - TOP - BOTTOM];

/// Colours of the curves on white paper, by the first part of their class; those of the page in light.
pub(super) const COLOURS: [(&str, &str); 4] =
    [("s1", "#0068a8"), ("s2", "#c24a00"), ("s3", "#00805c"), ("s4", "#9a4f8a")];
pub(super) const INK: &str = "#1b1f24";
pub(super) const MUTED: &str = "#59626d";
pub(super) const RULE: &str = "#d9dde2";

/// Beginning of the file.
const HEAD: &str = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";

impl Figure {
    /// The chart as an SVG file of its own; none without a curve.
    pub fn picture(&self) -> Option<String> {
        let [x, y] = self.axes()?;
        let [width, height] = BOX;
        let drawing = html! {
            clipPath id="box" { rect y="-1" width=(width) height=(height + 2.0) {} }
            g transform={ "translate(" (LEFT) " " (TOP) ")" } {
                (grid(&x, &y))
                g fill="none" stroke-width="1.6" stroke-linejoin="round" stroke-linecap="round" clip-path="url(#box)" {
                    @for series in self.series.iter().rev() {
                        @let Trace { line, dots } = series.trace(&x, &y, BOX);
                        @let dashes = series.class.contains("dashed").then_some("5 4");
                        @if series.bar.is_some() {
                            path fill=(colour(series.class)) stroke="none" d=(line) {}
                        } @else {
                            path stroke=(colour(series.class)) stroke-dasharray=[dashes] d=(line) {}
                        }
                        path stroke=(colour(series.class)) stroke-width="4" d=(dots) {}
                    }
                }
                @let inside = self.has_bars() || self.is_keyed();
                @let lifted = if self.is_keyed() { -12.0 } else { 0.0 };
                @for (place, series) in self.labels(&y) {
                    text x=(if inside { width - 8.0 } else { width + 8.0 }) text-anchor=[inside.then_some("end")]
                        y=(number((place * height + 4.5 + lifted).max(12.0))) fill=(colour(series.class)) font-weight="bold"
                        stroke=[inside.then_some("#fff")] stroke-width=[inside.then_some("3")] paint-order=[inside.then_some("stroke")] {
                        (series.label)
                    }
                }
                (self.marked(&x, &y))
                text x=(-LEFT + 8.0) y="-14" fill=(INK) { (raised(&self.y.text(y.power))) }
                text x=(width) y=(height + 42.0) text-anchor="end" fill=(INK) { (raised(&self.x.text(x.power))) }
            }
        };
        Some(whole(&self.title, HEIGHT, &drawing))
    }

    /// The events, each a dashed line with its label.
    fn marked(&self, x: &Axis, y: &Axis) -> Markup {
        let [width, height] = BOX;
        let places = self.marks.iter().enumerate().map(|(row, mark)| {
            let (from, step) = if self.is_above(mark, x, y) { (16.0, 18.0) } else { (height - 8.0, -18.0) };
            (x.place(mark.x), &mark.label, from + step * row as f64)
        });
        html! {
            @for (place, label, down) in places.filter(|(place, ..)| (0.0..=1.0).contains(place)) {
                @let at = number(place * width);
                @let (anchor, gap) = if place > 0.5 { ("end", -6.0) } else { ("start", 6.0) };
                line x1=(at) x2=(at) y1="0" y2=(height) stroke=(MUTED) stroke-dasharray="3 3" {}
                text x=(number(place * width + gap)) y=(number(down)) text-anchor=(anchor) fill=(MUTED) { (label) }
            }
        }
    }
}

/// A drawing of this height (px) as a file of its own.
pub(super) fn whole(title: &str, height: f64, drawing: &Markup) -> String {
    let drawing = html! {
        svg xmlns="http://www.w3.org/2000/svg" width=(WIDTH) height=(height) viewBox={ "0 0 " (WIDTH) " " (height) }
            font-family="Helvetica, Arial, Liberation Sans, DejaVu Sans, sans-serif" font-size="13" {
            title { (title) }
            rect width=(WIDTH) height=(height) fill="#fff" {}
            (drawing)
        }
    };
    format!("{HEAD}{}\n", visible(&drawing.into_string()))
}

fn grid(x: &Axis, y: &Axis) -> Markup {
    let [width, height] = BOX;
    html! {
        @for tick in y.ticks() {
            @let at = (1.0 - tick.at) * height;
            line x1="0" x2=(width) y1=(number(at)) y2=(number(at)) stroke=(RULE) {}
            text x="-8" y=(number(at + 4.5)) text-anchor="end" fill=(MUTED) { (raised(&tick.label)) }
        }
        @for tick in x.ticks() {
            @let at = number(tick.at * width);
            line x1=(at) x2=(at) y1="0" y2=(height) stroke=(RULE) {}
            text x=(at) y=(height + 20.0) text-anchor="middle" fill=(MUTED) { (raised(&tick.label)) }
        }
        line x1="0" x2=(width) y1=(height) y2=(height) stroke=(MUTED) {}
    }
}

/// A text with its superscripts as raised digits, since few fonts have all superscripts.
pub(super) fn raised(text: &str) -> Markup {
    const SUPERSCRIPTS: &str = "⁰¹²³⁴⁵⁶⁷⁸⁹⁻";
    let plain = |letter: char| "0123456789−".chars().nth(SUPERSCRIPTS.chars().position(|it| it == letter)?);
    let mut parts: Vec<(bool, String)> = Vec::new();
    for letter in text.chars() {
        let up = plain(letter);
        match parts.last_mut().filter(|(raised, _)| *raised == up.is_some()) {
            Some((_, part)) => part.push(up.unwrap_or(letter)),
            None => parts.push((up.is_some(), up.unwrap_or(letter).to_string())),
        }
    }
    html! {
        @for (place, (up, part)) in parts.iter().enumerate() {
            @if *up { tspan dy="-5" font-size="9.5" { (part) } }
            @else if place > 0 { tspan dy="5" { (part) } }
            @else { (part) }
        }
    }
}

fn colour(class: &str) -> &'static str {
    COLOURS.iter().find(|(name, _)| class.starts_with(name)).map_or(INK, |(_, colour)| colour)
}

pub(super) fn number(value: f64) -> String {
    format!("{value:.1}")
}
