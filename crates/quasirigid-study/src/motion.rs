//! The motion that a model asks for, in each of its systems.

use std::cell::OnceCell;

use quasirigid::dynamics::{
    Event, Forced, Form, FullState, MAX_FORCED_ORDER, Observer, Options, PropagateError, Run, SlowEquations,
    SlowState, Start, matched_start, propagate, propagate_forced, propagate_full,
};
use quasirigid::model::force::Force;
use quasirigid::model::{FlexibleBody, Marker, MotionState, ReducedBody, Support};
use quasirigid::reduction::{frequencies, manifold_has_meaning, state_has_meaning};
use quasirigid::secular::spun_displacements;
use quasirigid::verification::VerificationError;
use quasirigid_io::model::Displacements;
use quasirigid_math::vec3::{add, norm, scale};

use crate::about_spin::{self, OnManifold};
use crate::controlled;
use crate::driven;
use crate::error::StudyError;
use crate::settings::SpinManifoldSettings;
use crate::slugs;
use crate::start::{follows_its_spin, slaved_order, slaves};
use crate::study::Study;
use quasirigid_io::model::System;

/// Relative difference between an angular momentum and that of the spin which the series finds for it, from which the
/// series does not hold there.
const CLOSED: f64 = 0.01;

/// Beginning of the notes on a model whose motion [starts displaced](Motion::starts_displaced).
pub const DISPLACED: &str = "The internal coordinates do not start on the slow manifold";

/// Note on a start of which the file asks for a slow manifold that there is not. (Q8)
pub const LOOSE: &str = "No slow series holds for the rotors and liquids at this spin: they start at rest in the body; `speed` in \
                                [[rotor]] starts a rotor otherwise.";

/// A body with its forces and its initial state.
pub struct Motion<'a> {
    study: &'a Study,
    pub body: &'a FlexibleBody,
    pub forces: &'a [Force<Marker>],
    pub order: usize,
    /// Order of the torque-free part of the equations under forces. (E6)
    torque_free: usize,
    pub start: Start,
    /// Internal coordinates and rates, where the file gives them.
    displaced: Option<(Vec<f64>, Vec<f64>)>,
    /// Rates of cyclic coordinates, where the file gives them.
    speeds: &'a [(usize, f64)],
    /// The state on the slow manifold at the start, once it was asked for.
    slow: OnceCell<Option<FullState>>,
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
        let (order, torque_free, slow) = (*order, *order, OnceCell::new());
        Self { study, body, forces, order, torque_free, start, displaced, speeds, slow }
    }

    /// The motion with the reduced equations of another order; under forces with their torque-free part of that order, as the cost of the
    /// series along the flow grows steeply with its own.
    pub fn of_order(self, order: usize) -> Self {
        if self.system().acts() {
            return Self { torque_free: order, ..self };
        }
        Self { order, slow: OnceCell::new(), ..self }
    }

    pub fn study(&self) -> &'a Study {
        self.study
    }

    pub fn system(&self) -> Forced<'a> {
        Forced { body: self.body, forces: self.forces }
    }

    /// Whether something acts on the body: a force, a support or a motor, or a controller.
    pub fn is_acted_on(&self) -> bool {
        self.system().acts() || !self.study.controls.is_empty()
    }

    /// Whether an internal coordinate starts off the slow manifold.
    pub fn starts_displaced(&self) -> bool {
        self.displaced.is_some() || !self.speeds.is_empty()
    }

    /// Follows one of the systems; of the reduced equations about the spin also their verdict.
    pub fn follow(
        &self,
        system: System,
        about_spin: &SpinManifoldSettings,
        times: &[f64],
        options: &Options,
        observer: &mut dyn Observer,
    ) -> Result<(Run, Option<OnManifold>), StudyError> {
        slugs::carries(self.study, system)?;
        driven::carries(self.study, system)?;
        if !self.study.controls.is_empty() {
            return Ok((controlled::follow(self, system, times, options, observer)?, None));
        }
        if system == System::SpinManifold {
            let (run, verdict) = about_spin::follow(self, about_spin, times, options, observer)?;
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
        match system {
            System::Full => propagate_full(self.system(), &self.full()?, times, options, observer)
                .map_err(|error| self.study.told_of(error)),
            System::Reduced if self.starts_displaced() && self.order > 0 => {
                let run = self.follow_reduced(system, times, options, observer)?;
                Ok(Run { left_out: run.left_out + self.vibrations_of_the_start()?, ..run })
            }
            _ => self.follow_reduced(system, times, options, observer),
        }
    }

    /// Follows the rigid body, under its controllers.
    pub fn follow_rigid(
        &self,
        times: &[f64],
        options: &Options,
        observer: &mut dyn Observer,
    ) -> Result<Run, StudyError> {
        match self.study.controls.is_empty() {
            true => self.follow_reduced(System::Rigid, times, options, observer),
            false => controlled::follow(self, System::Rigid, times, options, observer),
        }
    }

    fn follow_reduced(
        &self,
        system: System,
        times: &[f64],
        options: &Options,
        observer: &mut dyn Observer,
    ) -> Result<Run, StudyError> {
        let order = if system == System::Rigid { 0 } else { self.order };
        match self.system().acts() {
            true => {
                let above = SlowEquations::torque_free_order(self.system(), options.form, order);
                let reduced =
                    above.map(|above| self.study.reduced(above.max(self.torque_free))).transpose()?;
                let equations = SlowEquations::energy_form(self.system(), order, reduced.as_deref());
                let slow = self.slow(equations, order)?;
                let options = if order > 1 { &self.bounded(options)? } else { options };
                Ok(propagate_forced(equations, &slow, times, options, observer)?)
            }
            false => {
                let reduced = self.study.reduced(order)?;
                let spin = if system == System::Reduced {
                    self.reduced_start(&reduced)?
                } else {
                    Start { omega: self.slaving(&reduced, self.start.omega)?, ..self.start }
                };
                Ok(propagate(&reduced, spin, times, options, observer)?)
            }
        }
    }

    /// Start of the reduced equations without forces: the one given, or the one on which displacements and rotors off the slow manifold
    /// settle.
    pub fn reduced_start(&self, reduced: &ReducedBody) -> Result<Start, StudyError> {
        if !self.starts_displaced() {
            return Ok(Start { omega: self.slaving(reduced, self.start.omega)?, ..self.start });
        }
        let slow = self.matched(reduced.order.min(MAX_FORCED_ORDER))?;
        Ok(Start { omega: self.settled_on(reduced, &slow)?, attitude: slow.attitude, ..self.start })
    }

    /// The options with an end where the spin passes the slowest elastic frequency: forces can drive a truncated series
    /// there, and beyond that frequency the series does not hold.
    fn bounded(&self, options: &Options) -> Result<Options, StudyError> {
        let mut options = options.clone();
        let bounded = options.events.iter().any(|event| matches!(event, Event::Validity { .. }));
        if !bounded && let Some(slowest) = frequencies(self.body)?.first() {
            options.events.push(Event::Validity { slowest: *slowest, limit: 1.0 });
        }
        Ok(options)
    }

    /// The full state at the start: on the slow manifold where there is one, else deformed by the steady spin, rotors and liquids turning
    /// with the body; displacements and speeds that the file gives in their place. (Q8)
    pub fn full(&self) -> Result<FullState, StudyError> {
        let Start { omega, attitude, place, velocity } = self.start;
        let cyclic = self.body.cyclic();
        let mut state = match &self.displaced {
            Some((q, rate)) => {
                let mut rate = rate.clone();
                let slaved = !cyclic.is_empty() && self.body.drives().is_empty();
                let slow = if slaved { self.on_slow_manifold()? } else { None };
                slow.iter().for_each(|slow| rate[cyclic.clone()].copy_from_slice(&slow.rate[cyclic.clone()]));
                FullState { omega, attitude, q: q.clone(), rate, place, velocity }
            }
            None if self.study.held()?.is_some() => self.beside_slugs()?,
            None => match self.on_slow_manifold()? {
                Some(slow) => slow.clone(),
                None => FullState { place, velocity, ..self.spun()? },
            },
        };
        self.speeds.iter().for_each(|(coordinate, speed)| state.rate[*coordinate] = *speed);
        Ok(state.driven(self.body))
    }

    /// The state of the body with sliding liquids and driven parts held where they lie at the start, these at rest in it.
    fn beside_slugs(&self) -> Result<FullState, StudyError> {
        let Some(held) = self.study.held()? else { return self.spun() };
        let state = Motion::new(held, self.start).full()?;
        let [q, rate] = [state.q, state.rate].map(|held| slugs::with_slugs(self.study, held));
        Ok(FullState { q, rate, ..state })
    }

    /// The state on the slow manifold; none where the series does not hold at the start. (Q8)
    fn on_slow_manifold(&self) -> Result<Option<&FullState>, StudyError> {
        if let Some(known) = self.slow.get() {
            return Ok(known.as_ref());
        }
        let found =
            if self.body.hung().is_some() || !slaves(self.body, self.start.omega)? || self.is_soft()? {
                None
            } else {
                match self.start.settled(self.system(), self.order) {
                    Err(VerificationError::NoSlowManifold { .. }) => None,
                    found => Some(found?),
                }
            };
        Ok(self.slow.get_or_init(|| found).as_ref())
    }

    /// The state deformed by the steady spin, in which nothing moves in the body. (Q8)
    fn spun(&self) -> Result<FullState, StudyError> {
        let Start { omega, attitude, .. } = self.start;
        let still = FullState::at_rest(self.body, omega, attitude);
        if self.body.elastic() == 0 || norm(omega) == 0.0 {
            return Ok(still);
        }
        let q = spun_displacements(self.body, omega).map_err(StudyError::NoStart)?;
        Ok(FullState { q, ..still })
    }

    /// Whether rotors and liquids that the file asks for on the slow manifold start turning with the body, since they have none.
    pub fn starts_loose(&self) -> Result<bool, StudyError> {
        if let (Some(held), None) = (self.study.held()?, &self.displaced) {
            return Motion::new(held, self.start).starts_loose();
        }
        let asked = self.displaced.is_none() && self.speeds.len() < self.body.cyclic().len();
        Ok(asked && norm(self.start.omega) > 0.0 && self.on_slow_manifold()?.is_none())
    }

    /// Size of the angular momentum at the start (N·m·s), internal angular momentum included.
    pub fn angular_momentum(&self) -> Result<f64, StudyError> {
        Ok(norm(self.full()?.angular_momentum(self.body)))
    }

    /// Whether the series of the slow manifold fails at the start.
    fn is_soft(&self) -> Result<bool, StudyError> {
        let omega = self.start.omega;
        Ok(norm(omega) > 0.0 && !follows_its_spin(self.body, &*self.study.reduced(self.order)?, omega))
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
            self.slaving(reduced, omega)
        } else {
            Err(self.unfound())
        }
    }

    /// An angular velocity (rad/s) at which the slow series of rotors and liquids has a meaning. (Q8)
    pub fn slaving(&self, reduced: &ReducedBody, omega: [f64; 3]) -> Result<[f64; 3], StudyError> {
        let means = self.is_rigid_inside(reduced.order) || manifold_has_meaning(self.body, reduced, omega);
        if means { Ok(omega) } else { Err(self.unfound()) }
    }

    /// Whether the equations of an order have no rates of rotors and liquids.
    fn is_rigid_inside(&self, order: usize) -> bool {
        order == 0 || self.body.cyclic().is_empty()
    }

    /// Spin (rad/s) by which the reduced equations are judged: that at which they start, or that of the start where they fail already there.
    pub fn judged_spin(&self, reduced: &ReducedBody) -> Result<[f64; 3], StudyError> {
        let omega = self.start.omega;
        match self.settled_spin(reduced) {
            Err(error) if error.is_of_the_series() => match slaved_order(self.study, reduced.order, omega)? {
                0 => Ok(omega),
                _ => Err(error),
            },
            found => found,
        }
    }

    /// Reason for which the reduced equations do not start.
    fn unfound(&self) -> StudyError {
        if self.body.cyclic().is_empty() {
            return PropagateError::NoAngularMomentum.into();
        }
        StudyError::NoSlowSeries { spin: norm(self.start.omega) }
    }

    /// Energy (J) of the vibrations of the start: of its displacements and rates off those on which the body settles. (B2)
    fn vibrations_of_the_start(&self) -> Result<f64, StudyError> {
        let (full, order) = (self.full()?, self.order.min(MAX_FORCED_ORDER));
        let settled = FullState::on_manifold(self.system(), order, &self.matched(order)?)?;
        let gap = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a - b).collect();
        let off = FullState {
            omega: add(full.omega, scale(-1.0, settled.omega)),
            q: gap(&full.q, &settled.q),
            rate: gap(&full.rate, &settled.rate),
            velocity: [0.0; 3],
            ..full
        };
        Ok(off.energy(self.body).max(0.0))
    }

    fn matched(&self, order: usize) -> Result<SlowState, StudyError> {
        Ok(matched_start(self.system(), order, &self.full()?)?)
    }

    fn slow(&self, equations: SlowEquations, order: usize) -> Result<SlowState, StudyError> {
        let Start { omega, attitude, place, velocity } = self.start;
        let slow = if self.starts_displaced() && order > 0 {
            self.matched(order)?
        } else {
            let still = SlowState { angular_momentum: [0.0; 3], attitude, place, velocity };
            equations.state(still, omega)?
        };
        if self.is_rigid_inside(order) || norm(omega) == 0.0 {
            return Ok(slow);
        }
        let FullState { omega, q, rate, .. } = FullState::on_manifold(self.system(), order, &slow)?;
        let motion = MotionState { omega, q: &q, rate: &rate };
        let means = state_has_meaning(self.body, motion, slow.angular_momentum);
        if means { Ok(slow) } else { Err(self.unfound()) }
    }

    /// The equations integrated, in words.
    pub fn equations(&self, system: System, form: Form) -> &'static str {
        let forces = self.system();
        match (system, forces.acts(), form) {
            (System::SpinManifold, ..) => "about the steady spin, z' = R(z) on a spectral submanifold",
            (System::Full, ..) => "full: momenta of the body and of every internal coordinate",
            (_, false, Form::AngularMomentum) => {
                "angular momentum in body axes, energy form: K' = (a v + K x Tv)/(a^2 + K.adj(T)K), v = K x grad E"
            }
            (_, true, Form::AngularMomentum) if system == System::Rigid => {
                "angular momentum in body axes, K' = K x w + M"
            }
            (_, true, Form::AngularMomentum) => {
                "angular momentum in body axes, K' = K x w + M, torque-free part in the energy form"
            }
            (_, false, Form::AngularVelocity) if !forces.body.wheels().is_empty() => {
                "spin, J w' + w x (Jw + k) = mu(w)"
            }
            (_, false, Form::AngularVelocity) => "spin, J w' + w x Jw = mu(w)",
            (_, true, Form::AngularVelocity) => "spin, J w' + w x Jw = M + mu",
        }
    }
}

#[cfg(test)]
mod tests;
