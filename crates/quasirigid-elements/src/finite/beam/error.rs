//! Errors of beams: sections, ends and materials that are not possible.
//! Each message names the quantity and the bound it breaks, in the words of the model file.

use thiserror::Error;

/// Error of a section or of a beam.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq)]
pub enum BeamError {
    /// A quantity that must be above zero.
    #[error("the {quantity} of a beam is {value}; it must be finite and above zero")]
    NotPositive {
        /// The quantity.
        quantity: Quantity,
        /// Value given.
        value: f64,
    },
    /// A wall for which the section has no room.
    #[error("the {quantity} of a section is {value}, but there is room for less than {room}")]
    NoRoom {
        /// The thickness.
        quantity: Quantity,
        /// Thickness given (m).
        value: f64,
        /// Upper bound of the thickness (m).
        room: f64,
    },
    /// Plates of an I-beam that differ too much in thickness for the formula of its torsion constant.
    #[error(
        "the web of an I-beam is {web} m thick and its flanges are {flange} m; its torsion constant is known for \
         a web of 0.25 to 1.5 times the flanges: give the constants of this section themselves"
    )]
    Plates {
        /// Thickness of the web (m).
        web: f64,
        /// Thickness of the flanges (m).
        flange: f64,
    },
    /// A Poisson's ratio that no stable material has.
    #[error("Poisson's ratio is {value}; it must be above -1 and below 0.5")]
    Poisson {
        /// Value given.
        value: f64,
    },
    /// Ends that are the same place, or none.
    #[error("the ends {} and {} of a beam are not a finite distance apart", place(&ends[0]), place(&ends[1]))]
    NoLength {
        /// The ends (m).
        ends: [[f64; 3]; 2],
    },
    /// A direction that does not fix the rotation of the section about the beam.
    #[error(
        "the direction {} of a beam's section is not across the beam, which runs along {}; give one that is",
        place(direction),
        place(axis)
    )]
    NoDirection {
        /// The direction.
        direction: [f64; 3],
        /// Unit vector along the beam.
        axis: [f64; 3],
    },
}

/// A quantity of a section or of its material.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Size along `z`.
    Height,
    /// Size along `y`.
    Width,
    /// Outer radius.
    Radius,
    /// Thickness of a wall.
    Thickness,
    /// Thickness of the web of an I-beam.
    Web,
    /// Thickness of the flanges of an I-beam.
    Flange,
    /// Area.
    Area,
    /// Second moment `∫ z² dA`.
    SecondY,
    /// Second moment `∫ y² dA`.
    SecondZ,
    /// Torsion constant.
    Torsion,
    /// Effective area for shear along `y`.
    ShearY,
    /// Effective area for shear along `z`.
    ShearZ,
    /// Young's modulus.
    Young,
    /// Shear modulus.
    ShearModulus,
    /// Density.
    Density,
}

impl std::fmt::Display for Quantity {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Height => "height",
            Self::Width => "width",
            Self::Radius => "radius",
            Self::Thickness => "thickness",
            Self::Web => "thickness of the web",
            Self::Flange => "thickness of the flanges",
            Self::Area => "area",
            Self::SecondY => "second moment ∫z²dA",
            Self::SecondZ => "second moment ∫y²dA",
            Self::Torsion => "torsion constant",
            Self::ShearY => "shear area along y",
            Self::ShearZ => "shear area along z",
            Self::Young => "Young's modulus",
            Self::ShearModulus => "shear modulus",
            Self::Density => "density",
        })
    }
}

/// Accepts a quantity that is above zero.
pub(super) fn positive(quantity: Quantity, value: f64) -> Result<(), BeamError> {
    if value > 0.0 && value.is_finite() { Ok(()) } else { Err(BeamError::NotPositive { quantity, value }) }
}

/// A place or a direction, by its coordinates.
fn place([x, y, z]: &[f64; 3]) -> String {
    format!("({x}, {y}, {z})")
}
