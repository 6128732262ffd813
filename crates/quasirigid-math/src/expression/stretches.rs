//! Stretches of a history over which its values keep their sign, or change in one direction.

/// Stretch of a history, ascending.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stretch {
    /// Sign of its values, or of their change.
    pub sign: f64,
    /// Places after and before which the next sign begins.
    pub ends: [f64; 2],
    /// Largest value, or whole change.
    pub size: f64,
    /// Places whose values show that.
    pub shown: [f64; 2],
}

/// Stretches of one sign of places and values; zeros and what is no number belong to none.
pub(super) fn of_sign(history: &[[f64; 2]]) -> Vec<Stretch> {
    let mut found: Vec<Stretch> = Vec::new();
    for [x, value] in history.iter().copied().filter(|[_, value]| *value != 0.0 && !value.is_nan()) {
        let (sign, size) = (value.signum(), value.abs());
        match found.last_mut().filter(|last| last.sign == sign) {
            Some(last) => {
                last.ends[1] = x;
                if size > last.size {
                    (last.size, last.shown) = (size, [x; 2]);
                }
            }
            None => found.push(Stretch { sign, ends: [x; 2], size, shown: [x; 2] }),
        }
    }
    found
}

/// Stretches over which the values of places grow, or fall.
pub(super) fn of_slope(history: &[[f64; 2]]) -> Vec<Stretch> {
    let mut found: Vec<Stretch> = Vec::new();
    let known: Vec<[f64; 2]> = history.iter().copied().filter(|[_, value]| !value.is_nan()).collect();
    for [[a, before], [b, value]] in known.array_windows() {
        let change = value - before;
        if change == 0.0 {
            continue;
        }
        match found.last_mut().filter(|last| last.sign == change.signum()) {
            Some(last) => {
                last.ends[1] = *a;
                last.size += change.abs();
                last.shown[1] = *b;
            }
            None => found.push(Stretch {
                sign: change.signum(),
                ends: [*b, *a],
                size: change.abs(),
                shown: [*a, *b],
            }),
        }
    }
    found
}

/// Intervals between stretches of opposite signs, each with the sign before it; those of like signs side by side are one.
pub(super) fn turns(stretches: &[Stretch]) -> impl Iterator<Item = ([f64; 2], f64)> + '_ {
    let pairs = stretches.array_windows().filter(|[a, b]| a.sign != b.sign);
    pairs.map(|[a, b]| ([a.ends[1], b.ends[0]], a.sign))
}
