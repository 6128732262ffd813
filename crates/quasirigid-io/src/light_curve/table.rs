//! Tables of light curves in text.

use std::collections::HashMap;
use std::path::Path;

use super::error::wrong;
use super::{Clock, LightCurveFile, LightCurveProblem, Sighting};
use crate::table_file::{BadLine, BodyTable, Unnumbered, bracketed_name, read_numbers};
use crate::text_file::{self, Place};
use crate::units::number_in;
use crate::visible::Excerpt;

/// Columns of places, of the Sun and of the observer.
const PLACES: [&str; 6] = ["sun_x", "sun_y", "sun_z", "observer_x", "observer_y", "observer_z"];
/// Columns of times.
const TIMES: [&str; 2] = ["t", "jd"];
/// Magnitudes of a factor of ten.
const POGSON: f64 = 2.5;

type Fault = text_file::Fault<LightCurveProblem>;

/// A column: its name, and its unit.
type Title = (String, Option<String>);

pub(super) fn read(file: &Path, bytes: &[u8]) -> Result<LightCurveFile, Fault> {
    if bytes.trim_ascii().is_empty() {
        return Err((Place::File, LightCurveProblem::Empty));
    }
    let mut titles: Vec<Title> = Vec::new();
    let read = read_numbers(file, bytes, |table: &BodyTable| {
        titles = (0..table.names.len()).map(|index| title(table, index)).collect();
        Ok::<_, std::convert::Infallible>((0..table.names.len()).collect())
    });
    let (columns, _) = read.map_err(|error| match error {
        Unnumbered::Table(error) => (Place::File, LightCurveProblem::Table(error)),
        Unnumbered::Unwanted(never) => match never {},
        Unnumbered::Line(BadLine { line, column, found }) => {
            let name = column.and_then(|at| titles.get(at)).map(|(name, _)| name);
            let found = Excerpt::from(found.as_str());
            let told = name.map_or_else(
                || format!("{found}; was the file cut off?"),
                |name| format!("{name}: {found:?} is not a finite number"),
            );
            (Place::Line(line), LightCurveProblem::Line(told))
        }
    })?;
    let columns: Vec<Vec<f64>> = columns.into_iter().map(|column| column.values).collect();
    sightings(&titles, &columns)
}

fn title(table: &BodyTable, index: usize) -> Title {
    let unit = table.units.get(index).and_then(Clone::clone).filter(|unit| !unit.is_empty());
    let name = table.names[index].trim();
    (bracketed_name(name).unwrap_or(name).to_owned(), unit)
}

fn sightings(titles: &[Title], columns: &[Vec<f64>]) -> Result<LightCurveFile, Fault> {
    let refuse = |problem: String| (Place::File, LightCurveProblem::Columns(problem));
    let place = |name: &str| titles.iter().position(|(other, _)| other == name);
    let missing = |name: &str| {
        let there: Vec<&str> = titles.iter().map(|(name, _)| name.as_str()).collect();
        refuse(format!("no column is {name:?}; there are {}", there.join(", ")))
    };
    let (clock, times) = match TIMES.map(place) {
        [Some(_), Some(_)] => {
            return Err(refuse("the table has two clocks, t and jd; leave one out".to_owned()));
        }
        [Some(t), None] => (Clock::Seconds, t),
        [None, Some(jd)] => (Clock::JulianDate, jd),
        [None, None] => {
            return Err(refuse("no column is the time: `t` in seconds from the start, or `jd`".to_owned()));
        }
    };
    let of_time = if clock == Clock::Seconds { "s" } else { "d" };
    let seconds = factor(&titles[times], of_time).map_err(refuse)?;
    let mut places = Vec::new();
    for name in PLACES {
        let at = place(name).ok_or_else(|| missing(name))?;
        places.push((at, factor(&titles[at], "au").map_err(refuse)?));
    }
    let (brightness, magnitude, blocks) = (place("brightness"), place("magnitude"), place("block"));
    if brightness.is_some() && magnitude.is_some() {
        return Err(refuse("the table has both brightness and magnitude; leave one out".to_owned()));
    }
    let mut found = Vec::new();
    let mut labels: HashMap<u64, usize> = HashMap::new();
    for row in 0..columns[times].len() {
        let entry = |index: usize| places[index].1 * columns[places[index].0][row];
        let (sun, observer) = ([0, 1, 2].map(entry), [3, 4, 5].map(entry));
        let of_magnitude = magnitude.map(|at| 10f64.powf(-columns[at][row] / POGSON));
        let brightness = brightness.map(|at| columns[at][row]).or(of_magnitude);
        if let Some(problem) = wrong(sun, observer, brightness) {
            return Err((Place::File, LightCurveProblem::Row { row: row + 1, problem }));
        }
        let time = seconds * columns[times][row] + 0.0; // no negative zero
        if !time.is_finite() {
            let problem = "the time is beyond the range of numbers".to_owned();
            return Err((Place::File, LightCurveProblem::Row { row: row + 1, problem }));
        }
        let label = blocks.map_or(0.0, |at| columns[at][row]);
        let next = labels.len();
        let block = *labels.entry(label.to_bits()).or_insert(next);
        found.push(Sighting { time, sun, observer, brightness, block });
    }
    Ok(LightCurveFile { clock, sightings: found })
}

/// Length of the unit of a column in the one that is meant without.
fn factor((name, unit): &Title, own: &str) -> Result<f64, String> {
    let Some(unit) = unit else { return Ok(1.0) };
    number_in(&format!("1 {unit}"), own)
        .ok_or_else(|| format!("{:?} is no unit of {name}; give it in {own}", Excerpt::from(unit.as_str())))
}
