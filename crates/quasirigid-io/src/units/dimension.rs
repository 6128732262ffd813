/// Exponents of kilogram, metre, second and radian.
pub(super) type Exponents = [i32; 4];

/// What a quantity of the model file measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dimension {
    name: &'static str,
    unit: &'static str,
    example: &'static str,
    exponents: Exponents,
}

impl Dimension {
    /// Pure number.
    pub const NUMBER: Self = Self::new("a plain number", "", "", [0, 0, 0, 0]);
    /// Mass (kg).
    pub const MASS: Self = Self::new("a mass", "kg", "12 lb", [1, 0, 0, 0]);
    /// Length (m).
    pub const LENGTH: Self = Self::new("a length", "m", "22 in", [0, 1, 0, 0]);
    /// Time (s).
    pub const TIME: Self = Self::new("a time", "s", "2 h", [0, 0, 1, 0]);
    /// Angular velocity (rad/s).
    pub const ANGULAR_VELOCITY: Self = Self::new("an angular velocity", "rad/s", "750 rpm", [0, 0, -1, 1]);
    /// Moment of inertia (kg·m²).
    pub const INERTIA: Self = Self::new("a moment of inertia", "kg m^2", "3.2 lb ft^2", [1, 2, 0, 0]);
    /// Stiffness (N/m).
    pub const STIFFNESS: Self = Self::new("a stiffness", "N/m", "12.5 lbf/in", [1, 0, -2, 0]);
    /// Damping (N·s/m).
    pub const DAMPING: Self = Self::new("a damping", "N s/m", "0.3 lbf s/in", [1, 0, -1, 0]);
    /// Rotational stiffness (N·m/rad).
    pub const ROTATIONAL_STIFFNESS: Self =
        Self::new("a rotational stiffness", "N m/rad", "0.565 N m/rad", [1, 2, -2, -1]);
    /// Rotational damping (N·m·s/rad).
    pub const ROTATIONAL_DAMPING: Self =
        Self::new("a rotational damping", "N m s/rad", "0.01 N m s/rad", [1, 2, -1, -1]);

    const ALL: [Self; 10] = [
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
        let [.., radian] = exponents;
        exponents[..3] == self.exponents[..3] && (radian == 0 || radian == self.exponents[3])
    }

    /// What a unit with these exponents measures, in words.
    pub(super) fn describe(exponents: Exponents) -> String {
        if let Some(dimension) = Self::ALL.iter().find(|dimension| dimension.exponents == exponents) {
            return dimension.name.to_owned();
        }
        let factors: Vec<String> = ["kg", "m", "s", "rad"]
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
