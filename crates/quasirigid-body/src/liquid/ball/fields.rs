//! Galerkin flows of a ball or spheroid of liquid in spherical harmonics: toroidal of odd degree, poloidal of even degree.
//! Only these degrees are driven by a rotation; components `u_x ± iu_y`, `u_z` are harmonics themselves, so that products have few entries
//! and the stretch couples no more than four degrees.
//! Equation (L16), docs/theory/13-inside.md.

use nalgebra::{DMatrix, DVector};

use super::radial::Radial;
use crate::liquid::galerkin::{Fields, Products, TURNED, WEIGHTS};
use crate::math::quadrature::gauss_legendre;

/// Component of the flows of a degree: `u_x + iu_y`, `u_x − iu_y` or `u_z`.
struct Part {
    component: usize,
    degree: usize,
    factor: f64,
    radial: usize,
}

/// Flows of a degree.
struct Degree {
    radials: Vec<Radial>,
    parts: Vec<Part>,
    /// Slopes `∂u/∂z`: component, degree, values.
    slopes: Vec<(usize, usize, DMatrix<f64>)>,
}

/// Number of degrees that a stretched ball couples.
const STRETCHED: usize = 4;
/// Flows of harmonic `m` round the axis of a spheroid that spins about it, `degrees` degrees with `count` flows each; `stretch` is the
/// square of the ratio of the semi-axes along and across. They are the flows in the ball of radius 1, toroidal of odd and poloidal of
/// even degree, stretched like the ball. (L16)
pub(super) fn fields(m: usize, degrees: usize, count: usize, stretch: f64) -> Fields {
    let unit = |[x, weight]: [f64; 2]| [0.5 * (1.0 + x), 0.5 * weight];
    let rule: Vec<[f64; 2]> = gauss_legendre(degrees + 2 * count + 6).into_iter().map(unit).collect();
    let all: Vec<Degree> = (1..=degrees).map(|l| Degree::new(m as i32, l, count, &rule)).collect();
    let width = if stretch == 1.0 { 1 } else { STRETCHED };
    let chunks: Vec<&[Degree]> = all.chunks(width).collect();
    // The rigid rotation is toroidal, of degree 1, with the radial function r and l(l+1)∫r⁴ dr = 2/5.
    let turn = DVector::from_iterator(rule.len(), rule.iter().map(|[r, weight]| weight.sqrt() * r * r));
    let first = all[0].radials[0].value.tr_mul(&turn) * (2.0 / 0.4_f64.sqrt());
    let group = width.min(degrees) * count;
    Fields {
        groups: chunks.iter().map(|own| of(own, own, stretch)).collect(),
        between: chunks.windows(2).map(|pair| of(pair[0], pair[1], stretch).couplings()).collect(),
        load: DVector::from_fn(group, |row, _| if row < count { first[row] } else { 0.0 }),
    }
}

impl Degree {
    fn new(m: i32, l: usize, count: usize, rule: &[[f64; 2]]) -> Self {
        let (degree, order) = (l as f64, f64::from(m));
        let part = |component, degree, factor, radial| Part { component, degree, factor, radial };
        let (radials, parts) = if l % 2 == 1 {
            let ladder = |sign: f64| -((degree - sign * order) * (degree + sign * order + 1.0)).sqrt();
            let parts = vec![part(0, l, ladder(1.0), 0), part(1, l, ladder(-1.0), 0), part(2, l, -order, 0)];
            (vec![Radial::toroidal(l, count, rule)], parts)
        } else {
            let up = |sign: f64| {
                let product = (degree + sign * order + 1.0) * (degree + sign * order + 2.0);
                (product / ((2.0 * degree + 1.0) * (2.0 * degree + 3.0))).sqrt()
            };
            let down = |sign: f64| {
                let product = (degree - sign * order) * (degree - sign * order - 1.0);
                (product / ((2.0 * degree - 1.0) * (2.0 * degree + 1.0))).sqrt()
            };
            let parts = vec![
                part(0, l + 1, -up(1.0), 0),
                part(0, l - 1, down(1.0), 1),
                part(1, l + 1, up(-1.0), 0),
                part(1, l - 1, -down(-1.0), 1),
                part(2, l + 1, cosine(l + 1, m), 0),
                part(2, l - 1, cosine(l, m), 1),
            ];
            (Radial::poloidal(l, count, rule).into(), parts)
        };
        let slopes = parts.iter().flat_map(|part| slopes(m, part, &radials[part.radial])).collect();
        Self { radials, parts, slopes }
    }
}

/// Slope `∂/∂z` of a component, at the degrees above and below.
fn slopes(m: i32, part: &Part, radial: &Radial) -> [(usize, usize, DMatrix<f64>); 2] {
    let (l, order) = (part.degree, m + [1, -1, 0][part.component]);
    let [above, below] = radial.along_axis(l);
    [
        (part.component, l + 1, part.factor * cosine(l + 1, order) * above),
        (part.component, l.wrapping_sub(1), part.factor * cosine(l, order) * below),
    ]
}

/// `c_l` of `cosθ Y_l = c_{l+1} Y_{l+1} + c_l Y_{l−1}`, zero at the lowest degree.
fn cosine(l: usize, m: i32) -> f64 {
    let (l, m) = (l as f64, f64::from(m));
    ((l * l - m * m).max(0.0) / (4.0 * l * l - 1.0)).sqrt()
}

/// Products of the flows of some degrees with those of others.
fn of(rows: &[Degree], columns: &[Degree], stretch: f64) -> Products {
    let count = rows[0].radials[0].value.ncols();
    let zero = DMatrix::zeros(rows.len() * count, columns.len() * count);
    let mut own = Products { mass: zero.clone(), friction: zero.clone(), turning: zero };
    for (i, row) in rows.iter().enumerate() {
        for (j, column) in columns.iter().enumerate() {
            let block = pair(row, column, stretch);
            let place = (i * count, j * count);
            own.mass.view_mut(place, (count, count)).copy_from(&block.mass);
            own.friction.view_mut(place, (count, count)).copy_from(&block.friction);
            own.turning.view_mut(place, (count, count)).copy_from(&block.turning);
        }
    }
    own.cleaned()
}

fn pair(row: &Degree, column: &Degree, stretch: f64) -> Products {
    let count = row.radials[0].value.ncols();
    let zero = DMatrix::zeros(count, count);
    let mut own = Products { mass: zero.clone(), friction: zero.clone(), turning: zero };
    for a in &row.parts {
        for b in column.parts.iter().filter(|b| (b.component, b.degree) == (a.component, a.degree)) {
            let factor = WEIGHTS[a.component] * a.factor * b.factor;
            let [f, g] = [&row.radials[a.radial], &column.radials[b.radial]];
            let product = factor * (f.value.transpose() * &g.value);
            let slant = (a.degree * (a.degree + 1)) as f64;
            let gradient =
                factor * ((f.slope.transpose() * &g.slope) + slant * (f.over.transpose() * &g.over));
            let square = if a.component == 2 { stretch } else { 1.0 };
            own.turning += TURNED[a.component] * &product;
            own.mass += square * product;
            own.friction += square * gradient;
        }
    }
    if stretch != 1.0 {
        for (component, degree, f) in &row.slopes {
            let like = |(c, l, _): &&(usize, usize, _)| (c, l) == (component, degree);
            for (.., g) in column.slopes.iter().filter(like) {
                // Slopes along a stretched axis are smaller, those of the stretched component larger.
                let square = if *component == 2 { 1.0 - stretch } else { 1.0 / stretch - 1.0 };
                own.friction += square * WEIGHTS[*component] * (f.transpose() * g);
            }
        }
    }
    own
}
