//! Table of the settings that a user may give: name, flag, key, former name, unit, range and help of each, for all interfaces.

use std::fmt::{self, Display, Formatter};

use quasirigid::model::{MAX_DEGREE, MAX_ORDER};
use quasirigid_io::model::MAX_ROWS;

/// Range of a setting.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Range {
    /// Words, states and vectors, each with a reading of its own.
    Read,
    /// Numbers above zero.
    Positive,
    /// Numbers from the first to the second.
    Number(f64, f64),
    /// Whole numbers from the first to the second.
    Count(usize, usize),
}

impl Display for Range {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Read => f.write_str("one that is read"),
            Self::Positive => f.write_str("one above zero"),
            Self::Number(least, most) => write!(f, "{least:e} to {most:e}"),
            Self::Count(least, most) => write!(f, "{least} to {most}"),
        }
    }
}

/// Defines the settings, each by its name, flag, key, former name, unit, range and help. The name is the field in Rust and the argument in Python.
macro_rules! settings {
    ($($Setting:ident: $name:literal, $flag:literal, $key:literal, $former:literal, $unit:literal, $range:expr, $help:literal;)+) => {
        /// A setting that a user may give.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Setting {
            $(#[doc = concat!("Setting `", $flag, "`, in the file `", $key, "`.")] $Setting,)+
        }

        impl Setting {
            /// All settings.
            pub const ALL: &'static [Self] = &[$(Self::$Setting),+];

            /// The argument of Python, which is the field in Rust.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self { $(Self::$Setting => $name,)+ }
            }

            /// The flag of the command line.
            #[must_use]
            pub const fn flag(self) -> &'static str {
                match self { $(Self::$Setting => $flag,)+ }
            }

            /// The key of the model file, or the name where the file has none.
            #[must_use]
            pub const fn key(self) -> &'static str {
                match self { $(Self::$Setting => $key,)+ }
            }

            /// The name in the version before, which this one still takes, as in a flag; empty where it is the same.
            #[must_use]
            pub const fn former(self) -> &'static str {
                match self { $(Self::$Setting => $former,)+ }
            }

            /// The unit of a plain number; empty without one.
            #[must_use]
            pub const fn unit(self) -> &'static str {
                match self { $(Self::$Setting => $unit,)+ }
            }

            /// The range.
            #[must_use]
            pub const fn range(self) -> Range {
                match self { $(Self::$Setting => $range,)+ }
            }

            /// What the setting means.
            #[must_use]
            pub const fn help(self) -> &'static str {
                match self { $(Self::$Setting => $help,)+ }
            }
        }
    };
}

use Range::{Count, Number, Positive, Read};

settings! {
    Order: "order", "--order", "[run] order", "", "", Count(0, MAX_ORDER),
    "Order p of the reduced equations, 0 (rigid) to 12; the file's own, or 3 (the paper's)";
    Duration: "duration", "--duration", "[run] duration", "", "s", Positive,
    "Duration, in seconds or with a unit such as \"2 h\"; the file's own, or a hundred revolutions";
    Tolerance: "tolerance", "--tolerance", "[run] tolerance", "", "", Number(1e-15, 1e-2),
    "Error allowed per step, relative, 1e-15 to 1e-2 [default: 1e-12]";
    Samples: "samples", "--samples", "[run] samples", "", "", Count(2, MAX_ROWS),
    "Number of output times, spread evenly from the start to the end";
    Form: "form", "--form", "[run] form", "", "", Read,
    "Variable that is integrated: the angular momentum, which keeps |K| exactly, or the angular velocity, as in the paper";
    Integrator: "integrator", "--integrator", "[run] integrator", "method", "", Read,
    "Integrator of the full system [default: automatic]";
    System: "system", "--system", "[run] systems", "", "", Read,
    "System of equations to integrate";
    Coordinates: "coordinates", "--coordinates", "coordinates", "", "", Read,
    "Add the internal coordinates and their rates to the table of the full system";
    Displacements: "displacements", "--displacements", "displacements", "", "", Read,
    "Add the displacements of points, appendages and nodes to the table of the full system";
    Degree: "degree", "--degree", "[run] spin_manifold.degree", "", "", Count(1, MAX_DEGREE),
    "Degree of the reduced equations about the spin in the amplitude, 1 to 11 [default: the file's, or 5]";
    Masters: "masters", "--masters", "[run] spin_manifold.masters", "", "rad/s", Read,
    "Modes that they follow: automatic, nutation, or frequencies in rad/s beside the nutation [default: the file's, \
     or automatic]";
    Style: "style", "--style", "[run] spin_manifold.style", "", "", Read,
    "Style of the equations about the spin [default: the file's, or normal-form]";
    Axis: "axis", "--axis", "axis", "", "", Read,
    "Principal axis to spin about";
    Spin: "spin", "--spin", "spin", "", "rad/s", Read,
    "Angular velocity (rad/s): the steady spin nearest to its direction, with its size [default: the angular momentum \
     of the start, about both axes of extreme inertia]";
    Start: "start", "--start", "evolve.start", "from", "", Read,
    "Where to start: D/I3 = |K|^2/2EI3 as 0.9 or \"90% of I3\", or the greatest nutation (wobble) about the axis of greatest \
     inertia as \"20 deg\" [default: the file's, or the initial state]";
    Until: "until", "--until", "evolve.until", "to", "", Read,
    "Where to end, in the same form [default: the file's, or 1 % of the energy of the nutation left]";
    EvolutionDuration: "duration", "--duration", "evolve = { duration = \"10 yr\" } in [run]", "", "s", Positive,
    "Longest time, in seconds or with a unit such as \"10 Gyr\" [default: the file's, or none]";
    EvolutionSamples: "samples", "--samples", "evolve.samples", "", "", Count(2, MAX_ROWS),
    "Number of rows [default: the file's, or 201]";
    Power: "power", "--power", "evolve.power", "", "", Read,
    "Source of the mean power [default: the file's, or harmonics where a material needs them]";
    Method: "method", "--method", "evolve.method", "", "", Read,
    "Method of the evolution [default: the file's, or the one that holds]";
    UncertaintySamples: "uncertainty_samples", "--uncertainty-samples", "uncertainty_samples", "samples-of-uncertainty", "", Count(2, MAX_ROWS),
    "Draws of the keys in [uncertainty], for intervals of the time and the revolutions";
    Orders: "orders", "--orders", "verify.orders", "", "", Count(0, MAX_ORDER),
    "Orders to verify, separated by commas [default: 1 to the model's order; from 0 with rotors or liquids; about the \
     spin degrees 1 to 3]";
    Revolutions: "revolutions", "--revolutions", "verify.revolutions", "rotations", "", Positive,
    "Revolutions of each history [default: 5]; about the spin periods of the nutation [default: 1]";
    Halvings: "halvings", "--halvings", "verify.halvings", "", "", Read,
    "How often epsilon is halved [default: 4]; about the spin the amplitude [default: 3]";
    Amplitude: "amplitude", "--amplitude", "amplitude", "", "deg", Positive,
    "Largest amplitude of the nutation about the spin, in degrees [default: 2.86, 0.05 rad]";
    Out: "out", "--out", "out", "folder", "", Read,
    "Folder of the results";
    Resume: "resume", "--resume", "resume", "", "", Read,
    "Go on with work that was cut off, with the same bits";
    Threads: "threads", "--threads", "threads", "", "", Count(1, 1024),
    "Number of threads, on which no result depends [default: as many as there are]";
}

impl Setting {
    /// The name that an interface has for the setting, or its key in the file.
    pub(crate) fn or_in_file(self, name: &dyn Fn(Self) -> &'static str) -> String {
        let (name, key) = (name(self), self.key());
        if name == key { key.to_owned() } else { format!("{name} or with {key}") }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One word means one thing: the flag is the name with dashes, and the key ends in it.
    #[test]
    fn a_setting_has_one_name_in_every_interface() {
        for setting in Setting::ALL {
            let name = setting.name();
            assert_eq!(setting.flag(), format!("--{}", name.replace('_', "-")));
            let key = setting.key().trim_start_matches("[run] ");
            let last = key.rsplit('.').next().unwrap_or(key);
            let of_list = *setting == Setting::System && last == "systems";
            let shown = *setting == Setting::EvolutionDuration && key.starts_with("evolve = { duration =");
            assert!(last == name || of_list || shown, "{name}: {key}");
            assert!(!setting.help().is_empty() && !setting.help().ends_with('.'), "{name}");
            assert_ne!(setting.former(), name);
        }
    }

    /// A former name is the name of no other setting of the same question.
    #[test]
    fn former_names_are_free_or_of_another_question() {
        for setting in Setting::ALL.iter().filter(|setting| !setting.former().is_empty()) {
            let taken = Setting::ALL.iter().find(|other| other.name() == setting.former());
            assert!(
                taken.is_none() || (*setting, taken) == (Setting::Integrator, Some(&Setting::Method)),
                "{setting:?}: {taken:?}"
            );
        }
    }
}
