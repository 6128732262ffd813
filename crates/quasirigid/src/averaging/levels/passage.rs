use super::evolution::{LevelError, LevelEvolution};
use super::leg::{Leg, Piece};
use super::saddle_passage::Separatrix;
use crate::math::bisection::bisected;
use crate::math::vec3::scale;

/// What ends an evolution along levels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Until {
    /// A share is left of the energy that the start has above the steady spin that attracts.
    EnergyLeft(f64),
    /// The greatest angle (rad) between the momentum and the steady spin that attracts has fallen to this.
    Wobble(f64),
    /// A time has passed (s).
    Duration(f64),
}

/// An evolution along levels.
#[derive(Clone, Debug, PartialEq)]
pub struct LevelPassage {
    /// States on the way, start and end among them.
    pub rows: Vec<LevelRow>,
    /// Energies of saddles passed on the way, the one that ended it last.
    pub separatrices: Vec<Separatrix>,
    /// Why it ended.
    pub ending: LevelEnding,
    /// Momentum (N·m·s, body axes) of the steady spin that attracts; behind a separatrix whose ways are alike, one of them.
    pub attractor: [f64; 3],
}

/// A state on the way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LevelRow {
    /// Time (s).
    pub time: f64,
    /// Turns about the angular momentum.
    pub turns: f64,
    /// Slow energy (J).
    pub energy: f64,
    /// Least and greatest angle (rad) between the momentum and the steady spin circled.
    pub nutation: [f64; 2],
    /// Period of the level (s).
    pub period: f64,
    /// Mean rate (rad/s) at which the axis of least inertia goes round the momentum. (N7)
    pub long_axis_precession_rate: f64,
    /// Mean power dissipated (W).
    pub power: f64,
    /// A momentum on the level (N·m·s, body axes).
    pub momentum: [f64; 3],
    /// Momentum of the steady spin circled (N·m·s, body axes).
    pub circled: [f64; 3],
}

/// Why an evolution along levels ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LevelEnding {
    /// The target was reached.
    Reached,
    /// The duration has passed.
    Duration,
    /// At a separatrix behind which the ways differ: the last of [`LevelPassage::separatrices`] lists them.
    Undecided,
    /// Nothing is dissipated.
    Lossless,
}

/// Length of the way that is integrated at once, and where a wobble has fallen to nothing.
const STRETCH: f64 = 2.0;
const NOTHING: f64 = 300.0;
/// Share of the logarithm that the last piece of time next to a saddle has beside its end value, `1/ln(1/margin)`.
const LOGARITHM: f64 = 1.0 / 16.0;
/// Halvings that find an angle on the way.
const ANGLE_STEPS: usize = 50;

/// A piece with what went before it.
struct Stretch {
    leg: usize,
    piece: Piece,
    time: f64,
    turns: f64,
}

/// An evolution in the making.
struct Making<'a> {
    levels: &'a LevelEvolution,
    legs: Vec<Leg>,
    stretches: Vec<Stretch>,
    separatrices: Vec<Separatrix>,
    xi: f64,
    time: f64,
    turns: f64,
}

impl LevelEvolution {
    /// Follows the levels from a momentum `K` (body axes; its direction counts) to a target, and lists states evenly along the
    /// way. (N5), (N6)
    ///
    /// # Errors
    /// [`LevelError`] if the start is steady or on a separatrix, and for the angle of a wobble about a family of steady spins.
    pub fn follow(&self, K: [f64; 3], until: Until, rows: usize) -> Result<LevelPassage, LevelError> {
        let u = self.moving(K)?;
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
            turns: 0.0,
        };
        let followed = making.run(h, until).and_then(|ending| making.passage(ending, rows));
        followed.map_err(|error| match (error, until) {
            (LevelError::Open, Until::Wobble(angle)) if angle < SMALLEST => LevelError::TooSmall { angle },
            (error, _) => error,
        })
    }
}

/// Wobbles (rad) above this have an energy that stands out of rounding.
const SMALLEST: f64 = 1e-6;

impl Making<'_> {
    fn run(&mut self, start: f64, until: Until) -> Result<LevelEnding, LevelError> {
        loop {
            let leg = self.leg();
            let turn = leg.turn(&self.levels.energy, self.xi).ok_or(LevelError::Open)?;
            if !(turn.loss > 0.0) {
                return Ok(LevelEnding::Lossless);
            }
            let last = self.end_of_leg();
            let goal = self.goal(start, until)?;
            if let Some(ending) = self.advance(goal.unwrap_or(last), until)? {
                return Ok(ending);
            }
            if goal.is_some() {
                return Ok(LevelEnding::Reached);
            }
            if !self.pass()? {
                return Ok(LevelEnding::Undecided);
            }
        }
    }

    fn leg(&self) -> &Leg {
        &self.legs[self.legs.len() - 1]
    }

    /// The last place of the leg that is followed.
    fn end_of_leg(&self) -> f64 {
        let leg = self.leg();
        if leg.saddles.is_empty() { NOTHING } else { leg.place(self.levels.saddles().margin()) }
    }

    /// The place of the target, if it lies on this leg.
    fn goal(&self, start: f64, until: Until) -> Result<Option<f64>, LevelError> {
        let leg = self.leg();
        match until {
            Until::EnergyLeft(share) => {
                let above = leg.minimum - leg.bottom + share * (start - leg.minimum);
                let on = above > 0.0 && leg.place(above).max(self.xi) < self.end_of_leg();
                Ok(on.then(|| leg.place(above).max(self.xi)))
            }
            Until::Wobble(_) if !leg.isolated => Err(LevelError::Family),
            Until::Wobble(angle) if leg.saddles.is_empty() => self.wobbling(angle).map(Some),
            Until::Wobble(_) | Until::Duration(_) => Ok(None),
        }
    }

    /// The place on the last leg where the greatest angle has fallen to this.
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
    fn advance(&mut self, goal: f64, until: Until) -> Result<Option<LevelEnding>, LevelError> {
        while self.xi < goal {
            let ends = [self.xi, (self.xi + STRETCH).min(goal)];
            let pieces = self.leg().pieces(&self.levels.energy, ends).ok_or(LevelError::Open)?;
            for piece in pieces {
                let [_, end] = piece.ends;
                let [time, turns] = piece.until(end);
                let stretch = Stretch { leg: self.legs.len() - 1, time: self.time, turns: self.turns, piece };
                self.stretches.push(stretch);
                if let Until::Duration(duration) = until
                    && self.time + time >= duration
                {
                    self.stop_within(duration);
                    return Ok(Some(LevelEnding::Duration));
                }
                self.time += time;
                self.turns += turns;
                self.xi = end;
            }
        }
        Ok(None)
    }

    /// Ends in the last stretch, when a time has passed.
    fn stop_within(&mut self, duration: f64) {
        let Stretch { piece, time, turns, .. } = &self.stretches[self.stretches.len() - 1];
        self.xi = bisected(piece.ends, |xi| piece.until(xi)[0], duration - time, true);
        self.turns = turns + piece.until(self.xi)[1];
        self.time = duration;
    }

    /// Passes the saddles at the end of the leg if it matters little which way; says whether it did.
    fn pass(&mut self) -> Result<bool, LevelError> {
        let (levels, leg) = (self.levels, self.leg().clone());
        let saddles = levels.saddles();
        self.rest(&leg, self.xi)?;
        let next = saddles.next(&leg.saddles);
        let (ways, alike) = saddles.ways(&next);
        let (time, energy) = (self.time, levels.energy.joules(leg.bottom));
        let passable = alike && !ways.is_empty();
        self.separatrices.push(Separatrix { time, energy, ways, alike });
        if !passable {
            return Ok(false);
        }
        let start = next[0].0;
        let below = levels.leg(start, Some(leg.bottom))?;
        self.xi = below.place(levels.energy.energy(start) - below.bottom);
        self.rest(&below, self.xi)?;
        self.legs.push(below);
        Ok(true)
    }

    /// Adds the time between a saddle and the last level followed beside it, where the integrand is a logarithm.
    fn rest(&mut self, leg: &Leg, xi: f64) -> Result<(), LevelError> {
        let [time, turns] = leg.slowness(&self.levels.energy, xi).ok_or(LevelError::Open)?;
        // dξ = dh (top − bottom)/((top − h)(h − bottom)): beside an end it is the distance over itself.
        self.time += time * (1.0 + LOGARITHM);
        self.turns += turns * (1.0 + LOGARITHM);
        Ok(())
    }

    fn passage(self, ending: LevelEnding, rows: usize) -> Result<LevelPassage, LevelError> {
        let (levels, G) = (self.levels, self.levels.energy.G);
        let row = |leg: &Leg, xi: f64, time: f64, turns: f64| {
            let level = leg.level(&levels.energy, xi).ok_or(LevelError::Open)?;
            Ok(LevelRow {
                time,
                turns,
                energy: level.energy,
                nutation: level.nutation,
                period: level.period,
                long_axis_precession_rate: level.long_axis_precession_rate,
                power: level.power,
                momentum: scale(G, leg.on(&levels.energy, xi)),
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
            let Stretch { leg, piece, time, turns } = &self.stretches[stretch];
            let xi = piece.ends[0] + (way - passed);
            let [more, further] = piece.until(xi);
            listed.push(row(&self.legs[*leg], xi, time + more, turns + further)?);
        }
        // An evolution that ends at a saddle is told up to the last level before it.
        let (xi, leg) = match (ending, self.stretches.last()) {
            (LevelEnding::Undecided, Some(stretch)) => (stretch.piece.ends[1], &self.legs[stretch.leg]),
            _ => (self.xi, &self.legs[self.legs.len() - 1]),
        };
        listed.push(row(leg, xi, self.time, self.turns)?);
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
