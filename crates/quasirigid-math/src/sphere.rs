//! Stationary points of a field on the sphere: places where a polynomial vector field is normal to it.

use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};

use super::polynomial::{Homogeneous, Series};
use super::scalar::Gradient;

/// Kind of a stationary point of a field. The names are those for the gradient of a function on the sphere.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StationaryKind {
    /// Least value: the linearised field is positive definite.
    Minimum,
    /// Greatest value.
    Maximum,
    /// Saddle: its determinant is negative.
    Saddle,
}

/// Stationary point: a place on the unit sphere where a field is normal to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StationaryPoint {
    /// Unit vector to the point.
    pub place: [f64; 3],
    /// Two unit vectors that make a right-handed frame with the first.
    pub tangents: [[f64; 3]; 2],
    /// The linearised tangential field in that frame.
    pub slope: [[f64; 2]; 2],
    /// Kind of the point.
    pub kind: StationaryKind,
}

/// The stationary points of a field on the unit sphere.
#[derive(Clone, Debug, PartialEq)]
pub struct Stationary {
    /// Isolated points.
    pub points: Vec<StationaryPoint>,
    /// Whether other points form curves, or fill the sphere.
    pub families: bool,
    /// Whether the numbers of extrema and of saddles differ by two, as those of all points on a sphere do.
    pub complete: bool,
    /// Largest tangential part over a grid of directions.
    pub size: f64,
}

/// Directions from which Newton's method starts, and the number of times they are multiplied by four if points are missing.
const STARTS: usize = 192;
const REFINEMENTS: usize = 3;
const NEWTON_STEPS: usize = 60;
/// Longest step (rad), and the last one of a search that has converged.
const STRIDE: f64 = 0.3;
const ARRIVED: f64 = 1e-9;
/// Angle (rad) below which points are one.
const SAME_POINT: f64 = 1e-6;
/// Share of the square of the field below which a determinant belongs to a family.
const FLAT: f64 = 1e-9;

/// Stationary points of a map of three rows on the unit sphere, from a grid of directions and those given.
///
/// A tangential part below `rounding` counts as none. Newton's method in the tangent plane of the sphere; the index theorem of Poincaré and
/// Hopf shows whether any is missing. (N2)
#[must_use]
pub fn stationary(map: &Series, given: &[[f64; 3]], rounding: f64) -> Stationary {
    let size = directions(STARTS).map(|x| tangential(map, x).norm()).fold(0.0, f64::max);
    let mut found = Stationary { points: Vec::new(), families: size <= rounding, complete: false, size };
    if found.families {
        return found;
    }
    for refinement in 0..REFINEMENTS {
        let grid = directions(STARTS * 4_usize.pow(refinement as u32));
        for start in given.iter().copied().filter(|_| refinement == 0).chain(grid) {
            match search(map, start, size) {
                Some((point, determinant)) if determinant.abs() > FLAT * size * size => {
                    let apart = |known: &StationaryPoint| distance(known.place, point.place) > SAME_POINT;
                    if found.points.iter().all(apart) {
                        found.points.push(point);
                    }
                }
                Some(_) => found.families = true,
                None => {}
            }
        }
        let index = |point: &StationaryPoint| if point.kind == StationaryKind::Saddle { -1 } else { 1 };
        found.complete = found.points.iter().map(index).sum::<i32>() == 2;
        if found.complete || found.families {
            break;
        }
    }
    found
}

/// Map at a radius without the isotropic part of its linear part, which is normal to every sphere: values on the unit sphere then lose no
/// digits to that part.
#[must_use]
pub fn deviator(map: &Series, radius: f64) -> Series {
    let mut scaled = map.stretched(radius);
    let linear = scaled.part(1);
    let mean = (0..3).map(|row| linear.row(row)[row]).sum::<f64>() / 3.0;
    let mut part = linear.clone();
    part.add_scaled(-mean, &Homogeneous::identity());
    scaled.set(part);
    scaled
}

/// Unit vectors spread evenly over the sphere: a spiral with steps of the golden angle.
pub fn directions(count: usize) -> impl Iterator<Item = [f64; 3]> {
    let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    (0..count).map(move |i| {
        let z = 1.0 - (2.0 * i as f64 + 1.0) / count as f64;
        let (sin, cos) = (golden * i as f64).sin_cos();
        let radius = (1.0 - z * z).sqrt();
        [radius * cos, radius * sin, z]
    })
}

/// Directions of a grid from which the greatest value is sought, the first step from each (rad, of a grid of one direction), how often it is halved,
/// and how many steps are tried in all: along a narrow ridge small steps lead nowhere.
const SUMMITS: usize = 4;
const FIRST_STEP: f64 = 2.0;
const HALVINGS: usize = 20;
const STEPS: usize = 60;

/// Greatest value of a function over the unit sphere: uphill from the highest of a grid of so many directions, so that it hardly depends on the
/// axes in which the grid lies.
pub fn greatest(count: usize, value: impl Fn([f64; 3]) -> f64) -> f64 {
    let mut grid: Vec<(f64, [f64; 3])> = directions(count).map(|u| (value(u), u)).collect();
    grid.sort_by(|a, b| b.0.total_cmp(&a.0));
    let first = FIRST_STEP / (count as f64).sqrt();
    grid.into_iter().take(SUMMITS).map(|start| uphill(start, first, &value)).fold(0.0, f64::max)
}

/// Value at the end of a climb by shorter and shorter steps to four sides.
fn uphill((mut height, mut place): (f64, [f64; 3]), first: f64, value: &impl Fn([f64; 3]) -> f64) -> f64 {
    let mut step = first;
    let mut halved = 0;
    for _ in 0..STEPS {
        if halved == HALVINGS {
            break;
        }
        let [a, b] = tangents(place).map(Vector3::from);
        let sides = [a, -a, b, -b].map(|side| (Vector3::from(place) + step * side).normalize().into());
        let next = sides.map(|u: [f64; 3]| (value(u), u)).into_iter().max_by(|a, b| a.0.total_cmp(&b.0));
        match next {
            Some((higher, u)) if higher > height => (height, place) = (higher, u),
            _ => (step, halved) = (0.5 * step, halved + 1),
        }
    }
    height
}

/// Two unit vectors that with a third make a right-handed frame: `e₁ × e₂ = e`.
#[must_use]
pub fn tangents(e: [f64; 3]) -> [[f64; 3]; 2] {
    let e = Vector3::from(e);
    let mut helper = [0.0; 3];
    helper[e.iamin()] = 1.0;
    let first = Vector3::from(helper).cross(&e).normalize();
    [first.into(), e.cross(&first).into()]
}

/// Columns of the Jacobian of a map of three rows: its derivatives along each axis.
#[must_use]
pub fn jacobian(map: &Series, x: [f64; 3]) -> [[f64; 3]; 3] {
    let rows = map.vector(Gradient::variables(x));
    [0, 1, 2].map(|axis| rows.map(|row| row.slopes[axis]))
}

/// Newton's method from a direction: the point, and the determinant of its slope.
fn search(map: &Series, start: [f64; 3], size: f64) -> Option<(StationaryPoint, f64)> {
    let mut x = Vector3::from(start).normalize();
    for _ in 0..NEWTON_STEPS {
        let (value, slope, [first, second]) = linearised(map, x);
        let step = slope.lu().solve(&-value)?;
        let length = step.norm();
        if length <= ARRIVED && value.norm() <= ARRIVED * size {
            x = (x + step[0] * first + step[1] * second).normalize();
            let (_, slope, [first, second]) = linearised(map, x);
            let kind = kind(&slope);
            let tangents = [first.into(), second.into()];
            let slope_rows = [[slope[(0, 0)], slope[(0, 1)]], [slope[(1, 0)], slope[(1, 1)]]];
            let point = StationaryPoint { place: x.into(), tangents, slope: slope_rows, kind };
            return Some((point, slope.determinant()));
        }
        let step = if length > STRIDE { step * (STRIDE / length) } else { step };
        x = (x + step[0] * first + step[1] * second).normalize();
    }
    None
}

fn kind(slope: &Matrix2<f64>) -> StationaryKind {
    if slope.determinant() < 0.0 {
        StationaryKind::Saddle
    } else if slope.trace() > 0.0 {
        StationaryKind::Minimum
    } else {
        StationaryKind::Maximum
    }
}

/// Tangential part of a field at a unit vector, in its tangents, with its derivative along them.
fn linearised(map: &Series, x: Vector3<f64>) -> (Vector2<f64>, Matrix2<f64>, [Vector3<f64>; 2]) {
    let frame = tangents(x.into()).map(Vector3::from);
    let rows = map.vector(Gradient::variables(x.into()));
    let field = Vector3::from(rows.map(|row| row.value));
    let slopes = Matrix3::from_fn(|row, axis| rows[row].slopes[axis]);
    let slope = slopes - field.dot(&x) * Matrix3::identity();
    let value = Vector2::new(frame[0].dot(&field), frame[1].dot(&field));
    let matrix = Matrix2::from_fn(|i, j| frame[i].dot(&(slope * frame[j])));
    (value, matrix, frame)
}

fn tangential(map: &Series, x: [f64; 3]) -> Vector3<f64> {
    Vector3::from(x).cross(&Vector3::from(map.vector(x)))
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (Vector3::from(a) - Vector3::from(b)).norm()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `x⁴ + y⁴ + z⁴` on the sphere: six maxima on the axes, eight minima on the diagonals, twelve saddles between them.
    #[test]
    fn the_cube_has_twenty_six_stationary_points() {
        let mut map = Series::zero(3, 3);
        let mut part = Homogeneous::zero(3, 3);
        for (row, exponents) in [[3, 0, 0], [0, 3, 0], [0, 0, 3]].into_iter().enumerate() {
            part.row_mut(row)[crate::polynomial::monomial::index(exponents)] = 4.0;
        }
        map.set(part);
        let found = stationary(&map, &[], 0.0);
        let count = |kind| found.points.iter().filter(|point| point.kind == kind).count();
        assert_eq!(
            [StationaryKind::Maximum, StationaryKind::Minimum, StationaryKind::Saddle].map(count),
            [6, 8, 12]
        );
        assert!(found.complete && !found.families);
    }

    /// Of a power of the component along an axis it is one, wherever the axis lies.
    #[test]
    fn the_greatest_value_does_not_know_the_axes_of_the_grid() {
        for turn in 0..20 {
            let (sin, cos) = (0.1 * f64::from(turn)).sin_cos();
            let axis = Vector3::new(cos, sin * 0.6, sin * 0.8);
            let found = greatest(400, |x| axis.dot(&Vector3::from(x)).powi(8));
            assert!((found - 1.0).abs() < 1e-12, "{turn} {found}");
        }
    }

    #[test]
    fn a_body_of_revolution_has_a_family_and_a_sphere_nothing_else() {
        let linear = |diagonal: [f64; 3]| {
            let mut map = Series::zero(1, 3);
            map.set(Homogeneous::linear(&[
                [diagonal[0], 0.0, 0.0],
                [0.0, diagonal[1], 0.0],
                [0.0, 0.0, diagonal[2]],
            ]));
            stationary(&deviator(&map, 2.0), &[], 1e-15)
        };
        let revolution = linear([1.0, 1.0, 2.0]);
        assert!(revolution.families);
        assert_eq!(revolution.points.len(), 2);
        let sphere = linear([1.5; 3]);
        assert!(sphere.families && sphere.points.is_empty());
    }
}
