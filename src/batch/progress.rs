//! How far work of more than a second is, on a terminal.

use std::io::IsTerminal;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::JoinHandle;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Work that takes less shows nothing.
const AFTER: Duration = Duration::from_secs(1);
/// How often it is drawn then.
const EVERY: Duration = Duration::from_millis(200);

/// A bar for several items, a clock for one. It is on standard error, and only where that is a terminal; it goes when it is
/// dropped.
pub(super) struct Progress {
    bar: ProgressBar,
    /// Shows the bar after a while, unless the work has ended.
    shower: Option<(Sender<()>, JoinHandle<()>)>,
}

impl Progress {
    /// For this many items.
    pub(super) fn new(items: usize, quiet: bool) -> Self {
        let template = if items > 1 { "[{bar:30}] {pos} of {len}, {eta} left" } else { "working, {elapsed}" };
        let style = ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar());
        let bar = ProgressBar::with_draw_target(Some(items as u64), ProgressDrawTarget::hidden());
        let bar = bar.with_style(style.progress_chars("##."));
        let shown = !quiet && std::io::stderr().is_terminal();
        let shower = shown.then(|| {
            let (ended, end) = channel::<()>();
            let bar = bar.clone();
            let show = move || {
                if end.recv_timeout(AFTER) == Err(RecvTimeoutError::Timeout) {
                    bar.set_draw_target(ProgressDrawTarget::stderr());
                    bar.enable_steady_tick(EVERY);
                }
            };
            (ended, std::thread::spawn(show))
        });
        Self { bar, shower }
    }

    /// One more is done.
    pub(super) fn done(&self) {
        self.bar.inc(1);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some((ended, shower)) = self.shower.take() {
            drop(ended);
            let _ = shower.join();
        }
        self.bar.finish_and_clear();
    }
}
