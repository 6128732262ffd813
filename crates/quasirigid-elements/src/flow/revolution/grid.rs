//! Meridian grid of a cavity of revolution: patches with polynomials of high degree, nodes and quadrature points.
//! Sides of the square may be one line, one place or the axis; nodes there are numbered once, so that flows are continuous.
//! Equation (L10), docs/theory/13-inside.md; spectral elements `[@bernardi1999]`.

use super::lagrange::lagrange;
use super::outline::{Meridian, Side};
use crate::math::quadrature::{gauss_legendre, gauss_lobatto};

/// Meridian divided into patches, with the nodes of polynomials in each.
pub(super) struct Grid {
    /// Distance from the axis, and height, of each node (m).
    pub places: Vec<[f64; 2]>,
    /// Whether each node is on a wall.
    pub walls: Vec<bool>,
    /// Whether each node is on the axis.
    pub axis: Vec<bool>,
    pub patches: Vec<Patch>,
    /// Patches along walls, with quadrature points there.
    pub edges: Vec<Patch>,
    /// Whether each node is on a free surface.
    pub surface: Vec<bool>,
    /// Patches along free surfaces, with quadrature points there.
    pub surfaces: Vec<Patch>,
}

/// A patch of a meridian.
pub(super) struct Patch {
    /// Nodes of the patch.
    pub nodes: Vec<usize>,
    /// Quadrature points.
    pub points: Vec<Point>,
}

/// Quadrature point.
pub(super) struct Point {
    /// Share of the area of the meridian (m²), or of the length of a wall (m).
    pub share: f64,
    /// Distance from the axis, and height (m).
    pub at: [f64; 2],
    /// The polynomials of the nodes: value, `∂/∂r` and `∂/∂z` (1, 1/m, 1/m).
    pub functions: Vec<[f64; 3]>,
    /// The polynomials of the pressure, two degrees lower.
    pub pressures: Vec<f64>,
}

/// Quadrature points along a side beyond the degree, so that round outlines and the divisor `r` cost no digits.
const BEYOND: usize = 4;

impl Grid {
    /// The meridian, with polynomials of a degree (2 at least) along each side of a patch and so many layers of patches at walls.
    pub fn new(outline: &dyn Meridian, degree: usize, layers: usize) -> Self {
        let cuts = outline.cuts(layers);
        let size = cuts.each_ref().map(|cuts| (cuts.len() - 1) * degree);
        let numbers = Numbers::new(outline.sides(), size);
        let mut grid = Self {
            places: Vec::new(),
            walls: Vec::new(),
            axis: Vec::new(),
            patches: Vec::new(),
            edges: Vec::new(),
            surface: Vec::new(),
            surfaces: Vec::new(),
        };
        let lobatto: Vec<f64> = gauss_lobatto(degree + 1).iter().map(|[x, _]| 0.5 * (1.0 + x)).collect();
        let lines = cuts.each_ref().map(|cuts| {
            let along = cuts.windows(2).flat_map(|ends| {
                lobatto[..degree].iter().map(|x| ends[0] + (ends[1] - ends[0]) * x).collect::<Vec<_>>()
            });
            along.chain([1.0]).collect::<Vec<f64>>()
        });
        for place in numbers.all() {
            grid.places.push(outline.place([lines[0][place[0]], lines[1][place[1]]]).at);
            grid.walls.push(numbers.touches(place, Side::Wall));
            grid.axis.push(numbers.touches(place, Side::Axis));
            grid.surface.push(numbers.touches(place, Side::Surface));
        }
        let template = Template::new(degree);
        for (i, s) in cuts[0].windows(2).enumerate() {
            for (j, t) in cuts[1].windows(2).enumerate() {
                let local = (0..=degree).flat_map(|a| (0..=degree).map(move |b| [a, b]));
                let nodes: Vec<usize> =
                    local.map(|[a, b]| numbers.of([i * degree + a, j * degree + b])).collect();
                let range = [[s[0], s[1]], [t[0], t[1]]];
                for (way, sides) in outline.sides().iter().enumerate() {
                    for (end, side) in sides.iter().enumerate() {
                        let along = match side {
                            Side::Wall => &mut grid.edges,
                            Side::Surface => &mut grid.surfaces,
                            Side::Axis | Side::Seam | Side::Point => continue,
                        };
                        if range[way][end] == end as f64 {
                            let points = template.edge(outline, range, way, end);
                            along.push(Patch { nodes: nodes.clone(), points });
                        }
                    }
                }
                grid.patches.push(Patch { nodes, points: template.points(outline, range) });
            }
        }
        grid
    }
}

impl Patch {
    /// Volume swept by the patch round the axis (m³).
    pub fn volume(&self) -> f64 {
        2.0 * std::f64::consts::PI * self.points.iter().map(|point| point.share * point.at[0]).sum::<f64>()
    }
}

/// Numbers of the nodes of a square; nodes at one place have one number.
struct Numbers {
    sides: [[Side; 2]; 2],
    size: [usize; 2],
    numbers: Vec<usize>,
}

impl Numbers {
    fn new(sides: [[Side; 2]; 2], size: [usize; 2]) -> Self {
        let mut own = Self { sides, size, numbers: Vec::new() };
        let mut count = 0;
        for i in 0..=size[0] {
            for j in 0..=size[1] {
                let first = own.first([i, j]);
                let number = if first == [i, j] { count } else { own.of(first) };
                count += usize::from(first == [i, j]);
                own.numbers.push(number);
            }
        }
        own
    }

    /// The first of the nodes at the same place.
    fn first(&self, [i, j]: [usize; 2]) -> [usize; 2] {
        if i == 0 && self.sides[0][0] == Side::Point || j == 0 && self.sides[1][0] == Side::Point {
            [0, 0]
        } else if j == self.size[1] && self.sides[1][1] == Side::Seam {
            [i, 0]
        } else {
            [i, j]
        }
    }

    fn of(&self, [i, j]: [usize; 2]) -> usize {
        self.numbers[i * (self.size[1] + 1) + j]
    }

    /// The first nodes at each place, in the order of their numbers.
    fn all(&self) -> impl Iterator<Item = [usize; 2]> {
        let whole = (0..=self.size[0]).flat_map(|i| (0..=self.size[1]).map(move |j| [i, j]));
        whole.filter(|place| self.first(*place) == *place)
    }

    fn touches(&self, place: [usize; 2], side: Side) -> bool {
        (0..2).any(|way| {
            let [start, end] = self.sides[way];
            place[way] == 0 && start == side || place[way] == self.size[way] && end == side
        })
    }
}

/// Polynomials along a side and the rule that integrates them, 0 to 1.
struct Template {
    points: Vec<Line>,
    ends: [Line; 2],
}

/// A point of a side.
struct Line {
    at: f64,
    weight: f64,
    /// Values and slopes of the polynomials of the nodes.
    functions: Vec<[f64; 2]>,
    /// Values of the polynomials of the pressure.
    pressures: Vec<f64>,
}

impl Template {
    fn new(degree: usize) -> Self {
        let unit = |[x, weight]: &[f64; 2]| [0.5 * (1.0 + x), 0.5 * weight];
        let nodes: Vec<f64> = gauss_lobatto(degree + 1).iter().map(|point| unit(point)[0]).collect();
        let pressures: Vec<f64> = gauss_legendre(degree - 1).iter().map(|point| unit(point)[0]).collect();
        let line = |[at, weight]: [f64; 2]| Line {
            at,
            weight,
            functions: lagrange(&nodes, at),
            pressures: lagrange(&pressures, at).into_iter().map(|[value, _]| value).collect(),
        };
        Self {
            points: gauss_legendre(degree + BEYOND).iter().map(unit).map(line).collect(),
            ends: [0.0, 1.0].map(|end| line([end, 1.0])),
        }
    }

    /// The points of a patch between values of `s` and of `t`, with their shares of its area.
    fn points(&self, outline: &dyn Meridian, range: [[f64; 2]; 2]) -> Vec<Point> {
        let pairs = self.points.iter().flat_map(|a| self.points.iter().map(move |b| [a, b]));
        let area = |[[r_s, r_t], [z_s, z_t]]: [[f64; 2]; 2]| (r_s * z_t - r_t * z_s).abs();
        pairs.map(|lines| Point::new(outline, range, lines, area)).collect()
    }

    /// The points where one of `s` and `t` ends, with their shares of the length.
    fn edge(&self, outline: &dyn Meridian, range: [[f64; 2]; 2], way: usize, end: usize) -> Vec<Point> {
        let along = 1 - way;
        let width = range[way][1] - range[way][0];
        let length = |[r, z]: [[f64; 2]; 2]| r[along].hypot(z[along]) / width;
        let lines = self.points.iter().map(|point| match way {
            0 => [&self.ends[end], point],
            _ => [point, &self.ends[end]],
        });
        lines.map(|lines| Point::new(outline, range, lines, length)).collect()
    }
}

impl Point {
    /// The point of a patch at places along its sides; `measure` is that of the slopes of the outline there.
    fn new(
        outline: &dyn Meridian,
        [s, t]: [[f64; 2]; 2],
        [by_s, by_t]: [&Line; 2],
        measure: impl Fn([[f64; 2]; 2]) -> f64,
    ) -> Self {
        let (width, height) = (s[1] - s[0], t[1] - t[0]);
        let place = outline.place([s[0] + width * by_s.at, t[0] + height * by_t.at]);
        let [[r_s, r_t], [z_s, z_t]] = place.slopes;
        let determinant = r_s * z_t - r_t * z_s;
        let functions = by_s.functions.iter().flat_map(|[f, f_s]| {
            by_t.functions.iter().map(move |[g, g_t]| {
                let (slope_s, slope_t) = (f_s * g / width, f * g_t / height);
                let slope_r = (z_t * slope_s - z_s * slope_t) / determinant;
                [f * g, slope_r, (r_s * slope_t - r_t * slope_s) / determinant]
            })
        });
        let pressures = by_s.pressures.iter().flat_map(|f| by_t.pressures.iter().map(move |g| f * g));
        Self {
            share: by_s.weight * by_t.weight * width * height * measure(place.slopes),
            at: place.at,
            functions: functions.collect(),
            pressures: pressures.collect(),
        }
    }
}
