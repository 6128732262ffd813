//! Eigenvalues of Hessenberg matrices in lanes: Francis's QR iteration with two shifts `[@francis1962]`.
//! All lanes chase their bulges down one loop; each takes part in the rows of its own block, and is left as it is elsewhere.

use super::matrices::Matrices;
use crate::lanes::{LANES, Lanes, Mask};
use crate::simd::Arithmetic;

/// Sweeps for one deflation at most, and sweeps after which the shifts are exceptional ones.
const SWEEPS: f64 = 60.0;
const EXCEPTIONAL: f64 = 10.0;
/// Size of a subdiagonal entry that is none, in a matrix with entries of about one; the square of a square of it is still a number.
const NOTHING: f64 = 1e-70;

/// Eigenvalues of the Hessenberg matrix in every lane; none of one whose iteration has not ended.
#[inline(always)]
pub(super) fn eigenvalues<A: Arithmetic>(matrices: &mut Matrices) -> [Option<Vec<[f64; 2]>>; LANES] {
    let size = matrices.size();
    let mut values: [Option<Vec<[f64; 2]>>; LANES] = std::array::from_fn(|_| Some(Vec::with_capacity(size)));
    let mut blocks = Blocks { matrices, first: at(0), last: Lanes::splat(size as f64 - 1.0), sweeps: at(0) };
    loop {
        blocks.split();
        let corner = blocks.corner();
        if blocks.deflate(&corner, &mut values) {
            continue;
        }
        let open = blocks.first.at_most(blocks.last);
        let lost = open & at(0).at_most(blocks.sweeps - Lanes::splat(SWEEPS));
        for lane in (0..LANES).filter(|lane| lost.get(*lane)) {
            values[lane] = None;
        }
        blocks.last = Lanes::splat(-1.0).select(lost, blocks.last);
        let open = open & !lost;
        if !open.any() {
            return values;
        }
        blocks.sweep::<A>(&corner, open);
        blocks.sweeps = blocks.sweeps + at(1);
    }
}

/// A row or column as a number in every lane.
#[inline(always)]
fn at(place: usize) -> Lanes {
    Lanes::splat(place as f64)
}

#[inline(always)]
fn equal(a: Lanes, b: Lanes) -> Mask {
    a.at_most(b) & b.at_most(a)
}

/// Lowest unreduced block of each lane.
struct Blocks<'a> {
    matrices: &'a mut Matrices,
    /// First and last row of the block; last is −1 in a lane that has ended.
    first: Lanes,
    last: Lanes,
    /// Sweeps since the last deflation.
    sweeps: Lanes,
}

/// Last two rows of the blocks, `[[a, b], [c, d]]`, and the subdiagonal entry before them.
struct Corner {
    a: Lanes,
    b: Lanes,
    c: Lanes,
    d: Lanes,
    before: Lanes,
}

impl Blocks<'_> {
    /// Looks for the first row of each block, and sets the negligible subdiagonal entry above it to zero.
    #[inline(always)]
    fn split(&mut self) {
        let zero = at(0);
        let size = self.matrices.size();
        self.first = zero;
        for row in 1..size {
            let entry = self.matrices.at(row, row - 1);
            let beside = self.matrices.at(row, row).abs() + self.matrices.at(row - 1, row - 1).abs();
            let least = (Lanes::splat(f64::EPSILON) * beside).max(Lanes::splat(NOTHING));
            let small = entry.abs().at_most(least) & at(row).at_most(self.last);
            self.first = at(row).select(small, self.first);
            self.matrices.set(row, row - 1, zero.select(small, entry));
        }
    }

    /// Last two rows of each block.
    #[inline(always)]
    fn corner(&self) -> Corner {
        let zero = at(0);
        let mut corner = Corner { a: zero, b: zero, c: zero, d: self.matrices.at(0, 0), before: zero };
        for row in 1..self.matrices.size() {
            let here = equal(at(row), self.last);
            corner.a = self.matrices.at(row - 1, row - 1).select(here, corner.a);
            corner.b = self.matrices.at(row - 1, row).select(here, corner.b);
            corner.c = self.matrices.at(row, row - 1).select(here, corner.c);
            corner.d = self.matrices.at(row, row).select(here, corner.d);
            if row > 1 {
                corner.before = self.matrices.at(row - 1, row - 2).select(here, corner.before);
            }
        }
        corner
    }

    /// Takes off the blocks of one and two rows; tells whether there were any.
    #[inline(always)]
    fn deflate(&mut self, corner: &Corner, values: &mut [Option<Vec<[f64; 2]>>; LANES]) -> bool {
        let single = equal(self.first, self.last);
        let double = equal(self.first + at(1), self.last);
        if !(single | double).any() {
            return false;
        }
        let (apart, imaginary) = corner.pair();
        for lane in 0..LANES {
            if let Some(values) = &mut values[lane] {
                if single.get(lane) {
                    values.push([corner.d.0[lane], 0.0]);
                } else if double.get(lane) {
                    let [first, second] = apart.map(|apart| (corner.d + apart).0[lane]);
                    values.extend([[first, imaginary.0[lane]], [second, -imaginary.0[lane]]]);
                }
            }
        }
        self.last = self.last - at(1).select(single, at(2).select(double, at(0)));
        self.sweeps = at(0).select(single | double, self.sweeps);
        true
    }

    /// Chases a bulge down the block of each open lane.
    #[inline(always)]
    fn sweep<A: Arithmetic>(&mut self, corner: &Corner, open: Mask) {
        let exceptional = self.sweeps / Lanes::splat(EXCEPTIONAL);
        let exceptional = equal(exceptional, exceptional.map(f64::floor)) & !self.sweeps.at_most(at(0));
        let shifts = corner.shifts::<A>(exceptional);
        let (mut from, mut to) = (self.matrices.size(), 0);
        for lane in (0..LANES).filter(|lane| open.get(*lane)) {
            from = from.min(self.first.0[lane] as usize);
            to = to.max(self.last.0[lane] as usize);
        }
        for row in from..to {
            let within = open & self.first.at_most(at(row)) & at(row + 1).at_most(self.last);
            if within.any() {
                let starts = equal(at(row), self.first);
                let reflection = self.reflection::<A>(row, &shifts, [within, starts]);
                reflection.apply::<A>(self.matrices, row, from..to + 1);
            }
        }
    }

    /// Reflection that takes the bulge one row down, or makes it; none in lanes whose block is elsewhere. Below a block all entries are zero, so
    /// that of its last two rows the third is none.
    #[inline(always)]
    fn reflection<A: Arithmetic>(
        &mut self,
        row: usize,
        shifts: &[Lanes; 3],
        [within, starts]: [Mask; 2],
    ) -> Reflection {
        let zero = at(0);
        let mut bulge = [zero; 3];
        if row > 0 {
            bulge = std::array::from_fn(|i| self.matrices.at(row + i, row - 1));
        }
        if (within & starts).any() {
            let start = self.start::<A>(row, shifts);
            bulge = std::array::from_fn(|i| start[i].select(starts, bulge[i]));
        }
        let (reflection, length, some) = Reflection::of::<A>(bulge, within);
        if row > 0 {
            let goes_on = within & !starts & some;
            let left = [zero - length, zero, zero];
            for (i, left) in left.into_iter().enumerate() {
                let entry = self.matrices.at(row + i, row - 1);
                self.matrices.set(row + i, row - 1, left.select(goes_on, entry));
            }
        }
        reflection
    }

    /// First column of the product of the block less each shift, at its first row.
    #[inline(always)]
    fn start<A: Arithmetic>(&self, row: usize, [x, y, w]: &[Lanes; 3]) -> [Lanes; 3] {
        let h = self.matrices.at(row, row);
        let down = self.matrices.at(row + 1, row);
        let (r, s) = (*x - h, *y - h);
        let first = r.mul_add::<A>(s, at(0) - *w);
        [
            self.matrices.at(row, row + 1).mul_add::<A>(down, first),
            down * (self.matrices.at(row + 1, row + 1) - h - r - s),
            down * self.matrices.at(row + 2, row + 1),
        ]
    }
}

impl Corner {
    /// Eigenvalues of the last two rows as distances from the last diagonal entry: the real parts, the nearer one last, and the imaginary part
    /// of the first, zero of real ones.
    #[inline(always)]
    fn pair(&self) -> ([Lanes; 2], Lanes) {
        let zero = at(0);
        let half = Lanes::splat(0.5) * (self.a - self.d);
        let product = self.b * self.c;
        let square = half * half + product;
        let root = square.abs().sqrt();
        let real = zero.at_most(square);
        let far = half + root.select(zero.at_most(half), zero - root);
        let near = zero.select(equal(far, zero), zero - product / far);
        ([far.select(real, half), near.select(real, half)], zero.select(real, root))
    }

    /// Shifts as two diagonal entries and the product of the others: the eigenvalues of the last two rows, of real ones the nearer to the last
    /// diagonal entry twice, without which some matrices of four rows never end `[@day1996]`.
    #[inline(always)]
    fn shifts<A: Arithmetic>(&self, exceptional: Mask) -> [Lanes; 3] {
        let zero = at(0);
        let ([_, near], imaginary) = self.pair();
        let real = equal(imaginary, zero);
        let nearer = self.d + near;
        let [x, y] = [self.d, self.a].map(|entry| nearer.select(real, entry));
        let product = zero.select(real, self.b * self.c);
        let beside = self.c.abs() + self.before.abs();
        let other = Lanes::splat(0.75).mul_add::<A>(beside, self.d);
        [
            other.select(exceptional, x),
            other.select(exceptional, y),
            (Lanes::splat(-0.4375) * beside * beside).select(exceptional, product),
        ]
    }
}

/// Reflection `1 − u vᵀ` of three rows, in each lane.
struct Reflection {
    u: [Lanes; 3],
    /// The first entry is one.
    v: [Lanes; 2],
}

impl Reflection {
    /// Reflection that turns a vector into its first direction, where it is wanted, with the length that it gives it there up to the sign, and
    /// where there is one.
    #[inline(always)]
    fn of<A: Arithmetic>(vector: [Lanes; 3], wanted: Mask) -> (Self, Lanes, Mask) {
        let zero = at(0);
        let [p, q, r] = vector;
        let square = p.mul_add::<A>(p, q.mul_add::<A>(q, r * r));
        let some = wanted & !square.at_most(Lanes::splat(f64::MIN_POSITIVE));
        let length = square.sqrt();
        let length = (zero - length).select(p.at_most(zero), length);
        let sum = p + length;
        let (inner, outer) = (Lanes::splat(1.0) / length, Lanes::splat(1.0) / sum);
        let u = [sum * inner, q * inner, r * inner].map(|u| u.select(some, zero));
        let v = [q * outer, r * outer].map(|v| v.select(some, zero));
        (Self { u, v }, length, some)
    }

    /// Reflects three rows from one on and then three columns, within the rows and columns of a range.
    #[inline(always)]
    fn apply<A: Arithmetic>(&self, matrices: &mut Matrices, row: usize, range: std::ops::Range<usize>) {
        let zero = at(0);
        let minus = |of: Lanes| zero - of;
        let ([x, y, z], [q, r]) = (self.u, self.v);
        let [minus_x, minus_y, minus_z] = self.u.map(minus);
        let [minus_q, minus_r] = self.v.map(minus);
        let mut rows = matrices.rows_mut(row);
        if let (Some(first), Some(second), Some(third)) = (rows.next(), rows.next(), rows.next()) {
            let columns = row..range.end;
            let (first, second) = (&mut first[columns.clone()], &mut second[columns.clone()]);
            for ((a, b), c) in first.iter_mut().zip(second).zip(&mut third[columns]) {
                let sum = r.mul_add::<A>(*c, q.mul_add::<A>(*b, *a));
                *a = minus_x.mul_add::<A>(sum, *a);
                *b = minus_y.mul_add::<A>(sum, *b);
                *c = minus_z.mul_add::<A>(sum, *c);
            }
        }
        let end = (row + 4).min(range.end);
        for entries in matrices.rows_mut(range.start).take(end - range.start) {
            if let [a, b, c, ..] = &mut entries[row..] {
                let sum = z.mul_add::<A>(*c, y.mul_add::<A>(*b, x * *a));
                *a = *a - sum;
                *b = minus_q.mul_add::<A>(sum, *b);
                *c = minus_r.mul_add::<A>(sum, *c);
            }
        }
    }
}
