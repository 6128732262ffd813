//! Section of a layered shell: membrane, coupling, bending and transverse shear stiffness, and mass per area.
//! Sections are sums over layers, so that the layers of one material make a section of their own and keep their own loss.
//! Classical lamination theory `[@jones1999]`.

use std::ops::Add;

use nalgebra::{Matrix2, Matrix3, Rotation2};

use super::error::{Constant, ShellError};

/// Section of a shell: stiffness and mass across its thickness, in the axes of the element, per unit of area:
///
/// ```text
/// N = A ε + B κ,     M = B ε + D κ,     Q = S γ
/// ```
///
/// with `ε, κ = (11, 22, 2·12)`; heights are above the nodes, along the normal. Sections add as their layers do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ShellSection {
    /// Membrane stiffness (N/m).
    pub A: Matrix3<f64>,
    /// Coupling (N).
    pub B: Matrix3<f64>,
    /// Bending stiffness (N·m).
    pub D: Matrix3<f64>,
    /// Stiffness in transverse shear (N/m).
    pub S: Matrix2<f64>,
    /// Mass (kg/m²).
    pub mass: f64,
    /// Moment of the mass in height (kg/m).
    pub first: f64,
    /// Second moment of the mass in height (kg).
    pub second: f64,
}

/// Layer of a material with two directions of its own, as unidirectional fibres have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ply {
    /// Young's moduli along and across the fibres (Pa).
    pub young: [f64; 2],
    /// Poisson's ratio `ν₁₂`: contraction across the fibres under tension along them.
    pub poisson: f64,
    /// Shear moduli `G₁₂`, `G₁₃`, `G₂₃` (Pa).
    pub shear: [f64; 3],
    /// Density (kg/m³).
    pub density: f64,
    /// Thickness (m).
    pub thickness: f64,
    /// Angle (rad) from the reference direction to the fibres, counter-clockwise seen against the normal.
    pub angle: f64,
}

/// Reissner's factor of a homogeneous section, used for every laminate, because a factor from the equilibrium of the layers is not a sum
/// over them.
const SHEAR_CORRECTION: f64 = 5.0 / 6.0;

impl ShellSection {
    /// The section of each layer at its place, from the lowest to the highest, with their common mid-surface `offset` (m)
    /// above the nodes: classical lamination theory `[@jones1999]`, with transverse shear in parallel. The laminate is
    /// their sum.
    ///
    /// # Errors
    /// A layer that no material can be.
    pub fn layers(plies: &[Ply], offset: f64) -> Result<Vec<Self>, ShellError> {
        if !offset.is_finite() {
            return Err(ShellError::NotFinite { name: Constant::Offset, value: offset });
        }
        plies.iter().enumerate().try_for_each(|(index, ply)| ply.check(index))?;
        let mut bottom = offset - 0.5 * plies.iter().map(|ply| ply.thickness).sum::<f64>();
        let layer = |ply: &Ply| {
            let height = bottom + 0.5 * ply.thickness;
            bottom += ply.thickness;
            ply.section(height)
        };
        Ok(plies.iter().map(layer).collect())
    }
}

impl Ply {
    /// The section of the layer alone, its middle at a `height` above the nodes.
    fn section(&self, height: f64) -> ShellSection {
        let t = self.thickness;
        // ∫ z² dz over the layer
        let second = t * (height.powi(2) + t.powi(2) / 12.0);
        let Q = self.plane_stress();
        ShellSection {
            A: t * Q,
            B: t * height * Q,
            D: second * Q,
            S: SHEAR_CORRECTION * t * self.transverse(),
            mass: self.density * t,
            first: self.density * t * height,
            second: self.density * second,
        }
    }

    /// Stiffness in plane stress (Pa), in the axes of the element.
    fn plane_stress(&self) -> Matrix3<f64> {
        let [E1, E2] = self.young;
        let share = 1.0 / (1.0 - self.poisson.powi(2) * E2 / E1);
        let across = share * self.poisson * E2;
        let own = Matrix3::new(share * E1, across, 0.0, across, share * E2, 0.0, 0.0, 0.0, self.shear[0]);
        let (s, c) = self.angle.sin_cos();
        // strains along the fibres from those along the axes, shear as an angle
        let turn =
            Matrix3::new(c * c, s * s, s * c, s * s, c * c, -s * c, -2.0 * s * c, 2.0 * s * c, c * c - s * s);
        turn.transpose() * own * turn
    }

    /// Transverse shear moduli (Pa), in the axes of the element.
    fn transverse(&self) -> Matrix2<f64> {
        let turn = Rotation2::new(self.angle).into_inner();
        turn * Matrix2::new(self.shear[1], 0.0, 0.0, self.shear[2]) * turn.transpose()
    }

    fn check(&self, ply: usize) -> Result<(), ShellError> {
        let constants = [
            (Constant::E1, self.young[0]),
            (Constant::E2, self.young[1]),
            (Constant::G12, self.shear[0]),
            (Constant::G13, self.shear[1]),
            (Constant::G23, self.shear[2]),
            (Constant::Density, self.density),
            (Constant::Thickness, self.thickness),
        ];
        for (name, value) in constants {
            let massless = matches!(name, Constant::Density) && value == 0.0;
            if !(massless || value > 0.0 && value.is_finite()) {
                return Err(ShellError::Positive { ply, name, value });
            }
        }
        let limit = self.young[0] / self.young[1];
        if !(self.poisson.powi(2) < limit) {
            return Err(ShellError::Poisson { ply, value: self.poisson, limit });
        }
        if !self.angle.is_finite() {
            return Err(ShellError::NotFinite { name: Constant::Angle, value: self.angle });
        }
        Ok(())
    }
}

impl Add for ShellSection {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            A: self.A + other.A,
            B: self.B + other.B,
            D: self.D + other.D,
            S: self.S + other.S,
            mass: self.mass + other.mass,
            first: self.first + other.first,
            second: self.second + other.second,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CARBON: Ply = Ply {
        young: [140e9, 9e9],
        poisson: 0.3,
        shear: [5e9, 4e9, 3e9],
        density: 1600.0,
        thickness: 1e-3,
        angle: 0.0,
    };

    /// `Q₁₁`, `Q₂₂`, `Q₁₂` of the layer `[@jones1999]`.
    fn moduli() -> [f64; 3] {
        let share = 1.0 - 0.3 * 0.3 * 9.0 / 140.0;
        [140e9 / share, 9e9 / share, 0.3 * 9e9 / share]
    }

    fn near(value: f64, expected: f64) {
        assert!((value - expected).abs() <= 1e-13 * expected.abs(), "{value} {expected}");
    }

    /// Fibres along the axis below, across it above: stiffer along it below the middle.
    #[test]
    fn layers_across_each_other_couple_stretch_and_bending() {
        let across = Ply { angle: std::f64::consts::FRAC_PI_2, ..CARBON };
        let section = ShellSection::laminate(&[CARBON, across], 0.0).unwrap();
        let [Q11, Q22, Q12] = moduli();
        near(section.A[(0, 0)], 1e-3 * (Q11 + Q22));
        near(section.A[(0, 1)], 2e-3 * Q12);
        near(section.A[(2, 2)], 2e-3 * 5e9);
        near(section.B[(0, 0)], -0.5e-6 * (Q11 - Q22));
        near(section.B[(1, 1)], 0.5e-6 * (Q11 - Q22));
        near(section.D[(1, 1)], 1e-9 / 3.0 * (Q11 + Q22));
        near(section.S[(0, 0)], 5.0 / 6.0 * 1e-3 * (4e9 + 3e9));
    }

    /// `[@jones1999]`, at an angle at which no entry vanishes.
    #[test]
    fn fibres_at_an_angle_couple_stretch_and_shear() {
        let angle = 0.6_f64;
        let section = ShellSection::laminate(&[Ply { angle, ..CARBON }], 0.0).unwrap();
        let ([Q11, Q22, Q12], Q66) = (moduli(), 5e9);
        let (s, c) = angle.sin_cos();
        let mixed = Q11 - Q12 - 2.0 * Q66;
        let other = Q12 - Q22 + 2.0 * Q66;
        near(
            section.A[(0, 0)],
            1e-3 * (Q11 * c.powi(4) + 2.0 * (Q12 + 2.0 * Q66) * (s * c).powi(2) + Q22 * s.powi(4)),
        );
        near(section.A[(0, 2)], 1e-3 * (mixed * s * c.powi(3) + other * s.powi(3) * c));
        near(section.A[(1, 2)], 1e-3 * (mixed * s.powi(3) * c + other * s * c.powi(3)));
        near(section.S[(0, 1)], 5.0 / 6.0 * 1e-3 * (4e9 - 3e9) * s * c);
        near(section.S[(0, 0)], 5.0 / 6.0 * 1e-3 * (4e9 * c * c + 3e9 * s * s));
    }

    /// The axes theorem, for stiffness and mass alike.
    #[test]
    fn an_offset_shifts_the_moments() {
        let section = |offset: f64| ShellSection::laminate(&[CARBON], offset).unwrap();
        let (middle, above) = (section(0.0), section(7e-3));
        near(above.B[(0, 1)], 7e-3 * middle.A[(0, 1)]);
        near(above.D[(0, 0)], middle.D[(0, 0)] + 4.9e-5 * middle.A[(0, 0)]);
        near(above.first, 7e-3 * 1.6);
        near(above.second, 1.6 * (1e-6 / 12.0 + 4.9e-5));
        assert_eq!((middle.first, above.mass), (0.0, 1.6));
    }

    #[test]
    fn what_is_no_ply_is_refused() {
        let refused = |ply: Ply| ShellSection::laminate(&[CARBON, ply], 0.0).unwrap_err();
        let thin = refused(Ply { thickness: 0.0, ..CARBON });
        assert_eq!(thin, ShellError::Positive { ply: 1, name: Constant::Thickness, value: 0.0 });
        assert_eq!(thin.to_string(), "ply 2: thickness = 0; it must be positive and finite");
        let limit: f64 = 140.0 / 9.0;
        let poisson = |value: f64| ShellSection::laminate(&[Ply { poisson: value, ..CARBON }], 0.0);
        assert!(poisson(0.999 * limit.sqrt()).is_ok());
        assert!(matches!(poisson(1.001 * limit.sqrt()), Err(ShellError::Poisson { .. })));
        assert!(matches!(poisson(f64::NAN), Err(ShellError::Poisson { .. })));
        assert!(matches!(refused(Ply { angle: f64::NAN, ..CARBON }), ShellError::NotFinite { .. }));
        assert!(matches!(ShellSection::laminate(&[CARBON], f64::NAN), Err(ShellError::NotFinite { .. })));
    }
}
