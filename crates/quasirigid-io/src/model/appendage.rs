//! Appendage reader: `[[appendage]]`, cantilever modes from a vendor's sheet or a file of NASTRAN, without shapes.
//! Effective masses are squares that have lost the sign of the participation factor, and are refused.
//! Equation (K17), docs/theory/12-structures.md.

use std::path::Path;

use quasirigid_elements::{Appendage, AppendageMode, ElementKind, Extent, InertiaPoint};

use super::body::{INERTIA, inertia};
use super::key::{Form, Key, Keys, NUMBER, Shape, TEXT, VECTOR, any, array, key, list, quantity, vector};
use super::names::Part;
use super::reader::{Keyed, NAME, Naming, Reader};
use super::surface::unit_of;
use super::table::Table;
use super::value::Value;
use crate::nastran::sheet;
use crate::units::Dimension;

pub(super) const READER: Reader = Reader {
    key: "appendage",
    title: "[[appendage]]",
    meaning: "cantilever modes from a sheet",
    keys: Keyed::All(&APPENDAGE),
    kind: Some(ElementKind::Appendage),
    naming: Naming::Numbered("modal appendage"),
    names: |_| Part::Modal,
    aliases: &[],
    nested: &[],
    is_body: false,
    read: |entry, draft| {
        let (appendage, note) = appendage(entry.table, entry.name, draft.sources.folder)?;
        draft.file_notes.extend(note);
        draft.assembly.appendages.push(appendage);
        Some(())
    },
};

/// Unit of the participation factors.
const UNIT: Form = any(&[Shape::Text, Shape::Number]);

const APPENDAGE: Keys = Keys {
    known: &[
        NAME,
        key("at", vector("m"), "interface, origin of the sheet"),
        key(
            "axes",
            array(2, &Shape::Vector).or("file's"),
            "of the sheet, in the file's: the first, and one in the plane of the first two",
        ),
        key("mass", quantity("kg"), ""),
        key("center_of_mass", vector("m"), "from the interface, sheet's axes"),
        Key { meaning: "about the centre of mass, sheet's axes", ..INERTIA },
        key(
            "interface_inertia",
            any(&[Shape::Vector, Shape::Matrix]).in_unit("kg m²"),
            "about the interface, instead",
        ),
        key("modes", list(&Shape::Table(&MODE)), "with the interface held"),
        key(
            "file",
            TEXT,
            "instead of mass, centre, inertia and modes: `MEFFMASS` of NASTRAN (`.op2`, `.f06`), or an external superelement (`.op4`, \
             `.pch`, `.op2`)",
        ),
        key("nodes", TEXT.or("`file`"), "of a superelement: `.pch` or `.asm` with its boundary"),
        key("damping_ratio", NUMBER.or("0"), "of the modes of `file`"),
        key(
            "rotation_about",
            vector("m").or("the interface"),
            "point of `rotation`, from the interface, sheet's axes",
        ),
        key("mass_unit", UNIT.or("`\"kg\"`"), "of `translation` and `rotation`"),
        key("length_unit", UNIT.or("`\"m\"`"), "of `rotation`"),
        key(
            "line",
            VECTOR.or("none"),
            "of a boom: the mass is on this line through the interface and bends across it",
        ),
        key(
            "normal",
            VECTOR.or("none"),
            "of a panel: the mass is in the plane across this through the interface and bends along it",
        ),
    ],
};

const MODE: Keys = Keys {
    known: &[
        key("frequency", quantity("rad/s"), ""),
        key("damping_ratio", NUMBER.or("0"), ""),
        key("translation", vector("kg^½"), "∫φ dm, of unit modal mass, with its sign"),
        key("rotation", vector("kg^½ m"), "∫s×φ dm"),
    ],
};

/// Quantities that are squares of a participation factor.
const SQUARES: [&str; 3] = ["effective_mass", "effective_inertia", "effective_masses"];
/// Axes unless the file chooses others: those of the file.
const ALIGNED: [[f64; 3]; 2] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

/// What a sheet says of an appendage.
struct Sheet {
    mass: f64,
    center_of_mass: [f64; 3],
    inertia: ([[f64; 3]; 3], InertiaPoint),
    rotation_about: [f64; 3],
    modes: Vec<AppendageMode>,
    note: Option<String>,
}

/// Reads an `[[appendage]]`, with what is to tell of its file.
fn appendage(table: &Table<'_>, name: &str, folder: &Path) -> Option<(Appendage, Option<String>)> {
    let interface = table.read("at", "at = [0.6, 0.0, 0.2]", |value| value.vector(Dimension::LENGTH));
    let axes = table.read_or("axes", ALIGNED, |value| {
        value.array("two directions", |axis| axis.vector(Dimension::NUMBER))
    });
    let unit = |key, dimension| table.read_or(key, 1.0, |value| unit_of(&value, dimension));
    let units = [unit("mass_unit", Dimension::MASS), unit("length_unit", Dimension::LENGTH)];
    let sheet = match table.get("file") {
        Some(file) => of_file(table, &file, folder, [units[0]?, units[1]?]),
        None => typed(table, units),
    };
    let extent = extent(table);
    let (interface, axes, sheet) = (interface?, axes?, sheet?);
    let Sheet { mass, center_of_mass, inertia: (inertia, inertia_about), rotation_about, modes, note } =
        sheet;
    let name = name.to_owned();
    let appendage = Appendage {
        name,
        interface,
        axes,
        mass,
        center_of_mass,
        inertia,
        inertia_about,
        rotation_about,
        extent: extent?,
        modes,
    };
    Some((appendage, note))
}

/// Keys of what a file of NASTRAN has.
const IN_FILE: [&str; 6] =
    ["mass", "center_of_mass", "inertia", "interface_inertia", "modes", "rotation_about"];

/// Reads mass and modes from a file of NASTRAN, about the origin of the sheet.
fn of_file(table: &Table<'_>, file: &Value<'_>, folder: &Path, [mass, length]: [f64; 2]) -> Option<Sheet> {
    if let Some(value) = IN_FILE.iter().find_map(|key| table.get(key)) {
        let message = format!("`{}` is in the `file`", value.key());
        return value.refuse(message, "given twice", "leave out one of the two");
    }
    let nodes = match table.get("nodes") {
        Some(value) => Some(folder.join(value.text()?)),
        None => None,
    };
    let damping_ratio = table.read_or("damping_ratio", 0.0, |value| value.non_negative(Dimension::NUMBER))?;
    let refuse = |message: String| {
        let help = "it is looked for beside the model; MEFFMASS in .op2 or .f06, and external superelements in .op4, .pch or .op2 are read";
        file.refuse(format!("`file`: {message}"), "cannot be used", help)
    };
    let path = folder.join(file.text()?);
    let sheet = match sheet::read(&path, nodes.as_deref()) {
        Ok(sheet) => sheet,
        Err(error) => return refuse(error.to_string()),
    };
    let body = match sheet.body() {
        Ok(body) => body,
        Err(problem) => return refuse(format!("{}: {problem}", path.display())),
    };
    let mode = |mode: &sheet::SheetMode| {
        let [x, y, z, rx, ry, rz] = mode.factors.map(|factor| mass.sqrt() * factor);
        AppendageMode {
            frequency: mode.frequency,
            damping_ratio,
            translation: [x, y, z],
            rotation: [rx, ry, rz].map(|factor| length * factor),
        }
    };
    let modes: Vec<AppendageMode> = sheet.modes.iter().map(mode).collect();
    let hertz =
        |mode: Option<&AppendageMode>| mode.map_or(0.0, |mode| mode.frequency / std::f64::consts::TAU);
    let (mass, center_of_mass) = (mass * body.mass, body.center.map(|x| length * x));
    let note = format!(
        "{}: {mass:.6} kg with the centre of mass at [{:.6}, {:.6}, {:.6}] m from the interface, {} modes from {:.4} Hz to {:.4} Hz",
        file.words().unwrap_or_default(),
        center_of_mass[0],
        center_of_mass[1],
        center_of_mass[2],
        modes.len(),
        hertz(modes.first()),
        hertz(modes.last()),
    );
    let unit = mass / body.mass * length.powi(2);
    Some(Sheet {
        mass,
        center_of_mass,
        inertia: (body.inertia.map(|row| row.map(|entry| unit * entry)), InertiaPoint::Interface),
        rotation_about: [0.0; 3],
        modes,
        note: Some(note),
    })
}

/// Reads mass and modes as the model gives them.
fn typed(table: &Table<'_>, [mass_unit, length_unit]: [Option<f64>; 2]) -> Option<Sheet> {
    for key in ["nodes", "damping_ratio"] {
        if let Some(value) = table.get(key) {
            return value.refuse(format!("`{key}` is of a `file`"), "without a file", "leave it out");
        }
    }
    let mass = table.read("mass", "mass = 12.0", |value| value.positive(Dimension::MASS));
    let center_of_mass = table
        .read("center_of_mass", "center_of_mass = [1.5, 0.0, 0.0]", |value| value.vector(Dimension::LENGTH));
    let inertia = about(table);
    let rotation_about = table.vector_or_zero("rotation_about", Dimension::LENGTH);
    let example = "modes = [{ frequency = \"0.3 Hz\", translation = [0, 0, 1.2], rotation = [0, -2.4, 0] }]";
    let modes = table.read("modes", example, |value| value.list("a list of modes", |item| mode(&item)));
    let (mut modes, translation) = (modes?, mass_unit?.sqrt());
    let rotation = translation * length_unit?;
    for mode in &mut modes {
        mode.translation = mode.translation.map(|factor| translation * factor);
        mode.rotation = mode.rotation.map(|factor| rotation * factor);
    }
    Some(Sheet {
        mass: mass?,
        center_of_mass: center_of_mass?,
        inertia: inertia?,
        rotation_about: rotation_about?,
        modes,
        note: None,
    })
}

/// Reads the inertia tensor, and the point that it is about.
fn about(table: &Table<'_>) -> Option<([[f64; 3]; 3], InertiaPoint)> {
    match (table.get("inertia"), table.get("interface_inertia")) {
        (Some(_), Some(second)) => second.refuse(
            "`inertia` and `interface_inertia` are one tensor about two points",
            "one too many",
            "leave one of them out",
        ),
        (None, Some(value)) => Some((inertia(&value)?, InertiaPoint::Interface)),
        _ => {
            let value = table.required("inertia", "inertia = [0.1, 9.0, 9.0], about the centre of mass")?;
            Some((inertia(&value)?, InertiaPoint::CenterOfMass))
        }
    }
}

fn extent(table: &Table<'_>) -> Option<Extent> {
    let direction = |value: &Value<'_>| value.vector(Dimension::NUMBER);
    Some(match (table.get("line"), table.get("normal")) {
        (None, None) => Extent::Unknown,
        (Some(line), None) => Extent::Line(direction(&line)?),
        (None, Some(normal)) => Extent::Plane(direction(&normal)?),
        (Some(_), Some(normal)) => {
            let message = "the mass is on a `line` or in a plane with a `normal`";
            return normal.refuse(message, "one too many", "leave one of them out");
        }
    })
}

/// Reads a mode, with the participation factors in the units of the sheet.
fn mode(value: &Value<'_>) -> Option<AppendageMode> {
    if let Some(square) = SQUARES.iter().find_map(|key| value.entry(key)) {
        let message = "an effective mass has lost the sign of its participation factor, and with it the coupling of its axes";
        let help =
            "ask for the participation factors of unit modal mass, and write `translation` and `rotation`";
        return square.refuse(message, "a square", help);
    }
    let table = value.table("a mode", &MODE)?;
    let frequency =
        table.read("frequency", "frequency = \"0.3 Hz\"", |value| value.positive(Dimension::FREQUENCY));
    let damping_ratio = table.read_or("damping_ratio", 0.0, |value| value.non_negative(Dimension::NUMBER));
    let factor = |key, example| table.read(key, example, |value| value.vector(Dimension::NUMBER));
    let translation = factor("translation", "translation = [0, 0, 1.2]");
    let rotation = factor("rotation", "rotation = [0, -2.4, 0]");
    Some(AppendageMode {
        frequency: frequency?,
        damping_ratio: damping_ratio?,
        translation: translation?,
        rotation: rotation?,
    })
}
