//! Epochs of attitude files: a date of the Gregorian calendar and a time of day, to the picosecond, without a time scale of their own.
//! Every day has 86 400 s. That is so in TAI, TT, TDB and GPS; in UTC between two leap seconds, which [`TimeSystem`] knows.

use std::fmt::{self, Display, Formatter};
use std::str::FromStr;

/// Picoseconds of a second and of a day.
const SECOND: u64 = 1_000_000_000_000;
const DAY: u64 = 86_400 * SECOND;
/// Last year that four digits write.
const LAST_YEAR: i64 = 9999;
/// Months as STK writes them.
const MONTHS: [&str; 12] =
    ["Jan", "Feb", "Mar", "Apr", "May", "Jun", "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"];

/// Instant of a calendar.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Epoch {
    /// Days since 1970-01-01.
    day: i64,
    /// Picoseconds of the day.
    time: u64,
}

/// A text that is no epoch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no epoch; write 2026-01-01T00:00:00, or in STK 1 Jan 2026 00:00:00.0, with a second below 60")]
pub struct NoEpoch;

impl Epoch {
    /// Noon of 2000-01-01, from which SPICE counts seconds of TDB.
    pub const J2000: Self = Self { day: 10_957, time: DAY / 2 };

    /// Midnight of 1970-01-01, from which Unix counts.
    pub(super) const UNIX: Self = Self { day: 0, time: 0 };

    /// So many seconds later, to the nearest picosecond; none outside the years 1 to 9999.
    #[must_use]
    pub fn after(self, t: f64) -> Option<Self> {
        let whole = t.floor();
        if !(whole.abs() < 1e12) {
            return None;
        }
        let part = ((t - whole) * SECOND as f64).round() as i128;
        let time = i128::from(self.time) + whole as i128 * i128::from(SECOND) + part;
        let day = self.day + time.div_euclid(i128::from(DAY)) as i64;
        let time = time.rem_euclid(i128::from(DAY)) as u64;
        let (year, ..) = date(day);
        (1..=LAST_YEAR).contains(&year).then_some(Self { day, time })
    }

    /// Seconds from another epoch to this one.
    #[must_use]
    pub fn since(self, other: Self) -> f64 {
        let between = i128::from(self.day - other.day) * i128::from(DAY) + i128::from(self.time)
            - i128::from(other.time);
        let second = i128::from(SECOND);
        between.div_euclid(second) as f64 + between.rem_euclid(second) as f64 / SECOND as f64
    }

    /// An epoch as STK writes it: `1 Jun 2002 12:00:00.000`.
    ///
    /// # Errors
    /// [`NoEpoch`].
    pub fn of_stk(text: &str) -> Result<Self, NoEpoch> {
        let words: Vec<&str> = text.split_whitespace().collect();
        let [day, month, year, time] = words[..] else { return Err(NoEpoch) };
        let month = MONTHS.iter().position(|name| name.eq_ignore_ascii_case(month)).ok_or(NoEpoch)? + 1;
        Self::of(digits(year)?, month as u64, digits(day)?, time_of(time)?)
    }

    /// The epoch as STK writes it.
    #[must_use]
    pub fn to_stk(self) -> String {
        let (year, month, day) = date(self.day);
        let name = MONTHS[(month - 1) as usize];
        format!("{day} {name} {year} {}", clock(self.time))
    }

    /// Year with the share of it that has passed.
    pub(crate) fn decimal_year(self) -> f64 {
        let (year, ..) = date(self.day);
        let [first, next] = [year, year + 1].map(|year| day_of(year, 1, 1));
        let passed = (self.day - first) as f64 + self.time as f64 / DAY as f64;
        year as f64 + passed / (next - first) as f64
    }

    /// Mean sidereal time at Greenwich (rad), from 0 to 2π, with the epoch as UT1: 280.46061837 degrees at noon of 2000-01-01, and
    /// 360.98564736629 a day.
    pub(crate) fn sidereal_angle(self) -> f64 {
        let whole = (self.day - Self::J2000.day) as f64;
        let part = self.time as f64 / DAY as f64 - 0.5;
        let degrees = 280.460_618_37 + 0.985_647_366_29 * whole + 360.985_647_366_29 * part;
        degrees.rem_euclid(360.0).to_radians()
    }

    fn of(year: u64, month: u64, day: u64, time: u64) -> Result<Self, NoEpoch> {
        let days = i64::try_from(year).ok().filter(|year| (1..=LAST_YEAR).contains(year));
        let number = day_of(days.ok_or(NoEpoch)?, month as i64, day as i64);
        let found = Self { day: number, time };
        if date(number) == (year as i64, month, day) { Ok(found) } else { Err(NoEpoch) }
    }

    fn of_ordinal(year: u64, ordinal: u64, time: u64) -> Result<Self, NoEpoch> {
        let first = Self::of(year, 1, 1, time)?;
        let found = Self { day: first.day + ordinal as i64 - 1, time };
        if date(found.day).0 == year as i64 && ordinal > 0 { Ok(found) } else { Err(NoEpoch) }
    }
}

impl FromStr for Epoch {
    type Err = NoEpoch;

    /// Reads ISO 8601 as CCSDS has it: a date by month or by day of the year, and a time; a date alone is its midnight.
    fn from_str(text: &str) -> Result<Self, NoEpoch> {
        let text = text.trim();
        let text = text.strip_suffix(['Z', 'z']).unwrap_or(text);
        let (date, time) = text.split_once(['T', 't']).map_or((text, Ok(0)), |(a, b)| (a, time_of(b)));
        let time = time?;
        let parts: Vec<&str> = date.split('-').collect();
        match parts[..] {
            [year, ordinal] if ordinal.len() == 3 => Self::of_ordinal(digits(year)?, digits(ordinal)?, time),
            [year, month, day] => Self::of(digits(year)?, digits(month)?, digits(day)?, time),
            _ => Err(NoEpoch),
        }
    }
}

impl Display for Epoch {
    /// ISO 8601, with the fewest digits of the second, three or a multiple, that say it to the picosecond.
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let (year, month, day) = date(self.day);
        write!(f, "{year:04}-{month:02}-{day:02}T{}", clock(self.time))
    }
}

/// Time scale of epochs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TimeSystem {
    /// Coordinated universal time, of which some days have a leap second.
    #[default]
    Utc,
    /// A scale of days of 86 400 s, by its name.
    Uniform(&'static str),
}

impl TimeSystem {
    /// Dynamical barycentric time, in which SPICE counts.
    pub const TDB: Self = Self::Uniform("TDB");
    /// The others that CCSDS names and that have a calendar.
    const OTHERS: [&'static str; 7] = ["TAI", "TT", "TDB", "GPS", "TCB", "TCG", "UT1"];

    /// The scale of a name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        if name.eq_ignore_ascii_case("UTC") {
            return Some(Self::Utc);
        }
        Self::OTHERS.iter().find(|other| name.eq_ignore_ascii_case(other)).map(|other| Self::Uniform(other))
    }

    /// The name in files.
    #[must_use]
    pub fn label(self) -> &'static str {
        match self {
            Self::Utc => "UTC",
            Self::Uniform(name) => name,
        }
    }

    /// The epoch after the first leap second between two epochs, where differences of the calendar are a second short of elapsed time.
    #[must_use]
    pub fn leap_between(self, from: Epoch, to: Epoch) -> Option<Epoch> {
        let leaps = LEAPS.iter().map(|(year, month)| Epoch { day: day_of(*year, *month, 1), time: 0 });
        leaps.filter(|_| self == Self::Utc).find(|leap| from < *leap && *leap <= to)
    }
}

/// Months on whose first day a leap second had just passed, by the Bulletins C of the IERS up to number 70; later ones are not known.
const LEAPS: [(i64, i64); 27] = [
    (1972, 7),
    (1973, 1),
    (1974, 1),
    (1975, 1),
    (1976, 1),
    (1977, 1),
    (1978, 1),
    (1979, 1),
    (1980, 1),
    (1981, 7),
    (1982, 7),
    (1983, 7),
    (1985, 7),
    (1988, 1),
    (1990, 1),
    (1991, 1),
    (1992, 7),
    (1993, 7),
    (1994, 7),
    (1996, 1),
    (1997, 7),
    (1999, 1),
    (2006, 1),
    (2009, 1),
    (2012, 7),
    (2015, 7),
    (2017, 1),
];

/// Year, month and day of a day since 1970-01-01: years of 400 repeat, counted from March, so that a leap day is the last.
fn date(day: i64) -> (i64, u64, u64) {
    let shifted = day + 719_468;
    let (era, of_era) = (shifted.div_euclid(146_097), shifted.rem_euclid(146_097));
    let year_of_era = (of_era - of_era / 1460 + of_era / 36_524 - of_era / 146_096) / 365;
    let of_year = of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let from_march = (5 * of_year + 2) / 153;
    let day = of_year - (153 * from_march + 2) / 5 + 1;
    let month = if from_march < 10 { from_march + 3 } else { from_march - 9 };
    (year_of_era + era * 400 + i64::from(month <= 2), month as u64, day as u64)
}

/// Days from 1970-01-01 to a date, whose month and day may be out of range by no more than two digits are.
fn day_of(year: i64, month: i64, day: i64) -> i64 {
    let year = year - i64::from(month <= 2);
    let (era, year_of_era) = (year.div_euclid(400), year.rem_euclid(400));
    let from_march = if month > 2 { month - 3 } else { month + 9 };
    let of_year = (153 * from_march + 2) / 5 + day - 1;
    era * 146_097 + year_of_era * 365 + year_of_era / 4 - year_of_era / 100 + of_year - 719_468
}

/// A time of day, `hh:mm:ss` with any digits behind the point, of which twelve count.
fn time_of(text: &str) -> Result<u64, NoEpoch> {
    let parts: Vec<&str> = text.split(':').collect();
    let [hours, minutes, seconds] = parts[..] else { return Err(NoEpoch) };
    let (seconds, fraction) = seconds.split_once('.').unwrap_or((seconds, ""));
    if fraction.bytes().any(|digit| !digit.is_ascii_digit()) {
        return Err(NoEpoch);
    }
    let fraction = format!("{:0<12.12}", fraction);
    let (hours, minutes, seconds) = (digits(hours)?, digits(minutes)?, digits(seconds)?);
    if hours > 23 || minutes > 59 || seconds > 59 {
        return Err(NoEpoch);
    }
    Ok((3600 * hours + 60 * minutes + seconds) * SECOND + digits(&fraction)?)
}

fn digits(text: &str) -> Result<u64, NoEpoch> {
    let plain = !text.is_empty() && text.len() <= 12 && text.bytes().all(|byte| byte.is_ascii_digit());
    text.parse().ok().filter(|_| plain).ok_or(NoEpoch)
}

fn clock(time: u64) -> String {
    let (seconds, fraction) = (time / SECOND, format!("{:012}", time % SECOND));
    let kept = fraction.trim_end_matches('0').len().next_multiple_of(3).max(3);
    let (hours, minutes) = (seconds / 3600, seconds / 60 % 60);
    format!("{hours:02}:{minutes:02}:{:02}.{}", seconds % 60, &fraction[..kept])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_and_days_are_those_of_the_calendar() {
        // days by `date -u -d DATE +%s` of GNU coreutils 9.4, over 86 400
        for (text, day) in
            [("1970-01-01", 0), ("2000-02-29", 11_016), ("1900-03-01", -25_508), ("2026-11-28", 20_785)]
        {
            let epoch: Epoch = text.parse().unwrap();
            assert_eq!(epoch.day, day, "{text}");
            assert_eq!(epoch.to_string(), format!("{text}T00:00:00.000"));
        }
        let ordinal: Epoch = "2006-090T05:00:00.071Z".parse().unwrap();
        assert_eq!(ordinal.to_string(), "2006-03-31T05:00:00.071");
        assert_eq!(Epoch::J2000.to_string(), "2000-01-01T12:00:00.000");
    }

    #[test]
    fn what_no_calendar_has_is_refused() {
        for text in [
            "",
            "2026",
            "2026-13-01",
            "2026-02-29",
            "2026-366",
            "2026-000",
            "2026-01-01T24:00:00",
            "2026-01-01T10:00",
            "2016-12-31T23:59:60",
            "2026-01-01T00:00:00.1e3",
            "2026-01-01T00:00:-1",
            "0000-01-01",
            "1 Jan 2026 00:00:00",
            "é",
        ] {
            assert_eq!(text.parse::<Epoch>(), Err(NoEpoch), "{text}");
        }
        assert!(Epoch::of_stk("31 Feb 2026 00:00:00.0").is_err());
        assert!(Epoch::of_stk("1 Thermidor 2026 00:00:00.0").is_err());
        assert_eq!(Epoch::J2000.after(f64::NAN), None);
        assert_eq!(Epoch::J2000.after(3e11), None);
    }

    #[test]
    fn times_are_kept_to_the_picosecond() {
        let epoch = Epoch::of_stk("31 Dec 2027 23:59:59.9").unwrap();
        assert_eq!(epoch.after(0.2).unwrap().to_string(), "2028-01-01T00:00:00.100");
        assert_eq!(epoch.after(-0.9).unwrap().to_stk(), "31 Dec 2027 23:59:59.000");
        for t in [0.1, 100.1, 1e-12, 60.0 / 7.0, 86_400.5, -3.25] {
            let later = epoch.after(t).unwrap();
            assert!((later.since(epoch) - t).abs() <= 0.51e-12, "{t}");
            assert_eq!(later.to_string().parse(), Ok(later));
        }
    }

    #[test]
    fn leap_seconds_are_those_between_two_epochs_of_utc() {
        let [before, last, next] =
            ["2016-12-31", "2016-12-31T23:59:59", "2017-01-01"].map(|text| text.parse().unwrap());
        assert_eq!(TimeSystem::Utc.leap_between(before, next), Some(next));
        assert_eq!(TimeSystem::Utc.leap_between(before, last), None);
        assert_eq!(TimeSystem::TDB.leap_between(before, next), None);
        let all = LEAPS.map(|(year, month)| day_of(year, month, 1));
        assert!(all.is_sorted());
    }

    /// The sidereal time of the Astronomical Almanac, 1987-04-10 at 0 h: 13 h 10 min 46.3668 s, and at 19 h 21 min 8 34 57.0896 (J. Meeus,
    /// Astronomical Algorithms, chapter 12).
    #[test]
    fn sidereal_time_is_that_of_the_almanac() {
        let hours = |text: &str| text.parse::<Epoch>().unwrap().sidereal_angle().to_degrees() / 15.0;
        // the linear law leaves out terms of a few milliseconds
        assert!((hours("1987-04-10T00:00:00") - (13.0 + 10.0 / 60.0 + 46.3668 / 3600.0)).abs() < 1e-5);
        assert!((hours("1987-04-10T19:21:00") - (8.0 + 34.0 / 60.0 + 57.0896 / 3600.0)).abs() < 1e-5);
        let year = |text: &str| text.parse::<Epoch>().unwrap().decimal_year();
        assert_eq!([year("2024-01-01"), year("2024-07-02"), year("1900-01-01")], [2024.0, 2024.5, 1900.0]);
    }
}
