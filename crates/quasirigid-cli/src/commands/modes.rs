use quasirigid::math::sym::norm;
use quasirigid::model::Principal;
use quasirigid::modes::{Given, acts};
use serde_json::json;

use super::{Loaded, initial, load, notes};
use crate::args::Modes;
use crate::failure::Failure;
use crate::motion::Motion;
use crate::{Ending, output, steady, steady_state};

/// Finds the steady spin and the small motions about it.
pub fn modes(arguments: &Modes) -> Result<Ending, Failure> {
    let loaded = load(&arguments.common)?;
    let Loaded { model, body, forces, .. } = &loaded;
    notes(model, &arguments.common);
    if acts(body, forces) {
        return under_forces(arguments, &loaded);
    }
    let asked = arguments.spin.as_ref().map(|spin| vector(spin)).transpose()?;
    let (omega, given) = match asked {
        Some(omega) => (omega, Given::Rate(norm(omega))),
        None => of_start(&loaded)?,
    };
    let spins = match (&arguments.axis, asked) {
        (Some(name), _) => {
            let place = ["least", "middle", "greatest"].iter().position(|axis| axis == name);
            let axis = Principal::of(body.invariants().J).axes[place.unwrap_or(2)];
            vec![steady::spin(&loaded, name, axis, given)]
        }
        (None, Some(_)) => vec![steady::spin(&loaded, "asked", nearest(body, omega), given)],
        (None, None) => steady::poles(&loaded, omega, given).records,
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

/// The angular velocity (rad/s) of the start, and its angular momentum, or its rate if what turns inside takes that up.
fn of_start(loaded: &Loaded) -> Result<([f64; 3], Given), Failure> {
    let spin = initial(&loaded.model, &loaded.body, loaded.order)?;
    let momentum = Motion::new(loaded, spin).momentum()?;
    let given = if momentum > 0.0 { Given::Momentum(momentum) } else { Given::Rate(norm(spin.omega)) };
    Ok((spin.omega, given))
}

/// Finds the steady state under the forces and the small motions about it.
fn under_forces(arguments: &Modes, loaded: &Loaded) -> Result<Ending, Failure> {
    if arguments.axis.is_some() {
        return Err(Failure::AxisUnderForces);
    }
    let asked = arguments.spin.as_ref().map(|spin| vector(spin)).transpose()?;
    let near = steady_state::near(loaded, asked)?;
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
