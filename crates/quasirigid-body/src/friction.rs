//! Friction of single coordinates beyond the damping matrix: laws that are not linear in the rate.
//! The slope of a law at rest is in the damping matrix, so that small motions need nothing else; the rest is here, in one place.
//! Equations (U10) to (U12), docs/theory/21-slosh.md.

/// Friction of a coordinate beyond that of the damping matrix. (U12)
#[derive(Clone, Debug, PartialEq)]
pub struct Friction {
    /// Name of the dissipator, as in the model file.
    pub name: String,
    /// Coordinate.
    pub coordinate: usize,
    /// Law.
    pub law: TubeFriction,
}

/// Friction of a slug of liquid that fills a length of a smooth circular tube and runs along it: laminar, turbulent and between, in a
/// straight tube and in a curved one. (U10)–(U12)
///
/// Developed flow: the slug has run for some diameters, and its rate changes slowly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TubeFriction {
    /// Reynolds number per rate of the coordinate (s), `2 a R/ν`.
    pub reynolds: f64,
    /// Generalised force per `f Re²` (N·m), `π ρ ν² L R/(16 a)`.
    pub unit: f64,
    /// Radius of the tube over that of its curvature, `a/R`; zero of a straight one.
    pub curvature: f64,
    /// What every force is multiplied by: 1 but in a body derived from another.
    pub share: f64,
}

/// Flow in a tube.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TubeFlow {
    /// Laminar.
    Laminar,
    /// Neither steadily laminar nor steadily turbulent.
    Transitional,
    /// Turbulent.
    Turbulent,
}

/// Dean number `Re √(a/R)` up to which a curved tube has the laminar friction of a straight one.
const LEAST_DEAN: f64 = 11.6;
/// Reynolds number up to which flow in a straight tube is laminar.
const LAMINAR: f64 = 2300.0;
/// Reynolds number from which it is turbulent, over that up to which it is laminar.
const TURBULENT: f64 = 4000.0 / LAMINAR;
/// Reynolds number above which friction falls less than by the power 1/4.
const BLASIUS: f64 = 5e4;
/// `Re (a/R)²` above which the power 1/20 takes over from the sum where that is the lesser.
const STRONGLY_CURVED: f64 = 100.0;

impl TubeFriction {
    /// Law of a slug with density (kg/m³), kinematic viscosity (m²/s) and length (m) in a tube of radius `radius` (m) bent to the radius `bend`
    /// (m), whose coordinate is the angle about the centre of the bend. (U12)
    #[must_use]
    pub fn of_ring([density, viscosity]: [f64; 2], length: f64, [radius, bend]: [f64; 2]) -> Self {
        let unit = std::f64::consts::PI * density * viscosity * viscosity * length * bend / (16.0 * radius);
        Self { reynolds: 2.0 * radius * bend / viscosity, unit, curvature: radius / bend, share: 1.0 }
    }

    /// Slope of the friction at rest, `8π ρν L R²` (N·m·s/rad), which belongs to the damping matrix. (U10)
    #[must_use]
    pub fn at_rest(&self) -> f64 {
        64.0 * self.share * self.unit * self.reynolds
    }

    /// Friction beyond that at rest (N·m) at a rate (rad/s), of the sign of the rate. (U12)
    #[must_use]
    pub fn beyond(&self, rate: f64) -> f64 {
        let Re = self.reynolds * rate.abs();
        (self.share * self.unit * (self.squared(Re) - 64.0 * Re)).copysign(rate)
    }

    /// Flow at a rate (rad/s).
    #[must_use]
    pub fn flow(&self, rate: f64) -> TubeFlow {
        let (Re, last) = (self.reynolds * rate.abs(), self.last_laminar());
        match Re {
            Re if Re <= last => TubeFlow::Laminar,
            Re if Re < TURBULENT * last => TubeFlow::Transitional,
            _ => TubeFlow::Turbulent,
        }
    }

    /// Darcy friction factor `f` at a Reynolds number. (U10)–(U12)
    #[must_use]
    pub fn factor(&self, Re: f64) -> f64 {
        self.squared(Re) / (Re * Re)
    }

    /// `f Re²`: laminar, turbulent, and between a monotone cubic that meets both with their slopes.
    fn squared(&self, Re: f64) -> f64 {
        let last = self.last_laminar();
        let first = TURBULENT * last;
        if Re <= last {
            return self.laminar(Re);
        }
        if Re >= first {
            return self.turbulent(Re);
        }
        let ends = [self.laminar(last), self.turbulent(first)];
        let slope = |value: &dyn Fn(f64) -> f64, at: f64, side: f64| {
            let step = 1e-6 * side * at;
            (value(at + step) - value(at)) / step
        };
        let slopes = [slope(&|Re| self.laminar(Re), last, -1.0), slope(&|Re| self.turbulent(Re), first, 1.0)];
        between([last, first], ends, slopes, Re)
    }

    /// Greatest Reynolds number of laminar flow. (U11)
    fn last_laminar(&self) -> f64 {
        (2e4 * self.curvature.powf(0.32)).max(LAMINAR)
    }

    /// `f Re²` of laminar flow. (U10), (U11)
    fn laminar(&self, Re: f64) -> f64 {
        let dean = Re * self.curvature.sqrt();
        if dean <= LEAST_DEAN {
            return 64.0 * Re;
        }
        64.0 * Re / (1.0 - (1.0 - (LEAST_DEAN / dean).powf(0.45)).powf(1.0 / 0.45))
    }

    /// `f Re²` of turbulent flow. (U10), (U11)
    fn turbulent(&self, Re: f64) -> f64 {
        let blasius = 0.3164 * Re.powf(-0.25);
        let straight = if Re < BLASIUS { blasius } else { blasius.max((1.8 * (Re / 6.9).log10()).powi(-2)) };
        let chi = Re * self.curvature * self.curvature;
        let sum = (0.304 + 0.029 * chi.powf(0.25)) / 0.3164;
        let curved = if chi > STRONGLY_CURVED { sum.min(chi.powf(0.05)) } else { sum };
        straight * curved.max(1.0) * Re * Re
    }
}

/// Cubic between two places with these values and slopes, the slopes cut to three times the chord, up to which it is monotone.
fn between([from, to]: [f64; 2], values: [f64; 2], slopes: [f64; 2], at: f64) -> f64 {
    let (width, s) = (to - from, (at - from) / (to - from));
    let rise = values[1] - values[0];
    let [start, end] = slopes.map(|slope| (slope * width).clamp(0.0, 3.0 * rise.max(0.0)));
    values[0] + s * s * (3.0 - 2.0 * s) * rise + s * (1.0 - s) * ((1.0 - s) * start - s * end)
}

impl Friction {
    /// Friction of a coordinate with another number, and with its force multiplied.
    pub(super) fn moved(&self, coordinate: usize, factor: f64) -> Self {
        let law = TubeFriction { share: factor * self.law.share, ..self.law };
        Self { coordinate, law, ..self.clone() }
    }

    /// Friction (in the unit of the coordinate's momentum per second) beyond the damping matrix, at the rates of all coordinates.
    #[must_use]
    pub fn force(&self, rate: &[f64]) -> f64 {
        self.law.beyond(rate[self.coordinate])
    }

    /// Power (W) that it takes.
    #[must_use]
    pub fn power(&self, rate: &[f64]) -> f64 {
        self.force(rate) * rate[self.coordinate]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ring(curvature: f64) -> TubeFriction {
        TubeFriction::of_ring([13530.0, 1.13e-7], 0.133, [0.0046, 0.0046 / curvature])
    }

    /// Hagen and Poiseuille, `Δp = 8 µ L v/a²`, on the cross-section at the distance `R`.
    #[test]
    fn slow_friction_is_that_of_poiseuille() {
        let (rho, nu, L, a, R) = (870.0, 2.3e-5, 0.41, 0.011, 0.6);
        let law = TubeFriction::of_ring([rho, nu], L, [a, R]);
        let per_rate = 8.0 * rho * nu * L * R / (a * a) * std::f64::consts::PI * a * a * R;
        assert!((law.at_rest() / per_rate - 1.0).abs() < 1e-14);
        assert_eq!(law.beyond(0.9 * LEAST_DEAN / law.curvature.sqrt() / law.reynolds), 0.0);
        assert_eq!(law.flow(0.0), TubeFlow::Laminar);
    }

    /// Numbers of the law of Prandtl and von Karman for a smooth tube, from which that of Blasius differs by 2.4 % at most; and those of a ring by the
    /// laws of White, and of Mori and Nakayama, as Caleb Bell's `fluids` 1.3.1 has them.
    #[test]
    fn friction_factors_are_those_of_charts() {
        let straight = ring(1e-9);
        for (Re, known) in
            [(1000.0, 0.064), (4000.0, 0.0399), (1e4, 0.0309), (1e5, 0.018), (1e6, 0.0116), (1e7, 0.0081)]
        {
            let found = straight.factor(Re);
            assert!((found / known - 1.0).abs() < 0.025, "{Re}: {found}");
        }
        let curved = ring(0.0362);
        let De = 3000.0 * 0.0362_f64.sqrt();
        let white = 64.0 / 3000.0 / (1.0 - (1.0 - (11.6 / De).powf(0.45)).powf(2.222_222));
        assert!((curved.factor(3000.0) / white - 1.0).abs() < 1e-6);
        let chi: f64 = 45500.0 * 0.0362 * 0.0362;
        let mori = 0.3 * 0.0362_f64.sqrt() * chi.powf(-0.2) * (1.0 + 0.112 * chi.powf(-0.2));
        assert!((curved.factor(45500.0) / mori - 1.0).abs() < 0.01, "{} {mori}", curved.factor(45500.0));
    }

    /// No jump, no fall and no energy from nothing, at any rate and curvature.
    #[test]
    fn friction_grows_with_the_rate() {
        for curvature in [1e-9, 1e-4, 1.2e-3, 0.0362, 0.0667] {
            let law = ring(curvature);
            let mut last = 0.0;
            for step in 0..4000 {
                let rate = 10f64.powf(-2.0 + 7.0 * f64::from(step) / 4000.0) / law.reynolds * 100.0;
                let force = law.at_rest() * rate + law.beyond(rate);
                assert!(force >= last, "{curvature} {}", rate * law.reynolds);
                assert!(step == 0 || force < 1.02 * last, "{curvature} {}", rate * law.reynolds);
                assert!(law.beyond(rate) >= 0.0 && law.beyond(-rate) == -law.beyond(rate));
                last = force;
            }
        }
    }
}
