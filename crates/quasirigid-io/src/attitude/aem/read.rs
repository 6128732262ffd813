//! Reader of attitude ephemeris messages: lines, header and segments.

use super::super::error::{AttitudeProblem, Fault, Line};
use super::super::{AttitudeHistory, Epoch, TimeSystem};
use super::Version;
use super::segment::Segment;
use crate::text_file::{Place, last_line, lines};

/// Keywords of the header, beside those of its version.
const HEADER: [&str; 5] = ["CREATION_DATE", "ORIGINATOR", "MESSAGE_ID", "CLASSIFICATION", "CCSDS_AEM_VERS"];

/// Reads a message, whose segments follow each other.
pub fn read(text: &str) -> Result<AttitudeHistory, Fault> {
    let mut message =
        Message { version: None, history: AttitudeHistory::default(), segment: None, in_data: false };
    for (number, line) in lines(text) {
        message.line(line).map_err(|problem| (Place::Line(number), problem))?;
    }
    let ends = |line| (Place::Line(last_line(text)), AttitudeProblem::Ends { line });
    match &message.segment {
        Some(_) => Err(ends(Line::Keyword)),
        None if message.history.t.is_empty() => Err(ends(Line::MetaStart)),
        None => Ok(message.history),
    }
}

/// A message up to a line.
struct Message {
    version: Option<Version>,
    history: AttitudeHistory,
    /// The segment begun.
    segment: Option<Segment>,
    in_data: bool,
}

impl Message {
    fn line(&mut self, line: &str) -> Result<(), AttitudeProblem> {
        if line == "COMMENT" || line.starts_with("COMMENT ") {
            return Ok(());
        }
        let Some(version) = self.version else {
            self.version = Some(version(line)?);
            return Ok(());
        };
        match (line, &mut self.segment, self.in_data) {
            ("META_START", None, _) => self.segment = Some(Segment::new(version)),
            ("META_STOP", Some(segment), false) => {
                segment.close()?;
                segment.check_follows(&self.history)?;
            }
            ("DATA_START", Some(segment), false) if segment.is_closed() => self.in_data = true,
            ("DATA_STOP", Some(_), true) => {
                self.segment = None;
                self.in_data = false;
            }
            (_, Some(segment), true) => record(&mut self.history, segment, line)?,
            (_, Some(segment), false) if !segment.is_closed() => {
                let (keyword, value) = pair(line)?;
                segment.set(keyword, value)?;
            }
            (_, None, _) if pair(line).is_ok_and(|(keyword, _)| HEADER.contains(&keyword)) => {}
            (_, segment, _) => {
                let line_kind = if segment.is_some() { Line::Keyword } else { Line::MetaStart };
                return Err(AttitudeProblem::Unexpected { found: line.into(), line: line_kind });
            }
        }
        Ok(())
    }
}

fn version(line: &str) -> Result<Version, AttitudeProblem> {
    let (keyword, value) = pair(line)?;
    match (keyword, value) {
        ("CCSDS_AEM_VERS", "1.0") => Ok(Version::One),
        ("CCSDS_AEM_VERS", "2.0") => Ok(Version::Two),
        ("CCSDS_AEM_VERS", other) => Err(AttitudeProblem::Value {
            keyword: "CCSDS_AEM_VERS",
            found: other.into(),
            advice: "the versions are 1.0 and 2.0",
        }),
        _ => Err(AttitudeProblem::Missing { keyword: "CCSDS_AEM_VERS" }),
    }
}

fn pair(line: &str) -> Result<(&str, &str), AttitudeProblem> {
    match line.split_once('=') {
        Some((keyword, value)) => Ok((keyword.trim(), value.trim())),
        None => Err(AttitudeProblem::Unexpected { found: line.into(), line: Line::Keyword }),
    }
}

/// Appends the record of a line; times count from the first record of the message.
fn record(history: &mut AttitudeHistory, segment: &Segment, line: &str) -> Result<(), AttitudeProblem> {
    let mut words = line.split_whitespace();
    let word = words.next().unwrap_or_default();
    let epoch: Epoch =
        word.parse().map_err(|problem| AttitudeProblem::Epoch { found: word.into(), problem })?;
    let start = *history.epoch.get_or_insert(epoch);
    let system = segment.time_system();
    history.time_system.get_or_insert(system);
    if let Some(leap) = TimeSystem::leap_between(system, start, epoch) {
        return Err(AttitudeProblem::LeapSecond { leap });
    }
    if history.object.is_empty() {
        (history.object, history.frame) = segment.names();
    }
    let record = segment.record(epoch.since(start), words)?;
    history.push(record)
}
