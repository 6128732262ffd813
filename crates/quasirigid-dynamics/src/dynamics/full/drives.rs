//! Driven coordinates in the full equations: their laws in place of their components of a state, and the work of the drives.
//! Equations (T7) to (T9), docs/theory/08-full-system.md.

use crate::math::ode::Stretch;
use crate::model::{Drive, FlexibleBody};

/// Drives of a body. The components of their coordinates and momenta in a state steer nothing. (T7)
#[derive(Clone, Debug)]
pub(super) struct Drives<'a> {
    drives: &'a [Drive],
    /// Value, rate and acceleration of each law at the time set last.
    laws: Vec<[f64; 3]>,
    /// Coordinates at that time, the driven ones by their laws.
    q: Vec<f64>,
    /// Momenta of the driven coordinates in the motion set last.
    momenta: Vec<f64>,
}

impl<'a> Drives<'a> {
    /// Drives of a body; none of one without.
    pub fn of(body: &'a FlexibleBody) -> Option<Self> {
        let drives = body.drives();
        let (laws, q) = (vec![[0.0; 3]; drives.len()], vec![0.0; body.coordinates().len()]);
        (!drives.is_empty()).then(|| Self { drives, laws, q, momenta: vec![0.0; drives.len()] })
    }

    /// Sets the time (s) and the coordinates, of which the driven ones are by their laws. (T7)
    pub fn set(&mut self, t: f64, q: &[f64]) {
        self.q.copy_from_slice(q);
        for (drive, law) in self.drives.iter().zip(&mut self.laws) {
            *law = drive.at(t);
            self.q[drive.coordinate] = law[0];
        }
    }

    /// Coordinates set last.
    pub fn q(&self) -> &[f64] {
        &self.q
    }

    /// Rates of the driven coordinates.
    pub fn rates(&self) -> impl Iterator<Item = f64> {
        self.laws.iter().map(|[_, rate, _]| *rate)
    }

    /// Notes the momenta of the driven coordinates. (T8)
    pub fn note(&mut self, momenta: impl Iterator<Item = f64>) {
        self.momenta.iter_mut().zip(momenta).for_each(|(own, momentum)| *own = momentum);
    }

    /// Momenta with those noted in place of those of the driven coordinates.
    pub fn momenta(&self, p: &[f64]) -> Vec<f64> {
        let mut p = p.to_vec();
        self.drives.iter().zip(&self.momenta).for_each(|(drive, momentum)| p[drive.coordinate] = *momentum);
        p
    }

    /// Part `p u` of the work of the drives (J) at the motion noted last. (T9)
    pub fn carried(&self) -> f64 {
        self.momenta.iter().zip(&self.laws).map(|(momentum, [_, rate, _])| momentum * rate).sum()
    }

    /// Rate (W) of the rest of that work, under these loads on the coordinates, of which those on driven ones are taken: nothing else asks for
    /// them. (T9)
    pub fn rest_of_power(&self, loads: &mut [f64]) -> f64 {
        let drives = self.drives.iter().zip(&self.momenta).zip(&self.laws);
        let each = drives.map(|((drive, momentum), [_, rate, acceleration])| {
            let load = std::mem::take(&mut loads[drive.coordinate]);
            -(momentum * acceleration + load * rate)
        });
        each.sum()
    }

    /// Time as far beyond the end of a stretch as the last one within is before it; none before that end.
    pub fn beyond(stretch: Stretch, t: f64) -> Option<f64> {
        (t >= stretch.to).then(|| t + (t - stretch.within(t)))
    }

    /// Rates and momenta of the driven coordinates in the motion noted last.
    pub fn motion(&self) -> Vec<[f64; 2]> {
        self.momenta.iter().zip(&self.laws).map(|(momentum, [_, rate, _])| [*momentum, *rate]).collect()
    }
}

/// Times at which the rates of drives are looked at.
const LOOKS: usize = 64;

/// Size of the energies (J) of driven parts up to an end (s), by which errors of the work of drives are judged; none without drives. (T9)
pub(super) fn energy(body: &FlexibleBody, end: f64) -> Option<f64> {
    let at = |t: f64| {
        let moving = |drive: &Drive| body.invariants().modal_mass(drive.coordinate) * drive.at(t)[1].powi(2);
        body.drives().iter().map(moving).sum::<f64>()
    };
    let looks = (0..=LOOKS).map(|look| at(end * look as f64 / LOOKS as f64));
    (!body.drives().is_empty()).then(|| looks.fold(0.0, f64::max))
}

/// Change of the rest of the work (J) where rates jump, from the momenta and rates before and after. (T9)
pub(super) fn rest_of_jump(before: &[[f64; 2]], after: &[[f64; 2]]) -> f64 {
    let each = before.iter().zip(after).map(|([p0, u0], [p1, u1])| -0.5 * (p0 + p1) * (u1 - u0));
    each.sum()
}
