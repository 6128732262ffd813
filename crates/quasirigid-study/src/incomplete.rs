//! Terms that the equations of a body leave out at an order, in words.

use quasirigid::elements::{Assembly, Incomplete};

/// Warns of an order above the one that the parts of a body support. Full and reduced equations then lack the same terms, so that no
/// verification shows the gap; those of hinges alone are in the full system.
pub fn beyond(assembly: &Assembly, order: usize) -> Option<String> {
    let missing = assembly.incomplete_at(order);
    let complete = missing.iter().map(|what| what.order()).min()?;
    let causes: Vec<&str> = missing.iter().map(|what| cause(*what)).collect();
    let full = if missing == [Incomplete::Hinges] {
        "The full system has the terms that are missing."
    } else if missing.contains(&Incomplete::Hinges) {
        "The terms that are missing are missing in the full system, too, but those of hinges."
    } else {
        "The terms that are missing are missing in the full system, too."
    };
    Some(format!(
        "Of this body the equations are complete to order {complete}, and order {order} is asked for: {}. {full}",
        causes.join("; ")
    ))
}

fn cause(what: Incomplete) -> &'static str {
    match what {
        Incomplete::Liquids => "the square of the velocity of liquids is that of slow flows (order 3)",
        Incomplete::Ellipsoids => "the strain of ellipsoids is linear (order 3)",
        Incomplete::Surfaces => "the strain of solids inside surfaces is linear (order 3)",
        Incomplete::Shapes => "the displacements of modes and matrices are linear (order 3)",
        Incomplete::SheetLoads => {
            "a sheet without `line` or `normal` leaves the load of a steady spin on an appendage unknown (order 0)"
        }
        Incomplete::Sheets => "a sheet leaves the second order of an appendage unknown (order 3)",
        Incomplete::AxialSprings => "the force of axial springs is linear in the displacement (order 3)",
        Incomplete::SpringsOnAppendages => {
            "springs at places on appendages see the displacement to first order (order 3)"
        }
        Incomplete::Hinges => "paths on hinges are kept to second order in the reduced equations (order 5)",
        Incomplete::Structures => "paths of beams, panels and solids are kept to second order (order 5)",
    }
}
