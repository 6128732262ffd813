//! Kinds of elements: one list of an assembly each, walked as one.

/// Defines the lists of an [`Assembly`](super::Assembly) and the kinds of their elements: `list: Kind(Type) = "words for one", role, field of the name;`.
macro_rules! kinds {
    ($($(#[$doc:meta])* $list:ident: $kind:ident($type:ty) = $words:literal, $role:expr $(, $name:ident)?;)+) => {
        /// Kind of an element.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum ElementKind {
            /// The carrier.
            Carrier,
            $($(#[$doc])* $kind,)+
            /// The support.
            Support,
            /// The magnetic field.
            MagneticField,
        }

        impl ElementKind {
            /// Words for one element of the kind.
            #[must_use]
            pub fn words(self) -> &'static str {
                match self {
                    Self::Carrier => "carrier",
                    $(Self::$kind => $words,)+
                    Self::Support => "support",
                    Self::MagneticField => "magnetic field",
                }
            }

            /// Place of an element of the kind among the others.
            pub(crate) fn role(self) -> Role {
                match self {
                    Self::Carrier => Role::Mass,
                    $(Self::$kind => $role,)+
                    Self::Support | Self::MagneticField => Role::External,
                }
            }
        }

        /// A body as the user describes it: a carrier with points, springs, hinged appendages and parts of finite elements on it,
        /// or a body without a carrier that is elastic throughout.
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[derive(Clone, Debug, Default, PartialEq)]
        pub struct Assembly {
            /// Carrier: the rigid body that everything else is mounted on; none of a body that is elastic throughout.
            pub carrier: Option<Carrier>,
            $($(#[$doc])* pub $list: Vec<$type>,)+
            /// Number of coordinates that parts of finite elements are given.
            pub reduction: PartReduction,
            /// Support of the body.
            pub support: Support,
            /// Magnetic field that controllers sense and act by; none without one. A force has a field of its own. (Y8)
            pub magnetic_field: Option<MagneticField>,
            /// What was observed of the body in rotation; none where its shape is that of the relaxed body.
            pub as_observed: Option<ObservedShape>,
        }

        $(impl element::Named for $type {
            $(fn name(&self) -> &str {
                &self.$name
            })?
        })+

        $(impl AssemblyElement for $type {
            fn add_to(self, assembly: &mut Assembly) -> ElementId {
                assembly.$list.push(self);
                ElementKind::$kind.at(assembly.$list.len() - 1)
            }
        })+

        impl Assembly {
            /// Elements, list by list.
            pub(crate) fn each(&self) -> impl Iterator<Item = (ElementId, &dyn element::Element)> {
                std::iter::empty()
                    $(.chain(self.$list.iter().enumerate().map(
                        |(index, element)| (ElementKind::$kind.at(index), element as &dyn element::Element)
                    )))+
            }

            /// Elements to be changed, list by list.
            pub(crate) fn each_mut(&mut self) -> impl Iterator<Item = (ElementId, &mut dyn element::Element)> {
                std::iter::empty()
                    $(.chain(self.$list.iter_mut().enumerate().map(
                        |(index, element)| (ElementKind::$kind.at(index), element as &mut dyn element::Element)
                    )))+
            }

            /// An element, if the body has it in a list.
            pub(crate) fn element(&self, ElementId { kind, index }: ElementId) -> Option<&dyn element::Element> {
                match kind {
                    $(ElementKind::$kind => self.$list.get(index).map(|element| element as &dyn element::Element),)+
                    ElementKind::Carrier | ElementKind::Support | ElementKind::MagneticField => None,
                }
            }
        }
    };
}

/// An element of an [`Assembly`](super::Assembly): its kind, and its index in the list of that kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ElementId {
    /// Kind of the element.
    pub kind: super::ElementKind,
    /// Index in the list of the kind; 0 where a body has one of the kind at most.
    pub index: usize,
}

impl super::ElementKind {
    /// The element of the kind with an index.
    #[must_use]
    pub const fn at(self, index: usize) -> ElementId {
        ElementId { kind: self, index }
    }

    /// Whether a body has one of the kind at most.
    #[must_use]
    pub fn is_single(self) -> bool {
        matches!(self, Self::Carrier | Self::Support | Self::MagneticField)
    }
}

impl ElementId {
    /// The carrier.
    pub const CARRIER: Self = super::ElementKind::Carrier.at(0);
    /// The support.
    pub const SUPPORT: Self = super::ElementKind::Support.at(0);
    /// The magnetic field.
    pub const MAGNETIC_FIELD: Self = super::ElementKind::MagneticField.at(0);
}

impl std::fmt::Display for ElementId {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.kind.is_single() {
            true => write!(f, "{}", self.kind.words()),
            false => write!(f, "{} {}", self.kind.words(), self.index + 1),
        }
    }
}
