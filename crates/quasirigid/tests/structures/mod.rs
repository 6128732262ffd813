//! Structures of finite elements: their reduction on a carrier or floating, against other methods for the same body.

mod appendages;
mod beams;
mod bushings;
mod common;
mod dissipators;
mod ellipsoids;
mod exported;
mod floating;
mod frames;
mod hostile;
mod large;
mod meshes;
mod modes;
mod moving;
mod necked;
mod necks;
mod networks;
mod rings;
mod skew_springs;
mod solids;
mod spin_up;
mod spinning;
mod tanks;
mod visuals;
mod whirl;
