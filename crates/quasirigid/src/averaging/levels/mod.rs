//! Ageing along the level curves of the slow energy, for bodies whose moments are nearly equal.

mod descent;
mod energy;
mod evolution;
mod leg;
mod level;
mod passage;
mod separatrix;

pub use evolution::{LevelError, LevelEvolution};
pub use level::Level;
pub use passage::{LevelEnding, LevelPassage, LevelRow, Until};
pub use separatrix::{Separatrix, Way};
