//! Bisection: root of a monotonic function of one variable.

/// Halvings of an interval: past the resolution of the numbers.
const HALVINGS: usize = 200;

/// Place in an interval where a monotonic function, `rising` or falling, takes a value that lies between those at the ends.
pub fn bisected(
    [mut low, mut high]: [f64; 2],
    function: impl Fn(f64) -> f64,
    value: f64,
    rising: bool,
) -> f64 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if (function(middle) < value) == rising {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_found_to_rounding() {
        for wanted in [-2.5, 1e-3, 0.7] {
            let cube = |x: f64| x.powi(3);
            let found = bisected([-3.0, 2.0], cube, cube(wanted), true);
            assert!((found / wanted - 1.0).abs() < 4.0 * f64::EPSILON, "{found}");
            let found = bisected([-3.0, 2.0], |x| -cube(x), -cube(wanted), false);
            assert!((found / wanted - 1.0).abs() < 4.0 * f64::EPSILON, "{found}");
        }
    }
}
