//! Evolution along levels from a start to a target: legs, passages of saddles, and the rows of the result.
//! Time next to a saddle has a logarithm, added in closed form from the last level followed; where the branches beyond a saddle differ the
//! evolution ends there, since a fraction of a revolution decides.
//! Equations (N5) and (N6), docs/theory/17-levels.md.

use std::f64::consts::TAU;

use super::evolution::{LevelError, LevelEvolution};
use super::leg::{Leg, Piece};
use super::saddle_passage::Separatrix;
use crate::math::bisection::bisected;
use crate::math::vec3::scale;

/// Target that ends an evolution along levels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Until {
    /// Share left of the energy that the start has above the attracting steady spin.
    EnergyLeft(f64),
    /// Greatest angle (rad) between the angular momentum and the attracting steady spin.
    Wobble(f64),
    /// Elapsed time (s).
    Duration(f64),
}

/// Result of an evolution along levels.
#[derive(Clone, Debug, PartialEq)]
pub struct LevelPassage {
    /// States of the evolution, start and end among them.
    pub rows: Vec<LevelRow>,
    /// Separatrices passed, the one that ended the evolution last.
    pub separatrices: Vec<Separatrix>,
    /// Reason of the end.
    pub ending: LevelStopReason,
    /// Angular momentum (N·m·s, body axes) of the attracting steady spin; beyond a separatrix with equal branches, one of them.
    pub attractor: [f64; 3],
}

/// State of an evolution along levels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LevelRow {
    /// Time (s).
    pub time: f64,
    /// Revolutions about the angular momentum.
    pub revolutions: f64,
    /// Slow energy (J).
    pub energy: f64,
    /// Least and greatest angle (rad) between the angular momentum and the steady spin circled.
    pub nutation: [f64; 2],
    /// Period of the level (s).
    pub period: f64,
    /// Mean rate (rad/s) at which the axis of least inertia goes round the angular momentum. (N7)
    pub long_axis_precession_rate: f64,
    /// Mean power dissipated (W).
    pub power: f64,
    /// Angular momentum on the level (N·m·s, body axes).
    pub angular_momentum: [f64; 3],
    /// Angular momentum of the steady spin circled (N·m·s, body axes).
    pub circled: [f64; 3],
}

/// Reason why an evolution along levels ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LevelStopReason {
    /// The target was reached.
    Reached,
    /// The duration has passed.
    Duration,
    /// At a separatrix beyond which the branches differ: the last of [`LevelPassage::separatrices`] lists them.
    Undecided,
    /// Nothing is dissipated.
    Lossless,
}

/// Length in `ξ` that is integrated at once, and the place where a wobble is beyond numbers.
const STRETCH: f64 = 2.0;
const NOTHING: f64 = 300.0;
/// Place where a wobble is below the rounding of a direction, so that the rotation is a steady spin: `e^{−32}` of the widest.
const STEADY: f64 = 64.0;
/// Relative excess of the last piece of time next to a saddle over its end value: the logarithm's share `1/ln(1/margin)`.
const LOGARITHM: f64 = 1.0 / 16.0;
/// Halvings that locate an angle of wobble.
const ANGLE_STEPS: usize = 50;

/// Piece with the time and revolutions before it.
struct Stretch {
    leg: usize,
    piece: Piece,
    time: f64,
    revolutions: f64,
}

/// Evolution along levels in progress.
struct Making<'a> {
    levels: &'a LevelEvolution,
    legs: Vec<Leg>,
    stretches: Vec<Stretch>,
    separatrices: Vec<Separatrix>,
    xi: f64,
    time: f64,
    revolutions: f64,
}

impl LevelEvolution {
    /// Follows the levels from an angular momentum `K` (body axes; only the direction matters) to a target, and lists states evenly in
    /// `ξ`. (N5), (N6)
    ///
    /// # Errors
    /// [`LevelError`] if the start is steady or on a separatrix, for an angle that is lost in rounding, and for the angle of a wobble about a
    /// family of steady spins.
    pub fn follow(&self, K: [f64; 3], until: Until, rows: usize) -> Result<LevelPassage, LevelError> {
        let u = self.moving(K)?;
        match until {
            Until::Wobble(angle) if angle < SMALLEST_WOBBLE => return Err(LevelError::TooSmall { angle }),
            _ => {}
        }
        let leg = self.leg(u, None)?;
        let h = self.energy.energy(u);
        let xi = leg.place(h - leg.bottom);
        let mut making = Making {
            levels: self,
            legs: vec![leg],
            stretches: Vec::new(),
            separatrices: Vec::new(),
            xi,
            time: 0.0,
            revolutions: 0.0,
        };
        let ending = making.run(h, until)?;
        making.passage(ending, rows)
    }
}

/// Smallest wobble (rad) whose energy stands out of rounding.
const SMALLEST_WOBBLE: f64 = 1e-6;

impl Making<'_> {
    fn run(&mut self, start: f64, until: Until) -> Result<LevelStopReason, LevelError> {
        loop {
            let leg = self.leg();
            let turn = leg.turn(&self.levels.energy, self.xi).ok_or(LevelError::Open)?;
            if !(turn.loss > 0.0) {
                return Ok(LevelStopReason::Lossless);
            }
            let last = self.end_of_leg();
            let goal = self.goal(start, until)?;
            if let Some(ending) = self.advance(goal.unwrap_or(last), until)? {
                return Ok(ending);
            }
            if goal.is_some() {
                return Ok(LevelStopReason::Reached);
            }
            if let (true, Until::Duration(duration)) = (self.leg().saddles.is_empty(), until) {
                self.stay(duration)?;
                return Ok(LevelStopReason::Duration);
            }
            if !self.pass()? {
                return Ok(LevelStopReason::Undecided);
            }
        }
    }

    fn leg(&self) -> &Leg {
        &self.legs[self.legs.len() - 1]
    }

    /// The last place of the leg that is followed.
    fn end_of_leg(&self) -> f64 {
        let leg = self.leg();
        if leg.saddles.is_empty() { STEADY } else { leg.place(self.levels.saddles().margin()) }
    }

    /// Place of the target, if on this leg.
    fn goal(&self, start: f64, until: Until) -> Result<Option<f64>, LevelError> {
        let leg = self.leg();
        match until {
            Until::EnergyLeft(share) => {
                let above = leg.minimum - leg.bottom + share * (start - leg.minimum);
                let last = leg.saddles.is_empty();
                let on = above > 0.0 && (last || leg.place(above).max(self.xi) < self.end_of_leg());
                Ok(on.then(|| leg.place(above).max(self.xi)))
            }
            Until::Wobble(_) if !leg.isolated => Err(LevelError::Family),
            Until::Wobble(angle) if leg.saddles.is_empty() => self.wobbling(angle).map(Some),
            Until::Wobble(_) | Until::Duration(_) => Ok(None),
        }
    }

    /// Place on the last leg where the greatest angle has fallen to `angle` (rad).
    fn wobbling(&self, angle: f64) -> Result<f64, LevelError> {
        let (leg, energy) = (self.leg(), &self.levels.energy);
        let greatest = |xi: f64| leg.turn(energy, xi).map_or(f64::NAN, |turn| turn.nutation[1]);
        if !(greatest(self.xi) > angle) {
            return Ok(self.xi);
        }
        let mut ends = [self.xi, self.xi + STRETCH];
        while greatest(ends[1]) > angle {
            if ends[1] > NOTHING {
                return Err(LevelError::Open);
            }
            ends = [ends[1], ends[1] + STRETCH];
        }
        for _ in 0..ANGLE_STEPS {
            let middle = 0.5 * (ends[0] + ends[1]);
            let side = usize::from(greatest(middle) <= angle);
            ends[side] = middle;
        }
        Ok(0.5 * (ends[0] + ends[1]))
    }

    /// Integrates to a place on the leg, or to the end of the duration.
    fn advance(&mut self, goal: f64, until: Until) -> Result<Option<LevelStopReason>, LevelError> {
        while self.xi < goal {
            let ends = [self.xi, (self.xi + STRETCH).min(goal)];
            let pieces = self.leg().pieces(&self.levels.energy, ends).ok_or(LevelError::Open)?;
            for piece in pieces {
                let [_, end] = piece.ends;
                let [time, revolutions] = piece.until(end);
                let stretch = Stretch {
                    leg: self.legs.len() - 1,
                    time: self.time,
                    revolutions: self.revolutions,
                    piece,
                };
                self.stretches.push(stretch);
                if let Until::Duration(duration) = until
                    && self.time + time >= duration
                {
                    self.stop_within(duration);
                    return Ok(Some(LevelStopReason::Duration));
                }
                self.time += time;
                self.revolutions += revolutions;
                self.xi = end;
            }
        }
        Ok(None)
    }

    /// Stays in the steady spin that was reached up to an elapsed time.
    fn stay(&mut self, duration: f64) -> Result<(), LevelError> {
        let spin = self.leg().turn(&self.levels.energy, STEADY).ok_or(LevelError::Open)?;
        self.revolutions += (duration - self.time) * spin.turned / (TAU * spin.period);
        self.time = duration;
        Ok(())
    }

    /// Ends within the last stretch at an elapsed time.
    fn stop_within(&mut self, duration: f64) {
        let Stretch { piece, time, revolutions, .. } = &self.stretches[self.stretches.len() - 1];
        self.xi = bisected(piece.ends, |xi| piece.until(xi)[0], duration - time, true);
        self.revolutions = revolutions + piece.until(self.xi)[1];
        self.time = duration;
    }

    /// Passes the saddles at the end of the leg if the ways behind them are alike; returns false where they are not.
    fn pass(&mut self) -> Result<bool, LevelError> {
        let (levels, leg) = (self.levels, self.leg().clone());
        let saddles = levels.saddles();
        self.rest(&leg, self.xi)?;
        let next = saddles.next(&leg.saddles);
        let (ways, alike) = saddles.ways(&next);
        let (time, energy) = (self.time, levels.energy.joules(leg.bottom));
        let passable = alike && !ways.is_empty();
        let mut separatrix = Separatrix { time, energy, ways, alike, circled: None };
        if !passable {
            self.separatrices.push(separatrix);
            return Ok(false);
        }
        let start = next[0].0;
        let below = levels.leg(start, Some(leg.bottom))?;
        separatrix.circled = Some(scale(levels.energy.G, below.circled));
        self.separatrices.push(separatrix);
        self.xi = below.place(levels.energy.energy(start) - below.bottom);
        self.rest(&below, self.xi)?;
        self.legs.push(below);
        Ok(true)
    }

    /// Adds the time between a saddle and the last level followed beside it, where the integrand is a logarithm.
    fn rest(&mut self, leg: &Leg, xi: f64) -> Result<(), LevelError> {
        let [time, revolutions] = leg.slowness(&self.levels.energy, xi).ok_or(LevelError::Open)?;
        // dξ = dh (top − bottom)/((top − h)(h − bottom)): beside an end it is the distance over itself.
        self.time += time * (1.0 + LOGARITHM);
        self.revolutions += revolutions * (1.0 + LOGARITHM);
        Ok(())
    }

    fn passage(self, ending: LevelStopReason, rows: usize) -> Result<LevelPassage, LevelError> {
        let (levels, G) = (self.levels, self.levels.energy.G);
        let row = |leg: &Leg, xi: f64, time: f64, revolutions: f64| {
            let level = leg.level(&levels.energy, xi).ok_or(LevelError::Open)?;
            Ok(LevelRow {
                time,
                revolutions,
                energy: level.energy,
                nutation: level.nutation,
                period: level.period,
                long_axis_precession_rate: level.long_axis_precession_rate,
                power: level.power,
                angular_momentum: scale(G, leg.on(&levels.energy, xi)),
                circled: scale(G, leg.circled),
            })
        };
        let length =
            |stretch: &Stretch| stretch.piece.ends[1].min(self.last(stretch)) - stretch.piece.ends[0];
        let whole: f64 = self.stretches.iter().map(length).sum();
        let mut listed = Vec::new();
        let count = if self.stretches.is_empty() { 0 } else { rows.max(2) };
        let (mut stretch, mut passed) = (0, 0.0);
        for i in 0..count.saturating_sub(1) {
            let way = whole * i as f64 / (count - 1) as f64;
            while stretch + 1 < self.stretches.len() && way >= passed + length(&self.stretches[stretch]) {
                passed += length(&self.stretches[stretch]);
                stretch += 1;
            }
            let Stretch { leg, piece, time, revolutions } = &self.stretches[stretch];
            let xi = piece.ends[0] + (way - passed);
            let [more, further] = piece.until(xi);
            listed.push(row(&self.legs[*leg], xi, time + more, revolutions + further)?);
        }
        // Rows of an evolution that ends at a saddle stop at the last level before the saddle.
        let (xi, leg) = match (ending, self.stretches.last()) {
            (LevelStopReason::Undecided, Some(stretch)) => (stretch.piece.ends[1], &self.legs[stretch.leg]),
            _ => (self.xi, &self.legs[self.legs.len() - 1]),
        };
        listed.push(row(leg, xi, self.time, self.revolutions)?);
        let attractor = self.legs[self.legs.len() - 1].descent.end();
        Ok(LevelPassage {
            rows: listed,
            separatrices: self.separatrices,
            ending,
            attractor: scale(G, attractor),
        })
    }

    /// The last place reached on the leg of a stretch.
    fn last(&self, stretch: &Stretch) -> f64 {
        if stretch.leg + 1 == self.legs.len() { self.xi } else { f64::INFINITY }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::vec3::norm;
    use crate::problems::ring_of_points;
    use crate::reduction::reduce;

    /// What is added beside a saddle is the rest of the way to it: the same time and revolutions remain, however far levels are followed.
    #[test]
    fn the_rest_of_the_way_to_a_saddle_has_no_end_of_its_own() {
        let reduced = reduce(&ring_of_points(2).body().unwrap(), 3).unwrap();
        let K = reduced.angular_momentum([1.0, 0.2, 0.1]);
        let levels = LevelEvolution::new(&reduced, norm(K)).unwrap();
        let leg = levels.leg(levels.moving(K).unwrap(), None).unwrap();
        assert!(!leg.saddles.is_empty());
        let rest = |xi: f64| {
            let (time, revolutions) = (0.0, 0.0);
            let (legs, stretches, separatrices) = (Vec::new(), Vec::new(), Vec::new());
            let mut making = Making { levels: &levels, legs, stretches, separatrices, xi, time, revolutions };
            making.rest(&leg, xi).unwrap();
            [making.time, making.revolutions]
        };
        let pieces = leg.pieces(&levels.energy, [10.0, 12.0]).unwrap();
        let (near, far) = (rest(10.0), rest(12.0));
        for i in 0..2 {
            let between: f64 = pieces.iter().map(|piece| piece.until(piece.ends[1])[i]).sum();
            assert!(
                ((between + far[i]) / near[i] - 1.0).abs() < 0.05,
                "{between} and {} of {}",
                far[i],
                near[i]
            );
        }
    }
}
