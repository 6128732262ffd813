//! The extension module `quasirigid._core`: a door to the study, as the command line is one.
//! Nothing is computed or decided here: arguments are read, the study is called, its answers become Python's objects.
//! The classes that users see, with their documentation, are in python/quasirigid.
#![allow(non_snake_case)]

mod answers;
mod arguments;
mod arrays;
mod arrow;
mod attitude;
mod audit;
mod columns;
mod dictionary;
mod ellipsoids;
mod ensemble;
mod failure;
mod infer;
mod light_curve;
mod model;
mod pool;
mod reduced;
mod series;
mod spin_paths;
mod stepper;
mod sweep;
mod values;
mod watching;

use pyo3::prelude::*;

/// The compiled part of quasirigid.
#[pymodule]
mod _core {
    #[pymodule_export]
    use crate::answers::RunAnswer;
    #[pymodule_export]
    use crate::arguments::former_argument;
    #[pymodule_export]
    use crate::arrays::linear_file;
    #[pymodule_export]
    use crate::arrays::linear_truncated;
    #[pymodule_export]
    use crate::attitude::{read_attitude, write_attitude};
    #[pymodule_export]
    use crate::audit::audit_histories;
    #[pymodule_export]
    use crate::columns::Columns;
    #[pymodule_export]
    use crate::dictionary::{to_toml, with_changes};
    #[pymodule_export]
    use crate::ellipsoids::evolve_ellipsoids;
    #[pymodule_export]
    use crate::model::Model;
    #[pymodule_export]
    use crate::reduced::Reduced;
    #[pymodule_export]
    use crate::stepper::Stepper;
    #[pymodule_export]
    use crate::sweep::{Collector, Sweep, read_sweep};

    /// Text of a model to begin with: a satellite with two damped booms.
    #[pymodule_export]
    const EXAMPLE: &str = include_str!("../../../examples/boom-satellite/model.toml");
    /// Version of the program and of the package.
    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");
}
