//! Is this work still wanted?
//!
//! Long computations ask [`Stop::check`] every few thousand samples and return [`Stopped`] when a newer
//! request has taken their place, so that no result is computed that nobody waits for.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// The work was abandoned.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stopped;

impl From<Stopped> for crate::error::Error {
    fn from(_: Stopped) -> Self {
        Self::Stopped
    }
}

/// Asked by a computation whether anybody still waits for it.
#[derive(Debug, Clone, Default)]
pub struct Stop(Wanted);

#[derive(Debug, Clone, Default)]
enum Wanted {
    #[default]
    Always,
    /// As long as the number is this one.
    While(Arc<AtomicU64>, u64),
    /// Until this says otherwise.
    Asked(Question),
}

/// Asked at each look: true when the work is no longer wanted.
#[derive(Clone)]
struct Question(Arc<dyn Fn() -> bool + Send + Sync>);

impl std::fmt::Debug for Question {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Question")
    }
}

impl Stop {
    /// How many samples a loop may handle between two calls of [`Stop::check`]: well under a millisecond of work.
    pub const STRIDE: usize = 4096;

    /// Work that runs to its end.
    #[must_use]
    pub fn never() -> Self {
        Self(Wanted::Always)
    }

    /// Work of `generation`, wanted for as long as `newest` holds that number.
    #[must_use]
    pub fn when_superseded(newest: Arc<AtomicU64>, generation: u64) -> Self {
        Self(Wanted::While(newest, generation))
    }

    /// Work that is wanted for this many looks and no longer: `left` says how many of them were not taken. With it a
    /// test sees how often a computation looks.
    #[must_use]
    pub fn after_looks(left: Arc<AtomicU64>) -> Self {
        Self::asking(move || {
            left.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |left| left.checked_sub(1)).is_err()
        })
    }

    /// Work that is no longer wanted as soon as `gone` says so, which is asked at each look.
    #[must_use]
    pub fn asking(gone: impl Fn() -> bool + Send + Sync + 'static) -> Self {
        Self(Wanted::Asked(Question(Arc::new(gone))))
    }

    /// True when the work is no longer wanted.
    #[must_use]
    #[inline]
    pub fn requested(&self) -> bool {
        match &self.0 {
            Wanted::Always => false,
            Wanted::While(newest, mine) => newest.load(Ordering::Relaxed) != *mine,
            Wanted::Asked(Question(gone)) => gone(),
        }
    }

    /// An error when the work is no longer wanted.
    ///
    /// # Errors
    /// [`Stopped`] when it is not.
    #[inline]
    pub fn check(&self) -> Result<(), Stopped> {
        if self.requested() { Err(Stopped) } else { Ok(()) }
    }

    /// [`Stop::check`] at every [`Stop::STRIDE`]-th index.
    ///
    /// # Errors
    /// [`Stopped`] when the work is no longer wanted.
    #[inline]
    pub fn check_at(&self, index: usize) -> Result<(), Stopped> {
        if index.is_multiple_of(Self::STRIDE) { self.check() } else { Ok(()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_newer_generation_stops_the_older_one() {
        let newest = Arc::new(AtomicU64::new(3));
        let stop = Stop::when_superseded(Arc::clone(&newest), 3);
        assert_eq!(stop.check(), Ok(()));
        newest.store(4, Ordering::Relaxed);
        assert_eq!(stop.check(), Err(Stopped));
        assert_eq!(Stop::never().check(), Ok(()));
    }

    #[test]
    fn looks_run_out() {
        let left = Arc::new(AtomicU64::new(2));
        let stop = Stop::after_looks(Arc::clone(&left));
        assert_eq!(
            [stop.check(), stop.check(), stop.check(), stop.check()],
            [Ok(()), Ok(()), Err(Stopped), Err(Stopped)]
        );
        assert_eq!(left.load(Ordering::Relaxed), 0);
    }
}
