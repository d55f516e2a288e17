//! The copy of the checkout that the mutants are written into.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Where everything lies, all of it below `target/mutants` of the checkout.
#[derive(Clone, Debug)]
pub struct Tree {
    /// The checkout.
    pub root: PathBuf,
    /// Its copy.
    pub copy: PathBuf,
    /// What cargo builds.
    pub build: PathBuf,
    /// Where tests may write: a folder for each worker.
    pub scratch: PathBuf,
    /// The outcomes, a line for each mutant.
    pub outcomes: PathBuf,
}

/// Words for a fault of the file system at `path`.
pub fn fault(path: &Path) -> impl Fn(std::io::Error) -> String + '_ {
    move |e| format!("{}: {e}", path.display())
}

impl Tree {
    /// The places for the checkout this program was built in.
    ///
    /// # Errors
    /// Words that say that the checkout is not there.
    pub fn new() -> Result<Self, String> {
        let here = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let root = here.canonicalize().map_err(fault(&here))?;
        let at = root.join("target/mutants");
        Ok(Self {
            copy: at.join("tree"),
            build: at.join("build"),
            scratch: at.join("scratch"),
            outcomes: at.join("outcomes.tsv"),
            root,
        })
    }

    /// Makes the copy what the checkout is, but for what is beside it (`fuzz`) and the `rewritten` files. Files
    /// that do not change keep their times, so that what depends on them is not built again.
    ///
    /// # Errors
    /// Words that name the file that could not be read or written.
    pub fn write(&self, rewritten: &[(String, String)]) -> Result<(), String> {
        for name in self.names()? {
            if name.starts_with("fuzz/") || rewritten.iter().any(|(file, _)| *file == name) {
                continue;
            }
            let from = self.root.join(&name);
            if from.is_file() {
                put(&self.copy.join(&name), &fs::read(&from).map_err(fault(&from))?)?;
            }
        }
        for (name, text) in rewritten {
            put(&self.copy.join(name), text.as_bytes())?;
        }
        self.link("shared")
    }

    /// What the tests look for beside the checkout is beside the copy.
    fn link(&self, name: &str) -> Result<(), String> {
        let (from, to) = (self.root.join("..").join(name), self.copy.join("..").join(name));
        match from.canonicalize() {
            Ok(from) if !to.exists() => std::os::unix::fs::symlink(from, &to).map_err(fault(&to)),
            _ => Ok(()),
        }
    }

    /// Files of the checkout that git knows or would take.
    fn names(&self) -> Result<Vec<String>, String> {
        let output = Command::new("git")
            .args(["ls-files", "-z", "--cached", "--others", "--exclude-standard"])
            .current_dir(&self.root)
            .output()
            .map_err(|e| format!("git cannot be run: {e}"))?;
        let list = String::from_utf8_lossy(&output.stdout).into_owned();
        Ok(list.split('\0').filter(|name| !name.is_empty()).map(str::to_owned).collect())
    }
}

/// Writes a file unless it is the same already.
fn put(path: &Path, bytes: &[u8]) -> Result<(), String> {
    if fs::read(path).is_ok_and(|old| old == bytes) {
        return Ok(());
    }
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(fault(folder))?;
    }
    fs::write(path, bytes).map_err(fault(path))
}
