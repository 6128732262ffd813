//! Galerkin flows of a cylinder of liquid: products of functions of radius and height, zero on the wall and free of divergence.
//! Conservation of volume is built in by `u_θ` across the axis and by a stream function about it; heights couple to near neighbours only,
//! so that groups are eliminated one by one.
//! Equation (L20), docs/theory/13-inside.md.

use nalgebra::{DMatrix, DVector};

use super::lines::{Line, Values, axial, radial};
use crate::liquid::galerkin::{Fields, Products, TURNED, WEIGHTS};
use crate::math::quadrature::gauss_legendre;

/// Component of the flows of a kind: each function of the radius times each of the height.
struct Part {
    component: usize,
    across: Line,
    along: Line,
}

/// Points and weights across and along the axis, and half the height over the radius. Integrands are even in the height.
struct Rules {
    across: Vec<[f64; 2]>,
    along: Vec<[f64; 2]>,
    half: f64,
}

/// Size of the groups of functions of the height; only neighbouring groups are coupled.
const WIDTH: usize = 2;

/// Flows of harmonic `m` round the axis in a cylinder of radius 1 and half height `half`, with `radial` functions of the radius and
/// `axial` of the height in each of two kinds. (L20)
pub(super) fn fields(m: usize, half: f64, [radial, axial]: [usize; 2]) -> Fields {
    let Flows { rules, kinds, sums, scales } = Flows::new(m, half, [radial, axial]);
    let heights: Vec<usize> = (0..axial).collect();
    let chunks: Vec<&[usize]> = heights.chunks(WIDTH).collect();
    let block = |rows: &[usize], columns: &[usize]| products(&sums, &scales, rows, columns);
    Fields {
        groups: chunks.iter().map(|own| block(own, own)).collect(),
        between: chunks.windows(2).map(|pair| block(pair[0], pair[1]).couplings()).collect(),
        load: rules.load(m, &kinds, &scales, chunks[0]),
    }
}

/// Flows of both kinds with their products.
struct Flows {
    rules: Rules,
    kinds: [Vec<Part>; 2],
    sums: [[Sum; 2]; 2],
    scales: [DMatrix<f64>; 2],
}

impl Flows {
    fn new(m: usize, half: f64, counts: [usize; 2]) -> Self {
        let rules = Rules::new(half, counts);
        let kinds = if m == 1 { rules.across_axis(counts) } else { rules.about_axis(counts) };
        let turns = [m as f64 + 1.0, (m as f64 - 1.0).abs(), m as f64];
        let sums = [0, 1].map(|a| [0, 1].map(|b| Sum::of(&kinds[a], &kinds[b], turns, &rules.across)));
        let scales = [0, 1].map(|kind| sums[kind][kind].roots(counts));
        Self { rules, kinds, sums, scales }
    }
}

impl Rules {
    fn new(half: f64, [radial, axial]: [usize; 2]) -> Self {
        let unit = |[x, weight]: [f64; 2]| [0.5 * (1.0 + x), 0.5 * weight];
        let upper = gauss_legendre(4 * axial + 16).into_iter().filter(|[x, _]| *x > 0.0);
        Self {
            across: gauss_legendre(2 * radial + 10).into_iter().map(unit).collect(),
            along: upper.map(|[x, weight]| [x, 2.0 * weight]).collect(),
            half,
        }
    }

    fn part(&self, component: usize, across: [&DMatrix<f64>; 2], along: [&DMatrix<f64>; 2]) -> Part {
        let by_r: Vec<f64> = self.across.iter().map(|[r, weight]| (r * weight).sqrt()).collect();
        let by_z: Vec<f64> = self.along.iter().map(|[_, weight]| (self.half * weight).sqrt()).collect();
        Part {
            component,
            across: Line::new(across[0], across[1], &by_r),
            along: Line::new(along[0], along[1], &by_z),
        }
    }

    /// Flows across the axis: `u_r = f g` and `u_z = f g`, each with the `u_θ = i(∂_r(r u_r) + r ∂_z u_z)` of conserved volume.
    fn across_axis(&self, [n, k]: [usize; 2]) -> [Vec<Part>; 2] {
        let Self { across: rule, along, half } = self;
        let times = |matrix: &DMatrix<f64>| powered(rule, matrix, 1);
        let [f, f1, f2]: Values = radial(n, [2, 0], rule);
        let [g, g1, _] = axial(k, [1, 1], along, *half);
        let (rf1, rf2) = (times(&f1), times(&f2));
        let first = vec![
            self.part(0, [&-&rf1, &-(&f1 + &rf2)], [&g, &g1]),
            self.part(1, [&(2.0 * &f + &rf1), &(3.0 * &f1 + &rf2)], [&g, &g1]),
        ];
        let [f, f1, _] = radial(n, [1, 1], rule);
        let [g, g1, g2] = axial(k, [2, 0], along, *half);
        let (rf, slope) = (times(&f), &f + times(&f1));
        let second = vec![
            self.part(0, [&-&rf, &-&slope], [&g1, &g2]),
            self.part(1, [&rf, &slope], [&g1, &g2]),
            self.part(2, [&f, &f1], [&g, &g1]),
        ];
        [first, second]
    }

    /// Flows about the axis: `u_θ = i f g`, and `u_r = −f g′`, `u_z = (r f)′g/r`.
    fn about_axis(&self, [n, k]: [usize; 2]) -> [Vec<Part>; 2] {
        let Self { across: rule, along, half } = self;
        let [f, f1, _]: Values = radial(n, [1, 1], rule);
        let [g, g1, _] = axial(k, [1, 0], along, *half);
        let first = vec![self.part(0, [&-&f, &-&f1], [&g, &g1]), self.part(1, [&f, &f1], [&g, &g1])];
        let [f, f1, f2] = radial(n, [2, 1], rule);
        let [g, g1, g2] = axial(k, [2, 1], along, *half);
        let up = powered(rule, &f, -1) + &f1;
        let slope = powered(rule, &f1, -1) - powered(rule, &f, -2) + f2;
        let second = vec![
            self.part(0, [&-&f, &-&f1], [&g1, &g2]),
            self.part(1, [&-&f, &-&f1], [&g1, &g2]),
            self.part(2, [&up, &slope], [&g, &g1]),
        ];
        [first, second]
    }

    /// Load of the rigid rotation, `u_− z − u_z r` across the axis and `u_θ r` about the axis; zero for higher functions of the height.
    fn load(
        &self,
        m: usize,
        kinds: &[Vec<Part>; 2],
        scales: &[DMatrix<f64>; 2],
        heights: &[usize],
    ) -> DVector<f64> {
        let square = |r: f64, z: f64| if m == 1 { 2.0 * z * z + r * r } else { r * r };
        let shares = self.across.iter().flat_map(|[r, w]| {
            self.along.iter().map(move |[x, v]| square(*r, self.half * x) * r * w * v * self.half)
        });
        let whole = shares.sum::<f64>().sqrt();
        let count = scales[0].nrows();
        let mut load = DVector::zeros(heights.len() * 2 * count);
        for (i, k) in heights.iter().enumerate() {
            for (kind, parts) in kinds.iter().enumerate() {
                for part in parts {
                    // Factor and powers of r and of z.
                    let (factor, [by_r, by_z]) = match (m, kind, part.component) {
                        (1, _, 1) => (1.0, [0, 1]),
                        (1, _, 2) => (-1.0, [1, 0]),
                        (0, 0, 0) => (-0.5, [1, 0]),
                        (0, 0, 1) => (0.5, [1, 0]),
                        _ => continue,
                    };
                    let turn: Vec<f64> =
                        self.across.iter().map(|[r, w]| r.powi(by_r) * (r * w).sqrt()).collect();
                    let across = part.across.value.tr_mul(&DVector::from_vec(turn));
                    let raised = |(place, [x, w]): (usize, &[f64; 2])| {
                        (self.half * x).powi(by_z) * (self.half * w).sqrt() * part.along.value[(place, *k)]
                    };
                    let along: f64 = self.along.iter().enumerate().map(raised).sum();
                    for n in 0..count {
                        load[(2 * i + kind) * count + n] +=
                            factor * along * across[n] / (scales[kind][(n, *k)] * whole);
                    }
                }
            }
        }
        load
    }
}

/// Matrix times a power of the radius.
fn powered(rule: &[[f64; 2]], matrix: &DMatrix<f64>, power: i32) -> DMatrix<f64> {
    DMatrix::from_fn(matrix.nrows(), matrix.ncols(), |row, column| {
        matrix[(row, column)] * rule[row][0].powi(power)
    })
}

/// Products of two kinds, each a sum of products across and along the axis.
struct Sum {
    mass: Vec<[DMatrix<f64>; 2]>,
    friction: Vec<[DMatrix<f64>; 2]>,
    turning: Vec<[DMatrix<f64>; 2]>,
}

impl Sum {
    fn of(a: &[Part], b: &[Part], turns: [f64; 3], rule: &[[f64; 2]]) -> Self {
        let mut own = Self { mass: Vec::new(), friction: Vec::new(), turning: Vec::new() };
        for p in a {
            for q in b.iter().filter(|q| q.component == p.component) {
                let weight = WEIGHTS[p.component];
                let round = turns[p.component].powi(2) * powered(rule, &q.across.value, -2);
                let across = weight * p.across.value.transpose() * &q.across.value;
                let bent = weight
                    * (p.across.slope.transpose() * &q.across.slope + p.across.value.transpose() * round);
                let along = p.along.value.transpose() * &q.along.value;
                let slant = p.along.slope.transpose() * &q.along.slope;
                own.turning.push([TURNED[p.component] * &across, along.clone()]);
                own.mass.push([across.clone(), along.clone()]);
                own.friction.extend([[bent, along], [across, slant]]);
            }
        }
        own
    }

    /// Roots of the diagonal of the friction matrix, for normalisation.
    fn roots(&self, [n, k]: [usize; 2]) -> DMatrix<f64> {
        DMatrix::from_fn(n, k, |n, k| {
            self.friction.iter().map(|[R, Z]| R[(n, n)] * Z[(k, k)]).sum::<f64>().sqrt()
        })
    }
}

/// Products of the flows of some heights with those of others, kind by kind.
fn products(sums: &[[Sum; 2]; 2], scales: &[DMatrix<f64>; 2], rows: &[usize], columns: &[usize]) -> Products {
    let count = scales[0].nrows();
    let of = |list: &dyn Fn(&Sum) -> &Vec<[DMatrix<f64>; 2]>| {
        let mut matrix = DMatrix::zeros(rows.len() * 2 * count, columns.len() * 2 * count);
        for (i, j) in rows.iter().enumerate() {
            for (l, k) in columns.iter().enumerate() {
                for (a, b) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                    let zero = DMatrix::zeros(count, count);
                    let sum = list(&sums[a][b]).iter().fold(zero, |sum, [R, Z]| sum + R * Z[(*j, *k)]);
                    let entry = |n: usize, p: usize| sum[(n, p)] / (scales[a][(n, *j)] * scales[b][(p, *k)]);
                    let place = ((2 * i + a) * count, (2 * l + b) * count);
                    let block = DMatrix::from_fn(count, count, entry);
                    matrix.view_mut(place, (count, count)).copy_from(&block);
                }
            }
        }
        matrix
    };
    let found = Products {
        mass: of(&|sum| &sum.mass),
        friction: of(&|sum| &sum.friction),
        turning: of(&|sum| &sum.turning),
    };
    found.cleaned()
}

/// Largest product of flows whose heights are in groups that are not neighbours, and largest load beyond the first groups.
#[cfg(test)]
pub(super) fn beyond_neighbours(m: usize, half: f64, counts: [usize; 2]) -> f64 {
    let Flows { rules, kinds, sums, scales } = Flows::new(m, half, counts);
    let far: Vec<usize> = (2 * WIDTH..counts[1]).collect();
    let near: Vec<usize> = (0..WIDTH).collect();
    let found = products(&sums, &scales, &near, &far);
    let later = rules.load(m, &kinds, &scales, &far).amax();
    found.mass.amax().max(found.turning.amax()).max(found.friction.amax()).max(later)
}
