//! Radial functions of the flows in a ball: toroidal and poloidal, by Jacobi polynomials.
//! With these weights the friction matrix of a ball is the identity; values are stored times radius and root of the weight, so that an
//! integral is one matrix product.
//! Equation (L16), docs/theory/13-inside.md.

use nalgebra::DMatrix;

use crate::liquid::jacobi::jacobi;

/// Radial functions `f` with `f′` and `f/r` at the points of a rule, times the radius and the root of the weight.
#[derive(Clone)]
pub(super) struct Radial {
    pub value: DMatrix<f64>,
    pub slope: DMatrix<f64>,
    pub over: DMatrix<f64>,
}

impl Radial {
    /// `r^l (1−r²) J_n^{(1, l+½)}(2r²−1)` of toroidal flows, with `l(l+1)∫|∇u|² = 1` of the flow in a ball: the Laplacian takes each to a
    /// polynomial orthogonal to the others.
    pub fn toroidal(l: usize, count: usize, rule: &[[f64; 2]]) -> Self {
        let [value, slope, _, laplacian] = functions(l, count, rule, 1);
        let mut own = Self { over: over(&value, rule), value, slope };
        for column in 0..count {
            let bent = -own.value.column(column).dot(&laplacian.column(column));
            let factor = (square(l) * bent).sqrt().recip();
            own.each(|matrix| matrix.column_mut(column).scale_mut(factor));
        }
        own
    }

    /// Poloidal flows: from `p = r^l (1−r²)² J_n^{(2, l+½)}(2r²−1)` the functions `l(l p/r − p′)` of the degree above and
    /// `(l+1)((l+1)p/r + p′)` of the degree below, scaled as the toroidal ones.
    pub fn poloidal(l: usize, count: usize, rule: &[[f64; 2]]) -> [Self; 2] {
        let [p, first, second, laplacian] = functions(l, count, rule, 2);
        let share = over(&p, rule);
        let bend = over(&(&first - &share), rule);
        let degree = l as f64;
        let of = |factor: f64, weight: f64, sign: f64| {
            let value = factor * (weight * &share + sign * &first);
            let slope = factor * (weight * &bend + sign * &second);
            Self { over: over(&value, rule), value, slope }
        };
        let mut pair = [of(degree, degree, -1.0), of(degree + 1.0, degree + 1.0, 1.0)];
        for column in 0..count {
            let factor = (square(l) * laplacian.column(column).norm_squared()).sqrt().recip();
            pair.iter_mut()
                .for_each(|radial| radial.each(|matrix| matrix.column_mut(column).scale_mut(factor)));
        }
        pair
    }

    /// `f′ − l f/r` and `f′ + (l+1) f/r`: parts of the slope along the axis at the degrees above and below.
    pub fn along_axis(&self, l: usize) -> [DMatrix<f64>; 2] {
        let degree = l as f64;
        [&self.slope - degree * &self.over, &self.slope + (degree + 1.0) * &self.over]
    }

    fn each(&mut self, change: impl FnMut(&mut DMatrix<f64>)) {
        [&mut self.value, &mut self.slope, &mut self.over].into_iter().for_each(change);
    }
}

fn square(l: usize) -> f64 {
    (l * (l + 1)) as f64
}

fn over(values: &DMatrix<f64>, rule: &[[f64; 2]]) -> DMatrix<f64> {
    DMatrix::from_fn(values.nrows(), values.ncols(), |row, column| values[(row, column)] / rule[row][0])
}

/// `f = r^l (1−r²)^k J_n^{(k, l+½)}`, `f′`, `f″` and `f″ + 2f′/r − l(l+1)f/r²`.
fn functions(l: usize, count: usize, rule: &[[f64; 2]], power: i32) -> [DMatrix<f64>; 4] {
    let mut found = [(); 4].map(|()| DMatrix::zeros(rule.len(), count));
    let degree = l as f64;
    for (row, [r, weight]) in rule.iter().enumerate() {
        let values = jacobi(count, [f64::from(power), degree + 0.5], 2.0 * r * r - 1.0);
        let rest = 1.0 - r * r;
        let scale = weight.sqrt() * r.powi(l as i32 + 1);
        for (column, [f, f_x, f_xx]) in values.into_iter().enumerate() {
            // By x = 2r² − 1 the slope of 1 − r² is −½.
            let [g, g_x, g_xx] = if power == 1 {
                [rest * f, rest * f_x - 0.5 * f, rest * f_xx - f_x]
            } else {
                let square = rest * rest;
                [square * f, square * f_x - rest * f, square * f_xx - 2.0 * rest * f_x + 0.5 * f]
            };
            let laplacian = 16.0 * r * r * g_xx + (8.0 * degree + 12.0) * g_x;
            let slope = degree * g / r + 4.0 * r * g_x;
            let second = laplacian - 2.0 * slope / r + square(l) * g / (r * r);
            for (matrix, value) in found.iter_mut().zip([g, slope, second, laplacian]) {
                matrix[(row, column)] = scale * value;
            }
        }
    }
    found
}
