//! Checkpoints: everything that decides the next steps of an integration, bit for bit, so that it goes on as if it had never stopped.
//! Factorisations are not kept; they are made again from what they were made of, which gives the same bits.

use super::Work;

/// Checkpoint of an integration: numbers in the order in which its parts save and load them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Checkpoint {
    words: Vec<u64>,
    /// Next number to load.
    next: usize,
}

impl Checkpoint {
    /// From the numbers of [`words`](Self::words).
    #[must_use]
    pub fn from_words(words: Vec<u64>) -> Self {
        Self { words, next: 0 }
    }

    /// The numbers, for a file.
    #[must_use]
    pub fn words(&self) -> &[u64] {
        &self.words
    }

    /// Saves a count.
    pub fn save_count(&mut self, count: u64) {
        self.words.push(count);
    }

    /// Saves a number.
    pub fn save(&mut self, number: f64) {
        self.words.push(number.to_bits());
    }

    /// Saves a list with its length.
    pub fn save_list(&mut self, list: &[f64]) {
        self.save_count(list.len() as u64);
        self.words.extend(list.iter().map(|number| number.to_bits()));
    }

    /// Saves the work of a solver.
    pub fn save_work(&mut self, work: Work) {
        let Work { steps, rejected, evaluations, factorizations, implicit_steps } = work;
        self.words.extend([steps, rejected, evaluations, factorizations, implicit_steps]);
    }

    /// Saves another checkpoint behind this one, whose [`rest`](Self::rest) it then is.
    pub fn save_rest(&mut self, other: &Self) {
        self.words.extend(&other.words);
    }

    /// Loads a count; none at the end.
    pub fn load_count(&mut self) -> Option<u64> {
        let word = *self.words.get(self.next)?;
        self.next += 1;
        Some(word)
    }

    /// Loads a number; none at the end.
    pub fn load(&mut self) -> Option<f64> {
        self.load_count().map(f64::from_bits)
    }

    /// Loads a list; none at the end.
    pub fn load_list(&mut self) -> Option<Vec<f64>> {
        let length = usize::try_from(self.load_count()?).ok()?;
        let words = self.words.get(self.next..self.next.checked_add(length)?)?;
        self.next += length;
        Some(words.iter().map(|word| f64::from_bits(*word)).collect())
    }

    /// Loads a list over one of the same length; none of another length.
    pub fn load_into(&mut self, list: &mut [f64]) -> Option<()> {
        let loaded = self.load_list()?;
        if loaded.len() != list.len() {
            return None;
        }
        list.copy_from_slice(&loaded);
        Some(())
    }

    /// Loads the work of a solver.
    pub fn load_work(&mut self) -> Option<Work> {
        Some(Work {
            steps: self.load_count()?,
            rejected: self.load_count()?,
            evaluations: self.load_count()?,
            factorizations: self.load_count()?,
            implicit_steps: self.load_count()?,
        })
    }

    /// The numbers that have not been loaded.
    #[must_use]
    pub fn rest(&self) -> Self {
        Self::from_words(self.words[self.next..].to_vec())
    }

    /// Whether every number has been loaded.
    #[must_use]
    pub fn is_spent(&self) -> bool {
        self.next == self.words.len()
    }
}
