//! Nonlinear eigenproblem of the spinning body, `P(λ)x = 0`, of many coordinates: parts on a carrier are coupled by its rotation and, in a free
//! body, by its recoil alone, so that the matrix is one of blocks with a border of six rows and columns.
//! The border is condensed, and solutions are refined once: where an eigenvalue is next to one of a block the condensed matrix loses digits.
//! Equations (M3) and (M24), docs/theory/15-modes.md.

use nalgebra::{Complex, ComplexField, Matrix3, SMatrix, Vector3};

use super::equilibrium::RelativeEquilibrium;
use super::iteration::{Nonlinear, Solution};
use super::unknowns::{Unknowns, modulus, turning};
use crate::math::blocks::{BlockFactor, Blocks};
use crate::math::lu::{ComplexDense, ComplexLu};
use crate::math::sparse::SparseRows;
use crate::math::sym3;
use crate::model::{Recoiling, SpinCoefficients, SpinMatrix, Viscoelastic};

type C = Complex<f64>;

/// Size of the border: angular velocity and recoil.
const BORDER: usize = 6;

/// Factors by `λ²`, `λ` and 1.
#[derive(Clone, Copy)]
struct Powers([f64; 3]);

impl std::ops::AddAssign for Powers {
    fn add_assign(&mut self, other: Self) {
        (0..3).for_each(|power| self.0[power] += other.0[power]);
    }
}

/// Coupling of an unknown with the carrier: angular momentum per rate and per displacement, and linear momentum per rate.
#[derive(Clone, Copy)]
struct Coupling {
    h: Vector3<f64>,
    u: Vector3<f64>,
    s: Vector3<f64>,
}

/// Dynamic stiffness of the spinning body by its blocks. (M24)
pub(super) struct BlockPencil<'a> {
    pub unknowns: Unknowns<'a>,
    omega: Vector3<f64>,
    angular_momentum: Vector3<f64>,
    inertia: Matrix3<f64>,
    couplings: Vec<Coupling>,
    entries: SparseRows<Powers>,
    /// `m` of the recoil, by `λ²`, `λ` and 1.
    recoil: [Matrix3<f64>; 3],
    materials: Vec<(&'a Viscoelastic, SparseRows<f64>)>,
    blocks: Blocks,
}

/// Factors at one `λ`.
pub(super) struct BorderedFactor {
    blocks: BlockFactor,
    /// Solutions of the blocks for the columns of the border, a row for each unknown.
    solved: Vec<[C; BORDER]>,
    /// Condensed matrix of angular velocity and recoil.
    pub condensed: SMatrix<C, BORDER, BORDER>,
}

impl<'a> BlockPencil<'a> {
    pub fn new(
        unknowns: Unknowns<'a>,
        equilibrium: &RelativeEquilibrium,
        coefficients: &SpinCoefficients,
    ) -> Self {
        let body = unknowns.body;
        let SpinCoefficients { inertia, mass, h, gyroscopic, centrifugal, .. } = coefficients;
        let mut places = vec![None; h.len()];
        unknowns.kept.iter().enumerate().for_each(|(place, j)| places[*j] = Some(place));
        let mut parts = Vec::new();
        let mut add = |(j, k, entry): (usize, usize, f64), power: usize| {
            if let (Some(j), Some(k)) = (places[j], places[k]) {
                let mut powers = [0.0; 3];
                powers[power] = entry;
                parts.push((j, k, Powers(powers)));
            }
        };
        let sparse = [(mass, 0, 1.0), (gyroscopic, 1, 1.0), (centrifugal, 2, -1.0)];
        for (matrix, power, sign) in sparse {
            entries(matrix).into_iter().for_each(|(j, k, entry)| add((j, k, sign * entry), power));
        }
        body.damping().iter().for_each(|(j, k, B)| add((j, k, *B), 1));
        body.stiffness().iter().for_each(|(j, k, C)| add((j, k, *C), 2));
        let size = unknowns.size - 3;
        let within = |material: &'a Viscoelastic| {
            let own = material.stiffness.iter();
            let own = own.filter_map(|(j, k, C)| Some((places[j]?, places[k]?, *C)));
            (material, SparseRows::sum(size, own.collect()))
        };
        let materials: Vec<_> =
            if unknowns.nonlinear { body.viscoelastic().iter().map(within).collect() } else { Vec::new() };
        let entries = SparseRows::sum(size, parts);
        let of_materials = materials.iter().flat_map(|(_, own)| own.iter().map(|(j, k, _)| [j, k]));
        let of_liquids = unknowns
            .memories
            .iter()
            .flat_map(|(start, memory)| (1..memory.axes.len()).map(move |axis| [*start, start + axis]));
        let pairs = entries.iter().map(|(j, k, _)| [j, k]).chain(of_materials).chain(of_liquids);
        Self {
            blocks: Blocks::of(size, pairs),
            omega: equilibrium.omega.into(),
            angular_momentum: equilibrium.angular_momentum.into(),
            inertia: Matrix3::from(sym3::rows(*inertia)),
            couplings: couplings(&unknowns, coefficients),
            recoil: [middle(mass), middle(gyroscopic), -middle(centrifugal)],
            entries,
            materials,
            unknowns,
        }
    }

    /// Blocks of the coordinates.
    pub fn blocks(&self) -> &Blocks {
        &self.blocks
    }

    /// Entries of the blocks by row, column, and the factors of `λ²`, `λ` and 1.
    pub fn block_entries(&self) -> impl Iterator<Item = (usize, usize, [f64; 3])> {
        self.entries.iter().map(|(j, k, Powers(powers))| (j, k, *powers))
    }

    /// Factors of `P(λ)`; none where a block is singular.
    pub fn factor(&self, lambda: C) -> Option<BorderedFactor> {
        let pair = |value: C| [value.re, value.im];
        let own = self.entries.iter().map(|(j, k, powers)| (j, k, pair(polynomial(lambda, powers.0))));
        let moduli = self.moduli(lambda);
        let of_materials = self.materials.iter().zip(&moduli).flat_map(|((_, stiffness), modulus)| {
            stiffness.iter().map(move |(j, k, C)| (j, k, pair(modulus * *C)))
        });
        let of_liquids =
            self.unknowns.impedances(lambda, self.omega).into_iter().map(|(j, k, entry)| (j, k, pair(entry)));
        let blocks = self.blocks.factor(own.chain(of_materials).chain(of_liquids))?;
        let columns = |coupling: &Coupling| {
            let given = coupling.h.map(C::from) * lambda - coupling.u.map(C::from);
            [given[0], given[1], given[2], coupling.s[0].into(), coupling.s[1].into(), coupling.s[2].into()]
        };
        let right: Vec<[f64; 2]> = self.couplings.iter().flat_map(columns).map(pair).collect();
        let solved = blocks.solve(&right, BORDER)?;
        let row = |row: &[[f64; 2]]| std::array::from_fn(|k| C::new(row[k][0], row[k][1]));
        let solved: Vec<[C; BORDER]> = solved.chunks_exact(BORDER).map(row).collect();
        let condensed = self.condensed(lambda, &solved);
        Some(BorderedFactor { blocks, solved, condensed })
    }

    /// `(λ1 + [ω]ₓ)J − [K]ₓ` and the definition of the recoil, less what the blocks answer.
    fn condensed(&self, lambda: C, solved: &[[C; BORDER]]) -> SMatrix<C, BORDER, BORDER> {
        let mut sums = SMatrix::<C, BORDER, BORDER>::zeros();
        let turning = self.turning(lambda);
        for (coupling, solved) in self.couplings.iter().zip(solved) {
            let rows = self.border_rows(&turning, lambda, coupling);
            for (row, border) in rows.iter().enumerate() {
                (0..BORDER).for_each(|column| sums[(row, column)] -= border * solved[column]);
            }
        }
        let recoil = self.middle(lambda);
        let answered = sums.fixed_view::<BORDER, 3>(0, 3) * recoil;
        sums.fixed_view_mut::<BORDER, 3>(0, 3).copy_from(&answered);
        let own = turning * self.inertia.map(C::from) - self.angular_momentum.cross_matrix().map(C::from);
        let mut body = sums.fixed_view_mut::<3, 3>(0, 0);
        body += own;
        let mut definition = sums.fixed_view_mut::<3, 3>(3, 3);
        definition -= Matrix3::identity();
        sums
    }

    /// Rows of the border at an unknown: of the angular momentum and of the recoil.
    fn border_rows(&self, turning: &Matrix3<C>, lambda: C, coupling: &Coupling) -> [C; BORDER] {
        let turned = turning * (coupling.h.map(C::from) * lambda + coupling.u.map(C::from));
        let s = coupling.s;
        [turned[0], turned[1], turned[2], s[0].into(), s[1].into(), s[2].into()]
    }

    /// Solution with factors; none where the condensed matrix is singular.
    pub fn solve_by(&self, factor: &BorderedFactor, lambda: C, right: &[C]) -> Option<Vec<C>> {
        let given: Vec<[f64; 2]> = right[3..].iter().map(|entry| [entry.re, entry.im]).collect();
        let answered = if given.is_empty() { given } else { factor.blocks.solve(&given, 1)? };
        let answered: Vec<C> = answered.iter().map(|[re, im]| C::new(*re, *im)).collect();
        let turning = self.turning(lambda);
        let mut load = [right[0], right[1], right[2], C::from(0.0), C::from(0.0), C::from(0.0)];
        for (coupling, answered) in self.couplings.iter().zip(&answered) {
            let rows = self.border_rows(&turning, lambda, coupling);
            load.iter_mut().zip(rows).for_each(|(load, border)| *load -= border * answered);
        }
        let mut condensed = ComplexDense::zero(BORDER);
        for (row, column) in (0..BORDER).flat_map(|row| (0..BORDER).map(move |column| (row, column))) {
            let entry = factor.condensed[(row, column)];
            condensed.add(row, column, [entry.re, entry.im]);
        }
        let load: Vec<[f64; 2]> = load.iter().map(|entry| [entry.re, entry.im]).collect();
        let carrier = ComplexLu::new(&condensed)?.solve(&load, 1)?;
        let carrier: Vec<C> = carrier.iter().map(|[re, im]| C::new(*re, *im)).collect();
        let pushed = self.middle(lambda) * Vector3::new(carrier[3], carrier[4], carrier[5]);
        let shares = [carrier[0], carrier[1], carrier[2], pushed[0], pushed[1], pushed[2]];
        let own = answered.iter().zip(&factor.solved).map(|(answered, solved)| {
            answered - solved.iter().zip(shares).map(|(solved, share)| solved * share).sum::<C>()
        });
        Some(carrier[..3].iter().copied().chain(own).collect())
    }

    /// Products with the parts of `P` by `λ²`, `λ` and 1, without materials and liquids that depend on the frequency otherwise.
    pub fn by_power<T: ComplexField<RealField = f64> + Copy>(&self, x: &[T]) -> [Vec<T>; 3] {
        let mut products = [0, 1, 2].map(|_| vec![T::zero(); x.len()]);
        let (spin, inner) = x.split_at(3);
        let vector = |list: &[T]| Vector3::new(list[0], list[1], list[2]);
        let times = |matrix: &Matrix3<f64>, x: Vector3<T>| matrix.map(T::from_real) * x;
        let sum = |part: &dyn Fn(&Coupling) -> Vector3<f64>| {
            let all = self.couplings.iter().zip(inner);
            all.fold(Vector3::zeros(), |sum: Vector3<T>, (coupling, x)| {
                sum + part(coupling).map(|entry| x.scale(entry))
            })
        };
        let [h, u, s] = [sum(&|own| own.h), sum(&|own| own.u), sum(&|own| own.s)];
        let (turn, held) = (self.omega.cross_matrix(), self.angular_momentum.cross_matrix());
        let spun = vector(spin);
        let body = [
            h,
            times(&self.inertia, spun) + times(&turn, h) + u,
            times(&(turn * self.inertia - held), spun) + times(&turn, u),
        ];
        let pushed = [0, 1, 2].map(|power| times(&self.recoil[power], s));
        for power in 0..3 {
            products[power][..3].copy_from_slice(body[power].as_slice());
        }
        for (j, coupling) in self.couplings.iter().enumerate() {
            let along = |a: Vector3<f64>, b: &Vector3<T>| {
                (0..3).fold(T::zero(), |sum, axis| sum + b[axis].scale(a[axis]))
            };
            for power in 0..3 {
                products[power][3 + j] += along(coupling.s, &pushed[power]);
            }
            products[1][3 + j] += along(coupling.h, &spun);
            products[2][3 + j] -= along(coupling.u, &spun);
        }
        for (j, k, Powers(powers)) in self.entries.iter() {
            (0..3).for_each(|power| products[power][3 + j] += inner[k].scale(powers[power]));
        }
        products
    }

    /// `m(λ)` of the recoil.
    fn middle(&self, lambda: C) -> Matrix3<C> {
        let [mass, rate, stiffness] = self.recoil.map(|part| part.map(C::from));
        mass * lambda * lambda + rate * lambda + stiffness
    }

    /// Complex moduli less one.
    fn moduli(&self, lambda: C) -> Vec<C> {
        self.materials.iter().map(|(material, _)| modulus(material, lambda)).collect()
    }

    /// `λ1 + [ω]ₓ`.
    fn turning(&self, lambda: C) -> Matrix3<C> {
        turning(lambda, self.omega)
    }
}

impl Nonlinear for BlockPencil<'_> {
    fn times(&self, lambda: C, x: &[C]) -> Vec<C> {
        let [mass, rate, stiffness] = self.by_power(x);
        let parts = mass.iter().zip(&rate).zip(&stiffness);
        let mut product: Vec<C> =
            parts.map(|((mass, rate), stiffness)| (mass * lambda + rate) * lambda + stiffness).collect();
        for ((_, stiffness), modulus) in self.materials.iter().zip(self.moduli(lambda)) {
            stiffness.iter().for_each(|(j, k, C)| product[3 + j] += modulus * *C * x[3 + k]);
        }
        for (j, k, entry) in self.unknowns.impedances(lambda, self.omega) {
            product[3 + j] += entry * x[3 + k];
        }
        product
    }

    fn solve(&self, lambda: C, right: &[C]) -> Solution {
        let Some(factor) = self.factor(lambda) else { return Solution::Singular };
        let Some(mut x) = self.solve_by(&factor, lambda, right) else { return Solution::Singular };
        let left: Vec<C> = right.iter().zip(self.times(lambda, &x)).map(|(right, Px)| right - Px).collect();
        if let Some(change) = self.solve_by(&factor, lambda, &left) {
            x.iter_mut().zip(change).for_each(|(x, change)| *x += change);
        }
        Solution::Found(x)
    }

    fn weights(&self, lambda: C) -> Vec<f64> {
        let square = lambda.norm_sqr();
        let size = self.unknowns.size - 3;
        let mut own = vec![0.0; size];
        self.entries.iter().filter(|(j, k, _)| j == k).for_each(|(j, _, entry)| own[j] = square * entry.0[0]);
        for (start, memory) in &self.unknowns.memories {
            (0..memory.axes.len()).for_each(|axis| own[start + axis] = square * memory.inertia);
        }
        (0..3).map(|axis| self.inertia[(axis, axis)]).chain(own).collect()
    }
}

fn polynomial(lambda: C, [square, linear, constant]: [f64; 3]) -> C {
    (lambda * square + linear) * lambda + constant
}

/// Entries of the blocks of a matrix.
fn entries(matrix: &SpinMatrix) -> Vec<(usize, usize, f64)> {
    match matrix {
        SpinMatrix::Recoiling(Recoiling { own, .. }) => {
            own.iter().map(|(j, k, entry)| (j, k, *entry)).collect()
        }
        SpinMatrix::Dense(whole) => {
            let all = (0..whole.size()).flat_map(|j| (0..whole.size()).map(move |k| (j, k)));
            all.map(|(j, k)| (j, k, whole.at(j, k))).filter(|(.., entry)| *entry != 0.0).collect()
        }
    }
}

fn middle(matrix: &SpinMatrix) -> Matrix3<f64> {
    match matrix {
        SpinMatrix::Recoiling(Recoiling { middle, .. }) => Matrix3::from(*middle).transpose(),
        SpinMatrix::Dense(_) => Matrix3::zeros(),
    }
}

/// Couplings of the unknowns after the angular velocity.
fn couplings(unknowns: &Unknowns, coefficients: &SpinCoefficients) -> Vec<Coupling> {
    let moments = match &coefficients.mass {
        SpinMatrix::Recoiling(Recoiling { moments, .. }) => &moments[..],
        SpinMatrix::Dense(_) => &[],
    };
    // a liquid whose impedance is known has no linear momentum
    let moments = unknowns.kept.iter().map(|j| moments.get(*j).copied().unwrap_or_default());
    let all = unknowns.couplings(coefficients).zip(moments.chain(std::iter::repeat([0.0; 3])));
    all.map(|((h, u), s)| Coupling { h: h.into(), u: u.into(), s: s.into() }).collect()
}
