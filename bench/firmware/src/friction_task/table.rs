//! Numbers for a tool outside: each with its name, meaning, unit and limits in one place.

/// A number of a table as a tool sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Field {
    /// Name in the source and for the tool.
    pub name: &'static str,
    /// What it is.
    pub description: &'static str,
    /// Its unit, empty for a plain number.
    pub unit: &'static str,
    /// Least value.
    pub minimum: f32,
    /// Largest value.
    pub maximum: f32,
}

/// A structure of numbers with a table of its fields: the documentation of a field is the description that the tool shows, the
/// limits are those that the program keeps.
macro_rules! table {
    (
        $(#[doc = $about:literal])+
        pub struct $name:ident, $fields:ident {
            $(
                $(#[doc = $text:literal])+
                $field:ident: $type:ty, $unit:literal, $least:literal to $most:literal;
            )+
        }
    ) => {
        $(#[doc = $about])+
        #[repr(C)]
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $name {
            $($(#[doc = $text])+ pub $field: $type,)+
        }

        /// The fields in their order.
        pub const $fields: [$crate::friction_task::table::Field; $name::LENGTH] = [
            $($crate::friction_task::table::Field {
                name: stringify!($field),
                description: concat!($($text),+),
                unit: $unit,
                minimum: $least,
                maximum: $most,
            }),+
        ];

        impl $name {
            /// How many numbers it has.
            pub const LENGTH: usize = [$(stringify!($field)),+].len();

            /// Their bits, in their order.
            #[must_use]
            pub const fn words(&self) -> [u32; Self::LENGTH] {
                [$($crate::friction_task::table::Word(self.$field).bits()),+]
            }

            /// The numbers with these bits, in their order.
            #[must_use]
            pub const fn of_words(words: [u32; Self::LENGTH]) -> Self {
                let [$($field),+] = words;
                Self {
                    $($field: $crate::friction_task::table::Word::<$type>::of($field).0,)+
                }
            }
        }
    };
}

pub(crate) use table;

/// A number of a table.
#[derive(Clone, Copy, Debug)]
pub struct Word<T>(pub T);

impl Word<f32> {
    /// The number with these bits.
    #[must_use]
    pub const fn of(bits: u32) -> Self {
        Self(f32::from_bits(bits))
    }

    /// Its bits.
    #[must_use]
    pub const fn bits(self) -> u32 {
        self.0.to_bits()
    }
}

impl Word<u32> {
    /// The number with these bits.
    #[must_use]
    pub const fn of(bits: u32) -> Self {
        Self(bits)
    }

    /// Its bits.
    #[must_use]
    pub const fn bits(self) -> u32 {
        self.0
    }
}
