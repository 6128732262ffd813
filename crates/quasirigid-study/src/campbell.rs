//! Campbell diagram: frequencies of the modes of the spinning body over its spin, from nearly none to twice that of the run.

use quasirigid::model::{Mode, Principal};
use quasirigid::modes::{RelativeEquilibrium, SpinMagnitude, SpinModes};
use quasirigid_io::record::CampbellRecord;
use quasirigid_math::vec3::norm;

use crate::study::Study;

/// Coordinates of a body whose modes at many spins take longer than a moment.
const MAX_COORDINATES: usize = 60;
/// Spins of the diagram.
const SPINS: usize = 48;
/// Greatest spin over that of the run.
const REACH: f64 = 2.0;

/// The diagram about the axis of the steady spin of the run; none of a body of many coordinates or with liquids, whose modes take seconds,
/// or where a steady spin is found at few spins.
pub(crate) fn campbell(study: &Study, of_run: &SpinModes) -> Option<CampbellRecord> {
    let body = &study.body;
    let omega = of_run.equilibrium.omega;
    let spin = norm(omega);
    if body.coordinates().len() > MAX_COORDINATES || !study.liquids.is_empty() || !(spin > 0.0) {
        return None;
    }
    let [mode, _] = Principal::compute(body.invariants().J).nearest(omega);
    let axis = if mode == Mode::ShortAxis { "greatest" } else { "least" };
    let mut record = CampbellRecord {
        axis: axis.into(),
        spin,
        spins: Vec::new(),
        frequencies: Vec::new(),
        decay_rates: Vec::new(),
    };
    let mut found = 0;
    for step in 1..=SPINS {
        let rate = REACH * spin * step as f64 / SPINS as f64;
        let given = SpinMagnitude::Rate(rate);
        let Ok(equilibrium) = RelativeEquilibrium::extreme_towards(body, mode, given, omega) else {
            continue;
        };
        if body.left_range(&equilibrium.q).is_some() {
            continue;
        }
        let Ok(modes) = SpinModes::about(body, equilibrium) else { continue };
        found += 1;
        for mode in modes.modes.iter().filter(|mode| mode.frequency > 0.0 && !mode.overdamped()) {
            record.spins.push(rate);
            record.frequencies.push(mode.frequency);
            record.decay_rates.push(mode.decay_rate);
        }
    }
    (found > SPINS / 4 && !record.spins.is_empty()).then_some(record)
}
