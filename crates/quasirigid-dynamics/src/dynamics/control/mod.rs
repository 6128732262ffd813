//! Controllers in the state of an integrated system: angular momenta of wheels, states of laws, commands that are held or wait, states of rods.
//! What is sampled is part of the state and constant between the instants, which are breakpoints; there it jumps.
//! Equations (Y1) to (Y4), (Y8) and (Y11), docs/theory/20-control.md.

mod clock;
mod sizes;

use std::ops::Range;

pub(super) use clock::Clock;

use crate::math::rotation::Turn;
use crate::math::vec3::{add, dot, scale};
use crate::model::MotionState;
use crate::model::control::{
    BodyController, Commands, ControlState, Controls, Sampling, SensedField, SensedOrbit,
};
use crate::model::force::MagneticField;

/// Places of controllers in their block of a state: angular momenta of wheels, then controller by controller, then rods.
#[derive(Clone, Debug)]
pub(super) struct ControlBlock<'a> {
    controls: &'a Controls,
    places: Vec<Place>,
    rods: Range<usize>,
    len: usize,
}

/// Places of one controller.
#[derive(Clone, Debug)]
struct Place {
    states: Range<usize>,
    /// Commands that act; none of a continuous controller.
    held: Range<usize>,
    /// Commands that wait, the next to act first.
    waiting: Range<usize>,
}

/// Motion of a body at a moment, as controllers see it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seen<'a> {
    pub t: f64,
    pub attitude: [f64; 4],
    pub motion: MotionState<'a, f64>,
}

/// What of controllers depends on the time: their instants, and the field that they sense or act by.
#[derive(Clone, Debug, Default)]
pub(super) struct ControlTimes {
    pub clocks: Vec<Clock>,
    pub field: Option<MagneticField>,
}

/// What the surroundings show to the sensors of a body.
#[derive(Clone, Copy)]
struct Sensed {
    field: SensedField,
    orbit: SensedOrbit,
    /// Unit vector to the Sun, body axes.
    sun: [f64; 3],
}

/// Action of controllers on a body.
#[derive(Clone, Copy, Debug)]
pub(super) struct Action {
    /// Torque on the carrier (N·m), body axes, that is external to body and wheels.
    pub torque: [f64; 3],
    /// Its impulse per time (N·m), inertial axes.
    pub impulse: [f64; 3],
    /// Power (W) of the torques on the carrier, the reactions of motors among them.
    pub power: f64,
}

impl<'a> ControlBlock<'a> {
    pub fn of(controls: &'a Controls) -> Self {
        let mut len = controls.wheels.len();
        let mut take = |count: usize| {
            len += count;
            len - count..len
        };
        let place = |controller: &BodyController| {
            let outputs = controller.outputs.len();
            let (held, waiting) = match controller.sampling {
                Some(sampling) => (outputs, outputs * sampling.queue().0),
                None => (0, 0),
            };
            Place { states: take(controller.law.states()), held: take(held), waiting: take(waiting) }
        };
        let places = controls.controllers.iter().map(place).collect();
        let rods = take(controls.rods.len());
        Self { controls, places, rods, len }
    }

    pub fn len(&self) -> usize {
        self.len
    }

    pub fn is_empty(&self) -> bool {
        self.controls.is_empty()
    }

    /// Whether a controller measures at instants.
    pub fn is_sampled(&self) -> bool {
        self.controls.controllers.iter().any(|controller| controller.sampling.is_some())
    }

    /// Whether a controller acts at all times.
    pub fn is_continuous(&self) -> bool {
        self.controls.controllers.iter().any(|controller| controller.sampling.is_none())
    }

    /// Block at the start, with the first samples.
    pub fn start(&self, seen: &Seen) -> Vec<f64> {
        let mut block = vec![0.0; self.len];
        for (wheel, value) in self.controls.wheels.iter().zip(&mut block) {
            *value = wheel.angular_momentum;
        }
        for (controller, place) in self.controls.controllers.iter().zip(&self.places) {
            block[place.states.clone()].copy_from_slice(&controller.start);
        }
        let field = self.sensed(seen).field;
        for (rod, state) in self.controls.rods.iter().zip(&mut block[self.rods.clone()]) {
            *state = rod.without_past(&field);
        }
        self.jump(seen, &mut block);
        block
    }

    /// Angular momentum (N·m·s, body axes) that motors have given to the wheels since the start.
    pub fn given(&self, block: &[f64]) -> [f64; 3] {
        let gained: Vec<f64> =
            self.controls.wheels.iter().zip(block).map(|(wheel, now)| now - wheel.angular_momentum).collect();
        self.controls.about_axes(&gained)
    }

    /// What depends on the time.
    pub fn times(&self) -> ControlTimes {
        ControlTimes { clocks: self.clocks(), field: self.controls.field }
    }

    /// Instants of samples and of the commands that they lead to. (Y3)
    fn clocks(&self) -> Vec<Clock> {
        let of = |Sampling { period, .. }: Sampling, offset| Clock { period, offset };
        let samplings = || self.controls.controllers.iter().filter_map(|controller| controller.sampling);
        let late = samplings().map(|sampling| (sampling, sampling.queue().1)).filter(|(_, rest)| *rest > 0.0);
        samplings()
            .map(|sampling| of(sampling, 0.0))
            .chain(late.map(|(sampling, rest)| of(sampling, rest)))
            .collect()
    }

    /// Action at a state, whose rates are written. (Y1), (Y4), (Y8), (Y11)
    pub fn act(&self, seen: &Seen, block: &[f64], rates: &mut [f64]) -> Action {
        rates.fill(0.0);
        let sensed = self.sensed(seen);
        let field = sensed.field;
        let mut commands = self.controls.silence();
        for (controller, place) in self.controls.controllers.iter().zip(&self.places) {
            if controller.sampling.is_some() {
                commands.add(controller, &block[place.held.clone()]);
                continue;
            }
            let inputs = controller.inputs(&self.state(seen, block, sensed), None);
            let (values, advance) = controller.act(&inputs, &block[place.states.clone()]);
            commands.add(controller, &values);
            rates[place.states.clone()].copy_from_slice(&advance);
        }
        for (rod, place) in self.controls.rods.iter().zip(self.rods.clone()) {
            commands.moment = add(commands.moment, rod.moment(&field, block[place]));
            rates[place] = rod.rate(&field, block[place]);
        }
        let Commands { torque, motors, moment } = commands;
        let torque = add(torque, field.torque(moment));
        rates[..motors.len()].copy_from_slice(&motors);
        let omega = seen.motion.omega;
        let reaction = self.controls.about_axes(&motors);
        Action {
            torque,
            impulse: Turn::of(seen.attitude).to_inertial(torque),
            power: dot(omega, add(torque, scale(-1.0, reaction))),
        }
    }

    /// Values of [`Controls::channels`] at a state: angular momenta of wheels, then of each controller the commands that act and its states.
    pub fn channels(&self, seen: &Seen, block: &[f64]) -> Vec<f64> {
        let sensed = self.sensed(seen);
        let mut values = block[..self.controls.wheels.len()].to_vec();
        for (controller, place) in self.controls.controllers.iter().zip(&self.places) {
            let states = &block[place.states.clone()];
            if controller.sampling.is_some() {
                values.extend(&block[place.held.clone()]);
            } else {
                values.extend(
                    controller.act(&controller.inputs(&self.state(seen, block, sensed), None), states).0,
                );
            }
            values.extend(states);
        }
        values
    }

    /// Torque (N·m) of the size that controllers exert at a state, for the scales of errors.
    pub fn size(&self, seen: &Seen, block: &[f64]) -> f64 {
        let mut rates = vec![0.0; self.len];
        let torque = self.act(seen, block, &mut rates).torque;
        let motors = self.controls.about_axes(&rates[..self.controls.wheels.len()]);
        dot(torque, torque).sqrt() + dot(motors, motors).sqrt()
    }

    /// Samples and commands that are due: whether something jumped. (Y3)
    pub fn jump(&self, seen: &Seen, block: &mut [f64]) -> bool {
        let mut jumped = false;
        let sensed = self.sensed(seen);
        for (index, (controller, place)) in self.controls.controllers.iter().zip(&self.places).enumerate() {
            let Some(sampling) = controller.sampling else { continue };
            let (slots, rest) = sampling.queue();
            let ticks = |offset| Clock { period: sampling.period, offset }.tick(seen.t);
            if rest > 0.0 && ticks(rest).is_some() {
                place.release(block);
                jumped = true;
            }
            let Some(sample) = ticks(0.0) else { continue };
            let inputs = controller.inputs(&self.state(seen, block, sensed), Some((index, sample)));
            let (values, next) = controller.act(&inputs, &block[place.states.clone()]);
            block[place.states.clone()].copy_from_slice(&next);
            match slots {
                0 => block[place.held.clone()].copy_from_slice(&values),
                _ => {
                    if rest == 0.0 {
                        place.release(block);
                    }
                    block[place.waiting.end - values.len()..place.waiting.end].copy_from_slice(&values);
                }
            }
            jumped = true;
        }
        jumped
    }

    fn sensed(&self, seen: &Seen) -> Sensed {
        let Seen { t, attitude, motion } = *seen;
        Sensed {
            field: self.controls.sensed(t, attitude, motion.omega),
            orbit: self.controls.relative_to_orbit(t, attitude, motion.omega),
            sun: self.controls.toward_sun(t, attitude),
        }
    }

    fn state<'s>(&self, seen: &Seen<'s>, block: &'s [f64], sensed: Sensed) -> ControlState<'s> {
        let Seen { t, attitude, motion } = *seen;
        let Sensed { field, orbit, sun } = sensed;
        ControlState { t, attitude, motion, wheels: &block[..self.controls.wheels.len()], field, orbit, sun }
    }
}

impl Place {
    /// Lets the command act that has waited longest, and moves the others up.
    fn release(&self, block: &mut [f64]) {
        let outputs = self.held.len();
        block.copy_within(self.waiting.start..self.waiting.start + outputs, self.held.start);
        block.copy_within(self.waiting.start + outputs..self.waiting.end, self.waiting.start);
    }
}
