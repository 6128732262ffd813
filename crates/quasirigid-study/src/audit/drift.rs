//! Drift of the invariants along a history: energy, angular momentum and the excess of the wobble, whole and by intervals of time.

use quasirigid::model::Mode;

use super::measure::Measured;
use super::rigid::Rigid;
use super::trend::Trend;

/// Intervals of the table.
const INTERVALS: usize = 10;
/// Rows of an interval at least.
const LEAST_ROWS: usize = 3;
/// Revolutions before which no trend is told from an oscillation.
const LEAST_TURNS: f64 = 1.0;
/// Rounding errors of the excess above which a wobble is one.
const ABOVE_ROUNDING: f64 = 3.0;
/// Share of the rows that have to show the wobble.
const MOST_ROWS: f64 = 0.9;

/// Invariants of a row.
#[derive(Clone, Copy, Debug)]
struct Row {
    t: f64,
    energy: f64,
    momentum: f64,
    /// Excess about the axis of the mode, and its rounding.
    excess: (f64, f64),
}

/// Relative drift of an invariant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Change {
    /// From the first row to the last.
    pub last: f64,
    /// The largest from the first row to any.
    pub largest: f64,
    /// Most that rounding makes between two rows.
    pub rounding: f64,
}

impl Change {
    /// Whether it is more than rounding makes.
    pub fn is_seen(&self) -> bool {
        self.largest > self.rounding
    }
}

/// Interval of a history.
#[derive(Clone, Debug)]
pub struct Interval {
    /// First and last time (s).
    pub times: [f64; 2],
    /// Mean wobble (rad); none where the body has none.
    pub wobble: Option<f64>,
    /// Trend of the energy, relative.
    pub power: Option<Trend>,
    /// Trend of the amplitude of the wobble, relative.
    pub wobble_trend: Option<Trend>,
    /// Trend of energy or angular momentum, or the largest step between two rows over the interval, relative (1/s).
    fastest: f64,
}

/// Drift of a history.
#[derive(Clone, Debug)]
pub struct Drift {
    /// Angular momentum of the first row (kg·m²·rad/s), in the unit of the tensor.
    pub momentum: f64,
    /// Of the angular momentum.
    pub momentum_change: Change,
    /// Of the energy.
    pub energy_change: Change,
    /// Mode of the first row.
    pub mode: Mode,
    /// Whether the rows show a wobble above their rounding.
    pub has_wobble: bool,
    /// Time (s) of the first row in the other mode.
    pub crossing: Option<f64>,
    /// Trend of the amplitude of the wobble, relative: the slope is `−1/τ`. (J3)
    pub wobble_trend: Option<Trend>,
    /// Intervals of equal time.
    pub intervals: Vec<Interval>,
    /// Interval in which energy or angular momentum changed fastest; none where neither changed by more than rounding.
    pub worst: Option<[f64; 2]>,
    /// Revolutions of the whole history.
    pub turns: f64,
    /// Whether it is shorter than a revolution or a period of the wobble.
    pub short: bool,
}

impl Drift {
    /// The drift of a history.
    pub fn of(measured: &Measured, body: &Rigid) -> Self {
        let moments = body.principal.moments;
        let (t, rates) = (&measured.file.t, &measured.file.rates);
        let first = body.invariants(rates[0], measured.rounding(0));
        let mode = first.mode(moments);
        let mut crossing = None;
        let (mut energy_rounding, mut momentum_rounding) = (0.0_f64, 0.0_f64);
        let rows: Vec<Row> = (0..t.len())
            .map(|k| {
                let found = body.invariants(rates[k], measured.rounding(k));
                if found.mode(moments) != mode && crossing.is_none() {
                    crossing = Some(t[k]);
                }
                energy_rounding = energy_rounding.max(found.rounding.energy);
                momentum_rounding = momentum_rounding.max(found.rounding.momentum);
                Row { t: t[k], energy: found.energy, momentum: found.momentum, excess: found.excess(mode) }
            })
            .collect();
        let shown = rows.iter().filter(|row| row.excess.0 > ABOVE_ROUNDING * row.excess.1).count();
        let has_wobble = body.wobbles() && shown as f64 >= MOST_ROWS * rows.len() as f64;
        let wobbles = has_wobble && crossing.is_none();
        let pieces: Vec<Interval> = intervals(&rows)
            .into_iter()
            .map(|rows| interval(rows, body, mode, has_wobble, wobbles))
            .collect();
        let energy_change = change(&rows, |row| row.energy, 2.0 * energy_rounding);
        let momentum_change = change(&rows, |row| row.momentum, 2.0 * momentum_rounding);
        let seen = energy_change.is_seen() || momentum_change.is_seen();
        let worst = pieces.iter().max_by(|a, b| a.fastest.total_cmp(&b.fastest)).filter(|_| seen);
        let angle: f64 = (1..t.len())
            .map(|k| {
                (t[k] - t[k - 1])
                    * 0.5
                    * [k - 1, k].map(|row| quasirigid_math::vec3::norm(rates[row])).iter().sum::<f64>()
            })
            .sum();
        let turns = angle / std::f64::consts::TAU;
        let polhode =
            body.principal.polhode(rates[0]).map_or(0.0, |polhode| std::f64::consts::TAU / polhode.frequency);
        let short = turns < LEAST_TURNS || t[t.len() - 1] - t[0] < polhode;
        Self {
            momentum: first.momentum,
            momentum_change,
            energy_change,
            mode,
            has_wobble,
            crossing,
            wobble_trend: wobbles.then(|| amplitude(&rows)).flatten().filter(|_| !short),
            worst: worst.map(|interval| interval.times),
            intervals: pieces,
            turns,
            short,
        }
    }

    /// Wobble (rad) of the first interval and of the last.
    pub fn wobble(&self) -> Option<[f64; 2]> {
        Some([self.intervals.first()?.wobble?, self.intervals.last()?.wobble?])
    }
}

fn change(rows: &[Row], of: impl Fn(&Row) -> f64, rounding: f64) -> Change {
    let first = rows.first().map_or(f64::NAN, &of);
    let relative = |row: &Row| of(row) / first - 1.0;
    let largest = rows.iter().map(|row| relative(row).abs()).fold(0.0, f64::max);
    Change { last: rows.last().map_or(0.0, relative), largest, rounding }
}

/// Trend of the logarithm of the amplitude, whose square is in proportion to the excess. Beside the digits of a row stands the rounding of an
/// integrator in double precision, which walks by a unit in the last place of the rates from row to row. (J3)
fn amplitude(rows: &[Row]) -> Option<Trend> {
    let walk = f64::EPSILON * (rows.len() as f64).sqrt();
    Trend::of(rows.iter().map(move |Row { t, excess: (excess, rounding), .. }| {
        (*t, 0.5 * excess.ln(), 0.5 * rounding / excess + walk / excess.sqrt())
    }))
}

/// Rows by intervals of equal time, which share the rows at their ends.
fn intervals(rows: &[Row]) -> Vec<&[Row]> {
    let count = INTERVALS.min(rows.len() / LEAST_ROWS).max(1);
    let [from, to] = [rows.first(), rows.last()].map(|row| row.map_or(0.0, |row| row.t));
    let bound = |k: usize| match k {
        _ if k == count => rows.len() - 1,
        _ => rows.partition_point(|row| row.t < from + (to - from) * k as f64 / count as f64),
    };
    let bounds: Vec<usize> = (0..=count).map(bound).collect();
    let pairs = bounds.windows(2).filter(|pair| pair[1] > pair[0]);
    pairs.map(|pair| &rows[pair[0]..=pair[1]]).collect()
}

fn interval(rows: &[Row], body: &Rigid, mode: Mode, has_wobble: bool, wobbles: bool) -> Interval {
    let [from, to] = [rows.first(), rows.last()].map(|row| row.map_or(0.0, |row| row.t));
    let mean = rows.iter().map(|row| row.excess.0).sum::<f64>() / rows.len() as f64;
    let first = rows.first().map_or(1.0, |row| row.energy);
    let power = Trend::of(rows.iter().map(|row| (row.t, row.energy / first, 0.0)));
    let fastest = |of: fn(&Row) -> f64| {
        let level = rows.first().map_or(1.0, of);
        let trend = Trend::of(rows.iter().map(|row| (row.t, of(row) / level, 0.0)));
        let steps = rows.windows(2).map(|pair| (of(&pair[1]) - of(&pair[0])).abs() / level / (to - from));
        steps.fold(trend.map_or(0.0, |trend| trend.slope.abs()), f64::max)
    };
    Interval {
        times: [from, to],
        wobble: has_wobble.then(|| body.wobble(mode, mean)),
        power,
        wobble_trend: wobbles.then(|| amplitude(rows)).flatten(),
        fastest: fastest(|row| row.energy).max(fastest(|row| row.momentum)),
    }
}
