//! Densities of the values of voxels: of values in a unit of density, or of grey values by the densities of some of them.

/// Density (kg/m³) of a value.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum DensityRule {
    /// Values are densities in a unit of so many kg/m³.
    Unit(f64),
    /// Grey values in ascending order, two at least, and their densities; straight between them, and straight on beyond the outermost two.
    Calibrated(Vec<[f64; 2]>),
}

impl DensityRule {
    pub(super) fn of(&self, value: f64) -> f64 {
        match self {
            Self::Unit(unit) => unit * value,
            Self::Calibrated(points) => {
                let inner = &points[1..points.len() - 1];
                let first = inner.partition_point(|[grey, _]| *grey <= value);
                let [[a, low], [b, high]] = [points[first], points[first + 1]];
                low + (value - a) / (b - a) * (high - low)
            }
        }
    }
}

/// Least, greatest and mean density, in words.
pub(super) fn told(densities: &[f64]) -> String {
    let (least, greatest) = densities
        .iter()
        .fold((f64::INFINITY, 0.0_f64), |(least, most), density| (least.min(*density), most.max(*density)));
    let mean = densities.iter().sum::<f64>() / densities.len() as f64;
    let [least, greatest, mean] = [least, greatest, mean].map(six_digits);
    format!("densities are {least} to {greatest} kg/m³, {mean} in the mean")
}

/// A positive number to six significant digits.
fn six_digits(number: f64) -> f64 {
    let scale = 10.0_f64.powi(5 - number.log10().floor() as i32);
    (number * scale).round() / scale
}

#[cfg(test)]
mod tests {
    use super::DensityRule;

    #[test]
    fn densities_go_straight_through_the_calibrated_values() {
        let rule = DensityRule::Calibrated(vec![[-1000.0, 0.0], [0.0, 1000.0], [3000.0, 2500.0]]);
        for (grey, density) in [
            (-1000.0, 0.0),
            (-250.0, 750.0),
            (0.0, 1000.0),
            (1000.0, 1500.0),
            (4000.0, 3000.0),
            (-1100.0, -100.0),
        ] {
            assert_eq!(rule.of(grey), density, "{grey}");
        }
        let two = DensityRule::Calibrated(vec![[10.0, 100.0], [20.0, 300.0]]);
        assert_eq!([0.0, 10.0, 15.0, 30.0].map(|grey| two.of(grey)), [-100.0, 100.0, 200.0, 500.0]);
        assert_eq!(DensityRule::Unit(1000.0).of(2.7), 2700.0);
    }
}
