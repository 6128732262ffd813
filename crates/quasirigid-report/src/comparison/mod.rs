//! Page that puts runs side by side: their verdicts, what differs and what does not, and their curves in the same figures.

mod dissipators;
mod figures;
mod rows;

use maud::{Markup, html};
use quasirigid_io::model::BodyKind;
use quasirigid_io::record::RunRecord;

use crate::charts;
use crate::page::document;
use crate::sections::{overview, table::table};
use crate::verdict::Verdict;
use rows::Row;

const TABLES: &str = include_str!("../assets/comparison.css");

/// A run of a comparison.
#[derive(Clone, Copy, Debug)]
pub struct Compared<'a> {
    /// Name by which the page calls the run.
    pub label: &'a str,
    /// Its record.
    pub record: &'a RunRecord,
}

impl Compared<'_> {
    /// The verdict on the numbers that the record shows.
    fn shown(&self) -> (Verdict, &'static str) {
        overview::headline(self.record, Verdict::of_all(&self.record.validity))
    }

    /// Whether the numbers of the history are those of the body.
    fn holds(&self) -> bool {
        self.shown().0 != Verdict::Fails
    }

    /// Whether the reduced equations hold.
    fn reduced_holds(&self) -> bool {
        Verdict::of_all(&self.record.validity) != Verdict::Fails
    }
}

/// Kind of the bodies that are compared: small bodies where every run is of one.
fn kind(runs: &[Compared<'_>]) -> BodyKind {
    let small = runs.iter().all(|run| run.record.body.kind == BodyKind::SmallBody);
    if small { BodyKind::SmallBody } else { BodyKind::Spacecraft }
}

/// The page of a comparison: one HTML file that needs no other.
///
/// The verdict on each run comes first; a number of equations that do not hold is not given.
pub fn comparison_page(runs: &[Compared<'_>]) -> String {
    let (differing, same): (Vec<Row>, Vec<Row>) = rows::of(runs).into_iter().partition(Row::differs);
    let body = html! {
        main {
            header {
                p.kind { (runs.len()) " runs side by side" }
                h1 { (title(runs)) }
                @for run in runs { (verdict(run)) }
            }
            section.comparison aria-label="Comparison" {
                h2 { "What differs" }
                @if differing.is_empty() { p.absent { "Nothing in the table below." } }
                @else { (side_by_side("By run", runs, &differing)) }
            }
            section.figures aria-label="Figures" {
                h2 { "How they went" }
                @for figure in figures::of(runs) { (figure.draw()) }
            }
            (dissipators::section(runs))
            section.comparison aria-label="The same" {
                h2 { "What is the same" }
                @if same.is_empty() { p.absent { "Nothing in the table above." } }
                @else { (alike(&same)) }
            }
        }
        (charts::script())
    };
    document(
        &format!("{} · quasirigid comparison", title(runs)),
        env!("CARGO_PKG_VERSION"),
        &[charts::STYLE, TABLES],
        &body,
    )
}

fn title(runs: &[Compared<'_>]) -> String {
    runs.iter().map(|run| run.label).collect::<Vec<_>>().join(" · ")
}

fn verdict(run: &Compared<'_>) -> Markup {
    let (shown, words) = run.shown();
    html! {
        div.verdict.(shown.class()) role="status" {
            (shown.icon())
            p { b { (run.label) ": " } strong { (words) } " " (run.record.validity.verdict) }
        }
    }
}

fn side_by_side(caption: &str, runs: &[Compared<'_>], rows: &[Row]) -> Markup {
    let headings: Vec<&str> = std::iter::once("").chain(runs.iter().map(|run| run.label)).collect();
    table(
        caption,
        &headings,
        html! {
            @for row in rows {
                tr { th scope="row" { (row.name) } @for value in &row.values { td { (value) } } }
            }
        },
    )
}

fn alike(rows: &[Row]) -> Markup {
    table(
        "In all runs",
        &["", ""],
        html! { @for row in rows { tr { th scope="row" { (row.name) } td { (row.values[0]) } } } },
    )
}
