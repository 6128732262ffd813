use thiserror::Error;

use crate::model::{InertiaError, RheologyError};

/// An element that no body can have: where it is, which of its values is wrong, and what is wrong with it.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("{place}: {field}: {problem}")]
pub struct ElementError {
    /// The element.
    pub place: Place,
    /// The value.
    pub field: Field,
    /// What is wrong.
    pub problem: Problem,
}

/// An element of an [`Assembly`](super::Assembly), by its index in the list of its kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// The carrier.
    Carrier,
    /// A material point.
    Point(usize),
    /// A spring.
    Spring(usize),
    /// A hinged appendage.
    Hinged(usize),
    /// An ellipsoid.
    Ellipsoid(usize),
    /// A solid inside a closed surface.
    Surface(usize),
    /// The support.
    Support,
    /// An external force.
    Force(usize),
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Carrier => write!(f, "carrier"),
            Self::Point(index) => write!(f, "point {}", index + 1),
            Self::Spring(index) => write!(f, "spring {}", index + 1),
            Self::Hinged(index) => write!(f, "hinged appendage {}", index + 1),
            Self::Ellipsoid(index) => write!(f, "ellipsoid {}", index + 1),
            Self::Surface(index) => write!(f, "surface {}", index + 1),
            Self::Support => write!(f, "support"),
            Self::Force(index) => write!(f, "force {}", index + 1),
        }
    }
}

/// A value of an element; its text is the key of the model file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Field {
    /// Unique name.
    Name,
    /// Mass.
    Mass,
    /// Centre of mass.
    CenterOfMass,
    /// Inertia tensor.
    Inertia,
    /// Equilibrium position.
    Position,
    /// Motion left by the constraints.
    Motion,
    /// First end of a spring.
    From,
    /// Second end of a spring.
    To,
    /// The carrier's end of an axial spring.
    Anchor,
    /// Stiffness.
    Stiffness,
    /// Damping.
    Damping,
    /// Place of a hinge.
    Hinge,
    /// Axes of a hinge.
    Axes,
    /// Semi-axes of an ellipsoid.
    SemiAxes,
    /// Centre of an ellipsoid.
    Center,
    /// Degree of the polynomials of a displacement.
    Degree,
    /// Density of a material.
    Density,
    /// Young's modulus of a material.
    Young,
    /// Poisson's ratio of a material.
    Poisson,
    /// How a material answers periodic strain.
    Rheology,
    /// The fixed or driven point of a support.
    FixedPoint,
    /// Velocity of a driven point at the start.
    Velocity,
    /// Acceleration of gravity.
    Acceleration,
    /// Part that a force acts on.
    On,
    /// Place on the carrier where a force acts.
    At,
    /// Coefficient of a drag.
    Coefficient,
    /// Amplitude of a torque.
    Torque,
    /// Amplitude of a thrust.
    Force,
    /// Magnetic dipole moment.
    Moment,
    /// Uniform magnetic field.
    MagneticField,
    /// Strength of the dipole whose magnetic field it is.
    Dipole,
    /// Frequency of a periodic force.
    Frequency,
    /// Phase of a periodic force.
    Phase,
    /// Gravitational parameter of an orbit.
    GravitationalParameter,
    /// Semi-major axis of an orbit.
    SemiMajorAxis,
    /// Eccentricity of an orbit.
    Eccentricity,
    /// Inclination of an orbit.
    Inclination,
    /// Longitude of the ascending node of an orbit.
    Node,
    /// Argument of the periapsis of an orbit.
    Periapsis,
    /// Mean anomaly at the start.
    MeanAnomaly,
}

impl std::fmt::Display for Field {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Name => "name",
            Self::Mass => "mass",
            Self::CenterOfMass => "center_of_mass",
            Self::Inertia => "inertia",
            Self::Position => "position",
            Self::Motion => "motion",
            Self::From => "from",
            Self::To => "to",
            Self::Anchor => "anchor",
            Self::Stiffness => "stiffness",
            Self::Damping => "damping",
            Self::Hinge => "hinge",
            Self::Axes => "axes",
            Self::SemiAxes => "semi_axes",
            Self::Center => "center",
            Self::Degree => "degree",
            Self::Density => "density",
            Self::Young => "young",
            Self::Poisson => "poisson",
            Self::Rheology => "rheology",
            Self::FixedPoint => "point",
            Self::Velocity => "velocity",
            Self::Acceleration => "acceleration",
            Self::On => "on",
            Self::At => "at",
            Self::Coefficient => "coefficient",
            Self::Torque => "torque",
            Self::Force => "force",
            Self::Moment => "moment",
            Self::MagneticField => "field",
            Self::Dipole => "dipole",
            Self::Frequency => "frequency",
            Self::Phase => "phase",
            Self::GravitationalParameter => "gravitational_parameter",
            Self::SemiMajorAxis => "semi_major_axis",
            Self::Eccentricity => "eccentricity",
            Self::Inclination => "inclination",
            Self::Node => "node",
            Self::Periapsis => "periapsis",
            Self::MeanAnomaly => "mean_anomaly",
        })
    }
}

/// What can be wrong with a value of an element.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq)]
pub enum Problem {
    /// A number is NaN or infinite.
    #[error("{value} is not a finite number")]
    NotFinite {
        /// The number.
        value: f64,
    },
    /// A mass is zero or negative.
    #[error("{value} kg is not a mass; it must be positive")]
    NotAMass {
        /// The number (kg).
        value: f64,
    },
    /// No mass distribution has this inertia tensor.
    #[error(transparent)]
    Inertia(#[from] InertiaError),
    /// No isotropic material has this Poisson's ratio, or it is incompressible.
    #[error(
        "no elastic material that can be compressed has the Poisson's ratio {value}; it lies between -1 and 0.5"
    )]
    Poisson {
        /// The ratio.
        value: f64,
    },
    /// No material answers a strain like this.
    #[error(transparent)]
    Rheology(#[from] RheologyError),
    /// Polynomials that rounding, or the shape, cannot tell apart.
    #[error("polynomials of degree {degree} cannot be told apart on this body")]
    Unresolved {
        /// Their degree.
        degree: usize,
    },
    /// A degree that is not offered.
    #[error("polynomials of degree {degree} are not offered; choose 1 to {most}")]
    Degree {
        /// Degree asked for.
        degree: usize,
        /// Highest one offered.
        most: usize,
    },
    /// The body has neither a carrier nor a part that is elastic throughout.
    #[error("the body has no carrier, no ellipsoid and no surface")]
    NoBody,
    /// An element that only goes with a carrier, on a body without.
    #[error("an element that is elastic throughout is the whole body; this cannot stand beside it")]
    BesideWhole,
    /// A force acts at a place of the carrier of a body that has none.
    #[error("this body has no carrier that the force could act on")]
    NoCarrier,
    /// A body that is elastic throughout has no point that a support could hold.
    #[error("a body that is elastic throughout moves freely; no point of it can be held")]
    HeldWhole,
    /// A direction has no length.
    #[error("a direction of zero length")]
    ZeroDirection,
    /// A matrix is not symmetric.
    #[error(
        "the matrix is not symmetric: entries [{row}][{column}] = {upper} and [{column}][{row}] = {lower} differ"
    )]
    NotSymmetric {
        /// Row of the first entry, from 0.
        row: usize,
        /// Column of the first entry, from 0.
        column: usize,
        /// The entry at (row, column).
        upper: f64,
        /// The entry at (column, row).
        lower: f64,
    },
    /// A stiffness or damping gives energy instead of taking it.
    #[error("the smallest eigenvalue is {eigenvalue:e}; a spring or dashpot must not give energy")]
    Indefinite {
        /// Smallest eigenvalue of the matrix.
        eigenvalue: f64,
    },
    /// Both ends of a spring are the same.
    #[error("both ends of the spring are the same")]
    SameEnds,
    /// There is no point with this index.
    #[error("there is no point {index}")]
    NoSuchPoint {
        /// Index asked for, from 0.
        index: usize,
    },
    /// The ends of an axial spring coincide, so they have no joining line.
    #[error("the ends of the axial spring are at the same place, so no line joins them")]
    NoLine,
    /// An axial spring to the carrier does not say where its end is.
    #[error("an axial spring to the carrier needs the place of its end on the carrier")]
    NoAnchor,
    /// A hinge has no axis, or more than three.
    #[error("a hinge has one, two or three axes, not {count}")]
    AxisCount {
        /// Number of axes given.
        count: usize,
    },
    /// The axes of a hinge do not turn the appendage independently.
    #[error("the axes are not independent, so two hinge angles would be the same motion")]
    DependentAxes,
    /// A hinge coefficient does not have one value or row per axis.
    #[error("there are {axes} axes but {values} values")]
    ValuePerAxis {
        /// Number of axes.
        axes: usize,
        /// Number of values or rows.
        values: usize,
    },
    /// An axis turns the appendage without moving any of its mass.
    #[error("turning about axis {axis} moves no mass; leave that axis out")]
    MasslessAxis {
        /// Number of the axis, from 1.
        axis: usize,
    },
    /// A force on the carrier does not say where it acts.
    #[error("a force on the carrier needs the place where it acts")]
    NoStation,
    /// A force on a point says where on the carrier it acts.
    #[error("a force on a point acts at the point itself")]
    StationOnPoint,
    /// A drag gives energy instead of taking it.
    #[error("the coefficient {value} is negative; a drag must not give energy")]
    Driving {
        /// The coefficient.
        value: f64,
    },
    /// A quantity is zero or negative.
    #[error("{value} is not positive")]
    NotPositive {
        /// The number.
        value: f64,
    },
    /// An eccentricity is not that of an ellipse.
    #[error("no ellipse has the eccentricity {value}; it is at least 0 and below 1")]
    NotElliptic {
        /// The eccentricity.
        value: f64,
    },
    /// A point is displaced where its constraints do not let it go.
    #[error("its constraints leave only the part {left:?} of this motion")]
    Barred {
        /// The part they leave (m or m/s), file's axes.
        left: [f64; 3],
    },
    /// Two elements share a name.
    #[error("the name \"{name}\" is used twice")]
    DuplicateName {
        /// The name.
        name: String,
    },
    /// No spring resists a displacement.
    #[error("a mechanism: no spring resists some motion of {coordinates}")]
    Mechanism {
        /// The coordinates that move, by name.
        coordinates: String,
    },
    /// The frozen body has no inertia about some axis, so it cannot be told how it turns.
    #[error("the whole body has no inertia about some axis (principal moments {moments:?} kg m^2)")]
    NoInertia {
        /// Principal moments of inertia about the pole (kg·m²), ascending.
        moments: [f64; 3],
        /// Whether the pole is a point that is fixed or driven, not the centre of mass.
        held: bool,
    },
}
