//! Steady spins in the plane of two equal moments: where a part breaks the symmetry each has a rate of its own, and the one next to the start is
//! told, with the fate of another.
//! Equation (M26), docs/theory/15-modes.md.

use quasirigid::model::Principal;
use quasirigid::modes::{RelativeEquilibrium, SpinMagnitude, SpinModes};
use quasirigid_io::record::{SteadySpinRecord, place_of_spin};
use quasirigid_math::vec3::{add, cross, dot, norm, scale, unit};

use crate::steady::{self, GREATEST, LEAST, MIDDLE, missing};
use crate::study::Study;

/// Coordinates of a body up to which the modes of other spins in the plane take a moment.
const MAX_COORDINATES: usize = 60;
/// Difference of two moments over the largest that is rounding.
const SAME: f64 = 1e-12;
/// Relative difference of rates that no printed digit shows, in the frequency of the spin where the rates are none.
const SHOWN: f64 = 1e-5;
const NO_RATE: f64 = 1e-14;
/// Part of the start in the plane, relative to its length, that is rounding.
const ACROSS: f64 = 1e-9;

/// The record of a steady spin and its modes, with a sentence on the others where it lies in the plane of two equal moments and their rates
/// differ; no answer where the start, across the plane, chooses none of them.
pub(crate) fn noted(
    study: &Study,
    omega: [f64; 3],
    mut record: SteadySpinRecord,
    modes: Option<SpinModes>,
) -> (SteadySpinRecord, Option<SpinModes>) {
    let Some(plane) = modes.as_ref().and_then(|modes| Plane::of(study, &record.axis, modes)) else {
        return (record, modes);
    };
    let Some(other) = plane.other(study) else { return (record, modes) };
    if norm(plane.within(omega)) > ACROSS * norm(omega) {
        let which = if record.axis == MIDDLE {
            "this is the one across that next to the start; of that one"
        } else {
            "this is the one next to the start; of one across it"
        };
        record.sentence = format!(
            "{} Every spin in the plane of the two equal moments is steady, with a rate of its own: {which} the {} {other}.",
            record.sentence,
            study.model.kind.nutation()
        );
        return (record, modes);
    }
    let why = format!(
        "About {}: no answer, since every spin in the plane of the two equal moments is steady with a rate of its own, and the start chooses \
         none of them; ask for one by its angular velocity.",
        place_of_spin(&record.axis)
    );
    (missing(&record.axis, why), None)
}

/// Plane of two equal moments, with a steady spin in it.
struct Plane<'a> {
    normal: [f64; 3],
    modes: &'a SpinModes,
}

impl<'a> Plane<'a> {
    /// The plane of a steady spin about the axis of one of two equal moments, of a small body without momentum wheels.
    fn of(study: &Study, name: &str, modes: &'a SpinModes) -> Option<Self> {
        let body = &study.body;
        let Principal { moments, axes } = Principal::compute(body.invariants().J);
        let [lower, upper] = [0, 1].map(|k| moments[k + 1] - moments[k] <= SAME * moments[2]);
        let normal = match name {
            GREATEST | MIDDLE if upper && !lower => axes[0],
            LEAST | MIDDLE if lower && !upper => axes[2],
            _ => return None,
        };
        let small = body.coordinates().len() <= MAX_COORDINATES && body.wheels().is_empty();
        small.then_some(Self { normal, modes })
    }

    fn within(&self, vector: [f64; 3]) -> [f64; 3] {
        add(vector, scale(-dot(vector, self.normal), self.normal))
    }

    /// Fate of the nutation about the spin across the own one; none where every spin of the plane has the same.
    fn other(&self, study: &Study) -> Option<String> {
        let own = &self.modes.equilibrium;
        let along = unit(own.omega);
        let across = cross(self.normal, along);
        let rate = |modes: &SpinModes| modes.nutation().map_or(0.0, |nutation| nutation.decay_rate);
        let about = |axis: [f64; 3]| {
            let given = SpinMagnitude::AngularMomentum(norm(own.angular_momentum));
            let spin = RelativeEquilibrium::near(&study.body, axis, given).ok()?;
            let steady = (spin.ratio - own.ratio).abs() <= SAME * own.ratio;
            SpinModes::about(&study.body, spin).ok().filter(|_| steady)
        };
        let (across, between) = (about(across)?, about(add(along, across))?);
        let rates = [self.modes, &across, &between].map(rate);
        let largest = rates.iter().fold(NO_RATE * norm(own.omega) / SHOWN, |most, rate| rate.abs().max(most));
        let differ = rates[1..].iter().any(|rate| (rate - rates[0]).abs() > SHOWN * largest);
        differ.then(|| steady::fate(rates[1]))
    }
}
