//! Spherical harmonics of the loads of sunlight. Those of facets that nothing shades are exact, by the theorem of Funk and Hecke; what the
//! shadows take is integrated over the sphere, and the error of the sum is measured at directions of its own.
//! Equations (F28) and (F29), docs/theory/07-forces.md.

use super::{LAMBERT, SunlitShape, apart, mean_length, spread};
use crate::math::spherical_harmonics::{count, each_harmonic, sphere_rule};
use crate::math::threads::Team;
use crate::math::vec3::{add, cross, minus, scale};
use crate::model::force::SunlightLoads;
use quasirigid_mesh::surface::Facet;

/// Degrees that are tried.
const DEGREES: [usize; 6] = [8, 16, 24, 32, 40, 48];
/// Directions at which the error is measured.
const MEASURED: usize = 300;
/// Facets and directions of one task.
const TASK: usize = 64;
/// Torque over that of the whole surface on the radius of the sphere with this surface, which is rounding.
const ROUNDING: f64 = 1e-9;
/// Error of the torque from which it may not hold.
pub const UNRESOLVED: f64 = 0.1;

/// Sums of a facet in light: its area, its normal, its place, and the product of both.
type Sums = [f64; 10];

/// How well harmonics follow the sum over the facets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SunlightAccuracy {
    /// Root mean square of the torque about the centre of the volume over all directions (m³).
    pub torque: f64,
    /// Root mean square of its error, relative.
    pub error: f64,
    /// Greatest error of the directions tried, relative to the root mean square of the torque.
    pub greatest: f64,
    /// Root mean square of the error of the force, relative.
    pub force_error: f64,
}

impl SunlitShape {
    /// Loads as harmonics of the least degree whose error is within a tolerance, or of the highest one, and their error. (F29)
    #[must_use]
    pub fn harmonics(&self, tolerance: f64) -> (SunlightLoads, SunlightAccuracy) {
        let team = Team::new();
        let directions = spread(MEASURED);
        let known: Vec<[[f64; 3]; 2]> = team
            .map(tasks(&directions), |part| part.iter().map(|sun| self.loads(*sun)).collect::<Vec<_>>())
            .concat();
        let mut found = self.of_degree(DEGREES[0], &team);
        let mut accuracy = self.accuracy(&found, &directions, &known);
        for degree in &DEGREES[1..] {
            if accuracy.error <= tolerance {
                break;
            }
            found = self.of_degree(*degree, &team);
            accuracy = self.accuracy(&found, &directions, &known);
        }
        (found, accuracy)
    }

    fn accuracy(&self, loads: &SunlightLoads, at: &[[f64; 3]], known: &[[[f64; 3]; 2]]) -> SunlightAccuracy {
        let found: Vec<[[f64; 3]; 2]> = at.iter().map(|sun| loads.at(*sun)).collect();
        let errors = |which: usize| {
            known.iter().zip(&found).map(move |(known, found)| minus(known[which], found[which]))
        };
        let area = self.area();
        let radius = (area / (4.0 * std::f64::consts::PI)).sqrt();
        let torque = mean_length(known.iter().map(|loads| loads[1]));
        let unit = torque.max(ROUNDING * area * radius);
        let worst = known.iter().zip(&found).map(|(a, b)| apart([a[1], b[1]])).fold(0.0, f64::max);
        SunlightAccuracy {
            torque,
            error: mean_length(errors(1)) / unit,
            greatest: worst / unit,
            force_error: mean_length(errors(0)) / mean_length(known.iter().map(|loads| loads[0])),
        }
    }

    /// Harmonics of the loads up to a degree. (F29)
    fn of_degree(&self, degree: usize, team: &Team) -> SunlightLoads {
        let lit = self.lit_sums(degree + 1, team);
        let rule = sphere_rule(2 * degree + 2);
        let parts = team.map(tasks(&rule), |part| {
            let mut sums = vec![[0.0; 6]; count(degree)];
            for (sun, weight) in part {
                let mut loads = unshaded(&lit, degree + 1, *sun);
                self.take_shadows(&mut loads, *sun);
                let [[fx, fy, fz], [mx, my, mz]] = loads;
                let mut each = sums.iter_mut();
                each_harmonic(degree, *sun, |_, value| {
                    let share = weight * value;
                    if let Some(sum) = each.next() {
                        let loads = [fx, fy, fz, mx, my, mz];
                        sum.iter_mut().zip(loads).for_each(|(sum, load)| *sum += share * load);
                    }
                });
            }
            sums
        });
        SunlightLoads::new(self.center, degree, total(parts))
    }

    /// Harmonics of the sums over all facets that face the Sun, as if nothing shaded them. (F28)
    fn lit_sums(&self, degree: usize, team: &Team) -> Vec<Sums> {
        let factors = funk_hecke(degree);
        let parts = team.map(tasks(self.facets.list()), |part| {
            let mut sums = vec![[0.0; 10]; count(degree)];
            for Facet { normal, area, middle, .. } in part {
                let ([nx, ny, nz], [x, y, z]) = (*normal, *middle);
                let [cx, cy, cz] = cross(*middle, *normal);
                let own = [1.0, nx, ny, nz, x, y, z, cx, cy, cz].map(|value| value * area);
                let mut each = sums.iter_mut();
                each_harmonic(degree, *normal, |l, value| {
                    let share = factors[l] * value;
                    if let (Some(sum), true) = (each.next(), share != 0.0) {
                        sum.iter_mut().zip(own).for_each(|(sum, own)| *sum += share * own);
                    }
                });
            }
            sums
        });
        total(parts)
    }
}

/// Parts of a list, one a task.
fn tasks<T>(list: &[T]) -> Vec<&[T]> {
    list.chunks(TASK).collect()
}

/// Sum of the parts, in their order.
fn total<const N: usize>(parts: Vec<Vec<[f64; N]>>) -> Vec<[f64; N]> {
    let mut parts = parts.into_iter();
    let first = parts.next().unwrap_or_default();
    parts.fold(first, |mut sums, part| {
        for (sum, more) in sums.iter_mut().zip(part) {
            sum.iter_mut().zip(more).for_each(|(sum, more)| *sum += more);
        }
        sums
    })
}

/// Force and torque per pressure of facets that nothing shades, from the harmonics of their sums. (F29)
fn unshaded(lit: &[Sums], degree: usize, sun: [f64; 3]) -> [[f64; 3]; 2] {
    let mut sums = [0.0; 10];
    let mut each = lit.iter();
    each_harmonic(degree, sun, |_, value| {
        if let Some(part) = each.next() {
            sums.iter_mut().zip(part).for_each(|(sum, part)| *sum += value * part);
        }
    });
    let [area, nx, ny, nz, x, y, z, cx, cy, cz] = sums;
    let force = add(scale(area, sun), scale(LAMBERT, [nx, ny, nz]));
    let torque = add(cross([x, y, z], sun), scale(LAMBERT, [cx, cy, cz]));
    [force, torque].map(|load| load.map(|entry| -entry))
}

/// Factors `½∫₀¹ x P_l(x) dx` of harmonics in `max(0, n·s) = Σ ½∫₀¹ x P_l dx Y_lm(n) Y_lm(s)`. (F28)
fn funk_hecke(degree: usize) -> Vec<f64> {
    let mut factors = vec![0.0; degree + 1];
    factors[0] = 0.25;
    if degree > 0 {
        factors[1] = 1.0 / 6.0;
    }
    for l in (2..=degree).step_by(2) {
        // ∫₀¹ x P_l dx falls by −(l − 3)/(l + 2) from the even degree before
        factors[l] = -(l as f64 - 3.0) / (l as f64 + 2.0) * factors[l - 2];
    }
    factors
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::quadrature::gauss_legendre;
    use crate::math::spherical_harmonics::legendre;

    /// The integrals by Gauss's rule, of polynomials exactly.
    #[test]
    fn factors_are_half_the_integrals_of_legendre_polynomials() {
        let rule = gauss_legendre(20);
        for (l, factor) in funk_hecke(30).into_iter().enumerate() {
            let half = |[node, weight]: &[f64; 2]| {
                let x = 0.5 * (1.0 + node);
                0.25 * weight * x * legendre(l, x)[l]
            };
            let known: f64 = rule.iter().map(half).sum();
            assert!((factor - known).abs() < 1e-15, "{l}: {factor} {known}");
        }
    }
}
