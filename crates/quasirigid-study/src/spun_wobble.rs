//! Start with a wobble that a body has when its spin has deformed it and the vibrations of the start have died out.
//! Equations (Q2), (Q8) and (Q21), docs/theory/16-methods.md.

use quasirigid::averaging::{FreeRotation, RotationState};
use quasirigid::dynamics::Start;
use quasirigid::model::{FlexibleBody, Mode, Principal};
use quasirigid::modes::{RelativeEquilibrium, SpinMagnitude};
use quasirigid::secular::{EnergyRange, SettledStarts};
use quasirigid_math::vec3::{add, norm, scale};

use crate::error::StudyError;
use crate::motion::Motion;
use crate::study::Study;

/// Share of a wobble by which its steady spin may be tilted without a difference.
const UNTILTED: f64 = 1e-4;

/// Difference of a place `ξ`, and of an angular momentum relative to itself, that is none; corrections of a start at most.
const SETTLED: f64 = 1e-9;
const KEPT: f64 = 1e-12;
const CORRECTIONS: usize = 60;

/// Wobble about the steady spin of the deformed body. (Q8)
pub struct SpunWobble {
    range: EnergyRange,
    place: RotationState,
    /// Angular momentum (N·m·s) of the body in balance.
    angular_momentum: [f64; 3],
}

impl SpunWobble {
    /// Wobble of this angle (rad) at this rate (rad/s) of the steady spin; none where the frozen body has the same, or no such steady spin is found
    /// whose springs withstand it. (Q8)
    pub fn of(
        body: &FlexibleBody,
        frozen: ([f64; 3], [f64; 3]),
        (angle, rate, mode): (f64, f64, Mode),
    ) -> Option<Self> {
        if !body.wheels().is_empty() {
            return None;
        }
        let principal = Principal::compute(body.invariants().J);
        let [least, middle, greatest] = principal.moments;
        let apart = (middle - least).min(greatest - middle).max(f64::EPSILON * greatest);
        let bulge = body.balanced(frozen.1).map_or(f64::INFINITY, |balanced| {
            let spun = body.full_inertia_at(&balanced.q);
            let changes = spun.iter().zip(body.invariants().J).map(|(spun, J)| (spun - J).powi(2));
            changes
                .zip([1.0, 1.0, 1.0, 2.0, 2.0, 2.0])
                .map(|(square, entries)| entries * square)
                .sum::<f64>()
                .sqrt()
        });
        if bulge <= UNTILTED * angle * apart {
            return None;
        }
        let axis = principal.axes[mode.circled()];
        let steady = RelativeEquilibrium::near(body, axis, SpinMagnitude::Rate(rate)).ok()?;
        if !steady.is_firm(body) {
            return None;
        }
        let range = EnergyRange::compute(body, norm(steady.angular_momentum)).ok()?;
        let place = FreeRotation::logit_of(range.moments(), mode, angle);
        let place = RotationState { mode, xi: place };
        let angular_momentum = range.state(body, place)?.angular_momentum(body);
        Some(Self { range, place, angular_momentum })
    }

    /// Start from which this wobble is left when the vibrations have died out, by the starts that angular momenta give; these follow a series, whose
    /// angular momentum is another where parts swing slowly. (Q2), (Q21)
    pub fn start(
        &self,
        study: &Study,
        started: impl Fn([f64; 3]) -> Result<Start, StudyError>,
    ) -> Result<Start, StudyError> {
        let Self { range, place: RotationState { mode, xi }, angular_momentum } = self;
        let first = started(*angular_momentum)?;
        let Some(starts) = SettledStarts::derive(&study.body, range, *mode, *angular_momentum) else {
            return Ok(first);
        };
        let (mut place, mut lean) = (*xi, [0.0; 3]);
        for _ in 0..CORRECTIONS {
            let balanced = range.state(&study.body, RotationState { mode: *mode, xi: place });
            let Some(balanced) = balanced else { return Ok(first) };
            let wanted = balanced.angular_momentum(&study.body);
            let start = started(add(wanted, lean))?;
            let full = Motion::new(study, start).full()?;
            let gap = add(wanted, scale(-1.0, full.angular_momentum(&study.body)));
            if norm(gap) > KEPT * norm(wanted) {
                lean = add(lean, gap);
                continue;
            }
            let Some(settled) = starts.rotation_state(&full) else { return Ok(first) };
            if (settled.xi - xi).abs() <= SETTLED {
                return Ok(start);
            }
            place += xi - settled.xi;
        }
        Ok(first)
    }
}
