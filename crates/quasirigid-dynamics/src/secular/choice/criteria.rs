use super::limits::Limits;
use super::reason::UnknownLiquid;
use crate::averaging::PowerSource;

/// Criteria of a choice: what is known of a body and a span before any method runs. (Q7), (Q9)
#[derive(Clone, Debug, PartialEq)]
pub struct Criteria {
    /// Source of the average that is tried first.
    pub first_power: PowerSource,
    /// Whether that source was asked for.
    pub power_asked: bool,
    /// Liquids of unknown response about the steady spin at an end of the span.
    pub unknown_liquids: Vec<UnknownLiquid>,
    /// Vibration that grows by parametric resonance on the span, as far as it was looked for.
    pub parametric: Option<GrowingVibration>,
    /// Whether the response in the spinning frame is known.
    pub spinning_frame: bool,
    /// Ratio of the spin to the slowest elastic frequency; none where the body has no such frequency.
    pub spin_ratio: Option<f64>,
    /// Largest relative change of a difference of moments of inertia by elasticity.
    pub moments_change: f64,
    /// Whether two moments are equal, so that a plane of steady spins takes the place of a separatrix.
    pub equal_moments: bool,
    /// Whether the reduced equations of level curves are known.
    pub level_equations: bool,
    /// Whether the body has rotors or liquids that turn without a spring.
    pub internal_rotation: bool,
    /// Whether a material loses energy by a law that the reduced equations leave out.
    pub viscoelastic: bool,
    /// Losses that the equations of motion leave out, as a share of the rate of a small wobble; infinite where it is not known.
    pub left_out: f64,
    /// Decay in a period of the polhode at the ends of the span.
    pub decay_per_period: f64,
    /// Whether a motion beside the nutation grows at an end of the span.
    pub internal_growth: bool,
    /// Revolutions of the span, by the rates of the modes; none where these are not known.
    pub revolutions: Option<f64>,
    /// Number of internal coordinates.
    pub coordinates: usize,
    /// Whether the ends of the span circle different axes.
    pub between_axes: bool,
}

/// Vibration that grows from nothing by parametric resonance. (H7)
#[derive(Clone, Debug, PartialEq)]
pub struct GrowingVibration {
    /// Coordinate with the largest share in it.
    pub coordinate: String,
    /// Frequency (rad/s, body axes).
    pub frequency: f64,
    /// Growth rate (1/s).
    pub rate: f64,
    /// Widest wobble (rad) of the state at which it grows.
    pub wobble: f64,
}

impl Criteria {
    /// Whether level curves of the slow energy suit the body better than averages along the frozen polhode: elasticity changes the moments of
    /// inertia.
    pub(super) fn suits_level_curves(&self, limits: &Limits) -> bool {
        self.moments_change > limits.moments_change && self.has_level_curves(limits)
    }

    /// Whether level curves of the slow energy hold: of a stiff body, all of whose losses the reduced equations have.
    pub(super) fn has_level_curves(&self, limits: &Limits) -> bool {
        self.spin_ratio.is_some_and(|ratio| ratio <= limits.spin_ratio_of_levels)
            && !self.internal_rotation
            && !self.viscoelastic
    }

    /// Whether averages are compared with short runs of the full system: not of a stiff body, nor where that system leaves losses out. (Q9)
    pub(super) fn wants_probes(&self, limits: &Limits) -> bool {
        let stiff = !self.internal_rotation
            && self.spin_ratio.is_none_or(|ratio| ratio < limits.spin_ratio_of_probes);
        !stiff && self.left_out <= limits.losses_left_out
    }
}
