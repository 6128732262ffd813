//! Unstructured grids of VTK: legacy files and XML files.

mod array;
mod data;
mod grid;
mod legacy;
mod xml;

use super::draft::finite;
use super::problem::VolumeProblem;
use super::sets::Sets;
use crate::mesh::error::{Fault, MeshProblem, Part, Place, Row};
pub(super) use legacy::read as read_legacy;
pub(super) use xml::read as read_xml;
