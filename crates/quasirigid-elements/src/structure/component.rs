//! Component: a structure condensed to few coordinates, with its invariants, matrices and curved paths.
//! Products of fields over lumped masses are made once, at the centre of mass; any pole and numbering follow from them.
//! Equations (I2) to (I6), (K8) and (K12), docs/theory.

use std::collections::HashMap;

use nalgebra::{DMatrix, Matrix3, Vector3};

use super::basis::Basis;
use super::curvature::Curvature;
use super::discrete::{Discrete, Structure};
use super::dofs::{Dofs, Unknown};
use super::follower_paths::FollowerPaths;
use super::loads::{Acceleration, LOADS, balanced, moments, stretching};
use super::losses::blocks;
use super::lumped_masses::MassProperties;
use super::masses::MassNormalized;
use super::node_paths::NodePath;
use super::owned;
use super::paths::Paths;
use super::solver::{Solver, Unsolved};
use crate::math::eigen::NoConvergence;
use crate::math::memory::{self, TooMuchMemory};
use crate::math::sparse::SparseRows;
use crate::math::sym3::Sym;
use crate::model::moment;
use crate::model::{Coordinate, CurvedPaths, Follower, Invariants, Pair, PartMass};
use crate::structure::Block;
use crate::structure::Condensation;

/// Structure in few coordinates, each of them a displacement scaled to its rms. (K8)
#[derive(Clone, Debug)]
pub(crate) struct Component {
    /// Mass and second moments.
    whole: MassProperties,
    /// `∫ u_j dm`.
    sums: Vec<Vector3<f64>>,
    /// `∫ s u_jᵀ dm`, with `s` from the centre of mass.
    moments: Vec<Matrix3<f64>>,
    /// `∫ u_j u_kᵀ dm`.
    products: Vec<Vec<Matrix3<f64>>>,
    /// Mass matrix: the traces of the products, and the inertia of DOFs that have no displacement.
    masses: DMatrix<f64>,
    /// Mass matrix of each part.
    owned: Vec<(String, DMatrix<f64>)>,
    /// Curvature of the paths of each pair; none if they are straight.
    curvatures: Option<Vec<Vec<Curvature>>>,
    /// Second order of the paths point by point; none if they are straight, or those of a panel or a solid.
    paths: Option<Paths>,
    /// Stiffness, damping and rheology of each dissipator.
    blocks: Vec<Block>,
    /// Displacement of each kept node per unit of each coordinate.
    kept_nodes: Vec<Vec<[f64; 3]>>,
    /// Curved paths of kept nodes, by their numbers; of a node that is not among them the path is straight.
    node_paths: HashMap<usize, NodePath>,
    /// Rotation of each kept node, where it has one.
    rotations: Vec<Option<Vec<[f64; 3]>>>,
    /// Number of unknowns of the structure.
    unknowns: usize,
    /// Largest share of the energy of a response that the coordinates do not hold.
    left_out: f64,
}

/// Fault of a structure that cannot be condensed.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Fault {
    /// A motion of these unknowns, largest first, meets no stiffness.
    Loose(Vec<Unknown>),
    /// The lowest modes are not found.
    NoConvergence(NoConvergence),
    /// The unknowns, so many, need more memory than there is.
    Memory(usize, TooMuchMemory),
}

/// Options of a condensation.
#[derive(Clone, Debug)]
pub(crate) struct CondensationOptions<'a> {
    /// Order to which the slow manifold is exact.
    pub order: usize,
    /// Number of lowest modes of vibration beside it.
    pub modes: usize,
    /// Whether the structure floats; else it is on its carrier.
    pub floating: bool,
    /// Nodes whose displacements are kept.
    pub kept_nodes: &'a [usize],
    /// Loads of other elements at each of them.
    pub loads: &'a [Load],
}

/// Load of other elements at a node.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Load {
    /// Whether a force acts there.
    pub force: bool,
    /// Whether a moment acts there.
    pub moment: bool,
}

/// Share of the largest unknown below which unknowns take no part in a motion.
const PART: f64 = 0.1;
/// Most nodes whose curved paths are told though nothing loads them.
const WATCHED: usize = 64;
/// Fields of displacement and of force that are in memory at once for each load, at least.
const COPIES: f64 = 6.0;

impl Structure {
    /// Component: the structure condensed to few coordinates.
    ///
    /// # Errors
    /// [`Fault`] if some motion meets no stiffness, or modes are not found.
    pub fn component(&self, dofs: Dofs, options: &CondensationOptions<'_>) -> Result<Component, Fault> {
        let unknowns = dofs.unknowns().len();
        let room = |cause| Fault::Memory(unknowns, cause);
        let discrete = Discrete::new(self, dofs).map_err(room)?;
        let solver = Solver::new(&discrete, options.floating).map_err(|fault| match fault {
            Unsolved::Singular(singular) => loose(&discrete.dofs, &singular.direction),
            Unsolved::Memory(cause) => room(cause),
        })?;
        let fields = LOADS + options.loaded().count();
        memory::ask((unknowns * fields * size_of::<f64>()) as f64 * COPIES).map_err(room)?;
        let whole = discrete.whole();
        let reference = whole.center;
        let forces = discrete.loads(reference);
        let (loads, statics) = if options.floating {
            (balanced(&whole), solver.answers(stretching(&forces)))
        } else {
            ((0..LOADS).map(Acceleration::of_load).collect(), solver.answers(forces.clone()))
        };
        let pulls = solver.answers(discrete.unit_forces(&options.loaded().collect::<Vec<_>>()));
        let wanted = stacked(&statics, &pulls);
        let mut basis = Basis::new(&discrete, &solver, &wanted, options.order);
        basis.append(&discrete, &solver.modes(&discrete, options.modes).map_err(Fault::NoConvergence)?);
        let MassNormalized { fields, masses } =
            MassNormalized::new(&discrete, basis.displacements(forces.ncols()), whole.mass);
        let works = &fields * forces.transpose();
        let energies: Vec<f64> =
            fields.row_iter().map(|field| energy(&discrete, &field.into_owned())).collect();
        let first = works.row_iter().map(|works| moments(&works.iter().copied().collect::<Vec<f64>>()));
        let (sums, moments) = first.unzip();
        let curved: Vec<usize> = options.curved().map(|number| options.kept_nodes[number]).collect();
        memory::ask(FollowerPaths::room(self, fields.nrows())).map_err(room)?;
        let followers = discrete.follower_paths(&fields);
        let (paths, node_paths) =
            match discrete.paths(&solver, &whole, &fields, &energies, &followers, &curved) {
                Some((paths, of_nodes)) => (Some(paths), Some(of_nodes)),
                None => (None, discrete.node_paths_by_work(&solver, &whole, &curved, &fields, &followers)),
            };
        let of_loads = discrete.works(reference, &loads, &statics, &fields, &followers);
        Ok(Component {
            whole,
            paths,
            node_paths: options.curved().zip(node_paths.into_iter().flatten()).collect(),
            sums,
            moments,
            products: by_pair(&discrete.products(&fields)),
            masses,
            curvatures: of_loads.map(|works| Curvature::of_pairs(&works)),
            owned: owned::masses(&discrete, &fields),
            blocks: blocks(&discrete, &fields),
            kept_nodes: options.kept_nodes.iter().map(|node| motion(&discrete, &fields, *node, 0)).collect(),
            rotations: options
                .kept_nodes
                .iter()
                .map(|node| self.nodes[*node].rotations.then(|| motion(&discrete, &fields, *node, 3)))
                .collect(),
            unknowns: fields.ncols(),
            left_out: basis.left_out,
        })
    }
}

impl Component {
    /// Number of coordinates.
    pub fn size(&self) -> usize {
        self.sums.len()
    }

    /// Condensation: numbers of unknowns and coordinates, and the energy left out.
    pub fn condensation(&self) -> Condensation {
        Condensation { unknowns: self.unknowns, coordinates: self.size(), left_out: self.left_out }
    }

    /// Mass (kg).
    pub fn mass(&self) -> f64 {
        self.whole.mass
    }

    /// Centre of mass (m), in the file's frame.
    pub fn center(&self) -> Vector3<f64> {
        self.whole.center
    }

    /// Inertia tensor about a pole.
    pub fn inertia(&self, pole: Vector3<f64>) -> Sym {
        let MassProperties { mass, center, second } = &self.whole;
        let arm = center - pole;
        moment::inertia(&(second + *mass * arm * arm.transpose())).map(|entry| 0.5 * entry)
    }

    /// `S_j`, `h_j` and `J_j` about a pole. (I2), (I3)
    pub fn coordinate(&self, j: usize, pole: Vector3<f64>) -> ([f64; 3], [f64; 3], Sym) {
        let W = self.moments[j] + (self.whole.center - pole) * self.sums[j].transpose();
        (self.sums[j].into(), moment::cross(&W), moment::inertia(&W))
    }

    fn straight_pair(&self, j: usize, k: usize) -> Pair {
        Pair { A: self.masses[(j, k)], ..moment::straight_pair(&self.products[j][k]) }
    }

    /// Invariants of two coordinates about a pole. (I4)–(I6)
    pub fn pair(&self, j: usize, k: usize, pole: Vector3<f64>) -> Pair {
        let straight = self.straight_pair(j, k);
        let Some(curvatures) = &self.curvatures else { return straight };
        let Curvature { sum, moment } = curvatures[j][k];
        let G = moment + (self.whole.center - pole) * sum.transpose();
        moment::curved_pair(straight, sum.into(), &G)
    }

    /// Invariants of all pairs about a pole, for coordinates numbered from `start`.
    pub fn pairs(&self, pole: Vector3<f64>, start: usize) -> impl Iterator<Item = (usize, usize, Pair)> + '_ {
        let size = self.size();
        (0..size * size).map(move |entry| {
            let (j, k) = (entry / size, entry % size);
            (start + j, start + k, self.pair(j, k, pole))
        })
    }

    /// Curved paths with all effects of their second order, in a body with these invariants; coordinates are numbered from `start`. (K12)
    pub fn curved_paths(&self, pole: Vector3<f64>, start: usize, body: &Invariants) -> Option<CurvedPaths> {
        let paths = self.paths.as_ref()?;
        let (own, first) = (start..start + self.size(), body.S.len());
        let arm = self.whole.center - pole;
        let mut whole = body.clone();
        let others = body.pairs.iter().filter(|(j, k, _)| !(own.contains(j) && own.contains(k)));
        let mut pairs: Vec<(usize, usize, Pair)> = others.map(|(j, k, pair)| (j, k, *pair)).collect();
        for (j, k) in own.clone().flat_map(|j| own.clone().map(move |k| (j, k))) {
            pairs.push((j, k, self.rest(j - start, k - start, pole, paths)));
        }
        for (e, (sum, moment)) in paths.sums.iter().zip(&paths.moments).enumerate() {
            let W = moment + arm * sum.transpose();
            whole.S.push((*sum).into());
            whole.h.push(moment::cross(&W));
            whole.J1.push(moment::inertia(&W));
            for (other, W) in paths.products[e].iter().enumerate() {
                let fields = other.checked_sub(self.size());
                let place = fields.map_or(start + other, |field| first + field);
                pairs.push((first + e, place, moment::straight_pair(W)));
                if fields.is_none() {
                    pairs.push((place, first + e, moment::straight_pair(&W.transpose())));
                }
            }
        }
        whole.pairs = SparseRows::sum(whole.S.len(), pairs);
        let forms = paths.forms.iter().map(|form| form.as_slice().to_vec()).collect();
        let follower = Follower::Quadratic { coordinates: own, forms };
        Some(CurvedPaths { straight: whole, followers: vec![follower] })
    }

    /// Invariants of two coordinates without the contribution of the fields of the second order.
    fn rest(&self, j: usize, k: usize, pole: Vector3<f64>, paths: &Paths) -> Pair {
        let mut rest = self.pair(j, k, pole);
        for ((sum, moment), form) in paths.sums.iter().zip(&paths.moments).zip(&paths.forms) {
            let W = form[(j, k)] * (moment + (self.whole.center - pole) * sum.transpose());
            let (grown, turned) = (moment::inertia(&W), moment::cross(&W));
            rest.J2.iter_mut().zip(grown).for_each(|(rest, part)| *rest -= 0.5 * part);
            rest.Z.iter_mut().zip(turned).for_each(|(rest, part)| *rest -= part);
        }
        rest
    }

    /// Coordinates of the component, by name.
    pub fn coordinates(&self) -> Vec<Coordinate> {
        (1..=self.size()).map(|number| Coordinate { name: format!("shape {number}"), unit: "m" }).collect()
    }

    /// Stiffness, damping and rheology, for coordinates numbered from `start`.
    pub fn blocks(&self, start: usize) -> impl Iterator<Item = Block> + '_ {
        self.blocks.iter().map(move |block| Block {
            name: block.name.clone(),
            columns: block.columns.iter().map(|column| start + column).collect(),
            stiffness: block.stiffness.clone(),
            damping: block.damping.clone(),
            rheology: block.rheology.clone(),
        })
    }

    /// Mass of each part over the coordinates, numbered from `start`, of a body that has so many.
    pub fn part_masses(&self, start: usize, all: usize) -> Vec<PartMass> {
        let entries = |mass: &DMatrix<f64>| {
            let places = (0..mass.nrows()).flat_map(|j| (0..mass.ncols()).map(move |k| (j, k)));
            places.map(|(j, k)| (start + j, start + k, mass[(j, k)])).collect()
        };
        let part = |(name, mass): &(String, DMatrix<f64>)| PartMass {
            name: name.clone(),
            mass: SparseRows::sum(all, entries(mass)),
        };
        self.owned.iter().map(part).collect()
    }

    /// Displacement of a kept node per unit of each coordinate, numbered from `start`.
    pub fn shapes(&self, node: usize, start: usize) -> Vec<(usize, [f64; 3])> {
        numbered(&self.kept_nodes[node], start)
    }

    /// Curvature `G_jk` of the path of a kept node for pairs of coordinates, numbered from `start`, in both orders. (K6)
    pub fn curvature(&self, node: usize, start: usize) -> Vec<(usize, usize, [f64; 3])> {
        let Some(path) = self.node_paths.get(&node) else { return Vec::new() };
        let pairs = (0..self.size()).flat_map(|j| (0..self.size()).map(move |k| (j, k)));
        let curved = pairs.map(|(j, k)| (start + j, start + k, path.each_ref().map(|form| form[(j, k)])));
        curved.filter(|(.., G)| *G != [0.0; 3]).collect()
    }

    /// Rotation of a kept node per unit of each coordinate, numbered from `start`; none of a node without rotations.
    pub fn rotations(&self, node: usize, start: usize) -> Option<Vec<(usize, [f64; 3])>> {
        self.rotations[node].as_ref().map(|rotations| numbered(rotations, start))
    }
}

impl CondensationOptions<'_> {
    /// Numbers of the kept nodes whose curved paths are told: those that are loaded, and those that are watched, if they are few.
    fn curved(&self) -> impl Iterator<Item = usize> + '_ {
        let all = self.loads.len() <= WATCHED;
        let loads = self.loads.iter().enumerate();
        loads.filter(move |(_, load)| all || load.force || load.moment).map(|(number, _)| number)
    }

    /// Nodes and components, 0 to 5, at which other elements load the structure.
    fn loaded(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.kept_nodes.iter().zip(self.loads).flat_map(|(node, load)| {
            let forces = (0..3).filter(|_| load.force);
            let moments = (3..6).filter(|_| load.moment);
            forces.chain(moments).map(|component| (*node, component))
        })
    }
}

fn numbered(shapes: &[[f64; 3]], start: usize) -> Vec<(usize, [f64; 3])> {
    shapes.iter().enumerate().map(|(j, shape)| (start + j, *shape)).collect()
}

fn stacked(above: &DMatrix<f64>, below: &DMatrix<f64>) -> DMatrix<f64> {
    let mut all = DMatrix::zeros(above.nrows() + below.nrows(), above.ncols());
    all.rows_mut(0, above.nrows()).copy_from(above);
    all.rows_mut(above.nrows(), below.nrows()).copy_from(below);
    all
}

fn energy(discrete: &Discrete<'_>, field: &nalgebra::RowDVector<f64>) -> f64 {
    field.dot(&nalgebra::RowDVector::from_vec(discrete.total.times(field.as_slice())))
}

fn by_pair(products: &[DMatrix<f64>; 9]) -> Vec<Vec<Matrix3<f64>>> {
    let count = products[0].nrows();
    let pair = |j: usize, k: usize| Matrix3::from_fn(|a, b| products[3 * a + b][(j, k)]);
    (0..count).map(|j| (0..count).map(|k| pair(j, k)).collect()).collect()
}

/// Three components of the motion of a node from the first on, per unit of each field.
fn motion(discrete: &Discrete<'_>, fields: &DMatrix<f64>, node: usize, first: usize) -> Vec<[f64; 3]> {
    let component = |component: usize, j: usize| {
        let row = discrete.dofs.row(node, component).iter();
        row.map(|(unknown, share)| share * fields[(j, *unknown)]).sum()
    };
    (0..fields.nrows()).map(|j| [0, 1, 2].map(|axis| component(first + axis, j))).collect()
}

fn loose(dofs: &Dofs, direction: &[f64]) -> Fault {
    let mut moving: Vec<usize> = (0..direction.len()).filter(|i| direction[*i].abs() > PART).collect();
    moving.sort_by(|a, b| direction[*b].abs().total_cmp(&direction[*a].abs()));
    Fault::Loose(moving.into_iter().map(|i| dofs.unknowns()[i]).collect())
}
