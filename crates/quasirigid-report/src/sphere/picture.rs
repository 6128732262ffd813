//! Picture of the sphere for a paper or a slide: an SVG file of its own, with the colours of white paper in it.

use quasirigid_io::record::RunRecord;
use quasirigid_io::visible::visible;

use super::{STYLE, Scene};
use crate::columns::main_history;
use crate::page::PALETTE;

/// The path of the angular momentum on its sphere, as an SVG file of its own. None if the record has no history, or lacks what the figure
/// needs.
pub fn sphere_picture(record: &RunRecord) -> Option<String> {
    let drawing = Scene::new(&record.body, main_history(record)?)?.draw().into_string();
    let style = on_paper(&format!("{STYLE}.sphere {{ font-family: Helvetica, Arial, sans-serif; }}"));
    let namespace = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"560\" height=\"390\"";
    let paper = "<rect x=\"-280\" y=\"-205\" width=\"560\" height=\"390\" fill=\"#fff\"/>";
    let head = format!("><style>{style}</style>{paper}");
    Some(visible(&drawing.replacen("<svg", namespace, 1).replacen('>', &head, 1)))
}

/// The style with the light colours of the palette in place of their names, which few programs but browsers know.
pub fn on_paper(style: &str) -> String {
    let light = PALETTE.split_once('}').map_or("", |(light, _)| light);
    let colours =
        light.split([';', '{']).filter_map(|entry| entry.trim().strip_prefix("--")?.split_once(':'));
    colours.fold(style.to_owned(), |style, (name, colour)| {
        style.replace(&format!("var(--{name})"), colour.trim())
    })
}
