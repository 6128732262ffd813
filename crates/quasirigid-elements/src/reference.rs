//! References from one element to another, by index.

/// End of a spring: the element to which it is attached.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum End {
    /// The carrier.
    Carrier,
    /// The point with this index in [`Assembly::points`](crate::Assembly::points).
    Point(usize),
    /// A node of a part.
    Node(NodeRef),
    /// A place on a hinged appendage.
    Hinged(PlaceRef),
}

/// A node of a part.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct NodeRef {
    /// Index of the part in [`Assembly::parts`](crate::Assembly::parts).
    pub part: usize,
    /// Index of the node in it.
    pub node: usize,
}

/// A place on a hinged appendage.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PlaceRef {
    /// Index of the appendage.
    pub hinged: usize,
    /// Index of the place in its list.
    pub place: usize,
}
