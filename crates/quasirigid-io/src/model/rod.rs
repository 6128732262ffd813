//! Hysteresis rod reader: `[[rod]]`. (Y10), (Y11)

use std::f64::consts::PI;

use quasirigid_body::control::{HysteresisLoop, HysteresisRod, demagnetization_of_spheroid};
use quasirigid_elements::ElementKind;

use super::key::{Keys, NUMBER, VECTOR, key, quantity};
use super::names::Part;
use super::reader::{Keyed, NAME, Naming, Reader};
use super::table::Table;
use crate::units::Dimension;

pub(super) const READER: Reader = Reader {
    key: "rod",
    title: "[[rod]]",
    meaning: "hysteresis rod",
    keys: Keyed::All(&ROD),
    kind: Some(ElementKind::Rod),
    naming: Naming::Apart("rod"),
    names: |_| Part::Throughout,
    aliases: &[],
    nested: &[],
    is_body: false,
    read: |entry, draft| {
        draft.assembly.rods.push(rod(entry.table, entry.name)?);
        Some(())
    },
};

const ROD: Keys = Keys {
    known: &[
        NAME,
        key("axis", VECTOR, "body axes"),
        key("length", quantity("m"), "with `diameter`"),
        key("diameter", quantity("m"), ""),
        key("volume", quantity("m³"), "instead, with `demagnetization`"),
        key("demagnetization", NUMBER.or("of the spheroid of this length and diameter"), "N, along the axis"),
        key("saturation", quantity("T"), "Bs of the material (Y10)"),
        key("remanence", quantity("T"), "Br"),
        key("coercivity", quantity("A/m"), "Hc"),
    ],
};

fn rod(table: &Table<'_>, name: &str) -> Option<HysteresisRod> {
    let axis = table.read("axis", "axis = [1, 0, 0]", |value| value.vector(Dimension::NUMBER));
    let size = size(table);
    let positive =
        |key, example: &str, dimension| table.read(key, example, |value| value.positive(dimension));
    let saturation = positive("saturation", "saturation = \"0.74 T\"", Dimension::MAGNETIC_FIELD);
    let remanence = positive("remanence", "remanence = \"0.35 T\"", Dimension::MAGNETIC_FIELD);
    let coercivity = positive("coercivity", "coercivity = \"1.59 A/m\"", Dimension::MAGNETIZING_FORCE);
    let (volume, demagnetization) = size?;
    let material = HysteresisLoop { saturation: saturation?, remanence: remanence?, coercivity: coercivity? };
    Some(HysteresisRod { name: name.to_owned(), axis: axis?, volume, demagnetization, material })
}

/// Volume (m³) and demagnetisation factor.
fn size(table: &Table<'_>) -> Option<(f64, f64)> {
    let factor = table.get("demagnetization").map(|value| value.non_negative(Dimension::NUMBER));
    if let Some(volume) = table.get("volume") {
        for key in ["length", "diameter"] {
            if let Some(other) = table.get(key) {
                let message = format!("`{key}` beside `volume`: the rod has its size twice");
                return other.refuse(message, "given twice", "leave out one of the two");
            }
        }
        let volume = volume.positive(Dimension::VOLUME);
        table.required(
            "demagnetization",
            "demagnetization = 1e-4, or length and diameter in place of volume",
        )?;
        return Some((volume?, factor??));
    }
    let [length, diameter] = [("length", "length = \"95 mm\""), ("diameter", "diameter = \"1 mm\"")]
        .map(|(key, example)| table.read(key, example, |value| value.positive(Dimension::LENGTH)));
    let (length, diameter) = (length?, diameter?);
    if length <= diameter {
        let message = format!("a rod of {length} m is no longer than its diameter of {diameter} m");
        return table.get("length")?.refuse(message, "no rod", "write the length along the axis");
    }
    let volume = 0.25 * PI * diameter * diameter * length;
    Some((volume, factor.unwrap_or_else(|| Some(demagnetization_of_spheroid(length / diameter)))?))
}
