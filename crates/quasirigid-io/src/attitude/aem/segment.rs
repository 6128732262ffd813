//! Metadata of a segment of an attitude ephemeris message, and what they make of a record.

use quasirigid_math::rotation::Turn;
use quasirigid_math::vec3::{add, cross, scale};

use super::super::error::{AttitudeProblem, Line};
use super::super::{AttitudeHistory, AttitudeRecord, TimeSystem};
use super::Version;
use crate::text_file::{finite, number};

/// Keywords of the metadata that are needed and say nothing about the numbers, or are not needed.
const UNUSED: [&str; 9] = [
    "OBJECT_ID",
    "CENTER_NAME",
    "START_TIME",
    "STOP_TIME",
    "USEABLE_START_TIME",
    "USEABLE_STOP_TIME",
    "INTERPOLATION_METHOD",
    "INTERPOLATION_DEGREE",
    "EULER_ROT_SEQ",
];
/// Beginnings of the names of frames that are fixed in a spacecraft. (504.0-B-1 annex A, SANA registry of spacecraft body frames)
const ON_BOARD: [&str; 17] = [
    "SC_BODY",
    "ACC",
    "ACTUATOR",
    "AST",
    "CSS",
    "DSS",
    "ESA",
    "GYRO",
    "IMU",
    "INSTRUMENT",
    "MTA",
    "RW",
    "SA_",
    "SENSOR",
    "STARTRACKER",
    "TAM",
    "BODY",
];

/// What the numbers behind the epoch are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Quaternion,
    Derivative,
    Rates,
}

/// A segment from its beginning on.
#[derive(Debug)]
pub struct Segment {
    version: Version,
    object: Option<String>,
    frames: [Option<String>; 2],
    time_system: Option<TimeSystem>,
    kind: Option<Kind>,
    /// Whether the quaternion leads from frame A to frame B.
    a_to_b: Option<bool>,
    scalar_first: Option<bool>,
    rate_frame: Option<String>,
    closed: bool,
}

impl Segment {
    pub fn new(version: Version) -> Self {
        let frames = [None, None];
        let (object, time_system, kind, rate_frame) = (None, None, None, None);
        let (a_to_b, scalar_first) = match version {
            Version::One => (None, None),
            Version::Two => (Some(true), Some(false)),
        };
        Self { version, object, frames, time_system, kind, a_to_b, scalar_first, rate_frame, closed: false }
    }

    /// Whether the metadata have ended.
    pub fn is_closed(&self) -> bool {
        self.closed
    }

    /// Takes a keyword of the metadata.
    pub fn set(&mut self, keyword: &str, value: &str) -> Result<(), AttitudeProblem> {
        let first = self.version == Version::One;
        let refused = |keyword, advice| AttitudeProblem::Value { keyword, found: value.into(), advice };
        match keyword {
            "OBJECT_NAME" => self.object = Some(value.to_owned()),
            "REF_FRAME_A" => self.frames[0] = Some(value.to_owned()),
            "REF_FRAME_B" => self.frames[1] = Some(value.to_owned()),
            "ATTITUDE_DIR" if first => {
                let known = [("A2B", true), ("B2A", false)];
                self.a_to_b =
                    Some(choice(known, value).ok_or_else(|| refused("ATTITUDE_DIR", "write A2B or B2A"))?);
            }
            "QUATERNION_TYPE" if first => {
                let known = [("FIRST", true), ("LAST", false)];
                let found = choice(known, value);
                self.scalar_first =
                    Some(found.ok_or_else(|| refused("QUATERNION_TYPE", "write FIRST or LAST"))?);
            }
            "TIME_SYSTEM" => {
                let advice = "epochs of a calendar are: UTC, TAI, TT, TDB, GPS, TCB, TCG or UT1";
                self.time_system =
                    Some(TimeSystem::named(value).ok_or_else(|| refused("TIME_SYSTEM", advice))?);
            }
            "ATTITUDE_TYPE" => {
                let known = [
                    ("QUATERNION", Kind::Quaternion),
                    ("QUATERNION/DERIVATIVE", Kind::Derivative),
                    ("QUATERNION/RATE", Kind::Rates),
                    ("QUATERNION/ANGVEL", Kind::Rates),
                ];
                let advice = "write quaternions: QUATERNION, QUATERNION/DERIVATIVE or QUATERNION/ANGVEL";
                self.kind = Some(choice(known, value).ok_or_else(|| refused("ATTITUDE_TYPE", advice))?);
            }
            "RATE_FRAME" if first => self.rate_frame = Some(value.to_owned()),
            "ANGVEL_FRAME" if !first => self.rate_frame = Some(value.to_owned()),
            _ if UNUSED.contains(&keyword) => {}
            _ => return Err(AttitudeProblem::Unexpected { found: keyword.into(), line: Line::Keyword }),
        }
        Ok(())
    }

    /// Ends the metadata, which must be whole.
    pub fn close(&mut self) -> Result<(), AttitudeProblem> {
        let missing = |keyword| AttitudeProblem::Missing { keyword };
        self.object.as_ref().ok_or(missing("OBJECT_NAME"))?;
        self.frames[0].as_ref().ok_or(missing("REF_FRAME_A"))?;
        self.frames[1].as_ref().ok_or(missing("REF_FRAME_B"))?;
        self.time_system.ok_or(missing("TIME_SYSTEM"))?;
        self.kind.ok_or(missing("ATTITUDE_TYPE"))?;
        self.a_to_b.ok_or(missing("ATTITUDE_DIR"))?;
        self.scalar_first.ok_or(missing("QUATERNION_TYPE"))?;
        if self.kind == Some(Kind::Rates) {
            let keyword = if self.version == Version::One { "RATE_FRAME" } else { "ANGVEL_FRAME" };
            let frame = self.rate_frame.as_ref().ok_or(missing(keyword))?;
            if self.rates_in_b().is_none() {
                let advice = "name one of the two frames of the segment";
                return Err(AttitudeProblem::Value { keyword, found: frame.as_str().into(), advice });
            }
            if self.a_to_b == Some(false) {
                let advice = "the standard does not say which frame turns at these rates; write A2B, or leave the rates out";
                return Err(AttitudeProblem::Value { keyword: "ATTITUDE_DIR", found: "B2A".into(), advice });
            }
        }
        self.closed = true;
        Ok(())
    }

    /// Refuses a segment that is about something else than those before.
    pub fn check_follows(&self, history: &AttitudeHistory) -> Result<(), AttitudeProblem> {
        let (object, frame) = self.names();
        if history.t.is_empty() {
            return Ok(());
        }
        let differs = |keyword| Err(AttitudeProblem::Differs { keyword });
        if !object.eq_ignore_ascii_case(&history.object) {
            return differs("OBJECT_NAME");
        }
        if !frame.eq_ignore_ascii_case(&history.frame) {
            return differs("REF_FRAME_A");
        }
        if history.time_system != self.time_system {
            return differs("TIME_SYSTEM");
        }
        if history.angular_velocity.is_empty() != (self.kind == Some(Kind::Quaternion)) {
            return differs("ATTITUDE_TYPE");
        }
        Ok(())
    }

    /// Time scale of the epochs.
    pub fn time_system(&self) -> TimeSystem {
        self.time_system.unwrap_or(TimeSystem::Utc)
    }

    /// Names of the object and of the reference axes.
    pub fn names(&self) -> (String, String) {
        let reference = if self.body_is_a() { &self.frames[1] } else { &self.frames[0] };
        (self.object.clone().unwrap_or_default(), reference.clone().unwrap_or_default())
    }

    /// The record of the words behind an epoch.
    pub fn record<'w>(
        &self,
        t: f64,
        words: impl Iterator<Item = &'w str>,
    ) -> Result<AttitudeRecord, AttitudeProblem> {
        let kind = self.kind.unwrap_or(Kind::Quaternion);
        let line = self.line(kind);
        let numbers: Vec<f64> = words
            .map(|word| number(word, line).and_then(|value| finite(value, word, line)))
            .collect::<Result<_, _>>()?;
        let (quaternion, rest) = match (kind, &numbers[..]) {
            (Kind::Quaternion, [a, b, c, d]) => ([*a, *b, *c, *d], &[][..]),
            (Kind::Rates, [a, b, c, d, rest @ ..]) if rest.len() == 3 => ([*a, *b, *c, *d], rest),
            (Kind::Derivative, [a, b, c, d, rest @ ..]) if rest.len() == 4 => ([*a, *b, *c, *d], rest),
            _ => return Err(AttitudeProblem::Values { found: numbers.len(), line }),
        };
        let turned = self.a_to_b.unwrap_or(true) == self.body_is_a();
        let ours = |four| if turned { conjugate(self.sorted(four)) } else { self.sorted(four) };
        let attitude = ours(quaternion);
        let angular_velocity = match *rest {
            [x, y, z] => Some(self.body_rates([x, y, z].map(f64::to_radians), attitude)),
            [a, b, c, d] => Some(angular_velocity_of(attitude, ours([a, b, c, d]))),
            _ => None,
        };
        Ok(AttitudeRecord { t, attitude, angular_velocity })
    }

    /// Angular velocity of the body against the reference axes, body axes, from that of frame B against frame A.
    fn body_rates(&self, rates: [f64; 3], attitude: [f64; 4]) -> [f64; 3] {
        let body_is_a = self.body_is_a();
        let sign = if body_is_a { -1.0 } else { 1.0 };
        let in_body = self.rates_in_b() == Some(!body_is_a);
        let omega = if in_body { rates } else { Turn::of(attitude).to_body(rates) };
        omega.map(|rate| sign * rate)
    }

    /// Whether the rates are in axes of frame B; none where they are in neither.
    fn rates_in_b(&self) -> Option<bool> {
        let named = self.rate_frame.as_deref()?;
        let is = |frame: usize, keyword: &str| {
            named.eq_ignore_ascii_case(keyword)
                || self.frames[frame].as_deref().is_some_and(|name| named.eq_ignore_ascii_case(name))
        };
        match (is(0, "REF_FRAME_A"), is(1, "REF_FRAME_B")) {
            (_, true) => Some(true),
            (true, false) => Some(false),
            (false, false) => None,
        }
    }

    /// Whether frame A is the body: where it alone has the name of a frame on board.
    fn body_is_a(&self) -> bool {
        let on_board = |name: &Option<String>| {
            let name = name.as_deref().unwrap_or_default().to_ascii_uppercase();
            ON_BOARD.iter().any(|beginning| name.starts_with(beginning))
        };
        on_board(&self.frames[0]) && !on_board(&self.frames[1])
    }

    /// The numbers of a quaternion, scalar first.
    fn sorted(&self, [a, b, c, d]: [f64; 4]) -> [f64; 4] {
        if self.scalar_first == Some(true) { [a, b, c, d] } else { [d, a, b, c] }
    }

    fn line(&self, kind: Kind) -> Line {
        let columns = match (kind, self.scalar_first == Some(true)) {
            (Kind::Quaternion, false) => "Q1 Q2 Q3 QC",
            (Kind::Quaternion, true) => "QC Q1 Q2 Q3",
            (Kind::Derivative, false) => "Q1 Q2 Q3 QC with the four derivatives",
            (Kind::Derivative, true) => "QC Q1 Q2 Q3 with the four derivatives",
            (Kind::Rates, false) => "Q1 Q2 Q3 QC with the three rates in deg/s",
            (Kind::Rates, true) => "QC Q1 Q2 Q3 with the three rates in deg/s",
        };
        Line::AemRecord { columns }
    }
}

/// Angular velocity in body axes at which an attitude has this rate, `2 q* ⊗ dq/dt`. (P3)
fn angular_velocity_of([s, v @ ..]: [f64; 4], [s_rate, v_rate @ ..]: [f64; 4]) -> [f64; 3] {
    scale(2.0, add(add(scale(s, v_rate), scale(-s_rate, v)), cross(v_rate, v)))
}

fn conjugate([s, x, y, z]: [f64; 4]) -> [f64; 4] {
    [s, -x, -y, -z]
}

fn choice<T: Copy, const N: usize>(known: [(&str, T); N], value: &str) -> Option<T> {
    // version 1.0 also has blanks in names of types
    let plain = value.replace(' ', "_");
    known.iter().find(|(name, _)| plain.eq_ignore_ascii_case(name)).map(|(_, meaning)| *meaning)
}
