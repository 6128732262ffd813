use nalgebra::{DMatrix, Vector3};

use super::freedoms::{Hold, Node, Unknown};

/// Unknowns that move one freedom, and their shares.
type Row = Vec<(usize, f64)>;

/// Nodes that hold each other in a circle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Circle {
    /// One of them.
    pub node: usize,
}

/// The freedoms of nodes as combinations of unknowns, while they are made. (K2)
pub(super) struct Rows<'n> {
    nodes: &'n [Node],
    /// Rows of the freedoms of each node.
    pub made: Vec<Vec<Row>>,
    pub unknowns: Vec<Unknown>,
}

impl<'n> Rows<'n> {
    /// The rows of nodes that are held like this.
    ///
    /// # Errors
    /// [`Circle`] if nodes hold each other.
    pub fn new(nodes: &'n [Node], holds: &[Hold]) -> Result<Self, Circle> {
        let mut rows = Self { nodes, made: vec![Vec::new(); nodes.len()], unknowns: Vec::new() };
        for node in order(holds)? {
            rows.made[node] = match &holds[node] {
                Hold::Free => rows.own(node, |_| true, Unknown::Node),
                Hold::Partly(moves) => rows.own(node, |component| moves[component], Unknown::Node),
                Hold::Coordinates(count) => {
                    rows.own(node, |component| component < *count, Unknown::Coordinate)
                }
                Hold::On { base, axes } => rows.held(node, *base, axes),
                Hold::Shaped { columns, shares } => rows.shaped(node, columns, shares),
            };
        }
        Ok(rows)
    }

    fn count(&self, node: usize) -> usize {
        if self.nodes[node].turns { 6 } else { 3 }
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

/// The nodes, each after those that it follows.
fn order(holds: &[Hold]) -> Result<Vec<usize>, Circle> {
    #[derive(Clone, Copy, PartialEq)]
    enum State {
        New,
        Open,
        Done,
    }
    let mut states = vec![State::New; holds.len()];
    let mut order = Vec::with_capacity(holds.len());
    for start in 0..holds.len() {
        let mut path = vec![start];
        while let Some(node) = path.last().copied() {
            if states[node] == State::New {
                states[node] = State::Open;
                for base in followed(&holds[node]) {
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
fn followed(hold: &Hold) -> Vec<usize> {
    match hold {
        Hold::Free | Hold::Partly(_) | Hold::Coordinates(_) => Vec::new(),
        Hold::On { base, .. } => base.iter().copied().collect(),
        Hold::Shaped { columns, .. } => columns.iter().map(|(node, _)| *node).collect(),
    }
}

/// A displacement at the end of an arm: `u + θ × arm`.
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

/// A row in which each unknown stands once.
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
