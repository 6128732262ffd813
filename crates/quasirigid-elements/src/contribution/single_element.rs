use crate::contribution::Matrices;
use crate::error::{ElementError, ElementId, Field, Problem, at};
use crate::model::{BodyParts, Coordinate, FlexibleBody, Invariants, Marker, Support, Wheels};
use crate::structure::Block;
use crate::visual::Visual;
use crate::{Condensation, Resolution};

/// Free body of a single element, elastic throughout, in its Tisserand frame.
pub(crate) struct SingleElementBody {
    pub place: ElementId,
    /// Centre of mass (m), in the file's frame.
    pub center: [f64; 3],
    pub invariants: Invariants,
    pub block: Block,
    pub coordinates: Vec<Coordinate>,
    pub markers: Vec<Marker>,
}

/// Body of a single element, with the approximation that was used.
pub(crate) struct WholeBody {
    pub body: FlexibleBody,
    pub condensation: Option<Condensation>,
    pub resolution: Option<Resolution>,
    pub visuals: Vec<Visual>,
}

impl SingleElementBody {
    /// The body.
    pub fn body(self) -> Result<FlexibleBody, ElementError> {
        let Self { place, center, invariants, block, coordinates, markers } = self;
        let Matrices { stiffness, damping, viscoelastic, dissipators } =
            Matrices::sum(coordinates.len(), std::iter::once(Ok(block)), &[])?;
        FlexibleBody::new(BodyParts {
            support: Support::Free,
            pole: center,
            center_of_mass: center,
            invariants,
            damping,
            stiffness,
            viscoelastic,
            dissipators,
            memories: Vec::new(),
            coordinates,
            cyclic: 0,
            wheels: Wheels::default(),
            drives: Vec::new(),
            markers,
        })
        .map_err(|error| at(place, Field::YOUNG)(Problem::Mechanism { coordinates: error.coordinates() }))
    }
}
