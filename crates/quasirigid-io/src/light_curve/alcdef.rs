//! Files of ALCDEF, the format of the data base of asteroid light curves: metadata, then date and magnitude of each point.

use std::fmt::Write;

use super::Sighting;
use crate::visible::one_line;

/// The text of a file of ALCDEF with a session for each block, of Julian dates and magnitudes; `name` is that of the object, `phase` the phase
/// angle (degrees) in the middle of each block. Magnitudes are in V, or differ from them by a constant.
#[must_use]
pub fn alcdef(
    name: &str,
    sightings: &[Sighting],
    (magnitudes, differ): (&[f64], bool),
    phase: impl Fn(&Sighting) -> f64,
) -> String {
    let mut text = String::new();
    let mut at = 0;
    for block in sightings.chunk_by(|a, b| a.block == b.block) {
        let middle = &block[block.len() / 2];
        let rows = block.iter().zip(&magnitudes[at..]);
        let told = write!(
            text,
            "STARTMETADATA\nREVISEDDATA=FALSE\nOBJECTNAME={}\nSESSIONDATE={}\nDELIMITER=PIPE\nFILTER=V\nMAGBAND=V\nDIFFERMAGS={}\n\
             LTCAPP=AVERAGE\nLTCTYPE=NONE\nREDUCEDMAGS=NONE\nUCORMAG=0\nPHASE=+{:.2}\nCOMMENT=computed by quasirigid, light-time corrected\nENDMETADATA\n",
            one_line(name),
            date(middle.time),
            if differ { "TRUE" } else { "FALSE" },
            phase(middle),
        );
        told.expect("a string takes any text");
        for (sighting, magnitude) in rows {
            writeln!(text, "DATA={:.6}|{magnitude:+.4}", sighting.time).expect("a string takes any text");
        }
        text.push_str("ENDDATA\n");
        at += block.len();
    }
    text
}

/// Day of the Gregorian calendar of a Julian date, by the days since 1 March of the year 0.
fn date(julian: f64) -> String {
    let day = (julian + 0.5).floor() as i64 - 1_721_120;
    let (era, of_era) = (day.div_euclid(146_097), day.rem_euclid(146_097));
    let year = (of_era - of_era / 1_460 + of_era / 36_524 - of_era / 146_096) / 365;
    let of_year = of_era - (365 * year + year / 4 - year / 100);
    let month = (5 * of_year + 2) / 153;
    let of_month = of_year - (153 * month + 2) / 5 + 1;
    let (month, later) = if month < 10 { (month + 3, 0) } else { (month - 9, 1) };
    format!("{:04}-{month:02}-{of_month:02}", year + 400 * era + later)
}

#[cfg(test)]
mod tests {
    use super::date;

    /// J2000 and the start of the modified Julian dates; a leap day.
    #[test]
    fn days_of_the_calendar_are_known_ones() {
        assert_eq!(date(2_451_545.0), "2000-01-01");
        assert_eq!(date(2_400_000.5), "1858-11-17");
        assert_eq!(date(2_451_603.6), "2000-02-29");
        assert_eq!(date(2_462_240.4), "2029-04-13");
    }
}
