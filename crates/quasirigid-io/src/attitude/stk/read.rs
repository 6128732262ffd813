//! Reader of attitude files of STK.

use super::super::error::{AttitudeProblem, Fault, Line};
use super::super::{AttitudeHistory, AttitudeRecord, Epoch, TimeSystem};
use crate::text_file::{Place, finite, last_line, lines, number};

/// Name of the block of attitudes.
const ATTITUDE: &str = "Attitude";

/// What the numbers behind the time are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    ScalarLast,
    ScalarFirst,
    Rates,
}

const KINDS: [(&str, Kind); 3] = [
    ("AttitudeTimeQuaternions", Kind::ScalarLast),
    ("AttitudeTimeQuatScalarFirst", Kind::ScalarFirst),
    ("AttitudeTimeQuatAngVels", Kind::Rates),
];

impl Kind {
    fn line(self) -> Line {
        let columns = match self {
            Self::ScalarLast => "q1 q2 q3 q4, scalar last",
            Self::ScalarFirst => "q4 q1 q2 q3, scalar first",
            Self::Rates => "q1 q2 q3 q4, scalar last, with three rates in deg/s",
        };
        Line::StkRecord { columns }
    }
}

/// Reads a file; keywords that say nothing about the numbers are passed over, and so are other blocks than that of the attitudes.
pub fn read(text: &str) -> Result<AttitudeHistory, Fault> {
    let mut file = AttitudeFile::default();
    let mut all = lines(text).filter(|(_, line)| !line.starts_with('#')).skip(1);
    while let Some((number, line)) = all.next() {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words[..] {
            [begin, block] if is(begin, "BEGIN") && !is(block, ATTITUDE) => {
                let end = all.find(|(_, line)| {
                    let mut words = line.split_whitespace();
                    words.next().is_some_and(|word| is(word, "END"))
                        && words.next().is_some_and(|word| is(word, block))
                });
                if end.is_none() {
                    return Err((
                        Place::Line(last_line(text)),
                        AttitudeProblem::Ends { line: Line::StkKeyword },
                    ));
                }
            }
            [end, block] if is(end, "END") && is(block, ATTITUDE) => {
                return file.ended().map_err(|p| (Place::File, p));
            }
            _ => file.line(line, &words).map_err(|problem| (Place::Line(number), problem))?,
        }
    }
    Err((Place::Line(last_line(text)), AttitudeProblem::Ends { line: Line::StkKeyword }))
}

fn is(word: &str, keyword: &str) -> bool {
    word.eq_ignore_ascii_case(keyword)
}

/// A file up to a line.
#[derive(Default)]
struct AttitudeFile {
    history: AttitudeHistory,
    announced: Option<usize>,
    kind: Option<Kind>,
}

impl AttitudeFile {
    fn line(&mut self, line: &str, words: &[&str]) -> Result<(), AttitudeProblem> {
        if let Some(kind) = self.kind {
            return self.record(kind, words);
        }
        let (keyword, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        let value = rest.trim();
        let refused = |keyword, advice| Err(AttitudeProblem::Value { keyword, found: value.into(), advice });
        if let Some((_, kind)) = KINDS.iter().find(|(name, _)| is(keyword, name)) {
            self.kind = Some(*kind);
        } else if keyword.to_ascii_lowercase().starts_with("attitudetime") {
            let advice = "write AttitudeTimeQuaternions or AttitudeTimeQuatAngVels";
            return Err(AttitudeProblem::Value { keyword: "the format", found: keyword.into(), advice });
        } else if is(keyword, "NumberOfAttitudePoints") {
            let Ok(count) = value.parse() else {
                return refused("NumberOfAttitudePoints", "write their number");
            };
            self.announced = Some(count);
        } else if is(keyword, "ScenarioEpoch") {
            let epoch = Epoch::of_stk(value);
            self.history.epoch =
                Some(epoch.map_err(|problem| AttitudeProblem::Epoch { found: value.into(), problem })?);
            self.history.time_system = Some(TimeSystem::Utc);
        } else if is(keyword, "CoordinateAxes") {
            self.history.frame = value.to_owned();
        } else if is(keyword, "TimeFormat") && !is(value, "EpSec") {
            return refused("TimeFormat", "write the times as seconds since ScenarioEpoch, EpSec");
        } else if !keyword.starts_with(|letter: char| letter.is_ascii_alphabetic()) {
            return Err(AttitudeProblem::Unexpected { found: line.into(), line: Line::StkKeyword });
        }
        Ok(())
    }

    fn record(&mut self, kind: Kind, words: &[&str]) -> Result<(), AttitudeProblem> {
        let line = kind.line();
        let numbers: Vec<f64> = words
            .iter()
            .map(|word| number(word, line).and_then(|value| finite(value, word, line)))
            .collect::<Result<_, _>>()?;
        let (t, attitude, angular_velocity) = match (kind, numbers[..].first_chunk()) {
            (Kind::ScalarFirst, Some([t, w, x, y, z])) if numbers.len() == 5 => (*t, [*w, *x, *y, *z], None),
            (Kind::ScalarLast, Some([t, x, y, z, w])) if numbers.len() == 5 => (*t, [*w, *x, *y, *z], None),
            (Kind::Rates, Some([t, x, y, z, w])) if numbers.len() == 8 => {
                let rates = [5, 6, 7].map(|place| f64::to_radians(numbers[place]));
                (*t, [*w, *x, *y, *z], Some(rates))
            }
            _ => return Err(AttitudeProblem::Values { found: numbers.len(), line }),
        };
        self.history.push(AttitudeRecord { t, attitude, angular_velocity })
    }

    fn ended(self) -> Result<AttitudeHistory, AttitudeProblem> {
        let found = self.history.t.len();
        match self.announced {
            Some(announced) if announced != found => Err(AttitudeProblem::Count { found, announced }),
            _ => Ok(self.history),
        }
    }
}
