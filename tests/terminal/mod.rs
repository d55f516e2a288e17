//! The program in a terminal of its own: a pseudo terminal, what it wrote, and the screen that makes of it.
//!
//! Nothing waits for a time: a test waits until the screen shows what it should, and fails with the screen when that
//! has not come after [`PATIENCE`].

use std::io::{Read, Write};
use std::num::NonZeroU16;
use std::path::Path;
use std::sync::{Arc, Condvar, Mutex};
use std::time::{Duration, Instant};

use portable_pty::{Child, CommandBuilder, MasterPty, PtySize, native_pty_system};
use tempfile::TempDir;
use vt100::{Parser, Screen};

/// How long a condition may take on a busy machine.
const PATIENCE: Duration = Duration::from_secs(20);

/// The end of a frame (DEC mode 2026 off).
const FRAME_END: &[u8] = b"\x1b[?2026l";

/// What came out of the terminal so far.
struct Seen {
    parser: Parser,
    raw: Vec<u8>,
    closed: bool,
}

/// A running program.
pub(crate) struct Terminal {
    master: Box<dyn MasterPty + Send>,
    writer: Box<dyn Write + Send>,
    child: Box<dyn Child + Send + Sync>,
    seen: Arc<(Mutex<Seen>, Condvar)>,
    /// The user's state folder, unless the environment names one: journals do not lie in that of whoever runs tests.
    _state: TempDir,
}

/// Rows and columns as the parser wants them, which has one of each at least.
fn screen_size((cols, rows): (u16, u16)) -> (NonZeroU16, NonZeroU16) {
    [rows, cols].map(|n| NonZeroU16::new(n).unwrap_or(NonZeroU16::MIN)).into()
}

fn pty_size((cols, rows): (u16, u16)) -> PtySize {
    PtySize { rows, cols, pixel_width: 0, pixel_height: 0 }
}

impl Terminal {
    /// Starts `wildpoint` with these words in `folder`.
    pub(crate) fn start(folder: &Path, words: &str, size: (u16, u16), environment: &[(&str, &str)]) -> Self {
        let mut command = CommandBuilder::new(env!("CARGO_BIN_EXE_wildpoint"));
        command.args(words.split_whitespace());
        Self::spawn(command, folder, size, environment)
    }

    /// Starts it with its standard input from `input`, a file in `folder`, and not from the terminal.
    pub(crate) fn start_fed(folder: &Path, words: &str, input: &str, size: (u16, u16)) -> Self {
        let mut command = CommandBuilder::new("sh");
        let line = format!("exec '{}' {words} < {input}", env!("CARGO_BIN_EXE_wildpoint"));
        command.args(["-c", &line]);
        Self::spawn(command, folder, size, &[])
    }

    fn spawn(mut command: CommandBuilder, folder: &Path, size: (u16, u16), environment: &[(&str, &str)]) -> Self {
        let pair = native_pty_system().openpty(pty_size(size)).unwrap();
        command.cwd(folder);
        ["NO_COLOR", "COLORTERM", "LC_ALL", "LC_CTYPE"].into_iter().for_each(|name| command.env_remove(name));
        let state = TempDir::new().unwrap();
        command.env("XDG_STATE_HOME", state.path());
        // Nor does the configuration of whoever runs tests change them.
        command.env("XDG_CONFIG_HOME", state.path());
        // Nor does the moment at which decisions are made.
        command.env("SOURCE_DATE_EPOCH", "1767225600");
        for (name, value) in [("TERM", "xterm-256color"), ("LANG", "C.UTF-8")].iter().chain(environment) {
            command.env(name, value);
        }
        let child = pair.slave.spawn_command(command).unwrap();
        // The last open end on this side would keep the reader from seeing the end.
        drop(pair.slave);
        let (rows, cols) = screen_size(size);
        let seen = Seen { parser: Parser::new(rows, cols, 0), raw: Vec::new(), closed: false };
        let seen = Arc::new((Mutex::new(seen), Condvar::new()));
        let mut reader = pair.master.try_clone_reader().unwrap();
        let shared = Arc::clone(&seen);
        std::thread::spawn(move || {
            let mut chunk = [0; 4096];
            loop {
                let read = reader.read(&mut chunk).unwrap_or(0);
                let mut seen = shared.0.lock().unwrap();
                seen.parser.process(&chunk[..read]);
                seen.raw.extend_from_slice(&chunk[..read]);
                seen.closed = read == 0;
                shared.1.notify_all();
                if read == 0 {
                    return;
                }
            }
        });
        let writer = pair.master.take_writer().unwrap();
        Self { master: pair.master, writer, child, seen, _state: state }
    }

    /// Waits until `done`, and gives what it made of it.
    fn wait<T>(&self, what: &str, mut done: impl FnMut(&Seen) -> Option<T>) -> T {
        let deadline = Instant::now() + PATIENCE;
        let mut seen = self.seen.0.lock().unwrap();
        loop {
            if let Some(found) = done(&seen) {
                return found;
            }
            let left = deadline.saturating_duration_since(Instant::now());
            let screen = || seen.parser.screen().contents();
            assert!(!left.is_zero() && !seen.closed, "{what} has not come; the screen is\n{}", screen());
            seen = self.seen.1.wait_timeout(seen, left).unwrap().0;
        }
    }

    /// Waits until a whole frame has been drawn for which `done` holds.
    pub(crate) fn wait_until(&self, what: &str, done: impl Fn(&Screen) -> bool) {
        self.wait(what, |seen| (seen.raw.ends_with(FRAME_END) && done(seen.parser.screen())).then_some(()));
    }

    /// Waits until the screen shows a text.
    pub(crate) fn wait_for(&self, text: &str) {
        self.wait_until(text, |screen| screen.contents().contains(text));
    }

    /// Waits until the result on the screen is that of the settings: none is awaited.
    pub(crate) fn settle(&self) {
        self.wait_until("a result", |screen| title(screen).contains(" flagged") && !title(screen).contains('…'));
    }

    /// Types; the keys arrive in one piece.
    pub(crate) fn keys(&mut self, keys: &str) {
        self.writer.write_all(keys.as_bytes()).unwrap();
        self.writer.flush().unwrap();
    }

    /// Types a key and waits until the program has read it, so that what is typed next arrives apart from it.
    #[cfg(target_os = "linux")]
    pub(crate) fn key_by_itself(&mut self, key: &str) {
        let path = format!("/proc/{}/io", self.child.process_id().unwrap());
        // The first line is `rchar: N`, the bytes read so far from anywhere, terminals too.
        let read = || std::fs::read_to_string(&path).unwrap().lines().next().map(str::to_owned);
        let before = read();
        let deadline = Instant::now() + PATIENCE;
        self.keys(key);
        while read() == before {
            assert!(Instant::now() < deadline, "{key:?} has not been read");
            std::thread::yield_now();
        }
    }

    /// Waits until the program has stopped itself, as after Ctrl-Z.
    #[cfg(target_os = "linux")]
    pub(crate) fn wait_stopped(&self) {
        let path = format!("/proc/{}/stat", self.child.process_id().unwrap());
        let deadline = Instant::now() + PATIENCE;
        // `PID (NAME) STATE ...`
        while !std::fs::read_to_string(&path).unwrap().contains(") T ") {
            assert!(Instant::now() < deadline, "the program goes on");
            std::thread::yield_now();
        }
        // What it wrote before may still be on its way.
        self.wait("the end of the screen", |seen| seen.raw.ends_with(b"\x1b[?25h").then_some(()));
    }

    /// Makes the window another size.
    pub(crate) fn resize(&mut self, size: (u16, u16)) {
        let (rows, cols) = screen_size(size);
        self.seen.0.lock().unwrap().parser.screen_mut().set_size(rows, cols);
        self.master.resize(pty_size(size)).unwrap();
    }

    /// The number of the process.
    pub(crate) fn pid(&self) -> u32 {
        self.child.process_id().unwrap()
    }

    /// Sends a signal by its name.
    pub(crate) fn signal(&self, name: &str) {
        let pid = self.pid().to_string();
        let sent = std::process::Command::new("kill").args(["-s", name, &pid]).status().unwrap();
        assert!(sent.success());
    }

    /// Waits until a whole frame has come after this many bytes.
    pub(crate) fn wait_more(&self, than: usize) {
        self.wait("a frame", |seen| (seen.raw.len() > than && seen.raw.ends_with(FRAME_END)).then_some(()));
    }

    /// Waits until a whole frame has come after this many bytes, or the program has ended.
    pub(crate) fn wait_more_or_end(&self, than: usize) {
        let deadline = Instant::now() + PATIENCE;
        let mut seen = self.seen.0.lock().unwrap();
        while !(seen.closed || seen.raw.len() > than && seen.raw.ends_with(FRAME_END)) {
            let left = deadline.saturating_duration_since(Instant::now());
            assert!(!left.is_zero(), "no frame has come; the screen is\n{}", seen.parser.screen().contents());
            seen = self.seen.1.wait_timeout(seen, left).unwrap().0;
        }
    }

    /// Whether the program has closed its terminal.
    pub(crate) fn ended(&self) -> bool {
        self.seen.0.lock().unwrap().closed
    }

    /// Ends the program as a power cut would, at once.
    pub(crate) fn kill(mut self) {
        self.signal("KILL");
        self.child.wait().unwrap();
    }

    /// How many frames have come.
    pub(crate) fn frames(&self) -> usize {
        let seen = self.seen.0.lock().unwrap();
        seen.raw.windows(FRAME_END.len()).filter(|bytes| *bytes == FRAME_END).count()
    }

    /// How many bytes have come.
    pub(crate) fn bytes(&self) -> usize {
        self.seen.0.lock().unwrap().raw.len()
    }

    /// What has come so far.
    pub(crate) fn raw(&self) -> Vec<u8> {
        self.seen.0.lock().unwrap().raw.clone()
    }

    /// Looks at the screen as it is.
    pub(crate) fn look<T>(&self, look: impl FnOnce(&Screen) -> T) -> T {
        look(self.seen.0.lock().unwrap().parser.screen())
    }

    /// Waits for the end of the program; gives its exit status and all it wrote.
    pub(crate) fn end(mut self) -> (u32, Vec<u8>) {
        let raw = self.wait_closed();
        (self.child.wait().unwrap().exit_code(), raw)
    }

    fn wait_closed(&self) -> Vec<u8> {
        let deadline = Instant::now() + PATIENCE;
        let mut seen = self.seen.0.lock().unwrap();
        while !seen.closed {
            let left = deadline.saturating_duration_since(Instant::now());
            assert!(!left.is_zero(), "the program goes on; the screen is\n{}", seen.parser.screen().contents());
            seen = self.seen.1.wait_timeout(seen, left).unwrap().0;
        }
        seen.raw.clone()
    }
}

/// The first line of the screen.
pub(crate) fn title(screen: &Screen) -> String {
    screen.rows(0, u16::MAX).next().unwrap_or_default()
}

impl Drop for Terminal {
    fn drop(&mut self) {
        // A test that failed leaves nothing behind.
        let _ = self.child.kill();
    }
}
