use quasirigid_io::record::{HistoryRecord, ModeRecord, RunRecord, SteadySpinRecord, place_of_spin};

use super::{Compared, kind};
use crate::columns::{column, ends, main_history};
use crate::number::{digits, duration, percent, short};
use crate::sections::overview::answered;

/// A quantity of every run, in words.
pub struct Row {
    /// Name of the quantity.
    pub name: String,
    /// Its value in each run.
    pub values: Vec<String>,
}

impl Row {
    /// Whether the runs have different values.
    pub fn differs(&self) -> bool {
        self.values.iter().any(|value| *value != self.values[0])
    }
}

/// Value of a quantity that a record lacks.
const NONE: &str = "–";
/// Value of a quantity of equations that do not hold.
const FALSE: &str = "does not hold";

type Value = fn(&RunRecord) -> Option<String>;

/// Quantities of the body and of the settings.
const GIVEN: [(&str, Value); 10] = [
    ("Body", |record| Some(record.model.name.clone())),
    ("Model file", |record| Some(record.model.file.clone())),
    ("SHA-256 of the model", |record| record.model.sha256.get(..12).map(str::to_owned)),
    ("Version", |record| Some(record.version.clone())),
    ("Mass [kg]", |record| Some(digits(record.body.mass, 6))),
    ("Principal moments [kg m²]", |record| {
        Some(record.body.principal_moments.map(|moment| digits(moment, 5)).join(", "))
    }),
    ("Internal coordinates", |record| Some(record.body.coordinates.len().to_string())),
    ("Order of the equations", |record| Some(record.reduction.order.to_string())),
    ("System followed", |record| Some(main_history(record)?.system.clone())),
    ("Tolerance", |record| Some(short(main_history(record)?.tolerance))),
];

/// Result of the reduced equations alone.
const REDUCED: (&str, Value) =
    ("Power of the reduced equations at the start [W]", |record| Some(digits(record.reduction.power, 4)));

/// Results of the histories, which hold as far as their equations.
const FOLLOWED: [(&str, Value); 5] = [
    ("Duration", |record| {
        let (first, last) = ends(column(&main_history(record)?.columns, "t")?.values.iter().copied())?;
        Some(duration(last - first))
    }),
    ("End of the history", |record| Some(main_history(record)?.status.clone())),
    ("Revolutions", |record| Some(digits(main_history(record)?.revolutions, 5))),
    ("Energy dissipated [J]", |record| Some(digits(main_history(record)?.dissipated, 4))),
    ("Energy drift [J]", |record| Some(digits(main_history(record)?.energy_drift, 2))),
];

/// Results with verdicts of their own: of the modes of the spinning body its stability.
const STEADY: (&str, Value) = ("Steady spin next to the start", |record| {
    let spin = steady(record)?;
    let grows = |time: f64| time < 0.0;
    let words = match spin.stable {
        true => "stable",
        false
            if spin.slowest.is_some()
                && !spin.modes.iter().filter_map(|mode| mode.time_constant).any(grows) =>
        {
            "stability not known"
        }
        false => "unstable",
    };
    Some(format!("{words}, about {}", place_of_spin(&spin.axis)))
});

/// Time constant of the nutation.
fn time_constant(record: &RunRecord) -> Option<String> {
    Some(match mode(record)?.time_constant {
        Some(time) if time < 0.0 => format!("grows, {}", duration(-time)),
        Some(time) => duration(time),
        None => "no decay".to_owned(),
    })
}

/// Frequency of the nutation.
fn frequency(record: &RunRecord) -> Option<String> {
    Some(digits(mode(record)?.frequency, 5))
}

/// Results with verdicts of their own: evolution, verification.
const JUDGED: [(&str, Value); 4] = [
    ("Over many revolutions", |record| {
        Some(match (answered(record), &record.evolution) {
            (Some(evolution), _) => evolution.status.clone(),
            (None, Some(_)) => "no answer".to_owned(),
            (None, None) => return None,
        })
    }),
    ("Time of the evolution", |record| Some(duration(answered(record)?.time))),
    ("Good to", |record| Some(percent(answered(record)?.time_error?))),
    ("Verification", |record| {
        let reached = record.verification.as_ref()?.reached;
        Some(if reached { "every order reached" } else { "not every order reached" }.to_owned())
    }),
];

/// The quantities of the runs that one of them has.
pub fn of(runs: &[Compared<'_>]) -> Vec<Row> {
    let told = |holds: fn(&Compared<'_>) -> bool| {
        move |(name, value): (String, Value)| {
            let text = |run: &Compared<'_>| match value(run.record) {
                Some(_) if !holds(run) => FALSE.to_owned(),
                found => found.filter(|text| !text.is_empty()).unwrap_or_else(|| NONE.to_owned()),
            };
            Row { name, values: runs.iter().map(text).collect() }
        }
    };
    let own = |rows: &[(&str, Value)]| -> Vec<(String, Value)> {
        rows.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect()
    };
    let kind = kind(runs);
    let angles: (_, Value) =
        (format!("{}, start → end", kind.title()), |record| nutation(main_history(record)?));
    let modes: [(_, Value); 2] = [
        (format!("Time constant of the {}", kind.nutation()), time_constant),
        (format!("Frequency of the {} [rad/s]", kind.nutation()), frequency),
    ];
    let followed = own(&FOLLOWED).into_iter().chain([angles]).map(told(|run| run.holds()));
    let reduced = own(&[REDUCED]).into_iter().map(told(|run| run.reduced_holds()));
    let judged = own(&[STEADY]).into_iter().chain(modes).chain(own(&JUDGED)).chain(own(&GIVEN));
    let all = followed.chain(reduced).chain(judged.map(told(|_| true)));
    all.filter(|row| row.values.iter().any(|value| value != NONE)).collect()
}

fn nutation(history: &HistoryRecord) -> Option<String> {
    let (start, end) = ends(column(&history.columns, "nutation_max")?.values.iter().copied())?;
    Some(format!("{}° → {}°", digits(start.to_degrees(), 4), digits(end.to_degrees(), 4)))
}

fn steady(record: &RunRecord) -> Option<&SteadySpinRecord> {
    record.steady_spins.first().filter(|spin| spin.spin.is_some())
}

fn mode(record: &RunRecord) -> Option<&ModeRecord> {
    steady(record)?.modes.iter().find(|mode| mode.nutation)
}
