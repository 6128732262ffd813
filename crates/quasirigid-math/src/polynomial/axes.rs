//! Change of axes of polynomial maps.

use super::{Homogeneous, Series};

impl Homogeneous {
    /// The map over the components of its argument along other axes.
    #[must_use]
    pub fn in_axes(&self, axes: [[f64; 3]; 3]) -> Self {
        let degree = self.degree();
        let component = |c: usize| powers(&Self::linear(&[axes.map(|axis| axis[c])]), degree);
        let [x, y, z] = [0, 1, 2].map(component);
        let mut turned = Self::zero(degree, self.rows());
        for ([i, j, k], coefficients) in self.terms() {
            let mut plane = Self::zero(i + j, 1);
            plane.add_product(0, 1.0, (x.part(i), 0), (y.part(j), 0));
            let mut whole = Self::zero(i + j + k, 1);
            whole.add_product(0, 1.0, (&plane, 0), (z.part(k), 0));
            for (row, coefficient) in coefficients.into_iter().enumerate().filter(|(_, c)| *c != 0.0) {
                turned.add_row(row, coefficient, (&whole, 0));
            }
        }
        turned
    }
}

/// Powers of a linear form, to a degree.
fn powers(form: &Homogeneous, degree: usize) -> Series {
    let mut powers = Series::zero(degree, 1);
    let mut power = Homogeneous::zero(0, 1);
    power.row_mut(0)[0] = 1.0;
    for next in 1..=degree {
        let mut product = Homogeneous::zero(next, 1);
        product.add_product(0, 1.0, (&power, 0), (form, 0));
        powers.set(std::mem::replace(&mut power, product));
    }
    powers.set(power);
    powers
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vec3::{add, scale};

    const AXES: [[f64; 3]; 3] = [[0.48, 0.6, -0.64], [-0.8, 0.6, -0.0375], [0.36, 0.53, 0.77]];

    /// The values do not change with the axes.
    #[test]
    fn values_are_those_in_the_first_axes() {
        let at: [f64; 3] = [0.3, -1.1, 0.7];
        let x = AXES.iter().zip(at).fold([0.0; 3], |sum, (axis, part)| add(sum, scale(part, *axis)));
        for degree in 0..=4 {
            let mut map = Homogeneous::zero(degree, 3);
            for (i, coefficients) in map.coefficients_mut().enumerate() {
                coefficients.iter_mut().enumerate().for_each(|(j, c)| *c = 0.3 + ((3 * i + j) as f64).sin());
            }
            let turned = map.in_axes(AXES);
            for row in 0..3 {
                let [found, expected] = [(&turned, at), (&map, x)].map(|(map, at)| map.value(at)[row]);
                assert!((found - expected).abs() < 1e-13, "{degree}: {found} {expected}");
            }
        }
    }
}
