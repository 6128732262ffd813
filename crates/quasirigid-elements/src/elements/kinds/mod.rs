//! Kinds of elements that a user describes, a file or a folder each. Code that several of them share to become a body is in
//! [`assembly`](super::assembly); their list, which makes ids, words and the lists of an assembly, is in [`elements`](super).

pub(in crate::elements) mod bushing;
pub(in crate::elements) mod carrier;
pub(in crate::elements) mod cavity;
pub(in crate::elements) mod ellipsoid;
pub(in crate::elements) mod force;
pub(in crate::elements) mod hinged;
pub(in crate::elements) mod material;
pub(in crate::elements) mod network;
pub(in crate::elements) mod part;
pub(in crate::elements) mod point;
pub(in crate::elements) mod rotor;
pub(in crate::elements) mod spring;
pub(in crate::elements) mod station;
pub(in crate::elements) mod surface;
pub(in crate::elements) mod wheel;
