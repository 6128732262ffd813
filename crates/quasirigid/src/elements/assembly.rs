use super::{Carrier, Hinged, Point, Spring};
use crate::model::Support;

/// A body as the user describes it: a carrier with points, springs and hinged appendages on it.
#[derive(Clone, Debug, PartialEq)]
pub struct Assembly {
    /// The rigid body that carries everything else.
    pub carrier: Carrier,
    /// Material points.
    pub points: Vec<Point>,
    /// Springs and dashpots.
    pub springs: Vec<Spring>,
    /// Rigid appendages on hinges.
    pub hinged: Vec<Hinged>,
    /// How the body is held.
    pub support: Support,
}
