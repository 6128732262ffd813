//! Resolution of the numbers of a file: the half of the last place that is written or stored.

/// How finely numbers are written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Resolution {
    /// Digits in text: at most so many places behind the point and so many significant digits. A column with fixed places shows its coarseness
    /// by the first, one with fixed digits by the second, whatever zeros its writer leaves out.
    Decimal {
        /// Places behind the decimal point.
        decimals: i32,
        /// Significant digits.
        significant: i32,
    },
    /// Single precision.
    Single,
    /// Double precision.
    Double,
}

/// Significant digits of a double, and of a number of single precision.
const OF_DOUBLE: i32 = 17;
const OF_SINGLE: i32 = 9;

impl Resolution {
    /// Half of the last place of a number: the most by which rounding may have changed it.
    #[must_use]
    pub fn error(self, value: f64) -> f64 {
        let stored = 0.5 * f64::EPSILON * value.abs();
        match self {
            Self::Double => stored,
            Self::Single => 0.5 * f64::from(f32::EPSILON) * value.abs(),
            Self::Decimal { decimals, significant } => {
                let fixed = if significant >= OF_DOUBLE { 0.0 } else { 0.5 * 10_f64.powi(-decimals) };
                let leading = if value == 0.0 { i32::MIN } else { value.abs().log10().floor() as i32 };
                let relative = match leading {
                    i32::MIN => 0.0,
                    leading => 0.5 * 10_f64.powi(leading + 1 - significant),
                };
                fixed.max(relative).max(stored)
            }
        }
    }

    /// Resolution of columns that one writer wrote: digits are those of the finest, since a column of ones has none of its own, and single
    /// precision where more digits are written than it has.
    pub(super) fn shared(columns: &[(Self, &[f64])]) -> Self {
        let single = |value: &f64| f64::from(*value as f32) == *value;
        let worse = |one: Self, other: Self| match (one, other) {
            (
                Self::Decimal { decimals, significant },
                Self::Decimal { decimals: places, significant: digits },
            ) => Self::Decimal { decimals: decimals.max(places), significant: significant.max(digits) },
            (Self::Double, other) | (other, Self::Double) => other,
            (Self::Single, other) | (other, Self::Single) => other,
        };
        let found = columns.iter().map(|(resolution, _)| *resolution).reduce(worse).unwrap_or(Self::Double);
        match found {
            Self::Decimal { significant, .. } if significant > OF_SINGLE => {
                let all = columns.iter().all(|(_, values)| values.iter().all(single));
                if all { Self::Single } else { found }
            }
            other => other,
        }
    }

    /// Resolution in words.
    #[must_use]
    pub fn words(self) -> String {
        match self {
            Self::Decimal { significant, .. } if significant >= OF_DOUBLE - 1 => {
                "double precision".to_owned()
            }
            Self::Decimal { significant: 1, .. } => "1 digit".to_owned(),
            Self::Decimal { significant, .. } => format!("{significant} digits"),
            Self::Single => "single precision".to_owned(),
            Self::Double => "double precision".to_owned(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_coarser_of_places_and_digits_counts() {
        let error = |decimals, significant, value| Resolution::Decimal { decimals, significant }.error(value);
        assert!((error(4, 5, 0.01) / 0.5e-4 - 1.0).abs() < 1e-12); // %.4f of 1.2345 and 0.01
        assert!((error(6, 4, 1.5) / 0.5e-3 - 1.0).abs() < 1e-12); // %.4g of 0.001234 and 1.5
        assert!((error(18, 17, 0.2) - 0.5 * f64::EPSILON * 0.2).abs() < 1e-16);
        assert_eq!(Resolution::Single.error(0.0), 0.0);
    }

    #[test]
    fn single_precision_shows_behind_many_digits() {
        let written = Resolution::Decimal { decimals: 20, significant: 17 };
        let singles = [0.1_f32, 0.7, 1e-3].map(f64::from);
        assert_eq!(Resolution::shared(&[(written, &singles), (written, &[0.0, 1.0])]), Resolution::Single);
        assert_eq!(Resolution::shared(&[(written, &singles), (written, &[0.1])]), written);
    }

    #[test]
    fn columns_of_one_writer_share_their_digits() {
        let [fine, plain] =
            [(5, 6), (0, 1)].map(|(decimals, significant)| Resolution::Decimal { decimals, significant });
        assert_eq!(Resolution::shared(&[(plain, &[1.0]), (fine, &[0.12345])]), fine);
    }
}
