use thiserror::Error;

/// Reasons for which a partly full tube is not answered.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq)]
pub enum TubeError {
    /// A tube that is not slender.
    #[error(
        "the tube has {curvature:.3} times the radius of the ring; the slug of a slender ring, up to {most}, is known"
    )]
    Thick {
        /// Radius of the tube over that of the ring.
        curvature: f64,
        /// Greatest that is answered.
        most: f64,
    },
    /// A direction of the liquid along the axis of the ring.
    #[error("the direction of the liquid is along the axis of the ring")]
    AlongAxis,
}

impl TubeError {
    /// Label for the place in a model file, and a remedy.
    pub(crate) fn told(&self) -> (&'static str, &'static str) {
        match self {
            Self::Thick { .. } => (
                "not slender",
                "take the mean radius of the ring and the inner radius of the tube; a full ring is a [[cavity]] of shape \"ring\"",
            ),
            Self::AlongAxis => (
                "along the axis",
                "give a direction across `axis`, from the centre of the ring to the middle of the liquid",
            ),
        }
    }
}
