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
    /// Nodes that are clamped on the carrier.
    Attach,
    /// File of a mesh or a matrix.
    File,
    /// What a part is made of.
    Material,
    /// Section of a beam.
    Section,
    /// Direction of the section of a beam.
    Up,
    /// Lines of beams between nodes.
    Lines,
    /// Masses at nodes.
    Masses,
    /// Layers of a panel.
    Layers,
    /// Direction of the angle zero of the layers of a panel.
    Reference,
    /// Damping in proportion to mass and stiffness.
    Rayleigh,
    /// Number of modes that are kept.
    Modes,
    /// Shapes of modes.
    Shapes,
    /// Frequencies of modes.
    Frequencies,
    /// Damping ratios of modes.
    DampingRatios,
    /// Nodes whose displacements are coordinates.
    Interface,
    /// Shear moduli of a material.
    Shear,
    /// Stiffness.
    Stiffness,
    /// Damping.
    Damping,
    /// Place of a hinge; of a connection, its axes.
    Hinge,
    /// Axes of a hinge.
    Axes,
    /// Tension of a spring.
    Tension,
    /// Places on a hinged appendage.
    Places,
    /// Axis of a rotor or a wheel.
    Axis,
    /// Friction of a rotor.
    Friction,
    /// Viscosity of a liquid.
    Viscosity,
    /// Shape of a cavity.
    Shape,
    /// Radius of a cylinder or a ring.
    Radius,
    /// Radii of an annulus.
    Radii,
    /// Radius of the tube of a ring.
    TubeRadius,
    /// Height of a cylinder.
    Height,
    /// Sides of a box.
    Sides,
    /// Semi-axes of the inner ellipsoid of a shell.
    InnerSemiAxes,
    /// Number of cells across a cavity.
    Resolution,
    /// Attitude of a cavity.
    Attitude,
    /// Speed of a rotor.
    Speed,
    /// Momentum of a wheel.
    Momentum,
    /// Semi-axes of an ellipsoid.
    SemiAxes,
    /// Centre of an ellipsoid.
    Center,
    /// Degree of the polynomials of a displacement.
    Degree,
    /// Number of cells.
    Cells,
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
            Self::Attach => "attach",
            Self::File => "file",
            Self::Material => "material",
            Self::Section => "section",
            Self::Up => "up",
            Self::Lines => "lines",
            Self::Masses => "masses",
            Self::Layers => "layers",
            Self::Reference => "reference",
            Self::Rayleigh => "rayleigh",
            Self::Modes => "modes",
            Self::Shapes => "shapes",
            Self::Frequencies => "frequencies",
            Self::DampingRatios => "damping_ratios",
            Self::Interface => "interface",
            Self::Shear => "shear",
            Self::Stiffness => "stiffness",
            Self::Damping => "damping",
            Self::Hinge => "hinge",
            Self::Axes => "axes",
            Self::Tension => "tension",
            Self::Places => "places",
            Self::Axis => "axis",
            Self::Friction => "friction",
            Self::Viscosity => "viscosity",
            Self::Shape => "shape",
            Self::Radius => "radius",
            Self::Radii => "radii",
            Self::TubeRadius => "tube_radius",
            Self::Height => "height",
            Self::Sides => "sides",
            Self::InnerSemiAxes => "inner_semi_axes",
            Self::Resolution => "resolution",
            Self::Attitude => "attitude",
            Self::Speed => "speed",
            Self::Momentum => "momentum",
            Self::SemiAxes => "semi_axes",
            Self::Center => "center",
            Self::Degree => "degree",
            Self::Cells => "cells",
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
