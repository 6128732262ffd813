use nalgebra::DMatrix;

use crate::liquid::jacobi::jacobi;

/// Functions at the points of a rule, with their first two derivatives.
pub(super) type Values = [DMatrix<f64>; 3];

/// Functions of the radius or of the height with their slopes, times the root of the weight.
pub(super) struct Line {
    pub value: DMatrix<f64>,
    pub slope: DMatrix<f64>,
}

impl Line {
    pub fn new(value: &DMatrix<f64>, slope: &DMatrix<f64>, roots: &[f64]) -> Self {
        let weighted = |matrix: &DMatrix<f64>| {
            DMatrix::from_fn(matrix.nrows(), matrix.ncols(), |row, column| roots[row] * matrix[(row, column)])
        };
        Self { value: weighted(value), slope: weighted(slope) }
    }
}

/// `r^q (1−r²)^k J_n^{(k,q)}(2r²−1)`, `q` 0 or 1 and `k` 1 or 2.
pub(super) fn radial(count: usize, [power, order]: [i32; 2], rule: &[[f64; 2]]) -> Values {
    let mut found = [(); 3].map(|()| DMatrix::zeros(rule.len(), count));
    for (row, [r, _]) in rule.iter().enumerate() {
        let orders = [f64::from(power), f64::from(order)];
        for (column, f) in jacobi(count, orders, 2.0 * r * r - 1.0).into_iter().enumerate() {
            // By x = 2r² − 1: x′ = 4r, and 1 − r² = (1 − x)/2.
            let [g, g_x, g_xx] = product(edge(power, [1.0 - r * r, -0.5, 0.0]), f);
            let [h, first, second] = [g, 4.0 * r * g_x, 4.0 * g_x + 16.0 * r * r * g_xx];
            let values = if order == 0 {
                [h, first, second]
            } else {
                [r * h, h + r * first, 2.0 * first + r * second]
            };
            found.iter_mut().zip(values).for_each(|(matrix, value)| matrix[(row, column)] = value);
        }
    }
    found
}

/// `(1−ζ²)^k J_n^{(k,k)}(ζ)` of the height `z = hζ`, the even or the odd ones.
pub(super) fn axial(count: usize, [power, odd]: [i32; 2], rule: &[[f64; 2]], half: f64) -> Values {
    let mut found = [(); 3].map(|()| DMatrix::zeros(rule.len(), count));
    for (row, [x, _]) in rule.iter().enumerate() {
        let all = jacobi(2 * count, [f64::from(power); 2], *x);
        for column in 0..count {
            let f = all[2 * column + odd as usize];
            let values = product(edge(power, [1.0 - x * x, -2.0 * x, -2.0]), f);
            for (derivative, (matrix, value)) in found.iter_mut().zip(values).enumerate() {
                matrix[(row, column)] = value / half.powi(derivative as i32);
            }
        }
    }
    found
}

/// `w` or `w²` with two derivatives.
fn edge(power: i32, [w, first, second]: [f64; 3]) -> [f64; 3] {
    if power == 1 { [w, first, second] } else { [w * w, 2.0 * w * first, 2.0 * (first * first + w * second)] }
}

fn product([a, a_x, a_xx]: [f64; 3], [b, b_x, b_xx]: [f64; 3]) -> [f64; 3] {
    [a * b, a_x * b + a * b_x, a_xx * b + 2.0 * a_x * b_x + a * b_xx]
}
