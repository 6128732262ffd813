//! Secular evolution along the level curves of the slow energy, for bodies whose moments are nearly equal.

mod descent;
mod energy;
mod evolution;
mod leg;
mod level;
mod passage;
mod saddle_passage;

pub use evolution::{LevelError, LevelEvolution};
pub use level::Level;
pub use passage::{LevelPassage, LevelRow, LevelStopReason, Until};
pub use saddle_passage::{Separatrix, Way};
