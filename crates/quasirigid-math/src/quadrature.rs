//! Quadrature: adaptive with bounded work, of several functions at once, and by Gauss rules.

use std::f64::consts::PI;

/// Nodes, not negative, of the Kronrod rule of 15 points on −1 to 1, with its weights and those of the Gauss rule of 7 points within it.
pub const KRONROD: [[f64; 3]; 8] = [
    [0.991_455_371_120_812_6, 0.022_935_322_010_529_224, 0.0],
    [0.949_107_912_342_758_5, 0.063_092_092_629_978_56, 0.129_484_966_168_869_7],
    [0.864_864_423_359_769_1, 0.104_790_010_322_250_19, 0.0],
    [0.741_531_185_599_394_4, 0.140_653_259_715_525_92, 0.279_705_391_489_276_64],
    [0.586_087_235_467_691_1, 0.169_004_726_639_267_9, 0.0],
    [0.405_845_151_377_397_2, 0.190_350_578_064_785_4, 0.381_830_050_505_118_9],
    [0.207_784_955_007_898_47, 0.204_432_940_075_298_9, 0.0],
    [0.0, 0.209_482_141_084_727_82, 0.417_959_183_673_469_4],
];
/// Most intervals of an integral.
const INTERVALS: usize = 1000;
/// Halvings without a gain that show an error of rounding, not of the rule.
const IDLE: usize = 12;
/// Share of the error below which a halving gains something.
const GAIN: f64 = 0.99;
/// Relative change of a sum in a halving that counts as none.
const UNCHANGED_SUM: f64 = 1e-5;

/// Value of an integral, with an estimate of its error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Integral<const N: usize> {
    /// The integral of each component; not finite where the function is not.
    pub value: [f64; N],
    /// Estimate of the error of each.
    pub error: [f64; N],
}

/// Integral of `f` from `a` to `b`, each component to a relative `tolerance` of itself where it does not change its sign.
///
/// The interval with the largest error is halved until the sum of the errors is small enough. The work is bounded: it ends at
/// 1000 intervals, or where halving no longer helps because `f` itself is not known better, as QUADPACK sees it
/// `[@piessens1983]`. The error says what was reached then.
pub fn integral<const N: usize>(
    f: &mut impl FnMut(f64) -> [f64; N],
    a: f64,
    b: f64,
    tolerance: f64,
) -> Integral<N> {
    let mut pieces = vec![Piece::over(f, a, b)];
    let mut idle = 0;
    loop {
        let whole = total(&pieces);
        // Share of the error allowed for a piece.
        let share = |error: &[f64; N]| {
            let shares =
                error.iter().zip(whole.value).map(|(error, value)| error / (tolerance * value.abs()));
            shares.filter(|share| !share.is_nan()).fold(0.0, f64::max)
        };
        let finite = whole.value.iter().all(|value| value.is_finite());
        if !finite || share(&whole.error) <= 1.0 || pieces.len() == INTERVALS || idle == IDLE {
            return whole;
        }
        let worst =
            |i: &usize, j: &usize| share(&pieces[*i].sum.error).total_cmp(&share(&pieces[*j].sum.error));
        let Some(at) = (0..pieces.len()).max_by(worst) else { return whole };
        let Piece { ends: [from, to], sum } = pieces[at];
        let middle = 0.5 * (from + to);
        let halves = [Piece::over(f, from, middle), Piece::over(f, middle, to)];
        let both = total(&halves);
        let still =
            (0..N).all(|i| (both.value[i] - sum.value[i]).abs() <= UNCHANGED_SUM * both.value[i].abs());
        if still && share(&both.error) >= GAIN * share(&sum.error) {
            idle += 1;
        }
        pieces[at] = halves[0];
        pieces.push(halves[1]);
    }
}

/// Part of an interval with its sum.
#[derive(Clone, Copy)]
struct Piece<const N: usize> {
    ends: [f64; 2],
    sum: Integral<N>,
}

impl<const N: usize> Piece<N> {
    fn over(f: &mut impl FnMut(f64) -> [f64; N], a: f64, b: f64) -> Self {
        Self { ends: [a, b], sum: kronrod(f, a, b) }
    }
}

fn total<const N: usize>(pieces: &[Piece<N>]) -> Integral<N> {
    let sum = |part: fn(&Integral<N>) -> &[f64; N]| {
        std::array::from_fn(|i| pieces.iter().map(|piece| part(&piece.sum)[i]).sum())
    };
    Integral { value: sum(|sum| &sum.value), error: sum(|sum| &sum.error) }
}

/// Kronrod sum over an interval with its error: the distance from the Gauss sum, less where both are small beside the variation of the
/// function, as in QUADPACK `[@piessens1983]`.
fn kronrod<const N: usize>(f: &mut impl FnMut(f64) -> [f64; N], a: f64, b: f64) -> Integral<N> {
    let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
    let mut values = [[[0.0; N]; 2]; KRONROD.len()];
    let (mut kronrod, mut gauss) = ([0.0; N], [0.0; N]);
    for ([node, weight, coarse], pair) in KRONROD.iter().zip(&mut values) {
        let sides = if *node == 0.0 { 1 } else { 2 };
        for (value, side) in pair.iter_mut().zip([half * node, -half * node]).take(sides) {
            *value = f(middle + side);
            for (i, value) in value.iter().enumerate() {
                kronrod[i] += half * weight * value;
                gauss[i] += half * coarse * value;
            }
        }
    }
    let error = |i: usize| {
        let mean = kronrod[i] / (b - a);
        let away = |(pair, node): (&[[f64; N]; 2], &[f64; 3])| {
            let sides = if node[0] == 0.0 { 1 } else { 2 };
            pair.iter().take(sides).map(|value| node[1] * (value[i] - mean).abs()).sum::<f64>()
        };
        let variation = (half * values.iter().zip(&KRONROD).map(away).sum::<f64>()).abs();
        let distance = (kronrod[i] - gauss[i]).abs();
        if variation > 0.0 { variation * (200.0 * distance / variation).powf(1.5).min(1.0) } else { distance }
    };
    Integral { value: kronrod, error: std::array::from_fn(error) }
}

/// Nodes on −1 to 1, ascending, and weights of Gauss's rule of `points` points, exact up to degree `2·points − 1`.
///
/// The nodes are the roots of Legendre's polynomial, by Newton's method from `cos π(i+¾)/(n+½)`.
#[must_use]
pub fn gauss_legendre(points: usize) -> Vec<[f64; 2]> {
    let mut rule = vec![[0.0; 2]; points];
    for i in 0..points.div_ceil(2) {
        let mut x =
            if 2 * i + 1 == points { 0.0 } else { (PI * (i as f64 + 0.75) / (points as f64 + 0.5)).cos() };
        for _ in 0..NEWTON {
            let [value, slope] = legendre(points, x);
            x -= value / slope;
        }
        let [_, slope] = legendre(points, x);
        let weight = 2.0 / ((1.0 - x) * (1.0 + x) * slope * slope);
        rule[i] = [-x, weight];
        rule[points - 1 - i] = [x, weight];
    }
    rule
}

/// Nodes on −1 to 1, ascending, and weights of Lobatto's rule of `points` points, the ends among them: exact up to degree
/// `2·points − 3`. At least two points.
///
/// The inner nodes are where the slope of Legendre's polynomial `P_n`, `n = points − 1`, vanishes.
#[must_use]
pub fn gauss_lobatto(points: usize) -> Vec<[f64; 2]> {
    let n = points - 1;
    let mut rule = vec![[0.0; 2]; points];
    let factor = (n * points) as f64;
    for i in 0..points.div_ceil(2) {
        let mut x = if 2 * i == n { 0.0 } else { (PI * i as f64 / n as f64).cos() };
        if i > 0 && 2 * i != n {
            for _ in 0..NEWTON {
                let [value, slope] = legendre(n, x);
                // (1 − x²) P″ = 2x P′ − n(n+1) P
                let curvature = (2.0 * x * slope - factor * value) / ((1.0 - x) * (1.0 + x));
                x -= slope / curvature;
            }
        }
        let value = if i == 0 { 1.0 } else { legendre(n, x)[0] };
        let weight = 2.0 / (factor * value * value);
        rule[i] = [-x, weight];
        rule[n - i] = [x, weight];
    }
    rule
}

/// Steps of Newton's method; from these starts three are enough for any number of points.
const NEWTON: usize = 5;

/// Legendre's polynomial of a degree and its derivative, within −1 to 1.
fn legendre(degree: usize, x: f64) -> [f64; 2] {
    let [mut before, mut value] = [0.0, 1.0];
    for n in 0..degree {
        let n = n as f64;
        [before, value] = [value, ((2.0 * n + 1.0) * x * value - n * before) / (n + 1.0)];
    }
    [value, degree as f64 * (before - x * value) / ((1.0 - x) * (1.0 + x))]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gauss_is_exact_up_to_twice_its_points() {
        for points in 1..30 {
            let rule = gauss_legendre(points);
            assert!(rule.windows(2).all(|pair| pair[0][0] < pair[1][0]));
            for power in 0..2 * points as i32 {
                let sum: f64 = rule.iter().map(|[x, weight]| weight * x.powi(power)).sum();
                let exact = if power % 2 == 0 { 2.0 / f64::from(power + 1) } else { 0.0 };
                assert!((sum - exact).abs() < 1e-14, "{points} points: x^{power} gives {sum}");
            }
        }
        let missed: f64 = gauss_legendre(3).iter().map(|[x, weight]| weight * x.powi(6)).sum();
        assert!((missed - 0.24).abs() < 1e-15, "2·5/9·(3/5)³ = 6/25, not 2/7");
    }

    #[test]
    fn lobatto_is_exact_up_to_twice_its_inner_points_and_one() {
        for points in 2..30 {
            let rule = gauss_lobatto(points);
            assert_eq!((rule[0][0], rule[points - 1][0]), (-1.0, 1.0));
            assert!(rule.windows(2).all(|pair| pair[0][0] < pair[1][0]));
            for power in 0..2 * points as i32 - 2 {
                let sum: f64 = rule.iter().map(|[x, weight]| weight * x.powi(power)).sum();
                let exact = if power % 2 == 0 { 2.0 / f64::from(power + 1) } else { 0.0 };
                assert!((sum - exact).abs() < 1e-14, "{points} points: x^{power} gives {sum}");
            }
        }
        let missed: f64 = gauss_lobatto(3).iter().map(|[x, weight]| weight * x.powi(4)).sum();
        assert!((missed - 2.0 / 3.0).abs() < 1e-15, "Simpson's rule gives 2/3, not 2/5");
    }

    #[test]
    fn a_narrow_peak_is_found_and_resolved() {
        let width = 1e-4;
        let mut calls = 0;
        let mut peak = |x: f64| {
            calls += 1;
            [width / ((x - 0.3).powi(2) + width * width), 2.0]
        };
        let Integral { value: [area, length], error } = integral(&mut peak, -1.0, 2.0, 1e-10);
        let exact = (1.7_f64 / width).atan() + (1.3_f64 / width).atan();
        assert!((area / exact - 1.0).abs() < 1e-10, "{area}");
        assert!((length - 6.0).abs() < 1e-14);
        assert!(error[0] < 1e-10 * area && error[0] >= (area - exact).abs(), "{error:?}");
        assert!(calls < 2_000, "{calls}");
    }

    #[test]
    fn what_is_infinite_stays_so() {
        assert_eq!(integral(&mut |_| [f64::INFINITY], 0.0, 1.0, 1e-9).value, [f64::INFINITY]);
        assert!(integral(&mut |_| [f64::NAN], 0.0, 1.0, 1e-9).value[0].is_nan());
    }

    /// A function that is known to six digits, one that has no integral, one that never settles: the work stays bounded, and the error says
    /// what is known.
    #[test]
    fn what_cannot_be_found_ends_and_says_so() {
        let calls = std::cell::Cell::new(0_u32);
        let counted = |value: f64| {
            calls.set(calls.get() + 1);
            [value]
        };
        let hash =
            |x: f64| (x.to_bits().wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 11) as f64 / (1_u64 << 53) as f64;
        let noisy = integral(&mut |x| counted(x.exp() * (1.0 + 1e-6 * (hash(x) - 0.5))), 0.0, 1.0, 1e-10);
        let gap = (noisy.value[0] - (1.0_f64.exp() - 1.0)).abs();
        assert!(gap < 1e-6 && noisy.error[0] > 0.1 * gap && noisy.error[0] < 1e-4, "{noisy:?} {gap:e}");
        assert!(calls.replace(0) < 2_000);
        let endless = integral(&mut |x| counted(1.0 / x), 0.0, 1.0, 1e-10);
        assert!(endless.error[0] > 1e-10 * endless.value[0], "{endless:?}");
        assert!(calls.replace(0) < 30_100);
        let wild = integral(&mut |x| counted(hash(x)), 0.0, 1.0, 1e-10);
        assert!(wild.error[0] > 1e-3, "{wild:?}");
        assert!(calls.replace(0) < 30_100);
    }
}
