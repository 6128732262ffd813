//! Nodal mass: the mass matrix of another program as lumped masses at nodes and negative ones between pairs of nodes.
//! Quadrature masses inside the cells are not known; these sums have the same moments, also where a lumped mass is negative.
//! Equation (K9), docs/theory/12-structures.md.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, Matrix3, Matrix3xX, Matrix6, Vector3};

use crate::error::{ElementError, ElementId, Field, Problem, at};
use crate::finite::{Block, Connectivity, Element, LumpedMass, Mass, MassLocation, rigid_points};
use crate::model::Inertia;
use crate::number;
use crate::structure::Node;

/// Nodes of another program's model, and its mass matrix over their displacements and rotations. (K9)
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NodalMass {
    /// Places of the nodes (m), in the file's frame.
    pub nodes: Vec<[f64; 3]>,
    /// Number of each node in its file.
    pub node_labels: Vec<u64>,
    /// Node and component, from 0 to 5, of each row.
    pub dofs: Vec<(usize, usize)>,
    /// Mass matrix: rows, columns and entries, both triangles.
    pub entries: Vec<(usize, usize, f64)>,
}

/// Blocks of matrices between two nodes, 6×6 each, by pairs of nodes, the smaller first.
pub(super) type Blocks<const N: usize> = BTreeMap<(usize, usize), [Matrix6<f64>; N]>;

/// Rows, columns and entries of a matrix, both triangles.
pub(super) type Entries<'e> = &'e [(usize, usize, f64)];

/// Difference, relative to the larger diagonal, up to which entries that should be equal agree.
const SYMMETRIC: f64 = 1e-9;
/// Share of the largest motion below which a motion moves nothing.
const NO_MOTION: f64 = 1e-9;
/// Share of the largest entry below which entries are rounding: the residue of a stiffness that resists nothing.
const ENTRY_ROUNDING: f64 = 1e-13;

impl NodalMass {
    /// Degrees of freedom of each node: 3, or 6 if some node has rotations.
    pub(super) fn per_node(&self) -> usize {
        if self.dofs.iter().any(|(_, component)| *component >= 3) { 6 } else { 3 }
    }

    /// The nodes, in their order.
    pub(super) fn structure_nodes(&self) -> impl Iterator<Item = Node> + '_ {
        let rotations = self.per_node() == 6;
        self.nodes.iter().map(move |place| Node { place: Vector3::from(*place), rotations })
    }

    /// Rigid motions that move some row, an orthonormal column each: six, or five of nodes in a line.
    pub(super) fn rigid(&self) -> DMatrix<f64> {
        let place = |node: usize| Vector3::from(self.nodes[node]);
        let middle = (0..self.nodes.len()).map(place).sum::<Vector3<f64>>() / self.nodes.len().max(1) as f64;
        let motion = |row: usize, motion: usize| {
            let (node, component) = self.dofs[row];
            let axis = Vector3::ith(motion % 3, 1.0);
            match (component < 3, motion < 3) {
                (true, true) => axis[component],
                (true, false) => axis.cross(&(place(node) - middle))[component],
                (false, true) => 0.0,
                (false, false) => axis[component - 3],
            }
        };
        let motions = DMatrix::from_fn(self.dofs.len(), 6, motion);
        let moved = motions.svd(true, false);
        let least = NO_MOTION * moved.singular_values.max();
        let columns: Vec<usize> = (0..moved.singular_values.len())
            .filter(|motion| moved.singular_values[*motion] > least)
            .collect();
        moved.u.map_or_else(|| DMatrix::zeros(0, 0), |basis| basis.select_columns(&columns))
    }

    /// Node and component of the rows of some nodes, node by node.
    #[must_use]
    pub fn rows_of(&self, nodes: &[usize]) -> Vec<(usize, usize)> {
        let moves = self.moves();
        let of = |node: &usize| {
            let (node, moves) = (*node, moves[*node]);
            (0..6).filter(move |component| moves[*component]).map(move |component| (node, component))
        };
        nodes.iter().flat_map(of).collect()
    }

    /// Components of each node that have a row.
    pub(super) fn moves(&self) -> Vec<[bool; 6]> {
        let mut moves = vec![[false; 6]; self.nodes.len()];
        for (node, component) in &self.dofs {
            moves[*node][*component] = true;
        }
        moves
    }

    /// Symmetric matrices over the rows as blocks between nodes.
    ///
    /// # Errors
    /// [`ElementError`] for a matrix that no body has.
    pub(super) fn blocks<const N: usize>(
        &self,
        place: ElementId,
        matrices: [(Field, Entries<'_>); N],
    ) -> Result<Blocks<N>, ElementError> {
        let zero = [Matrix6::zeros(); N];
        let mut blocks = Blocks::new();
        for (which, (field, entries)) in matrices.into_iter().enumerate() {
            symmetric(entries, self.dofs.len(), |row| self.name(row)).map_err(at(place, field))?;
            for (row, column, value) in entries {
                let ((i, a), (j, b)) = (self.dofs[*row], self.dofs[*column]);
                if i <= j {
                    blocks.entry((i, j)).or_insert(zero)[which][(a, b)] += value;
                }
            }
        }
        Ok(blocks)
    }

    /// A degree of freedom as other programs name it.
    fn name(&self, row: usize) -> String {
        let (node, component) = self.dofs[row];
        format!("{}.{}", self.node_labels[node], component + 1)
    }

    /// Lumped mass of each node: its mass to all nodes together.
    ///
    /// # Errors
    /// [`Problem`] if they have none.
    pub(super) fn lumps<'m>(
        &self,
        masses: impl IntoIterator<Item = ((usize, usize), &'m Matrix6<f64>)>,
    ) -> Result<Vec<Lump>, Problem> {
        let mut lumps: Vec<Lump> =
            self.moves().into_iter().map(|moves| Lump { moves, ..Lump::default() }).collect();
        for ((i, j), mass) in masses {
            let scalar = scalar(mass, [&lumps[i], &lumps[j]]);
            let rotary: Matrix3<f64> = mass.fixed_view::<3, 3>(3, 3).into_owned();
            let both = [(i, rotary), (j, rotary.transpose())];
            for (node, rotary) in both.into_iter().take(if i == j { 1 } else { 2 }) {
                lumps[node].mass += scalar;
                lumps[node].rotary += rotary;
            }
        }
        number::mass(lumps.iter().map(|lump| lump.mass).sum())?;
        Ok(lumps)
    }

    /// Mass, damping and stiffness of one node, or between two, as an element; the first node is `first` in the structure.
    pub(super) fn element(
        &self,
        (i, j): (usize, usize),
        first: usize,
        material: usize,
        [mass, damping, stiffness]: &[Matrix6<f64>; 3],
        lumps: &[Lump],
    ) -> Block {
        let (own, dofs) = (i == j, self.per_node());
        let lumped_masses = if own {
            self.lumped(i, &lumps[i])
        } else {
            self.between([i, j], scalar(mass, [&lumps[i], &lumps[j]]))
        };
        let nodes = if own { vec![first + i] } else { vec![first + i, first + j] };
        Block {
            connectivity: Connectivity { nodes, dofs, material },
            stiffness: Block::spread(stiffness, dofs, own),
            damping: Block::spread(damping, dofs, own),
            mass: Block::spread(mass, dofs, own),
            lumped_masses,
        }
    }

    /// The lumped mass of a node with its rotary inertia, where it is that of a rigid piece.
    fn lumped(&self, node: usize, lump: &Lump) -> Vec<LumpedMass> {
        let (Lump { mass, rotary, .. }, dofs) = (lump, self.per_node());
        let inertia = Inertia::new(std::array::from_fn(|i| std::array::from_fn(|j| rotary[(i, j)])));
        let points = match inertia {
            Ok(inertia) if dofs == 6 && *mass > 0.0 => rigid_points(*mass, &inertia),
            _ => vec![(*mass, Vector3::zeros())],
        };
        let place = Vector3::from(self.nodes[node]);
        let connectivity = Connectivity { nodes: vec![node], dofs, material: 0 };
        Mass { connectivity, points, place }.lumped_masses()
    }

    /// The mass between two nodes: `M_ij (u_i v_j + u_j v_i)` is the lumped mass less `M_ij (u_i − u_j)(v_i − v_j)`.
    fn between(&self, [i, j]: [usize; 2], mass: f64) -> Vec<LumpedMass> {
        let dofs = self.per_node();
        let mut shapes = Matrix3xX::zeros(2 * dofs);
        shapes.columns_mut(0, 3).copy_from(&Matrix3::identity());
        shapes.columns_mut(dofs, 3).copy_from(&-Matrix3::identity());
        let distance = Vector3::from(self.nodes[i]) - Vector3::from(self.nodes[j]);
        vec![LumpedMass { mass: -mass, location: MassLocation::Between(distance), shapes, turn: None }]
    }
}

/// The mass of a node to all nodes together: its rows summed over the nodes.
#[derive(Clone, Debug, Default)]
pub(super) struct Lump {
    /// Mass (kg).
    pub mass: f64,
    /// Rotary inertia (kg·m²).
    rotary: Matrix3<f64>,
    /// Components of the node that have a row.
    moves: [bool; 6],
}

/// Mass between two nodes for one component of the displacement, the mean of those for which both have rows.
fn scalar(mass: &Matrix6<f64>, lumps: [&Lump; 2]) -> f64 {
    let common: Vec<usize> = (0..3).filter(|axis| lumps.iter().all(|lump| lump.moves[*axis])).collect();
    if common.is_empty() {
        return 0.0;
    }
    common.iter().map(|axis| mass[(*axis, *axis)]).sum::<f64>() / common.len() as f64
}

/// Product of a matrix with columns.
pub(super) fn times(entries: Entries<'_>, columns: &DMatrix<f64>) -> DMatrix<f64> {
    let mut product = DMatrix::zeros(columns.nrows(), columns.ncols());
    for (row, column, entry) in entries {
        let share = *entry * columns.row(*column);
        let mut sum = product.row_mut(*row);
        sum += share;
    }
    product
}

/// Accepts the entries of a symmetric matrix that gives no motion of a single degree of freedom negative energy; `name` is that of a row.
pub(super) fn symmetric(
    entries: Entries<'_>,
    count: usize,
    name: impl Fn(usize) -> String,
) -> Result<(), Problem> {
    let mut found: BTreeMap<(usize, usize), f64> = BTreeMap::new();
    for (row, column, value) in entries {
        number::finite(&[*value])?;
        if *row.max(column) >= count {
            return Err(Problem::NoSuchRow { index: *row.max(column), count });
        }
        *found.entry((*row, *column)).or_default() += value;
    }
    let rounding = ENTRY_ROUNDING * found.values().fold(0.0, |largest: f64, value| largest.max(value.abs()));
    let diagonal = |i: usize| found.get(&(i, i)).copied().unwrap_or_default();
    if let Some(row) = (0..count).find(|row| diagonal(*row) < -rounding) {
        return Err(Problem::NegativeDiagonal { dof: name(row), value: diagonal(row) });
    }
    for ((row, column), value) in &found {
        let other = found.get(&(*column, *row)).copied().unwrap_or_default();
        let scale = (diagonal(*row) * diagonal(*column)).sqrt().max(value.abs());
        if !((value - other).abs() <= SYMMETRIC * scale + rounding) {
            return Err(Problem::Lopsided { dofs: [name(*row), name(*column)], values: [*value, other] });
        }
    }
    Ok(())
}
