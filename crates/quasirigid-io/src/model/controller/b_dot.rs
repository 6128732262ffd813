//! Coils against the rate of the magnetic field. (Y9)

use std::path::Path;

use quasirigid_body::control::{Actuator, ControlLaw, LinearLaw, RelayLaw};

use super::{Draft, NamedInput, counted, numbers};
use crate::model::channel::field_rates;
use crate::model::table::Table;
use crate::units::Dimension;

/// Name of what the law measures.
const MEASURED: &str = "field_rate";

pub(super) fn b_dot(table: &Table<'_>, period: Option<f64>, _: &Path) -> Option<Draft> {
    let rates = field_rates().map(|of| (of, MEASURED.to_owned(), 0.0));
    if table.read_or("bang_bang", false, |value| value.boolean())? {
        return switched(table, rates, period);
    }
    let example = "gain = \"2e4 A m^2 s/T\", or bang_bang = true with a `saturation` and a `period`";
    let gain = table.required("gain", example)?;
    let gains = numbers(table, "gain", 3, Dimension::FIELD_RATE_GAIN)?;
    if gains.iter().any(|gain| *gain < 0.0) || gains.iter().all(|gain| *gain == 0.0) {
        let message = "a gain of this law is positive, or zero about an axis without a coil: m = -k dB/dt brakes the rotation";
        return gain.refuse(
            message,
            "does not brake",
            "write a positive gain, or a law of your own by formulas",
        );
    }
    let row = |i: usize| (0..3).map(|j| if i == j { -gains[i] } else { 0.0 }).collect();
    let D = (0..3).map(row).collect();
    let law = ControlLaw::Linear(LinearLaw { C: vec![Vec::new(); 3], D, ..LinearLaw::default() });
    Some(draft(rates.to_vec(), law))
}

/// Moments of one size, by the sign of the rate alone.
fn switched(table: &Table<'_>, rates: [NamedInput; 3], period: Option<f64>) -> Option<Draft> {
    if let Some(gain) = table.get("gain") {
        let message = "a bang-bang law has no gain, but the moment of its coils";
        return gain.refuse(message, "not of this law", "leave it out, and give `saturation`");
    }
    if period.is_none() {
        if table.get("period").is_none() {
            let message = "a bang-bang law needs samples: where the rate is zero it would switch without end";
            let value = table.get("bang_bang")?;
            return value.refuse(message, "without a period", "add for example period = \"1 s\"");
        }
        return None;
    }
    let given = table.required("saturation", "saturation = \"0.2 A m^2\"")?;
    let levels = match given.items() {
        None => vec![given.positive(Dimension::MAGNETIC_MOMENT)?; 3],
        Some(items) if items.len() == 3 => {
            items.iter().map(|item| item.positive(Dimension::MAGNETIC_MOMENT)).collect::<Option<_>>()?
        }
        Some(items) => return counted(&given, items.len(), 3),
    };
    let law = RelayLaw { levels, lead: 0.0, on: vec![0.0; 3], off: vec![0.0; 3], least: 1 };
    Some(draft([rates.clone(), rates].concat(), ControlLaw::Relay(law)))
}

fn draft(inputs: Vec<NamedInput>, law: ControlLaw) -> Draft {
    let outputs = [0, 1, 2].map(|axis| Actuator::Moment { axis }).to_vec();
    Draft { deadbands: vec![0.0; inputs.len()], start: vec![0.0; law.states()], inputs, law, outputs }
}
