use std::collections::BTreeMap;
use std::ops::Range;

use nalgebra::Vector3;

use super::{Piece, SlowLiquid};
use crate::error::{ElementError, ElementId};
use crate::model::{Advection, Coordinate, LiquidMemory, Pair, Wheels};
use crate::structure::Entries;

/// Internal motion of a rotor, a wheel or a liquid: cyclic coordinates, which neither move the centre of mass of the carrier nor change its
/// inertia. (C1), (C2)
#[derive(Clone, Debug, Default)]
pub(crate) struct Internal {
    /// Name and unit of each cyclic coordinate.
    pub coordinates: Vec<Coordinate>,
    /// Angular momentum per unit rate of each.
    pub h: Vec<[f64; 3]>,
    /// Mass and gyroscopic coupling, by row and column.
    pub pairs: Vec<(usize, usize, Pair)>,
    /// Friction of each element, by row and column, with its name.
    pub friction: Vec<(String, Entries)>,
    /// Liquids whose linear response is known at every frequency.
    pub memories: Vec<LiquidMemory>,
    /// Advection of liquids.
    pub advections: Vec<Advection>,
    /// Rates of coordinates at the start that the file gives.
    pub speeds: Vec<(usize, f64)>,
    /// Angular momentum of wheels.
    pub wheels: Wheels,
    /// Mass that the internal elements add to the carrier, each piece with its centre (m), in the file's frame.
    pub rigid: Vec<(Piece, Vector3<f64>)>,
    /// Slow response of liquids.
    pub liquids: Vec<SlowLiquid>,
    /// First coordinate of each element that has any.
    pub firsts: BTreeMap<ElementId, usize>,
}

impl Internal {
    /// Sum over the internal elements of a body, numbered in order from `first`.
    pub fn sum(
        first: usize,
        elements: impl Iterator<Item = Result<Self, ElementError>>,
    ) -> Result<Self, ElementError> {
        let mut sum = Self::default();
        for element in elements {
            let next = element?.numbered_from(first + sum.coordinates.len());
            sum.coordinates.extend(next.coordinates);
            sum.h.extend(next.h);
            sum.pairs.extend(next.pairs);
            sum.friction.extend(next.friction);
            sum.memories.extend(next.memories);
            sum.advections.extend(next.advections);
            sum.speeds.extend(next.speeds);
            sum.wheels.add(next.wheels);
            sum.rigid.extend(next.rigid);
            sum.liquids.extend(next.liquids);
            sum.firsts.extend(next.firsts);
        }
        Ok(sum)
    }

    /// Internal motion of an element.
    pub fn of(self, element: ElementId) -> Self {
        let first = (!self.coordinates.is_empty()).then_some((element, 0));
        Self { firsts: first.into_iter().collect(), ..self }
    }

    /// Internal motion with its coordinates numbered from `start`.
    fn numbered_from(mut self, start: usize) -> Self {
        let moved = |range: &mut Range<usize>| *range = start + range.start..start + range.end;
        self.memories.iter_mut().for_each(|memory| moved(&mut memory.coordinates));
        self.advections.iter_mut().for_each(|advection| moved(&mut advection.coordinates));
        let entries = self.friction.iter_mut().flat_map(|(_, entries)| entries);
        let entries = entries.map(|(j, k, _)| (j, k)).chain(self.pairs.iter_mut().map(|(j, k, _)| (j, k)));
        entries.for_each(|(j, k)| (*j, *k) = (start + *j, start + *k));
        self.speeds.iter_mut().for_each(|(j, _)| *j += start);
        self.firsts.values_mut().for_each(|first| *first += start);
        self
    }
}
