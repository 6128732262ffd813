//! Change of axes of polynomial maps.

use super::{Homogeneous, Series};
use crate::sym3::COMPONENTS;

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

impl Series {
    /// The map over the components of its argument along other axes.
    #[must_use]
    pub fn in_axes(&self, axes: [[f64; 3]; 3]) -> Self {
        let mut turned = self.clone();
        for degree in 0..=self.degree() {
            turned.set(self.part(degree).in_axes(axes));
        }
        turned
    }

    /// A vector field with its argument and its values by their components along other axes.
    #[must_use]
    pub fn field_in_axes(&self, axes: [[f64; 3]; 3]) -> Self {
        let columns = [0, 1, 2].map(|c| axes.map(|axis| axis[c]));
        let mut turned = self.clone();
        for degree in 0..=self.degree() {
            turned.set(self.part(degree).in_axes(axes).contracted(&columns));
        }
        turned
    }

    /// A symmetric tensor field, rows xx, yy, zz, yz, zx, xy, with its argument and its values by their components along other axes.
    #[must_use]
    pub fn tensor_in_axes(&self, axes: [[f64; 3]; 3]) -> Self {
        let columns = COMPONENTS.map(|(i, j)| {
            COMPONENTS.map(|(a, b)| {
                let product = axes[a][i] * axes[b][j];
                if i == j { product } else { product + axes[a][j] * axes[b][i] }
            })
        });
        let mut turned = self.clone();
        for degree in 0..=self.degree() {
            turned.set(self.part(degree).in_axes(axes).contracted(&columns));
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
    use crate::vec3::{add, dot, scale};

    const AXES: [[f64; 3]; 3] = [[0.48, 0.6, -0.64], [-0.8, 0.6, -0.0375], [0.36, 0.53, 0.77]];

    /// The values do not change with the axes: of scalars at once, of fields after a change back; constants are lifted.
    #[test]
    fn values_are_those_in_the_first_axes() {
        let mut field = Series::zero(4, 3);
        for degree in 0..=4 {
            let mut part = Homogeneous::zero(degree, 3);
            for (i, coefficients) in part.coefficients_mut().enumerate() {
                coefficients.iter_mut().enumerate().for_each(|(j, c)| *c = 0.3 + ((3 * i + j) as f64).sin());
            }
            if degree > 0 {
                let lower = field.part(degree - 1).clone();
                (0..3).for_each(|row| part.add_row(row, 0.7, (&lower, row)));
            }
            field.set(part);
        }
        let at: [f64; 3] = [0.3, -1.1, 0.7];
        let x = AXES.iter().zip(at).fold([0.0; 3], |sum, (axis, part)| add(sum, scale(part, *axis)));
        let expected = field.vector(x);
        let scalars = field.in_axes(AXES).vector(at);
        let turned = field.field_in_axes(AXES).vector(at);
        for row in 0..3 {
            assert!((scalars[row] - expected[row]).abs() < 1e-13, "{scalars:?} {expected:?}");
            let along = dot(AXES[row], expected);
            assert!((turned[row] - along).abs() < 1e-13, "{turned:?} {expected:?}");
        }
    }
}
