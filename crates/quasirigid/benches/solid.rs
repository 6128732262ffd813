//! Time and memory of a static solution of an elastic cube: assembly, order, factor, nine right-hand sides.
//!
//! `cargo bench --bench solid -- NODES [FILE] [single|double] [scotch] [modes]` takes the nodes along an edge (22 if
//! none are given) and writes the matrix to FILE for other programs, unless it is `-`. Prints lines of a name and a
//! value, times in seconds and memory in MB, which `benchmarks/peers/solid.py` compares with those of other solvers.
#![allow(missing_docs, non_snake_case, clippy::print_stdout)]

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::sync::Arc;
use std::time::Instant;

use quasirigid_math::factor::{Analysis, Factor, Ordering, Precision};
use quasirigid_math::krylov::Pencil;
use quasirigid_math::symmetric::{Pattern, Symmetric};
use quasirigid_math::threads::Team;

const WIDTH: usize = 9;
/// Elements whose matrices exist at once.
const BATCH: usize = 1024;

/// Time on the wall, and processor time of all threads.
struct Clock {
    wall: Instant,
    processor: f64,
}

impl Clock {
    fn now() -> Self {
        Self { wall: Instant::now(), processor: processor() }
    }

    /// Prints both times of a phase, the time on the wall under the name with `_wall`.
    fn print(&self, phase: &str) {
        println!("{phase} {:.3}", processor() - self.processor);
        println!("{phase}_wall {:.3}", self.wall.elapsed().as_secs_f64());
    }
}

/// Processor time of this process (s), its ended threads included; not a number where the system does not tell.
fn processor() -> f64 {
    let ended = fs::read_to_string("/proc/self/stat").unwrap_or_default();
    // The name of the program may have spaces; user and system time follow eleven fields behind it, in hundredths of a second.
    let fields = ended.rsplit(')').next().unwrap_or_default().split_whitespace().skip(11).take(2);
    let ticks: Vec<f64> = fields.filter_map(|field| field.parse().ok()).collect();
    if ticks.len() < 2 { f64::NAN } else { ticks.iter().sum::<f64>() / 100.0 }
}

fn main() -> io::Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|argument| argument != "--bench").collect();
    let nodes = arguments.first().and_then(|nodes| nodes.parse().ok()).unwrap_or(22);
    let word = |word: &str| arguments.iter().any(|argument| argument == word);
    let start = Clock::now();
    let (stiffness, mass) = Cube { nodes }.matrices(word("modes"));
    println!("unknowns {}", stiffness.size());
    start.print("assembly");
    if let Some(path) = arguments.get(1).filter(|path| *path != "-") {
        write(path, &stiffness)?;
    }
    let precision = match (word("single"), word("double")) {
        (true, _) => Precision::Single,
        (_, true) => Precision::Double,
        _ => Precision::Automatic,
    };
    let start = Clock::now();
    let ordering = if word("scotch") { Ordering::Scotch } else { Ordering::Automatic };
    let analysis = Analysis::new(&stiffness, ordering).expect("the cube has a diagonal");
    start.print("order");
    println!("entries {}\nmultiplications {:e}", analysis.entries(), analysis.multiplications());
    let start = Clock::now();
    let factor = analysis.factor(precision).expect("the cube is held");
    start.print("factor");
    println!("precision {:?}", factor.work().precision);
    for width in [1, WIDTH] {
        let right: Vec<f64> = (0..width * stiffness.size()).map(|i| (i as f64 * 0.7).cos()).collect();
        let mut x = right.clone();
        let start = Clock::now();
        let iterations = factor.solve(&mut x, width).iterations;
        start.print(&format!("solve{width}"));
        println!("iterations {iterations}");
        println!("residual {:.1e}\nbits {:016x}", residual(&stiffness, &x, &right, width), bits(&x));
    }
    if word("modes") {
        modes(&stiffness, &mass, &factor);
    }
    println!("peak {:.0}", peak());
    Ok(())
}

/// `|b − A x| / |b|`.
fn residual(matrix: &Symmetric, x: &[f64], right: &[f64], width: usize) -> f64 {
    let gap: f64 = matrix.times_block(x, width).iter().zip(right).map(|(Ax, b)| (b - Ax).powi(2)).sum();
    (gap / right.iter().map(|b| b * b).sum::<f64>()).sqrt()
}

/// A sum over the bits of some numbers, which tells whether two runs agree in all of them.
fn bits(x: &[f64]) -> u64 {
    x.iter().fold(0, |sum: u64, x| sum.rotate_left(5).wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ x.to_bits())
}

/// The 20 lowest modes.
fn modes(stiffness: &Symmetric, mass: &Symmetric, factor: &Factor) {
    let solves = std::cell::Cell::new(0);
    let start = Clock::now();
    let pencil = Pencil {
        size: stiffness.size(),
        stiffness: &|x| stiffness.times(x),
        solve: &|x| {
            solves.set(solves.get() + 1);
            factor.solve(x, 1);
        },
        mass: &|x| mass.times(x),
    };
    let vectors = pencil.largest(20).expect("the modes of a cube converge");
    start.print("modes20");
    println!("solves {}", solves.get());
    for x in &vectors {
        println!("eigenvalue {:.12e}", quasirigid_math::krylov::dot(x, &mass.times(x)).recip());
    }
}

/// Starts, rows and entries of the lower triangle by columns, little-endian, after the number of columns and places.
fn write(path: &str, matrix: &Symmetric) -> io::Result<()> {
    let mut file = BufWriter::new(File::create(path)?);
    let mut start = 0_u64;
    file.write_all(&(matrix.size() as u64).to_le_bytes())?;
    file.write_all(&(matrix.entries().len() as u64).to_le_bytes())?;
    file.write_all(&start.to_le_bytes())?;
    for column in 0..matrix.size() {
        start += matrix.column(column).count() as u64;
        file.write_all(&start.to_le_bytes())?;
    }
    for column in 0..matrix.size() {
        matrix.column(column).try_for_each(|(row, _)| file.write_all(&(row as u32).to_le_bytes()))?;
    }
    matrix.entries().iter().try_for_each(|entry| file.write_all(&entry.to_le_bytes()))
}

/// Largest memory of this process so far in MB, not a number where the system does not tell.
fn peak() -> f64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kibibytes = line.and_then(|line| line.split_whitespace().next()?.parse().ok());
    kibibytes.map_or(f64::NAN, |kibibytes: f64| 1.024e-3 * kibibytes)
}

/// Unit cube of trilinear hexahedra, smoothly distorted, `E = 1`, `ν = 0.3`, fixed at six unknowns.
struct Cube {
    nodes: usize,
}

type Place = [f64; 3];

impl Cube {
    fn node(&self, i: usize, j: usize, k: usize) -> usize {
        i + self.nodes * (j + self.nodes * k)
    }

    fn place(&self, node: usize) -> Place {
        let grid = [node % self.nodes, node / self.nodes % self.nodes, node / self.nodes / self.nodes];
        let [x, y, z] = grid.map(|index| index as f64 / (self.nodes - 1) as f64);
        let bend = |a: f64, b: f64| 0.05 * (std::f64::consts::TAU * a).sin() * (3.0 * b).cos();
        [x + bend(y, z), y + bend(z, x), z + bend(x, y)]
    }

    /// Elements as lists of eight nodes.
    fn elements(&self) -> Vec<[u32; 8]> {
        let cells = self.nodes - 1;
        let corner = |cell: usize, c: usize| {
            let (i, j, k) = (cell % cells, cell / cells % cells, cell / cells / cells);
            self.node(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2)) as u32
        };
        (0..cells.pow(3)).map(|cell| std::array::from_fn(|c| corner(cell, c))).collect()
    }

    /// Statically determinate support: one corner, two unknowns of the next, one of a third.
    fn held(&self, node: usize, axis: usize) -> bool {
        let second = self.node(self.nodes - 1, 0, 0);
        let third = self.node(0, self.nodes - 1, 0);
        node == 0 || node == second && axis > 0 || node == third && axis == 2
    }

    /// Stiffness, and mass if `massive`.
    fn matrices(&self, massive: bool) -> (Symmetric, Symmetric) {
        let count = self.nodes.pow(3);
        let mut first = vec![0_u32];
        let mut unknowns = vec![None; 3 * count];
        let mut next = 0;
        for (index, unknown) in unknowns.iter_mut().enumerate() {
            if !self.held(index / 3, index % 3) {
                *unknown = Some(next);
                next += 1;
            }
            if index % 3 == 2 {
                first.push(next);
            }
        }
        let elements = self.elements();
        let pattern = Pattern::new(&first, elements.iter().map(|nodes| nodes.as_slice()));
        let mut stiffness = Symmetric::zero(Arc::new(pattern.expect("elements join nodes of the cube")));
        let mut mass = stiffness.clone();
        let team = Team::new();
        for batch in elements.chunks(BATCH) {
            let made = team.map(batch.iter().collect(), |nodes| {
                let axes = |node: &u32| (0..3).map(|axis| 3 * *node as usize + axis).collect::<Vec<_>>();
                let own: Vec<Option<u32>> = nodes.iter().flat_map(axes).map(|row| unknowns[row]).collect();
                (own, hexahedron(&nodes.map(|node| self.place(node as usize))))
            });
            let parts: Vec<(&[Option<u32>], &[f64])> =
                made.iter().map(|(own, (K, _))| (&own[..], &K[..])).collect();
            stiffness.add_all(&parts, &team).expect("the pattern has all elements");
            if massive {
                let parts: Vec<_> = made.iter().map(|(own, (_, M))| (&own[..], &M[..])).collect();
                mass.add_all(&parts, &team).expect("the pattern has all elements");
            }
        }
        (stiffness, mass)
    }
}

/// Stiffness and mass of a trilinear hexahedron, by 2 × 2 × 2 Gauss points; density 1.
fn hexahedron(places: &[Place; 8]) -> (Vec<f64>, Vec<f64>) {
    let (mut K, mut M) = (vec![0.0; 576], vec![0.0; 576]);
    let (lambda, mu) = (0.3 / (1.3 * 0.4), 1.0 / 2.6);
    for point in 0..8 {
        let (shapes, gradients, volume) = shape(places, point);
        for a in 0..8 {
            for b in 0..8 {
                let (g, h) = (gradients[a], gradients[b]);
                let dot: f64 = (0..3).map(|i| g[i] * h[i]).sum();
                for i in 0..3 {
                    for j in 0..3 {
                        let same = f64::from(u8::from(i == j));
                        let entry = lambda * g[i] * h[j] + mu * (g[j] * h[i] + same * dot);
                        K[(3 * a + i) * 24 + 3 * b + j] += volume * entry;
                    }
                    M[(3 * a + i) * 24 + 3 * b + i] += volume * shapes[a] * shapes[b];
                }
            }
        }
    }
    (K, M)
}

/// Shape functions at a Gauss point, their gradients in space, and the volume of the point.
fn shape(places: &[Place; 8], point: usize) -> ([f64; 8], [Place; 8], f64) {
    let sign = |corner: usize, axis: usize| if corner >> axis & 1 == 1 { 1.0 } else { -1.0 };
    let xi: Place = std::array::from_fn(|axis| sign(point, axis) / 3f64.sqrt());
    let factor = |corner, axis: usize| 0.5 * (1.0 + sign(corner, axis) * xi[axis]);
    let shapes = std::array::from_fn(|c| (0..3).map(|axis| factor(c, axis)).product());
    let local: [Place; 8] = std::array::from_fn(|c| {
        std::array::from_fn(|d| {
            (0..3).map(|axis| if axis == d { 0.5 * sign(c, axis) } else { factor(c, axis) }).product()
        })
    });
    // J[i][d] = ∂x_i/∂ξ_d
    let J: [Place; 3] =
        std::array::from_fn(|i| std::array::from_fn(|d| (0..8).map(|c| places[c][i] * local[c][d]).sum()));
    let cofactor = |i: usize, d: usize| {
        let (i1, i2, d1, d2) = ((i + 1) % 3, (i + 2) % 3, (d + 1) % 3, (d + 2) % 3);
        J[i1][d1] * J[i2][d2] - J[i1][d2] * J[i2][d1]
    };
    let volume: f64 = (0..3).map(|d| J[0][d] * cofactor(0, d)).sum();
    let gradients = local.map(|local| {
        std::array::from_fn(|i| (0..3).map(|d| cofactor(i, d) * local[d]).sum::<f64>() / volume)
    });
    (shapes, gradients, volume)
}
