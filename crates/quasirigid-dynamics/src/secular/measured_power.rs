//! Mean power of the full system, interpolated between periodic motions or short runs: the method where no average holds.
//! The power is divided by `⟨|ω̇|²⟩`, since that ratio is smooth up to the poles, where the modes give it, and to the separatrix; Chebyshev
//! places double until it settles.
//! Equations (Q4) and (Q19), docs/theory/16-methods.md.

use std::ops::ControlFlow;

use super::criteria::uneven;
use super::energy_range::EnergyRange;
use super::manifold_boundary::{LocalManifold, ManifoldBoundary};
use super::measure::{MeasureError, Measurement};
use super::measurement_point::{MeasureOptions, MeasurementPoint, NEAREST_SEPARATRIX, small, smallest, span};
use super::periodic_place::PeriodicPlaces;
use super::poles::Poles;
use crate::averaging::{FreeRotation, MeanPower, RotationState};
use crate::model::{FlexibleBody, Mode};

/// Mean power of the full system along the equivalent polhode, measured at a few places and interpolated. (Q4), (Q19)
///
/// The interpolated function is the logarithm of the ratio of the power to the mean square of the angular acceleration on the equivalent
/// polhode; that ratio is finite at the poles, where the modes give it, and at the separatrix.
#[derive(Clone, Debug)]
pub struct MeasuredPower {
    moments: [f64; 3],
    /// What gave the power at its places.
    pub places: Places,
    /// Logarithms of the ratio in the long-axis and the short-axis mode.
    curves: [Option<Curve>; 2],
    /// Measurements, in the order in which they were made; some from reduced equations about a spin.
    pub measurements: Vec<Measurement>,
    /// Ranges within which the power is that of reduced equations about a spin, with the difference from the full system at their edges. (Q11)
    pub boundaries: Vec<ManifoldBoundary>,
    /// Estimate of the relative error of the power: of the interpolation and of the measurements.
    pub error: f64,
}

/// What gives the power at a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Places {
    /// Short runs. (Q4)
    ShortRuns,
    /// Periodic motions. (Q19)
    PeriodicMotions,
}

/// Bound of the error over its estimate.
const ERROR_PER_ESTIMATE: f64 = 2.0;
/// Intervals between places, at first and at last.
const INTERVALS: [usize; 2] = [4, 32];

impl MeasuredPower {
    /// Measures the power between two rotation states. (Q4)
    ///
    /// # Errors
    /// [`MeasureError`] if a run ends early, the mean does not settle, or the caller asks for an end.
    pub fn along(
        body: &FlexibleBody,
        range: &EnergyRange,
        poles: &Poles,
        ([from, to], places): ([RotationState; 2], Places),
        options: &MeasureOptions,
        watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<Self, MeasureError> {
        let mut power = Self {
            moments: range.moments(),
            places,
            curves: [None, None],
            measurements: Vec::new(),
            boundaries: Vec::new(),
            error: 0.0,
        };
        for mode in [Mode::LongAxis, Mode::ShortAxis] {
            let Some(ends) =
                span(range, mode, [from, to], [NEAREST_SEPARATRIX, smallest(range, poles, mode)])
            else {
                continue;
            };
            let inside = [from, to].into_iter().filter(|state| state.mode == mode);
            let deepest = inside.map(|state| state.xi).fold(ends[1], f64::max);
            let local = LocalManifold::about(body, range, mode);
            let (options, periodic) = (*options, PeriodicPlaces::default());
            let (power, watch) = (&mut power, &mut *watch);
            let mut worker =
                Worker { body, range, poles, mode, deepest, options, local, places, periodic, power, watch };
            worker.boundary(ends)?;
            let curve = worker.curve(ends)?;
            power.curves[usize::from(mode == Mode::ShortAxis)] = Some(curve);
        }
        Ok(power)
    }

    /// Bound of the relative error of a time of so many periods of the wobble from this power. (Q4)
    #[must_use]
    pub fn time_error(&self, periods: f64) -> f64 {
        ERROR_PER_ESTIMATE * self.error + uneven(periods)
    }

    /// First measurement, with the mean power of each dissipator (W).
    #[must_use]
    pub fn budget(&self) -> Option<&Measurement> {
        self.measurements.first()
    }
}

impl MeanPower for MeasuredPower {
    fn moments(&self) -> [f64; 3] {
        self.moments
    }

    fn mean_power(&self, motion: &FreeRotation) -> f64 {
        let reference = motion.mean_square_acceleration();
        let curve = &self.curves[usize::from(motion.mode() == Mode::ShortAxis)];
        curve.as_ref().map_or(0.0, |curve| reference * curve.at(motion.logit()).exp())
    }
}

struct Worker<'w, 'b> {
    body: &'b FlexibleBody,
    range: &'b EnergyRange,
    poles: &'b Poles,
    mode: Mode,
    /// Place of the smallest wobble that the evolution comes to.
    deepest: f64,
    options: MeasureOptions,
    /// Reduced equations about the pole, where they are of use.
    local: Option<LocalManifold<'b>>,
    places: Places,
    periodic: PeriodicPlaces,
    power: &'w mut MeasuredPower,
    watch: &'w mut dyn FnMut(f64) -> ControlFlow<()>,
}

impl Worker<'_, '_> {
    /// Interpolating curve between two places, with places added until the curve settles.
    fn curve(&mut self, [low, high]: [f64; 2]) -> Result<Curve, MeasureError> {
        let mut nodes: Vec<[f64; 2]> = self.pole(high).into_iter().collect();
        // a wobble that no mode damps is damped by a power of it, a line over the place
        let reach = if nodes.is_empty() { self.deepest } else { high };
        let [first, last] = INTERVALS;
        let mut intervals = first;
        let mut curve: Option<Curve> = None;
        loop {
            for i in 0..=intervals {
                let new = curve.is_none() || i % 2 == 1;
                let place = 0.5 * (low + high)
                    + 0.5 * (high - low) * (std::f64::consts::PI * i as f64 / intervals as f64).cos();
                if new {
                    nodes.push(self.node(place)?);
                }
                if high - low < SINGLE_PLACE_LENGTH {
                    break;
                }
            }
            let next = Curve::through(nodes.clone(), [low, reach]);
            let Some(before) = curve.replace(next) else {
                intervals *= 2;
                continue;
            };
            let change = nodes.iter().map(|[xi, value]| (before.at(*xi) - value).abs()).fold(0.0, f64::max);
            let noise = self.power.measurements.iter().map(|each| each.error).fold(0.0, f64::max);
            if change <= self.options.error || intervals >= last || high - low < SINGLE_PLACE_LENGTH {
                self.power.error = self.power.error.max(change).max(noise);
                return Ok(curve.unwrap_or(before));
            }
            intervals *= 2;
        }
    }

    /// Logarithm of the ratio at the pole, from the modes, as a node beyond the last place.
    fn pole(&self, high: f64) -> Option<[f64; 2]> {
        let rate = self.poles.rate(self.mode).filter(|rate| *rate > 0.0)?;
        let xi = small(self.range, self.mode) + BEYOND;
        let motion = FreeRotation::at_logit(self.power.moments, self.range.angular_momentum(), self.mode, xi);
        let ratio = 2.0 * rate * motion.energy_from_axis() / motion.mean_square_acceleration();
        (high + 0.5 * BEYOND > xi - BEYOND && ratio > 0.0).then(|| [xi, ratio.ln()])
    }

    /// Compares the reduced equations about the pole with the full system at the edge of their range, and drops them where both differ. (Q11)
    fn boundary(&mut self, [low, _]: [f64; 2]) -> Result<(), MeasureError> {
        let Some(local) = self.local.take() else { return Ok(()) };
        let Some(edge) = local.edge(self.range, self.mode) else { return Ok(()) };
        if low >= edge.xi {
            self.power.boundaries.push(local.inside(self.mode));
            self.local = Some(local);
            return Ok(());
        }
        let run = match self.measured(edge.xi) {
            Ok(run) => run,
            Err(MeasureError::Interrupted) => return Err(MeasureError::Interrupted),
            Err(_) => return Ok(()),
        };
        let Ok(boundary) = local.boundary(self.range, &run) else { return Ok(()) };
        self.power.measurements.push(run);
        if boundary.mismatch <= self.options.error {
            self.power.error = self.power.error.max(boundary.mismatch);
            self.power.boundaries.push(boundary);
            self.local = Some(local);
        }
        Ok(())
    }

    /// Measures the logarithm of the ratio near a place.
    fn node(&mut self, xi: f64) -> Result<[f64; 2], MeasureError> {
        let state = RotationState { mode: self.mode, xi };
        let reduced = self.local.as_ref().and_then(|local| local.measurement(self.range, state));
        let found = reduced.map_or_else(|| self.measured(xi), Ok)?;
        let RotationState { mode, xi } = found.rotation_state;
        let there = FreeRotation::at_logit(self.power.moments, self.range.angular_momentum(), mode, xi);
        let value = (found.power / there.mean_square_acceleration()).ln();
        self.power.measurements.push(found);
        Ok([xi, value])
    }

    /// Measures the power near a place in the full system.
    fn measured(&mut self, xi: f64) -> Result<Measurement, MeasureError> {
        if self.places == Places::ShortRuns {
            return self.short_run(xi);
        }
        let state = RotationState { mode: self.mode, xi };
        let share = self.power.measurements.len() as f64 / (2 * INTERVALS[0] + 2) as f64;
        let watch = &mut *self.watch;
        self.periodic
            .measure(self.body, self.range, (state, self.options.error), &mut || watch(share.min(1.0)))
    }

    /// Measures the power near a place by a short run of the full system.
    fn short_run(&mut self, xi: f64) -> Result<Measurement, MeasureError> {
        let done: u64 = self.power.measurements.iter().map(|each| each.steps).sum();
        let share = done as f64 / self.options.most_steps as f64;
        let options =
            MeasureOptions { most_steps: self.options.most_steps.saturating_sub(done), ..self.options };
        let point = MeasurementPoint { body: self.body, range: self.range, poles: self.poles, options };
        let watch = &mut *self.watch;
        point.measure(RotationState { mode: self.mode, xi }, &mut || watch(share))
    }
}

/// Length in `ξ` below which one place is measured.
const SINGLE_PLACE_LENGTH: f64 = 0.05;
/// Distance of the pole's node from the small wobble, as `ξ`.
const BEYOND: f64 = 1.0;

/// Barycentric polynomial interpolation between nodes, and lines beyond them up to the places asked for: the motion leaves a
/// place while its power is measured, so that the last node lies short of it.
#[derive(Clone, Debug)]
struct Curve {
    nodes: Vec<[f64; 2]>,
    weights: Vec<f64>,
    /// Slopes before the first node and beyond the last.
    slopes: [f64; 2],
    /// Places beyond which the curve is constant.
    ends: [f64; 2],
}

impl Curve {
    /// Interpolates through nodes that crowd towards the ends, as Chebyshev points do, for use between two places.
    fn through(mut nodes: Vec<[f64; 2]>, [low, high]: [f64; 2]) -> Self {
        nodes.sort_by(|a, b| a[0].total_cmp(&b[0]));
        nodes.dedup_by(|a, b| (a[0] - b[0]).abs() < 1e-9);
        let span = nodes.last().map_or(0.0, |last| last[0]) - nodes.first().map_or(0.0, |first| first[0]);
        let scale = 4.0 / span.max(f64::MIN_POSITIVE);
        let weight = |i: usize| {
            let others = nodes.iter().enumerate().filter(|(k, _)| *k != i);
            others.map(|(_, other)| (scale * (nodes[i][0] - other[0])).recip()).product()
        };
        let weights = (0..nodes.len()).map(weight).collect();
        let slopes = [chord(nodes.iter(), -1.0, low), chord(nodes.iter().rev(), 1.0, high)];
        Self { nodes, weights, slopes, ends: [low, high] }
    }

    fn at(&self, x: f64) -> f64 {
        let (Some(first), Some(last)) = (self.nodes.first(), self.nodes.last()) else { return f64::NAN };
        let ([before, beyond], [low, high]) = (self.slopes, self.ends);
        let x = x.clamp(low.min(first[0]), high.max(last[0]));
        if x <= first[0] {
            return first[1] + before * (x - first[0]);
        }
        if x >= last[0] {
            return last[1] + beyond * (x - last[0]);
        }
        let (mut over, mut under) = (0.0, 0.0);
        for ([place, value], weight) in self.nodes.iter().zip(&self.weights) {
            if x == *place {
                return *value;
            }
            let share = weight / (x - place);
            over += share * value;
            under += share;
        }
        over / under
    }
}

/// Slope from the first of some nodes to the next as far from it as the place on its other side, so that no error of a node grows on the way
/// there; zero if the nodes reach the place.
fn chord<'a>(mut nodes: impl Iterator<Item = &'a [f64; 2]>, way: f64, place: f64) -> f64 {
    let Some([x, value]) = nodes.next() else { return 0.0 };
    let missing = way * (place - x);
    let far = nodes.find(|[other, _]| missing > 0.0 && (other - x).abs() >= missing);
    far.map_or(0.0, |[other, there]| (there - value) / (other - x))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A line is followed beyond the nodes, by a chord no shorter than the way; a single node, or none so far, gives a constant.
    #[test]
    fn curves_go_on_along_lines() {
        let line = |x: f64| 3.0 - 0.7 * x;
        let nodes: Vec<_> = [0.1, 0.2, 1.0, 1.9].map(|x| [x, line(x)]).into();
        let curve = Curve::through(nodes, [0.0, 2.2]);
        for x in [0.0, 0.05, 0.6, 2.0, 2.2] {
            assert!((curve.at(x) - line(x)).abs() < 1e-12, "{x}");
        }
        let rough = Curve::through(vec![[0.4, 1.0], [0.5, 1.01], [1.0, 0.8]], [0.0, 1.0]);
        assert!((rough.at(0.0) - (1.0 + 0.4 * 0.2 / 0.6)).abs() < 1e-12, "{}", rough.at(0.0));
        assert_eq!(rough.at(-1.0), rough.at(0.0));
        let beyond_the_pole = Curve::through(vec![[0.4, 1.0], [1.4, 2.0]], [0.4, 1.0]).at(3.0);
        assert_eq!(beyond_the_pole, 2.0);
        assert_eq!(Curve::through(vec![[0.4, 1.0]], [0.0, 1.0]).at(0.0), 1.0);
        assert_eq!(Curve::through(vec![[0.4, 1.0], [0.5, 2.0]], [0.0, 0.5]).at(0.0), 1.0);
    }
}
