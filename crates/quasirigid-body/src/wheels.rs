use crate::math::expression::Expression;
use crate::math::scalar::Smooth;
use crate::math::taylor::Taylor;
use crate::math::vec3::{add, scale};

/// Momentum wheels of a body: motors keep them at given speeds relative to the body. (C4)
///
/// The inertia of the body includes the locked wheels; the wheels add an angular momentum independent of the angular velocity.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Wheels {
    /// Angular momentum relative to the body of the wheels of constant speed (N·m·s), body axes.
    pub constant: [f64; 3],
    /// Wheels of prescribed speed.
    pub driven: Vec<DrivenWheel>,
}

/// Momentum wheel of prescribed speed.
#[derive(Clone, Debug, PartialEq)]
pub struct DrivenWheel {
    /// Axial inertia times axis (kg·m²), body axes.
    pub inertia: [f64; 3],
    /// Speed relative to the body (rad/s): an expression of the single variable `t`.
    pub speed: Expression,
}

impl Wheels {
    /// True if no wheel has an angular momentum relative to the body.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.constant == [0.0; 3] && self.driven.is_empty()
    }

    /// Adds other wheels of the same body.
    pub fn add(&mut self, other: Self) {
        self.constant = add(self.constant, other.constant);
        self.driven.extend(other.driven);
    }

    /// Angular momentum `k` of the wheels relative to the body at a time (N·m·s), body axes. (C4)
    #[must_use]
    pub fn angular_momentum<T: Smooth>(&self, t: T) -> [T; 3] {
        let driven =
            self.driven.iter().map(|wheel| scale(wheel.speed.value(&[t]), wheel.inertia.map(T::from)));
        driven.fold(self.constant.map(T::from), add)
    }

    /// Rate `k̇` of the angular momentum relative to the body at a time (N·m): the torque of the motors on the wheels beyond that of the
    /// rotation with the body.
    #[must_use]
    pub fn torque(&self, t: f64) -> [f64; 3] {
        if self.driven.is_empty() {
            return [0.0; 3];
        }
        self.angular_momentum(Taylor::<2>::variable(t)).map(|k| k.coefficient(1))
    }
}
