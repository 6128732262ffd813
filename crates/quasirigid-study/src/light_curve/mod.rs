//! Light curve of the body of a model: its brightness over time as an observer sees it, in the rotation that a history follows.
//! The outer surface is that of the ellipsoid or the surface of the model; the attitude is that of `simulate`. Equations (O7) to (O17),
//! docs/theory/24-light-curves.md.

mod epochs;
mod periods;
mod residuals;
mod shape;
mod text;

use quasirigid_io::light_curve::{LightCurveFile, Sighting, alcdef, damit};
use quasirigid_io::model::{Named, PartialRun, PartialSpinManifold, System};
use quasirigid_io::record::Column;
use quasirigid_math::rotation::Turn;
use quasirigid_photometry::{ASTRONOMICAL_UNIT, Law, LawAt, albedo, magnitude};
pub use quasirigid_photometry::{Hapke, Phase, Scattering};
use rayon::prelude::*;
use serde::Serialize;
use serde_json::{Value, json};

use crate::error::StudyError;
use crate::histories::{History, Table};
use crate::study::Study;
use crate::watch::{Watch, whole_pool};
use epochs::{Epoch, Epochs};
use periods::PeriodsObject;
use residuals::ResidualsObject;
use shape::Shape;

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
        let shape = Shape::of(self)?;
        let law = Law::new(asked.scattering, asked.phase).map_err(|error| refused(error.to_string()))?;
        let scale = scale(asked, &law, shape.cross_section())?;
        let epochs = Epochs::new(&asked.view, asked.epoch)?;
        let table = Table {
            system: asked.system,
            coordinates: false,
            displacements: false,
            times: epochs.times(),
            manifold: PartialSpinManifold::default(),
        };
        let history = self.simulate(run, &table, watch)?;
        let (seen, missed) = epochs.seen(&history.columns);
        let laws = seen.iter().map(|epoch| law.at(epoch.phase_angle()));
        let laws = laws.collect::<Result<Vec<LawAt>, _>>().map_err(|error| refused(error.to_string()))?;
        let lit: Vec<(LawAt, [f64; 3], [f64; 3])> = seen
            .iter()
            .zip(laws)
            .map(|(epoch, law)| {
                let turn = Turn::of(epoch.attitude);
                (law, turn.to_body(epoch.sun), turn.to_body(epoch.observer))
            })
            .collect();
        let pool = whole_pool()?;
        let (facets, error) = pool.install(|| shape.resolved(&lit));
        let brightness: Vec<f64> = pool.install(|| {
            lit.par_iter()
                .map(|(law, sun, observer)| scale.unwrap_or(1.0) * facets.brightness(law, *sun, *observer))
                .collect()
        });
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
        let zero = if absolute { 0.0 } else { magnitude(mean) };
        let magnitudes: Vec<f64> = brightness.iter().map(|value| magnitude(*value) - zero).collect();
        let most = magnitudes.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let residuals = ResidualsObject::of(&epochs, &brightness);
        let periods = asked.periods.then(|| PeriodsObject::of(&epochs, &brightness, history)).transpose()?;
        let mut notes: Vec<String> =
            history.reason().map(|reason| format!("{}: {reason}", crate::MAY_NOT_HOLD)).into_iter().collect();
        if surface.error > COARSE {
            notes.push(format!(
                "{}: the facets are too coarse for the shadows of this shape, which are wrong by up to {:.1} % of the brightness",
                crate::MAY_NOT_HOLD,
                100.0 * surface.error
            ));
        }
        if missed > 0 {
            notes.push(format!("{missed} times are left out, which the rotation did not reach"));
        }
        notes.extend(history.notes.iter().cloned());
        notes.extend(text::of_frame(&asked.view));
        notes.extend(study.observed.as_ref().map(|_| text::RELAXED.to_owned()));
        let mut found = Self {
            name: study.model.name.clone(),
            sentence: String::new(),
            holds: history.holds() && surface.error <= COARSE && missed == 0,
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

    /// The table: time, brightness, magnitude and phase angle; distances where the places of a file have them, and what was measured.
    #[must_use]
    pub fn columns(&self) -> Vec<Column> {
        let column = |name: &str, unit: &str, values: Vec<f64>| Column {
            name: name.into(),
            unit: unit.into(),
            values,
        };
        let mut columns = vec![
            column("t", "s", self.t.clone()),
            column("brightness", "m^2", self.brightness.clone()),
            column("magnitude", "mag", self.magnitude.clone()),
            column("phase_angle", "rad", self.phase_angle.clone()),
        ];
        let each =
            |of: &dyn Fn(&Epoch) -> Option<f64>| self.epochs.iter().map(of).collect::<Option<Vec<f64>>>();
        let distances = each(&|epoch| epoch.distances.map(|[sun, _]| sun))
            .zip(each(&|epoch| epoch.distances.map(|[_, observer]| observer)));
        if let Some((sun, observer)) = distances {
            let apparent = self
                .magnitude
                .iter()
                .zip(sun.iter().zip(&observer))
                .map(|(m, (r, d))| m + 5.0 * (r * d).log10())
                .collect();
            let [sun, observer] =
                [sun, observer].map(|distances| distances.iter().map(|au| au * ASTRONOMICAL_UNIT).collect());
            columns.push(column("sun_distance", "m", sun));
            columns.push(column("observer_distance", "m", observer));
            columns.push(column("apparent_magnitude", "mag", apparent));
        }
        if let (Some(residuals), Some(_)) = (&self.residuals, each(&|epoch| epoch.measured)) {
            let block = self.epochs.iter().map(|epoch| epoch.block as f64).collect();
            columns.push(column("measured", "m^2", residuals.scaled.clone()));
            columns.push(column("residual", "1", residuals.each.clone()));
            columns.push(column("block", "1", block));
        }
        columns
    }

    /// The curve as a file of DAMIT, relative in each block.
    ///
    /// # Errors
    /// [`StudyError::LightCurve`] without a Julian date of the start or places of Sun and observer.
    pub fn damit(&self) -> Result<String, StudyError> {
        let mut sightings = self.sightings()?;
        for block in sightings.chunk_by_mut(|a, b| a.block == b.block) {
            let mean = block.iter().filter_map(|each| each.brightness).sum::<f64>() / block.len() as f64;
            block.iter_mut().for_each(|each| each.brightness = each.brightness.map(|value| value / mean));
        }
        Ok(damit(&sightings))
    }

    /// The curve as a file of ALCDEF, with the magnitudes that the observer sees.
    ///
    /// # Errors
    /// As [`damit`](Self::damit).
    pub fn alcdef(&self) -> Result<String, StudyError> {
        let apparent = self.columns().into_iter().find(|column| column.name == "apparent_magnitude");
        let sightings = self.sightings()?;
        let magnitudes = apparent.map_or_else(Vec::new, |column| column.values);
        let phase = |sighting: &Sighting| {
            quasirigid_math::rotation::angle(sighting.sun, sighting.observer).to_degrees()
        };
        Ok(alcdef(&self.name, &sightings, &magnitudes, phase))
    }

    fn sightings(&self) -> Result<Vec<Sighting>, StudyError> {
        let epoch = self.epoch.ok_or_else(|| refused("files of DAMIT and ALCDEF have Julian dates; give the one of the start of the model, its epoch".to_owned()))?;
        let sighting = |(epoch_of, brightness): (&Epoch, &f64)| {
            let [sun, observer] = epoch_of.distances?;
            Some(Sighting {
                time: epoch + epoch_of.t / SECONDS_PER_DAY,
                sun: epoch_of.sun.map(|entry| sun * entry),
                observer: epoch_of.observer.map(|entry| observer * entry),
                brightness: Some(*brightness),
                block: epoch_of.block,
            })
        };
        let all: Option<Vec<Sighting>> = self.epochs.iter().zip(&self.brightness).map(sighting).collect();
        all.ok_or_else(|| refused("files of DAMIT and ALCDEF have places of Sun and observer; give them by a file in place of two directions".to_owned()))
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
