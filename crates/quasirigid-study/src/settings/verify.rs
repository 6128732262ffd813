//! Settings of verifications: about rest, and about a steady spin.

use quasirigid::submanifold::SpinManifoldPlan;
use quasirigid::verification::{SpinVerificationPlan, VerificationPlan};
use quasirigid_io::model::{PartialSpinManifold, PartialVerify};

use crate::study::Study;

/// Amplitude (rad), degrees, halvings, periods and number of times of a verification about the spin without given ones.
const AMPLITUDE: f64 = 0.05;
const DEGREES: [usize; 3] = [1, 2, 3];
const HALVINGS: usize = 3;
const PERIODS: f64 = 1.0;
const SAMPLES: usize = 50;

/// Settings of a verification about the spin, as far as a source gives them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PartialSpinVerify {
    /// Masters and style; the degree is not read.
    pub spin_manifold: PartialSpinManifold,
    /// Degrees as orders, periods of the nutation as revolutions, and halvings of the amplitude.
    pub verify: PartialVerify,
    /// Largest amplitude of the nutation (rad).
    pub amplitude: Option<f64>,
}

impl PartialSpinVerify {
    /// Plan of the verification of equations; of the file's `verify`, which is about rest, it takes nothing.
    pub(crate) fn resolve(&self, about: SpinManifoldPlan) -> SpinVerificationPlan {
        let PartialVerify { revolutions, orders, halvings } = self.verify.clone();
        SpinVerificationPlan {
            about,
            degrees: orders.unwrap_or_else(|| DEGREES.into()),
            amplitude: self.amplitude.unwrap_or(AMPLITUDE),
            halvings: halvings.unwrap_or(HALVINGS),
            periods: revolutions.unwrap_or(PERIODS),
            samples: SAMPLES,
        }
    }
}

impl Study {
    /// Plan of a verification: as asked for, or as the file asks; by default every order up to the model's from the highest
    /// one that is the rigid body: 0 with rotors and liquids, 1 with springs alone.
    #[must_use]
    pub fn verification_plan(&self, asked: PartialVerify) -> VerificationPlan {
        let lowest = usize::from(self.body.cyclic().is_empty());
        let file = self.model.run.verify.clone().unwrap_or_default();
        let PartialVerify { revolutions, orders, halvings } = asked.or(file);
        let usual = VerificationPlan::default();
        VerificationPlan {
            orders: orders.unwrap_or_else(|| (lowest..=self.order).collect()),
            rotations: revolutions.unwrap_or(usual.rotations),
            halvings: halvings.unwrap_or(usual.halvings),
            ..usual
        }
    }
}
