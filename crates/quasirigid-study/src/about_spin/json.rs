//! Reduced equations about a spin, for machines.

use quasirigid::model::Coordinate;
use quasirigid::submanifold::{AmplitudeRange, BackbonePoint, Defect, Style, Truncated};
use quasirigid_io::model::Named;
use serde_json::{Map, Value, json};

use super::{AboutSpin, StartWithin};
use crate::words::shares;

/// Version of the object; a key that changes its meaning raises it.
const VERSION: usize = 1;

pub(super) fn range(range: &AmplitudeRange) -> Value {
    json!({
        "nutation": range.nutation, "amplitude": range.amplitude, "share": range.share, "beyond": range.beyond,
    })
}

fn defect(defect: &Defect) -> Value {
    let finite = |value: f64| value.is_finite().then_some(value);
    json!({ "motion": finite(defect.motion), "power": finite(defect.power) })
}

pub(super) fn time_constant(decay_rate: f64) -> Option<f64> {
    Some(decay_rate.recip()).filter(|time| time.is_finite())
}

fn point(point: &BackbonePoint) -> Value {
    let BackbonePoint { amplitude, nutation, decay_rate, frequency, power, defect: left } = point;
    json!({
        "amplitude": amplitude, "nutation": nutation, "decay_rate": decay_rate,
        "time_constant": time_constant(*decay_rate), "frequency": frequency,
        "power": power.iter().map(|(_, power)| power).sum::<f64>(),
        "dissipation": shares(power), "defect": defect(left),
    })
}

fn start(start: &StartWithin) -> Value {
    let StartWithin { start, amplitude, nutation, defect: left, within } = start;
    json!({
        "amplitude": amplitude, "nutation": nutation, "within": within, "defect": defect(left),
        "left_out": Some(start.left_out).filter(|share| share.is_finite()), "coordinates": start.z,
    })
}

/// Non-zero coefficients of polynomials side by side, by monomial.
fn terms(exponents: &[Vec<u8>], parts: &[(&str, &[Truncated])]) -> Vec<Value> {
    let of = |(monomial, exponents): (usize, &Vec<u8>)| {
        let mut any = false;
        let mut term = Map::new();
        term.insert("exponents".into(), json!(exponents));
        for (name, polynomials) in parts {
            let values: Vec<[f64; 2]> = polynomials.iter().map(|each| each.coefficient(monomial)).collect();
            any |= values.iter().any(|value| *value != [0.0; 2]);
            term.insert((*name).into(), json!(values));
        }
        any.then_some(Value::Object(term))
    };
    exponents.iter().enumerate().filter_map(of).collect()
}

impl AboutSpin<'_> {
    /// For machines: every coefficient, with all digits.
    #[must_use]
    pub fn json(&self) -> Value {
        let Self { study, manifold, axis, backbone, .. } = self;
        let (body, expansion) = (manifold.body, manifold.expansion());
        let names =
            |coordinates: &[Coordinate]| coordinates.iter().map(|each| each.name.clone()).collect::<Vec<_>>();
        let (n, elastic) = (body.coordinates().len(), body.elastic());
        let exponents = expansion.ring.exponents();
        let leads: Vec<usize> = self.leads().collect();
        let mut rates = Vec::new();
        for (k, lead) in leads.iter().enumerate() {
            for (monomial, exponents) in exponents.iter().enumerate() {
                let value = expansion.rates[*lead].coefficient(monomial);
                if value != [0.0; 2] {
                    rates.push(json!({ "master": k, "exponents": exponents, "value": value }));
                }
            }
        }
        let state = &expansion.state;
        let parts: [(&str, &[Truncated]); 4] = [
            ("omega", &state[..3]),
            ("rates", &state[3..3 + n]),
            ("coordinates", &state[3 + n..3 + n + elastic]),
            ("direction", manifold.direction_expansion()),
        ];
        let resonances = manifold.near_resonances();
        json!({
            "version": VERSION,
            "name": study.model.name,
            "units": "SI",
            "about": "spin",
            "holds": self.holds(),
            "sentence": self.sentence(),
            "axis": axis.name(),
            "spin": manifold.spin.omega,
            "angular_momentum": manifold.spin.angular_momentum,
            "energy": manifold.steady_energy(),
            "displacements": body.coordinates().iter().zip(&manifold.spin.q).take(elastic)
                .map(|(coordinate, q)| (coordinate.name.clone(), json!(q))).collect::<Map<_, _>>(),
            "degree": manifold.degree(),
            "style": match manifold.style { Style::NormalForm => "normal-form", Style::Graph => "graph" },
            "masters": manifold.masters.iter().map(|master| json!({
                "name": master.name, "decay_rate": master.decay_rate,
                "time_constant": time_constant(master.decay_rate), "frequency": master.frequency,
            })).collect::<Vec<_>>(),
            "range": range(&self.range),
            "start": self.start.as_ref().map(start),
            "left_out": self.left_out.notes(),
            "backbone": backbone.points.iter().map(point).collect::<Vec<_>>(),
            "outer": manifold.outer.iter().map(|mode| json!({
                "name": mode.name, "decay_rate": mode.decay_rate, "frequency": mode.frequency,
            })).collect::<Vec<_>>(),
            "resonances": resonances.iter().map(|(near, mode)| json!({
                "exponents": near.exponents, "name": mode.name, "frequency": mode.frequency, "distance": near.distance,
            })).collect::<Vec<_>>(),
            "met": self.met.iter().map(|met| json!({
                "name": met.name, "harmonic": met.harmonic, "nutation": met.nutation, "frequency": met.frequency,
            })).collect::<Vec<_>>(),
            "whirl_onset": self.onset.as_ref().map(|onset| json!({
                "spin": onset.spin, "name": onset.name, "frequency": onset.frequency,
            })),
            "variables": self.variables(),
            "coordinates": names(&body.coordinates()[..elastic]),
            "rates": names(body.coordinates()),
            "R": rates,
            "W": terms(exponents, &parts),
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
