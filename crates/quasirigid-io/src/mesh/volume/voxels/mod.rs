//! Voxels as meshes: each solid voxel of a NumPy array, an NRRD file or a stack of TIFF pages is a hexahedron. Labels are sets, `value=3`,
//! and so are the parts that no face joins, `part=1` from the largest on. A rule makes densities of the values.

mod density;
mod nrrd;
mod parts;
mod problem;
#[cfg(feature = "tiff")]
mod tiff;

use std::collections::{BTreeMap, HashMap};
use std::path::Path;

use quasirigid_math::memory;
use quasirigid_math::vec3::{add, cross, dot, scale};
use quasirigid_mesh::{Cell, Mesh, Set, Shape};

use super::draft::finite;
use super::problem::VolumeProblem;
use super::{MeshProblem, VolumeFile};
use crate::matrix::numpy::Array;
use crate::mesh::error::{Fault, MeshError, Place};
use crate::text_file::FileError;
pub(crate) use density::DensityRule;
pub use problem::VoxelProblem;

/// Most voxels of a file, and most of them that are solid.
const MOST: usize = 1 << 28;
const MOST_SOLID: usize = 4_000_000;
/// Most labels that become sets.
const MOST_LABELS: usize = 1000;
/// Most parts that become sets.
const MOST_PARTS: usize = 100;
/// Memory of a solid voxel with its nodes (bytes).
const OF_VOXEL: f64 = 600.0;

/// What a user says of voxels.
#[derive(Clone, Debug, Default)]
pub(crate) struct VoxelRule {
    /// Sides of a voxel, in the unit of the file.
    pub size: Option<[f64; 3]>,
    /// Value at and above which a voxel is solid; none for labels, of which zero is empty, and for densities above zero.
    pub threshold: Option<f64>,
    /// Density of a value.
    pub density: Option<DensityRule>,
    /// Voxels of the smallest part that is kept.
    pub least: usize,
}

impl VoxelRule {
    fn is_solid(&self, value: f64) -> bool {
        match (self.threshold, &self.density) {
            (Some(least), _) => value >= least,
            (None, Some(rule)) => rule.of(value) > 0.0,
            (None, None) => value != 0.0,
        }
    }
}

/// Values on a grid.
pub(super) struct Grid {
    /// Numbers of voxels along the three axes.
    pub sizes: [usize; 3],
    /// Values, the first axis fastest.
    pub values: Vec<f64>,
    /// The corner of the first voxel, and its edges.
    pub corner: [f64; 3],
    pub edges: [[f64; 3]; 3],
}

/// The mesh of a NumPy array, whose three indices are along x, y and z.
pub(super) fn read_npy(bytes: &[u8], rule: &VoxelRule) -> Result<VolumeFile, Fault> {
    let at = |byte: usize, problem: VolumeProblem| (Place::Byte(byte), MeshProblem::from(problem));
    let array = Array::new(bytes).map_err(|(byte, problem)| at(byte, problem.into()))?;
    let [x, y, z] = array.shape[..] else {
        let found = format!("{:?}", array.shape);
        return Err((Place::File, VolumeProblem::from(VoxelProblem::Dimensions { found }).into()));
    };
    let count = counted([x, y, z]).map_err(of_file)?;
    memory::ask(8.0 * count as f64).map_err(|problem| (Place::File, MeshProblem::Memory(problem)))?;
    let mut values = Vec::with_capacity(count);
    for index in 0..count {
        let (i, j, k) = (index % x, index / x % y, index / (x * y));
        let place = if array.by_rows() { (i * y + j) * z + k } else { index };
        values.push(array.real(place).map_err(|(byte, problem)| at(byte, problem.into()))?);
    }
    Grid { sizes: [x, y, z], values, corner: [0.0; 3], edges: UNIT }.mesh(rule)
}

/// The mesh of an NRRD file, which may name the file of its values.
pub(super) fn read_nrrd(file: &Path, bytes: &[u8], rule: &VoxelRule) -> Result<VolumeFile, MeshError> {
    nrrd::read(file, bytes)?.mesh(rule).map_err(FileError::new(file))
}

/// The mesh of TIFF pages, along z one behind the other; their columns are along x and their rows along y.
#[cfg(feature = "tiff")]
pub(super) fn read_tiff(bytes: &[u8], rule: &VoxelRule) -> Result<VolumeFile, Fault> {
    tiff::read(bytes)?.mesh(rule)
}

/// TIFF in a program that was built without it.
#[cfg(not(feature = "tiff"))]
pub(super) fn read_tiff(_bytes: &[u8], _rule: &VoxelRule) -> Result<VolumeFile, Fault> {
    Err(of_file(VoxelProblem::WithoutTiff))
}

/// Edges of voxels of a file that does not give them.
const UNIT: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Whether a file begins as TIFF or BigTIFF.
pub(super) fn is_tiff(bytes: &[u8]) -> bool {
    [b"II*\0", b"MM\0*", b"II+\0", b"MM\0+"].iter().any(|mark| bytes.starts_with(*mark))
}

/// Number of voxels, which is bounded.
fn counted(sizes: [usize; 3]) -> Result<usize, VoxelProblem> {
    let count = sizes.iter().try_fold(1_usize, |count, size| count.checked_mul(*size));
    match count {
        Some(0) => Err(VoxelProblem::Nothing),
        Some(count) if count <= MOST => Ok(count),
        _ => Err(VoxelProblem::TooMany { count: format!("{sizes:?} voxels"), limit: MOST }),
    }
}

fn of_file(problem: VoxelProblem) -> Fault {
    (Place::File, VolumeProblem::from(problem).into())
}

impl Grid {
    /// Hexahedra of the solid voxels.
    fn mesh(mut self, rule: &VoxelRule) -> Result<VolumeFile, Fault> {
        if let Some(size) = rule.size {
            let unit =
                |axis: usize| scale(dot(self.edges[axis], self.edges[axis]).sqrt().recip(), self.edges[axis]);
            let edges = std::array::from_fn(|axis| scale(size[axis], unit(axis)));
            // The corner of the first voxel follows from its centre.
            let half =
                |edges: &[[f64; 3]; 3]| scale(0.5, edges.iter().fold([0.0; 3], |sum, edge| add(sum, *edge)));
            if self.corner != [0.0; 3] {
                self.corner = add(add(self.corner, half(&self.edges)), scale(-1.0, half(&edges)));
            }
            self.edges = edges;
        }
        let labels = rule.threshold.is_none() && rule.density.is_none();
        if let Some(found) = self.values.iter().find(|value| labels && value.fract() != 0.0) {
            return Err(of_file(VoxelProblem::NoLabel { found: found.to_string() }));
        }
        let mut solid: Vec<bool> = self.values.iter().map(|value| rule.is_solid(*value)).collect();
        let (of_part, mut sizes) = parts::parts(self.sizes, &solid);
        let mut notes = self.notes(rule, &sizes);
        let dropped = sizes.iter().filter(|size| **size < rule.least).count();
        for (voxel, part) in of_part.iter().enumerate() {
            solid[voxel] = part.is_some_and(|part| sizes[part] >= rule.least);
        }
        if dropped > 0 {
            let lost: usize = sizes.iter().filter(|size| **size < rule.least).sum();
            notes.push(format!(
                "{dropped} parts of fewer than {} voxels are left out ({lost} voxels)",
                rule.least
            ));
            sizes.retain(|size| *size >= rule.least);
        }
        let count = solid.iter().filter(|solid| **solid).count();
        if count == 0 {
            return Err(of_file(VoxelProblem::Nothing));
        }
        if count > MOST_SOLID {
            let problem = VoxelProblem::TooMany { count: format!("{count} solid voxels"), limit: MOST_SOLID };
            return Err(of_file(problem));
        }
        memory::ask(OF_VOXEL * count as f64)
            .map_err(|problem| (Place::File, MeshProblem::Memory(problem)))?;
        let mut mesh = self.hexahedra(&solid);
        for (node, place) in mesh.node_labels.iter().zip(&mesh.nodes) {
            finite(*node, *place).map_err(|problem| (Place::File, problem))?;
        }
        mesh.sets = self.sets(&solid, &of_part, sizes.len());
        let densities = rule.density.as_ref().map(|rule| self.densities(&solid, rule)).transpose();
        let densities = densities.map_err(of_file)?;
        notes.extend(densities.as_deref().map(density::told));
        Ok(VolumeFile { mesh, notes, densities })
    }

    /// Densities of the solid voxels.
    fn densities(&self, solid: &[bool], rule: &DensityRule) -> Result<Vec<f64>, VoxelProblem> {
        let [x, y, _] = self.sizes;
        let of = |voxel: usize| match rule.of(self.values[voxel]) {
            density if density > 0.0 && density.is_finite() => Ok(density),
            density => Err(VoxelProblem::NoDensity {
                voxel: [voxel % x, voxel / x % y, voxel / (x * y)],
                value: self.values[voxel].to_string(),
                density: density.to_string(),
            }),
        };
        (0..solid.len()).filter(|voxel| solid[*voxel]).map(of).collect()
    }

    fn notes(&self, rule: &VoxelRule, parts: &[usize]) -> Vec<String> {
        let length = |edge: &[f64; 3]| dot(*edge, *edge).sqrt();
        let [x, y, z] = [0, 1, 2].map(|axis| length(&self.edges[axis]));
        let solid: usize = parts.iter().sum();
        let what = match (rule.threshold, &rule.density) {
            (Some(threshold), _) => format!("at or above {threshold}"),
            (None, Some(_)) => "of a density above 0".to_owned(),
            (None, None) => "with another label than 0".to_owned(),
        };
        let mut notes = vec![format!(
            "{solid} of {} voxels of {x} by {y} by {z} (in the unit of the file) are solid, {what}",
            self.values.len()
        )];
        if parts.len() > 1 {
            let first: Vec<String> = parts.iter().take(5).map(usize::to_string).collect();
            let more = if parts.len() > 5 { ", …" } else { "" };
            notes.push(format!(
                "{} parts that no face joins, of {}{more} voxels: the sets part=1, part=2, …; `least_voxels` leaves out specks",
                parts.len(),
                first.join(", ")
            ));
        }
        notes
    }

    /// One hexahedron for each solid voxel, and the corners that they name, each once.
    fn hexahedra(&self, solid: &[bool]) -> Mesh {
        let [x, y, _] = self.sizes;
        let right = dot(cross(self.edges[0], self.edges[1]), self.edges[2]) > 0.0;
        let mut mesh = Mesh::default();
        let mut node_of: HashMap<usize, usize> = HashMap::new();
        for voxel in (0..solid.len()).filter(|voxel| solid[*voxel]) {
            let [i, j, k] = [voxel % x, voxel / x % y, voxel / (x * y)];
            let mut corner = |[a, b, c]: [usize; 3]| {
                let at = [i + a, j + b, k + c];
                let key = (at[2] * (y + 1) + at[1]) * (x + 1) + at[0];
                *node_of.entry(key).or_insert_with(|| {
                    let along = |axis: usize| scale(at[axis] as f64, self.edges[axis]);
                    mesh.nodes.push(add(self.corner, add(add(along(0), along(1)), along(2))));
                    mesh.node_labels.push(key as u64 + 1);
                    mesh.nodes.len() - 1
                })
            };
            let mut face = |c: usize| [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[a, b]| corner([a, b, c]));
            let [lower, upper] = [0, 1].map(&mut face);
            let nodes = if right { [lower, upper] } else { [upper, lower] }.concat();
            mesh.cells.push(Cell { label: voxel as u64 + 1, shape: Shape::Hex8, nodes: nodes.into() });
        }
        mesh
    }

    /// Sets of the labels and of the parts, by the indices of the cells.
    fn sets(&self, solid: &[bool], of_part: &[Option<usize>], parts: usize) -> Vec<Set> {
        let (mut labels, mut pieces): (BTreeMap<i64, Vec<usize>>, _) =
            (BTreeMap::new(), vec![Vec::new(); parts]);
        for (cell, voxel) in (0..solid.len()).filter(|voxel| solid[*voxel]).enumerate() {
            let value = self.values[voxel];
            if value.fract() == 0.0 && labels.len() <= MOST_LABELS {
                labels.entry(value as i64).or_default().push(cell);
            }
            if let Some(piece) = of_part[voxel].and_then(|part| pieces.get_mut(part)) {
                piece.push(cell);
            }
        }
        let set = |name: String, cells: Vec<usize>| Set { name, nodes: Vec::new(), cells };
        let whole = labels.len() <= MOST_LABELS && self.values.iter().all(|value| value.fract() == 0.0);
        let labels = labels.into_iter().filter(|_| whole);
        let mut sets: Vec<Set> = labels.map(|(label, cells)| set(format!("value={label}"), cells)).collect();
        if parts > 1 {
            let pieces = pieces.into_iter().take(MOST_PARTS).enumerate();
            sets.extend(pieces.map(|(part, cells)| set(format!("part={}", part + 1), cells)));
        }
        sets
    }
}
