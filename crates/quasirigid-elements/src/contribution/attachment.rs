//! Attachments: places of a body at which springs, forces and other links act, with the coordinates that displace and rotate them.

use std::collections::HashMap;

use nalgebra::Vector3;

use crate::End;
use crate::error::Problem;
use crate::model::{Carried, Marker};

/// Attachment: a place of a body at which a link or a force acts.
#[derive(Clone, Debug, Default)]
pub(crate) struct Attachment {
    pub name: String,
    /// Equilibrium position (m), in the file's frame; that of the carrier is its origin.
    pub position: Vector3<f64>,
    /// Coordinates that displace the place, with the displacement (m) per unit of each.
    pub shapes: Vec<(usize, [f64; 3])>,
    /// Coordinates that rotate the place, with the rotation (rad) per unit of each; none of a place without orientation.
    pub rotations: Option<Vec<(usize, [f64; 3])>>,
    /// Curvature of the path of the place for pairs of coordinates, where known.
    pub curvature: Vec<(usize, usize, [f64; 3])>,
    /// Rotation that carries the place, of a place on an appendage.
    pub carried: Option<Carried>,
}

/// Attachments of the elements of a body.
#[derive(Default)]
pub(crate) struct Attachments {
    of: HashMap<End, Attachment>,
}

impl Attachment {
    /// Place that no coordinate moves.
    pub fn at(position: Vector3<f64>, rotations: bool) -> Self {
        Self { position, rotations: rotations.then(Vec::new), ..Self::default() }
    }

    /// Marker of the place, from the pole.
    pub fn marker(&self, pole: Vector3<f64>) -> Marker {
        Marker {
            name: self.name.clone(),
            position: (self.position - pole).into(),
            shapes: self.shapes.clone(),
            rotations: self.rotations.clone().unwrap_or_default(),
            curvature: self.curvature.clone(),
            carried: self.carried.clone(),
        }
    }
}

impl Attachments {
    /// Attachment of an end of an element that was checked.
    ///
    /// # Errors
    /// [`Problem::NoCarrier`] for an end that was never noted: only the end on the carrier is not.
    pub fn of(&self, end: End) -> Result<&Attachment, Problem> {
        self.of.get(&end).ok_or(Problem::NoCarrier)
    }

    /// Notes an attachment.
    pub fn note(&mut self, end: End, attachment: Attachment) {
        self.of.insert(end, attachment);
    }

    /// Whether an end is noted.
    pub fn has(&self, end: End) -> bool {
        self.of.contains_key(&end)
    }
}
