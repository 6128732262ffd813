//! Problems with known answers, each with its source.

mod quartic_quintic;

pub use quartic_quintic::QuarticQuintic;
