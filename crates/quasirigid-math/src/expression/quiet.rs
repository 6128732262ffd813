//! Whether a formula hides nothing between a few places of a path: the sieve before the changes along it are found.
//! Equation (Z2), docs/theory/19-events.md.

use super::changes::FLAT;
use super::lobatto::{FINE, Lobatto};
use super::program::{Program, Role};

/// Change between neighbours, relative to the largest value, that is rounding.
const CHANGE_ROUNDING: f64 = 1e-13;

/// Whether every part of a formula is nearly a polynomial along a path, by its values at the points of Lobatto, and no part that acts in a
/// short part of the range of its argument has an argument with a zero or an extreme there. (Z2)
pub fn is_quiet(program: &Program, lobatto: &Lobatto, variables: &[&[f64]; FINE]) -> bool {
    let nodes = program.nodes();
    let mut histories = vec![[0.0; FINE]; nodes.len()];
    let mut values = Vec::new();
    for (place, variables) in variables.iter().enumerate() {
        program.trace(variables, nodes.len() - 1, &mut values);
        histories.iter_mut().zip(&values).for_each(|(history, value)| history[place] = *value);
    }
    nodes.iter().enumerate().all(|(index, node)| {
        let operands = &node.operands;
        let arguments_are_plain = match (node.role, operands.as_slice()) {
            (Role::Constant | Role::Variable(_), _) => return true,
            (Role::Even | Role::Product, _) => true,
            (Role::Choice, [a, b]) => {
                is_monotone(&std::array::from_fn(|place| histories[*a][place] - histories[*b][place]))
            }
            _ => operands.iter().all(|of| is_monotone(&histories[*of])),
        };
        let largest = histories[index].iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        arguments_are_plain && lobatto.defect(&histories[index]) <= FLAT * largest
    })
}

/// Whether values neither change their sign nor turn back.
fn is_monotone(values: &[f64; FINE]) -> bool {
    let largest = values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    let steps = values.windows(2).map(|pair| pair[1] - pair[0]);
    let (mut rises, mut falls) = (false, false);
    for step in steps.filter(|step| step.abs() > CHANGE_ROUNDING * largest) {
        rises |= step > 0.0;
        falls |= step < 0.0;
    }
    let one_sign = values.iter().all(|value| *value > 0.0) || values.iter().all(|value| *value < 0.0);
    let still = !rises && !falls;
    still || (one_sign && !(rises && falls))
}
