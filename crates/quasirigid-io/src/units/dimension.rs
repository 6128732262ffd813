//! Dimensions of quantities: names for messages, SI units, and exponents of kilogram, metre, second, ampere and radian.
//! The radian has an exponent of its own, so that `N m` is accepted for `N m/rad` but not the reverse.

/// Exponents of kilogram, metre, second, ampere and radian.
pub(super) type Exponents = [i32; 5];

/// Dimension of a quantity of the model file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dimension {
    name: &'static str,
    unit: &'static str,
    example: &'static str,
    exponents: Exponents,
}

impl Dimension {
    /// Pure number.
    pub const NUMBER: Self = Self::new("a plain number", "", "", [0, 0, 0, 0, 0]);
    /// Mass (kg).
    pub const MASS: Self = Self::new("a mass", "kg", "12 lb", [1, 0, 0, 0, 0]);
    /// Length (m).
    pub const LENGTH: Self = Self::new("a length", "m", "22 in", [0, 1, 0, 0, 0]);
    /// Area (m²).
    pub const AREA: Self = Self::new("an area", "m^2", "4 cm^2", [0, 2, 0, 0, 0]);
    /// Second moment of an area (m⁴).
    pub const SECOND_MOMENT: Self = Self::new("a second moment of area", "m^4", "12 cm^4", [0, 4, 0, 0, 0]);
    /// Rate (1/s).
    pub const RATE: Self = Self::new("a rate", "1/s", "0.2 1/s", [0, 0, -1, 0, 0]);
    /// Time (s).
    pub const TIME: Self = Self::new("a time", "s", "2 h", [0, 0, 1, 0, 0]);
    /// Angular velocity (rad/s).
    pub const ANGULAR_VELOCITY: Self = Self::new("an angular velocity", "rad/s", "750 rpm", [0, 0, -1, 0, 1]);
    /// Moment of inertia (kg·m²).
    pub const INERTIA: Self = Self::new("a moment of inertia", "kg m^2", "3.2 lb ft^2", [1, 2, 0, 0, 0]);
    /// Stiffness (N/m).
    pub const STIFFNESS: Self = Self::new("a stiffness", "N/m", "12.5 lbf/in", [1, 0, -2, 0, 0]);
    /// Surface tension (N/m).
    pub const SURFACE_TENSION: Self = Self::new("a surface tension", "N/m", "72 mN/m", [1, 0, -2, 0, 0]);
    /// Damping (N·s/m).
    pub const DAMPING: Self = Self::new("a damping", "N s/m", "0.3 lbf s/in", [1, 0, -1, 0, 0]);
    /// Rotational stiffness (N·m/rad).
    pub const ROTATIONAL_STIFFNESS: Self =
        Self::new("a rotational stiffness", "N m/rad", "0.565 N m/rad", [1, 2, -2, 0, -1]);
    /// Rotational damping (N·m·s/rad).
    pub const ROTATIONAL_DAMPING: Self =
        Self::new("a rotational damping", "N m s/rad", "0.01 N m s/rad", [1, 2, -1, 0, -1]);
    /// Angular momentum (N·m·s).
    pub const ANGULAR_MOMENTUM: Self =
        Self::new("an angular momentum", "N m s", "12 N m s", [1, 2, -1, 0, 0]);
    /// Kinematic viscosity (m²/s).
    pub const KINEMATIC_VISCOSITY: Self =
        Self::new("a kinematic viscosity", "m^2/s", "5 cSt", [0, 2, -1, 0, 0]);
    /// Dynamic viscosity (Pa·s).
    pub const DYNAMIC_VISCOSITY: Self =
        Self::new("a dynamic viscosity", "Pa s", "1.5 mPa s", [1, -1, -1, 0, 0]);
    /// Angle (rad).
    pub const ANGLE: Self = Self::new("an angle", "rad", "30 deg", [0, 0, 0, 0, 1]);
    /// Frequency (rad/s); hertz are revolutions per second.
    pub const FREQUENCY: Self = Self::new("a frequency", "rad/s", "2 Hz", [0, 0, -1, 0, 1]);
    /// Velocity (m/s).
    pub const VELOCITY: Self = Self::new("a velocity", "m/s", "3 km/s", [0, 1, -1, 0, 0]);
    /// Acceleration (m/s²).
    pub const ACCELERATION: Self = Self::new("an acceleration", "m/s^2", "32 ft/s^2", [0, 1, -2, 0, 0]);
    /// Force (N).
    pub const FORCE: Self = Self::new("a force", "N", "0.2 lbf", [1, 1, -2, 0, 0]);
    /// Torque (N·m).
    pub const TORQUE: Self = Self::new("a torque", "N m", "3 lbf ft", [1, 2, -2, 0, 0]);
    /// Energy (J).
    pub const ENERGY: Self = Self::new("an energy", "J", "12 kJ", [1, 2, -2, 0, 0]);
    /// Density (kg/m³).
    pub const DENSITY: Self = Self::new("a density", "kg/m^3", "2.5 g/cm^3", [1, -3, 0, 0, 0]);
    /// Pressure, and the modulus of a material (Pa).
    pub const PRESSURE: Self = Self::new("a pressure", "Pa", "70 GPa", [1, -1, -2, 0, 0]);
    /// Gravitational parameter (m³/s²).
    pub const GRAVITATIONAL_PARAMETER: Self =
        Self::new("a gravitational parameter", "m^3/s^2", "398600.4 km^3/s^2", [0, 3, -2, 0, 0]);
    /// Magnetic dipole moment (A·m²).
    pub const MAGNETIC_MOMENT: Self = Self::new("a magnetic moment", "A m^2", "200 mA m^2", [0, 2, 0, 1, 0]);
    /// Magnetic field (T).
    pub const MAGNETIC_FIELD: Self = Self::new("a magnetic field", "T", "30 uT", [1, 0, -2, -1, 0]);
    /// Magnetic field of a dipole times the cube of the distance (T·m³), `μ₀/4π` times its moment.
    pub const DIPOLE_STRENGTH: Self =
        Self::new("a dipole strength", "T m^3", "7.8e15 T m^3", [1, 3, -2, -1, 0]);

    /// Electrical conductivity (S/m).
    pub const CONDUCTIVITY: Self = Self::new("a conductivity", "S/m", "25 MS/m", [-1, -3, 3, 2, 0]);
    /// Magnetic tensor of a conductor (S·m⁴).
    pub const MAGNETIC_TENSOR: Self = Self::new("a magnetic tensor", "S m^4", "5662 S m^4", [-1, 2, 3, 2, 0]);

    /// Volume (m³).
    pub const VOLUME: Self = Self::new("a volume", "m^3", "75 mm^3", [0, 3, 0, 0, 0]);
    /// Magnetising force (A/m).
    pub const MAGNETIZING_FORCE: Self = Self::new("a magnetizing force", "A/m", "12 A/m", [0, -1, 0, 1, 0]);
    /// Gain of a dipole moment on the rate of a magnetic field (A·m²·s/T).
    pub const FIELD_RATE_GAIN: Self =
        Self::new("a gain on the rate of a field", "A m^2 s/T", "2e4 A m^2 s/T", [-1, 2, 3, 2, 0]);

    /// Dimensions that a unit alone can stand for: hertz and radians per second are told apart by their symbols.
    const ALL: [Self; 27] = [
        Self::NUMBER,
        Self::MASS,
        Self::LENGTH,
        Self::TIME,
        Self::ANGULAR_VELOCITY,
        Self::INERTIA,
        Self::STIFFNESS,
        Self::DAMPING,
        Self::ROTATIONAL_STIFFNESS,
        Self::ROTATIONAL_DAMPING,
        Self::ANGULAR_MOMENTUM,
        Self::KINEMATIC_VISCOSITY,
        Self::DYNAMIC_VISCOSITY,
        Self::ANGLE,
        Self::VELOCITY,
        Self::ACCELERATION,
        Self::FORCE,
        Self::TORQUE,
        Self::ENERGY,
        Self::DENSITY,
        Self::PRESSURE,
        Self::GRAVITATIONAL_PARAMETER,
        Self::MAGNETIC_MOMENT,
        Self::MAGNETIC_FIELD,
        Self::DIPOLE_STRENGTH,
        Self::CONDUCTIVITY,
        Self::MAGNETIC_TENSOR,
    ];

    const fn new(
        name: &'static str,
        unit: &'static str,
        example: &'static str,
        exponents: Exponents,
    ) -> Self {
        Self { name, unit, example, exponents }
    }

    /// Name with its article, as in "a mass".
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// SI unit in which a plain number is read; empty for a pure number.
    #[must_use]
    pub fn unit(&self) -> &'static str {
        self.unit
    }

    /// A quantity of this dimension, for messages; empty for a pure number.
    #[must_use]
    pub fn example(&self) -> &'static str {
        self.example
    }

    /// Whether a unit with these exponents measures this dimension, with its radian or without.
    pub(super) fn accepts(&self, exponents: Exponents) -> bool {
        let ([base @ .., radian], [own_base @ .., own_radian]) = (exponents, self.exponents);
        base == own_base && (radian == 0 || radian == own_radian)
    }

    /// Name of the quantity that a unit with these exponents measures.
    pub(super) fn describe(exponents: Exponents) -> String {
        let same = Self::ALL.iter().filter(|dimension| dimension.exponents == exponents);
        let names: Vec<&str> = same.map(|dimension| dimension.name).collect();
        if !names.is_empty() {
            return names.join(" or ");
        }
        let factors: Vec<String> = ["kg", "m", "s", "A", "rad"]
            .iter()
            .zip(exponents)
            .filter(|(_, exponent)| *exponent != 0)
            .map(
                |(symbol, exponent)| {
                    if exponent == 1 { (*symbol).to_owned() } else { format!("{symbol}^{exponent}") }
                },
            )
            .collect();
        format!("a quantity in {}", factors.join(" "))
    }
}
