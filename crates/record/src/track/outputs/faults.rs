//! Places at which a test makes the disk fail. In the program itself nothing ever fails here.

use std::io::{Result, Write};

/// A writer to the disk: each write and flush is a place at which it may fail, a write with half of its bytes
/// written.
pub(super) struct Disk<W>(pub(super) W);

impl<W: Write> Write for Disk<W> {
    fn write(&mut self, bytes: &[u8]) -> Result<usize> {
        if let Err(e) = point() {
            self.0.write_all(bytes.get(..bytes.len() / 2).unwrap_or_default())?;
            return Err(e);
        }
        self.0.write(bytes)
    }

    fn flush(&mut self) -> Result<()> {
        point()?;
        self.0.flush()
    }
}

#[cfg(not(any(test, feature = "faults")))]
#[expect(clippy::unnecessary_wraps, reason = "under test it can fail")]
pub(super) fn point() -> Result<()> {
    Ok(())
}

#[cfg(any(test, feature = "faults"))]
pub(super) use scripted::point;
#[cfg(any(test, feature = "faults"))]
pub use scripted::{fail_at, passed};

#[cfg(any(test, feature = "faults"))]
mod scripted {
    use std::cell::Cell;

    thread_local! {
        static PASSED: Cell<usize> = const { Cell::new(0) };
        static FAILS: Cell<Option<usize>> = const { Cell::new(None) };
    }

    /// Counts from here on; the place with this number (from 0) fails, once.
    pub fn fail_at(number: Option<usize>) {
        PASSED.set(0);
        FAILS.set(number);
    }

    /// How many places have been passed, the failed one among them.
    pub fn passed() -> usize {
        PASSED.get()
    }

    pub(in super::super) fn point() -> std::io::Result<()> {
        let here = PASSED.replace(PASSED.get() + 1);
        if FAILS.get() == Some(here) { Err(std::io::ErrorKind::StorageFull.into()) } else { Ok(()) }
    }
}
