//! The program as a user runs it: in a folder of its own, by its name, with files beside it.

use std::path::PathBuf;

use assert_cmd::Command;
use tempfile::TempDir;

/// A folder in which the program runs.
pub(crate) struct Folder(TempDir);

/// How a run ended.
pub(crate) struct Ran {
    pub(crate) status: i32,
    pub(crate) out: String,
    pub(crate) err: String,
}

impl Folder {
    /// A folder that holds these files.
    pub(crate) fn with(files: &[(&str, &[u8])]) -> Self {
        let folder = Self(TempDir::new().unwrap());
        for (name, bytes) in files {
            std::fs::write(folder.path(name), bytes).unwrap();
        }
        folder
    }

    /// A folder that holds the demonstration record as `demo.csv`.
    pub(crate) fn with_demo() -> Self {
        Self::with(&[("demo.csv", include_bytes!("../../data/demo.csv"))])
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub(crate) fn text(&self, name: &str) -> String {
        std::fs::read_to_string(self.path(name)).unwrap()
    }

    /// Everything in the folder, hidden files too.
    pub(crate) fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.0.path()).unwrap();
        let mut names: Vec<String> = entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    /// Runs `wildpoint` with these words; blanks stand between arguments.
    pub(crate) fn run(&self, words: &str) -> Ran {
        let mut command = Command::new(env!("CARGO_BIN_EXE_wildpoint"));
        command.current_dir(self.0.path()).env("LANG", "C.UTF-8").env_remove("LC_ALL").env_remove("NO_COLOR");
        // The configuration of whoever runs tests does not change them.
        command.env("XDG_CONFIG_HOME", self.0.path());
        // Nor does the day on which they run.
        command.env("SOURCE_DATE_EPOCH", "1767225600");
        let output = command.args(words.split_whitespace()).output().unwrap();
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
        Ran { status: output.status.code().unwrap(), out: text(output.stdout), err: text(output.stderr) }
    }

    /// Runs `wildpoint`, which must succeed without a complaint, and gives what it printed.
    pub(crate) fn done(&self, words: &str) -> String {
        let ran = self.run(words);
        assert_eq!((ran.status, ran.err.as_str()), (0, ""), "wildpoint {words}");
        ran.out
    }
}
