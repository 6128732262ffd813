use nalgebra::Complex;

use crate::flow::Velocity;

type C = Complex<f64>;

/// A flow on a circle round the axis: harmonics of `u_x + i u_y` and of `u_z`, each with its slopes along the radius and the axis.
pub(super) struct Ring {
    pub across: Vec<(i32, [C; 3])>,
    /// Harmonics from 0 on; the others are the conjugates of these.
    pub along: Vec<(i32, [C; 3])>,
}

impl Ring {
    /// The velocity at a distance from the axis (m) and an angle.
    pub fn velocity(&self, r: f64, angle: f64) -> Velocity {
        let turn = |n: i32| C::cis(f64::from(n) * angle);
        // Value, and slopes along the radius, the circle and the axis.
        let (mut w, mut z) = ([C::ZERO; 4], [0.0; 4]);
        for (n, [value, outward, upward]) in &self.across {
            let terms = [*value, *outward, C::i() * f64::from(*n) * value / r, *upward];
            w.iter_mut().zip(terms).for_each(|(sum, term)| *sum += term * turn(*n));
        }
        for (n, [value, outward, upward]) in &self.along {
            let both = if *n == 0 { 1.0 } else { 2.0 };
            let terms = [*value, *outward, C::i() * f64::from(*n) * value / r, *upward];
            z.iter_mut().zip(terms).for_each(|(sum, term)| *sum += both * (term * turn(*n)).re);
        }
        let (sine, cosine) = angle.sin_cos();
        let slopes = |outward: f64, round: f64, upward: f64| {
            [cosine * outward - sine * round, sine * outward + cosine * round, upward]
        };
        Velocity {
            u: [w[0].re, w[0].im, z[0]],
            gradient: [
                slopes(w[1].re, w[2].re, w[3].re),
                slopes(w[1].im, w[2].im, w[3].im),
                slopes(z[1], z[2], z[3]),
            ],
        }
    }
}
