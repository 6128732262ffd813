//! Cross-sections of beams: area, second moments, torsion constant and effective shear areas from shapes.
//! Only shapes whose shear centre is the centroid are here: the element couples no bending with twist. Accuracy stands with each.
//! Shear areas after Cowper `[@cowper1966]`, torsion of I-beams after El Darwish and Johnston `[@eldarwish1965]`.

use std::f64::consts::PI;

use super::error::{BeamError, Quantity, positive};

/// Cross-section of a beam, for principal axes `y` and `z` through its centroid.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Section {
    /// Area `A` (m²).
    pub area: f64,
    /// Second moment `∫ z² dA` (m⁴): bending in the plane of the beam and `z`.
    pub second_y: f64,
    /// Second moment `∫ y² dA` (m⁴): bending in the plane of the beam and `y`.
    pub second_z: f64,
    /// Saint-Venant's torsion constant (m⁴).
    pub torsion: f64,
    /// Effective area (m²) for shear along `y`; infinite where shear is neglected (Euler–Bernoulli).
    pub shear_y: f64,
    /// Effective area (m²) for shear along `z`; infinite where shear is neglected.
    pub shear_z: f64,
}

/// Form of a cross-section: heights are along `z`, widths along `y`, all lengths in metres and outer ones.
///
/// In all of them the shear centre is the centroid. Channels and angles are not among them: a force through their centroid twists them, and
/// the element has no such coupling.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SectionShape {
    /// A solid rectangle. Torsion by Saint-Venant's series, to rounding.
    Rectangle {
        /// Size along `z`.
        height: f64,
        /// Size along `y`.
        width: f64,
    },
    /// A solid circle.
    Circle {
        /// Radius.
        radius: f64,
    },
    /// A circular tube; torsion exact for a wall of any thickness.
    Tube {
        /// Outer radius.
        radius: f64,
        /// Thickness of the wall.
        thickness: f64,
    },
    /// A rectangular tube with a wall of one thickness.
    ///
    /// Torsion by Bredt's formula and the torsion of the walls themselves, `2 t b²h²/(b + h) + ⅔ t³ (b + h)` between the middles of the
    /// walls: 2 % below the exact constant where the wall is 1/20 of the side, 6 % at 1/5, at most 6.1 % in squares of any wall (finite
    /// elements on the section).
    Box {
        /// Size along `z`.
        height: f64,
        /// Size along `y`.
        width: f64,
        /// Thickness of the wall.
        thickness: f64,
    },
    /// A doubly symmetric I: flanges along `y`, the web along `z`.
    ///
    /// Torsion by the sum over the plates `⅓ Σ b t³` with corrections at the junctions and the ends `[@eldarwish1965]`, for webs of 0.25 to
    /// 1.5 times the thickness of the flanges; others are refused. The constant is within 2 % of finite elements on the section where the
    /// flanges are at least four times as wide as thick. The resistance of the flanges to warping is left out. So is the web from the shear
    /// along the flanges.
    IBeam {
        /// Size along `z`.
        height: f64,
        /// Size of the flanges along `y`.
        width: f64,
        /// Thickness of the web.
        web: f64,
        /// Thickness of the flanges.
        flange: f64,
    },
    /// Any section, by its constants, which are as in [`Section`]; its shear centre must be its centroid.
    General {
        /// Area (m²).
        area: f64,
        /// Second moment `∫ z² dA` (m⁴).
        second_y: f64,
        /// Second moment `∫ y² dA` (m⁴).
        second_z: f64,
        /// Torsion constant (m⁴).
        torsion: f64,
        /// Effective areas (m²) for shear along `y` and `z`; `None` neglects shear.
        shear: Option<[f64; 2]>,
    },
}

impl SectionShape {
    /// Constants of the section; its effective areas for shear, by Cowper's coefficients `[@cowper1966]`, need
    /// Poisson's ratio of the material.
    ///
    /// # Errors
    /// [`BeamError`]: a size that is not positive, walls without room, an I-beam of very different plates, or
    /// Poisson's ratio.
    pub fn section(&self, poisson: f64) -> Result<Section, BeamError> {
        if !(poisson > -1.0 && poisson < 0.5) {
            return Err(BeamError::Poisson { value: poisson });
        }
        self.check()?;
        Ok(match *self {
            Self::Rectangle { height, width } => rectangle(height, width, poisson),
            Self::Circle { radius } => tube(radius, radius, poisson),
            Self::Tube { radius, thickness } => tube(radius, thickness, poisson),
            Self::Box { height, width, thickness } => hollow(height, width, thickness, poisson),
            Self::IBeam { height, width, web, flange } => i_beam([height, width], [web, flange], poisson),
            Self::General { area, second_y, second_z, torsion, shear } => {
                let [shear_y, shear_z] = shear.unwrap_or([f64::INFINITY; 2]);
                Section { area, second_y, second_z, torsion, shear_y, shear_z }
            }
        })
    }

    /// Accepts sizes that are positive, and walls with room.
    fn check(&self) -> Result<(), BeamError> {
        use Quantity::{Area, Flange, Height, Radius, SecondY, SecondZ, ShearY, ShearZ};
        use Quantity::{Thickness, Torsion, Web, Width};
        let all =
            |sizes: &[(Quantity, f64)]| sizes.iter().try_for_each(|(name, size)| positive(*name, *size));
        match *self {
            Self::Rectangle { height, width } => all(&[(Height, height), (Width, width)]),
            Self::Circle { radius } => all(&[(Radius, radius)]),
            Self::Tube { radius, thickness } => {
                all(&[(Radius, radius), (Thickness, thickness)])?;
                room(Thickness, thickness, radius)
            }
            Self::Box { height, width, thickness } => {
                all(&[(Height, height), (Width, width), (Thickness, thickness)])?;
                room(Thickness, thickness, 0.5 * height.min(width))
            }
            Self::IBeam { height, width, web, flange } => {
                all(&[(Height, height), (Width, width), (Web, web), (Flange, flange)])?;
                room(Web, web, width)?;
                room(Flange, flange, 0.5 * height)?;
                let known = (0.25..=1.5).contains(&(web / flange));
                if known { Ok(()) } else { Err(BeamError::Plates { web, flange }) }
            }
            Self::General { area, second_y, second_z, torsion, shear } => {
                all(&[(Area, area), (SecondY, second_y), (SecondZ, second_z), (Torsion, torsion)])?;
                shear.map_or(Ok(()), |[y, z]| all(&[(ShearY, y), (ShearZ, z)]))
            }
        }
    }
}

/// Accepts a thickness below a bound.
fn room(quantity: Quantity, value: f64, room: f64) -> Result<(), BeamError> {
    if value < room { Ok(()) } else { Err(BeamError::NoRoom { quantity, value, room }) }
}

fn rectangle(height: f64, width: f64, poisson: f64) -> Section {
    let area = height * width;
    let effective = area * plate(poisson);
    Section {
        area,
        second_y: width * height.powi(3) / 12.0,
        second_z: height * width.powi(3) / 12.0,
        torsion: rectangle_torsion(height.max(width), height.min(width)),
        shear_y: effective,
        shear_z: effective,
    }
}

/// Cowper's coefficient of a rectangle.
fn plate(poisson: f64) -> f64 {
    10.0 * (1.0 + poisson) / (12.0 + 11.0 * poisson)
}

/// `⅓ a b³ [1 − 192 b/(π⁵ a) Σ tanh(nπa/2b)/n⁵]` over odd `n`, for sides `a ≥ b`.
fn rectangle_torsion(long: f64, short: f64) -> f64 {
    // The terms after n = 801 add up to less than 1e-15 of the sum, which is itself at most half of the number it is subtracted from.
    let term = |n: f64| (0.5 * n * PI * long / short).tanh() / n.powi(5);
    let sum: f64 = (0..=400).rev().map(|i| term(f64::from(2 * i + 1))).sum();
    long * short.powi(3) / 3.0 * (1.0 - 192.0 * short / (PI.powi(5) * long) * sum)
}

/// Tube with a wall up to the whole radius. Its coefficient is Cowper's for the hollow circle.
fn tube(outer: f64, thickness: f64, poisson: f64) -> Section {
    let inner = outer - thickness;
    let area = PI * thickness * (2.0 * outer - thickness);
    let second = 0.25 * area * (outer.powi(2) + inner.powi(2));
    let square = (inner / outer).powi(2);
    let both = (1.0 + square).powi(2);
    let hollow = (20.0 + 12.0 * poisson) * square;
    let effective = area * 6.0 * (1.0 + poisson) * both / ((7.0 + 6.0 * poisson) * both + hollow);
    Section {
        area,
        second_y: second,
        second_z: second,
        torsion: 2.0 * second,
        shear_y: effective,
        shear_z: effective,
    }
}

/// Rectangular tube; `h` and `b` are between the middles of its walls.
fn hollow(height: f64, width: f64, thickness: f64, poisson: f64) -> Section {
    let [h, b] = [height, width].map(|size| size - thickness);
    let area = 2.0 * thickness * (h + b);
    let along = |h: f64, b: f64| {
        let m = b / h;
        let flanges = 10.0 * m.powi(3) * (3.0 + poisson + 3.0 * m);
        area * thin_walled(m, flanges, poisson)
    };
    Section {
        area,
        second_y: plates([height, width], [2.0 * thickness, thickness]),
        second_z: plates([width, height], [2.0 * thickness, thickness]),
        torsion: thickness * (b + h) * (2.0 * (b * h / (b + h)).powi(2) + 2.0 / 3.0 * thickness.powi(2)),
        shear_y: along(b, h),
        shear_z: along(h, b),
    }
}

/// Doubly symmetric I. Shear along the flanges is borne by them, as rectangles.
fn i_beam([height, width]: [f64; 2], [web, flange]: [f64; 2], poisson: f64) -> Section {
    let (h, clear) = (height - flange, height - 2.0 * flange);
    let area = 2.0 * width * flange + clear * web;
    let (m, n) = (2.0 * width * flange / (h * web), width / h);
    let flanges = n.powi(2) * (30.0 * (m + m * m) + 5.0 * poisson * (8.0 * m + 9.0 * m * m));
    let ratio = web / flange;
    // Diameter (over the flange) of the circle in the junction, and its share of the torsion.
    let circle = 1.0 + 0.25 * ratio.powi(2);
    let junction = 2.0 * (-0.042 + 0.2204 * ratio - 0.0725 * ratio.powi(2)) * circle.powi(4) - 0.42;
    Section {
        area,
        second_y: plates([height, width], [web, flange]),
        second_z: (2.0 * flange * width.powi(3) + clear * web.powi(3)) / 12.0,
        torsion: (2.0 * width * flange.powi(3) + clear * web.powi(3)) / 3.0 + junction * flange.powi(4),
        shear_y: 2.0 * width * flange * plate(poisson),
        shear_z: area * thin_walled(m, flanges, poisson),
    }
}

/// Second moment of two flanges and the webs between them, which have this thickness together.
fn plates([height, width]: [f64; 2], [webs, flange]: [f64; 2]) -> f64 {
    let arm = 0.5 * (height - flange);
    2.0 * width * flange * (flange.powi(2) / 12.0 + arm.powi(2))
        + webs * (height - 2.0 * flange).powi(3) / 12.0
}

/// Cowper's coefficient of two flanges with one web or two: `m` is the area of the flanges over that of the webs,
/// `flanges` the term of the shear in the flanges.
fn thin_walled(m: f64, flanges: f64, poisson: f64) -> f64 {
    let straight = 12.0 + 72.0 * m + 150.0 * m.powi(2) + 90.0 * m.powi(3);
    let lateral = 11.0 + 66.0 * m + 135.0 * m.powi(2) + 90.0 * m.powi(3);
    10.0 * (1.0 + poisson) * (1.0 + 3.0 * m).powi(2) / (straight + poisson * lateral + flanges)
}

#[cfg(test)]
mod tests;
