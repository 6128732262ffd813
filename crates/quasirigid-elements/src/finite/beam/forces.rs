//! Internal forces of a beam element under end loads and loads between its nodes.
//! They are the stress of the geometric stiffness: loads between the nodes must be in them, or centrifugal stiffening converges slowly.
//! Equation (K6), docs/theory/12-structures.md.

use nalgebra::Vector3;

use super::Vector12;
use super::element::Beam;
use super::interpolation::Plane;

/// Internal forces of a beam: action of the part beyond a section on the part before it, in the axes of the body.
pub(super) struct Forces<'a> {
    beam: &'a Beam,
    planes: [Plane; 2],
    /// Forces (N) and moments (N·m) of the six strains.
    springs: [f64; 6],
    /// Load (N/m) at the middle, and its change over the length.
    load: [Vector3<f64>; 2],
    /// Moment (N).
    moment: Vector3<f64>,
}

/// A load per length of a beam.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Load {
    /// Force (N/m) at the first node and the second, linear between them.
    pub force: [Vector3<f64>; 2],
    /// Moment (N·m/m), uniform.
    pub moment: Vector3<f64>,
}

impl Load {
    /// A load without a moment.
    #[cfg(test)]
    pub fn of(force: [Vector3<f64>; 2]) -> Self {
        Self { force, ..Self::default() }
    }
}

impl Beam {
    /// Internal forces of a displacement under a load.
    pub(super) fn forces(&self, u: &Vector12, Load { force: load, moment }: Load) -> Forces<'_> {
        Forces {
            beam: self,
            planes: self.planes(),
            springs: self.springs().map(|(strain, stiffness)| stiffness * (strain * u).x),
            load: [0.5 * (load[0] + load[1]), load[1] - load[0]],
            moment,
        }
    }
}

impl Forces<'_> {
    /// Force and moment at `x = (½ + t) L`.
    ///
    /// The springs give the internal forces of forces at the nodes, `M = S + 2tA` and `V = −M′`. A load `p + t δ` with a moment `μ`, along
    /// the beam and about an axis across it, adds those of a beam fixed at both nodes, which do no work on the strains of the springs:
    ///
    /// ```text
    /// N = −L [p t + δ (½ t² − 1/24)],     T = −L μ t
    /// V = −L [p t + δ (½ t² − c)] − μ/(1 + φ),     c = (1/40 + φ/24)/(1 + φ)
    /// M = L² [p (½ t² − 1/24) + δ (t³/6 − c t)] − L μ t φ/(1 + φ)
    /// ```
    pub fn at(&self, t: f64) -> [Vector3<f64>; 2] {
        let [axis, ..] = self.beam.directions();
        let length = self.beam.length;
        let [stretch, twist, even_y, odd_y, even_z, odd_z] = self.springs;
        let [mean, change] = self.load.map(|load| load.dot(&axis));
        let straight = mean * t + change * (0.5 * t * t - 1.0 / 24.0);
        let mut force = (stretch - length * straight) * axis;
        let mut moment = (twist - length * t * self.moment.dot(&axis)) * axis;
        for (plane, [even, odd]) in self.planes.iter().zip([[even_y, odd_y], [even_z, odd_z]]) {
            let [mean, change] = self.load.map(|load| load.dot(&plane.across));
            let c = (1.0 / 40.0 + plane.phi / 24.0) / (1.0 + plane.phi);
            let shear = mean * t + change * (0.5 * t * t - c);
            let bending = mean * (0.5 * t * t - 1.0 / 24.0) + change * (t * t / 6.0 - c) * t;
            let turning = self.moment.dot(&plane.about) / (1.0 + plane.phi);
            let bending = length * length * bending - length * t * plane.phi * turning;
            force += (-2.0 * odd / length - length * shear - turning) * plane.across;
            moment += (even + 2.0 * t * odd + bending) * plane.about;
        }
        [force, moment]
    }
}
