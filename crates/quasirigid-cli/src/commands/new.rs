use std::path::{Component, Path, PathBuf, absolute};

use clap::ValueEnum;
use quasirigid_io::model::reference;

use crate::args::{NewArgs, Start};
use crate::failure::Failure;
use crate::output::Folder;
use crate::{ExitStatus, output};

/// Model, and the schema by which an editor completes and checks it.
const MODEL: &str = "model.toml";
const SCHEMA: &str = "schema.json";
/// What stands in a template for the name of the user's file.
const FILE: &str = "\"FILE\"";

/// Writes a commented start for a kind of body into a folder, or lists the kinds.
pub fn new(arguments: &NewArgs) -> Result<ExitStatus, Failure> {
    let NewArgs { kind, out, file, quiet } = arguments;
    let Some(kind) = kind else {
        output::print(&list())?;
        return Ok(ExitStatus::Done);
    };
    let folder = out.clone().unwrap_or_else(|| PathBuf::from(name(*kind)));
    Folder::check(&folder, false)?;
    let named = named(*kind, &folder, file.as_deref())?;
    let model = model(*kind).replace(FILE, &named);
    let building = Folder::new(&folder, false)?;
    building.write(MODEL, &format!("#:schema {SCHEMA}\n{model}"))?;
    building.write(SCHEMA, &format!("{:#}\n", reference::schema()))?;
    if *kind == Start::Tumblers {
        building.write("study.toml", include_str!("../templates/tumblers.toml"))?;
        building.write("bodies.csv", include_str!("../templates/tumblers.csv"))?;
    }
    let placed = building.finish()?;
    let as_asked = placed.told(&folder);
    if !quiet {
        let missing = (file.is_none() && usual_file(*kind).is_some()).then_some(&*named);
        output::print(&told(*kind, &placed.path, missing))?;
    }
    Ok(if as_asked { ExitStatus::Done } else { ExitStatus::CheckFailed })
}

/// The kinds with their meanings.
fn list() -> String {
    let kinds = Start::value_variants().iter().filter_map(ValueEnum::to_possible_value);
    let line = |kind: clap::builder::PossibleValue| {
        let help = kind.get_help().map(ToString::to_string).unwrap_or_default();
        format!("  {:16}{help}\n", kind.get_name())
    };
    format!("Kinds of bodies to start from:\n{}", kinds.map(line).collect::<String>())
}

fn name(kind: Start) -> String {
    kind.to_possible_value().map(|value| value.get_name().to_owned()).unwrap_or_default()
}

/// Template of the model of a kind.
fn model(kind: Start) -> &'static str {
    match kind {
        Start::BoomSatellite => include_str!("../templates/boom-satellite.toml"),
        Start::Panels => include_str!("../templates/panels.toml"),
        Start::Wheel => include_str!("../templates/wheel.toml"),
        Start::Tank => include_str!("../templates/tank.toml"),
        Start::Mesh => include_str!("../templates/mesh.toml"),
        Start::Nastran => include_str!("../templates/nastran.toml"),
        Start::Shape => include_str!("../templates/shape.toml"),
        Start::Ellipsoid => include_str!("../templates/ellipsoid.toml"),
        Start::LightCurve | Start::Tumblers => include_str!("../templates/light-curve.toml"),
    }
}

/// File that a kind reads, where the user has not named one.
fn usual_file(kind: Start) -> Option<&'static str> {
    match kind {
        Start::Mesh => Some("part.msh"),
        Start::Nastran => Some("part.bdf"),
        Start::Shape => Some("shape.obj"),
        _ => None,
    }
}

/// Name of the user's file as a text of a model in a folder; empty for a kind that reads none.
fn named(kind: Start, folder: &Path, file: Option<&Path>) -> Result<String, Failure> {
    let path = match (usual_file(kind), file) {
        (None, None) => return Ok(String::new()),
        (None, Some(_)) => return Err(Failure::ReadsNoFile { kind: name(kind) }),
        (Some(usual), None) => PathBuf::from(usual),
        (Some(_), Some(file)) if !file.is_file() => return Err(Failure::NoFile { path: file.into() }),
        (Some(_), Some(file)) => seen_from(folder, file)?,
    };
    let text = path.to_str().ok_or_else(|| Failure::OddName { path: path.clone() })?;
    Ok(serde_json::Value::from(text).to_string())
}

/// Path of a file as seen from a folder: relative if both are, and the folder is below the current one.
fn seen_from(folder: &Path, file: &Path) -> Result<PathBuf, Failure> {
    let below = folder.components().all(|part| matches!(part, Component::Normal(_) | Component::CurDir));
    if below && file.is_relative() {
        let depth = folder.components().filter(|part| matches!(part, Component::Normal(_))).count();
        return Ok([".."].into_iter().cycle().take(depth).map(Path::new).chain([file]).collect());
    }
    absolute(file).map_err(|cause| Failure::Write { path: file.into(), cause })
}

/// What was written, the file that is still missing, and the command to try next.
fn told(kind: Start, folder: &Path, missing: Option<&str>) -> String {
    let (command, file) = match kind {
        Start::Wheel => ("modes", MODEL),
        Start::Tank | Start::Ellipsoid | Start::LightCurve | Start::Shape => ("evolve", MODEL),
        Start::Tumblers => ("sweep", "study.toml"),
        Start::BoomSatellite | Start::Panels | Start::Mesh | Start::Nastran => ("check", MODEL),
    };
    let missing =
        missing.map(|name| format!("Put your file there as {name}, or change its name in {MODEL}.\n"));
    format!(
        "Created {}\n{}Next: quasirigid {command} {}\n",
        folder.display(),
        missing.unwrap_or_default(),
        folder.join(file).display()
    )
}
