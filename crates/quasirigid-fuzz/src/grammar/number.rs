//! Numbers of a model file: near a typical value, and now and then one that no body has.

use arbitrary::Unstructured;

use super::choice::{below, chance, pick};

/// Numbers that no body has, and values that are none.
const HOSTILE: [&str; 40] = [
    "0",
    "-1",
    "0.0",
    "-0.0",
    "1e308",
    "-1e308",
    "1e-308",
    "5e-324",
    "1e154",
    "1e-154",
    "1e100",
    "1e-100",
    "1e30",
    "1e-30",
    "nan",
    "inf",
    "-inf",
    "1e400",
    "9223372036854775807",
    "9223372036854775808",
    "-9223372036854775809",
    "0x7fffffffffffffff",
    "0b1",
    "1_000",
    "true",
    "\"\"",
    "\"x\"",
    "[]",
    "{}",
    "[1, 2]",
    "[[1]]",
    "1979-05-27",
    "\"1e308 km\"",
    "\"1e-320 m\"",
    "\"3 furlongs\"",
    "\"2 kg m/s\"",
    "\"1 1/s\"",
    "\"-5 rpm\"",
    "\"nan m\"",
    "\"12 km^3/s^2\"",
];

/// Writer of numbers with some share of hostile ones.
#[derive(Debug)]
pub struct Numbers<'u, 'b> {
    /// Source of the choices.
    pub u: &'u mut Unstructured<'b>,
    /// Hostile numbers in 256.
    hostility: u8,
}

impl<'u, 'b> Numbers<'u, 'b> {
    /// Numbers of a file: most files have few hostile ones or none, or no file would pass its reader.
    pub fn new(u: &'u mut Unstructured<'b>) -> Self {
        let hostility = [0, 0, 0, 1, 2, 4, 20][below(u, 7)];
        Self { u, hostility }
    }

    /// A number near a typical value, which gives its sign.
    pub fn near(&mut self, typical: f64) -> String {
        if chance(self.u, self.hostility) {
            return pick(self.u, &HOSTILE).to_owned();
        }
        let share = 0.25 + below(self.u, 1024) as f64 / 256.0;
        let far = if chance(self.u, self.hostility) { below(self.u, 120) as i32 - 60 } else { 0 };
        format!("{:e}", typical * share * 10f64.powi(far))
    }

    /// A number of either sign, or zero.
    pub fn signed(&mut self, typical: f64) -> String {
        match below(self.u, 5) {
            0 | 1 => self.near(typical),
            2 | 3 => self.near(-typical),
            _ => "0".to_owned(),
        }
    }

    /// Three numbers of either sign.
    pub fn vector(&mut self, typical: f64) -> String {
        let [x, y, z] = std::array::from_fn(|_| self.signed(typical));
        format!("[{x}, {y}, {z}]")
    }

    /// Three positive numbers.
    pub fn triple(&mut self, typical: f64) -> String {
        let [x, y, z] = std::array::from_fn(|_| self.near(typical));
        format!("[{x}, {y}, {z}]")
    }

    /// Principal moments of inertia near each other, as most bodies have.
    pub fn moments(&mut self, typical: f64) -> String {
        let base = 0.5 + below(self.u, 256) as f64 / 256.0;
        let each: [String; 3] = std::array::from_fn(|_| {
            if chance(self.u, self.hostility) {
                pick(self.u, &HOSTILE).to_owned()
            } else {
                format!("{:e}", typical * (base + below(self.u, 256) as f64 / 600.0))
            }
        });
        format!("[{}]", each.join(", "))
    }

    /// A direction.
    pub fn direction(&mut self) -> String {
        match below(self.u, 4) {
            0 => "[0, 0, 1]".to_owned(),
            1 => "[1, 0, 0]".to_owned(),
            2 => "[0.3, -0.5, 0.8]".to_owned(),
            _ => self.vector(1.0),
        }
    }

    /// A small count, or one that no machine has room for.
    pub fn count(&mut self, most: usize) -> String {
        if chance(self.u, self.hostility) {
            return pick(
                self.u,
                &["0", "-1", "1000", "10000", "1000000", "1000000000", "9223372036854775807", "1.5", "\"3\""],
            )
            .to_owned();
        }
        (1 + below(self.u, most)).to_string()
    }
}
