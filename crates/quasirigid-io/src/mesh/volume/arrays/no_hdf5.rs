//! HDF5 in a program that was built without it: no file is read.

use super::Arrays;
use crate::mesh::error::{Fault, Place};
use crate::mesh::volume::problem::VolumeProblem;

/// An HDF5 file, of which there is none.
pub(in crate::mesh::volume) enum Hdf5 {}

impl Hdf5 {
    pub(in crate::mesh::volume) fn read(_bytes: &[u8]) -> Result<Self, Fault> {
        Err((Place::File, VolumeProblem::WithoutHdf5.into()))
    }

    pub(in crate::mesh::volume) fn groups(&self, _path: &str) -> Vec<String> {
        match *self {}
    }

    pub(in crate::mesh::volume) fn number(&self, _path: &str, _key: &str) -> Option<i64> {
        match *self {}
    }
}

impl Arrays for Hdf5 {
    fn lengths(&self, _name: &str) -> Option<Vec<usize>> {
        match *self {}
    }

    fn reals(&self, _name: &str) -> Result<Option<Vec<f64>>, Fault> {
        match *self {}
    }

    fn integers(&self, _name: &str) -> Result<Option<Vec<i64>>, Fault> {
        match *self {}
    }

    fn texts(&self, _name: &str) -> Result<Option<Vec<String>>, Fault> {
        match *self {}
    }

    fn attribute(&self, _name: &str, _key: &str) -> Option<String> {
        match *self {}
    }
}
