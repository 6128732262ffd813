use quasirigid::math::sym::norm;
use quasirigid::model::Principal;
use quasirigid::modes::{Given, acts};
use quasirigid_io::model::Rotation;
use serde_json::json;

use super::{Loaded, initial, load, notes};
use crate::args::Modes;
use crate::failure::Failure;
use crate::{Ending, output, steady, steady_state};

/// Finds the steady spin and the small motions about it.
pub fn modes(arguments: &Modes) -> Result<Ending, Failure> {
    let loaded = load(&arguments.common)?;
    let Loaded { model, body, forces, order, .. } = &loaded;
    notes(model, &arguments.common);
    if acts(body, forces) {
        return under_forces(arguments, &loaded);
    }
    let asked = arguments.spin.as_ref().map(|spin| vector(spin)).transpose()?;
    let start = match (asked, model.initial.rotation) {
        (Some(omega), _) | (None, Some(Rotation::Spin(omega))) => Some(omega),
        _ => None,
    };
    let rate = |omega: [f64; 3]| Given::Rate(norm(omega));
    let spins = match (&arguments.axis, start) {
        (Some(name), start) => {
            let omega = match start {
                Some(omega) => omega,
                None => initial(model, body, *order, &arguments.common.model)?.omega,
            };
            let place = ["least", "middle", "greatest"].iter().position(|axis| axis == name);
            let axis = Principal::of(body.invariants().J).axes[place.unwrap_or(2)];
            vec![steady::spin(&loaded, name, axis, rate(omega))?]
        }
        (None, Some(omega)) => vec![steady::spin(&loaded, "asked", nearest(body, omega), rate(omega))?],
        (None, None) => {
            let omega = initial(model, body, *order, &arguments.common.model)?.omega;
            steady::poles(&loaded, rate(omega))?
        }
    };
    if arguments.common.json {
        let mut object = json!(spins[0]);
        object["name"] = json!(model.name);
        object["steady_spins"] = json!(spins);
        output::print(&format!("{object:#}\n"))?;
    } else {
        output::print(&steady::text(&model.name, &spins))?;
    }
    let found = spins.iter().all(|spin| spin.spin.is_some());
    Ok(if found { Ending::Done } else { Ending::CheckFailed })
}

/// Finds the steady state under the forces and the small motions about it.
fn under_forces(arguments: &Modes, loaded: &Loaded) -> Result<Ending, Failure> {
    if arguments.axis.is_some() {
        return Err(Failure::AxisUnderForces);
    }
    let asked = arguments.spin.as_ref().map(|spin| vector(spin)).transpose()?;
    let near = steady_state::near(loaded, asked, &arguments.common.model)?;
    let steady_state::Told { record, state } = steady_state::told(loaded, near);
    let found = record.spin.is_some();
    let name = &loaded.model.name;
    if arguments.common.json {
        let mut object = json!(record);
        object["name"] = json!(name);
        object["steady_spins"] = json!([record]);
        object["steady_state"] = json!(state);
        output::print(&format!("{object:#}\n"))?;
    } else {
        output::print(&steady::text(name, &[record]))?;
    }
    Ok(if found { Ending::Done } else { Ending::CheckFailed })
}

/// The principal axis next to an angular velocity, on its side.
fn nearest(body: &quasirigid::model::FlexibleBody, omega: [f64; 3]) -> [f64; 3] {
    let along = |axis: &[f64; 3]| quasirigid::math::sym::dot(*axis, omega);
    let Principal { axes, .. } = Principal::of(body.invariants().J);
    let axis = axes.into_iter().max_by(|a, b| along(a).abs().total_cmp(&along(b).abs())).unwrap_or(omega);
    axis.map(|entry| entry * along(&axis).signum())
}

fn vector(numbers: &[f64]) -> Result<[f64; 3], Failure> {
    <[f64; 3]>::try_from(numbers).map_err(|_| Failure::NotAVector { count: numbers.len() })
}
