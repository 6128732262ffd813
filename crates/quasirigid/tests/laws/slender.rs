//! Bodies of extreme moments: every time is found with bounded work, and to the accuracy that is claimed.

use std::sync::atomic::{AtomicU32, Ordering};

use quasirigid::averaging::{Evolution, FreeRotation, MeanPower, RotationState};
use quasirigid::model::Mode;

/// A loss by the products of the spin, `Σ c (ω_i ω_j)²`, averaged by sums over the polhode.
#[derive(Debug)]
struct Products {
    moments: [f64; 3],
    calls: AtomicU32,
}

impl MeanPower for Products {
    fn moments(&self) -> [f64; 3] {
        self.moments
    }

    fn mean_power(&self, motion: &FreeRotation) -> f64 {
        self.calls.fetch_add(1, Ordering::Relaxed);
        motion.mean(4, |[x, y, z]| (y * z).powi(2) + 2.0 * (z * x).powi(2) + 3.0 * (x * y).powi(2))
    }
}

/// From one axis through the separatrix to the other, in one piece and in two.
#[test]
fn times_of_slender_bodies_are_found() {
    for slenderness in [1e-3, 1e-6, 1e-9] {
        for gap in [0.3, 1e-3, 1e-6, 1e-8] {
            let power = Products { moments: [slenderness, 1.0 - gap, 1.0], calls: AtomicU32::new(0) };
            let evolution = Evolution::new(&power, 1.0);
            for end in [1.0, 20.0, 36.0, 300.0] {
                let [from, to] =
                    [Mode::LongAxis, Mode::ShortAxis].map(|mode| RotationState { mode, xi: end });
                let middle = RotationState { mode: Mode::ShortAxis, xi: 0.5 };
                let whole = evolution.passage(from, to);
                let parts = [evolution.passage(from, middle), evolution.passage(middle, to)];
                let sum: f64 = parts.iter().map(|part| part.time).sum();
                assert!(whole.time > 0.0 && whole.time.is_finite(), "{slenderness} {gap} {end}: {whole:?}");
                assert!(
                    (sum / whole.time - 1.0).abs() < 1e-9,
                    "{slenderness} {gap} {end}: {whole:?} {parts:?}"
                );
                assert!(whole.error < 1e-9 * whole.time, "{slenderness} {gap} {end}: {whole:?}");
                let calls = power.calls.swap(0, Ordering::Relaxed);
                assert!(calls < 20_000, "{slenderness} {gap} {end}: {calls}");
            }
        }
    }
}
