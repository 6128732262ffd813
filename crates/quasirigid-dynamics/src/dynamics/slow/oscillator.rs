//! Undamped modes of the recoiling body as damped oscillators under a load that is linear in time, followed exactly.
//! Equation (E9), docs/theory/09-forced-reduction.md.

/// Motion of a mode of unit modal mass, `η̈ + d η̇ + Ω² η = f`.
#[derive(Clone, Debug)]
pub(super) struct Oscillator {
    /// Undamped frequency `Ω` (rad/s), zero of a motion without stiffness, and damping `d` (1/s).
    pub frequency: f64,
    pub damping: f64,
    /// Amplitude, which counts where there is a stiffness, and its rate.
    pub value: f64,
    pub rate: f64,
}

impl Oscillator {
    /// Follows the mode over a time (s) in which the load goes evenly from one value to another. (E9)
    pub fn follow(&mut self, time: f64, [from, to]: [f64; 2]) {
        if !(time > 0.0) {
            return;
        }
        let slope = (to - from) / time;
        if self.frequency > 0.0 {
            self.vibrate(time, from, slope);
        } else {
            self.relax(time, [from, to], slope);
        }
    }

    /// With the particular solution `a + b t`.
    fn vibrate(&mut self, time: f64, from: f64, slope: f64) {
        let (square, half) = (self.frequency * self.frequency, 0.5 * self.damping);
        let b = slope / square;
        let a = (from - self.damping * b) / square;
        let [c, s] = swing(half, square, time);
        let (value, rate) = (self.value - a, self.rate - b);
        self.value = (c + half * s) * value + s * rate + a + b * time;
        self.rate = (c - half * s) * rate - square * s * value + b;
    }

    fn relax(&mut self, time: f64, [from, to]: [f64; 2], slope: f64) {
        if self.damping == 0.0 {
            self.rate += 0.5 * time * (from + to);
            return;
        }
        let b = slope / self.damping;
        let a = (from - b) / self.damping;
        self.rate = (-self.damping * time).exp() * (self.rate - a) + a + b * time;
    }
}

/// `e^{−δt} cos νt` and `e^{−δt} sin(νt)/ν`, `ν² = Ω² − δ²`; of an overdamped mode the hyperbolic ones.
fn swing(half: f64, square: f64, time: f64) -> [f64; 2] {
    let inner = square - half * half;
    let angle = inner.abs().sqrt() * time;
    if angle < 1e-6 {
        let fade = (-half * time).exp();
        return [fade, fade * time];
    }
    if inner > 0.0 {
        let ((sine, cosine), fade) = (angle.sin_cos(), (-half * time).exp());
        return [fade * cosine, fade * sine * time / angle];
    }
    // the slow exponent as Ω²/(δ + μ), which does not cancel
    let mu = inner.abs().sqrt();
    let [slow, fast] = [square / (half + mu), half + mu].map(|rate| (-rate * time).exp());
    [0.5 * (slow + fast), 0.5 * (slow - fast) / mu]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A load `f = 2 + 3 t` from rest, in one piece, in many pieces, and by small steps of the midpoint rule.
    #[test]
    fn modes_are_followed_exactly_under_linear_loads() {
        for (frequency, damping) in
            [(7.0, 0.3), (7.0, 14.0), (7.0, 14.0 + 1e-9), (7.0, 90.0), (0.0, 2.0), (0.0, 0.0)]
        {
            let still = Oscillator { frequency, damping, value: 0.1, rate: -0.2 };
            let load = |t: f64| 2.0 + 3.0 * t;
            let followed = |pieces: u32| {
                let mut mode = still.clone();
                let h = 0.8 / f64::from(pieces);
                (0..pieces).map(|i| h * f64::from(i)).for_each(|t| mode.follow(h, [load(t), load(t + h)]));
                mode
            };
            let (mut x, mut v) = (still.value, still.rate);
            let h = 2e-6;
            for i in 0..400_000 {
                let t = h * f64::from(i);
                let force = |x: f64, v: f64, t: f64| load(t) - damping * v - frequency * frequency * x;
                let middle = v + 0.5 * h * force(x, v, t);
                let slope = force(x + 0.5 * h * v, middle, t + 0.5 * h);
                (x, v) = (x + h * middle, v + h * slope);
            }
            for mode in [followed(1), followed(37)] {
                let close = |a: f64, b: f64| (a - b).abs() < 1e-7 * (1.0 + b.abs());
                assert!(close(mode.rate, v), "{frequency} {damping}: {} {v}", mode.rate);
                assert!(
                    frequency == 0.0 || close(mode.value, x),
                    "{frequency} {damping}: {} {x}",
                    mode.value
                );
            }
        }
    }
}
