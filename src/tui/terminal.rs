//! The terminal: taken over at the start, given back at every end.

use std::io::Write;
use std::mem::ManuallyDrop;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use crossbeam_channel::Receiver;
use ratatui::Terminal;
use ratatui::crossterm::event::{DisableBracketedPaste, EnableBracketedPaste};
use ratatui::crossterm::style::{Print, force_color_output};
use ratatui::crossterm::terminal::{
    BeginSynchronizedUpdate, EndSynchronizedUpdate, EnterAlternateScreen, LeaveAlternateScreen, disable_raw_mode,
    enable_raw_mode,
};
use ratatui::crossterm::{cursor, queue};
use ratatui::layout::Rect;

use super::clipboard;
use super::model::Model;
use super::view::view;
use super::wire::{Wire, plain_blanks};
use crate::error::{Error, Result};
use printer::{Sheet, printer};

mod printer;

/// How long leaving waits until the terminal has taken the last bytes.
const LAST_WORDS: Duration = Duration::from_millis(100);

/// True while the terminal is ours.
static TAKEN: AtomicBool = AtomicBool::new(false);

/// True while the mouse is ours, or will be when the terminal is taken again.
static MOUSE: AtomicBool = AtomicBool::new(false);

/// Presses, releases, the wheel, and movement while a button is down, in the form without a limit of 223 columns.
/// Not mode 1003: over a slow line every movement of the hand would cost bytes.
const MOUSE_ON: &str = "\x1b[?1000h\x1b[?1002h\x1b[?1006h";
const MOUSE_OFF: &str = "\x1b[?1006l\x1b[?1002l\x1b[?1000l";

/// The screen of the workbench. It gives the terminal back itself: what is inside is never dropped, since its own
/// `Drop` complains on standard error when it cannot show the cursor, which panics where the whole terminal is gone.
pub(super) struct Screen {
    terminal: ManuallyDrop<Terminal<Wire<Sheet>>>,
    /// True when the next frame is drawn whole, whatever the terminal shows.
    whole: bool,
}

impl Screen {
    /// Takes the terminal over, and with `mouse` the mouse.
    pub(super) fn take(mouse: bool) -> Result<Self> {
        MOUSE.store(mouse, Ordering::SeqCst);
        // Colours are ours to choose: crossterm's own handling of NO_COLOR also cancels reverse and bold.
        force_color_output(true);
        give_back_on_panic();
        enter()?;
        let backend = Wire::new(Sheet::default());
        let terminal = Terminal::new(backend).map_err(failed)?;
        Ok(Self { terminal: ManuallyDrop::new(terminal), whole: false })
    }

    /// Columns and rows.
    pub(super) fn size(&self) -> Result<(u16, u16)> {
        self.terminal.size().map(|s| (s.width, s.height)).map_err(failed)
    }

    /// Draws the model; terminals that can, show the frame at once.
    pub(super) fn draw(&mut self, model: &Model) -> Result<()> {
        queue!(self.terminal.backend_mut(), BeginSynchronizedUpdate).map_err(failed)?;
        if std::mem::take(&mut self.whole) {
            self.clear()?;
        }
        let drawing = |frame: &mut ratatui::Frame<'_>| {
            view(model, frame);
            plain_blanks(frame.buffer_mut());
        };
        self.terminal.draw(drawing).map_err(failed)?;
        #[cfg(debug_assertions)]
        panic_on_demand();
        queue!(self.terminal.backend_mut(), EndSynchronizedUpdate).map_err(failed)?;
        std::io::Write::flush(self.terminal.backend_mut()).map_err(failed)
    }

    /// True when the terminal has taken all that was drawn.
    pub(super) fn is_free(&self) -> bool {
        printer().idle()
    }

    /// Gets a message each time that the screen may be free again, or gone.
    pub(super) fn freed(&self) -> Receiver<()> {
        printer().done()
    }

    /// The error of what was written last, if there is one.
    pub(super) fn check(&self) -> Result<()> {
        printer().print(&[]).map_err(failed)
    }

    /// Forgets what the terminal shows, so that the next frame is drawn whole.
    pub(super) fn forget(&mut self) {
        self.whole = true;
    }

    /// Clears the terminal. (`Terminal::clear` would ask it where its cursor is and wait for the answer.)
    fn clear(&mut self) -> Result<()> {
        let (width, height) = self.size()?;
        self.terminal.resize(Rect { x: 0, y: 0, width, height }).map_err(failed)
    }

    /// Takes the mouse, or gives it to the terminal.
    pub(super) fn mouse(&mut self, on: bool) -> Result<()> {
        MOUSE.store(on, Ordering::SeqCst);
        self.say(if on { MOUSE_ON } else { MOUSE_OFF })
    }

    /// Puts a text on the clipboard of the terminal.
    pub(super) fn copy(&mut self, text: &str) -> Result<()> {
        self.say(&clipboard::sequence(text, std::env::var_os("TMUX").is_some()))
    }

    fn say(&mut self, sequence: &str) -> Result<()> {
        let terminal = self.terminal.backend_mut();
        terminal.write_all(sequence.as_bytes()).and_then(|()| std::io::Write::flush(terminal)).map_err(failed)
    }

    /// Gives the terminal back until the shell lets the program go on.
    pub(super) fn suspend(&mut self) -> Result<()> {
        leave();
        #[cfg(unix)]
        signal_hook::low_level::emulate_default_handler(signal_hook::consts::SIGTSTP).map_err(failed)?;
        enter()?;
        self.forget();
        Ok(())
    }
}

impl Drop for Screen {
    fn drop(&mut self) {
        leave();
    }
}

fn failed(source: std::io::Error) -> Error {
    Error::Io { action: "use", path: "the terminal".into(), source }
}

fn enter() -> Result<()> {
    enable_raw_mode().map_err(failed)?;
    TAKEN.store(true, Ordering::SeqCst);
    let mouse = Print(if MOUSE.load(Ordering::SeqCst) { MOUSE_ON } else { "" });
    let mut sheet = Sheet::default();
    queue!(sheet, EnterAlternateScreen, EnableBracketedPaste, mouse, cursor::Hide).map_err(failed)?;
    sheet.flush().map_err(failed)
}

/// Gives the terminal back, once, and without waiting long for it: nobody may be reading what it shows.
pub(super) fn leave() {
    if TAKEN.swap(false, Ordering::SeqCst) {
        if printer().make_way() {
            give_back();
        }
        // A terminal that is gone cannot be restored.
        let _ = disable_raw_mode();
    }
}

fn give_back() {
    let mouse = Print(if MOUSE.load(Ordering::SeqCst) { MOUSE_OFF } else { "" });
    let mut sheet = Sheet::default();
    let written =
        queue!(sheet, EndSynchronizedUpdate, mouse, DisableBracketedPaste, LeaveAlternateScreen, cursor::Show);
    if written.and_then(|()| sheet.flush()).is_ok() {
        printer().wait(LAST_WORDS);
    }
}

/// What tests of a panic need, in builds for tests alone.
#[cfg(debug_assertions)]
fn panic_on_demand() {
    assert!(std::env::var_os("WILDPOINT_PANIC").is_none(), "a panic on demand");
}

/// A panic gives the terminal back before it speaks.
fn give_back_on_panic() {
    static ONCE: std::sync::Once = std::sync::Once::new();
    ONCE.call_once(|| {
        let before = std::panic::take_hook();
        std::panic::set_hook(Box::new(move |info| {
            leave();
            before(info);
        }));
    });
}
