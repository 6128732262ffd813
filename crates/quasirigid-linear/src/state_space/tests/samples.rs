//! Random systems for the tests of state spaces, here and in `tests/suite`.

use nalgebra::DMatrix;

use super::{Real, System};

/// Numbers from −1 to 1, the same in each run.
pub struct Draws(pub u64);

impl Draws {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    pub fn matrix(&mut self, rows: usize, columns: usize) -> Real {
        DMatrix::from_fn(rows, columns, |_, _| self.next())
    }
}

/// Damped oscillators of frequencies over two decades and a relaxation, in turned axes and odd units, with two inputs and outputs.
pub fn decaying(draws: &mut Draws, modes: usize) -> System {
    let size = 2 * modes + 1;
    let mut A = Real::zeros(size, size);
    A[(size - 1, size - 1)] = -0.3;
    for mode in 0..modes {
        let (frequency, k) = (10f64.powf(1.0 + draws.next()), 2 * mode);
        A[(k, k + 1)] = 1.0;
        A[(k + 1, k)] = -frequency * frequency;
        A[(k + 1, k + 1)] = -2.0 * (0.02 + 0.015 * draws.next()) * frequency;
    }
    let mix = Real::identity(size, size) + 0.3 * draws.matrix(size, size);
    let units = Real::from_fn(size, size, |i, k| if i == k { 10f64.powi((i % 5) as i32 - 2) } else { 0.0 });
    let change = mix * units;
    let inverse = change.clone().try_inverse().unwrap();
    System {
        A: &change * A * inverse,
        B: &change * draws.matrix(size, 2),
        C: draws.matrix(2, size) * change.try_inverse().unwrap(),
        D: draws.matrix(2, 2),
    }
}
