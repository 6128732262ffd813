use quasirigid::verification::Plan;
use serde_json::json;

use super::{Loaded, initial, load, note_left_out, notes};
use crate::args::Verify;
use crate::complete::beyond;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::layout::paragraph;
use crate::message::remark;
use crate::motion::Motion;
use crate::{Ending, output, record, verification};

/// Sets the full system against the reduced equations, and prints the differences with their order.
pub fn verify(arguments: &Verify) -> Result<Ending, Failure> {
    let loaded = load(&arguments.common)?;
    let Loaded { model, body, order, .. } = &loaded;
    notes(model, &arguments.common);
    let start = initial(model, body, *order)?;
    note_left_out(&loaded, start.omega, &arguments.common);
    let motion = Motion::new(&loaded, start);
    let file = verification::plan(model, body, *order);
    let plan = Plan {
        orders: arguments.orders.clone().unwrap_or(file.orders),
        rotations: arguments.rotations.unwrap_or(file.rotations),
        halvings: arguments.halvings.unwrap_or(file.halvings),
        ..file
    };
    let highest = plan.orders.iter().copied().max().unwrap_or_default();
    if let Some(note) =
        beyond(&model.assembly, highest).filter(|_| highest > *order && !arguments.common.quiet)
    {
        remark(&format!("note: {note}"));
    }
    let interrupt = Interrupt::listen()?;
    let Some(found) = verification::follow(&motion, &plan, &interrupt, arguments.common.quiet)? else {
        remark("the verification was interrupted; nothing was measured");
        return Ok(Ending::CheckFailed);
    };
    let record = record::verification(&plan, &found);
    if arguments.common.json {
        output::print(&format!("{:#}\n", json!(record)))?;
    } else {
        output::print(&verification::text(&model.name, &record))?;
        if let Some(note) = beyond(&model.assembly, highest) {
            output::print(&format!("{}\n", paragraph(&note, "", "  ")))?;
        }
    }
    Ok(if record.reached { Ending::Done } else { Ending::CheckFailed })
}
