//! Reversion of the series `K(ω)`: angular velocity and energy as polynomials in the angular momentum.
//! In this form `|K|` is exact at every truncation; the fixed-point iteration gains one degree, or more where low degrees vanish, per pass.
//! Equation (R11), docs/theory/03-reduction.md.

use super::slow_manifold::mapped;
use crate::math::polynomial::monomial::{exponents, index};
use crate::math::polynomial::{Homogeneous, Series};
use crate::math::sym3::{self, Sym};

/// Angular velocity as a polynomial in the angular momentum, `Ω(K)`, by reversion of `K(ω)` to the same degree. (R11)
///
/// `Ω = J⁻¹[K − k − Σ_{d≥2} K_d(Ω)]`, with the angular momentum `k` of wheels, fixes one more degree of `Ω` per application, starting
/// from `Ω₁ = J⁻¹(K − k)`.
pub(super) fn reverted(angular_momentum: &Series, J: Sym) -> Series {
    let inverse = sym3::inverse(J);
    let mut Omega = Series::zero(angular_momentum.degree(), 3);
    let mut first = Homogeneous::linear(&sym3::rows(inverse));
    let mut wheels = angular_momentum.part(1).clone();
    wheels.add_scaled(-1.0, &Homogeneous::linear(&sym3::rows(J)));
    first.add_scaled(1.0, &mapped(inverse, -1.0, &wheels));
    Omega.set(first);
    let Some(lowest) = (2..=angular_momentum.degree()).find(|d| angular_momentum.part(*d).amax() > 0.0)
    else {
        return Omega;
    };
    let mut known = 1;
    while known < angular_momentum.degree() {
        let reached = (known + lowest - 1).min(angular_momentum.degree());
        let deviation = composed(angular_momentum, lowest, &Omega, reached);
        for degree in 2..=reached {
            Omega.set(mapped(inverse, -1.0, deviation.part(degree)));
        }
        known = reached;
    }
    Omega
}

/// Energy as a polynomial in the angular momentum, `E(Ω(K))`, to degree `p + 2`. (R11)
pub(super) fn of_momentum(energy: &Series, Omega: &Series) -> Series {
    composed(energy, 2, Omega, energy.degree())
}

/// `Σ outer_d(inner)` over `d ≥ lowest`, to degree `highest`.
pub(super) fn composed(outer: &Series, lowest: usize, inner: &Series, highest: usize) -> Series {
    let rows = outer.rows();
    let mut sum = Series::zero(highest, rows);
    if rows == 0 {
        return sum;
    }
    let mut powers = vec![constant_one(highest)];
    for power in 0..=highest.min(outer.degree()) {
        if power > 0 {
            powers = raised(&powers, power, inner, highest);
        }
        for degree in power.max(lowest)..=highest.min(outer.degree()) {
            if outer.part(degree).row_of(power, 0).is_some() {
                add_composed(&mut sum, outer.part(degree), power, &powers);
            }
        }
    }
    sum
}

/// Adds the terms of the outer map that belong to monomials of one degree `power`, evaluated at the inner map.
fn add_composed(sum: &mut Series, outer: &Homogeneous, power: usize, powers: &[Series]) {
    let lift = outer.degree() - power;
    for row in 0..outer.rows() {
        let coefficients = outer.row_of(power, row).unwrap_or_default();
        for (coefficient, inner) in coefficients.iter().zip(powers).filter(|(c, _)| **c != 0.0) {
            for total in power..=sum.degree() - lift {
                sum.add_row(total + lift, row, *coefficient, (inner.part(total), 0));
            }
        }
    }
}

/// Every monomial of a degree in the components of `inner`, from those of the degree below.
fn raised(lower: &[Series], degree: usize, inner: &Series, highest: usize) -> Vec<Series> {
    exponents(degree)
        .map(|mut monomial| {
            let axis = (0..3).find(|axis| monomial[*axis] > 0).unwrap_or(0);
            monomial[axis] -= 1;
            let factor = &lower[index(monomial)];
            let mut product = Series::zero(highest, 1);
            for total in degree..=highest {
                product.set(factor.row_product(0, inner, axis, total));
            }
            product
        })
        .collect()
}

fn constant_one(highest: usize) -> Series {
    let mut one = Series::zero(highest, 1);
    let mut part = Homogeneous::zero(0, 1);
    part.row_mut(0)[0] = 1.0;
    one.set(part);
    one
}
