//! Arguments of a light curve: where Sun and observer stand, and how the surface scatters.

use std::path::PathBuf;

use pyo3::prelude::*;
use quasirigid_io::light_curve::{Clock, LightCurveFile, Sighting, read_light_curve};
use quasirigid_io::model::System;
use quasirigid_study::light_curve::{LightCurveSettings, Scale, View, phase, scattering};

use crate::arguments::named;
use crate::failure::Failure;

/// View and surface of a light curve, as a dictionary.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct LightCurveArgs {
    system: String,
    view: Option<PathBuf>,
    sun: Vec<[f64; 3]>,
    observer: Vec<[f64; 3]>,
    times: Option<Vec<f64>>,
    epoch: Option<f64>,
    law: String,
    phase: String,
    albedo: Option<f64>,
    absolute_magnitude: Option<f64>,
    periods: bool,
}

impl LightCurveArgs {
    /// The settings of the study.
    pub fn settings(&self) -> Result<LightCurveSettings, Failure> {
        Ok(LightCurveSettings {
            system: named::<System>(Some(&self.system), "system")?.unwrap_or(System::Reduced),
            view: self.seen()?,
            epoch: self.epoch,
            scattering: scattering(&self.law)
                .map_err(|help| Failure::Input(format!("law = {:?}: {help}", self.law)))?,
            phase: phase(&self.phase)
                .map_err(|help| Failure::Input(format!("phase = {:?}: {help}", self.phase)))?,
            scale: Scale::given(self.albedo, self.absolute_magnitude),
            periods: self.periods,
        })
    }

    /// A file, directions that stay, or places at times.
    fn seen(&self) -> Result<View, Failure> {
        if let Some(file) = &self.view {
            return Ok(View::File(
                read_light_curve(file).map_err(|error| Failure::Input(error.to_string()))?,
            ));
        }
        let Some(times) = &self.times else {
            return Ok(View::Fixed { sun: self.sun[0], observer: self.observer[0] });
        };
        let at = |places: &[[f64; 3]], row: usize| places[row.min(places.len() - 1)];
        let sightings = times.iter().enumerate().map(|(row, time)| Sighting {
            time: *time,
            sun: at(&self.sun, row),
            observer: at(&self.observer, row),
            brightness: None,
            block: 0,
        });
        Ok(View::File(LightCurveFile { clock: Clock::Seconds, sightings: sightings.collect() }))
    }
}
