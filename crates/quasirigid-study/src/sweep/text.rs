//! Summary of a study for a terminal of 80 columns: the verdict first, then percentiles, correlations and reasons.

use std::fmt::{self, Write};

use quasirigid_io::record::{CorrelationRecord, QuantityRecord, SweepRecord};
use quasirigid_io::visible::one_line;

use crate::layout::paragraph;
use crate::words::significant;

/// Correlations that are listed for each quantity.
const CORRELATIONS: usize = 5;
/// Reasons and values that are listed.
const LISTED: usize = 10;

/// Summary in words.
#[must_use]
pub fn text(record: &SweepRecord) -> String {
    let mut text = String::new();
    write(&mut text, record).expect("a string takes any text");
    text
}

fn write(out: &mut String, record: &SweepRecord) -> fmt::Result {
    let count = |status: &str| record.status.get(status).copied().unwrap_or(0);
    let answered = count("answered");
    let name = one_line(&record.name);
    let mut title = if answered == record.rows {
        format!("{name}: all {} rows answered.", record.rows)
    } else {
        format!("{name}: {answered} of {} rows answered", record.rows)
    };
    if answered != record.rows {
        let rest = ["refused", "invalid", "failed"].map(|status| (count(status), status));
        for (count, status) in rest.into_iter().filter(|(count, _)| *count > 0) {
            write!(title, ", {count} {status}")?;
        }
        title.push('.');
    }
    writeln!(out, "{}", paragraph(&title, "", "  "))?;
    for note in &record.notes {
        writeln!(out, "{}", paragraph(&format!("note: {}", one_line(note)), "  ", "    "))?;
    }
    for reason in record.reasons.iter().take(LISTED) {
        let times =
            if reason.count == 1 { "row".to_owned() } else { format!("{} rows, the first", reason.count) };
        let line = format!("{}, {times} {}: {}", reason.status, reason.first_row, reason.example);
        writeln!(out, "{}", paragraph(&line, "  ", "    "))?;
    }
    if record.reasons.len() > LISTED {
        writeln!(out, "  and {} more reasons, in summary.json", record.reasons.len() - LISTED)?;
    }
    for quantity in &record.quantities {
        let unit = if quantity.unit.is_empty() { String::new() } else { format!(" ({})", quantity.unit) };
        writeln!(out, "\n  {}{unit}", one_line(&quantity.name))?;
        statistics(out, quantity)?;
        let strongest = record.correlations.iter().filter(|each| each.quantity == quantity.name);
        correlations(out, &strongest.take(CORRELATIONS).collect::<Vec<_>>())?;
    }
    Ok(())
}

fn statistics(out: &mut String, quantity: &QuantityRecord) -> fmt::Result {
    let QuantityRecord { count, nulls, infinite, percentiles, mean, min, max, counts, .. } = quantity;
    let number = |value: f64| significant(value, 5);
    if quantity.kind != "number" {
        let mut listed: Vec<_> = counts.iter().collect();
        listed.sort_by_key(|(_, count)| std::cmp::Reverse(**count));
        let listed = listed.iter().take(LISTED).map(|(text, count)| format!("{text}: {count}"));
        writeln!(out, "{}", paragraph(&listed.collect::<Vec<_>>().join(", "), "    ", "    "))?;
    } else if let (Some(min), Some(max)) = (min, max) {
        for percentile in percentiles {
            writeln!(out, "    {:>6} %  {:>14}", percentile.percent, number(percentile.value))?;
        }
        let of = if *infinite > 0 { " of the finite values" } else { "" };
        match mean {
            Some(mean) => {
                writeln!(out, "    mean {}, from {} to {}{of}", number(*mean), number(*min), number(*max))?
            }
            // their signs tell decay from growth, which no mean does
            None => {
                let range = format!("from {} to {}{of}", number(*min), number(*max));
                writeln!(out, "    {range}; in the order of rates: decay first, growth (< 0) last")?;
            }
        }
    }
    if *infinite > 0 {
        writeln!(out, "    {infinite} of {count} values are infinite: the end is never reached")?;
    }
    if *nulls > 0 {
        writeln!(out, "    {nulls} rows have no value")?;
    }
    Ok(())
}

fn correlations(out: &mut String, records: &[&CorrelationRecord]) -> fmt::Result {
    let known: Vec<String> =
        records.iter().filter_map(|record| Some(format!("{} {:+.2}", record.input, record.rho?))).collect();
    if known.is_empty() {
        return Ok(());
    }
    writeln!(out, "{}", paragraph(&format!("rank correlation: {}", known.join(", ")), "    ", "      "))
}
