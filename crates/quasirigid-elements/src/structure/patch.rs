//! Patches: neighbouring elements whose degrees of freedom are combinations of the same unknowns, as those of a body with given shapes.
//! Their matrices are summed over their degrees of freedom, and taken to the unknowns once. Equations (K2) and (K3), docs/theory/12-structures.md.

use std::collections::HashMap;
use std::ops::Range;
use std::sync::Arc;

use nalgebra::DMatrix;

use super::discrete::Structure;
use super::dofs::Dofs;
use crate::finite::Element;
use crate::math::symmetric::Pattern;

/// Elements of one material, and the unknowns that they share.
pub(super) struct Patch {
    pub elements: Range<usize>,
    /// Unknowns, none in place of a fixed degree of freedom.
    pub unknowns: Vec<Option<u32>>,
    /// None of one element each of whose degrees of freedom is an unknown or fixed.
    tie: Option<Tie>,
}

/// Degrees of freedom as combinations of unknowns.
struct Tie {
    /// Shares of the unknowns, a column per degree of freedom.
    shares: DMatrix<f64>,
    /// Columns of the degrees of freedom of each element.
    columns: Vec<Vec<usize>>,
}

/// Shares of a patch at most, and entries of the matrices of its elements; more elements are another patch.
const SHARES: usize = 1 << 20;
const ENTRIES: usize = 1 << 18;

impl Patch {
    /// A sum of symmetric matrices of elements over the unknowns; each part is the number of an element in the patch, and its matrix.
    pub fn sum(&self, parts: impl IntoIterator<Item = (usize, DMatrix<f64>)>) -> DMatrix<f64> {
        let Some(Tie { shares, columns }) = &self.tie else {
            let size = self.unknowns.len();
            return parts.into_iter().fold(DMatrix::zeros(size, size), |sum, (_, part)| sum + part);
        };
        let mut forces = DMatrix::zeros(shares.nrows(), shares.ncols());
        for (element, part) in parts {
            for (j, moved) in columns[element].iter().enumerate() {
                for (i, acting) in columns[element].iter().enumerate().filter(|(i, _)| part[(*i, j)] != 0.0) {
                    forces.column_mut(*acting).axpy(part[(i, j)], &shares.column(*moved), 1.0);
                }
            }
        }
        shares * forces.transpose()
    }

    fn groups(&self, groups: &[u32]) -> Vec<u32> {
        let group = |unknown: u32| groups.partition_point(|first| *first <= unknown) as u32 - 1;
        let mut joined: Vec<u32> = self.unknowns.iter().flatten().map(|unknown| group(*unknown)).collect();
        joined.sort_unstable();
        joined.dedup();
        joined
    }
}

/// The elements of a structure in patches, in their order.
pub(super) fn patches(structure: &Structure, dofs: &Dofs) -> Vec<Patch> {
    let mut patches = Vec::new();
    let mut open: Option<Open<'_>> = None;
    let mut owners = vec![usize::MAX; dofs.unknowns().len()];
    for (number, element) in structure.elements.iter().enumerate() {
        let element = element.as_ref();
        let rows: Vec<&[(usize, f64)]> = dofs.rows(element.nodes(), element.dofs()).collect();
        if let Some(patch) = &mut open
            && patch.takes(element, &rows, &owners)
        {
            patch.add(element, &rows);
            continue;
        }
        patches.extend(open.take().map(Open::closed));
        if rows.iter().all(|row| matches!(row, [] | [(_, 1.0)])) {
            let unknowns = rows.iter().map(|row| row.first().map(|(unknown, _)| *unknown as u32)).collect();
            patches.push(Patch { elements: number..number + 1, unknowns, tie: None });
        } else {
            let mut patch = Open::new(number, element, &rows, &mut owners);
            patch.add(element, &rows);
            open = Some(patch);
        }
    }
    patches.extend(open.map(Open::closed));
    patches
}

/// Pattern of the matrices of patches.
pub(super) fn pattern(dofs: &Dofs, patches: &[Patch]) -> Arc<Pattern> {
    let groups = dofs.groups();
    let lists: Vec<Vec<u32>> = patches.iter().map(|patch| patch.groups(&groups)).collect();
    let pattern = Pattern::new(&groups, lists.iter().map(Vec::as_slice));
    Arc::new(pattern.expect("groups ascend and each list names groups"))
}

/// A patch that may take more elements.
struct Open<'a> {
    first: usize,
    material: usize,
    unknowns: Vec<usize>,
    /// Unknowns and their shares, for each degree of freedom.
    rows: Vec<&'a [(usize, f64)]>,
    /// Numbers of the degrees of freedom, by node and component.
    numbers: HashMap<(usize, usize), usize>,
    columns: Vec<Vec<usize>>,
    /// Entries of the matrices of the elements.
    entries: usize,
}

impl<'a> Open<'a> {
    /// A patch over the unknowns of an element; `owners` has the first element of the last patch of each unknown.
    fn new(first: usize, element: &dyn Element, rows: &[&[(usize, f64)]], owners: &mut [usize]) -> Self {
        let mut unknowns: Vec<usize> =
            rows.iter().flat_map(|row| row.iter().map(|(unknown, _)| *unknown)).collect();
        unknowns.sort_unstable();
        unknowns.dedup();
        unknowns.iter().for_each(|unknown| owners[*unknown] = first);
        let (rows, numbers, columns) = (Vec::new(), HashMap::new(), Vec::new());
        Self { first, material: element.material(), unknowns, rows, numbers, columns, entries: 0 }
    }

    fn takes(&self, element: &dyn Element, rows: &[&[(usize, f64)]], owners: &[usize]) -> bool {
        element.material() == self.material
            && (self.rows.len() + rows.len()) * self.unknowns.len() <= SHARES
            && self.entries + rows.len().pow(2) <= ENTRIES
            && rows.iter().all(|row| row.iter().all(|(unknown, _)| owners[*unknown] == self.first))
    }

    fn add(&mut self, element: &dyn Element, rows: &[&'a [(usize, f64)]]) {
        let components = element.nodes().iter().flat_map(|node| (0..element.dofs()).map(|dof| (*node, dof)));
        let mut columns = Vec::with_capacity(rows.len());
        for (component, row) in components.zip(rows) {
            let next = self.rows.len();
            let column = *self.numbers.entry(component).or_insert(next);
            if column == next {
                self.rows.push(row);
            }
            columns.push(column);
        }
        self.entries += columns.len().pow(2);
        self.columns.push(columns);
    }

    fn closed(self) -> Patch {
        let mut shares = DMatrix::zeros(self.unknowns.len(), self.rows.len());
        for (mut column, row) in shares.column_iter_mut().zip(&self.rows) {
            for (unknown, share) in *row {
                column[self.unknowns.partition_point(|known| known < unknown)] += share;
            }
        }
        Patch {
            elements: self.first..self.first + self.columns.len(),
            unknowns: self.unknowns.iter().map(|unknown| Some(*unknown as u32)).collect(),
            tie: Some(Tie { shares, columns: self.columns }),
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix3, Vector3};

    use super::super::discrete::{Discrete, MaterialDamping};
    use super::super::dofs::{Constraint, Node};
    use super::*;
    use crate::finite::{Connectivity, Link, Mass};
    use crate::math::symmetric::Symmetric;
    use crate::model::Rheology;

    /// A number between −1 and 1 for each index.
    fn odd(index: usize) -> f64 {
        (index as f64 * 12.9898).sin()
    }

    fn matrix(index: usize) -> Matrix3<f64> {
        let root = Matrix3::from_fn(|i, j| odd(9 * index + 3 * i + j));
        root.transpose() * root
    }

    /// Nodes 1 to 8 move by five coordinates, 9 by three of them, 10 and 11 freely; links and masses between and on them.
    fn structure() -> Structure {
        let mut structure = Structure::default();
        let shaped = |node: usize, count: usize| Constraint::Shaped {
            columns: (0..count).map(|column| (0, column)).collect(),
            shares: DMatrix::from_fn(3, count, |i, j| odd(100 * node + 7 * i + j)),
        };
        let constraint = |node: usize| match node {
            0 => Constraint::Coordinates(5),
            9 => shaped(9, 3),
            10 => Constraint::Free,
            11 => Constraint::Partly([true, false, true, true, true, true]),
            _ => shaped(node, 5),
        };
        for node in 0..12 {
            let place = Vector3::new(odd(node), odd(node + 50), odd(node + 90));
            structure.nodes.push(Node { place, rotations: node == 0 });
            structure.constraints.push(constraint(node));
        }
        for [per_mass, per_stiffness] in [[0.3, 0.0], [0.0, 0.2], [0.1, 0.7]] {
            let rheology = Rheology::Elastic;
            structure.materials.push(MaterialDamping {
                name: String::new(),
                rheology,
                per_mass,
                per_stiffness,
            });
        }
        for (index, nodes) in [
            [1, 2],
            [2, 5],
            [8, 9],
            [3, 3],
            [9, 4],
            [4, 10],
            [10, 11],
            [9, 9],
            [6, 7],
            [10, 9],
            [2, 4],
            [5, 11],
        ]
        .into_iter()
        .enumerate()
        {
            let material = index / 5;
            let strain = [index, index + 1].map(matrix);
            let law = [index + 20, index + 30].map(matrix);
            structure.elements.push(Box::new(Link::new(nodes, material, strain, law)));
            let points = vec![(1.5 + odd(index), Vector3::zeros())];
            let place = structure.nodes[nodes[1]].place;
            let connectivity = Connectivity { nodes: vec![nodes[1]], dofs: 3, material };
            structure.elements.push(Box::new(Mass { connectivity, points, place }));
        }
        structure
    }

    /// Matrices of elements taken to the unknowns one by one.
    fn one_by_one(discrete: &Discrete<'_>, part: impl Fn(&dyn Element) -> DMatrix<f64>) -> DMatrix<f64> {
        let size = discrete.dofs.unknowns().len();
        let fields = DMatrix::identity(size, size);
        let each = discrete.structure.elements.iter().map(|element| {
            let spread = discrete.dofs.spread(element.nodes(), element.dofs(), &fields);
            &spread * part(element.as_ref()) * spread.transpose()
        });
        each.fold(DMatrix::zeros(size, size), |sum, own| sum + own)
    }

    fn gap(sum: &Symmetric, reference: &DMatrix<f64>) -> f64 {
        let mut rest = reference.clone();
        for column in 0..sum.size() {
            for (row, entry) in sum.column(column) {
                rest[(row, column)] -= entry;
                if row != column {
                    rest[(column, row)] -= entry;
                }
            }
        }
        rest.amax() / reference.amax()
    }

    #[test]
    fn patches_have_the_matrices_of_their_elements() {
        let structure = structure();
        let dofs = Dofs::new(&structure.nodes, &structure.constraints).unwrap();
        let ends: Vec<usize> = patches(&structure, &dofs).iter().map(|patch| patch.elements.end).collect();
        // Materials end at 10 and 20; nodes 10 and 11 have unknowns that others have not, and node 9 has fewer.
        assert_eq!(ends, [10, 12, 13, 14, 16, 18, 20, 22, 24]);
        let discrete = Discrete::new(&structure, dofs).unwrap();
        let material = |element: &dyn Element| &structure.materials[element.material()];
        let damping = |element: &dyn Element| {
            let zero = DMatrix::zeros(3 * element.nodes().len(), 3 * element.nodes().len());
            let dashpots = element.damping().unwrap_or(zero);
            let material = material(element);
            dashpots + material.per_stiffness * element.stiffness() + material.per_mass * element.mass()
        };
        assert!(gap(&discrete.mass, &one_by_one(&discrete, |element| element.mass())) < 1e-14);
        assert!(gap(discrete.damping.as_ref().unwrap(), &one_by_one(&discrete, damping)) < 1e-14);
        for (number, stiffness) in discrete.stiffness.iter().enumerate() {
            let own = |element: &dyn Element| {
                f64::from(u8::from(element.material() == number)) * element.stiffness()
            };
            assert!(gap(stiffness, &one_by_one(&discrete, own)) < 1e-14);
        }
    }
}
