//! Rows with a name on the left and what is drawn beside it over one axis, largest first: bars of a tornado, points with their errors.

use maud::{Markup, html};

use super::axis::Axis;
use super::picture::{INK, MUTED, RULE, WIDTH, number, raised, whole};

/// Height of a row, of a bar in it, and of the axis below (px).
const ROW: f64 = 22.0;
const BAR: f64 = 14.0;
/// Room below the rows, for the axis and its name.
pub const BELOW: f64 = 46.0;
/// Width of a letter on the average, and the most letters of a name.
const LETTER: f64 = 6.6;
const LONGEST: usize = 40;

/// A row.
pub struct Row {
    /// Name, on the left.
    pub name: String,
    /// What is drawn.
    pub drawn: Drawn,
}

/// What is drawn in a row.
pub enum Drawn {
    /// Bars from zero, each with its colour, and a text beside the longest of them.
    Bars(Vec<(f64, &'static str)>, String),
    /// A point with an error to both sides.
    Point(f64, f64),
}

impl Row {
    /// Values that the axis must reach.
    fn reach(&self) -> Vec<f64> {
        match &self.drawn {
            Drawn::Bars(bars, _) => bars.iter().map(|(value, _)| *value).collect(),
            Drawn::Point(value, error) => vec![value - error, value + error],
        }
    }

    fn shown_name(&self) -> String {
        let letters: Vec<char> = self.name.chars().collect();
        if letters.len() <= LONGEST {
            return self.name.clone();
        }
        let (head, tail) = (&letters[..LONGEST / 2 - 1], &letters[letters.len() - LONGEST / 2..]);
        format!("{}…{}", head.iter().collect::<String>(), tail.iter().collect::<String>())
    }
}

/// Width that the names take (px).
pub fn names_width(rows: &[Row]) -> f64 {
    let longest = rows.iter().map(|row| row.shown_name().chars().count()).max().unwrap_or(0);
    (LETTER * longest as f64 + 12.0).max(60.0)
}

/// Height of the rows (px).
pub fn height(rows: &[Row]) -> f64 {
    ROW * rows.len() as f64
}

/// The axis of rows, from the least to the greatest value with zero between, and as far at least.
pub fn axis(rows: &[Row], least: f64, margin: f64) -> Option<Axis> {
    let reach = rows
        .iter()
        .flat_map(Row::reach)
        .fold([-least, least], |[low, high], value| [low.min(value), high.max(value)]);
    Axis::linear(reach.into_iter(), margin)
}

/// The rows in a box of this width, the origin at its upper left, with the axis and its name below.
pub fn draw(rows: &[Row], x: &Axis, name: &str, width: f64) -> Markup {
    let bottom = height(rows);
    let at = |value: f64| x.place(value).clamp(0.0, 1.0) * width;
    let middle = |row: usize| ROW * (row as f64 + 0.5);
    html! {
        @for tick in x.ticks() {
            @let across = number(tick.at * width);
            line x1=(across) x2=(across) y1="0" y2=(number(bottom)) stroke=(RULE) {}
            text x=(across) y=(number(bottom + 20.0)) text-anchor="middle" fill=(MUTED) { (raised(&tick.label)) }
        }
        @for (place, row) in rows.iter().enumerate() {
            text x="-10" y=(number(middle(place) + 4.5)) text-anchor="end" fill=(INK) font-size="12" { (row.shown_name()) }
            (row.draw(middle(place), at))
        }
        line x1=(number(at(0.0))) x2=(number(at(0.0))) y1="0" y2=(number(bottom)) stroke=(MUTED) {}
        text x=(number(width)) y=(number(bottom + 40.0)) text-anchor="end" fill=(INK) { (raised(name)) }
    }
}

/// Colours of the change by one per cent more, and by one per cent less of a key.
pub const MORE_AND_LESS: [&str; 2] = ["#0068a8", "#e3a07a"];
/// Room above the rows of a tornado, and to the right of its box.
const ABOVE: f64 = 58.0;
const RIGHT: f64 = 30.0;

/// Rows of bars of an answer as an SVG file of its own, with the meaning of the colours above; none without rows.
pub fn tornado(answer: &str, rows: &[Row]) -> Option<String> {
    if rows.is_empty() {
        return None;
    }
    let left = names_width(rows) + 14.0;
    let width = WIDTH - left - RIGHT;
    // room for the text beside the longest bar
    let x = axis(rows, 0.0, 0.08)?;
    let drawing = html! {
        text x="14" y="24" fill=(INK) font-weight="bold" { (answer) }
        @for (place, (word, colour)) in ["1 % more of the key", "1 % less"].iter().zip(MORE_AND_LESS).enumerate() {
            @let at = 14.0 + 150.0 * place as f64;
            rect x=(at) y="36" width="11" height="11" fill=(colour) {}
            text x=(at + 17.0) y="46" fill=(MUTED) font-size="12" { (word) }
        }
        g transform={ "translate(" (number(left)) " " (ABOVE) ")" } {
            (draw(rows, &x, "change [%]", width))
        }
    };
    Some(whole(answer, ABOVE + height(rows) + BELOW, &drawing))
}

impl Row {
    fn draw(&self, middle: f64, at: impl Fn(f64) -> f64) -> Markup {
        match &self.drawn {
            Drawn::Bars(bars, label) => {
                let right = bars.iter().map(|(value, _)| *value).fold(0.0, f64::max);
                html! {
                    @for (value, colour) in bars {
                        @let ends = [at(0.0).min(at(*value)), at(0.0).max(at(*value))];
                        rect x=(number(ends[0])) width=(number(ends[1] - ends[0])) y=(number(middle - 0.5 * BAR)) height=(BAR) fill=(colour) {}
                    }
                    text x=(number(at(right) + 6.0)) y=(number(middle + 4.0)) fill=(MUTED) font-size="11.5"
                        stroke="#fff" stroke-width="3" paint-order="stroke" { (label) }
                }
            }
            Drawn::Point(value, error) => html! {
                line x1=(number(at(value - error))) x2=(number(at(value + error))) y1=(number(middle)) y2=(number(middle))
                    stroke="#0068a8" stroke-width="1.6" {}
                circle cx=(number(at(*value))) cy=(number(middle)) r="3.5" fill="#0068a8" {}
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(name: &str, value: f64) -> Row {
        Row {
            name: name.to_owned(),
            drawn: Drawn::Bars(vec![(value, "#000"), (-value, "#fff")], String::new()),
        }
    }

    #[test]
    fn bars_start_at_zero_and_end_at_their_values() {
        let rows = [row("a", 2.0), row("b", -1.0)];
        let x = axis(&rows, 0.0, 0.0).unwrap();
        let drawn = draw(&rows, &x, "change", 100.0).into_string();
        for bar in ["x=\"50.0\" width=\"50.0\"", "x=\"0.0\" width=\"50.0\"", "x=\"25.0\" width=\"25.0\""] {
            assert!(drawn.contains(bar), "{bar}: {drawn}");
        }
    }

    #[test]
    fn long_names_lose_their_middle() {
        let name = "matrices.1.damping.".repeat(5);
        let shown = row(&name, 1.0).shown_name();
        assert!(shown.chars().count() == LONGEST && shown.starts_with("matrices.1") && shown.contains('…'));
    }
}
