//! Curved paths point by point: second order of beams, masses and springs as few fields of their own.
//! The full system needs them at large displacements, where moments of second order alone leave the mass matrix indefinite.
//! Equations (K6), (K7) and (K12), docs/theory/12-structures.md.

use nalgebra::{DMatrix, DVector, Matrix3, Matrix3xX, Matrix4, SMatrix, Vector3, Vector4};

use super::discrete::Discrete;
use super::follower_paths::FollowerPaths;
use super::loads::{Acceleration, LOADS};
use super::lumped_masses::MassProperties;
use super::node_paths::{NodePath, RigidPart};
use super::pairs::Pairs;
use super::solver::Solver;
use crate::finite::{Element, LumpedMass, MassLocation, Turn, carried};

/// Second order of the paths of all points, `½ G_jk q_j q_k = Σ_e Ψ_e ½ qᵀΓ^e q`, as few fields `Ψ_e` with a unit mass each. (K12)
#[derive(Clone, Debug)]
pub(super) struct Paths {
    /// `∫ Ψ_e dm`.
    pub sums: Vec<Vector3<f64>>,
    /// `∫ s Ψ_eᵀ dm`, with `s` from the centre of mass.
    pub moments: Vec<Matrix3<f64>>,
    /// `∫ Ψ_e u_jᵀ dm` with the displacements of the coordinates, then with the fields themselves.
    pub products: Vec<Vec<Matrix3<f64>>>,
    /// `Γ^e`, symmetric.
    pub forms: Vec<DMatrix<f64>>,
}

/// Share of the largest field, at equal elastic energy of the coordinates, below which a field of the second order stays with (I6) alone:
/// its own terms matter at displacements larger by the inverse.
const NEGLIGIBLE: f64 = 1e-3;

impl Discrete<'_> {
    /// Second order of the paths, if they are curved and every element is a beam, a mass or a spring: then each point is known, and the
    /// fields are few. (K12)
    ///
    /// `energies` are the stiffness of each field with itself. With them the paths of the nodes `kept`.
    pub(super) fn paths(
        &self,
        solver: &Solver,
        whole: &MassProperties,
        fields: &DMatrix<f64>,
        energies: &[f64],
        followers: &FollowerPaths,
        kept: &[usize],
    ) -> Option<(Paths, Vec<NodePath>)> {
        let elements = &self.structure.elements;
        if fields.nrows() == 0 || !elements.iter().all(|element| slender(element.as_ref())) {
            return None;
        }
        let pairs = Pairs(fields.nrows());
        let spread = |element: &dyn Element, rows: &DMatrix<f64>| {
            self.dofs.spread(element.nodes(), element.dofs(), rows)
        };
        let mut forces = DMatrix::zeros(pairs.count(), fields.ncols());
        let mut inner = Vec::new();
        for element in elements {
            if let Some(path) = followers.spread(element.as_ref()) {
                let strained = -path * element.stiffness();
                self.dofs.gather(element.nodes(), element.dofs(), &strained, &mut forces);
            }
            let Some(bent) = Bent::of(element.as_ref(), &spread(element.as_ref(), fields), &pairs) else {
                inner.push(None);
                continue;
            };
            self.dofs.gather(element.nodes(), element.dofs(), &bent.forces, &mut forces);
            inner.push(Some(bent));
        }
        if inner.iter().all(Option::is_none) {
            return None;
        }
        let second = solver.answers(forces);
        let mut points = Points::default();
        for (element, bent) in elements.iter().zip(&inner) {
            let mut own = [fields, &second].map(|rows| spread(element.as_ref(), rows));
            if let Some(path) = followers.spread(element.as_ref()) {
                own[1] += path;
            }
            for lumped_mass in element.lumped_masses() {
                points.push(&lumped_mass, whole.center, &own, bent.as_ref(), &pairs);
            }
        }
        let scales: Vec<f64> =
            pairs.iter().map(|(j, k)| (energies[j] * energies[k]).sqrt().recip()).collect();
        let mut of_points = Points::rows(&points.second, pairs.count());
        let rigid = solver.floats().then(|| {
            let shares = points.settle(&mut of_points);
            RigidPart { center: whole.center, shares }
        });
        let nodes = self.node_paths(kept, &second, followers, rigid.as_ref(), &pairs);
        Some((points.paths(&of_points, &scales, &pairs), nodes))
    }
}

/// Whether an element is a line or a point of known masses.
fn slender(element: &dyn Element) -> bool {
    element.nodes().len() <= 2
        && element
            .lumped_masses()
            .iter()
            .all(|lumped_mass| matches!(lumped_mass.location, MassLocation::At(_)))
}

/// Second order of an element's strains: the forces and displacements that keep them.
struct Bent {
    /// Forces on the element's degrees of freedom that keep its strains, a row for each pair.
    forces: DMatrix<f64>,
    /// Mean place of the element's masses.
    center: Vector3<f64>,
    /// Displacement between the nodes of the element, beside the responses to the forces, of each pair: linear in the place.
    between: Vec<SMatrix<f64, 3, 4>>,
}

impl Bent {
    fn of(element: &dyn Element, own: &DMatrix<f64>, pairs: &Pairs) -> Option<Self> {
        let size = own.ncols();
        let works = |displacement: &DVector<f64>, force: &dyn Fn(Vector3<f64>) -> Vector3<f64>| {
            let geometric = element.geometric(displacement, force)?;
            let works = -(own * geometric * own.transpose());
            Some(DVector::from_iterator(pairs.count(), pairs.iter().map(|(j, k)| works[(j, k)])))
        };
        let none = |_: Vector3<f64>| Vector3::zeros();
        let mut forces = DMatrix::zeros(pairs.count(), size);
        for dof in 0..size {
            let mut unit = DVector::zeros(size);
            unit[dof] = 1.0;
            forces.set_column(dof, &works(&unit, &none)?);
        }
        let lumped_masses = element.lumped_masses();
        let place = |lumped_mass: &LumpedMass| lumped_mass.place_from(Vector3::zeros());
        let mass: f64 = lumped_masses.iter().map(|lumped_mass| lumped_mass.mass).sum();
        let center = lumped_masses
            .iter()
            .map(|lumped_mass| lumped_mass.mass * place(lumped_mass))
            .sum::<Vector3<f64>>()
            / mass;
        let moments: Matrix4<f64> = lumped_masses
            .iter()
            .map(|lumped_mass| {
                let s = (place(lumped_mass) - center).insert_row(0, 1.0);
                lumped_mass.mass * s * s.transpose()
            })
            .sum();
        let inverse = moments.pseudo_inverse(f64::EPSILON * moments.amax()).ok()?;
        let still = DVector::zeros(size);
        let mut between = vec![SMatrix::zeros(); pairs.count()];
        for load in 0..LOADS {
            let acceleration = Acceleration::of_load(load);
            let works = works(&still, &|at| acceleration.at(at - center, 1.0))?;
            for (field, work) in between.iter_mut().zip(works.iter()) {
                field[(load % 3, load / 3)] = *work;
            }
        }
        between.iter_mut().for_each(|works: &mut SMatrix<f64, 3, 4>| *works *= inverse);
        Some(Self { forces, center, between })
    }
}

/// Displacements of all masses, times the root of each mass.
#[derive(Default)]
struct Points {
    masses: Vec<f64>,
    /// Places from the centre of mass.
    places: Vec<Vector3<f64>>,
    /// Displacements of the coordinates and of the pairs: a matrix with a column for each.
    first: Vec<Matrix3xX<f64>>,
    second: Vec<Matrix3xX<f64>>,
}

impl Points {
    fn push(
        &mut self,
        lumped_mass: &LumpedMass,
        center: Vector3<f64>,
        [first, second]: &[DMatrix<f64>; 2],
        bent: Option<&Bent>,
        pairs: &Pairs,
    ) {
        let root = lumped_mass.mass.sqrt();
        let place = lumped_mass.place_from(Vector3::zeros());
        let mut curved: Matrix3xX<f64> = &lumped_mass.shapes * second.transpose();
        if let Some(bent) = bent {
            let s = Vector4::from((place - bent.center).insert_row(0, 1.0));
            for (mut column, between) in curved.column_iter_mut().zip(&bent.between) {
                column += between * s;
            }
        }
        if let Some(Turn { arm, shapes }) = &lumped_mass.turn {
            let rotations: Matrix3xX<f64> = shapes * first.transpose();
            for (mut column, (j, k)) in curved.column_iter_mut().zip(pairs.iter()) {
                let (a, b): (Vector3<f64>, Vector3<f64>) =
                    (rotations.column(j).into(), rotations.column(k).into());
                column += carried(&a, &b, arm);
            }
        }
        self.masses.push(lumped_mass.mass);
        self.places.push(place - center);
        self.first.push(root * &lumped_mass.shapes * first.transpose());
        self.second.push(root * curved);
    }

    /// Numbers of all points in a row for each column.
    fn rows(columns: &[Matrix3xX<f64>], count: usize) -> DMatrix<f64> {
        let mut rows = DMatrix::zeros(3 * columns.len(), count);
        for (point, column) in columns.iter().enumerate() {
            rows.rows_mut(3 * point, 3).copy_from(column);
        }
        rows
    }

    fn paths(&self, second: &DMatrix<f64>, scales: &[f64], pairs: &Pairs) -> Paths {
        let first = Self::rows(&self.first, pairs.0);
        let fields = independent(second, scales);
        let shares = fields.transpose() * second;
        let forms = shares.row_iter().map(|row| pairs.symmetric(row.iter().copied()));
        let at = |matrix: &DMatrix<f64>, point: usize, e: usize| -> Vector3<f64> {
            matrix.fixed_view::<3, 1>(3 * point, e).into()
        };
        let points = || self.masses.iter().map(|mass| mass.sqrt()).zip(&self.places).enumerate();
        let sums = (0..fields.ncols()).map(|e| points().map(|(i, (root, _))| root * at(&fields, i, e)).sum());
        let moments = (0..fields.ncols())
            .map(|e| points().map(|(i, (root, s))| root * s * at(&fields, i, e).transpose()).sum());
        let product = |e: usize, other: &DMatrix<f64>, j: usize| -> Matrix3<f64> {
            points().map(|(i, _)| at(&fields, i, e) * at(other, i, j).transpose()).sum()
        };
        let products = (0..fields.ncols()).map(|e| {
            let coordinates = (0..first.ncols()).map(|j| product(e, &first, j));
            coordinates.chain((0..fields.ncols()).map(|f| product(e, &fields, f))).collect()
        });
        Paths {
            sums: sums.collect(),
            moments: moments.collect(),
            products: products.collect(),
            forms: forms.collect(),
        }
    }

    /// Removes the rigid part of displacements, and returns it: the second order keeps linear and angular momentum at zero like the first.
    /// (K7)
    fn settle(&self, columns: &mut DMatrix<f64>) -> DMatrix<f64> {
        let mut rigid = DMatrix::zeros(columns.nrows(), 6);
        for (point, (mass, s)) in self.masses.iter().zip(&self.places).enumerate() {
            let mut block = rigid.fixed_view_mut::<3, 6>(3 * point, 0);
            block.fixed_columns_mut::<3>(0).copy_from(&(mass.sqrt() * Matrix3::identity()));
            block.fixed_columns_mut::<3>(3).copy_from(&(-mass.sqrt() * s.cross_matrix()));
        }
        let inverse = (rigid.transpose() * &rigid).try_inverse().unwrap_or_else(|| DMatrix::zeros(6, 6));
        let shares = inverse * rigid.transpose() * &*columns;
        *columns -= rigid * &shares;
        shares
    }
}

/// Orthonormal columns that span these columns but for negligible ones, measured with their scales: Gram–Schmidt, the largest first.
fn independent(columns: &DMatrix<f64>, scales: &[f64]) -> DMatrix<f64> {
    let mut rest = columns.clone();
    for (mut column, scale) in rest.column_iter_mut().zip(scales) {
        column *= *scale;
    }
    let mut found: Vec<DVector<f64>> = Vec::new();
    let mut largest = None;
    while found.len() < columns.nrows().min(columns.ncols()) {
        let norms = rest.column_iter().map(|column| column.norm());
        let Some((next, norm)) = norms.enumerate().max_by(|a, b| a.1.total_cmp(&b.1)) else { break };
        if !(norm > NEGLIGIBLE * *largest.get_or_insert(norm)) {
            break;
        }
        let mut direction: DVector<f64> = rest.column(next) / norm;
        for known in &found {
            direction -= known * known.dot(&direction);
        }
        direction.normalize_mut();
        let shares = direction.transpose() * &rest;
        rest.gemm(-1.0, &direction, &shares, 1.0);
        found.push(direction);
    }
    DMatrix::from_fn(columns.nrows(), found.len(), |row, column| found[column][row])
}
