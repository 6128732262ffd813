//! Kinds of elements that a user describes, a file or a folder each. Code that several of them share to become a body is in
//! [`assembly`](super::assembly); their list, which makes ids, words and the lists of an assembly, is in [`elements`](super).

pub(crate) mod bushing;
pub(crate) mod carrier;
pub(crate) mod cavity;
pub(crate) mod ellipsoid;
pub(crate) mod force;
pub(crate) mod hinged;
pub(crate) mod material;
pub(crate) mod network;
pub(crate) mod part;
pub(crate) mod point;
pub(crate) mod rotor;
pub(crate) mod spring;
pub(crate) mod station;
pub(crate) mod surface;
pub(crate) mod wheel;
