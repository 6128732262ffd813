//! Samples: quadrature points of a cell with the shape functions there, computed once for each shape and rule.
//! The purpose of a rule fixes its degree: too few points leave motions free of strain, too many make cells stiffer than they are.

use std::sync::OnceLock;

use super::Shape;
use super::functions::MAX_NODES;

/// Purpose of a quadrature over a cell. A Jacobian of higher degree than that of a cell with straight edges is not counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Rule {
    /// Products of two slopes, with enough points that only rigid motions are free of strain.
    Slopes,
    /// Products of two slopes with fewer points: two along each axis of quadratic quadrilaterals and hexahedra, two in a wedge of 6 nodes.
    Reduced,
    /// Products of two shape functions, exact where edges are straight and faces flat.
    Products,
}

/// A place of a quadrature rule, with the shape functions there.
#[derive(Clone, Debug, PartialEq)]
pub struct CellSample {
    /// Place on the reference cell.
    pub at: [f64; 3],
    /// Weight on the reference cell.
    pub weight: f64,
    /// Shape functions, in the order of the nodes.
    pub functions: [f64; MAX_NODES],
    /// Their derivatives along the axes of the reference cell.
    pub gradients: [[f64; 3]; MAX_NODES],
}

/// Shapes times rules.
const TABLES: usize = 14 * 3;

impl Shape {
    /// Samples of a rule; computed once.
    #[must_use]
    pub fn samples(self, rule: Rule) -> &'static [CellSample] {
        static KEPT: [OnceLock<Box<[CellSample]>>; TABLES] = [const { OnceLock::new() }; TABLES];
        KEPT[3 * self as usize + rule as usize].get_or_init(|| {
            let sample = |(at, weight)| CellSample {
                at,
                weight,
                functions: self.functions(at),
                gradients: self.gradients(at),
            };
            let [degree, along] = self.degrees(rule);
            self.rule(degree, along).into_iter().map(sample).collect()
        })
    }

    /// Degrees of the polynomials that a rule must integrate, as [`Shape::rule`] counts them.
    fn degrees(self, rule: Rule) -> [usize; 2] {
        let wedge = match (self, rule) {
            (Self::Wedge6, Rule::Slopes) => Some([2, 3]),
            (Self::Wedge6, Rule::Reduced) => Some([1, 3]),
            (Self::Wedge6, Rule::Products) => Some([3, 4]),
            (Self::Wedge15, Rule::Slopes | Rule::Reduced) => Some([2, 5]),
            (Self::Wedge15, Rule::Products) => Some([5, 6]),
            _ => None,
        };
        wedge.unwrap_or([self.degree(rule); 2])
    }

    fn degree(self, rule: Rule) -> usize {
        let quadratic = self.nodes() > self.corners();
        match (self.dimension(), self.corners(), rule) {
            // Simplices have a constant Jacobian, and slopes one degree lower than the functions.
            (1, ..) | (2, 3, _) | (3, 4, _) => match rule {
                Rule::Products => {
                    if quadratic {
                        4
                    } else {
                        2
                    }
                }
                Rule::Slopes | Rule::Reduced => {
                    if quadratic {
                        2
                    } else {
                        0
                    }
                }
            },
            (_, _, Rule::Slopes) if quadratic => 5,
            (_, _, Rule::Slopes | Rule::Reduced) => 3,
            // Twice the degree of the functions and that of the Jacobian, 1 of quadrilaterals and 2 of hexahedra.
            (dimension, _, Rule::Products) => dimension - 1 + if quadratic { 4 } else { 2 },
        }
    }
}
