//! Free rigid bodies for the tests of audits, integrated by methods of known damping: written here, not imported.

use std::fmt::Write;

pub type Matrix = [[f64; 3]; 3];
pub type Step = fn(&Free, [f64; 3], f64) -> [f64; 3];

/// Free rigid body, written here and not imported.
pub struct Free {
    pub tensor: Matrix,
    inverse: Matrix,
}

pub fn times(m: &Matrix, v: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|i| (0..3).map(|k| m[i][k] * v[k]).sum())
}

pub fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|i| a[i] * b[i]).sum()
}

pub fn plus(a: [f64; 3], s: f64, b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|i| a[i] + s * b[i])
}

impl Free {
    /// The body of three moments in axes whose vectors are the rows of a rotation.
    pub fn new(moments: [f64; 3], axes: &Matrix) -> Self {
        let of = |value: [f64; 3]| {
            [0, 1, 2].map(|i| [0, 1, 2].map(|k| (0..3).map(|a| value[a] * axes[a][i] * axes[a][k]).sum()))
        };
        Self { tensor: of(moments), inverse: of(moments.map(f64::recip)) }
    }

    pub fn rate(&self, w: [f64; 3]) -> [f64; 3] {
        times(&self.inverse, cross(times(&self.tensor, w), w))
    }

    pub fn entries(&self) -> [f64; 6] {
        let [[xx, xy, xz], [_, yy, yz], [_, _, zz]] = self.tensor;
        [xx, yy, zz, xy, xz, yz]
    }

    /// Energy doubled and angular momentum squared.
    pub fn invariants(&self, w: [f64; 3]) -> [f64; 2] {
        let momentum = times(&self.tensor, w);
        [dot(w, momentum), dot(momentum, momentum)]
    }
}

pub const OWN: Matrix = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Axes that are turned about two others.
pub fn turned(a: f64, b: f64) -> Matrix {
    let ((sa, ca), (sb, cb)) = (a.sin_cos(), b.sin_cos());
    [[ca * cb, ca * sb, -sa], [-sb, cb, 0.0], [sa * cb, sa * sb, ca]]
}

/// Iterations of implicit steps, each of which gains the digits of `hω`.
const ITERATIONS: usize = 10;

pub fn explicit_euler(body: &Free, w: [f64; 3], h: f64) -> [f64; 3] {
    plus(w, h, body.rate(w))
}

pub fn implicit_euler(body: &Free, w: [f64; 3], h: f64) -> [f64; 3] {
    (0..ITERATIONS).fold(w, |next, _| plus(w, h, body.rate(next)))
}

pub fn implicit_midpoint(body: &Free, w: [f64; 3], h: f64) -> [f64; 3] {
    (0..ITERATIONS).fold(w, |next, _| plus(w, h, body.rate(plus(w, 0.5, plus(next, -1.0, w)))))
}

pub fn runge_kutta(body: &Free, w: [f64; 3], h: f64) -> [f64; 3] {
    runge_kutta_of(&|w| body.rate(w), w, h)
}

/// A body that loses energy at a constant angular momentum, `dK/dt = K × ω + ε K × (K × ω)`.
pub fn dissipative(body: &Free, w: [f64; 3], h: f64) -> [f64; 3] {
    let rate = |w: [f64; 3]| {
        let momentum = times(&body.tensor, w);
        let turn = cross(momentum, w);
        times(&body.inverse, plus(turn, 1e-4, cross(momentum, turn)))
    };
    runge_kutta_of(&rate, w, h)
}

pub fn runge_kutta_of(rate: &dyn Fn([f64; 3]) -> [f64; 3], w: [f64; 3], h: f64) -> [f64; 3] {
    let first = rate(w);
    let second = rate(plus(w, 0.5 * h, first));
    let third = rate(plus(w, 0.5 * h, second));
    let fourth = rate(plus(w, h, third));
    let sum = plus(plus(first, 2.0, second), 1.0, plus(fourth, 2.0, third));
    plus(w, h / 6.0, sum)
}

/// Angular momentum turned by the rotation of a step: the explicit method of a Lie group, which keeps its magnitude but not the energy.
pub fn lie_euler(body: &Free, w: [f64; 3], h: f64) -> [f64; 3] {
    let angle = h * dot(w, w).sqrt();
    let axis = w.map(|part| part / dot(w, w).sqrt());
    let momentum = times(&body.tensor, w);
    let (sin, cos) = (-angle).sin_cos();
    let along = dot(axis, momentum);
    let turned =
        plus(plus(momentum.map(|part| cos * part), sin, cross(axis, momentum)), (1.0 - cos) * along, axis);
    times(&body.inverse, turned)
}

/// Rows `t, w` of a method, every so many steps.
pub fn rows(
    body: &Free,
    start: [f64; 3],
    step: Step,
    [h, duration]: [f64; 2],
    every: usize,
) -> Vec<[f64; 4]> {
    let mut w = start;
    let mut rows = Vec::new();
    for k in 0..=(duration / h).round() as usize {
        if k % every == 0 {
            rows.push([k as f64 * h, w[0], w[1], w[2]]);
        }
        w = step(body, w, h);
    }
    rows
}

pub fn csv(heading: &str, rows: &[[f64; 4]], number: impl Fn(f64) -> String) -> String {
    let mut text = format!("{heading}\n");
    for row in rows {
        writeln!(text, "{}", row.map(&number).join(",")).unwrap();
    }
    text
}

pub fn significant(digits: usize) -> impl Fn(f64) -> String {
    move |value| format!("{value:.*e}", digits - 1)
}
