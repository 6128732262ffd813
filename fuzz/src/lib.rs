//! The targets of `quasirigid-fuzz` for libFuzzer, a program each.

use quasirigid_fuzz::targets::{TARGETS, Target};

/// The target of a name.
///
/// # Panics
/// If there is none.
pub fn target(name: &str) -> &'static Target {
    TARGETS.iter().find(|target| target.name == name).expect("the program is named after a target")
}

/// Main program of a target.
#[macro_export]
macro_rules! fuzz {
    ($name:literal) => {
        libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
            static TARGET: std::sync::OnceLock<&quasirigid_fuzz::targets::Target> =
                std::sync::OnceLock::new();
            TARGET.get_or_init(|| $crate::target($name)).run(bytes);
        });
    };
}
