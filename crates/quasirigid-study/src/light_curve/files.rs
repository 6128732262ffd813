//! A light curve as a table, and as files of DAMIT and ALCDEF.

use quasirigid_io::light_curve::{Sighting, alcdef, damit};
use quasirigid_io::record::Column;
use quasirigid_math::rotation::angle;
use quasirigid_math::vec3::norm;
use quasirigid_photometry::{ASTRONOMICAL_UNIT, magnitude};

use super::epochs::Epoch;
use super::{LightCurve, SECONDS_PER_DAY, refused};
use crate::error::StudyError;

impl LightCurve {
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
            let name = if self.zero == "V" { "apparent_magnitude" } else { "apparent_relative_magnitude" };
            columns.push(column(name, "mag", apparent));
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
        let sightings = self.sightings()?;
        let apparent = |sighting: &Sighting| {
            let [sun, observer] = [sighting.sun, sighting.observer].map(norm);
            let zero = if self.zero == "V" { 0.0 } else { magnitude(self.mean_brightness) };
            magnitude(sighting.brightness.unwrap_or(0.0)) - zero + 5.0 * (sun * observer).log10()
        };
        let magnitudes: Vec<f64> = sightings.iter().map(apparent).collect();
        let phase = |sighting: &Sighting| angle(sighting.sun, sighting.observer).to_degrees();
        Ok(alcdef(&self.name, &sightings, (&magnitudes, self.zero != "V"), phase))
    }

    /// What a file tells of each time, block by block.
    fn sightings(&self) -> Result<Vec<Sighting>, StudyError> {
        if let Some(dark) = self.brightness.iter().position(|value| *value == 0.0) {
            return Err(refused(format!(
                "no facet is lit and seen at {} s, and files of DAMIT and ALCDEF hold no dark body: leave such times out",
                self.t[dark]
            )));
        }
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
        let sorted = all.map(|mut all| {
            all.sort_by_key(|sighting| sighting.block);
            all
        });
        sorted.ok_or_else(|| refused("files of DAMIT and ALCDEF have places of Sun and observer; give them by a file in place of two directions".to_owned()))
    }
}
