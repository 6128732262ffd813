//! A structure of shells with supports and loads, solved by a banded factor without pivots.

use nalgebra::{DMatrix, DVector, Vector3};

use super::super::{Ply, ShellSection, geometric, mass, stiffness};
use super::grid::Grid;

/// A homogeneous isotropic ply.
pub fn isotropic(young: f64, poisson: f64, thickness: f64) -> Ply {
    let shear = young / (2.0 * (1.0 + poisson));
    Ply { young: [young; 2], poisson, shear: [shear; 3], density: 1.0, thickness, angle: 0.0 }
}

pub fn section(young: f64, poisson: f64, thickness: f64) -> ShellSection {
    ShellSection::laminate(&[isotropic(young, poisson, thickness)], 0.0).unwrap()
}

/// Nodes with six degrees of freedom each; some are constrained, others loaded.
pub struct Structure {
    pub grid: Grid,
    pub section: ShellSection,
    pub reference: Vector3<f64>,
    pub held: Vec<bool>,
    pub load: DVector<f64>,
}

impl Structure {
    pub fn new(grid: Grid, section: ShellSection, reference: [f64; 3]) -> Self {
        let size = 6 * grid.nodes.len();
        Self {
            grid,
            section,
            reference: reference.into(),
            held: vec![false; size],
            load: DVector::zeros(size),
        }
    }

    /// Constrains degrees of freedom of the nodes at which `here` is true.
    pub fn hold(&mut self, dofs: &[usize], here: &dyn Fn(Vector3<f64>) -> bool) {
        for (index, place) in self.grid.nodes.iter().enumerate().filter(|(_, place)| here(**place)) {
            assert!(place.norm().is_finite());
            dofs.iter().for_each(|dof| self.held[6 * index + dof] = true);
        }
    }

    /// Adds a force per area (Pa) to all elements; every node bears the area around it.
    pub fn press(&mut self, pressure: &dyn Fn(Vector3<f64>) -> Vector3<f64>) {
        let unit = ShellSection { mass: 1.0, ..section(1.0, 0.0, 1.0) };
        for cell in &self.grid.cells {
            let mass = mass(self.grid.shape(), &self.grid.places(cell), &unit).unwrap();
            for (i, a) in cell.iter().enumerate() {
                let area: f64 = (0..cell.len()).map(|j| mass[(6 * i, 6 * j)]).sum();
                let force = area * pressure(self.grid.nodes[*a]);
                (0..3).for_each(|axis| self.load[6 * a + axis] += force[axis]);
            }
        }
    }

    /// Displacements under the load.
    pub fn answer(&self) -> DVector<f64> {
        let matrix = self
            .assembled(|nodes| stiffness(self.grid.shape(), nodes, self.reference, &self.section).unwrap());
        self.solved(&Banded::factor(matrix, &self.held), &self.load)
    }

    /// The smallest factor of the loads of `u` under which the structure buckles, by inverse iteration.
    pub fn buckling(&self, u: &DVector<f64>) -> f64 {
        let shape = self.grid.shape();
        let elastic = self.assembled(|nodes| stiffness(shape, nodes, self.reference, &self.section).unwrap());
        let mut cells = self.grid.cells.iter();
        let stress = self.assembled(|nodes| {
            let cell = cells.next().unwrap();
            let own = DVector::from_iterator(
                6 * cell.len(),
                cell.iter().flat_map(|i| (0..6).map(move |k| u[6 * i + k])),
            );
            geometric(shape, nodes, self.reference, &self.section, &own).unwrap()
        });
        let factor = Banded::factor(elastic, &self.held);
        let mut x =
            DVector::from_fn(u.len(), |i, _| if self.held[i] { 0.0 } else { 1.0 + 0.3 * (i as f64).sin() });
        let mut load = 0.0;
        for _ in 0..60 {
            let y = self.solved(&factor, &-stress.times(&x));
            load = x.dot(&x) / x.dot(&y);
            x = y.normalize();
        }
        load
    }

    fn solved(&self, factor: &Banded, load: &DVector<f64>) -> DVector<f64> {
        let free = DVector::from_fn(load.len(), |i, _| if self.held[i] { 0.0 } else { load[i] });
        factor.solve(free)
    }

    fn assembled(&self, mut element: impl FnMut(&[Vector3<f64>]) -> DMatrix<f64>) -> Banded {
        let reach = |cell: &Vec<usize>| cell.iter().max().unwrap() - cell.iter().min().unwrap();
        let band = 6 * (1 + self.grid.cells.iter().map(reach).max().unwrap());
        let mut matrix = Banded { band, rows: vec![0.0; self.load.len() * band] };
        for cell in &self.grid.cells {
            let part = element(&self.grid.places(cell));
            for (i, a) in cell.iter().enumerate() {
                for (j, b) in cell.iter().enumerate() {
                    for (k, l) in (0..6).flat_map(|k| (0..6).map(move |l| (k, l))) {
                        matrix.add(6 * a + k, 6 * b + l, part[(6 * i + k, 6 * j + l)]);
                    }
                }
            }
        }
        matrix
    }
}

/// Lower half of a symmetric matrix: row `i` holds the columns from `i − band + 1` to `i`.
struct Banded {
    band: usize,
    rows: Vec<f64>,
}

impl Banded {
    fn add(&mut self, row: usize, column: usize, value: f64) {
        if column <= row {
            self.rows[row * self.band + self.band - 1 + column - row] += value;
        }
    }

    fn times(&self, x: &DVector<f64>) -> DVector<f64> {
        let mut y = DVector::zeros(x.len());
        for row in 0..x.len() {
            for column in (row + 1).saturating_sub(self.band)..=row {
                let entry = self.rows[row * self.band + self.band - 1 + column - row];
                y[row] += entry * x[column];
                if column < row {
                    y[column] += entry * x[row];
                }
            }
        }
        y
    }

    /// Cholesky factor; rows of constrained degrees of freedom become those of the unit matrix.
    fn factor(mut self, held: &[bool]) -> Self {
        let (band, size) = (self.band, held.len());
        for row in 0..size {
            let start = (row + 1).saturating_sub(band);
            for column in start..=row {
                if held[row] || held[column] {
                    self.rows[row * band + band - 1 + column - row] = if row == column { 1.0 } else { 0.0 };
                    continue;
                }
                let from = start.max((column + 1).saturating_sub(band));
                let length = column - from;
                let a = &self.rows[row * band + band - 1 + from - row..][..length];
                let b = &self.rows[column * band + band - 1 + from - column..][..length];
                let product: f64 = a.iter().zip(b).map(|(a, b)| a * b).sum();
                let rest = self.rows[row * band + band - 1 + column - row] - product;
                let pivot = self.rows[column * band + band - 1];
                assert!(column < row || rest > 0.0, "freedom {} of node {} is loose", row % 6, row / 6);
                self.rows[row * band + band - 1 + column - row] =
                    if row == column { rest.sqrt() } else { rest / pivot };
            }
        }
        self
    }

    fn solve(&self, mut x: DVector<f64>) -> DVector<f64> {
        let entry = |row: usize, column: usize| self.rows[row * self.band + self.band - 1 + column - row];
        for row in 0..x.len() {
            let start = (row + 1).saturating_sub(self.band);
            let sum: f64 = (start..row).map(|column| entry(row, column) * x[column]).sum();
            x[row] = (x[row] - sum) / entry(row, row);
        }
        for row in (0..x.len()).rev() {
            x[row] /= entry(row, row);
            let start = (row + 1).saturating_sub(self.band);
            (start..row).for_each(|column| x[column] -= entry(row, column) * x[row]);
        }
        x
    }
}
