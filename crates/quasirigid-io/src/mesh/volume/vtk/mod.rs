//! Unstructured grids of VTK: legacy files and XML files.

mod array;
mod data;
mod grid;
mod legacy;
mod poly;
mod xml;

use super::draft::finite;
use super::problem::VolumeProblem;
use super::sets::Sets;
use crate::mesh::error::{Fault, MeshProblem, Part, Place, Row};
pub(in crate::mesh) use legacy::poly::read as read_legacy_polygons;
pub(super) use legacy::read as read_legacy;
pub(in crate::mesh) use xml::poly::read as read_xml_polygons;
pub(super) use xml::read as read_xml;
