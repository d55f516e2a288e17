//! How far work of more than a second is, on a terminal.

use std::io::IsTerminal;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

/// Work that takes less shows nothing.
const AFTER: Duration = Duration::from_secs(1);

/// A bar for several items, a clock for one. It is on standard error, and only where that is a terminal; it goes when it is
/// dropped.
pub(super) struct Progress(ProgressBar);

impl Progress {
    /// For so many items.
    pub(super) fn new(items: usize, quiet: bool) -> Self {
        if quiet || !std::io::stderr().is_terminal() {
            return Self(ProgressBar::hidden());
        }
        let template = if items > 1 { "[{bar:30}] {pos} of {len}, {eta} left" } else { "working, {elapsed}" };
        let style = ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar());
        let bar = ProgressBar::new(items as u64).with_style(style.progress_chars("##."));
        // The first tick draws it.
        bar.enable_steady_tick(AFTER);
        Self(bar)
    }

    /// One more is done.
    pub(super) fn done(&self) {
        if self.0.elapsed() >= AFTER {
            self.0.inc(1);
        } else {
            self.0.update(|state| state.set_pos(state.pos() + 1));
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
