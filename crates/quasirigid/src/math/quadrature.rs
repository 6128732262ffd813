//! Integrals of several functions at once, adaptive.

/// Nodes of Kronrod's rule of 15 points on −1 to 1, with its weights and those of the Gauss rule of 7 points within it.
const NODES: [[f64; 3]; 8] = [
    [0.991_455_371_120_812_6, 0.022_935_322_010_529_224, 0.0],
    [0.949_107_912_342_758_5, 0.063_092_092_629_978_56, 0.129_484_966_168_869_7],
    [0.864_864_423_359_769_1, 0.104_790_010_322_250_19, 0.0],
    [0.741_531_185_599_394_4, 0.140_653_259_715_525_92, 0.279_705_391_489_276_64],
    [0.586_087_235_467_691_1, 0.169_004_726_639_267_9, 0.0],
    [0.405_845_151_377_397_2, 0.190_350_578_064_785_4, 0.381_830_050_505_118_93],
    [0.207_784_955_007_898_47, 0.204_432_940_075_298_9, 0.0],
    [0.0, 0.209_482_141_084_727_82, 0.417_959_183_673_469_4],
];
/// Halvings of an interval, at most.
const DEPTH: u32 = 40;

/// Integral of `f` from `a` to `b`, each component to a relative `tolerance` of itself; not finite where `f` is not.
pub fn integral<const N: usize>(
    f: &mut impl FnMut(f64) -> [f64; N],
    a: f64,
    b: f64,
    tolerance: f64,
) -> [f64; N] {
    let (whole, error) = kronrod(f, a, b);
    refined(f, [a, b], (whole, error), whole.map(|sum| tolerance * sum.abs()), DEPTH)
}

/// The integral over an interval, halved until the error is below the one allowed.
fn refined<const N: usize>(
    f: &mut impl FnMut(f64) -> [f64; N],
    [a, b]: [f64; 2],
    (whole, error): ([f64; N], [f64; N]),
    allowed: [f64; N],
    depth: u32,
) -> [f64; N] {
    let finite = whole.iter().all(|sum| sum.is_finite());
    if depth == 0 || !finite || error.iter().zip(allowed).all(|(error, allowed)| *error <= allowed) {
        return whole;
    }
    let middle = 0.5 * (a + b);
    let halves = [kronrod(f, a, middle), kronrod(f, middle, b)];
    let allowed: [f64; N] =
        std::array::from_fn(|i| 0.5 * allowed[i].max(f64::EPSILON * (halves[0].0[i] + halves[1].0[i]).abs()));
    let [first, second] = [[a, middle], [middle, b]];
    let [left, right] = [(first, halves[0]), (second, halves[1])]
        .map(|(span, half)| refined(f, span, half, allowed, depth - 1));
    std::array::from_fn(|i| left[i] + right[i])
}

/// Kronrod's sum over an interval, and its distance from Gauss's.
fn kronrod<const N: usize>(f: &mut impl FnMut(f64) -> [f64; N], a: f64, b: f64) -> ([f64; N], [f64; N]) {
    let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
    let (mut kronrod, mut gauss) = ([0.0; N], [0.0; N]);
    for [node, weight, coarse] in NODES {
        let sides = if node == 0.0 { 1 } else { 2 };
        for side in [half * node, -half * node].into_iter().take(sides) {
            for (i, value) in f(middle + side).into_iter().enumerate() {
                kronrod[i] += half * weight * value;
                gauss[i] += half * coarse * value;
            }
        }
    }
    (kronrod, std::array::from_fn(|i| (kronrod[i] - gauss[i]).abs()))
}

#[cfg(test)]
mod tests {
    use super::*;

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
