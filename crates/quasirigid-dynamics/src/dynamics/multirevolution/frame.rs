//! Equations of the motion in the axes of a section. Next to its axis, components across it keep the digits that those along turned axes lose.
//! Equation (P9), docs/theory/05-propagation.md.

use nalgebra::{Matrix3, Rotation3, UnitQuaternion};

use super::revolution::Motion;
use crate::dynamics::form::AngularMomentumForm;
use crate::dynamics::steady::IsolatedSpin;
use crate::math::ode::Checkpoint;
use crate::math::rotation::{self, Attitude};
use crate::math::sphere::{StationaryKind, tangents};
use crate::math::vec3::{cross, dot, norm, scale};
use crate::model::ReducedBody;

/// Axes of a section, `d`, `e × d` and `e` in body axes, with the equations in them.
#[derive(Debug)]
pub(super) struct Frame {
    axes: [[f64; 3]; 3],
    /// Attitude of the axes in the body.
    attitude: Attitude,
    equations: AngularMomentumForm,
}

impl Frame {
    /// Axes of sections about the steady spins that others circle, the nearest to an angular momentum first. The sections pass the saddles,
    /// where the motion is slow, at a right angle.
    pub fn axes_about(spins: &[IsolatedSpin], K: [f64; 3]) -> Vec<[[f64; 3]; 3]> {
        let direction =
            |spin: &IsolatedSpin| scale(norm(spin.angular_momentum).recip(), spin.angular_momentum);
        let saddle = |spin: &&IsolatedSpin| spin.kind == StationaryKind::Saddle;
        let mut circled: Vec<_> = spins.iter().filter(|spin| !saddle(spin)).map(direction).collect();
        circled.sort_by(|a, b| dot(*b, K).total_cmp(&dot(*a, K)));
        let saddles: Vec<_> = spins.iter().filter(saddle).map(direction).collect();
        let axes = |e: [f64; 3]| {
            let nearest = saddles.iter().max_by(|a, b| dot(**a, e).total_cmp(&dot(**b, e)));
            let d = match nearest.map(|saddle| cross(*saddle, e)) {
                Some(across) if norm(across) > 0.0 => scale(norm(across).recip(), across),
                _ => tangents(e)[0],
            };
            [d, cross(e, d), e]
        };
        circled.into_iter().map(axes).collect()
    }

    pub fn new(body: &ReducedBody, axes: [[f64; 3]; 3]) -> Self {
        let matrix = Rotation3::from_matrix_unchecked(Matrix3::from(axes));
        let turn = UnitQuaternion::from_rotation_matrix(&matrix);
        Self {
            axes,
            attitude: [turn.w, turn.i, turn.j, turn.k],
            equations: AngularMomentumForm::in_axes(body, axes),
        }
    }

    /// The equations, as those of a motion.
    pub fn motion<'m, A>(&'m self, motion: &Motion<'m, A>) -> Motion<'m, A> {
        Motion { equations: &self.equations, work: motion.work, arithmetic: motion.arithmetic }
    }

    /// Components of a vector of the body in these axes.
    pub fn inside(&self, vector: [f64; 3]) -> [f64; 3] {
        self.axes.map(|axis| dot(axis, vector))
    }

    /// Components of a vector in body axes.
    pub fn outside(&self, vector: [f64; 3]) -> [f64; 3] {
        rotation::to_inertial(self.attitude, vector)
    }

    /// Attitude of these axes in a body of an attitude.
    pub fn attitude_inside(&self, body: Attitude) -> Attitude {
        rotation::product(body, self.attitude)
    }

    /// Attitude of the body whose axes these have an attitude.
    pub fn attitude_outside(&self, attitude: Attitude) -> Attitude {
        let [s, x, y, z] = self.attitude;
        rotation::product(attitude, [s, -x, -y, -z])
    }

    pub fn save(&self, checkpoint: &mut Checkpoint) {
        self.axes.iter().for_each(|axis| checkpoint.save_list(axis));
    }

    pub fn load(checkpoint: &mut Checkpoint, body: &ReducedBody) -> Option<Self> {
        let mut axes = [[0.0; 3]; 3];
        axes.iter_mut().try_for_each(|axis| checkpoint.load_into(axis))?;
        Some(Self::new(body, axes))
    }
}
