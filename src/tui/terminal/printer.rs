//! What goes to the terminal goes through a thread of its own. Writing to a terminal that nobody reads blocks, and the
//! loop of the workbench must never block: it takes signals, keys and the journal's news.

use std::io::{self, Write};
use std::sync::{Condvar, Mutex, MutexGuard, OnceLock, PoisonError};
use std::time::{Duration, Instant};

use crossbeam_channel::{Receiver, Sender, bounded};

/// How long leaving waits for a terminal that may only be slow.
const PATIENCE: Duration = Duration::from_millis(250);

/// Ends a sequence that was cut short (CAN), so that what follows is not taken for its rest.
const CANCEL: &[u8] = b"\x18";

/// The way to the terminal. There is one terminal, and so one of these.
pub(super) struct Printer {
    state: Mutex<State>,
    bell: Condvar,
    /// Tells the loop that everything has been written, or cannot be.
    done: (Sender<()>, Receiver<()>),
}

#[derive(Default)]
struct State {
    /// What is still to be written.
    waiting: Vec<u8>,
    /// True while the thread writes.
    writing: bool,
    /// Why the terminal takes nothing any more.
    failed: Option<io::Error>,
}

impl State {
    fn idle(&self) -> bool {
        self.waiting.is_empty() && !self.writing
    }
}

/// The printer of standard output.
pub(super) fn printer() -> &'static Printer {
    static PRINTER: OnceLock<Printer> = OnceLock::new();
    static THREAD: std::sync::Once = std::sync::Once::new();
    let printer = PRINTER.get_or_init(|| Printer { state: Mutex::default(), bell: Condvar::new(), done: bounded(1) });
    THREAD.call_once(|| drop(std::thread::spawn(|| printer.work(io::stdout()))));
    printer
}

impl Printer {
    /// Hands bytes over. Gives the error of an earlier write, after which nothing more is written.
    pub(super) fn print(&self, bytes: &[u8]) -> io::Result<()> {
        let mut state = self.state();
        if let Some(e) = &state.failed {
            // An error cannot be copied; its number and kind are what is asked for.
            return Err(e.raw_os_error().map_or_else(|| e.kind().into(), io::Error::from_raw_os_error));
        }
        state.waiting.extend_from_slice(bytes);
        drop(state);
        self.bell.notify_all();
        Ok(())
    }

    /// True when the terminal has taken everything.
    pub(super) fn idle(&self) -> bool {
        self.state().idle()
    }

    /// Gets a message each time that the terminal has taken everything, or has failed.
    pub(super) fn done(&self) -> Receiver<()> {
        self.done.1.clone()
    }

    /// Sees to it that the next bytes get through: waits for what is under way and, when the terminal does not take
    /// it, throws it away. False when even that did not help.
    pub(super) fn make_way(&self) -> bool {
        if self.wait(PATIENCE) {
            return true;
        }
        self.state().waiting.clear();
        let deadline = Instant::now() + PATIENCE;
        while Instant::now() < deadline {
            #[cfg(unix)]
            let _ = discard();
            if self.wait(Duration::from_millis(10)) {
                return self.print(CANCEL).is_ok();
            }
        }
        false
    }

    /// Waits until everything is written, but not longer than this.
    pub(super) fn wait(&self, patience: Duration) -> bool {
        let idle = self.bell.wait_timeout_while(self.state(), patience, |state| !state.idle());
        idle.unwrap_or_else(PoisonError::into_inner).0.idle()
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Writes what is handed over, as long as the program runs.
    fn work(&self, mut terminal: impl Write) {
        loop {
            let waiting = self.bell.wait_while(self.state(), |state| state.waiting.is_empty());
            let mut state = waiting.unwrap_or_else(PoisonError::into_inner);
            let bytes = std::mem::take(&mut state.waiting);
            state.writing = true;
            drop(state);
            let result = terminal.write_all(&bytes).and_then(|()| terminal.flush());
            let mut state = self.state();
            state.writing = false;
            if let Err(e) = result {
                state.failed = Some(e);
                state.waiting.clear();
            }
            let idle = state.idle();
            drop(state);
            self.bell.notify_all();
            if idle {
                // One that has not been heard yet says the same.
                let _ = self.done.0.try_send(());
            }
        }
    }
}

/// What the system holds for the terminal goes, so that the write that is blocked ends. Making room does not wake it up;
/// setting the modes does, to what they are.
#[cfg(unix)]
fn discard() -> rustix::io::Result<()> {
    use rustix::termios::{OptionalActions, QueueSelector, tcflush, tcgetattr, tcsetattr};
    let terminal = rustix::stdio::stdout();
    tcflush(terminal, QueueSelector::OFlush)?;
    tcsetattr(terminal, OptionalActions::Now, &tcgetattr(terminal)?)
}

/// Collects a frame, and hands it over as one piece when it is flushed.
#[derive(Default)]
pub(super) struct Sheet(Vec<u8>);

impl Write for Sheet {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        let bytes = std::mem::take(&mut self.0);
        printer().print(&bytes)
    }
}
