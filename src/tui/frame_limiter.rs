//! When the next frame may be drawn, and how long the loop may wait.

use std::time::{Duration, Instant};

use super::config;

/// The pace of the screen: not more frames a second than the user wants.
#[derive(Debug)]
pub(super) struct Pace {
    /// How long after an `Esc` the rest of a sequence may come.
    esc: Duration,
    /// How far frames are apart at least.
    frame: Duration,
    /// When the last frame was drawn.
    last: Option<Instant>,
    /// True when something changed that has not been drawn.
    owed: bool,
}

/// Nothing is to be waited for.
const LONG: Duration = Duration::from_secs(3600);

impl Pace {
    pub(super) fn new(screen: &config::Screen) -> Self {
        let frame = Duration::from_secs(1) / screen.fps.max(1);
        Self { esc: Duration::from_millis(screen.esc_timeout_ms), frame, last: None, owed: false }
    }

    /// How long to wait for the next event: for the rest of a sequence, or until a frame may be drawn that is owed,
    /// if the screen is `free`.
    pub(super) fn patience(&self, sequence: bool, free: bool) -> Duration {
        let esc = if sequence { self.esc } else { LONG };
        if self.owed && free { esc.min(self.left()) } else { esc }
    }

    /// True when a frame is owed.
    pub(super) fn owes(&self) -> bool {
        self.owed
    }

    /// True when a frame is owed and may be drawn now, if the screen is `free` for it.
    pub(super) fn frame_is_due(&self, free: bool) -> bool {
        self.owed && free && self.left().is_zero()
    }

    /// Whether to draw now, when something has `changed` or a frame was owed, and the screen is `free`. Counts it as
    /// drawn.
    pub(super) fn draws(&mut self, changed: bool, free: bool) -> bool {
        self.owed |= changed;
        let now = self.frame_is_due(free);
        if now {
            (self.last, self.owed) = (Some(Instant::now()), false);
        }
        now
    }

    fn left(&self) -> Duration {
        self.last.map_or(Duration::ZERO, |last| self.frame.saturating_sub(last.elapsed()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_frame_comes_at_once_and_the_next_is_owed() {
        // One frame in an hour: no machine is so busy that the second one is due.
        let mut pace = Pace { esc: Duration::from_millis(30), frame: LONG, last: None, owed: false };
        assert_eq!((pace.draws(false, true), pace.draws(true, true), pace.draws(true, true)), (false, true, false));
        assert!(pace.patience(false, true) <= LONG && !pace.frame_is_due(true));
        assert_eq!(pace.patience(true, true), Duration::from_millis(30));
        // Nothing owed, nothing waited for.
        let mut idle = Pace { frame: Duration::ZERO, ..pace };
        assert!(idle.draws(false, true) && !idle.draws(false, true));
        assert_eq!(idle.patience(false, true), LONG);
    }

    #[test]
    fn a_screen_that_has_not_taken_the_last_frame_gets_no_other_and_none_is_waited_for() {
        let mut pace = Pace { esc: Duration::from_millis(30), frame: Duration::ZERO, last: None, owed: false };
        assert!(!pace.draws(true, false) && pace.owes() && !pace.frame_is_due(false));
        assert_eq!(pace.patience(false, false), LONG);
        assert!(pace.frame_is_due(true) && pace.draws(false, true) && !pace.owes());
    }
}
