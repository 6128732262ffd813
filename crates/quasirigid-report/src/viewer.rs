//! Viewer of the body in motion, and the reduced equations that run in the page: markup, scripts and the scene.
//! The scripts need no library and no network; names of the scene become text alone.

use maud::{Markup, PreEscaped, html};
use quasirigid_io::model::BodyKind;
use quasirigid_io::record::SceneRecord;

use crate::packed;

/// Style of the viewer.
pub const STYLE: &str = include_str!("assets/viewer/viewer.css");
const MARKUP: &str = include_str!("assets/viewer/viewer.html");

/// Scripts, each before those that run it when the page is read.
const SCRIPTS: [&str; 25] = [
    packed::SCRIPT,
    include_str!("assets/viewer/arrays.js"),
    include_str!("assets/viewer/linear.js"),
    include_str!("assets/viewer/units.js"),
    include_str!("assets/viewer/polynomial.js"),
    include_str!("assets/viewer/tableau.js"),
    include_str!("assets/viewer/integrator.js"),
    include_str!("assets/viewer/motion.js"),
    include_str!("assets/viewer/frames.js"),
    include_str!("assets/viewer/run.js"),
    include_str!("assets/viewer/modes.js"),
    include_str!("assets/viewer/playback.js"),
    include_str!("assets/viewer/camera.js"),
    include_str!("assets/viewer/theme.js"),
    include_str!("assets/viewer/gl.js"),
    include_str!("assets/viewer/shaders.js"),
    include_str!("assets/viewer/stage.js"),
    include_str!("assets/viewer/pieces.js"),
    include_str!("assets/viewer/pick.js"),
    include_str!("assets/viewer/polhode.js"),
    include_str!("assets/viewer/curves.js"),
    include_str!("assets/viewer/viewer.js"),
    include_str!("assets/viewer/panel.js"),
    include_str!("assets/viewer/controls.js"),
    include_str!("assets/viewer/start.js"),
];

/// The viewer with the scene of a body of a kind.
pub fn section(kind: BodyKind, scene: &SceneRecord) -> Markup {
    let mut scene = serde_json::to_value(scene).expect("a scene is numbers and text");
    for mode in scene["modes"].as_array_mut().into_iter().flatten() {
        mode["name"] = mode["name"].as_str().map(|name| kind.mode_name(name)).into();
    }
    html! {
        (PreEscaped(MARKUP.replace("{Nutation}", kind.title())))
        script type="application/octet-stream" id="scene" { (packed::data(scene)) }
    }
}

/// The scripts as one, whose names are its own.
pub fn script() -> Markup {
    html! { script { (PreEscaped(format!("(() => {{\n\"use strict\";\n{}}})();\n", SCRIPTS.concat()))) } }
}
