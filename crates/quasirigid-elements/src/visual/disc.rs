//! Disc of a rotor or a wheel, whose size and place a model does not give: it has a share of the size of the carrier, at its centre.

use nalgebra::Vector3;

use super::outline::Outline;
use super::shapes::{revolved, rod};
use crate::Carrier;
use crate::number;

/// Radius and half the height of the disc over the radius of gyration of the carrier.
const RADIUS: f64 = 0.7;
const HALF_HEIGHT: f64 = 0.06;

/// Disc about an axis through the centre of the carrier.
pub(crate) fn disc(carrier: &Carrier, axis: [f64; 3]) -> Option<Outline> {
    let axis = number::unit(axis).ok()?;
    let piece = carrier.piece().ok()?;
    let size = (piece.second.trace().max(0.0) / carrier.mass).sqrt();
    let (radius, height) = (RADIUS * size, HALF_HEIGHT * size);
    let center: Vector3<f64> = carrier.position();
    let meridian = [[0.0, -height], [radius, -height], [radius, height], [0.0, height]];
    let outline = Outline::still(revolved(center, rod(axis), &meridian, false));
    Some(Outline { axis: Some((axis.into(), center.into())), ..outline })
}
