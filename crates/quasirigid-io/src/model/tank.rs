//! Tank reader: `[[tank]]`, a tank of revolution or a ring that is partly full. Equations (U1) to (U14), docs/theory/21-slosh.md.

use quasirigid_elements::{
    Assembly, ElementKind, Settling, Tank, TankContents, TankDamping, TankShape, Tube,
};

use super::initial::Initial;
use super::key::{
    KIND, Key, Keys, NUMBER, Shape, VECTOR, any, array, integer, key, list, pick, quantity, vector,
};
use super::kinds::{Kind, kind, of_table, opened, variants};
use super::names::Part;
use super::reader::{Keyed, NAME, Naming, Reader};
use super::rotation::Rotation;
use super::table::Table;
use super::value::Value;
use crate::units::Dimension;

/// Function that reads a shape of revolution; none of a ring, whose liquid slides and does not slosh.
type Read = Option<fn(&Table<'_>) -> Option<TankShape>>;

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
            list(&Shape::Array(2, &Shape::Number)).in_unit("m"),
            "distance from the axis and height along it, from end to end; heights ascend, but for flat ends",
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
            draft.assembly.tanks.push(tank(entry.table, entry.name)?);
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
fn tank(table: &Table<'_>, name: &str) -> Option<Tank> {
    let shape = of_table(table, "shape", &SHAPES)?;
    let shape = shape.read.and_then(|read| read(table));
    let center = table.vector_or_zero("center", Dimension::LENGTH);
    let axis = table.read_or("axis", [0.0, 0.0, 1.0], |value| direction(&value));
    let contents = contents(table);
    let density = table.read("density", "density = 1000.0", |value| value.positive(Dimension::DENSITY));
    let damping = damping(table);
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
    match (table.get("damping_ratio"), table.get("kinematic_viscosity")) {
        (Some(ratio), viscosity) => {
            let ratio = ratio.non_negative(Dimension::NUMBER);
            viscosity.map_or(Some(()), |value| value.positive(Dimension::KINEMATIC_VISCOSITY).map(drop))?;
            ratio.map(TankDamping::Ratio)
        }
        (None, _) => table
            .required("kinematic_viscosity", "kinematic_viscosity = \"1 cSt\", or damping_ratio = 0.01")?
            .positive(Dimension::KINEMATIC_VISCOSITY)
            .map(TankDamping::WallLayer),
    }
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

fn sphere(table: &Table<'_>) -> Option<TankShape> {
    Some(TankShape::Ellipsoid { semi_axes: [length(table, "radius", "radius = 0.5")?; 3] })
}

fn ellipsoid(table: &Table<'_>) -> Option<TankShape> {
    let semi_axes = table.required("semi_axes", "semi_axes = [0.5, 0.5, 0.35]")?;
    Some(TankShape::Ellipsoid {
        semi_axes: semi_axes.array("numbers", |item| item.positive(Dimension::LENGTH))?,
    })
}

fn cylinder(table: &Table<'_>) -> Option<TankShape> {
    let (radius, height) = (length(table, "radius", "radius = 0.3"), length(table, "height", "height = 0.8"));
    Some(TankShape::Cylinder { radius: radius?, height: height? })
}

fn capsule(table: &Table<'_>) -> Option<TankShape> {
    let (radius, height) = (length(table, "radius", "radius = 0.3"), length(table, "height", "height = 0.8"));
    Some(TankShape::Capsule { radius: radius?, height: height? })
}

fn cone(table: &Table<'_>) -> Option<TankShape> {
    let radii = table.required("radii", "radii = [0.1, 0.4]");
    let radii = radii.and_then(|value| value.array("numbers", |item| item.non_negative(Dimension::LENGTH)));
    let height = length(table, "height", "height = 0.5");
    Some(TankShape::Cone { radii: radii?, height: height? })
}

fn profile(table: &Table<'_>) -> Option<TankShape> {
    let example = "profile = [[0, -0.5], [0.4, -0.3], [0.4, 0.3], [0, 0.5]]";
    let value = table.required("profile", example)?;
    let points = value.list("a list of pairs of distance from the axis and height", |pair| {
        pair.numbers::<2>(Dimension::LENGTH)
    })?;
    Some(TankShape::Profile { points })
}

fn length(table: &Table<'_>, key: &'static str, example: &str) -> Option<f64> {
    table.read(key, example, |value| value.positive(Dimension::LENGTH))
}
