//! Kinds of elements that a user describes, a file or a folder each. What they give to a body is in
//! [`contribution`](super::contribution); their list, which makes ids, words and the lists of an assembly, is in [`elements`](super).

pub(crate) mod appendage;
pub(crate) mod application_point;
pub(crate) mod boom;
pub(crate) mod bushing;
pub(crate) mod carrier;
pub(crate) mod cavity;
pub(crate) mod coefficient;
pub(crate) mod compliance;
pub(crate) mod controller;
pub(crate) mod ellipsoid;
pub(crate) mod force;
pub(crate) mod hinged;
pub(crate) mod network;
pub(crate) mod part;
pub(crate) mod point;
pub(crate) mod prescribed;
pub(crate) mod ritz;
pub(crate) mod rod;
pub(crate) mod rotor;
pub(crate) mod spring;
pub(crate) mod surface;
pub(crate) mod tank;
pub(crate) mod tube;
pub(crate) mod wheel;
