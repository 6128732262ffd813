use super::error::ElementError;
use super::matrices::Entries;
use crate::model::{Advection, Coordinate, LiquidMemory, Pair};

/// What moves inside the carrier without moving its centre of mass or its inertia: a rotor, a liquid. Its coordinates are
/// cyclic. (C1), (C2)
#[derive(Clone, Debug, Default)]
pub(super) struct Inner {
    /// One per cyclic coordinate.
    pub coordinates: Vec<Coordinate>,
    /// Angular momentum of each.
    pub h: Vec<[f64; 3]>,
    /// Mass and gyroscopic coupling, by row and column.
    pub pairs: Vec<(usize, usize, Pair)>,
    /// Friction of each element, by row and column, with its name.
    pub friction: Vec<(String, Entries)>,
    /// Liquids whose linear answer is known at every frequency.
    pub memories: Vec<LiquidMemory>,
    /// Advection of liquids.
    pub advections: Vec<Advection>,
    /// Rates that the file gives for the start, by coordinate.
    pub speeds: Vec<(usize, f64)>,
}

impl Inner {
    /// Everything inside, numbered in order from `first`.
    pub fn sum(
        first: usize,
        elements: impl Iterator<Item = Result<Self, ElementError>>,
    ) -> Result<Self, ElementError> {
        let mut sum = Self::default();
        for element in elements {
            let Self { coordinates, h, pairs, friction, memories, advections, speeds } = element?;
            let start = first + sum.coordinates.len();
            sum.coordinates.extend(coordinates);
            sum.h.extend(h);
            sum.pairs.extend(pairs.into_iter().map(|(j, k, pair)| (start + j, start + k, pair)));
            sum.memories.extend(memories.into_iter().map(|memory| {
                let coordinates = start + memory.coordinates.start..start + memory.coordinates.end;
                LiquidMemory { coordinates, ..memory }
            }));
            sum.advections.extend(advections.into_iter().map(|advection| {
                let coordinates = start + advection.coordinates.start..start + advection.coordinates.end;
                Advection { coordinates, ..advection }
            }));
            sum.speeds.extend(speeds.into_iter().map(|(j, speed)| (start + j, speed)));
            sum.friction.extend(friction.into_iter().map(|(name, entries)| {
                (name, entries.into_iter().map(|(j, k, entry)| (start + j, start + k, entry)).collect())
            }));
        }
        Ok(sum)
    }
}
