use std::collections::BTreeMap;

use nalgebra::{Matrix3, Matrix3xX, Matrix6, Vector3};

use crate::elements::coefficient;
use crate::elements::error::{ElementError, Field, Place, Problem, at};
use crate::elements::finite::{Block, Element, Grain, Mass, Site, rigid_points};
use crate::elements::structure::Node;
use crate::model::Inertia;

/// Nodes of another program's model, and its mass matrix over their displacements and rotations. (K9)
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NodalMass {
    /// Places of the nodes (m), in the file's frame.
    pub nodes: Vec<[f64; 3]>,
    /// Number of each node in its file.
    pub node_labels: Vec<u64>,
    /// What each row is about: the index of a node, and a component from 0 to 5.
    pub freedoms: Vec<(usize, usize)>,
    /// Mass matrix: rows, columns and entries, both triangles.
    pub entries: Vec<(usize, usize, f64)>,
}

/// Blocks of matrices between two nodes, 6×6 each, by pairs of nodes, the smaller first.
pub(super) type Blocks<const N: usize> = BTreeMap<(usize, usize), [Matrix6<f64>; N]>;

/// Entries that should agree may differ by this much relative to the larger diagonal.
const SYMMETRIC: f64 = 1e-9;

impl NodalMass {
    /// Freedoms of each node: 3, or 6 if some node turns.
    pub(super) fn per_node(&self) -> usize {
        if self.freedoms.iter().any(|(_, component)| *component >= 3) { 6 } else { 3 }
    }

    /// The nodes, in their order.
    pub(super) fn structure_nodes(&self) -> impl Iterator<Item = Node> + '_ {
        let turns = self.per_node() == 6;
        self.nodes.iter().map(move |place| Node { place: Vector3::from(*place), turns })
    }

    /// Components of each node that have a row.
    pub(super) fn moves(&self) -> Vec<[bool; 6]> {
        let mut moves = vec![[false; 6]; self.nodes.len()];
        for (node, component) in &self.freedoms {
            moves[*node][*component] = true;
        }
        moves
    }

    /// Symmetric matrices over the rows as blocks between nodes.
    ///
    /// # Errors
    /// [`ElementError`] for a matrix that is not finite, not symmetric, or of another size.
    pub(super) fn blocks<const N: usize>(
        &self,
        place: Place,
        matrices: [(Field, &[(usize, usize, f64)]); N],
    ) -> Result<Blocks<N>, ElementError> {
        let zero = [Matrix6::zeros(); N];
        let mut blocks = Blocks::new();
        for (which, (field, entries)) in matrices.into_iter().enumerate() {
            let refuse = at(place, field);
            symmetric(entries, self.freedoms.len()).map_err(&refuse)?;
            for (row, column, value) in entries {
                let ((i, a), (j, b)) = (self.freedoms[*row], self.freedoms[*column]);
                if i <= j {
                    blocks.entry((i, j)).or_insert(zero)[which][(a, b)] += value;
                }
            }
        }
        Ok(blocks)
    }

    /// What the mass of each node is to all nodes together: its rows summed over the nodes.
    pub(super) fn sums<'m>(
        &self,
        masses: impl IntoIterator<Item = ((usize, usize), &'m Matrix6<f64>)>,
    ) -> Vec<Matrix6<f64>> {
        let mut sums = vec![Matrix6::zeros(); self.nodes.len()];
        for ((i, j), mass) in masses {
            sums[i] += mass;
            if i != j {
                sums[j] += mass.transpose();
            }
        }
        sums
    }

    /// Mass, damping and stiffness of one node, or between two, as an element; the first node is `first` in the structure.
    pub(super) fn element(
        &self,
        (i, j): (usize, usize),
        first: usize,
        matter: usize,
        [mass, damping, stiffness]: &[Matrix6<f64>; 3],
        sums: &[Matrix6<f64>],
    ) -> Block {
        let (own, freedoms) = (i == j, self.per_node());
        Block {
            nodes: if own { vec![first + i] } else { vec![first + i, first + j] },
            freedoms,
            matter,
            stiffness: Block::spread(stiffness, freedoms, own),
            damping: Block::spread(damping, freedoms, own),
            mass: Block::spread(mass, freedoms, own),
            grains: if own { self.lump(i, &sums[i]) } else { self.between([i, j], mass) },
        }
    }

    /// The lumped mass of a node with its rotary inertia, where it is that of a rigid piece.
    fn lump(&self, node: usize, sum: &Matrix6<f64>) -> Vec<Grain> {
        let (mass, freedoms) = (scalar(sum), self.per_node());
        let rotary: Matrix3<f64> = sum.fixed_view::<3, 3>(3, 3).into_owned();
        let inertia = Inertia::new(std::array::from_fn(|i| std::array::from_fn(|j| rotary[(i, j)])));
        let points = match inertia {
            Ok(inertia) if freedoms == 6 && mass > 0.0 => rigid_points(mass, &inertia),
            _ => vec![(mass, Vector3::zeros())],
        };
        let place = Vector3::from(self.nodes[node]);
        Mass { node, freedoms, matter: 0, points, place }.grains()
    }

    /// The mass between two nodes: `M_ij (u_i v_j + u_j v_i)` is the lumped mass less `M_ij (u_i − u_j)(v_i − v_j)`.
    fn between(&self, [i, j]: [usize; 2], mass: &Matrix6<f64>) -> Vec<Grain> {
        let freedoms = self.per_node();
        let mut shapes = Matrix3xX::zeros(2 * freedoms);
        shapes.columns_mut(0, 3).copy_from(&Matrix3::identity());
        shapes.columns_mut(freedoms, 3).copy_from(&-Matrix3::identity());
        let distance = Vector3::from(self.nodes[i]) - Vector3::from(self.nodes[j]);
        vec![Grain { mass: -scalar(mass), site: Site::Between(distance), shapes, turn: None }]
    }
}

/// The mass of a block for one component of the displacement, the mean of those it has.
pub(super) fn scalar(mass: &Matrix6<f64>) -> f64 {
    let known: Vec<f64> = (0..3).map(|axis| mass[(axis, axis)]).filter(|mass| *mass != 0.0).collect();
    known.iter().sum::<f64>() / known.len().max(1) as f64
}

/// Accepts the entries of a finite symmetric matrix of this size.
pub(super) fn symmetric(entries: &[(usize, usize, f64)], size: usize) -> Result<(), Problem> {
    let mut found: BTreeMap<(usize, usize), f64> = BTreeMap::new();
    for (row, column, value) in entries {
        if *row.max(column) >= size {
            return Err(Problem::NoSuchRow { index: *row.max(column), count: size });
        }
        coefficient::finite(&[*value])?;
        *found.entry((*row, *column)).or_default() += value;
    }
    let diagonal = |i: usize| found.get(&(i, i)).copied().unwrap_or_default().abs();
    for ((row, column), upper) in &found {
        let lower = found.get(&(*column, *row)).copied().unwrap_or_default();
        let scale = (diagonal(*row) * diagonal(*column)).sqrt().max(upper.abs());
        if !((upper - lower).abs() <= SYMMETRIC * scale) {
            return Err(Problem::NotSymmetric { row: *row, column: *column, upper: *upper, lower });
        }
    }
    Ok(())
}
