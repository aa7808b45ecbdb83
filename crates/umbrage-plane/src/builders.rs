/// Gives a struct of parameters a `with_<field>` method for each field: how code outside its crate sets one and keeps the rest, and
/// goes on compiling when a field is added.
#[doc(hidden)]
#[macro_export]
macro_rules! builders {
    ([$($generic:ident),*] $type:ty { $($with:ident $field:ident: $of:ty),+ $(,)? }) => {
        impl<$($generic),*> $type {
            $(
                #[doc = concat!("The same with another [`", stringify!($field), "`](Self#structfield.", stringify!($field), ").")]
                #[must_use]
                pub fn $with(mut self, $field: $of) -> Self {
                    self.$field = $field;
                    self
                }
            )+
        }
    };
}
