//! Tank reader: `[[tank]]`, a tank of revolution or a ring that is partly full. Equations (U1) to (U14), docs/theory/21-slosh.md.

use std::path::Path;

use quasirigid_elements::{
    Assembly, ElementKind, MeasuredSlosh, RingBaffle, Settling, Tank, TankContents, TankDamping, TankShape,
    Tube,
};

use super::initial::Initial;
use super::key::{
    KIND, Key, Keys, NUMBER, Shape, VECTOR, any, array, integer, key, list, pick, quantity, vector, words,
};
use super::kinds::{Kind, kind, of_table, opened, variants};
use super::names::Part;
use super::reader::{Keyed, NAME, Naming, Reader};
use super::rotation::Rotation;
use super::table::Table;
use super::value::Value;
use crate::table_file::{bracketed_name, read_bodies};
use crate::units::{Dimension, quantity as quantity_in};

/// Function that reads a shape of revolution; none of a ring, whose liquid slides and does not slosh.
type Read = Option<fn(&Table<'_>, &Path) -> Option<TankShape>>;

/// Shape of a ring.
const TUBE: &str = "tube";

/// Names of the keys of a shape: those of every tank and its own.
macro_rules! with {
    ($($own:literal),*) => {
        [
            "shape",
            "name",
            $($own,)*
            "center",
            "axis",
            "fill",
            "liquid_mass",
            "density",
            "kinematic_viscosity",
            "damping_ratio",
            "surface",
            "baffles",
            "wave_amplitude",
            "measured",
            "surface_tension",
            "settled_by",
            "modes",
        ]
    };
}

static SHAPES: [Kind<Read>; 7] = [
    kind!("[[tank]]", "shape", "sphere", with!("radius"), "", Some(sphere)),
    kind!(
        "[[tank]]",
        "shape",
        "ellipsoid",
        with!("semi_axes"),
        "of revolution, the third semi-axis along `axis`",
        Some(ellipsoid)
    ),
    kind!("[[tank]]", "shape", "cylinder", with!("radius", "height"), "", Some(cylinder)),
    kind!(
        "[[tank]]",
        "shape",
        "capsule",
        with!("radius", "height"),
        "cylinder with half a ball at each end",
        Some(capsule)
    ),
    kind!("[[tank]]", "shape", "cone", with!("radii", "height"), "or frustum, with flat ends", Some(cone)),
    kind!("[[tank]]", "shape", "profile", with!("profile"), "", Some(profile)),
    kind!(
        "[[tank]]",
        "shape",
        "tube",
        [
            "shape",
            "name",
            "radius",
            "tube_radius",
            "center",
            "axis",
            "towards",
            "fill",
            "liquid_mass",
            "density",
            "kinematic_viscosity",
            "surface_tension"
        ],
        "ring of tube, whose liquid slides along it as one slug",
        None
    ),
];

/// Acceleration under which a liquid has settled.
const ACCELERATION: Key = key("acceleration", vector("m/s²"), "felt by the liquid as a weight, body axes");
/// Keys of `settled_by`.
const SETTLED: Keys = Keys { known: &[ACCELERATION] };

/// Keys of a baffle.
const BAFFLE: Keys = Keys {
    known: &[
        key("height", quantity("m"), "along `axis`, from `center`"),
        key("width", quantity("m"), "from the wall to the free edge"),
    ],
};

/// Keys of a measured mode.
const MEASURED: Keys = Keys {
    known: &[
        key(
            "frequency",
            quantity("rad/s"),
            "in a tank at rest, under the same effective gravity, without the diaphragm",
        ),
        key("mass", quantity("kg"), "that sloshes"),
        key("damping_ratio", NUMBER, "without baffles and diaphragm"),
        key("stiffness", quantity("N/m").or("0"), "of a diaphragm or bladder, against that mass"),
        key("damping", quantity("N s/m").or("0"), "of a diaphragm or bladder, against that mass"),
    ],
};

/// Keys of a tank without a shape: those of every shape.
const ANY: Keys = Keys {
    known: &[
        key("shape", KIND, ""),
        NAME,
        key("radius", quantity("m"), ""),
        key("tube_radius", quantity("m"), "inner one; `radius` is the mean one of the ring"),
        key("semi_axes", vector("m"), "across, across and along `axis`"),
        key("height", quantity("m"), "from end to end"),
        key("radii", array(2, &Shape::Number).in_unit("m"), "of the ends, the second farther along `axis`"),
        key(
            "profile",
            any(&[Shape::List(&Shape::Array(2, &Shape::Number)), Shape::Text]).in_unit("m"),
            "distance from the axis and height along it, from end to end, or a CSV file of both; heights ascend, but for flat ends",
        ),
        key("center", vector("m").or("0"), "middle of the shape, or origin of its profile"),
        key(
            "axis",
            VECTOR.or("z"),
            "of revolution; the effective gravity is along it, either way; of a sphere any; of a tube that of the ring",
        ),
        key(
            "towards",
            VECTOR.or("x or y"),
            "from the centre of the ring to the middle of the liquid at the start, as far as it is across `axis`",
        ),
        key("fill", NUMBER, "share of the volume, between 0 and 1"),
        key("liquid_mass", quantity("kg"), "instead of `fill`"),
        key("density", quantity("kg/m³"), "of the liquid"),
        key(
            "kinematic_viscosity",
            quantity("m²/s"),
            "of the liquid; the layer at the wall damps the slosh (U7)",
        ),
        key("damping_ratio", NUMBER, "of every slosh mode, measured, instead of the viscosity"),
        key(
            "surface",
            words(&["clean", "contaminated"]).or("`\"clean\"`"),
            "a film of dirt that does not stretch has a layer of its own (U7)",
        ),
        key("baffles", list(&Shape::Table(&BAFFLE)), "rings at the wall, across the axis (U17)"),
        key("wave_amplitude", quantity("m"), "of the surface at the wall, by which baffles damp"),
        key(
            "measured",
            list(&Shape::Table(&MEASURED)),
            "values of the slosh modes, slowest first, in the place of the theory's; and diaphragms",
        ),
        key("surface_tension", quantity("N/m").or("0.07"), "by which capillarity is judged"),
        key(
            "settled_by",
            any(&[Shape::Words(&["spin"]), Shape::Table(&SETTLED)]),
            "what presses the liquid to a side: the spin of `[initial]`, or an acceleration",
        ),
        key("modes", integer(1, Tank::MOST_MODES as u64).or("2"), "slosh modes, of two coordinates each"),
    ],
};

/// Slosh modes unless the file gives a number.
const MODES: usize = 2;

pub(super) const READER: Reader = Reader {
    key: "tank",
    title: "[[tank]]",
    meaning: "tank of revolution or ring of tube that is partly full of a liquid",
    keys: Keyed::ByKind {
        any: &ANY,
        kinds: || variants(&SHAPES),
        open: |value| Some(opened(value, "[[tank]]", "shape", &ANY, &SHAPES)?.0),
        other: |table| is_tube(table).then_some((ElementKind::Tube, Part::Slug)),
    },
    kind: Some(ElementKind::Tank),
    naming: Naming::Numbered("tank"),
    names: |_| Part::Inside,
    aliases: &[("radius", "semi_axes"), ("kinematic_viscosity", "viscosity")],
    nested: &[],
    is_body: false,
    read: |entry, draft| {
        if is_tube(entry.table) {
            draft.assembly.tubes.push(tube(entry.table, entry.name)?);
        } else {
            let folder = draft.sources.folder;
            draft.assembly.tanks.push(tank(entry.table, entry.name, folder)?);
        }
        Some(())
    },
};

fn is_tube(table: &Table<'_>) -> bool {
    table.get("shape").is_some_and(|shape| shape.words() == Some(TUBE))
}

/// Reads a `[[tank]]` of shape "tube".
fn tube(table: &Table<'_>, name: &str) -> Option<Tube> {
    let radius = length(table, "radius", "radius = 0.25");
    let tube_radius = length(table, "tube_radius", "tube_radius = 0.005");
    let center = table.vector_or_zero("center", Dimension::LENGTH);
    let axis = table.read_or("axis", [0.0, 0.0, 1.0], |value| direction(&value));
    let towards = table.read_or("towards", None, |value| direction(&value).map(Some));
    let contents = contents(table);
    let density = table.read("density", "density = 13530.0", |value| value.positive(Dimension::DENSITY));
    let viscosity = table.read("kinematic_viscosity", "kinematic_viscosity = \"0.113 cSt\"", |value| {
        value.positive(Dimension::KINEMATIC_VISCOSITY)
    });
    Some(Tube {
        name: name.to_owned(),
        radius: radius?,
        tube_radius: tube_radius?,
        center: center?,
        axis: axis?,
        towards: towards?,
        contents: contents?,
        density: density?,
        viscosity: viscosity?,
        surface_tension: surface_tension(table)?,
        held: false,
    })
}

fn surface_tension(table: &Table<'_>) -> Option<Option<f64>> {
    table.read_or("surface_tension", None, |value| value.positive(Dimension::SURFACE_TENSION).map(Some))
}

/// Reads a `[[tank]]`; the spin that settles a liquid is set by [`spun`].
fn tank(table: &Table<'_>, name: &str, folder: &Path) -> Option<Tank> {
    let shape = of_table(table, "shape", &SHAPES)?;
    let shape = shape.read.and_then(|read| read(table, folder));
    let center = table.vector_or_zero("center", Dimension::LENGTH);
    let axis = table.read_or("axis", [0.0, 0.0, 1.0], |value| direction(&value));
    let contents = contents(table);
    let density = table.read("density", "density = 1000.0", |value| value.positive(Dimension::DENSITY));
    let damping = damping(table);
    let baffles =
        table.read_or("baffles", Vec::new(), |value| value.list("a list of baffles", |item| baffle(&item)));
    let wave_amplitude =
        table.read_or("wave_amplitude", None, |value| value.positive(Dimension::LENGTH).map(Some));
    let measured = table
        .read_or("measured", Vec::new(), |value| value.list("a list of modes", |item| measured_mode(&item)));
    let surface_tension = surface_tension(table);
    let example = "settled_by = { acceleration = [0, 0, -0.1] }, or settled_by = \"spin\"";
    let settled_by = table.read("settled_by", example, |value| settling(&value));
    let modes = table.read_or("modes", MODES, |value| value.integer(1..=Tank::MOST_MODES));
    Some(Tank {
        name: name.to_owned(),
        shape: shape?,
        center: center?,
        axis: axis?,
        contents: contents?,
        density: density?,
        damping: damping?,
        surface_tension: surface_tension?,
        baffles: baffles?,
        wave_amplitude: wave_amplitude?,
        measured: measured?,
        settled_by: settled_by?,
        modes: modes?,
    })
}

/// Gives tanks that a spin settles the angular velocity of the start; a file without one is told so.
pub(super) fn spun(file: &Table<'_>, assembly: &mut Assembly, initial: &Initial) -> Option<()> {
    let tables = file.several(READER.key, READER.title);
    let of_revolution =
        tables.iter().filter(|table| table.entry("shape").is_none_or(|shape| shape.words() != Some(TUBE)));
    for (tank, table) in assembly.tanks.iter_mut().zip(of_revolution) {
        let Settling::Spin(spin) = &mut tank.settled_by else { continue };
        match initial.rotation {
            Some(Rotation::Spin(omega)) => *spin = omega,
            _ => {
                let message =
                    "`settled_by`: the spin that settles the liquid is the angular velocity of the start";
                let help = "add angular_velocity = [0, 0, 1] to [initial], or write settled_by = { acceleration = [0, 0, -0.1] }";
                return table.entry("settled_by")?.refuse(message, "no angular velocity", help);
            }
        }
    }
    Some(())
}

fn contents(table: &Table<'_>) -> Option<TankContents> {
    match (table.get("fill"), table.get("liquid_mass")) {
        (Some(_), Some(mass)) => {
            let message = "`liquid_mass` beside `fill`: each follows from the other";
            mass.refuse(message, "one of the two", "leave one of them out")
        }
        (None, Some(mass)) => mass.positive(Dimension::MASS).map(TankContents::Mass),
        _ => {
            let fill = table.required("fill", "fill = 0.4, or liquid_mass = \"20 kg\"")?;
            fill.between(Dimension::NUMBER, [0.0, 1.0], "more than 0 and less than 1").map(TankContents::Fill)
        }
    }
}

fn damping(table: &Table<'_>) -> Option<TankDamping> {
    let dirty =
        table.read_or("surface", false, |value| value.choice(&[("clean", false), ("contaminated", true)]));
    match (table.get("damping_ratio"), table.get("kinematic_viscosity")) {
        (Some(ratio), viscosity) => {
            let ratio = ratio.non_negative(Dimension::NUMBER);
            viscosity.map_or(Some(()), |value| value.positive(Dimension::KINEMATIC_VISCOSITY).map(drop))?;
            if dirty? {
                let message = "`surface` beside `damping_ratio`: a measured ratio has the surface in it";
                return table.get("surface")?.refuse(message, "one of the two", "leave one of them out");
            }
            ratio.map(TankDamping::Ratio)
        }
        (None, _) => {
            let viscosity = table
                .required("kinematic_viscosity", "kinematic_viscosity = \"1 cSt\", or damping_ratio = 0.01")?
                .positive(Dimension::KINEMATIC_VISCOSITY);
            let layer = if dirty? { TankDamping::ContaminatedLayer } else { TankDamping::WallLayer };
            viscosity.map(layer)
        }
    }
}

/// Reads an entry of `baffles`.
fn baffle(value: &Value<'_>) -> Option<RingBaffle> {
    let table = value.table("a baffle", &BAFFLE)?;
    let height = table.read("height", "height = 0.1", |value| value.quantity(Dimension::LENGTH));
    let width = length(&table, "width", "width = \"3 cm\"");
    Some(RingBaffle { height: height?, width: width? })
}

/// Reads an entry of `measured`.
fn measured_mode(value: &Value<'_>) -> Option<MeasuredSlosh> {
    let table = value.table("a measured mode", &MEASURED)?;
    let positive = |key, dimension| table.read_or(key, None, |value| value.positive(dimension).map(Some));
    let frequency = positive("frequency", Dimension::FREQUENCY);
    let mass = positive("mass", Dimension::MASS);
    let ratio = table.read_or("damping_ratio", None, |value| value.non_negative(Dimension::NUMBER).map(Some));
    let held = |key, dimension| table.read_or(key, 0.0, |value| value.non_negative(dimension));
    let (stiffness, damping) = (held("stiffness", Dimension::STIFFNESS), held("damping", Dimension::DAMPING));
    Some(MeasuredSlosh {
        frequency: frequency?,
        mass: mass?,
        damping_ratio: ratio?,
        stiffness: stiffness?,
        damping: damping?,
    })
}

fn settling(value: &Value<'_>) -> Option<Settling> {
    if value.is_table() {
        let table = value.table("settled_by", &SETTLED)?;
        let felt = table.read("acceleration", "acceleration = [0, 0, -0.1]", |value| {
            value.vector(Dimension::ACCELERATION)
        });
        return felt.map(Settling::Acceleration);
    }
    let help = "write { acceleration = [0, 0, -0.1] }, or \"spin\"";
    match value.words() {
        Some("spin") => Some(Settling::Spin([0.0; 3])),
        Some(word) => value.refuse(format!("`settled_by` cannot be {word:?}"), "unknown word", help),
        None => value.mismatch("\"spin\" or an acceleration", help),
    }
}

fn direction(value: &Value<'_>) -> Option<[f64; 3]> {
    let axis = value.vector(Dimension::NUMBER)?;
    if axis == [0.0; 3] {
        let help = "write a direction such as [0, 0, 1]; its length does not matter";
        return value.refuse(format!("`{}` has no direction", value.key()), "no direction", help);
    }
    Some(axis)
}

fn sphere(table: &Table<'_>, _: &Path) -> Option<TankShape> {
    Some(TankShape::Ellipsoid { semi_axes: [length(table, "radius", "radius = 0.5")?; 3] })
}

fn ellipsoid(table: &Table<'_>, _: &Path) -> Option<TankShape> {
    let semi_axes = table.required("semi_axes", "semi_axes = [0.5, 0.5, 0.35]")?;
    Some(TankShape::Ellipsoid {
        semi_axes: semi_axes.array("numbers", |item| item.positive(Dimension::LENGTH))?,
    })
}

fn cylinder(table: &Table<'_>, _: &Path) -> Option<TankShape> {
    let (radius, height) = (length(table, "radius", "radius = 0.3"), length(table, "height", "height = 0.8"));
    Some(TankShape::Cylinder { radius: radius?, height: height? })
}

fn capsule(table: &Table<'_>, _: &Path) -> Option<TankShape> {
    let (radius, height) = (length(table, "radius", "radius = 0.3"), length(table, "height", "height = 0.8"));
    Some(TankShape::Capsule { radius: radius?, height: height? })
}

fn cone(table: &Table<'_>, _: &Path) -> Option<TankShape> {
    let radii = table.required("radii", "radii = [0.1, 0.4]");
    let radii = radii.and_then(|value| value.array("numbers", |item| item.non_negative(Dimension::LENGTH)));
    let height = length(table, "height", "height = 0.5");
    Some(TankShape::Cone { radii: radii?, height: height? })
}

fn profile(table: &Table<'_>, folder: &Path) -> Option<TankShape> {
    let example = "profile = [[0, -0.5], [0.4, -0.3], [0.4, 0.3], [0, 0.5]], or profile = \"tank.csv\"";
    let value = table.required("profile", example)?;
    if value.words().is_none() {
        let points = value
            .list("a list of pairs of distance from the axis and height, or a file", |pair| {
                pair.numbers::<2>(Dimension::LENGTH)
            })?;
        return Some(TankShape::Profile { points });
    }
    match meridian(&folder.join(value.text()?)) {
        Ok(points) => Some(TankShape::Profile { points }),
        Err(message) => {
            let help = "the file is looked for beside the model: CSV with the columns r and z in this order, in metres or with their \
                        unit in the header, as r [mm], from end to end of the wall";
            value.refuse(format!("`profile`: {message}"), "cannot be used", help)
        }
    }
}

/// Points of a file: distance from the axis and height (m).
fn meridian(file: &Path) -> Result<Vec<[f64; 2]>, String> {
    let table = read_bodies(file).map_err(|error| error.to_string())?;
    if let Some((_, reason)) = table.unread.first_key_value() {
        return Err(reason.clone());
    }
    let [r, z] = table.columns.as_slice() else {
        return Err(format!("the table has {} columns, and 2 are needed: r and z", table.names.len()));
    };
    let units = table.names.iter().zip(&table.units).zip(["r", "z"]).map(|((name, unit), known)| {
        if bracketed_name(name).unwrap_or(name) != known {
            return Err(format!(
                "the column {name:?} must be named {known:?}, perhaps with its unit in brackets"
            ));
        }
        let unit = unit.as_deref().unwrap_or("m");
        quantity_in(&format!("1 {unit}"), Dimension::LENGTH).map_err(|error| error.to_string())
    });
    let units = units.collect::<Result<Vec<f64>, String>>()?;
    let number = |row: usize, column: &[String], unit: f64| {
        let text = column[row].as_str();
        let number = text.parse::<f64>().ok().filter(|number| number.is_finite());
        let number =
            number.ok_or_else(|| format!("row {} has {text:?} where a finite number is needed", row + 1));
        number.map(|number| number * unit)
    };
    (0..table.rows()).map(|row| Ok([number(row, r, units[0])?, number(row, z, units[1])?])).collect()
}

fn length(table: &Table<'_>, key: &'static str, example: &str) -> Option<f64> {
    table.read(key, example, |value| value.positive(Dimension::LENGTH))
}
