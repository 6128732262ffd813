//! PLY: vertices and faces, among any other elements and properties, in any order.
//! Unknown elements are read and dropped rather than skipped, since the length of a list stands in the file before each list.

mod header;
mod values;

use super::TriangleMesh;
use super::draft::Draft;
use super::error::{Fault, MeshProblem, Part};
use crate::mesh::file::Encoding;
use header::{Element, Header, Kind};
use values::{Binary, Text, Values};

/// PLY: vertices and faces, among any other elements and properties, in any order.
pub(super) fn read(bytes: &[u8]) -> Result<TriangleMesh, Fault> {
    let header = Header::read(bytes)?;
    match header.encoding {
        Encoding::Text => elements(&header, Text::new(bytes, &header)?),
        Encoding::LittleEndian => elements(&header, Binary::new(bytes, &header, false)),
        Encoding::BigEndian => elements(&header, Binary::new(bytes, &header, true)),
    }
}

fn elements(header: &Header, mut values: impl Values) -> Result<TriangleMesh, Fault> {
    let mut mesh = Draft::new();
    let vertices = header.vertices();
    for element in &header.elements {
        if element.properties.is_empty() {
            continue; // takes no place in the file, however many there are
        }
        values.announce(element);
        match element.part {
            Part::Vertices => read_vertices(element, &mut values, &mut mesh)?,
            Part::Faces => read_faces(element, vertices, &mut values, &mut mesh)?,
            _ => {
                for _ in 0..element.count {
                    read_element(element, &mut values, |_, _, _| Ok(()))?;
                }
            }
        }
    }
    let last = header.elements.iter().rfind(|element| !element.properties.is_empty());
    if let (Some(place), Some(last)) = (values.surplus(), last) {
        return Err((place, MeshProblem::Surplus { part: last.part.clone(), announced: last.count }));
    }
    mesh.finish(0)
}

fn read_vertices(element: &Element, values: &mut impl Values, mesh: &mut Draft) -> Result<(), Fault> {
    let axis_of = element.axes();
    for _ in 0..element.count {
        let mut vertex = [0.0; 3];
        read_element(element, values, |property, value, values| {
            if let Some(axis) = axis_of.iter().position(|axis| *axis == property) {
                if !value.is_finite() {
                    return Err((values.place(), MeshProblem::NotFinite { found: value.to_string().into() }));
                }
                vertex[axis] = value;
            }
            Ok(())
        })?;
        mesh.vertices.push(vertex);
    }
    Ok(())
}

fn read_faces(
    element: &Element,
    vertices: usize,
    values: &mut impl Values,
    mesh: &mut Draft,
) -> Result<(), Fault> {
    let list = element.corners();
    let mut corners = Vec::new();
    for _ in 0..element.count {
        corners.clear();
        read_element(element, values, |property, value, values| {
            if property == list {
                if value.fract() != 0.0 || !(0.0..vertices as f64).contains(&value) {
                    let problem =
                        MeshProblem::NoSuchVertex { found: value.to_string().into(), first: 0, vertices };
                    return Err((values.place(), problem));
                }
                corners.push(value as u32);
            }
            Ok(())
        })?;
        mesh.polygon(&corners, 0);
    }
    Ok(())
}

/// Reads an element and shows each value, entries of lists too, with the index of the property.
fn read_element<V: Values>(
    element: &Element,
    values: &mut V,
    mut show: impl FnMut(usize, f64, &V) -> Result<(), Fault>,
) -> Result<(), Fault> {
    values.start()?;
    for (index, property) in element.properties.iter().enumerate() {
        match property.kind {
            Kind::Scalar(scalar) => {
                let value = values.next(scalar)?;
                show(index, value, values)?;
            }
            Kind::List { length, item } => {
                let found = values.next(length)?;
                if found.fract() != 0.0 || !(0.0..=u32::MAX.into()).contains(&found) {
                    return Err((
                        values.place(),
                        MeshProblem::ListLength { found: found.to_string().into() },
                    ));
                }
                for _ in 0..found as u64 {
                    let value = values.next(item)?;
                    show(index, value, values)?;
                }
            }
        }
    }
    values.finish()
}
