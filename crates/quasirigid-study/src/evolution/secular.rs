//! Secular evolution of a body: the power that is followed, its start and end, and the table and record of the result.
//! The power is behind a trait object, because polynomial, harmonics, spinning frame, modes and short runs are exchanged along the way;
//! moments change with it, since the polhode of the deformed body is not that of the frozen one.
//! Equations (G5) to (G8), docs/theory/11-materials.md; effective moments (Q1), docs/theory/16-methods.md.

use std::f64::consts::TAU;
use std::ops::ControlFlow;
use std::sync::Arc;

use quasirigid::averaging::{
    DriftLimits, DriftState, Evolution, FreeRotation, HillResponse, InterpolatedPower, LevelRow, MeanPower,
    PolynomialPower, PowerSource, Response, RotationState, harmonic_power,
};
use quasirigid::dynamics::Start;
use quasirigid::model::{FlexibleBody, Mode, Principal, ReducedBody};
use quasirigid::secular::EnergyRange;
use quasirigid_io::model::{Power, Target};
use quasirigid_io::record::{Column, CrossingRecord, EvolutionRecord, HarmonicRecord, ObservedRecord};
use quasirigid_math::vec3::norm;

use super::approach::approach;
use super::method::Verdict;
use super::reason::Reason;
use super::table::EvolutionTable;
use super::unanswered::unanswered;
use super::{refusals, words};
use crate::error::StudyError;
use crate::settings::EvolveSettings;
use crate::words::shares;

/// Share of the wobble's energy that is left at the end of an evolution without a target.
pub const LEFT: f64 = 0.01;
/// Shares of harmonics below this are negligible and not listed, nor are more than so many harmonics.
pub const FAINT: f64 = 1e-4;
const MOST_HARMONICS: usize = 12;
/// Resonances listed.
const MOST_CROSSINGS: usize = 12;

/// A body in secular evolution.
pub struct SecularEvolution {
    pub principal: Principal,
    pub response: Response,
    pub polynomial: PolynomialPower,
    /// The power of the harmonics, interpolated where it costs much.
    harmonic: Arc<dyn MeanPower>,
    /// Whether the polynomial's power is the one averaged, and whether the user chose its source.
    pub by_polynomial: bool,
    pub power_was_asked: bool,
    /// Whether the harmonics are those of the spinning frame.
    pub in_spinning_frame: bool,
    /// The power that is followed.
    pub source: Arc<dyn MeanPower>,
    /// The method, with its reason, its error, and its results beside the power.
    pub verdict: Verdict,
    /// Rotation of the frozen body with the angular momentum at the start.
    pub initial: FreeRotation,
    pub order: usize,
    /// Whether a material loses energy by a law that the polynomial leaves out.
    pub viscoelastic: bool,
    /// Frequencies (rad/s) between which materials were measured.
    pub measured: Vec<[f64; 2]>,
}

impl SecularEvolution {
    /// Evolution from the reduced equations, and from those of the order to which the state follows its spin.
    pub fn new(
        body: &FlexibleBody,
        [reduced, slaved]: [&ReducedBody; 2],
        start: Start,
        power: Option<Power>,
    ) -> Result<Self, StudyError> {
        let viscoelastic = !body.viscoelastic().is_empty();
        let principal = Principal::compute(reduced.J);
        let frozen = frozen(&principal, slaved.angular_momentum(start.omega));
        let measured = body.viscoelastic().iter().filter_map(|part| part.rheology.measured_between());
        let (response, polynomial) = (Response::compute(body)?, PolynomialPower::from_reduced(reduced));
        let by_polynomial = match power {
            Some(power) => power == Power::Polynomial,
            None => PowerSource::suited_to(body) == PowerSource::Polynomial,
        };
        if !frozen.iter().all(|rate| rate.is_finite()) {
            return Err(StudyError::BoundlessSpin);
        }
        let initial = FreeRotation::through(principal.moments, frozen)?;
        let harmonic = harmonic_power(body, &response, initial.angular_momentum());
        Ok(Self {
            principal,
            source: if by_polynomial { Arc::new(polynomial.clone()) } else { Arc::clone(&harmonic) },
            response,
            harmonic,
            polynomial,
            by_polynomial,
            power_was_asked: power.is_some(),
            in_spinning_frame: false,
            verdict: Verdict::average(None),
            initial,
            order: reduced.order,
            viscoelastic,
            measured: measured.collect(),
        })
    }

    /// Takes the angular momentum (N·m·s, body axes) of the deformed body at its start, which a series of the slow manifold does not know of a
    /// soft body.
    pub fn turn_with(&mut self, K: [f64; 3]) -> Result<(), StudyError> {
        self.initial = FreeRotation::through(self.principal.moments, frozen(&self.principal, K))?;
        Ok(())
    }

    pub fn power(&self) -> &dyn MeanPower {
        &*self.source
    }

    /// Takes the harmonics for the average.
    pub fn take_harmonics(&mut self) {
        (self.by_polynomial, self.source) = (false, Arc::clone(&self.harmonic));
    }

    /// Takes the response in the spinning frame for the average.
    pub fn take_hill(&mut self, hill: HillResponse) {
        self.in_spinning_frame = true;
        self.source = Arc::new(InterpolatedPower::new(hill, self.initial.angular_momentum()));
    }

    /// The average as it stands.
    pub fn shared(&self) -> Arc<dyn MeanPower> {
        if self.by_polynomial { Arc::new(self.polynomial.clone()) } else { Arc::clone(&self.harmonic) }
    }

    /// The record of an evolution that no method leads along: a message, and the rates of the modes.
    pub fn refused(&self, reason: &Reason) -> EvolutionRecord {
        let folding = |mode| self.verdict.folding(mode).unwrap_or(f64::NAN);
        let (damping_time, growth_time) = (folding(Mode::ShortAxis), folding(Mode::LongAxis));
        EvolutionRecord {
            damping_time,
            growth_time,
            ..unanswered(&refusals::text(reason), self.initial.angular_momentum(), mode(self.initial.mode()))
        }
        .with_unknown_named()
    }

    /// Takes another power, along the equivalent polhodes of the deformed body from an energy (J) on.
    pub fn take(&mut self, source: Arc<dyn MeanPower>, range: &EnergyRange, energy: f64) {
        self.principal.moments = range.moments();
        (self.source, self.initial) = (source, range.polhode(energy));
    }

    /// Begins at a rotation state of the deformed body, if there is one.
    pub fn begin(&mut self, stage: Option<RotationState>) {
        let Some(RotationState { mode, xi }) = stage else { return };
        self.initial =
            FreeRotation::at_logit(self.principal.moments, self.initial.angular_momentum(), mode, xi);
    }

    pub fn evolution(&self) -> Evolution {
        Evolution::new(Arc::clone(&self.source), self.initial.angular_momentum())
    }

    /// Start of the evolution: a target, or the initial state.
    pub fn start(
        &self,
        evolution: &Evolution,
        from: Option<Target>,
        free: bool,
    ) -> Result<RotationState, StudyError> {
        let energy = self.initial.energy();
        if energy == 0.0 {
            return Err(StudyError::AtRest);
        }
        if !energy.is_finite() {
            return Err(StudyError::BoundlessSpin);
        }
        match from {
            Some(target) => self.stage(evolution, target),
            None if free => RotationState::from_motion(&self.initial).ok_or(StudyError::Steady),
            None => Ok(RotationState::from_motion(&self.initial)
                .unwrap_or(RotationState::steady(self.initial.mode()))),
        }
    }

    pub fn stage(&self, evolution: &Evolution, target: Target) -> Result<RotationState, StudyError> {
        let [I1, _, I3] = self.principal.moments;
        match target {
            Target::Ratio(ratio) => {
                evolution.stage(ratio).ok_or(StudyError::NoRotationState { ratio, least: I1 / I3 })
            }
            Target::Wobble(angle) => {
                evolution.wobbling(angle).ok_or(StudyError::NoShortAxis { moments: self.principal.moments })
            }
        }
    }

    /// End of the evolution: the target or the time, whichever comes first; without either a hundredth of the wobble's energy.
    pub fn end(
        &self,
        evolution: &Evolution,
        from: RotationState,
        asked: &EvolveSettings,
    ) -> Result<RotationState, StudyError> {
        let target = match asked.until {
            Some(target) => self.stage(evolution, target)?,
            None if asked.duration.is_some() => evolution.settled(),
            None => evolution.faded(from, LEFT).ok_or(StudyError::Steady)?,
        };
        let [start, end] = [from, target].map(|stage| evolution.ratio(stage));
        if end < start {
            return Err(match asked.until {
                Some(Target::Wobble(to)) => {
                    StudyError::Calmer { from: evolution.motion(from).nutation()[1], to }
                }
                _ => StudyError::Backwards { from: start, to: end },
            });
        }
        match asked.duration {
            Some(duration) if evolution.time(from, target) > duration => {
                Ok(evolution.after(from, duration).unwrap_or(from))
            }
            _ => Ok(target),
        }
    }

    /// Limits of a drift: time, target, and the slowest elastic frequency.
    pub fn limits(&self, evolution: &Evolution, asked: &EvolveSettings) -> Result<DriftLimits, StudyError> {
        let duration = asked.duration.ok_or(StudyError::NoEvolutionDuration)?;
        let target = asked.until.map(|target| self.stage(evolution, target)).transpose()?;
        let fastest = self.response.frequencies().next().map_or(f64::INFINITY, |(frequency, _)| frequency);
        Ok(DriftLimits { target, fastest, ..DriftLimits::until(duration) })
    }

    pub fn drifting(&self, stage: RotationState) -> DriftState {
        let circled = self.initial.omega(0.0)[stage.mode.circled()];
        let side = if circled < 0.0 { -1.0 } else { 1.0 };
        DriftState {
            t: 0.0,
            stage,
            angular_momentum: self.initial.angular_momentum(),
            side,
            revolutions: 0.0,
        }
    }

    /// The table of the rows; fewer of them if the watch ends the work.
    pub fn columns(
        &self,
        rows: &mut EvolutionTable,
        watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Vec<Column> {
        let mut columns: Vec<Column> = COLUMNS
            .map(|(name, unit)| Column { name: name.into(), unit: unit.into(), values: Vec::new() })
            .into();
        let ended = rows.status == "interrupted"; // states that a drift has reached are still listed
        for i in 0..rows.states.len() {
            if watch(i as f64 / rows.states.len() as f64).is_break() && !ended {
                rows.states.truncate(i);
                rows.status = "interrupted";
                break;
            }
            let mut values = self.row(rows.advance(i));
            if let Some(powers) = &rows.powers {
                values[POWER] = powers[i];
            }
            if let Some(LevelRow {
                energy,
                nutation,
                period,
                long_axis_precession_rate,
                angular_momentum,
                ..
            }) = rows.levels.as_ref().map(|rows| rows[i])
            {
                let G = norm(angular_momentum);
                values[RATIO] = G * G / (2.0 * energy * self.principal.moments[2]);
                [values[NUTATION], values[NUTATION + 1]] = nutation;
                let precession = TAU / long_axis_precession_rate;
                (values[ENERGY], values[PERIOD], values[PERIOD + 1]) = (energy, period, precession);
            }
            columns.iter_mut().zip(values).for_each(|(column, value)| column.values.push(value));
        }
        columns
    }

    fn row(&self, state: DriftState) -> [f64; COLUMNS.len()] {
        let motion = Evolution::new(self.power(), state.angular_momentum).motion(state.stage);
        let [least, greatest] = motion.nutation();
        [
            state.t,
            motion.ratio(),
            (motion.mode().circled() + 1) as f64,
            least,
            greatest,
            motion.energy(),
            motion.angular_momentum(),
            motion.polhode_period(),
            TAU / motion.long_axis_precession_rate(),
            self.power().mean_power(&motion),
            self.polynomial.mean_power(&motion),
            state.revolutions,
        ]
    }

    pub fn record(
        &self,
        evolution: &Evolution,
        from: RotationState,
        rows: &EvolutionTable,
        asked: &EvolveSettings,
        time_range: Option<[f64; 2]>,
        columns: Vec<Column>,
    ) -> EvolutionRecord {
        let last = rows.last();
        let to = last.stage;
        let power = rows.powers.as_ref().map_or_else(|| evolution.power(from), |powers| powers[0]);
        let ages = power > 0.0 || !rows.steady() || rows.powers.is_some();
        let [start, end] = [0, rows.states.len().saturating_sub(1)].map(|row| observed(&columns, row));
        // Levels of the slow energy have ratios of their own, which the stages of a rigid body do not tell.
        let of_levels = |observed: &Option<ObservedRecord>, stage| {
            let level = rows.levels.as_ref().and(observed.as_ref());
            level.map_or_else(|| evolution.ratio(stage), |level| level.energy_ratio.recip())
        };
        let [ratio_start, ratio_end] = [of_levels(&start, from), of_levels(&end, to)];
        let mut record = EvolutionRecord {
            sentence: String::new(),
            road: self.verdict.road.into(),
            verdict: self.verdict.sentence.clone(),
            method: self.method(),
            status: if self.verdict.fails { "does-not-hold" } else { rows.status }.into(),
            message: if self.verdict.fails {
                self.verdict.sentence.clone()
            } else {
                words::message(rows, asked, ages)
            },
            angular_momentum: self.initial.angular_momentum(),
            mode_start: mode(from.mode).into(),
            mode_end: mode(to.mode).into(),
            ratio_start,
            ratio_end,
            start,
            end, // none of work that was told to end before its first row
            time: if ages { last.t } else { f64::INFINITY },
            time_error: self.verdict.error,
            time_range,
            revolutions: if ages { last.revolutions } else { f64::INFINITY },
            power,
            dissipation: shares(self.verdict.budget.as_ref().unwrap_or(&evolution.budget(from))),
            separatrix_time: if rows.steady() {
                evolution.separatrix_time(from, to)
            } else {
                rows.crossing()
            },
            lingering: if rows.steady() && self.has_separatrix() {
                evolution.lingering(from, to)
            } else {
                None
            },
            damping_time: self
                .verdict
                .folding(Mode::ShortAxis)
                .unwrap_or_else(|| self.damping_time(evolution)),
            growth_time: self.verdict.folding(Mode::LongAxis).unwrap_or(folding(evolution, Mode::LongAxis)),
            not_known: Vec::new(),
            estimates: Vec::new(),
            homogeneous: None,
            harmonics: self.harmonics(&evolution.motion(from)),
            resonances: self.resonances(evolution, from, to),
            approach: approach(&self.response, evolution, [from, to]),
            columns,
        };
        record.sentence = words::sentence(&record, rows.drift.as_ref());
        if !ages && self.by_polynomial && self.response.mean_power(&evolution.motion(from)) > 0.0 {
            record.sentence = words::lossless(self.order);
        }
        record.with_unknown_named()
    }

    /// Whether three moments differ, so that a separatrix lies between the axes.
    fn has_separatrix(&self) -> bool {
        [Mode::LongAxis, Mode::ShortAxis].iter().all(|mode| mode.exists(self.principal.moments))
    }

    /// Time (s) in which a small wobble about the axis of greatest inertia, or about the plane of the two greatest equal moments, falls by e.
    fn damping_time(&self, evolution: &Evolution) -> f64 {
        if Mode::ShortAxis.exists(self.principal.moments) {
            return folding(evolution, Mode::ShortAxis);
        }
        evolution.plane_rate().map_or(f64::NAN, f64::recip)
    }

    fn method(&self) -> String {
        if let Some(method) = self.verdict.method() {
            method
        } else if self.in_spinning_frame {
            "harmonics of the polhode in the spinning frame, coupled by its Coriolis and centrifugal forces"
                .into()
        } else if self.by_polynomial {
            format!("mean of the power of the reduced equations of order {} along the polhode", self.order)
        } else {
            "sum over the harmonics of the polhode, with every elastic mode, dashpot and material".into()
        }
    }

    fn harmonics(&self, motion: &FreeRotation) -> Vec<HarmonicRecord> {
        let powers: Vec<(f64, f64)> = self.response.harmonic_powers(motion).collect();
        let sum: f64 = powers.iter().map(|(_, power)| power).sum();
        let names: Vec<&str> = self.response.dissipators().collect();
        let parts = |taken: Vec<f64>| {
            names.iter().zip(taken).map(|(name, power)| ((*name).to_owned(), power / sum)).collect()
        };
        let listed = powers.iter().zip(self.response.harmonic_budgets(motion)).enumerate();
        let record = |(i, ((frequency, power), taken)): (usize, (&(f64, f64), Vec<f64>))| HarmonicRecord {
            number: i + 1,
            frequency: *frequency,
            share: power / sum,
            dissipation: parts(taken),
        };
        listed.map(record).filter(|harmonic| harmonic.share > FAINT).take(MOST_HARMONICS).collect()
    }

    fn resonances(
        &self,
        evolution: &Evolution,
        from: RotationState,
        to: RotationState,
    ) -> Vec<CrossingRecord> {
        let way = evolution.ratio(from)..=evolution.ratio(to);
        let crossings = self.response.resonances(evolution).into_iter();
        crossings
            .filter(|crossing| way.contains(&evolution.ratio(crossing.stage)))
            .take(MOST_CROSSINGS)
            .map(|crossing| CrossingRecord {
                harmonic: crossing.harmonic,
                frequency: crossing.frequency,
                ratio: evolution.ratio(crossing.stage),
                mode: mode(crossing.stage.mode).into(),
                coordinate: crossing.coordinate,
                share: crossing.share,
            })
            .collect()
    }
}

/// Angular velocity (rad/s) of the frozen body with an angular momentum (N·m·s, body axes), in principal axes.
fn frozen(principal: &Principal, K: [f64; 3]) -> [f64; 3] {
    let K = principal.components(K);
    [0, 1, 2].map(|i| K[i] / principal.moments[i])
}

/// Indices of columns.
const RATIO: usize = 1;
const NUTATION: usize = 3;
const ENERGY: usize = 5;
const PERIOD: usize = 7;
const POWER: usize = 9;
/// Columns of the table, each with its unit.
pub const COLUMNS: [(&str, &str); 12] = [
    ("t", "s"),
    ("D_over_I3", "1"),
    ("circled_axis", "1"),
    ("nutation_min", "rad"),
    ("nutation_max", "rad"),
    ("energy", "J"),
    ("momentum", "N m s"),
    ("polhode_period", "s"),
    ("precession_period", "s"),
    ("power", "W"),
    ("polynomial_power", "W"),
    ("turns", "1"),
];

/// A row of the table as observers describe it.
fn observed(columns: &[Column], row: usize) -> Option<ObservedRecord> {
    let at = |column: usize| columns[column].values.get(row).copied();
    Some(ObservedRecord {
        rotation_period: at(PERIOD)?,
        precession_period: at(PERIOD + 1)?,
        nutation_least: at(NUTATION)?,
        nutation_greatest: at(NUTATION + 1)?,
        energy_ratio: at(RATIO)?.recip(),
    })
}

/// Time (s) in which a small wobble about the axis of a mode changes by e; infinite where there is no such axis, or no loss.
fn folding(evolution: &Evolution, mode: Mode) -> f64 {
    let rate = evolution.wobble_rate(mode);
    if rate > 0.0 { rate.recip() } else { f64::INFINITY }
}

/// The name of a mode.
fn mode(mode: Mode) -> &'static str {
    match mode {
        Mode::ShortAxis => "short-axis",
        Mode::LongAxis => "long-axis",
    }
}
