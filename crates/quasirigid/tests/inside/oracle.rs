//! A rigid body with a flywheel, a ball and a wheel, in equations written for them alone.

use nalgebra::{Matrix3, Vector3};

/// Body with its internal elements; the inertia counts everything as locked.
pub struct Gyrostat {
    pub inertia: Matrix3<f64>,
    /// Axis, inertia and friction.
    pub flywheel: (Vector3<f64>, f64, f64),
    /// Inertia and friction.
    pub ball: (f64, f64),
    /// Angular momentum of the wheel at a time.
    pub wheel: fn(f64) -> Vector3<f64>,
}

/// Angular momentum of all, axial one of the flywheel, and that of the ball: body axes.
#[derive(Clone, Copy)]
pub struct State {
    pub K: Vector3<f64>,
    pub axial: f64,
    pub ball: Vector3<f64>,
}

impl Gyrostat {
    /// State from the spin and the speeds of flywheel and ball relative to the body.
    pub fn state(&self, omega: Vector3<f64>, speed: f64, ball: Vector3<f64>) -> State {
        let (axis, inertia, _) = self.flywheel;
        State {
            K: self.inertia * omega + inertia * speed * axis + self.ball.0 * ball + (self.wheel)(0.0),
            axial: inertia * (speed + axis.dot(&omega)),
            ball: self.ball.0 * (omega + ball),
        }
    }

    /// Angular velocity of the carrier, from the rest of the angular momentum.
    pub fn spin(&self, t: f64, state: &State) -> Vector3<f64> {
        let (axis, inertia, _) = self.flywheel;
        let loose =
            self.inertia - inertia * axis * axis.transpose() - Matrix3::from_diagonal_element(self.ball.0);
        let rest = state.K - state.axial * axis - state.ball - (self.wheel)(t);
        loose.lu().solve(&rest).unwrap()
    }

    fn rate(&self, t: f64, state: &State) -> State {
        let omega = self.spin(t, state);
        let (axis, inertia, friction) = self.flywheel;
        State {
            K: state.K.cross(&omega),
            axial: -friction * (state.axial / inertia - axis.dot(&omega)),
            ball: state.ball.cross(&omega) - self.ball.1 * (state.ball / self.ball.0 - omega),
        }
    }

    /// The state at the end of so many equal steps of the classical fourth-order method.
    pub fn after(&self, mut state: State, end: f64, steps: u32) -> State {
        let h = end / f64::from(steps);
        let along = |state: &State, rate: &State, h: f64| State {
            K: state.K + h * rate.K,
            axial: state.axial + h * rate.axial,
            ball: state.ball + h * rate.ball,
        };
        for step in 0..steps {
            let t = h * f64::from(step);
            let a = self.rate(t, &state);
            let b = self.rate(t + 0.5 * h, &along(&state, &a, 0.5 * h));
            let c = self.rate(t + 0.5 * h, &along(&state, &b, 0.5 * h));
            let d = self.rate(t + h, &along(&state, &c, h));
            for (rate, weight) in [(a, 1.0), (b, 2.0), (c, 2.0), (d, 1.0)] {
                state = along(&state, &rate, weight * h / 6.0);
            }
        }
        state
    }
}
