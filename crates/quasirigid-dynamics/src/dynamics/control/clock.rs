//! Instants that come again: `offset + k · period`. (Y3)

/// Instants at a period from an offset on (s).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::dynamics) struct Clock {
    pub period: f64,
    pub offset: f64,
}

/// Distance of an instant from a time, relative to it, that counts as none: as that of stops.
const APART: f64 = 64.0 * f64::EPSILON;

impl Clock {
    fn at(&self, number: f64) -> f64 {
        self.offset + number * self.period
    }

    fn nearest(&self, t: f64) -> f64 {
        ((t - self.offset) / self.period).round().max(0.0)
    }

    /// Number of the instant at a time; none between instants.
    pub fn tick(&self, t: f64) -> Option<u64> {
        let nearest = self.nearest(t);
        ((self.at(nearest) - t).abs() <= APART * t.abs()).then_some(nearest as u64)
    }

    /// First instant after a time.
    pub fn next(&self, t: f64) -> f64 {
        let nearest = self.nearest(t);
        let later = t + APART * t.abs();
        if self.at(nearest) > later { self.at(nearest) } else { self.at(nearest + 1.0) }
    }

    /// Last instant up to a time, which is that time itself where it is one; none before the first.
    pub fn last(&self, t: f64) -> Option<f64> {
        if self.tick(t).is_some() {
            return Some(t);
        }
        let before = ((t - self.offset) / self.period).floor();
        (before >= 0.0).then(|| self.at(before))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn instants_follow_each_other_without_gap() {
        for clock in [Clock { period: 0.1, offset: 0.0 }, Clock { period: 0.7, offset: 0.3 }] {
            let (mut t, mut number) = (clock.offset, 0);
            while number < 10_000 {
                assert_eq!(clock.tick(t), Some(number));
                assert_eq!(clock.last(t), Some(t));
                let between = t + 0.4 * clock.period;
                assert_eq!((clock.tick(between), clock.last(between)), (None, Some(clock.at(number as f64))));
                (t, number) = (clock.next(t), number + 1);
                assert_eq!(clock.next(between), t);
            }
        }
        assert_eq!(Clock { period: 1.0, offset: 0.5 }.last(0.2), None);
        assert_eq!(Clock { period: 1.0, offset: 0.5 }.next(0.0), 0.5);
    }
}
