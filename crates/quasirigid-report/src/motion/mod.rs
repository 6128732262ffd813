//! Moving picture of a run: the body as it tumbles in inertial axes, beside it the path of the angular momentum in body axes as it grows.
//! An SVG file without a script, which moves in an `<img>`; on paper, in programs that do not animate, and opened by itself by readers who
//! asked for less motion it is a still picture of the start with the whole path.

mod animation;
mod attitude;
mod drawing;
mod solids;
mod stretches;

use maud::{Markup, PreEscaped, html};
use quasirigid_io::record::{HistoryRecord, RunRecord};
use quasirigid_io::visible::visible;

use crate::columns::{column, ends, main_history};
use crate::number::{digits, duration, tidy};
use crate::sphere::vector::{Vector, cross, direction};
use crate::sphere::{self, Halves, on_paper};
use animation::Clock;
use attitude::{Quaternion, turned};
use drawing::{Observer, UNITS, arrow, body};
use solids::{Shape, Solid, solids};
use stretches::{Stretch, stretches};

const STYLE: &str = include_str!("../assets/motion.css");

/// Size of the picture (px), and of the sphere of the body in it.
const WIDTH: f64 = 860.0;
const HEIGHT: f64 = 474.0;
const BODY: f64 = 128.0;
/// Centres of the body and of the sphere of the angular momentum.
const LEFT: [f64; 2] = [190.0, 228.0];
const RIGHT: [f64; 2] = [592.0, 228.0];
/// Radius of that sphere over its usual one.
const SMALLER: f64 = 0.79;
/// Timeline: left, right, height.
const LINE: [f64; 3] = [20.0, 836.0, 442.0];
/// Height of the names of both pictures.
const NAMES: f64 = 388.0;
/// Length of the picture (s): of a whole history, of a stretch of a long one.
const WHOLE: f64 = 12.0;
const STRETCH: f64 = 2.4;
/// Elevation of the observer above the plane across the angular momentum.
const ELEVATION: f64 = 0.35;
/// Bytes that the motion of the body may take, and those of a point in a frame.
const MAX_BYTES: usize = 150_000;
const BYTES_PER_POINT: usize = 8;
/// Pieces in which the path of a stretch appears.
const PATH_PIECES: usize = 8;
/// Shades of the path, from early to late.
const SHADES: usize = 6;

/// The moving picture of the main history. None of a record without a scene or a history, of one whose rows are too far apart to tell the
/// motion between them, and of one of which only the extremes are at hand.
pub fn motion_picture(record: &RunRecord) -> Option<String> {
    let (scene, history) = (record.scene.as_ref()?, main_history(record)?);
    let sphere = sphere::Scene::new(&record.body, history)?;
    let solids = solids(scene);
    let points: usize = solids.iter().flat_map(|solid| &solid.shapes).map(Shape::points).sum();
    let stretches = stretches(history, MAX_BYTES / (BYTES_PER_POINT * points.max(1)))?;
    let movie = Movie { record, history, sphere, solids, stretches, scale: UNITS * BODY / scene.radius };
    movie.file()
}

struct Movie<'a> {
    record: &'a RunRecord,
    history: &'a HistoryRecord,
    sphere: sphere::Scene,
    solids: Vec<Solid>,
    stretches: Vec<Stretch>,
    scale: f64,
}

impl Movie<'_> {
    fn file(&self) -> Option<String> {
        let style = on_paper(&format!("{}{STYLE}", sphere::STYLE));
        let title = format!("{}: the rotation", self.record.model.name);
        let moving = self.scene(self.clock())?;
        let still = self.scene(Clock { frames: 1, duration: 0.0 })?;
        let drawing = html! {
            svg xmlns="http://www.w3.org/2000/svg" width=(WIDTH) height=(HEIGHT) viewBox={ "0 0 " (WIDTH) " " (HEIGHT) }
                role="img" aria-labelledby="motion-title motion-desc" {
                title id="motion-title" { (title) }
                desc id="motion-desc" { (self.description()) }
                style { (PreEscaped(style)) }
                rect width=(WIDTH) height=(HEIGHT) fill="#fff" {}
                text.title x="20" y="30" { (self.record.model.name) }
                text x="20" y="50" { (self.subtitle()) }
                text.middle x=(LEFT[0]) y=(NAMES) { "body, in inertial axes" }
                text.middle x=(RIGHT[0]) y=(NAMES) { "path of " tspan.momentum { "K" } ", in body axes" }
                g.moving { (moving) }
                g.still { (still) }
            }
        };
        Some(format!("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n{}\n", visible(&drawing.into_string())))
    }

    fn clock(&self) -> Clock {
        let frames = self.stretches.iter().map(|stretch| stretch.frames.len()).sum();
        let duration = if self.stretches.len() == 1 { WHOLE } else { STRETCH * self.stretches.len() as f64 };
        Clock { duration, frames }
    }

    /// Everything that moves, by a clock; by one of a single frame, the start.
    fn scene(&self, clock: Clock) -> Option<Markup> {
        let attitudes: Vec<Quaternion> = self
            .stretches
            .iter()
            .flat_map(|stretch| &stretch.frames)
            .map(|frame| frame.1)
            .take(clock.frames)
            .collect();
        let observer = self.observer()?;
        Some(html! {
            g transform={ "translate(" (LEFT[0]) " " (LEFT[1]) ") scale(" (1.0 / UNITS) ")" } {
                (self.tumbling(&observer, &attitudes, clock))
            }
            g.sphere transform={ "translate(" (RIGHT[0]) " " (RIGHT[1]) ") scale(" (SMALLER) ")" } {
                (self.sphere.backdrop())
                (self.path(clock))
                (self.sphere.labels())
            }
            (self.timeline(clock))
        })
    }

    /// The body before the arrows of the angular momentum and the angular velocity.
    fn tumbling(&self, observer: &Observer, attitudes: &[Quaternion], clock: Clock) -> Markup {
        let tips = |directions: &[Vector], radii: f64| -> Vec<[f64; 3]> {
            let length = radii * UNITS * BODY / observer.scale;
            let scaled = |direction: &Vector| direction.map(|part| length * part);
            attitudes
                .iter()
                .zip(directions)
                .map(|(attitude, it)| observer.spot(*attitude, scaled(it)))
                .collect()
        };
        let (momenta, spins) =
            (self.directions(clock, self.sphere.path()), self.directions(clock, &self.spins()));
        let fade: Vec<String> =
            self.stretches.iter().flat_map(|stretch| faded(stretch.frames.len())).collect();
        html! {
            (arrow("momentum", "K", 20.0, &tips(&momenta, 1.3), clock))
            g {
                @if clock.frames > 1 && self.stretches.len() > 1 { (clock.animate("opacity", &fade)) }
                (arrow("spin", "ω", -20.0, &tips(&spins, 1.15), clock))
                (body(&self.solids, observer, attitudes, clock))
            }
        }
    }

    /// Directions of the angular velocity in body axes, row by row.
    fn spins(&self) -> Vec<Option<Vector>> {
        let rows = crate::columns::vectors(&self.history.columns, ["wx", "wy", "wz"]).unwrap_or_default();
        rows.into_iter().map(direction).collect()
    }

    /// Directions in body axes, frame by frame, along those of the rows.
    fn directions(&self, clock: Clock, rows: &[Option<Vector>]) -> Vec<Vector> {
        let of = |stretch: &Stretch| {
            let ([first, last, _], count) = (stretch.rows, stretch.frames.len());
            (0..count)
                .map(|i| along(&rows[first..=last], i as f64 / (count - 1).max(1) as f64))
                .collect::<Vec<_>>()
        };
        self.stretches.iter().flat_map(of).take(clock.frames).collect()
    }

    /// An observer to whom the angular momentum at the start points up.
    fn observer(&self) -> Option<Observer> {
        let [first, ..] = self.sphere.path() else { return None };
        let up = turned(self.stretches.first()?.frames.first()?.1, (*first)?);
        let across = if up[0].abs() < 0.8 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
        let right = direction(cross(up, across))?;
        let away = cross(up, right);
        let (sin, cos) = ELEVATION.sin_cos();
        let mixed = |a: f64, b: f64| [0, 1, 2].map(|i| a * up[i] + b * away[i]);
        Some(Observer { axes: [right, mixed(cos, sin), mixed(sin, -cos)], scale: self.scale })
    }

    /// The path of the angular momentum in body axes, which grows, and its head.
    fn path(&self, clock: Clock) -> Markup {
        let path = self.sphere.path();
        let mut before = 0;
        let mut pieces: Vec<(usize, Halves, usize)> = Vec::new();
        let mut heads = Vec::new();
        for (number, stretch) in self.stretches.iter().enumerate() {
            let ([first, last, drawn], count) = (stretch.rows, stretch.frames.len());
            let shade = number * SHADES / self.stretches.len();
            let mut piece = |from: usize, to: usize, seen: usize| {
                let halves = self.sphere.view().curve(path[from..=to].iter().copied());
                pieces.push((shade, halves, seen));
            };
            let steps = PATH_PIECES.min(last - first);
            for step in 0..steps {
                let [from, to] = [step, step + 1].map(|step| first + step * (last - first) / steps);
                piece(from, to, before + (step + 1) * (count - 1) / steps);
            }
            // what follows is drawn once the stretch has been shown
            if drawn > last {
                piece(last, drawn, before + count - 1);
            }
            let place =
                |i: usize| path[first + i * (last - first) / (count - 1).max(1)].unwrap_or([0.0, 0.0, 1.0]);
            heads.extend((0..count).map(|i| self.sphere.view().spot(place(i))));
            before += count;
        }
        let of = |value: &dyn Fn(&sphere::Spot) -> f64| {
            heads.iter().take(clock.frames).map(|spot| format!("{:.1}", value(spot))).collect::<Vec<_>>()
        };
        let (x, y) = (of(&|spot| spot.x), of(&|spot| spot.y));
        let opacity = of(&|spot| if spot.near { 1.0 } else { 0.4 });
        html! {
            @for (shade, halves, from) in &pieces {
                g.track.{ "t" (shade) } {
                    @if clock.frames > 1 { (clock.show_in(*from..clock.frames)) }
                    path.far d=(halves.far) {}
                    path d=(halves.near) {}
                }
            }
            @if clock.frames > 1 {
                circle.head r="7" cx=(x[0]) cy=(y[0]) { (clock.animate("cx", &x)) (clock.animate("cy", &y)) (clock.animate("opacity", &opacity)) }
            }
        }
    }

    /// The times of the stretches on a line, and the state at each in words.
    fn timeline(&self, clock: Clock) -> Markup {
        let t = column(&self.history.columns, "t").map_or(&[][..], |column| &column.values);
        let Some((first, last)) = ends(t.iter().copied()) else { return html! {} };
        let place = |time: f64| LINE[0] + (LINE[1] - LINE[0]) * (time - first) / (last - first);
        let several = self.stretches.len() > 1;
        let mut before = 0;
        let spans: Vec<std::ops::Range<usize>> = self
            .stretches
            .iter()
            .map(|stretch| {
                before += stretch.frames.len();
                before - stretch.frames.len()..before
            })
            .collect();
        html! {
            line.axis x1=(LINE[0]) x2=(LINE[1]) y1=(LINE[2]) y2=(LINE[2]) {}
            text.end x=(LINE[1]) y=(LINE[2] + 22.0) { (duration(last - first)) }
            @if clock.frames > 1 {
                @for (stretch, span) in self.stretches.iter().zip(&spans) {
                    @let x: Vec<String> = self.stretches.iter().flat_map(|stretch| &stretch.frames).map(|frame| format!("{:.1}", place(frame.0))).collect();
                    @if several {
                        circle.stop cx=(format!("{:.1}", place(stretch.frames[0].0))) cy=(LINE[2]) r="4" {}
                        circle.now cx=(format!("{:.1}", place(stretch.frames[0].0))) cy=(LINE[2]) r="6" display=[(span.start > 0).then_some("none")] { (clock.show_in(span.clone())) }
                    } @else {
                        circle.now cx=(x[0]) cy=(LINE[2]) r="6" { (clock.animate("cx", &x)) }
                    }
                    text.state x=(LINE[0]) y=(LINE[2] - 18.0) display=[(span.start > 0).then_some("none")] {
                        (self.state(stretch, first)) @if several { (clock.show_in(span.clone())) }
                    }
                }
            } @else {
                @for stretch in &self.stretches { circle.stop cx=(format!("{:.1}", place(stretch.frames[0].0))) cy=(LINE[2]) r="4" {} }
                text.state x=(LINE[0]) y=(LINE[2] - 18.0) { (self.state(&self.stretches[0], first)) }
            }
        }
    }

    /// Time and nutation of a stretch.
    fn state(&self, stretch: &Stretch, zero: f64) -> String {
        let row = stretch.rows[0];
        let value = |name: &str| {
            column(&self.history.columns, name)?.values.get(row).copied().filter(|v| v.is_finite())
        };
        let nutation = value("nutation_max").map(|angle| {
            let axis = match value("circled_axis") {
                Some(1.0) => " about the axis of least inertia",
                Some(3.0) => " about the axis of greatest inertia",
                _ => "",
            };
            format!("{} up to {}°{axis}", self.record.body.kind.nutation(), digits(angle.to_degrees(), 3))
        });
        let time = stretch.frames[0].0 - zero;
        let after = if time > 0.0 { format!("after {}", duration(time)) } else { "at the start".to_owned() };
        let words: Vec<String> = [after].into_iter().chain(nutation).collect();
        words.join(": ")
    }

    fn subtitle(&self) -> String {
        let [first, .., last] = &self.stretches[0].frames[..] else { return String::new() };
        let whole = tidy(self.history.revolutions, 4);
        if self.stretches.len() == 1 {
            return format!("{whole} revolutions in {}, shown in {WHOLE:.0} s", duration(last.0 - first.0));
        }
        format!(
            "{} stretches of {} each, out of {whole} revolutions",
            self.stretches.len(),
            duration(last.0 - first.0),
        )
    }

    fn description(&self) -> String {
        format!(
            "{}. Left, the body as an observer at rest sees it, with its angular momentum K and its angular velocity ω. \
             Right, the path of K in the axes of the body.",
            self.subtitle()
        )
    }
}

/// Opacities of a stretch, which appears and goes in the first and last frames.
fn faded(frames: usize) -> Vec<String> {
    let near = |i: usize| (i.min(frames - 1 - i) as f64 / 4.0).min(1.0);
    (0..frames).map(|i| format!("{:.2}", near(i))).collect()
}

/// Direction at a place along those of some rows, from 0 to 1; none has no length.
fn along(rows: &[Option<Vector>], part: f64) -> Vector {
    let place = part * (rows.len() - 1) as f64;
    let row = (place.floor() as usize).min(rows.len() - 1);
    let next = (row + 1).min(rows.len() - 1);
    let (rest, [from, to]) = (place - row as f64, [row, next].map(|row| rows[row].unwrap_or_default()));
    direction([0, 1, 2].map(|i| (1.0 - rest) * from[i] + rest * to[i])).unwrap_or_default()
}
