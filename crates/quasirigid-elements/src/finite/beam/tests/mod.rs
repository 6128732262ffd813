//! Beams against closed forms: chains of elements, skew in space.

mod antenna;
mod buckling;
mod second_order;
mod spinning;
mod statics;
mod vibration;
mod whole;

use nalgebra::{DMatrix, DVector, Vector3};

use super::forces::Load;
use super::{Beam, BeamMaterial, Matrix12, Section, SectionShape, Vector12};

impl Beam {
    /// Geometric stiffness under loads at the nodes alone, so that the axial force is constant.
    fn geometric(&self, u: &Vector12) -> Matrix12 {
        self.geometric_under(u, Load::default())
    }
}

/// A straight line of elements.
struct Chain {
    beams: Vec<Beam>,
}

impl Chain {
    /// Elements of one length.
    fn even(
        ends: [[f64; 3]; 2],
        direction: [f64; 3],
        section: Section,
        material: BeamMaterial,
        count: usize,
    ) -> Self {
        let cuts: Vec<f64> = (0..=count).map(|i| i as f64 / count as f64).collect();
        Self::cut(ends, direction, section, material, &cuts)
    }

    /// Elements between these fractions of the length.
    fn cut(
        ends: [[f64; 3]; 2],
        direction: [f64; 3],
        section: Section,
        material: BeamMaterial,
        cuts: &[f64],
    ) -> Self {
        let [from, to] = ends.map(Vector3::from);
        let at = |cut: f64| (from + cut * (to - from)).into();
        let beam =
            |pair: &[f64]| Beam::new([at(pair[0]), at(pair[1])], Some(direction), section, material).unwrap();
        Self { beams: cuts.windows(2).map(beam).collect() }
    }

    fn size(&self) -> usize {
        6 * self.beams.len() + 6
    }

    fn sum(&self, matrix: impl Fn(&Beam) -> Matrix12) -> DMatrix<f64> {
        self.sum_by_place(|_, beam| matrix(beam))
    }

    fn sum_by_place(&self, matrix: impl Fn(usize, &Beam) -> Matrix12) -> DMatrix<f64> {
        let mut sum = DMatrix::zeros(self.size(), self.size());
        for (i, beam) in self.beams.iter().enumerate() {
            let mut view = sum.view_mut((6 * i, 6 * i), (12, 12));
            view += matrix(i, beam);
        }
        sum
    }

    /// Places of the nodes.
    fn nodes(&self) -> Vec<Vector3<f64>> {
        let first = self.beams.iter().map(|beam| beam.ends[0]).take(1);
        first.chain(self.beams.iter().map(|beam| beam.ends[1])).collect()
    }

    /// Displacements under a load with the first node clamped.
    fn clamped(&self, load: &DVector<f64>) -> DVector<f64> {
        let size = self.size();
        let kept: Vec<usize> = (6..size).collect();
        let stiffness = part(&self.sum(Beam::stiffness), &kept);
        let free = stiffness.cholesky().unwrap().solve(&load.rows(6, size - 6).into_owned());
        DVector::from_fn(size, |i, _| if i < 6 { 0.0 } else { free[i - 6] })
    }
}

/// Coordinates of an element of a chain.
fn own(u: &DVector<f64>, element: usize) -> Vector12 {
    u.fixed_rows::<12>(6 * element).into_owned()
}

/// Rigid motion of all nodes: this translation and a rotation about the origin.
fn rigid(nodes: &[Vector3<f64>], velocity: Vector3<f64>, turn: Vector3<f64>) -> DVector<f64> {
    let of = |node: &Vector3<f64>| {
        (velocity + turn.cross(node)).iter().chain(turn.iter()).copied().collect::<Vec<_>>()
    };
    DVector::from_vec(nodes.iter().flat_map(of).collect())
}

/// Rows and columns of a matrix.
fn part(matrix: &DMatrix<f64>, kept: &[usize]) -> DMatrix<f64> {
    matrix.select_rows(kept).select_columns(kept)
}

/// Eigenvalues `λ` of `A x = λ B x`, ascending, and vectors with `xᵀBx = 1`.
fn eigen(A: &DMatrix<f64>, B: &DMatrix<f64>) -> (Vec<f64>, DMatrix<f64>) {
    let lower = B.clone().cholesky().unwrap().l();
    let half = lower.solve_lower_triangular(A).unwrap().transpose();
    let whole = lower.solve_lower_triangular(&half).unwrap();
    let system = (0.5 * (&whole + whole.transpose())).symmetric_eigen();
    let mut order: Vec<usize> = (0..A.nrows()).collect();
    order.sort_by(|a, b| system.eigenvalues[*a].total_cmp(&system.eigenvalues[*b]));
    let vectors = lower.tr_solve_lower_triangular(&system.eigenvectors.select_columns(&order)).unwrap();
    (order.iter().map(|i| system.eigenvalues[*i]).collect(), vectors)
}

/// Section without shear whose radii of gyration are so small that its rotary inertia is negligible.
fn thin(area: f64, radius_y: f64, radius_z: f64) -> Section {
    let [second_y, second_z] = [radius_y, radius_z].map(|radius| area * radius * radius);
    let torsion = 4.0 * second_y * second_z / (second_y + second_z);
    SectionShape::General { area, second_y, second_z, torsion, shear: None }.section(0.3).unwrap()
}

/// Orders of convergence of errors at numbers of elements that double.
fn orders(errors: &[f64]) -> Vec<f64> {
    errors.windows(2).map(|pair| (pair[0] / pair[1]).abs().log2()).collect()
}

const ALLOY: BeamMaterial = BeamMaterial { young: 71e9, shear: 27e9, density: 2800.0 };
