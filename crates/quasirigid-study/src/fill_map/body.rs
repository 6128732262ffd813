//! The body at a fill and a spin: the model changed, its modes about that spin, and the slosh nearest to the rate of the nutation.

use quasirigid::elements::{Settling, TankContents};
use quasirigid_io::model::{Model, Rotation};
use quasirigid_io::record::{
    FillMotionRecord, FillPointRecord, ModeRecord, NearestSloshRecord, SteadySpinRecord,
};
use quasirigid_math::vec3::{minus, norm, scale, unit};

use super::held::{nutation_rate, slosh_frequencies};
use crate::error::StudyError;
use crate::modes::SteadySpinSettings;
use crate::study::Study;
use crate::tanks::{NOTABLE, felt};
use crate::words::{MAY_NOT_HOLD, significant};

/// Relative difference of the rate of a steady state from the spin that was asked for, above which it is another one.
const OTHER_SPIN: f64 = 0.01;

/// A model whose tanks are filled anew.
pub(super) struct FilledBody<'a> {
    study: &'a Study,
    /// Numbers of the tanks that are filled, and the mass of the liquid that each holds (kg).
    tanks: Vec<(usize, f64)>,
    /// Tanks whose liquids the recoil of the forces presses.
    thrust: Vec<usize>,
    /// Direction of the spin, and its size at the start (rad/s).
    axis: [f64; 3],
    pub spin: f64,
}

/// Slosh frequency: numbers of the tank, of the mode and of the slower or the faster of both.
pub(super) type SloshNumber = [usize; 3];

/// Point of a map, with every slosh frequency over the rate of the nutation with the liquid held.
#[derive(Clone, Debug)]
pub(super) struct Point {
    pub record: FillPointRecord,
    pub ratios: Vec<(SloshNumber, f64)>,
}

impl<'a> FilledBody<'a> {
    /// Tanks by name, or all.
    pub fn new(study: &'a Study, names: &[String]) -> Result<Self, StudyError> {
        let refused = |problem: String| StudyError::FillMap { problem };
        let all = &study.tanks;
        if all.is_empty() {
            let problem = "the model has no [[tank]] of revolution whose fill could be varied; a [[tank]] of shape \"tube\" and a [[cavity]] are none";
            return Err(refused(problem.to_owned()));
        }
        let number = |name: &String| {
            let known = || all.iter().map(|tank| format!("{:?}", tank.name)).collect::<Vec<_>>().join(", ");
            let found = all.iter().position(|tank| tank.name == *name);
            found.ok_or_else(|| {
                refused(format!("there is no [[tank]] {name:?} of revolution; there is {}", known()))
            })
        };
        let mut chosen = names.iter().map(number).collect::<Result<Vec<usize>, _>>()?;
        if names.is_empty() {
            chosen = (0..all.len()).collect();
        }
        chosen.sort_unstable();
        chosen.dedup();
        let spin = study.initial()?.omega;
        let size = norm(spin);
        if !(size > 0.0) {
            let problem = "the body does not turn, and the map is about the axis of its spin: give [initial] an angular_velocity, however slow";
            return Err(refused(problem.to_owned()));
        }
        let recoil = felt(study);
        let pressed = |number: &usize| {
            let Settling::Acceleration(settled) = all[*number].settled_by else { return false };
            study.body.support() == &quasirigid::model::Support::Free
                && norm(minus(recoil, settled)) <= NOTABLE * norm(settled)
        };
        Ok(Self {
            study,
            tanks: chosen
                .into_iter()
                .map(|number| (number, all[number].liquid_mass / all[number].fill))
                .collect(),
            thrust: (0..all.len()).filter(pressed).collect(),
            axis: unit(spin),
            spin: size,
        })
    }

    /// Names of the tanks that are filled.
    pub fn names(&self) -> Vec<String> {
        self.tanks.iter().map(|(number, _)| self.study.tanks[*number].name.clone()).collect()
    }

    /// Mass of the liquid (kg) in the tanks that are filled.
    fn liquid_mass(&self, fill: f64) -> f64 {
        self.tanks.iter().map(|(_, capacity)| fill * capacity).sum()
    }

    /// The model at a fill and a spin (rad/s).
    fn model(&self, fill: f64, spin: f64) -> Model {
        let mut model = self.study.model.clone();
        let omega = scale(spin, self.axis);
        model.initial.rotation = Some(Rotation::Spin(omega));
        model.extremes = None;
        let tanks = &mut model.assembly.tanks;
        self.tanks.iter().for_each(|(number, _)| tanks[*number].contents = TankContents::Fill(fill));
        let before: f64 = self.tanks.iter().map(|(number, _)| self.study.tanks[*number].liquid_mass).sum();
        let mass = self.study.body.invariants().mass;
        let lighter = mass / (mass + self.liquid_mass(fill) - before);
        for (number, tank) in tanks.iter_mut().enumerate() {
            match &mut tank.settled_by {
                Settling::Spin(settled) => *settled = omega,
                Settling::Acceleration(settled) if self.thrust.contains(&number) => {
                    *settled = scale(lighter, *settled);
                }
                Settling::Acceleration(_) => {}
            }
        }
        model
    }

    /// The point of a fill and a spin (rad/s).
    pub fn at(&self, fill: f64, spin: f64) -> Point {
        let mut record = FillPointRecord {
            spin,
            fill,
            liquid_mass: self.liquid_mass(fill),
            status: FillPointRecord::REFUSED.into(),
            reason: None,
            nutation: None,
            rigid_rate: None,
            dissipation: std::collections::BTreeMap::new(),
            slowest: None,
            nearest: None,
        };
        let mut ratios = Vec::new();
        match self.modes(fill, spin) {
            Err(reason) => record.reason = Some(reason),
            Ok((study, found)) => {
                let doubt = doubt(&study, &found);
                record.status =
                    if doubt.is_some() { FillPointRecord::DOUBTFUL } else { FillPointRecord::ANSWERED }
                        .into();
                record.reason = doubt;
                ratios = met(&study, &found, &mut record);
                motions(&found, &mut record);
            }
        }
        Point { record, ratios }
    }

    /// The study of a point with its steady spin, or the reason for which there is none.
    fn modes(&self, fill: f64, spin: f64) -> Result<(Study, SteadySpinRecord), String> {
        let first_line = |error: StudyError| {
            let text = error.to_string();
            text.lines().find(|line| !line.trim().is_empty()).unwrap_or("no answer").trim().to_owned()
        };
        let study = Study::new(self.model(fill, spin), Some(self.study.order)).map_err(first_line)?;
        let asked =
            SteadySpinSettings { omega: Some(scale(spin, self.axis)), ..SteadySpinSettings::default() };
        let mut found = study.modes(asked).map_err(first_line)?;
        let spins = found.spins.drain(..).next();
        let found = spins.ok_or_else(|| "no steady spin was found".to_owned())?;
        match found.spin {
            None => Err(found.sentence),
            Some(steady) if (norm(steady) - spin).abs() > OTHER_SPIN * spin => Err(format!(
                "the steady state beside this spin turns at {} rad/s",
                significant(norm(steady), 4)
            )),
            Some(_) => Ok((study, found)),
        }
    }
}

/// Why the answer may not hold; none where it does.
fn doubt(study: &Study, found: &SteadySpinRecord) -> Option<String> {
    let mut texts = study.model.notes.iter().chain([&found.sentence]);
    let text = texts.find(|text| text.starts_with(MAY_NOT_HOLD))?;
    let told = text[MAY_NOT_HOLD.len()..].trim_start_matches([':', ',', ' ']).trim_start_matches("since ");
    let end = told.find(". ").map_or(told.len(), |end| end + 1);
    Some(told[..end].to_owned())
}

/// Slosh frequencies over the rate of the nutation, with that rate and the nearest of them in the record. (U15), (U16)
fn met(study: &Study, found: &SteadySpinRecord, record: &mut FillPointRecord) -> Vec<(SloshNumber, f64)> {
    let (Some(spin), Some(angular_momentum)) = (found.spin, found.angular_momentum) else {
        return Vec::new();
    };
    record.rigid_rate = nutation_rate(study.body.invariants().J, spin, angular_momentum);
    let Some(rate) = record.rigid_rate else { return Vec::new() };
    let mut ratios = Vec::new();
    let mut nearest: Option<NearestSloshRecord> = None;
    for (number, tank) in study.tanks.iter().enumerate() {
        for (mode, slosh) in tank.slosh.iter().enumerate() {
            for (which, frequency) in slosh_frequencies(tank, slosh.frequency, spin).into_iter().enumerate() {
                let Some(frequency) = frequency else { continue };
                let ratio = frequency / rate;
                ratios.push(([number, mode, which], ratio));
                if nearest.as_ref().is_none_or(|known| ratio.ln().abs() < known.ratio.ln().abs()) {
                    nearest = Some(NearestSloshRecord {
                        tank: tank.name.clone(),
                        mode: mode + 1,
                        frequency,
                        ratio,
                    });
                }
            }
        }
    }
    record.nearest = nearest;
    ratios
}

/// The nutation, and of the others the one that grows fastest or decays slowest.
fn motions(found: &SteadySpinRecord, record: &mut FillPointRecord) {
    let told = |mode: &ModeRecord| FillMotionRecord {
        name: mode.name.clone(),
        frequency: mode.frequency,
        decay_rate: mode.decay_rate,
        time_constant: mode.time_constant,
    };
    let nutation = found.modes.iter().find(|mode| mode.nutation && !mode.neutral);
    record.nutation = nutation.map(told);
    record.dissipation = nutation.map(|mode| mode.dissipation.clone()).unwrap_or_default();
    let others = found.modes.iter().filter(|mode| !mode.nutation && !mode.neutral);
    record.slowest = others.min_by(|a, b| a.decay_rate.total_cmp(&b.decay_rate)).map(told);
}
