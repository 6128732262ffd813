//! Motion that circles a steady spin, known where it passes the section: by whole revolutions, one by one or in leaps.
//! Equations (P9) to (P12), docs/theory/05-propagation.md.

use super::frame::Frame;
use super::place::Place;
use super::rates::Rates;
use super::revolution::{Motion, Passage};
use super::section::Section;
use crate::dynamics::form::Equations;
use crate::dynamics::quadrature::Quadrature;
use crate::dynamics::reduced::Shares;
use crate::dynamics::spin::Accounts;
use crate::dynamics::steady::IsolatedSpin;
use crate::math::ode::Checkpoint;
use crate::math::rotation::{self, Attitude};
use crate::math::simd::{Arithmetic, Plain};
use crate::math::vec3::{norm, scale};

/// Motion that circles a steady spin, at its last passage of the section.
#[derive(Debug)]
pub(super) struct Circling {
    frame: Frame,
    section: Section,
    rates: Rates,
    /// Attitude of the axes of the section at the first passage, and the angle (rad) there.
    attitude: Attitude,
    first: f64,
    pub place: Place,
    /// Energies taken by each of several dissipators, over the number of revolutions.
    taken: Option<Quadrature>,
}

/// What became of an attempt to go on by whole revolutions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Advance {
    /// Another place on the section was reached.
    Moved,
    /// No whole revolution ends before the time.
    Arrived,
    /// The next revolution does not come back to the section.
    Lost,
}

/// Angle (rad) from the axis of a steady spin below which a motion is steady.
const STEADY: f64 = 1e-13;
/// Angle (rad) below which the shares of the dissipators are those of the least wobble.
const NEAR: f64 = 1e-4;

impl Circling {
    /// The first passage of a section by the motion from a state; none if it circles no steady spin.
    pub fn start<A: Arithmetic>(
        motion: &Motion<'_, A>,
        shares: &Shares<'_>,
        spins: &[IsolatedSpin],
        (t, state): (f64, &Accounts),
    ) -> Option<Self> {
        let body = shares.body();
        let rate = motion.equations.rate::<Plain, f64>(state.x);
        Frame::axes_about(spins, state.x).into_iter().find_map(|axes| {
            let frame = Frame::new(body, axes);
            let inside = frame.inside(state.x);
            let mut section = Section { G: norm(state.x), sense: 1.0 };
            section.sense = section.azimuth_rate(inside, frame.inside(rate)).signum();
            if Section::from_axis(inside) < STEADY {
                return Self::steady(motion, shares, (frame, section), (t, state));
            }
            let azimuth = section.azimuth(inside);
            let around = frame.motion(motion);
            let Passage { K, attitude, sums } =
                around.end_on_section(&section, inside, azimuth, |_, _| ())?;
            let first = Section::angle(K);
            let mut energies = Energies::of(&around, shares, &frame);
            around.revolution(&section, first, energies.adder())?;
            let place = Place::new([first.ln(), t, 0.0, state.dissipated, state.energy_change, state.angle])
                .moved(0, [0.0, sums.time, 0.0, sums.dissipated, sums.energy_change, sums.angle]);
            let attitude = rotation::product(frame.attitude_inside(state.attitude), attitude);
            let taken = energies.sums().map(|energies| Quadrature::new(0.0, energies));
            Some(Self { frame, section, rates: Rates::new(), attitude, first, place, taken })
        })
    }

    /// A steady spin to rounding, where the azimuth means nothing; none where it has no rates.
    fn steady<A: Arithmetic>(
        motion: &Motion<'_, A>,
        shares: &Shares<'_>,
        (frame, mut section): (Frame, Section),
        (t, state): (f64, &Accounts),
    ) -> Option<Self> {
        let mut rates = Rates::new();
        let first = Section::from_axis(frame.inside(state.x)).max(f64::MIN_POSITIVE);
        let found = [1.0, -1.0].into_iter().any(|sense| {
            (section.sense, rates) = (sense, Rates::new());
            rates.at(&frame.motion(motion), &section, first).is_some()
        });
        let place = Place::new([first.ln(), t, 0.0, state.dissipated, state.energy_change, state.angle]);
        let taken = (shares.count() > 0).then(|| Quadrature::new(0.0, vec![0.0; shares.count()]));
        let attitude = frame.attitude_inside(state.attitude);
        found.then_some(Self { frame, section, rates, attitude, first, place, taken })
    }

    /// Time (s) of the passage.
    pub fn time(&self) -> f64 {
        self.place.sums()[1]
    }

    /// State at the passage.
    pub fn state(&self) -> Accounts {
        let [_, _, precession, dissipated, energy_change, angle] = self.place.sums();
        let psi = self.place.psi();
        let K = rotation::to_inertial(self.attitude, self.section.at(self.first));
        let still = Section::moved(self.attitude, self.first, psi);
        let attitude = rotation::turned(still, scale(precession / norm(K), K));
        let x = self.frame.outside(self.section.at(psi));
        Accounts { x, attitude: self.frame.attitude_outside(attitude), dissipated, energy_change, angle }
    }

    /// Goes on by whole revolutions that end before a time (s), at most so many: over a piece of the rates, or by one.
    pub fn advance<A: Arithmetic>(
        &mut self,
        motion: &Motion<'_, A>,
        shares: &Shares<'_>,
        until: f64,
        most: u64,
    ) -> Advance {
        let motion = &self.frame.motion(motion);
        let mut passed = Vec::new();
        if let Some(fit) = self.rates.at(motion, &self.section, self.place.psi()) {
            let period = fit.at(self.place.psi(), 0.0)[1];
            let place = self.place.leap(fit, until, most, |n, psi| passed.push((n, psi)));
            let leaped = place.revolutions - self.place.revolutions;
            if leaped > 0 {
                motion.add_leaped(leaped);
                self.place = place;
                for (revolutions, psi) in passed {
                    let energies =
                        Energies::of(motion, shares, &self.frame).over_a_revolution(&self.section, psi);
                    take(&mut self.taken, revolutions, energies);
                }
                return Advance::Moved;
            }
            if self.place.before(until) < period {
                return Advance::Arrived;
            }
        }
        let mut energies = Energies::of(motion, shares, &self.frame);
        let revolution = motion.revolution(&self.section, self.place.psi(), energies.adder());
        let Some(revolution) = revolution else { return Advance::Lost };
        if revolution.sums.time > self.place.before(until) {
            return Advance::Arrived;
        }
        take(&mut self.taken, self.place.revolutions as f64, energies.sums());
        self.place = self.place.moved(1, revolution.changes());
        Advance::Moved
    }

    /// What changes along the motion.
    pub fn kept(&self) -> (Place, Option<Quadrature>) {
        (self.place, self.taken.clone())
    }

    /// Goes back to what was [`kept`](Self::kept).
    pub fn back(&mut self, kept: &(Place, Option<Quadrature>)) {
        (self.place, self.taken) = kept.clone();
    }

    /// Time (s) of the next revolution; none if the motion leaves the section.
    pub fn period<A: Arithmetic>(&self, motion: &Motion<'_, A>) -> Option<f64> {
        Some(self.frame.motion(motion).revolution(&self.section, self.place.psi(), |_, _| ())?.sums.time)
    }

    /// Energies taken by each of several dissipators so far.
    pub fn taken(&self) -> Option<Quadrature> {
        self.taken.clone()
    }

    pub fn save(&self, checkpoint: &mut Checkpoint) {
        self.frame.save(checkpoint);
        checkpoint.save(self.section.G);
        checkpoint.save(self.section.sense);
        self.rates.save(checkpoint);
        checkpoint.save_list(&self.attitude);
        checkpoint.save(self.first);
        self.place.save(checkpoint);
        checkpoint.save_count(u64::from(self.taken.is_some()));
        self.taken.iter().for_each(|taken| taken.save(checkpoint));
    }

    pub fn load(checkpoint: &mut Checkpoint, shares: &Shares<'_>) -> Option<Self> {
        let frame = Frame::load(checkpoint, shares.body())?;
        let section = Section { G: checkpoint.load()?, sense: checkpoint.load()? };
        let (rates, mut attitude) = (Rates::load(checkpoint)?, [0.0; 4]);
        checkpoint.load_into(&mut attitude)?;
        let (first, place) = (checkpoint.load()?, Place::load(checkpoint)?);
        let mut taken =
            (checkpoint.load_count()? == 1).then(|| Quadrature::new(0.0, vec![0.0; shares.count()]));
        taken.iter_mut().try_for_each(|taken| taken.load(checkpoint))?;
        Some(Self { frame, section, rates, attitude, first, place, taken })
    }
}

/// Adds the energies that the dissipators take over the revolution from a place on.
fn take(taken: &mut Option<Quadrature>, revolutions: f64, energies: Option<Vec<f64>>) {
    if let (Some(taken), Some(energies)) = (taken, energies) {
        taken.add(revolutions, energies);
    }
}

/// Energies (J) that several dissipators take over a stretch of the motion.
struct Energies<'a, A> {
    motion: &'a Motion<'a, A>,
    shares: &'a Shares<'a>,
    frame: &'a Frame,
    sums: Option<Quadrature>,
}

impl<'a, A: Arithmetic> Energies<'a, A> {
    fn of(motion: &'a Motion<'a, A>, shares: &'a Shares<'a>, frame: &'a Frame) -> Self {
        Self { motion, shares, frame, sums: None }
    }

    /// Energies over the revolution from an angle `ψ` (rad) on; near the axis they are as its square.
    fn over_a_revolution(mut self, section: &Section, psi: f64) -> Option<Vec<f64>> {
        if self.shares.count() > 0 {
            self.motion.revolution(section, psi.max(NEAR), self.adder())?;
        }
        let share = (psi / psi.max(NEAR)).powi(2);
        self.sums().map(|sums| sums.into_iter().map(|energy| share * energy).collect())
    }

    /// Receiver of the times and angular momenta of the stretch.
    fn adder(&mut self) -> impl FnMut(f64, [f64; 3]) {
        |t, K| {
            if self.shares.count() > 0 {
                let omega = self.motion.equations.omega(K);
                let powers = self.shares.powers(self.frame.outside(omega));
                match &mut self.sums {
                    Some(sums) => sums.add(t, powers),
                    None => self.sums = Some(Quadrature::new(t, powers)),
                }
            }
        }
    }

    fn sums(&self) -> Option<Vec<f64>> {
        self.sums.as_ref().map(Quadrature::sums)
    }
}
