//! Choices of the runner: the same seed gives the same executions on every machine.

/// Source of choices.
#[derive(Clone, Debug)]
pub struct Random(quasirigid_math::random::Random);

impl Random {
    /// Source with a seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self(quasirigid_math::random::Random::new(seed))
    }

    /// A number below `most`; zero for none.
    pub fn below(&mut self, most: usize) -> usize {
        if most == 0 { 0 } else { (self.0.bits() % most as u64) as usize }
    }

    /// One of several things.
    ///
    /// # Panics
    /// If there are none.
    pub fn pick<'t, T>(&mut self, things: &'t [T]) -> &'t T {
        &things[self.below(things.len())]
    }

    /// So many random bytes.
    pub fn bytes(&mut self, count: usize) -> Vec<u8> {
        (0..count).map(|_| self.0.bits() as u8).collect()
    }
}
