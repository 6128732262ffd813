//! Partial settings: structs whose every field may be absent, and the one rule by which two sources merge.

/// Defines partial settings. The first source to give a field decides it.
macro_rules! partial {
    ($(#[$about:meta])* $Name:ident { $($(#[$meaning:meta])* $field:ident: $Type:ty,)+ }) => {
        $(#[$about])*
        #[derive(Clone, Debug, Default, PartialEq)]
        pub struct $Name {
            $($(#[$meaning])* pub $field: Option<$Type>,)+
        }

        impl $Name {
            /// These settings, and those of another source where they are absent.
            #[must_use]
            pub fn or(self, other: Self) -> Self {
                Self { $($field: self.$field.or(other.$field),)+ }
            }
        }
    };
}

pub(super) use partial;
