//! Orthographic projection of curves on the unit sphere.

use std::fmt::Write;

use super::vector::{Vector, combined, cross, direction, dot};

/// Radius of the drawn sphere.
pub const RADIUS: f64 = 165.0;

/// A place on paper, and whether it is on the near side.
#[derive(Clone, Copy)]
pub struct Spot {
    /// To the right of the centre.
    pub x: f64,
    /// Below the centre.
    pub y: f64,
    /// Whether the place is on the side of the viewer.
    pub near: bool,
}

/// The near and the far half of a curve as path data.
#[derive(Default)]
pub struct Halves {
    /// Towards the viewer.
    pub near: String,
    /// Behind the sphere.
    pub far: String,
}

/// A viewpoint: unit vectors to the right, up and towards the viewer.
pub struct View([Vector; 3]);

impl View {
    /// A view from between three orthonormal axes, all turned towards the viewer, with the third upwards.
    pub fn between(axes: [Vector; 3]) -> Option<Self> {
        let towards = direction(combined([0.62, 0.60, 0.50], axes))?;
        let right = direction(cross(axes[2], towards))?;
        Some(Self([right, cross(towards, right), towards]))
    }

    /// Spot of a point; points off the sphere stay off the disc.
    pub fn spot(&self, point: Vector) -> Spot {
        let [right, up, depth] = self.0.map(|axis| dot(axis, point));
        Spot { x: RADIUS * right, y: -RADIUS * up, near: depth >= 0.0 }
    }

    /// Draws a curve through unit vectors, along great circles; a step of more than a radian is not joined.
    pub fn curve(&self, points: impl Iterator<Item = Option<Vector>>) -> Halves {
        let mut pen = Pen::default();
        let mut last: Option<Vector> = None;
        for point in points {
            let Some(point) = point else {
                last = None;
                continue;
            };
            let angle = last.map_or(f64::MAX, |last| dot(last, point).clamp(-1.0, 1.0).acos());
            match last {
                Some(last) if angle < 1.0 => {
                    let pieces = (angle / 0.12).ceil().max(1.0) as usize;
                    for piece in 1..=pieces {
                        let part = piece as f64 / pieces as f64;
                        let between = combined([1.0 - part, part, 0.0], [last, point, [0.0; 3]]);
                        pen.line(self.spot(direction(between).unwrap_or(point)), piece == pieces);
                    }
                }
                _ => pen.begin(self.spot(point)),
            }
            last = Some(point);
        }
        pen.halves
    }
}

/// Writes the two halves of a curve; steps below half a pixel are saved up.
#[derive(Default)]
struct Pen {
    halves: Halves,
    at: Option<Spot>,
}

impl Pen {
    fn begin(&mut self, spot: Spot) {
        write!(self.half(spot.near), "M{:.1} {:.1}h0", spot.x, spot.y).expect("a String takes any text");
        self.at = Some(spot);
    }

    fn line(&mut self, spot: Spot, thin: bool) {
        let Some(at) = self.at else {
            return self.begin(spot);
        };
        if at.near != spot.near {
            write!(self.half(spot.near), "M{:.1} {:.1}", at.x, at.y).expect("a String takes any text");
        } else if thin && (spot.x - at.x).hypot(spot.y - at.y) < 0.5 {
            return;
        }
        write!(self.half(spot.near), "L{:.1} {:.1}", spot.x, spot.y).expect("a String takes any text");
        self.at = Some(spot);
    }

    fn half(&mut self, near: bool) -> &mut String {
        if near { &mut self.halves.near } else { &mut self.halves.far }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const AXES: [Vector; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

    #[test]
    fn axes_turned_towards_the_viewer_are_near_and_the_third_is_up() {
        let view = View::between(AXES).unwrap();
        let spots = AXES.map(|axis| view.spot(axis));
        assert!(spots.iter().all(|spot| spot.near));
        assert!(spots[2].x.abs() < 1e-9 && spots[2].y < 0.0);
        assert!(spots[0].x < 0.0 && spots[1].x > 0.0, "x, y, z must turn right-handed");
        assert!(!view.spot([-1.0, 0.0, 0.0]).near);
    }

    #[test]
    fn great_circle_is_half_near_and_half_far() {
        let view = View::between(AXES).unwrap();
        let circle = (0..=360).map(|i| f64::from(i).to_radians()).map(|a| Some([a.cos(), a.sin(), 0.0]));
        let Halves { near, far } = view.curve(circle);
        assert_eq!(
            [&near, &far].map(|half| half.matches('M').count()),
            [2, 1],
            "the halves are joined across the sphere"
        );
        let [near, far] = [near, far].map(|half| half.matches('L').count());
        assert!(near.abs_diff(far) <= 2 && near + far >= 355, "{near} {far}");
    }

    #[test]
    fn gaps_and_leaps_are_not_joined() {
        let view = View::between(AXES).unwrap();
        let points = [Some(AXES[0]), Some(AXES[1]), None, Some(AXES[1])];
        let Halves { near, far } = view.curve(points.into_iter());
        assert_eq!((near.matches('M').count(), near.matches('L').count(), far.as_str()), (3, 0, ""));
    }
}
