use maud::{DOCTYPE, Markup, PreEscaped, html};
use quasirigid_io::record::RunRecord;
use quasirigid_io::visible::visible;

use crate::charts;
use crate::sphere;
use crate::viewer;

use crate::sections::{
    about_spin, answer, body, evolution, figures, head, inputs, liquids, modes, overview, provenance,
    reduction, validity, verification,
};

const STYLE: &str = include_str!("assets/page.css");
pub(crate) const PALETTE: &str = include_str!("assets/palette.css");

/// Content security policy: no resource from outside the page, as the browser enforces.
const POLICY: &str =
    "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:";

/// The report of a run: one HTML page that needs no other file.
///
/// The verdict on validity comes first, then the answer, the figures and the tables. Whatever the record lacks
/// (histories, columns, damping) is said in words where it would have stood. A page takes less than a megabyte,
/// with histories of any length and a scene of 10 000 vertices, six modes and 2000 frames.
pub fn page(record: &RunRecord) -> String {
    let title = format!("{} · quasirigid report", record.model.name);
    let kind = record.body.kind;
    let viewer = if record.scene.is_some() { viewer::STYLE } else { "" };
    let body = html! {
        main {
            (head::section(record))
            (overview::facts(record))
            @if let Some(scene) = &record.scene { (viewer::section(kind, scene)) }
            (answer::section(record))
            @if let Some(evolution) = &record.evolution { (evolution::section(kind, evolution)) }
            @if !record.steady_spins.is_empty() { (modes::section(kind, &record.steady_spins, record.campbell.as_ref())) }
            @if let Some(about) = &record.about_spin { (about_spin::section(kind, about)) }
            (figures::section(record))
            (validity::section(&record.validity))
            @if let Some(verification) = &record.verification { (verification::section(kind, verification)) }
            (reduction::section(&record.reduction))
            (body::section(&record.body))
            @if !record.liquids.is_empty() { (liquids::section(&record.liquids)) }
            @if let Some(inputs) = &record.inputs { (inputs::section(inputs)) }
            (provenance::section(record))
        }
        (charts::script())
        @if record.scene.is_some() { (viewer::script()) }
    };
    document(&title, &record.version, &[charts::STYLE, sphere::STYLE, viewer], &body)
}

/// A document that needs no other file, as text that shows every character.
pub(crate) fn document(title: &str, version: &str, styles: &[&str], body: &Markup) -> String {
    let document = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="generator" content={ "quasirigid " (version) };
                meta http-equiv="Content-Security-Policy" content=(POLICY);
                title { (title) }
                style { (PreEscaped(PALETTE)) (PreEscaped(STYLE)) (PreEscaped(styles.concat())) }
            }
            body { (body) }
        }
    };
    visible(&document.into_string())
}
