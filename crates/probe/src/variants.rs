//! The names of the variants of an event enum, from one list that the compiler holds complete.

/// Gives an enum `VARIANTS`, the names of all its variants in order, and `variant()`, the name of
/// the one at hand. A variant that is left out does not compile.
///
/// ```
/// enum Event {
///     Started { at: u32 },
///     Stopped,
/// }
/// probe::variants!(Event: Started, Stopped);
/// assert_eq!(Event::VARIANTS, ["Started", "Stopped"]);
/// assert_eq!(Event::Started { at: 3 }.variant(), "Started");
/// # let _ = Event::Stopped;
/// ```
#[macro_export]
macro_rules! variants {
    ($event:ty: $($variant:ident),+ $(,)?) => {
        impl $event {
            /// The names of all variants, in the order in which they are declared.
            pub const VARIANTS: &'static [&'static str] = &[$(stringify!($variant)),+];

            /// The name of the variant.
            pub fn variant(&self) -> &'static str {
                match self {
                    $(Self::$variant { .. } => stringify!($variant),)+
                }
            }
        }
    };
}
