//! Power budget: mean power that each dissipator takes from a free rotation. (D2)

use nalgebra::Complex;

use super::harmonics::Harmonic;
use super::poinsot::FreeRotation;
use super::response::Response;
use crate::math::sparse::SparseRows;

impl Response {
    /// Mean power (W) that each dissipator takes from a free rotation, by name; its sum is the whole. (D2)
    ///
    /// The shares are the mean of those of the motion and of its mirror image, which circles the same axis the other way: they differ by
    /// the share of the damping in the response, their sum does not.
    #[must_use]
    pub fn budget(&self, motion: &FreeRotation) -> Vec<(String, f64)> {
        let mut powers = vec![0.0; self.dissipators.len()];
        for taken in self.harmonic_budgets(motion) {
            powers.iter_mut().zip(taken).for_each(|(power, taken)| *power += taken);
        }
        self.dissipators.iter().map(|part| part.name.clone()).zip(powers).collect()
    }

    /// Names of the dissipators, in the order of their powers.
    pub fn dissipators(&self) -> impl Iterator<Item = &str> {
        self.dissipators.iter().map(|part| part.name.as_str())
    }

    /// Mean power (W) that each dissipator takes from each harmonic of a free rotation, in the order of
    /// [`harmonic_powers`](Self::harmonic_powers), which are the sums; shares as in [`budget`](Self::budget). (D2)
    pub fn harmonic_budgets(&self, motion: &FreeRotation) -> impl Iterator<Item = Vec<f64>> {
        let mean_spin = motion.mean_spin();
        motion.harmonics().map(move |harmonic| {
            let [real, imaginary] = harmonic.products;
            let mirrored = Harmonic { products: [real, imaginary.map(|part| -part)], ..harmonic };
            let one = self.taken(&harmonic, mean_spin);
            let other = self.taken(&mirrored, mean_spin.map(|rate| -rate));
            one.into_iter().zip(other).map(|(one, other)| 0.5 * (one + other)).collect()
        })
    }

    /// Mean power (W) of a harmonic that each dissipator takes: `2ν` times `x̄ᵀ(νB_c + Im C_c)x` of the response `x`. (D2)
    fn taken(&self, harmonic: &Harmonic, mean_spin: [f64; 3]) -> Vec<f64> {
        let frequency = harmonic.frequency;
        if self.rows.is_empty() {
            return vec![0.0; self.dissipators.len()];
        }
        let answer = self.answer(harmonic, mean_spin);
        let moved = self.displacement(&answer);
        let mut lost: Vec<f64> = self
            .dissipators
            .iter()
            .map(|part| {
                let material = part.loss.as_ref().map_or(0.0, |loss| {
                    let [_, imaginary] = loss.rheology.modulus(frequency);
                    imaginary * form(&loss.stiffness, &moved)
                });
                frequency * form(&part.damping, &moved) + material
            })
            .collect();
        for (owner, taken) in self.taken_by_memories(frequency, mean_spin, &answer) {
            lost[owner] += taken;
        }
        lost.into_iter().map(|lost| 2.0 * frequency * lost).collect()
    }

    /// Mean power over `2ν` taken by each liquid whose force at a frequency is known, with the index of its dissipator.
    fn taken_by_memories(
        &self,
        frequency: f64,
        mean_spin: [f64; 3],
        answer: &[Complex<f64>],
    ) -> Vec<(usize, f64)> {
        let lost = |(start, memory): &(usize, _)| {
            let force = self.memory_force(memory, frequency, mean_spin);
            let own = &answer[*start..start + force.nrows()];
            let pairs = (0..own.len()).flat_map(|i| (0..own.len()).map(move |j| (i, j)));
            pairs.map(|(i, j)| (own[i].conj() * force[(i, j)] * own[j]).im).sum::<f64>()
        };
        let owner = |(_, memory): &(usize, crate::model::LiquidMemory)| {
            let coordinate = memory.coordinates.start;
            self.dissipators.iter().position(|part| part.damping.row(coordinate).next().is_some())
        };
        self.memories.iter().filter_map(|memory| Some((owner(memory)?, lost(memory)))).collect()
    }
}

/// `x̄ᵀ M x` of a symmetric matrix.
fn form(matrix: &SparseRows<f64>, x: &[Complex<f64>]) -> f64 {
    matrix.iter().map(|(j, k, entry)| entry * (x[j].conj() * x[k]).re).sum()
}
