//! Masters of the reduced equations about a spin: the nutation, and the modes that the nutation cannot be followed without.

use crate::math::submanifold::{LinearMode, LinearPart, Master};
use crate::math::vec3::{dot, norm, scale};
use crate::model::FlexibleBody;
use crate::modes::{RelativeEquilibrium, SpinModes};

use super::error::SubmanifoldError;
use super::steady::SteadySpin;

/// Choice of the masters beside the nutation.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Masters {
    /// The nutation, with the modes near it or near a resonance, up to two.
    #[default]
    Automatic,
    /// The nutation alone.
    Nutation,
    /// The nutation and the modes next to these frequencies (rad/s).
    With(Vec<f64>),
}

/// Master mode: a mode about the steady spin that the reduced equations follow.
#[derive(Clone, Debug, PartialEq)]
pub struct MasterMode {
    /// Name: `nutation`, or what moves.
    pub name: String,
    /// Decay rate (1/s), negative for growth.
    pub decay_rate: f64,
    /// Frequency (rad/s); zero for a motion without oscillation.
    pub frequency: f64,
}

/// Mode left out of the reduced equations.
#[derive(Clone, Debug, PartialEq)]
pub struct OuterMode {
    /// Name of what moves.
    pub name: String,
    /// Decay rate (1/s) and frequency (rad/s).
    pub decay_rate: f64,
    /// Frequency (rad/s).
    pub frequency: f64,
}

/// Largest number of modes followed beside the nutation.
pub const MAX_MASTERS: usize = 2;
/// Distance of a mode from a harmonic of the nutation, over the frequency of the nutation, below which the mode is followed too.
const NEAR_HARMONIC: f64 = 0.3;
/// Size of the eigenvalue of a slow mode, in decay rates of the nutation, below which the mode is followed too.
const SLOW_MODE_RATIO: f64 = 10.0;
/// Highest harmonic of the nutation that drives a mode noticeably.
const HARMONICS: usize = 3;
/// Share of the spin below which an eigenvalue is zero.
const ZERO: f64 = 1e-7;
/// Difference from a resonance of small whole numbers, relative to the frequency, below which masters share a phase.
const RESONANT: f64 = 0.2;

/// Masters chosen, and the eigenvalues left out.
pub(super) struct Chosen {
    pub masters: Vec<Master>,
    pub modes: Vec<MasterMode>,
    pub outer: Vec<OuterMode>,
}

/// Chooses the masters about a steady spin. (W9)
pub(super) fn choose(
    body: &FlexibleBody,
    near: RelativeEquilibrium,
    spin: &SteadySpin,
    masters: &Masters,
) -> Result<Chosen, SubmanifoldError> {
    let linear = &spin.linear;
    let named = SpinModes::about(body, near)?;
    let nutation =
        named.nutation().filter(|mode| mode.of_motion[1] > 0.0).ok_or(SubmanifoldError::NoNutation)?;
    let [decay, frequency] = nutation.of_motion;
    let mut found: Vec<LinearMode> = linear.spectrum().map_err(crate::modes::ModesError::from)?;
    found.retain(|([re, im], _)| re.hypot(*im) > ZERO * norm(spin.omega));
    let distance = |[re, im]: [f64; 2], to: [f64; 2]| (re - to[0]).hypot(im - to[1]);
    let index = (0..found.len())
        .filter(|i| found[*i].0[1] > 0.0)
        .min_by(|a, b| {
            let gap = |i: usize| distance(found[i].0, [-decay, frequency]);
            gap(*a).total_cmp(&gap(*b))
        })
        .ok_or(SubmanifoldError::NoNutation)?;
    let lead = found.swap_remove(index);
    let with = followed(lead.0, &found, masters);
    let name = |lambda: [f64; 2]| {
        let nearest = named.modes.iter().filter(|mode| !mode.nutation).min_by(|a, b| {
            let gap =
                |mode: &crate::modes::SpinMode| distance(lambda, [-mode.of_motion[0], mode.of_motion[1]]);
            gap(a).total_cmp(&gap(b))
        });
        nearest.map_or_else(|| "internal motion".to_owned(), |mode| mode.name.clone())
    };
    let mut chosen = Chosen { masters: Vec::new(), modes: Vec::new(), outer: Vec::new() };
    let mut frequencies: Vec<f64> = Vec::new();
    let mut unit = 0.0;
    let all = std::iter::once(("nutation".to_owned(), &lead))
        .chain(with.iter().map(|i| (name(found[*i].0), &found[*i])));
    for (name, (lambda, vector)) in all {
        let refined = linear
            .refined(*lambda, vector)
            .filter(|pair| distance(pair.lambda, *lambda) < 1e-3 * lambda[0].hypot(lambda[1]));
        let pair = refined.ok_or(SubmanifoldError::Master { frequency: lambda[1] })?;
        let factor = if unit == 0.0 {
            tilt_factor(spin, &pair.right)
        } else {
            unit / energy_size(linear, &pair.right)
        };
        let pair = pair.scaled([factor, 0.0]);
        unit = if unit == 0.0 { energy_size(linear, &pair.right) } else { unit };
        let [re, im] = pair.lambda;
        chosen.modes.push(MasterMode { name, decay_rate: -re, frequency: im });
        let weight = phase(im, &mut frequencies);
        let at = chosen.masters.len();
        if im == 0.0 {
            chosen.masters.push(Master { mode: pair, partner: at, weight });
        } else {
            let opposite = weight.iter().map(|weight| -weight).collect();
            let twin = Master { mode: pair.conjugate(), partner: at, weight: opposite };
            chosen.masters.extend([Master { mode: pair, partner: at + 1, weight }, twin]);
        }
    }
    let groups = frequencies.len();
    chosen.masters.iter_mut().for_each(|master| master.weight.resize(groups, 0));
    chosen.outer = (0..found.len())
        .filter(|i| !with.contains(i))
        .map(|i| OuterMode { name: name(found[i].0), decay_rate: -found[i].0[0], frequency: found[i].0[1] })
        .collect();
    Ok(chosen)
}

/// Indices of the modes followed beside the nutation.
fn followed(nutation: [f64; 2], others: &[LinearMode], masters: &Masters) -> Vec<usize> {
    let size = nutation[0].hypot(nutation[1]);
    match masters {
        Masters::Nutation => Vec::new(),
        Masters::With(frequencies) => {
            let mut chosen = Vec::new();
            for frequency in frequencies {
                let gap = |i: &usize| (others[*i].0[1] - frequency).abs();
                let free = (0..others.len()).filter(|i| !chosen.contains(i));
                chosen.extend(free.min_by(|a, b| gap(a).total_cmp(&gap(b))));
            }
            chosen
        }
        Masters::Automatic => {
            let gap = |i: &usize| {
                let [re, im] = others[*i].0;
                let harmonics = (1..=HARMONICS).map(|n| {
                    let n = n as f64;
                    (re - n * nutation[0]).hypot(im - n * nutation[1])
                });
                harmonics.fold(f64::INFINITY, f64::min)
            };
            let slow = |i: &usize| {
                let [re, im] = others[*i].0;
                re.hypot(im) < SLOW_MODE_RATIO * nutation[0].abs()
            };
            let mut near: Vec<usize> =
                (0..others.len()).filter(|i| gap(i) < NEAR_HARMONIC * size || slow(i)).collect();
            near.sort_by(|a, b| gap(a).total_cmp(&gap(b)));
            near.truncate(MAX_MASTERS);
            near
        }
    }
}

/// Factor that makes a unit of the coordinate a greatest tilt of the angular momentum of 1 rad, and the tilt about the first axis real.
fn tilt_factor(spin: &SteadySpin, right: &[[f64; 2]]) -> f64 {
    let G = norm(spin.angular_momentum);
    let axis = scale(G.recip(), spin.angular_momentum);
    let part = |which: usize| {
        let x: Vec<f64> = right.iter().map(|entry| entry[which]).collect();
        let change: [f64; 3] =
            std::array::from_fn(|row| (0..x.len()).map(|k| spin.linear.mass.at(row, k) * x[k]).sum());
        let along = dot(change, axis);
        std::array::from_fn::<f64, 3, _>(|i| (change[i] - along * axis[i]) / G)
    };
    let (a, b) = (part(0), part(1));
    let square = dot(a, a) + dot(b, b);
    let turned = (dot(a, a) - dot(b, b)).hypot(2.0 * dot(a, b));
    (2.0 * (square + turned)).sqrt().recip()
}

/// Size of a vector whose components are measured in their scales.
fn energy_size(linear: &LinearPart, right: &[[f64; 2]]) -> f64 {
    let parts = right.iter().zip(&linear.scales).map(|([re, im], scale)| re.hypot(*im) / scale);
    parts.fold(0.0, f64::hypot)
}

/// Whole numbers of turns of a master with each phase: a resonance with the phases before, or a phase of its own. (W5)
fn phase(frequency: f64, phases: &mut Vec<f64>) -> Vec<i32> {
    if frequency == 0.0 {
        return vec![0; phases.len()];
    }
    for (k, phase) in phases.iter().enumerate() {
        let ratio = (frequency / phase).round();
        if (1.0..=3.0).contains(&ratio) && (frequency - ratio * phase).abs() < RESONANT * phase {
            let mut weight = vec![0; phases.len()];
            weight[k] = ratio as i32;
            return weight;
        }
    }
    phases.push(frequency);
    let mut weight = vec![0; phases.len()];
    weight[phases.len() - 1] = 1;
    weight
}

#[cfg(test)]
mod tests {
    use super::phase;

    /// Ratios decide whether two frequencies are in resonance, in whatever unit of time.
    #[test]
    fn a_resonance_has_no_unit() {
        for unit in [1e-6, 1.0, 1e6] {
            let mut phases = vec![unit];
            assert_eq!(phase(2.1 * unit, &mut phases), [2], "{unit:e}: near twice the first");
            assert_eq!(phase(2.4 * unit, &mut phases), [0, 1], "{unit:e}: between twice and three times");
            assert_eq!(phases, [unit, 2.4 * unit]);
        }
    }
}
