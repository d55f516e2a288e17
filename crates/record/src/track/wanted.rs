//! Is this record still wanted?

/// Asked by a loader, before each piece of its work, whether anybody still waits for the record.
#[derive(Clone, Copy)]
pub struct Wanted<'a>(&'a (dyn Fn() -> bool + Sync));

impl<'a> Wanted<'a> {
    /// Loading that runs to its end.
    #[must_use]
    pub fn always() -> Self {
        Self(&|| true)
    }

    /// Loading that is wanted for as long as `wanted` says so; once it has said no, it must not say yes again.
    #[must_use]
    pub fn as_long_as(wanted: &'a (dyn Fn() -> bool + Sync)) -> Self {
        Self(wanted)
    }

    /// True when somebody waits for it.
    #[must_use]
    pub fn still(&self) -> bool {
        (self.0)()
    }
}

impl std::fmt::Debug for Wanted<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Wanted")
    }
}
