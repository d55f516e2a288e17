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

    /// How long to wait for the next event: for the rest of a sequence, or until a frame may be drawn that is owed.
    pub(super) fn patience(&self, sequence: bool) -> Duration {
        let esc = if sequence { self.esc } else { LONG };
        if self.owed { esc.min(self.left()) } else { esc }
    }

    /// True when a frame is owed and may be drawn now.
    pub(super) fn frame_is_due(&self) -> bool {
        self.owed && self.left().is_zero()
    }

    /// Whether to draw now, when something has `changed` or a frame was owed. Counts it as drawn.
    pub(super) fn draws(&mut self, changed: bool) -> bool {
        self.owed |= changed;
        let now = self.frame_is_due();
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
        assert_eq!((pace.draws(false), pace.draws(true), pace.draws(true)), (false, true, false));
        assert!(pace.patience(false) <= LONG && !pace.frame_is_due());
        assert_eq!(pace.patience(true), Duration::from_millis(30));
        // Nothing owed, nothing waited for.
        let mut idle = Pace { frame: Duration::ZERO, ..pace };
        assert!(idle.draws(false) && !idle.draws(false));
        assert_eq!(idle.patience(false), LONG);
    }
}
