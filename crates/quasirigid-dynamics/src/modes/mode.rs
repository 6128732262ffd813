//! Modes of the spinning body about a relative equilibrium: decay rates, frequencies, nutation, shares and names.
//! Decay comes from the balance of the second variation of the energy where the eigenvalue has lost its digits; the nutation is the mode
//! whose angular momentum leaves the axis most, not the slowest one.
//! Equations (M2) to (M5), docs/theory/15-modes.md.

use std::collections::BTreeMap;

use nalgebra::{Complex, Vector3};

use super::blocks::BlockPencil;
use super::candidates::{Candidate, Source, candidates, neutral};
use super::definite::positive_energy;
use super::displacements::WHOLE;
use super::driven::Driven;
use super::equilibrium::RelativeEquilibrium;
use super::error::ModesError;
use super::iteration::{Nonlinear, Pair, apart_from, belongs, inverse_iteration};
use super::pencil::Pencil;
use super::range::{ModeRange, SlowModes};
use super::shares::{dissipation, form, leading, listed, moving, tellable};
use super::slow::SlowDirection;
use super::slowest::slowest;
use super::spectrum::{Eigenmotion, within};
use super::unknowns::Unknowns;
use crate::math::sym3;
use crate::math::vec3::norm;
use crate::model::{FlexibleBody, SpinCoefficients};

/// Mode of the spinning body: a small motion `e^{λt}` about a relative equilibrium, `λ = −decay_rate ± i·frequency`. (M2)
#[derive(Clone, Debug, PartialEq)]
pub struct SpinMode {
    /// Decay rate (1/s); negative for a motion that grows.
    pub decay_rate: f64,
    /// Frequency in body axes (rad/s), not negative; zero for a motion without oscillation.
    pub frequency: f64,
    /// Decay rate (1/s) and frequency (rad/s) of the mode in the equations of motion, where materials and liquids without equations of
    /// their own are left out or approximated.
    pub of_motion: [f64; 2],
    /// True for the nutation: the mode in which the angular momentum leaves the axis of the spin most.
    pub nutation: bool,
    /// True where the motion neither decays nor grows nor oscillates as far as rounding can tell: steady spins lie side by side, and it has
    /// no rate.
    pub neutral: bool,
    /// Bound (1/s) on the rate of decay or growth that rounding hides; zero where the decay rate is known.
    pub rate_bound: f64,
    /// `nutation`, or the coordinate that moves most; later modes of one name are counted, `"tip" x, second`.
    pub name: String,
    /// Shares of the kinetic energy: the carrier, then each part, by name; those of 1e-3 or more.
    pub moves: Vec<(String, f64)>,
    /// Shares of the energy dissipated, by name of the dissipator; empty without dissipation.
    pub dissipation: Vec<(String, f64)>,
    /// Angular velocity (rad/s), real and imaginary part, in the scale of the displacements.
    pub omega: [[f64; 2]; 3],
    /// Displacement of each coordinate, real and imaginary part; scale: the largest displacement, or angular velocity over the spin, is
    /// of size one in the units of the mass.
    pub shape: Vec<[f64; 2]>,
}

/// Modes of the spinning body about a relative equilibrium. (M2)–(M4)
#[derive(Clone, Debug, PartialEq)]
pub struct SpinModes {
    /// Steady spin.
    pub equilibrium: RelativeEquilibrium,
    /// Modes: the nutation first, if there is one, then by ascending frequency and decay rate, overdamped ones last.
    pub modes: Vec<SpinMode>,
    /// Decay rates (1/s) and frequencies (rad/s) of the internal motions in the equations of motion: all that were found but the nutation.
    pub internal: Vec<[f64; 2]>,
    /// Modes that were looked for.
    pub range: ModeRange,
}

/// Number of coordinates up to which every mode is refined as a solution of the nonlinear eigenproblem; for a larger body the nutation
/// alone, and with materials or liquids also the slowest modes.
const REFINED: usize = 40;
const SLOWEST: usize = 24;
/// Number of coordinates above which the nutation is refined only for materials or liquids.
const UNREFINED_COORDINATES: usize = 300;
/// Share of the decay rate below which a frequency is negligible.
pub(super) const OVERDAMPED: f64 = 0.1;
/// Relative difference below which eigenvalues of a liquid are the same.
const SAME_EIGENVALUE: f64 = 1e-6;
/// Share of the eigenvalue below which a decay rate is rounding, unless the energy balance gives it.
pub(super) const DECAY_ROUNDING: f64 = 1e-12;
/// Share of the eigenvalue below which a decay rate follows from the energy balance in a body with materials.
const LIGHT: f64 = 1e-5;

impl SpinMode {
    /// Time constant (s) of decay by the factor e: negative for growth, infinite for neither.
    #[must_use]
    pub fn time_constant(&self) -> f64 {
        self.decay_rate.recip()
    }

    /// Damping ratio `−Re λ/|λ|`: one for a motion without oscillation, negative for growth.
    #[must_use]
    pub fn damping_ratio(&self) -> f64 {
        let size = self.decay_rate.hypot(self.frequency);
        if size > 0.0 { self.decay_rate / size } else { 0.0 }
    }

    /// True for an internal motion that decays with no oscillation to speak of: the body itself does not move most, and the frequency is below a
    /// tenth of the decay rate.
    #[must_use]
    pub fn overdamped(&self) -> bool {
        let share =
            |name: &str| self.moves.iter().find(|(own, _)| own == name).map_or(0.0, |(_, share)| *share);
        let internal = self.moves.iter().any(|(_, other)| *other > share("body"));
        internal && !self.nutation && self.decay_rate > 0.0 && self.frequency < OVERDAMPED * self.decay_rate
    }

    /// True if the mode grows.
    #[must_use]
    pub fn grows(&self) -> bool {
        self.decay_rate < 0.0
    }
}

impl SpinModes {
    /// Number of coordinates up to which all modes are found if asked for: minutes.
    pub const MAX_COORDINATES: usize = 1500;

    /// Modes about a relative equilibrium of a body without external moments: all, or of a body of more than 150 elastic coordinates the slowest,
    /// as [`range`](Self::range) says.
    ///
    /// # Errors
    /// [`ModesError`] if the eigenvalue solver fails, or the mass matrix is not positive at the displacements.
    pub fn about(body: &FlexibleBody, equilibrium: RelativeEquilibrium) -> Result<Self, ModesError> {
        let many = body.elastic() > WHOLE;
        let sparse = || body.sparse_about_spin(equilibrium.omega, &equilibrium.q);
        match if many { sparse() } else { None } {
            Some(coefficients) => Self::slowest(body, equilibrium, &coefficients),
            None => Self::within(body, equilibrium, WHOLE),
        }
    }

    /// All modes, however many: the time grows with the cube of the number of coordinates.
    ///
    /// # Errors
    /// As [`about`](Self::about), and [`ModesError::TooMany`].
    pub fn all_about(body: &FlexibleBody, equilibrium: RelativeEquilibrium) -> Result<Self, ModesError> {
        let coordinates = body.coordinates().len();
        if coordinates > Self::MAX_COORDINATES {
            return Err(ModesError::TooMany { coordinates, most: Self::MAX_COORDINATES });
        }
        Self::within(body, equilibrium, usize::MAX)
    }

    /// Modes from the matrix of the first-order equations, with all displacements of a body of up to `whole` elastic coordinates.
    fn within(
        body: &FlexibleBody,
        equilibrium: RelativeEquilibrium,
        whole: usize,
    ) -> Result<Self, ModesError> {
        let coefficients = equilibrium.coefficients(body);
        let pencil = Pencil::new(body, &equilibrium, &coefficients);
        let slow = SlowDirection::of(body, &equilibrium, &coefficients);
        let steady = slow.as_ref().map_or(&[][..], |slow| &slow.steady);
        let found = within(body, &equilibrium, &coefficients, (steady, whole))?;
        let fastest = found.iter().map(|motion| motion.lambda.norm()).fold(0.0, f64::max);
        let count = body.coordinates().len();
        let positive_energy = count <= WHOLE && positive_energy(body, &coefficients, slow.as_ref());
        let projected = SlowModes { rate: fastest, missing: None, positive_energy };
        let candidates = candidates(found, slow.as_ref(), (body, &coefficients, norm(equilibrium.omega)));
        let refining = Refining {
            unknowns: &pencil.unknowns,
            problem: Some(&pencil),
            every: count <= REFINED,
            nutation: count <= UNREFINED_COORDINATES || pencil.unknowns.nonlinear,
        };
        let frame = Frame { body, equilibrium: &equilibrium, coefficients: &coefficients };
        let Ordered { modes, internal, lost } = frame.modes(candidates, slow.as_ref(), &refining);
        let range = match (body.elastic() > whole, lost) {
            (false, 0) => ModeRange::All,
            (true, 0) => ModeRange::Slowest(projected),
            _ => ModeRange::Slowest(SlowModes { missing: Some(lost), ..projected }),
        };
        Ok(Self { equilibrium, modes, internal, range })
    }

    /// Slowest modes of a body of many coordinates.
    pub(super) fn slowest(
        body: &FlexibleBody,
        equilibrium: RelativeEquilibrium,
        coefficients: &SpinCoefficients,
    ) -> Result<Self, ModesError> {
        let slow = SlowDirection::of(body, &equilibrium, coefficients);
        let (found, range) = slowest(body, &equilibrium, coefficients, slow.as_ref())?;
        let unknown = slow.as_ref().filter(|slow| slow.neutral() == 1);
        let unknown = unknown.map(|slow| neutral(body.coordinates().len(), slow));
        let own = found.into_iter().map(|motion| (Source::Spectrum, motion));
        let candidates = unknown.into_iter().chain(own).collect();
        let unknowns = Unknowns::exact(body);
        let exact =
            unknowns.nonlinear.then(|| BlockPencil::new(unknowns.clone(), &equilibrium, coefficients));
        let problem = exact.as_ref().map(|exact| exact as &dyn Nonlinear);
        let refining = Refining { unknowns: &unknowns, problem, every: true, nutation: true };
        let frame = Frame { body, equilibrium: &equilibrium, coefficients };
        let Ordered { modes, internal, lost } = frame.modes(candidates, slow.as_ref(), &refining);
        let missing = range.missing.map(|missing| missing + lost);
        Ok(Self { equilibrium, modes, internal, range: ModeRange::Slowest(SlowModes { missing, ..range }) })
    }

    /// Nutation; none for a body without one, as a sphere.
    #[must_use]
    pub fn nutation(&self) -> Option<&SpinMode> {
        self.modes.iter().find(|mode| mode.nutation)
    }

    /// True if no mode grows, neither of those found nor of others.
    #[must_use]
    pub fn stable(&self) -> bool {
        self.range.shows_stability() && !self.unstable()
    }

    /// True if a mode grows. A spin of a body of many coordinates may be neither stable nor unstable, as far as is known.
    #[must_use]
    pub fn unstable(&self) -> bool {
        self.modes.iter().any(SpinMode::grows)
    }

    /// Rotation `θ` of the body from its steady attitude in a mode (rad), real and imaginary parts: `λθ + Ω × θ = δω`. None for a mode
    /// that is a steady spin about another direction.
    #[must_use]
    pub fn rotation(&self, mode: &SpinMode) -> Option<[[f64; 2]; 3]> {
        let lambda = Complex::new(-mode.decay_rate, mode.frequency);
        let spin = Vector3::from(self.equilibrium.omega).map(Complex::from);
        let change = Vector3::from(mode.omega.map(|[re, im]| Complex::new(re, im)));
        let angle = change * lambda * lambda - spin.cross(&change) * lambda + spin * spin.dot(&change);
        let angle = angle / (lambda * (lambda * lambda + spin.dot(&spin)));
        let parts: [[f64; 2]; 3] = std::array::from_fn(|axis| [angle[axis].re, angle[axis].im]);
        parts.as_flattened().iter().all(|part| part.is_finite()).then_some(parts)
    }

    /// Frequencies (rad/s) of a mode in inertial axes: `λ − |ω|` and `λ + |ω|`.
    #[must_use]
    pub fn seen_from_outside(&self, mode: &SpinMode) -> [f64; 2] {
        let spin = norm(self.equilibrium.omega);
        [(mode.frequency - spin).abs(), mode.frequency + spin]
    }
}

/// Ordinals of modes that share a name.
const ORDINALS: [&str; 9] =
    ["second", "third", "fourth", "fifth", "sixth", "seventh", "eighth", "ninth", "tenth"];

/// Brings modes into their order, and counts those of one name, so that every name belongs to one mode.
pub(super) fn in_order(modes: &mut [SpinMode]) {
    modes.sort_by(|a, b| {
        let order = b.nutation.cmp(&a.nutation).then(a.overdamped().cmp(&b.overdamped()));
        order.then(a.frequency.total_cmp(&b.frequency)).then(a.decay_rate.total_cmp(&b.decay_rate))
    });
    let mut counts: BTreeMap<String, usize> = BTreeMap::new();
    for mode in modes {
        let count = counts.entry(mode.name.clone()).or_default();
        match ORDINALS.get(count.wrapping_sub(1)) {
            _ if *count == 0 => {}
            Some(ordinal) => mode.name = format!("{}, {ordinal}", mode.name),
            None => mode.name = format!("{}, {}th", mode.name, *count + 1),
        }
        *count += 1;
    }
}

/// Common data of the modes of a steady spin.
pub(super) struct Frame<'a> {
    pub(super) body: &'a FlexibleBody,
    pub(super) equilibrium: &'a RelativeEquilibrium,
    pub(super) coefficients: &'a SpinCoefficients,
}

type Complex3 = [Complex<f64>; 3];

/// Refinement of motions as solutions of the nonlinear eigenproblem.
struct Refining<'a> {
    unknowns: &'a Unknowns<'a>,
    /// Eigenproblem; none where the motions solve it as they are.
    problem: Option<&'a dyn Nonlinear>,
    /// Whether every motion is refined.
    every: bool,
    /// Whether the nutation is.
    nutation: bool,
}

/// Modes in their order.
struct Ordered {
    modes: Vec<SpinMode>,
    /// Decay rates and frequencies of the internal motions in the equations of motion.
    internal: Vec<[f64; 2]>,
    /// Eigenvalues of materials whose mode was not found, each of a pair by itself.
    lost: usize,
}

impl Frame<'_> {
    /// Modes in their order. A motion of a body with materials that leads to no mode of its own is left out. (M3)
    fn modes(
        &self,
        candidates: Vec<Candidate>,
        slow: Option<&SlowDirection>,
        refining: &Refining,
    ) -> Ordered {
        let (sources, found): (Vec<Source>, Vec<Eigenmotion>) = candidates.into_iter().unzip();
        let Refining { unknowns, problem, .. } = refining;
        let of_direction = self.of_direction(&found, &sources, slow);
        let nutation = of_direction.first().copied();
        let mut slowest: Vec<usize> = (0..found.len()).collect();
        slowest.sort_by(|a, b| found[*a].lambda.norm().total_cmp(&found[*b].lambda.norm()));
        let again = |i: usize| {
            sources[i] == Source::Spectrum
                && (refining.every
                    || (Some(i) == nutation && refining.nutation)
                    || (unknowns.nonlinear && slowest[..slowest.len().min(SLOWEST)].contains(&i)))
        };
        let tilts = slow.map_or(&[][..], |slow| &slow.tilts);
        let driven = Driven::of(self.body, self.coefficients, tilts);
        let mut modes: Vec<SpinMode> = Vec::with_capacity(found.len());
        let mut pairs: Vec<Pair> = Vec::with_capacity(found.len());
        let mut internal = Vec::with_capacity(found.len());
        let mut lost = 0;
        let others = (0..found.len()).filter(|i| Some(*i) != nutation);
        for i in nutation.into_iter().chain(others) {
            let motion = &found[i];
            let balanced = self.decay_of_motion(motion);
            if Some(i) != nutation {
                internal.push([balanced, motion.lambda.im]);
            }
            let start = (motion.lambda, unknowns.given(motion));
            let problem = problem.filter(|_| again(i));
            let kept = problem.and_then(|problem| inverse_iteration(problem, start.clone()));
            let mut kept = kept.filter(|(lambda, _)| belongs(*lambda, motion.lambda));
            let known = |lambda: Complex<f64>| {
                let gap =
                    |mode: &SpinMode| (lambda + mode.decay_rate - Complex::new(0.0, mode.frequency)).norm();
                modes.iter().any(|mode| gap(mode) < SAME_EIGENVALUE * lambda.norm())
            };
            // Relaxations of a liquid whose impedance is known are kept only where they lead to a new mode of the liquid; the nutation
            // always where it converges.
            let led_nowhere = |(lambda, _): &Pair| Some(i) != nutation && known(*lambda);
            let of_spectrum = sources[i] == Source::Spectrum;
            if of_spectrum && unknowns.has_liquids() && kept.as_ref().is_none_or(led_nowhere) {
                if Some(i) == nutation {
                    lost += if motion.lambda.im > 0.0 { 2 } else { 1 };
                }
                continue;
            }
            if let Some(problem) = problem.filter(|_| unknowns.nonlinear && !unknowns.has_liquids()) {
                kept = apart_from(&pairs, problem, &start, kept);
                if kept.is_none() {
                    lost += if motion.lambda.im > 0.0 { 2 } else { 1 };
                    continue;
                }
            }
            let (lambda, x) = kept.unwrap_or(start);
            let exact = of_spectrum && !unknowns.nonlinear;
            let of_motion = [if exact { balanced } else { -motion.lambda.re }, motion.lambda.im];
            let driven = of_direction.contains(&i).then_some(&driven);
            let mut mode = self.mode(unknowns, of_motion, (lambda, &x), (Some(i) == nutation, driven));
            if !of_spectrum {
                (mode.decay_rate, mode.rate_bound) = (-lambda.re, 0.0);
                mode.neutral = sources[i] == Source::Neutral;
            }
            if of_direction.contains(&i) {
                mode.name = "nutation".to_owned();
            } else if of_spectrum && unknowns.is_relaxation(&mode) {
                continue;
            }
            modes.push(mode);
            pairs.push((lambda, x));
        }
        in_order(&mut modes);
        Ordered { modes, internal, lost }
    }

    /// Change of the angular momentum in body axes.
    pub(super) fn angular_momentum(
        &self,
        delta: Complex3,
        rate: &[Complex<f64>],
        q: &[Complex<f64>],
    ) -> Complex3 {
        let SpinCoefficients { inertia, h, slopes, .. } = self.coefficients;
        let mut K = sym3::rows(*inertia).map(|row| row[0] * delta[0] + row[1] * delta[1] + row[2] * delta[2]);
        for (j, (h, u)) in h.iter().zip(slopes).enumerate() {
            for axis in 0..3 {
                K[axis] += rate[j] * h[axis] + q[j] * u[axis];
            }
        }
        K
    }

    fn mode(
        &self,
        unknowns: &Unknowns,
        of_motion: [f64; 2],
        (lambda, x): (Complex<f64>, &[Complex<f64>]),
        (nutation, driven): (bool, Option<&Driven>),
    ) -> SpinMode {
        let delta = [x[0], x[1], x[2]];
        let mut q = unknowns.coordinates(x);
        for j in driven.into_iter().flat_map(|driven| driven.still(lambda, delta)) {
            q[j] = Complex::from(0.0);
        }
        let rate: Vec<Complex<f64>> = q.iter().map(|q| lambda * q).collect();
        let liquids: Vec<_> = unknowns.liquids(lambda, x).collect();
        let lost = dissipation(self.body, self.equilibrium.omega, lambda, &q, &liquids);
        let total: f64 = lost.iter().map(|(_, power)| power).sum();
        let moved = moving(self.body, self.coefficients, delta, &rate, &liquids);
        let kinetic = kinetic(&moved);
        let largest = q.iter().enumerate().max_by(|a, b| {
            let size =
                |(j, rate): &(usize, &Complex<f64>)| rate.norm_sqr() * self.body.invariants().modal_mass(*j);
            size(a).total_cmp(&size(b))
        });
        let largest = largest.filter(|(_, rate)| rate.norm_sqr() > 0.0).map(|(j, _)| j);
        let leading = leading(self.body, &moved, largest, &liquids).unwrap_or_else(|| "spin".to_owned());
        let name = if nutation { "nutation".to_owned() } else { leading };
        let told = tellable(lambda, liquids.len(), lost.len());
        let (decay_rate, rate_bound) = self.decay(unknowns.nonlinear, lambda, (delta, &rate, &q), total);
        SpinMode {
            decay_rate,
            frequency: if lambda.im.abs() > DECAY_ROUNDING * lambda.norm() { lambda.im.abs() } else { 0.0 },
            of_motion,
            nutation,
            neutral: false,
            rate_bound,
            name,
            moves: if kinetic > 0.0 { listed(moved, kinetic) } else { Vec::new() },
            dissipation: if total > 0.0 && told { listed(lost, total) } else { Vec::new() },
            omega: delta.map(|entry| [entry.re, entry.im]),
            shape: q.iter().map(|entry| [entry.re, entry.im]).collect(),
        }
    }

    /// Decay rate and the bound on it where rounding hides it: from the energy balance, `2F₂·Re λ = −q̇ᴴBq̇`, where that is exact or more exact
    /// than the eigenvalue. (M4)
    fn decay(
        &self,
        nonlinear: bool,
        lambda: Complex<f64>,
        (delta, rate, q): (Complex3, &[Complex<f64>], &[Complex<f64>]),
        lost: f64,
    ) -> (f64, f64) {
        let rounding = DECAY_ROUNDING * lambda.norm();
        let hidden = if lost == 0.0 { 0.0 } else { rounding };
        let found = if lambda.re.abs() > rounding { (-lambda.re, 0.0) } else { (0.0, hidden) };
        let light = found.0.abs() < LIGHT * lambda.norm();
        let oscillates = lambda.im.abs() > lambda.re.abs();
        let balanced = oscillates && if nonlinear { light && self.body.memories().is_empty() } else { true };
        if !balanced {
            return found;
        }
        let second = self.second_variation(delta, rate, q);
        let size = kinetic(&moving(self.body, self.coefficients, delta, rate, &[]));
        if second.abs() > CANCELLED * size { (lost / (2.0 * second), 0.0) } else { found }
    }

    /// Decay rate in the equations of motion, where dashpots alone dissipate: from the energy balance where the motion oscillates, so
    /// that a motion without loss neither decays nor grows by rounding. (M4)
    fn decay_of_motion(&self, Eigenmotion { lambda, delta, rate, q, .. }: &Eigenmotion) -> f64 {
        let second = self.second_variation(*delta, rate, q);
        let size = kinetic(&moving(self.body, self.coefficients, *delta, rate, &[]));
        let balanced = lambda.im.abs() > lambda.re.abs() && second.abs() > CANCELLED * size;
        let (decay, rounding) = if balanced {
            (form(self.body.damping(), rate) / (2.0 * second), f64::EPSILON)
        } else {
            (-lambda.re, DECAY_ROUNDING)
        };
        if decay.abs() > rounding * lambda.norm() { decay } else { 0.0 }
    }

    /// Second variation of the energy at the angular momentum of the steady spin: conserved without dissipation. (M4)
    fn second_variation(&self, delta: Complex3, rate: &[Complex<f64>], q: &[Complex<f64>]) -> f64 {
        let SpinCoefficients { centrifugal, .. } = self.coefficients;
        let K = self.angular_momentum(delta, rate, q);
        let kinetic = kinetic(&moving(self.body, self.coefficients, delta, rate, &[]));
        let mut potential: f64 =
            self.body.stiffness().iter().map(|(j, k, C)| C * (q[j].conj() * q[k]).re).sum();
        for part in [|x: &Complex<f64>| x.re, |x: &Complex<f64>| x.im] {
            let x: Vec<f64> = q.iter().map(part).collect();
            potential -= centrifugal.times(&x).iter().zip(&x).map(|(load, x)| load * x).sum::<f64>();
        }
        let square: f64 = K.iter().map(Complex::norm_sqr).sum();
        0.5 * (kinetic + potential - square / self.equilibrium.ratio)
    }
}

/// Share of the kinetic energy below which a second variation is lost in rounding.
const CANCELLED: f64 = 1e-7;

pub(super) fn kinetic(parts: &[(String, f64)]) -> f64 {
    parts.iter().map(|(_, energy)| energy).sum()
}
