//! Records that the program carries with it.

use std::sync::Arc;

use super::Source;

/// The name of the demonstration record in a session file.
const DEMO: &str = "wildpoint:demo";

impl Source {
    /// The built-in record of this name.
    #[must_use]
    pub fn built_in(name: &str) -> Option<Self> {
        // Simulated by `wildpoint simulate demo`; a test holds the two together.
        (name == DEMO)
            .then(|| Self::BuiltIn { name: DEMO, bytes: Arc::from(&include_bytes!("../../../../data/demo.csv")[..]) })
    }

    /// The demonstration record.
    #[must_use]
    pub fn demo() -> Self {
        Self::built_in(DEMO).unwrap_or(Self::BuiltIn { name: DEMO, bytes: Arc::from(&b""[..]) })
    }

    /// Its name for people: the file name, or the built-in name.
    #[must_use]
    pub fn name(&self) -> String {
        match self {
            Self::File(path) => {
                path.file_name().map_or_else(|| path.to_string_lossy(), |n| n.to_string_lossy()).into_owned()
            }
            Self::BuiltIn { name, .. } => (*name).to_owned(),
        }
    }

    /// The file, where it is one.
    #[must_use]
    pub fn path(&self) -> Option<&std::path::Path> {
        match self {
            Self::File(path) => Some(path),
            Self::BuiltIn { .. } => None,
        }
    }
}
