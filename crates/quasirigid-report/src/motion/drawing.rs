//! The body as an observer at rest sees it: every shape of every piece, frame by frame.
//! Faces turned away are not seen; pieces behind the largest closed one are drawn before it, those in front after it, and those inside shine
//! through it.

use std::fmt::Write;

use maud::{Markup, html};

use super::animation::Clock;
use super::attitude::{Quaternion, turned};
use super::solids::{Place, Shape, Solid};
use crate::sphere::vector::{Vector, dot};

/// Points of the outline of a round body.
pub const HULL: usize = 24;
/// Units of the drawing per pixel: whole numbers are short.
pub const UNITS: f64 = 2.0;
/// Least and greatest radius of a dot (px).
const DOTS: [f64; 2] = [4.0, 9.0];

/// An observer at rest: unit vectors to the right, up and towards the observer in inertial axes, and units of the drawing per metre.
#[derive(Clone, Copy)]
pub struct Observer {
    /// Right, up, towards.
    pub axes: [Vector; 3],
    /// Units per metre.
    pub scale: f64,
}

/// A point in the drawing: right, down, and towards the observer.
type Spot = [f64; 3];

impl Observer {
    /// Spot of a vector of the body (m).
    pub fn spot(&self, attitude: Quaternion, vector: Vector) -> Spot {
        let inertial = turned(attitude, vector);
        let [x, y, z] = self.axes.map(|axis| self.scale * dot(axis, inertial));
        [x, -y, z]
    }
}

/// The pieces: those behind the largest closed one, that one, those before it.
pub fn body(solids: &[Solid], observer: &Observer, frames: &[Quaternion], clock: Clock) -> Markup {
    let center =
        solids.iter().find(|solid| solid.place == Place::Largest).map_or([0.0; 3], |solid| solid.center);
    let drawn = |solid: &Solid, side: f64| {
        let class = class(&solid.kind);
        let class = if solid.place == Place::Inside { format!("{class} inside") } else { class.to_owned() };
        let beyond = [0, 1, 2].map(|i| solid.center[i] - center[i]);
        let depth = |attitude: &Quaternion| match solid.place {
            Place::Beside => side * observer.spot(*attitude, beyond)[2],
            Place::Largest | Place::Inside => 1.0,
        };
        let depths: Vec<f64> = frames.iter().map(depth).collect();
        html! { @for shape in &solid.shapes { (draw(shape, &class, observer, frames, &depths, clock)) } }
    };
    let with = |place: Place| solids.iter().filter(move |solid| solid.place == place);
    html! {
        @for solid in with(Place::Beside) { (drawn(solid, -1.0)) }
        @for solid in with(Place::Largest) { (drawn(solid, 1.0)) }
        @for solid in with(Place::Inside) { (drawn(solid, 1.0)) }
        @for solid in with(Place::Beside) { (drawn(solid, 1.0)) }
    }
}

/// A shape, seen where its piece is in the layer, by a positive depth, and where it faces the observer.
fn draw(
    shape: &Shape,
    class: &str,
    observer: &Observer,
    frames: &[Quaternion],
    depths: &[f64],
    clock: Clock,
) -> Markup {
    let spots = |points: &[Vector], attitude: &Quaternion| -> Vec<Spot> {
        points.iter().map(|point| observer.spot(*attitude, *point)).collect()
    };
    let faces = |attitude: &Quaternion| match shape {
        Shape::Face { normal: Some(normal), .. } | Shape::Line { normal: Some(normal), .. } => {
            observer.spot(*attitude, *normal)[2] / observer.scale
        }
        _ => f64::INFINITY,
    };
    let seen: Vec<f64> =
        frames.iter().zip(depths).map(|(attitude, depth)| faces(attitude).min(*depth)).collect();
    if !seen.iter().any(|measure| *measure > 0.0) {
        return html! {};
    }
    let hidden = (seen[0] <= 0.0).then_some("none");
    let paths = |path: &dyn Fn(&Quaternion) -> String| frames.iter().map(path).collect::<Vec<_>>();
    let (style, values) = match shape {
        Shape::Face { corners, normal } => (
            format!("{class} {}", tone(normal.unwrap_or([0.0, 0.0, 1.0]))),
            paths(&|attitude| path(&spots(corners, attitude), true)),
        ),
        Shape::Hull(points) => {
            (format!("{class} tone-1"), paths(&|attitude| path(&outline(&spots(points, attitude)), true)))
        }
        Shape::Line { points, normal } => (
            if normal.is_some() { "meridian".to_owned() } else { format!("{class} line") },
            paths(&|attitude| path(&spots(points, attitude), false)),
        ),
        Shape::Dot(center, radius) => {
            let places: Vec<Spot> = frames.iter().map(|attitude| observer.spot(*attitude, *center)).collect();
            let of = |axis: usize| places.iter().map(|spot| whole(spot[axis])).collect::<Vec<_>>();
            let radius = (observer.scale * radius).clamp(DOTS[0] * UNITS, DOTS[1] * UNITS);
            let style = format!("{class} dot");
            return html! {
                circle class=(style) display=[hidden] cx=(of(0)[0]) cy=(of(1)[0]) r=(whole(radius)) {
                    (clock.animate("cx", &of(0))) (clock.animate("cy", &of(1))) (clock.show(&seen))
                }
            };
        }
    };
    html! {
        path class=(style) display=[hidden] d=(values[0]) { (clock.animate("d", &values)) (clock.show(&seen)) }
    }
}

/// A vector from the centre of the drawing to some tips, frame by frame, with its name beside the tip.
pub fn arrow(class: &str, name: &str, shift: f64, tips: &[Spot], clock: Clock) -> Markup {
    let of = |axis: usize, factor: f64, shift: f64| {
        tips.iter().map(|spot| whole(factor * spot[axis] + shift)).collect::<Vec<_>>()
    };
    let (x, y, text_x, text_y) = (of(0, 1.0, 0.0), of(1, 1.0, 0.0), of(0, 1.05, shift), of(1, 1.05, 10.0));
    html! {
        g.(class) {
            line x1="0" y1="0" x2=(x[0]) y2=(y[0]) { (clock.animate("x2", &x)) (clock.animate("y2", &y)) }
            circle r="6" cx=(x[0]) cy=(y[0]) { (clock.animate("cx", &x)) (clock.animate("cy", &y)) }
            text x=(text_x[0]) y=(text_y[0]) { (name) (clock.animate("x", &text_x)) (clock.animate("y", &text_y)) }
        }
    }
}

/// The farthest spots in evenly spaced directions: the hull, with the same number of points in every frame.
fn outline(spots: &[Spot]) -> Vec<Spot> {
    let farthest = |i: usize| {
        let (sin, cos) = (std::f64::consts::TAU * i as f64 / HULL as f64).sin_cos();
        let reach = |spot: &Spot| cos * spot[0] + sin * spot[1];
        spots.iter().copied().max_by(|a, b| reach(a).total_cmp(&reach(b))).unwrap_or_default()
    };
    (0..HULL).map(farthest).collect()
}

/// Path data through spots.
fn path(spots: &[Spot], closed: bool) -> String {
    let mut data = String::from("M");
    for (place, [x, y, _]) in spots.iter().enumerate() {
        let (x, y) = (whole(*x), whole(*y));
        let gap = |number: &str| if number.starts_with('-') { "" } else { " " };
        let before = if place == 0 { "" } else { gap(&x) };
        write!(data, "{before}{x}{}{y}", gap(&y)).expect("a String takes any text");
    }
    if closed { data + "z" } else { data }
}

fn whole(value: f64) -> String {
    format!("{}", value.round() + 0.0)
}

/// Class of a face by the axis of the body that it faces: so the faces of a box tell how it turns.
fn tone(normal: Vector) -> &'static str {
    let size = normal.map(f64::abs);
    if size[2] >= size[0] && size[2] >= size[1] {
        "tone-1"
    } else if size[1] >= size[0] {
        "tone-2"
    } else {
        "tone-3"
    }
}

/// Class of a kind of element.
fn class(kind: &str) -> &'static str {
    match kind {
        "point" | "appendage" | "rotor" | "wheel" => "part",
        "panel" | "shell" => "panel",
        "liquid" => "liquid",
        _ => "hull",
    }
}
