//! Magnetic tensor of a conducting body: given, or from a conductivity and a shape. (F15), (F16)

use quasirigid_body::force::{Conductor, ForceLaw};
use quasirigid_elements::ApplicationPoint;

use super::magnetic_field::{CommonField, field_of_force};
use super::table::Table;
use super::value::Value;
use crate::units::Dimension;

/// Shapes of conductors.
#[derive(Clone, Copy, PartialEq)]
enum Outline {
    Sphere,
    Shell,
}

const OUTLINES: [(&str, Outline); 2] = [("sphere", Outline::Sphere), ("shell", Outline::Shell)];

/// Reads a torque on eddy currents.
pub(super) fn eddy_current(table: &Table<'_>, common: CommonField) -> Option<ForceLaw<ApplicationPoint>> {
    let conductor = match (table.get("tensor"), table.get("conductivity")) {
        (None, Some(_)) => {
            of_metal(table).map(|metal| (isotropic(metal.magnetic_tensor()), metal.decay_time()))
        }
        _ => of_tensor(table).map(|tensor| (tensor, 0.0)),
    };
    let field = field_of_force(table, common);
    let (tensor, decay_time) = conductor?;
    Some(ForceLaw::EddyCurrent { tensor, decay_time, field: field? })
}

/// Reads a tensor: nine numbers, or one for every axis.
fn of_tensor(table: &Table<'_>) -> Option<[[f64; 3]; 3]> {
    let help = "tensor = \"5662 S m^4\", or conductivity = \"25 MS/m\" with shape, radius and thickness";
    let value = table.required("tensor", help)?;
    for key in ["conductivity", "shape", "radius", "thickness"] {
        if let Some(other) = table.get(key) {
            let message = format!("`{key}` says what the `tensor` is already");
            return other.refuse(message, "given twice", "leave out one of the two");
        }
    }
    if value.is_array() {
        return value.matrix(Dimension::MAGNETIC_TENSOR);
    }
    value.non_negative(Dimension::MAGNETIC_TENSOR).map(isotropic)
}

/// Reads a solid of one metal.
fn of_metal(table: &Table<'_>) -> Option<Conductor> {
    let positive = |key, example: &str, dimension| {
        table.read(key, example, |value: Value<'_>| value.positive(dimension))
    };
    let conductivity = positive("conductivity", "conductivity = \"25 MS/m\"", Dimension::CONDUCTIVITY);
    let outline =
        table.read("shape", "shape = \"sphere\", or shape = \"shell\"", |value| value.choice(&OUTLINES));
    let radius = positive("radius", "radius = \"30 cm\"", Dimension::LENGTH);
    match outline? {
        Outline::Sphere => {
            if let Some(thickness) = table.get("thickness") {
                let message = "`thickness` is that of a shell, and this sphere is solid";
                return thickness.refuse(
                    message,
                    "not for a sphere",
                    "leave it out, or write shape = \"shell\"",
                );
            }
            Some(Conductor::Sphere { conductivity: conductivity?, radius: radius? })
        }
        Outline::Shell => {
            let thickness = positive("thickness", "thickness = \"15 mm\"", Dimension::LENGTH);
            let (conductivity, radius, thickness) = (conductivity?, radius?, thickness?);
            if thickness > radius {
                let message = format!("`thickness` is {thickness} m, and the outer radius is {radius} m");
                let help = "write less than the radius, or shape = \"sphere\"";
                return table.get("thickness")?.refuse(message, "more than the radius", help);
            }
            Some(Conductor::Shell { conductivity, radius, thickness })
        }
    }
}

fn isotropic(value: f64) -> [[f64; 3]; 3] {
    [[value, 0.0, 0.0], [0.0, value, 0.0], [0.0, 0.0, value]]
}
