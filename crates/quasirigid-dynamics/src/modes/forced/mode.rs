//! Modes about a steady state under forces: eigenvalues, energy balance, names and shares.
//! Light decay is taken from the energy balance where all forces but drag have a potential, because the eigenvalue has lost those digits;
//! materials and liquids are refined by inverse iteration.
//! Equations (M3), (M5), (M7) and (M8), docs/theory/15-modes.md.

use nalgebra::{Complex, DMatrix, Vector3};

use super::error::SteadyError;
use super::frame_rotation::{FrameRotation, effective};
use super::pencil::{Pencil, form};
use super::slopes::{DISPLACED, OMEGA, Slopes, THETA};
use super::spectrum::{Eigenmotion, spectrum};
use super::state::SteadyState;
use super::system::System;
use super::whole_body_names::{NamedMotion, named};
use crate::model::force::{Force, ForceLaw};
use crate::model::{FlexibleBody, Marker};
use crate::modes::iteration::{Pair, apart_from, belongs, inverse_iteration};
use crate::modes::mode::{DECAY_ROUNDING, SpinMode, in_order};
use crate::modes::shares::{balance, dissipation, leading, listed, moving, tellable};

type C = Complex<f64>;

/// Modes about a steady state of a body under moments. (M7)
#[derive(Clone, Debug, PartialEq)]
pub struct SteadyModes {
    /// The steady state.
    pub state: SteadyState,
    /// The modes by ascending frequency and decay rate, the nutation first and overdamped ones last.
    pub modes: Vec<SpinMode>,
    /// Number of neutral motions: constant, or with constant rate, beyond those of every such state, which are the rotation about its
    /// axis and the change of a free rate.
    pub neutral: usize,
    /// True if materials or liquids enter with their response at the frequency of each mode.
    pub refined: bool,
}

/// Relative difference below which eigenvalues of a liquid are the same.
const SAME_EIGENVALUE: f64 = 1e-6;
/// Share of the eigenvalue below which a decay rate follows from the energy balance, where one exists.
const LIGHT: f64 = 1e-5;
/// Share of its terms below which the denominator of the balance is rounding.
const CANCELLED: f64 = 1e-7;

impl SteadyModes {
    /// The modes about a steady state. (M7)
    ///
    /// # Errors
    /// [`SteadyError::Eigenvalues`] if the eigenvalue solver fails.
    pub fn about(
        body: &FlexibleBody,
        forces: &[Force<Marker>],
        state: SteadyState,
    ) -> Result<Self, SteadyError> {
        let (forces, followed) = effective(body, forces);
        let instant = state.at(0.0);
        let system = System::about(body, Slopes::of(body, &forces, &instant), &instant, followed);
        let attitude = state.turning != FrameRotation::Own;
        let (found, zeros) = spectrum(body, &system, attitude)?;
        let pencil = Pencil::new(body, &system, attitude, followed);
        let exchange = |force: &Force<Marker>| {
            let slopes = Slopes::of(body, std::slice::from_ref(force), &instant).by - support(body, &instant);
            Some(Exchange { name: exchanging(force)?, drag: is_drag(&force.law), slopes })
        };
        let about = About {
            body,
            state: &state,
            system: &system,
            pencil: &pencil,
            attitude,
            conservative: attitude && !followed && forces.iter().all(|force| has_potential(&force.law)),
            exchanges: forces.iter().filter_map(exchange).collect(),
        };
        let modes = about.modes(&found);
        let axis = state.axis.map(|axis| crate::math::rotation::Turn::of(state.attitude).to_body(axis));
        let mut modes = named(modes, &state, axis);
        in_order(&mut modes);
        let usual = match state.turning {
            FrameRotation::About(_) => 2,
            FrameRotation::Own => 1,
            _ => 0,
        };
        Ok(Self { state, modes, neutral: zeros.saturating_sub(usual), refined: pencil.is_nonlinear() })
    }

    /// True if no mode grows.
    #[must_use]
    pub fn stable(&self) -> bool {
        !self.modes.iter().any(SpinMode::grows)
    }

    /// Frequencies (rad/s) of a mode in inertial axes: `λ − |ω|` and `λ + |ω|`.
    #[must_use]
    pub fn seen_from_outside(&self, mode: &SpinMode) -> [f64; 2] {
        let spin = crate::math::vec3::norm(self.state.omega);
        [(mode.frequency - spin).abs(), mode.frequency + spin]
    }
}

/// Force that takes energy from small motions, or gives it, with the slopes of its loads.
struct Exchange {
    name: String,
    drag: bool,
    slopes: DMatrix<f64>,
}

fn is_drag(law: &ForceLaw<Marker>) -> bool {
    matches!(law, ForceLaw::Drag { .. } | ForceLaw::SpinDrag { .. })
}

/// Name among the dissipators of a force that depends on velocities, or is given by a formula; none of the others.
fn exchanging(force: &Force<Marker>) -> Option<String> {
    match &force.law {
        law if is_drag(law) => Some(format!("drag {:?}", force.name)),
        ForceLaw::EddyCurrent { .. } => Some(format!("eddy currents {:?}", force.name)),
        ForceLaw::Sunlight { .. } => Some(format!("sunlight {:?}", force.name)),
        ForceLaw::Expression { .. } | ForceLaw::TorqueExpression { .. } => {
            Some(format!("force {:?}", force.name))
        }
        _ => None,
    }
}

/// Slopes of the loads of the support, which those of every force contain.
fn support(body: &FlexibleBody, instant: &super::slopes::Instant) -> DMatrix<f64> {
    Slopes::of(body, &[], instant).by
}

/// True if the loads of a law, but for drag, have a potential in axes that rotate with the body.
fn has_potential(law: &ForceLaw<Marker>) -> bool {
    use crate::model::force::Axes;
    match law {
        ForceLaw::UniformGravity { .. }
        | ForceLaw::CentralGravity { .. }
        | ForceLaw::MagneticDipole { .. }
        | ForceLaw::Drag { .. }
        | ForceLaw::SpinDrag { .. } => true,
        ForceLaw::Thrust { axes, .. } => *axes == Axes::Inertial,
        ForceLaw::During { law, .. } => has_potential(law),
        ForceLaw::Torque { .. }
        | ForceLaw::EddyCurrent { .. }
        | ForceLaw::Sunlight { .. }
        | ForceLaw::Expression { .. }
        | ForceLaw::TorqueExpression { .. }
        | ForceLaw::TorqueTable { .. }
        | ForceLaw::ForceTable { .. } => false,
    }
}

/// Common data of the modes of a state.
struct About<'a> {
    body: &'a FlexibleBody,
    state: &'a SteadyState,
    system: &'a System,
    pencil: &'a Pencil<'a>,
    attitude: bool,
    conservative: bool,
    exchanges: Vec<Exchange>,
}

impl About<'_> {
    fn modes(&self, found: &[Eigenmotion]) -> Vec<NamedMotion> {
        let mut modes: Vec<NamedMotion> = Vec::with_capacity(found.len());
        let mut kept: Vec<Pair> = Vec::new();
        for (i, motion) in found.iter().enumerate() {
            let start = (motion.lambda, self.pencil.unknowns(motion.turn, &motion.q, &motion.velocity));
            let refined = inverse_iteration(self.pencil, start.clone())
                .filter(|(lambda, _)| belongs(*lambda, motion.lambda));
            let known = |lambda: C| {
                kept.iter().any(|(other, _)| (other - lambda).norm() < SAME_EIGENVALUE * lambda.norm())
            };
            let apart = |lambda: C| {
                let before = found[..i].iter().all(|other| {
                    (other.lambda - motion.lambda).norm() > 10.0 * SAME_EIGENVALUE * lambda.norm()
                });
                known(lambda) && before
            };
            if self.pencil.has_liquids() && refined.as_ref().is_none_or(|(lambda, _)| known(*lambda)) {
                continue;
            }
            let refined = if self.pencil.is_nonlinear() {
                apart_from(&kept, self.pencil, &start, refined)
            } else {
                refined
            };
            // Eigenvalues before the iteration are kept where the iteration leads two motions to one.
            let (lambda, x) = refined.filter(|(lambda, _)| !apart(*lambda)).unwrap_or(start);
            modes.push(self.mode(motion.lambda, lambda, &x));
            kept.push((lambda, x));
        }
        modes
    }

    fn mode(&self, of_motion: C, lambda: C, x: &[C]) -> NamedMotion {
        let delta = self.pencil.spin(lambda, x);
        let q = self.pencil.coordinates(x);
        let rate: Vec<C> = q.iter().map(|q| lambda * q).collect();
        let liquids: Vec<_> =
            self.pencil.liquids(x).map(|(liquid, angles)| (liquid, lambda, angles)).collect();
        let mut lost = dissipation(self.body, self.state.omega, lambda, &q, &liquids);
        let inside: f64 = lost.iter().map(|(_, power)| power).sum();
        let turn = self.attitude.then(|| [x[0], x[1], x[2]]);
        for exchange in &self.exchanges {
            lost.push((exchange.name.clone(), self.taken(exchange, (delta, &rate), (turn, &q))));
        }
        let moved = moving(self.body, &self.system.coefficients, delta, &rate, &liquids);
        let kinetic: f64 = moved.iter().map(|(_, energy)| energy).sum();
        let carried = moved.iter().all(|(name, energy)| name == "body" || *energy <= moved[0].1);
        let largest = (0..q.len()).max_by(|a, b| self.energy(*a, &rate).total_cmp(&self.energy(*b, &rate)));
        let leading = leading(self.body, &moved, largest, &liquids).filter(|_| !carried && kinetic > 0.0);
        let name =
            leading.unwrap_or_else(|| if kinetic > 0.0 { "rotation" } else { "translation" }.to_owned());
        let rounding = self.pencil.rounding(lambda, x).max(DECAY_ROUNDING * lambda.norm());
        let told = tellable(lambda, liquids.len(), lost.len());
        let (decay_rate, rate_bound) = self.decay(lambda, x, &q, inside, rounding);
        let mode = SpinMode {
            decay_rate,
            frequency: if lambda.im.abs() > rounding { lambda.im.abs() } else { 0.0 },
            of_motion: [-of_motion.re, of_motion.im],
            nutation: false,
            neutral: false,
            rate_bound,
            name,
            moves: if kinetic > 0.0 { listed(moved, kinetic) } else { Vec::new() },
            dissipation: if told && decay_rate != 0.0 { balance(lost) } else { Vec::new() },
            omega: delta.map(|entry| [entry.re, entry.im]),
            shape: q.iter().map(|entry| [entry.re, entry.im]).collect(),
        };
        let moving = turn.map_or(f64::INFINITY, |turn| kinetic / self.turning(lambda, turn));
        NamedMotion { mode, turn, carried, moving }
    }

    /// Twice the mean kinetic energy (J) that a rotation of the whole body seen at an eigenvalue has in axes that turn with it.
    fn turning(&self, lambda: C, turn: [C; 3]) -> f64 {
        (0..3).map(|k| self.system.mass[(k, k)] * (lambda * turn[k]).norm_sqr()).sum()
    }

    /// Twice the mean power that a force takes from a motion: by its slopes by the velocities, and by the part of those by the displacements
    /// that has no potential. (M5)
    fn taken(
        &self,
        Exchange { drag, slopes, .. }: &Exchange,
        (delta, rate): ([C; 3], &[C]),
        (turn, q): (Option<[C; 3]>, &[C]),
    ) -> f64 {
        let mut velocities = delta.to_vec();
        velocities.extend(rate);
        let power = form(&self.velocities(slopes), &velocities, &velocities).re;
        if *drag {
            return -power;
        }
        let mut displaced = turn.unwrap_or([C::from(0.0); 3]).to_vec();
        displaced.extend(q);
        let by = self.displacements(slopes);
        let circulatory = 0.5 * (&by - by.transpose());
        -power - form(&circulatory, &velocities, &displaced).re
    }

    fn energy(&self, j: usize, rate: &[C]) -> f64 {
        self.system.mass[(3 + j, 3 + j)] * rate[j].norm_sqr()
    }

    /// Slopes of loads by angular velocity and rates.
    fn velocities(&self, by: &DMatrix<f64>) -> DMatrix<f64> {
        let (n, elastic) = (self.body.coordinates().len(), self.body.elastic());
        DMatrix::from_fn(3 + n, 3 + n, |row, column| {
            by[(row, if column < 3 { OMEGA + column } else { DISPLACED + elastic + column - 3 })]
        })
    }

    /// Slopes of loads by rotation and displacements.
    fn displacements(&self, by: &DMatrix<f64>) -> DMatrix<f64> {
        let (n, elastic) = (self.body.coordinates().len(), self.body.elastic());
        DMatrix::from_fn(3 + n, 3 + n, |row, column| match column {
            0..3 => by[(row, THETA + column)],
            _ if column < 3 + elastic => by[(row, DISPLACED + column - 3)],
            _ => 0.0,
        })
    }

    /// Decay rate and the bound on it where rounding hides it: from the energy balance where the loss is light and the other forces have a
    /// potential. (M8)
    fn decay(&self, lambda: C, x: &[C], q: &[C], inside: f64, rounding: f64) -> (f64, f64) {
        let lossless = self.conservative && inside == 0.0 && self.exchanges.is_empty();
        let hidden = if lossless { 0.0 } else { rounding };
        let found = if lambda.re.abs() > rounding { (-lambda.re, 0.0) } else { (0.0, hidden) };
        let light = lambda.re.abs() < LIGHT * lambda.norm();
        if !(light && self.conservative && self.body.memories().is_empty()) {
            return found;
        }
        let mut y = vec![x[0], x[1], x[2]];
        y.extend(q);
        let turn = Vector3::new(x[0], x[1], x[2]);
        let whirled = self.system.turning().map(Complex::from) * turn;
        let mut z = vec![C::from(0.0); y.len()];
        z[..3].copy_from_slice(whirled.as_slice());
        let size = y.len();
        let mass = self.system.mass.view((0, 0), (size, size)).into_owned();
        let rate = self.system.rate.view((0, 0), (size, size)).into_owned();
        let b = lambda.im;
        let m = form(&mass, &y, &y).re;
        let gyroscopic = (form(&mass, &y, &z) + form(&rate, &y, &y)).im;
        let mut lost = b * inside / lambda.norm_sqr();
        for Exchange { slopes, .. } in self.exchanges.iter().filter(|exchange| exchange.drag) {
            let velocities = self.velocities(slopes);
            lost -= b * form(&velocities, &y, &y).re;
            lost -= (form(&velocities, &y, &z) + form(&self.displacements(slopes), &y, &y)).im;
        }
        let below = 2.0 * b * m + gyroscopic;
        let terms = 2.0 * b.abs() * m + gyroscopic.abs();
        if below.abs() > CANCELLED * terms { (lost / below, 0.0) } else { found }
    }
}
