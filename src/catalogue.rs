//! How a family of entries is declared: the modules of the family and the list of their entries, in one place.

/// Declares a module for each name and collects their entries in `ALL`, in the order of the names; `find` looks one up by id.
///
/// The formatter does not follow modules that a macro declares; `.ci/run` hands it every file by name.
macro_rules! catalogue {
    ($(#[$doc:meta])* $entry:ident: $($visibility:vis $module:ident),+ $(,)?) => {
        $($visibility mod $module;)+

        $(#[$doc])*
        pub static ALL: &[&$entry] = &[$(&$module::ENTRY),+];

        /// The entry with this id.
        pub fn find(id: &str) -> Option<&'static $entry> {
            ALL.iter().copied().find(|entry| entry.id == id)
        }
    };
}
