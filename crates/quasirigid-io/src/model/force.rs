//! Force reader: `[[force]]`, one function for each of ten laws.
//! Whether a law needs a place or refuses one is a law of mechanics and checked by the library; here only keys and units are.
//! Equations (F3) to (F10), (F13) to (F15) and (F27), docs/theory/07-forces.md.

use std::cell::RefCell;
use std::f64::consts::TAU;
use std::path::Path;

use quasirigid_body::force::{Axes, Force, ForceLaw, Wave};
use quasirigid_elements::{ApplicationPoint, ElementKind};

use super::conductor::eddy_current;
use super::formula::{PLACE, formulas};
use super::key::{
    BOOLEAN, Form, KIND, Key, Keys, NUMBER, Shape, TEXT, VECTOR, any, key, list, of, pick, quantity, shared,
    words,
};
use super::kinds::{Kind, kind, of_table, opened, variants};
use super::magnetic_field::{self, CommonField, field_of_force};
use super::names::{END, Fixed, Names, Part};
use super::orbit::ORBIT;
use super::reader::{Keyed, NAME, Naming, Reader, Sources};
use super::sunlight::{Sunlit, sunlight};
use super::surface::{STRICT, UNIT};
use super::table::Table;
use super::timing::{alone, tabled, twice, windows};
use super::trajectory::trajectory;
use super::value::Value;
use crate::units::Dimension;

type Read = fn(&Table<'_>, &Around<'_, '_>) -> Option<ForceLaw<ApplicationPoint>>;

/// What a force refers to in the rest of the file.
struct Around<'s, 'a> {
    names: &'s Names<'a>,
    folder: &'s Path,
    field: CommonField,
    sunlit: Sunlit<'s>,
}

static KINDS: [Kind<Read>; 10] = [
    kind!(
        "[[force]]",
        "uniform-gravity",
        ["kind", "name", "acceleration", "during"],
        "(F3); moves a free body's centre of mass only",
        uniform_gravity
    ),
    kind!(
        "[[force]]",
        "central-gravity",
        ["kind", "name", "orbit", "during"],
        "gravity gradient (F4)",
        central_gravity
    ),
    kind!(
        "[[force]]",
        "drag",
        ["kind", "name", "on", "at", "coefficient", "during"],
        "−k v, v the inertial velocity of the place (F5)",
        drag
    ),
    kind!(
        "[[force]]",
        "spin-drag",
        ["kind", "name", "coefficient", "during"],
        "torque −k ω on the carrier (F5)",
        spin_drag
    ),
    kind!(
        "[[force]]",
        "torque",
        [
            "kind",
            "name",
            "torque",
            "axes",
            "frequency",
            "period",
            "phase",
            "timetable",
            "interpolation",
            "during"
        ],
        "on the carrier (F6)",
        torque
    ),
    kind!(
        "[[force]]",
        "thrust",
        [
            "kind",
            "name",
            "on",
            "at",
            "force",
            "axes",
            "frequency",
            "period",
            "phase",
            "timetable",
            "interpolation",
            "during"
        ],
        "(F7)",
        thrust
    ),
    kind!(
        "[[force]]",
        "magnetic-dipole",
        ["kind", "name", "moment", "field", "dipole", "dipole_rate", "igrf", "orbit", "during"],
        "torque on the carrier (F8)",
        magnetic_dipole
    ),
    kind!(
        "[[force]]",
        "eddy-current",
        [
            "kind",
            "name",
            "tensor",
            "conductivity",
            "shape",
            "radius",
            "thickness",
            "field",
            "dipole",
            "dipole_rate",
            "igrf",
            "orbit",
            "during"
        ],
        "torque [M(ω×B − Ḃ)]×B on the carrier (F15)",
        |table, around| eddy_current(table, around.field)
    ),
    kind!(
        "[[force]]",
        "sunlight",
        [
            "kind",
            "name",
            "direction",
            "distance",
            "orbit",
            "file",
            "unit",
            "strict",
            "shadows",
            "tolerance",
            "during"
        ],
        "pressure of light on the outer surface, with what it scatters and emits (F27)",
        |table, around| sunlight(table, &around.sunlit)
    ),
    kind!(
        "[[force]]",
        "expression",
        ["kind", "name", "on", "at", "force", "torque", "axes", "timetable", "interpolation", "during"],
        "formulas (F9): a `force`, inertial axes, or a `torque` on the carrier",
        expression
    ),
];

/// Components, or formulas of them.
const COMPONENTS: Form = any(&[Shape::Vector, Shape::Array(3, &Shape::Formula)]);

/// Keys of a force without a kind: those of every kind.
const ANY: Keys = Keys {
    known: &[
        key("kind", KIND, ""),
        NAME,
        key("on", END, "point, node or place, or `\"carrier\"`"),
        key("at", of(Shape::Vector).in_unit("m"), "on the carrier"),
        key("coefficient", quantity("N s/m, N m s"), "k"),
        key("acceleration", of(Shape::Vector).in_unit("m/s²"), "inertial axes"),
        key("orbit", shared("orbit"), ""),
        key("torque", COMPONENTS.in_unit("N m"), ""),
        key("force", COMPONENTS.in_unit("N"), ""),
        key(
            "axes",
            words(&["body", "inertial", "place"]).or("`\"body\"`"),
            "of force or torque; a `thrust` may turn with its place (F22)",
        ),
        key("frequency", quantity("rad/s").or("constant"), "Ω, the amplitude varies as cos(Ωt + φ)"),
        key("period", quantity("s"), "instead"),
        key("phase", quantity("rad").or("0"), "φ"),
        key("moment", of(Shape::Vector).in_unit("A m²"), "body axes"),
        Key { form: magnetic_field::FIELD.form.or("`[magnetic_field]`"), ..magnetic_field::FIELD },
        magnetic_field::DIPOLE,
        magnetic_field::DIPOLE_RATE,
        magnetic_field::MAIN_FIELD,
        key("tensor", any(&[Shape::Number, Shape::Matrix]).in_unit("S m⁴"), "magnetic tensor M, body axes"),
        key("conductivity", quantity("S/m"), "instead, with a `shape`"),
        key("shape", words(&["sphere", "shell"]), "(F16)"),
        key("radius", quantity("m"), "outer one"),
        key("thickness", quantity("m"), "of a shell"),
        key(
            "direction",
            VECTOR,
            "towards the Sun, inertial axes; with a `distance`, instead of an `orbit` about it",
        ),
        key("distance", quantity("m"), "of the Sun"),
        key(
            "file",
            TEXT.or("the [[surface]] or [[ellipsoid]]"),
            "closed surface in the light, as of a [[surface]]",
        ),
        UNIT,
        STRICT,
        key("shadows", BOOLEAN.or("`true`"), "of the surface on itself"),
        key("tolerance", NUMBER.or("0.01"), "error of the torque, of its root mean square; 0.0001 to 0.1"),
        key("timetable", TEXT, "CSV file instead of components (F14)"),
        key("interpolation", words(&["held", "linear"]).or("`\"held\"`"), "of the timetable"),
        key(
            "during",
            list(&Shape::Array(2, &Shape::Number)).in_unit("s").or("always"),
            "windows `[begin, end]` (F13)",
        ),
    ],
};

pub(super) const READER: Reader = Reader {
    key: "force",
    title: "[[force]]",
    meaning: "force or torque",
    keys: Keyed::ByKind {
        any: &ANY,
        kinds: || variants(&KINDS),
        open: |value| Some(opened(value, "[[force]]", "kind", &ANY, &KINDS)?.0),
        other: |_| None,
    },
    kind: Some(ElementKind::Force),
    naming: Naming::Apart("force"),
    names: |_| Part::Throughout,
    aliases: &[("period", "frequency")],
    nested: &[("orbit", &ORBIT)],
    is_body: false,
    read: |entry, draft| {
        let Sources { folder, field, .. } = draft.sources;
        let sunlit =
            Sunlit { name: entry.name, folder, assembly: &draft.assembly, notes: RefCell::default() };
        let around = Around { names: &draft.names, folder, field, sunlit };
        let law = (of_table(entry.table, "kind", &KINDS)?.read)(entry.table, &around);
        let notes = around.sunlit.notes.into_inner();
        let windows = windows(entry.table);
        let (law, windows) = (law?, windows?);
        draft.notes.extend(notes);
        let law = match windows {
            Some(windows) => ForceLaw::During { windows, law: Box::new(law) },
            None => law,
        };
        draft.assembly.forces.push(Force { name: entry.name.to_owned(), law });
        Some(())
    },
};

fn uniform_gravity(table: &Table<'_>, _: &Around<'_, '_>) -> Option<ForceLaw<ApplicationPoint>> {
    let acceleration =
        vector(table, "acceleration", Dimension::ACCELERATION, "acceleration = [0, 0, -9.81]")?;
    Some(ForceLaw::UniformGravity { acceleration })
}

fn central_gravity(table: &Table<'_>, around: &Around<'_, '_>) -> Option<ForceLaw<ApplicationPoint>> {
    Some(ForceLaw::CentralGravity { orbit: trajectory(table, around.folder)? })
}

fn drag(table: &Table<'_>, around: &Around<'_, '_>) -> Option<ForceLaw<ApplicationPoint>> {
    let at = application_point(table, around.names);
    let coefficient = coefficient(table, Dimension::DAMPING, "coefficient = \"0.2 N s/m\"");
    Some(ForceLaw::Drag { at: at?, coefficient: coefficient? })
}

fn spin_drag(table: &Table<'_>, _: &Around<'_, '_>) -> Option<ForceLaw<ApplicationPoint>> {
    let coefficient = coefficient(table, Dimension::ROTATIONAL_DAMPING, "coefficient = \"1e-4 N m s\"")?;
    Some(ForceLaw::SpinDrag { coefficient })
}

fn torque(table: &Table<'_>, around: &Around<'_, '_>) -> Option<ForceLaw<ApplicationPoint>> {
    if let Some(given) = tabled(table, "torque", around.folder) {
        return given.and_then(|given| Some(ForceLaw::TorqueTable { table: given, axes: axes(table)? }));
    }
    let torque = vector(table, "torque", Dimension::TORQUE, "torque = [0, 0, \"0.05 N m\"]");
    let axes = axes(table);
    let wave = wave(table);
    Some(ForceLaw::Torque { torque: torque?, axes: axes?, wave: wave? })
}

fn thrust(table: &Table<'_>, around: &Around<'_, '_>) -> Option<ForceLaw<ApplicationPoint>> {
    let at = application_point(table, around.names);
    if let Some(given) = tabled(table, "force", around.folder) {
        let axes = axes_at_place(table);
        return Some(ForceLaw::ForceTable { at: at?, table: given?, axes: axes? });
    }
    let force = vector(table, "force", Dimension::FORCE, "force = [0, 0, \"5 mN\"]");
    let axes = axes_at_place(table);
    let wave = wave(table);
    Some(ForceLaw::Thrust { at: at?, force: force?, axes: axes?, wave: wave? })
}

fn magnetic_dipole(table: &Table<'_>, around: &Around<'_, '_>) -> Option<ForceLaw<ApplicationPoint>> {
    let moment = vector(table, "moment", Dimension::MAGNETIC_MOMENT, "moment = [0, 0, \"0.2 A m^2\"]");
    let field = field_of_force(table, around.field);
    Some(ForceLaw::MagneticDipole { moment: moment?, field: field? })
}

fn expression(table: &Table<'_>, around: &Around<'_, '_>) -> Option<ForceLaw<ApplicationPoint>> {
    if table.get("timetable").is_some() {
        return timetable_or_formula(table, around);
    }
    if let Some(value) = table.get("interpolation") {
        return alone(&value);
    }
    if let Some(torque) = table.get("torque") {
        return torque_expression(table, &torque);
    }
    if let Some(axes) = table.get("axes") {
        let message = "`axes` are those of a `torque`; the formulas of a force are in inertial axes";
        let help = "turn the force with qw qx qy qz, or give a torque";
        return axes.refuse(message, "not for a force", help);
    }
    let at = application_point(table, around.names);
    let force = table.read("force", "force = [\"-0.1*vx\", \"0\", \"sin(2*t)\"]", |value| {
        formulas(&value, &PLACE, Dimension::FORCE)
    });
    Some(ForceLaw::Expression { at: at?, force: force? })
}

/// A table in place of formulas: of a force where the entry has a place, of a torque on the carrier elsewhere.
fn timetable_or_formula(table: &Table<'_>, around: &Around<'_, '_>) -> Option<ForceLaw<ApplicationPoint>> {
    let given = tabled(table, "torque", around.folder)?;
    if let Some(force) = table.get("force") {
        return twice(&force);
    }
    if table.get("on").is_some() {
        let (at, axes) = (application_point(table, around.names), axes_or(table, Axes::Inertial));
        return Some(ForceLaw::ForceTable { at: at?, table: given?, axes: axes? });
    }
    let axes = axes(table);
    Some(ForceLaw::TorqueTable { table: given?, axes: axes? })
}

fn torque_expression(table: &Table<'_>, torque: &Value<'_>) -> Option<ForceLaw<ApplicationPoint>> {
    for key in ["force", "on", "at"] {
        if let Some(value) = table.get(key) {
            let message = format!("`{key}` goes with a `force`, and this is a `torque` on the carrier");
            let help = "leave it out, or write one [[force]] for each";
            return value.refuse(message, "not for a torque", help);
        }
    }
    let axes = axes(table);
    Some(ForceLaw::TorqueExpression { torque: formulas(torque, &PLACE, Dimension::TORQUE)?, axes: axes? })
}

/// Point of application of a force: a point, or a place of the carrier. The library checks which of them needs a place.
fn application_point(table: &Table<'_>, names: &Names<'_>) -> Option<ApplicationPoint> {
    let on = table.read("on", "on = \"carrier\"", |value| names.end(&value, Fixed::Force));
    let at = table.read_or("at", None, |value| value.vector(Dimension::LENGTH).map(Some));
    Some(ApplicationPoint { on: on?, at: at? })
}

fn axes(table: &Table<'_>) -> Option<Axes> {
    axes_or(table, Axes::Body)
}

/// Axes in the words of the file.
const AXES: [(&str, Axes); 3] = [("body", Axes::Body), ("inertial", Axes::Inertial), ("place", Axes::Place)];

fn axes_or(table: &Table<'_>, usual: Axes) -> Option<Axes> {
    table.read_or("axes", usual, |value| value.choice(&AXES[..2]))
}

/// Axes of a force in components, which may turn with the place where it acts.
fn axes_at_place(table: &Table<'_>) -> Option<Axes> {
    table.read_or("axes", Axes::Body, |value| value.choice(&AXES))
}

/// Reads the wave of an amplitude: frequency or period, and phase.
fn wave(table: &Table<'_>) -> Option<Wave> {
    let phase = table.read_or("phase", 0.0, |value| value.quantity(Dimension::ANGLE));
    let frequency = match (table.get("frequency"), table.get("period")) {
        (Some(frequency), None) => frequency.quantity(Dimension::FREQUENCY),
        (None, Some(period)) => period.positive(Dimension::TIME).map(|period| TAU / period),
        (Some(_), Some(period)) => period.refuse(
            "the `period` follows from the `frequency`",
            "given twice",
            "leave out one of the two",
        ),
        (None, None) => match table.get("phase") {
            Some(phase) => phase.refuse(
                "a `phase` without a `frequency` or a `period`",
                "of what?",
                "add for example frequency = \"2 Hz\", or leave it out",
            ),
            None => Some(0.0),
        },
    };
    Some(Wave { frequency: frequency?, phase: phase? })
}

fn vector(table: &Table<'_>, key: &'static str, dimension: Dimension, example: &str) -> Option<[f64; 3]> {
    table.required(key, example)?.vector(dimension)
}

fn coefficient(table: &Table<'_>, dimension: Dimension, example: &str) -> Option<f64> {
    table.required("coefficient", example)?.non_negative(dimension)
}
