//! Signals, and how the workbench ended.

use std::path::{Path, PathBuf};

use crossbeam_channel::Receiver;

use super::journal::Kept;
use super::model::Model;
use crate::error::{Error, Result};
use crate::track::{Source, printable};

/// A signal, as far as it matters.
#[derive(Debug, Clone, Copy)]
#[cfg_attr(not(unix), expect(dead_code, reason = "there are no signals"))]
pub(super) enum Signalled {
    /// End, because of this signal.
    End(i32),
    Suspend,
    Resumed,
    /// The window has another size.
    Resized,
}

/// The signal that says that the terminal is gone.
pub(super) const HANG_UP: i32 = 1;

#[cfg(unix)]
pub(super) fn listen() -> Result<Receiver<Signalled>> {
    use signal_hook::consts::{SIGCONT, SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGTSTP, SIGWINCH};
    let mut signals =
        signal_hook::iterator::Signals::new([SIGTERM, SIGHUP, SIGINT, SIGQUIT, SIGTSTP, SIGCONT, SIGWINCH])
            .map_err(|source| Error::Io { action: "listen for", path: "signals".into(), source })?;
    let (sender, receiver) = crossbeam_channel::unbounded();
    let of_input = sender.clone();
    std::thread::spawn(move || {
        if input_has_ended() {
            let _ = of_input.send(Signalled::End(HANG_UP));
        }
    });
    std::thread::spawn(move || {
        for signal in signals.forever() {
            let meaning = match signal {
                SIGTSTP => Signalled::Suspend,
                SIGCONT => Signalled::Resumed,
                SIGWINCH => Signalled::Resized,
                other => Signalled::End(other),
            };
            if sender.send(meaning).is_err() {
                return;
            }
        }
    });
    Ok(receiver)
}

/// Waits for the end of input: the other side of the terminal is closed. Where the program is no part of its session,
/// no signal says so, and whoever reads input gets nothing, again and again. False when it cannot be known.
#[cfg(unix)]
fn input_has_ended() -> bool {
    use rustix::event::{PollFd, PollFlags, poll};
    use std::io::IsTerminal as _;
    // What keys are read from.
    let console = if std::io::stdin().is_terminal() { None } else { std::fs::File::open("/dev/tty").ok() };
    let stdin = std::io::stdin();
    loop {
        // No event is asked for: an end is told anyway.
        let mut input = match &console {
            Some(console) => PollFd::new(console, PollFlags::empty()),
            None => PollFd::new(&stdin, PollFlags::empty()),
        };
        match poll(std::slice::from_mut(&mut input), None) {
            Err(rustix::io::Errno::INTR) => {}
            Err(_) => return false,
            Ok(_) => return input.revents().intersects(PollFlags::HUP | PollFlags::ERR),
        }
    }
}

#[cfg(not(unix))]
pub(super) fn listen() -> Result<Receiver<Signalled>> {
    Ok(crossbeam_channel::never())
}

/// True when an error says that there is no terminal any more.
pub(super) fn is_gone(error: &Error) -> bool {
    /// EIO, what a write to a terminal gives whose other end is closed.
    const INPUT_OUTPUT: i32 = 5;
    match error {
        Error::Io { action: "use", source, .. } => {
            source.raw_os_error() == Some(INPUT_OUTPUT) || source.kind() == std::io::ErrorKind::BrokenPipe
        }
        _ => false,
    }
}

/// How the workbench ended.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Ended {
    /// The signal that ended it; none when the user left it.
    pub signal: Option<i32>,
    /// What the user should know of work that was not saved; empty when there is none.
    pub words: String,
}

impl Ended {
    /// Ended by `signal`, with what the journal has `kept` of the work that was not saved, if there is a journal.
    pub(super) fn by(signal: i32, model: &Model, kept: Option<&Kept>) -> Self {
        let name = match signal {
            HANG_UP => "the terminal is gone (SIGHUP)",
            2 => "interrupted (SIGINT)",
            3 => "ended (SIGQUIT)",
            15 => "terminated (SIGTERM)",
            _ => "ended by a signal",
        };
        let shown = |path: &Path| printable(&path.display().to_string());
        let words = match kept {
            _ if !model.unsaved() => format!("{name}; everything was saved"),
            Some(Kept { journal: Some(path), missing }) => {
                let again = reopened(model).map(|p| format!(" {}", shown(&p))).unwrap_or_default();
                let lost = match missing {
                    0 => String::new(),
                    1 => "the last change could not be written and is lost; earlier ".into(),
                    n => format!("the last {n} changes could not be written and are lost; earlier "),
                };
                let path = shown(path);
                format!("{name}; {lost}unsaved work is kept in {path}, `wildpoint{again}` offers it back")
            }
            Some(Kept { journal: None, .. }) => {
                format!("{name}; what was not saved is lost, since the journal could not be written")
            }
            None => format!("{name}; what was not saved is lost, since there is no journal"),
        };
        Self { signal: Some(signal), words }
    }
}

/// What is opened to go on; none for the record that needs no name.
fn reopened(model: &Model) -> Option<PathBuf> {
    match (&model.file, &model.track.source) {
        (Some(file), _) => Some(file.clone()),
        (None, Source::File(path)) => Some(path.clone()),
        (None, Source::BuiltIn { .. } | Source::Input(_)) => None,
    }
}
