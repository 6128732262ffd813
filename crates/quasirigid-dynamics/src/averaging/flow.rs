//! Flow of materials under the mean load of a rotation: laws without a modulus at rest give way to it without end.
//! Equation (G21), docs/theory/11-materials.md.

use nalgebra::{DMatrix, DVector};

use super::loaded_modes::LoadedMode;
use super::response::Law;
use super::{FreeRotation, Response};
use crate::math::sym3::Sym;
use crate::model::Dissipator;

/// Flow of a material under the mean load of a rotation. (G21)
#[derive(Clone, Debug, PartialEq)]
pub struct MaterialFlow {
    /// Name of the dissipator whose dashpot in series is the fastest.
    pub name: String,
    /// Time (s) after which the inertia tensor has changed by the share asked for.
    pub time: f64,
}

/// Factors beside the times of the dashpots between which a time is sought.
const WIDEST: f64 = 1e12;
/// Halvings of its logarithm.
const HALVINGS: usize = 60;

impl Response {
    /// Time after which the materials that flow without end under the mean load of a rotation have changed the inertia tensor by a share of the
    /// difference between its greatest and its least moment; none where it never changes so much. (G21)
    #[must_use]
    pub fn material_flow(&self, motion: &FreeRotation, share: f64) -> Option<MaterialFlow> {
        let viscous = |part: &Dissipator| part.loss.as_ref()?.rheology.viscous_time();
        let times = self.dissipators.iter().filter_map(|part| Some((viscous(part)?, &part.name)));
        let (fastest, name) = times.clone().min_by(|a, b| a.0.total_cmp(&b.0))?;
        let slowest = times.map(|(time, _)| time).fold(fastest, f64::max);
        let [least, _, greatest] = self.principal().moments;
        let load = self.mean_load(motion);
        let elastic = self.held_at(&load, f64::INFINITY)?;
        let beyond = |logarithm: f64| {
            let held = self.held_at(&load, (-logarithm).exp())?;
            Some(self.change(&(held - &elastic)) > share * (greatest - least))
        };
        let (mut before, mut after) = ((fastest / WIDEST).ln(), (slowest * WIDEST).ln());
        if !beyond(after)? {
            return None;
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (before + after);
            if beyond(middle)? { after = middle } else { before = middle }
        }
        Some(MaterialFlow { name: name.clone(), time: after.exp() })
    }

    /// Mean load on each elastic row over a rotation; zero on the others.
    fn mean_load(&self, motion: &FreeRotation) -> DVector<f64> {
        let products = motion.mean_products();
        let on = |load: &Sym| load.iter().zip(products).map(|(load, product)| load * product).sum::<f64>();
        DVector::from_iterator(
            self.rows.len(),
            self.rows.iter().map(|row| if row.square > 0.0 { on(&row.load) } else { 0.0 }),
        )
    }

    /// Amplitudes of the rows that hold a load with every flowing law at a real frequency `s` (1/s); none where nothing holds it.
    fn held_at(&self, load: &DVector<f64>, s: f64) -> Option<DVector<f64>> {
        let held = |row: &LoadedMode| if row.square > 0.0 { row.square } else { 1.0 };
        let mut stiffness =
            DMatrix::from_diagonal(&DVector::from_iterator(self.rows.len(), self.rows.iter().map(held)));
        for loss in &self.losses {
            let Law::Material(rheology) = &loss.law else { continue };
            if rheology.viscous_time().is_some() && s.is_finite() {
                stiffness += (rheology.continued([s, 0.0])[0] - 1.0) * &loss.matrix;
            }
        }
        let found = stiffness.lu().solve(load)?;
        found.iter().all(|amplitude| amplitude.is_finite()).then_some(found)
    }

    /// Size (kg·m²) of the change of the inertia tensor by amplitudes of the rows.
    fn change(&self, amplitudes: &DVector<f64>) -> f64 {
        let mut change = [0.0; 6];
        for (row, amplitude) in self.rows.iter().zip(amplitudes) {
            change.iter_mut().zip(row.load).for_each(|(sum, load)| *sum += amplitude * load);
        }
        let [xx, yy, zz, yz, zx, xy] = change;
        // a load is half of the derivative of a moment, and a whole one of a product, which stands twice in the tensor
        let diagonal: f64 = [xx, yy, zz].iter().map(|half| 4.0 * half * half).sum();
        let products: f64 = [yz, zx, xy].iter().map(|product| 2.0 * product * product).sum();
        (diagonal + products).sqrt()
    }
}
