//! YORP: the mean torque of sunlight on a body that spins about its axis of greatest inertia, over the rotation and the orbit, by the
//! obliquity. Equations (F30) to (F33), docs/theory/07-forces.md.

mod text;

use std::f64::consts::PI;

use quasirigid::dynamics::Start;
use quasirigid::model::Principal;
use quasirigid::model::force::{
    ForceLaw, MeanSunlight, MeanTorque, SPEED_OF_LIGHT, SunPath, SunlightLoads, ThermalSurface, Trajectory,
    light_pressure,
};
use quasirigid_io::record::Column;
use quasirigid_math::rotation::{Turn, angle};
use quasirigid_math::vec3::{cross, dot, norm, scale};
use serde::Serialize;
use serde_json::{Value, json};

use crate::error::StudyError;
use crate::study::Study;
use crate::words::significant;

/// Steps between obliquities (degrees).
const STEP: usize = 5;
/// Part of the degrees of the harmonics that is left out, two at least, to see what the last ones are worth.
const LEFT_OUT: usize = 4;
/// Error of the torques, of the greatest, above which they may not hold.
const COARSE: f64 = 0.1;
/// Torque over that of the light on the whole body at its radius, which is rounding and the error of the facets.
const NOTHING: f64 = 1e-9;
/// Share of the angular momentum along an axis that is rounding.
const ROUNDING: f64 = 1e-9;
/// Angle (rad) of the start from the axis of greatest inertia that is told.
const WOBBLE: f64 = 0.02;

/// Surface of the body, for the lag of its heat.
#[derive(Clone, Copy, Debug)]
pub struct YorpSettings {
    /// Bond albedo.
    pub albedo: f64,
    /// Emissivity.
    pub emissivity: f64,
    /// Thermal inertia (J/(m²·K·s^½)).
    pub thermal_inertia: f64,
}

impl Default for YorpSettings {
    fn default() -> Self {
        Self { albedo: 0.1, emissivity: 0.9, thermal_inertia: 0.0 }
    }
}

/// YORP of a body; the first paragraph of a field is the reference of `--json` in the guide.
#[derive(Clone, Debug, Serialize)]
pub struct Yorp {
    /// Title of the model.
    pub name: String,
    /// The result in words, what does not hold first.
    pub sentence: String,
    /// Whether the torques hold.
    pub holds: bool,
    /// Spin (rad/s) about the axis of greatest inertia with the angular momentum of the start.
    pub spin: f64,
    /// Moment of inertia about the axis (kg·m²).
    pub moment: f64,
    /// Axis, along the spin, body axes.
    pub axis: [f64; 3],
    /// Mean pressure of the light (Pa) over the orbit.
    pub pressure: f64,
    /// Thermal parameter of the surface.
    pub thermal_parameter: f64,
    /// First harmonic of the heat that is emitted, over that which is absorbed.
    pub emission: f64,
    /// Lag of that harmonic (rad).
    pub lag: f64,
    /// Error of the torques by the harmonics left out, relative to the greatest.
    pub error: f64,
    /// At the obliquity of the start; `null` where the Sun stands in one direction.
    pub now: Option<YorpObject>,
    /// At obliquities from 0 to 180 degrees.
    pub curve: Vec<YorpObject>,
    /// Notes to read before the numbers.
    pub notes: Vec<String>,
}

/// Mean torque and rates at an obliquity.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct YorpObject {
    /// Obliquity (rad).
    pub obliquity: f64,
    /// Mean torque along the spin (N·m).
    pub spin_torque: f64,
    /// Mean torque that raises the obliquity (N·m).
    pub obliquity_torque: f64,
    /// Rate of the spin (rad/s²).
    pub spin_rate: f64,
    /// Rate of the obliquity (rad/s).
    pub obliquity_rate: f64,
    /// Time (s) in which the spin doubles at this rate; `null` where it falls.
    pub doubling_time: Option<f64>,
    /// Time (s) in which the spin halves at this rate; `null` where it rises.
    pub halving_time: Option<f64>,
}

/// Spin of a body about its axis of greatest inertia.
struct Spin {
    rate: f64,
    moment: f64,
    axis: [f64; 3],
    /// Angular momentum at the start (N·m·s), body axes.
    momentum: [f64; 3],
    start: Start,
}

impl Study {
    /// Mean torque of the sunlight of the model by the obliquity.
    ///
    /// # Errors
    /// Those of [`initial`](Self::initial), and [`StudyError::Yorp`] for a model without one force of sunlight on one orbit, on a support, or
    /// at rest, and for a surface that there is not.
    pub fn yorp(&self, asked: YorpSettings) -> Result<Yorp, StudyError> {
        self.undriven("yorp")?;
        let surface = surface(asked)?;
        let (loads, sun) = self.sunlight()?;
        let spin = self.short_axis_spin()?;
        let (pressure, normal) = light(sun)?;
        let center = self.body.center_of_mass();
        let means = MeanSunlight::about(loads, center, spin.axis);
        let irradiance = pressure * SPEED_OF_LIGHT;
        let response = surface.response(irradiance, spin.rate);
        let [force, _] = loads.at(spin.axis);
        let floor = NOTHING * norm(force).powf(1.5);
        let of = |means: &MeanSunlight, obliquity: f64| {
            let MeanTorque { spin: along, obliquity: across } = means.torque(obliquity, response);
            let torques =
                [along, across].map(|torque| if torque.abs() > floor { pressure * torque } else { 0.0 });
            rates(torques, obliquity, &spin)
        };
        let at = |obliquity: f64| of(&means, obliquity);
        let curve: Vec<YorpObject> = (0..=180 / STEP).map(|k| at((k * STEP) as f64 * PI / 180.0)).collect();
        let kept = loads.degree() - (loads.degree() / LEFT_OUT).max(2);
        let coarse = MeanSunlight::about(&loads.truncated(kept), center, spin.axis);
        let rough: Vec<YorpObject> = curve.iter().map(|at| of(&coarse, at.obliquity)).collect();
        let error = error(&curve, &rough, pressure * floor);
        let now = normal.map(|normal| {
            let pole = Turn::of(spin.start.attitude).to_inertial(spin.momentum);
            at(angle(pole, normal))
        });
        let theta = surface.thermal_parameter(irradiance, spin.rate);
        let [emission, lag] = ThermalSurface::emission(theta);
        let wobble = angle(spin.start.omega, spin.axis);
        let mut notes = Vec::new();
        if error > COARSE {
            notes.push(format!(
                "{}: the last harmonics change the torques by {} % of the greatest; ask for a smaller `tolerance` in the force",
                crate::MAY_NOT_HOLD,
                significant(100.0 * error, 2)
            ));
        }
        if wobble > WOBBLE {
            notes.push(format!(
                "the start is {} degrees from the axis of greatest inertia, and the torque is that of a steady spin about it",
                significant(wobble.to_degrees(), 3)
            ));
        }
        let mut found = Yorp {
            name: self.model.name.clone(),
            sentence: String::new(),
            holds: error <= COARSE,
            spin: spin.rate,
            moment: spin.moment,
            axis: spin.axis,
            pressure,
            thermal_parameter: theta,
            emission,
            lag,
            error,
            now,
            curve,
            notes,
        };
        found.sentence = found.told();
        Ok(found)
    }

    /// The one force of sunlight.
    fn sunlight(&self) -> Result<(&SunlightLoads, &SunPath), StudyError> {
        let mut all =
            self.forces.iter().filter(|force| matches!(force.law.timed().0, ForceLaw::Sunlight { .. }));
        let refused = |problem: &str| Err(refused(problem.to_owned()));
        match (all.next().map(|force| force.law.timed()), all.next()) {
            (Some((ForceLaw::Sunlight { loads, sun }, None)), None) => Ok((loads, sun)),
            (Some((_, Some(_))), None) => refused(
                "the sunlight of the model acts in windows of time, and its mean is over all time; leave `during` out",
            ),
            (None, _) => refused(
                "the model has no sunlight; add [[force]] with kind = \"sunlight\" and orbit = { body = \"Sun\", semi_major_axis = \"1 au\" }",
            ),
            _ => refused("the model has several forces of sunlight; keep one"),
        }
    }

    /// The spin about the axis of greatest inertia with the angular momentum of the start.
    fn short_axis_spin(&self) -> Result<Spin, StudyError> {
        if self.body.translation().is_none() {
            return Err(refused(
                "the body has a support, and YORP is the torque on a free one; leave [support] out"
                    .to_owned(),
            ));
        }
        if !self.body.wheels().is_empty() {
            return Err(refused(
                "the body has momentum wheels, and the mean torque is that on a spin about the axis of greatest inertia; leave them out".to_owned(),
            ));
        }
        let start = self.initial()?;
        let J = self.body.invariants().J;
        let Principal { moments, axes } = Principal::compute(J);
        let momentum = quasirigid_math::sym3::times(J, start.omega);
        let along = dot(momentum, axes[2]);
        if along.abs() <= ROUNDING * norm(momentum) {
            return Err(refused("the body does not spin about its axis of greatest inertia; give [initial] an angular_velocity".to_owned()));
        }
        Ok(Spin {
            rate: norm(momentum) / moments[2],
            moment: moments[2],
            axis: scale(along.signum(), axes[2]),
            momentum,
            start,
        })
    }
}

/// Mean pressure of the light over an orbit, and the normal of it; none where the Sun stands in one direction, as if the orbit were a circle.
fn light(sun: &SunPath) -> Result<(f64, Option<[f64; 3]>), StudyError> {
    match sun {
        SunPath::Fixed { distance, .. } => Ok((light_pressure(*distance), None)),
        SunPath::Orbit(Trajectory::Orbit(orbit)) => {
            let point = orbit.at(0.0);
            let e = orbit.eccentricity;
            // the mean of 1/r² over time (F31)
            let pressure = light_pressure(orbit.semi_major_axis) / ((1.0 - e) * (1.0 + e)).sqrt();
            Ok((pressure, Some(cross(point.place, point.velocity))))
        }
        SunPath::Orbit(_) => Err(refused("the orbit of the sunlight is a flyby or a table, and the mean is over an ellipse; give one by its `semi_major_axis`".to_owned())),
    }
}

fn surface(asked: YorpSettings) -> Result<ThermalSurface, StudyError> {
    let YorpSettings { albedo, emissivity, thermal_inertia } = asked;
    if !(0.0..1.0).contains(&albedo) {
        return Err(refused(format!("the Bond albedo is {albedo}; give a number from 0 to below 1")));
    }
    if !(emissivity > 0.0 && emissivity <= 1.0) {
        return Err(refused(format!("the emissivity is {emissivity}; give a number above 0 and at most 1")));
    }
    if !(thermal_inertia >= 0.0 && thermal_inertia.is_finite()) {
        return Err(refused(format!(
            "the thermal inertia is {thermal_inertia}; give zero or a positive number, in J m^-2 K^-1 s^-1/2"
        )));
    }
    Ok(ThermalSurface { albedo, emissivity, thermal_inertia })
}

/// Rates of a spin under torques along it and across it (N·m).
fn rates([along, across]: [f64; 2], obliquity: f64, spin: &Spin) -> YorpObject {
    let rate = along / spin.moment;
    YorpObject {
        obliquity,
        spin_torque: along,
        obliquity_torque: across,
        spin_rate: rate,
        obliquity_rate: across / (spin.moment * spin.rate),
        doubling_time: (rate > 0.0).then(|| spin.rate / rate),
        halving_time: (rate < 0.0).then(|| -0.5 * spin.rate / rate),
    }
}

/// Greatest difference of torques over the greatest torque, which is no smaller than a floor (N·m).
fn error(curve: &[YorpObject], rough: &[YorpObject], floor: f64) -> f64 {
    let greatest = |of: fn(&YorpObject) -> f64| {
        let most = curve.iter().map(of).fold(0.0, |most: f64, value| most.max(value.abs()));
        let off = curve.iter().zip(rough).map(|(a, b)| (of(a) - of(b)).abs()).fold(0.0, f64::max);
        [most, off]
    };
    let parts: [[f64; 2]; 2] = [greatest(|of| of.spin_torque), greatest(|of| of.obliquity_torque)];
    parts.iter().map(|[_, off]| *off).fold(0.0, f64::max)
        / parts.iter().map(|[most, _]| *most).fold(floor, f64::max)
}

impl Yorp {
    /// As a JSON object.
    #[must_use]
    pub fn json(&self) -> Value {
        json!(self)
    }

    /// The curve as a table.
    #[must_use]
    pub fn columns(&self) -> Vec<Column> {
        type Of = fn(&YorpObject) -> f64;
        let all: [(&str, &str, Of); 5] = [
            ("obliquity", "rad", |at| at.obliquity),
            ("spin_torque", "N m", |at| at.spin_torque),
            ("obliquity_torque", "N m", |at| at.obliquity_torque),
            ("spin_rate", "rad/s^2", |at| at.spin_rate),
            ("obliquity_rate", "rad/s", |at| at.obliquity_rate),
        ];
        all.map(|(name, unit, of)| Column {
            name: name.into(),
            unit: unit.into(),
            values: self.curve.iter().map(of).collect(),
        })
        .into()
    }
}

fn refused(problem: String) -> StudyError {
    StudyError::Yorp { problem }
}
