//! Shares of parts and dissipators in the energy and the dissipation of a mode. (M5)

use std::collections::BTreeMap;

use nalgebra::{Complex, Vector3};

use crate::math::sparse::SparseRows;
use crate::math::sym3;
use crate::model::impedance;
use crate::model::{FlexibleBody, LiquidMemory, SpinCoefficients};

/// Liquid whose impedance is known, with the eigenvalue and the angles about its axes.
pub(super) type LiquidMotion<'a> = (&'a LiquidMemory, Complex<f64>, &'a [Complex<f64>]);

/// Twice the mean kinetic energy of the carrying body and of each part, by name; negative where a part moves against the momentum of its
/// coordinates.
pub(super) fn moving(
    body: &FlexibleBody,
    coefficients: &SpinCoefficients,
    delta: [Complex<f64>; 3],
    rate: &[Complex<f64>],
    liquids: &[LiquidMotion<'_>],
) -> Vec<(String, f64)> {
    let SpinCoefficients { inertia, h, .. } = coefficients;
    let [re, im] = [0, 1]
        .map(|part| rate.iter().map(|rate| if part == 0 { rate.re } else { rate.im }).collect::<Vec<f64>>());
    let (re, im) = (coefficients.mass.times(&re), coefficients.mass.times(&im));
    let mut K = sym3::rows(*inertia).map(|row| row[0] * delta[0] + row[1] * delta[1] + row[2] * delta[2]);
    let mut parts: Vec<(String, f64)> = vec![("body".to_owned(), 0.0)];
    let mut places: BTreeMap<&str, usize> = BTreeMap::new();
    let mut of_structure = 0.0;
    for (j, coordinate) in body.coordinates().iter().enumerate() {
        let turned = h[j][0] * delta[0] + h[j][1] * delta[1] + h[j][2] * delta[2];
        let momentum = Complex::new(re[j], im[j]) + turned;
        let energy = (rate[j].conj() * momentum).re;
        (0..3).for_each(|axis| K[axis] += rate[j] * h[j][axis]);
        if coordinate.is_shape() {
            of_structure += energy;
            continue;
        }
        match places.get(coordinate.part()) {
            Some(place) => parts[*place].1 += energy,
            None => {
                places.insert(coordinate.part(), parts.len());
                parts.push((coordinate.part().to_owned(), energy));
            }
        }
    }
    parts.extend(split(body, rate, of_structure));
    for (liquid, lambda, angles) in liquids {
        let name = body.coordinates()[liquid.coordinates.start].part();
        let mut energy = 0.0;
        for (axis, angle) in liquid.axes.iter().zip(*angles) {
            let rate = lambda * angle;
            let turned = axis[0] * delta[0] + axis[1] * delta[1] + axis[2] * delta[2];
            energy += liquid.inertia * (rate.conj() * (rate + turned)).re;
            (0..3).for_each(|i| K[i] += rate * liquid.inertia * axis[i]);
        }
        match parts[1..].iter_mut().find(|(known, _)| known == name) {
            Some((_, sum)) => *sum += energy,
            None => parts.push((name.to_owned(), energy)),
        }
    }
    parts[0].1 = (0..3).map(|axis| (delta[axis].conj() * K[axis]).re).sum();
    parts
}

/// Splits the energy of a structure among its parts in proportion to their energy relative to the body.
fn split(body: &FlexibleBody, rate: &[Complex<f64>], energy: f64) -> Vec<(String, f64)> {
    let own: Vec<f64> = body.part_masses().iter().map(|part| form(&part.mass, rate).max(0.0)).collect();
    let sum: f64 = own.iter().sum();
    if !(sum > 0.0) {
        return if energy == 0.0 { Vec::new() } else { vec![("structure".to_owned(), energy)] };
    }
    let parts = body.part_masses().iter().zip(own);
    parts.map(|(part, own)| (part.name.clone(), energy * own / sum)).collect()
}

/// Names of the parts that move most in a structure: all with at least half of the energy of the first.
fn parts_that_move(body: &FlexibleBody, moved: &[(String, f64)]) -> String {
    let of_structure = |name: &str| body.part_masses().iter().any(|part| part.name == name);
    let own = moved.iter().filter(|(name, _)| of_structure(name));
    let most = own.clone().fold(0.0_f64, |most, (_, energy)| most.max(energy.abs()));
    let names = own.filter(|(_, energy)| energy.abs() >= 0.5 * most).map(|(name, _)| format!("{name:?}"));
    names.collect::<Vec<_>>().join(" and ")
}

/// Name of the largest motion beside that of the body: a coordinate, parts of a structure, or a liquid with more kinetic energy than the
/// part of that coordinate.
pub(super) fn leading(
    body: &FlexibleBody,
    moved: &[(String, f64)],
    largest: Option<usize>,
    liquids: &[LiquidMotion<'_>],
) -> Option<String> {
    let energy =
        |part: &str| moved.iter().find(|(name, _)| name == part).map_or(0.0, |(_, energy)| energy.abs());
    let flowing = liquids
        .iter()
        .map(|(liquid, ..)| body.coordinates()[liquid.coordinates.start].part())
        .max_by(|a, b| energy(a).total_cmp(&energy(b)));
    let own = largest.map(|j| &body.coordinates()[j]);
    let own =
        own.filter(|own| own.is_shape() || flowing.is_none_or(|liquid| energy(own.part()) >= energy(liquid)));
    let named = own.map(|own| match own.is_shape() && !body.part_masses().is_empty() {
        true => parts_that_move(body, moved),
        false => own.name.clone(),
    });
    named.or_else(|| flowing.map(str::to_owned))
}

/// Decay rate, as a share of the eigenvalue, up to which the power of a liquid is a loss alone.
const SLOW_DECAY_RATIO: f64 = 1e-3;

/// Share below which an entry is not listed.
const SHOWN: f64 = 1e-3;

/// Shares of a sum, by name, of at least `SHOWN`.
pub(super) fn listed(list: Vec<(String, f64)>, sum: f64) -> Vec<(String, f64)> {
    let shares = list.into_iter().map(|(name, value)| (name, value / sum));
    shares.filter(|(_, share)| *share >= SHOWN).collect()
}

/// Shares of what is taken from a motion in all, or given to it where that is more; negative for what gives.
pub(super) fn balance(list: Vec<(String, f64)>) -> Vec<(String, f64)> {
    let sum = |sign: f64| list.iter().map(|(_, power)| (sign * power).max(0.0)).sum::<f64>();
    let whole = sum(1.0).max(sum(-1.0));
    let shares = list.into_iter().map(|(name, power)| (name, power / whole));
    shares.filter(|(_, share)| share.abs() >= SHOWN).collect()
}

/// True if shares of the dissipation are defined: the impedance of a liquid contains stored energy too, which a fast decay gives back.
pub(super) fn tellable(lambda: Complex<f64>, liquids: usize, dissipators: usize) -> bool {
    liquids == 0 || dissipators == 1 || lambda.re.abs() <= SLOW_DECAY_RATIO * lambda.norm()
}

/// `xᴴBx` of a symmetric matrix, positive semi-definite; zero where the sum is rounding of its terms, whose sign is arbitrary.
pub(super) fn form(matrix: &SparseRows<f64>, x: &[Complex<f64>]) -> f64 {
    let (mut sum, mut size) = (0.0, 0.0);
    for (j, k, entry) in matrix.iter() {
        let term = entry * (x[j].conj() * x[k]).re;
        sum += term;
        size += term.abs();
    }
    if sum.abs() > matrix.size() as f64 * f64::EPSILON * size { sum } else { 0.0 }
}

/// Twice the mean power that each dissipator takes from a motion `e^{λt}`, by name.
pub(super) fn dissipation(
    body: &FlexibleBody,
    omega: [f64; 3],
    lambda: Complex<f64>,
    q: &[Complex<f64>],
    liquids: &[LiquidMotion<'_>],
) -> Vec<(String, f64)> {
    let square = lambda.norm_sqr();
    let form = |matrix: &SparseRows<f64>| form(matrix, q);
    let mut lost: Vec<(String, f64)> = body
        .dissipators()
        .iter()
        .map(|dissipator| {
            let damped = square * form(&dissipator.damping);
            let material = dissipator.loss.as_ref().map_or(0.0, |loss| {
                let [_, lag] = loss.rheology.continued([lambda.re, lambda.im]);
                lag * lambda.im * form(&loss.stiffness)
            });
            (dissipator.name.clone(), damped + material)
        })
        .collect();
    for (memory, lambda, angles) in liquids {
        let Z = impedance(memory, *lambda, omega.into());
        let rate = memory.axes.iter().zip(*angles).fold(
            Vector3::zeros(),
            |sum: Vector3<Complex<f64>>, (axis, x)| {
                sum + Vector3::from(*axis).map(Complex::from) * (lambda * x)
            },
        );
        let power = rate.dotc(&(Z * rate)).re;
        let name = body.coordinates()[memory.coordinates.start].part();
        match lost.iter_mut().find(|(known, _)| known == name) {
            Some((_, sum)) => *sum += power,
            None => lost.push((name.to_owned(), power)),
        }
    }
    lost
}
