//! Factors of a formula that may be zero over a long time, in which what they multiply need not be followed: a window times a fast wave.
//! Equation (Z2), docs/theory/19-events.md.

use super::program::{Node, Role};

/// Order in which the parts of a formula are followed, and the factors that hide each of them where they are zero.
#[derive(Clone, Debug)]
pub struct Guards {
    /// Parts after their operands, and after the factors that hide them.
    pub order: Vec<usize>,
    /// Factors of each part.
    pub factors: Vec<Vec<usize>>,
}

impl Guards {
    /// Of a tree whose root is the last node; only factors `known` along the whole path, which may be zero over a stretch, hide others.
    pub fn of(nodes: &[Node], known: &[bool]) -> Self {
        let mut narrow: Vec<bool> = Vec::with_capacity(nodes.len());
        for Node { role, operands } in nodes {
            narrow.push(role.is_narrow() || operands.iter().any(|of| narrow[*of]));
        }
        let hides = |index: usize| narrow[index] && known[index];
        let mut guards =
            Self { order: Vec::with_capacity(nodes.len()), factors: vec![Vec::new(); nodes.len()] };
        // from the root: each node is put before its operands, and the order is reversed at the end
        let mut open: Vec<usize> = nodes.len().checked_sub(1).into_iter().collect();
        while let Some(index) = open.pop() {
            guards.order.push(index);
            let Node { role, operands } = &nodes[index];
            let own = guards.factors[index].clone();
            operands.iter().for_each(|of| guards.factors[*of].clone_from(&own));
            let mut operands = operands.clone();
            if let (Role::Product, [a, b]) = (role, operands.as_slice()) {
                let (first, second) = if hides(*a) || !hides(*b) { (*a, *b) } else { (*b, *a) };
                if hides(first) {
                    guards.factors[second].push(first);
                }
                operands = vec![first, second];
            }
            open.extend(operands);
        }
        guards.order.reverse();
        guards
    }
}

#[cfg(test)]
mod tests {
    use super::super::Expression;
    use super::*;

    /// The factor with a corner hides the other one, on whichever side it stands, and comes first.
    #[test]
    fn windows_hide_what_they_multiply() {
        for (text, window, wave) in [("step(t)*cos(7*t)", 1, 5), ("cos(7*t)*(1 + step(t))", 7, 3)] {
            let nodes = Expression::parse(text, &["t"]).unwrap().program.nodes();
            let guards = Guards::of(&nodes, &vec![true; nodes.len()]);
            assert_eq!(guards.factors[wave], [window], "{text} {nodes:?}");
            let place = |index: usize| guards.order.iter().position(|of| *of == index);
            assert!(place(window) < place(wave) && guards.factors[window].is_empty(), "{text}");
            assert_eq!(guards.order.len(), nodes.len());
        }
    }
}
