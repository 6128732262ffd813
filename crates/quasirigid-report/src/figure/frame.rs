//! Frame of a chart of a study: title, grid and axis names around a drawing of its own.
//! Charts of studies differ in what they draw (bars, bands, cells), not in their frame; curves against time have [`Figure`](super::Figure).

use maud::{Markup, html};

use super::axis::Axis;
use super::trace::{HEIGHT, WIDTH};
use super::{grid, percent};
use crate::number::unit_with_power;

/// Frame of a chart.
pub struct Frame<'a> {
    /// Identifier within the page.
    pub id: &'a str,
    /// Title.
    pub title: &'a str,
    /// Caption: the content, and the way of drawing.
    pub caption: &'a str,
    /// Horizontal axis with the name and the unit of its quantity.
    pub x: (&'a Axis, &'a str, &'a str),
    /// Vertical axis likewise.
    pub y: (&'a Axis, &'a str, &'a str),
}

impl Frame<'_> {
    /// The chart around a drawing in a box of [`WIDTH`] by [`HEIGHT`], the origin at its upper left, and labels over it.
    pub fn draw(&self, drawing: &Markup, over: &Markup) -> Markup {
        let [x_name, y_name] = [self.x, self.y].map(named);
        let [title, desc] = ["title", "desc"].map(|part| format!("{}-{part}", self.id));
        html! {
            figure {
                h3 { (self.title) }
                div.chart.still {
                    svg.plot role="img" aria-labelledby={ (title) " " (desc) } {
                        title id=(title) { (self.title) }
                        desc id=(desc) { (y_name) " against " (x_name) ". " (self.caption) }
                        svg viewBox={ "0 0 " (WIDTH) " " (HEIGHT) } preserveAspectRatio="none" width="100%" height="100%" { (drawing) }
                        (grid(&self.x.0.ticks(), &self.y.0.ticks()))
                        text.name x="-3.6em" y="-0.9em" { (y_name) }
                        text.name.end x="100%" y="100%" dy="3.1em" { (x_name) }
                        (over)
                    }
                }
                figcaption { (self.caption) }
            }
        }
    }
}

/// A label at a place of the frame, both from 0 to 1 and the height from below, with a line across the chart.
pub fn marked(x: f64, label: &str) -> Markup {
    let at = percent(x);
    html! {
        line.event x1=(at) x2=(at) y1="0" y2="100%" {}
        text.name.event.middle x=(at) y="0" dy="-0.35em" { (label) }
    }
}

fn named((axis, name, unit): (&Axis, &str, &str)) -> String {
    let unit = unit_with_power(axis.power, unit);
    if unit.trim().is_empty() || unit == "1" { name.to_owned() } else { format!("{name} [{unit}]") }
}
