//! Places in time that no step passes: breakpoints, where the steps begin anew, and ends of the intervals in which what acts changes
//! quickly. (Z1) to (Z3), (Z6)

use std::f64::consts::{PI, TAU};

use super::prescribed::varies;
use crate::dynamics::control::{Clock, ControlTimes};
use crate::dynamics::external::{Forced, Pose};
use crate::math::expression::Expression;
use crate::math::ode::Stretch;
use crate::model::force::{Conic, ForceLaw, MagneticField, Orbit, TIME, Trajectory, VARIABLES};
use crate::model::{Marker, Support};

/// Stops of a run.
#[derive(Clone, Debug, Default)]
pub(super) struct Stops<'a> {
    /// All stops but periodic ones, ascending.
    all: Vec<f64>,
    /// Those at which the steps begin anew.
    breaks: Vec<f64>,
    periodic: Vec<Periodic>,
    /// Instants of controllers, breakpoints too. (Y3)
    clocks: Vec<Clock>,
    formulas: Vec<Formula<'a>>,
    end: f64,
    /// Time up to which the formulas have been followed, and the length of the part that is tried next (s).
    followed: f64,
    part: f64,
    /// Evaluations of formulas.
    pub evaluations: u64,
    /// Time (s) from which the formulas could not be followed.
    pub lost: Option<f64>,
}

/// Stops that come again.
#[derive(Clone, Debug)]
struct Periodic {
    period: f64,
    /// Places in the first period, ascending.
    places: Vec<f64>,
}

/// Formula with its variables at the start, one of which is the time.
#[derive(Clone, Debug)]
struct Formula<'a> {
    formula: &'a Expression,
    time: usize,
    at: Vec<f64>,
}

/// Evaluations of all formulas together in a part of the run, and in the whole of it. (Z3)
const IN_PART: u64 = 1_000_000;
const IN_ALL: u64 = 1_000_000_000;
/// Share of a part that is tried after one in which the evaluations did not suffice.
const RETRIED_SHARE: f64 = 0.25;
/// Shortest part, as a share of the run.
const SHORTEST_PART: f64 = 1e-9;
/// Distance of two stops, relative to the time, below which they are one: no step is shorter.
const APART: f64 = 64.0 * f64::EPSILON;
/// Stops in an orbit, at equal steps of the eccentric anomaly.
const IN_ORBIT: usize = 8;

/// Stops of what acts on a body from `t = 0` to an end (s).
pub(super) fn stops<'a>(system: Forced<'a>, omega: [f64; 3], pose: &Pose<f64>, end: f64) -> Stops<'a> {
    let mut stops = Stops { end, part: end, ..Stops::default() };
    let [x, y, z] = pose.place;
    let [vx, vy, vz] = pose.velocity;
    let [wx, wy, wz] = omega;
    let [qw, qx, qy, qz] = pose.attitude;
    let felt: [f64; VARIABLES] = [x, y, z, vx, vy, vz, 0.0, wx, wy, wz, qw, qx, qy, qz];
    for force in system.forces {
        let (law, windows) = force.law.timed();
        stops.breaks.extend(windows.into_iter().flat_map(|windows| windows.list().as_flattened()));
        stops.of_law(law);
        if let Some(own) = law.formulas().filter(|formulas| varies(formulas)) {
            stops.formulas.extend(own.iter().map(|formula| Formula {
                formula,
                time: TIME,
                at: felt.to_vec(),
            }));
        }
    }
    let alone = |formula: &'a Expression| Formula { formula, time: 0, at: vec![0.0] };
    if let Support::Prescribed { acceleration, .. } = system.body.support() {
        stops.formulas.extend(acceleration.iter().map(alone));
    }
    stops.formulas.extend(system.body.wheels().driven.iter().map(|wheel| alone(&wheel.speed)));
    stops.formulas.extend(system.body.drives().iter().map(|drive| alone(&drive.law)));
    stops.formulas.retain(|Formula { formula, time, .. }| formula.uses(*time));
    if stops.formulas.is_empty() {
        stops.followed = end;
    }
    stops.settle();
    stops
}

impl Stops<'_> {
    fn of_law(&mut self, law: &ForceLaw<Marker>) {
        match law {
            ForceLaw::Torque { wave, .. } | ForceLaw::Thrust { wave, .. } if wave.frequency != 0.0 => {
                self.periodic.push(Periodic { period: TAU / wave.frequency.abs(), places: vec![0.0] });
            }
            ForceLaw::TorqueTable { table, .. } | ForceLaw::ForceTable { table, .. } => {
                self.breaks.extend(table.times());
            }
            ForceLaw::MagneticDipole { field, .. } | ForceLaw::EddyCurrent { field, .. } => {
                self.periodic.extend(Periodic::of_field(field));
            }
            _ => {}
        }
        match law.trajectory() {
            Some(Trajectory::Orbit(orbit)) => self.periodic.push(Periodic::orbit(orbit)),
            Some(Trajectory::Conic(conic)) => self.of_conic(conic),
            Some(Trajectory::Table(table)) => self.breaks.extend(table.times()),
            None => {}
        }
    }

    /// The instants of controllers, and those of their field. (Y3), (Y8)
    pub fn of_controllers(&mut self, ControlTimes { clocks, field }: ControlTimes) {
        self.clocks = clocks;
        self.periodic.extend(field.iter().flat_map(Periodic::of_field));
    }

    /// The passage of the periapsis, and times from it that double from half of that in which the body passes its distance. (Z6)
    fn of_conic(&mut self, conic: &Conic) {
        let (middle, unit, period) = (conic.time_of_periapsis, conic.passing_time(), conic.period());
        let most = period.map_or(middle.abs() + self.end, |period| 0.5 * period);
        let apart = std::iter::successors(Some(0.5 * unit), |apart| Some(2.0 * apart));
        let apart: Vec<f64> = apart.take_while(|apart| *apart < most).collect();
        let places = apart.iter().flat_map(|apart| [middle - apart, middle + apart]).chain([middle]);
        match period {
            Some(period) => {
                let mut places: Vec<f64> = places.map(|t| t.rem_euclid(period)).collect();
                places.sort_by(f64::total_cmp);
                self.periodic.push(Periodic { period, places });
            }
            None => self.all.extend(places),
        }
    }

    /// Puts the stops in order and apart.
    fn settle(&mut self) {
        let end = self.end;
        let merge = |list: &mut Vec<f64>| {
            list.sort_by(f64::total_cmp);
            list.dedup_by(|later, kept| *later - *kept <= APART * later.abs());
        };
        // a break that all but is an end of the run is one
        for t in &mut self.breaks {
            let end = [0.0, end].into_iter().find(|end_of_run| (*t - end_of_run).abs() <= APART * end);
            *t = end.unwrap_or(*t);
        }
        self.breaks.retain(|t| (0.0..=end).contains(t));
        merge(&mut self.breaks);
        let breaks = &self.breaks;
        let near = |t: f64| {
            let after = breaks.partition_point(|other| *other < t);
            let nearest = [after.checked_sub(1), Some(after)].into_iter().flatten();
            nearest.filter_map(|i| breaks.get(i)).any(|other| (other - t).abs() <= APART * t.abs())
        };
        self.all.retain(|t| !near(*t));
        self.all.extend(breaks);
        self.all.retain(|t| *t > 0.0 && *t < end * (1.0 - APART));
        merge(&mut self.all);
    }

    /// Follows the formulas beyond a time, in parts whose cost is bounded, so that a run pays for what its steps reach. (Z3)
    pub fn follow(&mut self, t: f64) {
        while self.followed <= t && self.followed < self.end {
            let from = self.followed;
            let to =
                if from + self.part < self.end * (1.0 - SHORTEST_PART) { from + self.part } else { self.end };
            if self.evaluations > IN_ALL || to - from < SHORTEST_PART * self.end {
                (self.lost, self.followed) = (Some(from), self.end);
            } else if self.follow_part(from, to) {
                self.followed = to;
                self.settle();
            } else {
                self.part = RETRIED_SHARE * (to - from);
            }
        }
    }

    /// Follows the formulas over a part of the run; false if the evaluations did not suffice.
    fn follow_part(&mut self, from: f64, to: f64) -> bool {
        let budget = IN_PART / self.formulas.len() as u64;
        let (mut breaks, mut ends) = (vec![from, to], Vec::new());
        for Formula { formula, time, at } in &self.formulas {
            let found = formula.changes(*time, at, [from, to], budget);
            self.evaluations += found.evaluations;
            if !found.complete {
                return false;
            }
            breaks.extend(found.breaks);
            ends.extend(found.ends);
        }
        self.breaks.extend(breaks);
        self.all.extend(ends);
        true
    }

    /// True if a run has no stops and will have none.
    pub fn is_empty(&self) -> bool {
        let none = self.all.is_empty() && self.breaks.is_empty() && self.clocks.is_empty();
        none && self.periodic.is_empty() && self.formulas.is_empty()
    }

    /// Stops known so far within the run, without those that come again.
    pub fn list(&self) -> &[f64] {
        &self.all
    }

    /// Number of breakpoints known so far within the run.
    pub fn breakpoints(&self) -> usize {
        self.breaks.iter().filter(|t| **t > 0.0 && **t < self.end).count()
    }

    /// Next stop after a time that has been followed; infinite without one before the end.
    pub fn next(&self, t: f64) -> f64 {
        let own = self.all.get(self.all.partition_point(|stop| *stop <= t)).copied().unwrap_or(f64::INFINITY);
        let again = self.periodic.iter().map(|periodic| periodic.next(t)).fold(f64::INFINITY, f64::min);
        let again = if own - again <= APART * again.abs() { own } else { again };
        let next = self.clocks.iter().fold(own.min(again), |next, clock| {
            let instant = clock.next(t);
            if instant < next * (1.0 - APART) { instant } else { next }
        });
        if next < self.end * (1.0 - APART) { next } else { f64::INFINITY }
    }

    /// The stretch between breakpoints that lies after a time that has been followed, and whether it begins there; none without breakpoints.
    pub fn stretch(&self, t: f64) -> Option<(Stretch, bool)> {
        if self.breaks.is_empty() && self.clocks.is_empty() {
            return None;
        }
        let after = self.breaks.partition_point(|stop| *stop <= t);
        let from = after.checked_sub(1).map_or(f64::NEG_INFINITY, |before| self.breaks[before]);
        let to = self.breaks.get(after).copied().unwrap_or(f64::INFINITY);
        let from = self.clocks.iter().filter_map(|clock| clock.last(t)).fold(from, f64::max);
        let to = self.clocks.iter().map(|clock| clock.next(t)).fold(to, f64::min);
        Some((Stretch { from, to }, from == t))
    }
}

impl Periodic {
    /// Equal steps of the eccentric anomaly. (F10)
    fn orbit(orbit: &Orbit) -> Self {
        let period = orbit.period();
        let place = |step: usize| {
            let E = TAU * step as f64 / IN_ORBIT as f64 - PI;
            let M = E - orbit.eccentricity * E.sin() - orbit.mean_anomaly;
            M.rem_euclid(TAU) / TAU * period
        };
        let mut places: Vec<f64> = (0..IN_ORBIT).map(place).collect();
        places.sort_by(f64::total_cmp);
        Self { period, places }
    }

    /// Those of the orbit, and even ones in the turn of the dipole. (F8)
    fn of_field(field: &MagneticField) -> impl Iterator<Item = Self> {
        let turn = Some(field.rotation().abs()).filter(|rate| *rate > 0.0).map(|rate| {
            let period = TAU / rate;
            Self { period, places: (0..IN_ORBIT).map(|i| period * i as f64 / IN_ORBIT as f64).collect() }
        });
        field.orbit().map(Self::orbit).into_iter().chain(turn)
    }

    fn next(&self, t: f64) -> f64 {
        let turns = (t / self.period).floor() - 1.0;
        let later = t + APART * t.abs();
        let mut all = (0..4).flat_map(|turn| {
            let start = (turns + f64::from(turn)) * self.period;
            self.places.iter().map(move |place| start + place)
        });
        all.find(|stop| *stop > later).unwrap_or(f64::INFINITY)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stops_come_in_order_and_apart() {
        let mut stops = Stops {
            all: vec![3.0, 1.0, 0.0, 7.0, 2.0 + 4e-16],
            breaks: vec![2.0, 9.0, 10.0 - 2e-15, 11.0],
            periodic: vec![Periodic { period: 4.0, places: vec![0.0] }],
            end: 10.0,
            ..Stops::default()
        };
        stops.settle();
        let mut t = 0.0;
        let mut found = Vec::new();
        while found.len() < 20 && t < 10.0 {
            t = stops.next(t);
            found.push(t);
        }
        assert_eq!(found, [1.0, 2.0, 3.0, 4.0, 7.0, 8.0, 9.0, f64::INFINITY]);
        assert_eq!(stops.stretch(2.0), Some((Stretch { from: 2.0, to: 9.0 }, true)));
        assert_eq!(stops.stretch(9.5), Some((Stretch { from: 9.0, to: 10.0 }, false)));
        assert_eq!((stops.breakpoints(), stops.list().len()), (2, 5));
    }

    #[test]
    fn periodic_stops_go_on_after_the_last_other() {
        for all in [vec![], vec![1.0]] {
            let periodic = vec![Periodic { period: 4.0, places: vec![0.5] }];
            let stops = Stops { all: all.clone(), periodic, end: 9.0, ..Stops::default() };
            let found: Vec<f64> = [0.5, 1.0, 4.5, 8.5].map(|t| stops.next(t)).to_vec();
            let first = all.first().copied().unwrap_or(4.5);
            assert_eq!(found, [first, 4.5, 8.5, f64::INFINITY]);
        }
    }

    /// Instants of a controller beside a break: one that is a break to rounding is that break.
    #[test]
    fn instants_of_controllers_are_breakpoints() {
        let clocks = vec![Clock { period: 0.1, offset: 0.0 }, Clock { period: 0.1, offset: 0.04 }];
        let mut stops = Stops { breaks: vec![0.3, 0.35], clocks, end: 1.0, ..Stops::default() };
        stops.settle();
        let mut t = 0.0;
        let found: Vec<f64> = (0..8)
            .map(|_| {
                let (stretch, begins) = stops.stretch(t).unwrap();
                assert!(begins && stretch.from == t, "{stretch:?} {t}");
                t = stops.next(t);
                t
            })
            .collect();
        let expected = [0.04, 0.1, 0.14, 0.2, 0.24, 0.3, 0.34, 0.35];
        assert!(found.iter().zip(expected).all(|(t, known)| (t - known).abs() < 1e-15), "{found:?}");
        let (stretch, begins) = stops.stretch(0.37).unwrap();
        assert!(!begins && stretch == Stretch { from: 0.35, to: 0.4 }, "{stretch:?}");
    }

    fn followed(formula: &Expression, end: f64) -> Stops<'_> {
        let formulas = vec![Formula { formula, time: 0, at: vec![0.0] }];
        Stops { formulas, end, part: end, ..Stops::default() }
    }

    /// A formula that changes too often for one part is followed in several, each when the steps come to it, and nothing is lost between.
    #[test]
    fn long_formulas_are_followed_part_by_part() {
        let formula = Expression::parse("max(0, sin(6.283185307179586*t)-0.9)", &["t"]).unwrap();
        let mut stops = followed(&formula, 1e5);
        stops.follow(0.0);
        let (first, spent) = (stops.followed, stops.evaluations);
        assert!(first > 100.0 && first < 1e5 && spent < 12 * IN_PART, "{first} {spent}");
        stops.follow(first);
        assert!(stops.followed > first && stops.lost.is_none());
        let corners = stops.breaks.iter().filter(|t| **t < (first + 50.0).floor()).count() as f64;
        let edges = stops.breaks.iter().filter(|t| **t < first + 50.0 && (*t / first).fract() == 0.0).count();
        assert_eq!(corners - edges as f64, 2.0 * (first + 50.0).floor());
    }

    #[test]
    fn what_cannot_be_followed_is_lost() {
        let formula = Expression::parse("sin(1e12*t)", &["t"]).unwrap();
        let mut stops = followed(&formula, 1e3);
        stops.follow(0.0);
        assert_eq!(stops.lost, Some(0.0));
        assert!(stops.evaluations < 20 * IN_PART);
    }
}
