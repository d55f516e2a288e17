//! A terminal that is not read, and one whose other side is closed without a signal.

use std::io::{Read as _, Write as _};
use std::time::{Duration, Instant};

use portable_pty::{Child, CommandBuilder, MasterPty, PtySize, native_pty_system};
use tempfile::TempDir;

use super::program::Folder;

/// How long a condition may take on a busy machine.
const PATIENCE: Duration = Duration::from_secs(20);

/// The program in a terminal that is read only when a test says so.
struct Unread {
    folder: Folder,
    state: TempDir,
    master: Box<dyn MasterPty + Send>,
    child: Box<dyn Child + Send + Sync>,
}

impl Unread {
    /// Starts the workbench; `controlling` when it is told of the end of its terminal by a signal.
    fn start(controlling: bool) -> Self {
        let (folder, state) = (Folder::with_demo(), TempDir::new().unwrap());
        let size = PtySize { rows: 40, cols: 120, pixel_width: 0, pixel_height: 0 };
        let pair = native_pty_system().openpty(size).unwrap();
        let mut command = CommandBuilder::new(env!("CARGO_BIN_EXE_wildpoint"));
        command.arg("demo.csv");
        command.cwd(folder.path(""));
        command.env("XDG_STATE_HOME", state.path());
        command.env("XDG_CONFIG_HOME", state.path());
        command.env("TERM", "xterm-256color");
        command.set_controlling_tty(controlling);
        let child = pair.slave.spawn_command(command).unwrap();
        Self { folder, state, master: pair.master, child }
    }

    fn journals(&self) -> usize {
        let folder = std::fs::read_dir(self.state.path().join("wildpoint/journal"));
        folder.map_or(0, |entries| entries.flatten().filter(|e| e.path().extension().unwrap() == "journal").count())
    }

    /// Bytes that the program has written so far, to whatever.
    fn written(&self) -> u64 {
        let io = std::fs::read_to_string(format!("/proc/{}/io", self.child.process_id().unwrap())).unwrap();
        io.lines().find_map(|line| line.strip_prefix("wchar: ")).unwrap().parse().unwrap()
    }

    /// Waits until `done`; gives false when the patience is at its end.
    fn until(patience: Duration, mut done: impl FnMut() -> bool) -> bool {
        let deadline = Instant::now() + patience;
        while !done() {
            if Instant::now() > deadline {
                return false;
            }
            std::thread::yield_now();
        }
        true
    }

    /// The status with which the program ends.
    fn ends(&mut self) -> Option<u32> {
        let mut status = None;
        Self::until(PATIENCE, || {
            status = self.child.try_wait().unwrap();
            status.is_some()
        });
        status.map(|s| s.exit_code())
    }
}

impl Drop for Unread {
    fn drop(&mut self) {
        let _ = self.child.kill();
    }
}

#[test]
fn a_signal_ends_a_workbench_whose_terminal_is_not_read_with_its_journal_whole() {
    for (name, status) in [("TERM", 143), ("HUP", 129), ("INT", 130)] {
        let mut program = Unread::start(true);
        let mut keys = program.master.take_writer().unwrap();
        // A first frame, whatever it shows, has been written; the terminal holds it unread.
        assert!(Unread::until(PATIENCE, || program.written() > 2000));
        assert!(Unread::until(PATIENCE, || {
            keys.write_all(b"a").unwrap();
            Unread::until(Duration::from_millis(200), || program.journals() == 1)
        }));
        // Whole frames, until a further one no longer gets through: the program is stuck in writing.
        let stuck = Unread::until(PATIENCE, || {
            let before = program.written();
            keys.write_all(b"\x0c").unwrap();
            !Unread::until(Duration::from_millis(500), || program.written() > before)
        });
        assert!(stuck, "the terminal takes everything");
        let pid = program.child.process_id().unwrap().to_string();
        assert!(std::process::Command::new("kill").args(["-s", name, &pid]).status().unwrap().success());
        assert_eq!(program.ends(), Some(status), "{name}");
        assert_eq!(program.journals(), 1);
        // What the terminal gets to see in the end gives it back.
        let mut raw = Vec::new();
        let mut reader = program.master.try_clone_reader().unwrap();
        let _ = reader.read_to_end(&mut raw);
        let text = String::from_utf8_lossy(&raw);
        assert!(text.contains("\x1b[?1049l") && text.contains("\x1b[?25h"), "{text:?}");
        assert!(text.contains("unsaved work is kept in"), "{text:?}");
        drop(keys);
        assert!(program.folder.path("demo.csv").exists());
    }
}

#[test]
fn the_end_of_input_ends_the_workbench_without_a_signal() {
    let mut program = Unread::start(false);
    let (mut reader, mut keys) = (program.master.try_clone_reader().unwrap(), program.master.take_writer().unwrap());
    let (mut screen, mut chunk) = (vt100::Parser::new(40.try_into().unwrap(), 120.try_into().unwrap(), 0), [0; 4096]);
    for (wanted, key) in [(" flagged", "a"), ("accepted row 61", "")] {
        while !screen.screen().contents().contains(wanted) {
            let read = reader.read(&mut chunk).unwrap();
            assert_ne!(read, 0, "the program has ended");
            screen.process(&chunk[..read]);
        }
        keys.write_all(key.as_bytes()).unwrap();
    }
    // All that is open on this side goes, after the last frame: a write that fails would end the program too.
    assert!(Unread::until(PATIENCE, || {
        let before = program.written();
        !Unread::until(Duration::from_millis(500), || program.written() > before)
    }));
    let nobody = native_pty_system().openpty(PtySize::default()).unwrap().master;
    drop((reader, keys, std::mem::replace(&mut program.master, nobody)));
    assert_eq!(program.ends(), Some(129));
    assert_eq!(program.journals(), 1);
}
