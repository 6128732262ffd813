//! Contents of a page, of a record as a run leaves it and of any other.

mod any_record;
mod comparison;
mod harmonics;
mod motion;
mod packed;
mod page;
mod styles;
