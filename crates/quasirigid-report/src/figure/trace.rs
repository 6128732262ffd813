//! A curve as SVG path data, thinned without loss: every pixel column keeps its extremes.

use std::fmt::Write;

/// Width of the drawing on a page, in columns of about a pixel.
pub const WIDTH: f64 = 800.0;
/// Height of the drawing on a page.
pub const HEIGHT: f64 = 240.0;
/// Both.
pub const PAGE: [f64; 2] = [WIDTH, HEIGHT];

/// Path data of a curve.
#[derive(Default)]
pub struct Trace {
    /// Continuous parts.
    pub line: String,
    /// Points alone between gaps.
    pub dots: String,
}

impl Trace {
    /// Traces the points (place along x, place along y, both from 0 to 1) in a box of this width and height, with a gap where y is not
    /// finite.
    ///
    /// Each column keeps its first, lowest, highest and last point in the order of the rows, so the line is as long
    /// as the plot is wide, however many points there are, and no excursion is lost.
    pub fn new(size: [f64; 2], points: impl Iterator<Item = (f64, f64)>) -> Self {
        let mut columns: Vec<Option<Span>> = vec![None; size[0] as usize + 1];
        for (row, (x, y)) in points.enumerate().filter(|(_, (x, _))| (0.0..=1.0).contains(x)) {
            let span = columns[(x * size[0]) as usize].get_or_insert_default();
            match y.is_finite() {
                true => span.add(Point { row, x, y }),
                false => span.gap = Some(row),
            }
        }
        let mut pen = Pen::new(size);
        for mut span in columns.into_iter().flatten() {
            for point in span.corners() {
                if span.gap.take_if(|gap| *gap < point.row).is_some() {
                    pen.lift();
                }
                pen.draw(point);
            }
            if span.gap.is_some() {
                pen.lift();
            }
        }
        pen.lift();
        pen.trace
    }

    /// Bars between two places along x, from a base to a height; those that are not finite are left out.
    pub fn of_bars(size: [f64; 2], base: f64, bars: impl Iterator<Item = ([f64; 2], f64)>) -> Self {
        let mut trace = Self::default();
        let base = (1.0 - base) * size[1];
        for ([left, right], top) in bars.filter(|(_, top)| top.is_finite()) {
            let [left, right, top] = [left * size[0], right * size[0], (1.0 - top) * size[1]];
            write!(trace.line, "M{left:.1} {base:.1}V{top:.1}H{right:.1}V{base:.1}Z")
                .expect("a String takes any text");
        }
        trace
    }

    /// Points that no line joins.
    pub fn of_points(size: [f64; 2], points: impl Iterator<Item = (f64, f64)>) -> Self {
        let mut pen = Pen::new(size);
        for (row, (x, y)) in points.enumerate() {
            if (0.0..=1.0).contains(&x) && (0.0..=1.0).contains(&y) {
                pen.draw(Point { row, x, y });
                pen.lift();
            }
        }
        pen.trace
    }
}

#[derive(Clone, Copy, PartialEq)]
struct Point {
    row: usize,
    x: f64,
    y: f64,
}

/// Points of one pixel column; none if every row in it was a gap.
#[derive(Clone, Default)]
struct Span {
    points: Option<[Point; 4]>,
    /// The last row that was a gap.
    gap: Option<usize>,
}

impl Span {
    fn add(&mut self, point: Point) {
        let [_, lowest, highest, last] = self.points.get_or_insert([point; 4]);
        *last = point;
        if point.y < lowest.y {
            *lowest = point;
        }
        if point.y > highest.y {
            *highest = point;
        }
    }

    /// The points in the order of the rows.
    fn corners(&self) -> Vec<Point> {
        let mut corners = self.points.map_or_else(Vec::new, Vec::from);
        corners.sort_by_key(|point| point.row);
        corners
    }
}

/// Writes path data, a place only when it differs from the one before.
struct Pen {
    size: [f64; 2],
    trace: Trace,
    place: String,
    drawn: usize,
}

impl Pen {
    fn new(size: [f64; 2]) -> Self {
        Self { size, trace: Trace::default(), place: String::new(), drawn: 0 }
    }

    fn draw(&mut self, point: Point) {
        let [x, y] = [point.x * self.size[0], (1.0 - point.y.clamp(-1.0, 2.0)) * self.size[1]];
        let place = format!("{x:.1} {:.1}", y + 0.0);
        if place == self.place {
            return;
        }
        if self.drawn == 1 {
            write!(self.trace.line, "M{}", self.place).expect("a String takes any text");
        }
        if self.drawn > 0 {
            write!(self.trace.line, "L{place}").expect("a String takes any text");
        }
        self.place = place;
        self.drawn += 1;
    }

    fn lift(&mut self) {
        if self.drawn == 1 {
            write!(self.trace.dots, "M{}h0", self.place).expect("a String takes any text");
        }
        self.place.clear();
        self.drawn = 0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaps_break_the_line_and_lone_points_are_dots() {
        let points =
            [(0.0, 0.0), (0.1, 1.0), (0.2, f64::NAN), (0.5, 0.5), (0.6, f64::INFINITY), (f64::NAN, 0.0)];
        let Trace { line, dots } = Trace::new(PAGE, points.into_iter());
        assert_eq!((line.as_str(), dots.as_str()), ("M0.0 240.0L80.0 0.0", "M400.0 120.0h0"));
        assert_eq!(Trace::new(PAGE, std::iter::empty()).line, "");
        // a jump within one column of pixels
        let jump = [(0.0, 0.0), (0.5, 0.0), (0.5, f64::NAN), (0.5, 1.0), (1.0, 1.0)];
        assert_eq!(Trace::new(PAGE, jump.into_iter()).line, "M0.0 240.0L400.0 240.0M400.0 0.0L800.0 0.0");
    }

    #[test]
    fn million_points_keep_a_single_spike_and_stay_short() {
        let n = 1_000_000;
        let height = |i: usize| {
            if i == 654_321 { 1.0 } else { 0.25 + 0.2 * (i as f64 * 0.7).sin() }
        };
        let Trace { line, .. } = Trace::new(PAGE, (0..n).map(|i| (i as f64 / (n - 1) as f64, height(i))));
        assert!(line.contains("L523.5 0.0"), "the spike is lost");
        let x = |step: &str| step.split(' ').next().unwrap().parse::<f64>().unwrap();
        assert!(line[1..].split('L').map(x).is_sorted(), "the line runs back");
        assert!(line.len() < 50_000, "{} bytes", line.len());
    }

    #[test]
    fn times_in_any_order_give_a_short_path() {
        let x = |i: u64| (i.wrapping_mul(2_654_435_761) % 10_007) as f64 / 10_007.0;
        assert!(Trace::new(PAGE, (0..100_000).map(|i| (x(i), x(i * 7)))).line.len() < 50_000);
    }
}
