//! Quadrature over the steps of a solver, of quantities outside of its state.

use crate::math::ode::Checkpoint;

/// Points of the interpolating polynomial that is integrated.
const POINTS: usize = 4;
/// Places of Gauss' rule, exact for the cubic, over half the interval.
const GAUSS: f64 = 0.577_350_269_189_625_8;

/// Integrals over time of quantities known at the ends of steps: of cubics through four neighbours, whatever the steps.
#[derive(Clone, Debug)]
pub(super) struct Quadrature {
    times: Vec<f64>,
    values: Vec<Vec<f64>>,
    sums: Vec<f64>,
    /// True once intervals before the last one have been added.
    under_way: bool,
}

impl Quadrature {
    pub fn new(t: f64, values: Vec<f64>) -> Self {
        let sums = vec![0.0; values.len()];
        Self { times: vec![t], values: vec![values], sums, under_way: false }
    }

    /// Saves the integrals and the last points.
    pub fn save(&self, checkpoint: &mut Checkpoint) {
        checkpoint.save_list(&self.times);
        self.values.iter().for_each(|values| checkpoint.save_list(values));
        checkpoint.save_list(&self.sums);
        checkpoint.save_count(u64::from(self.under_way));
    }

    /// Loads saved integrals; none of other quantities.
    pub fn load(&mut self, checkpoint: &mut Checkpoint) -> Option<()> {
        self.times = checkpoint.load_list()?;
        self.values = self.times.iter().map(|_| checkpoint.load_list()).collect::<Option<_>>()?;
        checkpoint.load_into(&mut self.sums)?;
        self.under_way = checkpoint.load_count()? == 1;
        self.values.iter().all(|values| values.len() == self.sums.len()).then_some(())
    }

    /// Adds the next point; a point at the time of the last one is skipped.
    pub fn add(&mut self, t: f64, values: Vec<f64>) {
        let last = self.times.last().copied().unwrap_or(f64::NEG_INFINITY);
        if t <= last {
            return;
        }
        if self.times.len() == POINTS {
            self.times.remove(0);
            self.values.remove(0);
        }
        self.times.push(t);
        self.values.push(values);
        if self.times.len() == POINTS {
            self.integrate(usize::from(self.under_way)..POINTS - 2);
            self.under_way = true;
        }
    }

    /// Integrals up to the last point.
    pub fn sums(&self) -> Vec<f64> {
        let mut whole = self.clone();
        let last = self.times.len() - 1;
        whole.integrate(if self.under_way { last - 1 } else { 0 }..last);
        whole.sums
    }

    /// Adds the integrals over the intervals that begin at these points.
    fn integrate(&mut self, starts: std::ops::Range<usize>) {
        for start in starts {
            let weights = weights(&self.times, start);
            for (values, weight) in self.values.iter().zip(weights) {
                self.sums.iter_mut().zip(values).for_each(|(sum, value)| *sum += weight * value);
            }
        }
    }
}

/// Weights of the values in the integral from one of the times to the next, of the polynomial through all of them.
fn weights(times: &[f64], start: usize) -> [f64; POINTS] {
    let (middle, half) = (0.5 * (times[start] + times[start + 1]), 0.5 * (times[start + 1] - times[start]));
    let mut weights = [0.0; POINTS];
    for place in [middle - GAUSS * half, middle + GAUSS * half] {
        for (i, weight) in weights.iter_mut().enumerate().take(times.len()) {
            let others = times.iter().enumerate().filter(|(j, _)| *j != i);
            *weight += half * others.map(|(_, t)| (place - t) / (times[i] - t)).product::<f64>();
        }
    }
    weights
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Uneven steps, any number of points: a polynomial of the degree that they make, or a cubic.
    #[test]
    fn polynomials_are_integrated_exactly() {
        let times = [0.3, 0.7, 1.9, 2.0, 3.4, 3.5, 5.1];
        for count in 1..=times.len() {
            let power = (count - 1).min(3) as i32;
            let value = |t: f64| vec![t.powi(power), 2.0];
            let mut sum = Quadrature::new(times[0], value(times[0]));
            times[1..count].iter().for_each(|t| sum.add(*t, value(*t)));
            sum.add(times[count - 1], vec![f64::NAN; 2]);
            let end = times[count - 1];
            let expected = (end.powi(power + 1) - times[0].powi(power + 1)) / f64::from(power + 1);
            let found = sum.sums();
            assert!((found[0] - expected).abs() < 1e-13 * expected.max(1.0), "{count}: {found:?} {expected}");
            assert!((found[1] - 2.0 * (end - times[0])).abs() < 1e-13);
        }
    }
}
