use super::lagrange::lagrange;
use super::outline::{Outline, Side};
use crate::math::quadrature::{gauss_legendre, gauss_lobatto};

/// A meridian cut into patches, with the nodes of polynomials in each.
pub(super) struct Grid {
    /// Distance from the axis, and height, of each node (m).
    pub places: Vec<[f64; 2]>,
    /// Whether each node is on a wall.
    pub walls: Vec<bool>,
    /// Whether each node is on the axis.
    pub axis: Vec<bool>,
    pub patches: Vec<Patch>,
}

/// A patch of a meridian.
pub(super) struct Patch {
    /// Its nodes.
    pub nodes: Vec<usize>,
    /// Its points of quadrature.
    pub points: Vec<Point>,
}

/// A point of quadrature.
pub(super) struct Point {
    /// Its share of the area of the meridian (m²).
    pub area: f64,
    /// Distance from the axis, and height (m).
    pub at: [f64; 2],
    /// The polynomials of the nodes: value, `∂/∂r` and `∂/∂z` (1, 1/m, 1/m).
    pub functions: Vec<[f64; 3]>,
    /// The polynomials of the pressure, two degrees lower.
    pub pressures: Vec<f64>,
}

/// Points of quadrature along a side beyond the degree, so that round outlines and the divisor `r` cost no digits.
const BEYOND: usize = 4;

impl Grid {
    /// The meridian, with polynomials of a degree (2 at least) along each side of a patch.
    pub fn new(outline: &Outline, degree: usize) -> Self {
        let cuts = outline.cuts();
        let size = cuts.each_ref().map(|cuts| (cuts.len() - 1) * degree);
        let numbers = Numbers::new(outline.sides(), size);
        let mut grid = Self { places: Vec::new(), walls: Vec::new(), axis: Vec::new(), patches: Vec::new() };
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
        }
        let template = Template::new(degree);
        for (i, s) in cuts[0].windows(2).enumerate() {
            for (j, t) in cuts[1].windows(2).enumerate() {
                let local = (0..=degree).flat_map(|a| (0..=degree).map(move |b| [a, b]));
                let nodes = local.map(|[a, b]| numbers.of([i * degree + a, j * degree + b])).collect();
                let points = template.points(outline, [[s[0], s[1]], [t[0], t[1]]]);
                grid.patches.push(Patch { nodes, points });
            }
        }
        grid
    }
}

/// The nodes of a square, numbered; those that are one place have one number.
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
        if i == 0 && self.sides[0][0] == Side::Point {
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
    /// Place and weight of each point, values and slopes of the polynomials of the nodes there, values of those of the pressure.
    points: Vec<([f64; 2], Vec<[f64; 2]>, Vec<f64>)>,
}

impl Template {
    fn new(degree: usize) -> Self {
        let unit = |[x, weight]: &[f64; 2]| [0.5 * (1.0 + x), 0.5 * weight];
        let nodes: Vec<f64> = gauss_lobatto(degree + 1).iter().map(|point| unit(point)[0]).collect();
        let pressures: Vec<f64> = gauss_legendre(degree - 1).iter().map(|point| unit(point)[0]).collect();
        let point = |point: [f64; 2]| {
            let values = lagrange(&pressures, point[0]).into_iter().map(|[value, _]| value).collect();
            (point, lagrange(&nodes, point[0]), values)
        };
        Self { points: gauss_legendre(degree + BEYOND).iter().map(unit).map(point).collect() }
    }

    /// The points of a patch between values of `s` and of `t`.
    fn points(&self, outline: &Outline, [s, t]: [[f64; 2]; 2]) -> Vec<Point> {
        let (width, height) = (s[1] - s[0], t[1] - t[0]);
        let pairs = self.points.iter().flat_map(|a| self.points.iter().map(move |b| (a, b)));
        pairs
            .map(|((at_s, along_s, pressures_s), (at_t, along_t, pressures_t))| {
                let place = outline.place([s[0] + width * at_s[0], t[0] + height * at_t[0]]);
                let [[r_s, r_t], [z_s, z_t]] = place.slopes;
                let determinant = r_s * z_t - r_t * z_s;
                let functions = along_s.iter().flat_map(|[f, f_s]| {
                    along_t.iter().map(move |[g, g_t]| {
                        let (by_s, by_t) = (f_s * g / width, f * g_t / height);
                        let by_r = (z_t * by_s - z_s * by_t) / determinant;
                        [f * g, by_r, (r_s * by_t - r_t * by_s) / determinant]
                    })
                });
                Point {
                    area: at_s[1] * at_t[1] * width * height * determinant.abs(),
                    at: place.at,
                    functions: functions.collect(),
                    pressures: pressures_s
                        .iter()
                        .flat_map(|f| pressures_t.iter().map(move |g| f * g))
                        .collect(),
                }
            })
            .collect()
    }
}
