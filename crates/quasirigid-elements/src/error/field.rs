//! Keys of elements: names of the values that validation errors point at, spelt as in the model file.
//! Constants in one list keep the spelling of an error and of the model file together; a reader looks the place up by this key.

/// Key of an element: names the value that an error is about, spelt as in the model file.
///
/// Keys that several kinds share, or that are checked apart from their kind, stand here; a kind may have keys of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Field(&'static str);

/// Defines keys.
macro_rules! fields {
    ($($(#[$doc:meta])* $name:ident = $key:literal;)+) => {
        impl Field {
            $($(#[$doc])* pub const $name: Self = Self($key);)+
        }
    };
}

fields! {
    /// Unique name.
    NAME = "name";
    /// Mass.
    MASS = "mass";
    /// Centre of mass.
    CENTER_OF_MASS = "center_of_mass";
    /// Inertia tensor.
    INERTIA = "inertia";
    /// Equilibrium position.
    POSITION = "position";
    /// Motion left by the constraints.
    MOTION = "motion";
    /// First end of a spring.
    FROM = "from";
    /// Second end of a spring.
    TO = "to";
    /// The carrier's end of an axial spring.
    ANCHOR = "anchor";
    /// Nodes that are clamped on the carrier.
    ATTACH = "attach";
    /// File of a mesh or a matrix.
    FILE = "file";
    /// Material of a part.
    MATERIAL = "material";
    /// Section of a beam.
    SECTION = "section";
    /// Direction of the section of a beam.
    UP = "up";
    /// Lines of beams between nodes.
    LINES = "lines";
    /// Masses at nodes.
    MASSES = "masses";
    /// Layers of a panel.
    LAYERS = "layers";
    /// Direction of the angle zero of the layers of a panel.
    REFERENCE = "reference";
    /// Damping in proportion to mass and stiffness.
    RAYLEIGH = "rayleigh";
    /// Number of modes that are kept.
    MODES = "modes";
    /// Shapes of modes.
    SHAPES = "shapes";
    /// Frequencies of modes.
    FREQUENCIES = "frequencies";
    /// Damping ratios of modes.
    DAMPING_RATIOS = "damping_ratios";
    /// Nodes whose displacements are coordinates.
    INTERFACE = "interface";
    /// Shear moduli of a material.
    SHEAR = "shear";
    /// Stiffness.
    STIFFNESS = "stiffness";
    /// Damping.
    DAMPING = "damping";
    /// Place of a hinge; of a connection, its axes.
    HINGE = "hinge";
    /// Axes of a hinge.
    AXES = "axes";
    /// Tension of a spring.
    TENSION = "tension";
    /// Places on a hinged appendage.
    PLACES = "places";
    /// Axis of a rotor or a wheel.
    AXIS = "axis";
    /// Friction of a rotor.
    FRICTION = "friction";
    /// Viscosity of a liquid.
    VISCOSITY = "viscosity";
    /// Shape of a cavity.
    SHAPE = "shape";
    /// Radius of a cylinder or a ring.
    RADIUS = "radius";
    /// Radii of an annulus.
    RADII = "radii";
    /// Radius of the tube of a ring.
    TUBE_RADIUS = "tube_radius";
    /// Height of a cylinder.
    HEIGHT = "height";
    /// Sides of a box.
    SIDES = "sides";
    /// Semi-axes of the inner ellipsoid of a shell.
    INNER_SEMI_AXES = "inner_semi_axes";
    /// Number of cells across a cavity.
    RESOLUTION = "resolution";
    /// Attitude of a cavity.
    ATTITUDE = "attitude";
    /// Speed of a rotor.
    SPEED = "speed";
    /// Angular momentum of a wheel.
    MOMENTUM = "momentum";
    /// Semi-axes of an ellipsoid.
    SEMI_AXES = "semi_axes";
    /// Centre of an ellipsoid.
    CENTER = "center";
    /// Degree of the polynomials of a displacement.
    DEGREE = "degree";
    /// Number of cells.
    CELLS = "cells";
    /// Density of a material.
    DENSITY = "density";
    /// Young's modulus of a material.
    YOUNG = "young";
    /// Poisson's ratio of a material.
    POISSON = "poisson";
    /// Rheology of a material.
    RHEOLOGY = "rheology";
    /// The fixed or driven point of a support.
    FIXED_POINT = "point";
    /// Velocity of a driven point at the start.
    VELOCITY = "velocity";
    /// Acceleration of gravity.
    ACCELERATION = "acceleration";
    /// Part that a force acts on.
    ON = "on";
    /// Place on the carrier where a force acts.
    AT = "at";
    /// Coefficient of a drag.
    COEFFICIENT = "coefficient";
    /// Amplitude of a torque.
    TORQUE = "torque";
    /// Amplitude of a thrust.
    FORCE = "force";
    /// Magnetic dipole moment.
    MOMENT = "moment";
    /// Uniform magnetic field.
    MAGNETIC_FIELD = "field";
    /// Strength of the dipole that makes the magnetic field.
    DIPOLE = "dipole";
    /// Magnetic tensor of a conductor.
    TENSOR = "tensor";
    /// Rate at which the dipole turns that makes the magnetic field.
    DIPOLE_RATE = "dipole_rate";
    /// Main field of the Earth.
    IGRF = "igrf";
    /// Precession of an orbit.
    PRECESSION = "precession";
    /// Conductivity of a conductor.
    CONDUCTIVITY = "conductivity";
    /// Frequency of a periodic force.
    FREQUENCY = "frequency";
    /// Phase of a periodic force.
    PHASE = "phase";
    /// Gravitational parameter of an orbit.
    GRAVITATIONAL_PARAMETER = "gravitational_parameter";
    /// Direction of the Sun.
    DIRECTION = "direction";
    /// Distance of the Sun.
    DISTANCE = "distance";
    /// Semi-major axis of an orbit.
    SEMI_MAJOR_AXIS = "semi_major_axis";
    /// Distance of the periapsis of an orbit.
    PERIAPSIS_DISTANCE = "periapsis_distance";
    /// Time at which the periapsis is passed.
    TIME_OF_PERIAPSIS = "time_of_periapsis";
    /// Eccentricity of an orbit.
    ECCENTRICITY = "eccentricity";
    /// Inclination of an orbit.
    INCLINATION = "inclination";
    /// Longitude of the ascending node of an orbit.
    NODE = "node";
    /// Argument of the periapsis of an orbit.
    PERIAPSIS = "periapsis";
    /// Mean anomaly at the start.
    MEAN_ANOMALY = "mean_anomaly";
}

impl Field {
    /// A key of one kind of element.
    #[must_use]
    pub const fn new(key: &'static str) -> Self {
        Self(key)
    }

    /// Spelling in the model file.
    #[must_use]
    pub const fn key(self) -> &'static str {
        self.0
    }
}

impl std::fmt::Display for Field {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.0)
    }
}
