//! Reduced equations about the steady spin of a study: the spin, the range, the start within it, and histories.

mod history;
mod json;
mod record;
mod text;
mod verification;

use std::ops::ControlFlow;

use quasirigid::dynamics::{FullState, Nutations};
use quasirigid::model::{Mode, Principal};
use quasirigid::modes::{RelativeEquilibrium, SpinMagnitude, WhirlOnset, acts, whirl_onset};
use quasirigid::submanifold::{
    AmplitudeRange, Backbone, CrossedResonance, Defect, ManifoldStart, Masters, SpinManifold,
    SpinManifoldPlan, SubmanifoldError,
};
use quasirigid_io::model::{BodyKind, PartialSpinManifold};
use quasirigid_math::rotation::angle;
use quasirigid_math::vec3::{dot, norm, scale, unit};
use quasirigid_math::watch;

use crate::error::StudyError;
use crate::left_out::LeftOut;
use crate::modes::PrincipalAxis;
use crate::motion::Motion;
use crate::settings::{DEGREE, SpinManifoldSettings};
use crate::steady::{self, GREATEST, LEAST, NamedSpin};
use crate::study::Study;
use crate::words::{displaced, growth, significant};

pub(crate) use history::HistoryVerdict;
pub use history::OnManifold;
pub(crate) use history::follow;
pub use verification::{verification_json, verification_text};

/// Share of motion and dissipation that reduced equations about a spin may leave: the border of their range. (W11)
pub const SHARE: f64 = 0.01;
/// Number of masters up to which an expansion to the usual degree takes a moment, and the degree of those with more.
const QUICK: usize = 4;
const LOWER_DEGREE: usize = 3;
/// Degrees tried where the start lies outside the range of the usual one.
const HIGHER_DEGREES: [usize; 2] = [7, 9];
/// Coordinates of a body up to which the equations take a moment, and are tried unasked.
pub(crate) const MAX_TRIED_COORDINATES: usize = 60;
/// Number of coordinates up to which the onset of whirl is looked for, and how much faster than the spin.
const ONSET_COORDINATES: usize = 24;
const ONSET_SPIN_RATIO: f64 = 10.0;
/// Amplitudes of the backbone within the range, and beyond: a point lies on the border.
const WITHIN: usize = 32;
const BEYOND: usize = 8;
/// Widest amplitude of a backbone where no amplitude is within the range (rad).
const DEFAULT_AMPLITUDE: f64 = 0.1;
/// Amplitude (rad) below which the defect of a start is rounding.
const STEADY_AMPLITUDE: f64 = 1e-4;
/// Relative difference of the frequency asked for from that of a mode, within which they are the same.
const SAME_FREQUENCY: f64 = 0.05;
/// Angle up to which resonances met are told, in ranges.
const CROSSED_RANGES: f64 = 2.0;

/// Start of a study among the reduced equations about its spin.
#[derive(Clone, Debug)]
pub struct StartWithin {
    /// Coordinates and attitude.
    pub start: ManifoldStart,
    /// Amplitude of the nutation (rad).
    pub amplitude: f64,
    /// Greatest nutation angle over a period at that amplitude (rad); where there is none, that of the start.
    pub nutation: f64,
    /// Defect over a period.
    pub defect: Defect,
    /// Whether the start lies within the range.
    pub within: bool,
}

/// Reduced equations about the steady spin of a study, with their range.
#[derive(Debug)]
pub struct AboutSpin<'a> {
    study: &'a Study,
    /// The equations.
    pub manifold: SpinManifold<'a>,
    /// Name of the steady spin: that of its axis of inertia, `least` or `greatest`, or that of its energy where momentum wheels turn it away.
    pub name: &'static str,
    /// Range of amplitudes.
    pub range: AmplitudeRange,
    /// Motion along the spin manifold, to a quarter beyond the range.
    pub backbone: Backbone,
    /// Start of the model; none about an axis that the start does not circle.
    pub start: Option<StartWithin>,
    /// Losses that the equations of motion leave out.
    pub left_out: LeftOut,
    /// Resonances of modes left out that the nutation meets within its range.
    pub crossed: Vec<CrossedResonance>,
    /// Onset of whirl above the spin, up to ten times as fast; none where it was not looked for or not found.
    pub onset: Option<WhirlOnset>,
}

impl Study {
    /// Derives the reduced equations about the steady spin with the angular momentum of the start, about the principal axis that the start
    /// circles or another.
    ///
    /// # Errors
    /// [`StudyError`] for an invalid start, and where there are no such equations.
    pub fn about_spin(
        &self,
        asked: PartialSpinManifold,
        axis: Option<PrincipalAxis>,
    ) -> Result<AboutSpin<'_>, StudyError> {
        self.left_alone("a derivation about a spin")?;
        let settings = SpinManifoldSettings::resolve(asked, axis, self)?;
        watch::stage("expanding about the spin");
        let mut ask = |share: f64| {
            watch::progress(share);
            ControlFlow::Continue(())
        };
        about(&Motion::new(self, self.initial()?), &settings, &mut ask)
    }

    /// Derives the reduced equations about the steady spin of the lowest degree among a few at which they hold at the start, unless the
    /// file chooses a degree; where none holds, of the highest degree tried.
    ///
    /// # Errors
    /// As [`about_spin`](Self::about_spin).
    pub fn about_spin_that_holds(&self) -> Result<AboutSpin<'_>, StudyError> {
        watch::stage("expanding about the spin");
        let mut ask = |share: f64| {
            watch::progress(share);
            ControlFlow::Continue(())
        };
        that_holds(&Motion::new(self, self.initial()?), &mut ask)
    }
}

/// The reduced equations about the steady spin of a motion, of the lowest degree among a few at which they hold at the start; where none
/// holds, the highest. The degree is that of the file, where the file has one, and a low one where many masters make it slow.
pub(crate) fn that_holds<'a>(
    motion: &Motion<'a>,
    watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<AboutSpin<'a>, StudyError> {
    let study = motion.study();
    let mut settings = SpinManifoldSettings::resolve(PartialSpinManifold::default(), None, study)?;
    if study.model.run.spin_manifold.as_ref().is_some_and(|file| file.degree.is_some()) {
        return about(motion, &settings, watch);
    }
    settings.degree = 1;
    let masters = derived(motion, &settings, watch)?.manifold.expansion().masters.len();
    let quick = masters <= QUICK;
    settings.degree = if quick { DEGREE } else { LOWER_DEGREE };
    let mut found = about(motion, &settings, watch)?;
    for degree in HIGHER_DEGREES.into_iter().filter(|_| quick) {
        let outside = found.start.as_ref().is_some_and(|start| !start.within);
        if !outside || found.range.amplitude <= 0.0 {
            break;
        }
        settings.degree = degree;
        found = about(motion, &settings, watch)?;
    }
    Ok(found)
}

/// The reduced equations about the steady spin of a motion, with their range and backbone.
pub(crate) fn about<'a>(
    motion: &Motion<'a>,
    settings: &SpinManifoldSettings,
    watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<AboutSpin<'a>, StudyError> {
    let Derived { manifold, name, state } = derived(motion, settings, watch)?;
    let range = manifold.range(SHARE);
    let inside = if range.amplitude > 0.0 { range.amplitude } else { DEFAULT_AMPLITUDE };
    let count = WITHIN + BEYOND;
    let backbone = manifold.backbone(inside * count as f64 / WITHIN as f64, count);
    let start = state.map(|state| within(&manifold, &range, &state));
    let left_out = LeftOut::at(motion.study(), manifold.spin.omega, None);
    let crossed = manifold.crossed_resonances(CROSSED_RANGES * range.nutation);
    let onset = onset(&manifold, name, watch);
    Ok(AboutSpin { study: motion.study(), manifold, name, range, backbone, start, left_out, crossed, onset })
}

/// Onset of whirl above the steady spin of a body of few coordinates; none of a spin that momentum wheels turn away from an axis or that turns
/// against them, whose faster ones are not looked for.
fn onset(
    manifold: &SpinManifold,
    name: &str,
    watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Option<WhirlOnset> {
    let against = dot(manifold.body.wheels().angular_momentum(0.0), manifold.spin.omega) < 0.0;
    let about_axis = [GREATEST, LEAST].contains(&name) && !against;
    let few = manifold.body.coordinates().len() <= ONSET_COORDINATES;
    if !(about_axis && few) || manifold.unstable().is_some() {
        return None;
    }
    let spin = manifold.rate();
    whirl_onset(manifold.body, manifold.mode, [spin, ONSET_SPIN_RATIO * spin], watch)
}

/// Reduced equations about a spin, with the state of the start where it circles that spin.
struct Derived<'a> {
    manifold: SpinManifold<'a>,
    name: &'static str,
    state: Option<FullState>,
}

fn derived<'a>(
    motion: &Motion<'a>,
    settings: &SpinManifoldSettings,
    watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Derived<'a>, StudyError> {
    let body = motion.body;
    motion.study().without_slugs("reduced equations about a spin")?;
    let Planned { plan, spin, name, state } = planned(motion, settings)?;
    let manifold = SpinManifold::about(body, spin, &plan, watch)?;
    if let Some(left) = body.left_range(&manifold.spin.q) {
        return Err(StudyError::SteadySpinBeyond { what: displaced(body, left) });
    }
    if let Masters::With(frequencies) = &plan.masters {
        there(&manifold, frequencies, motion.study().model.kind)?;
    }
    Ok(Derived { manifold, name, state })
}

/// Plan of the equations about a steady spin, with its name, and the state of a start that circles it.
struct Planned {
    plan: SpinManifoldPlan,
    spin: RelativeEquilibrium,
    name: &'static str,
    state: Option<FullState>,
}

fn planned(motion: &Motion<'_>, settings: &SpinManifoldSettings) -> Result<Planned, StudyError> {
    let (study, body) = (motion.study(), motion.body);
    if acts(body, motion.forces) {
        return Err(StudyError::ForcesAboutSpin {
            names: motion.forces.iter().map(|force| force.name.clone()).collect(),
        });
    }
    let state = motion.full()?;
    let K = state.angular_momentum(body);
    if !(norm(K) > 0.0) {
        return Err(StudyError::AtRest);
    }
    if settings.axis == Some(PrincipalAxis::Middle) {
        return Err(StudyError::MiddleAxis { kind: study.model.kind });
    }
    let given = SpinMagnitude::AngularMomentum(norm(K));
    let mut found = steady::found(study, state.omega, given);
    let circled = circled(study, K, &found)?;
    let asked = settings.axis;
    let chosen = asked.and_then(|axis| found.iter().position(|named| named.axis() == axis));
    let chosen = if asked.is_some_and(|axis| found[circled].axis() != axis) { chosen } else { Some(circled) };
    let chosen = chosen.unwrap_or(circled);
    let axis = found[chosen].axis();
    let NamedSpin { name, spin } = found.swap_remove(chosen);
    let mut spin = spin.map_err(SubmanifoldError::from)?;
    if body.wheels().is_empty() && dot(spin.angular_momentum, K) < 0.0 {
        spin = RelativeEquilibrium::near(body, scale(-1.0, spin.omega), given)
            .map_err(SubmanifoldError::from)?;
    }
    let mode = if axis == PrincipalAxis::Least { Mode::LongAxis } else { Mode::ShortAxis };
    let SpinManifoldSettings { degree, masters, style, .. } = settings.clone();
    let plan = SpinManifoldPlan { mode, angular_momentum: K, masters, degree, style };
    Ok(Planned { plan, spin, name, state: (chosen == circled).then_some(state) })
}

/// Place of the steady spin that an angular momentum circles: that of the axis of the frozen body next to it, on a separatrix the nearer of
/// the outer two; with momentum wheels the one next to the axis circled.
fn circled(study: &Study, K: [f64; 3], found: &[NamedSpin]) -> Result<usize, StudyError> {
    let rigid = study.reduced(0)?;
    let axis = Nutations::new(&rigid).at(K).map_or(K, |nutation| nutation.axis);
    let by_axis = match Principal::compute(rigid.J).nearest(axis)[0] {
        Mode::ShortAxis => GREATEST,
        Mode::LongAxis => LEAST,
    };
    let along = |named: &NamedSpin| {
        named.spin.as_ref().map_or(f64::NEG_INFINITY, |spin| dot(unit(spin.angular_momentum), axis))
    };
    let nearest = || (0..found.len()).max_by(|a, b| along(&found[*a]).total_cmp(&along(&found[*b])));
    let named = if study.body.wheels().is_empty() {
        found.iter().position(|named| named.name == by_axis)
    } else {
        None
    };
    named.or_else(nearest).ok_or(StudyError::AtRest)
}

/// Refuses frequencies asked for that no mode about the spin has.
fn there(manifold: &SpinManifold, frequencies: &[f64], kind: BodyKind) -> Result<(), StudyError> {
    let found = &manifold.masters[1..];
    let missing = frequencies.iter().enumerate().find(|(at, frequency)| {
        let near = |master: f64| (master - **frequency).abs() <= SAME_FREQUENCY * frequency.max(master);
        !found.get(*at).is_some_and(|master| near(master.frequency))
    });
    let Some((_, frequency)) = missing else { return Ok(()) };
    let kept = found.iter().map(|mode| (mode.name.clone(), mode.frequency));
    let outer = manifold.outer.iter().map(|mode| (mode.name.clone(), mode.frequency));
    let mut modes: Vec<(String, f64)> = kept.chain(outer).collect();
    modes.sort_by(|a, b| (a.1 - frequency).abs().total_cmp(&(b.1 - frequency).abs()));
    modes.dedup();
    Err(StudyError::NoMaster { frequency: *frequency, modes, kind })
}

/// The start of a state, and whether it lies within the range.
fn within(manifold: &SpinManifold, range: &AmplitudeRange, state: &FullState) -> StartWithin {
    let start = manifold.start(state);
    let sizes: Vec<f64> = start.z.iter().map(|[re, im]| re.hypot(*im)).collect();
    let widest = sizes.iter().copied().fold(0.0, f64::max);
    let amplitude = sizes[0];
    let lost =
        sizes.iter().any(|size| !size.is_finite()) || amplitude > quasirigid::submanifold::MAX_AMPLITUDE;
    let nutation = if lost {
        angle(state.angular_momentum(manifold.body), manifold.axis())
    } else {
        manifold.nutation(amplitude)
    };
    let defect = match (lost, widest > STEADY_AMPLITUDE) {
        (true, _) => Defect { motion: f64::INFINITY, power: f64::INFINITY },
        (_, true) => manifold.defect_around(&start.z),
        (_, false) => Defect::default(),
    };
    let within = amplitude <= range.amplitude && defect.largest() <= range.share;
    StartWithin { start, amplitude, nutation, defect, within }
}

impl AboutSpin<'_> {
    /// Whether the equations hold somewhere, at the start too, and leave no loss out.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.reason().is_none()
    }

    /// Reason for which they do not hold, in words.
    fn reason(&self) -> Option<String> {
        let percent = significant(100.0 * self.range.share, 1);
        let fails = "The reduced equations about the spin DO NOT HOLD";
        let kind = self.study.model.kind;
        let nutation = kind.nutation();
        if let Some((name, decay_rate)) = self.manifold.unstable() {
            return Some(format!(
                "{fails}: the steady spin is unstable, {}.",
                growth(&kind.mode_name(name), decay_rate)
            ));
        }
        if self.range.amplitude <= 0.0 {
            let near = self.manifold.near_resonances().first().map_or_else(String::new, |(_, mode)| {
                format!(", with {} in resonance: follow its mode too", mode.name)
            });
            return Some(format!("{fails} at any {nutation} within {percent} %{near}."));
        }
        let outside = self.start.as_ref().filter(|start| !start.within);
        if let Some(start) = outside {
            let degrees = |angle: f64| significant(angle.to_degrees(), 3);
            let held = degrees(self.range.nutation);
            if start.amplitude <= self.range.amplitude {
                let defect = significant(100.0 * start.defect.largest(), 2);
                return Some(format!(
                    "{fails} at the start: with its other modes they leave {defect} % there, beyond {percent} %."
                ));
            }
            return Some(format!(
                "{fails} at the start: its {nutation} is {} degrees, and at degree {} they hold to {held} degrees within {percent} %.",
                degrees(start.nutation),
                self.manifold.degree()
            ));
        }
        self.left_out.wrong().map(str::to_owned)
    }

    /// The range, or the reason for which the equations do not hold, in a sentence.
    #[must_use]
    pub fn sentence(&self) -> String {
        self.reason().unwrap_or_else(|| {
            let at_least = if self.range.beyond { "at least " } else { "" };
            format!(
                "The reduced equations about the spin hold to a {} of {at_least}{} degrees within {} % at degree {}.",
                self.study.model.kind.nutation(),
                significant(self.range.nutation.to_degrees(), 3),
                significant(100.0 * self.range.share, 1),
                self.manifold.degree()
            )
        })
    }

    /// Points of the backbone, without the steady spin itself, within the range.
    fn inner(&self) -> &[quasirigid::submanifold::BackbonePoint] {
        &self.backbone.points[..=WITHIN]
    }
}
