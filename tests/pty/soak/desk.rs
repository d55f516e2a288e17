//! A record, a state folder, and the workbenches on them.

use std::io::Write as _;
use std::path::PathBuf;

use rustix::process::{Pid, Resource, Rlimit, prlimit};
use tempfile::TempDir;

use super::super::program::Folder;
use super::super::terminal::{Terminal, title};

/// The window in which decisions are made: what the program says about them stands on one line.
pub(super) const WINDOW: (u16, u16) = (110, 30);

/// The length of the record before it grows.
const RECORD: &[u8] = include_bytes!("../../../data/demo.csv");

pub(super) struct Desk {
    folder: Folder,
    state: TempDir,
}

impl Desk {
    pub(super) fn new() -> Self {
        Self { folder: Folder::with_demo(), state: TempDir::new().unwrap() }
    }

    /// Starts a workbench on the record.
    pub(super) fn start(&self, size: (u16, u16)) -> Terminal {
        let state = self.state.path().display().to_string();
        Terminal::start(&self.folder.path(""), "demo.csv", size, &[("XDG_STATE_HOME", &state)])
    }

    /// The record gets a row more, as if it were still being written.
    pub(super) fn grow(&self) {
        let mut file = std::fs::File::options().append(true).open(self.folder.path("demo.csv")).unwrap();
        let row = String::from_utf8_lossy(RECORD).lines().last().unwrap().to_owned();
        let length = self.folder.path("demo.csv").metadata().unwrap().len();
        writeln!(file, "{}", row.replacen(row.split(',').next().unwrap(), &format!("{}", 1_000_000 + length), 1))
            .unwrap();
    }

    /// The record is what it was before it grew.
    pub(super) fn shrink(&self) {
        let file = std::fs::File::options().write(true).open(self.folder.path("demo.csv")).unwrap();
        file.set_len(RECORD.len() as u64).unwrap();
    }

    pub(super) fn has_grown(&self) -> bool {
        self.folder.path("demo.csv").metadata().unwrap().len() > RECORD.len() as u64
    }

    fn journals(&self) -> Vec<PathBuf> {
        let entries = std::fs::read_dir(self.state.path().join("wildpoint/journal"));
        let paths = entries.into_iter().flatten().flatten().map(|entry| entry.path());
        paths.filter(|path| path.extension().is_some_and(|e| e == "journal")).collect()
    }

    /// Whether any workbench may write one more line into its journal.
    pub(super) fn fill(&self, terminal: &Terminal, full: bool) {
        let length = self.journals().iter().filter_map(|path| Some(path.metadata().ok()?.len())).max();
        let pid = Pid::from_raw(terminal.pid().try_into().unwrap());
        // A part of a line still fits.
        let current = full.then(|| length.unwrap_or(0) + 17);
        prlimit(pid, Resource::Fsize, Rlimit { current, maximum: None }).unwrap();
    }

    /// The decisions about a channel that a workbench saves, and the end of the workbench.
    pub(super) fn saved(&self, mut terminal: Terminal, channel: &str) -> Vec<(u32, char)> {
        terminal.keys(":w! check.toml\r");
        terminal.wait_for("saved check.toml");
        terminal.keys(":q!\r");
        assert_eq!(terminal.end().0, 0);
        let session = wildpoint::session::read(&self.folder.path("check.toml")).unwrap();
        let plan = session.plans.iter().find(|plan| plan.channel == channel);
        let initial = |word: &str| word.chars().next().unwrap();
        plan.map_or_else(Vec::new, |plan| {
            plan.decisions.iter().map(|(row, d)| (row + 1, initial(d.ruling.verdict().word()))).collect()
        })
    }
}

/// Whether the workbench says that it does not journal.
pub(super) fn not_journalled(terminal: &Terminal) -> bool {
    terminal.look(|screen| title(screen).contains("not journalled"))
}
