//! Integrals: adaptive, of several functions at once, and by Gauss's rule.

use std::f64::consts::PI;

/// Nodes of Kronrod's rule of 15 points on −1 to 1, with its weights and those of the Gauss rule of 7 points within it.
const NODES: [[f64; 3]; 8] = [
    [0.991_455_371_120_812_6, 0.022_935_322_010_529_224, 0.0],
    [0.949_107_912_342_758_5, 0.063_092_092_629_978_56, 0.129_484_966_168_869_7],
    [0.864_864_423_359_769_1, 0.104_790_010_322_250_19, 0.0],
    [0.741_531_185_599_394_4, 0.140_653_259_715_525_92, 0.279_705_391_489_276_64],
    [0.586_087_235_467_691_1, 0.169_004_726_639_267_9, 0.0],
    [0.405_845_151_377_397_2, 0.190_350_578_064_785_4, 0.381_830_050_505_118_9],
    [0.207_784_955_007_898_47, 0.204_432_940_075_298_9, 0.0],
    [0.0, 0.209_482_141_084_727_82, 0.417_959_183_673_469_4],
];
/// Halvings of an interval, at most.
const DEPTH: u32 = 40;

/// Integral of `f` from `a` to `b`, each component to a relative `tolerance` of itself where it does not change its sign; not
/// finite where `f` is not.
pub fn integral<const N: usize>(
    f: &mut impl FnMut(f64) -> [f64; N],
    a: f64,
    b: f64,
    tolerance: f64,
) -> [f64; N] {
    let whole = kronrod(f, a, b);
    refined(f, [a, b], whole, ([0.0; N], tolerance), DEPTH)
}

/// A sum over an interval, and its error.
type Sum<const N: usize> = ([f64; N], [f64; N]);

/// The integral over an interval, halved until the error is below the one allowed, or the relative one.
fn refined<const N: usize>(
    f: &mut impl FnMut(f64) -> [f64; N],
    [a, b]: [f64; 2],
    (sum, error): Sum<N>,
    (allowed, relative): ([f64; N], f64),
    depth: u32,
) -> [f64; N] {
    let allowed: [f64; N] = std::array::from_fn(|i| allowed[i].max(relative * sum[i].abs()));
    let finite = sum.iter().all(|sum| sum.is_finite());
    if depth == 0 || !finite || error.iter().zip(allowed).all(|(error, allowed)| *error <= allowed) {
        return sum;
    }
    let middle = 0.5 * (a + b);
    let limits = (allowed.map(|error| 0.5 * error), relative);
    let mut part = |from: f64, to: f64| {
        let sum = kronrod(f, from, to);
        refined(f, [from, to], sum, limits, depth - 1)
    };
    let (left, right) = (part(a, middle), part(middle, b));
    std::array::from_fn(|i| left[i] + right[i])
}

/// Kronrod's sum over an interval with its error: the distance from Gauss's sum, less where both are small beside the
/// variation of the function, as QUADPACK estimates it `[@piessens1983]`.
fn kronrod<const N: usize>(f: &mut impl FnMut(f64) -> [f64; N], a: f64, b: f64) -> Sum<N> {
    let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
    let mut values = [[[0.0; N]; 2]; NODES.len()];
    let (mut kronrod, mut gauss) = ([0.0; N], [0.0; N]);
    for ([node, weight, coarse], pair) in NODES.iter().zip(&mut values) {
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
        let variation = (half * values.iter().zip(&NODES).map(away).sum::<f64>()).abs();
        let distance = (kronrod[i] - gauss[i]).abs();
        if variation > 0.0 { variation * (200.0 * distance / variation).powf(1.5).min(1.0) } else { distance }
    };
    (kronrod, std::array::from_fn(error))
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
        let [area, length] = integral(&mut peak, -1.0, 2.0, 1e-10);
        let exact = (1.7_f64 / width).atan() + (1.3_f64 / width).atan();
        assert!((area / exact - 1.0).abs() < 1e-10, "{area}");
        assert!((length - 6.0).abs() < 1e-14);
        assert!(calls < 2_000, "{calls}");
    }

    #[test]
    fn what_is_infinite_stays_so() {
        assert_eq!(integral(&mut |_| [f64::INFINITY], 0.0, 1.0, 1e-9), [f64::INFINITY]);
    }
}
