//! Bodies so stiff and slow that the average along the frozen polhode needs no reference spins to be judged by.

use std::f64::consts::TAU;

use super::average_powers::AveragePowers;
use crate::averaging::{FreeRotation, MeanPower, PowerSource};
use crate::model::{FlexibleBody, Mode};
use crate::secular::apart;

/// Ratio of the spin to the slowest elastic frequency below which the average needs no judgement.
const STIFF_SPIN_RATIO: f64 = 1e-3;
/// Relative difference of moments of inertia above which they are distinct for so slow a spin, and below which they are equal.
const DISTINCT: f64 = 1e-3;
const EQUAL: f64 = 1e-9;
/// Change of the wobble in a radian of the polhode from which an average is judged by the modes. (Q14)
const CHANGE_PER_RADIAN: f64 = 1e-2;
/// Relative difference between the powers of the polynomial and of the harmonics below which losses are of first order.
const FIRST_ORDER: f64 = 2.5e-3;
/// States `ξ` at which the two are compared, from the separatrix to the axis.
const COMPARED_AT: [f64; 5] = [-6.0, -3.0, 0.0, 3.0, 12.0];

/// Source of the average of a body whose polhode is that of the frozen body, from a rotation at a spin (rad/s); none where the average must be
/// judged. Where losses are not of first order it is the harmonics', unless another was asked for.
#[must_use]
pub fn stiff_average(
    body: &FlexibleBody,
    powers: &AveragePowers,
    initial: &FreeRotation,
    spin: f64,
) -> Option<PowerSource> {
    let first = &*powers.of(powers.first);
    if !is_stiff(body, powers, initial, spin) || change_per_radian(first, initial) > CHANGE_PER_RADIAN {
        return None;
    }
    if powers.first == PowerSource::Polynomial && !first_order(powers, initial) {
        return powers.may_take_harmonics().then_some(PowerSource::Harmonics);
    }
    Some(powers.first)
}

/// Whether the spin is slow beside every elastic frequency, and the moments of inertia are distinct beside what it bends.
fn is_stiff(body: &FlexibleBody, powers: &AveragePowers, initial: &FreeRotation, spin: f64) -> bool {
    let [I1, I2, I3] = powers.response.principal().moments;
    let distinct = [I2 - I1, I3 - I2].iter().all(|gap| *gap > DISTINCT * I3 || *gap < EQUAL * I3);
    let slowest = powers.response.frequencies().next().map_or(f64::INFINITY, |(frequency, _)| frequency);
    let driven = powers.response.driven_materials(initial);
    let softest = driven.iter().fold(1.0, |least: f64, material| least.min(material.modulus));
    body.cyclic().is_empty() && distinct && spin < STIFF_SPIN_RATIO * slowest * softest.sqrt()
}

/// Rate of the wobble, `P/2E_w`, over the polhode rate: what an average over its period leaves out. (Q3), (Q14)
fn change_per_radian(power: &dyn MeanPower, motion: &FreeRotation) -> f64 {
    let steady = motion.angular_momentum().powi(2) / (2.0 * motion.moments()[motion.mode().circled()]);
    let wobble = 2.0 * (motion.energy() - steady).abs();
    power.mean_power(motion) / wobble * motion.polhode_period() / TAU
}

/// Whether polynomial and harmonics have the same power wherever an evolution may lead: next to the separatrix the wobble is slow, so that the
/// start alone says nothing of the rest.
fn first_order(powers: &AveragePowers, initial: &FreeRotation) -> bool {
    let (moments, G) = (initial.moments(), initial.angular_momentum());
    let modes = [Mode::ShortAxis, Mode::LongAxis].into_iter().filter(|mode| mode.exists(moments));
    let mut motions =
        modes.flat_map(|mode| COMPARED_AT.map(|xi| FreeRotation::at_logit(moments, G, mode, xi)));
    motions.all(|motion| {
        apart(powers.polynomial.mean_power(&motion), powers.response.mean_power(&motion)) < FIRST_ORDER
    })
}
