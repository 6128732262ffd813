use quasirigid::dynamics::{Forced, Form, RigidState, SpinState, forced_torque, takes};
use quasirigid::model::{FlexibleBody, Support};
use quasirigid::reduction::{ReductionError, degree_sizes, frequencies, reduce};
use quasirigid::verification::Start;
use quasirigid_io::export::{Derived, DisplacedLoads, Forces, Mechanism, StartLoads};

use super::{Loaded, initial, load, notes};
use crate::args::{Derive, DeriveFormat};
use crate::failure::Failure;
use crate::motion::Motion;
use crate::{Ending, output};

/// Prints the reduced equations.
pub fn derive(arguments: &Derive) -> Result<Ending, Failure> {
    let loaded = load(&arguments.common)?;
    let Loaded { model, body, order, .. } = &loaded;
    notes(model, &arguments.common);
    let reduced = reduce(body, *order)?;
    let frequencies = frequencies(body)?;
    let start = initial(model, body, *order).ok();
    let forces = acting(&loaded, start);
    let derived = Derived {
        name: &model.name,
        body,
        reduced: &reduced,
        frequencies: &frequencies,
        mechanisms: &mechanisms(body, *order)?,
        forces: forces.as_ref(),
    };
    let format = if arguments.common.json { DeriveFormat::Json } else { arguments.format };
    let mut text = match format {
        DeriveFormat::Text => derived.text(),
        DeriveFormat::Json => derived.json(),
        DeriveFormat::Latex => derived.latex(),
    };
    if !text.ends_with('\n') {
        text.push('\n');
    }
    output::print(&text)?;
    Ok(Ending::Done)
}

/// What acts on the body, and what it comes to at the start; none where nothing acts.
pub fn acting(loaded: &Loaded, start: Option<SpinState>) -> Option<Forces> {
    let Loaded { body, forces, order, .. } = loaded;
    let system = Forced { body, forces };
    let driven = matches!(body.support(), Support::Prescribed { .. }).then(|| "a driven pole".to_owned());
    let motors = (!body.wheels().driven.is_empty()).then(|| "the motors of wheels".to_owned());
    let names = forces.iter().map(|force| force.name.clone()).chain(driven).chain(motors).collect();
    system.acts().then(|| Forces { names, start: start.map(|spin| at_start(system, loaded, spin, *order)) })
}

fn at_start(system: Forced, loaded: &Loaded, spin: SpinState, order: usize) -> StartLoads {
    let Start { omega, attitude, place, velocity } = Motion::new(loaded, spin).start;
    let state = RigidState { t: 0.0, omega, attitude, pole: place, pole_velocity: velocity };
    let torque = forced_torque(system, order, &state);
    let displaced = takes(system, Form::Paper, order.min(3)).then_some(DisplacedLoads {
        moment_variation: torque.moment_variation,
        mu: torque.mu,
        force_variation: torque.force_variation,
        phi: torque.phi,
        displacements: torque.q,
    });
    StartLoads { angular_velocity: omega, moment: torque.moment, force: torque.force, displaced }
}

/// What moves inside and what outside, each with the other locked, of a body that has both.
fn mechanisms(body: &FlexibleBody, order: usize) -> Result<Vec<Mechanism>, ReductionError> {
    if body.elastic() == 0 || body.cyclic().is_empty() {
        return Ok(Vec::new());
    }
    let alone = |name, part: &FlexibleBody| {
        let sizes = degree_sizes(&reduce(part, order)?, [1.0, 0.0, 0.0]);
        Ok(Mechanism { name, sizes: sizes.iter().map(|each| (each.degree, each.size)).collect() })
    };
    Ok(vec![
        alone("liquids and rotors", &body.stiff_outside())?,
        alone("springs and dashpots", &body.locked_inside())?,
    ])
}
