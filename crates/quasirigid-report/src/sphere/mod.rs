//! The path of the angular momentum on its sphere, seen from the body.

mod picture;
mod rigid_polhodes;
mod stretches;
pub mod vector;
mod view;

use maud::{Markup, html};
use quasirigid_io::record::{BodyRecord, HistoryRecord};

pub use picture::{on_paper, sphere_picture};
use rigid_polhodes::polhodes;
use stretches::{momentum_directions, pieces};
use vector::{Vector, combined, dot};
pub use view::{Halves, RADIUS, Spot, View};

/// Style of the figure.
pub const STYLE: &str = include_str!("../assets/sphere.css");

/// The part of the plane that is drawn: left, top, width, height.
const VIEW_BOX: &str = "-280 -205 560 390";

const CAPTION: &str = "Direction of the angular momentum K = Jω in the axes of the body, from the hollow to the full dot; the far \
half is dimmed. Faint lines are the polhodes of the rigid body, the dashed ones its separatrix: without dissipation K \
stays on one of them. J is the inertia of the frozen body, so K is placed as exactly as the body is rigid.";

const THINNED: &str = "The history is too long to be kept whole in the page: its ends are drawn.";
const SAMPLED: &str = "The history is long: stretches of it are drawn, evenly spaced over the run.";

/// The figure, or a sentence on the missing data.
pub fn figure(body: &BodyRecord, history: &HistoryRecord) -> Markup {
    html! {
        figure {
            h3 { "Angular momentum on its sphere" }
            @match Scene::new(body, history) {
                Some(scene) => {
                    (scene.draw())
                    figcaption { (CAPTION) @if scene.sampled { " " (SAMPLED) } @if scene.thinned { " " (THINNED) } }
                }
                None => p.absent {
                    "Not drawn: it needs the columns wx, wy, wz, the inertia and orthonormal principal axes."
                }
            }
        }
    }
}

/// What the figure shows.
pub struct Scene {
    /// Principal axes, each turned to the side where the path runs.
    axes: [Vector; 3],
    /// Whether an axis was turned.
    turned: [bool; 3],
    moments: [f64; 3],
    view: View,
    path: Vec<Option<Vector>>,
    /// The path as drawn, with the shade of each piece.
    pieces: Vec<(usize, Halves)>,
    /// Whether the pieces are a sample of the path.
    sampled: bool,
    /// Whether the record has the extremes of the path alone, of which the ends are drawn.
    thinned: bool,
}

impl Scene {
    /// None unless the record has spins, an inertia and principal axes.
    pub fn new(body: &BodyRecord, history: &HistoryRecord) -> Option<Self> {
        let axes = orthonormal(body.principal_axes)?;
        let path = momentum_directions(body.inertia, &history.columns)?;
        let turned = axes.map(|axis| path.iter().flatten().map(|&k| dot(axis, k)).sum::<f64>() < 0.0);
        let axes = [0, 1, 2].map(|i| if turned[i] { axes[i].map(|x| -x) } else { axes[i] });
        let view = View::between(axes)?;
        // between the extremes of intervals lie revolutions, so that no line joins them
        let thinned = !history.is_whole();
        let (pieces, sampled) = if thinned { (Vec::new(), false) } else { pieces(&view, &path) };
        Some(Self { axes, turned, moments: body.principal_moments, view, path, pieces, sampled, thinned })
    }

    /// Direction of the angular momentum in every row.
    pub fn path(&self) -> &[Option<Vector>] {
        &self.path
    }

    /// The viewpoint.
    pub fn view(&self) -> &View {
        &self.view
    }

    /// The sphere with the paths of the rigid body and the axes, without the path and names.
    pub fn backdrop(&self) -> Markup {
        let [plain, dashed] = [false, true].map(|separatrix| self.polhodes(separatrix));
        html! {
            @for &axis in &self.axes { (self.stub(axis, -1.0)) (self.stub(axis, 1.0)) }
            circle.ball r=(RADIUS) {}
            path.polhode.far d=(plain.far) {}
            path.polhode.separatrix.far d=(dashed.far) {}
            path.polhode d=(plain.near) {}
            path.polhode.separatrix d=(dashed.near) {}
        }
    }

    fn draw(&self) -> Markup {
        let [plain, dashed] = [false, true].map(|separatrix| self.polhodes(separatrix));
        html! {
            svg.sphere role="img" aria-labelledby="sphere-title sphere-desc"
                viewBox=(VIEW_BOX) {
                title id="sphere-title" { "Angular momentum on its sphere" }
                desc id="sphere-desc" { (CAPTION) }
                @for &axis in &self.axes { (self.stub(axis, -1.0)) }
                circle.ball r=(RADIUS) {}
                path.polhode.far d=(plain.far) {}
                path.polhode.separatrix.far d=(dashed.far) {}
                @for (shade, halves) in &self.pieces { path.track.far.{ "t" (shade) } d=(halves.far) {} }
                path.polhode d=(plain.near) {}
                path.polhode.separatrix d=(dashed.near) {}
                @for (shade, halves) in &self.pieces { path.track.{ "t" (shade) } d=(halves.near) {} }
                (self.ends())
                @for &axis in &self.axes { (self.stub(axis, 1.0)) }
                (self.labels())
            }
        }
    }

    fn polhodes(&self, separatrix: bool) -> Halves {
        let mut all = Halves::default();
        for curve in polhodes(self.moments).iter().filter(|curve| curve.separatrix == separatrix) {
            let halves = self.view.curve(curve.points.iter().map(|&k| Some(combined(k, self.axes))));
            all.near += &halves.near;
            all.far += &halves.far;
        }
        all
    }

    /// The piece of an axis outside the sphere.
    fn stub(&self, axis: Vector, side: f64) -> Markup {
        let from = self.view.spot(axis.map(|x| side * x));
        let to = self.beside(axis.map(|x| side * x), 1.1);
        html! { line.axis x1=(px(from.x)) y1=(px(from.y)) x2=(px(to.x)) y2=(px(to.y)) {} }
    }

    /// Names of the axes.
    pub fn labels(&self) -> Markup {
        const NAMES: [&str; 3] = ["axis 1, least J", "axis 2", "axis 3, greatest J"];
        html! {
            @for i in 0..3 {
                @let Spot { x, y, .. } = self.beside(self.axes[i], 1.14);
                @let side = if x.abs() < 0.2 * RADIUS { Some("middle") } else { (x < 0.0).then_some("end") };
                text class=[side] x=(px(x)) y=(px(y)) dy="0.3em" { @if self.turned[i] { "−" } (NAMES[i]) }
            }
        }
    }

    /// Spot on an axis at so many radii from the centre of the drawing.
    fn beside(&self, axis: Vector, radii: f64) -> Spot {
        let Spot { x, y, near } = self.view.spot(axis);
        let stretch = radii * RADIUS / x.hypot(y);
        Spot { x: stretch * x, y: stretch * y, near }
    }

    fn ends(&self) -> Markup {
        let mut known = self.path.iter().flatten();
        let first = known.next();
        let dots = [("start", first), ("end", known.next_back().or(first))];
        html! {
            @for (class, k) in dots.into_iter().filter_map(|(class, k)| Some((class, self.view.spot(*k?)))) {
                circle.end-point.(class).far[!k.near] cx=(px(k.x)) cy=(px(k.y)) r="5" {}
            }
        }
    }
}

fn orthonormal(axes: [Vector; 3]) -> Option<[Vector; 3]> {
    let error = |i: usize, j: usize| (dot(axes[i], axes[j]) - f64::from(u8::from(i == j))).abs();
    (0..3).all(|i| (0..3).all(|j| error(i, j) < 1e-6)).then_some(axes)
}

fn px(length: f64) -> String {
    format!("{length:.1}")
}
