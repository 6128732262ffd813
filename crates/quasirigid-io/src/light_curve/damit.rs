//! Files `lc.txt` of DAMIT: the number of light curves; of each a line with its number of points and whether it is calibrated, then a line
//! for each point: light-time corrected Julian date, brightness, Sun and Earth as seen from the asteroid (au, ecliptic axes).

use std::fmt::Write;

use super::error::wrong;
use super::{Clock, LightCurveFile, LightCurveProblem, Sighting};
use crate::text_file::{self, Place, lines};
use crate::visible::Excerpt;

type Fault = text_file::Fault<LightCurveProblem>;

/// Whether a text begins with a number alone on its line.
pub(super) fn is_damit(bytes: &[u8]) -> bool {
    let first = bytes.split(|byte| *byte == b'\n').map(<[u8]>::trim_ascii).find(|line| !line.is_empty());
    first.is_some_and(|line| line.iter().all(u8::is_ascii_digit))
}

pub(super) fn read(bytes: &[u8]) -> Result<LightCurveFile, Fault> {
    let text = text_file::text::<LightCurveProblem>(bytes)?;
    let mut lines = lines(text);
    let last = text_file::last_line(text);
    let ended = |what: &str| {
        (Place::Line(last), LightCurveProblem::Line(format!("the file ends before {what}; was it cut off?")))
    };
    let (at, first) = lines.next().ok_or_else(|| ended("its first line"))?;
    let [count] = numbers::<1>(at, first)?;
    let mut sightings = Vec::new();
    for block in 0..whole(at, count)? {
        let (at, head) = lines.next().ok_or_else(|| ended("a light curve that was announced"))?;
        // a third number, where there is one, is not needed here
        let points = head.split_whitespace().next().unwrap_or_default();
        let [points] = numbers::<1>(at, points)?;
        for _ in 0..whole(at, points)? {
            let (at, line) = lines.next().ok_or_else(|| ended("a point that was announced"))?;
            let [time, brightness, a, b, c, d, e, f] = numbers::<8>(at, line)?;
            let (sun, observer) = ([a, b, c], [d, e, f]);
            if let Some(problem) = wrong(sun, observer, Some(brightness)) {
                return Err((Place::Line(at), LightCurveProblem::Line(problem)));
            }
            sightings.push(Sighting { time, sun, observer, brightness: Some(brightness), block });
        }
    }
    if let Some((at, _)) = lines.next() {
        let problem = "after the last light curve that was announced there is more; is the number in the first line right?";
        return Err((Place::Line(at), LightCurveProblem::Line(problem.to_owned())));
    }
    Ok(LightCurveFile { clock: Clock::JulianDate, sightings })
}

/// The numbers of a line, all finite.
fn numbers<const N: usize>(at: usize, line: &str) -> Result<[f64; N], Fault> {
    let refuse = |problem: String| (Place::Line(at), LightCurveProblem::Line(problem));
    let words: Vec<&str> = line.split_whitespace().collect();
    let number = |word: &&str| {
        let read = word.parse::<f64>().ok().filter(|number| number.is_finite());
        read.ok_or_else(|| refuse(format!("{:?} is not a finite number", Excerpt::from(*word))))
    };
    let found = words.iter().map(number).collect::<Result<Vec<f64>, Fault>>()?;
    <[f64; N]>::try_from(found).map_err(|found| {
        refuse(format!("{} numbers, and a line here has {N}: is this a file of DAMIT?", found.len()))
    })
}

fn whole(at: usize, count: f64) -> Result<usize, Fault> {
    if count >= 0.0 && count.fract() == 0.0 && count < 1e9 {
        return Ok(count as usize);
    }
    Err((Place::Line(at), LightCurveProblem::Line(format!("{count} is no number of light curves or points"))))
}

/// The text of a file of DAMIT, of sightings with brightness in blocks one after the other.
#[must_use]
pub fn damit(sightings: &[Sighting]) -> String {
    let blocks: Vec<&[Sighting]> = sightings.chunk_by(|a, b| a.block == b.block).collect();
    let mut text = format!("{}\n", blocks.len());
    for block in blocks {
        writeln!(text, "{} 0", block.len()).expect("a string takes any text");
        for Sighting { time, sun, observer, brightness, .. } in block {
            let [a, b, c] = sun;
            let [d, e, f] = observer;
            let value = brightness.unwrap_or(1.0);
            writeln!(text, "{time} {value} {a} {b} {c} {d} {e} {f}").expect("a string takes any text");
        }
    }
    text
}
