use thiserror::Error;

/// Reasons for which the slosh of a tank is not answered.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq)]
pub enum TankError {
    /// A fill that is no share of the volume.
    #[error("a fill of {fill}: a tank that is partly full is filled to more than 0 and less than 1")]
    Fill {
        /// The fill.
        fill: f64,
    },
    /// More liquid than the tank holds.
    #[error("{mass} kg of liquid in a tank that holds {most:.6} kg")]
    Overfull {
        /// Mass of the liquid (kg).
        mass: f64,
        /// Mass that would fill the tank (kg).
        most: f64,
    },
    /// A number of modes that is not offered.
    #[error("{modes} slosh modes are not offered; choose 1 to {most}")]
    Modes {
        /// Number asked for.
        modes: usize,
        /// Most that are offered.
        most: usize,
    },
    /// An ellipsoid that is not of revolution about its axis.
    #[error(
        "semi-axes of {first} m and {second} m across the axis differ: the tank is not of revolution about it"
    )]
    NotOfRevolution {
        /// First semi-axis (m).
        first: f64,
        /// Second semi-axis (m).
        second: f64,
    },
    /// A capsule shorter than its ends.
    #[error("a capsule of radius {radius} m is longer than {} m from end to end, not {height} m", 2.0 * radius)]
    ShortCapsule {
        /// Radius (m).
        radius: f64,
        /// Height from end to end (m).
        height: f64,
    },
    /// A cone without a base.
    #[error("both ends of the cone have the radius 0")]
    NoCone,
    /// A profile with too few or too many points.
    #[error("a profile of {points} points; it has 3 to {most}")]
    ProfilePoints {
        /// Number of points.
        points: usize,
        /// Most that are offered.
        most: usize,
    },
    /// A profile that does not begin or end on the axis.
    #[error("the profile is open: point {point} is {radius} m from the axis, where it should close")]
    OpenProfile {
        /// Number of the point, from 1.
        point: usize,
        /// Its distance from the axis (m).
        radius: f64,
    },
    /// A profile that crosses the axis or touches it between its ends.
    #[error(
        "point {point} of the profile has the distance {radius} m from the axis; between the ends it is positive"
    )]
    ProfileOnAxis {
        /// Number of the point, from 1.
        point: usize,
        /// Its distance from the axis (m).
        radius: f64,
    },
    /// A profile that turns back.
    #[error(
        "the profile turns back or crosses itself at point {point}: from end to end heights ascend, but for flat ends"
    )]
    FoldedProfile {
        /// Number of the point, from 1.
        point: usize,
    },
    /// Nothing presses the liquid to a side.
    #[error("nothing presses the liquid to a side of the tank: {cause}")]
    Weightless {
        /// The cause.
        cause: String,
    },
    /// The effective gravity is not along the axis.
    #[error(
        "the liquid is pressed {degrees:.3} degrees off the axis of the tank; slosh is known along the axis, within {most} degrees"
    )]
    Tilted {
        /// Angle between both (degrees).
        degrees: f64,
        /// Greatest angle (degrees).
        most: f64,
    },
    /// A tank near the axis of a spin.
    #[error(
        "slosh at {ratio:.3} times the spin: below {least} times the Coriolis force makes other waves, and the free surface of a spinning tank near the axis \
         is not answered"
    )]
    NearSpinAxis {
        /// Frequency of the slosh over the spin.
        ratio: f64,
        /// Least ratio.
        least: f64,
    },
    /// A liquid whose inertia decides how the body moves.
    #[error(
        "whether the liquid turns with the tank or is left behind changes its moments of inertia by {:.1} % of the differences of the body's; above {} % the \
         motion about this spin is not known",
        100.0 * share,
        100.0 * most
    )]
    Uncertain {
        /// Change of its moments over the differences of the body's.
        share: f64,
        /// Greatest share.
        most: f64,
    },
    /// A surface that capillarity rules.
    #[error("the Bond number is {bond:.3}: below {least} surface tension, not weight, shapes the surface")]
    Capillary {
        /// Bond number.
        bond: f64,
        /// Least number.
        least: f64,
    },
    /// A liquid so viscous that its layer at the wall is not thin.
    #[error(
        "the layer at the wall would damp the slosh by {ratio:.3} of critical: above {most} it is not thin"
    )]
    Viscous {
        /// Damping ratio of the layer.
        ratio: f64,
        /// Greatest ratio.
        most: f64,
    },
    /// Measured values of more modes than are kept.
    #[error("measured values of {given} slosh modes, and {modes} are kept")]
    TooManyMeasured {
        /// Number of entries.
        given: usize,
        /// Number of modes.
        modes: usize,
    },
    /// Measured masses that leave nothing of the liquid.
    #[error(
        "{moving:.6} kg slosh of {liquid:.6} kg of liquid: what is left has no mass, or a negative moment of inertia"
    )]
    HeavySlosh {
        /// Mass that sloshes (kg).
        moving: f64,
        /// Mass of the liquid (kg).
        liquid: f64,
    },
    /// Baffles without a wave.
    #[error("baffles damp a large wave more than a small one, and there is no `wave_amplitude`")]
    NoWave,
    /// A wave that is not small.
    #[error("a wave of the amplitude {amplitude} m: the slosh of small waves is known, to {most:.3} m here")]
    HighWave {
        /// Amplitude at the wall (m).
        amplitude: f64,
        /// Greatest amplitude (m).
        most: f64,
    },
    /// A baffle that is not in the tank.
    #[error("a baffle at the height {height} m: the tank is from {low:.4} m to {high:.4} m along its axis")]
    BaffleOutside {
        /// Height (m).
        height: f64,
        /// Lowest height of the tank (m).
        low: f64,
        /// Highest height of the tank (m).
        high: f64,
    },
    /// A baffle that the wave uncovers.
    #[error(
        "a baffle {depth:.4} m below the surface, in a wave of the amplitude {amplitude} m: its damping is known while the wave does not reach it"
    )]
    BaffleUncovered {
        /// Depth (m), negative above the surface.
        depth: f64,
        /// Amplitude at the wall (m).
        amplitude: f64,
    },
    /// A baffle that changes the flow.
    #[error("a baffle {width} m wide: the flow past a narrow one is known, to {most:.4} m here")]
    WideBaffle {
        /// Width (m).
        width: f64,
        /// Greatest width (m).
        most: f64,
    },
    /// A flow that is not resolved.
    #[error("the slosh in this tank is not resolved: {}", match error {
        Some(error) => format!("two grids differ by {:.1e}", error),
        None => "floating point does not resolve its places".to_owned(),
    })]
    Unresolved {
        /// Relative difference of two grids; none where one of them was not solved.
        error: Option<f64>,
    },
}

impl TankError {
    /// Label for the place in a model file, and a remedy; an empty remedy is none.
    pub(crate) fn told(&self) -> (&'static str, &'static str) {
        match self {
            Self::Fill { .. } => ("between 0 and 1", "a full tank is a [[cavity]], an empty one is left out"),
            Self::Overfull { .. } => (
                "more than it holds",
                "check the units of the mass, of the shape and of the density; a full tank is a [[cavity]]",
            ),
            Self::Modes { .. } => {
                ("not offered", "the first mode carries most of the moving mass; 2 are enough for most tanks")
            }
            Self::NotOfRevolution { .. } => {
                ("not of revolution", "write semi_axes = [across, across, along] with the third along `axis`")
            }
            Self::ShortCapsule { .. } => (
                "too short",
                "the height of a capsule is measured from end to end; a shorter one is a sphere or an ellipsoid",
            ),
            Self::NoCone => ("no cone", "write radii = [lower, upper] with one of them positive"),
            Self::ProfilePoints { .. } => (
                "points",
                "write profile = [[0, -0.5], [0.4, -0.3], [0.4, 0.3], [0, 0.5]], pairs of distance from the axis and height",
            ),
            Self::OpenProfile { .. } => ("open", "begin and end the profile on the axis, at r = 0"),
            Self::ProfileOnAxis { .. } => ("on the axis", "cut the tank there into two"),
            Self::FoldedProfile { .. } => (
                "turns back",
                "list the points from the lower pole to the upper one; a wall that a horizontal line meets twice is not known",
            ),
            Self::Weightless { .. } => (
                "no effective gravity",
                "write settled_by = { acceleration = [0, 0, -0.1] }, or move the tank off the axis of the spin",
            ),
            Self::Tilted { .. } => (
                "off the axis",
                "turn `axis`, or approximate the tank by a sphere, of which every direction is an axis",
            ),
            Self::NearSpinAxis { .. } => (
                "too near the axis of the spin",
                "small tanks far from the axis are answered; a full one is a [[cavity]]",
            ),
            Self::Uncertain { .. } => (
                "not known in this spin",
                "small tanks in a body whose moments differ are answered; a full one is a [[cavity]]",
            ),
            Self::Capillary { .. } => (
                "too little weight",
                "give the `surface_tension` if it is less than that of water, or leave the slosh out: hold the liquid as part of the carrier",
            ),
            Self::Viscous { .. } => {
                ("too viscous", "give a measured damping_ratio, or hold the liquid as part of the carrier")
            }
            Self::TooManyMeasured { .. } => {
                ("more than the modes", "keep more `modes`, or leave entries out")
            }
            Self::HeavySlosh { .. } => (
                "too much",
                "check the mass, and the fill at which it was measured; the moving mass is less than the liquid's",
            ),
            Self::NoWave => ("no amplitude", "add a line such as: wave_amplitude = \"1 cm\""),
            Self::HighWave { .. } => {
                ("not small", "give the amplitude at the wall of the waves that are damped")
            }
            Self::BaffleOutside { .. } => (
                "outside",
                "heights are along `axis`, from `center`, the middle of the shape or the origin of its profile",
            ),
            Self::BaffleUncovered { .. } => (
                "reached by the wave",
                "give a smaller wave_amplitude, or a measured damping_ratio; a baffle above the wave damps nothing",
            ),
            Self::WideBaffle { .. } => {
                ("too wide", "give a measured damping_ratio and frequency instead of the baffle")
            }
            Self::Unresolved { .. } => (
                "not resolved",
                "take a fill farther from empty and full (a full tank is a [[cavity]]), keep fewer modes, or smooth the profile",
            ),
        }
    }
}
