//! Elimination of constraints: rows of each node's degrees of freedom from those of the nodes that it follows.
//! Nodes are taken in the order in which they follow each other; a circle has no such order and is refused.
//! Equation (K2), docs/theory/12-structures.md.

use nalgebra::{DMatrix, Vector3};

use super::dofs::{Constraint, GivenRow, Node, Unknown};

/// Unknowns that move one degree of freedom, and their shares.
type Row = Vec<(usize, f64)>;

/// Nodes that constrain each other in a circle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Circle {
    /// One of these nodes.
    pub node: usize,
}

/// The degrees of freedom of nodes as combinations of unknowns, while they are made. (K2)
pub(super) struct Rows<'n> {
    nodes: &'n [Node],
    /// Rows of the degrees of freedom of each node.
    pub made: Vec<Vec<Row>>,
    pub unknowns: Vec<Unknown>,
}

impl<'n> Rows<'n> {
    /// Rows of nodes under these constraints.
    ///
    /// # Errors
    /// [`Circle`] if nodes constrain each other.
    pub fn new(nodes: &'n [Node], constraints: &[Constraint]) -> Result<Self, Circle> {
        let mut rows = Self { nodes, made: vec![Vec::new(); nodes.len()], unknowns: Vec::new() };
        for node in order(constraints)? {
            rows.made[node] = match &constraints[node] {
                Constraint::Free => rows.own(node, |_| true, Unknown::Node),
                Constraint::Partly(moves) => rows.own(node, |component| moves[component], Unknown::Node),
                Constraint::Coordinates(count) => {
                    rows.own(node, |component| component < *count, Unknown::Coordinate)
                }
                Constraint::On { base, axes } => rows.held(node, *base, axes),
                Constraint::Shaped { columns, shares } => rows.shaped(node, columns, shares),
                Constraint::Linear { rows: moved, .. } => rows.linear(node, moved, constraints),
            };
        }
        Ok(rows)
    }

    fn count(&self, node: usize) -> usize {
        self.nodes[node].dofs()
    }

    /// Rows of which some are unknowns of their own, the others zero.
    fn own(
        &mut self,
        node: usize,
        moves: impl Fn(usize) -> bool,
        unknown: impl Fn(usize, usize) -> Unknown,
    ) -> Vec<Row> {
        let count = self.count(node);
        let row = |component| {
            if moves(component) { self.unknown(unknown(node, component)) } else { Row::new() }
        };
        (0..count).map(row).collect()
    }

    fn unknown(&mut self, unknown: Unknown) -> Row {
        self.unknowns.push(unknown);
        vec![(self.unknowns.len() - 1, 1.0)]
    }

    /// Rows of a node on a base, or on the carrier; its rotations are its own where the base has none.
    fn held(&mut self, node: usize, base: Option<usize>, axes: &[Vector3<f64>]) -> Vec<Row> {
        let (held, arm) = match base {
            Some(base) => (self.made[base].clone(), self.nodes[node].place - self.nodes[base].place),
            None => (vec![Row::new(); 6], Vector3::zeros()),
        };
        let mut made: Vec<Row> = (0..3).map(|axis| carried(&held, arm, axis)).collect();
        if self.count(node) == 6 && held.len() == 6 {
            made.extend_from_slice(&held[3..]);
            for (number, axis) in axes.iter().enumerate() {
                let turn = self.unknown(Unknown::Joint(node, number));
                for component in 0..3 {
                    made[3 + component].extend(scaled(&turn, axis[component]));
                }
            }
        } else if self.count(node) == 6 {
            made.extend((3..6).map(|component| self.unknown(Unknown::Node(node, component))));
        }
        made
    }

    /// Rows of which some are unknowns of their own, others shares of rows. Nodes of this kind may share in each other: what moves by itself
    /// is an unknown before any of them has all of its rows.
    fn linear(&mut self, node: usize, moved: &[GivenRow], constraints: &[Constraint]) -> Vec<Row> {
        let bases = moved.iter().flat_map(|(_, terms)| terms.iter().map(|(base, ..)| *base));
        for base in bases.chain([node]) {
            if let (true, Constraint::Linear { own, .. }) = (self.made[base].is_empty(), &constraints[base]) {
                self.made[base] = self.own(base, |component| own[component], Unknown::Node);
            }
        }
        let mut made = self.made[node].clone();
        for (component, terms) in moved.iter().filter(|(component, _)| *component < self.count(node)) {
            let shares = terms.iter().flat_map(|(base, of, share)| scaled(&self.made[*base][*of], *share));
            made[*component] = merged(shares.collect());
        }
        made
    }

    /// Rows that are shares of other rows.
    fn shaped(&self, node: usize, columns: &[(usize, usize)], shares: &DMatrix<f64>) -> Vec<Row> {
        let row = |component: usize| {
            let mut row = Row::new();
            for ((base, of), share) in columns.iter().zip(&shares.row(component)) {
                row.extend(scaled(&self.made[*base][*of], *share));
            }
            merged(row)
        };
        (0..self.count(node)).map(row).collect()
    }
}

/// Nodes in an order in which each comes after those that it follows.
pub(super) fn order(constraints: &[Constraint]) -> Result<Vec<usize>, Circle> {
    #[derive(Clone, Copy, PartialEq)]
    enum State {
        New,
        Open,
        Done,
    }
    let mut states = vec![State::New; constraints.len()];
    let mut order = Vec::with_capacity(constraints.len());
    for start in 0..constraints.len() {
        let mut path = vec![start];
        while let Some(node) = path.last().copied() {
            if states[node] == State::New {
                states[node] = State::Open;
                for base in followed(&constraints[node], constraints) {
                    match states[base] {
                        State::New => path.push(base),
                        State::Open => return Err(Circle { node: base }),
                        State::Done => {}
                    }
                }
            } else {
                if states[node] == State::Open {
                    states[node] = State::Done;
                    order.push(node);
                }
                path.pop();
            }
        }
    }
    Ok(order)
}

/// Nodes whose motion a node follows.
fn followed(constrain: &Constraint, all: &[Constraint]) -> Vec<usize> {
    match constrain {
        Constraint::Free | Constraint::Partly(_) | Constraint::Coordinates(_) => Vec::new(),
        Constraint::On { base, .. } => base.iter().copied().collect(),
        Constraint::Shaped { columns, .. } => columns.iter().map(|(node, _)| *node).collect(),
        Constraint::Linear { rows, .. } => {
            let bases = rows.iter().flat_map(|(_, terms)| terms.iter().map(|(base, ..)| *base));
            bases.filter(|base| !matches!(all[*base], Constraint::Linear { .. })).collect()
        }
    }
}

/// Displacement at the end of an arm: `u + θ × arm`.
fn carried(base: &[Row], arm: Vector3<f64>, axis: usize) -> Row {
    let mut row = base[axis].clone();
    if base.len() == 6 {
        let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
        row.extend(scaled(&base[3 + next], arm[last]));
        row.extend(scaled(&base[3 + last], -arm[next]));
    }
    row.retain(|(_, share)| *share != 0.0);
    row
}

fn scaled(row: &Row, factor: f64) -> impl Iterator<Item = (usize, f64)> + '_ {
    row.iter().map(move |(unknown, share)| (*unknown, factor * share)).filter(|(_, share)| *share != 0.0)
}

/// Row in which each unknown stands once.
fn merged(mut row: Row) -> Row {
    row.sort_unstable_by_key(|(unknown, _)| *unknown);
    row.dedup_by(|next, sum| {
        let same = next.0 == sum.0;
        if same {
            sum.1 += next.1;
        }
        same
    });
    row
}
