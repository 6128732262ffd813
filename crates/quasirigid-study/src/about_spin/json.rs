//! Reduced equations about a spin, for machines. First paragraphs of the fields are the reference of `--json` in the guide.

use std::collections::BTreeMap;

use quasirigid::model::Coordinate;
use quasirigid::submanifold::{AmplitudeRange, BackbonePoint, Defect, Style, Truncated};
use serde::Serialize;
use serde_json::{Value, json};

use super::{AboutSpin, StartWithin};
use crate::words::shares;

/// Version of the object; a key that changes its meaning raises it.
const VERSION: usize = 1;

/// Reduced equations about a spin.
#[derive(Serialize)]
struct EquationsObject<'a> {
    /// 1, raised where a key changes its meaning.
    version: usize,
    /// Title of the model.
    name: &'a str,
    /// `SI`.
    units: &'a str,
    /// `spin`.
    about: &'a str,
    /// Whether they hold at the start.
    holds: bool,
    /// In words.
    sentence: String,
    /// `least` or `greatest` inertia; `least energy` or `greatest energy` where momentum wheels turn the spin away.
    axis: &'a str,
    /// Steady spin (rad/s), body axes.
    spin: [f64; 3],
    /// N m s.
    angular_momentum: [f64; 3],
    /// J.
    energy: f64,
    /// m, rad.
    displacements: BTreeMap<&'a str, f64>,
    /// In the amplitude.
    degree: usize,
    /// `normal-form` or `graph`.
    style: &'a str,
    /// The nutation first.
    masters: Vec<MasterObject<'a>>,
    /// How far the equations hold, (W11).
    range: RangeObject,
    /// The start; `null` about an axis not circled.
    start: Option<StartObject<'a>>,
    /// Effects left out.
    left_out: Vec<String>,
    /// The nutation by its amplitude, to a quarter beyond the range, (W12).
    backbone: Vec<PointObject>,
    /// Modes left out, the slowest first.
    outer: Vec<OuterObject<'a>>,
    /// Of monomials with those modes, (W6).
    resonances: Vec<ResonanceObject<'a>>,
    /// Resonances that the nutation meets up to twice its range.
    met: Vec<MetObject<'a>>,
    /// Spin from which a motion grows, up to tenfold, or `null`.
    whirl_onset: Option<WhirlObject<'a>>,
    /// `z1`, conjugate `z1*`, ….
    variables: Vec<String>,
    /// Of `W.coordinates`.
    coordinates: Vec<&'a str>,
    /// Of `W.rates`.
    rates: Vec<&'a str>,
    /// ż = R(z).
    R: Vec<RateTerm<'a>>,
    /// Manifold.
    W: Vec<StateTerm<'a>>,
}

/// Mode that the equations follow.
#[derive(Serialize)]
struct MasterObject<'a> {
    /// `nutation`, or a coordinate.
    name: &'a str,
    /// 1/s, negative where it grows.
    decay_rate: f64,
    /// s.
    time_constant: Option<f64>,
    /// rad/s.
    frequency: f64,
}

/// Range of the nutation.
#[derive(Serialize)]
pub(super) struct RangeObject {
    /// rad.
    nutation: f64,
    /// |z1|.
    amplitude: f64,
    /// Defect there.
    share: f64,
    /// Farther than searched.
    beyond: bool,
}

/// Start on the spin manifold.
#[derive(Serialize)]
struct StartObject<'a> {
    /// |z1|.
    amplitude: f64,
    /// rad.
    nutation: f64,
    /// Whether in the range.
    within: bool,
    /// Shares.
    defect: DefectObject,
    /// Share of the energy beyond the steady spin, off the spin manifold.
    left_out: Option<f64>,
    /// z, one of each conjugate pair.
    coordinates: &'a [[f64; 2]],
}

/// Defect of the equations.
#[derive(Serialize)]
struct DefectObject {
    /// Or `null`.
    motion: Option<f64>,
    /// Or `null`.
    power: Option<f64>,
}

/// Point of the backbone.
#[derive(Serialize)]
struct PointObject {
    /// |z1|.
    amplitude: f64,
    /// rad.
    nutation: f64,
    /// 1/s.
    decay_rate: f64,
    /// s.
    time_constant: Option<f64>,
    /// rad/s.
    frequency: f64,
    /// W.
    power: f64,
    /// Shares.
    dissipation: BTreeMap<String, f64>,
    /// Shares.
    defect: DefectObject,
}

/// Mode that the equations leave out.
#[derive(Serialize)]
struct OuterObject<'a> {
    /// Coordinate.
    name: &'a str,
    /// 1/s.
    decay_rate: f64,
    /// rad/s.
    frequency: f64,
}

/// Near resonance of a monomial with a mode left out.
#[derive(Serialize)]
struct ResonanceObject<'a> {
    /// Of the monomial.
    exponents: &'a [u8],
    /// Of the mode.
    name: &'a str,
    /// rad/s.
    frequency: f64,
    /// Relative.
    distance: f64,
}

/// Resonance on the way.
#[derive(Serialize)]
struct MetObject<'a> {
    /// Of the mode.
    name: &'a str,
    /// Of the nutation.
    harmonic: usize,
    /// rad.
    nutation: f64,
    /// rad/s.
    frequency: f64,
}

/// Onset of whirl.
#[derive(Serialize)]
struct WhirlObject<'a> {
    /// rad/s.
    spin: f64,
    /// Of the motion.
    name: &'a str,
    /// rad/s.
    frequency: f64,
}

/// Term of the motion on the spin manifold.
#[derive(Serialize)]
struct RateTerm<'a> {
    /// From 0.
    master: usize,
    /// Of the monomial.
    exponents: &'a [u8],
    /// Complex.
    value: [f64; 2],
}

/// Term of the spin manifold.
#[derive(Serialize)]
struct StateTerm<'a> {
    /// Of the monomial.
    exponents: &'a [u8],
    /// rad/s.
    omega: Vec<[f64; 2]>,
    /// Of coordinates.
    rates: Vec<[f64; 2]>,
    /// m, rad.
    coordinates: Vec<[f64; 2]>,
    /// Of the angular momentum, body axes.
    direction: Vec<[f64; 2]>,
}

impl RangeObject {
    pub(super) fn new(range: &AmplitudeRange) -> Self {
        let AmplitudeRange { amplitude, nutation, share, beyond } = *range;
        Self { nutation, amplitude, share, beyond }
    }
}

fn finite(value: f64) -> Option<f64> {
    Some(value).filter(|value| value.is_finite())
}

fn defect(defect: &Defect) -> DefectObject {
    DefectObject { motion: finite(defect.motion), power: finite(defect.power) }
}

pub(super) fn time_constant(decay_rate: f64) -> Option<f64> {
    finite(decay_rate.recip())
}

fn point(point: &BackbonePoint) -> PointObject {
    let BackbonePoint { amplitude, nutation, decay_rate, frequency, power, defect: left } = point;
    PointObject {
        amplitude: *amplitude,
        nutation: *nutation,
        decay_rate: *decay_rate,
        time_constant: time_constant(*decay_rate),
        frequency: *frequency,
        power: power.iter().map(|(_, power)| power).sum(),
        dissipation: shares(power),
        defect: defect(left),
    }
}

fn start(start: &StartWithin) -> StartObject<'_> {
    let StartWithin { start, amplitude, nutation, defect: left, within } = start;
    StartObject {
        amplitude: *amplitude,
        nutation: *nutation,
        within: *within,
        defect: defect(left),
        left_out: finite(start.left_out),
        coordinates: &start.z,
    }
}

/// Terms of the spin manifold that are not zero: angular velocity, rates, coordinates, direction.
fn state_terms<'a>(exponents: &'a [Vec<u8>], parts: [&[Truncated]; 4]) -> Vec<StateTerm<'a>> {
    let of = |(monomial, exponents): (usize, &'a Vec<u8>)| {
        let values =
            |part: &[Truncated]| part.iter().map(|each| each.coefficient(monomial)).collect::<Vec<_>>();
        let [omega, rates, coordinates, direction] = parts.map(values);
        let parts = [&omega, &rates, &coordinates, &direction];
        let any = parts.into_iter().flatten().any(|value| *value != [0.0; 2]);
        any.then_some(StateTerm { exponents, omega, rates, coordinates, direction })
    };
    exponents.iter().enumerate().filter_map(of).collect()
}

fn names(coordinates: &[Coordinate]) -> Vec<&str> {
    coordinates.iter().map(|each| each.name.as_str()).collect()
}

impl AboutSpin<'_> {
    /// For machines: every coefficient, with all digits.
    #[must_use]
    pub fn json(&self) -> Value {
        let Self { study, manifold, name, backbone, .. } = self;
        let (body, expansion) = (manifold.body, manifold.expansion());
        let (n, elastic) = (body.coordinates().len(), body.elastic());
        let exponents = expansion.ring.exponents();
        let mut rates = Vec::new();
        for (master, lead) in self.leads().enumerate() {
            for (monomial, exponents) in exponents.iter().enumerate() {
                let value = expansion.rates[lead].coefficient(monomial);
                if value != [0.0; 2] {
                    rates.push(RateTerm { master, exponents, value });
                }
            }
        }
        let state = &expansion.state;
        let parts =
            [&state[..3], &state[3..3 + n], &state[3 + n..3 + n + elastic], manifold.direction_expansion()];
        let resonances = manifold.near_resonances();
        let displaced = body.coordinates().iter().zip(&manifold.spin.q).take(elastic);
        json!(EquationsObject {
            version: VERSION,
            name: &study.model.name,
            units: "SI",
            about: "spin",
            holds: self.holds(),
            sentence: self.sentence(),
            axis: name,
            spin: manifold.spin.omega,
            angular_momentum: manifold.spin.angular_momentum,
            energy: manifold.steady_energy(),
            displacements: displaced.map(|(coordinate, q)| (coordinate.name.as_str(), *q)).collect(),
            degree: manifold.degree(),
            style: match manifold.style {
                Style::NormalForm => "normal-form",
                Style::Graph => "graph",
            },
            masters: manifold
                .masters
                .iter()
                .map(|master| MasterObject {
                    name: &master.name,
                    decay_rate: master.decay_rate,
                    time_constant: time_constant(master.decay_rate),
                    frequency: master.frequency,
                })
                .collect(),
            range: RangeObject::new(&self.range),
            start: self.start.as_ref().map(start),
            left_out: self.left_out.notes(),
            backbone: backbone.points.iter().map(point).collect(),
            outer: manifold
                .outer
                .iter()
                .map(|mode| OuterObject {
                    name: &mode.name,
                    decay_rate: mode.decay_rate,
                    frequency: mode.frequency,
                })
                .collect(),
            resonances: resonances
                .iter()
                .map(|(near, mode)| ResonanceObject {
                    exponents: &near.exponents,
                    name: &mode.name,
                    frequency: mode.frequency,
                    distance: near.distance,
                })
                .collect(),
            met: self
                .crossed
                .iter()
                .map(|crossed| MetObject {
                    name: &crossed.name,
                    harmonic: crossed.harmonic,
                    nutation: crossed.nutation,
                    frequency: crossed.frequency,
                })
                .collect(),
            whirl_onset: self.onset.as_ref().map(|onset| WhirlObject {
                spin: onset.spin,
                name: &onset.name,
                frequency: onset.frequency,
            }),
            variables: self.variables(),
            coordinates: names(&body.coordinates()[..elastic]),
            rates: names(body.coordinates()),
            R: rates,
            W: state_terms(exponents, parts),
        })
    }

    /// What `check` tells of the equations.
    #[must_use]
    pub fn short_json(&self) -> Value {
        let mut object = self.json();
        for key in [
            "version",
            "name",
            "units",
            "about",
            "variables",
            "coordinates",
            "rates",
            "R",
            "W",
            "backbone",
            "outer",
        ] {
            object.as_object_mut().and_then(|object| object.remove(key));
        }
        object
    }
}
