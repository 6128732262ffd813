//! The end of a history for machines. First paragraphs of the fields are the reference of `--json` in the guide.

use std::collections::BTreeMap;

use quasirigid::dynamics::{Run, Scan};
use quasirigid_io::model::Named;
use serde::Serialize;
use serde_json::{Value, json};

use crate::about_spin::HistoryVerdict;
use crate::free_rotation::FreeRotationObject;
use crate::histories::History;
use crate::words::shares;

/// State at the end.
#[derive(Serialize)]
struct HistoryObject<'a> {
    /// `full`, `reduced`, `rigid` or `manifold`.
    system: &'a str,
    /// How it ended.
    status: &'a str,
    /// In words.
    message: &'a str,
    /// Time (s).
    t: f64,
    /// Angular velocity (rad/s), body axes.
    omega: [f64; 3],
    /// Quaternion.
    attitude: [f64; 4],
    /// Angular momentum (N m s), body axes.
    momentum: [f64; 3],
    /// Energy (J).
    energy: f64,
    /// Energy dissipated (J).
    dissipated: f64,
    /// Shares.
    dissipation: BTreeMap<String, f64>,
    /// Work of forces (J).
    work: f64,
    /// Change of energy by the integrator alone (J).
    energy_drift: f64,
    /// Of `reduced`: energy left in vibrations, and out of `dissipated` (J), (E5).
    left_out: f64,
    /// Of `reduced`: change of external forces by displacements, against the stiffness, (E7).
    load_ratio: f64,
    /// Of `reduced`: error of the angular velocity by vibrations, (E8); absent where it is small.
    #[serde(skip_serializing_if = "Option::is_none")]
    ringing: Option<RingingObject>,
    /// The same of the angular momentum, relative.
    momentum_drift: f64,
    /// ∫|ω| dt/2π.
    turns: f64,
    /// Of the centre of mass (m), inertial axes.
    position: [f64; 3],
    /// Of the same (m/s).
    velocity: [f64; 3],
    /// Pole (m), inertial axes.
    pole: [f64; 3],
    /// Steps accepted.
    steps: u64,
    /// Steps rejected.
    rejected: u64,
    /// Implicit ones.
    implicit_steps: u64,
    /// Of the equations of motion.
    evaluations: u64,
    /// Of matrices.
    factorizations: u64,
    /// Of formulas of `t`.
    scan: ScanObject,
    /// Free rotation that the rigid body would go on in; `null` of a constrained body, of a sphere, and with rotors, liquids or wheels.
    free_rotation: Option<FreeRotationObject>,
    /// Of `manifold` alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    manifold: Option<HistoryVerdict>,
}

/// Error of the angular velocity by vibrations.
#[derive(Serialize)]
struct RingingObject {
    /// First time (s) of an error above 5 %.
    from: f64,
    /// Last one (s).
    to: f64,
    /// Largest error (rad/s).
    omega: f64,
    /// Relative to the largest angular velocity.
    share: f64,
}

/// Search of formulas of time.
#[derive(Serialize)]
struct ScanObject {
    /// Of the formulas.
    evaluations: u64,
    /// Where steps begin anew.
    breakpoints: u64,
    /// That no step passes.
    stops: u64,
}

impl History {
    /// The last state and the integration, for machines.
    #[must_use]
    pub fn json(&self) -> Value {
        let Run { last, work, .. } = &self.run;
        let Scan { evaluations, breakpoints, stops } = self.run.scan;
        json!(HistoryObject {
            system: self.system.recorded(),
            status: self.status,
            message: &self.message,
            t: last.t,
            omega: last.omega,
            attitude: last.attitude,
            momentum: last.angular_momentum,
            energy: last.energy,
            dissipated: last.dissipated,
            dissipation: shares(&self.budget),
            work: last.work,
            energy_drift: last.energy_drift,
            left_out: self.run.left_out,
            load_ratio: self.run.load_ratio,
            ringing: self.run.ringing.map(|ringing| RingingObject {
                from: ringing.from,
                to: ringing.to,
                omega: ringing.omega,
                share: ringing.share,
            }),
            momentum_drift: last.momentum_drift,
            turns: last.revolutions,
            position: last.place,
            velocity: last.velocity,
            pole: last.pole,
            steps: work.steps,
            rejected: work.rejected,
            implicit_steps: work.implicit_steps,
            evaluations: work.evaluations,
            factorizations: work.factorizations,
            scan: ScanObject { evaluations, breakpoints, stops },
            free_rotation: self.free_rotation,
            manifold: self.manifold.as_ref().map(|manifold| manifold.for_machines()),
        })
    }
}
