use nalgebra::{DMatrix, Vector3};

/// Where a node is and whether it turns.
#[derive(Clone, Copy, Debug)]
pub(in crate::elements) struct Node {
    /// Equilibrium position (m), in the file's frame.
    pub place: Vector3<f64>,
    /// Whether it has rotations beside its displacements.
    pub turns: bool,
}

/// How a node is held.
#[derive(Clone, Debug)]
pub(in crate::elements) enum Hold {
    /// By the elements alone.
    Free,
    /// By the elements, but for components 0 to 5 that do not move.
    Partly([bool; 6]),
    /// On the carrier, or on another node, as one rigid piece but for rotations about these axes; three axes are a ball
    /// joint.
    On {
        /// The other node; none for the carrier.
        base: Option<usize>,
        /// Axes of relative rotation, unit vectors.
        axes: Vec<Vector3<f64>>,
    },
}

/// An unknown of the structure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::elements) enum Unknown {
    /// Component 0 to 5 of the motion of a node.
    OfNode(usize, usize),
    /// Rotation of a held node about one of its axes.
    OfJoint(usize, usize),
}

/// Displacements and rotations of the nodes as combinations of unknowns. (K2)
#[derive(Clone, Debug)]
pub(in crate::elements) struct Freedoms {
    /// First freedom of each node, and the end.
    first: Vec<usize>,
    /// First term of each freedom, and the end.
    starts: Vec<usize>,
    /// Unknowns and their shares.
    terms: Vec<(usize, f64)>,
    unknowns: Vec<Unknown>,
}

/// Unknowns that move one freedom, and their shares.
type Row = Vec<(usize, f64)>;

/// Nodes that hold each other in a circle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::elements) struct Circle {
    /// One of them.
    pub node: usize,
}

impl Freedoms {
    /// The freedoms of nodes that are held like this.
    ///
    /// # Errors
    /// [`Circle`] if nodes hold each other.
    pub fn new(nodes: &[Node], holds: &[Hold]) -> Result<Self, Circle> {
        let mut rows: Vec<Option<Vec<Row>>> = vec![None; nodes.len()];
        let mut unknowns = Vec::new();
        for node in 0..nodes.len() {
            for held in chain(holds, &rows, node)?.into_iter().rev() {
                let made = held_rows(nodes, &holds[held], &rows, held, &mut unknowns);
                rows[held] = Some(made);
            }
        }
        let mut freedoms = Self { first: vec![0], starts: vec![0], terms: Vec::new(), unknowns };
        for row in rows.into_iter().flatten() {
            for terms in row {
                freedoms.terms.extend(terms);
                freedoms.starts.push(freedoms.terms.len());
            }
            freedoms.first.push(freedoms.starts.len() - 1);
        }
        Ok(freedoms)
    }

    /// The unknowns.
    pub fn unknowns(&self) -> &[Unknown] {
        &self.unknowns
    }

    /// First unknown of each group of unknowns of one node, and the end.
    pub fn groups(&self) -> Vec<u32> {
        let owner = |unknown: &Unknown| match *unknown {
            Unknown::OfNode(node, _) | Unknown::OfJoint(node, _) => node,
        };
        let starts = (1..self.unknowns.len())
            .filter(|index| owner(&self.unknowns[*index]) != owner(&self.unknowns[index - 1]));
        let mut groups: Vec<u32> = std::iter::once(0).chain(starts.map(|start| start as u32)).collect();
        groups.push(self.unknowns.len() as u32);
        groups
    }

    /// Unknowns that move a component of a node, with their shares.
    pub fn row(&self, node: usize, component: usize) -> &[(usize, f64)] {
        let freedom = self.first[node] + component;
        &self.terms[self.starts[freedom]..self.starts[freedom + 1]]
    }

    /// Rows of an element with these nodes.
    pub fn rows<'a>(
        &'a self,
        nodes: &'a [usize],
        freedoms: usize,
    ) -> impl Iterator<Item = &'a [(usize, f64)]> {
        nodes.iter().flat_map(move |node| (0..freedoms).map(move |component| self.row(*node, component)))
    }

    /// Fields over the unknowns, a row each, over the freedoms of an element.
    pub fn spread(&self, nodes: &[usize], freedoms: usize, fields: &DMatrix<f64>) -> DMatrix<f64> {
        let mut spread = DMatrix::zeros(fields.nrows(), nodes.len() * freedoms);
        for (number, row) in self.rows(nodes, freedoms).enumerate() {
            for (unknown, share) in row {
                spread.column_mut(number).axpy(*share, &fields.column(*unknown), 1.0);
            }
        }
        spread
    }

    /// Adds forces over the freedoms of an element, a row each, to those over the unknowns.
    pub fn gather(&self, nodes: &[usize], freedoms: usize, forces: &DMatrix<f64>, sum: &mut DMatrix<f64>) {
        for (number, row) in self.rows(nodes, freedoms).enumerate() {
            for (unknown, share) in row {
                sum.column_mut(*unknown).axpy(*share, &forces.column(number), 1.0);
            }
        }
    }
}

/// A node and the nodes that hold it, as far as their rows are still to be made, from the node on.
fn chain(holds: &[Hold], rows: &[Option<Vec<Row>>], node: usize) -> Result<Vec<usize>, Circle> {
    let mut chain = Vec::new();
    let mut next = Some(node);
    while let Some(held) = next.filter(|held| rows[*held].is_none()) {
        if chain.len() > 1 && chain.contains(&held) || chain.len() == 1 && chain[0] == held {
            return Err(Circle { node: held });
        }
        chain.push(held);
        next = match &holds[held] {
            Hold::Free | Hold::Partly(_) => None,
            Hold::On { base, .. } => *base,
        };
    }
    Ok(chain)
}

/// Rows of a node whose base has its rows.
fn held_rows(
    nodes: &[Node],
    hold: &Hold,
    rows: &[Option<Vec<Row>>],
    node: usize,
    unknowns: &mut Vec<Unknown>,
) -> Vec<Row> {
    let mut own = |unknown: Unknown| {
        unknowns.push(unknown);
        vec![(unknowns.len() - 1, 1.0)]
    };
    let count = if nodes[node].turns { 6 } else { 3 };
    let (base, axes) = match hold {
        Hold::Free => return (0..count).map(|component| own(Unknown::OfNode(node, component))).collect(),
        Hold::Partly(moves) => {
            let one = |component: usize| {
                if moves[component] { own(Unknown::OfNode(node, component)) } else { Vec::new() }
            };
            return (0..count).map(one).collect();
        }
        Hold::On { base, axes } => (base, axes),
    };
    let still = vec![Vec::new(); 6];
    let held = base.and_then(|base| rows[base].as_ref()).unwrap_or(&still);
    let arm = base.map_or_else(Vector3::zeros, |base| nodes[node].place - nodes[base].place);
    let mut made: Vec<Row> = (0..3).map(|axis| carried(held, arm, axis)).collect();
    if count == 6 && held.len() == 6 {
        made.extend_from_slice(&held[3..]);
        for (number, axis) in axes.iter().enumerate() {
            let turn = own(Unknown::OfJoint(node, number));
            for component in 0..3 {
                made[3 + component].extend(turn.iter().map(|(unknown, _)| (*unknown, axis[component])));
            }
        }
    } else if count == 6 {
        made.extend((3..6).map(|component| own(Unknown::OfNode(node, component))));
    }
    made
}

/// A displacement at the end of an arm: `u + θ × arm`.
fn carried(base: &[Row], arm: Vector3<f64>, axis: usize) -> Row {
    let mut row = base[axis].clone();
    if base.len() == 6 {
        let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
        row.extend(base[3 + next].iter().map(|(unknown, share)| (*unknown, share * arm[last])));
        row.extend(base[3 + last].iter().map(|(unknown, share)| (*unknown, -share * arm[next])));
    }
    row.retain(|(_, share)| *share != 0.0);
    row
}
