//! The motion that a model asks for, in each of its systems.

use quasirigid::dynamics::{
    Event, Forced, Form, FullState, MAX_FORCED_ORDER, Observer, Options, PropagateError, Run, SlowState,
    Start, matched_start, propagate, propagate_forced, propagate_full,
};
use quasirigid::model::force::Force;
use quasirigid::model::{FlexibleBody, Marker, ReducedBody, Support};
use quasirigid::reduction::frequencies;
use quasirigid::secular::spun_displacements;
use quasirigid_io::model::Displacements;
use quasirigid_math::vec3::{add, norm, scale};

use crate::about_spin::{self, AskedManifold, OnManifold};
use crate::error::StudyError;
use crate::start::{follows_its_spin, slaved_order};
use crate::study::Study;
use quasirigid_io::model::System;

/// Relative difference between an angular momentum and that of the spin which the series finds for it, from which the
/// series means nothing there.
const CLOSED: f64 = 0.01;

/// Beginning of the notes on a model whose motion [starts displaced](Motion::starts_displaced).
pub const DISPLACED: &str = "What moves inside does not start on the slow manifold";

/// A body with its forces and its initial state.
pub struct Motion<'a> {
    study: &'a Study,
    pub body: &'a FlexibleBody,
    pub forces: &'a [Force<Marker>],
    pub order: usize,
    pub start: Start,
    /// Internal coordinates and rates, where the file gives them.
    displaced: Option<(Vec<f64>, Vec<f64>)>,
    /// Rates of cyclic coordinates, where the file gives them.
    speeds: &'a [(usize, f64)],
}

/// Position and velocity (m, m/s) at the start: of the centre of mass of a free body, of the pole of any other.
pub fn placed(Study { model, body, .. }: &Study) -> ([f64; 3], [f64; 3]) {
    match body.support() {
        Support::Free => (model.initial.position, model.initial.velocity),
        Support::FixedPoint { .. } => ([0.0; 3], [0.0; 3]),
        Support::Prescribed { position, velocity, .. } => (*position, *velocity),
    }
}

impl<'a> Motion<'a> {
    pub fn new(study: &'a Study, spin: Start) -> Self {
        let Study { model, body, forces, speeds, order, .. } = study;
        let (place, velocity) = placed(study);
        let displaced = match &model.initial.displacements {
            Displacements::SlowManifold => None,
            Displacements::Given { q, rate } => {
                let [mut q, mut rate] = [q.clone(), rate.clone()];
                q.resize(body.coordinates().len(), 0.0);
                rate.resize(body.coordinates().len(), 0.0);
                Some((q, rate))
            }
        };
        let start = Start { omega: spin.omega, attitude: spin.attitude, place, velocity };
        Self { study, body, forces, order: *order, start, displaced, speeds }
    }

    pub fn study(&self) -> &'a Study {
        self.study
    }

    pub fn system(&self) -> Forced<'a> {
        Forced { body: self.body, forces: self.forces }
    }

    /// Whether an internal coordinate starts off the slow manifold.
    pub fn starts_displaced(&self) -> bool {
        self.displaced.is_some() || !self.speeds.is_empty()
    }

    /// Follows one of the systems; of the reduced equations about the spin also their verdict.
    pub fn follow(
        &self,
        system: System,
        manifold: &AskedManifold,
        times: &[f64],
        options: &Options,
        observer: &mut dyn Observer,
    ) -> Result<(Run, Option<OnManifold>), StudyError> {
        if system == System::Manifold {
            let (run, verdict) = about_spin::follow(self, manifold, times, options, observer)?;
            return Ok((run, Some(verdict)));
        }
        Ok((self.follow_body(system, times, options, observer)?, None))
    }

    fn follow_body(
        &self,
        system: System,
        times: &[f64],
        options: &Options,
        observer: &mut dyn Observer,
    ) -> Result<Run, StudyError> {
        let order = if system == System::Rigid { 0 } else { self.order };
        match system {
            System::Full => Ok(propagate_full(self.system(), &self.full()?, times, options, observer)?),
            System::Reduced | System::Rigid | System::Manifold if self.system().acts() => {
                let slow = self.slow(order)?;
                let options = if order > 1 { &self.bounded(options)? } else { options };
                Ok(propagate_forced(self.system(), order, &slow, times, options, observer)?)
            }
            System::Reduced | System::Rigid | System::Manifold => {
                let reduced = self.study.reduced(order)?;
                let Start { omega, attitude, place, velocity } = self.start;
                let (omega, attitude) = if system == System::Reduced && self.starts_displaced() {
                    let slow = self.matched(order.min(MAX_FORCED_ORDER))?;
                    (self.settled_on(&reduced, &slow)?, slow.attitude)
                } else {
                    (omega, attitude)
                };
                let spin = Start { omega, attitude, place, velocity };
                Ok(propagate(&reduced, spin, times, options, observer)?)
            }
        }
    }

    /// The options with an end where the spin passes the slowest elastic frequency: forces can drive a truncated series
    /// there, and beyond that frequency the series means nothing.
    fn bounded(&self, options: &Options) -> Result<Options, StudyError> {
        let mut options = options.clone();
        let bounded = options.events.iter().any(|event| matches!(event, Event::Validity { .. }));
        if !bounded && let Some(slowest) = frequencies(self.body)?.first() {
            options.events.push(Event::Validity { slowest: *slowest, limit: 1.0 });
        }
        Ok(options)
    }

    /// The full state at the start.
    pub fn full(&self) -> Result<FullState, StudyError> {
        let Start { omega, attitude, place, velocity } = self.start;
        let mut state = match &self.displaced {
            Some((q, rate)) => {
                let (mut rate, cyclic) = (rate.clone(), self.body.cyclic());
                // rotors and liquids that the spin does not slave turn with the body
                if !cyclic.is_empty() && slaved_order(self.body, 1, omega)? > 0 {
                    let settled = self.start.settled(self.system(), self.order)?;
                    rate[cyclic.clone()].copy_from_slice(&settled.rate[cyclic]);
                }
                FullState { omega, attitude, q: q.clone(), rate, place, velocity }
            }
            None if slaved_order(self.body, 1, omega)? == 0 => {
                FullState { place, velocity, ..FullState::at_rest(self.body, omega, attitude) }
            }
            None if self.is_soft()? => {
                let q = spun_displacements(self.body, omega).map_err(StudyError::NoStart)?;
                FullState { place, velocity, q, ..FullState::at_rest(self.body, omega, attitude) }
            }
            None => self.start.settled(self.system(), self.order)?,
        };
        self.speeds.iter().for_each(|(coordinate, speed)| state.rate[*coordinate] = *speed);
        Ok(state)
    }

    /// Size of the angular momentum at the start (N·m·s), internal angular momentum included.
    pub fn angular_momentum(&self) -> Result<f64, StudyError> {
        Ok(norm(self.full()?.angular_momentum(self.body)))
    }

    /// Whether the series of the slow manifold fails at the start, so that the displacements are those of a steady spin.
    pub fn is_soft(&self) -> Result<bool, StudyError> {
        let omega = self.start.omega;
        let asked = self.displaced.is_none() && slaved_order(self.body, 1, omega)? > 0 && norm(omega) > 0.0;
        Ok(asked && !follows_its_spin(self.body, &*self.study.reduced(self.order)?, omega))
    }

    /// Spin (rad/s) at which the reduced equations start: the one given, or the one on which displacements and rotors off the slow
    /// manifold settle.
    pub fn settled_spin(&self, reduced: &ReducedBody) -> Result<[f64; 3], StudyError> {
        if !self.starts_displaced() || self.order == 0 {
            return Ok(self.start.omega);
        }
        self.settled_on(reduced, &self.matched(self.order.min(MAX_FORCED_ORDER))?)
    }

    fn settled_on(&self, reduced: &ReducedBody, slow: &SlowState) -> Result<[f64; 3], StudyError> {
        if self.order == 0 {
            return Ok(self.start.omega);
        }
        let omega = reduced.angular_velocity(slow.angular_momentum);
        let gap = norm(add(reduced.angular_momentum(omega), scale(-1.0, slow.angular_momentum)));
        if gap <= CLOSED * norm(slow.angular_momentum) {
            Ok(omega)
        } else {
            Err(PropagateError::NoAngularMomentum.into())
        }
    }

    fn matched(&self, order: usize) -> Result<SlowState, StudyError> {
        Ok(matched_start(self.system(), order, &self.full()?)?)
    }

    fn slow(&self, order: usize) -> Result<SlowState, StudyError> {
        if self.starts_displaced() && order > 0 {
            return self.matched(order);
        }
        let Start { omega, attitude, place, velocity } = self.start;
        let still = SlowState { angular_momentum: [0.0; 3], attitude, place, velocity };
        Ok(still.with_spin(self.system(), order, omega)?)
    }

    /// The equations integrated, in words.
    pub fn equations(&self, system: System, form: Form) -> &'static str {
        let forces = self.system();
        match (system, forces.acts(), form) {
            (System::Manifold, ..) => "about the steady spin, z' = R(z) on a spectral submanifold",
            (System::Full, ..) => "full: momenta of the body and of every internal coordinate",
            (_, false, Form::AngularMomentum) => {
                "angular momentum in body axes, energy form: K' = (a v + K x Tv)/(a^2 + K.adj(T)K), v = K x grad E"
            }
            (_, true, Form::AngularMomentum) => "angular momentum in body axes, K' = K x w + M",
            (_, false, Form::AngularVelocity) if !forces.body.wheels().is_empty() => {
                "spin, J w' + w x (Jw + k) = mu(w)"
            }
            (_, false, Form::AngularVelocity) => "spin, J w' + w x Jw = mu(w)",
            (_, true, Form::AngularVelocity) => "spin, J w' + w x Jw = M + mu",
        }
    }
}
