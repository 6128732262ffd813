//! Names that most programs need: `use quasirigid::prelude::*;`

pub use crate::averaging::{Evolution, FreeRotation, PowerSource, Response, RotationState};
pub use crate::dynamics::{
    Event, Forced, Form, FullState, Method, Observer, Options, Outcome, Rounding, Sample, Start, propagate,
    propagate_full, spin_path, spin_paths, steady_spins,
};
pub use crate::elements::{
    Assembly, AssemblyElement, CARRIER, Carrier, ElementId, Ellipsoid, End, Hinged, Material, Point,
    PointMotion, Spring,
};
pub use crate::math::rotation::{ALIGNED, angle};
pub use crate::math::vec3::norm;
pub use crate::model::{FlexibleBody, Mode, Principal, ReducedBody, Rheology};
pub use crate::modes::{RelativeEquilibrium, SpinMagnitude, SpinModes};
pub use crate::reduction::{Validity, Verdict, reduce};
pub use crate::verification::{Difference, Verification, VerificationPlan, verify};
