//! Scripts of the charts: zoom of linked figures, values under the pointer, downloads. The charts are complete without them.

use maud::{Markup, PreEscaped, html};

use crate::packed;

/// Style that the scripts add to that of the page.
pub const STYLE: &str = include_str!("assets/plot/plot.css");

/// Scripts, each before those that run it when the page is read.
const SCRIPTS: [&str; 16] = [
    packed::SCRIPT,
    include_str!("assets/plot/lists.js"),
    include_str!("assets/plot/words.js"),
    include_str!("assets/plot/scale.js"),
    include_str!("assets/plot/series.js"),
    include_str!("assets/plot/curve.js"),
    include_str!("assets/plot/link.js"),
    include_str!("assets/plot/layer.js"),
    include_str!("assets/plot/pointer.js"),
    include_str!("assets/plot/chart.js"),
    include_str!("assets/plot/zoom.js"),
    include_str!("assets/plot/keys.js"),
    include_str!("assets/plot/picture.js"),
    include_str!("assets/plot/table.js"),
    include_str!("assets/plot/toolbar.js"),
    include_str!("assets/plot/start.js"),
];

/// The scripts as one, whose names are its own.
pub fn script() -> Markup {
    html! { script { (PreEscaped(format!("(() => {{\n\"use strict\";\n{}}})();\n", SCRIPTS.concat()))) } }
}
