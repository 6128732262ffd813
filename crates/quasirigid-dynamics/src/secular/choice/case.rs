use super::average_powers::AveragePowers;
use super::criteria::{Criteria, GrowingVibration};
use super::limits::Limits;
use super::reference_spins::ReferenceSpins;
use super::span::Span;
use crate::averaging::{Evolution, HillResponse};
use crate::math::eigen::NoConvergence;
use crate::math::vec3::norm;
use crate::model::{FlexibleBody, Mode, Principal, ReducedBody};
use crate::reduction::{frequencies, reduce};

/// Case of a choice: a body without momentum wheels on a span, with the criteria and what was computed for them.
#[derive(Clone, Debug)]
pub struct Case<'a> {
    /// Steady spins by which methods are judged.
    pub spins: &'a ReferenceSpins<'a>,
    /// Span that is followed.
    pub span: &'a Span,
    /// Mean powers of the averages.
    pub powers: &'a AveragePowers,
    /// Criteria.
    pub criteria: Criteria,
    /// Response in the spinning frame, where an average of it may be tried.
    pub(super) spinning_frame: Option<HillResponse>,
    /// Reduced equations whose level curves may be followed.
    pub(super) level_equations: Option<ReducedBody>,
}

/// States of a span at which parametric resonance is looked for.
const PARAMETRIC_SAMPLES: usize = 4;
/// Least order of the reduced equations on level curves.
pub const LEVEL_ORDER: usize = 5;

impl<'a> Case<'a> {
    /// The case of a method that was asked for, which needs no more criteria than those of its own.
    ///
    /// # Errors
    /// [`NoConvergence`] if the vibrations are not found.
    pub fn asked(
        spins: &'a ReferenceSpins<'a>,
        span: &'a Span,
        powers: &'a AveragePowers,
    ) -> Result<Self, NoConvergence> {
        let body = spins.body;
        let unknown = span.ends.iter().map(|state| spins.unknown_liquid_response(state.mode));
        let slowest = frequencies(body)?.first().copied();
        let criteria = Criteria {
            first_power: powers.first,
            power_asked: powers.asked,
            unknown_liquids: unknown.into_iter().find(|liquids| !liquids.is_empty()).unwrap_or(&[]).to_vec(),
            parametric: None,
            spinning_frame: false,
            spin_ratio: slowest.map(|slowest| norm(span.start.omega) / slowest),
            moments_change: moments_change(body, spins),
            equal_moments: [Mode::LongAxis, Mode::ShortAxis]
                .iter()
                .any(|mode| !mode.exists(spins.range.moments())),
            level_equations: false,
            internal_rotation: !body.cyclic().is_empty(),
            viscoelastic: !body.viscoelastic().is_empty(),
            left_out: spins.left_out(span.ends),
            decay_per_period: spins.decay_per_period(span.ends),
            internal_growth: spins.internal_growth(span.ends),
            revolutions: [spins.revolutions(span.ends), span.most_revolutions()]
                .into_iter()
                .flatten()
                .reduce(f64::min),
            coordinates: body.coordinates().len(),
            between_axes: span.ends[0].mode != span.ends[1].mode,
        };
        Ok(Self { spins, span, powers, criteria, spinning_frame: None, level_equations: None })
    }

    /// The case of a free choice, with reduced equations of at least an order on level curves.
    ///
    /// # Errors
    /// [`NoConvergence`] if the vibrations are not found.
    pub fn unasked(
        spins: &'a ReferenceSpins<'a>,
        span: &'a Span,
        powers: &'a AveragePowers,
        order: usize,
        limits: &Limits,
    ) -> Result<Self, NoConvergence> {
        let case = Self::asked(spins, span, powers)?;
        if !case.criteria.unknown_liquids.is_empty() {
            return Ok(case);
        }
        let few = case.criteria.coordinates <= limits.coordinates_of_spinning_frame;
        let spinning_frame = if few { HillResponse::compute(spins.body).ok() } else { None };
        let parametric = spinning_frame.as_ref().and_then(|hill| case.parametric(hill));
        let criteria = Criteria { parametric, spinning_frame: spinning_frame.is_some(), ..case.criteria };
        let case = Self { criteria, spinning_frame, ..case };
        // beside equal moments, and where elasticity bends them much, averages may not hold, so that these equations are needed
        let levels = case.criteria.suits_level_curves(limits)
            || case.criteria.equal_moments && case.criteria.has_level_curves(limits);
        Ok(if levels { case.with_level_equations(order) } else { case })
    }

    /// The case with reduced equations of at least an order on level curves, where these are found.
    #[must_use]
    pub fn with_level_equations(mut self, order: usize) -> Self {
        self.level_equations = reduce(self.spins.body, order.max(LEVEL_ORDER)).ok();
        self.criteria.level_equations = self.level_equations.is_some();
        self
    }

    /// Vibration that grows from nothing at a state of the span; none if none does.
    fn parametric(&self, hill: &HillResponse) -> Option<GrowingVibration> {
        let evolution = Evolution::new(hill, self.spins.range.angular_momentum());
        let [from, to] = self.span.ends;
        evolution.rotation_states(from, to, PARAMETRIC_SAMPLES).find_map(|state| {
            let motion = evolution.motion(state);
            let found = hill.floquet(&motion).ok()?.resonance?;
            Some(GrowingVibration {
                coordinate: found.coordinate,
                frequency: found.frequency,
                rate: found.rate,
                wobble: motion.nutation()[1],
            })
        })
    }
}

/// Largest relative change of a difference of moments of inertia by the elasticity of a body.
fn moments_change(body: &FlexibleBody, spins: &ReferenceSpins) -> f64 {
    let (rigid, bent) = (Principal::compute(body.invariants().J).moments, spins.range.moments());
    let change = |[a, b]: [usize; 2]| {
        let (before, after) = (rigid[b] - rigid[a], bent[b] - bent[a]);
        ((after - before) / before).abs()
    };
    [[0, 1], [1, 2]].map(change).into_iter().fold(0.0, f64::max)
}
