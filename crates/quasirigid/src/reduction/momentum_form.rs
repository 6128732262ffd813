use super::manifold::mapped;
use crate::math::polynomial::monomial::{exponents, index};
use crate::math::polynomial::{Homogeneous, Series};
use crate::math::sym::{self, Sym};

/// Spin as a polynomial in the momentum, `Ω(K)`, by reversion of `K(ω)` to the same degree. (R11)
///
/// `Ω = J⁻¹[K − Σ_{d≥2} K_d(Ω)]` fixes one more degree of `Ω` each time it is applied, starting from `Ω₁ = J⁻¹K`.
pub(super) fn reverted(momentum: &Series, J: Sym) -> Series {
    let inverse = sym::inverse(J);
    let mut Omega = Series::zero(momentum.degree(), 3);
    Omega.set(Homogeneous::linear(&sym::rows(inverse)));
    let Some(lowest) = (2..=momentum.degree()).find(|d| momentum.part(*d).amax() > 0.0) else {
        return Omega;
    };
    let mut known = 1;
    while known < momentum.degree() {
        let reached = (known + lowest - 1).min(momentum.degree());
        let deviation = composed(momentum, lowest, &Omega, reached);
        for degree in 2..=reached {
            Omega.set(mapped(inverse, -1.0, deviation.part(degree)));
        }
        known = reached;
    }
    Omega
}

/// Energy as a polynomial in the momentum, `E(Ω(K))`, to degree `p + 2`. (R11)
pub(super) fn of_momentum(energy: &Series, Omega: &Series) -> Series {
    composed(energy, 2, Omega, energy.degree())
}

/// `Σ outer_d(inner)` over `d ≥ lowest`, to degree `highest`.
fn composed(outer: &Series, lowest: usize, inner: &Series, highest: usize) -> Series {
    let rows = outer.rows();
    let mut sum = Series::zero(highest, rows);
    let mut powers = vec![constant_one(highest)];
    for degree in 1..=highest.min(outer.degree()) {
        powers = raised(&powers, degree, inner, highest);
        if degree < lowest {
            continue;
        }
        for (term, power) in powers.iter().enumerate() {
            for total in degree..=highest {
                let mut part = sum.part(total).clone();
                for row in 0..rows {
                    part.add_row(row, outer.part(degree).row(row)[term], (power.part(total), 0));
                }
                sum.set(part);
            }
        }
    }
    sum
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
