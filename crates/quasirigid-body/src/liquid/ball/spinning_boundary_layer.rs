//! Boundary layer of a liquid that spins with a ball or a spheroid: drag and moment of inertia at a frequency. (L17)

use std::f64::consts::TAU;

use nalgebra::{Complex, Vector3};

use super::SpinningSpheroid;
use crate::math::quadrature::gauss_legendre;

type C = Complex<f64>;

/// Numbers of points of the rule from pole to pole, and round the axis.
const POINTS: usize = 32;
const ROUND: usize = 8;

/// Force per rate of an ideal core of uniform vorticity and of its thin boundary layer with the Coriolis force in both, in the units of
/// [`SpinningSpheroid::drag`]. (L17)
pub(super) fn drag(liquid: SpinningSpheroid, m: usize, sigma: C) -> [C; 2] {
    let SpinningSpheroid { stretch, tau } = liquid;
    // Inertia and Coriolis coupling of the slip per its load squared, with `∫|e × r|² dV = 1` in the ball.
    let shape = WallSlip::new(m, stretch);
    let core = shape.mass * sigma - C::new(0.0, m as f64 * 2.0 * tau * shape.turning);
    [core, over_wall(sigma, tau, |x| shape.at(x))]
}

/// Slip past the wall of an ideal core, per its load squared.
struct WallSlip {
    m: usize,
    stretch: f64,
    mass: f64,
    turning: f64,
    scale: f64,
}

impl WallSlip {
    /// Slip in a spheroid with the semi-axes 1 and `c`: across the axis the load is `4c²/(1 + c²)·V/5` and equals `∫w² dV`, per `c²
    /// V·2/5` of the load of (L16); about the axis the core rotates as a whole.
    fn new(m: usize, stretch: f64) -> Self {
        let unit = 5.0 / (2.0 * (4.0 / 3.0 * std::f64::consts::PI) * stretch.sqrt());
        if m == 0 {
            return Self { m, stretch, mass: 1.0, turning: 0.0, scale: unit };
        }
        let share = 1.0 + stretch;
        // Load over that of the unit rotation of the stretched ball.
        let load = 2.0 / share;
        let mass = 2.0 * stretch / share / (load * load * stretch);
        let turning = 2.0 * stretch / (share * share) / (load * load * stretch);
        Self { m, stretch, mass, turning, scale: unit / (load * load * stretch) }
    }

    /// `w̄·(w − i n × w)` integrated round the axis where the normal has the component `x` along it, per `dx`.
    fn at(&self, x: C) -> C {
        let across = (C::from(1.0) - x * x).sqrt();
        let round = (0..ROUND).map(|place| {
            let (sin, cos) = (TAU * place as f64 / ROUND as f64).sin_cos();
            let n = Vector3::new(across * cos, across * sin, x);
            let square = across * across + x * x * self.stretch;
            let r = Vector3::new(n.x, n.y, n.z * self.stretch) / square.sqrt();
            let dot = |a: &[C; 3], b: &[C; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
            let cross =
                |w: &[C; 3]| [n.y * w[2] - n.z * w[1], n.z * w[0] - n.x * w[2], n.x * w[1] - n.y * w[0]];
            let [w, conjugate] = self.slip(r);
            let area = self.stretch / (square * square) * (TAU / ROUND as f64);
            (dot(&conjugate, &w) - C::i() * dot(&conjugate, &cross(&w))) * area
        });
        self.scale * round.sum::<C>()
    }

    /// Slip at a place, and the function that equals its conjugate on the wall.
    fn slip(&self, r: Vector3<C>) -> [[C; 3]; 2] {
        let zero = C::from(0.0);
        if self.m == 0 {
            let w = [r.y, -r.x, zero];
            return [w, w];
        }
        let factor = 2.0 / (1.0 + self.stretch) / 2.0_f64.sqrt();
        let sign = C::new(0.0, self.m as f64);
        let about_x = [zero, r.z * factor, -r.y * (factor * self.stretch)];
        let about_y = [-r.z * factor, zero, r.x * (factor * self.stretch)];
        [sign, -sign].map(|sign| [0, 1, 2].map(|axis| about_x[axis] + sign * about_y[axis]))
    }
}

/// `∫ g(x) κ dx` from −1 to 1 with `κ = √(σ + 2iτx)`: with `κ` as the variable the integrand is regular at `κ = 0`.
fn over_wall(sigma: C, tau: f64, g: impl Fn(C) -> C) -> C {
    let turn = C::new(0.0, 2.0 * tau);
    let [first, last] = [(sigma - turn).sqrt(), (sigma + turn).sqrt()];
    let term = |[place, weight]: [f64; 2]| {
        let share = 0.5 * (1.0 + place);
        let kappa = first + (last - first) * share;
        let x = (kappa + first) / (first + last) * (2.0 * share) - 1.0;
        0.5 * weight * g(x) * kappa * kappa
    };
    4.0 / (first + last) * gauss_legendre(POINTS).into_iter().map(term).sum::<C>()
}
