//! Light curve of the body of a model: its brightness over time as an observer sees it, in the rotation that a history follows.
//! The outer surface is that of the ellipsoid or the surface of the model; the attitude is that of `simulate`. Equations (O7) to (O17),
//! docs/theory/24-light-curves.md.

mod epochs;
mod files;
mod named;
mod periods;
mod residuals;
mod shape;
mod text;

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

pub use named::{phase, scattering};
use quasirigid_io::light_curve::LightCurveFile;
use quasirigid_io::model::{Named, PartialRun, PartialSpinManifold, System};
use quasirigid_math::rotation::Turn;
use quasirigid_photometry::{Facets, Law, LawAt, albedo, magnitude};
pub use quasirigid_photometry::{Hapke, Phase, Scattering};
use rayon::prelude::*;
use serde::Serialize;
use serde_json::{Value, json};

use crate::error::StudyError;
use crate::histories::{History, Table};
use crate::study::Study;
use crate::watch::{Flagging, Watch, watched, whole_pool};
use epochs::{Epoch, Epochs};
use periods::PeriodsObject;
use residuals::ResidualsObject;
use shape::{Lit, Shape};

/// Relative error of the facets above which a light curve may not hold.
const COARSE: f64 = 0.02;
const SECONDS_PER_DAY: f64 = 86_400.0;

/// Place of Sun and observer as seen from the body, in the inertial axes of the model.
#[derive(Clone, Debug)]
pub enum View {
    /// Directions that stay, of any length, at the times of a history.
    Fixed {
        /// Direction to the Sun.
        sun: [f64; 3],
        /// Direction to the observer.
        observer: [f64; 3],
    },
    /// Times and places of a file.
    File(LightCurveFile),
}

/// Scale of the brightness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scale {
    /// None: magnitudes are relative to the mean, or to the albedo of Hapke's law.
    Relative,
    /// Geometric albedo of a sphere of the material.
    Albedo(f64),
    /// Absolute magnitude in V that a sphere with the mean cross-section would have.
    AbsoluteMagnitude(f64),
}

impl Scale {
    /// Scale by the one of both that is given.
    #[must_use]
    pub fn given(albedo: Option<f64>, absolute_magnitude: Option<f64>) -> Self {
        match (albedo, absolute_magnitude) {
            (Some(albedo), _) => Self::Albedo(albedo),
            (None, Some(magnitude)) => Self::AbsoluteMagnitude(magnitude),
            (None, None) => Self::Relative,
        }
    }
}

/// What is seen, and how the surface scatters.
#[derive(Clone, Debug)]
pub struct LightCurveSettings {
    /// System of equations that gives the rotation.
    pub system: System,
    /// Sun and observer.
    pub view: View,
    /// Julian date of the start of the model, where the file has Julian dates or a file of them is to be written.
    pub epoch: Option<f64>,
    /// Law of scattering.
    pub scattering: Scattering,
    /// Its phase function.
    pub phase: Phase,
    /// Scale.
    pub scale: Scale,
    /// Whether frequencies are looked for.
    pub periods: bool,
}

/// Light curve; the first paragraph of a field is the reference of `--json` in the guide.
#[derive(Clone, Debug, Serialize)]
pub struct LightCurve {
    /// Title of the model.
    pub name: String,
    /// The result in words, what does not hold first.
    pub sentence: String,
    /// Whether rotation and brightness hold.
    pub holds: bool,
    /// System of equations of the rotation.
    pub system: &'static str,
    /// Facets of the outer surface.
    pub surface: SurfaceObject,
    /// Geometric albedo of a sphere of the material; `null` where none is given, and for Hapke's law, which has its own.
    pub albedo: Option<f64>,
    /// Mean brightness (m²).
    pub mean_brightness: f64,
    /// Magnitude that zero stands for: `V` of the Sun's light, or the `mean` of the curve.
    pub zero: &'static str,
    /// Greatest less least magnitude; `null` where the body is dark at a time.
    pub amplitude: f64,
    /// Times (s).
    pub t: Vec<f64>,
    /// Area (m²) of the disc that is as bright, as a white sphere at opposition is, at one astronomical unit; times the albedo where there is
    /// one.
    pub brightness: Vec<f64>,
    /// Magnitude at one astronomical unit from Sun and observer.
    pub magnitude: Vec<f64>,
    /// Phase angle (rad).
    pub phase_angle: Vec<f64>,
    /// Comparison with measured brightness; `null` without one.
    pub residuals: Option<ResidualsObject>,
    /// Frequencies found in the curve, measured where it was; `null` if not asked for.
    pub periods: Option<PeriodsObject>,
    /// Notes to read before the numbers.
    pub notes: Vec<String>,
    #[serde(skip)]
    epochs: Vec<Epoch>,
    #[serde(skip)]
    epoch: Option<f64>,
}

/// Facets of an outer surface.
#[derive(Clone, Debug, Serialize)]
pub struct SurfaceObject {
    /// `ellipsoid` or `surface`.
    pub kind: &'static str,
    /// Number of facets.
    pub facets: usize,
    /// Whether the body is convex: it throws no shadow on itself.
    pub convex: bool,
    /// Relative error of the brightness by the size of the facets, estimated; zero of a convex surface of triangles, which is exact.
    pub error: f64,
    /// Mean cross-section of a convex body with this surface (m²).
    pub cross_section: f64,
}

impl Study {
    /// Brightness of the body over time, by the rotation of `simulate`.
    ///
    /// # Errors
    /// Those of [`simulate`](Self::simulate), and [`StudyError::LightCurve`] for a model without an outer surface, for places, times and laws
    /// that give no brightness.
    pub fn light_curve(
        &self,
        run: &PartialRun,
        asked: &LightCurveSettings,
        watch: &mut dyn Watch,
    ) -> Result<LightCurve, StudyError> {
        if let Some(epoch) = asked.epoch.filter(|epoch| !epoch.is_finite()) {
            return Err(refused(format!(
                "the epoch is {epoch}; give the Julian date of the start of the model"
            )));
        }
        let shape = Shape::of(self)?;
        let law = Law::new(asked.scattering, asked.phase).map_err(|error| refused(error.to_string()))?;
        let scale = scale(asked, &law, shape.cross_section())?;
        let epochs = Epochs::new(&asked.view, asked.epoch)?;
        let table = Table {
            system: Some(asked.system),
            coordinates: false,
            displacements: false,
            times: epochs.times(),
            manifold: PartialSpinManifold::default(),
        };
        let history = self.simulate(run, &table, watch)?;
        let (seen, missed) = epochs.seen(&history.columns);
        let laws = seen.iter().map(|epoch| law.at(epoch.phase_angle()));
        let laws = laws.collect::<Result<Vec<LawAt>, _>>().map_err(|error| refused(error.to_string()))?;
        let lit: Vec<Lit> = seen
            .iter()
            .zip(laws)
            .map(|(epoch, law)| {
                let turn = Turn::of(epoch.attitude);
                (law, turn.to_body(epoch.sun), turn.to_body(epoch.observer))
            })
            .collect();
        let (facets, error, brightness) = lighted(&shape, &lit, scale.unwrap_or(1.0), watch)?;
        let surface = SurfaceObject {
            kind: shape.kind(),
            facets: facets.count(),
            convex: facets.is_convex(),
            error,
            cross_section: facets.mean_cross_section(),
        };
        LightCurve::new(
            self,
            asked,
            &history,
            Seen {
                epochs: seen,
                missed,
                brightness,
                surface,
                scale,
                absolute: scale.is_some() || law.has_albedo(),
            },
        )
    }
}

/// Facets of a shape with their error, and the brightness at each time, by all threads.
fn lighted(
    shape: &Shape<'_>,
    lit: &[Lit],
    scale: f64,
    watch: &mut dyn Watch,
) -> Result<(Facets, f64, Vec<f64>), StudyError> {
    let (cancelled, done) = (AtomicBool::new(false), AtomicUsize::new(0));
    let share = || done.load(Ordering::Relaxed) as f64 / lit.len().max(1) as f64;
    let mut observer =
        Flagging { watch, cancelled: &cancelled, stage: "adding up the facets", share: &share };
    let found = watched(&mut observer, || {
        Ok(whole_pool()?.install(|| {
            let (facets, error) = shape.resolved(lit);
            let one = |(law, sun, observer): &Lit| {
                done.fetch_add(1, Ordering::Relaxed);
                let wanted = !cancelled.load(Ordering::Relaxed);
                wanted.then(|| scale * facets.brightness(law, *sun, *observer))
            };
            let brightness: Option<Vec<f64>> = lit.par_iter().map(one).collect();
            brightness.map(|brightness| (facets, error, brightness))
        }))
    })?;
    found.ok_or(StudyError::Interrupted)
}

/// What was seen at the times of a history.
struct Seen {
    epochs: Vec<Epoch>,
    /// Number of times that the history did not reach.
    missed: usize,
    brightness: Vec<f64>,
    surface: SurfaceObject,
    scale: Option<f64>,
    absolute: bool,
}

impl LightCurve {
    fn new(
        study: &Study,
        asked: &LightCurveSettings,
        history: &History,
        seen: Seen,
    ) -> Result<Self, StudyError> {
        let Seen { epochs, missed, brightness, surface, scale, absolute } = seen;
        if epochs.is_empty() {
            return Err(refused(format!("the rotation reaches none of the times: {}", history.message)));
        }
        let mean = brightness.iter().sum::<f64>() / brightness.len() as f64;
        if !(mean > 0.0) {
            return Err(refused(
                "no facet of the body is lit and seen at any time: the Sun stands behind it".to_owned(),
            ));
        }
        let dark =
            epochs.iter().zip(&brightness).find(|(epoch, value)| epoch.measured.is_some() && **value == 0.0);
        if let Some((epoch, _)) = dark {
            return Err(refused(format!(
                "brightness was measured at {} s, and no facet of the model is lit and seen then; are the places of Sun and observer as seen from the body?",
                epoch.t
            )));
        }
        let zero = if absolute { 0.0 } else { magnitude(mean) };
        let magnitudes: Vec<f64> = brightness.iter().map(|value| magnitude(*value) - zero).collect();
        let most = magnitudes.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let residuals = ResidualsObject::of(&epochs, &brightness);
        let periods = asked
            .periods
            .then(|| PeriodsObject::of(&epochs, &brightness, surface.error, history))
            .transpose()?;
        let mut notes: Vec<String> =
            history.reason().map(|reason| format!("{}: {reason}", crate::MAY_NOT_HOLD)).into_iter().collect();
        if surface.error > COARSE {
            notes.push(format!(
                "{}: the facets are too coarse for the shadows of this shape, which are wrong by up to {:.1} % of the brightness",
                crate::MAY_NOT_HOLD,
                100.0 * surface.error
            ));
        }
        let doubt = periods.as_ref().and_then(|periods| periods.doubt.as_ref());
        notes.extend(doubt.map(|doubt| format!("{}: {doubt}", crate::MAY_NOT_HOLD)));
        if missed > 0 {
            notes.push(format!("{missed} times are left out, which the rotation did not reach"));
        }
        notes.extend(history.notes.iter().cloned());
        notes.extend(text::of_frame(&asked.view));
        notes.extend(study.observed.as_ref().map(|_| text::RELAXED.to_owned()));
        let mut found = Self {
            name: study.model.name.clone(),
            sentence: String::new(),
            holds: history.holds()
                && surface.error <= COARSE
                && missed == 0
                && periods.as_ref().is_none_or(|periods| periods.doubt.is_none()),
            system: asked.system.name(),
            surface,
            albedo: scale,
            mean_brightness: mean,
            zero: if absolute { "V" } else { "mean" },
            amplitude: most - magnitudes.iter().copied().fold(f64::INFINITY, f64::min),
            t: epochs.iter().map(|epoch| epoch.t).collect(),
            phase_angle: epochs.iter().map(Epoch::phase_angle).collect(),
            brightness,
            magnitude: magnitudes,
            residuals,
            periods,
            notes,
            epochs,
            epoch: asked.epoch,
        };
        found.sentence = found.told();
        Ok(found)
    }

    /// As a JSON object.
    #[must_use]
    pub fn json(&self) -> Value {
        json!(self)
    }
}

/// Geometric albedo that the brightness is multiplied by, where one is given or follows. (O14)
fn scale(asked: &LightCurveSettings, law: &Law, cross_section: f64) -> Result<Option<f64>, StudyError> {
    if law.has_albedo() && asked.scale != Scale::Relative {
        return Err(refused(
            "Hapke's law has an albedo of its own; leave out any other and an absolute magnitude".to_owned(),
        ));
    }
    let given = match asked.scale {
        Scale::Relative => return Ok(None),
        Scale::Albedo(albedo) => albedo,
        Scale::AbsoluteMagnitude(magnitude) => albedo(magnitude, cross_section),
    };
    if given > 0.0 && given <= 2.0 {
        return Ok(Some(given));
    }
    Err(refused(match asked.scale {
        Scale::AbsoluteMagnitude(magnitude) => format!(
            "an absolute magnitude of {magnitude} for a mean cross-section of {cross_section:.4e} m^2 is a geometric albedo of {given:.3}, which no surface has; is the unit of the shape right?"
        ),
        _ => format!("the geometric albedo is {given}; give a number above 0 and at most 2"),
    }))
}

fn refused(problem: String) -> StudyError {
    StudyError::LightCurve { problem }
}
