use super::poinsot::FreeRotation;
use crate::math::polynomial::Series;
use crate::model::{Mode, Principal, ReducedBody};

/// How the rotation of a free body ages: its energy falls at the mean power of its dashpots while `|K|` stays. (A6)
#[derive(Clone, Debug)]
pub struct Evolution<'a> {
    power: &'a Series,
    principal: Principal,
    G: f64,
}

/// A state of rotation at a given `|K|`: a mode, and the place `ξ` between the separatrix, `−∞`, and the axis, `+∞`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stage {
    /// Axis that the momentum circles.
    pub mode: Mode,
    /// `ln` of the distance of `D` from the separatrix over that from the axis.
    pub xi: f64,
}

/// Distance from the separatrix, as `ξ`, below which nothing is left to integrate: `e^{−42}`.
const SEPARATRIX: f64 = -42.0;
/// Length of a panel in `ξ`, and the nodes and weights of Gauss's rule on it.
const PANEL: f64 = 2.0;
const NODES: [[f64; 2]; 10] = [
    [-0.973_906_528_517_171_7, 0.066_671_344_308_688_1],
    [-0.865_063_366_688_984_5, 0.149_451_349_150_580_6],
    [-0.679_409_568_299_024_4, 0.219_086_362_515_982_04],
    [-0.433_395_394_129_247_2, 0.269_266_719_309_996_35],
    [-0.148_874_338_981_631_2, 0.295_524_224_714_752_87],
    [0.148_874_338_981_631_2, 0.295_524_224_714_752_87],
    [0.433_395_394_129_247_2, 0.269_266_719_309_996_35],
    [0.679_409_568_299_024_4, 0.219_086_362_515_982_04],
    [0.865_063_366_688_984_5, 0.149_451_349_150_580_6],
    [0.973_906_528_517_171_7, 0.066_671_344_308_688_1],
];

impl<'a> Evolution<'a> {
    /// The evolution of a free body with the angular momentum `G` (N·m·s).
    #[must_use]
    pub fn new(body: &'a ReducedBody, G: f64) -> Self {
        Self { power: &body.power, principal: Principal::of(body.J), G }
    }

    /// Mean power dissipated (W). (A5)
    #[must_use]
    pub fn power(&self, stage: Stage) -> f64 {
        self.mean_power(&self.motion(stage))
    }

    fn motion(&self, Stage { mode, xi }: Stage) -> FreeRotation {
        FreeRotation::at_logit(self.principal.moments, self.G, mode, xi)
    }

    fn mean_power(&self, motion: &FreeRotation) -> f64 {
        let [x, y, z] = self.principal.axes;
        let spin = |omega: [f64; 3]| [0, 1, 2].map(|i| omega[0] * x[i] + omega[1] * y[i] + omega[2] * z[i]);
        motion.mean(self.power.degree(), |omega| self.power.scalar(spin(omega)))
    }

    /// The stage with this `D/I₃`; none outside of `I₁/I₃` to 1, or at an axis, where nothing ages.
    #[must_use]
    pub fn stage(&self, ratio: f64) -> Option<Stage> {
        let [I1, I2, I3] = self.principal.moments;
        let D = ratio * I3;
        let (mode, from_separatrix, from_axis) =
            if D >= I2 { (Mode::ShortAxis, D - I2, I3 - D) } else { (Mode::LongAxis, I2 - D, D - I1) };
        (from_axis > 0.0).then(|| Stage { mode, xi: (from_separatrix / from_axis).ln() })
    }

    /// Time (s) from one stage to another, negative if the second is the earlier; infinite where nothing is dissipated. (A6)
    #[must_use]
    pub fn time(&self, from: Stage, to: Stage) -> f64 {
        match (from.mode, to.mode) {
            (Mode::ShortAxis, Mode::ShortAxis) => self.along(Mode::ShortAxis, from.xi, to.xi),
            (Mode::LongAxis, Mode::LongAxis) => self.along(Mode::LongAxis, to.xi, from.xi),
            (Mode::LongAxis, Mode::ShortAxis) => {
                self.along(Mode::LongAxis, SEPARATRIX, from.xi)
                    + self.along(Mode::ShortAxis, SEPARATRIX, to.xi)
            }
            (Mode::ShortAxis, Mode::LongAxis) => -self.time(to, from),
        }
    }

    /// Time (s) that lies between two places of a mode; negative if the second is nearer the separatrix.
    fn along(&self, mode: Mode, from: f64, to: f64) -> f64 {
        let panels = ((to - from).abs() / PANEL).ceil().max(1.0);
        let half = 0.5 * (to - from) / panels;
        let sum = |panel: usize| -> f64 {
            let middle = from + half * (2 * panel + 1) as f64;
            NODES.iter().map(|[node, weight]| weight * self.slowness(mode, middle + half * node)).sum()
        };
        half * (0..panels as usize).map(sum).sum::<f64>()
    }

    /// `|dE/dξ|` over the power (s).
    fn slowness(&self, mode: Mode, xi: f64) -> f64 {
        let motion = self.motion(Stage { mode, xi });
        motion.energy_slope() / self.mean_power(&motion)
    }
}
