use std::collections::BTreeMap;

use nalgebra::{DMatrix, Matrix3, Matrix3xX, Matrix6, Vector3};

use crate::elements::coefficient;
use crate::elements::error::{ElementError, Field, Place, Problem, at};
use crate::elements::finite::{Element, Grain, Mass, Site, rigid_points};
use crate::elements::structure::{Hold, Matter, Structure};
use crate::model::{Inertia, Rheology};

/// Matrices over displacements and rotations of nodes, from another program. (K9)
///
/// What the program held is taken as held on the carrier; its mass there is the carrier's.
#[derive(Clone, Debug, PartialEq)]
pub struct Matrices {
    /// Places of the nodes (m), in the file's frame.
    pub nodes: Vec<[f64; 3]>,
    /// Number of each node in its file.
    pub node_labels: Vec<u64>,
    /// What each row is about: the index of a node, and a component from 0 to 5.
    pub freedoms: Vec<(usize, usize)>,
    /// Mass matrix: rows, columns and entries, both triangles.
    pub mass: Vec<(usize, usize, f64)>,
    /// Stiffness matrix.
    pub stiffness: Vec<(usize, usize, f64)>,
    /// Damping matrix.
    pub damping: Vec<(usize, usize, f64)>,
    /// How what has this stiffness answers periodic strain.
    pub rheology: Rheology,
}

/// Blocks of the matrices between two nodes, or of one with itself.
#[derive(Debug)]
struct Block {
    nodes: Vec<usize>,
    freedoms: usize,
    matter: usize,
    stiffness: DMatrix<f64>,
    damping: DMatrix<f64>,
    mass: DMatrix<f64>,
    grains: Vec<Grain>,
}

/// Mass, damping and stiffness between two nodes, 6×6 each.
type Blocks = [Matrix6<f64>; 3];

/// The mass of a node to all nodes together: its rows summed over the nodes.
#[derive(Clone, Debug, Default)]
struct Lump {
    mass: f64,
    /// What its rotations have (kg·m²).
    rotary: Matrix3<f64>,
}

/// Entries that should agree may differ by this much relative to the larger diagonal.
const SYMMETRIC: f64 = 1e-9;

impl Matrices {
    /// Whether some node turns.
    pub(super) fn turns(&self) -> bool {
        self.freedoms.iter().any(|(_, component)| *component >= 3)
    }

    /// Adds its blocks to a structure that has its nodes, and holds the components that have no row.
    pub(super) fn furnish(
        &self,
        index: usize,
        first: usize,
        [per_mass, per_stiffness]: [f64; 2],
        structure: &mut Structure,
    ) -> Result<(), ElementError> {
        let place = Place::Part(index);
        self.rheology.check().map_err(|error| at(place, Field::Rheology)(error.into()))?;
        let blocks = self.blocks(place)?;
        let rheology = self.rheology.clone();
        let matter = structure.matter(Matter { rheology, per_mass, per_stiffness });
        let freedoms = if self.turns() { 6 } else { 3 };
        let moves = self.moves();
        let between = |nodes: [usize; 2], mass: &Matrix6<f64>| scalar(mass, nodes.map(|node| moves[node]));
        let lumps = self.lumps(&blocks, between);
        let total: f64 = lumps.iter().map(|lump| lump.mass).sum();
        coefficient::mass(total).map_err(at(place, Field::Mass))?;
        for ((i, j), [mass, damping, stiffness]) in &blocks {
            let own = i == j;
            let spread = |block: &Matrix6<f64>| spread(block, freedoms, own);
            let grains = if own {
                self.lumped(*i, freedoms, &lumps[*i])
            } else {
                self.between([*i, *j], freedoms, between([*i, *j], mass))
            };
            structure.elements.push(Box::new(Block {
                nodes: if own { vec![first + i] } else { vec![first + i, first + j] },
                freedoms,
                matter,
                stiffness: spread(stiffness),
                damping: spread(damping),
                mass: spread(mass),
                grains,
            }));
        }
        Ok(())
    }

    /// How each node is held where its components have no row.
    pub(super) fn holds(&self) -> Vec<Hold> {
        self.moves().into_iter().map(Hold::Partly).collect()
    }

    /// A node without a row for some displacement: the other program held it.
    pub(super) fn held(&self) -> Option<usize> {
        self.moves().iter().position(|moves| moves[..3].contains(&false))
    }

    /// Which components of each node have a row.
    fn moves(&self) -> Vec<[bool; 6]> {
        let mut moves = vec![[false; 6]; self.nodes.len()];
        for (node, component) in &self.freedoms {
            moves[*node][*component] = true;
        }
        moves
    }

    /// The matrices by pairs of nodes, the smaller first.
    fn blocks(&self, place: Place) -> Result<BTreeMap<(usize, usize), Blocks>, ElementError> {
        let mut blocks: BTreeMap<(usize, usize), Blocks> = BTreeMap::new();
        let matrices =
            [(Field::Mass, &self.mass), (Field::Damping, &self.damping), (Field::Stiffness, &self.stiffness)];
        for (which, (field, entries)) in matrices.into_iter().enumerate() {
            let refuse = at(place, field);
            self.symmetric(entries).map_err(&refuse)?;
            for (row, column, value) in entries {
                let ((i, a), (j, b)) = (self.freedoms[*row], self.freedoms[*column]);
                if i <= j {
                    blocks.entry((i, j)).or_default()[which][(a, b)] += value;
                }
            }
        }
        Ok(blocks)
    }

    fn lumps(
        &self,
        blocks: &BTreeMap<(usize, usize), Blocks>,
        between: impl Fn([usize; 2], &Matrix6<f64>) -> f64,
    ) -> Vec<Lump> {
        let mut lumps = vec![Lump::default(); self.nodes.len()];
        for ((i, j), [mass, ..]) in blocks {
            let rotary: Matrix3<f64> = mass.fixed_view::<3, 3>(3, 3).into_owned();
            let both = [(*i, rotary), (*j, rotary.transpose())];
            for (node, rotary) in both.into_iter().take(if i == j { 1 } else { 2 }) {
                lumps[node].mass += between([*i, *j], mass);
                lumps[node].rotary += rotary;
            }
        }
        lumps
    }

    /// The lumped mass of a node with its rotary inertia, where it is that of a rigid piece.
    fn lumped(&self, node: usize, freedoms: usize, lump: &Lump) -> Vec<Grain> {
        let Lump { mass, rotary } = lump;
        let inertia = Inertia::new(std::array::from_fn(|i| std::array::from_fn(|j| rotary[(i, j)])));
        let points = match inertia {
            Ok(inertia) if freedoms == 6 && *mass > 0.0 => rigid_points(*mass, &inertia),
            _ => vec![(*mass, Vector3::zeros())],
        };
        let place = Vector3::from(self.nodes[node]);
        Mass { node, freedoms, matter: 0, points, place }.grains()
    }

    /// The mass between two nodes: `M_ij (u_i v_j + u_j v_i)` is the lumped mass less `M_ij (u_i − u_j)(v_i − v_j)`.
    fn between(&self, [i, j]: [usize; 2], freedoms: usize, mass: f64) -> Vec<Grain> {
        let mut shapes = Matrix3xX::zeros(2 * freedoms);
        shapes.columns_mut(0, 3).copy_from(&Matrix3::identity());
        shapes.columns_mut(freedoms, 3).copy_from(&-Matrix3::identity());
        let distance = Vector3::from(self.nodes[i]) - Vector3::from(self.nodes[j]);
        vec![Grain { mass: -mass, site: Site::Between(distance), shapes, turn: None }]
    }

    /// Accepts the entries of a symmetric matrix that gives no motion of a single freedom energy.
    fn symmetric(&self, entries: &[(usize, usize, f64)]) -> Result<(), Problem> {
        let count = self.freedoms.len();
        let mut found: BTreeMap<(usize, usize), f64> = BTreeMap::new();
        for (row, column, value) in entries {
            coefficient::finite(&[*value])?;
            if *row.max(column) >= count {
                return Err(Problem::NoSuchRow { index: *row.max(column), count });
            }
            *found.entry((*row, *column)).or_default() += value;
        }
        let diagonal = |i: usize| found.get(&(i, i)).copied().unwrap_or_default();
        if let Some(row) = (0..count).find(|row| diagonal(*row) < 0.0) {
            return Err(Problem::NegativeDiagonal { freedom: self.name(row), value: diagonal(row) });
        }
        for ((row, column), value) in &found {
            let other = found.get(&(*column, *row)).copied().unwrap_or_default();
            let scale = (diagonal(*row) * diagonal(*column)).sqrt().max(value.abs());
            if !((value - other).abs() <= SYMMETRIC * scale) {
                let freedoms = [self.name(*row), self.name(*column)];
                return Err(Problem::Lopsided { freedoms, values: [*value, other] });
            }
        }
        Ok(())
    }

    /// A freedom as other programs name it.
    fn name(&self, row: usize) -> String {
        let (node, component) = self.freedoms[row];
        format!("{}.{}", self.node_labels[node], component + 1)
    }
}

/// The mass between two nodes for one component of the displacement, the mean of those for which both have rows.
fn scalar(mass: &Matrix6<f64>, moves: [[bool; 6]; 2]) -> f64 {
    let common: Vec<usize> = (0..3).filter(|axis| moves.iter().all(|moves| moves[*axis])).collect();
    if common.is_empty() {
        return 0.0;
    }
    common.iter().map(|axis| mass[(*axis, *axis)]).sum::<f64>() / common.len() as f64
}

/// A block over the freedoms of an element of one node, or of two.
fn spread(block: &Matrix6<f64>, freedoms: usize, own: bool) -> DMatrix<f64> {
    let part = block.view((0, 0), (freedoms, freedoms));
    if own {
        return part.into_owned();
    }
    let mut matrix = DMatrix::zeros(2 * freedoms, 2 * freedoms);
    matrix.view_mut((0, freedoms), (freedoms, freedoms)).copy_from(&part);
    matrix.view_mut((freedoms, 0), (freedoms, freedoms)).copy_from(&part.transpose());
    matrix
}

impl Element for Block {
    fn nodes(&self) -> &[usize] {
        &self.nodes
    }

    fn freedoms(&self) -> usize {
        self.freedoms
    }

    fn matter(&self) -> usize {
        self.matter
    }

    fn stiffness(&self) -> DMatrix<f64> {
        self.stiffness.clone()
    }

    fn damping(&self) -> Option<DMatrix<f64>> {
        Some(self.damping.clone())
    }

    fn mass(&self) -> DMatrix<f64> {
        self.mass.clone()
    }

    fn grains(&self) -> Vec<Grain> {
        self.grains.clone()
    }
}

#[cfg(test)]
mod tests;
