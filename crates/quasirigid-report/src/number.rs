//! Numbers as a reader wants them: few digits, powers of ten as superscripts, thin spaces between thousands.

/// At most four significant digits, zeros at the end dropped: for a number that stands alone.
pub fn short(value: f64) -> String {
    tidy(value, 4)
}

/// At most so many significant digits, zeros at the end dropped.
pub fn tidy(value: f64, significant: usize) -> String {
    let text = digits(value, significant);
    let (number, power) = text.split_at(text.find('×').unwrap_or(text.len()));
    match number.contains('.') {
        true => number.trim_end_matches('0').trim_end_matches('.').to_owned() + power,
        false => text,
    }
}

/// So many significant digits, zeros included: for a number beside others of its kind.
///
/// Plain from 0.001 to a million, with a power of ten outside.
pub fn digits(value: f64, significant: usize) -> String {
    if !value.is_finite() {
        return not_finite(value);
    }
    let (mantissa, exponent) = scientific(value, significant);
    match exponent {
        _ if value == 0.0 => "0".into(),
        -3..6 => fixed(value, (significant as i32 - 1 - exponent).max(0) as usize),
        _ => format!("{}×{}", mantissa.replace('-', "−"), power_of_ten(exponent)),
    }
}

/// A ratio in percent, two significant digits below one percent, three above.
pub fn percent(ratio: f64) -> String {
    let percent = 100.0 * ratio;
    format!("{}\u{a0}%", tidy(percent, if percent.abs() < 1.0 { 2 } else { 3 }))
}

/// Numbers of one kind with the decimal points under each other: the common power of ten, and the numbers over it.
///
/// The largest gets so many significant digits, the others as many decimals: rounding noise beside it reads as zero.
pub fn aligned(values: &[f64], significant: usize) -> (i32, Vec<String>) {
    let largest = values.iter().filter(|v| v.is_finite()).fold(0.0, |a: f64, v| a.max(v.abs()));
    let (_, exponent) = scientific(largest, significant);
    let power = if (-3..6).contains(&exponent) { 0 } else { exponent };
    let decimals = (significant as i32 - 1 - (exponent - power)).max(0) as usize;
    let text = |&value: &f64| match value.is_finite() {
        true => fixed(over_power(value, power), decimals),
        false => not_finite(value),
    };
    (power, values.iter().map(text).collect())
}

/// `value / 10ᵖᵒʷᵉʳ`, also where `10ᵖᵒʷᵉʳ` itself is out of range.
pub fn over_power(value: f64, power: i32) -> f64 {
    let half = power / 2;
    value / 10f64.powi(half) / 10f64.powi(power - half)
}

/// A unit with a power of ten before it, as `10³ rad/s`.
pub fn unit_with_power(power: i32, unit: &str) -> String {
    match power {
        0 => unit.to_owned(),
        _ => format!("{} {unit}", power_of_ten(power)),
    }
}

/// `10ⁿ`.
pub fn power_of_ten(power: i32) -> String {
    let superscript = |digit: char| match digit {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        _ => char::from_u32(0x2070 + digit as u32 - '0' as u32).unwrap_or(digit),
    };
    format!("10{}", power.to_string().chars().map(superscript).collect::<String>())
}

/// So many decimals, with a true minus sign, no minus before zero and thin spaces between thousands.
pub fn fixed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let (negative, text) = text.strip_prefix('-').map_or((false, text.as_str()), |rest| (true, rest));
    let (whole, fraction) = text.split_once('.').map_or((text, ""), |(whole, fraction)| (whole, fraction));
    let mut out = String::new();
    if negative && text.contains(|c: char| ('1'..='9').contains(&c)) {
        out.push('−');
    }
    for (i, digit) in whole.chars().enumerate() {
        if whole.len() > 4 && i > 0 && (whole.len() - i).is_multiple_of(3) {
            out.push('\u{202f}');
        }
        out.push(digit);
    }
    if !fraction.is_empty() {
        out.push('.');
        out.push_str(fraction);
    }
    out
}

/// A duration in the unit that suits it.
pub fn duration(seconds: f64) -> String {
    let (name, scale) = time_unit(seconds);
    format!("{}\u{a0}{name}", tidy(seconds / scale, 3))
}

/// The unit that suits a time: its name, and its length in seconds.
pub fn time_unit(seconds: f64) -> (&'static str, f64) {
    const YEAR: f64 = 31_557_600.0;
    const UNITS: [(&str, f64); 8] = [
        ("Gyr", 1e9 * YEAR),
        ("Myr", 1e6 * YEAR),
        ("kyr", 1e3 * YEAR),
        ("yr", YEAR),
        ("d", 86_400.0),
        ("h", 3600.0),
        ("min", 60.0),
        ("s", 1.0),
    ];
    let enough = |&&(_, scale): &&(&str, f64)| seconds.abs() >= 1.5 * scale;
    *UNITS.iter().find(enough).unwrap_or(&("s", 1.0))
}

/// Mantissa and exponent after rounding.
fn scientific(value: f64, significant: usize) -> (String, i32) {
    let text = format!("{value:.*e}", significant - 1);
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    (mantissa.to_owned(), exponent.parse().unwrap_or(0))
}

fn not_finite(value: f64) -> String {
    match value {
        _ if value.is_nan() => "undefined".into(),
        _ if value > 0.0 => "∞".into(),
        _ => "−∞".into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_are_those_a_reader_wants() {
        let cases = [
            (0.0, "0"),
            (-0.0, "0"),
            (1.0 / 3.0, "0.3333"),
            (-0.25, "−0.25"),
            (12_345.678, "12\u{202f}346"),
            (9.999_96, "10"),
            (999_999.9, "1×10⁶"),
            (1.234_56e-7, "1.235×10⁻⁷"),
            (-5e-324, "−4.941×10⁻³²⁴"),
            (f64::NAN, "undefined"),
            (f64::NEG_INFINITY, "−∞"),
        ];
        for (value, text) in cases {
            assert_eq!(short(value), text, "{value:e}");
        }
        assert_eq!(
            [digits(0.5, 3), digits(-1e-9, 2), digits(9.999, 3), digits(0.0, 3)],
            ["0.500", "−1.0×10⁻⁹", "10.0", "0"]
        );
    }

    #[test]
    fn aligned_numbers_share_a_power_and_hide_noise() {
        assert_eq!(
            aligned(&[9.5, -1e-17, 16.25], 6),
            (0, vec!["9.5000".into(), "0.0000".into(), "16.2500".into()])
        );
        assert_eq!(aligned(&[2e300, -1e299], 6), (300, vec!["2.00000".into(), "−0.10000".into()]));
        assert_eq!(aligned(&[], 6), (0, vec![]));
    }

    #[test]
    fn durations_choose_their_unit() {
        assert_eq!(duration(7200.0), "2\u{a0}h");
        assert_eq!(duration(89.0), "89\u{a0}s");
        assert_eq!(duration(1e10), "317\u{a0}yr");
        assert_eq!(duration(5e11), "15.8\u{a0}kyr");
        assert_eq!(duration(1e14), "3.17\u{a0}Myr");
        assert_eq!(duration(1e17), "3.17\u{a0}Gyr");
        assert_eq!(percent(0.001_234), "0.12\u{a0}%");
    }
}
