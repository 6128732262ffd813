//! Unit symbols with their SI values, prefixes, and words that people write for them.
//! Values are fractions of exact numbers, as the units are defined, and prefixes apply only where the SI or usage has them.

use std::f64::consts::{PI, TAU};

use super::dimension::Exponents;
use crate::nearest::nearest;

/// A unit as a fraction `up / down` of the SI unit with the same exponents.
///
/// The fraction keeps decimal units exact: 1 mm is 1/1000 m, and 22 mm is the number closest to 0.022 m.
#[derive(Clone, Copy, Debug)]
pub(super) struct Unit {
    pub(super) up: f64,
    pub(super) down: f64,
    pub(super) exponents: Exponents,
}

/// Prefixes a symbol can have.
#[derive(Clone, Copy, PartialEq)]
enum Prefixes {
    None,
    Si,
    /// Only those for long times: kyr, Myr, Gyr.
    Large,
}

use Prefixes::{Large, None as Bare, Si};

const POUND: f64 = 0.453_592_37;
const FOOT: f64 = 0.304_8;
const INCH: f64 = 0.025_4;
const POUND_FORCE: f64 = POUND * 9.806_65;

const NUMBER: Exponents = [0, 0, 0, 0, 0];
const MASS: Exponents = [1, 0, 0, 0, 0];
const LENGTH: Exponents = [0, 1, 0, 0, 0];
const TIME: Exponents = [0, 0, 1, 0, 0];
const ANGLE: Exponents = [0, 0, 0, 0, 1];
const FREQUENCY: Exponents = [0, 0, -1, 0, 0];
const ANGULAR_VELOCITY: Exponents = [0, 0, -1, 0, 1];
const FORCE: Exponents = [1, 1, -2, 0, 0];
const PRESSURE: Exponents = [1, -1, -2, 0, 0];
const ENERGY: Exponents = [1, 2, -2, 0, 0];
const POWER: Exponents = [1, 2, -3, 0, 0];
const KINEMATIC_VISCOSITY: Exponents = [0, 2, -1, 0, 0];
const VISCOSITY: Exponents = [1, -1, -1, 0, 0];
const CURRENT: Exponents = [0, 0, 0, 1, 0];
const MAGNETIC_FIELD: Exponents = [1, 0, -2, -1, 0];
const CONDUCTANCE: Exponents = [-1, -2, 3, 2, 0];

/// Symbol, `up`, `down`, exponents, prefixes. Feet and pounds are the international ones, the year is the Julian year
/// and the astronomical unit that of the IAU (2012).
const SYMBOLS: &[(&str, f64, f64, Exponents, Prefixes)] = &[
    ("1", 1.0, 1.0, NUMBER, Bare),
    ("g", 1.0, 1e3, MASS, Si),
    ("t", 1e3, 1.0, MASS, Bare),
    ("lb", POUND, 1.0, MASS, Bare),
    ("oz", POUND, 16.0, MASS, Bare),
    ("slug", POUND_FORCE, FOOT, MASS, Bare),
    ("m", 1.0, 1.0, LENGTH, Si),
    ("in", INCH, 1.0, LENGTH, Bare),
    ("ft", FOOT, 1.0, LENGTH, Bare),
    ("yd", 0.914_4, 1.0, LENGTH, Bare),
    ("mi", 1_609.344, 1.0, LENGTH, Bare),
    ("AU", 149_597_870_700.0, 1.0, LENGTH, Bare),
    ("au", 149_597_870_700.0, 1.0, LENGTH, Bare),
    ("s", 1.0, 1.0, TIME, Si),
    ("min", 60.0, 1.0, TIME, Bare),
    ("h", 3_600.0, 1.0, TIME, Bare),
    ("hr", 3_600.0, 1.0, TIME, Bare),
    ("d", 86_400.0, 1.0, TIME, Bare),
    ("yr", 31_557_600.0, 1.0, TIME, Large),
    ("rad", 1.0, 1.0, ANGLE, Si),
    ("deg", PI, 180.0, ANGLE, Bare),
    ("°", PI, 180.0, ANGLE, Bare),
    ("arcmin", PI, 10_800.0, ANGLE, Bare),
    ("arcsec", PI, 648_000.0, ANGLE, Bare),
    ("rev", TAU, 1.0, ANGLE, Bare),
    ("rpm", TAU, 60.0, ANGULAR_VELOCITY, Bare),
    ("Hz", 1.0, 1.0, FREQUENCY, Si),
    ("N", 1.0, 1.0, FORCE, Si),
    ("lbf", POUND_FORCE, 1.0, FORCE, Bare),
    ("ozf", POUND_FORCE, 16.0, FORCE, Bare),
    ("dyn", 1.0, 1e5, FORCE, Bare),
    ("Pa", 1.0, 1.0, PRESSURE, Si),
    ("bar", 1e5, 1.0, PRESSURE, Bare),
    ("psi", POUND_FORCE, INCH * INCH, PRESSURE, Bare),
    ("ksi", 1e3 * POUND_FORCE, INCH * INCH, PRESSURE, Bare),
    ("J", 1.0, 1.0, ENERGY, Si),
    ("erg", 1.0, 1e7, ENERGY, Bare),
    ("W", 1.0, 1.0, POWER, Si),
    ("St", 1.0, 1e4, KINEMATIC_VISCOSITY, Si),
    ("P", 1.0, 10.0, VISCOSITY, Si),
    ("A", 1.0, 1.0, CURRENT, Si),
    ("T", 1.0, 1.0, MAGNETIC_FIELD, Si),
    ("S", 1.0, 1.0, CONDUCTANCE, Si),
];

const PREFIXES: &[(&str, i32)] = &[
    ("da", 1),
    ("h", 2),
    ("k", 3),
    ("M", 6),
    ("G", 9),
    ("T", 12),
    ("P", 15),
    ("d", -1),
    ("c", -2),
    ("m", -3),
    ("u", -6),
    ("µ", -6),
    ("μ", -6),
    ("n", -9),
    ("p", -12),
    ("f", -15),
];

/// Words people write for a symbol.
const WORDS: &[(&str, &str)] = &[
    ("gram", "g"),
    ("kilogram", "kg"),
    ("kgs", "kg"),
    ("kilo", "kg"),
    ("tonne", "t"),
    ("ton", "t"),
    ("pound", "lb"),
    ("lbs", "lb"),
    ("lbm", "lb"),
    ("ounce", "oz"),
    ("meter", "m"),
    ("metre", "m"),
    ("kilometer", "km"),
    ("millimeter", "mm"),
    ("inch", "in"),
    ("inches", "in"),
    ("foot", "ft"),
    ("feet", "ft"),
    ("yard", "yd"),
    ("mile", "mi"),
    ("sec", "s"),
    ("second", "s"),
    ("minute", "min"),
    ("hr", "h"),
    ("hour", "h"),
    ("day", "d"),
    ("year", "yr"),
    ("y", "yr"),
    ("radian", "rad"),
    ("degree", "deg"),
    ("turn", "rev"),
    ("hertz", "Hz"),
    ("newton", "N"),
    ("pascal", "Pa"),
    ("stokes", "St"),
    ("joule", "J"),
    ("ampere", "A"),
    ("amp", "A"),
    ("tesla", "T"),
    ("siemens", "S"),
];

/// The unit with this symbol, with or without a prefix.
pub(super) fn unit(symbol: &str) -> Option<Unit> {
    bare(symbol, 0, |_| true).or_else(|| {
        PREFIXES.iter().find_map(|(prefix, power)| {
            let symbol = symbol.strip_prefix(prefix)?;
            bare(symbol, *power, |allowed| allowed == Si || (allowed == Large && *power >= 3))
        })
    })
}

/// The unit with this symbol times a power of ten, if the symbol allows it.
fn bare(symbol: &str, power: i32, allows: impl Fn(Prefixes) -> bool) -> Option<Unit> {
    let (_, up, down, exponents, _) =
        SYMBOLS.iter().find(|(name, .., prefixes)| *name == symbol && allows(*prefixes))?;
    Some(Unit {
        up: up * 10f64.powi(power.max(0)),
        down: down * 10f64.powi((-power).max(0)),
        exponents: *exponents,
    })
}

/// The symbol that an unknown one probably means.
pub(super) fn suggestion(symbol: &str) -> Option<&'static str> {
    let word = symbol.to_lowercase();
    let singular = word.strip_suffix('s').unwrap_or(&word);
    let spelled =
        WORDS.iter().find(|(name, _)| *name == word || *name == singular).map(|(_, symbol)| *symbol);
    let common = ["kg", "mm", "cm", "km", "kN", "MPa", "GPa", "ms", "mrad", "kyr", "Myr", "Gyr", "cSt", "cP"];
    spelled.or_else(|| nearest(symbol, SYMBOLS.iter().map(|(name, ..)| *name).chain(common)))
}
